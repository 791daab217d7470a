"""Speed and acceleration of a measured turn: what the uncertainty says holds against the truth."""

from __future__ import annotations

import numpy as np
import pytest

from rigapp_model.history import smooth_history
from rigapp_model.history_uncertainty import (
    MotionUncertainty,
    _line_of_least_span,
    motion_uncertainty,
)

COUNT = 2.0 * np.pi / 3600.0
FINE = 50

Turn = tuple[np.ndarray, np.ndarray, np.ndarray]


def turn(ratio: np.ndarray, rpm: float, rate: float) -> Turn:
    """Return angle, speed, acceleration at the samples; ratio: speed over the mean, finely."""
    mean = rpm * np.pi / 30.0
    step = 1.0 / (rate * FINE)
    speed = mean * ratio
    angle = 0.1234 + np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * step)))
    return angle[::FINE], speed[::FINE], np.gradient(speed, step)[::FINE]


def phase(rpm: float, rate: float) -> np.ndarray:
    """Return the turn (0 .. 1) at fine times of one revolution at the mean speed."""
    return np.arange(round(60.0 / rpm * rate) * FINE) / (FINE * rate * 60.0 / rpm)


def dip(at: np.ndarray, width: float) -> np.ndarray:
    return np.asarray(1.0 - 0.03 * np.exp(-0.5 * ((at - 0.4) / width) ** 2))


def ripple(at: np.ndarray, order: int, size: float) -> np.ndarray:
    return np.asarray(1.0 + size * np.cos(2.0 * np.pi * order * at + 0.3))


def examined(
    measured: np.ndarray, rate: float, acceleration: np.ndarray
) -> tuple[MotionUncertainty, np.ndarray]:
    """Return what is said of a measured angle, and the acceleration's true error over U (k = 2)."""
    time = np.arange(len(measured)) / rate
    history = smooth_history(time, measured)
    found = motion_uncertainty(time, measured, history)
    return found, np.abs(history.acceleration - acceleration) / (2.0 * found.acceleration)


@pytest.mark.parametrize("noisy", [False, True])
@pytest.mark.parametrize("rpm", [30.0, 60.0, 300.0])
@pytest.mark.parametrize(
    "motion",
    [
        *(lambda at, w=width: dip(at, w) for width in (0.05, 0.02, 0.01, 0.005, 0.002)),
        *(lambda at, r=size: ripple(at, 25, r) for size in (0.001, 0.005, 0.02)),
        lambda at: ripple(at, 13, 0.005),
        lambda at: 1.0 - 0.03 / (1.0 + np.exp(-(at - 0.4) / 0.003)),
        lambda at: ripple(at, 2, 0.01),
        lambda at: 1.0 + 0.0 * at,
    ],
)  # fmt: skip
def test_the_true_acceleration_is_covered(motion, rpm: float, noisy: bool) -> None:  # type: ignore[no-untyped-def]
    rate = 960.0
    angle, _, acceleration = turn(motion(phase(rpm, rate)), rpm, rate)
    counts = np.floor(angle / COUNT) * COUNT
    noise = np.random.default_rng(2).normal(0.0, COUNT / np.sqrt(12.0), len(angle))
    _, share = examined(angle + noise if noisy else counts, rate, acceleration)
    assert np.mean(share <= 1.0) >= 0.95


@pytest.mark.parametrize(
    ("width", "rpm"), [(0.02, 30.0), (0.01, 30.0), (0.005, 30.0), (0.01, 60.0), (0.005, 60.0)]
)
def test_a_sudden_dip_is_covered_where_it_is_worst_and_told(width: float, rpm: float) -> None:
    angle, _, acceleration = turn(dip(phase(rpm, 960.0), width), rpm, 960.0)
    found, share = examined(np.floor(angle / COUNT) * COUNT, 960.0, acceleration)
    assert share.max() <= 1.0
    assert found.unfollowed > 0.0
    assert 0.4 < np.argmax(found.acceleration) / len(angle) + 0.05 < 0.5


def test_a_fast_ripple_is_covered_and_told() -> None:
    for rpm in (30.0, 60.0, 300.0):
        angle, _, acceleration = turn(ripple(phase(rpm, 960.0), 25, 0.01), rpm, 960.0)
        found, share = examined(np.floor(angle / COUNT) * COUNT, 960.0, acceleration)
        assert share.max() <= 1.0
        assert found.unfollowed >= 0.7 * np.abs(acceleration).max()


@pytest.mark.parametrize(
    ("rpm", "rate"), [(30.0, 960.0), (60.0, 960.0), (112.0, 960.3), (8.0, 960.3)]
)
def test_a_steady_turn_has_a_small_uncertainty_and_no_alarm(rpm: float, rate: float) -> None:
    mean = rpm * np.pi / 30.0
    angle, _, acceleration = turn(1.0 + 0.0 * phase(rpm, rate), rpm, rate)
    found, share = examined(np.floor(angle / COUNT) * COUNT, rate, acceleration)
    assert found.unfollowed == 0.0
    assert share.max() <= 1.0
    assert 2.0 * found.acceleration.max() < 0.15 * mean**2
    assert 2.0 * found.speed.max() < 0.005 * mean
    assert found.angle == pytest.approx(COUNT / np.sqrt(12.0), rel=0.3)


def test_a_finer_encoder_knows_more() -> None:
    angle, _, acceleration = turn(ripple(phase(31.7, 960.0), 2, 0.01), 31.7, 960.0)
    coarse, fine = (
        examined(np.floor(angle / count) * count, 960.0, acceleration)[0]
        for count in (COUNT, COUNT / 10.0)
    )
    assert fine.acceleration.max() < 0.2 * coarse.acceleration.max()


def test_noise_alone_is_hardly_ever_taken_for_motion() -> None:
    angle, _, acceleration = turn(1.0 + 0.0 * phase(60.0, 960.0), 60.0, 960.0)
    noise = np.random.default_rng(7).normal(0.0, COUNT, (200, len(angle)))
    told = [examined(angle + one, 960.0, acceleration)[0].unfollowed > 0.0 for one in noise]
    assert sum(told) <= 1


@pytest.mark.parametrize(("begin", "end"), [(0.4, 0.7), (0.02, 0.5), (0.5, 0.9), (0.0, 0.15)])
def test_the_angle_is_covered_at_the_seam_of_a_run_up(begin: float, end: float) -> None:
    """A ramp that begins or ends within the turn bends the angle as no parabola does."""
    at = phase(60.0, 960.0)
    ratio = 0.4 + 0.6 * np.clip((at - begin) / (end - begin), 0.0, 1.0)
    angle, _, _ = turn(ratio, 60.0, 960.0)
    counts = np.floor(angle / COUNT) * COUNT
    time = np.arange(len(counts)) / 960.0
    history = smooth_history(time, counts)
    found = motion_uncertainty(time, counts, history)
    off = np.abs(history.angle + 0.5 * COUNT - angle)  # whole counts are half a one behind
    assert np.mean(off <= 2.0 * found.angle) > 0.95
    assert (off / (2.0 * found.angle)).max() < 1.5


@pytest.mark.parametrize("seed", range(8))
def test_the_line_of_least_span_has_the_least_span_of_all_lines(seed: int) -> None:
    random = np.random.default_rng(seed)
    size = int(random.integers(3, 800))
    tau = np.linspace(-1.0, 1.0, size)
    turn = np.linspace(0.0, 2.0 * np.pi, size)
    angle = turn + random.uniform(0.0, 0.02) * np.sin(random.integers(1, 9) * turn)
    residual = angle - COUNT * np.floor(angle / COUNT) + random.uniform(-2.0, 2.0) * COUNT * tau
    least = np.ptp(residual - _line_of_least_span(residual, COUNT))
    slopes = np.linspace(-COUNT, COUNT, 2001)
    assert all(least <= np.ptp(residual - slope * tau) + 1e-9 * COUNT for slope in slopes)
