"""Virtual calibrations: the stated uncertainty holds the truth in about 95 of 100.

``benchmarks/bench_coverage.py`` prints the table of 1000 calibrations a scenario; this is its short
form, whose bounds are those of a true coverage of 93 to 97 %.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_calibration.load_cell.scatter import SeriesScores
from tests.calibration import virtual_mistakes
from tests.calibration.simulated_cell import SETTINGS, Cell, take
from tests.calibration.virtual_calibrations import SCENARIOS, coverage

COUNT = 50
STATED = ("matrix", "zero", "|F|", "component")


@pytest.fixture(scope="module")
def table() -> list[dict[str, tuple[float, int]]]:
    return [coverage(scenario, COUNT, 40 + place) for place, scenario in enumerate(SCENARIOS)]


@pytest.mark.long
@pytest.mark.parametrize("name", STATED)
def test_truth_is_held_in_93_to_97_of_100(
    table: list[dict[str, tuple[float, int]]], name: str
) -> None:
    parts = np.array([found[name][0] for found in table])
    # The elements of a matrix are not independent: calibrations count, not elements.
    low, high = (
        stats.binom.ppf(q, COUNT * len(table), p) / (COUNT * len(table))
        for q, p in ((0.001, 0.93), (0.999, 0.97))
    )
    assert low <= parts.mean() <= high, dict(zip(SCENARIOS, parts, strict=True))
    assert parts.min() >= stats.binom.ppf(0.001, COUNT, 0.93) / COUNT


def test_nothing_counts_twice() -> None:
    """Of single readings on a display of steps, U is that of their scatter, not 1.4 times it."""
    found = calibrate_load_cell(take(Cell(), np.random.default_rng(8), angles=12), SETTINGS)
    scatter = math.hypot(0.7, 2.0 / math.sqrt(12.0))
    assert found.by_load[0].magnitude.expanded == pytest.approx(1.96 * scatter, rel=0.2)
    names = {one.name for one in found.by_load[-1].across.contributions}
    assert {"angle reference", "fit", "repeatability"} <= names
    assert not any("resolution" in name for name in names)


def test_series_that_agree_exactly_have_a_variance_of_zero_not_a_negative_one() -> None:
    """Four series on a coarse, quiet display may agree in a coefficient to the last bit."""
    one = np.ones((1, 1, 1))
    scores = SeriesScores(
        scores=np.zeros((1, 1, 1)),
        covariance=np.array([[-1e-18]]),  # of a product of matrices, by rounding
        influence=one,
        spread=np.zeros((1, 1)),
        shape=one,
        rest=np.zeros((1, 2)),
        free=1,
    )
    assert scores.variance(np.ones(1)) == (0.0, 1.0)


def test_a_quiet_cell_on_a_coarse_display_is_calibrated() -> None:
    kind = virtual_mistakes.KINDS["4 angles, quiet coarse, drift"]
    readings = virtual_mistakes.take(kind, np.random.default_rng((11, 159))).readings
    found = calibrate_load_cell(readings, virtual_mistakes.SETTINGS)
    assert all(0.0 < one.expanded < 1.0 for one in found.elements)


@pytest.mark.parametrize("steps", [3, 4])
def test_the_loop_is_in_u_with_the_fewest_loads_too(steps: int) -> None:
    """Three loads, which are enough for a calibration, do not show how wide its loop is."""
    rng = np.random.default_rng(5)
    cell = Cell(noise=0.02, step=0.0, hysteresis=1.2)
    found = calibrate_load_cell(take(cell, rng, steps=steps), SETTINGS)
    assert not [one for one in found.problems if one.blocks]
    middle = min(found.by_load, key=lambda one: abs(one.load - 200.0))
    assert middle.magnitude.expanded > 0.5 * 1.2
    rising = np.linalg.inv(cell.sensitivity)
    held = [
        abs(element - true) <= budget.expanded
        for element, true, budget in zip(
            found.fit.matrix.flat, rising.flat, found.elements, strict=True
        )
    ]
    assert all(held)


def test_a_mean_of_fine_readings_has_a_small_uncertainty() -> None:
    cell = Cell(noise=0.02, step=0.0)
    found = calibrate_load_cell(take(cell, np.random.default_rng(8), angles=12), SETTINGS)
    angle = 1.96 * SETTINGS.angle_uncertainty * 400.0
    assert found.by_load[-1].across.expanded == pytest.approx(angle, rel=0.05)
    assert found.by_load[-1].magnitude.expanded < 0.1


def test_the_loop_enters_once_at_half_of_it() -> None:
    rng = np.random.default_rng(9)
    readings = take(Cell(noise=0.0, step=0.0, hysteresis=1.2), rng, angles=12)
    found = calibrate_load_cell(readings, SETTINGS)
    half = next(one for one in found.by_load if one.load == 240.0)
    line = {one.name: one for one in half.magnitude.contributions}
    loop = 1.2 * math.sin(math.pi * 240.0 / 392.0)
    assert 0.45 * loop < line["reversibility and interpolation"].uncertainty < 0.7 * loop
    assert line["repeatability"].uncertainty < 0.02
    assert line["reproducibility between series"].uncertainty < 0.05
