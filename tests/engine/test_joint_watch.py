"""The pairing's range: a warning when a test leaves it, its end when it comes back."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from rigapp.config.parameters import PairingSection
from rigapp.engine.judging.jointwatch import STAYS, JointWatch
from rigapp.schema.alarms import Cause
from rigapp.schema.columns import prediction_columns

NOTHING = dict.fromkeys((one.name for one in prediction_columns()), np.nan)


def told(watch: JointWatch, value: float, times: int) -> Iterator[Cause | str]:
    for _ in range(times):
        yield from watch.look({**NOTHING, "pressure_velocity_max": value})


@pytest.mark.parametrize("value", [0.021, 0.001])
def test_a_pairing_beyond_its_range_is_told_once_and_ends_when_it_is_back(value: float) -> None:
    watch = JointWatch(
        PairingSection(
            pressure_velocity_low_MPa_m_per_s=0.002, pressure_velocity_high_MPa_m_per_s=0.02
        )
    )
    assert not list(told(watch, 0.01, 100))
    assert not list(told(watch, value, STAYS - 1))
    (cause,) = told(watch, value, 100)
    assert isinstance(cause, Cause)
    assert cause.key == "pairing_left"
    assert f"{value:g} MPa m/s; model.pairing.pressure_velocity_" in cause.sentence
    assert list(told(watch, 0.01, 100)) == ["pairing_left"]


def test_a_joint_that_wears_otherwise_is_told_once_for_each_departure() -> None:
    watch, values = JointWatch(), {**NOTHING, "wear_consistency": 7.1}
    assert not list(watch.look(values))
    values["wear_departure_revolution"] = 4210.0
    (cause,) = watch.look(values)
    assert isinstance(cause, Cause)
    assert cause.key == "wears_otherwise"
    assert "Since about revolution 4210 the joint wears faster" in cause.sentence
    assert "Of 100 tests of 21,377 revolutions without a change fewer than 1" in cause.sentence
    assert not list(watch.look(values))


def test_what_is_not_known_leaves_no_range() -> None:
    assert not list(told(JointWatch(PairingSection(sliding_speed_high_m_per_s=0.1)), np.nan, 100))
    assert not list(told(JointWatch(), 1e9, 100))
