"""The force of a hanging weight: mass, local gravity, air buoyancy, and the uncertainty of each."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import GTC
import numpy as np
from numpy.typing import ArrayLike

from rigapp_calibration.arrays import Array

REFERENCE_AIR_DENSITY = 1.2
REFERENCE_MASS_DENSITY = 8000.0
"""Of a conventional mass, kg/m^3 (OIML D 28)."""
STANDARD_GRAVITY = 9.80665
"""The standard acceleration of free fall, m/s^2 (CGPM 1901)."""

MassKind = Literal["conventional", "true"]


@dataclass(frozen=True, slots=True)
class Place:
    """Gravity (m/s^2) and air density (kg/m^3) at the weights, with standard uncertainties."""

    gravity: float
    gravity_uncertainty: float
    air_density: float = REFERENCE_AIR_DENSITY
    air_density_uncertainty: float = 0.05


@dataclass(frozen=True, slots=True)
class WeightSet:
    """What the weights are: how their mass is stated, density (kg/m^3), relative uncertainty.

    hanger_mass: mass (kg) that hangs at every loaded step beside the pieces.
    """

    mass_kind: MassKind = "conventional"
    density: float = REFERENCE_MASS_DENSITY
    density_uncertainty: float = 100.0
    relative_uncertainty: float = 5e-5
    hanger_mass: float = 0.0


def normal_gravity(latitude: float, height: float = 0.0) -> float:
    """Return the normal gravity (m/s^2) at a latitude (rad) and height (m) on the ellipsoid.

    Somigliana's closed formula with the WGS 84 constants and the free-air gradient. A local value
    differs by up to some 1e-4 of it.
    """
    s = math.sin(latitude) ** 2
    on_ellipsoid = (
        9.7803253359 * (1.0 + 0.00193185265241 * s) / math.sqrt(1.0 - 0.00669437999013 * s)
    )
    return on_ellipsoid - 3.086e-6 * height


def force_per_mass(weights: WeightSet, place: Place) -> float:
    """Return newton per kilogram of stated mass: gravity less the buoyancy of the air.

    A conventional mass is that of a reference weight of 8000 kg/m^3 which balances the piece in air
    of 1.2 kg/m^3 (OIML D 28); its true mass follows from the piece's own density.
    """
    factor = 1.0 - place.air_density / weights.density
    if weights.mass_kind == "conventional":
        factor *= (1.0 - REFERENCE_AIR_DENSITY / REFERENCE_MASS_DENSITY) / (
            1.0 - REFERENCE_AIR_DENSITY / weights.density
        )
    return place.gravity * factor


def weight_force(mass: ArrayLike, weights: WeightSet, place: Place) -> Array:
    """Return the downward force (N) of stated masses (kg); the hanger adds to every mass > 0."""
    stated = np.asarray(mass, dtype=np.float64)
    hanging = np.where(stated > 0.0, stated + weights.hanger_mass, 0.0)
    return hanging * force_per_mass(weights, place)


def relative_force_uncertainty(weights: WeightSet, place: Place) -> float:
    """Return the relative standard uncertainty of the force of any load of the set.

    Mass, gravity, air density and weight density by first-order propagation. It is common to all
    loads, so it scales the whole calibration and no residual shows it.
    """
    mass = GTC.ureal(1.0, weights.relative_uncertainty, label="mass of the weights")
    gravity = GTC.ureal(place.gravity, place.gravity_uncertainty, label="local gravity")
    air = GTC.ureal(place.air_density, place.air_density_uncertainty, label="air density")
    density = GTC.ureal(weights.density, weights.density_uncertainty, label="density of weights")
    force = mass * gravity * (1.0 - air / density)
    if weights.mass_kind == "conventional":
        force *= (1.0 - REFERENCE_AIR_DENSITY / REFERENCE_MASS_DENSITY) / (
            1.0 - REFERENCE_AIR_DENSITY / density
        )
    return float(GTC.uncertainty(force) / GTC.value(force))


def pin_force(weight: ArrayLike, angle: ArrayLike, offset: float) -> Array:
    """Return the force on the pin (n, 2) in the pin (crank) frame of weights (N) at angles (rad).

    The weight pulls towards -y of the fixed frame; ``offset`` comes from the angle reference step.
    """
    turned = np.asarray(angle, dtype=np.float64) + offset
    size = np.asarray(weight, dtype=np.float64)
    return np.stack((-size * np.sin(turned), -size * np.cos(turned)), axis=-1)
