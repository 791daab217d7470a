"""Writing of revolutions, cycles, predictions and events of one test to its file."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.engine.recording.history import History, RetainedCycle
from rigapp.engine.recording.store import Store
from rigapp.engine.samples.assembler import Revolution
from rigapp.engine.values.calibrate import Calibration, Measured
from rigapp.schema.channels import ChannelTable
from rigapp.schema.columns import PREDICTED_CURVES, PROFILE_CURVES
from rigapp.schema.messages import (
    Cycle,
    Event,
    PathReport,
    Prediction,
    RevolutionMeasured,
    WornProfile,
    as_array,
)

Array = NDArray[np.float64]

NO_ROW: Mapping[str, float] = MappingProxyType({})


def cycle_samples(
    measured: Measured, table: ChannelTable, start_sample: int, time_offset_s: float
) -> dict[str, ArrayLike]:
    """Return the columns of the complete cycle of a revolution, (samples,) each, as in a file.

    start_sample: device sample at which the test's time was time_offset_s.
    """
    revolution, values = measured.revolution, measured.calibrated
    time = (revolution.sample_indices() - start_sample) / revolution.sample_rate_Hz
    columns: dict[str, Array] = {
        "angle": np.degrees(values.angle_rad),
        "time": time + time_offset_s,
        **values.curves,
        **{f"raw_{name}": signal for name, signal in measured.signals().items()},
    }
    # Copies in the types of the file, which then need no further copy.
    return {
        column.name: columns[column.name].astype(column.dtype) for column in table.cycle_columns
    }


def cycle_message(number: int, measured: Measured) -> Cycle:
    """Return one revolution for display."""
    values = measured.calibrated
    return Cycle(
        revolution=number,
        angle_deg=np.degrees(values.angle_rad).astype("<f4").tobytes(),
        curves={name: curve.astype("<f4").tobytes() for name, curve in values.curves.items()},
    )


RECOVERY_INTERVAL_S = 0.05
"""Least interval of storing a cycle without a trigger for recovery: each one up to 1,200 rpm. It is
half of the cost of a revolution, and a simulated rig may make a thousand per second."""

CURVES_WAITING = 256
"""Largest number of predictions that wait for their cycle."""


class CurvesBeside:
    """Selection of the predicted curves for the stored cycles.

    Predictions are later than cycles, and skip revolutions: the curves for a stored cycle are those
    of the first prediction of its revolution or a later one. The number of waiting predictions is
    bounded; curves of the oldest are dropped.
    """

    def __init__(self) -> None:
        self._waiting: deque[Prediction] = deque(maxlen=CURVES_WAITING)
        self._kept: deque[int] = deque(maxlen=CURVES_WAITING)
        self._decided = 0

    def predicted(self, prediction: Prediction) -> Iterator[Prediction]:
        """Add a prediction; yield those whose curves are to be written now, in order."""
        self._waiting.append(prediction)
        return self._chosen()

    def kept(self, numbers: Iterable[int], decided: int) -> Iterator[Prediction]:
        """Add stored cycles; no further one up to revolution ``decided`` will be stored."""
        self._kept.extend(numbers)
        self._decided = decided
        return self._chosen()

    def _chosen(self) -> Iterator[Prediction]:
        while self._waiting and self._waiting[0].revolution <= self._decided:
            prediction = self._waiting.popleft()
            has_cycle = False
            while self._kept and self._kept[0] <= prediction.revolution:
                self._kept.popleft()
                has_cycle = True
            if has_cycle:
                yield prediction


class Recorder:
    """Recorder of one test; rows from the processing thread, otherwise thread-safe.

    first: number of the next revolution. unfinished: returns the samples of the revolution in
    progress. table: the channels of the file, None for those of the rig. After ``finish`` or
    ``abandon`` all calls are without effect.
    """

    def __init__(
        self,
        store: Store,
        history: History,
        calibration: Calibration,
        time_offset_s: float,
        first: int = 1,
        unfinished: Callable[[], Revolution | None] = lambda: None,
        table: ChannelTable | None = None,
    ) -> None:
        self._store = store
        self._history = history
        self._curves = CurvesBeside()
        self._calibration = calibration
        self._table = table if table is not None else calibration.table
        index = calibration.table.place
        columns = [index[name] for name in self._table.names]
        self._kept = None if columns == list(range(len(index))) else columns
        self._start_sample: int | None = None
        self._time_offset_s = time_offset_s
        self._first = first
        self._unfinished = unfinished
        self._lock = threading.Lock()
        self._closed = False
        self._waiting_profile: WornProfile | None = None
        self._last: tuple[int, int] | None = None
        self._complete = False
        self._recovery_s = -math.inf
        self.committed = 0

    def begin(self, sample: int) -> None:
        """Set the device sample at which the test's time starts."""
        self._start_sample = sample

    @property
    def rows(self) -> int:
        """Return the number of rows in the file, committed or not."""
        return self._store.revolutions

    @property
    def cycles_refused(self) -> int:
        """Return the number of complete cycles that had no space."""
        return self._store.cycles_refused

    @property
    def triggers_refused(self) -> int:
        """Return the number of alarms, limits and notes whose cycles had no space."""
        return self._history.refused

    def row(self, number: int, row: Array, measured: Measured) -> None:
        """Write a row, and the cycles to store."""
        with self._lock:
            if self._closed:
                return
            self._store.append_row(row if self._kept is None else row[self._kept])
            self._last = (number, measured.revolution.ordinal)
            self._complete = number >= self._history.planned
            quality = int(row[measured.calibration.table.place["quality"]])
            leaving = self._history.add(number, measured, quality)
            self._write_cycles(leaving)
            self._store_for_recovery(number, measured, quality)

    def _store_for_recovery(self, number: int, measured: Measured, quality: int) -> None:
        """Write a cycle that waits in memory to the file, for recovery after a crash."""
        waiting, now_s = self._history.waiting(), time.monotonic()
        if waiting is None or (
            waiting.why is None and now_s < self._recovery_s + RECOVERY_INTERVAL_S
        ):
            return
        self._recovery_s = now_s
        self._store.hold_cycle(number, self._samples(measured), waiting.why or "", quality)

    def trigger(self, critical: bool) -> None:
        """Store the next complete cycle and those around it."""
        with self._lock:
            if not self._closed:
                self._history.trigger(critical)

    def prediction(self, prediction: Prediction) -> Array:
        """Write a prediction and return its values; curves for stored cycles only."""
        values = as_array(prediction.values, "<f8")
        with self._lock:
            if not self._closed:
                self._store.append_prediction(values)
                self._write_curves(self._curves.predicted(prediction))
                if prediction.checkpoint:
                    self._store.keep_checkpoint(prediction.revolution, prediction.checkpoint)
                if prediction.profile is not None:
                    self._write_profile(prediction.profile)
        return values

    def _write_profile(self, profile: WornProfile) -> None:
        """Write a scheduled profile; the latest of the others is written at the end."""
        if not profile.keep:
            self._waiting_profile = profile
            return
        self._waiting_profile = None
        curves = {name: as_array(getattr(profile, name)) for name in PROFILE_CURVES}
        self._store.append_profile(as_array(profile.values, "<f8"), curves)

    def event(self, event: Event) -> bool:
        """Write an event; return False if the log is full."""
        with self._lock:
            return self._closed or self._store.append_event(event)

    def gap(self, event: Event) -> None:
        """Write and count an interruption of the data."""
        with self._lock:
            if not self._closed:
                self._store.note_gap(event)

    def place(self) -> None:
        """Write queued data to the file between commits, so that appending does not have to."""
        if not self._closed:
            self._store.place()

    def commit(self) -> int:
        """Commit all data; return the number of committed rows. Does not block appending."""
        if not self._closed:
            self.committed = self._store.commit()
        return self.committed

    @property
    def path(self) -> Path:
        """Return the path of the file."""
        return self._store.path

    def watch_path(self, notice: Callable[[str], object]) -> PathReport | None:
        """Restore the path of the file if it was deleted, moved or replaced; may take long.

        notice: called before.
        """
        return None if self._closed else self._store.watch_path(notice)

    def extend(self, revolutions: int) -> None:
        """Reserve space for a number of revolutions; raise UnusableInput without space."""
        with self._lock:
            if not self._closed:
                self._store.extend(revolutions)

    def finish(
        self, status: str, reason_code: str, sentence: str, *, keep_empty: bool = True
    ) -> bool:
        """Write queued data, the unfinished revolution and the end of the test, and close.

        keep_empty: False deletes a file without a complete revolution. Returns whether it exists.
        """
        with self._lock:
            if not (keep_empty or self._closed or self._store.revolutions):
                self._closed = True
                self._store.discard()
                return False
        unfinished = None if self._closed or self._complete else self._unfinished()
        with self._lock:
            if self._closed:
                return True
            self._write_cycles(self._history.close())
            if unfinished is not None:
                self._write_unfinished(unfinished)
            if self._waiting_profile is not None:
                self._write_profile(msgspec.structs.replace(self._waiting_profile, keep=True))
            self._closed = True
        try:
            self._store.finish(status, reason_code, sentence)
            self.committed = self._store.revolutions
        finally:
            self._store.close()
        return True

    def abandon(self) -> None:
        """Close the file after a write error; never raises."""
        with self._lock:
            self._closed = True
        try:
            self._store.close()
        except Exception:
            return

    def _samples(self, measured: Measured) -> dict[str, ArrayLike]:
        return cycle_samples(measured, self._table, self._start_sample or 0, self._time_offset_s)

    def _write_cycles(self, leaving: Iterable[RetainedCycle]) -> None:
        numbers: list[int] = []
        for cycle in leaving:
            assert cycle.why is not None
            columns = self._samples(cycle.measured)
            if self._store.append_cycle(cycle.number, columns, cycle.why.value, cycle.quality):
                numbers.append(cycle.number)
        self._write_curves(self._curves.kept(numbers, self._history.decided))

    def _write_curves(self, predictions: Iterable[Prediction]) -> None:
        for prediction in predictions:
            curves = {name: as_array(getattr(prediction, name)) for name in PREDICTED_CURVES}
            self._store.append_curves(prediction.revolution, curves)

    def _write_unfinished(self, revolution: Revolution) -> None:
        """Write an unfinished revolution after the last row, unless it began before the test."""
        if self._start_sample is None or revolution.first_sample < self._start_sample:
            return
        number, ordinal = self._last or (self._first - 1, revolution.ordinal - 1)
        if revolution.ordinal <= ordinal or revolution.samples == 0:
            return
        samples = self._samples(Measured(revolution, self._calibration))
        self._store.append_unfinished(
            number + revolution.ordinal - ordinal, samples, int(revolution.flags)
        )


TEMPERATURE = ("room_temperature", "room_temperature_mean")
"""Columns of the temperature that affects the probes: of a slow channel, or of a sampled one."""


def measured_history(
    number: int, measured: Measured, row: Mapping[str, float] = NO_ROW
) -> RevolutionMeasured:
    """Return the input of the twin for one revolution; row: its values by column."""
    values = measured.calibrated
    arrays = {"time_s": values.time_s, "angle_rad": values.angle_rad}
    arrays |= {name: values[name] for name in ("force_1", "force_2", "probe_1", "probe_2")}
    packed = {name: array.astype("<f8").tobytes() for name, array in arrays.items()}
    warm = next((row[name] for name in TEMPERATURE if name in row), math.nan)
    return RevolutionMeasured(revolution=number, **packed, temperature_C=warm)
