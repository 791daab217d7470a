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


@dataclass(frozen=True, slots=True)
class Step:
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


@dataclass(frozen=True, slots=True)
class Shape:
    """The size of a plan: angles, loads up, preloads, waiting time (s), descending series."""

    angles: int
    loads: int
    preloads: int
    settle: float
    descending: bool


SHAPES = {
    PlanKind.DAILY: Shape(angles=4, loads=1, preloads=0, settle=10.0, descending=False),
    PlanKind.ROUTINE: Shape(angles=4, loads=5, preloads=1, settle=30.0, descending=True),
    PlanKind.FULL: Shape(angles=12, loads=10, preloads=3, settle=30.0, descending=True),
}
PRELOAD_WAIT = 60.0
HANDLING = 25.0
"""Seconds that a technician needs to change a load, for the estimate of the time left."""


def make_plan(kind: PlanKind, heaviest: float, pieces: Sequence[float]) -> tuple[Step, ...]:
    """Return the steps of a plan up to ``heaviest`` (kg) with the laboratory's pieces (kg).

    Angle reference first; at each angle: preloads to the maximum and back, zero, rising loads,
    falling loads, zero. The loads are those that the pieces can make.
    """
    shape = SHAPES[kind]
    loads = possible_loads(heaviest, shape.loads, pieces)
    steps = [Step(StepKind.ANGLE_REFERENCE)]
    for place in range(shape.angles):
        angle = float(2.0 * np.pi * place / shape.angles)
        steps.append(Step(StepKind.TURN, angle=angle))
        for _ in range(shape.preloads):
            steps.append(Step(StepKind.PRELOAD, mass=loads[-1], angle=angle, wait=PRELOAD_WAIT))
            steps.append(Step(StepKind.PRELOAD, angle=angle, wait=shape.settle))
        steps += _series(str(place + 1), angle, loads, shape)
    return tuple(steps)


def _series(series: str, angle: float, loads: Sequence[float], shape: Shape) -> list[Step]:
    rising = [0.0, *loads]
    masses = [(mass, False) for mass in rising]
    back = rising[-2::-1] if shape.descending else [0.0]
    masses += [(mass, True) for mass in back]
    return [
        Step(StepKind.READING, series, number, mass, angle, shape.settle, falling)
        for number, (mass, falling) in enumerate(masses, 1)
    ]


def time_needed(steps: Sequence[Step]) -> float:
    """Return the seconds that the steps take a technician."""
    return sum(step.wait + HANDLING for step in steps)
