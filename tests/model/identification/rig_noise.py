"""Tests of a joint whose probes are disturbed as those of laboratories are: a world of its own.

Nothing here is from the estimator. The joint is a rigid crescent: the pin, displaced by the depth,
cuts an area out of the bushing, which grows by Archard's law. Its elastic approach is that of a
Winkler layer. Disturbances are filtered noise, sines, steps, logarithmic creep, outliers, gaps, and
a joint whose modulus, clearance or load differ from what the estimator is told.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

Array = NDArray[np.float64]

LAST = 21_377
COEFFICIENT = 5e-13
RADIUS, CLEARANCE, FORCE, STIFFNESS = 9.5e-3, 0.25e-3, 110.0, 2e11
"""m, m, N, and N/m^3 of the layer."""
WIDTH = 0.0131
SLIP = 2.0 * np.pi * RADIUS
AFTER = 60e-6
"""Depth that the default joint has after LAST revolutions, m: the force-slip product is set so."""
SCATTER = 0.4e-6
DAY, HOUR = 43_200.0, 1_800.0
"""Revolutions of a day and an hour at the 30 rpm of the usual rig."""


@dataclass(frozen=True)
class Joint:
    """Hold a joint: clearance m, stiffness N/m^3, load relative to the usual."""

    clearance: float = CLEARANCE
    stiffness: float = STIFFNESS
    load: float = 1.0

    def area(self, depth: Array) -> Array:
        """Return the area (m^2) that the pin cuts out at depths (n,), m."""
        apart = self.clearance + depth
        angle = np.arccos(self.clearance / apart)
        return np.asarray(2.0 * RADIUS * (apart * np.sin(angle) - self.clearance * angle))

    def approach(self, depth: Array) -> Array:
        """Return the elastic approach (m) at depths (n,), m."""
        angle = np.arccos(self.clearance / (self.clearance + np.maximum(depth, 0.0) + 10e-6))
        return np.asarray(
            FORCE * self.load / (2.0 * self.stiffness * WIDTH * RADIUS * np.sin(angle))
        )


USUAL = Joint()
FINE_DEPTHS = np.concatenate([[0.0], np.geomspace(1e-9, 1.2e-3, 6000)])
UNIT = float(USUAL.area(np.array([AFTER]))[0]) / LAST
"""Area (m^2) that a revolution of the usual joint wears at COEFFICIENT."""


def worn(joint: Joint, progress: Array) -> Array:
    """Return the depth (n,), m, after progress (n,): revolutions at COEFFICIENT and usual load."""
    return np.interp(progress * UNIT * joint.load, joint.area(FINE_DEPTHS), FINE_DEPTHS)


def read_through(true: Joint, told: Joint, depth: Array) -> Array:
    """Return the depth that is read off, where the approach is taken out by another joint's."""
    seen = depth + true.approach(depth) - true.approach(np.zeros(1))
    table = FINE_DEPTHS + told.approach(FINE_DEPTHS) - told.approach(np.zeros(1))
    return np.interp(seen, np.maximum.accumulate(table), FINE_DEPTHS)


@dataclass(frozen=True, eq=False)
class Recorded:
    """Hold a test, a reading a revolution.

    ratio: of K to COEFFICIENT; true, clean, read (n,): depth, with errors that last (creep, swing
    and step among them), and with all of them, m; room (n,): temperature beside the usual one, K.
    """

    ratio: float
    true: Array
    clean: Array
    read: Array
    room: Array


def filtered(random: np.random.Generator, length: float, count: int) -> Array:
    """Return noise of unit deviation whose correlation falls by e in so many revolutions."""
    keep = float(np.exp(-1.0 / length))
    kicks = random.normal(size=count) * np.sqrt(1.0 - keep**2)
    kicks[0] = random.normal()
    return np.asarray(lfilter([1.0], [1.0, -keep], kicks))


def swing(random: np.random.Generator, period: float, size: float) -> Callable[[Array], Array]:
    """Return a sine of an amplitude (m) with a random phase."""
    phase = random.uniform(0.0, 2.0 * np.pi)
    return lambda number: size * np.sin(2.0 * np.pi * number / period + phase)


KINDS = (
    "white", "AR 20", "AR 200", "daily", "hourly", "step", "creep", "outliers", "gaps",
    "modulus", "clearance", "gain",
)  # fmt: skip


def recorded(kind: str, seed: int, doubled_at: int | None = None) -> Recorded:
    """Return a test with one kind of disturbance.

    Every test has a sensitivity (1 %), a zero (1 um), a modulus (20 %) and 0.4 um of scatter of its
    own, as they are stated to the estimator.
    doubled_at: revolution from which the coefficient is twice as large.
    """
    random = np.random.default_rng([KINDS.index(kind), seed])
    number = np.arange(1.0, LAST + 1.0)
    ratio = float(np.exp(random.normal(0.0, 0.3)))
    wrong = (
        1.2 ** random.choice([-1.0, 1.0])
        if kind == "modulus"
        else float(np.exp(random.normal(0.0, 0.2)))
    )
    joint = Joint(stiffness=STIFFNESS * wrong)
    if kind == "clearance":
        joint = replace(joint, clearance=CLEARANCE * (1.0 + random.normal(0.0, 0.1)))
    if kind == "gain":
        joint = replace(joint, load=1.0 + random.normal(0.0, 0.02))
    made = ratio * number
    if doubled_at is not None:
        made = made + ratio * np.maximum(number - doubled_at, 0.0)
    true = worn(joint, made)
    seen = read_through(joint, USUAL, true)
    clean = (1.0 + random.normal(0.0, 0.01)) * seen + random.normal(0.0, 1e-6)
    walk = np.sqrt(np.diff(np.log(number), prepend=0.0))
    clean = clean + 0.3e-6 * np.cumsum(random.normal(size=LAST) * walk)
    noise = SCATTER * random.normal(size=LAST)
    room = 0.02 * random.normal(size=LAST)
    if kind.startswith("AR"):
        noise = SCATTER * filtered(random, float(kind[3:]), LAST)
    if kind in ("daily", "hourly"):
        course = swing(random, DAY if kind == "daily" else HOUR, 1e-6)(number)
        course -= course[:100].mean()
        room = room + course / 0.5e-6
        clean = clean + course
    if kind == "step":
        at = random.integers(2000, LAST)
        clean = clean + np.where(number > at, 2e-6 * random.choice([-1.0, 1.0]), 0.0)
    if kind == "creep":
        clean = clean + 2e-6 * np.log10(number) * random.choice([-1.0, 1.0])
    if kind == "outliers":
        wrong = random.random(LAST) < 0.02
        noise = np.where(wrong, 20e-6 * random.standard_t(2.0, LAST), noise)
    read = clean + noise
    if kind == "gaps":
        for _ in range(5):
            begin = int(random.integers(100, LAST - 2500))
            read[begin : begin + int(random.integers(50, 2500))] = np.nan
    return Recorded(ratio, true, clean, read, room)
