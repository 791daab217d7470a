"""The analog inputs of a simulated GSV-8: electrical signals in, converter codes out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from rigapp_drivers.gsv8.numbers import OVERRANGE
from rigapp_drivers.gsv8.protocol import NOMINAL_RANGE, InputType

CODE_PER_RANGE = 2.0**23 / OVERRANGE
HIGHEST_CODE = (1 << 23) - 1
LOWEST_CODE = -(1 << 23)

_FAR_OUT, _NO_RANGE = 1e6, 1e300

Codes = NDArray[np.int64]


def part_of_range(signal: NDArray[np.float64] | float, kind: InputType) -> NDArray[np.float64]:
    """Return a signal in fractions of an input's range; an open input (infinite) far beyond it."""
    part = np.asarray(signal / NOMINAL_RANGE.get(kind, _NO_RANGE))
    return part if np.isfinite(part).all() else np.clip(part, -_FAR_OUT, _FAR_OUT)


def parts_of_ranges(
    signals: Mapping[int, NDArray[np.float64]], samples: int, kinds: Sequence[InputType]
) -> NDArray[np.float64]:
    """Return (8, samples) in fractions of each range."""
    inputs = np.zeros((8, samples))
    for channel, signal in signals.items():
        inputs[channel - 1] = part_of_range(signal, kinds[channel - 1])
    return inputs


def open_inputs(signals: Mapping[int, NDArray[np.float64]]) -> int:
    """Return the flags of a value error of kind 3 for the wires that are broken: Ud+, Ud-."""
    flags = 0
    for channel, signal in signals.items():
        flags |= bool(signal.max() == np.inf) << 2 * (channel - 1)
        flags |= bool(signal.min() == -np.inf) << 2 * (channel - 1) + 1
    return flags


class AnalogInputs:
    """Convert the eight inputs together; an input without a signal sees zero."""

    def __init__(self) -> None:
        self._stuck: dict[int, float] = {}
        self._last = np.zeros(8)

    def faulty(
        self, inputs: NDArray[np.float64], saturated: int | None, stuck: int | None
    ) -> NDArray[np.float64]:
        """Return the inputs with one channel beyond its range or stuck at its last value."""
        if saturated is not None:
            inputs[saturated - 1] = 2.0
        if stuck is None:
            self._stuck.clear()
        else:
            held = self._stuck.setdefault(stuck, float(self._last[stuck - 1]))
            inputs[stuck - 1] = held
        self._last = inputs[:, -1].copy()
        return inputs


def codes_of(inputs: NDArray[np.float64]) -> Codes:
    """Return the converter's signed 24-bit codes of normalised inputs."""
    codes = np.round(inputs * CODE_PER_RANGE)
    return np.clip(codes, LOWEST_CODE, HIGHEST_CODE).astype(np.int64)
