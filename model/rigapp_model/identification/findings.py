"""Disturbances of a test's probes, from the bins: creep, slow swing, steps, correlated noise."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification.posterior import Nodes
from rigapp_model.identification.shapes import COLUMNS, CREEP, HEAT, STEP, SWING, WARMTH

Array = NDArray[np.float64]

CREEP_NAME, SWING_NAME, STEP_NAME = "creep", "swing", "step"
COLOUR_NAME, HEAT_NAME = "correlated noise", "temperature"
FOUND = 0.95
"""Probability from which a disturbance is reported."""
SIGMAS = 2.0
"""Standard uncertainties from 0 beyond which creep, a swing and the effect of temperature are
reported."""


@dataclass(frozen=True, slots=True)
class Disturbance:
    """Disturbance of the probes.

    name: a constant above; size: m, of creep per decade, of temperature per kelvin, amplitude of a
    swing, signed step, standard deviation of correlated noise; doubt: standard uncertainty of size,
    m; revolutions: period of the swing, revolution of the step, correlation length; 0 for creep and
    temperature; probability: of its presence.
    """

    name: str
    size: float
    doubt: float
    revolutions: float
    probability: float


def disturbances(weights: Sequence[float], nodes: Sequence[Nodes]) -> tuple[Disturbance, ...]:
    """Return the disturbances averaged over all statements, given by weights and nodes."""
    weight = np.concatenate([w * n.weight for w, n in zip(weights, nodes, strict=True)])
    weight = weight / weight.sum()
    states = np.concatenate([n.left for n in nodes])
    spare = np.concatenate(
        [n.spare + n.pulled @ n.covariance @ n.pulled.swapaxes(1, 2) for n in nodes]
    )
    period, size, length = (
        np.concatenate([getattr(n.kinds, name) for n in nodes])
        for name in ("period", "size", "length")
    )
    jump = np.concatenate([n.kinds.jump for n in nodes])
    steps = nodes[0].steps
    result = []
    creeps = np.concatenate([n.kinds.creeps for n in nodes]) > 0.0
    if weight[creeps].sum() > FOUND:
        share = weight * creeps / weight[creeps].sum()
        mean, doubt = _moments(share, states[:, 2], spare[:, 2, 2])
        decade = CREEP * float(np.log(10.0))
        if abs(mean) > SIGMAS * doubt:
            held = float(weight[creeps].sum())
            result.append(Disturbance(CREEP_NAME, decade * mean, decade * doubt, 0.0, held))
    mean, doubt = _moments(weight, states[:, 2 + HEAT], spare[:, 2 + HEAT, 2 + HEAT])
    if abs(mean) > SIGMAS * doubt:
        result.append(Disturbance(HEAT_NAME, WARMTH * mean, WARMTH * doubt, 0.0, 1.0))
    swings = period > 0.0
    if weight[swings].sum() > FOUND:
        share = weight * swings / weight[swings].sum()
        by = SWING * np.hypot(states[:, 3], states[:, 4])
        mean, doubt = _moments(share, by, SWING**2 * 0.5 * (spare[:, 3, 3] + spare[:, 4, 4]))
        if mean > SIGMAS * doubt:
            middle = float(np.exp(share @ np.log(np.where(swings, period, 1.0))))
            result.append(Disturbance(SWING_NAME, mean, doubt, middle, float(weight @ swings)))
    for index, (first, last) in enumerate(steps):
        state = COLUMNS + 2 + 2 * index
        mean, doubt = _moments(weight, states[:, state], spare[:, state, state])
        result.append(
            Disturbance(STEP_NAME, STEP * mean, STEP * doubt, 0.5 * float(first + last), 1.0)
        )
    stepped = jump[:, 1] > 0.0
    if weight[stepped].sum() > FOUND:
        share = weight * stepped / weight[stepped].sum()
        mean, doubt = _moments(share, states[:, 3], spare[:, 3, 3])
        at = float(share @ jump.mean(axis=1))
        result.append(
            Disturbance(STEP_NAME, STEP * mean, STEP * doubt, at, float(weight[stepped].sum()))
        )
    coloured = size > 0.0
    if weight[coloured].sum() > FOUND:
        share = weight * coloured / weight[coloured].sum()
        middle = float(np.exp(share @ np.log(np.maximum(length, 1.0))))
        mean, doubt = _moments(share, size, np.zeros(size.size))
        result.append(Disturbance(COLOUR_NAME, mean, doubt, middle, float(weight[coloured].sum())))
    return tuple(result)


def _moments(weight: Array, mean: Array, variance: Array) -> tuple[float, float]:
    """Return mean and standard deviation of a mixture."""
    centre = float(weight @ mean)
    spread = float(weight @ (np.maximum(variance, 0.0) + (mean - centre) ** 2))
    return centre, float(np.sqrt(spread))
