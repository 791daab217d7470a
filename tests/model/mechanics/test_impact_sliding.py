"""Sliding and impacts of technique 3 against an integration that shares nothing with it.

Coordinates of both bodies, multipliers at the ideal joint, scipy's DOP853 with events at
every touch, and the velocities of the two surfaces' material points by finite differences.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rigapp_model.contact.ensemble import ensemble
from rigapp_model.contact.impact import integrate_contact
from rigapp_model.contact.impact_system import ClearanceSystem, ContactState, clearance_system
from rigapp_model.contact_law import ContactModel
from rigapp_model.parameters import Joint, Material, Mechanism, Spring

CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))
JOINT = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3)
ROUGH = replace(JOINT, friction_coefficient=0.13)
POLYMER, STEEL = Material(500e6, 0.38), Material(206e9, 0.29)


@dataclass
class Independent:
    """Integrate follower (x, y, angle) and slider (x) with forces written from the laws alone."""

    system: ClearanceSystem
    impact_speed: float = 1e-3

    def bodies(self, time: float, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """Return pin centre and bushing centre with their velocities."""
        m, s = self.system.mechanism, self.system
        angle = s.start_angle + s.speed * time
        pin = m.crank_radius * np.array([np.cos(angle), np.sin(angle)])
        pin_v = s.speed * np.array([-pin[1], pin[0]])
        arm = -0.5 * m.follower_length * np.array([np.cos(y[2]), np.sin(y[2])])
        return pin, pin_v, y[:2] + arm, y[4:6] + y[6] * np.array([-arm[1], arm[0]])

    def depth(self, time: float, y: np.ndarray) -> float:
        pin, _, bushing, _ = self.bodies(time, y)
        return float(np.hypot(*(pin - bushing)) - self.system.joint.clearance)

    def sliding(self, time: float, y: np.ndarray) -> float:
        """Return how fast a point of the pin's surface passes the bushing's surface there, m/s.

        Both points are carried with their bodies for a moment to either side.
        """
        pin, pin_v, bushing, bushing_v = self.bodies(time, y)
        out = (pin - bushing) / np.hypot(*(pin - bushing))
        point = pin + self.system.joint.pin_radius * out
        moment = 1e-7

        def carried(centre, velocity, speed, side):  # type: ignore[no-untyped-def]
            c, s = np.cos(speed * side), np.sin(speed * side)
            return centre + velocity * side + np.array([[c, -s], [s, c]]) @ (point - centre)

        moved = [
            carried(pin, pin_v, self.system.speed, side) - carried(bushing, bushing_v, y[6], side)
            for side in (moment, -moment)
        ]
        return float(((moved[0] - moved[1]) / (2.0 * moment)) @ np.array([-out[1], out[0]]))

    def forces(self, time: float, y: np.ndarray) -> tuple[float, float, np.ndarray]:
        """Return normal force, friction force and the direction of the normal."""
        s = self.system
        pin, pin_v, bushing, bushing_v = self.bodies(time, y)
        offset, rates = pin - bushing, pin_v - bushing_v
        out = offset / np.hypot(*offset)
        depth = np.hypot(*offset) - s.joint.clearance
        rate = float(rates @ out)
        damping = max(0.0, 1.0 + s.contact.hysteresis * rate / self.impact_speed)
        normal = self.elastic(depth) * damping
        slip = self.sliding(time, y)
        low, high = s.contact.friction_ramp
        ramp = np.sign(slip) * np.clip((abs(slip) - low) / (high - low), 0.0, 1.0)
        return normal, s.joint.friction_coefficient * float(ramp) * normal, out

    def elastic(self, depth: float) -> float:
        if depth <= 0.0:
            return 0.0
        law = self.system.elastic
        return law * depth**1.5 if isinstance(law, float) else float(law.force(depth))

    def derivative(self, time: float, y: np.ndarray, touching: bool) -> np.ndarray:
        m, s = self.system.mechanism, self.system
        half = 0.5 * m.follower_length
        e = np.array([np.cos(y[2]), np.sin(y[2])])
        n = np.array([-e[1], e[0]])
        force, turning = np.zeros(2), 0.0
        if touching:
            normal, rub, out = self.forces(time, y)
            force = normal * out + rub * np.array([-out[1], out[0]])
            arm = self.bodies(time, y)[0] + s.joint.pin_radius * out - y[:2]
            turning = arm[0] * force[1] - arm[1] * force[0]
        spring = -m.spring.stiffness * (y[3] - m.spring.free_position) if m.spring else 0.0
        mass = np.diag([m.follower_mass, m.follower_mass, m.follower_inertia, m.moving_mass])
        rows = np.array([[1.0, 0.0, half * n[0], -1.0], [0.0, 1.0, half * n[1], 0.0]])
        matrix = np.block([[mass, rows.T], [rows, np.zeros((2, 2))]])
        right = np.concatenate([force, [turning, spring], half * y[6] ** 2 * e])
        growth = np.linalg.solve(matrix, right)[:4]
        rates = np.zeros(2)
        if touching:
            rates = abs(self.sliding(time, y)) * np.array([1.0, normal]) * (normal > 0.0)
        return np.concatenate([y[4:8], growth, rates])

    def run(self, start: ContactState, end: float) -> tuple[np.ndarray, list[tuple[float, float]]]:
        """Return (slip, sliding work) at the end, and speed and peak of each impact."""
        half = 0.5 * self.system.mechanism.follower_length
        e = np.array([np.cos(start.follower_angle), np.sin(start.follower_angle)])
        x = np.array([start.slider_position, 0.0]) - half * e
        w = start.follower_speed
        v = np.array([start.slider_velocity, 0.0]) - half * w * np.array([-e[1], e[0]])
        y = np.array([*x, start.follower_angle, start.slider_position, *v, w,
                      start.slider_velocity, 0.0, 0.0])  # fmt: skip
        time, touching, impacts = 0.0, False, []
        while time < end:

            def crossing(t: float, z: np.ndarray, begin=time, sign=1 if touching else -1) -> float:  # type: ignore[no-untyped-def]
                # Just after a touch the depth is 0 but for rounding: that is no crossing.
                return sign * 1e-12 if t < begin + 1e-8 else self.depth(t, z)

            crossing.terminal, crossing.direction = True, -1.0 if touching else 1.0  # type: ignore[attr-defined]
            now = touching
            run = solve_ivp(
                lambda t, z, now=now: self.derivative(t, z, now),
                (time, end), y, "DOP853", rtol=1e-10, atol=1e-13, events=crossing,
                dense_output=True, max_step=1e-4 if touching else 1e-3,
            )  # fmt: skip
            if touching:
                moments = np.linspace(time, run.t[-1], 4001)
                sizes = [np.hypot(*self.forces(t, run.sol(t))[:2]) for t in moments]
                impacts[-1] = (impacts[-1][0], max(sizes))
            time, y = float(run.t[-1]), run.y[:, -1]
            if run.status == 1:
                touching = not touching
                if touching:
                    pin, pin_v, bushing, bushing_v = self.bodies(time, y)
                    out = (pin - bushing) / np.hypot(*(pin - bushing))
                    speed = float((pin_v - bushing_v) @ out)
                    self.impact_speed = max(speed, self.system.contact.impact_speed_floor)
                    impacts.append((speed, 0.0))
        return y[8:], impacts


@pytest.mark.long
@pytest.mark.parametrize(
    ("joint", "material", "law"),
    [
        pytest.param(JOINT, POLYMER, "flores", marks=pytest.mark.long),
        (ROUGH, POLYMER, "elements"),
        pytest.param(
            replace(JOINT, bushing_width=3e-3), POLYMER, "elements", marks=pytest.mark.long
        ),
        pytest.param(
            replace(JOINT, bushing_width=50e-3), POLYMER, "pereira", marks=pytest.mark.long
        ),
        pytest.param(JOINT, STEEL, "elements", marks=pytest.mark.long),
    ],
)
def test_slip_work_and_peaks_of_impacts_are_those_of_another_integration(
    joint: Joint, material: Material, law: str
) -> None:
    settings = ContactModel(law, restitution=0.7)
    system = clearance_system(CASE_A, joint, material, STEEL, np.pi, settings, start_angle=0.4)
    start = thrown(system)
    end = 0.02 if material == POLYMER else 0.0145
    times = np.linspace(0.0, end, 21)
    mine = integrate_contact(system, start, times)
    other = Independent(system)
    (slip, work), impacts = other.run(start, end)
    assert len(mine.impacts) == len(impacts) >= 2
    assert 0.02 < mine.contact_fraction < 0.95
    np.testing.assert_allclose(mine.impacts.speed, [v for v, _ in impacts], rtol=1e-4)
    np.testing.assert_allclose(mine.impacts.peak, [p for _, p in impacts], rtol=1e-3)
    assert mine.greatest_force == pytest.approx(max(p for _, p in impacts), rel=1e-3)
    assert mine.slip.sum() == pytest.approx(slip, rel=1e-3)
    assert mine.work.sum() == pytest.approx(work, rel=1e-3)
    # What the relative rotation alone would count is far off while the pin travels.
    turned = np.abs(mine.motion.slip_rate(joint.pin_radius)).mean() * end * mine.contact_fraction
    assert abs(mine.slip.sum() / turned - 1.0) > 0.1


def thrown(system: ClearanceSystem) -> ContactState:
    """Return a concentric pin and bushing with the follower thrown aside."""
    from rigapp_model.dynamics import inverse_dynamics

    motion = inverse_dynamics(system.mechanism, system.start_angle, system.speed)
    return ContactState(
        float(motion.slider_position),
        float(motion.follower_angle),
        float(motion.slider_velocity) + 0.15,
        float(motion.follower_speed) + 1.0,
    )


@pytest.mark.parametrize("joint", [JOINT, ROUGH])
def test_the_slip_is_that_of_the_rotation_while_the_spring_holds_contact(joint: Joint) -> None:
    from rigapp_model.contact.impact import contact_cycle

    cycle = contact_cycle(clearance_system(CASE_B, joint, POLYMER, STEEL, np.pi), 720)
    assert cycle.slip.sum() == pytest.approx(2.0 * np.pi * joint.pin_radius, rel=2e-3)
    counted = np.abs(cycle.motion.slip_rate(joint.pin_radius)) * cycle.normal_force
    assert cycle.work.sum() == pytest.approx(counted.mean() * 2.0, rel=2e-2)
    np.testing.assert_allclose(np.hypot(*cycle.pressed).sum(), cycle.work.sum(), rtol=1e-3)
    assert cycle.greatest_force >= cycle.motion.force_magnitude.max()


@pytest.mark.long
def test_the_greatest_force_does_not_depend_on_the_samples() -> None:
    few, many = (
        ensemble(clearance_system(CASE_A, JOINT, STEEL, STEEL, np.pi), 6, points)
        for points in (36, 3600)
    )
    np.testing.assert_allclose(few.peaks, many.peaks, rtol=1e-12)
    assert few.greatest_force.value == pytest.approx(float(many.greatest_force.value), rel=1e-9)
    assert few.sample.motion.force_magnitude.max() < 0.9 * few.sample.greatest_force
    assert few.peaks.max() >= few.sample.impacts.peak.max()
