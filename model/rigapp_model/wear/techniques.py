"""Table of the joint techniques: models of pin and bushing, and their forces.

A new technique is one row here and the module that computes it. Imports are deferred, as the
command line's help reads the names.
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
    """Compute motion and forces for a known motion of the crank."""

    def __call__(
        self, parameters: Parameters, angle: Any, speed: Any, acceleration: Any, depth: float
    ) -> tuple[MechanismMotion, str]:
        """Return the motion, and a message, empty if all assumptions hold.

        angle (n,): rad; speed: rad/s; acceleration: rad/s^2; depth: of wear at the contact point,
        m.
        """


@dataclass(frozen=True, slots=True)
class LifeOptions:
    """Options of the loads of a life.

    speed: of the crank, rad/s. tolerance: of the depth, relative, for sampled forces. alive: called
    during long computations; may raise. evolving: whether a clearance increases with the wear.
    """

    speed: float
    tolerance: float = 1e-2
    alive: Callable[[], None] = lambda: None
    evolving: bool = True


Source = Callable[["Parameters", LifeOptions], "ForceSource"]


@dataclass(frozen=True, slots=True)
class Technique:
    """Model of pin and bushing.

    sentence: its assumption, for help, form and report. needs: its inputs besides the mechanism.
    solve: None if the motion must be integrated from impact to impact, so that a single measured
    revolution has no prediction. source: of the loads of a life.
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


def _perfect_source(parameters: Parameters, options: LifeOptions) -> ForceSource:
    from rigapp_model.wear.forces import Constrained

    return Constrained(parameters, options.speed, 0.0, follows_wear=False)


def _continuous_source(parameters: Parameters, options: LifeOptions) -> ForceSource:
    from rigapp_model.wear.forces import Constrained

    clearance = parameters.joint.clearance
    return Constrained(parameters, options.speed, clearance, follows_wear=options.evolving)


def _contact_source(parameters: Parameters, options: LifeOptions) -> ForceSource:
    from rigapp_model.wear.impact_forces import SeparateBodies

    return SeparateBodies(parameters, options.speed, options.tolerance, options.alive)


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
"""Names of the techniques that compute the forces of a measured revolution."""


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
    """Return names as an enumeration within a sentence."""
    *first, last = names
    return say("{} or {}", joined(", ", first), last) if first else last
