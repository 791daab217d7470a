"""The level turned end for end: its own error cancels, a wrong flat is noticed."""

from __future__ import annotations

import math

import pytest

from rigapp_calibration.load_cell.plans import LevelError, reversed_level, single


@pytest.mark.parametrize("true_deg", [-3.0, 0.0, 0.4, 12.0])
@pytest.mark.parametrize("error_deg", [-0.6, 0.0, 0.3])
def test_the_levels_own_error_cancels(true_deg: float, error_deg: float) -> None:
    # A level that is off by e makes the operator stop the crank at -e, turned at +e.
    first, second = (math.radians((true_deg + e) % 360.0) for e in (error_deg, -error_deg))
    found = reversed_level(first, second, math.radians(0.02))
    assert math.degrees(found.angle) == pytest.approx(true_deg, abs=1e-9)
    assert math.degrees(found.level_error or 0.0) == pytest.approx(error_deg, abs=1e-9)
    assert math.degrees(found.uncertainty) == pytest.approx(0.02 / math.sqrt(2.0))
    alone = single(first, math.radians(0.05))
    assert math.degrees(alone.angle) == pytest.approx(true_deg + error_deg, abs=1e-9)


def test_two_readings_of_different_flats_are_refused() -> None:
    with pytest.raises(LevelError, match="same flat"):
        reversed_level(math.radians(1.5), math.radians(-1.5), 1e-4)
