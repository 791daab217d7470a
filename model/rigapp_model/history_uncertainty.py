"""The uncertainty of speed and acceleration fitted to a measured history of the angle.

The fit has a few harmonics of the revolution. The residuals are searched for motion up to
``HIGHEST_ORDER``: significant orders are motion that the fit does not follow; motion of the other
orders may be hidden by the resolution of the counts.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import maximum_filter1d, median_filter, uniform_filter1d

from rigapp_model.history import (
    COUNTING_DEVIATION,
    COUNTING_SPAN,
    AngleHistory,
    quantum_of,
)
from rigapp_model.recurrent_motion import HIGHEST_ORDER, RecurrentMotion

Array = NDArray[np.float64]

UNSEEN_COUNTS = 2.5
"""Number of counts of a history that undetected motion may change."""
SIGNIFICANT_PAIR, SIGNIFICANT_SINGLE = 10.0, 25.0
"""Power over that of the noise from which two orders, or a single one, are motion (odds of 1 in
100,000 by chance)."""
BROAD = 7.0
"""Standard deviations above the noise from which the mean power is motion."""
EXPLAINED = 0.06
"""Counts by which the measured ones may deviate from a fit that explains them."""
ALIKE = 1.1
"""Ratio of standard deviations up to which two motions explain angles without counts equally."""
BETWEEN = 1.0 / np.sqrt(24.0)
"""RMS of a wave with a random amplitude within a span of one."""
SPIKE = 3.0
"""Counts, or standard deviations, by which a faulty sample differs from its neighbours."""
AVERAGED = 9
"""Neighbours whose mean shows an error of the fit: a hundredth of a turn."""
COUNTED = 0.6
"""Error of that mean, in counts, where a constant speed beats slowly with the counts."""
BANDWIDTH = 3
"""Highest order of a sudden change, as a multiple of the highest order searched."""
LINE_STEPS, LINE_RESOLUTION = 60, 1e-12
"""Maximum number of slopes that are tried for a line (ten at most were needed), and its resolution
in counts."""


@dataclass(frozen=True, slots=True, eq=False)
class MotionUncertainty:
    """Standard uncertainties at each time: angle (rad), speed (rad/s), acceleration (rad/s^2).

    unfollowed: largest acceleration (rad/s^2) in the angle that is not in the fit; 0 if none
    exceeds the noise. recurrent: recurrent motion, including this revolution. history: the motion
    to which these apply: the fit, or the recurrent motion if that explains the angle as well.
    lasting: fraction of the acceleration's deviation that is the same in each revolution.
    """

    angle: Array
    speed: Array
    acceleration: Array
    unfollowed: float
    recurrent: RecurrentMotion
    history: AngleHistory
    lasting: float = 1.0


NOTHING_YET = RecurrentMotion()


def motion_uncertainty(
    time: ArrayLike,
    angle: ArrayLike,
    history: AngleHistory,
    before: RecurrentMotion = NOTHING_YET,
) -> MotionUncertainty:
    """Return the uncertainty of a fitted history; arguments as for ``smooth_history``.

    before: recurrent motion of earlier revolutions, which includes what one fit does not resolve.
    """
    times_s = np.asarray(time, dtype=np.float64)
    unwrapped = np.unwrap(np.asarray(angle, dtype=np.float64))
    quantum = quantum_of(unwrapped)
    size = len(times_s)
    even = np.linspace(times_s[0], times_s[-1], size)
    by_chance = max(quantum / np.sqrt(12.0), 0.0 if quantum else history.noise) ** 2 / size
    recurrent, known = before.after(times_s, unwrapped, history.angle, by_chance)
    smooth, speed_error, acceleration_error = history.angle, np.zeros(size), np.zeros(size)
    lasting = 1.0
    if known is not None:
        smooth = known.angle
        if _explains(unwrapped, smooth, history, quantum):
            history = AngleHistory(smooth, known.speed, known.acceleration, history.noise)
            lasting = known.lasting
        speed_error = known.speed - history.speed
        acceleration_error = known.acceleration - history.acceleration
    residual, slack = _residual_motion(unwrapped, smooth, quantum)
    beyond = np.interp(even, times_s, residual)
    turns = max(abs(history.angle[-1] - history.angle[0]) / (2.0 * np.pi), 1e-9)
    rate = 2.0 * np.pi / (times_s[-1] - times_s[0])
    spectrum = np.fft.rfft(beyond - beyond.mean()) / size
    power = np.abs(spectrum) ** 2
    top = min(len(power) // 3, max(2, round(HIGHEST_ORDER * turns)))
    least = (UNSEEN_COUNTS * quantum / size) ** 2
    noise = max(_noise_power(power[top:]), least, np.finfo(float).tiny)
    usual = np.full(len(power), noise)
    if known is not None:
        some = min(top, HIGHEST_ORDER)
        usual[1 : some + 1] = np.maximum(noise, known.scatter[:some])
    seen = np.where(_significant_orders(power / usual, top), spectrum, 0.0)
    orders = rate * np.arange(1, top + 1)
    hidden = [
        float(
            np.hypot(
                np.sqrt(2.0 * noise * np.sum(orders ** (2 * times))),
                slack * BETWEEN * np.sqrt(np.mean(orders ** (2 * times))),
            )
        )
        for times in (1, 2)
    ]
    if known is not None:
        in_common = known.hidden_speed, known.hidden_acceleration
        hidden = [
            min(alone, float(np.hypot(np.sqrt(known.again) * alone, common)))
            for alone, common in zip(hidden, in_common, strict=True)
        ]
    speed, acceleration = (
        np.hypot(_envelope(_derived(seen, rate, size, times), top), hidden[times - 1])
        for times in (1, 2)
    )
    moved = np.abs(_derived(seen, rate, size, 2))
    most = float(moved.max())
    if most > 0.0:
        sudden = _envelope(moved / most, top) * _sudden_acceleration(seen, top, rate)
        acceleration = np.hypot(acceleration, sudden)
        most = float(np.hypot(most, sudden.max()))
    return MotionUncertainty(
        angle=_angle_uncertainty(unwrapped - history.angle, history.noise, quantum),
        speed=np.hypot(np.interp(times_s, even, speed), speed_error),
        acceleration=np.hypot(np.interp(times_s, even, acceleration), acceleration_error),
        unfollowed=most,
        recurrent=recurrent,
        history=history,
        lasting=lasting,
    )


def _explains(unwrapped: Array, known: Array, history: AngleHistory, quantum: float) -> bool:
    """Return whether a known motion explains the angles as well as the fit does.

    Counts: by the criterion of the fit. Other angles: the standard deviation must not exceed
    ``ALIKE`` times that of the fit.
    """
    residual = unwrapped - known
    if quantum > 0.0:
        residual = (residual - _line_of_least_span(residual, quantum)) / quantum
        return (
            float(np.ptp(residual)) <= COUNTING_SPAN
            and float(np.std(residual)) <= COUNTING_DEVIATION
        )
    return float(np.std(residual)) <= ALIKE * float(np.std(unwrapped - history.angle))


def _angle_uncertainty(residual: Array, noise: float, quantum: float) -> Array:
    """Return the standard uncertainty of a fitted angle, rad, from the residuals.

    Each measured angle is correct to one count: where neighbours deviate together by more, as at
    the index in a turn with a change of speed, the fit is wrong there.
    """
    known = max(noise, quantum / np.sqrt(12.0))
    local_mean = np.abs(uniform_filter1d(residual, AVERAGED, mode="nearest"))
    chance = max(COUNTED * quantum, 2.0 * noise / np.sqrt(AVERAGED))
    return np.asarray(np.hypot(known, np.where(local_mean > chance, local_mean, 0.0)))


def _significant_orders(ratio: Array, top: int) -> NDArray[np.bool_]:
    """Return flags of the orders that are motion, from their power over that of the noise."""
    slow = ratio[1 : top + 1]
    significant = slow > SIGNIFICANT_PAIR
    if np.count_nonzero(significant) < 2 and slow.max() < SIGNIFICANT_SINGLE:
        significant[:] = False
    if np.minimum(slow, SIGNIFICANT_PAIR).mean() > 1.0 + BROAD / np.sqrt(len(slow)):
        significant |= slow > 1.0
    return np.concatenate([[False], significant, np.zeros(len(ratio) - top - 1, dtype=np.bool_)])


def _residual_motion(unwrapped: Array, smooth: Array, quantum: float) -> tuple[Array, float]:
    """Return the residual angle without spikes, and the angle that may be hidden.

    Counts are compared with those computed from the fit: the difference is motion, not counting.
    If all samples lie at the same few angles within a count, motion between these changes none.
    """
    residual = unwrapped - smooth
    if quantum > 0.0:
        straight = residual - _line_of_least_span(residual, quantum)
        span = float(np.ptp(straight))
        if span < (1.0 + 2.0 * EXPLAINED) * quantum:
            return np.zeros_like(residual), max(abs(quantum - span), _widest_gap(straight, quantum))
        middle = smooth - unwrapped[0] + 0.5 * quantum * np.sign(smooth[-1] - smooth[0])
        residual = unwrapped - unwrapped[0] - quantum * np.floor(middle / quantum)
    near = median_filter(residual, 5, mode="nearest")
    spikes = np.abs(residual - near) > SPIKE * max(quantum, float(residual.std()))
    return np.where(spikes, near, residual), 0.0


class _Span(NamedTuple):
    """Span of the residuals about a line of a slope, and how it changes with the slope."""

    slope: float
    span: float
    change: float


def _line_of_least_span(residual: Array, quantum: float) -> Array:
    """Return the line with the least span of residuals; one count at a constant speed.

    The span is a convex, piecewise linear function of the slope: the next slope is where the lines
    that touch it at both ends intersect, so that some six spans find the minimum itself.
    """
    tau = np.linspace(-1.0, 1.0, len(residual))

    def span_at(slope: float) -> _Span:
        straight = residual - slope * tau
        top, bottom = straight.argmax(), straight.argmin()
        span, change = straight[top] - straight[bottom], tau[bottom] - tau[top]
        return _Span(slope, float(span), float(change))

    low, high = span_at(-quantum), span_at(quantum)
    best = low if low.span <= high.span else high
    for _ in range(LINE_STEPS):
        if low.change >= 0.0 or high.change <= 0.0:
            break
        slope = high.span - low.span + low.change * low.slope - high.change * high.slope
        slope /= low.change - high.change
        bound = low.span + low.change * (slope - low.slope)
        best = span_at(slope)
        if best.span <= bound + LINE_RESOLUTION * quantum:
            break
        low, high = (best, high) if best.change < 0.0 else (low, best)
    return np.asarray(best.slope * tau)


def _widest_gap(residual: Array, quantum: float) -> float:
    """Return the widest angle without a sample within a count."""
    positions = np.sort(np.mod(residual, quantum))
    return float(np.max(np.diff(positions, append=positions[0] + quantum)))


def _noise_power(power: Array) -> float:
    """Return the mean power per order of white noise, from the median, robust against lines."""
    return float(np.median(power) / np.log(2.0)) if len(power) else 0.0


def _derived(spectrum: Array, rate: float, size: int, times: int) -> Array:
    orders = np.arange(len(spectrum))
    return np.asarray(np.fft.irfft(spectrum * (1j * rate * orders) ** times, size) * size)


def _envelope(values: Array, top: int) -> Array:
    """Return the largest magnitude within half a period of the highest order on either side."""
    reach = max(1, len(values) // (2 * top))
    return np.asarray(maximum_filter1d(np.abs(values), 2 * reach + 1, mode="wrap"))


def _sudden_acceleration(seen: Array, top: int, rate: float) -> float:
    """Return the acceleration of a sudden change in the orders above the highest.

    An instantaneous change has equal accelerations in all orders; a single line is none.
    """
    orders = np.arange(1, top + 1)
    each = np.abs(seen[orders]) * (rate * orders) ** 2
    line = float(np.max(each**2) / np.sum(each**2))
    typical = float(np.median(each[2 * top // 3 :]))
    return max(0.0, 1.0 - 2.0 * line) * 2.0 * typical * (min(BANDWIDTH * top, len(seen) - 1) - top)
