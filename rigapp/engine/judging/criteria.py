"""Stop criteria of ``[stop]``, evaluated per revolution.

Evaluated revolutions are the complete ones at the set speed. A revolution without a value (NaN, no
prediction by the twin) is skipped: it neither fulfils nor interrupts. A criterion without a value
for ``NO_DATA_REVOLUTIONS`` evaluated revolutions has *no data*, which raises an alarm.

Elapsed time is the column ``time``, including pauses and interruptions; running time is the time
in which the crank turned. Wear depth and wear rate are evaluated with the twin's prediction, by the
value that is stored and displayed: the column ``measured_wear_depth``.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.config.ranges import unit_of
from rigapp.config.recipe import StopSection
from rigapp.config.rules import levels
from rigapp.schema.channels import BASE
from rigapp.schema.criteria import CRITERIA, At, Criterion, Sight
from rigapp.schema.messages import NOT_STEADY

Array = NDArray[np.float64]

NO_DATA_REVOLUTIONS = 200  # some minutes at usual speeds: a failed sensor, not a short dropout
RATE_BINS = 50
"""Bins of the window; the wear rate is the slope through their means."""

LEAST_BINS = 3
"""Fewest means of a slope; with fewer its scatter is unknown."""

FILLED_SHARE = 0.8
"""Least distance from the first to the last mean, relative to the window."""

MOST_UNEVALUATED = 1024
"""Stored revolutions without evaluation, for later predictions; a twin this late is reported
elsewhere."""

HISTORY_COLUMNS = ("revolution", "speed", "quality")
"""Columns of the rows of earlier runs that criteria need."""

DEPTH_COLUMNS = ("revolution", "measured_wear_depth")
"""Columns of the predictions of earlier runs that criteria need."""

NOTHING = np.empty((2, 0))


@dataclass(frozen=True, slots=True)
class CriterionMet:
    """A met criterion. planned: a planned end (complete), else a limit."""

    name: str
    sentence: str
    planned: bool


class _Rate:
    """Slope of the wear depth over a window of revolutions, by least squares over bins."""

    def __init__(self, window: int) -> None:
        self._width = max(1, window // RATE_BINS)
        self._needed = max(LEAST_BINS, window // self._width)
        self._bins: deque[tuple[float, float]] = deque(maxlen=self._needed)
        self._window = window
        self._bin = -1
        self._sum = np.zeros(3)

    def add(self, number: int, depth_um: float) -> float | None:
        """Add a revolution; return a new rate (um per 1000 revolutions) at the end of a bin."""
        result = None
        bin_index = number // self._width
        if bin_index != self._bin:
            if self._sum[0] > 0:
                self._bins.append((self._sum[1] / self._sum[0], self._sum[2] / self._sum[0]))
                result = self._slope(number)
            self._bin, self._sum = bin_index, np.zeros(3)
        self._sum += (1.0, number, depth_um)
        return result

    def _slope(self, number: int) -> float | None:
        """Return the slope if at least half of the bins are filled, from end to end."""
        points = [point for point in self._bins if point[0] > number - self._window - self._width]
        if len(points) < max(LEAST_BINS, self._needed // 2):
            return None
        x, y = np.array(points).T
        if x[-1] - x[0] < FILLED_SHARE * (self._window - 2 * self._width):
            return None
        x = x - x.mean()
        return float(1000.0 * (x @ (y - y.mean())) / (x @ x))


class _Watched:
    """A set criterion, with its level and the consecutive evaluated revolutions that meet it."""

    def __init__(self, criterion: Criterion, level: float, stop: StopSection) -> None:
        self.criterion = criterion
        self.rate: _Rate | None = None
        self.patience = NO_DATA_REVOLUTIONS
        self._level = level
        self._needed = self._number = getattr(stop, criterion.count) if criterion.count else 1
        if criterion.window:
            self._number = getattr(stop, criterion.window)
            self.rate = _Rate(self._number)
            self.patience += self._number
        self._beyond = 0
        self.since_value = 0
        self.left_percent = math.nan

    def look(self, number: int, at: At) -> CriterionMet | None:
        """Evaluate a revolution's value; an unknown one neither fulfils nor interrupts."""
        criterion = self.criterion
        value: float | None = criterion.value(at)
        # Infinity on the far side of the level is a known value: without wear the test never ends.
        endless = math.inf if criterion.falls else -math.inf
        if value is None or not (math.isfinite(value) or value == endless):
            return None
        if self.rate is not None:
            value = self.rate.add(number, value)
            if value is None:
                return None
        self.since_value = 0
        met = value <= self._level if criterion.falls else value >= self._level
        left = value - self._level if criterion.falls else self._level - value
        self.left_percent = 100.0 * left / max(abs(self._level), 1e-12)
        self._beyond = self._beyond + 1 if met else 0
        if not self._beyond or self._beyond < self._needed:
            return None
        sentence = criterion.sentence(value, self._level, self._number)
        doubt = criterion.doubt(at) if criterion.doubt is not None else math.nan
        if math.isfinite(doubt):
            sentence = (
                f"{sentence[:-1]}, +/- {doubt:.2g} {unit_of('stop.' + criterion.key)} (k = 2)."
            )
        return CriterionMet(criterion.key, sentence, criterion.planned)


class StopMonitor:
    """Evaluation of revolutions by ``[stop]``; one thread each for rows and predictions."""

    def __init__(self, stop: StopSection) -> None:
        self._stop = stop
        self._last = 0
        self.running_h = 0.0
        self._not_evaluated: deque[int] = deque(maxlen=MOST_UNEVALUATED)
        watched = [_Watched(CRITERIA[key], level, stop) for key, level in levels(stop).items()]
        self._by_sight = {
            sight: [w for w in watched if w.criterion.sight is sight] for sight in Sight
        }
        self._evaluated = self._by_sight[Sight.ROW] + self._by_sight[Sight.PREDICTION]
        self._rates = [w.rate for w in watched if w.rate is not None]

    @property
    def any(self) -> bool:
        """Return whether any criterion besides the number of revolutions is set."""
        return any(self._by_sight.values())

    def recent(self, last: int) -> int:
        """Return the revolution after which depths of earlier runs are used."""
        return last - 2 * self._stop.wear_rate_window_revolutions

    def remember(self, rows: Iterable[Array], last: int, depths: Array = NOTHING) -> None:
        """Add earlier runs: their rows, (len(HISTORY_COLUMNS), n) each, in order.

        last: their last revolution; depths: (len(DEPTH_COLUMNS), n), mm. Counts of consecutive
        revolutions restart.
        """
        recent = self.recent(last)
        left_out: set[int] = set()
        for number, speed, quality in rows:
            steps = np.diff(number, prepend=self._last)
            with np.errstate(divide="ignore", invalid="ignore"):
                hours = steps / (60.0 * speed)
            self.running_h += float(hours[np.isfinite(hours) & (hours > 0)].sum())
            if len(number):
                self._last = int(number[-1])
            unsteady = (quality.astype(np.int64) & NOT_STEADY) != 0
            left_out.update(number[unsteady & (number > recent)].astype(int))
        for revolution, depth in depths[:, (depths[0] > recent) & (depths[0] <= last)].T.tolist():
            if int(revolution) not in left_out and math.isfinite(depth):
                for rate in self._rates:
                    rate.add(int(revolution), 1e3 * depth)

    def row(self, row: Array) -> CriterionMet | None:
        """Evaluate a row in the order of ``ChannelTable.names``; return a met criterion."""

        def at(name: str) -> float:
            return float(row[BASE.place[name]])

        number = int(at("revolution"))
        self._run(number, at("speed"))
        met = self.over(at("time"))
        if met is not None:
            return met
        if int(at("quality")) & NOT_STEADY or number <= self._stop.hold_off_revolutions:
            self._not_evaluated.append(number)
            return None
        for evaluated in self._evaluated:
            evaluated.since_value += 1
        return self._first(Sight.ROW, number, at)

    def is_evaluated(self, number: int) -> bool:
        """Return whether a revolution is evaluated: complete and at the set speed."""
        return number not in self._not_evaluated and number > self._stop.hold_off_revolutions

    def prediction(self, number: int, values: Mapping[str, float]) -> CriterionMet | None:
        """Evaluate a prediction: its columns by name, see ``prediction_columns``."""
        if not self.is_evaluated(number):
            return None
        return self._first(Sight.PREDICTION, number, values.__getitem__)

    def over(self, time_s: float) -> CriterionMet | None:
        """Return the planned end at this time of the test, if any."""
        clocks = {"time": time_s, "running_time": self.running_h}
        return self._first(Sight.CLOCK, self._last, clocks.__getitem__)

    def of_depth(self) -> list[str]:
        """Return the set criteria that depend on the measured wear depth."""
        return [w.criterion.key for w in self._evaluated if w.criterion.of_depth]

    def no_data(self) -> list[str]:
        """Return the criteria without a value for too long."""
        return [w.criterion.key for w in self._evaluated if w.since_value >= w.patience]

    def nearest(self) -> tuple[float, str]:
        """Return the distance to the nearest criterion, in percent of its level, and its title.

        Infinity and an empty title before the first value.
        """
        known = [
            (watched.left_percent, watched.criterion.title)
            for seen in self._by_sight.values()
            for watched in seen
            if math.isfinite(watched.left_percent)
        ]
        return min(known, default=(math.inf, ""))

    def _first(self, sight: Sight, number: int, at: At) -> CriterionMet | None:
        result: CriterionMet | None = None
        for watched in self._by_sight[sight]:
            met = watched.look(number, at)
            result = result or met
        return result

    def _run(self, number: int, speed_rpm: float) -> None:
        if math.isfinite(speed_rpm) and speed_rpm > 0:
            self.running_h += max(0, number - self._last) / (60.0 * speed_rpm)
        self._last = number
