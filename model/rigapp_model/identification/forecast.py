"""Forecasts for this specimen and for the next one of its kind.

Revolutions that remain to a depth, the band in which depth will lie, the scatter of specimens.
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
"""Nodes that hold this share of the posterior decide its 95 % limits to a hundredth of a sigma, and
those that hold the others where they are, first and then."""
MARGIN = 4.0
"""Standard uncertainties by which the life must pass a depth for its limits to be known."""
TIMES = 32
"""Revolutions at which the probability of a depth is computed first; then where it is as in NEAR,
twice."""
AROUND = (-0.2, -0.08, -0.03, -0.012, -0.004, 0.0, 0.004, 0.012, 0.03, 0.08, 0.2)
SWING_COLUMNS = (3, 4)
"""Of cosine and sine, behind the level, the noise and the creep."""
LEVELS = (0.025, 0.5, 0.975)
NEAR = np.unique([np.clip(level + np.array(AROUND), 1e-3, 0.999) for level in LEVELS])


@dataclass(frozen=True, slots=True)
class Remaining:
    """The remaining revolutions until the depth (m) is reached; None with a reason in words.

    high is infinite where the computed life does not hold it.
    """

    depth: float
    revolutions: Credible | None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Band:
    """Median and 95 % limits of the depth (n,), m, at revolutions (n,).

    NaN where it is beyond what the model computes.
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
    """Return the revolutions that remain to a depth, m, with 95 % limits.

    rate: progress of a future revolution, nominal cycles, by default that of the last ones;
    measured: whether the depth is a reading of the probes, as for a stop criterion, with their
    errors so far, or the depth itself, whose uncertainty contains that of the sensitivity and the
    reference. It is by all statements with their weights.
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
    believed = _believed(known)
    slowest = min(float(nodes.hypotheses.log_coefficient.min()) for _, nodes in believed)
    farthest = life.course.progress[-1] * np.exp(-slowest) / rate
    ahead = np.concatenate([[0.0], np.geomspace(1.0, max(farthest, 10.0), TIMES - 1)])
    for share in ROUGH_SHARES:
        rough = [(weight, nodes.heaviest(share)) for weight, nodes in believed]
        reached = _reached(known, life, rough, ahead, rate, depth, measured)
        ahead = np.unique(np.concatenate([ahead[[0, -1]], np.interp(NEAR, reached, ahead)]))
    reached = _reached(known, life, believed, ahead, rate, depth, measured)
    limits = [
        float(np.interp(level, reached, ahead)) if reached[-1] >= level else float("inf")
        for level in LEVELS
    ]
    if not np.isfinite(limits[1]):
        return Remaining(depth, None, say("beyond what the model computes, more likely than not"))
    return Remaining(depth, Credible(limits[1], limits[0], limits[2]))


def _believed(known: Identification) -> list[tuple[float, Nodes]]:
    """Return the statements of a forecast: weights, which sum up to 1, and nodes."""
    verdicts = [verdict for verdict in known.verdicts if verdict.weight > 1e-4]
    total = sum(verdict.weight for verdict in verdicts)
    return [(verdict.weight / total, verdict.nodes.heaviest(SHARE)) for verdict in verdicts]


def _reached(
    known: Identification,
    life: DepthLife,
    believed: list[tuple[float, Nodes]],
    ahead: Array,
    rate: float,
    depth: float,
    measured: bool,
) -> Array:
    """Return the probability that the depth is reached some revolutions ahead (n,)."""
    chance = np.zeros(ahead.size)
    for weight, nodes in believed:
        at = known.revolution + ahead
        mean, deviation = _depths(known, life, nodes, at, rate, measured)
        if measured:
            mean = mean + _to_crest(nodes, at, known.revolution)
        chance += weight * (nodes.weight @ ndtr((mean - depth) / deviation))
    return np.maximum.accumulate(chance)


def _to_crest(nodes: Nodes, at: Array, now: float) -> Array:
    """Return the height of a swing's crest above the swing at revolutions (H, n), m, 0 without one.

    A reading that swings reaches a depth first at a crest; one of them is passed in each period.
    """
    period = np.where(nodes.kinds.period > 0.0, nodes.kinds.period, np.inf)[:, None]
    cosine, sine = (nodes.left[:, column, None] for column in SWING_COLUMNS)
    turn = 2.0 * np.pi * at / period
    rise = np.hypot(cosine, sine) - cosine * np.cos(turn) - sine * np.sin(turn)
    return np.where(at - now >= period, SWING * rise, 0.0)


def _depths(
    known: Identification, life: DepthLife, nodes: Nodes, at: Array, rate: float, measured: bool
) -> tuple[Array, Array]:
    """Return mean and standard deviation of the depth (H, n), m, by each node at revolutions (n,).

    The drift continues from the last bin as a random walk, and the correlated noise decays to none.
    The temperature is the mean so far, with its spread.
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
    usual, spread = _warmth(known)
    warm = np.full(at.size, usual)
    falls = np.exp(-np.maximum(at - known.revolution, 0.0) / kinds.length[:, None])
    # Many nodes have few shapes.
    rows = np.column_stack([kinds.period, kinds.jump, kinds.creeps])
    _, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    some = kinds.at(first)
    each = shapes(some.period, some.jump, some.creeps, nodes.steps, Moments(at, at, warm))
    onward = np.empty((*worn.shape, 2 + each.shape[1]))
    onward[:, :, 0], onward[:, :, 1] = 1.0, falls
    onward[:, :, 2:] = each.swapaxes(1, 2)[which.ravel()]
    mean = (
        worn
        + (columns @ nodes.mean[:, :, None])[:, :, 0]
        + (onward @ nodes.left[:, :, None])[:, :, 0]
    )
    apart = columns - onward @ nodes.pulled
    walked = np.log(np.maximum(at, 1.0)) - known.readings.walked[-1]
    variance = (
        ((apart @ nodes.covariance) * apart).sum(axis=2)
        + ((onward @ nodes.spare) * onward).sum(axis=2)
        + kinds.size[:, None] ** 2 * (1.0 - falls**2)
        + kinds.strength[:, None] ** 2 * np.maximum(walked, 0.0)
        + (WARMTH * spread) ** 2 * (nodes.left[:, heat] ** 2 + nodes.spare[:, heat, heat])[:, None]
    )
    return mean, np.sqrt(variance)


def _warmth(known: Identification) -> tuple[float, float]:
    """Return mean and standard deviation of the temperature beside the first bin, K."""
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
    """Return median and 95 % limits of the depth at coming revolutions (n,).

    rate, measured: as for ``remaining``; without the scatter of a single reading.
    """
    known = identification
    at = np.asarray(revolutions, dtype=np.float64)
    rate = known.rate if rate is None else rate
    parts = [
        (weight * nodes.weight, *_depths(known, life, nodes, at, rate, measured))
        for weight, nodes in _believed(known)
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
    """Return the depth (n,), m, that a mixture of normals is below with a probability."""
    for _ in range(20):  # a millionth of the range from low to high
        middle = 0.5 * (low + high)
        below = weight @ ndtr((middle - mean) / deviation) < level * weight.sum()
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)


# Many specimens of one pairing: their scatter, and the prediction for the next one.
#
# Estimates y_i = ln K_i with y_i = mu + d_i + c_i e + r_i: d_i between specimens, normal with
# deviation tau; r_i of one test alone; e of the probes' sensitivity, the same for all tests with
# one calibration record, so that it does not average out, as that of the load does not. mu is
# marginalised with a flat prior, tau on a grid (A. Gelman et al., Bayesian Data Analysis, 3rd ed.
# 2013, section 5.4, with common errors).

USUAL_SCATTER = 0.5
"""Scale of tau's half-normal prior: two specimens in three within a factor of 1.6 [assumed]."""
REACH = 5.0
"""Largest tau of the grid over the scale; a half-normal has 6e-7 beyond."""
GRID = 250
"""Points over tau: one each hundredth of K is finer than any test resolves."""
LEAST_LEARNT = 0.1
"""Least share of the posterior's precision by a test's own readings."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """The estimate of ln K by one test, without its prior.

    log_coefficient: ln(K / (m^2/N)); spread: its standard uncertainty; common: part of that by the
    sensitivity of the probes, with its sign; record: name of the record that it is from;
    load: relative standard uncertainty of the load, which all tests of a rig have in common, and
    which spread does not hold.
    """

    log_coefficient: float
    spread: float
    common: float
    record: str
    load: float = 0.0


@dataclass(frozen=True, slots=True)
class Pairing:
    """The result of several specimens for their pairing.

    coefficient: of the median specimen, next: of the next specimen, m^2/N; scatter: factor by which
    one standard deviation of the specimens differs from the median, exp(tau); prior: for the
    next test; each: estimates of the specimens, each with those of the others (m^2/N).
    """

    coefficient: Credible
    next: Credible
    scatter: Credible
    prior: Prior
    each: tuple[Credible, ...]


def estimate_of(known: Identification, record: str) -> Estimate:
    """Return the estimate of a test; raise NotIdentifiable where it has too little data."""
    values, weights, seen = _seen(known)
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
    common = float(weights @ ((values - weights @ values) * (seen - weights @ seen)))
    common *= spread**-2 / precision
    own = float(np.hypot(precision**-0.5, known.errors.geometry))
    common = float(np.clip(common, -0.999 * own, 0.999 * own))
    return Estimate(float(alone), own, common, record, known.errors.load)


def pairing_of(estimates: Sequence[Estimate], source: str) -> Pairing:
    """Return the pairing of some specimens; source: in words, for the prior.

    One specimen is enough: its scatter is then the usual one. Raises NotIdentifiable for none.
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


def _seen(known: Identification) -> tuple[Array, Array, Array]:
    """Return ln(K/K0) now, weight and mean of e / u_e of the nodes of all statements."""
    nodes = [verdict.nodes for verdict in known.verdicts]
    weight = np.concatenate([verdict.weight * verdict.nodes.weight for verdict in known.verdicts])
    return (
        np.concatenate([n.now(known.progress)[0] for n in nodes]),
        weight / weight.sum(),
        np.concatenate([n.mean[:, 1] for n in nodes]),
    )


def _errors(estimates: Sequence[Estimate]) -> Array:
    """Return the covariance (n, n) of the estimates about their own specimens."""
    common = np.array([estimate.common for estimate in estimates])
    names = np.array([estimate.record for estimate in estimates])
    together = (names[:, None] == names[None, :]) * np.outer(common, common)
    load = np.array([estimate.load for estimate in estimates])
    own = np.diag([estimate.spread**2 - estimate.common**2 for estimate in estimates])
    return np.asarray(together + np.outer(load, load) + own)


@dataclass(frozen=True, slots=True, eq=False)
class _ByScatter:
    """For each tau (t,): likelihood, mean and variance of mu, those of specimens (t, n)."""

    log_likelihood: Array
    centre: Array
    variance: Array
    own: Array
    spare: Array


def _by_scatter(y: Array, errors: Array, taus: Array) -> _ByScatter:
    """Return the posterior for each tau (t,) by estimates (n,) with a covariance (n, n)."""
    values, vectors = np.linalg.eigh(errors)
    total = values + taus[:, None] ** 2
    inverse = np.einsum("ik,tk,jk->tij", vectors, 1.0 / total, vectors)
    row = inverse.sum(axis=2)
    variance = 1.0 / row.sum(axis=1)
    centre = variance * (row @ y)
    left = y - centre[:, None]
    rest = np.einsum("tij,tj->ti", inverse, left)
    misfit = (left * rest).sum(axis=1)
    log_likelihood = -0.5 * (np.log(total).sum(axis=1) - np.log(variance) + misfit)
    # A specimen is mu + d, and d the share tau^2 / V of the residual; mu's uncertainty propagates.
    square = taus[:, None] ** 2
    along = 1.0 - square * row
    spare = square * (1.0 - square * np.einsum("tii->ti", inverse))
    spare = np.maximum(spare + variance[:, None] * along**2, 0.0)
    return _ByScatter(log_likelihood, centre, variance, centre[:, None] + square * rest, spare)


def _mixture(weight: Array, centre: Array, variance: Array) -> Credible:
    """Return median and limits of exp of a mixture of normals, (n,) each."""
    deviation = np.sqrt(np.maximum(variance, 1e-18))
    ends = (centre - 9.0 * deviation).min(), (centre + 9.0 * deviation).max()

    def level(wanted: float) -> float:
        def above(x: float) -> float:
            return float(weight @ ndtr((x - centre) / deviation)) - wanted

        return float(np.exp(brentq(above, *ends, xtol=1e-6)))

    return Credible(level(0.5), level(0.025), level(0.975))
