"""Many specimens of one pairing: how much they scatter, and what to expect of the next one.

Estimates y_i = ln K_i with y_i = mu + d_i + c_i e + r_i: d_i between specimens, normal with
deviation tau; r_i of one test alone; e of the probes' sensitivity, the same for all tests with one
calibration record, so that it does not average out, as that of the load does not. mu is
marginalised with a flat prior, tau on a grid (A. Gelman et al., Bayesian Data Analysis, 3rd ed.
2013, section 5.4, with common errors).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import ndtr

from rigapp.texts import say
from rigapp_model.identification.errors import NotIdentifiable, Prior
from rigapp_model.identification.inference import Credible, Identification, quantiles

Array = NDArray[np.float64]

USUAL_SCATTER = 0.5
"""Scale of tau's half-normal prior: two specimens in three within a factor of 1.6 [assumed]."""
REACH = 5.0
"""The grid of tau reaches so many times the scale; a half-normal has 6e-7 beyond."""
GRID = 250
"""Points over tau: one each hundredth of K is finer than any test tells."""
LEAST_LEARNT = 0.1
"""A test whose readings hold less than this share of the posterior's precision tells too little."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """Hold what one test tells of ln K, without what was known beforehand.

    log_coefficient: ln(K / (m^2/N)); spread: its standard uncertainty; common: how much of that is
    by the sensitivity of the probes, with its sign; record: name of the record that it is from;
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
    """Hold what several specimens tell of their pairing.

    coefficient: of the median specimen, next: of the next specimen, m^2/N; scatter: factor by which
    one standard deviation of the specimens differs from the median, exp(tau); prior: for the
    next test; each: estimates of the specimens, each with what the others tell (m^2/N).
    """

    coefficient: Credible
    next: Credible
    scatter: Credible
    prior: Prior
    each: tuple[Credible, ...]


def estimate_of(known: Identification, record: str) -> Estimate:
    """Return what a test tells of its coefficient; raise NotIdentifiable for too little."""
    values, weights, seen = _seen(known)
    mean, spread = known.mean, known.spread
    before = known.prior.spread**-2
    precision = spread**-2 - before
    if precision < LEAST_LEARNT * spread**-2:
        raise NotIdentifiable(
            say(
                "the readings say hardly more of the wear coefficient than what was assumed"
                " before the test: let it run longer"
            )
        )
    alone = (mean * spread**-2 - np.log(known.prior.coefficient) * before) / precision
    common = float(weights @ ((values - weights @ values) * (seen - weights @ seen)))
    common *= spread**-2 / precision
    own = float(np.hypot(precision**-0.5, known.errors.geometry))
    common = float(np.clip(common, -0.999 * own, 0.999 * own))
    return Estimate(float(alone), own, common, record, known.errors.load)


def pairing_of(estimates: Sequence[Estimate], source: str) -> Pairing:
    """Return what specimens of one pairing tell; source: where from, in words, for the prior.

    One specimen is enough: its scatter is then the usual one. Raises NotIdentifiable for none.
    """
    if not estimates:
        raise NotIdentifiable(say("there is no test whose wear coefficient is known"))
    y = np.array([one.log_coefficient for one in estimates])
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
        Credible(*(float(np.exp(one)) for one in (tau.median, tau.low, tau.high))),
        Prior(float(np.exp(mean)), spread, source),
        tuple(_mixture(weight, *one) for one in zip(by.own.T, by.spare.T, strict=True)),
    )


def _seen(known: Identification) -> tuple[Array, Array, Array]:
    """Return ln(K/K0) now, weight and mean of e / u_e of the nodes of all statements."""
    nodes = [one.nodes for one in known.verdicts]
    weight = np.concatenate([one.weight * one.nodes.weight for one in known.verdicts])
    return (
        np.concatenate([one.now(known.progress)[0] for one in nodes]),
        weight / weight.sum(),
        np.concatenate([one.mean[:, 1] for one in nodes]),
    )


def _errors(estimates: Sequence[Estimate]) -> Array:
    """Return the covariance (n, n) of the estimates about their own specimens."""
    common = np.array([one.common for one in estimates])
    names = np.array([one.record for one in estimates])
    together = (names[:, None] == names[None, :]) * np.outer(common, common)
    load = np.array([one.load for one in estimates])
    own = np.diag([one.spread**2 - one.common**2 for one in estimates])
    return np.asarray(together + np.outer(load, load) + own)


@dataclass(frozen=True, slots=True, eq=False)
class _ByScatter:
    """Hold for each tau (t,): likelihood, mean and variance of mu, those of specimens (t, n)."""

    log_likelihood: Array
    centre: Array
    variance: Array
    own: Array
    spare: Array


def _by_scatter(y: Array, errors: Array, taus: Array) -> _ByScatter:
    """Return what estimates (n,) with a covariance (n, n) tell for each tau (t,)."""
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
    # A specimen is mu + d, and d is the share tau^2 / V of what is left; mu's doubt goes along.
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
