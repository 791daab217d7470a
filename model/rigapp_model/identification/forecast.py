"""Forecasts for this specimen and for the next one of its pairing.

Remaining revolutions to a depth, band of the future depth, scatter between specimens.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq
from scipy.special import ndtr

from rigapp.texts import say
from rigapp_model.errors import require_positive
from rigapp_model.identification.errors import NotIdentifiable, Prior
from rigapp_model.identification.inference import Credible, Identification, quantiles
from rigapp_model.identification.life import DepthLife
from rigapp_model.identification.posterior import Nodes
from rigapp_model.identification.shapes import HEAT, SWING, WARMTH, Moments, shapes

Array = NDArray[np.float64]

SHARE, ROUGH_SHARES = 1.0 - 1e-3, (0.97, 0.995)
"""Share of the posterior in the nodes used: sets the 95 % limits to a hundredth of a sigma; shares
of the two preceding passes that locate the limits."""
MARGIN = 4.0
"""Standard uncertainties beyond a depth up to which the life must be computed for its limits."""
TIMES = 32
"""Number of revolutions at which the probability of a depth is computed first; two passes refine
them at the probabilities NEAR."""
AROUND = (-0.2, -0.08, -0.03, -0.012, -0.004, 0.0, 0.004, 0.012, 0.03, 0.08, 0.2)
SWING_COLUMNS = (3, 4)
"""States of cosine and sine, after the level, the noise and the creep."""
LEVELS = (0.025, 0.5, 0.975)
NEAR = np.unique([np.clip(level + np.array(AROUND), 1e-3, 0.999) for level in LEVELS])


@dataclass(frozen=True, slots=True)
class Remaining:
    """Remaining revolutions until the depth (m) is reached; None with the reason as text.

    high is infinite if it is beyond the computed life.
    """

    depth: float
    revolutions: Credible | None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Band:
    """Median and 95 % limits of the depth (n,), m, at revolutions (n,).

    NaN beyond the computed life.
    """

    revolution: Array
    median: Array
    low: Array
    high: Array


def remaining(
    identification: Identification,
    life: DepthLife,
    depth: float,
    rate: float | None = None,
    measured: bool = True,
) -> Remaining:
    """Return the remaining revolutions to a depth, m, with 95 % limits.

    rate: progress per future revolution, nominal cycles, by default that of the last ones;
    measured: True for a reading of the probes, as in a stop criterion, with their present errors;
    False for the true depth, with the uncertainty of sensitivity and reference. Averaged over all
    statements with their weights.
    """
    require_positive("depth", depth, "m")
    known, errors = identification, identification.errors
    needed = (depth + MARGIN * errors.reference) / (1.0 - min(MARGIN * known.sensitivity, 0.5))
    if needed > life.computed_depth:
        return Remaining(
            depth,
            None,
            say(
                "beyond what the model computes: its life reaches {:.4g} um, and {:.4g} um"
                " are needed for the limits of {:.4g} um",
                1e6 * life.computed_depth,
                1e6 * needed,
                1e6 * depth,
            ),
        )
    rate = known.rate if rate is None else rate
    require_positive("rate", rate)
    weighted = _weighted_nodes(known)
    slowest = min(float(nodes.hypotheses.log_coefficient.min()) for _, nodes in weighted)
    farthest = life.course.progress[-1] * np.exp(-slowest) / rate
    ahead = np.concatenate([[0.0], np.geomspace(1.0, max(farthest, 10.0), TIMES - 1)])
    for share in ROUGH_SHARES:
        rough = [(weight, nodes.heaviest(share)) for weight, nodes in weighted]
        reached = _probability_reached(known, life, rough, ahead, rate, depth, measured)
        ahead = np.unique(np.concatenate([ahead[[0, -1]], np.interp(NEAR, reached, ahead)]))
    reached = _probability_reached(known, life, weighted, ahead, rate, depth, measured)
    limits = [
        float(np.interp(level, reached, ahead)) if reached[-1] >= level else float("inf")
        for level in LEVELS
    ]
    if not np.isfinite(limits[1]):
        return Remaining(depth, None, say("beyond what the model computes, more likely than not"))
    return Remaining(depth, Credible(limits[1], limits[0], limits[2]))


def _weighted_nodes(known: Identification) -> list[tuple[float, Nodes]]:
    """Return weights, with a sum of 1, and nodes of the statements used."""
    verdicts = [verdict for verdict in known.verdicts if verdict.weight > 1e-4]
    total = sum(verdict.weight for verdict in verdicts)
    return [(verdict.weight / total, verdict.nodes.heaviest(SHARE)) for verdict in verdicts]


def _probability_reached(
    known: Identification,
    life: DepthLife,
    weighted: list[tuple[float, Nodes]],
    ahead: Array,
    rate: float,
    depth: float,
    measured: bool,
) -> Array:
    """Return the probability that the depth is reached after more revolutions ``ahead`` (n,)."""
    chance = np.zeros(ahead.size)
    for weight, nodes in weighted:
        at = known.revolution + ahead
        mean, deviation = _depths(known, life, nodes, at, rate, measured)
        if measured:
            mean = mean + _crest_height(nodes, at, known.revolution)
        chance += weight * (nodes.weight @ ndtr((mean - depth) / deviation))
    return np.maximum.accumulate(chance)


def _crest_height(nodes: Nodes, at: Array, now: float) -> Array:
    """Return a swing's crest relative to its value at revolutions (H, n), m, 0 without a swing.

    With a swing, the readings first reach a depth at a crest, which occurs once per period.
    """
    period = np.where(nodes.kinds.period > 0.0, nodes.kinds.period, np.inf)[:, None]
    cosine, sine = (nodes.left[:, column, None] for column in SWING_COLUMNS)
    turn = 2.0 * np.pi * at / period
    rise = np.hypot(cosine, sine) - cosine * np.cos(turn) - sine * np.sin(turn)
    return np.where(at - now >= period, SWING * rise, 0.0)


def _depths(
    known: Identification, life: DepthLife, nodes: Nodes, at: Array, rate: float, measured: bool
) -> tuple[Array, Array]:
    """Return mean and standard deviation of the depth (H, n), m, of each node at revolutions (n,).

    The drift continues from the last bin as a random walk, and the correlated noise decays. The
    temperature is the mean so far, with its spread.
    """
    progress = known.progress + rate * (at - known.revolution)
    worn, slopes = life.depth(progress, nodes.hypotheses.scaled(np.zeros(0)))
    by_ratio = slopes[1]
    if not measured:
        mean = worn + nodes.mean[:, :1] * by_ratio
        variance = by_ratio**2 * nodes.covariance[:, :1, 0]
        return mean, np.sqrt(variance + 1e-24)
    columns = np.empty((*worn.shape, 4))
    columns[:, :, 0], columns[:, :, 1] = by_ratio, known.sensitivity * worn
    columns[:, :, 2], columns[:, :, 3] = known.errors.reference, life.elastic_doubt(worn)
    kinds, heat = nodes.kinds, 2 + HEAT
    usual, spread = _temperature_moments(known)
    warm = np.full(at.size, usual)
    decay = np.exp(-np.maximum(at - known.revolution, 0.0) / kinds.length[:, None])
    # Many nodes have the same shapes.
    rows = np.column_stack([kinds.period, kinds.jump, kinds.creeps])
    _, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    distinct = kinds.at(first)
    each = shapes(
        distinct.period, distinct.jump, distinct.creeps, nodes.steps, Moments(at, at, warm)
    )
    onward = np.empty((*worn.shape, 2 + each.shape[1]))
    onward[:, :, 0], onward[:, :, 1] = 1.0, decay
    onward[:, :, 2:] = each.swapaxes(1, 2)[which.ravel()]
    mean = (
        worn
        + (columns @ nodes.mean[:, :, None])[:, :, 0]
        + (onward @ nodes.left[:, :, None])[:, :, 0]
    )
    difference = columns - onward @ nodes.pulled
    walked = np.log(np.maximum(at, 1.0)) - known.readings.walked[-1]
    variance = (
        ((difference @ nodes.covariance) * difference).sum(axis=2)
        + ((onward @ nodes.spare) * onward).sum(axis=2)
        + kinds.size[:, None] ** 2 * (1.0 - decay**2)
        + kinds.strength[:, None] ** 2 * np.maximum(walked, 0.0)
        + (WARMTH * spread) ** 2 * (nodes.left[:, heat] ** 2 + nodes.spare[:, heat, heat])[:, None]
    )
    return mean, np.sqrt(variance)


def _temperature_moments(known: Identification) -> tuple[float, float]:
    """Return mean and standard deviation of the temperature relative to the first bin, K."""
    by = known.readings
    weight = (by.revolution - by.begin) / (by.revolution - by.begin).sum()
    mean = float(weight @ by.warm)
    return mean, float(np.sqrt(weight @ (by.warm - mean) ** 2))


def predictive_band(
    identification: Identification,
    life: DepthLife,
    revolutions: ArrayLike,
    rate: float | None = None,
    measured: bool = True,
) -> Band:
    """Return median and 95 % limits of the depth at future revolutions (n,).

    rate, measured: as for ``remaining``; without the scatter of a single reading.
    """
    known = identification
    at = np.asarray(revolutions, dtype=np.float64)
    rate = known.rate if rate is None else rate
    parts = [
        (weight * nodes.weight, *_depths(known, life, nodes, at, rate, measured))
        for weight, nodes in _weighted_nodes(known)
    ]
    weight, mean, deviation = (np.concatenate([part[k] for part in parts]) for k in range(3))
    low, high = (mean - 5.0 * deviation).min(axis=0), (mean + 5.0 * deviation).max(axis=0)
    limits = [_level(level, weight, mean, deviation, low, high) for level in LEVELS]
    beyond = (
        limits[2]
        > life.computed_depth * (1.0 - MARGIN * known.sensitivity) - MARGIN * known.errors.reference
    )
    lower, middle, upper = (np.where(beyond, np.nan, limit) for limit in limits)
    return Band(at, middle, lower, upper)


def _level(
    level: float, weight: Array, mean: Array, deviation: Array, low: Array, high: Array
) -> Array:
    """Return a quantile (n,), m, of a mixture of normals."""
    for _ in range(20):  # a millionth of the range from low to high
        middle = 0.5 * (low + high)
        below = weight @ ndtr((middle - mean) / deviation) < level * weight.sum()
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)


# Several specimens of one pairing: their scatter, and the prediction for the next one.
#
# Estimates y_i = ln K_i with y_i = mu + d_i + c_i e + r_i: d_i between specimens, normal with
# deviation tau; r_i of one test; e of the probes' sensitivity, common to all tests with the same
# calibration record, so that it does not average out, like that of the load. mu is marginalised
# with a flat prior, tau on a grid (A. Gelman et al., Bayesian Data Analysis, 3rd ed. 2013,
# section 5.4, with common errors).

USUAL_SCATTER = 0.5
"""Scale of tau's half-normal prior: two specimens in three within a factor of 1.6 [assumed]."""
REACH = 5.0
"""End of the grid of tau, in scales; a half-normal has 6e-7 beyond."""
GRID = 250
"""Points over tau: steps of a hundredth of K, finer than any test resolves."""
LEAST_LEARNT = 0.1
"""Least share of the readings of a test in the precision of the posterior."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """Estimate of ln K from one test, without its prior.

    log_coefficient: ln(K / (m^2/N)); spread: its standard uncertainty; common: signed part of that
    due to the sensitivity of the probes; record: name of the record of that; load: relative
    standard uncertainty of the load, common to all tests of a rig and not in spread.
    """

    log_coefficient: float
    spread: float
    common: float
    record: str
    load: float = 0.0


@dataclass(frozen=True, slots=True)
class Pairing:
    """Result of several specimens for their pairing.

    coefficient: of the median specimen, next: of the next specimen, m^2/N; scatter: factor of one
    standard deviation between specimens, exp(tau); prior: for the next test; each: posterior
    estimates of the specimens, given all of them (m^2/N).
    """

    coefficient: Credible
    next: Credible
    scatter: Credible
    prior: Prior
    each: tuple[Credible, ...]


def estimate_of(known: Identification, record: str) -> Estimate:
    """Return the estimate of a test; raise NotIdentifiable with too little data."""
    values, weights, sensitivity = _coefficient_and_sensitivity(known)
    mean, spread = known.mean, known.spread
    before = known.prior.spread**-2
    precision = spread**-2 - before
    if precision < LEAST_LEARNT * spread**-2:
        raise NotIdentifiable(
            say(
                "the readings add little to the wear coefficient that was assumed before the"
                " test: let it run longer"
            )
        )
    alone = (mean * spread**-2 - np.log(known.prior.coefficient) * before) / precision
    common = float(weights @ ((values - weights @ values) * (sensitivity - weights @ sensitivity)))
    common *= spread**-2 / precision
    own = float(np.hypot(precision**-0.5, known.errors.geometry))
    common = float(np.clip(common, -0.999 * own, 0.999 * own))
    return Estimate(float(alone), own, common, record, known.errors.load)


def pairing_of(estimates: Sequence[Estimate], source: str) -> Pairing:
    """Return the result for a pairing; source: text for the prior.

    With one specimen the scatter is the prior's. Raises NotIdentifiable without any.
    """
    if not estimates:
        raise NotIdentifiable(say("there is no test with a known wear coefficient"))
    y = np.array([estimate.log_coefficient for estimate in estimates])
    taus = np.linspace(0.0, REACH * USUAL_SCATTER, GRID)
    by = _by_scatter(y, _errors(estimates), taus)
    log_weight = by.log_likelihood - 0.5 * (taus / USUAL_SCATTER) ** 2
    weight = np.exp(log_weight - log_weight.max())
    weight /= weight.sum()
    coming = by.variance + taus**2
    mean = float(weight @ by.centre)
    spread = float(np.sqrt(weight @ (coming + (by.centre - mean) ** 2)))
    tau = quantiles(taus, weight, float(taus[1]))
    return Pairing(
        _mixture(weight, by.centre, by.variance),
        _mixture(weight, by.centre, coming),
        Credible(*(float(np.exp(limit)) for limit in (tau.median, tau.low, tau.high))),
        Prior(float(np.exp(mean)), spread, source),
        tuple(_mixture(weight, *node) for node in zip(by.own.T, by.spare.T, strict=True)),
    )


def _coefficient_and_sensitivity(known: Identification) -> tuple[Array, Array, Array]:
    """Return present ln(K/K0), weight and mean of e / u_e of the nodes of all statements."""
    nodes = [verdict.nodes for verdict in known.verdicts]
    weight = np.concatenate([verdict.weight * verdict.nodes.weight for verdict in known.verdicts])
    return (
        np.concatenate([n.now(known.progress)[0] for n in nodes]),
        weight / weight.sum(),
        np.concatenate([n.mean[:, 1] for n in nodes]),
    )


def _errors(estimates: Sequence[Estimate]) -> Array:
    """Return the covariance (n, n) of the estimates relative to the true values."""
    common = np.array([estimate.common for estimate in estimates])
    names = np.array([estimate.record for estimate in estimates])
    covariance = (names[:, None] == names[None, :]) * np.outer(common, common)
    load = np.array([estimate.load for estimate in estimates])
    own = np.diag([estimate.spread**2 - estimate.common**2 for estimate in estimates])
    return np.asarray(covariance + np.outer(load, load) + own)


@dataclass(frozen=True, slots=True, eq=False)
class _ByScatter:
    """For each tau (t,): likelihood, mean and variance of mu, and of the specimens (t, n)."""

    log_likelihood: Array
    centre: Array
    variance: Array
    own: Array
    spare: Array


def _by_scatter(y: Array, errors: Array, taus: Array) -> _ByScatter:
    """Return the posterior for each tau (t,), from estimates (n,) with a covariance (n, n)."""
    values, vectors = np.linalg.eigh(errors)
    total = values + taus[:, None] ** 2
    inverse = np.einsum("ik,tk,jk->tij", vectors, 1.0 / total, vectors)
    row = inverse.sum(axis=2)
    variance = 1.0 / row.sum(axis=1)
    centre = variance * (row @ y)
    residual = y - centre[:, None]
    weighted = np.einsum("tij,tj->ti", inverse, residual)
    misfit = (residual * weighted).sum(axis=1)
    log_likelihood = -0.5 * (np.log(total).sum(axis=1) - np.log(variance) + misfit)
    # A specimen is mu + d; d is tau^2 / V times the residual; mu's uncertainty propagates.
    square = taus[:, None] ** 2
    along = 1.0 - square * row
    spare = square * (1.0 - square * np.einsum("tii->ti", inverse))
    spare = np.maximum(spare + variance[:, None] * along**2, 0.0)
    return _ByScatter(log_likelihood, centre, variance, centre[:, None] + square * weighted, spare)


def _mixture(weight: Array, centre: Array, variance: Array) -> Credible:
    """Return median and limits of exp of a mixture of normals, (n,) each."""
    deviation = np.sqrt(np.maximum(variance, 1e-18))
    ends = (centre - 9.0 * deviation).min(), (centre + 9.0 * deviation).max()

    def level(probability: float) -> float:
        def above(x: float) -> float:
            return float(weight @ ndtr((x - centre) / deviation)) - probability

        return float(np.exp(brentq(above, *ends, xtol=1e-6)))

    return Credible(level(0.5), level(0.025), level(0.975))
