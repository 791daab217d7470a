"""Technique 3 against technique 2, a published benchmark, another integrator, and energy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rigapp_model.contact import impact_laws as laws
from rigapp_model.contact.impact import ContactCycle, contact_cycle, integrate_contact
from rigapp_model.contact.impact_system import (
    ClearanceSystem,
    ContactState,
    clearance_system,
    settled_state,
)
from rigapp_model.contact_law import ContactModel, WornSurface, foundation_modulus, hertz_stiffness
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Joint, Material, Mechanism, Spring

CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))
JOINT = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3)
ROUGH = replace(JOINT, friction_coefficient=0.13)
POLYMER, STEEL = Material(500e6, 0.38), Material(206e9, 0.29)

FAST = Mechanism(0.05, 0.3, 1e-4, 0.12, 0.21, 2.5e-4, 0.14)
BEARING = Joint(9.5e-3, 10e-3, 20e-3, 13e-3)
HARD = Material(207e9, 0.3)
RPM_5000 = 5000.0 * np.pi / 30.0


def centred_state(system: ClearanceSystem) -> ContactState:
    """Return the state of the perfect joint at the start angle: pin and bushing concentric."""
    motion = inverse_dynamics(system.mechanism, system.start_angle, system.speed)
    return ContactState(
        slider_position=float(motion.slider_position),
        follower_angle=float(motion.follower_angle),
        slider_velocity=float(motion.slider_velocity),
        follower_speed=float(motion.follower_speed),
    )


def test_case_b_stays_in_contact_and_agrees_with_technique_2() -> None:
    system = clearance_system(CASE_B, JOINT, POLYMER, STEEL, np.pi)
    cycle = contact_cycle(system)
    assert cycle.contact_is_continuous
    assert len(cycle.impacts) == 0
    assert cycle.touching.all()
    depth = [system.penetration_under(size) for size in cycle.motion.force_magnitude]
    np.testing.assert_allclose(cycle.penetration, depth, rtol=1e-2)
    other = inverse_dynamics(CASE_B, cycle.motion.angle, np.pi, clearance=JOINT.clearance)
    difference = cycle.motion.force_magnitude - other.force_magnitude
    assert np.abs(difference).max() < 0.05
    assert np.degrees(np.abs(cycle.contact_angle).max()) < 0.5
    assert cycle.motion.angle[0] % (2.0 * np.pi) == pytest.approx(0.0, abs=1e-12)
    assert len(cycle.time) == 360


def test_case_a_loses_contact() -> None:
    system = clearance_system(CASE_A, JOINT, POLYMER, STEEL, np.pi)
    cycle = contact_cycle(system, revolutions=10)
    assert 0.5 < cycle.contact_fraction < 0.65
    assert not cycle.contact_is_continuous
    assert len(cycle.impacts) > 50
    assert (cycle.impacts.speed > 0.0).all()
    assert (cycle.penetration[~cycle.touching] <= 1e-12).all()
    assert (cycle.normal_force[~cycle.touching] == 0.0).all()
    assert cycle.touching.mean() == pytest.approx(cycle.contact_fraction, abs=0.03)
    assert np.degrees(np.ptp(cycle.contact_angle)) > 300.0


def test_the_published_benchmark_at_5000_rpm() -> None:
    assert hertz_stiffness(BEARING, HARD, HARD) == pytest.approx(6.61e10, rel=1e-3)
    ideal = inverse_dynamics(FAST, np.deg2rad(np.arange(360.0)), RPM_5000).slider_acceleration
    assert ideal.min() == pytest.approx(-19419.0, abs=1.0)
    assert ideal.max() == pytest.approx(9696.0, abs=1.0)
    published = ContactModel("lankarani-nikravesh")
    smooth = clearance_system(FAST, BEARING, HARD, HARD, RPM_5000, published, location="wrist")
    start = centred_state(smooth)
    cycle = contact_cycle(smooth, revolutions=200, settling_revolutions=10, start=start)
    # Samples of 200 revolutions scatter by 0.016 and 0.7 (standard deviation), and another
    # processor's rounding is another sample.
    assert 0.715 < cycle.contact_fraction < 0.835
    assert 10.3 < len(cycle.impacts) / 200 < 15.3
    rough = clearance_system(
        FAST,
        replace(BEARING, friction_coefficient=0.1),
        HARD,
        HARD,
        RPM_5000,
        published,
        location="wrist",
    )
    start = centred_state(rough)
    cycle = contact_cycle(rough, 3600, revolutions=2, settling_revolutions=4, start=start)
    assert cycle.contact_is_continuous
    peak = np.abs(cycle.motion.slider_acceleration).max() / np.abs(ideal).max()
    assert 1.38 < peak < 1.48


@pytest.mark.parametrize(
    ("joint", "material", "foundation", "steps"),
    [
        (JOINT, POLYMER, False, 1000),
        (ROUGH, POLYMER, False, 3000),
        (JOINT, POLYMER, True, 1600),
        (JOINT, STEEL, False, 3900),
        (ROUGH, STEEL, False, 10000),
    ],
)
def test_the_default_tolerance_gives_every_point_in_few_steps(
    joint: Joint, material: Material, foundation: bool, steps: int
) -> None:
    def cycle(tolerance: float) -> ContactCycle:
        settings = ContactModel(foundation=foundation, tolerance=tolerance)
        system = clearance_system(CASE_B, joint, material, STEEL, np.pi, settings)
        return contact_cycle(system, settling_revolutions=0)

    assert ContactModel().tolerance == 1e-8
    usual, fine = cycle(1e-8), cycle(1e-11)
    apart = np.abs(usual.motion.force - fine.motion.force).max()
    assert apart < 1e-4 * fine.motion.force_magnitude.max()
    assert usual.steps < steps


def test_looking_up_between_steps_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    system = clearance_system(CASE_A, JOINT, POLYMER, STEEL, np.pi)
    parts: list[float] = []
    whole = contact_cycle(system, settling_revolutions=0, progress=parts.append)
    assert parts == [1.0]
    monkeypatch.setattr("rigapp_model.contact.impact.STEPS_AT_ONCE", 50)
    looked = contact_cycle(system, settling_revolutions=0, progress=parts.append)
    assert len(parts) > 20
    np.testing.assert_array_equal(looked.motion.force, whole.motion.force)
    assert looked.contact_fraction == whole.contact_fraction
    np.testing.assert_array_equal(looked.impacts.time, whole.impacts.time)


def test_steps_without_end_are_refused_with_advice(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rigapp_model.contact.impact.MOST_STEPS", 40)
    monkeypatch.setattr("rigapp_model.contact.impact.STEPS_AT_ONCE", 20)
    system = clearance_system(CASE_A, JOINT, POLYMER, STEEL, np.pi)
    with pytest.raises(ModelError, match=r"steps is 40: too many by .* s; raise the tolerance"):
        contact_cycle(system)


def absolute_coordinates(system, time: float, y: np.ndarray, impact_speed: float):  # type: ignore[no-untyped-def]
    """Return the derivative of (x2, y2, phi2, x3, rates) with the ideal joint by multipliers."""
    m, joint, settings = system.mechanism, system.joint, system.contact
    x2, y2, phi, x3, *rates = y
    v2x, v2y, w2, v3 = rates
    half = 0.5 * m.follower_length
    e, n = np.array([np.cos(phi), np.sin(phi)]), np.array([-np.sin(phi), np.cos(phi)])
    angle, w = system.start_angle + system.speed * time, system.speed
    pin = m.crank_radius * np.array([np.cos(angle), np.sin(angle)])
    pin_v = w * np.array([-pin[1], pin[0]])
    centre, centre_v = np.array([x2, y2]), np.array([v2x, v2y])
    at_crank = system.location == "crank"
    side = -1.0 if at_crank else 1.0
    inner, inner_v, inner_w = (
        (pin, pin_v, w) if at_crank else (np.array([x3, 0.0]), np.array([v3, 0.0]), 0.0)
    )
    offset = inner - (centre + side * half * e)
    depth = np.hypot(*offset) - joint.clearance
    force = np.zeros(2)
    contact = inner
    if depth > 0.0:
        out = offset / np.hypot(*offset)
        along = np.array([-out[1], out[0]])
        contact = inner + joint.pin_radius * out
        arm = contact - centre
        follower_v = centre_v + w2 * np.array([-arm[1], arm[0]])
        reach = contact - inner
        pin_surface_v = inner_v + inner_w * np.array([-reach[1], reach[0]])
        relative = pin_surface_v - follower_v
        rate, slip = relative @ out, relative @ along
        damping = max(0.0, 1.0 + settings.hysteresis * rate / impact_speed)
        normal = system.elastic * depth**1.5 * damping
        low, high = settings.friction_ramp
        ramp = np.sign(slip) * np.clip((abs(slip) - low) / (high - low), 0.0, 1.0)
        force = normal * out + joint.friction_coefficient * ramp * normal * along
    arm = contact - centre
    spring = -m.spring.stiffness * (x3 - m.spring.free_position) if m.spring else 0.0
    mass = np.diag([m.follower_mass, m.follower_mass, m.follower_inertia, m.moving_mass])
    load = np.array(
        [
            force[0] + m.follower_mass * m.gravity[0],
            force[1] + m.follower_mass * m.gravity[1],
            arm[0] * force[1] - arm[1] * force[0],
            spring + m.moving_mass * m.gravity[0] - (0.0 if at_crank else force[0]),
        ]
    )
    if at_crank:
        rows = np.array([[1.0, 0.0, half * n[0], -1.0], [0.0, 1.0, half * n[1], 0.0]])
        right = half * w2 * w2 * e
    else:
        rows = np.array([[1.0, 0.0, -half * n[0], 0.0], [0.0, 1.0, -half * n[1], 0.0]])
        right = -half * w2 * w2 * e - w * w * pin
    system_matrix = np.block([[mass, rows.T], [rows, np.zeros((2, 2))]])
    growth = np.linalg.solve(system_matrix, np.concatenate([load, right]))[:4]
    return np.concatenate([rates, growth])


@pytest.mark.parametrize(
    ("mechanism", "joint", "location", "speed", "duration", "law"),
    [
        (CASE_B, JOINT, "crank", np.pi, 0.08, "lankarani-nikravesh"),
        (replace(CASE_B, gravity=(1.0, -9.81)), ROUGH, "crank", np.pi, 0.08, "flores"),
        (FAST, replace(BEARING, friction_coefficient=0.1), "wrist", 100.0, 0.004, "flores"),
    ],
)
def test_an_independent_integration_in_absolute_coordinates(
    mechanism: Mechanism, joint: Joint, location: str, speed: float, duration: float, law: str
) -> None:
    settings = ContactModel(law=law, impact_speed_floor=0.01)
    system = clearance_system(
        mechanism, joint, POLYMER, STEEL, speed, settings, location, start_angle=0.7
    )
    start = settled_state(system)
    start = replace(start, slider_velocity=start.slider_velocity + 1e-3)
    times = np.linspace(0.0, duration, 41)
    cycle = integrate_contact(system, start, times)
    assert cycle.contact_is_continuous
    first = cycle.motion
    y = [
        *first.follower_position[:, 0],
        first.follower_angle[0],
        first.slider_position[0],
        *first.follower_velocity[:, 0],
        first.follower_speed[0],
        first.slider_velocity[0],
    ]
    other = solve_ivp(
        lambda t, y: absolute_coordinates(system, t, y, 0.01),
        (0.0, duration),
        y,
        method="DOP853",
        rtol=1e-11,
        atol=1e-13,
        t_eval=times,
    )
    assert other.success
    depth = system.scales[0]
    mine = np.vstack([first.follower_position, first.follower_angle, first.slider_position])
    scale = np.array([[1.0], [1.0], [1.0 / mechanism.follower_length], [1.0]]) * depth
    assert (np.abs(mine - other.y[:4]) / scale).max() < 1e-6
    assert np.ptp(cycle.penetration) > 0.05 * depth


def test_newtons_laws_hold_at_every_sample() -> None:
    for location in ("crank", "wrist"):
        mechanism = replace(CASE_B, gravity=(0.5, -9.81))
        system = clearance_system(
            mechanism, ROUGH, POLYMER, STEEL, np.pi, location=location, start_angle=0.3
        )
        motion = contact_cycle(system, settling_revolutions=0).motion
        peak = 1e-9 * motion.force_magnitude.max()
        m, g = mechanism, np.array(mechanism.gravity)[:, None]
        slider = motion.wrist_force[0] + motion.spring_force + m.moving_mass * g[0]
        np.testing.assert_allclose(slider, m.moving_mass * motion.slider_acceleration, atol=peak)
        follower = motion.force - motion.wrist_force + m.follower_mass * g
        np.testing.assert_allclose(
            follower, m.follower_mass * motion.follower_centre_acceleration, atol=peak
        )
        pin = 2.0 * motion.crank_position - motion.follower_position
        wrist = -motion.follower_position.copy()
        wrist[0] += motion.slider_position
        moment = (
            motion.friction_moment
            + pin[0] * motion.force[1]
            - pin[1] * motion.force[0]
            - wrist[0] * motion.wrist_force[1]
            + wrist[1] * motion.wrist_force[0]
        )
        if location == "crank":
            expected = m.follower_inertia * motion.follower_acceleration
            np.testing.assert_allclose(moment, expected, atol=peak)


def test_a_perfectly_elastic_joint_keeps_its_energy() -> None:
    settings = ContactModel(law="flores", restitution=1.0, tolerance=1e-6)
    system = clearance_system(CASE_B, JOINT, POLYMER, STEEL, 0.0, settings, start_angle=1.0)
    start = replace(centred_state(system), follower_speed=0.5)
    cycle = integrate_contact(system, start, np.linspace(0.0, 1.0, 501))
    assert len(cycle.impacts) > 10
    assert 0.05 < cycle.contact_fraction < 0.95
    m = cycle.motion
    spring = 0.5 * 525.0 * (m.slider_position - CASE_B.spring.free_position) ** 2
    contact = 0.4 * system.elastic * np.maximum(cycle.penetration, 0.0) ** 2.5
    kinetic = 0.5 * (
        CASE_B.moving_mass * m.slider_velocity**2
        + CASE_B.follower_mass * np.sum(m.follower_velocity**2, axis=0)
        + CASE_B.follower_inertia * m.follower_speed**2
    )
    energy = kinetic + spring + contact
    assert np.ptp(energy - energy[0]) < 1e-3 * np.ptp(kinetic)


@pytest.mark.parametrize(
    ("law", "error"),
    [
        ("elements", 0.002),
        ("liu", 0.002),
        ("pereira", 0.05),
        ("lankarani-nikravesh", 0.05),
        ("flores", 0.015),
    ],
)
def test_an_impact_gives_the_restitution_back(law: str, error: float) -> None:
    for restitution in (0.8, 0.9, 0.95):
        settings = ContactModel(law=law, restitution=restitution, tolerance=1e-6)
        system = clearance_system(CASE_A, JOINT, POLYMER, STEEL, 0.0, settings)
        start = replace(centred_state(system), slider_velocity=0.1)
        cycle = integrate_contact(system, start, np.array([0.0, 0.0055, 0.0125]))
        assert len(cycle.impacts) == 1
        assert cycle.impacts.speed[0] == pytest.approx(0.1, rel=1e-9)
        assert not cycle.final_state.touching
        assert -cycle.final_state.slider_velocity / 0.1 == pytest.approx(restitution, abs=error)


def test_friction_moves_the_contact_point_and_costs_the_drive() -> None:
    system = clearance_system(CASE_B, ROUGH, POLYMER, STEEL, np.pi)
    cycle = contact_cycle(system, 720, revolutions=2)
    assert cycle.contact_is_continuous
    other = inverse_dynamics(
        CASE_B, cycle.motion.angle, np.pi, clearance=JOINT.clearance, contact=ROUGH
    )
    assert np.degrees(cycle.contact_angle.mean()) == pytest.approx(-7.4, abs=0.5)
    assert cycle.motion.force_magnitude.mean() == pytest.approx(
        other.force_magnitude.mean(), rel=3e-3
    )
    assert cycle.motion.drive_torque.mean() == pytest.approx(other.drive_torque.mean(), rel=0.02)


def test_a_run_cut_in_two_is_the_same_run() -> None:
    system = clearance_system(CASE_A, JOINT, POLYMER, STEEL, np.pi)
    start = settled_state(system)
    times = np.linspace(0.0, 1.5, 301)
    whole = integrate_contact(system, start, times)
    first = integrate_contact(system, start, times[:201])
    assert 0.0 < first.contact_fraction < 1.0
    moved = replace_start(system, times[200])
    second = integrate_contact(moved, first.final_state, times[200:] - times[200])
    np.testing.assert_allclose(
        second.motion.slider_position[:20], whole.motion.slider_position[200:220], atol=2e-8
    )


def replace_start(system, time: float):  # type: ignore[no-untyped-def]
    """Return the system with its start angle moved on by a time."""
    return clearance_system(
        system.mechanism,
        system.joint,
        POLYMER,
        STEEL,
        system.speed,
        system.contact,
        start_angle=system.start_angle + system.speed * time,
    )


def test_flight_begins_in_the_centre_and_ends_at_the_wall() -> None:
    system = clearance_system(CASE_B, JOINT, POLYMER, STEEL, np.pi)
    cycle = integrate_contact(system, centred_state(system), np.linspace(0.0, 0.05, 51))
    assert cycle.penetration[0] == pytest.approx(-JOINT.clearance, rel=1e-9)
    assert not cycle.touching[0]
    assert cycle.impacts.time[0] > 0.005
    assert np.hypot(*cycle.motion.force[:, 0]) == 0.0


def table_of(profile: WornSurface | None) -> tuple[np.ndarray, np.ndarray]:
    system = clearance_system(CASE_B, JOINT, POLYMER, STEEL, np.pi, profile=profile)
    return system.vector, system.table


def test_the_gap_to_a_shifted_circle_is_exact() -> None:
    shift = np.array([0.2e-3, 0.1e-3])
    angle = np.linspace(-np.pi, np.pi, 181)
    u = -np.array([np.cos(angle), np.sin(angle)])
    along = shift @ u
    radius = along + np.sqrt(10e-3**2 - shift @ shift + along**2)
    vector, table = table_of(WornSurface(angle, radius - 10e-3))
    for turn in np.linspace(0.0, 2.0 * np.pi, 23):
        d = 0.6e-3 * np.array([np.cos(turn), np.sin(turn)])
        away = d - shift
        distance = np.hypot(*away)
        deep, nx, ny = laws.nearest_on_profile(vector, table, *d)
        assert deep == pytest.approx(distance + 9.5e-3 - 10e-3, abs=1e-9)
        np.testing.assert_allclose((nx, ny), away / distance, atol=2e-5)


def test_even_wear_is_a_larger_bushing() -> None:
    settings = ContactModel(stiffness=3e8, tolerance=1e-6, foundation=False)
    angle = np.deg2rad(np.arange(-180.0, 180.0, 2.0))
    worn = WornSurface(angle, np.full(len(angle), 0.2e-3))
    by_profile = clearance_system(CASE_B, ROUGH, POLYMER, STEEL, np.pi, settings, profile=worn)
    larger = replace(ROUGH, bushing_radius=10.2e-3)
    by_radius = clearance_system(CASE_B, larger, POLYMER, STEEL, np.pi, settings)
    start = settled_state(by_radius)
    times = np.linspace(0.0, 0.2, 101)
    one, two = (integrate_contact(s, start, times) for s in (by_profile, by_radius))
    np.testing.assert_allclose(one.motion.force_magnitude, two.motion.force_magnitude, rtol=1e-3)


def test_a_groove_worn_at_the_contact_point_lengthens_the_follower() -> None:
    angle = np.deg2rad(np.arange(-180.0, 180.0, 2.0))
    depth = 0.3e-3 * np.exp(-((np.degrees(angle) / 30.0) ** 2))
    system = clearance_system(
        CASE_B, JOINT, POLYMER, STEEL, np.pi, profile=WornSurface(angle, depth)
    )
    shoulder = np.deg2rad(np.linspace(-60.0, 60.0, 4001))
    groove = 0.3e-3 * np.exp(-((np.degrees(shoulder) / 30.0) ** 2))
    rho, sine = 10e-3 + groove, np.sin(shoulder)
    reach = (rho * np.cos(shoulder) - np.sqrt(9.5e-3**2 - (rho * sine) ** 2)).min()
    cycle = contact_cycle(system)
    assert cycle.contact_is_continuous
    other = inverse_dynamics(CASE_B, cycle.motion.angle, np.pi, clearance=reach)
    change = cycle.motion.slider_position - other.slider_position
    assert (change / cycle.penetration).min() > 1.0
    assert (change / cycle.penetration).max() < 1.0 / np.cos(np.deg2rad(40.0))
    assert np.abs(cycle.motion.force_magnitude - other.force_magnitude).max() < 0.2


def test_the_foundation_bears_the_integral_of_its_pressure() -> None:
    settings = ContactModel(foundation=True)
    system = clearance_system(CASE_B, JOINT, POLYMER, STEEL, np.pi, settings)
    depth = 60e-6
    d = -(JOINT.clearance + depth)
    fx, fy, moment, turned, deep = laws.foundation_force(system.vector, system.table, d, 0.0)
    assert deep == pytest.approx(depth, rel=1e-9)
    assert laws.foundation_force(system.vector, system.table, 0.4e-3, 0.2e-3) == (0.0,) * 5
    turn = np.linspace(-0.5, 0.5, 200001)
    ex, ey = -10e-3 * np.cos(turn) - d, -10e-3 * np.sin(turn)
    distance = np.hypot(ex, ey)
    pressure = foundation_modulus(500e6, 0.38, 10e-3) * np.maximum(0.0, 9.5e-3 - distance)
    expected = np.trapezoid(pressure * ex / distance, turn) * 10e-3 * JOINT.bushing_width
    assert fx == pytest.approx(expected, rel=2e-3)
    assert (fy, moment) == pytest.approx((0.0, 0.0), abs=1e-9 * abs(fx))
    expected = np.trapezoid(
        pressure * (-10e-3 * np.cos(turn) * ex - 10e-3 * np.sin(turn) * ey) / distance, turn
    )
    assert turned == pytest.approx(expected * 10e-3 * JOINT.bushing_width, rel=2e-3)
    cycle = contact_cycle(system)
    other = inverse_dynamics(CASE_B, cycle.motion.angle, np.pi, clearance=JOINT.clearance)
    assert cycle.contact_is_continuous
    assert np.abs(cycle.motion.force_magnitude - other.force_magnitude).max() < 0.05


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: clearance_system(CASE_B, replace(JOINT, pin_radius=10e-3), STEEL, STEEL, 1.0),
         "larger than its pin"),
        (lambda: clearance_system(replace(CASE_B, slider_mass=0.0), JOINT, STEEL, STEEL, 1.0),
         "moving mass"),
        (lambda: clearance_system(CASE_B, JOINT, STEEL, STEEL, float("nan")), "speed"),
        (lambda: clearance_system(CASE_B, JOINT, STEEL, STEEL, 1.0, location="guide"), "crank or"),
        (lambda: ContactModel(restitution=1.2), "must not exceed 1"),
        (lambda: ContactModel(restitution=0.0), "greater than 0"),
        (lambda: ContactModel(friction_ramp=(1e-3, 1e-3)), "end must exceed"),
        (lambda: ContactModel(impact_speed_floor=0.0), "impact speed floor"),
        (lambda: ContactModel(tolerance=1.0), "tolerance"),
        (lambda: ContactModel(law="hertz"), "choose elements, pereira, liu, lankarani"),
        (lambda: ContactModel(restitution=0.005), "give 0.01 or more"),
        (lambda: WornSurface(np.arange(8.0), np.arange(8.0)), "within one turn"),
        (lambda: clearance_system(
            CASE_B, JOINT, STEEL, STEEL, 1.0, ContactModel(foundation=False),
            profile=WornSurface(np.linspace(-3.0, 3.0, 61),
                                3e-4 * np.exp(-4.0 * np.linspace(-3.0, 3.0, 61) ** 2))),
         "rounder than the pin"),
        (lambda: WornSurface(np.arange(4.0), np.arange(4.0)), "at least 8"),
        (lambda: contact_cycle(clearance_system(CASE_B, JOINT, STEEL, STEEL, 0.0)), "turns"),
        (lambda: contact_cycle(clearance_system(CASE_B, JOINT, STEEL, STEEL, 1.0), 0), "1 point"),
        (lambda: integrate_contact(
            clearance_system(CASE_B, JOINT, STEEL, STEEL, 1.0),
            ContactState(0.28, 0.0, 0.0, 0.0), [1.0, 0.5]), "increasing"),
    ],
)  # fmt: skip
def test_refusals(build, words: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(ModelError, match=words):
        build()
