"""The load cell: recovered truth, honest intervals, and a message for each planted mistake."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_calibration.load_cell.readings import LoadCellReadings
from rigapp_calibration.load_cell.settings import LoadCellSettings
from rigapp_calibration.load_cell.weights import Place
from rigapp_calibration.taking.readings import numbered_twice
from tests.calibration.simulated_cell import SETTINGS, Cell, take


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(7)


def codes(readings: LoadCellReadings, settings=SETTINGS, *, blocking: bool = True) -> set[str]:
    found = calibrate_load_cell(readings, settings)
    assert found.accepted == (not any(p.blocks for p in found.problems))
    for problem in found.problems:
        assert problem.sentence.endswith((".", "?", ")")), problem.sentence
        assert "\n" not in problem.sentence
    return {p.code for p in found.problems if p.blocks or not blocking}


def changed(readings: LoadCellReadings, **arrays) -> LoadCellReadings:
    return replace(readings, **arrays)


@pytest.mark.sampled(every=5)
@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("angles", [4, 8, 12])
def test_honest_readings_are_accepted(seed: int, angles: int) -> None:
    cell = Cell(hysteresis=0.8, drift=0.5)
    readings = take(cell, np.random.default_rng(seed), angles=angles)
    found = calibrate_load_cell(readings, SETTINGS)
    assert found.accepted, [p.sentence for p in found.problems]
    assert found.fit is not None
    assert found.fit.matrix == pytest.approx(np.linalg.inv(cell.sensitivity), abs=1.0)


def test_noiseless_cell_is_recovered_exactly(rng: np.random.Generator) -> None:
    cell = Cell(noise=0.0, step=0.0)
    found = calibrate_load_cell(take(cell, rng), SETTINGS)
    assert found.fit is not None
    assert found.fit.matrix == pytest.approx(np.linalg.inv(cell.sensitivity), rel=1e-9)
    assert found.fit.zero == pytest.approx(cell.zero, abs=1e-12)
    assert found.fit.residual_std < 1e-9


def test_common_angle_offset_is_invisible_in_the_residuals(rng: np.random.Generator) -> None:
    straight = calibrate_load_cell(take(Cell(step=0.0), np.random.default_rng(1)), SETTINGS)
    turned_cell = Cell(step=0.0, offset=np.radians(0.2))
    turned = calibrate_load_cell(take(turned_cell, np.random.default_rng(1)), SETTINGS)
    assert straight.fit is not None
    assert turned.fit is not None
    assert turned.fit.residual_std == pytest.approx(straight.fit.residual_std, rel=0.01)
    error = turned.fit.matrix @ turned_cell.sensitivity @ np.array([0.0, 400.0])
    assert abs(error[0]) == pytest.approx(400.0 * np.radians(0.2), abs=0.5)
    told = replace(SETTINGS, angle_offset=np.radians(0.2))
    right = calibrate_load_cell(take(turned_cell, np.random.default_rng(1)), told)
    assert right.fit is not None
    assert np.linalg.inv(turned_cell.sensitivity) == pytest.approx(right.fit.matrix, abs=0.6)


def test_quadratic_cell_gets_quadratic_terms(rng: np.random.Generator) -> None:
    cell = Cell(step=0.0, noise=0.2)
    readings = take(cell, rng, angles=12)
    force = calibrate_load_cell(readings, SETTINGS).applied
    bent = readings.signal + 1e-7 * np.column_stack((force[:, 0] ** 2, force[:, 1] ** 2))
    found = calibrate_load_cell(changed(readings, signal=bent), SETTINGS)
    assert "quadratic" in found.terms
    assert found.fit is not None
    assert found.fit.force(bent) == pytest.approx(force, abs=1.5)


def test_it_says_that_the_cell_cannot_be_classified(rng: np.random.Generator) -> None:
    found = calibrate_load_cell(take(Cell(), rng), SETTINGS)
    assert found.classification.startswith("Not classifiable")
    assert "800 N" in found.classification
    assert "1000 N" in found.classification


Plant = Callable[[LoadCellReadings], LoadCellReadings]


def wrong_weight(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    at, twin = 14, 13
    signal[at] = signal[twin] + 0.375 * (signal[at] - signal[twin])
    return changed(r, signal=signal)


def swapped_steps(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[[13, 14]] = signal[[14, 13]]
    return changed(r, signal=signal)


def skipped_step(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[13:15] = signal[14:16]
    return changed(r, signal=signal)


def swapped_axes(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, signal=r.signal[:, ::-1].copy())


def reversed_axis(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, signal=r.signal * np.array([1.0, -1.0]))


def reversed_both(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, signal=-r.signal)


def swinging(r: LoadCellReadings) -> LoadCellReadings:
    noise = np.random.default_rng(3).normal(0.0, 0.04, r.signal[22:33].shape)
    signal = r.signal.copy()
    signal[22:33] += noise
    return changed(r, signal=signal)


def angle_off(r: LoadCellReadings) -> LoadCellReadings:
    angle = r.angle.copy()
    angle[22:33] += np.radians(1.0)
    return changed(r, angle=angle)


def loose_cable(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[40, 0] += 0.6
    signal[51, 0] -= 0.9
    return changed(r, signal=signal)


def saturated(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, signal=np.clip(r.signal, -1.2, 1.2))


def drift(r: LoadCellReadings) -> LoadCellReadings:
    ramp = np.linspace(0.0, 0.06, len(r))[:, None]
    return changed(r, signal=r.signal + ramp)


def rubs(r: LoadCellReadings) -> LoadCellReadings:
    return take(Cell(hysteresis=8.0), np.random.default_rng(5))


def few_angles(r: LoadCellReadings) -> LoadCellReadings:
    return take(Cell(), np.random.default_rng(5), angles=2)


def not_a_number(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[17, 1] = np.nan
    return changed(r, signal=signal)


def grams(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, mass=1000.0 * r.mass)


def radians(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, angle=np.radians(r.angle))


def dead(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[:, 1] = 0.003
    return changed(r, signal=signal)


def copied(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[55:66] = signal[44:55]
    return changed(r, signal=signal)


def no_zero(r: LoadCellReadings) -> LoadCellReadings:
    keep = r.mass > 0.0
    return LoadCellReadings(
        tuple(s for s, k in zip(r.series, keep, strict=True) if k),
        r.step[keep],
        r.mass[keep],
        r.angle[keep],
        r.signal[keep],
    )


def overload(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, mass=1.5 * r.mass)


def forgotten_hanger(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, mass=np.where(r.mass > 0.0, r.mass - 1.5, 0.0))


def zero_jump(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[len(r) // 2 :] += np.array([0.06, 0.0])
    return changed(r, signal=signal)


def pasted_twice(r: LoadCellReadings) -> LoadCellReadings:
    fine = take(Cell(step=0.0), np.random.default_rng(5))
    keep = [*range(20), 19, *range(20, len(fine))]
    series = tuple(fine.series[i] for i in keep)
    return LoadCellReadings(
        series, fine.step[keep], fine.mass[keep], fine.angle[keep], fine.signal[keep]
    )


def one_angle(r: LoadCellReadings) -> LoadCellReadings:
    angle = r.angle.copy()
    angle[26] += np.radians(5.0)
    return changed(r, angle=angle)


def one_swing(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[26] += np.array([0.07, -0.06])
    return changed(r, signal=signal)


def hardly_connected(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[:, 0] = np.random.default_rng(2).normal(0.0, 1e-5, len(r))
    return changed(r, signal=signal)


def microvolts(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, signal=1000.0 * r.signal)


def tenth_of_a_turn(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, angle=r.angle + np.radians(8.0))


def newtons(r: LoadCellReadings) -> LoadCellReadings:
    return changed(r, mass=9.81 * r.mass)


def plugs_of_one_series(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[77:] = signal[77:, ::-1]
    return changed(r, signal=signal)


def plugs_of_one_of_four(r: LoadCellReadings) -> LoadCellReadings:
    four = take(Cell(), np.random.default_rng(5), angles=4)
    signal = four.signal.copy()
    signal[33:] = signal[33:, ::-1]
    return changed(four, signal=signal)


def sign_of_one_series(r: LoadCellReadings) -> LoadCellReadings:
    signal = r.signal.copy()
    signal[22:33, 0] *= -1.0
    return changed(r, signal=signal)


MISTAKES: list[tuple[str, Plant]] = [
    ("wrong_weight", wrong_weight),
    ("swapped_steps", swapped_steps),
    ("skipped_step", skipped_step),
    ("axes_swapped", swapped_axes),
    ("axis_reversed", reversed_axis),
    ("axes_reversed", reversed_both),
    ("axes_swapped", plugs_of_one_series),
    ("axes_swapped", plugs_of_one_of_four),
    ("axis_reversed", sign_of_one_series),
    ("scatter", swinging),
    ("angle_off", angle_off),
    ("cable_loose", loose_cable),
    ("saturated", saturated),
    ("drift", drift),
    ("hysteresis", rubs),
    ("too_few_angles", few_angles),
    ("not_a_number", not_a_number),
    ("mass_unit", grams),
    ("angle_unit", radians),
    ("bridge_dead", dead),
    ("copied_series", copied),
    ("no_zero", no_zero),
    ("overload", overload),
    ("overload", newtons),
    ("hanger_mass", forgotten_hanger),
    ("zero_jump", zero_jump),
    ("duplicated_rows", pasted_twice),
    ("angle_off", one_angle),
    ("scatter", one_swing),
    ("bridge_dead", hardly_connected),
    ("signal_unit", microvolts),
    ("angle_reference", tenth_of_a_turn),
]


@pytest.mark.parametrize(("code", "plant"), MISTAKES, ids=[plant.__name__ for _, plant in MISTAKES])
def test_planted_mistake_is_named_and_nothing_else(
    code: str, plant: Plant, rng: np.random.Generator
) -> None:
    assert codes(plant(take(Cell(), rng))) == {code}


def random_good(seed: int) -> tuple[LoadCellReadings, LoadCellSettings]:
    """Return what an honest laboratory might take: any plan, cell, noise, display and layout."""
    rng = np.random.default_rng(seed)
    gain = rng.choice([0.001, 0.0025, 0.005])
    truth = gain * (np.eye(2) + rng.normal(0.0, 0.015, (2, 2)))
    cell = Cell(
        sensitivity=truth,
        zero=gain * rng.normal(0.0, 5.0, 2),
        noise=rng.choice([0.05, 0.3, 0.7, 1.0]),
        step=rng.choice([0.0, 2.0]),
        hysteresis=rng.uniform(-0.2, 1.2),
        drift=rng.normal(0.0, 0.5),
    )
    angles, steps = int(rng.choice([4, 5, 8, 12])), int(rng.choice([4, 5, 8, 10]))
    readings = take(cell, rng, angles, steps, float(rng.choice([20.0, 30.0, 40.0])))
    if rng.random() < 0.3:  # one series for all angles
        readings = replace(readings, series=("1",) * len(readings))
    return readings, SETTINGS


@pytest.mark.parametrize(
    ("steps", "found"),
    [
        ((1, 2, 3, 4), None),
        ((1, 2, 3, 4, 1, 2, 3, 4), None),
        ((1, 1, 2, 3), 1),
        ((1, 2, 3, 2, 4), 3),
        ((1, 2, 3, 4, 1), 4),
        ((1, 2, 3, 1, 2, 3, 3), 6),
    ],
)
def test_a_number_that_stands_twice_is_told_from_a_second_run(
    steps: tuple[int, ...], found: int | None
) -> None:
    assert numbered_twice(["a"] * len(steps), steps) == found
    assert numbered_twice(range(len(steps)), steps) is None


@pytest.mark.parametrize("sets", [12, pytest.param(60, marks=pytest.mark.long)])
def test_good_readings_are_never_refused(sets: int) -> None:
    for seed in range(sets):
        found = calibrate_load_cell(*random_good(seed))
        assert found.accepted, (seed, [one.sentence for one in found.problems])


@pytest.mark.parametrize(("gravity", "expected"), [(981.0, None), (9.70, None), (9.7803, 9.8123)])
def test_wrong_gravity_is_named(
    gravity: float, expected: float | None, rng: np.random.Generator
) -> None:
    settings = replace(SETTINGS, place=Place(gravity, 1e-4), gravity_expected=expected)
    assert "wrong_gravity" in codes(take(Cell(), rng), settings)


def test_standard_gravity_is_only_a_hint(rng: np.random.Generator) -> None:
    settings = replace(SETTINGS, place=Place(9.80665, 1e-4))
    assert codes(take(Cell(), rng), settings) == set()
    assert "standard_gravity" in codes(take(Cell(), rng), settings, blocking=False)
