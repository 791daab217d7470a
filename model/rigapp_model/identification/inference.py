"""Wear coefficient of a running test: posteriors of the statements, compared by evidence."""

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
    """Median of a quantity and its 95 % credible limits."""

    median: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, eq=False)
class Verdict:
    """Result of one statement.

    weight: its probability among all; log_evidence; coefficient: present, m^2/N; before: the first,
    after: the last, transition: progress of the change or of the running-in, nominal cycles; None
    for a constant coefficient.
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
    """Wear coefficient after some bins.

    coefficient: present, averaged over all statements, m^2/N; mean: of ln K; spread: its standard
    deviation, without that of the load; verdicts: by statement, the most probable first; drift:
    mean of its strength, m per root of ln n; readings: the bins; prior, errors: as used;
    life_coefficient: K0, m^2/N; sensitivity: relative standard uncertainty, including that of the
    life's computation; disturbances: of the probes, included in the limits.
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
        """Return the progress per revolution, nominal cycles, over the last two bins."""
        by = self.readings
        revolutions = float(by.revolution[-1] - by.revolution[-3])
        return float(self.progress - by.progress[-3] - by.half[-3]) / revolutions

    @property
    def progress(self) -> float:
        """Return the measured progress at the last revolution, nominal cycles."""
        return float(self.readings.progress[-1] + self.readings.half[-1])

    @property
    def revolution(self) -> float:
        """Return the last revolution used."""
        return float(self.readings.revolution[-1])

    def density(self, points: int = 121) -> tuple[Array, Array]:
        """Return coefficients (points,), m^2/N, and the density of ln K there (points,)."""
        at = self.mean + np.linspace(-4.5, 4.5, points) * self.spread
        now = _coefficients(self.verdicts, self.progress)
        edges, cumulative = distribution(*_with_load(*now, self.errors.scale))
        by = np.interp(at - np.log(self.life_coefficient), edges, cumulative)
        return np.exp(at), np.gradient(by, at)


def distribution(values: Array, weights: Array, breadth: Array | float) -> tuple[Array, Array]:
    """Return the nodes of the piecewise linear distribution function, and its values.

    Each value is distributed uniformly over its breadth; the sum of weights is 1.
    """
    wide = np.broadcast_to(np.maximum(breadth, 1e-9), values.shape)
    edges = np.concatenate([values - 0.5 * wide, values + 0.5 * wide])
    order = np.argsort(edges)
    density = np.cumsum(np.concatenate([weights / wide, -weights / wide])[order])
    edges = edges[order]
    cumulative = np.cumsum(np.append(0.0, density[:-1] * np.diff(edges)))
    return edges, np.maximum.accumulate(cumulative / cumulative[-1])


def quantiles(values: Array, weights: Array, breadth: Array | float = 0.0) -> Credible:
    """Return median and 95 % limits of ``distribution``."""
    edges, cumulative = distribution(values, weights, breadth)
    low, median, high = np.interp([0.025, 0.5, 0.975], cumulative, edges)
    return Credible(float(median), float(low), float(high))


LOADS = ndtri((np.arange(9) + 0.5) / 9.0)
"""Equally probable errors of the load, in standard uncertainties."""


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
    """Return present ln(K/K0), weight and breadth of all nodes of the statements."""
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

    life: must be computed beyond the present depth. Deterministic. Raises NotIdentifiable with a
    reason.
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
        # The ratio is normal given ln K: replaced by a uniform distribution of the same variance.
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
    """Return the limits of a quantity, in a unit, from those of its logarithm."""
    return Credible(
        *(unit * float(np.exp(x)) for x in (logarithm.median, logarithm.low, logarithm.high))
    )
