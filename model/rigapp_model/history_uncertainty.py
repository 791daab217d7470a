"""The uncertainty of speed and acceleration fitted to a measured history of the angle.

The fit has a few harmonics of the turn. The residuals are searched for motion up to
``HIGHEST_ORDER``; orders that stand out are motion that the fit does not follow, and others could
still hide in the counts.
"""

from __future__ import annotations

from dataclasses import dataclass

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
"""Counts of a history that a motion may change without being detected."""
STANDS_OUT, FAR = 10.0, 25.0
"""Ratios of power to noise from which an order is motion: two of the first, one of the second (odds
of 1 in 100,000 by chance)."""
BROAD = 7.0
"""Standard deviations by which the mean power must exceed the noise's to be motion."""
EXPLAINED = 0.06
"""Counts by which a fit may miss those that were measured and still explain them."""
ALIKE = 1.1
"""Ratio of deviations up to which two motions explain angles that are no counts equally well."""
BETWEEN = 1.0 / np.sqrt(24.0)
"""RMS of a wave of any amplitude that fits in a span of one."""
SPIKE = 3.0
"""Counts, or standard deviations, by which a faulty sample is off its neighbours."""
TOGETHER = 9
"""Neighbours whose mean shows whether the fit is off: a hundredth of a turn."""
COUNTED = 0.6
"""Counts by which that mean is off where a steady turn beats slowly with the counts."""
REACH = 3
"""Factor for a sudden change, which has orders beyond the highest."""


@dataclass(frozen=True, slots=True, eq=False)
class MotionUncertainty:
    """Standard uncertainties at each time: angle (rad), speed (rad/s), acceleration (rad/s^2).

    unfollowed: the largest acceleration (rad/s^2) that the angle shows beyond the fit; 0 when none
    exceeds the noise. recurrent: recurrent motion, with this revolution. history: the motion that
    these belong to: the fit, or the recurrent motion where that explains the angle as well.
    lasting: part of the acceleration's deviation that is the same in each revolution.
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

    before: recurrent motion of earlier revolutions, which shows what the fit to one misses.
    """
    moments = np.asarray(time, dtype=np.float64)
    turned = np.unwrap(np.asarray(angle, dtype=np.float64))
    quantum = quantum_of(turned)
    size = len(moments)
    even = np.linspace(moments[0], moments[-1], size)
    by_chance = max(quantum / np.sqrt(12.0), 0.0 if quantum else history.noise) ** 2 / size
    recurrent, known = before.after(moments, turned, history.angle, by_chance)
    smooth, slower, unpushed = history.angle, np.zeros(size), np.zeros(size)
    lasting = 1.0
    if known is not None:
        smooth = known.angle
        if _explains(turned, smooth, history, quantum):
            history = AngleHistory(smooth, known.speed, known.acceleration, history.noise)
            lasting = known.lasting
        slower = known.speed - history.speed
        unpushed = known.acceleration - history.acceleration
    left, slack = _beyond(turned, smooth, quantum)
    beyond = np.interp(even, moments, left)
    turns = max(abs(history.angle[-1] - history.angle[0]) / (2.0 * np.pi), 1e-9)
    rate = 2.0 * np.pi / (moments[-1] - moments[0])
    spectrum = np.fft.rfft(beyond - beyond.mean()) / size
    power = np.abs(spectrum) ** 2
    top = min(len(power) // 3, max(2, round(HIGHEST_ORDER * turns)))
    least = (UNSEEN_COUNTS * quantum / size) ** 2
    noise = max(_noise_power(power[top:]), least, np.finfo(float).tiny)
    usual = np.full(len(power), noise)
    if known is not None:
        some = min(top, HIGHEST_ORDER)
        usual[1 : some + 1] = np.maximum(noise, known.scatter[:some])
    seen = np.where(_stands_out(power / usual, top), spectrum, 0.0)
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
        sudden = _envelope(moved / most, top) * _faster(seen, top, rate)
        acceleration = np.hypot(acceleration, sudden)
        most = float(np.hypot(most, sudden.max()))
    return MotionUncertainty(
        angle=_of_angle(turned - history.angle, history.noise, quantum),
        speed=np.hypot(np.interp(moments, even, speed), slower),
        acceleration=np.hypot(np.interp(moments, even, acceleration), unpushed),
        unfollowed=most,
        recurrent=recurrent,
        history=history,
        lasting=lasting,
    )


def _explains(turned: Array, known: Array, history: AngleHistory, quantum: float) -> bool:
    """Return whether a known motion explains the angles as well as the fit does.

    For counts by the criterion of the fit itself; else the deviation from it must not exceed that
    from the fit, corrected for its terms.
    """
    left = turned - known
    if quantum > 0.0:
        left = (left - _line_of_least_span(left, quantum)) / quantum
        return float(np.ptp(left)) <= COUNTING_SPAN and float(np.std(left)) <= COUNTING_DEVIATION
    return float(np.std(left)) <= ALIKE * float(np.std(turned - history.angle))


def _of_angle(left: Array, noise: float, quantum: float) -> Array:
    """Return the standard uncertainty of a fitted angle, rad, from the residuals.

    Each measured angle is right to a count: where several together are off by more, at the seam of
    a turn with a change of speed, the fit is off there.
    """
    known = max(noise, quantum / np.sqrt(12.0))
    near = np.abs(uniform_filter1d(left, TOGETHER, mode="nearest"))
    chance = max(COUNTED * quantum, 2.0 * noise / np.sqrt(TOGETHER))
    return np.asarray(np.hypot(known, np.where(near > chance, near, 0.0)))


def _stands_out(ratio: Array, top: int) -> NDArray[np.bool_]:
    """Return which orders are motion, from their power over the noise's."""
    slow = ratio[1 : top + 1]
    standing = slow > STANDS_OUT
    if np.count_nonzero(standing) < 2 and slow.max() < FAR:
        standing[:] = False
    if np.minimum(slow, STANDS_OUT).mean() > 1.0 + BROAD / np.sqrt(len(slow)):
        standing |= slow > 1.0
    return np.concatenate([[False], standing, np.zeros(len(ratio) - top - 1, dtype=np.bool_)])


def _beyond(turned: Array, smooth: Array, quantum: float) -> tuple[Array, float]:
    """Return the angle beyond the fit, without spikes, and how much may be hidden.

    Counts are compared with those that the fit would give: the rest is motion, not counting. Where
    the same few angles between the counts recur, motion between them changes none.
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
    """Return the line with the least span of residuals: counting a steady turn leaves one count."""
    tau = np.linspace(-1.0, 1.0, len(left))
    low, high = -quantum, quantum
    for _ in range(40):
        lower, upper = low + (high - low) / 3.0, high - (high - low) / 3.0
        if np.ptp(left - lower * tau) < np.ptp(left - upper * tau):
            high = upper
        else:
            low = lower
    return np.asarray(0.5 * (low + high) * tau)


def _room(left: Array, quantum: float) -> float:
    """Return the widest angle within a count without a sample."""
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
    typical = float(np.median(each[2 * top // 3 :]))
    return max(0.0, 1.0 - 2.0 * line) * 2.0 * typical * (min(REACH * top, len(seen) - 1) - top)
