"""Readings of the depth gathered in bins of revolutions, about 12 to a decade.

A bin's mean is robust: readings are averaged in groups of up to eight whose two largest and two
smallest are left out, and a bin has one group at least. The scatter is that of the groups about a
straight line over progress, so that wear within a bin does not count as scatter. Each reading costs
the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple, dataclass, field, fields
from math import isfinite, nan
from typing import Any

import numpy as np

from rigapp_model.errors import require_positive

PER_DECADE = 12
"""Bins a decade: in one of them the depth grows by a fifth, its curve by 4e-4 of the depth."""
LEAST_APART = 1e-9
"""The part of a temperature beside a straight line counts from this share of its squares on."""
GROUP = 8
"""Readings of a group: two in eight may be wrong without harm; its mean is 0.9 as efficient."""


@dataclass(frozen=True, slots=True)
class Bin:
    """A closed bin.

    revolution: last one in it; first, progress, last: measured progress at its beginning, its mean
    and at its end, nominal cycles; depth: robust mean, m; count: readings; squares: of the groups
    about their straight line, times readings, m^2 (``freedom`` of them independent); steps: squares
    of differences of neighbouring groups, less their mean, times readings, NaN where not known;
    warm: mean temperature, degC, None where not known: else its effect is removed from squares,
    too.
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
    """Gather readings until the bin is closed, in a fixed number of numbers.

    Sums over groups: n, p, d, p^2, p d, d^2, T, T^2, p T, d T with progress, depth and temperature
    less those of the first reading; warmed: whether the temperature of all is known.
    begun, latest: depths of the first and the last group; moved: squares of their steps, m^2.
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
        """Take one reading."""
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
        for at, value in enumerate((1.0, p, d, p * p, p * d, d * d, t, t * t, p * t, d * t)):
            self.sums[at] += n * value
        self.groups += 1
        self.waiting = []

    def numbers(self) -> dict[str, Any]:
        """Return the state as plain numbers, for a checkpoint."""
        kept = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**kept, "sums": list(self.sums), "waiting": list(self.waiting)}

    def closed(self) -> Bin | None:
        """Return the bin, None when there is no reading in it."""
        if len(self.waiting) >= GROUP // 2 or not self.groups:
            self._group()
        if not self.groups:
            return None
        n, p, d, pp, pd, dd, t, tt, pt, dt = self.sums
        along, across = pp - p * p / n, pd - p * d / n
        left = dd - d * d / n - (across**2 / along if along > 0.0 else 0.0)
        freedom = max(self.groups - 2, 0)
        if self.warmed and along > 0.0:
            beside = pt - p * t / n
            apart = tt - t * t / n - beside**2 / along
            if freedom > 1 and apart > LEAST_APART * tt:
                left -= (dt - d * t / n - across * beside / along) ** 2 / apart
                freedom -= 1
        steps = self.moved - GROUP * (self.latest - self.begun) ** 2 / max(self.groups - 1, 1)
        return Bin(
            self.revolution,
            self.first,
            self.origin[0] + p / n,
            self.last,
            self.origin[1] + d / n,
            int(n),
            max(left, 0.0) if freedom else 0.0,
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
    """Take readings one by one, and keep closed bins and the one that is being filled."""

    per_decade: float = PER_DECADE
    closed: list[Bin] = field(default_factory=list)
    _open: Gathering = field(default_factory=Gathering)
    _ends: float = 0.0

    def __post_init__(self) -> None:
        require_positive("per_decade", self.per_decade)

    def add(
        self, revolution: float, progress: float, depth: float, warm: float = nan
    ) -> Bin | None:
        """Take one reading; return the bin that it closed, None when none.

        revolution: its number, rising; progress: by then, nominal cycles; depth: measured, m; warm:
        temperature, degC, NaN where there is none. A depth that is not finite is left out.
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
        """Return the last revolution of the bin in which one lies."""
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
    """Return the bins of a state from ``numbers``."""
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
