"""Probes that the evaluation was not written for: U holds, of one reading and of a mean.

``benchmarks/bench_independent_cell.py`` prints the table of 400 sets a row; this is its short form.
"""

from __future__ import annotations

import numpy as np
import pytest

from rigapp_calibration.probes.calibrate import calibrate_probe
from tests.calibration.independent_probe import Nature, Probe, take
from tests.calibration.probe_coverage import PLAIN, ROWS, Row, coverage, readings_of, settings_of


@pytest.mark.sampled(every=5)
@pytest.mark.parametrize("row", ROWS, ids=lambda one: one.name)
def test_positions_lie_within_u_of_the_truth(row: Row) -> None:
    found = coverage(row, 40, 21)
    assert found.pop("refused") == 0.0
    assert min(found.values()) > 0.84, found  # three standard deviations below 95 %


@pytest.mark.long
@pytest.mark.parametrize("row", ROWS, ids=lambda one: one.name)
def test_positions_lie_within_u_in_93_to_99_of_100(row: Row) -> None:
    found = coverage(row, 1000, 22)
    assert found.pop("refused") < 0.005
    assert all(0.93 <= part <= 0.995 for part in found.values()), found


def budget(nature: Nature, readings: float) -> dict[str, float]:
    probe = Probe(nature, np.random.default_rng(3))
    found = calibrate_probe(readings_of(take(probe)), settings_of(nature)).budget
    assert found is not None
    parts = {one.name: one.uncertainty for one in found.contributions}
    return {**parts, "U": found.of_mean(readings).expanded}


def test_a_bend_stays_in_a_mean_and_noise_does_not() -> None:
    many = 1e6
    bent, noisy = Nature(screw=0.05, bend=0.008), Nature(screw=0.05, noise=2.0)
    assert budget(bent, many)["U"] > 0.95 * budget(bent, 1)["U"]
    assert budget(noisy, many)["U"] < 0.4 * budget(noisy, 1)["U"]
    name = "bend of the line, second and third degree"
    assert budget(bent, 1)[name] == pytest.approx(0.3 * 0.008 * 800e-6, rel=0.15)
    assert budget(PLAIN, 1)[name] < 0.2e-6


def test_what_the_micrometer_explains_counts_once() -> None:
    name = "differences between positions beyond those of the micrometer"
    assert budget(Nature(screw=0.5, noise=0.02), 1)[name] == 0.0
