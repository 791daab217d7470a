"""The parameter file of the model: the text side, with the units in the keys."""

from __future__ import annotations

from typing import Annotated

import msgspec

from rigapp.config.numbers import INERTIA_KG_M2, MASS_KG, MODULUS_MPA, POISSON, within


class MechanismSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[mechanism]: lengths, masses and inertias of crank, follower and slider."""

    crank_radius_mm: Annotated[float, within(1.0, 1000.0)]
    crank_mass_kg: Annotated[float, MASS_KG]
    crank_inertia_kg_m2: Annotated[float, INERTIA_KG_M2]
    follower_length_mm: Annotated[float, within(1.0, 5000.0)]
    follower_mass_kg: Annotated[float, MASS_KG]
    follower_inertia_kg_m2: Annotated[float, INERTIA_KG_M2]
    slider_mass_kg: Annotated[float, MASS_KG]
    added_mass_kg: Annotated[float, MASS_KG] = 0.0
    gravity_m_s2: Annotated[tuple[float, float], within(-20.0, 20.0)] = (0.0, 0.0)


class SpringSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[spring]: force on the slider = -stiffness (position - free position)."""

    stiffness_N_per_m: Annotated[float, within(0.0, 1e6)]
    free_position_mm: Annotated[float, within(-10_000.0, 10_000.0)]


class JointSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[joint]: pin and bushing of the joint of interest."""

    pin_radius_mm: Annotated[float, within(0.5, 500.0)]
    bushing_radius_mm: Annotated[float, within(0.5, 500.0)]
    bushing_outer_radius_mm: Annotated[float, within(1.0, 1000.0)]
    bushing_width_mm: Annotated[float, within(0.5, 1000.0)]
    friction_coefficient: Annotated[float, within(0.0, 2.0)] = 0.0


class BushingSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[bushing]: material of the bushing and its wear coefficient."""

    youngs_modulus_MPa: Annotated[float, MODULUS_MPA]
    poissons_ratio: Annotated[float, POISSON]
    density_g_per_cm3: Annotated[float, within(0.01, 25.0)]
    wear_coefficient_mm3_per_Nm: Annotated[float, within(0.0, 1.0)]


class PinSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[pin]: material of the pin."""

    youngs_modulus_MPa: Annotated[float, MODULUS_MPA]
    poissons_ratio: Annotated[float, POISSON]


class ParameterFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A parameter file: what ``rigapp model`` reads, and the [model] part of a test."""

    schema: int
    mechanism: MechanismSection
    joint: JointSection
    bushing: BushingSection
    pin: PinSection
    spring: SpringSection | None = None
