"""The contact laws in one table, and their restitution.

A new law is one row here and, if its elastic force is new, a curve in
``rigapp_model.contact.indentation``. Imports no numerical library: the command line's help uses it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from rigapp.texts import joined, say
from rigapp_model.errors import ModelError, require_positive

LEAST_RESTITUTION = 0.01
NEARLY_ELASTIC = 0.999
"""Above it, Lankarani and Nikravesh's damping is exact to 1e-6 of the restitution."""
MISSED = 0.02
"""Error of the restitution from which it is reported; the restitution of a rig is as uncertain."""


@dataclass(frozen=True, slots=True)
class ContactLaw:
    """Law of the normal force, F = elastic(d) (1 + a d'/d0').

    name: in files; sentence: description; elastic: "elements", "pereira", "liu" or "sphere";
    damping: function from restitution to the factor a.
    """

    name: str
    sentence: str
    elastic: str
    damping: Callable[[float], float]


def exact_damping(restitution: float) -> float:
    """Return the factor a for a restitution e: the root of a (1 + e) = ln((1 + a)/(1 - a e)).

    The loss of an impact with F = f(d) (1 + a d'/d0') depends on a alone, for any f: integrate
    v dv / (1 + a v/d0') = -f dd / m from first contact to rest and from rest to separation
    (Gonthier and others, 2004). 0 at e = 1.
    """
    if restitution > NEARLY_ELASTIC:
        return lankarani_damping(restitution)

    def remainder(factor: float) -> float:
        return 1.0 - factor * restitution - (1.0 + factor) * math.exp(-factor * (1.0 + restitution))

    # Also 0 without damping; positive between there and the root.
    return _root(remainder, 0.5 * (1.0 - restitution), 1.0 / restitution)


def restitution_of(damping: float) -> float:
    """Return the restitution of a damping factor, the inverse of ``exact_damping``."""
    if damping < lankarani_damping(NEARLY_ELASTIC):
        return math.sqrt(1.0 - damping / 0.75)
    lost = damping - math.log1p(damping)
    return _root(lambda x: 1.0 - x - math.exp(-x - lost), 0.0, 1.0) / damping


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the root of a decreasing function by bisection."""
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def lankarani_damping(restitution: float) -> float:
    """Return 3 (1 - e^2)/4 (Lankarani and Nikravesh, 1990), for e near 1."""
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
    """Raise ModelError for an unknown law or a restitution out of range."""
    if law not in CONTACT_LAWS:
        raise ModelError("contact_law", law, say("choose {}", joined(", ", tuple(CONTACT_LAWS))))
    require_positive("restitution", restitution)
    if restitution > 1.0:
        raise ModelError("restitution", restitution, say("it must not exceed 1"))
    if restitution < LEAST_RESTITUTION:
        raise ModelError("restitution", restitution, say("give {:g} or more", LEAST_RESTITUTION))
