"""What a simulated GSV-8 keeps in its settings memory, and how often it was written."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from drivers.gsv8.numbers import DataType
from drivers.gsv8.protocol import (
    ANALOG_CHANNELS,
    COUNTER_CHANNELS,
    COUNTER_ON,
    MODE_FILTER_AUTOMATIC,
    NOMINAL_RANGE,
    InputType,
)

DEFAULT_COUNTER_MODE = 0xC8  # x1, saturate, store last; bit 0 (present) is not stored
DEFAULT_OUTPUT = (1, 0)
DIGITAL_LINES = 16


def default_scale(kind: InputType) -> float:
    """Return the user scale that the device loads with an input type."""
    return NOMINAL_RANGE.get(kind, 1.0)


@dataclass(slots=True)
class Settings:
    """Settings of the device; lists by channel, analog 1..8 first, counters 9 and 10 last."""

    counter_scale: float = 8388608.0
    input_types: list[InputType] = field(
        default_factory=lambda: [InputType.BRIDGE_5V] * ANALOG_CHANNELS
    )
    scales: list[float] = field(default_factory=list)
    offsets: list[float] = field(default_factory=lambda: [0.0] * 10)
    zeros: list[int] = field(default_factory=lambda: [0] * ANALOG_CHANNELS)
    units: list[int] = field(default_factory=lambda: [0] * 10)
    rate_Hz: float = 10.0
    objects: int = ANALOG_CHANNELS
    data_type: DataType = DataType.FLOAT32
    transmit_flags: int = 0
    mode: int = MODE_FILTER_AUTOMATIC
    counter_modes: list[int] = field(default_factory=lambda: [DEFAULT_COUNTER_MODE] * 2)
    counter_gates: list[int] = field(default_factory=lambda: [0] * COUNTER_CHANNELS)
    counter_homes: list[int] = field(default_factory=lambda: [0] * COUNTER_CHANNELS)
    filter_Hz: float = 11400.0
    outputs: list[tuple[int, int]] = field(default_factory=lambda: [DEFAULT_OUTPUT] * 8)
    line_directions: list[int] = field(default_factory=lambda: [1] * 4)
    line_types: list[tuple[int, int]] = field(default_factory=lambda: [(4, 0)] * DIGITAL_LINES)
    line_levels: list[int] = field(default_factory=lambda: [0] * DIGITAL_LINES)
    line_initial: list[int] = field(default_factory=lambda: [0] * DIGITAL_LINES)
    line_thresholds: dict[tuple[int, int], float] = field(default_factory=dict)
    uart_baud_rate: int = 115200

    def __post_init__(self) -> None:
        if not self.scales:
            analog = [default_scale(kind) for kind in self.input_types]
            self.scales = [*analog, self.counter_scale, self.counter_scale]

    @property
    def counters(self) -> tuple[int, ...]:
        """Return the counters (0, 1) that are switched on."""
        return tuple(n for n, mode in enumerate(self.counter_modes) if mode & COUNTER_ON)

    @property
    def analog_objects(self) -> int:
        """Return how many analog channels are in the frame."""
        return self.objects - len(self.counters)

    def defaults(self) -> Settings:
        """Return the factory settings; counters on, bit rate, objects and data type stay."""
        fresh = Settings(counter_scale=self.counter_scale)
        modes = [
            DEFAULT_COUNTER_MODE & ~COUNTER_ON | mode & COUNTER_ON for mode in self.counter_modes
        ]
        return replace(
            fresh,
            counter_modes=modes,
            uart_baud_rate=self.uart_baud_rate,
            objects=self.objects,
            data_type=self.data_type,
        )
