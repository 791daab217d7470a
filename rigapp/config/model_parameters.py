"""From the parameter file, in the units of its keys, to the model's records in SI."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile

if TYPE_CHECKING:
    from model.parameters import Parameters

MM = 1e-3
MPA = 1e6
G_PER_CM3 = 1e3
MM3_PER_NM = 1e-9


def read_parameters(path: Path) -> Parameters:
    """Read a parameter file into the model's records; raise UnusableInput naming file and key."""
    from rigapp.config.loading import read_parameter_file

    path = Path(path)
    return to_parameters(read_parameter_file(path).record, source=str(path))


def to_parameters(file: ParameterFile, source: str = "", section: str = "") -> Parameters:
    """Turn a parameter file's record into the model's records in SI.

    ``source`` and ``section`` (for example "model" for the [model] part of a test) only serve the
    message. Raises UnusableInput naming the key, its value in the file's unit, and the remedy.
    """
    from model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring

    prefix = (f"{source}: " if source else "") + (f"{section}." if section else "")
    m, s, j, b, p = file.mechanism, file.spring, file.joint, file.bushing, file.pin

    def build(
        kind: Any, table: str, record: Any, scales: Mapping[str, float | None], **more: Any
    ) -> Any:
        """Build one record; a key less its unit is the field, no scale takes the value as it is."""
        values = {key: getattr(record, key) for key in scales}
        fields = {
            field_of(key): values[key] if scale is None else values[key] * scale
            for key, scale in scales.items()
        }
        try:
            return kind(**fields, **more)
        except ValueError as error:
            quantity = getattr(error, "quantity", "")
            remedy = getattr(error, "remedy", str(error))
            key = next((key for key in values if field_of(key) == quantity), quantity)
            raise UnusableInput(f"{prefix}{table}.{key} = {values.get(key)}: {remedy}.") from error

    spring = s and build(Spring, "spring", s, {"stiffness_N_per_m": 1.0, "free_position_mm": MM})
    mechanism = build(
        Mechanism,
        "mechanism",
        m,
        {
            "crank_radius_mm": MM,
            "crank_mass_kg": 1.0,
            "crank_inertia_kg_m2": 1.0,
            "follower_length_mm": MM,
            "follower_mass_kg": 1.0,
            "follower_inertia_kg_m2": 1.0,
            "slider_mass_kg": 1.0,
            "added_mass_kg": 1.0,
            "gravity_m_s2": None,
        },
        spring=spring,
    )
    joint = build(
        Joint,
        "joint",
        j,
        {
            "pin_radius_mm": MM,
            "bushing_radius_mm": MM,
            "bushing_outer_radius_mm": MM,
            "bushing_width_mm": MM,
            "friction_coefficient": 1.0,
        },
    )
    elastic = {"youngs_modulus_MPa": MPA, "poissons_ratio": 1.0}
    bushing = build(
        Bushing,
        "bushing",
        b,
        {
            "density_g_per_cm3": G_PER_CM3,
            "wear_coefficient_mm3_per_Nm": MM3_PER_NM,
        },
        material=build(Material, "bushing", b, elastic),
    )
    pin = build(Material, "pin", p, elastic)
    return Parameters(mechanism=mechanism, joint=joint, bushing=bushing, pin=pin)


UNITS = ("_kg_m2", "_mm3_per_Nm", "_N_per_m", "_g_per_cm3", "_MPa", "_kg", "_mm", "_m_s2")


def field_of(key: str) -> str:
    """Return a key without its unit."""
    for unit in UNITS:
        if key.endswith(unit):
            return key.removesuffix(unit)
    return key
