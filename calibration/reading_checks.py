"""Checks of dead-weight readings and settings alone, before any fit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from calibration.characteristics import angle_groups
from calibration.problems import Problem
from calibration.readings import LoadCellReadings
from calibration.settings import LoadCellSettings
from calibration.weights import STANDARD_GRAVITY

FEWEST_LOADED = 12
FEWEST_ANGLES = 4
WIDEST_GAP = np.radians(130.0)


def check_readings(readings: LoadCellReadings, settings: LoadCellSettings) -> Iterator[Problem]:
    """Yield what makes readings or settings unusable whatever the fit says."""
    yield from _not_numbers(readings)
    yield from _impossible_masses(readings, settings)
    yield from _angles(readings)
    yield from _gravity(settings)
    yield from _dead_or_stuck(readings)
    loaded = int(np.count_nonzero(readings.mass > 0.0))
    if loaded < FEWEST_LOADED:
        yield Problem(
            "too_few_readings",
            f"Only {loaded} readings with weights; take at least {FEWEST_LOADED}, better 40"
            " (4 pin angles, 5 loads up and down).",
        )
    if not np.any(readings.mass == 0.0):
        yield Problem("no_zero", "There is no reading without weights; take a zero in each series.")


def place_of(readings: LoadCellReadings, index: int) -> str:
    """Return where a reading stands, in words."""
    return f"series {readings.series[index]}, step {readings.step[index]}"


def _not_numbers(readings: LoadCellReadings) -> Iterator[Problem]:
    columns = np.column_stack((readings.mass, readings.angle, readings.signal))
    bad = np.flatnonzero(~np.isfinite(columns).all(axis=1))
    if len(bad):
        yield Problem(
            "not_a_number",
            f"The reading at {place_of(readings, int(bad[0]))} is not a number"
            + (f" (and {len(bad) - 1} more)" if len(bad) > 1 else "")
            + "; take it again.",
        )


def _impossible_masses(readings: LoadCellReadings, settings: LoadCellSettings) -> Iterator[Problem]:
    heaviest = float(np.nanmax(readings.mass, initial=0.0))
    if np.nanmin(readings.mass, initial=0.0) < 0.0:
        yield Problem("negative_mass", "A mass is negative; masses are written in kg, from 0 up.")
    limit = 1.2 * settings.cell.full_scale / settings.place.gravity
    if heaviest > 50.0 * limit:
        yield Problem(
            "mass_unit",
            f"A mass of {heaviest:g} kg is written; was it meant in grams? Write kilograms.",
        )
    elif heaviest > limit:
        yield Problem(
            "overload",
            f"{heaviest:g} kg is more than the cell may bear ({limit:.1f} kg); check the mass.",
        )


def _angles(readings: LoadCellReadings) -> Iterator[Problem]:
    loaded = readings.mass > 0.0
    angle = readings.angle[loaded & np.isfinite(readings.angle)]
    if not len(angle):
        return
    degrees = np.degrees(angle)
    if np.ptp(degrees) > 0.5 and np.abs(degrees).max() < 6.3 and len(np.unique(degrees)) >= 4:
        yield Problem(
            "angle_unit",
            "All pin angles lie between 0 and 6.3; they look like radians, write degrees.",
        )
        return
    groups = angle_groups(angle)
    count = len(np.unique(groups))
    if count < FEWEST_ANGLES:
        yield Problem(
            "too_few_angles",
            f"Only {count} pin angle{'s' if count > 1 else ''}: the two axes cannot be told apart;"
            f" take at least {FEWEST_ANGLES}, evenly round the turn.",
        )
        return
    turned = np.sort(np.mod([angle[groups == g].mean() for g in np.unique(groups)], 2 * np.pi))
    gap = float(np.max(np.diff(np.append(turned, turned[0] + 2.0 * np.pi))))
    if gap > WIDEST_GAP:
        yield Problem(
            "angles_uneven",
            f"No pin angle within {np.degrees(gap):.0f} degrees of the turn; spread the angles"
            " evenly.",
        )


def _gravity(settings: LoadCellSettings) -> Iterator[Problem]:
    gravity, expected = settings.place.gravity, settings.gravity_expected
    if not 9.76 <= gravity <= 9.84:
        yield Problem(
            "wrong_gravity",
            f"gravity_m_s2 = {gravity:g} is found nowhere on the ground (9.76 .. 9.84 m/s2);"
            " write the local value, or latitude and height.",
        )
    elif expected is not None and abs(gravity / expected - 1.0) > 5e-4:
        yield Problem(
            "wrong_gravity",
            f"gravity_m_s2 = {gravity:g} does not belong to the latitude and height given, which"
            f" mean {expected:.4f} m/s2; correct one of them.",
        )
    elif settings.gravity_stated and expected is None and abs(gravity - STANDARD_GRAVITY) < 5e-6:
        yield Problem(
            "standard_gravity",
            "gravity_m_s2 = 9.80665 is the standard value, not a local one (up to 0.27 % off);"
            " write the local value, or latitude and height.",
            blocks=False,
        )


def _dead_or_stuck(readings: LoadCellReadings) -> Iterator[Problem]:
    signal = readings.signal
    if len(signal) < 4 or not np.isfinite(signal).all():
        return
    for axis in range(2):
        if np.ptp(signal[:, axis]) == 0.0:
            yield Problem(
                "bridge_dead",
                f"signal_{axis + 1} never changes ({signal[0, axis]:g}); is the bridge connected"
                " and switched on?",
            )
    names = list(dict.fromkeys(readings.series))
    tables = {n: signal[[one == n for one in readings.series]] for n in names}
    for place, name in enumerate(names):
        for other in names[:place]:
            if len(tables[name]) > 4 and np.array_equal(tables[name], tables[other]):
                yield Problem(
                    "copied_series",
                    f"Series {name} repeats series {other} digit for digit; was it copied instead"
                    " of taken?",
                )
