"""The wear coefficient from a running test: posterior of each statement, compared by evidence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from rigapp_model.identification.bins import Bin, Bins
from rigapp_model.identification.errors import Prior, ProbeErrors
from rigapp_model.identification.findings import Disturbance, disturbances
from rigapp_model.identification.life import DepthLife
from rigapp_model.identification.noise import DepthBins, readings_of
from rigapp_model.identification.posterior import (
    IdentificationInputs,
    Nodes,
    PosteriorInputs,
    alternative_posterior,
    constant_posterior,
)
from rigapp_model.identification.screening import likely_noise
from rigapp_model.identification.statements import STATEMENTS, Statement

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Credible:
    """The median of a quantity with its 95 % credible limits."""

    median: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, eq=False)
class Verdict:
    """The result of one statement.

    weight: its probability among all; log_evidence; coefficient: now, m^2/N; before: the first,
    after: the last, and transition: progress at which it changed or within which it ran in, nominal
    cycles, None for a constant one.
    """

    name: str
    weight: float
    log_evidence: float
    coefficient: Credible
    before: Credible | None
    after: Credible | None
    transition: Credible | None
    nodes: Nodes


@dataclass(frozen=True, slots=True, eq=False)
class Identification:
    """The wear coefficient after some bins.

    coefficient: now, by all statements with their weights, m^2/N; mean: of ln K; spread: its
    standard deviation, without that of the load; verdicts: by statement, the most probable first;
    drift: mean of its strength, m per root of ln n; readings: the bins; prior, errors: what they
    were judged with; life_coefficient: K0, m^2/N; sensitivity: relative standard uncertainty, with
    that of the life's computation; disturbances: of the probes, which the limits hold.
    """

    coefficient: Credible
    mean: float
    spread: float
    verdicts: tuple[Verdict, ...]
    drift: float
    readings: DepthBins
    prior: Prior
    errors: ProbeErrors
    life_coefficient: float
    sensitivity: float
    disturbances: tuple[Disturbance, ...] = ()

    @property
    def best(self) -> Verdict:
        """Return the most probable statement."""
        return self.verdicts[0]

    @property
    def rate(self) -> float:
        """Return the progress of a revolution, nominal cycles, by the last two bins."""
        by = self.readings
        turned = float(by.revolution[-1] - by.revolution[-3])
        return float(self.progress - by.progress[-3] - by.half[-3]) / turned

    @property
    def progress(self) -> float:
        """Return the measured progress at the last revolution, nominal cycles."""
        return float(self.readings.progress[-1] + self.readings.half[-1])

    @property
    def revolution(self) -> float:
        """Return the last revolution that was taken into account."""
        return float(self.readings.revolution[-1])

    def density(self, points: int = 121) -> tuple[Array, Array]:
        """Return coefficients (points,), m^2/N, and the density of ln K there (points,)."""
        at = self.mean + np.linspace(-4.5, 4.5, points) * self.spread
        now = _coefficients(self.verdicts, self.progress)
        edges, reached = distribution(*_with_load(*now, self.errors.scale))
        by = np.interp(at - np.log(self.life_coefficient), edges, reached)
        return np.exp(at), np.gradient(by, at)


def distribution(values: Array, weights: Array, breadth: Array | float) -> tuple[Array, Array]:
    """Return the corners of the distribution of values, and itself there; it is straight between.

    Each value is spread evenly over its breadth; weights sum up to 1.
    """
    wide = np.broadcast_to(np.maximum(breadth, 1e-9), values.shape)
    edges = np.concatenate([values - 0.5 * wide, values + 0.5 * wide])
    order = np.argsort(edges)
    density = np.cumsum(np.concatenate([weights / wide, -weights / wide])[order])
    edges = edges[order]
    reached = np.cumsum(np.append(0.0, density[:-1] * np.diff(edges)))
    return edges, np.maximum.accumulate(reached / reached[-1])


def quantiles(values: Array, weights: Array, breadth: Array | float = 0.0) -> Credible:
    """Return median and 95 % limits of ``distribution``."""
    edges, reached = distribution(values, weights, breadth)
    low, median, high = np.interp([0.025, 0.5, 0.975], reached, edges)
    return Credible(float(median), float(low), float(high))


LOADS = ndtri((np.arange(9) + 0.5) / 9.0)
"""Errors of the load, in standard uncertainties, of equal probability."""


def _with_load(values: Array, weights: Array, breadth: Array, load: float) -> tuple[Array, ...]:
    """Return values of ln K, weights and breadth with the load's relative uncertainty."""
    if not load:
        return values, weights, breadth
    off = load * LOADS / LOADS.std()
    return (
        (values[:, None] + off).ravel(),
        np.repeat(weights / off.size, off.size),
        np.repeat(np.maximum(breadth, 0.5 * load), off.size),
    )


def _coefficients(verdicts: Sequence[Verdict], progress: float) -> tuple[Array, Array, Array]:
    """Return ln(K/K0) now, weight and breadth of all nodes of some statements."""
    now = [v.nodes.now(progress) for v in verdicts]
    return (
        np.concatenate([value for value, _ in now]),
        np.concatenate([v.weight * v.nodes.weight for v in verdicts])
        / sum(v.weight for v in verdicts),
        np.concatenate([breadth for _, breadth in now]),
    )


def identify(
    bins: Bins | Sequence[Bin], life: DepthLife, errors: ProbeErrors, prior: Prior
) -> Identification:
    """Identify the wear coefficient from bins of the measured depth.

    life: must be computed beyond the depth measured so far. Pure: the same bins give the same
    numbers. Raises NotIdentifiable in words where nothing can be stated.
    """
    closed = bins.closed if isinstance(bins, Bins) else bins
    readings = readings_of(closed, errors)
    inputs = IdentificationInputs(readings, life, errors, prior)
    noise = likely_noise(inputs, STATEMENTS[0], STATEMENTS[2])
    noisy = PosteriorInputs(readings, life, errors, prior, noise)
    first = (STATEMENTS[0], *constant_posterior(noisy, STATEMENTS[0]))
    start = float(first[2].weight @ first[2].hypotheses.log_coefficient)
    posteriors = [
        first,
        *((other, *alternative_posterior(noisy, other, start)) for other in STATEMENTS[1:]),
    ]
    chances = np.log([s.chance for s, _, _ in posteriors]) + [log for _, log, _ in posteriors]
    weight = np.exp(chances - np.logaddexp.reduce(chances))
    progress = float(readings.progress[-1] + readings.half[-1])
    verdicts = tuple(
        sorted(
            (
                _verdict(s, log, float(share), nodes, progress, life.coefficient, errors.scale)
                for (s, log, nodes), share in zip(posteriors, weight, strict=True)
            ),
            key=lambda each: -each.weight,
        )
    )
    values, weights, breadth = _coefficients(verdicts, progress)
    mean = float(weights @ values)
    spread = float(np.sqrt(weights @ ((values - mean) ** 2 + breadth**2 / 12.0)))
    strengths = np.concatenate([v.nodes.kinds.strength for v in verdicts])
    return Identification(
        _scaled(quantiles(*_with_load(values, weights, breadth, errors.scale)), life.coefficient),
        mean + float(np.log(life.coefficient)),
        spread,
        verdicts,
        float(weights @ strengths),
        readings,
        prior,
        errors,
        life.coefficient,
        noisy.sensitivity,
        disturbances([v.weight for v in verdicts], [v.nodes for v in verdicts]),
    )


def _verdict(
    statement: Statement,
    log_evidence: float,
    share: float,
    nodes: Nodes,
    progress: float,
    coefficient: float,
    load: float,
) -> Verdict:
    """Return the result of a statement, with its probability among all of them."""
    at = nodes.hypotheses
    value, breadth = nodes.now(progress)
    now = quantiles(*_with_load(value, nodes.weight, breadth, load))
    before, after, transition = None, None, None
    if statement.spread:
        # The ratio is normal given ln K: as broad as an even spread of the same variance.
        breadth = np.sqrt(nodes.breadth**2 + 12.0 * nodes.covariance[:, 0, 0])
        first = quantiles(
            *_with_load(at.log_coefficient + nodes.log_ratio, nodes.weight, breadth, load)
        )
        before = _scaled(first, coefficient)
        last = quantiles(*_with_load(at.log_coefficient, nodes.weight, nodes.breadth, load))
        after = _scaled(last, coefficient)
        transition = _scaled(quantiles(np.log(at.transition), nodes.weight), 1.0)
    return Verdict(
        statement.name,
        share,
        log_evidence,
        _scaled(now, coefficient),
        before,
        after,
        transition,
        nodes,
    )


def _scaled(logarithm: Credible, unit: float) -> Credible:
    """Return limits of a quantity from those of its logarithm, in a unit."""
    return Credible(
        *(unit * float(np.exp(x)) for x in (logarithm.median, logarithm.low, logarithm.high))
    )
