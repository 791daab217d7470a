"""A depth outside of what was predicted early is said in words, one inside is not."""

from __future__ import annotations

import numpy as np
import pytest

from rigapp.report.testreport.identified import ForecastBand, beyond_band
from rigapp_model.identification import Band, Bin

REVOLUTIONS = np.linspace(50.0, 500.0, 60)
MEDIAN = 11.6e-6 * np.sqrt(REVOLUTIONS / 450.0)
EARLY = ForecastBand(50, Band(REVOLUTIONS, MEDIAN, MEDIAN - 1.4e-6, MEDIAN + 1.4e-6))


def bins(depth: float) -> list[Bin]:
    return [
        Bin(400.0, 350.0, 375.0, 400.0, 0.9 * depth, 50, 0.0, 40),
        Bin(500.0, 400.0, 450.0, 500.0, depth, 100, 0.0, 90),
    ]


@pytest.mark.parametrize("depth", [15.1e-6, 9.0e-6])
def test_a_depth_outside_the_band_is_said(depth: float) -> None:
    said = beyond_band(EARLY, bins(depth))
    assert f"{1e6 * depth:.1f} µm are measured at revolution 450" in said
    assert "after revolution 50 11.6 µm were predicted there, 10.2 to 13.0 µm" in said


def test_a_depth_within_the_band_needs_no_word() -> None:
    assert beyond_band(EARLY, bins(12.9e-6)) == ""


def test_what_is_not_computed_that_far_says_nothing() -> None:
    unknown = np.full(60, np.nan)
    band = ForecastBand(50, Band(REVOLUTIONS, unknown, unknown, unknown))
    assert beyond_band(band, bins(15.1e-6)) == ""


def test_revolutions_are_those_of_the_test() -> None:
    assert "at revolution 440; after revolution 40" in beyond_band(EARLY, bins(15.1e-6), 10)
