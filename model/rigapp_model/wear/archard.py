"""Archard's law in closed form: rates, limits, and wear without elastic indentation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import cumulative_simpson

from rigapp.texts import say
from rigapp_model.errors import ModelError, require_positive

Array = NDArray[np.float64]


def largest_explicit_step(
    node_spacing: float, wear_coefficient: float, slip: float, modulus: float
) -> float:
    """Return the stability limit of an explicit step, in cycles.

    4 dx / (pi K s E'): beyond it the shortest wave on the mesh (two node spacings dx, m) grows
    from step to step, because the wear of one step exceeds its indentation.
    modulus: E' = E / (1 - nu^2), Pa; slip: of a cycle, m. Proportional to the node spacing.
    """
    require_positive("node_spacing", node_spacing, "m")
    require_positive("modulus", modulus, "Pa")
    rate = wear_coefficient * slip * modulus
    return float("inf") if rate == 0.0 else float(4.0 * node_spacing / (np.pi * rate))


@dataclass(frozen=True, slots=True)
class RigidWear:
    """Wear by a pin without indentation: cycles, depth (m), worn area (m^2)."""

    cycles: Array
    depth: Array
    area: Array


def rigid_wear(
    inner: float,
    pin_radius: float,
    force: float,
    wear_coefficient: float,
    slip: float,
    cycles: ArrayLike,
) -> RigidWear:
    """Compute the wear by a constant force with negligible elastic indentation.

    inner, pin_radius: m; force: per metre of width, N/m; slip: of a cycle, m. With the pin centre
    at d the half-angle f of the worn part has cos f = (a^2 - d^2 - R1^2) / (2 d R1), and Archard's
    law with the pressure of that part gives dN/dd = R1 (f + sin(2 f) / 2) / (K s F); depth is d
    less the clearance. Raises ModelError without clearance or if the wear leaves its range.
    """
    require_positive("force", force, "N/m")
    start = inner - pin_radius
    requested = np.asarray(cycles, dtype=np.float64)
    rate = wear_coefficient * slip * force
    effort = rate * float(requested.max())
    # Upper bound of the depth: the pressure is at least force over the pin's diameter.
    deepest = 1.01 * effort / (np.pi * pin_radius / 2.0) + 4.0 * np.cbrt(
        (effort / pin_radius) ** 2 * abs(start) / pin_radius
    )
    course = rigid_course(inner, pin_radius, max(deepest, 1e-12 * inner))
    if course.effort[-1] < effort:
        raise ModelError("cycles", float(requested.max()), say("the wear would leave its range"))
    depth = np.interp(rate * requested, course.effort, course.depth)
    return RigidWear(requested, depth, worn_lens(inner, pin_radius, depth))


@dataclass(frozen=True, slots=True)
class RigidCourse:
    """Wear by a rigid pin: depth (m), worn area (m^2), and effort K s F N (m^2).

    Depends only on the effort, the product of wear coefficient, slip, force per width and cycles.
    """

    depth: Array
    area: Array
    effort: Array


def rigid_course(inner: float, pin_radius: float, deepest: float) -> RigidCourse:
    """Compute the course of rigid wear up to a depth (m); raise ModelError without clearance."""
    start = inner - pin_radius
    require_positive("clearance", start, "m")
    require_positive("deepest", deepest, "m")
    # The half-angle starts as a root of the depth: in u with depth = deepest u^2 all is smooth.
    u = np.linspace(0.0, 1.0, 20001)
    depth = deepest * u * u
    f = _half_angle(inner, pin_radius, depth)
    slope = pin_radius * (f + 0.5 * np.sin(2.0 * f)) * 2.0 * deepest * u
    effort = cumulative_simpson(slope, x=u, initial=0.0)
    return RigidCourse(depth, worn_lens(inner, pin_radius, depth), effort)


def _half_angle(inner: float, pin_radius: float, depth: Array) -> Array:
    """Return the half-angle of the worn part at depths, rad."""
    d = inner - pin_radius + depth
    cosine = (inner**2 - d**2 - pin_radius**2) / (2.0 * d * pin_radius)
    return np.arccos(np.clip(cosine, -1.0, 1.0))


def rigid_half_angle(inner: float, pin_radius: float, depth: float) -> float:
    """Return the half-angle (rad) of the part worn by a rigid pin at a depth (m)."""
    if inner - pin_radius + depth <= 0.0:
        return float(np.pi / 2.0)
    return float(_half_angle(inner, pin_radius, np.array(depth)))


def worn_lens(inner: float, pin_radius: float, depth: Array) -> Array:
    """Return the area of the pin's circle outside the bushing's circle, m^2."""
    d = inner - pin_radius + depth
    f = _half_angle(inner, pin_radius, depth)
    g = np.arctan2(pin_radius * np.sin(f), d + pin_radius * np.cos(f))
    pin_part = pin_radius**2 * f + d * pin_radius * np.sin(f)
    return np.asarray(pin_part - inner**2 * g)
