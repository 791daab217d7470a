"""State of a simulated GSV-8: hardware, non-volatile settings, volatile state, faults."""

from __future__ import annotations

import enum
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8.numbers import DataType
from rigapp_drivers.gsv8.protocol import CounterMode, InputType
from rigapp_drivers.gsv8.words import ValueFault

HIGHEST_COUNT = (1 << 23) - 1
LOWEST_COUNT = -(1 << 23)
_SPAN = 1 << 24

Counts = NDArray[np.int64]


class QuadratureInput:
    """Count the edges of an encoder with an index.

    counts_per_revolution: edges of A and B, four per line. At the index the counter is set to the
    home value, in both directions; in between it counts on.
    """

    def __init__(self, counts_per_revolution: int) -> None:
        self.counts_per_revolution = counts_per_revolution
        self.last_count = 0
        self._edge: int | None = None
        self._origin = 0

    def slip(self, counts: int) -> None:
        """Offset the counter by ``counts`` until the next index."""
        self._origin -= counts

    def clear(self, mode: CounterMode, value: int = 0) -> None:
        """Set the count at the shaft's present position."""
        divisor = 4 // mode.quadrature.counts_per_line
        self._origin = (self._edge or 0) // divisor - value
        self.last_count = value

    def advance(
        self, shaft_revolutions: NDArray[np.float64], mode: CounterMode, home: int, *, index: bool
    ) -> Counts:
        """Return the counts at these unwrapped angles; index: whether its pulses arrive."""
        # The tiny shift corrects an angle that rounding put just below an edge.
        edges = np.floor(shaft_revolutions * self.counts_per_revolution + 1e-6).astype(np.int64)
        divisor = 4 // mode.quadrature.counts_per_line
        counts = edges // divisor if divisor > 1 else edges.copy()
        if mode.use_index and index:
            counts -= self._origins(edges, divisor, home)
        else:
            counts -= self._origin
        self._edge = int(edges[-1])
        counts = self._limited(counts, mode)
        self.last_count = int(counts[-1])
        return counts

    def _origins(self, edges: Counts, divisor: int, home: int) -> Counts | int:
        """Return the count origin of each sample; it changes at each index pulse."""
        first = edges[0] if self._edge is None else self._edge
        low, high = min(first, edges.min()), max(first, edges.max())
        if low % self.counts_per_revolution and low // self.counts_per_revolution == (
            high // self.counts_per_revolution
        ):
            return self._origin  # usual case: no index between the lowest and the highest edge
        before = np.empty_like(edges)
        before[0] = first
        before[1:] = edges[:-1]
        turn = self.counts_per_revolution
        last_forward = edges // turn * turn
        last_backward = -(-edges // turn) * turn
        forward = (edges > before) & (last_forward > before)
        backward = (edges < before) & (last_backward < before)
        passed = np.flatnonzero(forward | backward)
        if passed.size == 0:
            return self._origin
        pulses = np.where(forward[passed], last_forward[passed], last_backward[passed])
        origins = np.concatenate(([self._origin], pulses // divisor - home))
        lengths = np.diff(np.concatenate(([0], passed, [edges.size])))
        self._origin = int(origins[-1])
        return np.repeat(origins, lengths)

    def _limited(self, counts: Counts, mode: CounterMode) -> Counts:
        if counts.max() <= HIGHEST_COUNT and counts.min() >= LOWEST_COUNT:
            return counts
        if not mode.saturate:
            return (counts - LOWEST_COUNT) % _SPAN + LOWEST_COUNT
        over = np.maximum.accumulate(np.maximum(counts - HIGHEST_COUNT, 0))
        counts = counts - over
        under = np.maximum.accumulate(np.maximum(LOWEST_COUNT - counts, 0))
        self._origin += int(over[-1]) - int(under[-1])
        return counts + under


DEFAULT_COUNTER_MODE = 0xC8  # x1, saturate, store last; bit 0 (present) is not stored
_MOST_STORED_FAULTS = 38
_FASTEST_HZ = {DataType.FLOAT32: 12000.0, DataType.INT24: 24000.0, DataType.INT16: 48000.0}
_FASTEST_WITH_COUNTER_HZ = 16000.0


class Gsv8Fault(enum.StrEnum):
    """Kinds of fault; the comment gives the meaning of ``value`` and its default."""

    # in the stream, once
    DROPPED_FRAMES = "dropped_frames"  # number of missing frames (1)
    CUT_FRAME = "cut_frame"  # bytes of the frame that are sent (11)
    GARBAGE = "garbage"  # number of random bytes before a frame (7)
    FLIPPED_BIT = "flipped_bit"  # index of the byte with one wrong bit (5)
    OVERRUN = "overrun"  # frames lost in the transmit queue (10); reported as code 91
    # in the stream, while active
    WRONG_OBJECT_COUNT = "wrong_object_count"  # objects more than the device reports (1)
    # at the inputs, while active
    SATURATED_INPUT = "saturated_input"  # analog channel (1), beyond its range
    STUCK_INPUT = "stuck_input"  # analog channel (1)
    SENSOR_BROKEN = "sensor_broken"  # analog channel (1); value error of kind 3
    MISSING_INDEX = "missing_index"  # the index pulse does not arrive
    STUCK_COUNTER = "stuck_counter"
    # at the counter, once
    COUNTER_SLIP = "counter_slip"  # counts too many (1)
    FALSE_INDEX = "false_index"  # an index pulse where there is none
    # in the replies; count: number of replies, target: command
    NO_REPLY = "no_reply"
    LOST_COMMAND = "lost_command"  # neither executed nor answered
    SLOW_REPLY = "slow_reply"  # delay in s (0.3)
    REFUSED = "refused"  # status of the answer (75 hexadecimal)
    # the device
    WRITE_ACCESS_ELSEWHERE = "write_access_elsewhere"  # every write returns status 75
    RESET = "reset"  # power off and on


def default_scale(kind: InputType) -> float:
    """Return the default user scale of an input type."""
    return p.NOMINAL_RANGE.get(kind, 1.0)


@dataclass(frozen=True, slots=True)
class Hardware:
    """Hardware of the simulated device."""

    firmware: tuple[int, int] = (1, 56)
    serial_number: int = 20123456
    usb: bool = True
    counter_present: bool = True
    offset_binary: bool = True
    zero_prohibited: int = 0


@dataclass(slots=True)
class Memory:
    """Settings of the device; lists by channel, analog 1..8 first, counters 9 and 10 last."""

    counter_scale: float = 8388608.0
    input_types: list[InputType] = field(
        default_factory=lambda: [InputType.BRIDGE_5V] * p.ANALOG_CHANNELS
    )
    scales: list[float] = field(default_factory=list)
    offsets: list[float] = field(default_factory=lambda: [0.0] * p.USER_CHANNELS)
    zeros: list[int] = field(default_factory=lambda: [0] * p.ANALOG_CHANNELS)
    rate_Hz: float = 10.0
    objects: int = p.ANALOG_CHANNELS
    data_type: DataType = DataType.FLOAT32
    transmit_flags: int = 0
    mode: int = p.MODE_FILTER_AUTOMATIC
    counter_modes: list[int] = field(default_factory=lambda: [DEFAULT_COUNTER_MODE] * 2)
    counter_gates: list[int] = field(default_factory=lambda: [0] * p.COUNTER_CHANNELS)
    counter_homes: list[int] = field(default_factory=lambda: [0] * p.COUNTER_CHANNELS)
    filter_Hz: float = 11400.0
    line_directions: list[int] = field(default_factory=lambda: [1] * 4)
    line_thresholds: dict[tuple[int, int], float] = field(default_factory=dict)
    uart_baud_rate: int = 115200

    def __post_init__(self) -> None:
        if not self.scales:
            analog = [default_scale(kind) for kind in self.input_types]
            self.scales = [*analog, self.counter_scale, self.counter_scale]

    @property
    def counters(self) -> tuple[int, ...]:
        """Return the counters (0, 1) that are switched on."""
        return tuple(n for n, mode in enumerate(self.counter_modes) if mode & p.COUNTER_ON)

    @property
    def analog_objects(self) -> int:
        """Return the number of analog channels in the frame."""
        return self.objects - len(self.counters)


@dataclass(slots=True)
class Volatile:
    """State that the device loses at power-off."""

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
    """State shared by commands and stream; ``writes`` counts changes of stored settings."""

    def __init__(self, hardware: Hardware, settings: Memory, counts_per_revolution: int) -> None:
        self.hardware = hardware
        self.settings = settings
        self.counters = tuple(QuadratureInput(counts_per_revolution) for _ in range(2))
        self.writes = 0
        self.write_access = True
        self.state = Volatile()
        self.power_on()

    def power_on(self) -> None:
        """Restart as at power-on: the settings remain, the volatile state is reset."""
        self.state = Volatile(transmitting=not self.settings.transmit_flags & p.TX_ALWAYS_OFF)
        self.state.data_checksum = bool(self.settings.transmit_flags & p.TX_CHECKSUM)
        for counter, flags in zip(self.counters, self.settings.counter_modes, strict=True):
            if not flags & p.COUNTER_STORES_LAST:
                counter.clear(p.decode_counter_mode(flags))

    def highest_rate_Hz(
        self, data_type: DataType | None = None, objects: int | None = None, counting: bool = False
    ) -> float:
        """Return the highest rate that the settings, or these instead, allow."""
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
        """Store a value error, once per change of its flags; flags 0: it has ended."""
        before = self.state.present.get(kind, 0)
        self.state.present[kind] = flags
        if flags in (0, before):
            return
        self.state.faults.append(ValueFault(kind, int(now_s / 60.0), flags))
        del self.state.faults[:-_MOST_STORED_FAULTS]
