"""The twin's bushings wear as the whole-life model says, and the probes' depth is told apart."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rigapp.config.loading import read_parameters
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import Prediction, as_array
from rigapp.twin.predict import MeasuredRevolution
from rigapp.twin.twin import Twin
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.wear.life import life

PARAMETERS = read_parameters(Path(__file__).parents[2] / "examples" / "parameters.toml")

RUN_OUT = 3e-6


def revolution(number: int, factor: float = 1.0, probe_um: float = -500.0) -> MeasuredRevolution:
    time = np.arange(720) * (2.0 / 720)
    angle = np.pi * time
    motion = inverse_dynamics(PARAMETERS.mechanism, angle, np.pi, 0.0, PARAMETERS.joint.clearance)
    turn = angle - motion.follower_angle
    return MeasuredRevolution(
        number,
        time,
        angle,
        factor * motion.force_crank[0],
        factor * motion.force_crank[1],
        1e-6 * probe_um + RUN_OUT * np.cos(turn),
        RUN_OUT * np.sin(turn),
    )


def values(prediction: Prediction) -> dict[str, float]:
    numbers = as_array(prediction.values, "<f8")
    return dict(zip((c.name for c in prediction_columns()), numbers, strict=True))


@pytest.mark.long
def test_predicted_wear_is_that_of_the_whole_life_model() -> None:
    twin = Twin(PARAMETERS, "continuous")
    last = {}
    for number in [*range(1, 60), *range(60, 600, 10), *range(600, 6001, 60)]:
        last = values(twin.predict(revolution(number)))
    whole = life(PARAMETERS, np.pi, 6000.0, "continuous", 1e-3)
    expected = 1e3 * float(np.interp(6000.0, whole.cycles, whole.max_depth))
    assert last["wear_depth"] == pytest.approx(expected, rel=0.02)
    assert last["driven_wear_depth"] == pytest.approx(expected, rel=0.02)


@pytest.mark.long
def test_larger_measured_forces_wear_the_driven_bushing_only() -> None:
    twin = Twin(PARAMETERS, "continuous")
    for number in range(1, 200):
        last = values(twin.predict(revolution(number, factor=1.5)))
    assert last["driven_wear_depth"] > 1.2 * last["wear_depth"]


def test_resumed_test_catches_up() -> None:
    twin = Twin(PARAMETERS, "continuous", new_position_um=(-500.0, 0.0))
    late = values(twin.predict(revolution(6000, probe_um=-600.0)))
    whole = life(PARAMETERS, np.pi, 6000.0, "continuous", 1e-3)
    expected = 1e3 * float(np.interp(6000.0, whole.cycles, whole.max_depth))
    assert late["wear_depth"] == pytest.approx(expected, rel=0.06)
    # This pin does not indent: by what the approach falls meanwhile the depth is told too large.
    assert late["measured_wear_depth"] == pytest.approx(0.1085, abs=1e-3)
    assert late["measured_wear_depth_uncertainty"] > 3e-3


def test_probes_tell_the_depth_against_the_first_revolutions() -> None:
    twin = Twin(PARAMETERS, "continuous")
    first = [values(twin.predict(revolution(n))) for n in range(1, 10)]
    assert np.isnan(first[0]["measured_wear_depth"])
    assert first[8]["measured_wear_depth"] == pytest.approx(0.0, abs=1e-4)
    later = values(twin.predict(revolution(10, probe_um=-520.0)))
    # This pin does not indent, so what the approach falls by comes on top.
    assert later["measured_wear_depth"] == pytest.approx(0.0255, abs=1e-3)
