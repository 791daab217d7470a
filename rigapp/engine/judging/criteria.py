"""What ends a test before its last revolution: the criteria of ``[stop]``, judged per revolution.

Only judged revolutions count: whole ones at the set speed. A revolution without a value (NaN, no
answer of the twin) is left out: it fulfils nothing and interrupts nothing. A criterion that has had
no value for ``NO_DATA_REVOLUTIONS`` judged revolutions has *no data*, which raises an alarm.

Elapsed time is the column ``time``, with pauses and interruptions; running time is the time in
which the crank turned. Wear depth and wear rate are judged where the twin answers, by the number
that goes into the file and onto the screen: the column ``measured_wear_depth``.
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

NO_DATA_REVOLUTIONS = 200  # some minutes at usual speeds: a sensor that fails, not a hiccup
RATE_BINS = 50
"""Number of equal parts of the window; the wear rate is the slope through their means."""

LEAST_BINS = 3
"""The scatter of a slope through fewer means cannot be seen."""

FILLED_SHARE = 0.8
"""Of the window, from its first to its last mean: a slope over less is not that of the window."""

MOST_UNJUDGED = 1024
"""Revolutions whose prediction is awaited; a twin so far behind is reported elsewhere."""

HISTORY_COLUMNS = ("revolution", "speed", "quality")
"""Columns that a criterion needs of the rows of an earlier segment."""

DEPTH_COLUMNS = ("revolution", "measured_wear_depth")
"""Columns that a criterion needs of the predictions of an earlier segment."""

NOTHING = np.empty((2, 0))


@dataclass(frozen=True, slots=True)
class CriterionMet:
    """A criterion that is met. planned: an end as planned (complete), else a limit."""

    name: str
    sentence: str
    planned: bool


class _Rate:
    """The slope of the wear depth over a window of revolutions, by least squares over bins."""

    def __init__(self, window: int) -> None:
        self._width = max(1, window // RATE_BINS)
        self._needed = max(LEAST_BINS, window // self._width)
        self._bins: deque[tuple[float, float]] = deque(maxlen=self._needed)
        self._window = window
        self._bin = -1
        self._sum = np.zeros(3)

    def add(self, number: int, depth_um: float) -> float | None:
        """Add a revolution; return the rate (um per 1000 revolutions) when a new one is known."""
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
        """Return the slope when the window is filled for at least half, from end to end."""
        points = [point for point in self._bins if point[0] > number - self._window - self._width]
        if len(points) < max(LEAST_BINS, self._needed // 2):
            return None
        x, y = np.array(points).T
        if x[-1] - x[0] < FILLED_SHARE * (self._window - 2 * self._width):
            return None
        x = x - x.mean()
        return float(1000.0 * (x @ (y - y.mean())) / (x @ x))


class _Watched:
    """A criterion in use: its level, and how many evaluated revolutions in a row must meet it."""

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
        # One that is infinite far from the level is known: nothing wears, so nothing ends it.
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
    """Evaluate revolutions by ``[stop]``; rows and predictions each come from one thread."""

    def __init__(self, stop: StopSection) -> None:
        self._stop = stop
        self._last = 0
        self.running_h = 0.0
        self._not_evaluated: deque[int] = deque(maxlen=MOST_UNJUDGED)
        watched = [_Watched(CRITERIA[key], level, stop) for key, level in levels(stop).items()]
        self._seen = {sight: [w for w in watched if w.criterion.sight is sight] for sight in Sight}
        self._evaluated = self._seen[Sight.ROW] + self._seen[Sight.PREDICTION]
        self._rates = [w.rate for w in watched if w.rate is not None]

    @property
    def any(self) -> bool:
        """Return whether anything beside the number of revolutions ends the test."""
        return any(self._seen.values())

    def recent(self, last: int) -> int:
        """Return the revolution after which depths of an earlier segment still count."""
        return last - 2 * self._stop.wear_rate_window_revolutions

    def remember(self, rows: Iterable[Array], last: int, depths: Array = NOTHING) -> None:
        """Add an earlier segment: its rows, (len(HISTORY_COLUMNS), n) each, in order.

        last: number of the last of them; depths: (len(DEPTH_COLUMNS), n), mm. What must come in a
        row begins afresh.
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
        """Evaluate a row, ordered as ``ChannelTable.names``; return the criterion that it met."""

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

    def judges(self, number: int) -> bool:
        """Return whether the prediction of a revolution counts: whole and at the set speed."""
        return number not in self._not_evaluated and number > self._stop.hold_off_revolutions

    def prediction(self, number: int, values: Mapping[str, float]) -> CriterionMet | None:
        """Evaluate the twin's answer: its columns by name, see ``prediction_columns``."""
        if not self.judges(number):
            return None
        return self._first(Sight.PREDICTION, number, values.__getitem__)

    def over(self, time_s: float) -> CriterionMet | None:
        """Return the planned end that a test has reached at this time of the test, if any."""
        clocks = {"time": time_s, "running_time": self.running_h}
        return self._first(Sight.CLOCK, self._last, clocks.__getitem__)

    def of_depth(self) -> list[str]:
        """Return the criteria that are set and follow from the measured wear depth."""
        return [w.criterion.key for w in self._evaluated if w.criterion.of_depth]

    def no_data(self) -> list[str]:
        """Return the criteria that have had no value for too long."""
        return [w.criterion.key for w in self._evaluated if w.since_value >= w.patience]

    def nearest(self) -> tuple[float, str]:
        """Return how far before the nearest criterion it is, in percent of it, and its title.

        Infinite and unnamed while nothing is known of any.
        """
        known = [
            (watched.left_percent, watched.criterion.title)
            for seen in self._seen.values()
            for watched in seen
            if math.isfinite(watched.left_percent)
        ]
        return min(known, default=(math.inf, ""))

    def _first(self, sight: Sight, number: int, at: At) -> CriterionMet | None:
        result: CriterionMet | None = None
        for watched in self._seen[sight]:
            met = watched.look(number, at)
            result = result or met
        return result

    def _run(self, number: int, speed_rpm: float) -> None:
        if math.isfinite(speed_rpm) and speed_rpm > 0:
            self.running_h += max(0, number - self._last) / (60.0 * speed_rpm)
        self._last = number
