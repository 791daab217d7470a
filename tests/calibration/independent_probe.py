"""A capacitance probe before a micrometer, that shares nothing with the evaluation.

Written from the physics alone: it imports nothing of the program. The screw of the micrometer has a
progressive error, one that comes back with every turn, and one of setting it; the probe bends, has
a part of third degree, a memory of the way it was approached, noise, and wanders while it warms up.
Lengths in um, signals in V.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

SCREW_TURN = 500.0
"""Lead of a micrometer's screw, um."""
PART = 0.2
"""Of a micrometer's variance that comes back with each turn, and as much that is of setting it."""


@dataclass(frozen=True)
class Nature:
    """What a probe and its micrometer are beside ideal; parts of the half range where not in um.

    reach: half of the range that is calibrated, um. sensitivity: um/V. screw: standard deviation of
    a position of the micrometer, um: of its variance most is progressive, a fifth comes back with
    each turn, a fifth is of setting it.
    bend, third: at the ends. loop: between going out and coming back. drift: from the first to the
    last reading, standard deviation. noise: of one reading, um; display: its step, V.
    """

    reach: float = 800.0
    sensitivity: float = 100.0
    screw: float = 0.5
    bend: float = 0.0
    third: float = 0.0
    loop: float = 0.0
    drift: float = 0.0
    noise: float = 0.2
    display: float = 3e-4


@dataclass
class Probe:
    """One probe with its micrometer, drawn by its generator."""

    nature: Nature
    rng: np.random.Generator

    def __post_init__(self) -> None:
        n, rng = self.nature, self.rng
        part = n.screw * math.sqrt(PART)
        self.slope = rng.choice([-1.0, 1.0]) / n.sensitivity * (1.0 + rng.normal(0.0, 0.02))
        self.offset = rng.normal(0.0, 0.1)
        self.progressive = rng.normal(0.0, n.screw) * math.sqrt(3.0 * (1.0 - 2.0 * PART))
        self.wave = part * math.sqrt(2.0)
        self.phase = rng.uniform(0.0, 2.0 * math.pi)
        self.setting = part
        self.signs = rng.choice([-1.0, 1.0], 3)
        self.wander = rng.normal(0.0, n.drift) * n.reach

    def stands(self, written: float) -> float:
        """Return where the target stands, um, when the micrometer shows a position."""
        wave = self.wave * math.sin(2.0 * math.pi * written / SCREW_TURN + self.phase)
        own = self.rng.normal(0.0, self.setting)
        return written + self.progressive * written / self.nature.reach + wave + own

    def voltage(self, stands: float, falling: bool, moment: float, readings: int = 1) -> float:
        """Return what is read, V, the mean of so many; moment: -0.5 .. 0.5 of the calibration."""
        n, share = self.nature, stands / self.nature.reach
        seen = stands + n.reach * (
            n.bend * self.signs[0] * share**2
            + n.third * self.signs[1] * share**3
            + n.loop * self.signs[2] * (0.5 if falling else -0.5)
        )
        seen += self.wander * moment
        fine = self.offset + self.slope * (seen + self.rng.normal(0.0, n.noise, readings))
        return float((np.round(fine / n.display) * n.display).mean())


Table = list[tuple[str, int, float, float]]


def take(probe: Probe, positions: int = 11, runs: int = 3) -> Table:
    """Return readings as a technician writes them: series, step, um, V; up and down each run."""
    rising = np.linspace(-probe.nature.reach, probe.nature.reach, positions)
    way = [(x, False) for x in rising] + [(x, True) for x in rising[-2::-1]]
    rows, last = [], runs * len(way) - 1
    for run in range(runs):
        for step, (x, falling) in enumerate(way):
            moment = len(rows) / last - 0.5
            volts = probe.voltage(probe.stands(x), falling, moment)
            rows.append((str(run + 1), step + 1, float(x), volts))
    return rows


@dataclass(frozen=True)
class Used:
    """A position in use, um, and what is read of it, V: once, and as the mean of many."""

    position: float
    one: float
    many: float


def use(probe: Probe, mean_of: int = 25) -> Used:
    """Bring the pin anywhere in the range, from either side, at any moment of the drift."""
    rng = probe.rng
    at = rng.uniform(-1.0, 1.0) * probe.nature.reach
    falling, moment = bool(rng.random() < 0.5), rng.uniform(-0.5, 0.5)
    one, many = (probe.voltage(at, falling, moment, count) for count in (1, mean_of))
    return Used(float(at), one, many)
