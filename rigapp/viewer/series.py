"""The data of one test on the screen: statistics of every revolution, predictions, newest cycle."""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.channels import BASE
from rigapp.schema.columns import (
    PREDICTED_CURVES,
    PROFILE_ANGLES_DEG,
    PROFILE_CURVES,
    prediction_columns,
)
from rigapp.schema.deviations import deviation_columns, deviation_sentence
from rigapp.schema.messages import Cycle, Prediction, Snapshot, WornProfile, as_array
from rigapp.schema.rownumbers import RowNumbers
from rigapp.viewer.channels import SIZE, table_of
from rigapp.viewer.pyramid import KEPT, Pyramid

Floats = NDArray[np.float64]

ANGLES_DEG = np.asarray(PROFILE_ANGLES_DEG, dtype=np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class ShownProfile:
    """A worn profile, mm at ANGLES_DEG; NaN where nothing is known."""

    revolution: int
    measured: Floats
    predicted: Floats
    driven: Floats
    uncertainty: Floats

    @property
    def deepest(self) -> float:
        """Return the largest depth of all curves, 0 when there is none."""
        curves = np.concatenate([self.measured + self.uncertainty, self.predicted, self.driven])
        finite = curves[np.isfinite(curves)]
        return max(float(finite.max(initial=0.0)), 0.0)


def shown_profile(message: WornProfile) -> ShownProfile:
    """Unpack a message."""
    curves = {name: as_array(getattr(message, name)).astype(np.float64) for name in PROFILE_CURVES}
    return ShownProfile(message.revolution, **curves)


KEPT_CYCLES = 8
"""Newest whole cycles kept, so that a late prediction still finds its own cycle."""

UNFOLLOWED_SHARE = 0.05
"""Of the predicted maximum: a smaller uncertainty by the speed is not reported."""

PREDICTED = tuple(column.name for column in prediction_columns())
NOT_DRAWN = ("revolution", "samples", "lost_samples")


Wanted = tuple[tuple[str, ...], tuple[str, ...]]
"""Names of columns of rows and of predictions."""
Loaded = tuple[dict[str, Pyramid], dict[str, Pyramid]]
"""Series of rows and of predictions by name."""


class SeriesTable:
    """Columns that grow together, each with its levels of detail, against ``revolution``."""

    def __init__(self, columns: tuple[str, ...], capacity: int = 1 << 16, kept: int = KEPT) -> None:
        self._columns = columns
        self._kept = kept
        self._x = RowNumbers()
        self._series = {name: Pyramid(capacity, kept) for name in columns if name not in NOT_DRAWN}

    def __len__(self) -> int:
        return len(self._x)

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names of the series that can be drawn."""
        return tuple(self._series)

    @property
    def revolutions(self) -> RowNumbers:
        """Return the revolution number of every row."""
        return self._x

    def series(self, name: str) -> Pyramid:
        """Return one series; raise KeyError for an unknown name."""
        return self._series[name]

    def set_columns(self, columns: Sequence[str]) -> None:
        """Set the columns of rows from now on; a new column is NaN before."""
        if tuple(columns) == self._columns:
            return
        self._columns = tuple(columns)
        for name in self._columns:
            if name not in self._series and name not in NOT_DRAWN:
                self._series[name] = Pyramid(len(self._x) + 1, self._kept)
                self._series[name].extend(np.full(len(self._x), np.nan, dtype=np.float32))

    def extend(self, rows: Floats) -> None:
        """Append rows (n, columns) in column order; rows not newer than the last are left out."""
        if len(rows) == 0:
            return
        revolutions = rows[:, self._columns.index("revolution")]
        if len(self._x):
            fresh = revolutions > self._x[-1]
            if not fresh.all():
                rows, revolutions = rows[fresh], revolutions[fresh]
        self._x.extend(revolutions)
        for index, name in enumerate(self._columns):
            if name in self._series:
                self._series[name].extend(rows[:, index])

    def load(self, columns: Mapping[str, NDArray[np.generic]]) -> None:
        """Append rows column by column, as a file holds them; a missing one is unknown (NaN)."""
        self.set_columns((*self._columns, *(name for name in columns if name not in self._columns)))
        revolutions = np.asarray(columns["revolution"], dtype=np.float64)
        self._x.extend(revolutions)
        for name, series in self._series.items():
            values = columns.get(name)
            series.extend(
                np.full(len(revolutions), np.nan, dtype=np.float32)
                if values is None
                else np.asarray(values, dtype=np.float32)
            )

    def settle(self) -> None:
        """Build every level of detail now, so that drawing does not wait for it."""
        for series in self._series.values():
            series.settle()

    def at(self, name: str, row: int) -> float:
        """Return the value of a row, NaN where it is not known; raise KeyError for a column."""
        result = self.newest(name, 1, row + 1)
        return float(result[-1]) if len(result) else float("nan")

    def newest(self, name: str, count: int, stop: int | None = None) -> NDArray[np.floating]:
        """Return the last ``count`` values of a series, or fewer, of rows before ``stop``."""
        end = len(self) if stop is None else min(stop, len(self))
        return self._series[name].rows(end - count, end)

    def last(self, name: str) -> float:
        """Return the newest value of a series, NaN when there is none."""
        return self.at(name, len(self) - 1)


@dataclass(frozen=True, slots=True)
class MeasuredCycle:
    """One whole revolution as measured: equally long float32 arrays, crank frame."""

    revolution: int
    angle_deg: NDArray[np.float32]
    channels: Mapping[str, NDArray[np.float32]]


@dataclass(frozen=True, slots=True)
class PredictedCycle:
    """One predicted revolution on equally spaced crank angles from 0 deg on, crank frame."""

    revolution: int
    angle_deg: Floats
    curves: Mapping[str, NDArray[np.float32]]

    def at(self, angle_deg: NDArray[np.floating], curve: str) -> Floats:
        """Return the predicted curve at crank angles (periodic linear interpolation)."""
        # Closed by its first point: numpy's own period sorts all the angles at every call.
        values = self.curves[curve]
        turn = angle_deg if _within_turn(angle_deg) else np.mod(angle_deg, 360.0)
        closed = np.append(self.angle_deg, 360.0), np.append(values, values[:1])
        return np.asarray(np.interp(turn, *closed), dtype=np.float64)


def _within_turn(angle_deg: NDArray[np.floating]) -> bool:
    return len(angle_deg) == 0 or bool(angle_deg.min() >= 0.0 and angle_deg.max() <= 360.0)


def measured_cycle(message: Cycle) -> MeasuredCycle:
    """Unpack a cycle message (views, no copy)."""
    curves = {name: as_array(curve) for name, curve in message.curves.items()}
    return MeasuredCycle(message.revolution, as_array(message.angle_deg), curves)


def predicted_cycle(message: Prediction) -> PredictedCycle:
    """Unpack a prediction message (views, no copy)."""
    sent = {name: getattr(message, name) for name in PREDICTED_CURVES}
    curves = {name: as_array(curve) for name, curve in sent.items() if curve}
    points = len(curves[SIZE])
    return PredictedCycle(
        message.revolution, 360.0 / max(points, 1) * np.arange(points, dtype=np.float64), curves
    )


@dataclass(frozen=True, slots=True)
class Doubt:
    """The uncertainty of a predicted force.

    uncertainty_N: the largest expanded one (k = 2) of the revolution, NaN when unknown; unfollowed:
    the speed changed faster than the prediction can follow. deviation: cause of a deviation beyond
    the tolerances, empty without one.
    """

    uncertainty_N: float = math.nan
    unfollowed: bool = False
    deviation: str = ""


class LiveData:
    """Collect snapshots as the data of the panels, which only read."""

    def __init__(self, planned: int = 0, kept: int = KEPT) -> None:
        capacity = max(1 << 16, planned + 1024)
        self.channels = BASE
        self.rows = SeriesTable(BASE.names, capacity, kept)
        self.predictions = SeriesTable(PREDICTED, capacity, kept)
        self.loaded = 0
        self.cycle: MeasuredCycle | None = None
        self.prediction: PredictedCycle | None = None
        self.profile: ShownProfile | None = None
        self.missing_from: int | None = None
        self._cycles: OrderedDict[int, MeasuredCycle] = OrderedDict()
        self._next_row: int | None = None
        self._row_names: tuple[str, ...] = BASE.names

    def take(self, snapshot: Snapshot) -> None:
        """Take a snapshot.

        ``missing_from`` becomes the number of the first missing row when rows are
        missing between the last snapshot and this one; the file has them.
        """
        rows = _matrix(snapshot.rows, len(snapshot.columns))
        self.set_columns(snapshot.columns)
        if len(rows):
            expected = self._next_row if self._next_row is not None else 0
            if snapshot.first_row > expected and self.missing_from is None:
                self.missing_from = expected
            self._next_row = max(expected, snapshot.first_row + len(rows))
            self.rows.extend(rows)
        if snapshot.recorded is not None:
            self.show(snapshot.recorded)
        self.predictions.extend(_matrix(snapshot.predictions, len(prediction_columns())))
        if snapshot.cycle is not None:
            self.cycle = measured_cycle(snapshot.cycle)
            self._cycles[self.cycle.revolution] = self.cycle
            while len(self._cycles) > KEPT_CYCLES:
                self._cycles.popitem(last=False)
        if snapshot.prediction is not None:
            self.prediction = predicted_cycle(snapshot.prediction)
        if snapshot.profile is not None:
            self.profile = shown_profile(snapshot.profile)

    def show(self, count: int) -> None:
        """Show the first ``count`` rows of a recorded test; live data ignores it."""

    def forget_newest(self) -> None:
        """Drop the newest curves: a replay continues from an earlier row."""
        self.cycle, self.prediction, self.profile = None, None, None
        self._cycles.clear()

    def wanted(self) -> Wanted | None:
        """Return the columns of rows and predictions that have still to be read from a file."""
        return None

    def read(self, names: Wanted) -> Loaded:
        """Return whole columns of rows and predictions; for a worker thread."""
        return {}, {}

    def put(self, made: Loaded) -> None:
        """Take columns that have been read."""

    def close(self) -> None:
        """Close the file, where the data come from one."""

    def expect(self, committed: int) -> None:
        """Set the number of rows in the file: rows that were never sent are missing too."""
        if committed > len(self.rows) and self.missing_from is None:
            self.missing_from = len(self.rows)

    def set_columns(self, units: Mapping[str, str]) -> None:
        """Set the columns of a row: name -> unit, in its order."""
        if tuple(units) != self._row_names:
            self._row_names = tuple(units)
            self.channels = table_of(units)
            self.rows.set_columns(self._row_names)

    def load_rows(
        self,
        columns: Mapping[str, NDArray[np.generic]],
        units: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        """Take the rows of a file and their units; the next live row is the one after them."""
        self.set_columns(BASE.units | dict(units))
        self.rows.load(columns)
        self._next_row = len(self.rows)

    def doubt(self, revolution: int) -> Doubt:
        """Return the uncertainty of the predicted force of a revolution."""
        row = self.predictions.revolutions.searchsorted(revolution)
        if row == len(self.predictions) or self.predictions.revolutions[row] != revolution:
            return Doubt()
        sure, unfollowed, most, *differs = (
            self.predictions.at(name, row)
            for name in (
                "force_uncertainty",
                "unfollowed_acceleration",
                f"{SIZE}_max",
                *(column.name for column in deviation_columns()),
            )
        )
        sentence = deviation_sentence(*differs)
        return Doubt(sure, unfollowed > 0.0 and sure > UNFOLLOWED_SHARE * most, sentence)

    def partner(self, prediction: PredictedCycle) -> MeasuredCycle | None:
        """Return the measured cycle of a prediction while it is still kept."""
        return self._cycles.get(prediction.revolution)


def _matrix(data: bytes, columns: int) -> Floats:
    values = np.frombuffer(data, dtype="<f8")
    return values.reshape(-1, columns)
