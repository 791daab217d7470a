"""Speed and acceleration from encoder counts: how accurate, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp_model.errors import ModelError
from rigapp_model.history import motion_from_history, smooth_history

COUNT = 2.0 * np.pi / 3600.0


def rig(
    rpm: float,
    rate: float,
    ripple: dict[int, float],
    gain: float = 0.0,
    start: float = 0.1234,
    revolutions: float = 1.0,
) -> tuple[np.ndarray, ...]:
    """Return time, angle, speed, acceleration of a turn with relative speed ripple by harmonic."""
    w, turn = rpm * np.pi / 30.0, 2.0 * np.pi * revolutions
    period = turn / w if gain == 0.0 else (np.sqrt(w * w + 2.0 * turn * gain) - w) / gain
    t = np.arange(int(period * rate)) / rate
    base, pace = start + w * t + 0.5 * gain * t * t, w + gain * t
    angle, speed, growth = base.copy(), pace.copy(), np.full_like(t, gain)
    for k, r in ripple.items():
        angle += r / k * np.sin(k * base + k)
        speed += r * pace * np.cos(k * base + k)
        growth += r * gain * np.cos(k * base + k) - r * k * pace**2 * np.sin(k * base + k)
    return t, angle, speed, growth


RIPPLE = {1: 0.005, 2: 0.01, 3: 0.003}


@pytest.mark.parametrize(
    ("rpm", "rate", "speed_error", "acceleration_error"),
    [
        (30.0, 960.0, 4e-4, 6e-4),
        (30.0, 12000.0, 4e-5, 6e-5),
        (60.0, 960.0, 5e-4, 1e-3),
        (600.0, 960.0, 2e-3, 4e-3),
        (600.0, 12000.0, 2e-3, 4e-3),
    ],
)
def test_counts_of_a_steady_turn_with_ripple(
    rpm: float, rate: float, speed_error: float, acceleration_error: float
) -> None:
    time, angle, speed, growth = rig(rpm, rate, RIPPLE)
    w = rpm * np.pi / 30.0
    got_speed, got_growth = motion_from_history(time, np.floor(angle / COUNT) * COUNT)
    assert np.abs(got_speed - speed).max() < speed_error * w
    assert np.abs(got_growth - growth).max() < acceleration_error * w**2
    assert np.abs(growth).max() > 0.02 * w**2


def test_counts_that_beat_with_the_sampling_look_like_no_ripple() -> None:
    for rpm, rate in ((112.0, 960.3), (600.0, 12000.0), (8.0, 960.3)):
        time, angle, _, _ = rig(rpm, rate, {})
        speed, growth = motion_from_history(time, np.floor(angle / COUNT) * COUNT)
        assert np.abs(speed / (rpm * np.pi / 30.0) - 1.0).max() < 1e-3
        assert np.abs(growth).max() == 0.0


def test_a_steady_turn_has_no_acceleration_at_all() -> None:
    time, angle, _, _ = rig(30.0, 960.0, {})
    speed, growth = motion_from_history(time, np.floor(angle / COUNT) * COUNT)
    assert np.abs(speed - np.pi).max() < 1e-4
    assert np.abs(growth).max() == 0.0


def test_counts_of_a_run_up() -> None:
    time, angle, speed, growth = rig(30.0, 960.0, RIPPLE, gain=0.5)
    got_speed, got_growth = motion_from_history(time, np.floor(angle / COUNT) * COUNT)
    assert np.abs(got_speed - speed).max() < 2e-3 * np.pi
    assert np.abs(got_growth - growth).max() < 0.05


def test_exact_angles_are_differentiated_exactly() -> None:
    time, angle, speed, growth = rig(30.0, 960.0, {1: 0.02, 4: 0.01})
    got_speed, got_growth = motion_from_history(time, angle)
    np.testing.assert_allclose(got_speed, speed, rtol=1e-6)
    np.testing.assert_allclose(got_growth, growth, atol=2e-5)


def test_the_counter_may_restart_at_the_index_and_turn_backwards() -> None:
    time, angle, speed, growth = rig(30.0, 960.0, RIPPLE, start=2.0)
    counts = np.floor(angle / COUNT) * COUNT
    wrapped = np.mod(counts, 2.0 * np.pi)
    for given_angle, sign in ((wrapped, 1.0), (-counts, -1.0)):
        got_speed, got_growth = motion_from_history(time, given_angle)
        assert np.abs(got_speed - sign * speed).max() < 2e-3
        assert np.abs(got_growth - sign * growth).max() < 1e-2


def test_lost_samples_and_a_spike_do_little_harm() -> None:
    time, angle, speed, growth = rig(30.0, 960.0, RIPPLE)
    counts = np.floor(angle / COUNT) * COUNT
    counts[700] += 0.5
    kept = np.ones(len(time), dtype=bool)
    kept[300:340] = False
    got_speed, got_growth = motion_from_history(time[kept], counts[kept])
    assert np.abs(got_speed - speed[kept]).max() < 2e-3
    assert np.abs(got_growth - growth[kept]).max() < 1e-2


def test_noise_is_that_of_the_counts() -> None:
    time, angle, _, _ = rig(30.0, 960.0, RIPPLE)
    history = smooth_history(time, np.floor(angle / COUNT) * COUNT)
    assert history.noise == pytest.approx(COUNT / np.sqrt(12.0), rel=0.05)
    assert np.abs(history.angle - (angle - 0.5 * COUNT)).max() < 0.2 * COUNT


def test_standstill_is_no_motion() -> None:
    speed, growth = motion_from_history(np.arange(100) / 960.0, np.full(100, 1.5))
    assert np.abs(speed).max() < 1e-10
    assert np.abs(growth).max() < 1e-10


@settings(max_examples=40, deadline=None)
@given(
    rpm=st.floats(5.0, 120.0),
    amplitude=st.floats(0.0, 0.03),
    harmonic=st.integers(1, 5),
    start=st.floats(-6.0, 6.0),
)
def test_any_rig_speed(rpm: float, amplitude: float, harmonic: int, start: float) -> None:
    time, angle, speed, growth = rig(rpm, 960.3, {harmonic: amplitude}, start=start)
    w = rpm * np.pi / 30.0
    got_speed, got_growth = motion_from_history(time, np.floor(angle / COUNT) * COUNT)
    assert np.abs(got_speed - speed).max() < 0.02 * w
    assert np.abs(got_growth - growth).max() < 0.06 * w**2


@pytest.mark.parametrize(
    ("time", "angle", "words"),
    [
        (np.arange(5.0), np.arange(5.0), "at least 8"),
        (np.arange(9.0), np.arange(8.0), "one time for each angle"),
        (np.r_[0.0:8.0, 7.0], np.arange(9.0), "sample 8 is not later"),
        (np.arange(9.0), np.r_[0.0:8.0, np.nan], "finite"),
    ],
)
def test_refusals(time: np.ndarray, angle: np.ndarray, words: str) -> None:
    with pytest.raises(ModelError, match=words):
        motion_from_history(time, angle)
