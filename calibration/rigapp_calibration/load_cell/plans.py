"""The dead-weight calibration as data: its plans (daily check, routine, full) and its steps.

Angle reference first; at each pin angle: preloads to the maximum and back, zero, rising loads,
falling loads, zero. Creep last: the largest load, read twice while it hangs.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rigapp_calibration.load_cell.characteristics import CREEP_AT
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.taking.pieces import WeightChange, next_change, possible_loads, told_pieces
from rigapp_calibration.taking.procedure import Method, Procedure, Step, StepKind


class PlanKind(enum.StrEnum):
    """How much is taken."""

    DAILY = "daily check"
    ROUTINE = "routine"
    FULL = "full"


PRELOAD_WAIT = 60.0
"""Seconds that a preload hangs: ISO 376 wants 1 to 1.5 minutes."""
HANDLING = 25.0
"""Seconds that a technician needs to change a load, for the estimate of the time left."""
CREEP_SERIES = "creep"
ANGLE_TOLERANCE = math.radians(5.0)
"""The pin may stand so far from the plan's angle: what counts is the angle that is recorded."""
LEVEL = (
    "Lay the level on the flat of the crank, turn the crank until the bubble is in the middle, and"
    " enter the angle that the encoder shows. Then turn the level end for end and do it again: the"
    " mean is free of the level's own error."
)


@dataclass(frozen=True, slots=True)
class PlanSize:
    """The size of a plan: angles, loads up, preloads, waiting time (s), descending series.

    What has descending series has the creep at its end: both tell how the cell follows a load.
    """

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


@lru_cache
def _steps_of(plan: LoadCellPlan) -> tuple[Step, ...]:
    """Return the steps of a plan: a page that tells of it asks at each key."""
    return tuple(plan._steps())


@dataclass(frozen=True, slots=True)
class LoadCellPlan:
    """What is taken: how much, the heaviest load (kg), the laboratory's pieces (kg)."""

    kind: PlanKind
    heaviest: float
    pieces: tuple[float, ...]

    def steps(self) -> tuple[Step, ...]:
        """Return the steps; the loads are those that the pieces can make."""
        return _steps_of(self)

    def _steps(self) -> Iterator[Step]:
        size = SIZES[self.kind]
        loads = possible_loads(self.heaviest, size.loads, self.pieces)
        rising = [0.0, *loads]
        course = [(mass, False) for mass in rising]
        course += [(mass, True) for mass in (rising[-2::-1] if size.descending else [0.0])]
        yield Step(StepKind.ANGLE_REFERENCE, LEVEL, handling=HANDLING)
        for place in range(size.angles):
            angle = float(2.0 * np.pi * place / size.angles)
            words = f"Take all weights off and turn the pin to {np.degrees(angle):.0f} degrees."
            yield Step(StepKind.SET_UP, words, angle, handling=HANDLING)
            hanging: tuple[float, ...] = ()
            for mass, wait in ((loads[-1], PRELOAD_WAIT), (0.0, size.settle)) * size.preloads:
                change = next_change(mass, hanging, self.pieces)
                words = f"{_change_words(change)} This only exercises the cell; nothing is read."
                hanging = change.hanging
                yield Step(
                    StepKind.PRELOAD, words, angle, change.mass, hanging, wait=wait,
                    handling=HANDLING,
                )  # fmt: skip
            for number, (mass, falling) in enumerate(course, 1):
                change = next_change(mass, hanging, self.pieces)
                words = f"{_change_words(change)} Wait until it hangs still."
                hanging = change.hanging
                yield Step(
                    StepKind.READING, words, angle, change.mass, hanging, str(place + 1), number,
                    size.settle, HANDLING, falling,
                )  # fmt: skip
        if size.descending:
            yield from self._creep(angle, loads[-1])

    def _creep(self, angle: float, largest: float) -> Iterator[Step]:
        change = next_change(largest, (), self.pieces)

        def step(
            kind: StepKind, words: str, number: int = 0, wait: float = 0.0, due: float = 0.0
        ) -> Step:
            return Step(
                kind, words, angle, change.mass, change.hanging, CREEP_SERIES, number, wait,
                0.0 if due else HANDLING, due=due, optional=True,
            )  # fmt: skip

        yield step(
            StepKind.PRELOAD,
            f"Creep: from no load, {_change_words(change).lower()} Hang it without a pause, and go"
            " on as soon as it hangs still: from then on the time counts.",
        )
        before = 0.0
        for number, due in enumerate(CREEP_AT, 1):
            words = f"Leave the {change.mass:g} kg hanging: they are read after {due:g} s."
            if due == CREEP_AT[-1]:
                words += " Then take all weights off."
            yield step(StepKind.READING, words, number, due - before, due)
            before = due


def _change_words(change: WeightChange) -> str:
    if not change.hanging:
        return "Take all weights off." if change.remove else "Nothing may hang on the pin."
    parts = []
    if change.remove:
        parts.append(f"take off {' + '.join(told_pieces(change.remove))}")
    if change.add:
        parts.append(f"hang {' + '.join(told_pieces(change.add))}")
    text = " and ".join(parts) or "change nothing"
    return f"{text[0].upper()}{text[1:]}: {change.mass:g} kg hang then."


# --- the journal ----------------------------------------------------------------------------------


def wrong_angle(angle: float, step: Step) -> str:
    """Return why a step cannot be done at a pin angle (rad), empty when it can."""
    if step.set_up is None or abs(math.remainder(angle - step.set_up, 2.0 * math.pi)) <= (
        ANGLE_TOLERANCE
    ):
        return ""
    return (
        f"the encoder shows {np.degrees(angle):.1f} degrees; turn the pin to"
        f" {np.degrees(step.set_up):.0f} degrees"
    )


WEIGHING = Method(
    told=lambda plan: {
        "kind": plan.kind.value,
        "heaviest": plan.heaviest,
        "pieces": list(plan.pieces),
    },
    plan=lambda e: LoadCellPlan(PlanKind(e["kind"]), e["heaviest"], tuple(e["pieces"])),
    set_up="turned",
    place="angle",
    value="mass",
    wrongly=wrong_angle,
    afresh=True,
)


def load_cell_readings(procedure: Procedure[LoadCellPlan]) -> LoadCellReadings:
    """Return the readings that stand, in the order taken; those of the creep are left out."""
    return LoadCellReadings(*procedure.columns(of=lambda step: not step.due))
