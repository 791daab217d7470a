"""Simulated hands: what they do at a step, and the mistakes that they can be told to make."""

from __future__ import annotations

import enum
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from calibration.load_cell.plans import StepKind
from calibration.load_cell.procedure import Procedure


class Mistake(enum.StrEnum):
    """A mistake to practise, in the operator's words."""

    NONE = "none"
    WRONG_WEIGHT = "a wrong weight hangs"
    SWAPPED_CABLE = "the two plugs are exchanged"
    SWINGING = "the weight swings"


@dataclass(frozen=True, slots=True)
class Action:
    """One request to the engine: verb and arguments."""

    verb: str
    arguments: Mapping[str, Any]


def _hand(what: str, **details: Any) -> Action:
    return Action("hand", {"what": what, "details": details})


def preparation() -> tuple[Action, ...]:
    """Return what makes the simulated rig ready: follower off, once past the encoder's index."""
    turns = (90.0, 180.0, 270.0, 359.0, 0.0)
    return (_hand("take_off_follower"), *(_hand("turn_pin", angle_deg=at) for at in turns))


def tidy_up() -> tuple[Action, ...]:
    """Return what puts the simulated rig together again and ends planted mistakes."""
    return (*mistake_actions(Mistake.NONE), _hand("put_on_follower"))


def mistake_actions(mistake: Mistake) -> tuple[Action, ...]:
    """Return what begins a mistake at the rig and ends all others.

    A wrong weight is a matter of what is hung, see ``step_actions``.
    """
    ends = tuple(Action("clear_fault", {"kind": kind}) for kind in _FAULTS.values())
    kind = _FAULTS.get(mistake)
    return (*ends, Action("inject_fault", {"kind": kind})) if kind else ends


_FAULTS = {Mistake.SWAPPED_CABLE: "swapped_bridges", Mistake.SWINGING: "swinging_weight"}


def step_actions(
    procedure: Procedure, mistake: Mistake, gravity: float, hanger: float
) -> tuple[Action, ...]:
    """Return what the hands do for the step under way.

    A wrong weight: the last piece is another one of the set, or a kilogram too much.
    """
    if procedure.done:
        return ()
    step = procedure.step
    if step.kind is StepKind.ANGLE_REFERENCE:
        return (_hand("turn_pin", angle_deg=0.0),)
    if step.kind is StepKind.TURN:
        degrees = math.degrees(step.angle)
        return (_weigh(0.0, gravity), _hand("turn_pin", angle_deg=degrees))
    mass = procedure.change.mass if step.mass > 0.0 else 0.0
    if mass > 0.0:
        if mistake is Mistake.WRONG_WEIGHT:
            mass = _wrong(mass, procedure.change.hanging)
        mass += hanger
    return (_weigh(mass, gravity),)


def _weigh(mass: float, gravity: float) -> Action:
    return _hand("hang_weight", mass_kg=mass, gravity_m_s2=gravity)


def _wrong(mass: float, hanging: Sequence[float]) -> float:
    smallest = min(hanging)
    return mass - 0.5 * smallest if smallest >= 2.0 else mass + 1.0
