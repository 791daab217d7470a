"""Virtual tests: depth of a joint of known wear coefficient with errors as a certificate states."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from model.identification import Bins, DepthLife, Prior, ProbeErrors, depth_life

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
