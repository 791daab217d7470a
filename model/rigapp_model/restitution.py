"""The contact laws in one table, and their restitution.

A new law is one row here, and where it is elastic in its own way a curve in
``rigapp_model.contact.indentation``. Nothing is imported here: a command line's help reads them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from rigapp.texts import joined, say
from rigapp_model.errors import ModelError, require_positive

LEAST_RESTITUTION = 0.01
NEARLY_ELASTIC = 0.999
"""Above, Lankarani and Nikravesh's damping is exact to 1e-6 of the restitution."""
MISSED = 0.02
"""A larger error of the restitution is reported: that of a rig is not known better."""


@dataclass(frozen=True, slots=True)
class ContactLaw:
    """One law of the normal force, F = elastic(d) (1 + a d'/d0').

    name: in files; sentence: what it is; elastic: "elements", "pereira", "liu" or "sphere";
    damping: the factor a for a restitution.
    """

    name: str
    sentence: str
    elastic: str
    damping: Callable[[float], float]


def exact_damping(restitution: float) -> float:
    """Return the factor a that gives a restitution e back: a (1 + e) = ln((1 + a)/(1 - a e)).

    The loss of an impact by F = f(d) (1 + a d'/d0') depends on a alone, whatever f is: integrate
    v dv / (1 + a v/d0') = -f dd / m from touch to rest and from rest to parting (Gonthier and
    others, 2004). 0 at e = 1.
    """
    if restitution > NEARLY_ELASTIC:
        return lankarani_damping(restitution)

    def taken(factor: float) -> float:
        return 1.0 - factor * restitution - (1.0 + factor) * math.exp(-factor * (1.0 + restitution))

    # Also 0 without damping; between there and the root it is above.
    return _root(taken, 0.5 * (1.0 - restitution), 1.0 / restitution)


def restitution_of(damping: float) -> float:
    """Return the restitution that a damping factor gives: ``exact_damping`` the other way round."""
    if damping < lankarani_damping(NEARLY_ELASTIC):
        return math.sqrt(1.0 - damping / 0.75)
    lost = damping - math.log1p(damping)
    return _root(lambda x: 1.0 - x - math.exp(-x - lost), 0.0, 1.0) / damping


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the root of a falling function, by bisection."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def lankarani_damping(restitution: float) -> float:
    """Return 3 (1 - e^2)/4 (Lankarani and Nikravesh, 1990): for e near 1."""
    return 0.75 * (1.0 - restitution**2)


def flores_damping(restitution: float) -> float:
    """Return 8 (1 - e)/(5 e) (Flores, Machado, Silva and Martins, 2011)."""
    return 8.0 * (1.0 - restitution) / (5.0 * restitution)


DEFAULT_LAW = "elements"
CONTACT_LAWS = {
    law.name: law
    for law in (
        ContactLaw(
            "elements",
            say("as stiff as the elastic bushing of the wear model; the restitution is exact"),
            "elements",
            exact_damping,
        ),
        ContactLaw(
            "pereira",
            say("a cylinder in a cylinder by Pereira and others (2011)"),
            "pereira",
            lankarani_damping,
        ),
        ContactLaw(
            "liu",
            say("a cylinder in a cylinder by Liu and others (2007); the restitution is exact"),
            "liu",
            exact_damping,
        ),
        ContactLaw(
            "lankarani-nikravesh",
            say("a sphere in a sphere, whatever the width; for a restitution near 1"),
            "sphere",
            lankarani_damping,
        ),
        ContactLaw(
            "flores",
            say("a sphere in a sphere, whatever the width, by Flores and others (2011)"),
            "sphere",
            flores_damping,
        ),
    )
}
"""Name -> law, the default first."""


def check_law(law: str, restitution: float) -> None:
    """Raise ModelError for a law that does not exist or a restitution out of range."""
    if law not in CONTACT_LAWS:
        raise ModelError("contact_law", law, say("choose {}", joined(", ", tuple(CONTACT_LAWS))))
    require_positive("restitution", restitution)
    if restitution > 1.0:
        raise ModelError("restitution", restitution, say("it must not exceed 1"))
    if restitution < LEAST_RESTITUTION:
        raise ModelError("restitution", restitution, say("give {:g} or more", LEAST_RESTITUTION))
