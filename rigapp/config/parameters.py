"""The parameter file of the model: the text side, units in the keys, and what it means in SI."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.numbers import INERTIA_KG_M2, MASS_KG, MODULUS_MPA, POISSON, within
from rigapp.schema.units import stem_of, unit_of_key

if TYPE_CHECKING:
    from model.parameters import Parameters

MM = 1e-3
MPA = 1e6


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


def to_parameters(file: ParameterFile, source: str = "", section: str = "") -> Parameters:
    """Turn a parameter file's record into the model's records in SI.

    ``source`` and ``section`` (for example "model" for the [model] part of a test) only serve the
    message. Raises UnusableInput naming the key, its value in the file's unit, and the remedy.
    """
    from model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring

    prefix = (f"{source}: " if source else "") + (f"{section}." if section else "")

    def build(kind: Any, table: str, record: msgspec.Struct, **more: Any) -> Any:
        """Build the model's record of a table; a key less its unit is the field."""
        keys = {stem_of(key): key for key in record.__struct_fields__}
        own = {name: key for name, key in keys.items() if name in kind.__dataclass_fields__}
        try:
            return kind(**{name: _in_si(record, key) for name, key in own.items()}, **more)
        except ValueError as error:
            quantity = getattr(error, "quantity", "")
            remedy = getattr(error, "remedy", str(error))
            key = own.get(quantity, quantity)
            value = getattr(record, key, None)
            raise UnusableInput(f"{prefix}{table}.{key} = {value}: {remedy}.") from error

    spring = file.spring and build(Spring, "spring", file.spring)
    mechanism = build(Mechanism, "mechanism", file.mechanism, spring=spring)
    joint = build(Joint, "joint", file.joint)
    material = build(Material, "bushing", file.bushing)
    bushing = build(Bushing, "bushing", file.bushing, material=material)
    pin = build(Material, "pin", file.pin)
    return Parameters(mechanism=mechanism, joint=joint, bushing=bushing, pin=pin)


def _in_si(record: msgspec.Struct, key: str) -> Any:
    value, unit = getattr(record, key), unit_of_key(key)
    assert unit.si is not None, f"{key}: how its unit becomes SI is not known"
    return value if unit.si == 1.0 else value * unit.si
