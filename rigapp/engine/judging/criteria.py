"""What ends a test before its last revolution: the criteria of ``[stop]``, judged per revolution.

Only judged revolutions count: whole ones at the set speed. A revolution without a value (NaN, no
answer of the twin) is left out: it fulfils nothing and interrupts nothing. A criterion that has had
no value for ``BLIND_REVOLUTIONS`` judged revolutions is *blind*, which the caller tells loudly.

Elapsed time is the column ``time``, with pauses and interruptions; running time is the time in
which the crank turned. Wear depth and wear rate are judged where the twin answers, by the number
that goes into the file and onto the screen: the column ``measured_wear_depth``.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from rigapp.config.recipe import StopSection
from rigapp.schema.columns import revolution_columns
from rigapp.schema.messages import Flag

Array = NDArray[np.float64]

BLIND_REVOLUTIONS = 200
RATE_BINS = 50
"""The wear rate is the slope through the means of so many equal parts of the window."""

NOT_JUDGED = Flag.RAMP | Flag.PAUSED | Flag.PARTIAL

PLACE = {column.name: place for place, column in enumerate(revolution_columns())}
_REVOLUTION, _TIME, _SPEED = PLACE["revolution"], PLACE["time"], PLACE["speed"]
_FORCE, _QUALITY = PLACE["force_max"], PLACE["quality"]

TITLES = {
    "elapsed_time_h": "elapsed time",
    "running_time_h": "running time",
    "wear_depth_um": "wear depth",
    "force_N": "force",
    "wear_rate_um_per_1000_revolutions": "wear rate",
    "deviation_N": "deviation from the model",
    "deviation_percent": "deviation from the model",
}
"""Key of a criterion -> its name in words."""

HISTORY_COLUMNS = ("revolution", "speed", "quality")
"""What a criterion needs to know of the rows of an earlier segment."""

DEPTH_COLUMNS = ("revolution", "measured_wear_depth")
"""What a criterion needs to know of the predictions of an earlier segment."""

NOTHING = np.empty((2, 0))


@dataclass(frozen=True, slots=True)
class Met:
    """Say that a criterion is met. planned: an end as planned (complete), else a limit."""

    name: str
    sentence: str
    planned: bool


@dataclass(slots=True)
class _Streak:
    """A level to be reached in so many judged revolutions in a row."""

    key: str
    level: float
    needed: int
    planned: bool
    words: Callable[[float, float, int], str]
    beyond: int = 0
    since_value: int = 0

    def look(self, value: float) -> Met | None:
        self.since_value = 0
        if value < self.level:
            self.beyond = 0
            return None
        self.beyond += 1
        if self.beyond < self.needed:
            return None
        return Met(self.key, self.words(value, self.level, self.needed), self.planned)


class _Rate:
    """The slope of the wear depth over a window of revolutions, by least squares over bins."""

    def __init__(self, window: int) -> None:
        self._width = max(1, window // RATE_BINS)
        self._needed = max(3, window // self._width)
        self._bins: deque[tuple[float, float]] = deque(maxlen=self._needed)
        self._window = window
        self._bin = -1
        self._sum = np.zeros(3)

    def add(self, number: int, depth_um: float) -> float | None:
        """Add a revolution; return the rate (um per 1000 revolutions) when a new one is known."""
        found = None
        place = number // self._width
        if place != self._bin:
            if self._sum[0] > 0:
                self._bins.append((self._sum[1] / self._sum[0], self._sum[2] / self._sum[0]))
                found = self._slope(number)
            self._bin, self._sum = place, np.zeros(3)
        self._sum += (1.0, number, depth_um)
        return found

    def _slope(self, number: int) -> float | None:
        """Return the slope when the window is filled for at least half, from end to end."""
        points = [point for point in self._bins if point[0] > number - self._window - self._width]
        if len(points) < max(3, self._needed // 2):
            return None
        x, y = np.array(points).T
        if x[-1] - x[0] < 0.8 * (self._window - 2 * self._width):
            return None
        x = x - x.mean()
        return float(1000.0 * (x @ (y - y.mean())) / (x @ x))


class StopMonitor:
    """Judge revolutions by ``[stop]``; rows and predictions each come from one thread."""

    def __init__(self, stop: StopSection) -> None:
        self._stop = stop
        self._rate = _Rate(stop.wear_rate_window_revolutions)
        self._last = 0
        self.running_h = 0.0
        self._unjudged: deque[int] = deque(maxlen=1024)
        self._streaks = {one.key: one for one in _streaks(stop)}

    @property
    def any(self) -> bool:
        """Tell whether anything beside the number of revolutions ends the test."""
        return any(value is not None for value in _levels(self._stop).values())

    def remember(self, rows: Iterable[Array], last: int, depths: Array = NOTHING) -> None:
        """Take up an earlier segment: its rows, (len(HISTORY_COLUMNS), n) each, in order.

        last: number of the last of them; depths: (len(DEPTH_COLUMNS), n), mm. What must come in a
        row begins afresh.
        """
        left_out: set[int] = set()
        for number, speed, quality in rows:
            steps = np.diff(number, prepend=self._last)
            with np.errstate(divide="ignore", invalid="ignore"):
                hours = steps / (60.0 * speed)
            self.running_h += float(hours[np.isfinite(hours) & (hours > 0)].sum())
            if len(number):
                self._last = int(number[-1])
            left_out.update(number[(quality.astype(np.int64) & NOT_JUDGED) != 0].astype(int))
        recent = last - 2 * self._stop.wear_rate_window_revolutions
        for one, depth in depths[:, (depths[0] > recent) & (depths[0] <= last)].T.tolist():
            if int(one) not in left_out and math.isfinite(depth):
                self._rate.add(int(one), 1e3 * depth)

    def row(self, row: Array) -> Met | None:
        """Judge a row in the order of ``revolution_columns``; return the criterion that it met."""
        number, quality = int(row[_REVOLUTION]), int(row[_QUALITY])
        self._run(number, float(row[_SPEED]))
        met = self._times(float(row[_TIME]))
        if met is not None:
            return met
        if quality & NOT_JUDGED or number <= self._stop.hold_off_revolutions:
            self._unjudged.append(number)
            return None
        for streak in self._streaks.values():
            streak.since_value += 1
        return self._first({"force_N": float(row[_FORCE])})

    def prediction(self, number: int, values: Mapping[str, float]) -> Met | None:
        """Judge the twin's answer: its columns by name, see ``prediction_columns``."""
        if number in self._unjudged or number <= self._stop.hold_off_revolutions:
            return None
        residual_N, force_N = values["residual_rms"], values["force_rms"]
        depth_um = 1e3 * values["measured_wear_depth"]
        found: dict[str, float | None] = {
            "deviation_N": residual_N,
            "deviation_percent": 100.0 * residual_N / force_N if force_N > 0 else math.nan,
            "wear_depth_um": depth_um,
        }
        if math.isfinite(depth_um):
            found["wear_rate_um_per_1000_revolutions"] = self._rate.add(number, depth_um)
        met = self._first(found)
        doubt_um = 1e3 * values["measured_wear_depth_uncertainty"]
        if met is None or met.name != "wear_depth_um" or not math.isfinite(doubt_um):
            return met
        return replace(met, sentence=f"{met.sentence[:-1]}, +/- {doubt_um:.2g} um (k = 2).")

    def over(self, time_s: float) -> Met | None:
        """Return the planned end that a test has reached at this time of its own, if any."""
        return self._times(time_s)

    def blind(self) -> list[str]:
        """Return the criteria that have had no value for too long."""
        return [
            one.key
            for one in self._streaks.values()
            if one.since_value >= max(BLIND_REVOLUTIONS, self._patience(one.key))
        ]

    def _patience(self, key: str) -> int:
        if key != "wear_rate_um_per_1000_revolutions":
            return 0
        return self._stop.wear_rate_window_revolutions + BLIND_REVOLUTIONS

    def _first(self, values: dict[str, float | None]) -> Met | None:
        found: Met | None = None
        for key, value in values.items():
            streak = self._streaks.get(key)
            if streak is None or value is None or math.isnan(value):
                continue
            found = found or streak.look(value)
        return found

    def _run(self, number: int, speed_rpm: float) -> None:
        if math.isfinite(speed_rpm) and speed_rpm > 0:
            self.running_h += max(0, number - self._last) / (60.0 * speed_rpm)
        self._last = number

    def _times(self, time_s: float) -> Met | None:
        stop = self._stop
        hours = time_s / 3600.0
        if stop.elapsed_time_h is not None and hours >= stop.elapsed_time_h:
            text = (
                f"The test has lasted {hours:.4g} h; it was planned for {stop.elapsed_time_h:g} h."
            )
            return Met("elapsed_time_h", text, planned=True)
        if stop.running_time_h is not None and self.running_h >= stop.running_time_h:
            text = (
                f"The crank has turned for {self.running_h:.4g} h; {stop.running_time_h:g} h were"
                " planned."
            )
            return Met("running_time_h", text, planned=True)
        return None


def described(stop: StopSection) -> list[str]:
    """Return the criteria that are set, in words, for a check or a report."""
    units = {"h": "h", "um": "um", "N": "N", "percent": "%"}
    found = []
    for name, level in _levels(stop).items():
        if level is None:
            continue
        if name == "wear_rate_um_per_1000_revolutions":
            found.append(f"wear rate {level:g} um per 1000 revolutions")
            continue
        words, _, unit = name.rpartition("_")
        found.append(f"{words.replace('_', ' ')} {level:g} {units[unit]}")
    return found


def _levels(stop: StopSection) -> dict[str, float | None]:
    return {
        "elapsed_time_h": stop.elapsed_time_h,
        "running_time_h": stop.running_time_h,
        "wear_depth_um": stop.wear_depth_um,
        "force_N": stop.force_N,
        "wear_rate_um_per_1000_revolutions": stop.wear_rate_um_per_1000_revolutions,
        "deviation_N": stop.deviation_N,
        "deviation_percent": stop.deviation_percent,
    }


def _row_words(what: str, unit: str) -> Callable[[float, float, int], str]:
    def words(value: float, level: float, needed: int) -> str:
        times = f"in {needed} revolutions in a row" if needed > 1 else "in one revolution"
        return (
            f"{what} was at or above {level:g} {unit} {times}, {value:.4g} {unit} in the last one."
        )

    return words


def _streaks(stop: StopSection) -> Iterator[_Streak]:
    if stop.wear_depth_um is not None:
        yield _Streak(
            "wear_depth_um",
            stop.wear_depth_um,
            stop.wear_depth_revolutions,
            True,
            _row_words("The measured wear depth", "um"),
        )
    if stop.force_N is not None:
        words = _row_words("The maximum of |F|", "N")
        yield _Streak("force_N", stop.force_N, stop.force_revolutions, False, words)
    if stop.wear_rate_um_per_1000_revolutions is not None:
        window = stop.wear_rate_window_revolutions

        def rate(value: float, level: float, needed: int) -> str:
            return (
                f"The wear rate over {window} revolutions was {value:.4g} um per 1000 revolutions;"
                f" the limit is {level:g}."
            )

        yield _Streak(
            "wear_rate_um_per_1000_revolutions",
            stop.wear_rate_um_per_1000_revolutions,
            1,
            False,
            rate,
        )
    for key, unit in (("deviation_N", "N"), ("deviation_percent", "% of the predicted RMS")):
        level = getattr(stop, key)
        if level is not None:
            words = _row_words("The RMS of measured less predicted |F|", unit)
            yield _Streak(key, level, stop.deviation_revolutions, False, words)
