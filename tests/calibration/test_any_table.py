"""Any table of load-cell readings gives a result or a refusal in a sentence, never an error."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from rigapp_calibration.load_cell.calibrate import calibrate_load_cell
from rigapp_calibration.load_cell.readings import LoadCellReadings
from tests.calibration.simulated_cell import SETTINGS, Cell, take

ENDED_IN_AN_ERROR = (111, 524, 656, 886)
"""Tables that did, beside those of three loads: of cells so quiet that an effect is exactly 0."""


def odd_table(rng: np.random.Generator) -> LoadCellReadings:
    """Return readings of a quiet or noisy cell, whole, with gaps, rising only, or in part twice."""
    cell = Cell(
        noise=rng.choice([0.0, 1e-6, 0.05, 0.7]),
        step=rng.choice([0.0, 0.02, 1.0, 2.0, 5.0]),
        hysteresis=rng.choice([0.0, 1.2]),
        drift=rng.choice([0.0, 1.0]),
    )
    angles, steps = int(rng.choice([2, 3, 4, 6, 8])), int(rng.integers(2, 7))
    whole = take(cell, rng, angles, steps, rng.choice([20.0, 40.0]))
    count = len(whole.step)
    kept = [
        np.arange(count),
        np.flatnonzero(rng.random(count) < rng.choice([0.5, 0.8, 0.95])),
        np.flatnonzero(whole.step <= steps + 1),
        np.flatnonzero(whole.mass > 0.0),
        np.sort(rng.choice(count, count)),
    ][rng.integers(5)]
    series = tuple(whole.series[at] for at in kept)
    taken = Counter[str]()
    step = [taken.update([one]) or taken[one] for one in series]
    return LoadCellReadings(
        series, np.array(step, np.int64), whole.mass[kept], whole.angle[kept], whole.signal[kept]
    )


@pytest.mark.parametrize("number", [*ENDED_IN_AN_ERROR, *range(60)])
def test_any_table_gives_a_result_or_a_refusal(number: int) -> None:
    found = calibrate_load_cell(odd_table(np.random.default_rng(number)), SETTINGS)
    if not any(problem.blocks for problem in found.problems):
        assert found.elements is not None
        assert all(np.isfinite(one.expanded) for one in found.elements)
