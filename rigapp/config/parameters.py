"""The parameter file of the model: the text side, with the units in the keys."""

from __future__ import annotations

import msgspec


class MechanismSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[mechanism]: lengths, masses and inertias of crank, follower and slider."""

    crank_radius_mm: float
    crank_mass_kg: float
    crank_inertia_kg_m2: float
    follower_length_mm: float
    follower_mass_kg: float
    follower_inertia_kg_m2: float
    slider_mass_kg: float
    added_mass_kg: float = 0.0
    gravity_m_s2: tuple[float, float] = (0.0, 0.0)


class SpringSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[spring]: force on the slider = -stiffness (position - free position)."""

    stiffness_N_per_m: float
    free_position_mm: float


class JointSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[joint]: pin and bushing of the joint of interest."""

    pin_radius_mm: float
    bushing_radius_mm: float
    bushing_outer_radius_mm: float
    bushing_width_mm: float
    friction_coefficient: float = 0.0


class BushingSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[bushing]: material of the bushing and its wear coefficient."""

    youngs_modulus_MPa: float
    poissons_ratio: float
    density_g_per_cm3: float
    wear_coefficient_mm3_per_Nm: float


class PinSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[pin]: material of the pin."""

    youngs_modulus_MPa: float
    poissons_ratio: float


class ParameterFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A parameter file: what ``rigapp model`` reads, and the [model] part of a test."""

    schema: int
    mechanism: MechanismSection
    joint: JointSection
    bushing: BushingSection
    pin: PinSection
    spring: SpringSection | None = None
