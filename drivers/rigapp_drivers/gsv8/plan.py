"""Convert a data request into the settings of the device; pure, no device needed."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rigapp.texts import joined, say
from rigapp_drivers.api import ChannelSpec, DataRequest, InvalidRequest
from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8.numbers import OVERRANGE, DataType, scale_of_code
from rigapp_drivers.gsv8.protocol import CounterMode, InputType, Quadrature

_DATA_TYPES = {
    "float32": DataType.FLOAT32,
    "int24": DataType.INT24,
    "int16": DataType.INT16,
}
_QUADRATURES = {
    "x4": Quadrature.X4,
    "x2": Quadrature.X2,
    "x1": Quadrature.X1,
    "pulse and direction": Quadrature.PULSE_AND_DIRECTION,
}
_BRIDGES = {
    p.NOMINAL_RANGE[kind]: kind
    for kind in (InputType.BRIDGE_8V75, InputType.BRIDGE_5V, InputType.BRIDGE_2V5)
}
_LONGEST_RANGE_V = 10.0


@dataclass(frozen=True, slots=True)
class Plan:
    """Required settings of the device.

    objects: inputs in the order of the frame; channels: the requested inputs in their order.
    analog: channel number -> input type. counters: counter number (0, 1) -> mode. data_checksum:
    None: depends on firmware and line.
    """

    sample_rate_Hz: float
    data_type: DataType
    objects: tuple[str, ...]
    channels: tuple[str, ...]
    analog: Mapping[int, InputType]
    counters: Mapping[int, CounterMode]
    counter_home: int
    counts_per_unit: float
    data_checksum: bool | None
    command_checksum: bool
    high_speed: bool
    filter_Hz: float | None

    @property
    def rows(self) -> list[int]:
        """Return the index of each channel among the objects of the frame."""
        return [self.objects.index(name) for name in self.channels]

    def specs(self) -> tuple[ChannelSpec, ...]:
        """Return the ChannelSpec of each channel: float32 is scaled by the device, integers not."""
        return tuple(self._spec(name) for name in self.channels)

    def _spec(self, name: str) -> ChannelSpec:
        kind, number = parse_input(name)
        if kind == "counter":
            return ChannelSpec(name, "count", scale=self.counts_per_unit)
        nominal = p.NOMINAL_RANGE[self.analog[number]]
        unit = "V" if self.analog[number] is InputType.SINGLE_ENDED else "mV/V"
        scale = 1.0
        if self.data_type is not DataType.FLOAT32:
            scale = scale_of_code(self.data_type, nominal)
        end = OVERRANGE * nominal
        return ChannelSpec(name, unit, scale=scale, minimum=-end, maximum=end)


def make_plan(request: DataRequest, settings: Mapping[str, Any]) -> Plan:
    """Return the plan for a request; raise InvalidRequest.

    settings: every key of ``settings.SETTINGS``.
    """
    _check_rate(request.sample_rate_Hz)
    if not request.inputs:
        raise InvalidRequest("no input is requested; name at least one.")
    data_type = _DATA_TYPES[settings["data_type"]]
    analog: dict[int, InputType] = {}
    counters: dict[int, CounterMode] = {}
    for name, (kind, span) in request.inputs.items():
        family, number = parse_input(name)
        if family == "counter":
            _check_counter(name, kind, data_type)
            counters[number - 1] = _counter_mode(settings)
        else:
            analog[number] = _input_type(name, kind, span)
    return Plan(
        sample_rate_Hz=request.sample_rate_Hz,
        data_type=data_type,
        objects=_objects(settings["object_map"], analog, counters, tuple(request.inputs)),
        channels=tuple(request.inputs),
        analog=analog,
        counters=counters,
        counter_home=settings["counter_home"],
        counts_per_unit=settings["counts_per_unit"],
        data_checksum=None if settings["data_checksum"] == "auto" else settings["data_checksum"],
        command_checksum=settings["command_checksum"],
        high_speed=settings["high_speed_frames"],
        filter_Hz=_filter(settings["analog_filter"]),
    )


def parse_input(name: str) -> tuple[str, int]:
    """Return family ("analog" or "counter") and number of an input; raise InvalidRequest."""
    match = re.fullmatch(r"(analog)_([1-8])|(counter)_([12])", name)
    if match is None:
        raise InvalidRequest(
            'the device has no input "{}"; it has analog_1 to analog_8, counter_1, counter_2.', name
        )
    family = match[1] or match[3]
    return family, int(match[2] or match[4])


def _check_rate(rate_Hz: float) -> None:
    if rate_Hz in p.ALLOWED_RATES_HZ:
        return
    near = joined(say(" or "), (f"{rate:g}" for rate in p.neighbours_of_rate(rate_Hz)))
    raise InvalidRequest(
        "sample_rate_Hz = {:g} is not a rate of this device; the nearest are {}.", rate_Hz, near
    )


def _check_counter(name: str, kind: str, data_type: DataType) -> None:
    if kind != "counter":
        raise InvalidRequest("{} is a counter and cannot measure a {}.", name, kind)
    if data_type is DataType.INT16:
        raise InvalidRequest(
            'data_type = "int16" keeps one of 256 counts of {}; choose "int24" or "float32".', name
        )


def _input_type(name: str, kind: str, span: float) -> InputType:
    if kind == "bridge":
        if span not in _BRIDGES:
            known = joined(", ", (f"{choice:g}" for choice in sorted(_BRIDGES)))
            raise InvalidRequest(
                "{}: a range of {:g} mV/V is not there; choose {}.", name, span, known
            )
        return _BRIDGES[span]
    if kind == "voltage":
        if not 0.0 < span <= _LONGEST_RANGE_V:
            raise InvalidRequest(
                "{}: a range of {:g} V is not there; the range is 10 V.", name, span
            )
        return InputType.SINGLE_ENDED
    raise InvalidRequest('{} cannot be a "{}"; it can be a bridge or a voltage.', name, kind)


def _counter_mode(settings: Mapping[str, Any]) -> CounterMode:
    return CounterMode(
        on=True,
        quadrature=_QUADRATURES[settings["counter_quadrature"]],
        use_index=settings["counter_index"],
        saturate=settings["counter_saturates"],
        store_last=False,
        pull_ups=settings["counter_pull_ups"],
        index_inverted=settings["counter_index_inverted"],
        noise_filter=settings["counter_noise_filter"],
    )


def _objects(
    object_map: Sequence[Any],
    analog: Mapping[int, InputType],
    counters: Mapping[int, CounterMode],
    requested: tuple[str, ...],
) -> tuple[str, ...]:
    if object_map:
        return _mapped(object_map, requested)
    # A frame contains the analog channels from 1, and at least two objects.
    fewest = 1 if counters else 2
    last = max([*analog, fewest])
    return (
        *(f"analog_{number}" for number in range(1, last + 1)),
        *(f"counter_{number + 1}" for number in sorted(counters)),
    )


def _mapped(object_map: Sequence[Any], requested: tuple[str, ...]) -> tuple[str, ...]:
    names = tuple(str(name) for name in object_map)
    for name in names:
        parse_input(name)
    if len(set(names)) != len(names):
        raise InvalidRequest("object_map = {} names an input twice.", list(names))
    missing = [name for name in requested if name not in names]
    if missing:
        raise InvalidRequest("object_map = {} lacks {}.", list(names), joined(", ", missing))
    idle = [name for name in names if name.startswith("counter") and name not in requested]
    if idle:
        raise InvalidRequest(
            "object_map names {}, which is not in use; take it out.", joined(", ", idle)
        )
    counters = sum(name.startswith("counter") for name in names)
    if len(names) > p.ANALOG_CHANNELS + counters or len(names) < 2:
        raise InvalidRequest("object_map has {} inputs; 2 to 10 are possible.", len(names))
    return names


def _filter(words: str) -> float | None:
    return None if words == "automatic" else float(words.removesuffix(" Hz"))
