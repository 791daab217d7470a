"""Elastic contact laws: the indentation of a bushing by its pin under a force.

The default, ``elements``, is the indentation of the clamped elastic ring of the wear model, so that
technique 3 has the same stiffness as the bushing that wears. The laws of Pereira and Liu are
published for cylinders in cylinders; that of a sphere, Hertz', has no width.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from rigapp.texts import say
from rigapp_model.bushing.contact import ContactError
from rigapp_model.bushing.ring import Ring, pressure_distribution
from rigapp_model.contact.impact_laws import SEGMENTS
from rigapp_model.contact_law import ContactModel, hertz_stiffness
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Joint, Material
from rigapp_model.restitution import CONTACT_LAWS

Array = NDArray[np.float64]

NARROW = 0.08
"""Half-angle of contact, rad, below which half-space theory continues the elements to 2e-4."""
STEP = 1.6
"""Ratio of consecutive forces, from the narrow contact to the elastic limit."""
FEWEST = 4
FAINT = 1e-9
"""First depth of a curve over its last; below it, the curve is extrapolated as a power."""
NEWTON_STEPS = 4
PEREIRA_MEETS = 0.34954
"""Clearance, mm, at which the two branches of Pereira's exponent agree to 1e-4."""
MICRON_RANGE = (5e-6, 10e-3)  # m: clearances of the fit of Pereira's exponent


@dataclass(frozen=True, slots=True, eq=False)
class Indentation:
    """Smooth curve of force (N) over depth (m) of a pin in a bushing.

    ``table`` (SEGMENTS, 4): cubics of log force over log depth, highest power first; ``begin``
    and ``spacing``: of the log depth. Beyond the ends the curve is extrapolated as a power of the
    depth; ``end`` (m): largest depth at which the law is valid, inf without a limit.
    """

    table: Array
    begin: float
    spacing: float
    end: float

    def force(self, depth: ArrayLike) -> Array:
        """Return the force (N) at depths (m) above 0."""
        deep: Array = np.log(np.asarray(depth, dtype=np.float64))
        return np.asarray(np.exp(self._log_force(deep)[0]))

    def depth(self, force: ArrayLike) -> Array:
        """Return the depth (m) under forces (N) above 0."""
        target = np.log(np.asarray(force, dtype=np.float64))
        knots: Array = self.begin + self.spacing * np.arange(SEGMENTS + 1.0)
        deep: Array = np.interp(target, self._log_force(knots)[0], knots)
        for _ in range(NEWTON_STEPS):
            value, slope = self._log_force(deep)
            deep = deep + (target - value) / slope
        return np.asarray(np.exp(deep))

    def _log_force(self, deep: Array) -> tuple[Array, Array]:
        """Return the log of the force over that of the depth, and its slope."""
        last = self.begin + SEGMENTS * self.spacing
        inside = np.clip(deep, self.begin, last)
        at = np.minimum(((inside - self.begin) / self.spacing).astype(np.int64), SEGMENTS - 1)
        offset = inside - self.begin - at * self.spacing
        c3, c2, c1, c0 = self.table[at].T
        slope = c1 + offset * (2.0 * c2 + 3.0 * offset * c3)
        return c0 + offset * (c1 + offset * (c2 + offset * c3)) + slope * (deep - inside), slope


def indentation(
    joint: Joint, bushing: Material, pin: Material, contact: ContactModel
) -> Indentation | float:
    """Return the elastic curve of a contact's law, or K (N/m^1.5) of a force K d^1.5."""
    hertz = hertz_stiffness(joint, bushing, pin)
    if contact.stiffness is not None:
        return contact.stiffness
    law = LAWS[CONTACT_LAWS[contact.law].elastic]
    return hertz if law is None else law(joint, bushing, pin)


def elements(joint: Joint, bushing: Material, pin: Material) -> Indentation:
    """Return the indentation of the elastic ring of the wear model; raise ModelError.

    The pin is elastic too: the ring's modulus is that of both bodies, 1/E* = sum (1 - nu^2)/E.
    """
    depth, force = _ring_curve(
        joint.bushing_radius,
        joint.bushing_outer_radius,
        joint.pin_radius,
        contact_modulus(bushing, pin) * (1.0 - bushing.poissons_ratio**2),
        bushing.poissons_ratio,
    )
    return curve(depth, force * joint.bushing_width, float(depth[-1]))


def pereira(joint: Joint, bushing: Material, pin: Material) -> Indentation:
    """Return the fitted law of Pereira, Ramalho and Ambrosio (2011) for internal contact.

    F = (0.965 c + 0.0965) L E* / c depth^n, n = Y c^-0.005, Y = 1.51 ln(1000 c)^-0.151 up to a
    clearance c of 0.34954 mm, and 0.0151 c + 1.151 from there; in N, mm and MPa. Raises ModelError
    outside 5 um to 10 mm.
    """
    low, high = MICRON_RANGE
    if not low <= joint.clearance <= high:
        raise ModelError(
            "clearance",
            joint.clearance,
            say("the law of Pereira was fitted from {:g} to {:g} m; choose elements", low, high),
            "m",
        )
    c = 1e3 * joint.clearance
    shape = 1.51 * np.log(1e3 * c) ** -0.151 if c < PEREIRA_MEETS else 0.0151 * c + 1.151
    modulus = 1e-6 * contact_modulus(bushing, pin)
    stiffness = (0.965 * c + 0.0965) * 1e3 * joint.bushing_width * modulus / c
    depth = _depths(joint)
    return curve(depth, stiffness * (1e3 * depth) ** (shape * c**-0.005), np.inf)


def liu(joint: Joint, bushing: Material, pin: Material) -> Indentation:
    """Return the law of Liu, Zhang and Yang (2007): pi/2 L E* depth sqrt(depth/(2 (c + depth)))."""
    depth = _depths(joint)
    share = np.sqrt(depth / (2.0 * (joint.clearance + depth)))
    modulus = contact_modulus(bushing, pin)
    return curve(depth, 0.5 * np.pi * joint.bushing_width * modulus * depth * share, np.inf)


def contact_modulus(bushing: Material, pin: Material) -> float:
    """Return E* of both bodies, 1/E* = sum (1 - nu^2)/E, Pa."""
    compliance = sum((1.0 - m.poissons_ratio**2) / m.youngs_modulus for m in (bushing, pin))
    return float(1.0 / compliance)


def curve(depth: Array, force: Array, end: float) -> Indentation:
    """Return a smooth curve through depths (m, increasing) and forces (N)."""
    uneven = CubicSpline(np.log(depth), np.log(force))
    grid = np.linspace(np.log(depth[0]), np.log(depth[-1]), SEGMENTS + 1)
    even = CubicSpline(grid, uneven(grid))
    table = np.ascontiguousarray(even.c.T)
    return Indentation(table, float(grid[0]), float(grid[1] - grid[0]), end)


def _depths(joint: Joint) -> Array:
    """Return depths up to the wall's thickness, m."""
    wall = joint.bushing_outer_radius - joint.bushing_radius
    return np.geomspace(FAINT * wall, wall, 4 * SEGMENTS + 1)


@lru_cache(maxsize=32)
def _ring_curve(
    inner: float, outer: float, pin_radius: float, youngs_modulus: float, poissons_ratio: float
) -> tuple[Array, Array]:
    """Return depths (m) and forces (N per metre of width) of the ring, both increasing.

    By the elements from a narrow contact to the limit of linear elasticity. For a narrower contact
    the difference to a half-space under a line load is independent of the force: its depth is
    q/(pi E*) (C - ln q), with C from the narrowest contact of the elements.
    """
    ring = Ring(inner, outer, pin_radius, youngs_modulus, poissons_ratio)
    points: list[tuple[float, float]] = []
    load = _narrow_load(ring)
    while True:
        try:
            contact = pressure_distribution(ring, (load, 0.0))
        except ContactError:
            break
        points.append((float(contact.pin[0]) - ring.clearance, load))
        load *= STEP
    if len(points) < FEWEST:
        raise ModelError(
            "clearance",
            ring.clearance,
            say("the bushing carries too little for the elements; choose the law pereira or liu"),
            "m",
        )
    depth, force = np.array(points).T
    line = 1.0 / (np.pi * ring.modulus)
    constant = depth[0] / (line * force[0]) + np.log(force[0])
    faint = force[0] * np.geomspace(FAINT, 1.0, 41)[:-1]
    return (
        np.concatenate([line * faint * (constant - np.log(faint)), depth]),
        np.concatenate([faint, force]),
    )


def _narrow_load(ring: Ring) -> float:
    """Return the force (N per metre of width) of a contact with the half-angle ``NARROW``."""
    low, high = 0.0, ring.modulus * ring.wall
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ring.half_angle(middle) < NARROW else (low, middle)
    return high


LAWS: dict[str, Callable[[Joint, Material, Material], Indentation] | None] = {
    "elements": elements,
    "pereira": pereira,
    "liu": liu,
    "sphere": None,
}
"""Name of an elastic law -> its curve; None for Hertz' K d^1.5."""
