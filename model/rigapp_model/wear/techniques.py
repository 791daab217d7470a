"""The joint techniques in one table: models of pin and bushing, and their forces.

A new technique is one row here, and the module that computes it. Nothing is imported before it is
needed: a command line's help reads the names.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from rigapp.texts import joined, say
from rigapp_model.errors import ModelError

if TYPE_CHECKING:
    from rigapp_model.dynamics import MechanismMotion
    from rigapp_model.parameters import Parameters
    from rigapp_model.wear.forces import ForceSource


class Solve(Protocol):
    """Compute motion and forces of a crank whose motion is known."""

    def __call__(
        self, parameters: Parameters, angle: Any, speed: Any, acceleration: Any, depth: float
    ) -> tuple[MechanismMotion, str]:
        """Return the motion, and a sentence on it, empty when all assumptions hold.

        angle (n,): rad; speed: rad/s; acceleration: rad/s^2; depth: of wear at the contact point,
        m.
        """


@dataclass(frozen=True, slots=True)
class LifeOptions:
    """The options of a life's loads.

    speed: of the crank, rad/s. tolerance: of the depth, as a part of it, for forces that must be
    sampled. alive: called in between where that takes long, and may raise. evolving: whether a
    clearance grows with the wear.
    """

    speed: float
    tolerance: float = 1e-2
    alive: Callable[[], None] = lambda: None
    evolving: bool = True


Source = Callable[["Parameters", LifeOptions], "ForceSource"]


@dataclass(frozen=True, slots=True)
class Technique:
    """One model of pin and bushing.

    sentence: its assumption, for help, form and report. needs: its inputs beside the mechanism.
    solve: None where the motion has to be integrated from impact to impact, so that a single
    measured revolution has no prediction. source: of the loads of a life.
    """

    name: str
    sentence: str
    needs: tuple[str, ...]
    solve: Solve | None
    source: Source


def _perfect(
    parameters: Parameters, angle: Any, speed: Any, acceleration: Any, depth: float
) -> tuple[MechanismMotion, str]:
    from rigapp_model.joints import perfect_joint

    mechanism, joint = parameters.mechanism, parameters.joint
    return perfect_joint(mechanism, angle, speed, acceleration, joint), ""


def _continuous(
    parameters: Parameters, angle: Any, speed: Any, acceleration: Any, depth: float
) -> tuple[MechanismMotion, str]:
    from rigapp_model.joints import continuous_contact

    mechanism, joint = parameters.mechanism, parameters.joint
    gap = joint.clearance + depth
    contact = continuous_contact(mechanism, joint, angle, speed, acceleration, gap)
    return contact.motion, contact.sentence()


def _perfect_source(parameters: Parameters, wanted: LifeOptions) -> ForceSource:
    from rigapp_model.wear.forces import Constrained

    return Constrained(parameters, wanted.speed, 0.0, follows_wear=False)


def _continuous_source(parameters: Parameters, wanted: LifeOptions) -> ForceSource:
    from rigapp_model.wear.forces import Constrained

    clearance = parameters.joint.clearance
    return Constrained(parameters, wanted.speed, clearance, follows_wear=wanted.evolving)


def _contact_source(parameters: Parameters, wanted: LifeOptions) -> ForceSource:
    from rigapp_model.wear.impact_forces import SeparateBodies

    return SeparateBodies(parameters, wanted.speed, wanted.tolerance, wanted.alive)


TECHNIQUES = {
    technique.name: technique
    for technique in (
        Technique(
            "perfect",
            say("pin and bushing centres coincide"),
            (),
            _perfect,
            _perfect_source,
        ),
        Technique(
            "continuous",
            say("the pin always touches the bushing, and the clearance grows with the wear"),
            ("clearance",),
            _continuous,
            _continuous_source,
        ),
        Technique(
            "contact",
            say("pin and bushing are separate bodies that may lose contact"),
            ("clearance", "elasticity"),
            None,
            _contact_source,
        ),
    )
}
"""Name -> technique: the paper's sections 3.1 and 3.2, and separate bodies."""

SOLVABLE = tuple(name for name, technique in TECHNIQUES.items() if technique.solve is not None)
"""Names of those that give the forces of a measured revolution."""


def technique_of(name: str) -> Technique:
    """Return a technique by name; raise ModelError for an unknown one."""
    technique = TECHNIQUES.get(name)
    if technique is None:
        raise ModelError("technique", name, say("choose {}", listed()))
    return technique


def solve_of(name: str) -> Solve:
    """Return the function for the forces of a measured revolution; raise ModelError."""
    solve = TECHNIQUES[name].solve if name in TECHNIQUES else None
    if solve is None:
        raise ModelError("technique", name, say("choose {}", listed(SOLVABLE)))
    return solve


def listed(names: tuple[str, ...] = tuple(TECHNIQUES)) -> str:
    """Return names as a list in a sentence."""
    *first, last = names
    return say("{} or {}", joined(", ", first), last) if first else last
