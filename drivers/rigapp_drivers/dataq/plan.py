"""Convert a DataRequest into a scan list, a rate, and the ChannelSpecs of the rows; pure."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from rigapp.texts import joined, say, sentence_of_error
from rigapp_drivers.api import ChannelSpec, DataRequest, InvalidRequest
from rigapp_drivers.dataq import protocol as p
from rigapp_drivers.dataq.protocol import Clock, Function, Model
from rigapp_drivers.dataq.rates import NoSuchRate, Rate, encoder_rate, rate_for
from rigapp_drivers.dataq.scans import ENCODER_STEPS, Layout, Steps
from rigapp_drivers.dataq.settings import NO_LINE

COUNTER: Final = "counter_1"
_SPARE_STEPS: Final = 2  # uneven line spacing, and an edge just before or after a scan
_LOWEST_COUNT, _HIGHEST_COUNT = -(2.0**31), 2.0**31 - 1.0


@dataclass(frozen=True, slots=True)
class Analog:
    """An analog input: its range, and the gain of the bridge amplifier before it, if any.

    gain: V at the input for 1 mV/V of the bridge; None: the input is a voltage.
    """

    range_V: float
    gain: float | None = None

    def spec(self, number: int) -> ChannelSpec:
        """Return the ChannelSpec of this input: in V, or in mV/V of the bridge before the gain."""
        span = self.range_V if self.gain is None else self.range_V / self.gain
        unit = "V" if self.gain is None else "mV/V"
        return ChannelSpec(f"analog_{number}", unit, p.analog_scale(span), 0.0, -span, span)


@dataclass(frozen=True, slots=True)
class Plan:
    """All settings of the device.

    scan_list: words by position. rows: of the scan, in the order of ``channels``. direction_line,
    index_line: numbers of the digital lines with B and Z of the encoder. wiring: description.
    """

    model: Model
    clock: Clock
    rate: Rate
    sample_rate_Hz: float
    scan_list: tuple[int, ...]
    filter_mode: int
    packet_code: int
    layout: Layout
    steps: Steps
    channels: tuple[ChannelSpec, ...]
    rows: tuple[int, ...]
    pulses_per_revolution: float
    direction_line: int | None
    index_line: int | None
    wiring: str

    def commands(self, *, end_list: bool) -> tuple[bytes, ...]:
        """Return the command lines of the set-up; ps is last, as srate may change it."""
        lines = [p.line("encode", 0), p.line("endo", p.ALL_INPUTS)]
        lines += [p.line("slist", index, word) for index, word in enumerate(self.scan_list)]
        if end_list:
            lines.append(p.line("slist", len(self.scan_list), p.END_OF_LIST))
        channels = [word & 7 for word in self.scan_list[: self.layout.analog]]
        lines += [p.line("filter", channel, self.filter_mode) for channel in channels]
        lines += [
            p.line("dec", self.rate.dec),
            p.line("deca", self.rate.deca),
            p.line("srate", self.rate.srate),
            p.line("ps", self.packet_code),
        ]
        return tuple(lines)


def make_plan(request: DataRequest, settings: Mapping[str, Any]) -> Plan:
    """Return the plan for a request; raise InvalidRequest."""
    model = p.MODELS[settings["model"]]
    clock = Clock(settings["clock"])
    analog = _analog(request, model, settings["bridge_amplifiers"])
    pulses = _pulses_per_revolution(request)
    rate_range_Hz = settings["rate_range_Hz"]
    direction, index = _lines(settings, clock)
    digital = settings["digital"] or (direction, index) != (None, None)
    layout = Layout(len(analog), digital, bool(rate_range_Hz), model.mask)
    if layout.words > p.MOST_ENTRIES:
        raise InvalidRequest(
            "{} entries in the scan list, {} at most; take analog inputs out.",
            layout.words,
            p.MOST_ENTRIES,
        )
    words = [p.analog_word(n - 1, model.ranges_V.index(analog[n].range_V)) for n in analog]
    if digital:
        words.append(Function.DIGITAL)
    if rate_range_Hz:
        words.append(p.rate_word(rate_range_Hz))
    words.append(Function.COUNTER)
    rate, nominal = _rate(request.sample_rate_Hz, clock, layout.words)
    channels = _channels(analog, digital, rate_range_Hz, counter=COUNTER in request.inputs)
    return Plan(
        model=model,
        clock=clock,
        rate=rate,
        sample_rate_Hz=nominal,
        scan_list=tuple(words),
        filter_mode=p.FILTERS[settings["filter"]],
        packet_code=_packet_code(2.0 * layout.words * nominal * settings["block_s"], clock),
        layout=layout,
        steps=_steps(clock, nominal, pulses, settings),
        channels=channels,
        rows=tuple(range(len(channels))),
        pulses_per_revolution=pulses,
        direction_line=direction,
        index_line=index,
        wiring=_wiring(settings, clock),
    )


def _lines(settings: Mapping[str, Any], clock: Clock) -> tuple[int | None, int | None]:
    """Return the numbers of the digital lines with B and Z of the encoder."""
    named = {key: settings[key] for key in ("direction_line", "index_line")}
    used = {key: line for key, line in named.items() if line != NO_LINE}
    for key, line in used.items():
        if clock is not Clock.ENCODER:
            raise InvalidRequest(
                '{} = "{}" needs clock = "encoder": scans of the internal clock miss'
                " its changes; take it out.",
                key,
                line,
            )
        if line == p.RATE_LINE and settings["rate_range_Hz"]:
            raise InvalidRequest(
                '{} = "{}" is the rate input, which rate_range_Hz records; choose another line.',
                key,
                line,
            )
    if len(used) == 2 and len(set(used.values())) == 1:
        raise InvalidRequest(
            'direction_line and index_line are both "{}"; each needs its own.', named["index_line"]
        )
    direction, index = (int(used[key][1:]) if key in used else None for key in named)
    return direction, index


def _wiring(settings: Mapping[str, Any], clock: Clock) -> str:
    """Return the wiring of the encoder in words."""
    by_encoder = clock is Clock.ENCODER
    places = [say("{} (scan clock)", p.CLOCK_LINE)] if by_encoder else []
    places.append(say("{} (counter)", p.COUNTER_LINE))
    places += [say("{} (rate)", p.RATE_LINE)] if settings["rate_range_Hz"] else []
    words = [say("encoder line A to {}", joined(", ", places))]
    for name, key in (("B", "direction_line"), ("Z", "index_line")):
        if settings[key] != NO_LINE:
            words.append(say("line {} to {}", name, settings[key]))
    return joined(", ", words)


def _analog(request: DataRequest, model: Model, amplifiers: Mapping[str, Any]) -> dict[int, Analog]:
    """Return the analog inputs by number (1 to 8), in ascending order."""
    analog: dict[int, Analog] = {}
    for name, (kind, wanted) in request.inputs.items():
        if kind == "counter":
            if name != COUNTER:
                raise InvalidRequest("{}: the device has one counter, {}.", name, COUNTER)
            continue
        match = re.fullmatch(r"analog_([1-8])", name)
        if match is None:
            raise InvalidRequest(
                "{} is not an input; write analog_1 to analog_8 or {}.", name, COUNTER
            )
        if kind == "bridge":
            analog[int(match[1])] = _bridge(name, wanted, model, amplifiers)
            continue
        if kind != "voltage":
            raise InvalidRequest(
                "{}: a {} input does not exist; declare it as a voltage.", name, kind
            )
        if wanted not in model.ranges_V:
            raise InvalidRequest(
                "{}: the {} has no range of {:g} V; it has {} V.",
                name,
                model.name,
                wanted,
                _ranges(model),
            )
        analog[int(match[1])] = Analog(wanted)
    return dict(sorted(analog.items()))


def _bridge(name: str, range_mV_per_V: float, model: Model, gains: Mapping[str, Any]) -> Analog:
    """Return a bridge with an external amplifier, in the smallest sufficient range."""
    if name not in gains:
        raise InvalidRequest(
            (
                "{} is declared as a bridge, and the {} has no bridge inputs; use a bridge"
                " amplifier with a voltage output and state its output in V for 1 mV/V as"
                " bridge_amplifiers = {{ {} = ... }}."
            ),
            name,
            model.name,
            name,
        )
    gain = gains[name]
    usable = isinstance(gain, int | float) and not isinstance(gain, bool)
    if not (usable and math.isfinite(gain) and gain > 0.0):
        raise InvalidRequest(
            "bridge_amplifiers.{} = {} is no gain; give the amplifier's output in V for"
            " 1 mV/V, a number above 0.",
            name,
            repr(gain),
        )
    needed = range_mV_per_V * gain
    fitting = [volts for volts in model.ranges_V if volts >= needed * (1.0 - 1e-9)]
    if not fitting:
        raise InvalidRequest(
            "{}: {:g} mV/V make {:g} V behind the amplifier of {:g} V for 1 mV/V; the"
            " {} has {} V; lower range_mV_per_V.",
            name,
            range_mV_per_V,
            needed,
            gain,
            model.name,
            _ranges(model),
        )
    return Analog(min(fitting), float(gain))


def _ranges(model: Model) -> str:
    return joined(", ", (f"{volts:g}" for volts in model.ranges_V))


def _pulses_per_revolution(request: DataRequest) -> float:
    pulses = request.inputs.get(COUNTER, ("counter", 3600.0))[1]
    if not (math.isfinite(pulses) and pulses >= 1.0):
        raise InvalidRequest(
            "{}: {:g} counts per revolution cannot be; give 1 or more.", COUNTER, pulses
        )
    return float(pulses)


def _rate(requested_Hz: float, clock: Clock, entries: int) -> tuple[Rate, float]:
    if clock is Clock.ENCODER:
        rate = encoder_rate(entries)
        if not 0.0 < requested_Hz <= rate.sample_rate_Hz:
            raise InvalidRequest(
                "sample_rate_Hz = {:g} is the nominal rate of the encoder's pulses;"
                " with {} entries in the scan list it can be {:g} at most.",
                requested_Hz,
                entries,
                rate.sample_rate_Hz,
            )
        return rate, float(requested_Hz)
    try:
        rate = rate_for(requested_Hz, entries)
    except NoSuchRate as error:
        raise InvalidRequest(sentence_of_error(error)) from error
    return rate, rate.sample_rate_Hz


def _steps(clock: Clock, rate_Hz: float, pulses: float, settings: Mapping[str, Any]) -> Steps:
    """Return the limits of the counter's steps, in counts per scan and per scan squared."""
    if clock is Clock.ENCODER:
        return ENCODER_STEPS
    speed = settings["maximum_speed_rpm"] / 60.0
    highest = math.ceil(speed * pulses / rate_Hz) + _SPARE_STEPS
    if highest > p.COUNTER_SPAN // 4:
        raise InvalidRequest(
            (
                "at {:g} scans/s and maximum_speed_rpm = {:g} the 16-bit counter may step by {}"
                " from scan to scan, too much to detect a lost byte; raise sample_rate_Hz or"
                " lower maximum_speed_rpm."
            ),
            rate_Hz,
            settings["maximum_speed_rpm"],
            highest,
        )
    acceleration = settings["maximum_acceleration_rev_per_s2"]
    change = math.ceil(acceleration * pulses / rate_Hz**2) + _SPARE_STEPS
    return Steps(0, highest, min(change, highest))


def _channels(
    analog: Mapping[int, Analog], digital: bool, rate_range_Hz: float, *, counter: bool
) -> tuple[ChannelSpec, ...]:
    specs = [analog[number].spec(number) for number in analog]
    if digital:
        specs.append(ChannelSpec("digital", "bits", minimum=0.0, maximum=127.0))
    if rate_range_Hz:
        scale, offset = p.rate_scale(rate_range_Hz)
        specs.append(ChannelSpec("rate_1", "Hz", scale, offset, 0.0, rate_range_Hz))
    if counter:
        specs.append(ChannelSpec(COUNTER, "count", minimum=_LOWEST_COUNT, maximum=_HIGHEST_COUNT))
    return tuple(specs)


def _packet_code(block_bytes: float, clock: Clock) -> int:
    """Return the largest packet of at most half a block; the smallest for the encoder clock."""
    if clock is Clock.ENCODER:
        return 0
    fitting = [code for code, size in enumerate(p.PACKET_SIZES) if 2 * size <= block_bytes]
    return fitting[-1] if fitting else 0
