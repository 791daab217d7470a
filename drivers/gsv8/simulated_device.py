"""The simulated GSV-8 behind its commands: hardware, settings, volatile state."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from drivers.gsv8 import protocol as p
from drivers.gsv8.numbers import DataType
from drivers.gsv8.simulated_counter import QuadratureInput
from drivers.gsv8.simulated_memory import Settings
from drivers.gsv8.words import ValueFault

_MOST_STORED_FAULTS = 38
_FASTEST_HZ = {DataType.FLOAT32: 12000.0, DataType.INT24: 24000.0, DataType.INT16: 48000.0}
_FASTEST_WITH_COUNTER_HZ = 16000.0


class Entry(NamedTuple):
    """A command: allowed numbers of parameters, what obeys it, whether it changes a setting."""

    lengths: tuple[int, ...]
    handler: Callable[[bytes], bytes]
    writes: bool = False


Table = Mapping[int, Entry]


class Refused(Exception):
    """Answer with a status code and no data."""

    def __init__(self, status: int) -> None:
        super().__init__(f"status {status:02X}")
        self.status = status


@dataclass(frozen=True, slots=True)
class Hardware:
    """What the simulated device is."""

    firmware: tuple[int, int] = (1, 56)
    serial_number: int = 20123456
    usb: bool = True
    counter_present: bool = True
    offset_binary: bool = True
    zero_prohibited: int = 0


@dataclass(slots=True)
class State:
    """What the device forgets when its power goes."""

    transmitting: bool = True
    data_checksum: bool = False
    high_speed: bool = False
    injection: int = 0
    synchronous_error: int = 0
    asynchronous_error: int = 0
    faults: list[ValueFault] = field(default_factory=list)
    present: dict[int, int] = field(default_factory=dict)
    raw: list[int] = field(default_factory=lambda: [0] * p.ANALOG_CHANNELS)


class Device:
    """Everything that commands and stream share; ``writes`` counts changes of stored settings."""

    def __init__(self, hardware: Hardware, settings: Settings, counts_per_revolution: int) -> None:
        self.hardware = hardware
        self.settings = settings
        self.counters = (
            QuadratureInput(counts_per_revolution),
            QuadratureInput(counts_per_revolution),
        )
        self.writes = 0
        self.write_access = True
        self.stored_faults: list[ValueFault] = []
        self.state = State()
        self.power_on()

    def power_on(self) -> None:
        """Start as after the power comes: the settings are still there, the rest is forgotten."""
        self.state = State(transmitting=not self.settings.transmit_flags & p.TX_ALWAYS_OFF)
        self.state.data_checksum = bool(self.settings.transmit_flags & p.TX_CHECKSUM)
        for counter, flags in zip(self.counters, self.settings.counter_modes, strict=True):
            if not flags & p.COUNTER_STORES_LAST:
                counter.clear(p.decode_counter_mode(flags))

    def highest_rate_Hz(
        self, data_type: DataType | None = None, objects: int | None = None, counting: bool = False
    ) -> float:
        """Return the highest rate that the settings, or these in their place, allow."""
        data_type = data_type or self.settings.data_type
        fastest = _FASTEST_HZ[data_type]
        if counting or self.settings.counters:
            fastest = min(fastest, _FASTEST_WITH_COUNTER_HZ)
        if not self.hardware.usb:
            length = 4 + (objects or self.settings.objects) * data_type.width
            line = self.settings.uart_baud_rate / 10.0 / length
            fastest = max(rate for rate in p.ALLOWED_RATES_HZ if rate <= max(line, 1.0))
        return fastest

    def note_fault(self, kind: int, flags: int, now_s: float) -> None:
        """Remember a value error, once for each change of its flags; flags 0: it is over."""
        before = self.state.present.get(kind, 0)
        self.state.present[kind] = flags
        if flags in (0, before):
            return
        fault = ValueFault(kind, int(now_s / 60.0), flags)
        self.state.faults.append(fault)
        self.stored_faults.append(fault)
        del self.state.faults[:-_MOST_STORED_FAULTS]
        del self.stored_faults[:-_MOST_STORED_FAULTS]


def only(value: int, allowed: int) -> None:
    """Refuse any other index."""
    if value != allowed:
        raise Refused(0x51)


def analog(channel: int) -> int:
    """Return the place of an analog channel 1..8."""
    if not 1 <= channel <= p.ANALOG_CHANNELS:
        raise Refused(0x51)
    return channel - 1


def user(channel: int) -> int:
    """Return the place of a channel 1..10."""
    if not 1 <= channel <= p.USER_CHANNELS:
        raise Refused(0x51)
    return channel - 1


def users(channel: int) -> range:
    """Return the places of a channel 1..10, of all for 0."""
    return range(p.USER_CHANNELS) if channel == 0 else range(user(channel), channel)


def line(number: int) -> int:
    """Return the place of a digital line 1..16."""
    if not 1 <= number <= 16:
        raise Refused(0x51)
    return number - 1
