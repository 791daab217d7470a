"""Virtual tests: depth of a joint of known wear coefficient with errors as a certificate states."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rigapp_model.identification import Bin, Bins, DepthLife, Prior, ProbeErrors, depth_life
from rigapp_model.identification.bins import GROUP, trimmed

Array = NDArray[np.float64]

NOMINAL = 5e-13
ERRORS = ProbeErrors(0.01, 1e-6, 0.3e-6, 0.4e-6)
STEADY = replace(ERRORS, swing=0.0)
"""Of a room whose temperature is known not to swing."""
PRIOR = Prior(NOMINAL)
LN_4 = float(np.log(4.0))


def a_life() -> DepthLife:
    """Return a life of 60 um after 20,000 nominal cycles, ever slower as the contact widens."""
    progress = np.concatenate([[0.0], np.geomspace(1.0, 1e5, 200)])
    return depth_life(NOMINAL, progress, 60e-6 * ((1.0 + progress / 50.0) ** 0.75 - 1.0) / 88.6)


def readings(
    life: DepthLife,
    seed: int,
    last: int,
    scaled: Array | None = None,
    coefficient: float = 1.1 * NOMINAL,
) -> Array:
    """Return the measured depth (last,), m, of each revolution.

    scaled: progress at the life's coefficient, that of a constant one unless given.
    """
    number = np.arange(1.0, last + 1.0)
    q = coefficient / NOMINAL * number if scaled is None else scaled[:last]
    return measured(np.random.default_rng(seed), life.course.at(q)[0])[1]


def measured(
    random: np.random.Generator, depth: Array, life: DepthLife | None = None
) -> tuple[Array, Array]:
    """Return what probes read of a depth (n,), m, without and with their scatter.

    life: its doubt by the bushing's modulus is drawn too.
    """
    number = np.arange(1.0, depth.size + 1.0)
    e, b = random.normal(0.0, ERRORS.sensitivity), random.normal(0.0, ERRORS.reference)
    walked = np.diff(np.log(number), prepend=0.0)
    drift = np.cumsum(random.normal(size=depth.size) * ERRORS.drift * np.sqrt(walked))
    clean = (1.0 + e) * depth + b + drift
    if life is not None and life.elastic is not None:
        clean = clean + random.normal() * life.elastic_doubt(depth)
    return clean, clean + random.normal(0.0, ERRORS.scatter, depth.size)


def gathered(depth: Array) -> Bins:
    bins = Bins()
    for number, one in enumerate(depth, start=1):
        bins.add(number, float(number), float(one))
    return bins


def gathered_at_once(depth: Array, per_decade: float = 12.0) -> list[Bin]:
    """Return all at once the bins of ``gathered(depth)``, and the one that is being filled."""
    scratch, starts = Bins(per_decade), [1.0]
    while starts[-1] <= depth.size:
        starts.append(scratch._end_of(starts[-1]) + 1.0)
    found = []
    for low, after in pairwise([*starts[:-1], depth.size + 1.0]):
        part = depth[int(low) - 1 : int(after) - 1]
        number = np.arange(low, after)
        count = part.size // GROUP
        whole = np.sort(part[: count * GROUP].reshape(count, GROUP), axis=1)
        mean, size = whole[:, 2:-2].mean(axis=1), np.full(count, float(GROUP))
        at = number[: count * GROUP].reshape(count, GROUP).mean(axis=1)
        rest = part[count * GROUP :]
        if rest.size >= GROUP // 2:
            mean, size = np.append(mean, trimmed(list(rest))), np.append(size, rest.size)
            at = np.append(at, number[count * GROUP :].mean())
        middle, level = np.average(at, weights=size), np.average(mean, weights=size)
        along, across = at - middle, mean - level
        square = float(size @ along**2)
        left = float(size @ across**2) - float(size @ (along * across)) ** 2 / max(square, 1e-9)
        freedom = max(mean.size - 2, 0)
        steps = GROUP * (
            float((np.diff(mean) ** 2).sum()) - (mean[-1] - mean[0]) ** 2 / max(mean.size - 1, 1)
        )
        found.append(
            Bin(
                after - 1.0,
                low,
                float(middle),
                after - 1.0,
                float(level),
                int(size.sum()),
                max(left, 0.0) if freedom else 0.0,
                freedom,
                max(float(steps), 0.0) if freedom else 0.0,
            )
        )
    return found


@dataclass(frozen=True)
class Drawn:
    """Hold a virtual test: its coefficient, progress at K0 of each revolution, and its readings."""

    coefficient: float
    scaled: Array
    clean: Array
    depth: Array


def drawn(random: np.random.Generator, life: DepthLife, last: int, kind: str = "constant") -> Drawn:
    """Draw a test of so many revolutions: coefficient, statement and errors, all of them anew.

    A change is by a factor of up to 4 either way within the middle four fifths; running-in begins
    at up to 6 times the coefficient and takes 100 to 5,000 revolutions.
    """
    number = np.arange(1.0, last + 1.0)
    ratio = float(np.exp(random.normal(0.0, 0.3)))
    scaled = ratio * number
    if kind == "change":
        factor, at = np.exp(random.uniform(-LN_4, LN_4)), last * random.uniform(0.1, 0.9)
        scaled = ratio * (np.minimum(number, at) + factor * np.maximum(number - at, 0.0))
    elif kind == "running-in":
        first, place = (
            np.exp(random.uniform(*np.log([1.2, 6.0]))),
            random.uniform(*np.log([100, 5e3])),
        )
        place = np.exp(place)
        scaled = ratio * (number + (first - 1.0) * place * -np.expm1(-number / place))
    return Drawn(ratio * NOMINAL, scaled, *measured(random, life.course.at(scaled)[0], life))


def moved(life: DepthLife, scaled: Array) -> float:
    """Return how far the depth is from what any constant coefficient makes of it.

    The largest distance over the test from the nearest course, in standard deviations of a reading
    by scatter and drift.
    """
    last = scaled.size
    number = np.unique(np.geomspace(1, last, 80).astype(np.int64))
    true = life.course.at(scaled[number - 1])[0]
    noise = np.hypot(ERRORS.scatter, ERRORS.drift * np.sqrt(np.log(number)))
    ratios = scaled[-1] / last * np.geomspace(0.2, 5.0, 200)
    other = life.course.at(ratios[:, None] * number)[0]
    return float((np.abs(other - true) / noise).max(axis=1).min())
