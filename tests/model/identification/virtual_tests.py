"""Virtual tests: depth of a joint of known wear coefficient with errors as a certificate states."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from model.identification import Bin, Bins, DepthLife, Prior, ProbeErrors, depth_life
from model.identification.bins import GROUP, trimmed

Array = NDArray[np.float64]

NOMINAL = 5e-13
ERRORS = ProbeErrors(0.01, 1e-6, 0.3e-6, 0.4e-6)
PRIOR = Prior(NOMINAL)


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
    random = np.random.default_rng(seed)
    number = np.arange(1.0, last + 1.0)
    q = coefficient / NOMINAL * number if scaled is None else scaled
    e, b = random.normal(0.0, ERRORS.sensitivity), random.normal(0.0, ERRORS.reference)
    walked = np.diff(np.log(number), prepend=0.0)
    drift = np.cumsum(random.normal(size=last) * ERRORS.drift * np.sqrt(walked))
    scatter = random.normal(0.0, ERRORS.scatter, last)
    return (1.0 + e) * life.stretches[0].at(q)[0] + b + drift + scatter


def gathered(depth: Array) -> Bins:
    bins = Bins()
    for number, one in enumerate(depth, start=1):
        bins.add(number, float(number), float(one))
    return bins


def gathered_at_once(depth: Array, per_decade: float = 12.0) -> list[Bin]:
    """Return the closed bins of ``gathered``, of revolutions from 1 on, all at once."""
    scratch, starts = Bins(per_decade), [1.0]
    while starts[-1] <= depth.size:
        starts.append(scratch._end_of(starts[-1]) + 1.0)
    found = []
    for low, after in pairwise(starts[:-1]):
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
            )
        )
    return found
