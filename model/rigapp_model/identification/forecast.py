"""What is to come: revolutions that remain to a depth, and the band in which depth will lie."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtr

from rigapp.texts import say
from rigapp_model.errors import require_positive
from rigapp_model.identification.inference import Credible, Identification
from rigapp_model.identification.life import DepthLife
from rigapp_model.identification.posterior import Nodes
from rigapp_model.identification.shapes import HEAT, SWING, WARMTH, Moments, shapes

Array = NDArray[np.float64]

SHARE, ROUGH_SHARES = 1.0 - 1e-3, (0.97, 0.995)
"""Nodes that hold this share of the posterior decide its 95 % limits to a hundredth of a sigma, and
those that hold the others where they are, first and then."""
MARGIN = 4.0
"""The life must reach so many standard uncertainties beyond a depth for its limits to be known."""
TIMES = 32
"""Revolutions at which the probability of a depth is computed first; then where it is as in NEAR,
twice."""
AROUND = (-0.2, -0.08, -0.03, -0.012, -0.004, 0.0, 0.004, 0.012, 0.03, 0.08, 0.2)
SWING_COLUMNS = (3, 4)
"""Of cosine and sine, behind the level, the noise and the creep."""
LEVELS = (0.025, 0.5, 0.975)
NEAR = np.unique([np.clip(one + np.array(AROUND), 1e-3, 0.999) for one in LEVELS])


@dataclass(frozen=True, slots=True)
class Remaining:
    """Hold how many revolutions remain until the depth (m) is reached; None with a reason in words.

    high is infinite where the computed life does not hold it.
    """

    depth: float
    revolutions: Credible | None
    reason: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Band:
    """Hold median and 95 % limits of the depth (n,), m, at revolutions (n,).

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

    rate: what a revolution will add to progress, nominal cycles, as of late unless told; measured:
    whether the depth is one that the probes will read, as a stop criterion does, with their errors
    so far, or the depth itself, whose uncertainty holds that of the sensitivity and the reference.
    It is by all statements with their weights.
    """
    require_positive("depth", depth, "m")
    known, errors = identification, identification.errors
    needed = (depth + MARGIN * errors.reference) / (1.0 - min(MARGIN * known.sensitivity, 0.5))
    if needed > life.reach:
        return Remaining(
            depth,
            None,
            say(
                "beyond what the model computes: its life reaches {:.4g} um, and {:.4g} um"
                " are needed for the limits of {:.4g} um",
                1e6 * life.reach,
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
    """Return the statements that a forecast is by: weights, which sum up to 1, and nodes."""
    verdicts = [one for one in known.verdicts if one.weight > 1e-4]
    total = sum(one.weight for one in verdicts)
    return [(one.weight / total, one.nodes.heaviest(SHARE)) for one in verdicts]


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
    found = np.zeros(ahead.size)
    for weight, nodes in believed:
        at = known.revolution + ahead
        mean, deviation = _depths(known, life, nodes, at, rate, measured)
        if measured:
            mean = mean + _to_crest(nodes, at, known.revolution)
        found += weight * (nodes.weight @ ndtr((mean - depth) / deviation))
    return np.maximum.accumulate(found)


def _to_crest(nodes: Nodes, at: Array, now: float) -> Array:
    """Return what a swing's crest is above the swing at revolutions (H, n), m, 0 without one.

    A reading that swings reaches a depth first at a crest; one of them is passed in each period.
    """
    period = np.where(nodes.kinds.period > 0.0, nodes.kinds.period, np.inf)[:, None]
    cosine, sine = (nodes.left[:, one, None] for one in SWING_COLUMNS)
    turn = 2.0 * np.pi * at / period
    rise = np.hypot(cosine, sine) - cosine * np.cos(turn) - sine * np.sin(turn)
    return np.where(at - now >= period, SWING * rise, 0.0)


def _depths(
    known: Identification, life: DepthLife, nodes: Nodes, at: Array, rate: float, measured: bool
) -> tuple[Array, Array]:
    """Return mean and standard deviation of the depth (H, n), m, by each node at revolutions (n,).

    What the bins leave of the drift goes on from the last bin as a random walk, and the correlated
    noise falls from what it was to none. The temperature is what it was in the mean, with its
    spread.
    """
    progress = known.progress + rate * (at - known.revolution)
    found, slopes = life.depth(progress, nodes.hypotheses.scaled(np.zeros(0)))
    by_ratio = slopes[1]
    if not measured:
        mean = found + nodes.mean[:, :1] * by_ratio
        variance = by_ratio**2 * nodes.covariance[:, :1, 0]
        return mean, np.sqrt(variance + 1e-24)
    columns = np.empty((*found.shape, 4))
    columns[:, :, 0], columns[:, :, 1] = by_ratio, known.sensitivity * found
    columns[:, :, 2], columns[:, :, 3] = known.errors.reference, life.elastic_doubt(found)
    kinds, heat = nodes.kinds, 2 + HEAT
    usual, spread = _warmth(known)
    warm = np.full(at.size, usual)
    falls = np.exp(-np.maximum(at - known.revolution, 0.0) / kinds.length[:, None])
    # Many nodes have few shapes.
    rows = np.column_stack([kinds.period, kinds.jump, kinds.creeps])
    _, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    some = kinds.at(first)
    each = shapes(some.period, some.jump, some.creeps, nodes.steps, Moments(at, at, warm))
    onward = np.empty((*found.shape, 2 + each.shape[1]))
    onward[:, :, 0], onward[:, :, 1] = 1.0, falls
    onward[:, :, 2:] = each.swapaxes(1, 2)[which.ravel()]
    mean = (
        found
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
    found = [_level(level, weight, mean, deviation, low, high) for level in LEVELS]
    beyond = (
        found[2] > life.reach * (1.0 - MARGIN * known.sensitivity) - MARGIN * known.errors.reference
    )
    lower, middle, upper = (np.where(beyond, np.nan, one) for one in found)
    return Band(at, middle, lower, upper)


def _level(
    level: float, weight: Array, mean: Array, deviation: Array, low: Array, high: Array
) -> Array:
    """Return the depth (n,), m, that a mixture of normals is below with a probability."""
    for _ in range(20):  # a millionth of what lies between low and high
        middle = 0.5 * (low + high)
        below = weight @ ndtr((middle - mean) / deviation) < level * weight.sum()
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return 0.5 * (low + high)
