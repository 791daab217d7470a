"""Put revolutions, cycles, predictions and events of one test into its file."""

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
    """Return the columns of a whole cycle for one revolution, (samples,) each, as a file has them.

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
    # Copies of the file's own types: the file then need not copy them again.
    return {
        column.name: columns[column.name].astype(column.dtype) for column in table.cycle_columns
    }


def cycle_message(number: int, measured: Measured) -> Cycle:
    """Return one revolution for drawing."""
    values = measured.calibrated
    return Cycle(
        revolution=number,
        angle_deg=np.degrees(values.angle_rad).astype("<f4").tobytes(),
        curves={name: curve.astype("<f4").tobytes() for name, curve in values.curves.items()},
    )


HOLD_EVERY_S = 0.05
"""A cycle without a trigger is held in the file so often at most: each one up to 1,200 rpm. It
takes half of what a revolution costs, and a simulated rig may make a thousand a second."""

CURVES_WAITING = 256
"""Predictions that wait for their cycle."""


class CurvesBeside:
    """Choose the predicted curves that go beside the kept cycles.

    The twin answers later than the cycle comes, and skips revolutions: to each kept cycle belongs
    the first prediction of its revolution or a later one. Waiting predictions are bounded; of more
    the oldest lose their curves.
    """

    def __init__(self) -> None:
        self._waiting: deque[Prediction] = deque(maxlen=CURVES_WAITING)
        self._kept: deque[int] = deque(maxlen=CURVES_WAITING)
        self._decided = 0

    def predicted(self, prediction: Prediction) -> Iterator[Prediction]:
        """Take a prediction; yield those whose curves are to be written now, in order."""
        self._waiting.append(prediction)
        return self._chosen()

    def kept(self, numbers: Iterable[int], decided: int) -> Iterator[Prediction]:
        """Take the cycles that are kept; no further one up to revolution ``decided`` will be."""
        self._kept.extend(numbers)
        self._decided = decided
        return self._chosen()

    def _chosen(self) -> Iterator[Prediction]:
        while self._waiting and self._waiting[0].revolution <= self._decided:
            prediction = self._waiting.popleft()
            wanted = False
            while self._kept and self._kept[0] <= prediction.revolution:
                self._kept.popleft()
                wanted = True
            if wanted:
                yield prediction


class Recorder:
    """Write one test; rows from the processing thread, the rest from any.

    first: number of the first revolution to come. unfinished: returns the samples of the revolution
    under way. table: the channels that the file keeps, None for those of the rig. After ``close``
    nothing is written any more, and nothing fails.
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
        kept = [index[name] for name in self._table.names]
        self._kept = None if kept == list(range(len(index))) else kept
        self._start_sample: int | None = None
        self._time_offset_s = time_offset_s
        self._first = first
        self._unfinished = unfinished
        self._lock = threading.Lock()
        self._closed = False
        self._waiting_profile: WornProfile | None = None
        self._last: tuple[int, int] | None = None
        self._whole = False
        self._held_s = -math.inf
        self.committed = 0

    def begin(self, sample: int) -> None:
        """Set the device sample at which the test's time starts."""
        self._start_sample = sample

    @property
    def rows(self) -> int:
        """Return the rows in the file, committed or not."""
        return self._store.revolutions

    @property
    def cycles_refused(self) -> int:
        """Return the number of whole cycles that had no space."""
        return self._store.cycles_refused

    @property
    def triggers_refused(self) -> int:
        """Return the number of alarms, limits and notes whose whole cycles had no space."""
        return self._history.refused

    def row(self, number: int, row: Array, measured: Measured) -> None:
        """Write a row, and the whole cycles that are kept."""
        with self._lock:
            if self._closed:
                return
            self._store.append_row(row if self._kept is None else row[self._kept])
            self._last = (number, measured.revolution.ordinal)
            self._whole = number >= self._history.planned
            quality = int(row[measured.calibration.table.place["quality"]])
            leaving = self._history.add(number, measured, quality)
            self._keep(leaving)
            self._hold(number, measured, quality)

    def _hold(self, number: int, measured: Measured, quality: int) -> None:
        """Put a cycle that waits in memory into the file too, for after a crash."""
        waiting, now_s = self._history.waiting(), time.monotonic()
        if waiting is None or (waiting.why is None and now_s < self._held_s + HOLD_EVERY_S):
            return
        self._held_s = now_s
        self._store.hold_cycle(number, self._samples(measured), waiting.why or "", quality)

    def trigger(self, critical: bool) -> None:
        """Store the next complete cycle and its neighbours."""
        with self._lock:
            if not self._closed:
                self._history.trigger(critical)

    def prediction(self, prediction: Prediction) -> Array:
        """Write a prediction and return its values; curves beside the kept cycles only."""
        values = as_array(prediction.values, "<f8")
        with self._lock:
            if not self._closed:
                self._store.append_prediction(values)
                self._write_curves(self._curves.predicted(prediction))
                if prediction.checkpoint:
                    self._store.keep_checkpoint(prediction.revolution, prediction.checkpoint)
                if prediction.profile is not None:
                    self._take_profile(prediction.profile)
        return values

    def _take_profile(self, profile: WornProfile) -> None:
        """Write a profile of the schedule; of the others the newest waits for the end."""
        if not profile.keep:
            self._waiting_profile = profile
            return
        self._waiting_profile = None
        curves = {name: as_array(getattr(profile, name)) for name in PROFILE_CURVES}
        self._store.append_profile(as_array(profile.values, "<f8"), curves)

    def event(self, event: Event) -> bool:
        """Write an event; False when the log has no room for it."""
        with self._lock:
            return self._closed or self._store.append_event(event)

    def gap(self, event: Event) -> None:
        """Write and count an interruption of the data."""
        with self._lock:
            if not self._closed:
                self._store.note_gap(event)

    def place(self) -> None:
        """Put what waits in memory into the file; between commits, so that appending need not."""
        if not self._closed:
            self._store.place()

    def commit(self) -> int:
        """Flush to disk; return the number of saved rows. Rows may be appended meanwhile."""
        if not self._closed:
            self.committed = self._store.commit()
        return self.committed

    @property
    def path(self) -> Path:
        """Return where the file is."""
        return self._store.path

    def watch_path(self, notice: Callable[[str], object]) -> PathReport | None:
        """Restore the file's name when it was deleted, moved or replaced; may take long.

        notice: called before that.
        """
        return None if self._closed else self._store.watch_path(notice)

    def extend(self, revolutions: int) -> None:
        """Make room for another number of revolutions; raise UnusableInput when there is none."""
        with self._lock:
            if not self._closed:
                self._store.extend(revolutions)

    def finish(
        self, status: str, reason_code: str, sentence: str, *, keep_empty: bool = True
    ) -> bool:
        """Write what still waits and the revolution cut off, record how the test ended, and close.

        keep_empty: False deletes a file without a whole revolution. Return whether it is kept.
        """
        with self._lock:
            if not (keep_empty or self._closed or self._store.revolutions):
                self._closed = True
                self._store.discard()
                return False
        cut_off = None if self._closed or self._whole else self._unfinished()
        with self._lock:
            if self._closed:
                return True
            self._keep(self._history.close())
            if cut_off is not None:
                self._keep_unfinished(cut_off)
            if self._waiting_profile is not None:
                self._take_profile(msgspec.structs.replace(self._waiting_profile, keep=True))
            self._closed = True
        try:
            self._store.finish(status, reason_code, sentence)
            self.committed = self._store.revolutions
        finally:
            self._store.close()
        return True

    def abandon(self) -> None:
        """Close the file after the disk refused it; never raises."""
        with self._lock:
            self._closed = True
        try:
            self._store.close()
        except Exception:
            return

    def _samples(self, measured: Measured) -> dict[str, ArrayLike]:
        return cycle_samples(measured, self._table, self._start_sample or 0, self._time_offset_s)

    def _keep(self, leaving: Iterable[RetainedCycle]) -> None:
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

    def _keep_unfinished(self, revolution: Revolution) -> None:
        """Store a revolution that was cut off after the last row, not one before the test."""
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
"""Columns of the temperature that moves the probes: of a slow channel, or of a sampled one."""


def measured_history(
    number: int, measured: Measured, row: Mapping[str, float] = NO_ROW
) -> RevolutionMeasured:
    """Return what the twin needs of one revolution; row: its values by column."""
    values = measured.calibrated
    wanted = {"time_s": values.time_s, "angle_rad": values.angle_rad}
    wanted |= {name: values[name] for name in ("force_1", "force_2", "probe_1", "probe_2")}
    packed = {name: array.astype("<f8").tobytes() for name, array in wanted.items()}
    warm = next((row[name] for name in TEMPERATURE if name in row), math.nan)
    return RevolutionMeasured(revolution=number, **packed, temperature_C=warm)
