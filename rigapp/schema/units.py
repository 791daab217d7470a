"""Units, each defined once: ending of a key, written form, and typical mistakes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Final


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit that the end of a key names.

    words: written form in a sentence. file: written form in a test file, that of ``words`` when
    None, empty where a file leaves it in the name. si: factor of the key's number to SI, None
    without a conversion. mistaken: units typed by mistake: name, factor
    and offset to this one.
    """

    ending: str
    words: str
    file: str | None = None
    si: float | None = None
    mistaken: tuple[tuple[str, float, float], ...] = ()


_ALL = (
    Unit("_um_per_1000_revolutions", "um per 1000 revolutions", "um/1000"),
    Unit("_MPa_m_per_s", "MPa m/s", None, 1e6, (("W/mm^2", 1.0, 0.0), ("Pa m/s", 1e-6, 0.0))),
    Unit("_mV_per_V_per_N2", "mV/V per N^2", ""),
    Unit("_N_per_mV_per_V", "N per mV/V", "N/(mV/V)"),
    Unit("_mm3_per_Nm", "mm^3/(N m)", "mm3/(N m)", 1e-9, (("m^2/N", 1e9, 0.0),)),
    Unit("_N_per_hour", "N/h", ""),
    Unit("_kg_per_m3", "kg/m^3", "kg/m3", 1.0, (("g/cm^3", 1e3, 0.0), ("g/m^3", 1e-3, 0.0))),
    Unit("_g_per_cm3", "g/cm^3", "g/cm3", 1e3, (("kg/m^3", 1e-3, 0.0),)),
    Unit("_rpm_per_s", "rpm/s"),
    Unit("_m_per_s", "m/s", None, 1.0, (("mm/s", 1e-3, 0.0),)),
    Unit("_um_per_V", "um/V", None, None, (("mm/V", 1e3, 0.0), ("m/V", 1e6, 0.0))),
    Unit("_mV_per_V", "mV/V", None, None, (("V/V", 1e3, 0.0), ("uV/V", 1e-3, 0.0))),
    Unit("_N_per_m", "N/m", None, 1.0, (("N/mm", 1e3, 0.0),)),
    Unit("_K_per_W", "K/W", ""),
    Unit("_kg_m2", "kg m^2", "kg m2", 1.0, (("kg mm^2", 1e-6, 0.0), ("g mm^2", 1e-9, 0.0))),
    Unit("_m_s2", "m/s^2", "m/s2", 1.0, (("cm/s^2 (Gal)", 1e-2, 0.0), ("mm/s^2", 1e-3, 0.0))),
    Unit("_percent", "%", None, None, (("a share of 1", 100.0, 0.0),)),
    Unit("_revolutions", "revolutions", ""),
    Unit("_degC", "degC", "", None, (("K", 1.0, -273.15),)),
    Unit("_days", "days", ""),
    Unit("_MPa", "MPa", None, 1e6, (("GPa", 1e3, 0.0), ("Pa", 1e-6, 0.0))),
    Unit("_hPa", "hPa", "", None, (("kPa", 10.0, 0.0), ("Pa", 1e-2, 0.0))),
    Unit("_rpm", "rpm", None, None,
         (("revolutions/s", 60.0, 0.0), ("revolutions/h", 1.0 / 60.0, 0.0))),
    Unit("_deg", "deg"),
    Unit("_Nm", "N m"),
    Unit("_Hz", "Hz"),
    Unit("_kg", "kg", None, 1.0, (("g", 1e-3, 0.0),)),
    Unit("_mm", "mm", None, 1e-3, (("m", 1e3, 0.0), ("um", 1e-3, 0.0))),
    Unit("_um", "um", None, 1e-6, (("mm", 1e3, 0.0), ("m", 1e6, 0.0))),
    Unit("_ms", "ms", None, 1e-3, (("s", 1e3, 0.0), ("us", 1e-3, 0.0))),
    Unit("_h", "h"),
    Unit("_A", "A", ""),
    Unit("_C", "degC", ""),
    Unit("_K", "K", ""),
    Unit("_N", "N", None, 1.0, (("kN", 1e3, 0.0), ("mN", 1e-3, 0.0))),
    Unit("_V", "V", None, 1.0),
    Unit("_m", "m", "", 1.0, (("km", 1e3, 0.0),)),
    Unit("_s", "s", None, 1.0, (("ms", 1e-3, 0.0),)),
)  # fmt: skip

UNITS: Final = tuple(sorted(_ALL, key=lambda unit: -len(unit.ending)))
"""Longer endings first."""

MISTAKEN: Final[Mapping[str, tuple[tuple[str, float, float], ...]]] = {
    unit.words: unit.mistaken for unit in UNITS if unit.mistaken
}
"""Unit in a sentence -> units typed by mistake."""

NO_UNIT: Final = Unit("", "", "1", 1.0)


@lru_cache(1024)  # a window requests the same few keys two thousand times
def unit_of_key(key: str) -> Unit:
    """Return the unit at the end of a key, ``NO_UNIT`` without one."""
    return next((unit for unit in UNITS if key.endswith(unit.ending)), NO_UNIT)


def stem_of(key: str) -> str:
    """Return a key without its unit."""
    return key.removesuffix(unit_of_key(key).ending)
