"""Frictionless contact of the rigid pin and the elastic bushing: touching nodes and forces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.bushing import active_set
from rigapp_model.bushing.compliance import SurfaceCompliance
from rigapp_model.errors import ModelError

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Indentation over wall thickness beyond which linear elasticity does not hold.
LARGEST_INDENTATION = 0.2
# Fraction of the pin's radius beyond which its flanks are nearly parallel to the force.
FLANK = 0.98
# Pressure over modulus beyond which linear elasticity does not hold.
LARGEST_STRAIN = 0.25


class ContactError(ModelError):
    """The contact cannot carry the load; the message gives the reason."""


class ArcTooSmall(ContactError):
    """The contact reaches beyond the arc of nodes chosen for it."""


@dataclass(frozen=True, slots=True)
class Contact:
    """Solution of one contact: position of the pin and nodal forces.

    ``pin``: pin centre from the bushing's centre, (2,), m; ``force``: normal force of each
    node per metre of width, (N,), N/m; ``frame``: outward unit normals (N, 4), in x and y and
    in radial and tangential components; ``gap``: between pin and surface after elastic
    displacement and wear, m; ``touching``: flags; ``iterations``: their number.
    """

    pin: Array
    force: Array
    frame: Array
    gap: Array
    touching: Flags
    iterations: int


def solve_contact(
    compliance: SurfaceCompliance,
    surface: Array,
    pin_radius: float,
    force: ArrayLike,
    start: Contact | None = None,
) -> Contact:
    """Solve the contact of the pin with the surface under one force.

    surface: positions of the compliance's nodes, (N, 2), m; force: on the bushing by the pin per
    metre of width, (2,), N/m; start: contact to start from. The result is verified:
    gap >= 0, force >= 0, force x gap = 0, sum of force x normal = ``force``. Raises ContactError
    if the surface cannot carry the force, ArcTooSmall if an end of the arc touches.
    """
    load = np.ascontiguousarray(force, dtype=np.float64)
    size = float(np.hypot(load[0], load[1]))
    if not np.isfinite(size):
        raise ContactError("force", say("not finite"), say("give finite components"))
    if size == 0.0:
        raise ContactError("force", 0.0, say("without a force there is no contact to solve"), "N/m")
    if start is None:
        pin, touching = first_guess(surface, compliance, pin_radius, load)
        pressed = np.zeros(len(surface))
    else:
        pin, touching, pressed = start.pin.copy(), start.touching.copy(), start.force.copy()
    gap = np.empty(len(surface))
    frame = np.empty((len(surface), 4))
    status, iterations = active_set.solve(
        surface,
        compliance.axis,
        compliance.polar,
        np.zeros(len(surface)),
        pin_radius,
        load,
        pin,
        touching,
        pressed,
        gap,
        frame,
    )
    if status != active_set.CARRIED:
        raise ContactError("force", size, _REASONS[status], say("N per metre of width"))
    contact = Contact(pin, pressed, frame, gap, touching, iterations)
    if touching[compliance.ends].any():
        raise ArcTooSmall("force", size, _BEYOND_ARC, say("N per metre of width"))
    return contact


_REASONS = {
    active_set.NOT_SETTLED: say(
        "the contact found no balance; the load is too high for this bushing or the profile"
        " is not smooth"
    ),
    active_set.ONE_SIDED: say(
        "no bushing material lies in the direction of the force, so nothing can carry it"
    ),
}
_BEYOND_ARC = say("the contact reaches beyond the arc of nodes that may touch; lower the force")


def first_guess(
    surface: Array, compliance: SurfaceCompliance, pin_radius: float, force: Array
) -> tuple[Array, Flags]:
    """Return an initial pin centre and touching flags, from a Winkler foundation."""
    size = np.hypot(force[0], force[1])
    direction = force / size
    along = surface @ direction
    across2 = (surface * surface).sum(axis=1) - along**2
    facing = np.flatnonzero((along > 0.0) & (across2 < (FLANK * pin_radius) ** 2))
    touching = np.zeros(len(surface), dtype=np.bool_)
    if facing.size == 0:
        return np.zeros(2), touching
    gap = along[facing] - np.sqrt(pin_radius**2 - across2[facing])
    gaps = np.sort(gap)
    stiffness = 0.3 / compliance.polar[0, facing, facing].mean()
    carried = np.arange(1, gaps.size + 1) * gaps - np.cumsum(gaps)
    count = max(int(np.searchsorted(carried, size / stiffness)), 1)
    touching[facing[gap <= gaps[count - 1]]] = True
    return (size / stiffness + gaps[:count].sum()) / count * direction, touching


def simpson_weights(surface: Array) -> Array:
    """Return the length of the closed surface at each node, m.

    surface: positions of all nodes of the ring, (N, 2), corner and middle nodes in turn. Simpson's
    rule in each element, on the polygon through its three nodes: the current arc length. Pressure =
    force / weight.
    """
    step = np.empty_like(surface)
    np.subtract(surface[1:], surface[:-1], out=step[:-1])
    np.subtract(surface[0], surface[-1], out=step[-1])
    ahead = np.hypot(step[:, 0], step[:, 1])
    element = ahead[0::2] + ahead[1::2]
    weights = np.empty(len(surface))
    weights[1::2] = element * (4.0 / 6.0)
    weights[2::2] = (element[1:] + element[:-1]) / 6.0
    weights[0] = (element[0] + element[-1]) / 6.0
    return weights


def refuse_beyond_elasticity(
    force: float, indentation: float, wall: float, pressure: float, modulus: float
) -> None:
    """Raise ContactError where linear elasticity does not hold.

    force: N/m; indentation: of the pin, m; wall: thickness of the bushing, m; pressure: maximum,
    Pa; modulus: E / (1 - nu^2), Pa.
    """
    unit = say("N per metre of width")
    sinks = say("the pin would sink {:.3g} mm", indentation * 1000.0)
    if indentation >= wall:
        end = say("{} and go through the wall of {:.3g} mm; lower the force", sinks, wall * 1000.0)
        raise ContactError("force", force, end, unit)
    if indentation > LARGEST_INDENTATION * wall or pressure > LARGEST_STRAIN * modulus:
        raise ContactError(
            "force",
            force,
            say(
                "{} into a wall of {:.3g} mm with {:.3g} MPa, which is beyond linear"
                " elasticity; lower the force or give a stiffer bushing",
                sinks,
                wall * 1000.0,
                pressure * 1e-6,
            ),
            unit,
        )
