"""A pin load cell in the time domain, from 5 N to 20 kN, that shares nothing with the evaluation.

Written from the physics alone: it imports nothing of the program. Pieces hang from a pin that is
turned in the vertical plane; each bridge answers a component of the force in the pin's frame. The
memory of the metal is a row of play operators (Prandtl and Ishlinskii), creep relaxes with two time
constants, the amplifier warms up, the pin outboard of the gauges weighs something, and the load is
introduced by an adapter that is another one in use. Whatever a mass is said to be, the cell reads
what hangs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

G = 9.80722
"""Where this cell stands, m/s^2."""
AIR, STEEL = 1.2, 8000.0
NEWTON_PER_KG = G * (1.0 - AIR / STEEL)
"""Of pieces of steel in air, whose mass is the conventional one."""
PLAYS = np.array([0.02, 0.05, 0.1, 0.18, 0.3])
"""Half widths of the plays, of full scale."""
CREEP_S = np.array([40.0, 400.0])


@dataclass(frozen=True)
class Nature:
    """What a cell is beside ideal; parts of full scale, or of the load where it says so.

    loop: of the hysteresis at its widest. creep: of the load, within minutes. warm_zero, warm_gain:
    until the amplifier is warm. pin: own weight that turns. noise: of one reading. display: its
    step. introduction: of the load, between one adapter and the next. product: f1 f2 in both
    bridges, cubic: of x y^2 and y x^2, bow: of the cube of each component, all at full scale.
    dead_zone: of full scale, that friction at the hanger holds back. setting_deg: of the angle of a
    series. rated: mV/V at full scale.
    """

    full_scale: float = 400.0
    rated: float = 1.6
    noise: float = 2e-4
    display: float = 1e-5
    loop: float = 0.0
    creep: float = 0.0
    warm_zero: float = 0.0
    warm_gain: float = 0.0
    pin: float = 0.0
    introduction: float = 0.0
    product: float = 0.0
    cubic: float = 0.0
    bow: float = 0.0
    dead_zone: float = 0.0
    setting_deg: float = 0.0


@dataclass
class TimeCell:
    """One cell with a memory. Drawn by its generator; ``scale``: of the forces that really hang."""

    nature: Nature
    rng: np.random.Generator
    scale: float = 1.0
    turned: float = 0.0
    time: float = 0.0
    plays: np.ndarray = field(default_factory=lambda: np.zeros((2, len(PLAYS))))
    crept: np.ndarray = field(default_factory=lambda: np.zeros((2, len(CREEP_S))))
    last: np.ndarray = field(default_factory=lambda: np.zeros(2))

    def __post_init__(self) -> None:
        per_newton = self.nature.rated / self.nature.full_scale
        mixed = np.eye(2) + self.rng.normal(0.0, 0.01, (2, 2))
        self.gain = per_newton * mixed
        self.offset = self.rng.normal(0.0, 0.01, 2)
        self.warm = self.rng.choice([-1.0, 1.0], 2)
        self.signs = self.rng.choice([-1.0, 1.0], (3, 2))
        self.change_adapter()

    def change_adapter(self) -> None:
        """Introduce the load in another way from here on."""
        half = self.nature.introduction
        self.adapter = self.rng.uniform(-half, half, 2)

    def weight(self, newton: float, angle: float) -> np.ndarray:
        """Return a weight in the pin's frame, the pin at an angle (rad)."""
        turned = angle + self.turned
        return -newton * np.array([math.sin(turned), math.cos(turned)])

    def feel(self, force: np.ndarray, angle: float, seconds: float) -> None:
        """Hang a force (N, pin frame) and let it act for so many seconds."""
        n = self.nature
        own = self.weight(n.pin * n.full_scale, angle)
        size = float(np.hypot(*force))
        held = max(0.0, size - n.dead_zone * n.full_scale) / size if size else 0.0
        along, across = self.adapter
        felt = held * (force * (1.0 + along) + across * np.array([-force[1], force[0]])) + own
        share = felt / n.full_scale
        for axis in range(2):
            self.plays[axis] = np.clip(self.plays[axis], share[axis] - PLAYS, share[axis] + PLAYS)
        rest = np.exp(-seconds / CREEP_S)
        self.crept = share[:, None] + (self.crept - share[:, None]) * rest
        self.time += seconds
        self.last = share

    def read(self, readings: int = 1) -> np.ndarray:
        """Return what the display shows, mV/V; the mean of so many readings."""
        n, x = self.nature, self.last
        answer = x + n.loop * (self.plays.mean(axis=1) - x) / 0.26
        answer = answer + n.creep * (self.crept.mean(axis=1) - x)
        answer = answer + n.product * self.signs[0] * x[0] * x[1]
        answer = answer + n.cubic * self.signs[1] * x * x[::-1] ** 2
        answer = answer + n.bow * self.signs[2] * x**3
        cold = math.exp(-self.time / 1800.0)
        answer = answer * (1.0 - n.warm_gain * self.warm * cold) + n.warm_zero * self.warm * cold
        noisy = answer + self.rng.normal(0.0, n.noise, (readings, 2))
        signal = noisy @ (self.gain * n.full_scale).T + self.offset
        step = n.display * n.rated
        return (np.round(signal / step) * step).mean(axis=0)


@dataclass(frozen=True)
class Course:
    """How a technician takes a calibration: angles (degrees, one a series), loads of full scale."""

    angles: tuple[float, ...] = (0, 45, 90, 135, 180, 225, 270, 315, 0, 90)
    loads: tuple[float, ...] = (0.2, 0.4, 0.6, 0.8, 0.99)
    falling: bool = True
    preloads: int = 1
    wait_s: float = 35.0


Table = list[tuple[str, int, float, float, float, float]]


def take(cell: TimeCell, course: Course) -> Table:
    """Return readings as a technician writes them: series, step, kg, degrees, two signals."""
    n, rows = cell.nature, []
    for number, degrees in enumerate(course.angles, 1):
        angle = math.radians(degrees + cell.rng.normal(0.0, n.setting_deg))

        def hang(share: float, seconds: float, angle: float = angle) -> None:
            force = cell.scale * share * n.full_scale
            cell.feel(cell.weight(force, angle), angle, seconds)

        for _ in range(course.preloads):
            hang(course.loads[-1], 60.0)
            hang(0.0, course.wait_s)
        rising = (0.0, *course.loads)
        falling = rising[-2::-1] if course.falling else (0.0,)
        for step, share in enumerate((*rising, *falling), 1):
            hang(share, course.wait_s)
            kg = share * n.full_scale / NEWTON_PER_KG
            rows.append((str(number), step, kg, degrees, *cell.read()))
    return rows


@dataclass(frozen=True)
class Used:
    """A force in use: as it is (N, pin frame), its angle, what is shown of it and of no load."""

    force: np.ndarray
    angle: float
    signal: np.ndarray
    signal_mean: np.ndarray
    rest: np.ndarray
    rest_angle: float


def use(cell: TimeCell, size: float, largest: float, mean_of: int = 25) -> Used:
    """Bring a force upon the warm cell, from above or from below, in any direction of its frame.

    The zero is taken before, at another angle of the pin. largest: N, of the cycles in use.
    """
    rng, n = cell.rng, cell.nature
    cell.time += 7200.0
    cell.change_adapter()
    way, angle, before = rng.uniform(0.0, 2.0 * math.pi, 3)
    unit = np.array([math.cos(way), math.sin(way)])
    for _ in range(2):
        cell.feel(largest * unit, before, 5.0)
        cell.feel(np.zeros(2), before, 30.0)
    rest = cell.read(400)
    falling = rng.random() < 0.5
    if falling:
        cell.feel(largest * unit, angle, 30.0)
    cell.feel(size * unit, angle, 35.0)
    one, many = cell.read(), cell.read(mean_of)
    assert n.full_scale > 0.0
    return Used(size * unit, angle, one, many, rest, before)
