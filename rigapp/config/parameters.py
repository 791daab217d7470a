"""The parameter file of the model: text with units in the keys, and records in SI units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.numbers import (
    INERTIA_KG_M2,
    MASS_KG,
    MODULUS_MPA,
    POISSON,
    PRESSURE_MPA,
    PRESSURE_VELOCITY,
    SPEED_M_PER_S,
    within,
)
from rigapp.schema.units import stem_of, unit_of_key
from rigapp.texts import say, sentence_of_error
from rigapp_model.restitution import CONTACT_LAWS
from rigapp_model.wear.laws import LAWS

if TYPE_CHECKING:
    from rigapp_model.parameters import Parameters, WearLaw

    WearLawName = str
    ContactLawName = str
else:
    WearLawName = Literal[tuple(LAWS)]
    ContactLawName = Literal[tuple(CONTACT_LAWS)]

LAW_WORDS = msgspec.Meta(
    description="; ".join(f"{law.name}: {law.sentence}" for law in LAWS.values())
)
CONTACT_LAW_WORDS = msgspec.Meta(
    description="; ".join(f"{law.name}: {law.sentence}" for law in CONTACT_LAWS.values())
)

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
    restitution: Annotated[float, within(0.01, 1.0)] = 0.9
    contact_law: Annotated[ContactLawName, CONTACT_LAW_WORDS] = "elements"


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


class WearSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[wear]: the wear law, one of ``LAWS``; a key that the law does not use must be absent.

    bushing.wear_coefficient is the steady one of running-in, that at the reference pressure of the
    pressure exponent, and the mild one of two regimes.
    """

    law: Annotated[WearLawName, LAW_WORDS] = "archard"
    initial_wear_coefficient_mm3_per_Nm: Annotated[float | None, within(0.0, 1.0)] = None
    running_in_revolutions: Annotated[float | None, within(1.0, 1e8)] = None
    pressure_exponent: Annotated[float | None, within(0.5, 2.5)] = None
    reference_pressure_MPa: Annotated[float | None, within(1e-3, 1e4)] = None
    severe_wear_coefficient_mm3_per_Nm: Annotated[float | None, within(0.0, 1.0)] = None
    transition_MPa_m_per_s: Annotated[float | None, PRESSURE_VELOCITY] = None


class PairingSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[pairing]: the range of the pair of materials; beyond it, a test warns.

    pressure_velocity: of nominal pressure (force over pin diameter and bushing width) and sliding
    speed at one crank angle; the largest of a revolution is judged.
    """

    pressure_velocity_low_MPa_m_per_s: Annotated[float | None, PRESSURE_VELOCITY] = None
    pressure_velocity_high_MPa_m_per_s: Annotated[float | None, PRESSURE_VELOCITY] = None
    nominal_pressure_high_MPa: Annotated[float | None, PRESSURE_MPA] = None
    sliding_speed_high_m_per_s: Annotated[float | None, SPEED_M_PER_S] = None


class ParameterFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A parameter file: what ``rigapp model`` reads, and the [model] part of a test."""

    schema: int
    mechanism: MechanismSection
    joint: JointSection
    bushing: BushingSection
    pin: PinSection
    spring: SpringSection | None = None
    wear: WearSection | None = None
    pairing: PairingSection | None = None


def to_parameters(file: ParameterFile, source: str = "", section: str = "") -> Parameters:
    """Convert the record of a parameter file into the model's records in SI units.

    ``source`` and ``section`` (for example "model" for the [model] part of a test) are used in
    messages. Raises UnusableInput naming the key, its value in the file's unit, and the remedy.
    """
    from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring

    prefix = (say("{}: ", source) if source else "") + (f"{section}." if section else "")

    def build(kind: Any, table: str, record: msgspec.Struct, **more: Any) -> Any:
        """Build the model's record of a table; fields are the keys without units."""
        keys = {stem_of(key): key for key in record.__struct_fields__}
        own = {name: key for name, key in keys.items() if name in kind.__dataclass_fields__}
        try:
            return kind(**{name: _in_si(record, key) for name, key in own.items()}, **more)
        except ValueError as error:
            quantity = getattr(error, "quantity", "")
            remedy = getattr(error, "remedy", sentence_of_error(error))
            key = own.get(quantity, quantity)
            value = getattr(record, key, None)
            raise UnusableInput(f"{prefix}{table}.{key} = {value}: {remedy}.") from error

    spring = file.spring and build(Spring, "spring", file.spring)
    mechanism = build(Mechanism, "mechanism", file.mechanism, spring=spring)
    joint = build(Joint, "joint", file.joint)
    material = build(Material, "bushing", file.bushing)
    law = _law(file.wear, file.bushing.wear_coefficient_mm3_per_Nm, f"{prefix}wear")
    bushing = build(Bushing, "bushing", file.bushing, material=material, law=law)
    pin = build(Material, "pin", file.pin)
    return Parameters(mechanism=mechanism, joint=joint, bushing=bushing, pin=pin)


def _law(wear: WearSection | None, coefficient: float, where: str) -> WearLaw:
    """Return the wear law of a bushing; raises UnusableInput for keys that do not fit it."""
    from rigapp_model.parameters import ARCHARD, WearLaw

    if wear is None:
        return ARCHARD
    needs = LAWS[wear.law].needs
    for key in wear.__struct_fields__[1:]:
        is_set = getattr(wear, key) is not None
        if is_set and key not in needs:
            raise UnusableInput(
                "{}.{} has no effect with law = {}; remove it or choose the law that uses it",
                where,
                key,
                repr(wear.law),
            )
        if not is_set and key in needs:
            raise UnusableInput("{}.{} is missing; the law {} needs it", where, key, repr(wear.law))
    if needs and not coefficient > 0.0:
        raise UnusableInput(
            "{}.law = {} needs bushing.wear_coefficient_mm3_per_Nm above 0", where, repr(wear.law)
        )
    first = wear.initial_wear_coefficient_mm3_per_Nm
    if first is not None and first < coefficient:
        raise UnusableInput(
            "{}.initial_wear_coefficient_mm3_per_Nm = {:g} is below"
            " bushing.wear_coefficient_mm3_per_Nm = {:g}, to which it falls",
            where,
            first,
            coefficient,
        )
    scaled = {
        "excess": (first, 1.0 / (coefficient or 1.0), -1.0),
        "running_in": (wear.running_in_revolutions, 1.0, 0.0),
        "exponent": (wear.pressure_exponent, 1.0, 0.0),
        "reference_pressure": (wear.reference_pressure_MPa, MPA, 0.0),
        "beyond": (wear.severe_wear_coefficient_mm3_per_Nm, 1.0 / (coefficient or 1.0), 0.0),
        "transition": (wear.transition_MPa_m_per_s, MPA, 0.0),
    }
    numbers = {key: x * by + plus for key, (x, by, plus) in scaled.items() if x is not None}
    try:
        return WearLaw(wear.law, **numbers)
    except ValueError as error:
        raise UnusableInput("{}, law {}: {}", where, repr(wear.law), error) from error


def _in_si(record: msgspec.Struct, key: str) -> Any:
    value, unit = getattr(record, key), unit_of_key(key)
    assert unit.si is not None, f"{key}: how its unit becomes SI is not known"
    return value if unit.si == 1.0 else value * unit.si
