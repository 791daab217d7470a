"""Specimens of one pairing: their scatter, and what is to be expected of the next one."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from virtual_tests import ERRORS, NOMINAL, PRIOR, a_life, gathered, readings

from rigapp_model.identification import NotIdentifiable, Prior, identify
from rigapp_model.identification.forecast import Estimate, estimate_of, pairing_of


def campaign(random: np.random.Generator, count: int, tau: float, doubt: float) -> list[Estimate]:
    """Draw specimens about ln K = -28, measured with an own doubt and a common one of 1 %."""
    e = random.normal()
    specimens = -28.0 + random.normal(0.0, tau, count)
    y = specimens + 0.01 * e + random.normal(0.0, doubt, count)
    return [Estimate(float(one), float(np.hypot(doubt, 0.01)), 0.01, "probes") for one in y]


def test_the_next_specimen_lies_within_its_limits_as_often_as_they_say() -> None:
    random = np.random.default_rng(5)
    inside, inside_median, drawn = 0, 0, 250
    for _ in range(drawn):
        tau = abs(random.normal(0.0, 0.5))
        found = pairing_of(campaign(random, 5, tau, 0.05), "five tests")
        coming = float(np.exp(-28.0 + random.normal(0.0, tau)))
        inside += found.next.low < coming < found.next.high
        inside_median += found.coefficient.low < float(np.exp(-28.0)) < found.coefficient.high
    assert 0.92 < inside / drawn < 0.98
    assert 0.92 < inside_median / drawn < 0.98


def test_the_probes_sensitivity_does_not_average_out() -> None:
    alike = [Estimate(-28.0, 0.05, 0.049, "probes") for _ in range(20)]
    other = [dataclasses.replace(one, record=f"record {n}") for n, one in enumerate(alike)]
    same, different = (pairing_of(one, "x").coefficient for one in (alike, other))
    assert np.log(same.high / same.low) > 3.5 * 0.049
    assert np.log(different.high / different.low) < 1.2 * 0.049


def test_one_specimen_scatters_as_usual_and_many_alike_hardly() -> None:
    one = pairing_of([Estimate(-28.0, 0.03, 0.01, "a")], "one test")
    many = pairing_of([Estimate(-28.0, 0.03, 0.01, "a")] * 10, "ten tests")
    assert one.scatter.median == pytest.approx(np.exp(0.5 * 0.674), rel=0.02)
    assert many.scatter.high < 1.05 < one.prior.spread + 1.0
    assert one.each[0].median == pytest.approx(np.exp(-28.0), rel=0.01)
    with pytest.raises(NotIdentifiable, match="no test"):
        pairing_of([], "nothing")


def test_what_was_known_before_the_test_is_not_counted_as_its_result() -> None:
    life = a_life()
    bins = gathered(readings(life, 3, 20000))
    wide = estimate_of(identify(bins, life, ERRORS, PRIOR), "probes")
    prior = Prior(1.3 * NOMINAL, 0.08, "another test")
    told = estimate_of(identify(bins, life, ERRORS, prior), "probes")
    assert told.log_coefficient == pytest.approx(wide.log_coefficient, abs=0.3 * wide.spread)
    assert told.spread == pytest.approx(wide.spread, rel=0.1)
    assert 0.0 < abs(wide.common) < wide.spread
    sure = Prior(1.1 * NOMINAL, 1e-4, "one who knows")
    with pytest.raises(NotIdentifiable, match="add little"):
        estimate_of(identify(bins, life, ERRORS, sure), "probes")
