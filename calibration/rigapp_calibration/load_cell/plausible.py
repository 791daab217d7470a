"""What weights, gravity and air can be on this planet, and the unit that a stray number has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.weights import STANDARD_GRAVITY
from rigapp_calibration.problems import Problem, note

OVERLOADING = 1.2
"""A cell bears so many times its full scale: the safe load that makers of such cells state."""
GRAVITY_FITS = 5e-4
"""Relative: a stated gravity may differ by so much from what latitude and height give, since local
anomalies reach some 1e-4 of it and a wrong latitude or height means more."""


@dataclass(frozen=True, slots=True)
class Plausible:
    """A range, why it ends there, and the units typed by mistake with their factor to its own."""

    low: float
    high: float
    unit: str
    why: str
    others: tuple[tuple[str, float], ...]

    def objection(self, key: str, value: float) -> str:
        """Return what is wrong with a value in one sentence; empty when nothing is."""
        if self.low <= value <= self.high:
            return ""
        meant = next(
            (
                f"; did you mean {unit}? Then write {value * factor:.6g}"
                for unit, factor in self.others
                if self.low <= value * factor <= self.high
            ),
            "",
        )
        bounds = f"{self.low:g} .. {self.high:g} {self.unit}"
        return f"{key} = {value:g} is not plausible ({bounds}: {self.why}){meant}."


WEIGHT_DENSITY = Plausible(
    1500.0,
    22_700.0,
    "kg/m^3",
    "steel has 8000, brass 8400, aluminium 2700",
    (("g/cm^3", 1e3), ("g/m^3", 1e-3)),
)
GRAVITY = Plausible(
    9.76,
    9.84,
    "m/s^2",
    "what is found on the ground",
    (("cm/s^2 (Gal)", 1e-2), ("mm/s^2", 1e-3), ("units of 9.80665 m/s^2", STANDARD_GRAVITY)),
)
AIR_DENSITY = Plausible(
    0.6,
    1.5,
    "kg/m^3",
    "1.2 near the sea, 0.7 at 5000 m",
    (("g/cm^3", 1e3), ("g/m^3", 1e-3)),
)


SIGNAL_UNIT = "mV/V"
"""What the engine reads a strain-gauge cell in: bridge voltage over excitation. A record in another
unit serves no rig."""
RATED_OUTPUT = Plausible(
    0.05,
    4.5,
    SIGNAL_UNIT,
    "a full bridge of foil gauges gives its gauge factor, 2, times the strain: 4 at the 0.2 % that"
    " hardened steel bears, about 2 in most cells",
    (("uV/V", 1e-3), ("V/V", 1e3)),
)
"""Signal at full scale. Its low end: a two-hundredth of that, a step of the resolution, is what a
good amplifier's noise is."""


def impossible(settings: LoadCellSettings) -> Iterator[Problem]:
    """Yield what cannot be true of cell, weights, air and place: no force is told by it."""
    unit = settings.cell.signal_unit
    if unit != SIGNAL_UNIT:
        yield Problem(
            "signal_unit",
            f"signal_unit = {unit!r}, but a rig reads its load cell in {SIGNAL_UNIT}; write"
            f" signal_unit = {SIGNAL_UNIT!r} and the signals as the amplifier's mV of the bridge"
            " per V of excitation.",
        )
    for code, key, plausible, value in (
        ("weight_density", "density_kg_per_m3", WEIGHT_DENSITY, settings.weights.density),
        ("air_density", "air_density_kg_per_m3", AIR_DENSITY, settings.place.air_density),
        ("wrong_gravity", "gravity_m_s2", GRAVITY, settings.place.gravity),
    ):
        words = plausible.objection(key, value)
        if words:
            yield Problem(code, words)


def check_settings(settings: LoadCellSettings) -> Iterator[Problem]:
    """Yield what cannot be true of weights, air and place, and what does not fit together."""
    yield from impossible(settings)
    heaviest = heaviest_mass(settings)
    if settings.weights.hanger_mass > heaviest:
        yield Problem(
            "hanger_mass",
            f"hanger_mass_kg = {settings.weights.hanger_mass:g} is more than the cell may bear"
            f" ({heaviest:.1f} kg); it is written in kg, not in g.",
        )
    yield from _gravity(settings)


def heaviest_mass(settings: LoadCellSettings) -> float:
    """Return the mass (kg) that the cell may bear at most."""
    return OVERLOADING * settings.cell.full_scale / STANDARD_GRAVITY


def _gravity(settings: LoadCellSettings) -> Iterator[Problem]:
    gravity, expected = settings.place.gravity, settings.gravity_expected
    if GRAVITY.objection("", gravity):
        return
    if expected is not None and abs(gravity / expected - 1.0) > GRAVITY_FITS:
        yield Problem(
            "wrong_gravity",
            f"gravity_m_s2 = {gravity:g} does not belong to the latitude and height given, which"
            f" mean {expected:.4f} m/s2; correct one of them.",
        )
    elif settings.gravity_stated and expected is None and abs(gravity - STANDARD_GRAVITY) < 5e-6:
        yield note(
            "standard_gravity",
            "gravity_m_s2 = 9.80665 is the standard value, not a local one (up to 0.27 % off);"
            " write the local value, or latitude and height.",
        )
