"""Zeros by series, and the weight of the turning parts, from the unloaded readings.

A constant load of all readings is not a gain: signals of a series are taken relative to its
own unloaded readings (ISO 376, ASTM E74). The remaining change of the zeros over the pin's angle is
the weight of the pin outboard of its gauges, which always pulls down: the zeros lie on a
circle. Each run (a series at one pin angle) gives one zero, so that its readings count once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rigapp_calibration.arrays import Array, Marks, Whole

DEGREES_PER_RUN = 2
FEWEST_DEGREES = 2
"""Fewer give no scatter of the zeros, and so no uncertainty of the weight."""
FEWEST_ALIKE = 4
MOST_ALIKE = 0.6
"""A higher correlation is a drift, which the zeros report as one (``drift``)."""
ROUNDS = 20
HUBER = 2.5
"""Zeros off by more standard deviations lose weight: a jump of a cable is not the weight of a
pin."""


@dataclass(frozen=True, slots=True)
class Zeros:
    """Result of the zeros. own (n, 2): zero of its series at the time of each reading, signal.

    rest (2,): signals at no load and without the pin's weight, in the middle of the calibration.
    rest_uncertainty (2,): standard, N. weight: of the pin as it acts where the loads hang, N, with
    its standard uncertainty and degrees of freedom; what hung at the zeros beside the pin is taken
    off. drift: half the change of a zero over the calibration; scatter: of one component of a
    series' zero beyond drift and weight, both N. circle (n, 2): the pin's weight in the signals of
    each reading.
    """

    own: Array
    rest: Array
    rest_uncertainty: Array
    weight: float
    weight_uncertainty: float
    degrees: float
    drift: float
    scatter: float
    circle: Array


def own_zeros(signal: Array, unloaded: Marks, run: Whole) -> Array:
    """Return the zero (n, 2) of each reading: its run's, linear in time between two of them.

    A run without one has the zeros of all. signal (n, 2): without the pin's weight.
    """
    own = np.empty_like(signal)
    order = np.arange(len(signal))
    for number in np.unique(run):
        members = run == number
        zeros = np.flatnonzero(members & unloaded)
        if not len(zeros):
            zeros = np.flatnonzero(unloaded)
        for axis in range(2):
            own[members, axis] = np.interp(order[members], zeros, signal[zeros, axis])
    return own


def examine_zeros(
    signal: Array, unloaded: Marks, run: Whole, down: Array, sensitivity: Array, hanging: float
) -> Zeros:
    """Fit the zeros; down (n, 2): where the weight points at each reading, pin frame.

    sensitivity (2, 2): signal per newton. hanging: N, what hung at the zeros beside the pin.
    """
    runs, centre, towards, time = _run_means(signal, unloaded, run, down)
    felt = centre @ np.linalg.inv(sensitivity).T
    count, ones = len(runs), np.ones(len(runs))
    spread = count > 1 and np.ptp(towards, axis=0).max() > 1e-3
    columns = [np.kron(ones, [1.0, 0.0]), np.kron(ones, [0.0, 1.0])]
    if spread:
        columns.append(towards.ravel())
    if DEGREES_PER_RUN * count >= len(columns) + 2 + FEWEST_DEGREES:
        columns += [np.kron(time, axis) for axis in np.eye(2)]
    rows = np.column_stack(columns)
    values, covariance, variance, degrees = _huber(rows, felt.ravel())
    covariance = covariance * _alike(felt - (rows @ values).reshape(-1, 2))
    weight = float(values[2]) if spread else 0.0
    circle = weight * down @ sensitivity.T
    drifts = values[-2:] if rows.shape[1] > 3 else np.zeros(2)
    own_noise = float(np.trace(covariance[-2:, -2:])) if rows.shape[1] > 3 else 0.0
    return Zeros(
        own=own_zeros(signal - circle, unloaded, run) + circle,
        rest=values[:2] @ sensitivity.T,
        rest_uncertainty=np.sqrt(np.diag(covariance)[:2]),
        weight=weight - hanging if spread else 0.0,
        weight_uncertainty=float(np.sqrt(covariance[2, 2])) if spread else 0.0,
        degrees=float(degrees),
        drift=0.5 * float(np.sqrt(max(0.0, float(drifts @ drifts) - own_noise) / 2.0)),
        scatter=float(np.sqrt(variance)),
        circle=circle,
    )


def _run_means(
    signal: Array, unloaded: Marks, run: Whole, down: Array
) -> tuple[Whole, Array, Array, Array]:
    """Return number, mean signals (k, 2), directions (k, 2) and times of the runs with zeros."""
    runs = np.unique(run[unloaded])
    order = np.linspace(-0.5, 0.5, len(signal))
    marks = [unloaded & (run == number) for number in runs]
    centre, towards = (np.array([of[m].mean(axis=0) for m in marks]) for of in (signal, down))
    return runs, centre, towards, np.array([order[m].mean() for m in marks])


def _alike(rest: Array) -> float:
    """Return the factor of a covariance for correlated successive zeros.

    rest (k, 2): of the zeros about their fit, in the order of time. The noise of a warming
    amplifier is not white: with a correlation r of neighbours, as of an autoregressive series of
    first order, a slow wave in the zeros is known (1 + r) / (1 - r) times worse. Of few residuals
    about a line r comes out too small by (2 + 4 r) / k (Kendall 1954).
    """
    size = float(np.sum(rest**2))
    if len(rest) < FEWEST_ALIKE or size == 0.0:
        return 1.0
    alike = float(np.sum(rest[1:] * rest[:-1])) / size
    if alike <= 0.0:
        return 1.0
    alike = min(alike + (2.0 + 4.0 * alike) / len(rest), MOST_ALIKE)
    return (1.0 + alike) / (1.0 - alike)


def _huber(rows: Array, values: Array) -> tuple[Array, Array, float, int]:
    """Return solution, its covariance, the variance of a value, and the degrees of freedom."""
    root = np.ones(len(values))
    degrees = len(values) - rows.shape[1]
    for _ in range(ROUNDS):
        solution = np.linalg.lstsq(rows * root[:, None], values * root, rcond=None)[0]
        rest = values - rows @ solution
        scale = float(np.median(np.abs(rest))) / 0.6745 if degrees > 0 else 0.0
        # Few values nearly fit by themselves: their median underestimates the scatter.
        scale = max(scale, 0.5 * float(np.sqrt(np.mean(rest**2))))
        new = np.sqrt(np.minimum(1.0, HUBER * scale / np.maximum(np.abs(rest), 1e-300)))
        if np.abs(new - root).max() < 1e-6:
            break
        root = new
    variance = float(np.sum((rest * root) ** 2)) / max(degrees, 1)
    bread = np.linalg.pinv((rows * root[:, None]).T @ (rows * root[:, None]))
    covariance = np.asarray(variance * bread, np.float64)
    return np.asarray(solution, np.float64), covariance, variance, max(degrees, 1)
