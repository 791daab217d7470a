"""Speed and acceleration from a measured history of the crank angle.

An encoder returns integer counts, whose second differences are useless as accelerations. The crank
of a running rig turns at constant speed, perhaps with constant acceleration and a few harmonics of
the revolution; these are fitted by least squares and differentiated analytically.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import float64, types
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.compiled import njit
from rigapp_model.errors import ModelError

# Kernels with the sums of the angle fit. The linear algebra library would use threads that wait
# for each other: a hundred times slower on a busy machine.

MATRIX = float64[:, ::1]
ROW = float64[::1]
READ_ROW = types.Array(float64, 1, "C", readonly=True)
DEPENDENT = 1e-14
"""Pivot (relative) below which a column counts as linearly dependent on the others."""


@njit(types.Tuple((MATRIX, ROW))(MATRIX, ROW), cache=True, fastmath={"reassoc"})
def normal_equations(design, values):  # type: ignore[no-untyped-def]
    """Return the Gram matrix of the design's rows (m, n) and their products with values (n,)."""
    count, size = design.shape
    gram, right = np.empty((count, count)), np.empty(count)
    for i in range(count):
        for j in range(i + 1):
            total = 0.0
            for k in range(size):
                total += design[i, k] * design[j, k]
            gram[i, j] = gram[j, i] = total
        total = 0.0
        for k in range(size):
            total += design[i, k] * values[k]
        right[i] = total
    return gram, right


@njit(MATRIX(MATRIX), cache=True)
def inverse(matrix):  # type: ignore[no-untyped-def]
    """Return the inverse of a symmetric, positive matrix; zeros for a dependent unknown."""
    count = matrix.shape[0]
    work = matrix.copy()
    scale = np.empty(count)
    for i in range(count):
        scale[i] = 1.0 / math.sqrt(work[i, i]) if work[i, i] > 0.0 else 0.0
    for i in range(count):
        for j in range(count):
            work[i, j] *= scale[i] * scale[j]
    used = np.zeros(count)
    for k in range(count):
        pivot = work[k, k]
        if pivot < DEPENDENT:
            continue
        used[k] = 1.0
        for i in range(count):
            if i != k:
                factor = work[i, k] / pivot
                for j in range(count):
                    if j != k:
                        work[i, j] -= factor * work[k, j]
                work[i, k] = -factor
        for j in range(count):
            work[k, j] /= pivot
        work[k, k] = 1.0 / pivot
    for i in range(count):
        for j in range(count):
            work[i, j] *= scale[i] * scale[j] * used[i] * used[j]
    return work


@njit(MATRIX(READ_ROW, READ_ROW, READ_ROW, READ_ROW, READ_ROW), cache=True)
def evaluate(tau, phase, trend, cosines, sines):  # type: ignore[no-untyped-def]
    """Return the fit and its first two derivatives at tau (n,), shape (3, n).

    phase, trend: three coefficients of a polynomial; cosines, sines: of k times the phase.
    """
    out = np.empty((3, tau.size))
    gain = 2.0 * phase[2]
    for n in range(tau.size):
        t = tau[n]
        out[0, n] = trend[0] + t * (trend[1] + t * trend[2])
        out[1, n] = trend[1] + 2.0 * t * trend[2]
        out[2, n] = 2.0 * trend[2]
        if cosines.size == 0:
            continue
        angle = phase[0] + t * (phase[1] + t * phase[2])
        rate = phase[1] + gain * t
        c1, s1 = math.cos(angle), math.sin(angle)
        c, s = c1, s1
        wave = first = second = 0.0
        for k in range(cosines.size):
            order = k + 1.0
            along = cosines[k] * c + sines[k] * s
            wave += along
            first += order * (sines[k] * c - cosines[k] * s)
            second -= order * order * along
            c, s = c * c1 - s * s1, s * c1 + c * s1
        out[0, n] += wave
        out[1, n] += first * rate
        out[2, n] += second * rate * rate + first * gain
    return out


Array = NDArray[np.float64]

HARMONICS = 12  # ripple decreases with k^3: the 13th is 2000 times below the first
FEWEST_SAMPLES = 8  # a trend has three unknowns, and must be distinguished from noise
MOST_BLOCKS = 2048  # 170 per period of the 12th harmonic; more only cost time
RIPPLE_PRIOR = 0.05
"""Expected amplitude (rad) of the first harmonic, 5 % ripple of the speed: a loosely tuned drive.

Harmonic k is expected to be k^3 times smaller: equal torques of all harmonics, and some decay.
"""
SIGNIFICANT = 6.0
"""Ratio of a harmonic's power to a coefficient's variance, below which it is noise (5 % odds)."""
TREND_SIGNIFICANT = 4.0  # standard deviations: noise is taken for a run-up with odds of 6e-5
OUTLIER = 10.0  # times the median residual: nearly 7 standard deviations of normal noise
LEAST_RESIDUAL = 1e-12  # rad: below it residuals are rounding, and none is an outlier
FEWEST_KEPT = (
    0.8  # of the samples: if more than a fifth deviate, it is unfitted motion, not outliers
)
SAMPLES_PER_HARMONIC = 8  # two unknowns each: three quarters of the samples determine the noise
RESOLVED = 1e-9  # rad: ten times the rounding of an angle after 1e5 turns
FINEST_COUNT = 1e-5  # rad: 600 000 counts a turn, more than the counter of any rig resolves
WHOLE = 0.01  # counts, deviation from an integer: of a step of 100 with a count known to 1e-4
COUNTING_SPAN, COUNTING_DEVIATION = 1.85, 0.34
"""Residuals about a line due to counting alone: span and standard deviation, in counts.

At most 1.21 and 0.326 in 6000 turns at constant speed, any speed. The limit of the deviation is
5 % above that; that of the span allows an edge error of 0.6 counts, as of encoders, but no count.
"""
LEAST_TURN = 0.25
"""Half the turn (rad) below which no harmonics are fitted.

Below it the first harmonic and the parabola of the trend differ by less than 1.6e-4 rad (x^4 / 24).
"""
LEAST_GAIN = 0.005
"""Quadratic over linear turn above which the harmonics follow the changing speed.

Below it the phase error of the 12th harmonic at the ends of a revolution is 0.2 rad (12 pi / 200).
"""


@dataclass(frozen=True, slots=True)
class AngleHistory:
    """Smooth history: angle (rad), speed (rad/s), acceleration (rad/s^2) at each time.

    ``noise`` is the standard deviation of one measured angle about the fit (rad), estimated from
    the residuals; 2 pi / n / sqrt(12) is expected of an encoder with n counts a turn.
    """

    angle: Array
    speed: Array
    acceleration: Array
    noise: float


def motion_from_history(
    time: ArrayLike, angle: ArrayLike, harmonics: int = HARMONICS
) -> tuple[Array, Array]:
    """Return crank speed (rad/s) and acceleration (rad/s^2) at each measured time.

    time: s, strictly increasing, shape (n,), n >= 8; preferably one revolution or more. angle: rad,
    shape (n,); may be encoder counts times the angle of a count and may restart at the index.
    Raises ModelError for arrays that cannot be differentiated.
    """
    history = smooth_history(time, angle, harmonics)
    return history.speed, history.acceleration


def smooth_history(time: ArrayLike, angle: ArrayLike, harmonics: int = HARMONICS) -> AngleHistory:
    """Fit a measured angle history; see ``motion_from_history`` for arguments and errors."""
    times, unwrapped = _checked(time, angle)
    middle, half = 0.5 * (times[0] + times[-1]), 0.5 * (times[-1] - times[0])
    tau = (times - middle) / half
    mean_rate = 0.5 * (unwrapped[-1] - unwrapped[0])
    per_block = -(-len(times) // MOST_BLOCKS)
    taus, angles = _block_means(tau, per_block), _block_means(unwrapped, per_block)
    most = min(
        harmonics,
        len(taus) // SAMPLES_PER_HARMONIC,
        int(len(taus) * np.pi / max(2.0 * abs(mean_rate), 1.0)),
    )
    orders = np.arange(1, most + 1) if abs(mean_rate) > LEAST_TURN else np.arange(0)
    raw = slice(per_block // 2, len(taus) * per_block, per_block)
    counted = Counted(tau[raw], unwrapped[raw], quantum_of(unwrapped))
    phase = np.array([0.0, mean_rate, 0.0])
    values, noise = _fit(taus, angles, phase, orders, counted)
    if abs(values[2]) > LEAST_GAIN * abs(values[1]) and len(orders):
        phase[1:] = values[1:3]
        values, noise = _fit(taus, angles, phase, orders, counted)
    width = per_block * float(np.median(np.diff(tau))) * mean_rate
    factor = np.sinc(orders * (width / (2.0 * np.pi)))
    cosines, sines = values[3 : 3 + len(orders)] / factor, values[3 + len(orders) :] / factor
    smooth, slope, curvature = evaluate(tau, phase, values[:3].copy(), cosines, sines)
    return AngleHistory(
        smooth, slope / half, curvature / half**2, noise * float(np.sqrt(per_block))
    )


def _checked(time: ArrayLike, angle: ArrayLike) -> tuple[Array, Array]:
    """Validate both; return them as float64 arrays, the angle unwrapped."""
    times, unwrapped = np.asarray(time, dtype=np.float64), np.asarray(angle, dtype=np.float64)
    if times.ndim != 1 or times.shape != unwrapped.shape:
        shapes = say("{} for {} angles", times.shape, unwrapped.shape)
        raise ModelError("time", shapes, say("give one time for each angle"))
    if len(times) < FEWEST_SAMPLES:
        raise ModelError("samples", len(times), say("give at least {}", FEWEST_SAMPLES))
    if not (np.isfinite(times).all() and np.isfinite(unwrapped).all()):
        raise ModelError(say("angle history"), say("not finite"), say("give finite numbers only"))
    steps = np.diff(times)
    if steps.min() <= 0.0:
        where = int(steps.argmin()) + 1
        raise ModelError(
            "time",
            float(times[where]),
            say("sample {} is not later than the one before", where),
            "s",
        )
    return times, np.unwrap(unwrapped)


def _block_means(values: Array, size: int) -> Array:
    """Return the means of complete blocks; samples after the last complete block are dropped."""
    if size == 1:
        return values
    end = len(values) // size * size
    return values[:end].reshape(-1, size).mean(axis=1)


def _design(tau: Array, phase: Array, count: int) -> Array:
    """Return rows with 1, tau, tau^2, then cos and sin of k times the phase polynomial."""
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


@dataclass(frozen=True, slots=True)
class Counted:
    """Individual samples (not means), to decide whether a fit explains the counts."""

    tau: Array
    angle: Array
    quantum: float


def quantum_of(angle: Array) -> float:
    """Return the angle of one count (rad), or 0 if the angles are not integer counts."""
    steps = np.unique(np.rint(np.abs(np.diff(angle)) / RESOLVED)) * RESOLVED
    differences = np.diff(steps, prepend=0.0)
    count = float(differences[differences > 0.0].min(initial=np.inf))
    if not FINEST_COUNT < count < np.inf:
        return 0.0
    counts = steps / count
    return count if np.abs(counts - np.rint(counts)).max() < WHOLE else 0.0


def _fit(
    taus: Array, angles: Array, phase: Array, orders: NDArray[np.int_], counted: Counted
) -> tuple[Array, float]:
    """Return the coefficients of trend and harmonics, and the noise.

    Chooses the simplest motion that explains the counts: few harmonics, no trend. Otherwise counts
    that beat with the sampling at exactly constant speed would be fitted as ripple.
    """
    most = len(orders)
    design = _design(taus, phase, most)
    trend, count = True, most
    if counted.quantum > 0.0:
        single = _design(counted.tau, phase, most)
        gram, right = normal_equations(design, angles)
        for trend, count in [(t, k) for k in range(most + 1) for t in (False, True)]:
            use = _rows(most, count, trend)
            values = inverse(np.ascontiguousarray(gram[np.ix_(use, use)])) @ right[use]
            residual = (counted.angle - values @ single[use]) / counted.quantum
            if np.ptp(residual) <= COUNTING_SPAN and residual.std() <= COUNTING_DEVIATION:
                break
    rows = _rows(most, count, trend=True)
    some, noise = _solve(np.ascontiguousarray(design[rows]), angles, orders[:count], trend)
    values = np.zeros(len(design))
    values[rows] = some
    return values, noise


def _rows(most: int, count: int, trend: bool) -> NDArray[np.int_]:
    """Return the design's rows for a motion with ``count`` harmonics."""
    waves = np.arange(count)
    return np.concatenate([np.arange(3 if trend else 2), 3 + waves, 3 + most + waves])


def _solve(
    design: Array, angles: Array, orders: NDArray[np.int_], trend: bool
) -> tuple[Array, float]:
    """Return the coefficients and the noise; outliers are excluded once, weak terms set to 0."""
    values, noise = _regularised(design, angles, orders, trend)
    residual = np.abs(angles - values @ design)
    kept = residual <= OUTLIER * max(float(np.median(residual)), LEAST_RESIDUAL)
    if FEWEST_KEPT < kept.mean() < 1.0:
        return _regularised(np.ascontiguousarray(design[:, kept]), angles[kept], orders, trend)
    return values, noise


def _regularised(
    design: Array, angles: Array, orders: NDArray[np.int_], trend: bool
) -> tuple[Array, float]:
    """Solve with the noise of the residuals and the prior that ripple decreases with k^3."""
    gram, right = normal_equations(design, angles)
    degrees = max(len(angles) - len(gram), 1)
    free = _ridge(gram, right, np.zeros(len(gram)), 1.0)[0]
    noise = float(np.sqrt(np.sum((angles - free @ design) ** 2) / degrees))
    prior = np.zeros(len(gram))
    prior[3:] = np.tile((noise * orders**3.0 / RIPPLE_PRIOR) ** 2, 2)
    values, spread = _ridge(gram, right, prior, noise)
    if not trend or abs(values[2]) < TREND_SIGNIFICANT * spread[2]:
        use = np.arange(len(gram)) != 2
        values[2] = 0.0
        values[use], spread[use] = _ridge(gram[np.ix_(use, use)], right[use], prior[use], noise)
    cosines, sines = np.split(values[3:], 2)
    variance = 0.5 * np.sum(np.reshape(spread[3:], (2, -1)) ** 2, axis=0)
    power = np.maximum(cosines**2 + sines**2, 1e-300)
    values[3:] *= np.tile(np.maximum(0.0, 1.0 - SIGNIFICANT * variance / power), 2)
    return values, noise


def _ridge(gram: Array, right: Array, prior: Array, noise: float) -> tuple[Array, Array]:
    """Return the coefficients and their standard deviations."""
    inverted = inverse(np.ascontiguousarray(gram + np.diag(prior)))
    return inverted @ right, noise * np.sqrt(np.maximum(np.diag(inverted), 0.0))
