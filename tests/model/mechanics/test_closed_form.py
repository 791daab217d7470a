"""The closed form against the reference tables, power balance and its own exact relations."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp_model.dynamics import MechanismMotion, inverse_dynamics
from rigapp_model.errors import ModelError
from rigapp_model.frames import into_frame
from rigapp_model.parameters import Joint, Mechanism, Spring

DATA = Path(__file__).parents[2] / "data"
CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))
RPM_30 = np.pi
DEGREES = np.deg2rad(np.arange(360.0))


def columns_of(motion: MechanismMotion) -> dict[str, np.ndarray]:
    """Return the motion under the reference table's column names."""
    vectors = {
        ("x1[m]", "y1[m]"): motion.crank_position,
        ("v1x[m/s]", "v1y[m/s]"): motion.crank_velocity,
        ("a1x[m/s2]", "a1y[m/s2]"): motion.crank_acceleration,
        ("x2[m]", "y2[m]"): motion.follower_position,
        ("v2x[m/s]", "v2y[m/s]"): motion.follower_velocity,
        ("a2x[m/s2]", "a2y[m/s2]"): motion.follower_centre_acceleration,
        ("Fx[N]", "Fy[N]"): motion.force,
        ("F_e1[N]", "F_n1[N]"): motion.force_crank,
        ("F_e2[N]", "F_n2[N]"): motion.force_follower,
        ("Sx[N]", "Sy[N]"): motion.wrist_force,
        ("R1x[N]", "R1y[N]"): motion.bearing_force,
    }
    scalars = {
        "phi2[rad]": motion.follower_angle,
        "w2[rad/s]": motion.follower_speed,
        "al2[rad/s2]": motion.follower_acceleration,
        "x3[m]": motion.slider_position,
        "v3[m/s]": motion.slider_velocity,
        "a3[m/s2]": motion.slider_acceleration,
        "Fs[N]": motion.spring_force,
        "F[N]": motion.force_magnitude,
        "S[N]": np.hypot(*motion.wrist_force),
        "N[N]": motion.guide_force,
        "T[N*m]": motion.drive_torque,
    }
    for names, vector in vectors.items():
        scalars |= dict(zip(names, vector, strict=True))
    return scalars


@pytest.mark.parametrize(("case", "mechanism"), [("A", CASE_A), ("B", CASE_B)])
def test_every_column_of_the_reference_tables(case: str, mechanism: Mechanism) -> None:
    table = np.genfromtxt(
        DATA / f"forces_case_{case}.csv", delimiter=",", names=True, deletechars=""
    )
    mine = columns_of(inverse_dynamics(mechanism, table["phi1[rad]"], RPM_30))
    assert set(table.dtype.names) - set(mine) == {"crank_angle_deg", "phi1[rad]"}
    for name, values in mine.items():
        scale = max(np.abs(table[name]).max(), 1e-12)
        assert np.abs(values - table[name]).max() <= 1e-9 * scale, name


@pytest.mark.parametrize(
    ("mechanism", "rpm", "largest", "at", "least", "at_least", "rms"),
    [
        (CASE_A, 30.0, 6.467943, 0, 0.257094, 72, 3.688926),
        (CASE_B, 30.0, 96.902350, 180, 26.467943, 0, 71.067093),
        (CASE_A, 600.0, 2587.177125, 0, 102.837479, 72, 1475.570258),
    ],
)
def test_reference_extremes(
    mechanism: Mechanism,
    rpm: float,
    largest: float,
    at: int,
    least: float,
    at_least: int,
    rms: float,
) -> None:
    force = inverse_dynamics(mechanism, DEGREES, rpm * np.pi / 30.0).force_magnitude
    assert (int(force.argmax()), int(force.argmin())) == (at, at_least)
    assert force.max() == pytest.approx(largest, abs=6e-7)
    assert force.min() == pytest.approx(least, abs=6e-7)
    assert np.sqrt(np.mean(force**2)) == pytest.approx(rms, abs=6e-7)


def test_twenty_times_the_speed_gives_four_hundred_times_the_force() -> None:
    slow = inverse_dynamics(CASE_A, DEGREES, RPM_30)
    fast = inverse_dynamics(CASE_A, DEGREES, 20.0 * RPM_30)
    np.testing.assert_allclose(fast.force, 400.0 * slow.force, rtol=0.0, atol=1e-11)


def power_imbalance(
    mechanism: Mechanism, speed: float, growth: float, gap: float, contact: Joint | None
) -> float:
    """Return drive power less the rate of energy and friction, over the largest drive power."""
    m = inverse_dynamics(mechanism, DEGREES, speed, growth, gap, contact)
    masses = (mechanism.crank_mass, mechanism.follower_mass, mechanism.moving_mass)
    still = np.zeros_like(m.slider_velocity)
    velocities = (m.crank_velocity, m.follower_velocity, np.stack([m.slider_velocity, still]))
    accelerations = (
        m.crank_acceleration,
        m.follower_centre_acceleration,
        np.stack([m.slider_acceleration, still]),
    )
    rate = mechanism.crank_inertia * m.speed * m.acceleration
    rate = rate + mechanism.follower_inertia * m.follower_speed * m.follower_acceleration
    for mass, v, a in zip(masses, velocities, accelerations, strict=True):
        rate += mass * (v[0] * (a[0] - mechanism.gravity[0]))
        rate += mass * (v[1] * (a[1] - mechanism.gravity[1]))
    rate -= m.spring_force * m.slider_velocity
    rate += m.friction_moment * (m.speed - m.follower_speed)
    power = m.drive_torque * m.speed
    return float(np.abs(power - rate).max() / np.abs(power).max())


def test_power_balance_of_the_reference_cases() -> None:
    for mechanism in (CASE_A, CASE_B):
        assert power_imbalance(mechanism, RPM_30, 0.0, 0.0, None) < 1e-12


@settings(max_examples=60, deadline=None)
@given(
    speed=st.floats(0.5, 80.0),
    growth=st.floats(-50.0, 50.0),
    gap=st.floats(-2e-3, 2e-3),
    gravity=st.tuples(st.floats(-10.0, 10.0), st.floats(-10.0, 10.0)),
    friction=st.floats(0.0, 0.4),
    added=st.floats(0.0, 10.0),
)
def test_power_balance_holds_whatever_the_settings(
    speed: float,
    growth: float,
    gap: float,
    gravity: tuple[float, float],
    friction: float,
    added: float,
) -> None:
    mechanism = replace(CASE_B, gravity=gravity, added_mass=added)
    joint = Joint(9.5e-3, 10e-3, 20e-3, 13e-3, friction)
    assert power_imbalance(mechanism, speed, growth, gap, joint) < 1e-12


def test_accelerations_are_the_derivatives_of_positions() -> None:
    time = np.linspace(0.0, 1.0, 20001)
    angle, speed, growth = 0.3 + 4.0 * time - time**2, 4.0 - 2.0 * time, -2.0
    m = inverse_dynamics(CASE_B, angle, speed, growth, 0.5e-3)
    step = time[1]
    for position, velocity, acceleration in (
        (m.slider_position, m.slider_velocity, m.slider_acceleration),
        (m.follower_angle, m.follower_speed, m.follower_acceleration),
        (m.follower_position, m.follower_velocity, m.follower_centre_acceleration),
        (m.crank_position, m.crank_velocity, m.crank_acceleration),
    ):
        slope = np.gradient(position, step, axis=-1)[..., 1:-1]
        np.testing.assert_allclose(slope, velocity[..., 1:-1], atol=5e-8)
        bend = np.gradient(velocity, step, axis=-1)[..., 1:-1]
        np.testing.assert_allclose(bend, acceleration[..., 1:-1], atol=5e-7)


def test_clearance_lengthens_the_follower_and_relaxes_an_outboard_spring() -> None:
    perfect = inverse_dynamics(CASE_B, DEGREES, RPM_30)
    for gap, expected in ((0.1e-3, -0.055), (0.5e-3, -0.27), (1.0e-3, -0.55)):
        worn = inverse_dynamics(CASE_B, DEGREES, RPM_30, clearance=gap)
        assert worn.slider_position[0] - perfect.slider_position[0] == pytest.approx(gap)
        change = worn.force_magnitude.max() / perfect.force_magnitude.max() - 1.0
        assert 100.0 * change == pytest.approx(expected, abs=6e-3)


def test_an_inboard_spring_tightens_with_clearance() -> None:
    mechanism = replace(CASE_A, spring=Spring(525.0, 0.100))
    perfect = inverse_dynamics(mechanism, 0.0, RPM_30).spring_force
    worn = inverse_dynamics(mechanism, 0.0, RPM_30, clearance=1e-3).spring_force
    assert worn - perfect == pytest.approx(-0.525)


def test_friction_force_is_tangent_to_the_friction_circle() -> None:
    joint = Joint(9.5e-3, 10e-3, 20e-3, 13e-3, 0.13)
    m = inverse_dynamics(CASE_B, DEGREES, RPM_30, contact=joint)
    rho = 9.5e-3 * 0.13 / np.hypot(1.0, 0.13)
    np.testing.assert_allclose(m.friction_moment, rho * m.force_magnitude, rtol=1e-12)
    back = inverse_dynamics(CASE_B, DEGREES, -RPM_30, contact=joint)
    np.testing.assert_allclose(back.friction_moment, -rho * back.force_magnitude, rtol=1e-12)
    frictionless = inverse_dynamics(CASE_B, DEGREES, RPM_30)
    assert np.mean(m.drive_torque) > 0.01
    assert np.mean(frictionless.drive_torque) == pytest.approx(0.0, abs=1e-12)


def test_slip_is_one_circumference_of_the_pin() -> None:
    for gap in (0.0, 1e-3):
        m = inverse_dynamics(CASE_B, DEGREES, RPM_30, clearance=gap)
        slip = m.slip_increments(9.5e-3)
        assert slip.sum() == pytest.approx(2.0 * np.pi * 9.5e-3, rel=1e-14)
        middle = inverse_dynamics(CASE_B, DEGREES + np.deg2rad(0.5), RPM_30, clearance=gap)
        rate = middle.slip_rate(9.5e-3) * (np.deg2rad(1.0) / RPM_30)
        np.testing.assert_allclose(slip, rate, rtol=2e-5)
    backwards = inverse_dynamics(CASE_B, DEGREES[::-1], -RPM_30)
    total = backwards.slip_increments(9.5e-3).sum()
    assert total == pytest.approx(2.0 * np.pi * 9.5e-3, rel=1e-14)


def test_scalars_and_histories() -> None:
    one = inverse_dynamics(CASE_B, 1.0, RPM_30, 2.0)
    many = inverse_dynamics(CASE_B, DEGREES[:, None] + [0.0, 1.0], RPM_30, 2.0)
    assert one.force.shape == (2,)
    assert many.force.shape == (2, 360, 2)
    np.testing.assert_allclose(many.force[:, 0, 1], one.force, rtol=1e-13)


def test_frames_turn_and_return() -> None:
    m = inverse_dynamics(CASE_B, DEGREES, RPM_30)
    turn = m.follower_angle - m.angle
    turned = into_frame(m.force_crank, np.cos(turn), np.sin(turn))
    np.testing.assert_allclose(turned, m.force_follower, atol=1e-12)
    c, s = np.cos(0.3), np.sin(0.3)
    np.testing.assert_allclose(into_frame(into_frame(m.force, c, s), c, -s), m.force, atol=1e-13)
    np.testing.assert_allclose(into_frame((1.0, 0.0), 0.0, 1.0), (0.0, -1.0), atol=1e-16)


@pytest.mark.parametrize(
    ("arguments", "quantity", "words"),
    [
        (((float("nan"),), 1.0), "angle", "finite"),
        ((0.0, float("inf")), "speed", "finite"),
        ((0.0, 1.0, 0.0, -0.13), "clearance", "too short"),
        (((0.0, 1.0), (1.0, 2.0, 3.0)), "shapes", "one shape"),
    ],
)
def test_refusals(arguments: tuple, quantity: str, words: str) -> None:
    with pytest.raises(ModelError, match=words) as caught:
        inverse_dynamics(CASE_A, *arguments)
    assert caught.value.quantity == quantity


def test_a_locking_joint_is_refused() -> None:
    joint = Joint(0.25, 0.26, 0.30, 13e-3, 5.0)
    with pytest.raises(ModelError, match="locks"):
        inverse_dynamics(CASE_B, DEGREES, RPM_30, contact=joint)
