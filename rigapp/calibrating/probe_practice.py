"""Simulated hands at the micrometer: what they do at a step, and the mistakes they can make."""

from __future__ import annotations

import enum

from calibration.probes.procedure import ProbeProcedure, ProbeStepKind
from rigapp.calibrating.practice import Action

BACKLASH_UM = 15.0
DRIFT_UM = 1.0
TOO_FAR = 2.5


class ProbeMistake(enum.StrEnum):
    """A mistake to practise, in the operator's words."""

    NONE = "none"
    WRONG_POSITION = "the micrometer is set wrong once"
    SKIPPED = "a position is skipped"
    OTHER_WAY = "the micrometer is turned the other way"
    BACKLASH = "positions are approached from the wrong side"
    OTHER_PROBE = "the target stands before the other probe"
    TOO_FAR = "the micrometer is turned too far"
    DRIFT = "something slips slowly"


def _hand(what: str, **details: object) -> Action:
    return Action("hand", {"what": what, "details": details})


def probe_preparation() -> tuple[Action, ...]:
    """Return what makes the simulated rig ready: follower off, micrometers in the middle."""
    return (_hand("take_off_follower"), *_centred())


def probe_tidy_up() -> tuple[Action, ...]:
    """Return what puts the simulated rig together again."""
    return (*_centred(), _hand("put_on_follower"))


def _centred() -> tuple[Action, ...]:
    return tuple(_hand("set_micrometer", probe=probe, position_um=0.0) for probe in (1, 2))


def probe_actions(
    procedure: ProbeProcedure, mistake: ProbeMistake, since: int
) -> tuple[Action, ...]:
    """Return what the hands do for the step under way.

    since: step of the plan at which the mistake began.
    """
    if procedure.done:
        return ()
    step = procedure.step
    if step.kind is ProbeStepKind.MOUNT:
        return _centred()
    wanted = 1e6 * step.position
    moved = [0.0, 0.0]
    probe = step.probe
    if mistake is ProbeMistake.OTHER_PROBE:
        probe = 3 - probe
    moved[probe - 1] = _with_mistake(procedure, mistake, wanted, since)
    return tuple(
        _hand("set_micrometer", probe=number, position_um=position)
        for number, position in enumerate(moved, 1)
    )


def _with_mistake(
    procedure: ProbeProcedure, mistake: ProbeMistake, wanted: float, since: int
) -> float:
    step, here = procedure.step, procedure.position
    size = 1e6 * procedure.step_size
    if mistake is ProbeMistake.WRONG_POSITION and here == since:
        return wanted + 0.3 * size
    if mistake is ProbeMistake.SKIPPED:
        return wanted + (-size if step.falling else size)
    if mistake is ProbeMistake.OTHER_WAY:
        return -wanted
    if mistake is ProbeMistake.BACKLASH and step.falling:
        return wanted + BACKLASH_UM
    if mistake is ProbeMistake.TOO_FAR:
        return TOO_FAR * wanted
    if mistake is ProbeMistake.DRIFT:
        return wanted + DRIFT_UM * (here - since)
    return wanted
