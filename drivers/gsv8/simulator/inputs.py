"""The analog inputs of a simulated GSV-8: electrical signals in, converter codes out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from drivers.gsv8.numbers import OVERRANGE
from drivers.gsv8.protocol import NOMINAL_RANGE, InputType

CODE_PER_RANGE = 2.0**23 / OVERRANGE
HIGHEST_CODE = (1 << 23) - 1
LOWEST_CODE = -(1 << 23)

_NOISE_RATES_HZ = (10.0, 50.0, 100.0, 1000.0, 5000.0, 8000.0)
_NOISE_STEPS = {
    InputType.BRIDGE_8V75: (3.0e5, 2.5e5, 1.5e5, 6.0e4, 4.0e4, 1.4e4),
    InputType.BRIDGE_5V: (2.0e5, 1.2e5, 8.0e4, 2.5e4, 1.0e4, 8.0e3),
}
_PEAK_TO_SIGMA = 6.6
_FAR_OUT, _NO_RANGE = 1e6, 1e300

Codes = NDArray[np.int64]


def noise_sigma(kind: InputType, rate_Hz: float) -> float:
    """Return the standard deviation of the noise in fractions of the range (MAN p12).

    The maker gives steps from zero to full range; one step is taken as 6.6 standard deviations.
    Ranges without data are as noisy as 3.5 mV/V.
    """
    steps = _NOISE_STEPS.get(kind, _NOISE_STEPS[InputType.BRIDGE_5V])
    log_steps = np.interp(np.log(rate_Hz), np.log(_NOISE_RATES_HZ), np.log(steps))
    return float(np.exp(-log_steps)) / _PEAK_TO_SIGMA


def part_of_range(signal: NDArray[np.float64] | float, kind: InputType) -> NDArray[np.float64]:
    """Return a signal in fractions of an input's range; an open input (infinite) far beyond it."""
    part = np.asarray(signal / NOMINAL_RANGE.get(kind, _NO_RANGE))
    return part if np.isfinite(part).all() else np.clip(part, -_FAR_OUT, _FAR_OUT)


def open_inputs(signals: Mapping[int, NDArray[np.float64]]) -> int:
    """Return the flags of a value error of kind 3 for the wires that are broken: Ud+, Ud-."""
    flags = 0
    for channel, signal in signals.items():
        flags |= bool(signal.max() == np.inf) << 2 * (channel - 1)
        flags |= bool(signal.min() == -np.inf) << 2 * (channel - 1) + 1
    return flags


class AnalogInputs:
    """Convert the eight inputs together.

    noise: add the device's own noise. delays_s: delay of the analog filter by channel number, for
    all channels by 0; the counters have none.
    """

    def __init__(
        self, rng: np.random.Generator, noise: bool, delays_s: Mapping[int, float]
    ) -> None:
        self._rng = rng
        self._noise = noise
        self._delays_s = dict(delays_s)
        self._history: NDArray[np.float64] = np.zeros((8, 0))
        self._stuck: dict[int, float] = {}
        self._last = np.zeros(8)

    def normalised(
        self,
        signals: Mapping[int, NDArray[np.float64]],
        samples: int,
        kinds: Sequence[InputType],
        rate_Hz: float,
    ) -> NDArray[np.float64]:
        """Return (8, samples) in fractions of each range; an input without a signal sees zero."""
        inputs = np.zeros((8, samples))
        for channel, signal in signals.items():
            inputs[channel - 1] = part_of_range(signal, kinds[channel - 1])
        if self._delays_s:
            inputs = self._delayed(inputs, rate_Hz)
        if self._noise:
            sigmas = np.array([noise_sigma(kind, rate_Hz) for kind in kinds])
            inputs += sigmas[:, None] * self._rng.standard_normal(inputs.shape)
        return inputs

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

    def _delayed(self, inputs: NDArray[np.float64], rate_Hz: float) -> NDArray[np.float64]:
        common = self._delays_s.get(0, 0.0)
        shifts = [self._delays_s.get(n, common) * rate_Hz for n in range(1, 9)]
        depth = int(np.ceil(max(shifts))) + 1
        first = inputs[:, :1] if self._history.shape[1] == 0 else self._history[:, :1]
        missing = max(0, depth - self._history.shape[1])
        whole = np.concatenate((np.repeat(first, missing, axis=1), self._history, inputs), axis=1)
        whole = whole[:, -(inputs.shape[1] + depth) :]
        self._history = whole[:, -depth:]
        places = np.arange(inputs.shape[1]) + depth
        grid = np.arange(whole.shape[1])
        return np.array(
            [np.interp(places - shift, grid, row) for shift, row in zip(shifts, whole, strict=True)]
        )


def codes_of(inputs: NDArray[np.float64]) -> Codes:
    """Return the converter's signed 24-bit codes of normalised inputs."""
    codes = np.round(inputs * CODE_PER_RANGE)
    return np.clip(codes, LOWEST_CODE, HIGHEST_CODE).astype(np.int64)
