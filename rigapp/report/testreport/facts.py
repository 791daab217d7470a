"""Reduce a test file to what a report says of it, one column at a time.

Only a column or two of the revolutions is in memory at once, so that a test of 10^7 revolutions
needs no more than a few hundred megabytes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.report.testreport.envelope import Floats, envelope
from rigapp.schema.channels import Channel, Kind
from rigapp.schema.messages import NOT_STEADY, Flag
from rigapp.storage import TestReader, largest_force

Line = tuple[Floats, Floats]

SPEED = Channel("speed", "rpm", "speed of the crank")
"""The speed, which the encoder gives, as a report treats it: beside the channels."""

SIZE = "force"

ENDS = 10
"""Good revolutions at each end of the test that are averaged to say how a quantity changed."""


@dataclass(frozen=True, slots=True)
class Peak:
    """An extreme value, the revolution it was in, and that revolution's quality flags.

    lower_bound: the value went beyond the measuring range.
    """

    value: float
    revolution: int
    quality: int
    lower_bound: bool = False

    @property
    def sign(self) -> str:
        """Return what stands before the value."""
        return "≥ " if self.lower_bound else ""


@dataclass(frozen=True, slots=True, eq=False)
class ChannelFacts:
    """What a report says of a channel, as the file describes it.

    overall: RMS over the whole test, of a slow channel the mean; start, end: mean of that there.
    steady: smallest and largest value in revolutions at a steady speed, None without any.
    lines: maximum, minimum and RMS against revolution, of a slow channel its values. age_s: the
    oldest value of a slow channel, NaN for others.
    """

    channel: Channel
    largest: Peak
    smallest: Peak
    overall: float
    start: float
    end: float
    steady: tuple[float, float] | None
    lines: Mapping[str, Line]
    age_s: float

    @property
    def name(self) -> str:
        """Return the channel's name in the file."""
        return self.channel.name

    @property
    def unit(self) -> str:
        """Return the unit of its values."""
        return self.channel.unit


@dataclass(frozen=True, slots=True)
class Gap:
    """Data missing before a revolution.

    missing: revolutions not recorded. seconds: without data, by the host's clock.
    """

    revolution: int
    missing: int
    lost_samples: int
    seconds: float


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """What the statistics of the revolutions say. flags: revolutions with each flag."""

    revolutions: int
    good: int
    first: int
    last: int
    flags: Mapping[Flag, int]
    unknown_flags: int
    lost_samples: int
    samples_each: float
    mean_speed: float
    test_s: float
    host_span: tuple[float, float]
    channels: tuple[ChannelFacts, ...]
    speed: ChannelFacts | None
    gaps: tuple[Gap, ...]


class _Table:
    """Read columns of the rows that were safe when the report was begun."""

    def __init__(self, reader: TestReader) -> None:
        self._reader = reader
        self.rows = reader.committed()
        self.units = reader.column_units()

    def column(self, name: str) -> NDArray[Any]:
        """Return the safe rows of a column."""
        return self._reader.column(name, 0, self.rows)

    def __contains__(self, name: str) -> bool:
        return name in self.units


def rows_of(reader: TestReader) -> Rows | None:
    """Return what the statistics say; None when no revolution is recorded."""
    table = _Table(reader)
    if table.rows == 0:
        return None
    number = table.column("revolution").astype(np.int64)
    quality = table.column("quality").astype(np.int64)
    lost = table.column("lost_samples")
    host, time = table.column("host_time"), table.column("time")
    known = int(sum(Flag))
    channels = tuple(
        _channel(table, one, number, quality)
        for one in reader.plan.table.channels
        if all(name in table for name in _columns(one))
    )
    channels = tuple(_with_trip(one, reader) if one.name == SIZE else one for one in channels)
    speed = table.column("speed")
    return Rows(
        revolutions=table.rows,
        good=int(np.count_nonzero(quality == 0)),
        first=int(number[0]),
        last=int(number[-1]),
        flags={flag: int(np.count_nonzero(quality & flag)) for flag in Flag if flag},
        unknown_flags=int(np.count_nonzero(quality & ~known)),
        lost_samples=int(lost.sum()),
        samples_each=float(np.median(table.column("samples"))),
        mean_speed=mean(speed),
        test_s=float(time[-1]),
        host_span=(float(host[0]), float(host[-1])),
        channels=channels,
        speed=_channel(table, SPEED, number, quality) if "speed_max" in table else None,
        gaps=_gaps(number, quality, lost, host, speed),
    )


def _with_trip(force: ChannelFacts, reader: TestReader) -> ChannelFacts:
    """Return |F| with the largest one of the test, which may be of a revolution without a row."""
    found = largest_force(reader)
    if found is None:
        return force
    whole = found.revolution == force.largest.revolution
    quality = force.largest.quality if whole else 0 if found.whole else int(Flag.PARTIAL)
    peak = Peak(found.value_N, found.revolution, quality, found.lower_bound)
    return replace(force, largest=peak)


def mean(values: NDArray[Any]) -> float:
    """Return the mean of the finite values, NaN without any."""
    finite = values[np.isfinite(values)]
    return float(finite.mean()) if finite.size else float("nan")


def span_of(reader: TestReader, name: str) -> tuple[float, float, str] | None:
    """Return the smallest and the largest value of a measured or predicted column, and its unit.

    None when there is no such column or no value in it.
    """
    if name in reader.column_units():
        values, unit = reader.column(name), reader.column_units()[name]
    elif name in reader.column_units("prediction"):
        values, unit = reader.predictions()[name], reader.column_units("prediction")[name]
    else:
        return None
    finite = values[np.isfinite(values)]
    most = largest_force(reader) if name == f"{SIZE}_max" else None
    if most is not None:
        return float(finite.min(initial=most.value_N)), most.value_N, unit
    if not finite.size:
        return None
    return float(finite.min()), float(finite.max()), unit


def _columns(channel: Channel) -> tuple[str, ...]:
    """Return the columns that a report needs of a channel: of a slow one value and age."""
    if channel.kind is Kind.SLOW:
        return channel.name, f"{channel.name}_age"
    return f"{channel.name}_max", f"{channel.name}_min", f"{channel.name}_rms"


def _channel(
    table: _Table, channel: Channel, number: NDArray[np.int64], quality: NDArray[np.int64]
) -> ChannelFacts:
    slow = channel.kind is Kind.SLOW
    if slow:
        largest, age = (table.column(name) for name in _columns(channel))
        smallest = typical = largest
        oldest, overall = age[np.isfinite(age)].max(initial=0.0), mean(largest)
        lines = {"value": envelope(number, largest)}
    else:
        largest, smallest, typical = (table.column(name) for name in _columns(channel))
        oldest, overall = np.nan, np.sqrt(mean(np.square(typical)))
        named = zip(("max", "min", "rms"), (largest, smallest, typical), strict=True)
        lines = {name: envelope(number, values) for name, values in named}
    good = np.flatnonzero(quality == 0)
    return ChannelFacts(
        channel=channel,
        largest=_peak(largest, number, quality, 1.0),
        smallest=_peak(smallest, number, quality, -1.0),
        overall=float(overall),
        start=mean(typical[good[:ENDS]]),
        end=mean(typical[good[-ENDS:]]),
        steady=_steady_range(largest, smallest, quality),
        lines=lines,
        age_s=float(oldest),
    )


def _steady_range(
    largest: NDArray[Any], smallest: NDArray[Any], quality: NDArray[np.int64]
) -> tuple[float, float] | None:
    steady = (quality & NOT_STEADY == 0) & np.isfinite(largest) & np.isfinite(smallest)
    if not steady.any():
        return None
    return float(smallest[steady].min()), float(largest[steady].max())


def _peak(
    values: NDArray[Any], number: NDArray[np.int64], quality: NDArray[np.int64], sign: float
) -> Peak:
    if not np.isfinite(values).any():
        return Peak(float("nan"), 0, 0)
    place = int(np.argmax(np.where(np.isfinite(values), sign * values, -np.inf)))
    return Peak(float(values[place]), int(number[place]), int(quality[place]))


def _gaps(
    number: NDArray[np.int64],
    quality: NDArray[np.int64],
    lost: NDArray[Any],
    host: NDArray[Any],
    speed: NDArray[Any],
) -> tuple[Gap, ...]:
    steps = np.diff(number, prepend=number[0] - 1)
    places = np.flatnonzero((quality & int(Flag.GAP_BEFORE) != 0) | (steps != 1))
    found = []
    for place in places.tolist():
        turn = 60.0 / abs(speed[place]) if speed[place] else 0.0
        seconds = float(host[place] - host[place - 1] - turn) if place else float("nan")
        found.append(
            Gap(
                int(number[place]),
                max(0, int(steps[place]) - 1),
                int(lost[place]),
                max(0.0, seconds) if np.isfinite(seconds) else float("nan"),
            )
        )
    return tuple(found)
