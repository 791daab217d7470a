"""Settings known besides the readings: cell, weights, place, angle reference. SI."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rigapp.texts import say
from rigapp_calibration.load_cell.weights import STANDARD_GRAVITY, Place, WeightSet
from rigapp_calibration.problems import Problem, note, refusal


@dataclass(frozen=True, slots=True)
class CellSettings:
    """Name a load cell: full scale (N), resolution (N), unit of its signal.

    rated_output: signal at full scale by its data sheet, None where it is not stated, with its
    relative tolerance. guarded: a daily check is passed within what is allowed less U (JCGM 106),
    not up to it.
    """

    name: str
    full_scale: float
    resolution: float
    signal_unit: str
    rated_output: float | None = None
    rated_tolerance: float = 0.01
    guarded: bool = True


@dataclass(frozen=True, slots=True)
class Use:
    """What changes between the calibration and a test; each as a half width.

    temperature: difference of the cell's temperature to that of the calibration, K. gain_per_kelvin
    relative; zero_per_kelvin: part of full scale, since the zero was taken last. creep: between
    seconds and minutes under load, part of the load; creep_measured: by this calibration. change:
    of the gain until the next calibration, relative. introduction: of the load by an adapter, in
    the calibration and in use, part of the load. angle: of the pin in use, rad (an eccentric
    encoder). largest: force in use, N, None for full scale. dead_zone: part of full scale that is
    held back of every load, by friction at the hanger. other_adapter: introduces the load in use.
    zeroed: the zero is taken before a test, so that that of the calibration is not used. Not shown
    by readings of the calibration, parts of full scale: cross_terms f1 f2 at full scale, of each
    bridge; nonlinearity, of the characteristic beyond the largest load; loop, the width of the
    hysteresis where no falling loads were read, or too few to show it, or the cycles in use are
    longer.
    """

    temperature: float = 0.0
    gain_per_kelvin: float = 0.0
    zero_per_kelvin: float = 0.0
    creep: float = 0.0
    change: float = 0.0
    creep_measured: bool = False
    introduction: float = 0.0
    angle: float = 0.0
    largest: float | None = None
    dead_zone: float = 0.0
    other_adapter: bool = True
    zeroed: bool = False
    cross_terms: float = 0.0125
    nonlinearity: float = 0.005
    loop: float = 0.005


@dataclass(frozen=True, slots=True)
class LoadCellSettings:
    """All settings of a load-cell calibration; angles in rad.

    angle_stated: an angle reference was taken; else the offset is unknown. gravity_stated: it was
    given as a value, not from latitude and height. gravity_expected: what latitude and height give,
    None when they are unknown.
    """

    cell: CellSettings
    weights: WeightSet
    place: Place
    angle_offset: float = 0.0
    angle_uncertainty: float = 0.0
    angle_stated: bool = True
    gravity_stated: bool = True
    gravity_expected: float | None = None
    use: Use = Use()


OVERLOADING = 1.2
"""Factor of full scale that a cell tolerates: the safe load stated by makers of such cells."""
GRAVITY_FITS = 5e-4
"""Relative tolerance of a stated gravity to that by latitude and height: local anomalies
reach some 1e-4 of it; more means a wrong latitude or height."""


@dataclass(frozen=True, slots=True)
class Plausible:
    """A range with its reason, and the units typed by mistake with their factor to its own."""

    low: float
    high: float
    unit: str
    why: str
    others: tuple[tuple[str, float], ...]

    def objection(self, key: str, value: float) -> str:
        """Return the objection to a value in one sentence; empty without one."""
        if self.low <= value <= self.high:
            return ""
        meant = next(
            (
                say("; did you mean {}? Then write {:.6g}", unit, value * factor)
                for unit, factor in self.others
                if self.low <= value * factor <= self.high
            ),
            "",
        )
        bounds = say("{:g} .. {:g} {}", self.low, self.high, self.unit)
        return say("{} = {:g} is not plausible ({}: {}){}.", key, value, bounds, self.why, meant)


WEIGHT_DENSITY = Plausible(
    1500.0,
    22_700.0,
    "kg/m^3",
    say("steel has 8000, brass 8400, aluminium 2700"),
    (("g/cm^3", 1e3), ("g/m^3", 1e-3)),
)
GRAVITY = Plausible(
    9.76,
    9.84,
    "m/s^2",
    say("what is found on the ground"),
    (
        (say("cm/s^2 (Gal)"), 1e-2),
        ("mm/s^2", 1e-3),
        (say("units of 9.80665 m/s^2"), STANDARD_GRAVITY),
    ),
)
AIR_DENSITY = Plausible(
    0.6,
    1.5,
    "kg/m^3",
    say("1.2 near the sea, 0.7 at 5000 m"),
    (("g/cm^3", 1e3), ("g/m^3", 1e-3)),
)


SIGNAL_UNIT = "mV/V"
"""Unit in which the engine reads a strain-gauge cell: bridge voltage over excitation. A record in
another unit cannot be used by a rig."""
RATED_OUTPUT = Plausible(
    0.05,
    4.5,
    SIGNAL_UNIT,
    say(
        "a full bridge of foil gauges gives its gauge factor, 2, times the strain: 4 at the"
        " 0.2 % that hardened steel bears, about 2 in most cells"
    ),
    (("uV/V", 1e-3), ("V/V", 1e3)),
)
"""Signal at full scale. Lower end: a two-hundredth of it, a step of the resolution, equals the
noise of a good amplifier."""


def impossible(settings: LoadCellSettings) -> Iterator[Problem]:
    """Yield impossible values of cell, weights, air and place: no force can be computed."""
    unit = settings.cell.signal_unit
    if unit != SIGNAL_UNIT:
        yield refusal(
            "signal_unit",
            "signal_unit = {}, but a rig reads its load cell in {}; write signal_unit ="
            " {} and the signals as the amplifier's mV of the bridge per V of"
            " excitation.",
            repr(unit),
            SIGNAL_UNIT,
            repr(SIGNAL_UNIT),
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
    """Yield impossible or contradictory values of weights, air and place."""
    yield from impossible(settings)
    heaviest = heaviest_mass(settings)
    if settings.weights.hanger_mass > heaviest:
        yield refusal(
            "hanger_mass",
            "hanger_mass_kg = {:g} is more than the cell may bear ({:.1f} kg); it is"
            " written in kg, not in g.",
            settings.weights.hanger_mass,
            heaviest,
        )
    yield from _gravity(settings)


def heaviest_mass(settings: LoadCellSettings) -> float:
    """Return the largest mass (kg) that the cell tolerates."""
    return OVERLOADING * settings.cell.full_scale / STANDARD_GRAVITY


def _gravity(settings: LoadCellSettings) -> Iterator[Problem]:
    gravity, expected = settings.place.gravity, settings.gravity_expected
    if GRAVITY.objection("", gravity):
        return
    if expected is not None and abs(gravity / expected - 1.0) > GRAVITY_FITS:
        yield refusal(
            "wrong_gravity",
            "gravity_m_s2 = {:g} does not belong to the latitude and height given,"
            " which mean {:.4f} m/s2; correct one of them.",
            gravity,
            expected,
        )
    elif settings.gravity_stated and expected is None and abs(gravity - STANDARD_GRAVITY) < 5e-6:
        yield note(
            "standard_gravity",
            "gravity_m_s2 = 9.80665 is the standard value, not a local one (up to 0.27"
            " % off); write the local value, or latitude and height.",
        )
