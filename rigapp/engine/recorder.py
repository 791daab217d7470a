"""Put revolutions, cycles, predictions and events of one test into its file."""

from __future__ import annotations

import threading
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.engine.assembler import Revolution
from rigapp.engine.calibrate import Calibrated, Calibration, calibrate
from rigapp.engine.columns import PREDICTED_CURVES
from rigapp.engine.messages import Cycle, Event, Prediction, RevolutionMeasured, as_array
from rigapp.engine.schedule import Schedule
from rigapp.engine.store import Store

Array = NDArray[np.float64]


def cycle_samples(
    revolution: Revolution, calibration: Calibration, start_sample: int, time_offset_s: float
) -> dict[str, ArrayLike]:
    """Return the columns of ``cycle_columns`` for one revolution, (samples,) each.

    start_sample: device sample at which the test's time was time_offset_s.
    """
    values = calibrate(revolution, calibration)
    inside = slice(revolution.before, revolution.before + revolution.samples)
    raw = revolution.values[:, inside]
    rows = calibration.rows
    signals = (
        raw[list(rows)].astype(np.float64) * calibration.scale[:, None]
        + calibration.offset[:, None]
    )
    time = (revolution.sample_indices() - start_sample) / revolution.sample_rate_Hz
    return {
        "angle": np.degrees(values.angle_rad),
        "time": time + time_offset_s,
        "force_1": values.force_1,
        "force_2": values.force_2,
        "force": values.force,
        "probe_1": values.probe_1,
        "probe_2": values.probe_2,
        "raw_force_1": signals[0],
        "raw_force_2": signals[1],
        "raw_probe_1": signals[2],
        "raw_probe_2": signals[3],
        "raw_count": raw[calibration.counter_row],
    }


def cycle_message(number: int, revolution: Revolution, calibration: Calibration) -> Cycle:
    """Return one revolution for drawing."""
    values: Calibrated = calibrate(revolution, calibration)

    def packed(array: Array) -> bytes:
        return array.astype("<f4").tobytes()

    return Cycle(
        revolution=number,
        angle_deg=packed(np.degrees(values.angle_rad)),
        force_1=packed(values.force_1),
        force_2=packed(values.force_2),
        force=packed(values.force),
        probe_1=packed(values.probe_1),
        probe_2=packed(values.probe_2),
    )


class Recorder:
    """Write one test; rows from the processing thread, the rest from any.

    After ``close`` nothing is written any more, and nothing fails.
    """

    def __init__(
        self,
        store: Store,
        schedule: Schedule,
        calibration: Calibration,
        time_offset_s: float,
    ) -> None:
        self._store = store
        self._schedule = schedule
        self._calibration = calibration
        self._start_sample = 0
        self._time_offset_s = time_offset_s
        self._lock = threading.Lock()
        self._closed = False
        self._last: tuple[int, Revolution] | None = None
        self._last_kept = 0
        self._curves_due = False
        self.committed = 0

    def begin(self, sample: int) -> None:
        """Take note of the device sample at which the test's time starts."""
        self._start_sample = sample

    @property
    def rows(self) -> int:
        """Return the rows in the file, committed or not."""
        return self._store.revolutions

    @property
    def cycles_refused(self) -> int:
        """Return the whole cycles that had no room."""
        return self._store.cycles_refused

    def row(self, number: int, row: Array, revolution: Revolution) -> None:
        """Write a row, and its whole cycle when the schedule keeps it."""
        with self._lock:
            if self._closed:
                return
            self._store.append_row(row)
            self._last = (number, revolution)
            if self._schedule.keeps(number):
                self._keep(number, revolution)

    def prediction(self, prediction: Prediction) -> Array:
        """Write a prediction and return its values; curves beside the kept cycles only."""
        values = as_array(prediction.values, "<f8")
        with self._lock:
            curves: Mapping[str, ArrayLike] | None = None
            if self._curves_due and prediction.revolution >= self._last_kept:
                curves = {name: as_array(getattr(prediction, name)) for name in PREDICTED_CURVES}
                self._curves_due = False
            if not self._closed:
                self._store.append_prediction(values, curves)
        return values

    def event(self, event: Event) -> None:
        """Write an event."""
        with self._lock:
            if not self._closed:
                self._store.append_event(event)

    def gap(self, event: Event) -> None:
        """Write and count an interruption of the data."""
        with self._lock:
            if not self._closed:
                self._store.note_gap(event)

    def commit(self) -> int:
        """Make everything safe; return the safe rows. Appending goes on meanwhile."""
        if not self._closed:
            self.committed = self._store.commit()
        return self.committed

    def finish(self, status: str, reason_code: str, sentence: str) -> None:
        """Keep the last cycle, say how the test ended, and close the file."""
        with self._lock:
            if self._closed:
                return
            if self._last is not None and self._schedule.any and self._last[0] != self._last_kept:
                self._keep(*self._last)
            self._closed = True
        try:
            self._store.finish(status, reason_code, sentence)
            self.committed = self._store.revolutions
        finally:
            self._store.close()

    def abandon(self) -> None:
        """Close the file after the disk refused it; never raises."""
        with self._lock:
            self._closed = True
        try:
            self._store.close()
        except Exception:
            return

    def _keep(self, number: int, revolution: Revolution) -> None:
        columns = cycle_samples(
            revolution, self._calibration, self._start_sample, self._time_offset_s
        )
        if self._store.append_cycle(number, columns):
            self._last_kept = number
            self._curves_due = True


def measured_history(
    number: int, revolution: Revolution, calibration: Calibration
) -> RevolutionMeasured:
    """Return what the twin needs of one revolution."""
    values = calibrate(revolution, calibration)

    def packed(array: Array) -> bytes:
        return array.astype("<f8").tobytes()

    return RevolutionMeasured(
        revolution=number,
        time_s=packed(values.time_s),
        angle_rad=packed(values.angle_rad),
        force_1=packed(values.force_1),
        force_2=packed(values.force_2),
        probe_1=packed(values.probe_1),
        probe_2=packed(values.probe_2),
    )
