"""The budget by GTC against a Monte Carlo after JCGM 101."""

from __future__ import annotations

import numpy as np
import pytest

from rigapp_calibration.load_cell.budget import expanded_line
from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_calibration.taking.uncertainty import Contribution, combine
from tests.calibration.simulated_cell import SETTINGS, Cell, take

TRIALS = 1_000_000


def drawn(line: Contribution, rng: np.random.Generator) -> np.ndarray:
    """Draw what a contribution stands for: with few degrees of freedom a scaled t (JCGM 101)."""
    if line.distribution == "two-point":
        return rng.choice(line.points or [line.uncertainty], TRIALS) * rng.choice(
            [-1.0, 1.0], TRIALS
        )
    if line.distribution == "rectangular":
        return line.uncertainty * rng.uniform(-np.sqrt(3.0), np.sqrt(3.0), TRIALS)
    if np.isinf(line.degrees):
        return line.uncertainty * rng.standard_normal(TRIALS)
    shrink = np.sqrt((line.degrees - 2.0) / line.degrees)
    return line.uncertainty * shrink * rng.standard_t(line.degrees, TRIALS)


def test_expanded_uncertainty_agrees_with_monte_carlo() -> None:
    rng = np.random.default_rng(5)
    found = calibrate_load_cell(take(Cell(hysteresis=1.0), rng), SETTINGS)
    assert found.budget is not None
    total = sum(drawn(line, rng) for line in found.budget.contributions)
    assert found.budget.expanded == pytest.approx(np.percentile(np.abs(total), 95.0), rel=0.02)


@pytest.mark.parametrize(
    "lines",
    [
        [Contribution("branch", 1.0, distribution="two-point")],
        [Contribution("half width", 1.0, distribution="rectangular")],
        [Contribution("noise", 1.0), Contribution("branch", 1.0, distribution="two-point")],
        [
            Contribution("noise", 0.3, 20.0, "A"),
            Contribution("branch", 1.0, distribution="two-point"),
            Contribution("half width", 1.0, distribution="rectangular"),
        ],
    ],
)
def test_bounded_parts_get_the_factor_of_their_distribution(lines: list[Contribution]) -> None:
    rng = np.random.default_rng(6)
    drawn_sums = np.abs(sum(drawn(line, rng) for line in lines))
    assert combine(0.0, tuple(lines)).expanded == pytest.approx(
        np.percentile(drawn_sums, 95.0), rel=0.01
    )


def test_a_mean_has_less_of_what_scatters_and_all_of_the_rest() -> None:
    one = combine(
        100.0, (Contribution("scale", 0.3), Contribution("noise", 2.0, 30.0, "A", averages=True))
    )
    assert one.of_mean(25).combined == pytest.approx(np.hypot(0.3, 0.4))
    assert one.of_mean(np.inf).expanded == pytest.approx(0.3 * 1.96, rel=1e-3)


def test_few_degrees_of_freedom_widen_the_interval() -> None:
    wide = combine(100.0, (Contribution("repeatability", 1.0, 5.0),))
    assert wide.coverage_factor == pytest.approx(2.5706, abs=1e-3)
    narrow = combine(100.0, (Contribution("mass", 1.0, np.inf),))
    assert narrow.coverage_factor == pytest.approx(1.96, abs=1e-3)
    both = combine(100.0, (Contribution("a", 3.0, np.inf), Contribution("b", 4.0, np.inf)))
    assert both.combined == pytest.approx(5.0)


@pytest.mark.parametrize("curvature", [1e-5, -1e-4], ids=["rising", "falling"])
def test_line_bounds_the_uncertainty_from_above(curvature: float) -> None:
    budgets = tuple(
        combine(f, (Contribution("a", 20.0 + 0.01 * f + curvature * f * f, np.inf),))
        for f in (40.0, 160.0, 280.0, 400.0)
    )
    constant, slope = expanded_line(budgets)
    assert constant >= 0.0
    assert slope >= 0.0
    for one in budgets:
        assert constant + slope * one.value >= one.expanded - 1e-9
