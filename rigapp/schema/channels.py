"""The channels of a rig in one ordered table: quantity, source, stored statistics.

Everything that lists channels derives from the table: the columns of a row and of a whole cycle,
limits, the screen, reports and exports. Every rig has ``BASE``: a load cell with two axes, the size
of its force, a pair of probes. Channels of ``[channels.NAME]`` in a rig file follow, so
that the columns of ``BASE`` keep their indices; the slow channels come last.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

STATISTICS = ("max", "min", "rms", "mean", "angle_of_max")
"""Statistics of a sampled channel in a row, as columns ``NAME_max`` and so on."""

_SENTENCES = {
    "max": "maximum",
    "min": "minimum",
    "rms": "root mean square",
    "mean": "mean",
    "angle_of_max": "crank angle of the maximum of",
}

AVERAGES = ("mean", "rms", "max")
"""Statistics of a slow channel in a row, besides the newest value: of its readings in the
revolution."""

LOAD_CELL = "load_cell"
PROBES = "probes"


@dataclass(frozen=True, slots=True)
class Column:
    """Describe one 1-D dataset: name, numpy dtype, unit, one sentence."""

    name: str
    dtype: str
    unit: str
    description: str


class Kind(enum.StrEnum):
    """Origin of a channel's values.

    SAMPLED: from an input of the data source, simultaneous with the encoder. DERIVED: calculated
    from sampled ones. SLOW: polled from a device, one value a revolution with its age.
    """

    SAMPLED = "sampled"
    DERIVED = "derived"
    SLOW = "slow"


@dataclass(frozen=True, slots=True)
class Channel:
    """Describe one channel.

    description: what it is, in words. instrument: ``LOAD_CELL``, ``PROBES``, or empty for a free
    one. frame: in which its direction is fixed, empty without one. device: name in the rig file.
    input: of the data source, or the quantity of a slow device. signal_unit: of the
    input. signal_range: its largest magnitude, in that unit. latency_s: delay against the encoder.
    averaged: for a slow one, ``AVERAGES`` are stored; older files have the newest value only.
    """

    name: str
    unit: str
    description: str
    kind: Kind = Kind.SAMPLED
    instrument: str = ""
    frame: str = ""
    device: str = ""
    input: str = ""
    signal_unit: str = "V"
    signal_range: float = 0.0
    latency_s: float = 0.0
    averaged: bool = False

    @property
    def columns(self) -> tuple[Column, ...]:
        """Return its columns in a row, in storage order."""
        if self.kind is Kind.SLOW:
            return (
                Column(self.name, "<f8", self.unit, f"newest {self.description}"),
                Column(f"{self.name}_age", "<f8", "s", f"age of {self.name} at the end of it"),
                *(self._averages() if self.averaged else ()),
            )
        return tuple(
            Column(
                f"{self.name}_{statistic}",
                "<f8",
                "deg" if statistic == "angle_of_max" else self.unit,
                f"{_SENTENCES[statistic]} {self.name} over the revolution",
            )
            for statistic in STATISTICS
        )

    def _averages(self) -> Iterable[Column]:
        for statistic in AVERAGES:
            sentence = f"{_SENTENCES[statistic]} {self.name} by its readings in the revolution"
            yield Column(f"{self.name}_{statistic}", "<f8", self.unit, sentence)
        sentence = f"readings of {self.name} in the revolution"
        yield Column(f"{self.name}_readings", "<i4", "1", sentence)


_HEAD = (
    Column("revolution", "<i8", "1", "number of the revolution since the start of the test"),
    Column("time", "<f8", "s", "end of the revolution, device time since the start of the test"),
    Column("host_time", "<f8", "s", "end of the revolution, UTC seconds since 1970-01-01"),
    Column("speed", "<f8", "rpm", "mean speed of the crank"),
    Column("speed_max", "<f8", "rpm", "maximum speed of the crank"),
    Column("speed_min", "<f8", "rpm", "minimum speed of the crank"),
    Column("speed_rms", "<f8", "rpm", "RMS speed of the crank"),
    Column("samples", "<i4", "1", "samples in the revolution"),
    Column("lost_samples", "<i4", "1", "samples lost in or just before the revolution"),
    Column("quality", "<i4", "1", "0 good, else flags, see rigapp.schema.messages.Flag"),
)


@dataclass(frozen=True)
class ChannelTable:
    """The channels of a rig, or of a file, in their one order."""

    channels: tuple[Channel, ...]

    @cached_property
    def _by_name(self) -> dict[str, Channel]:
        return {channel.name: channel for channel in self.channels}

    def __getitem__(self, name: str) -> Channel:
        """Return a channel by name; raise KeyError."""
        return self._by_name[name]

    def __contains__(self, name: object) -> bool:
        """Return whether there is a channel of that name."""
        return name in self._by_name

    @cached_property
    def sampled(self) -> tuple[Channel, ...]:
        """Return the channels with an input of the data source."""
        return self._of(Kind.SAMPLED)

    @cached_property
    def curves(self) -> tuple[Channel, ...]:
        """Return the channels with a value at each sample, derived ones included."""
        return self._of(Kind.SAMPLED, Kind.DERIVED)

    @cached_property
    def slow(self) -> tuple[Channel, ...]:
        """Return the channels with one value a revolution."""
        return self._of(Kind.SLOW)

    @cached_property
    def free(self) -> tuple[Channel, ...]:
        """Return the channels that belong to no instrument, slow ones included."""
        return tuple(channel for channel in self.channels if not channel.instrument)

    def names_of(self, instrument: str) -> tuple[str, ...]:
        """Return the names of an instrument's own inputs."""
        return tuple(channel.name for channel in self.sampled if channel.instrument == instrument)

    @cached_property
    def revolution_columns(self) -> tuple[Column, ...]:
        """Return the columns of ``/entry/revolutions``, in storage order."""
        return (*_HEAD, *(column for channel in self.channels for column in channel.columns))

    @cached_property
    def cycle_columns(self) -> tuple[Column, ...]:
        """Return the per-sample columns of ``/entry/cycles``, in storage order."""
        base = [curve for curve in self.curves if curve.instrument]
        free = [curve for curve in self.curves if not curve.instrument]
        return (
            Column("angle", "<f4", "deg", "crank angle of the sample, latency corrected"),
            Column("time", "<f8", "s", "device time of the sample since the start of the test"),
            *map(_calibrated, base),
            *(_raw(channel) for channel in base if channel.kind is Kind.SAMPLED),
            Column("raw_count", "<f4", "count", "signal of count as the device sent it"),
            *(column for channel in free for column in (_calibrated(channel), _raw(channel))),
        )

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Return the names of a row's values."""
        return tuple(column.name for column in self.revolution_columns)

    @cached_property
    def units(self) -> dict[str, str]:
        """Return name -> unit of a row's values, in their order."""
        return {column.name: column.unit for column in self.revolution_columns}

    @cached_property
    def place(self) -> dict[str, int]:
        """Return name -> index of a row's values."""
        return {name: index for index, name in enumerate(self.names)}

    def _of(self, *kinds: Kind) -> tuple[Channel, ...]:
        return tuple(channel for channel in self.channels if channel.kind in kinds)


def _calibrated(channel: Channel) -> Column:
    return Column(channel.name, "<f4", channel.unit, f"calibrated {channel.name}")


def _raw(channel: Channel) -> Column:
    sentence = f"signal of {channel.name} as the device sent it"
    return Column(f"raw_{channel.name}", "<f4", channel.signal_unit, sentence)


def _force(axis: int, direction: str) -> Channel:
    sentence = f"force on the follower by the crank pin, {direction}"
    return Channel(
        f"force_{axis}", "N", sentence, instrument=LOAD_CELL, frame="crank", signal_unit="mV/V"
    )


def _probe(axis: int, direction: str) -> Channel:
    sentence = f"position of the pin, {direction}"
    return Channel(f"probe_{axis}", "um", sentence, instrument=PROBES, frame="follower")


BASE = ChannelTable(
    (
        _force(1, "along the crank (e1)"),
        _force(2, "across the crank (n1)"),
        Channel("force", "N", "size of the force", Kind.DERIVED, LOAD_CELL),
        _probe(1, "along the follower (e2)"),
        _probe(2, "across the follower (n2)"),
    )
)
"""Channels of every rig; its rig file adds devices, inputs and ranges."""


def taken_names(channels: Iterable[Channel]) -> set[str]:
    """Return the names used by the columns of channels in rows and in whole cycles."""
    table = ChannelTable(tuple(channels))
    return {column.name for column in (*table.revolution_columns, *table.cycle_columns)}
