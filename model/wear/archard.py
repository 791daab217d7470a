"""Archard's law in closed form: rates, limits, and the wear of a pin that does not indent."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import cumulative_simpson

from model.errors import ModelError, require_positive

Array = NDArray[np.float64]


def largest_explicit_step(
    node_spacing: float, wear_coefficient: float, slip: float, modulus: float
) -> float:
    """Return the most cycles that explicit extrapolation may take at once.

    4 dx / (pi K s E'): beyond it the shortest wave on the mesh (two node spacings dx, m) grows
    from step to step, because the wear of one step takes away more than its indentation.
    modulus: E' = E / (1 - nu^2), Pa; slip: of a cycle, m. Halves when the mesh is refined.
    """
    require_positive("node_spacing", node_spacing, "m")
    require_positive("modulus", modulus, "Pa")
    rate = wear_coefficient * slip * modulus
    return float("inf") if rate == 0.0 else float(4.0 * node_spacing / (np.pi * rate))


@dataclass(frozen=True, slots=True)
class RigidWear:
    """Hold the wear by a pin that does not indent: cycles, depth (m), worn area (m^2)."""

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
    """Compute the wear by a constant force where elastic indentation is negligible.

    inner, pin_radius: m; force: per metre of width, N/m; slip: of a cycle, m. With the pin centre
    at d the half-angle f of the worn part has cos f = (a^2 - d^2 - R1^2) / (2 d R1), and Archard's
    law with the pressure of that part gives dN/dd = R1 (f + sin(2 f) / 2) / (K s F); depth is d
    less the clearance. Raises ModelError without clearance or when the wear leaves its range.
    """
    require_positive("force", force, "N/m")
    start = inner - pin_radius
    require_positive("clearance", start, "m")
    wanted = np.asarray(cycles, dtype=np.float64)
    rate = wear_coefficient * slip * force / pin_radius
    # A variable with the square root's start taken out: d = start + depth_scale u^2.
    end = start + max(rate * float(wanted.max()), 1e-12 * start) * 4.0
    end += np.cbrt((rate * float(wanted.max())) ** 2 * start / pin_radius)
    u = np.linspace(0.0, 1.0, 20001)
    d = start + (end - start) * u * u
    cosine = (inner**2 - d**2 - pin_radius**2) / (2.0 * d * pin_radius)
    f = np.arccos(np.clip(cosine, -1.0, 1.0))
    slope = (f + 0.5 * np.sin(2.0 * f)) / rate * 2.0 * (end - start) * u if rate > 0.0 else 0.0 * u
    run = cumulative_simpson(slope, x=u, initial=0.0)
    if rate > 0.0 and run[-1] < wanted.max():
        raise ModelError("cycles", float(wanted.max()), "the wear would leave its range")
    depth = np.interp(wanted, run, d - start) if rate > 0.0 else np.zeros_like(wanted)
    return RigidWear(wanted, depth, _lens(inner, pin_radius, start + depth))


def rigid_half_angle(inner: float, pin_radius: float, depth: float) -> float:
    """Return the half-angle (rad) of the worn part when a rigid pin has worn in to a depth (m)."""
    d = inner - pin_radius + depth
    if d <= 0.0:
        return float(np.pi / 2.0)
    cosine = (inner**2 - d**2 - pin_radius**2) / (2.0 * d * pin_radius)
    return float(np.arccos(np.clip(cosine, -1.0, 1.0)))


def _lens(inner: float, pin_radius: float, d: Array) -> Array:
    """Return the area of the pin's circle at d that lies outside the bushing's circle, m^2."""
    f = np.arccos(np.clip((inner**2 - d**2 - pin_radius**2) / (2.0 * d * pin_radius), -1.0, 1.0))
    g = np.arctan2(pin_radius * np.sin(f), d + pin_radius * np.cos(f))
    pin_part = pin_radius**2 * f + d * pin_radius * np.sin(f)
    return np.asarray(pin_part - inner**2 * g)
