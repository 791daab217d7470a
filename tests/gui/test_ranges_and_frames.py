"""Axis ranges keep still, frames turn the right way."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.viewer.frames import ForceFrame, to_frame
from rigapp.viewer.ranges import SteadyRange, nice_step

REFERENCE = Path(__file__).parent.parent / "data" / "gui_forces_spring.csv"


@given(st.floats(1e-6, 1e9))
def test_steps_are_one_two_or_five(span: float) -> None:
    step = nice_step(span)
    mantissa = step / 10.0 ** np.floor(np.log10(step) + 1e-9)
    assert min(abs(mantissa - wanted) for wanted in (1.0, 2.0, 5.0)) < 1e-6
    assert 5.0 * step >= span * (1.0 - 1e-6)


@given(st.lists(st.tuples(st.floats(-1e4, 1e4), st.floats(0.0, 1e4)), min_size=1, max_size=20))
def test_data_are_never_outside_the_range(spans: list[tuple[float, float]]) -> None:
    steady = SteadyRange(1.0)
    for low, span in spans:
        steady.update(low, low + span)
        assert steady.range is not None
        assert steady.range[0] <= low + 1e-6
        assert steady.range[1] >= low + span - 1e-6


def test_a_range_keeps_still_while_the_data_fill_half_of_it() -> None:
    steady = SteadyRange(1.0)
    assert steady.update(0.0, 95.0)
    assert not steady.update(2.0, 93.0)
    assert not steady.update(0.0, 60.0)
    assert steady.update(0.0, 20.0)
    assert not steady.update(float("nan"), 3.0)


def test_a_symmetric_range_has_zero_in_its_middle() -> None:
    steady = SteadyRange(4.0, symmetric=True)
    steady.update(-1.0, 7.3)
    assert steady.range is not None
    assert steady.range[0] == -steady.range[1]
    assert steady.range[1] >= 7.3


def test_frames_agree_with_the_closed_form() -> None:
    with REFERENCE.open(encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    angle, e1, n1, x, y, e2, n2 = (
        np.array([row[key] for row in rows])
        for key in ("crank_angle_deg", "F_e1", "F_n1", "Fx", "Fy", "F_e2", "F_n2")
    )
    ratio = 76.2 / 203.2
    for frame, wanted in (
        (ForceFrame.CRANK, (e1, n1)),
        (ForceFrame.GLOBAL, (x, y)),
        (ForceFrame.FOLLOWER, (e2, n2)),
    ):
        found = to_frame(e1, n1, angle, frame, ratio)
        np.testing.assert_allclose(found, wanted, atol=1e-9)


def test_the_follower_frame_needs_the_mechanism() -> None:
    with pytest.raises(ValueError, match="mechanism"):
        to_frame([1.0], [0.0], [10.0], ForceFrame.FOLLOWER)
