"""The wear coefficient from a running test: posterior of each statement, compared by evidence."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from model.identification.bins import Bin, Bins
from model.identification.errors import Prior, ProbeErrors
from model.identification.evidence import DepthBins, noise_of, readings_of
from model.identification.life import DepthLife
from model.identification.posterior import Given, Nodes, constant_posterior
from model.identification.statements import STATEMENTS

Array = NDArray[np.float64]

STRENGTHS = (1.0, 1.6, 2.5, 4.0, 6.3)
"""Strengths of the drift compared, in units of the record's lower bound: five to the decade."""
STRENGTH_DECAY = 2.0
"""Each next strength is less probable beforehand by exp of this: the record is believed."""
LEAST_DRIFT = 1e-9
"""A record without drift counts as one of so little, m: the table of strengths needs a unit."""


@dataclass(frozen=True, slots=True)
class Credible:
    """Hold the median of a quantity with its 95 % credible limits."""

    median: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, eq=False)
class Verdict:
    """Hold what one statement comes to.

    weight: its probability among all; log_evidence; coefficient: now, m^2/N; before: the first
    one, and place: progress at which it changed or within which it ran in, nominal cycles, None
    for a constant one.
    """

    name: str
    weight: float
    log_evidence: float
    coefficient: Credible
    before: Credible | None
    place: Credible | None
    nodes: Nodes


@dataclass(frozen=True, slots=True, eq=False)
class Identification:
    """Hold what is known of the wear coefficient after some bins.

    coefficient: now, all statements by their weights, m^2/N; mean: of ln K; spread: its standard
    deviation; verdicts: by statement, the most probable first; drift: strength, m per root of ln n;
    readings: the bins; prior, errors: what they were judged with; life_coefficient: K0, m^2/N;
    sensitivity: relative standard uncertainty, with that of the life's computation.
    """

    coefficient: Credible
    mean: float
    spread: float
    verdicts: tuple[Verdict, ...]
    drift: Credible
    readings: DepthBins
    prior: Prior
    errors: ProbeErrors
    life_coefficient: float
    sensitivity: float

    @property
    def best(self) -> Verdict:
        """Return the most probable statement."""
        return self.verdicts[0]

    @property
    def rate(self) -> float:
        """Return what a revolution adds to progress, nominal cycles, by the last two bins."""
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
        """Return coefficients (points,), m^2/N, and the density of ln K there (points,).

        It is that of all statements, over its whole breadth.
        """
        values, weights = self._all()
        centre, spread = self.mean, self.spread
        at = centre + np.linspace(-4.5, 4.5, points) * spread
        order = np.argsort(values)
        reached = np.interp(at, values[order], np.cumsum(weights[order]))
        return self.life_coefficient * np.exp(at), np.gradient(reached, at)

    def _all(self) -> tuple[Array, Array]:
        """Return ln(K/K0) and weight of all nodes."""
        values = [v.nodes.hypotheses.log_coefficient for v in self.verdicts]
        weights = [v.weight * v.nodes.weight for v in self.verdicts]
        return np.concatenate(values), np.concatenate(weights)


def quantiles(values: Array, weights: Array) -> Credible:
    """Return median and 95 % limits of weighted values."""
    order = np.argsort(values)
    w = weights[order]
    reached = (np.cumsum(w) - 0.5 * w) / w.sum()
    low, median, high = np.interp([0.025, 0.5, 0.975], reached, values[order])
    return Credible(float(median), float(low), float(high))


def identify(
    bins: Bins | Sequence[Bin], life: DepthLife, errors: ProbeErrors, prior: Prior
) -> Identification:
    """Return what bins of the measured depth tell of the wear coefficient.

    life: must be computed beyond the depth measured so far. Pure: the same bins give the same
    numbers. Raises CannotBeTold in words where nothing can be stated.
    """
    closed = bins.closed if isinstance(bins, Bins) else bins
    given = Given(readings_of(closed, errors), life, errors, prior)
    drift = max(errors.drift, LEAST_DRIFT)
    noises = [noise_of(given.readings, drift * one) for one in STRENGTHS]
    log_prior = -STRENGTH_DECAY * np.arange(len(STRENGTHS))
    log_prior = log_prior - np.logaddexp.reduce(log_prior)
    found = [
        (one, *constant_posterior(given, one, noises, log_prior))
        for one in STATEMENTS
        if not one.spread
    ]
    total = np.logaddexp.reduce([evidence for _, evidence, _ in found])
    verdicts = tuple(
        sorted(
            (
                Verdict(
                    one.name,
                    float(np.exp(evidence - total)),
                    evidence,
                    _coefficient(nodes, life.coefficient, 0.0),
                    _coefficient(nodes, life.coefficient, 1.0) if one.spread else None,
                    quantiles(nodes.hypotheses.place, nodes.weight) if one.spread else None,
                    nodes,
                )
                for one, evidence, nodes in found
            ),
            key=lambda each: -each.weight,
        )
    )
    values = np.concatenate([v.nodes.hypotheses.log_coefficient for v in verdicts])
    weights = np.concatenate([v.weight * v.nodes.weight for v in verdicts])
    strengths = np.concatenate([v.nodes.strength for v in verdicts])
    mean = float(weights @ values)
    spread = float(np.sqrt(weights @ (values - mean) ** 2))
    now = quantiles(values, weights)
    k0 = life.coefficient
    return Identification(
        Credible(*(k0 * float(np.exp(each)) for each in (now.median, now.low, now.high))),
        mean + float(np.log(k0)),
        spread,
        verdicts,
        quantiles(strengths, weights),
        given.readings,
        prior,
        errors,
        k0,
        given.sensitivity,
    )


def _coefficient(nodes: Nodes, coefficient: float, first: float) -> Credible:
    """Return the coefficient now, or the first one (first = 1), m^2/N."""
    values = nodes.hypotheses.log_coefficient + first * nodes.log_ratio
    found = quantiles(values, nodes.weight)
    return Credible(
        *(coefficient * float(np.exp(each)) for each in (found.median, found.low, found.high))
    )
