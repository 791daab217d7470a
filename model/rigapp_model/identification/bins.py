"""Readings of the depth averaged in bins of revolutions, about 12 per decade.

A bin's mean is robust: it averages groups of up to eight readings without the two largest and the
two smallest of each; a bin has at least one group. The scatter is that of the groups about a
straight line over progress, so that wear within a bin does not count as scatter. The cost per
reading is constant.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple, dataclass, field, fields
from math import isfinite, nan
from typing import Any

import numpy as np

from rigapp_model.errors import require_positive

PER_DECADE = 12
"""Bins per decade: in a bin the depth grows by a fifth, with a curvature of 4e-4 of the depth."""
LEAST_APART = 1e-9
"""Least deviation of the temperature from a straight line that is used: fraction of its squares."""
GROUP = 8
"""Readings per group: two of eight may be faulty; the efficiency of its mean is 0.9."""


@dataclass(frozen=True, slots=True)
class Bin:
    """A closed bin.

    revolution: its last; first, progress, last: measured progress at its beginning, its mean and at
    its end, nominal cycles; depth: robust mean, m; count: of readings; squares: of the groups about
    their straight line, times readings, m^2; freedom: degrees of freedom of squares; steps: squares
    of differences of neighbouring groups, less their mean, times readings, NaN if unknown; warm:
    mean temperature, degC, whose effect is then removed from squares as well; None if unknown.
    """

    revolution: float
    first: float
    progress: float
    last: float
    depth: float
    count: int
    squares: float
    freedom: int
    steps: float = float("nan")
    warm: float | None = None


@dataclass(slots=True)
class Gathering:
    """Sums of the readings of an open bin, of constant size.

    sums: over groups, of n, p, d, p^2, p d, d^2, T, T^2, p T, d T with progress, depth and
    temperature relative to the first reading; warmed: whether all temperatures are known.
    begun, latest: depths of the first and the last group; moved: sum of their squared steps, m^2.
    """

    origin: tuple[float, ...] = (0.0, 0.0, 0.0)
    sums: list[float] = field(default_factory=lambda: [0.0] * 10)
    groups: int = 0
    first: float = 0.0
    last: float = 0.0
    revolution: float = 0.0
    waiting: list[tuple[float, ...]] = field(default_factory=list)
    begun: float = 0.0
    latest: float = 0.0
    moved: float = 0.0
    warmed: bool = True

    def add(self, revolution: float, progress: float, depth: float, warm: float) -> None:
        """Add a reading."""
        if not isfinite(warm):
            self.warmed, warm = False, 0.0
        if not (self.groups or self.waiting):
            self.origin, self.first = (progress, depth, warm), progress
        self.revolution, self.last = revolution, progress
        self.waiting.append((progress, depth, warm))
        if len(self.waiting) == GROUP:
            self._group()

    def _group(self) -> None:
        if not self.waiting:
            return
        p = sum(reading[0] for reading in self.waiting) / len(self.waiting) - self.origin[0]
        d = trimmed([reading[1] for reading in self.waiting]) - self.origin[1]
        t = sum(reading[2] for reading in self.waiting) / len(self.waiting) - self.origin[2]
        n = float(len(self.waiting))
        if self.groups:
            self.moved += GROUP * (d - self.latest) ** 2
        else:
            self.begun = d
        self.latest = d
        for index, value in enumerate((1.0, p, d, p * p, p * d, d * d, t, t * t, p * t, d * t)):
            self.sums[index] += n * value
        self.groups += 1
        self.waiting = []

    def numbers(self) -> dict[str, Any]:
        """Return the state as plain numbers, for a checkpoint."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**values, "sums": list(self.sums), "waiting": list(self.waiting)}

    def closed(self) -> Bin | None:
        """Return the closed bin, None without readings."""
        if len(self.waiting) >= GROUP // 2 or not self.groups:
            self._group()
        if not self.groups:
            return None
        n, p, d, pp, pd, dd, t, tt, pt, dt = self.sums
        progress_squares, progress_depth = pp - p * p / n, pd - p * d / n
        residual = (
            dd
            - d * d / n
            - (progress_depth**2 / progress_squares if progress_squares > 0.0 else 0.0)
        )
        freedom = max(self.groups - 2, 0)
        if self.warmed and progress_squares > 0.0:
            progress_temperature = pt - p * t / n
            temperature_residual = tt - t * t / n - progress_temperature**2 / progress_squares
            if freedom > 1 and temperature_residual > LEAST_APART * tt:
                residual -= (
                    dt - d * t / n - progress_depth * progress_temperature / progress_squares
                ) ** 2 / temperature_residual
                freedom -= 1
        steps = self.moved - GROUP * (self.latest - self.begun) ** 2 / max(self.groups - 1, 1)
        return Bin(
            self.revolution,
            self.first,
            self.origin[0] + p / n,
            self.last,
            self.origin[1] + d / n,
            int(n),
            max(residual, 0.0) if freedom else 0.0,
            freedom,
            max(steps, 0.0) if freedom else 0.0,
            self.origin[2] + t / n if self.warmed else None,
        )


def trimmed(values: list[float]) -> float:
    """Return the mean without the largest and the smallest quarter."""
    cut = len(values) // 4
    kept = sorted(values)[cut : len(values) - cut]
    return sum(kept) / len(kept)


@dataclass(slots=True)
class Bins:
    """Closed bins and the open one, filled reading by reading."""

    per_decade: float = PER_DECADE
    closed: list[Bin] = field(default_factory=list)
    _open: Gathering = field(default_factory=Gathering)
    _ends: float = 0.0

    def __post_init__(self) -> None:
        require_positive("per_decade", self.per_decade)

    def add(
        self, revolution: float, progress: float, depth: float, warm: float = nan
    ) -> Bin | None:
        """Add a reading; return the bin that it closed, or None.

        revolution: number, increasing; progress: until then, nominal cycles; depth: measured, m;
        warm: temperature, degC, NaN if unknown. Skips a depth that is not finite.
        """
        if not np.isfinite(depth):
            return None
        done = None
        if revolution > self._ends:
            done = self._close()
            self._ends = self._end_of(revolution)
        self._open.add(revolution, progress, depth, warm)
        return done

    def _close(self) -> Bin | None:
        done = self._open.closed()
        self._open = Gathering()
        if done is not None:
            self.closed.append(done)
        return done

    def _end_of(self, revolution: float) -> float:
        """Return the last revolution of the bin that contains this one."""
        number = np.floor(self.per_decade * np.log10(max(revolution, 1.0)) + 1e-9)
        end = float(np.floor(10.0 ** ((number + 1.0) / self.per_decade) - 1e-9))
        return max(end, revolution + GROUP - 1.0)

    def numbers(self) -> dict[str, Any]:
        """Return the state as plain numbers, for a checkpoint."""
        return {
            "per_decade": self.per_decade,
            "closed": [list(astuple(each)) for each in self.closed],
            "open": self._open.numbers(),
            "ends": self._ends,
        }


def bins_of(numbers: Mapping[str, Any]) -> Bins:
    """Restore bins from their ``numbers``."""
    is_open = dict(numbers["open"])
    is_open["origin"] = tuple(is_open["origin"])
    is_open["waiting"] = [tuple(reading) for reading in is_open["waiting"]]
    is_open["sums"] = list(is_open["sums"])
    missing = len(Gathering().sums) - len(is_open["sums"])
    if missing:  # of a version without temperature
        is_open["origin"] = (*is_open["origin"], 0.0)
        is_open["waiting"] = [(*reading, 0.0) for reading in is_open["waiting"]]
        is_open["sums"] += [0.0] * missing
        is_open["warmed"] = False
    closed = [Bin(*row) for row in numbers["closed"]]
    return Bins(numbers["per_decade"], closed, Gathering(**is_open), numbers["ends"])
