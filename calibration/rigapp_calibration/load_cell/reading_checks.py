"""Checks of dead-weight readings and settings alone, before any fit."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from itertools import combinations

import numpy as np

from rigapp.texts import joined, say
from rigapp_calibration.arrays import Whole
from rigapp_calibration.load_cell.characteristics import angle_groups
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import (
    RATED_OUTPUT,
    LoadCellSettings,
    check_settings,
    heaviest_mass,
)
from rigapp_calibration.load_cell.weights import FEWEST_LOADS, weight_force
from rigapp_calibration.problems import Problem, blocked, refusal
from rigapp_calibration.taking.readings import (
    check_columns,
    check_steps,
    each_series,
    not_numbers,
    place_of,
)

FEWEST_LOADED = 12
"""Twice the coefficients of the linear model: with fewer, mistakes cannot be detected."""
FEWEST_ANGLES = 4
"""Each axis in both directions; three angles determine A, but reveal no wrong angle."""
FEWEST_COPIED = 4
"""A shorter series may repeat another one by chance."""
BY_CHANCE = 1e-3
"""A series that repeats another one by chance less often was copied: one good calibration in a
thousand that takes an angle twice would be refused."""
LIGHTEST_SHARE = 2e-3
"""Part of the cell's limit: lighter weights are lost in its noise."""
WIDEST_GAP = np.radians(130.0)
"""Four even angles leave gaps of 90 degrees; wider ones leave a direction without any load."""


def check_readings(readings: LoadCellReadings, settings: LoadCellSettings) -> Iterator[Problem]:
    """Yield problems that make readings or settings unusable for any fit."""
    columns = np.column_stack((readings.mass, readings.angle, readings.signal))
    yield from check_columns(readings.unused)
    yield from not_numbers(readings, columns)
    yield from _angles(readings)
    scale = [
        *_impossible_masses(readings, settings),
        *check_settings(settings),
        *_dead_or_stuck(readings),
    ]
    yield from scale
    if not blocked(scale):
        yield from _rated_output(readings, settings)
    loaded = int(np.count_nonzero(readings.mass > 0.0))
    if loaded < FEWEST_LOADED:
        yield refusal(
            "too_few_readings",
            "Only {} readings with weights; take at least {}, better 40 (4 pin angles,"
            " 5 loads up and down).",
            loaded,
            FEWEST_LOADED,
        )
    yield from _few_loads(readings)
    if not np.any(readings.mass == 0.0):
        yield refusal("no_zero", "There is no reading without weights; take a zero in each series.")


def _few_loads(readings: LoadCellReadings) -> Iterator[Problem]:
    loads = np.unique(np.round(readings.mass[readings.mass > 0.0], 3))
    if 0 < len(loads) < FEWEST_LOADS:
        heaviest = float(loads[-1])
        missing = [
            share
            for share in np.arange(1, FEWEST_LOADS + 1) * heaviest / FEWEST_LOADS
            if np.abs(loads - share).min() > 0.2 * heaviest
        ]
        missing = missing or [0.5 * (float(loads[0]) + heaviest)]
        yield refusal(
            "too_few_loads",
            "Only {} different loads hung ({} kg): at least {} are needed above zero. Take"
            " others as well, for example {} kg.",
            len(loads),
            joined(" and ", (f"{one:g}" for one in loads)),
            FEWEST_LOADS,
            joined(" and ", (f"{one:.3g}" for one in missing)),
        )


def _impossible_masses(readings: LoadCellReadings, settings: LoadCellSettings) -> Iterator[Problem]:
    heaviest = float(np.nanmax(readings.mass, initial=0.0))
    if np.nanmin(readings.mass, initial=0.0) < 0.0:
        yield refusal("negative_mass", "A mass is negative; masses are written in kg, from 0 up.")
    limit = heaviest_mass(settings)
    if heaviest > 50.0 * limit:
        yield refusal(
            "mass_unit",
            "A mass of {:g} kg is written; was it meant in grams? Write kilograms.",
            heaviest,
        )
    elif 0.0 < heaviest < LIGHTEST_SHARE * limit:
        yield refusal(
            "mass_unit",
            (
                "The heaviest mass is {:g} kg, the cell may bear {:.1f} kg: the masses are too"
                " small for a calibration; write kilograms, not tonnes."
            ),
            heaviest,
            limit,
        )
    elif heaviest > limit:
        yield refusal(
            "overload",
            "{:g} kg is more than the cell may bear ({:.1f} kg); check the mass, which"
            " is written in kilograms, not in grams, newtons or pounds.",
            heaviest,
            limit,
        )


def _angles(readings: LoadCellReadings) -> Iterator[Problem]:
    loaded = readings.mass > 0.0
    angle = readings.angle[loaded & np.isfinite(readings.angle)]
    if not len(angle):
        return
    degrees = np.degrees(angle)
    if np.ptp(degrees) > 0.5 and np.abs(degrees).max() < 6.3 and len(np.unique(degrees)) >= 4:
        yield refusal(
            "angle_unit",
            "All pin angles lie between 0 and 6.3; they look like radians, write degrees.",
        )
        return
    groups = angle_groups(angle)
    count = len(np.unique(groups))
    if count < FEWEST_ANGLES:
        yield refusal(
            "too_few_angles",
            (
                "Only {} pin angle{}: the two axes cannot be separated; take at least {}, evenly"
                " round the turn."
            ),
            count,
            "s" if count > 1 else "",
            FEWEST_ANGLES,
        )
        return
    turned = np.sort(np.mod([angle[groups == g].mean() for g in np.unique(groups)], 2 * np.pi))
    gap = float(np.max(np.diff(np.append(turned, turned[0] + 2.0 * np.pi))))
    if gap > WIDEST_GAP:
        yield refusal(
            "angles_uneven",
            "No pin angle within {:.0f} degrees of the turn; spread the angles evenly.",
            np.degrees(gap),
        )


def _dead_or_stuck(readings: LoadCellReadings) -> Iterator[Problem]:
    signal = readings.signal
    if len(signal) < 4 or not np.isfinite(signal).all():
        return
    still = np.ptp(signal, axis=0) == 0.0
    for axis in range(2):
        if still[axis]:
            yield refusal(
                "bridge_dead",
                "signal_{} never changes ({:g}); is the bridge connected and switched on?",
                axis + 1,
                signal[0, axis],
            )
    if not still.any():  # a constant signal repeats a series by chance
        yield from _copied(readings)
    yield from _duplicated(readings)


def _rated_output(readings: LoadCellReadings, settings: LoadCellSettings) -> Iterator[Problem]:
    """Check the unit of the signal by its size at full scale, with mass and force as stated."""
    loaded = readings.mass > 0.0
    rows = loaded & np.isfinite(readings.signal).all(axis=1)
    if not rows.any() or loaded.all():
        return
    at_rest = np.nanmedian(readings.signal[~loaded], axis=0)
    change = np.hypot(*(readings.signal[rows] - at_rest).T)
    force = weight_force(readings.mass[rows], settings.weights, settings.place)
    # With one dead bridge half of the readings are usable: the upper quartile is one of them.
    rated = float(np.percentile(change / force, 75.0)) * settings.cell.full_scale
    words = RATED_OUTPUT.objection(say("The signal at full scale"), rated)
    if words:
        yield refusal(
            "signal_unit", "{} Are the signals volts of an amplifier, counts, or N?", words
        )


def _duplicated(readings: LoadCellReadings) -> Iterator[Problem]:
    """Yield rows that occur twice with equal digits, and repeated step numbers.

    A coarse display repeats single readings of a second run with the same numbers; if all
    repeat, it is not a second run.
    """
    steps = list(zip(_runs_of(readings), readings.step.tolist(), strict=True))
    values = np.column_stack((readings.mass, readings.angle, readings.signal)).tolist()
    rows = [(*one, *two) for one, two in zip(steps, values, strict=True)]
    again, same = _seen_before(steps), _seen_before(rows)
    if same and (again == same or not coarse(readings)):
        more = say(" ({} more like it)", len(same) - 1) if len(same) > 1 else ""
        yield refusal(
            "duplicated_rows",
            (
                "The reading at {} occurs twice in the table{}; remove the copy. A second run"
                " needs its own series."
            ),
            place_of(readings, same[0]),
            more,
        )
    else:
        yield from check_steps(readings, _runs_of(readings))


def _seen_before(rows: Sequence[Hashable]) -> list[int]:
    first = {row: index for index, row in reversed(list(enumerate(rows)))}
    return [index for index, row in enumerate(rows) if first[row] < index]


def _runs_of(readings: LoadCellReadings) -> list[tuple[str, int]]:
    return list(zip(readings.series, angle_groups(readings.angle).tolist(), strict=True))


def coarse(readings: LoadCellReadings) -> bool:
    """Return whether the signals come in steps of more than a few hundredths of a newton."""
    per_newton = np.ptp(readings.signal, axis=0) / (20.0 * max(readings.mass.max(), 1e-9))
    steps = [np.diff(np.unique(column)) for column in readings.signal.T]
    return any(len(d) == 0 or d.min() > 0.05 * g for d, g in zip(steps, per_newton, strict=True))


def _copied(readings: LoadCellReadings) -> Iterator[Problem]:
    """Yield two series with the same digits, though noise would have changed some."""
    group = angle_groups(readings.angle)
    members = {name: np.flatnonzero(marks) for name, marks in each_series(readings.series)}
    alike = [
        (name, other)
        for other, name in combinations(members, 2)
        if len(members[name]) > FEWEST_COPIED
        and np.array_equal(readings.signal[members[name]], readings.signal[members[other]])
    ]
    repeating = _repeating(readings, group, set(alike)) if alike else 0.0
    copies = [
        (name, other)
        for name, other in alike
        if not np.array_equal(group[members[name]], group[members[other]])
        or repeating ** len(members[name]) < BY_CHANCE
    ]
    if copies:
        name, other = copies[0]
        more = say(" (and {} more)", len(copies) - 1) if len(copies) > 1 else ""
        yield refusal(
            "copied_series",
            "Series {} repeats series {} digit for digit{}; was it copied instead of taken?",
            name,
            other,
            more,
        )


def _repeating(readings: LoadCellReadings, group: Whole, alike: set[tuple[str, str]]) -> float:
    """Return how often two readings of one load and angle have the same digits.

    A quiet cell with a coarse display repeats itself. Pairs of series that are ``alike`` are left
    out; 0 where nothing was taken twice.
    """
    same = pairs = 0
    where: dict[tuple[int, float], list[int]] = {}
    for index, key in enumerate(zip(group.tolist(), readings.mass.tolist(), strict=True)):
        where.setdefault(key, []).append(index)
    for members in where.values():
        for first, second in combinations(members, 2):
            if (readings.series[second], readings.series[first]) not in alike:
                pairs += 1
                same += np.array_equal(readings.signal[first], readings.signal[second])
    return same / pairs if pairs else 0.0
