"""Reduce a test file to the facts of its report, one column at a time.

Only one or two columns of the revolutions are in memory at a time, so that a test of 10^7
revolutions needs at most a few hundred megabytes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.report.testreport.envelope import Floats, envelope
from rigapp.schema.channels import BASE, PROBES, Channel, Kind
from rigapp.schema.messages import NOT_STEADY, Flag
from rigapp.schema.rownumbers import RowNumbers
from rigapp.storage import TestReader, largest_force, row_numbers

Line = tuple[Floats, Floats]

SPEED = Channel("speed", "rpm", "speed of the crank")
"""The speed from the encoder, which a report shows like a channel."""

SIZE = "force"

ENDS = 10
"""Number of good revolutions averaged at each end of the test to show the change of a quantity."""


@dataclass(frozen=True, slots=True)
class Peak:
    """An extreme value, its revolution, and that revolution's quality flags.

    lower_bound: the value exceeded the measuring range.
    """

    value: float
    revolution: int
    quality: int
    lower_bound: bool = False

    @property
    def sign(self) -> str:
        """Return the sign before the value."""
        return "≥ " if self.lower_bound else ""


@dataclass(frozen=True, slots=True, eq=False)
class ChannelFacts:
    """Facts of a channel of the file.

    overall: RMS over the whole test, for a slow channel the mean; start, end: its mean at the ends.
    steady: smallest and largest value in revolutions at a steady speed, None without any. lines:
    maximum, minimum and RMS against revolution, for a slow channel its values. age_s: largest age
    of a slow channel's value, NaN for others.
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
        """Return the unit of the values."""
        return self.channel.unit


@dataclass(frozen=True, slots=True)
class Gap:
    """A gap in the data before a revolution.

    missing: number of revolutions not recorded. seconds: duration by the host's clock.
    """

    revolution: int
    missing: int
    lost_samples: int
    seconds: float


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """Statistics of the revolutions. flags: number of revolutions with each flag."""

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
    channels: tuple[ChannelFacts, ...]
    speed: ChannelFacts | None
    gaps: tuple[Gap, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _RowQuality:
    """Numbers and quality flags of the rows; first, last: good rows at each end."""

    number: RowNumbers
    quality: NDArray[np.int32]
    first: NDArray[np.intp]
    last: NDArray[np.intp]


class _Table:
    """Read columns of the rows that were committed when the report was started."""

    def __init__(self, reader: TestReader) -> None:
        self._reader = reader
        self.rows = reader.committed()
        self.units = reader.column_units()

    def column(self, name: str) -> NDArray[Any]:
        """Return the committed rows of a column."""
        return self._reader.column(name, 0, self.rows)

    def __contains__(self, name: str) -> bool:
        return name in self.units


def rows_of(reader: TestReader) -> Rows | None:
    """Return the statistics of the test; None when no revolution is recorded."""
    table = _Table(reader)
    if table.rows == 0:
        return None
    number = row_numbers(reader, "revolutions")
    quality = table.column("quality").astype(np.int32, copy=False)
    good = np.flatnonzero(quality == 0)
    ends = good[:ENDS].copy(), good[-ENDS:].copy()
    rated, all_good = _RowQuality(number, quality, *ends), int(good.size)
    del good
    known = int(sum(Flag))
    channels = tuple(
        _channel(table, channel, rated)
        for channel in reader.plan.table.channels
        if all(name in table for name in _columns(channel))
    )
    channels = tuple(
        _with_trip(channel, reader) if channel.name == SIZE else channel for channel in channels
    )
    return Rows(
        revolutions=table.rows,
        good=all_good,
        first=int(number[0]),
        last=int(number[-1]),
        flags={flag: int(np.count_nonzero(quality & flag)) for flag in Flag if flag},
        unknown_flags=int(np.count_nonzero(quality & ~known)),
        lost_samples=int(table.column("lost_samples").sum()),
        samples_each=float(np.median(table.column("samples"))),
        mean_speed=mean(table.column("speed")),
        test_s=float(reader.column("time", table.rows - 1, table.rows)[0]),
        channels=channels,
        speed=_channel(table, SPEED, rated) if "speed_max" in table else None,
        gaps=_gaps(table, number, quality),
    )


def _with_trip(force: ChannelFacts, reader: TestReader) -> ChannelFacts:
    """Return |F| with the largest value of the test, which may be in a revolution without a row."""
    largest = largest_force(reader)
    if largest is None:
        return force
    in_a_row = largest.revolution == force.largest.revolution
    quality = force.largest.quality if in_a_row else 0 if largest.complete else int(Flag.PARTIAL)
    peak = Peak(largest.value_N, largest.revolution, quality, largest.lower_bound)
    return replace(force, largest=peak)


PART = 1 << 18
"""Number of values processed at once, so that copies of a long column stay small."""


def parts_of(values: NDArray[Any]) -> Iterator[tuple[int, NDArray[Any]]]:
    """Yield a long column in parts (views), each with the index of its first value."""
    for first in range(0, len(values), PART):
        yield first, values[first : first + PART]


def mean(values: NDArray[Any], power: int = 1) -> float:
    """Return the mean of the finite values to a power, NaN without any."""
    count, total = 0, 0.0
    for _, part in parts_of(values):
        finite = part[np.isfinite(part)]
        count, total = count + finite.size, total + float((finite**power).sum())
    return total / count if count else float("nan")


def furthest(values: NDArray[Any], of: Callable[[NDArray[Any]], NDArray[Any]]) -> int | None:
    """Return the index of the finite value with the largest result of ``of``; None without any."""
    result, most = None, -math.inf
    for first, part in parts_of(values):
        finite = np.isfinite(part)
        if finite.any():
            sizes = np.where(finite, of(part), -np.inf)
            index = int(np.argmax(sizes))
            if result is None or sizes[index] > most:
                result, most = first + index, float(sizes[index])
    return result


def span_of(reader: TestReader, name: str) -> tuple[float, float, str] | None:
    """Return the smallest and the largest value of a measured or predicted column, and its unit.

    None for a missing column or one without values.
    """
    if name in reader.column_units():
        values, unit = reader.column(name), reader.column_units()[name]
    elif name in reader.column_units("prediction"):
        values = reader.column(name, stream="prediction")
        unit = reader.column_units("prediction")[name]
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
    """Return the columns of a channel for a report; for a slow one, value and age."""
    if channel.kind is Kind.SLOW:
        return channel.name, f"{channel.name}_age"
    return f"{channel.name}_max", f"{channel.name}_min", f"{channel.name}_rms"


def _channel(table: _Table, channel: Channel, rows: _RowQuality) -> ChannelFacts:
    slow, oldest, names = channel.kind is Kind.SLOW, np.nan, _columns(channel)
    typical = table.column(names[0] if slow else names[2])
    start, end = (mean(typical[ends]) for ends in (rows.first, rows.last))
    line = envelope(rows.number, typical)
    if slow:
        ages = table.column(names[1])
        oldest = float(ages[np.isfinite(ages)].max(initial=0.0))
        largest = smallest = typical
        overall, lines = mean(typical), {"value": line}
    else:
        overall = math.sqrt(mean(typical, 2))
        del typical  # two columns in memory at most
        largest, smallest = (table.column(name) for name in names[:2])
        lines = {
            "max": envelope(rows.number, largest),
            "min": envelope(rows.number, smallest),
            "rms": line,
        }
    return ChannelFacts(
        channel=channel,
        largest=_peak(largest, rows, 1.0),
        smallest=_peak(smallest, rows, -1.0),
        overall=float(overall),
        start=start,
        end=end,
        steady=_steady_range(largest, smallest, rows.quality),
        lines=lines,
        age_s=oldest,
    )


def _steady_range(
    largest: NDArray[Any], smallest: NDArray[Any], quality: NDArray[np.int32]
) -> tuple[float, float] | None:
    low, high = np.inf, -np.inf
    for first, part in parts_of(quality):
        most, least = (column[first : first + len(part)] for column in (largest, smallest))
        steady = (part & int(NOT_STEADY) == 0) & np.isfinite(most) & np.isfinite(least)
        low = float(np.min(least, where=steady, initial=low))
        high = float(np.max(most, where=steady, initial=high))
    return (low, high) if math.isfinite(low) else None


def _peak(values: NDArray[Any], rows: _RowQuality, sign: float) -> Peak:
    row = furthest(values, lambda part: sign * part)
    if row is None:
        return Peak(float("nan"), 0, 0)
    return Peak(float(values[row]), int(rows.number[row]), int(rows.quality[row]))


def gaps_of(reader: TestReader) -> tuple[Gap, ...]:
    """Return the interruptions of a test, without its other statistics."""
    table = _Table(reader)
    if table.rows == 0:
        return ()
    quality = table.column("quality").astype(np.int32, copy=False)
    return _gaps(table, row_numbers(reader, "revolutions"), quality)


def _gaps(table: _Table, number: RowNumbers, quality: NDArray[np.int32]) -> tuple[Gap, ...]:
    flagged = np.flatnonzero(quality & int(Flag.GAP_BEFORE) != 0)
    indices = np.union1d(flagged, number.breaks[1:])
    if not indices.size:
        return ()
    before = np.maximum(indices - 1, 0)
    lost, speed = (table.column(name)[indices] for name in ("lost_samples", "speed"))
    host = table.column("host_time")
    waited = host[indices] - host[before]
    result = []
    for at, row in enumerate(indices.tolist()):
        turn = 60.0 / abs(speed[at]) if speed[at] else 0.0
        seconds = float(waited[at] - turn) if row else float("nan")
        step = int(number[row] - number[row - 1]) if row else 1
        result.append(
            Gap(
                int(number[row]),
                max(0, step - 1),
                int(lost[at]),
                max(0.0, seconds) if np.isfinite(seconds) else float("nan"),
            )
        )
    return tuple(result)


Stated = Mapping[str, float]
"""Channel -> stated expanded uncertainty of one value, in its unit."""


def stated_uncertainties(calibration: Mapping[str, Any]) -> Stated:
    """Return the uncertainties stated in a file for channels other than forces."""
    probes = calibration.get("probes")
    both = probes.get("uncertainty_um") if isinstance(probes, Mapping) else None
    stated: dict[str, Any] = dict(zip(BASE.names_of(PROBES), both or (), strict=False))
    for name, section in calibration.items():
        if name.startswith("channel_") and isinstance(section, Mapping):
            stated[name.removeprefix("channel_")] = section.get("uncertainty")
    return {
        name: float(value)
        for name, value in stated.items()
        if isinstance(value, int | float) and math.isfinite(value)
    }
