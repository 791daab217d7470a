"""How uncertain are speed and acceleration that were fitted to a measured history of the angle?

The fit has a few harmonics of the turn. What the measured angle still shows beyond it is looked for
up to ``HIGHEST_ORDER``; what stands out is motion that the fit does not follow, and what does not
stand out could still hide in the counts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import maximum_filter1d, median_filter

from rigapp_model.history import AngleHistory, quantum_of

Array = NDArray[np.float64]

HIGHEST_ORDER = 40
"""Orders of the turn up to which motion is looked for, and may hide in the counts."""
UNSEEN_COUNTS = 2.5
"""Counts of a history that a motion may change without being told from none."""
STANDS_OUT, FAR = 10.0, 25.0
"""An order with so many times the power of the noise is motion: two of the first, one of the second
(odds of 1 in 100,000 by chance)."""
BROAD = 7.0
"""Standard deviations by which the mean power must exceed the noise's to be motion."""
EXPLAINED = 0.06
"""Counts by which a fit may miss those that were measured and still explain them."""
BETWEEN = 1.0 / np.sqrt(24.0)
"""RMS of a wave of any amplitude that has room in a span of one."""
SPIKE = 3.0
"""Counts, or standard deviations, by which one sample is off its neighbours by a fault."""
REACH = 3
"""A sudden change has orders beyond the highest; it is taken to reach so many times as far."""


@dataclass(frozen=True, slots=True, eq=False)
class MotionUncertainty:
    """Hold standard uncertainties at each time: angle (rad), speed (rad/s), acceleration (rad/s^2).

    unfollowed: the largest acceleration (rad/s^2) that the angle shows beyond the fit; 0 when none
    stands out of the noise.
    """

    angle: float
    speed: Array
    acceleration: Array
    unfollowed: float


def motion_uncertainty(
    time: ArrayLike, angle: ArrayLike, history: AngleHistory
) -> MotionUncertainty:
    """Return how uncertain a fitted history is; arguments as ``smooth_history`` took them."""
    moments = np.asarray(time, dtype=np.float64)
    turned = np.unwrap(np.asarray(angle, dtype=np.float64))
    quantum = quantum_of(turned)
    size = len(moments)
    even = np.linspace(moments[0], moments[-1], size)
    left, slack = _beyond(turned, history.angle, quantum)
    beyond = np.interp(even, moments, left)
    turns = max(abs(history.angle[-1] - history.angle[0]) / (2.0 * np.pi), 1e-9)
    rate = 2.0 * np.pi / (moments[-1] - moments[0])
    spectrum = np.fft.rfft(beyond - beyond.mean()) / size
    power = np.abs(spectrum) ** 2
    top = min(len(power) // 3, max(2, round(HIGHEST_ORDER * turns)))
    least = (UNSEEN_COUNTS * quantum / size) ** 2
    noise = max(_noise_power(power[top:]), least, np.finfo(float).tiny)
    seen = np.where(_stands_out(power / noise, top), spectrum, 0.0)
    orders = rate * np.arange(1, top + 1)
    speed, acceleration = (
        np.hypot(
            _envelope(_derived(seen, rate, size, times), top),
            np.hypot(
                np.sqrt(2.0 * noise * np.sum(orders ** (2 * times))),
                slack * BETWEEN * np.sqrt(np.mean(orders ** (2 * times))),
            ),
        )
        for times in (1, 2)
    )
    moved = np.abs(_derived(seen, rate, size, 2))
    most = float(moved.max())
    if most > 0.0:
        sudden = _envelope(moved / most, top) * _faster(seen, top, rate)
        acceleration = np.hypot(acceleration, sudden)
        most = float(np.hypot(most, sudden.max()))
    return MotionUncertainty(
        angle=max(history.noise, quantum / np.sqrt(12.0)),
        speed=np.interp(moments, even, speed),
        acceleration=np.interp(moments, even, acceleration),
        unfollowed=most,
    )


def _stands_out(ratio: Array, top: int) -> NDArray[np.bool_]:
    """Tell which orders are motion, from their power over the noise's."""
    slow = ratio[1 : top + 1]
    standing = slow > STANDS_OUT
    if np.count_nonzero(standing) < 2 and slow.max() < FAR:
        standing[:] = False
    if np.minimum(slow, STANDS_OUT).mean() > 1.0 + BROAD / np.sqrt(len(slow)):
        standing |= slow > 1.0
    return np.concatenate([[False], standing, np.zeros(len(ratio) - top - 1, dtype=np.bool_)])


def _beyond(turned: Array, smooth: Array, quantum: float) -> tuple[Array, float]:
    """Return what the angle shows beyond the fit, spikes left out, and how much any may hide.

    Counts are compared with those that the fit would give: what is left is motion, not counting.
    Where a few angles between the counts come again and again, motion between them changes none.
    """
    left = turned - smooth
    if quantum > 0.0:
        straight = left - _line_of_least_span(left, quantum)
        span = float(np.ptp(straight))
        if span < (1.0 + 2.0 * EXPLAINED) * quantum:
            return np.zeros_like(left), max(abs(quantum - span), _room(straight, quantum))
        middle = smooth - turned[0] + 0.5 * quantum * np.sign(smooth[-1] - smooth[0])
        left = turned - turned[0] - quantum * np.floor(middle / quantum)
    near = median_filter(left, 5, mode="nearest")
    spikes = np.abs(left - near) > SPIKE * max(quantum, float(left.std()))
    return np.where(spikes, near, left), 0.0


def _line_of_least_span(left: Array, quantum: float) -> Array:
    """Return the line about which least is left: counting a steady turn leaves one count."""
    tau = np.linspace(-1.0, 1.0, len(left))
    low, high = -quantum, quantum
    for _ in range(40):
        one, two = low + (high - low) / 3.0, high - (high - low) / 3.0
        if np.ptp(left - one * tau) < np.ptp(left - two * tau):
            high = two
        else:
            low = one
    return np.asarray(0.5 * (low + high) * tau)


def _room(left: Array, quantum: float) -> float:
    """Return the widest angle within a count at which no sample lies."""
    places = np.sort(np.mod(left, quantum))
    return float(np.max(np.diff(places, append=places[0] + quantum)))


def _noise_power(power: Array) -> float:
    """Return the mean power of one order of white noise, by the median, which lines do not move."""
    return float(np.median(power) / np.log(2.0)) if len(power) else 0.0


def _derived(spectrum: Array, rate: float, size: int, times: int) -> Array:
    orders = np.arange(len(spectrum))
    return np.asarray(np.fft.irfft(spectrum * (1j * rate * orders) ** times, size) * size)


def _envelope(values: Array, top: int) -> Array:
    """Return the largest size within half a period of the highest order on either side."""
    reach = max(1, len(values) // (2 * top))
    return np.asarray(maximum_filter1d(np.abs(values), 2 * reach + 1, mode="wrap"))


def _faster(seen: Array, top: int, rate: float) -> float:
    """Return the acceleration of a sudden change in the orders beyond the highest.

    A change within no time has the same acceleration in every order; a single line is no change.
    """
    orders = np.arange(1, top + 1)
    each = np.abs(seen[orders]) * (rate * orders) ** 2
    line = float(np.max(each**2) / np.sum(each**2))
    one = float(np.median(each[2 * top // 3 :]))
    return max(0.0, 1.0 - 2.0 * line) * 2.0 * one * (min(REACH * top, len(seen) - 1) - top)
