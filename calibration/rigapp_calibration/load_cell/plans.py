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
from itertools import pairwise

import numpy as np

from rigapp.texts import SentenceError, say
from rigapp_calibration.arrays import Array
from rigapp_calibration.load_cell.characteristics import CREEP_AT
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.two_axis import forces
from rigapp_calibration.load_cell.weights import (
    STANDARD_GRAVITY,
    WeightChange,
    change_to,
    next_change,
    piece_texts,
    pin_force,
    possible_loads,
    rising_loads,
)
from rigapp_calibration.load_cell.wiring import check_plugs
from rigapp_calibration.taking.procedure import Method, Procedure, Step, StepKind
from rigapp_calibration.taking.signals import (
    Judgement,
    Readiness,
    SignalState,
    SignalWindow,
    assess,
)


class PlanKind(enum.StrEnum):
    """Extent of a calibration."""

    DAILY = "daily check"
    ROUTINE = "routine"
    FULL = "full"


PRELOAD_WAIT = 60.0
"""Seconds that a preload hangs: ISO 376 requires 1 to 1.5 minutes."""
HANDLING = 5.0
PIECE = 4.0
"""Seconds that a technician needs for a step, and for each piece that is hung or taken off, for the
estimate of the time left."""
LAYOUT = 2
"""Version of a plan's steps: older journals state none and are resumed in layout 1."""
CREEP_SERIES = "creep"
AGAIN_APART = 0.25
"""Part of a turn between the repeated angles: includes both axes of the cell."""
ANGLE_TOLERANCE = math.radians(5.0)
"""Tolerance of the pin's angle to the plan: the recorded angle is used."""
LEVEL = say(
    "Lay the level on the flat of the crank, turn the crank until the bubble is in the"
    " middle, and enter the angle that the encoder shows. Then turn the level end for"
    " end and do it again: the mean is free of the level's own error."
)


@dataclass(frozen=True, slots=True)
class PlanSize:
    """Size of a plan: angles, number of repeated ones, rising loads, preloads, waiting time (s).

    Plans with falling series end with the creep: both characterise the response to a load.
    """

    angles: int
    loads: int
    preloads: int
    settle: float
    descending: bool
    again: int = 0


SIZES = {
    PlanKind.DAILY: PlanSize(angles=4, loads=1, preloads=0, settle=10.0, descending=False),
    PlanKind.ROUTINE: PlanSize(
        angles=8, loads=5, preloads=1, settle=30.0, descending=True, again=2
    ),
    PlanKind.FULL: PlanSize(angles=12, loads=10, preloads=3, settle=30.0, descending=True, again=2),
}
"""Full is what ISO 376 requires (three preloads, loads up and down, 30 s), at angles of 30 degrees;
routine determines all coefficients, cross terms included; daily detects a change of the cell.
The first angles are repeated at the end: repeatability (ISO 376's b') and drift are separated."""
FORMER_SIZES = {
    **SIZES,
    PlanKind.ROUTINE: PlanSize(angles=4, loads=5, preloads=1, settle=30.0, descending=True),
    PlanKind.FULL: PlanSize(angles=12, loads=10, preloads=3, settle=30.0, descending=True),
}
"""Of layout 1."""


@lru_cache
def _steps_of(plan: LoadCellPlan) -> tuple[Step, ...]:
    """Return the steps of a plan; cached, since a page requests them at each key."""
    return tuple(plan._steps())


@dataclass(frozen=True, slots=True)
class LoadCellPlan:
    """Plan of a calibration: extent, heaviest load (kg), the laboratory's pieces (kg).

    layout: version of the steps; a journal begun by a former version keeps its own.
    """

    kind: PlanKind
    heaviest: float
    pieces: tuple[float, ...]
    layout: int = LAYOUT

    def steps(self) -> tuple[Step, ...]:
        """Return the steps; the loads are those that the pieces can make."""
        return _steps_of(self)

    def loads(self) -> tuple[tuple[float, ...], ...]:
        """Return the mass at each rising load, kg: pieces are only added from one to the next."""
        return rising_loads(self.heaviest, SIZES[self.kind].loads, self.pieces)

    @property
    def size(self) -> PlanSize:
        """Return the extent."""
        return (SIZES if self.layout == LAYOUT else FORMER_SIZES)[self.kind]

    def _course(self) -> list[tuple[WeightChange, bool]]:
        """Return the changes at the hanger of a series, from no load on, and which are falling."""
        nothing = WeightChange((), (), ())
        if self.layout != LAYOUT:
            return self._former_course()
        rising = [(), *self.loads()]
        up = [(change_to(after, before), False) for before, after in pairwise(rising)]
        down = rising[::-1] if self.size.descending else [rising[-1], ()]
        return [
            (nothing, False),
            *up,
            *((change_to(after, before), True) for before, after in pairwise(down)),
        ]

    def _former_course(self) -> list[tuple[WeightChange, bool]]:
        rising = [0.0, *possible_loads(self.heaviest, self.size.loads, self.pieces)]
        course = [(mass, False) for mass in rising]
        course += [(mass, True) for mass in (rising[-2::-1] if self.size.descending else [0.0])]
        changes: list[tuple[WeightChange, bool]] = []
        hanging: tuple[float, ...] = ()
        for mass, falling in course:
            changes.append((next_change(mass, hanging, self.pieces), falling))
            hanging = changes[-1][0].hanging
        return changes

    def _steps(self) -> Iterator[Step]:
        size, course = self.size, self._course()
        full = max((one for one, _ in course), key=lambda one: one.mass).hanging
        preload = (change_to(full, ()), PRELOAD_WAIT), (change_to((), full), size.settle)
        yield Step(StepKind.ANGLE_REFERENCE, LEVEL, handling=2.0 * HANDLING)
        for place in range(size.angles + size.again):
            # One full turn later: a repeated angle is a separate set-up.
            angle = float(2.0 * np.pi * place / size.angles)
            if place >= size.angles:
                angle = float(2.0 * np.pi * (1.0 + AGAIN_APART * (place - size.angles)))
            words = say("Take all weights off and turn the pin to {:.0f} degrees.", _degrees(angle))
            yield Step(StepKind.SET_UP, words, angle, handling=2.0 * HANDLING)
            for change, wait in preload * size.preloads:
                words = say(
                    "{} This only exercises the cell; no reading is taken.", _change_words(change)
                )
                yield Step(
                    StepKind.PRELOAD, words, angle, change.mass, change.hanging, wait=wait,
                    handling=_handling(change),
                )  # fmt: skip
            for number, (change, falling) in enumerate(course, 1):
                words = say("{} Wait until it is still.", _change_words(change))
                yield Step(
                    StepKind.READING, words, angle, change.mass, change.hanging, str(place + 1),
                    number, size.settle, _handling(change), falling,
                )  # fmt: skip
        if size.descending:
            yield from self._creep(angle, change_to(full, ()))

    def _creep(self, angle: float, change: WeightChange) -> Iterator[Step]:
        def step(
            kind: StepKind, words: str, number: int = 0, wait: float = 0.0, due: float = 0.0
        ) -> Step:
            return Step(
                kind, words, angle, change.mass, change.hanging, CREEP_SERIES, number, wait,
                0.0 if due else _handling(change), due=due, optional=True,
            )  # fmt: skip

        yield step(
            StepKind.PRELOAD,
            say(
                (
                    "Creep, from no load. {} Hang it without a pause, and continue as soon as it"
                    " is still: from then on the time counts."
                ),
                _change_words(change),
            ),
        )
        before = 0.0
        for number, due in enumerate(CREEP_AT, 1):
            words: str = say(
                "Leave the {:g} kg hanging: they are read after {:g} s.", change.mass, due
            )
            if due == CREEP_AT[-1]:
                words += say(" Then take all weights off.")
            yield step(StepKind.READING, words, number, due - before, due)
            before = due


def _handling(change: WeightChange) -> float:
    """Return the seconds for a change at the hanger."""
    return HANDLING + PIECE * (len(change.add) + len(change.remove))


def _degrees(angle: float) -> float:
    """Return an angle (rad) as degrees of one turn."""
    return float(np.degrees(angle)) % 360.0


def _change_words(change: WeightChange) -> str:
    if not change.hanging:
        return (
            say("Take all weights off.") if change.remove else say("The pin must carry no weight.")
        )
    off, on = (" + ".join(piece_texts(one)) for one in (change.remove, change.add))
    if not change.remove and not change.add:
        return say("Change nothing: {:g} kg stay on the pin.", change.mass)
    if not change.add:
        return say("Take off {}: {:g} kg are then on the pin.", off, change.mass)
    if not change.remove:
        return say("Hang {}: {:g} kg are then on the pin.", on, change.mass)
    return say("Take off {} and hang {}: {:g} kg are then on the pin.", off, on, change.mass)


# --- the journal ----------------------------------------------------------------------------------


def wrong_angle(angle: float, step: Step) -> str:
    """Return why a step is impossible at a pin angle (rad), empty if it is possible."""
    if step.set_up is None or abs(math.remainder(angle - step.set_up, 2.0 * math.pi)) <= (
        ANGLE_TOLERANCE
    ):
        return ""
    return say(
        "the encoder shows {:.1f} degrees; turn the pin to {:.0f} degrees",
        _degrees(angle),
        _degrees(step.set_up),
    )


WEIGHING = Method(
    told=lambda plan: {
        "kind": plan.kind.value,
        "heaviest": plan.heaviest,
        "pieces": list(plan.pieces),
        "layout": plan.layout,
    },
    plan=lambda e: LoadCellPlan(
        PlanKind(e["kind"]), e["heaviest"], tuple(e["pieces"]), e.get("layout", 1)
    ),
    set_up="turned",
    place="angle",
    value="mass",
    wrongly=wrong_angle,
    afresh=True,
)


def load_cell_readings(procedure: Procedure[LoadCellPlan]) -> LoadCellReadings:
    """Return the valid readings in the order taken, without those of the creep."""
    return LoadCellReadings(*procedure.columns(of=lambda step: not step.due))


SPREAD_SHARE = 0.25
"""Part of the cell's resolution that a steady signal may spread: below the resolution of a
reading."""
NOISE_SHARE = 0.6
"""Part of one sample's noise, which is about half the resolution: less is not a swinging weight."""
SLOPE_SHARE = 0.05
"""Part of the resolution by which a steady signal may change in a second: creep is slower."""
FELT_SHARE = 0.3
"""Part of the load that must be measured before plugs and loading time are evaluated."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LoadCellWindow(SignalWindow):
    """The cell's signals of the last seconds.

    angle: of the pin (rad) from the encoder, None while its index has not been passed. matrix
    (2, 2), zero (2,), quadratic (2, 3) or None: the calibration in use.
    """

    angle: float | None
    matrix: Array
    zero: Array
    quadratic: Array | None = None

    def force(self, signal: Array) -> float:
        """Return the magnitude of the force (N) by the calibration in use of a signal (2,)."""
        return float(np.hypot(*forces(signal, self.matrix, self.zero, self.quadratic)[0]))


def assess_load(
    window: LoadCellWindow, step: Step, resolution: float, since: float, wait: float
) -> Readiness:
    """Evaluate a window for a step; resolution: of the cell, N; since, wait: see ``assess``."""
    per_newton = 1.0 / max(float(np.sqrt(abs(np.linalg.det(window.matrix)))), 1e-12)
    return assess(
        window,
        since=since,
        wait=wait,
        spread=resolution * (SPREAD_SHARE + NOISE_SHARE * window.noise_share) * per_newton,
        slope=resolution * SLOPE_SHARE * per_newton,
        first=_first(window),
        set_up=lambda found: (
            _check_position(window, step)
            or _check_load(window, step, found.mean)
            or _check_plugs(window, step, found.mean)
        ),
        felt=window.force,
    )


def _first(window: LoadCellWindow) -> Judgement | None:
    if window.angle is None:
        return (
            SignalState.WAITING,
            say("the angle is not known yet: turn the crank by hand past the encoder's index once"),
        )
    return None if window.stands else (SignalState.MOVING, say("the crank turns"))


def _check_position(window: LoadCellWindow, step: Step) -> Judgement | None:
    """Evaluate the pin's position for a step without reading, or if the position is wrong."""
    assert window.angle is not None
    if step.kind is StepKind.ANGLE_REFERENCE:
        return SignalState.STEADY, say("the crank is stationary")
    wrong = wrong_angle(window.angle, step)
    if wrong:
        return SignalState.WAITING, wrong
    if step.kind is StepKind.SET_UP:
        return SignalState.STEADY, say("the pin is at {:.1f} degrees", math.degrees(window.angle))
    return None


def _check_load(window: LoadCellWindow, step: Step, signal: Array) -> Judgement | None:
    """Evaluate whether the load is applied, from which on the time of a series counts."""
    if step.kind is not StepKind.PRELOAD or not step.series:
        return None
    if window.force(signal) > FELT_SHARE * step.value * STANDARD_GRAVITY:
        return None
    return SignalState.WAITING, say("the {:g} kg are not on the pin yet", step.value)


def _check_plugs(window: LoadCellWindow, step: Step, signal: Array) -> Judgement | None:
    """Evaluate by the applied load whether the plugs are exchanged or turned, before a reading.

    The first preload suffices, whatever calibration is in use.
    """
    assert window.angle is not None
    expected = FELT_SHARE * step.value * STANDARD_GRAVITY
    if not (expected > 0.0 and window.force(signal) > expected):
        return None
    problem = check_plugs(signal - window.zero, pin_force(1.0, window.angle, 0.0))
    return None if problem is None else (SignalState.WAITING, problem.sentence)


LARGEST_LEVEL_ERROR = math.radians(1.0)
"""A machinist's level is ten times better; more means another flat, or a bubble off its middle."""


class LevelError(SentenceError, ValueError):
    """Two readings cannot be of one level on one flat; the text gives the reason."""


@dataclass(frozen=True, slots=True)
class LevelReading:
    """The encoder's angle with the crank level, its standard uncertainty, the level's error; rad.

    The level's own error is known where it was turned.
    """

    angle: float
    uncertainty: float
    level_error: float | None


def single(shown: float, uncertainty: float) -> LevelReading:
    """Take one reading (rad); the uncertainty is the level's, its own error included."""
    return LevelReading(_near_zero(shown), uncertainty, None)


def reversed_level(first: float, second: float, setting: float) -> LevelReading:
    """Take two readings (rad), the level turned end for end between them.

    setting: standard uncertainty of centring the bubble once, rad; of the mean it is
    1 / sqrt(2). Raises LevelError when the level would be off by more than a degree.
    """
    one, two = _near_zero(first), _near_zero(second)
    half = 0.5 * (one - two)
    if abs(half) > LARGEST_LEVEL_ERROR:
        raise LevelError(
            "the two angles differ by {:.2f} degrees; was the level on the same flat"
            " both times, and the bubble in the middle?",
            abs(math.degrees(2.0 * half)),
        )
    return LevelReading(0.5 * (one + two), setting / math.sqrt(2.0), half)


def _near_zero(angle: float) -> float:
    return math.remainder(angle, 2.0 * math.pi)
