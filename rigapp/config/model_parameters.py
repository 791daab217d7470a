"""From the parameter file, in the units of its keys, to the model's records in SI."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile
from rigapp.schema.units import stem_of, unit_of_key

if TYPE_CHECKING:
    from model.parameters import Parameters

MM = 1e-3
MPA = 1e6


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
