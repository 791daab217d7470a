"""The twin predicts a revolution from its angle history, and measures its distance from it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp.config.loading import read_parameter_file
from rigapp.config.parameters import to_parameters
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import RevolutionMeasured, as_array
from rigapp.twin.predict import (
    GRID,
    PredictionError,
    Wear,
    compare,
    phase_shift,
    predict_force,
    unpack,
)
from rigapp.twin.twin import Twin
from rigapp.twin.worker import serve
from rigapp_model.dynamics import inverse_dynamics

PARAMETERS = to_parameters(
    read_parameter_file(Path(__file__).parents[2] / "examples" / "parameters.toml").record
)
CLEARANCE = PARAMETERS.joint.bushing_radius - PARAMETERS.joint.pin_radius


def revolution(ripple: float, clearance: float, samples: int = 1920) -> RevolutionMeasured:
    """Make a revolution at 30 rpm whose speed ripples once a turn, with the true forces."""
    time = np.arange(samples) * (2.0 / samples)
    mean = np.pi
    angle = mean * time + ripple * np.sin(mean * time)
    speed = mean * (1.0 + ripple * np.cos(mean * time))
    acceleration = -mean * mean * ripple * np.sin(mean * time)
    motion = inverse_dynamics(PARAMETERS.mechanism, angle, speed, acceleration, clearance)
    counts = np.floor(angle * 3600.0 / (2.0 * np.pi)) * (2.0 * np.pi / 3600.0)
    zeros = np.zeros(samples)
    arrays = (time, counts, *motion.force_crank, zeros, zeros)
    return RevolutionMeasured(7, *(np.asarray(a, "<f8").tobytes() for a in arrays))


def predict_revolution(parameters, joint, measured, wear):  # type: ignore[no-untyped-def]
    motion, _ = predict_force(parameters, joint, measured, wear.predicted_depth)
    return compare(measured, motion, wear)


def values(prediction: object) -> dict[str, float]:
    numbers = as_array(prediction.values, "<f8")  # type: ignore[attr-defined]
    return dict(zip((c.name for c in prediction_columns()), numbers, strict=True))


@pytest.mark.parametrize("ripple", [0.0, 0.02])
def test_prediction_follows_the_measured_speed(ripple: float) -> None:
    measured = unpack(revolution(ripple, CLEARANCE))
    prediction = predict_revolution(PARAMETERS, "continuous", measured, Wear())
    found = values(prediction)
    assert found["revolution"] == 7
    assert found["residual_rms"] < 0.15
    assert found["residual_1_rms"] < 0.15
    assert found["residual_2_rms"] < 0.15
    assert abs(found["phase_shift"]) < 0.2


def test_joint_technique_matters() -> None:
    measured = unpack(revolution(0.0, CLEARANCE))
    perfect = values(predict_revolution(PARAMETERS, "perfect", measured, Wear()))
    worn = values(
        predict_revolution(PARAMETERS, "continuous", measured, Wear(predicted_depth=5e-4))
    )
    continuous = values(predict_revolution(PARAMETERS, "continuous", measured, Wear()))
    assert perfect["force_max"] > continuous["force_max"] > worn["force_max"]
    assert worn["wear_depth"] == pytest.approx(0.5)
    assert np.isnan(worn["measured_wear_depth"])


def test_wrong_sign_is_seen() -> None:
    good = revolution(0.0, CLEARANCE)
    flipped = RevolutionMeasured(
        good.revolution,
        good.time_s,
        good.angle_rad,
        (-as_array(good.force_1, "<f8")).tobytes(),
        good.force_2,
        good.probe_1,
        good.probe_2,
    )
    found = values(predict_revolution(PARAMETERS, "continuous", unpack(flipped), Wear()))
    assert found["residual_rms"] < 0.2
    assert found["residual_1_rms"] > 20.0


@settings(deadline=None, max_examples=12)
@given(st.floats(-60.0, 60.0))
def test_phase_shift_is_the_lag_of_the_measurement(degrees: float) -> None:
    curve = 50.0 + 30.0 * np.cos(GRID) + 8.0 * np.sin(2.0 * GRID)
    lag = np.radians(degrees)
    late = 50.0 + 30.0 * np.cos(GRID - lag) + 8.0 * np.sin(2.0 * (GRID - lag))
    assert np.degrees(phase_shift(late, curve)) == pytest.approx(degrees, abs=0.02)


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda a: a.update(angle=-a["angle"]), "did not turn forward"),
        (lambda a: a.update(angle=0.0 * a["angle"]), "did not turn forward"),
        (lambda a: a.update(angle=np.nan * a["angle"]), "not all numbers"),
        (lambda a: a["time"].__setitem__(5, np.inf), "not all numbers"),
        (lambda a: a["force_2"].__setitem__(3, np.nan), "not all numbers"),
    ],
)
def test_what_is_no_forward_revolution_is_named(change: Any, why: str) -> None:
    time = np.arange(360) * (2.0 / 360)
    arrays = {"time": time, "angle": np.pi * time}
    arrays |= {name: np.zeros(360) for name in ("force_1", "force_2", "probe_1", "probe_2")}
    change(arrays)
    with pytest.raises(PredictionError, match=why):
        unpack(RevolutionMeasured(7, *(a.astype("<f8").tobytes() for a in arrays.values())))


ANY = st.one_of(st.floats(), st.floats(-10.0, 10.0))


@given(
    st.integers(0, 40).flatmap(lambda n: st.tuples(*[st.lists(ANY, min_size=n, max_size=n)] * 6)),
    st.integers(-5, 2**40),
)
def test_no_history_makes_the_twin_fail(columns: tuple[list[float], ...], number: int) -> None:
    message = RevolutionMeasured(number, *(np.array(c, "<f8").tobytes() for c in columns))
    with np.errstate(all="ignore"):
        reply = serve(Twin(PARAMETERS, "continuous"), message)
    assert not reply.failed, reply.failed
    assert (reply.prediction is None) == bool(reply.refused)


TURN = np.linspace(0.0, 1.0, 96_000, endpoint=False)


def uneven(ratio: np.ndarray, rpm: float = 60.0, fine: int = 100) -> RevolutionMeasured:
    """Make a revolution whose speed over the mean is given finely, with the true forces."""
    mean = rpm * np.pi / 30.0
    step = 60.0 / rpm / len(ratio)
    speed = mean * ratio
    angle = np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * step)))[::fine]
    acceleration = np.gradient(speed, step)[::fine]
    motion = inverse_dynamics(PARAMETERS.mechanism, angle, speed[::fine], acceleration, CLEARANCE)
    count = 2.0 * np.pi / 3600.0
    counts = np.floor(angle / count + 0.37) * count
    zeros = np.zeros(len(angle))
    time = np.arange(len(angle)) * step * fine
    arrays = (time, counts, *motion.force_crank, zeros, zeros)
    return RevolutionMeasured(7, *(np.asarray(a, "<f8").tobytes() for a in arrays))


@pytest.mark.parametrize(
    ("ratio", "followed"),
    [
        (1.0 + 0.0 * TURN, True),
        (1.0 + 0.01 * np.cos(4.0 * np.pi * TURN), True),
        (1.0 - 0.03 * np.exp(-0.5 * ((TURN - 0.4) / 0.01) ** 2), False),
        (1.0 - 0.03 * np.exp(-0.5 * ((TURN - 0.4) / 0.005) ** 2), False),
        (1.0 + 0.01 * np.cos(50.0 * np.pi * TURN), False),
    ],
)
@pytest.mark.parametrize("rpm", [60.0, 300.0])
def test_the_force_is_as_uncertain_as_it_is_wrong(
    ratio: np.ndarray, followed: bool, rpm: float
) -> None:
    measured = unpack(uneven(ratio[:: round(rpm / 60.0)], rpm))
    motion, doubt = predict_force(PARAMETERS, "continuous", measured, 0.0)
    at_grid = [np.interp(GRID, measured.angle, f) for f in (measured.force_1, measured.force_2)]
    error = np.hypot(*(motion.force_crank - np.array(at_grid)))
    assert np.mean(error <= doubt.curve) >= 0.95
    assert (doubt.unfollowed == 0.0) is followed
    found = values(compare(measured, motion, Wear(), doubt))
    assert found["force_uncertainty"] == pytest.approx(doubt.largest)
    assert found["unfollowed_acceleration"] == pytest.approx(doubt.unfollowed)
    if followed:
        assert doubt.largest < (0.04 if rpm < 100.0 else 0.2) * found["force_max"]
    elif rpm < 100.0:
        assert doubt.largest >= error.max()


def test_the_twin_says_how_sure_it_is() -> None:
    twin = Twin(PARAMETERS, "continuous")
    steady = values(twin.predict(unpack(uneven(1.0 + 0.0 * TURN))))
    dip = 1.0 - 0.03 * np.exp(-0.5 * ((TURN - 0.4) / 0.01) ** 2)
    sudden = values(twin.predict(unpack(uneven(dip))))
    assert 0.0 < steady["force_uncertainty"] < 0.2 * sudden["force_uncertainty"]
    assert steady["unfollowed_acceleration"] == 0.0 < sudden["unfollowed_acceleration"]
