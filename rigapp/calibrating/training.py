"""The training mode on a simulated rig: the simulated operator's actions, and mistakes to practise.

A simulated rig has no technician; the engine's verb ``hand`` turns its pin, hangs its weights and
sets its micrometers. A ``Training`` returns the actions of a step.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from rigapp_calibration.taking.procedure import Procedure, StepKind


@dataclass(frozen=True, slots=True)
class Action:
    """One request to the engine: verb and arguments."""

    verb: str
    arguments: Mapping[str, Any]


def _hand(what: str, **details: Any) -> Action:
    return Action("hand", {"what": what, "details": details})


Actions = tuple[Action, ...]


@dataclass(frozen=True, slots=True)
class Training:
    """Training for a calibration.

    mistakes: the choices, the first of them none. prepare: prepares the rig; the engine restores
    it when the calibration ends. plant: begins a mistake at the rig and ends all others.
    act (session, mistake, since): the actions of the step under way, ``since``: the step at which
    the mistake began.
    """

    mistakes: type[enum.StrEnum]
    prepare: Actions
    plant: Callable[[Any], Actions]
    act: Callable[[Any, Any, int], Actions]


class NoMistake(enum.StrEnum):
    """Choices without actions of the simulated operator."""

    NONE = "none"


NO_PRACTICE = Training(NoMistake, (), lambda _: (), lambda *_: ())

# --- weights --------------------------------------------------------------------------------------


class WeighingMistake(enum.StrEnum):
    """A mistake with weights to practise, in the operator's words."""

    NONE = "none"
    WRONG_WEIGHT = "a wrong weight hangs"
    SWAPPED_CABLE = "the two plugs are exchanged"
    SWINGING = "the weight swings"


_FAULTS = {
    WeighingMistake.SWAPPED_CABLE: "swapped_bridges",
    WeighingMistake.SWINGING: "swinging_weight",
}
MISTAKES = tuple(_FAULTS.values())
"""Faults of the simulated rig by which a mistake is made."""
ONCE_ROUND = (90.0, 180.0, 270.0, 359.0, 0.0)
"""Angles (degrees) that turn the pin once past the encoder's index."""
BARE_PIN: Actions = (
    _hand("take_off_follower"),
    *(_hand("turn_pin", angle_deg=at) for at in ONCE_ROUND),
)
"""Prepares the simulated rig: follower off, once past the encoder's index."""


def _plant_fault(mistake: WeighingMistake) -> Actions:
    """Begin a mistake at the rig; a wrong weight is hung by ``_weigh``."""
    ends = tuple(Action("clear_fault", {"kind": kind}) for kind in MISTAKES)
    kind = _FAULTS.get(mistake)
    return (*ends, Action("inject_fault", {"kind": kind})) if kind else ends


def _weigh(session: Any, mistake: WeighingMistake, since: int) -> Actions:
    """Bring pin and weights to the state of the step.

    From any state, since a step may be the first one after a restart. The creep needs no waiting:
    the time of loading is passed on. A wrong weight: half a piece less, or a kilogram too much.
    """
    procedure, settings = session.procedure, session.settings
    if procedure.done:
        return ()
    step = procedure.step
    turn = _hand("turn_pin", angle_deg=math.degrees(step.set_up or 0.0) % 360.0)
    mass = 0.0
    if step.pieces:
        mass = step.value + settings.weights.hanger_mass
        if mistake is WeighingMistake.WRONG_WEIGHT:
            mass += _wrong_by(step.pieces)
    hung = {"hung_s": step.due} if step.due else {}
    hang = _hand("hang_weight", mass_kg=mass, gravity_m_s2=settings.place.gravity, **hung)
    return (turn, hang) if step.pieces else (hang, turn)


def _wrong_by(hanging: Sequence[float]) -> float:
    smallest = min(hanging)
    return -0.5 * smallest if smallest >= 2.0 else 1.0


LOAD_CELL_PRACTICE = Training(
    WeighingMistake,
    prepare=BARE_PIN,
    plant=_plant_fault,
    act=_weigh,
)


# --- micrometers ----------------------------------------------------------------------------------

BACKLASH_UM = 15.0
DRIFT_UM = 1.0
TOO_FAR = 2.5
"""Sizes of a technician's mistakes: the checks detect each of them."""


class MicrometerMistake(enum.StrEnum):
    """A mistake at the micrometer to practise, in the operator's words."""

    NONE = "none"
    WRONG_POSITION = "the micrometer is set wrong once"
    SKIPPED = "a position is skipped"
    OTHER_WAY = "the micrometer is turned the other way"
    BACKLASH = "positions are approached from the wrong side"
    OTHER_PROBE = "the target is in front of the other probe"
    TOO_FAR = "the micrometer is turned too far"
    DRIFT = "something slips slowly"


def _set(*positions_um: float) -> Actions:
    return tuple(
        _hand("set_micrometer", probe=number, position_um=position)
        for number, position in enumerate(positions_um, 1)
    )


def _turn_micrometer(session: Any, mistake: MicrometerMistake, since: int) -> Actions:
    procedure: Procedure[Any] = session.procedure
    if procedure.done:
        return ()
    step = procedure.step
    if step.kind is StepKind.SET_UP:
        return _set(0.0, 0.0)
    at = _with_mistake(procedure, mistake, since)
    first = (step.set_up == 1) is not (mistake is MicrometerMistake.OTHER_PROBE)
    return _set(at, 0.0) if first else _set(0.0, at)


def _with_mistake(procedure: Procedure[Any], mistake: MicrometerMistake, since: int) -> float:
    """Return the setting of a micrometer, um."""
    step, position = procedure.step, procedure.position
    wanted, size = 1e6 * step.value, 1e6 * float(procedure.plan.step_size)
    if mistake is MicrometerMistake.WRONG_POSITION and _first_time(procedure, since):
        return wanted + 0.3 * size
    if mistake is MicrometerMistake.SKIPPED:
        return wanted + (-size if step.falling else size)
    if mistake is MicrometerMistake.OTHER_WAY:
        return -wanted
    if mistake is MicrometerMistake.BACKLASH and step.falling:
        return wanted + BACKLASH_UM
    if mistake is MicrometerMistake.TOO_FAR:
        return TOO_FAR * wanted
    if mistake is MicrometerMistake.DRIFT:
        return wanted + DRIFT_UM * (position - since)
    return wanted


def _first_time(procedure: Procedure[Any], since: int) -> bool:
    """Return whether the step is the first reading from ``since`` on, and is not taken again."""
    readings = (i for i, step in enumerate(procedure.steps) if step.kind is StepKind.READING)
    first = next((index for index in readings if index >= since), -1)
    taken = any(reading.step == first for reading in procedure.taken)
    return procedure.position == first and not taken


PROBE_PRACTICE = Training(
    MicrometerMistake,
    prepare=(_hand("take_off_follower"), *_set(0.0, 0.0)),
    plant=lambda _: (),
    act=_turn_micrometer,
)
