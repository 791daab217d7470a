"""The channel table of a rig file, and the faults of its ``[channels.NAME]``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import pairwise

from rigapp.config.ranges import unit_of
from rigapp.config.rig import ChannelSection, RigFile
from rigapp.config.rules import NAME
from rigapp.schema.channels import BASE, Channel, ChannelTable, Kind, taken_names
from rigapp.schema.columns import prediction_columns
from rigapp.texts import joined, say

LONGEST_NAME = 40
"""Maximum length of a channel's name, for which its columns are readable as headings."""

RESERVED = frozenset(
    {"revolution", "first", "count", "quality", "why", "committed", "deviation", "crank_angle"}
)
"""Reserved names: used by files and screens in addition to the columns."""

_OF_INPUT = (
    "device",
    "input",
    "scale",
    "offset_V",
    "table",
    "range_V",
    "latency_ms",
    "uncertainty",
    "calibration",
    "calibration_override",
)
"""Keys that do not apply to a channel with a ``source``."""


def channel_table(rig: RigFile) -> ChannelTable:
    """Return the channels of a rig in order: ``BASE``, free sampled ones, slow ones."""
    cell, probes = rig.load_cell, rig.probes
    wired: dict[str, Channel] = {"force": BASE["force"]}
    for axis in (1, 2):
        wired[f"force_{axis}"] = replace(
            BASE[f"force_{axis}"],
            device=cell.device,
            input=getattr(cell, f"input_{axis}"),
            signal_range=cell.range_mV_per_V,
            latency_s=1e-3 * cell.latency_ms[axis - 1],
        )
        wired[f"probe_{axis}"] = replace(
            BASE[f"probe_{axis}"],
            device=probes.device,
            input=getattr(probes, f"input_{axis}"),
            signal_range=probes.range_V,
            latency_s=1e-3 * probes.latency_ms[axis - 1],
        )
    base = tuple(wired[channel.name] for channel in BASE.channels)
    free = [_channel(name, section) for name, section in rig.channels.items()]
    return ChannelTable((*base, *sorted(free, key=lambda channel: channel.kind is Kind.SLOW)))


def _channel(name: str, section: ChannelSection) -> Channel:
    words = name.replace("_", " ")
    if not section.source:
        return Channel(
            name,
            section.unit,
            words,
            device=section.device,
            input=section.input,
            signal_range=section.range_V,
            latency_s=1e-3 * section.latency_ms,
        )
    device, quantity = section.slow_source
    unit = unit_of(f"_{quantity}")
    sentence = say("{}, {} of {}", words, quantity, device)
    return Channel(
        name,
        section.unit or unit,
        sentence,
        Kind.SLOW,
        device=device,
        input=quantity,
        signal_unit=unit,
        averaged=True,
    )


def input_keys(rig: RigFile) -> dict[str, str]:
    """Return key -> name of every input of the data source named in a rig file."""
    result = {
        "encoder.input": rig.encoder.input,
        "load_cell.input_1": rig.load_cell.input_1,
        "load_cell.input_2": rig.load_cell.input_2,
        "probes.input_1": rig.probes.input_1,
        "probes.input_2": rig.probes.input_2,
    }
    for name, section in rig.channels.items():
        if not section.source:
            result[f"channels.{name}.input"] = section.input
    return result


def channel_faults(rig: RigFile) -> Iterator[str]:
    """Yield the faults of the free channels, each with its key."""
    known = {column.name for column in prediction_columns()} | RESERVED
    taken = dict.fromkeys(known | taken_names(BASE.channels), say("has it already"))
    taken |= dict.fromkeys(
        (channel.name for channel in BASE.channels), say("is a channel of every rig")
    )
    for name, section in rig.channels.items():
        key = f"channels.{name}"
        wrong = _of_name(name, key, section, taken)
        yield from [wrong] if wrong else _of_section(rig, key, section)
        taken |= dict.fromkeys(
            (name, *taken_names([_channel(name, section)])), say("is of {}", key)
        )


def _of_name(name: str, key: str, section: ChannelSection, taken: Mapping[str, str]) -> str:
    if not NAME.fullmatch(name) or len(name) > LONGEST_NAME or name.startswith("raw_"):
        return say(
            "{} is no name for a channel; write at most {} lower-case letters, digits"
            " and _, a letter first and not raw_, for example bushing_temperature",
            key,
            LONGEST_NAME,
        )
    own = {column.name for column in _channel(name, section).columns} | {name, f"raw_{name}"}
    clash = sorted(own & taken.keys(), key=lambda column: (column != name, column))
    if not clash:
        return ""
    return say(
        "{} is not a possible name: its column {} exists; choose another name", key, repr(clash[0])
    )


def _of_section(rig: RigFile, key: str, section: ChannelSection) -> Iterator[str]:
    if section.source:
        fields = [field for field in _OF_INPUT if getattr(section, field) != getattr(_PLAIN, field)]
        if fields:
            yield say(
                (
                    "{}.{} has no effect with {}.source; remove one of them: a channel is either"
                    " an input or a source"
                ),
                key,
                fields[0],
                key,
            )
        yield from _of_source(rig, key, section)
        return
    source = rig.encoder.device
    for name, example in (("device", source), ("input", "analog_5"), ("unit", "degC")):
        if not getattr(section, name).strip():
            yield say('{}.{} is missing; write {} = "{}" or the like', key, name, name, example)
    if section.device != source:
        yield say(
            (
                "{}.device = {} must be {}, the device of the encoder: inputs are sampled"
                " together with the crank angle; values of another device are read with"
                ' {}.source = "DEVICE.QUANTITY"'
            ),
            key,
            repr(section.device),
            repr(source),
            key,
        )
    if section.table and (section.scale, section.offset_V) != (_PLAIN.scale, _PLAIN.offset_V):
        yield say(
            ("{}.table is given together with scale or offset_V; keep either the table or these"),
            key,
        )
    elif not section.table and section.scale == 0.0:
        yield say("{}.scale = 0 makes the same value of every voltage; write the unit per V", key)
    if len(section.table) == 1:
        yield say("{}.table has one point; give two or more as [[voltage in V, value], ...]", key)
    for row, ((low, first), (high, second)) in enumerate(pairwise(section.table), 2):
        if high <= low:
            yield say(
                "{}.table {}: voltage {:g} V is not above {:g} V before; sort it",
                key,
                row,
                high,
                low,
            )
        elif first == second:
            yield say(
                "{}.table {}: value {:g} is that of the row before; take one out", key, row, second
            )
    rising = [after[1] > before[1] for before, after in pairwise(section.table)]
    if any(rising) and not all(rising):
        yield say(
            "{}.table rises and falls; a voltage must mean one value and a value one voltage", key
        )


def _of_source(rig: RigFile, key: str, section: ChannelSection) -> Iterator[str]:
    device, quantity = section.slow_source
    if not (device and quantity):
        yield say(
            '{}.source = {} is not readable; write "DEVICE.QUANTITY"', key, repr(section.source)
        )
    elif device not in rig.devices:
        known = joined(", ", rig.devices) or "none"
        yield say(
            "{}.source = {}: {} is not among the devices ({})",
            key,
            repr(section.source),
            device,
            known,
        )
    elif device == rig.encoder.device:
        yield say(
            "{}.source = {}: {} is the data source; give {}.device and {}.input for one"
            " of its inputs",
            key,
            repr(section.source),
            device,
            key,
            key,
        )


_PLAIN = ChannelSection()
