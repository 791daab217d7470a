"""The plans of a dead-weight calibration: daily check, routine, full; steps in the order taken."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from calibration.load_cell.pieces import possible_loads


class StepKind(enum.StrEnum):
    """What the operator does in a step."""

    ANGLE_REFERENCE = "angle reference"
    TURN = "turn"
    PRELOAD = "preload"
    READING = "reading"


class PlanKind(enum.StrEnum):
    """How much is taken."""

    DAILY = "daily check"
    ROUTINE = "routine"
    FULL = "full"


PRELOAD_WAIT = 60.0
"""Seconds that a preload hangs: ISO 376 wants 1 to 1.5 minutes."""
HANDLING = 25.0
"""Seconds that a technician needs to change a load, for the estimate of the time left."""


@dataclass(frozen=True, slots=True)
class LoadCellStep:
    """One step: what to do, where (angle in rad), with which load (kg), and how long to wait (s).

    series and number name the reading in the record; falling: the load is reached by taking off.
    """

    kind: StepKind
    series: str = ""
    number: int = 0
    mass: float = 0.0
    angle: float = 0.0
    wait: float = 0.0
    falling: bool = False

    @property
    def set_up(self) -> float | None:
        """Return the pin angle to which the pin is turned for the step, rad."""
        return None if self.kind is StepKind.ANGLE_REFERENCE else self.angle

    @property
    def effort(self) -> float:
        """Return the seconds that the step takes a technician."""
        return self.wait + HANDLING


@dataclass(frozen=True, slots=True)
class PlanSize:
    """The size of a plan: angles, loads up, preloads, waiting time (s), descending series."""

    angles: int
    loads: int
    preloads: int
    settle: float
    descending: bool


SIZES = {
    PlanKind.DAILY: PlanSize(angles=4, loads=1, preloads=0, settle=10.0, descending=False),
    PlanKind.ROUTINE: PlanSize(angles=4, loads=5, preloads=1, settle=30.0, descending=True),
    PlanKind.FULL: PlanSize(angles=12, loads=10, preloads=3, settle=30.0, descending=True),
}
"""Full is what ISO 376 asks (three preloads, loads up and down, 30 s), at angles of 30 degrees;
routine, what tells all coefficients in an hour; daily, what tells a change of the cell."""


@dataclass(frozen=True, slots=True)
class LoadCellPlan:
    """What is taken: how much, the heaviest load (kg), the laboratory's pieces (kg)."""

    kind: PlanKind
    heaviest: float
    pieces: tuple[float, ...]

    def steps(self) -> tuple[LoadCellStep, ...]:
        """Return the steps.

        Angle reference first; at each angle: preloads to the maximum and back, zero, rising loads,
        falling loads, zero. The loads are those that the pieces can make.
        """
        size = SIZES[self.kind]
        loads = possible_loads(self.heaviest, size.loads, self.pieces)
        steps = [LoadCellStep(StepKind.ANGLE_REFERENCE)]
        for place in range(size.angles):
            angle = float(2.0 * np.pi * place / size.angles)
            steps.append(LoadCellStep(StepKind.TURN, angle=angle))
            for _ in range(size.preloads):
                for mass, wait in ((loads[-1], PRELOAD_WAIT), (0.0, size.settle)):
                    steps.append(LoadCellStep(StepKind.PRELOAD, mass=mass, angle=angle, wait=wait))
            steps += _series(str(place + 1), angle, loads, size)
        return tuple(steps)


def _series(
    series: str, angle: float, loads: Sequence[float], size: PlanSize
) -> list[LoadCellStep]:
    rising = [0.0, *loads]
    masses = [(mass, False) for mass in rising]
    back = rising[-2::-1] if size.descending else [0.0]
    masses += [(mass, True) for mass in back]
    return [
        LoadCellStep(StepKind.READING, series, number, mass, angle, size.settle, falling)
        for number, (mass, falling) in enumerate(masses, 1)
    ]
