"""Speed and acceleration from a measured history of the crank angle.

An encoder gives whole counts, whose differences are useless as accelerations. The crank of a
running rig moves as a steady turn, perhaps a steady gain of speed, and a few harmonics of the
turn; these are fitted by least squares and differentiated exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from model.errors import ModelError

Array = NDArray[np.float64]

HARMONICS = 12
FEWEST_SAMPLES = 8
MOST_BLOCKS = 2048
RIPPLE_PRIOR = 0.05
"""Expected amplitude (rad) of the first harmonic; harmonic k is expected to be k^3 times less."""
SIGNIFICANT = 6.0
"""Harmonics with less than this many times the variance of a coefficient are noise (5 % odds)."""
TREND_SIGNIFICANT = 4.0
OUTLIER = 10.0
LEAST_TURN = 0.25
"""Half the turn (rad) below which there is nothing periodic to fit."""
LEAST_GAIN = 0.005
"""Gain of speed over half the history above which the harmonics follow the changing speed."""


@dataclass(frozen=True, slots=True)
class AngleHistory:
    """Hold a smooth history: angle (rad), speed (rad/s), acceleration (rad/s^2) at each time.

    ``noise`` is the standard deviation of one measured angle about the fit (rad), as estimated
    from the residuals; for an encoder of n counts a turn expect 2 pi / n / sqrt(12).
    """

    angle: Array
    speed: Array
    acceleration: Array
    noise: float


def motion_from_history(
    time: ArrayLike, angle: ArrayLike, harmonics: int = HARMONICS
) -> tuple[Array, Array]:
    """Return crank speed (rad/s) and acceleration (rad/s^2) at each measured time.

    time: s, strictly increasing, shape (n,), n >= 8; best one revolution or more. angle: rad,
    shape (n,); may be whole encoder counts times the count's angle and may restart at the index.
    Raises ModelError for what cannot be differentiated.
    """
    history = smooth_history(time, angle, harmonics)
    return history.speed, history.acceleration


def smooth_history(time: ArrayLike, angle: ArrayLike, harmonics: int = HARMONICS) -> AngleHistory:
    """Fit a measured angle history; see ``motion_from_history`` for arguments and errors."""
    moments, turned = _checked(time, angle)
    middle, half = 0.5 * (moments[0] + moments[-1]), 0.5 * (moments[-1] - moments[0])
    tau = (moments - middle) / half
    mean_rate = 0.5 * (turned[-1] - turned[0])
    per_block = -(-len(moments) // MOST_BLOCKS)
    taus, angles = _block_means(tau, per_block), _block_means(turned, per_block)
    most = min(harmonics, len(taus) // 8, int(len(taus) * np.pi / max(2.0 * abs(mean_rate), 1.0)))
    orders = np.arange(1, most + 1) if abs(mean_rate) > LEAST_TURN else np.arange(0)
    phase = np.array([0.0, mean_rate, 0.0])
    values, noise = _solve(_design(taus, phase, len(orders)), angles, orders)
    if abs(values[2]) > LEAST_GAIN * abs(values[1]) and len(orders):
        phase[1:] = values[1:3]
        values, noise = _solve(_design(taus, phase, len(orders)), angles, orders)
    waves = values[3 : 3 + len(orders)] - 1j * values[3 + len(orders) :]
    width = per_block * float(np.median(np.diff(tau))) * mean_rate
    waves = waves / np.sinc(orders * (width / (2.0 * np.pi)))
    angle, slope, bend = _evaluate(tau, phase, values[:3], waves)
    return AngleHistory(angle, slope / half, bend / half**2, noise * float(np.sqrt(per_block)))


def _checked(time: ArrayLike, angle: ArrayLike) -> tuple[Array, Array]:
    """Return both as float64 arrays, the angle unwrapped."""
    moments, turned = np.asarray(time, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    if moments.ndim != 1 or moments.shape != turned.shape:
        shapes = f"{moments.shape} for {turned.shape} angles"
        raise ModelError("time", shapes, "give one time for each angle")
    if len(moments) < FEWEST_SAMPLES:
        raise ModelError("samples", len(moments), f"give at least {FEWEST_SAMPLES}")
    if not (np.isfinite(moments).all() and np.isfinite(turned).all()):
        raise ModelError("angle history", "not finite", "give finite numbers only")
    steps = np.diff(moments)
    if steps.min() <= 0.0:
        where = int(steps.argmin()) + 1
        raise ModelError(
            "time", float(moments[where]), f"sample {where} is not later than the one before", "s"
        )
    return moments, np.unwrap(turned)


def _block_means(values: Array, size: int) -> Array:
    """Return the means of whole blocks; the rest after the last whole block is left out."""
    if size == 1:
        return values
    whole = len(values) // size * size
    return values[:whole].reshape(-1, size).mean(axis=1)


def _design(tau: Array, phase: Array, count: int) -> Array:
    """Return 1, tau, tau^2, then cos and sin of k times the phase polynomial, one a row."""
    powers = np.empty((count, len(tau)), dtype=np.complex128)
    if count:
        powers[0] = np.exp(1j * _polynomial(phase, tau))
    for k in range(1, count):
        powers[k] = powers[k - 1] * powers[0]
    return np.vstack([np.ones_like(tau), tau, tau * tau, powers.real, powers.imag])


def _polynomial(coefficients: Array, tau: Array) -> Array:
    """Return the quadratic of tau."""
    result: Array = coefficients[0] + tau * (coefficients[1] + tau * coefficients[2])
    return result


def _solve(design: Array, angles: Array, orders: NDArray[np.int_]) -> tuple[Array, float]:
    """Return the coefficients and the noise; outliers count once, weak terms are taken out."""
    values, noise = _regularised(design, angles, orders)
    residual = np.abs(angles - values @ design)
    kept = residual <= OUTLIER * max(float(np.median(residual)), 1e-12)
    if kept.mean() < 1.0 and kept.mean() > 0.8:
        return _regularised(design[:, kept], angles[kept], orders)
    return values, noise


def _regularised(design: Array, angles: Array, orders: NDArray[np.int_]) -> tuple[Array, float]:
    """Solve with the noise that the residuals show and the prior that ripple dies out with k^3."""
    count = len(orders)
    gram, right = design @ design.T, design @ angles
    degrees = max(len(angles) - len(gram), 1)
    free = np.linalg.lstsq(gram, right, rcond=1e-15)[0]
    noise = float(np.sqrt(np.sum((angles - free @ design) ** 2) / degrees))
    prior = np.zeros(len(gram))
    prior[3:] = np.tile((noise * orders**3.0 / RIPPLE_PRIOR) ** 2, 2)
    values, spread = _ridge(gram, right, prior, noise)
    if abs(values[2]) < TREND_SIGNIFICANT * spread[2]:
        use = np.arange(len(gram)) != 2
        values[2] = 0.0
        values[use], spread[use] = _ridge(gram[np.ix_(use, use)], right[use], prior[use], noise)
    power = values[3 : 3 + count] ** 2 + values[3 + count :] ** 2
    variance = 0.5 * (spread[3 : 3 + count] ** 2 + spread[3 + count :] ** 2)
    keep = np.maximum(0.0, 1.0 - SIGNIFICANT * variance / np.maximum(power, 1e-300))
    values[3:] *= np.tile(keep, 2)
    return values, noise


def _ridge(gram: Array, right: Array, prior: Array, noise: float) -> tuple[Array, Array]:
    """Return the coefficients and their standard deviations."""
    inverse = np.linalg.pinv(gram + np.diag(prior), rcond=1e-15, hermitian=True)
    return inverse @ right, noise * np.sqrt(np.maximum(np.diag(inverse), 0.0))


def _evaluate(
    tau: Array, phase: Array, trend: Array, waves: NDArray[np.complex128]
) -> tuple[Array, Array, Array]:
    """Return the fit and its first two derivatives with respect to tau."""
    angle = _polynomial(trend, tau)
    slope = trend[1] + 2.0 * trend[2] * tau
    bend = np.full_like(tau, 2.0 * trend[2])
    if np.any(waves):
        turn = np.exp(1j * _polynomial(phase, tau))
        rate, gain = phase[1] + 2.0 * phase[2] * tau, 2.0 * phase[2]
        orders = np.arange(1, len(waves) + 1)
        first = _horner(turn, 1j * orders * waves)
        angle += _horner(turn, waves)
        slope += first * rate
        bend += first * gain - _horner(turn, orders**2 * waves) * rate**2
    return angle, slope, bend


def _horner(turn: NDArray[np.complex128], factors: NDArray[np.complex128]) -> Array:
    """Return the real part of sum factors[k] turn^(k + 1)."""
    total = np.zeros_like(turn)
    for factor in factors[::-1]:
        total += factor
        total *= turn
    return total.real
