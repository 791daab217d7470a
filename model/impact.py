"""Technique 3, non-continuous contact: pin and bushing as separate bodies.

The crank turns at a prescribed constant speed; slider and follower move freely under spring,
gravity and the contact force in the joint with clearance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from model import impact_kernel as kernel
from model.dynamics import Motion
from model.errors import ModelError, require_not_negative, require_positive
from model.frames import into_frame
from model.impact_system import ClearanceSystem, ContactState, settled_state

Array = NDArray[np.float64]

MOST_STEPS = 20_000_000
MOST_IMPACTS = 100_000
LONGEST_STEP_TURN = float(np.deg2rad(1.0))
LONGEST_STEP_S = 1e-3


@dataclass(frozen=True, slots=True)
class Impacts:
    """Hold every beginning of a contact: time (s), crank angle (rad), normal speed (m/s)."""

    time: Array
    angle: Array
    speed: Array

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True, slots=True)
class ContactCycle:
    """Hold motion and contact at every sample, and what happened between them.

    ``motion`` as for the other techniques; its force is that of the pin on the follower.
    ``penetration`` (m) is negative in flight: the gap. ``contact_angle`` (rad) is where the pin is
    nearest to the bushing, in the follower frame from the point towards the crank. ``normal_force``
    (N) acts in the clearance joint. ``contact_fraction`` is the part of the recorded time in
    contact, exact between the samples. ``final_state`` is that at the last sample.
    """

    time: Array
    motion: Motion
    touching: NDArray[np.bool_]
    penetration: Array
    contact_angle: Array
    normal_force: Array
    contact_fraction: float
    impacts: Impacts
    final_state: ContactState
    steps: int

    @property
    def contact_is_continuous(self) -> bool:
        """Return whether the pin never left the bushing."""
        return self.contact_fraction >= 1.0 - 1e-12


def contact_cycle(
    system: ClearanceSystem,
    points: int = 360,
    revolutions: int = 1,
    settling_revolutions: int = 1,
    start: ContactState | None = None,
) -> ContactCycle:
    """Run the mechanism and record whole revolutions on ``points`` equal crank angles each.

    The first ``settling_revolutions`` are not recorded. start: None starts in contact (see
    ``settled_state``). Raises ModelError at standstill or when the integration fails.
    """
    if points < 1 or revolutions < 1 or settling_revolutions < 0:
        raise ModelError(
            "points and revolutions",
            (points, revolutions, settling_revolutions),
            "give at least 1 point, 1 revolution and 0 settling revolutions",
        )
    if system.speed == 0.0:
        raise ModelError("speed", 0.0, "a revolution needs a crank that turns", "rad/s")
    period = 2.0 * np.pi / abs(system.speed)
    first = settling_revolutions * period
    times = first + period / points * np.arange(points * revolutions + 1)
    return integrate_contact(system, start or settled_state(system), times, drop_last=True)


def integrate_contact(
    system: ClearanceSystem, start: ContactState, times: ArrayLike, drop_last: bool = False
) -> ContactCycle:
    """Integrate from time 0 and sample at ``times`` (s, increasing, from 0 on).

    Contact is tallied and impacts are recorded from the first to the last of ``times``;
    ``drop_last`` leaves the last one out of the samples (the end of a cycle is its beginning).
    Raises ModelError when the step becomes too small or the steps too many.
    """
    moments = np.ascontiguousarray(times, dtype=np.float64)
    if moments.ndim != 1 or len(moments) < 2 or np.any(np.diff(moments) <= 0.0):
        raise ModelError("times", moments.shape, "give at least two increasing times")
    require_not_negative("times", float(moments[0]), "s")
    require_positive("times", float(moments[-1]), "s")
    state = np.array(
        [
            start.slider_position,
            start.follower_angle,
            start.slider_velocity,
            start.follower_speed,
        ]
    )
    begin = np.array([0.0, start.impact_speed, float(start.touching)])
    longest = LONGEST_STEP_S
    if system.speed != 0.0:
        longest = min(longest, LONGEST_STEP_TURN / abs(system.speed))
    control = np.array(
        [
            *(system.contact.tolerance * system.scales),
            longest,
            system.contact.impact_speed_floor,
            moments[0],
        ]
    )
    samples = np.empty((len(moments), kernel.SAMPLE))
    impacts = np.empty((MOST_IMPACTS, 2))
    tally = np.empty(kernel.TALLY)
    status = kernel.integrate(
        system.vector,
        system.table,
        system.options,
        state,
        begin,
        control,
        moments,
        MOST_STEPS,
        samples,
        impacts,
        tally,
    )
    _check(status, float(tally[kernel.LAST_TIME]), state)
    count = min(int(tally[kernel.IMPACTS]), MOST_IMPACTS)
    at = impacts[:count, kernel.IMPACT_TIME].copy()
    kept = slice(0, len(moments) - 1 if drop_last else len(moments))
    rows = np.ascontiguousarray(samples[kept].T)
    motion = _motion(system, moments[kept], rows)
    return ContactCycle(
        time=moments[kept],
        motion=motion,
        touching=rows[kernel.TOUCHING] > 0.5,
        penetration=rows[kernel.DEPTH],
        contact_angle=_contact_angle(rows),
        normal_force=rows[kernel.NORMAL],
        contact_fraction=float(tally[kernel.TOUCH_TIME] / (moments[-1] - moments[0])),
        impacts=Impacts(
            time=at,
            angle=system.start_angle + system.speed * at,
            speed=impacts[:count, kernel.IMPACT_SPEED].copy(),
        ),
        final_state=ContactState(
            slider_position=float(state[kernel.X]),
            follower_angle=float(state[kernel.THETA]),
            slider_velocity=float(state[kernel.X_RATE]),
            follower_speed=float(state[kernel.THETA_RATE]),
            touching=bool(tally[kernel.LAST_TOUCHING] > 0.5),
            impact_speed=float(tally[kernel.LAST_IMPACT_SPEED]),
        ),
        steps=int(tally[kernel.STEPS]),
    )


def _check(status: int, time: float, state: Array) -> None:
    """Raise ModelError when the integration did not reach its end."""
    if status == kernel.TOO_MANY_STEPS:
        raise ModelError("steps", MOST_STEPS, f"too many by {time:g} s; raise the tolerance")
    if status == kernel.STEP_TOO_SMALL or not np.isfinite(state).all():
        raise ModelError(
            "step",
            "too small",
            f"no progress at {time:g} s; check masses and stiffness, or raise the tolerance",
        )


def _contact_angle(rows: Array) -> Array:
    """Return the normal's direction in the follower frame from the point towards the crank."""
    normal = np.arctan2(rows[kernel.NORMAL_Y], rows[kernel.NORMAL_X])
    turned = normal - rows[kernel.THETA] - np.pi
    return np.asarray((turned + np.pi) % (2.0 * np.pi) - np.pi)


def _motion(system: ClearanceSystem, times: Array, rows: Array) -> Motion:
    """Return the samples as a Motion, with the forces that the clearance joint does not give."""
    m = system.mechanism
    angle = system.start_angle + system.speed * times
    c1, s1 = np.cos(angle), np.sin(angle)
    c2, s2 = np.cos(rows[kernel.THETA]), np.sin(rows[kernel.THETA])
    w, w2, al2 = system.speed, rows[kernel.THETA_RATE], rows[kernel.THETA_GROWTH]
    radial = np.array([c1, s1])
    tangent = np.array([-s1, c1])
    pin, pin_v, pin_a = (
        m.crank_radius * radial,
        m.crank_radius * w * tangent,
        -m.crank_radius * w * w * radial,
    )
    half = 0.5 * m.follower_length
    arm = half * np.array([c2, s2])
    arm_v = half * w2 * np.array([-s2, c2])
    arm_a = half * (al2 * np.array([-s2, c2]) - w2 * w2 * np.array([c2, s2]))
    still = np.zeros_like(angle)
    slider = [np.array([rows[i], still]) for i in (kernel.X, kernel.X_RATE, kernel.X_GROWTH)]
    at_crank = system.location == "crank"
    if at_crank:
        bodies = [slider[i] - (arm, arm_v, arm_a)[i] for i in range(3)]
    else:
        bodies = [(pin, pin_v, pin_a)[i] + (arm, arm_v, arm_a)[i] for i in range(3)]
    gravity = np.array(m.gravity)[:, None]
    inertial = m.follower_mass * (bodies[2] - gravity)
    held = rows[[kernel.FORCE_X, kernel.FORCE_Y]]
    force = held if at_crank else inertial - held
    wrist = held - inertial if at_crank else -held
    moment = still
    if at_crank:
        bushing = slider[0] - 2.0 * arm
        dx, dy = pin - bushing
        moment = rows[kernel.MOMENT] - (dx * force[1] - dy * force[0])
    spring = still
    if m.spring is not None:
        spring = -m.spring.stiffness * (rows[kernel.X] - m.spring.free_position)
    crank_a = 0.5 * pin_a
    crank_weight = m.crank_mass * gravity
    torque = (
        pin[0] * force[1]
        - pin[1] * force[0]
        + moment
        - 0.5 * (pin[0] * crank_weight[1] - pin[1] * crank_weight[0])
    )
    return Motion(
        angle=angle,
        speed=np.full_like(angle, w),
        acceleration=still,
        follower_angle=rows[kernel.THETA],
        follower_speed=w2,
        follower_acceleration=al2,
        crank_position=0.5 * pin,
        crank_velocity=0.5 * pin_v,
        crank_acceleration=crank_a,
        follower_position=bodies[0],
        follower_velocity=bodies[1],
        follower_centre_acceleration=bodies[2],
        slider_position=rows[kernel.X],
        slider_velocity=rows[kernel.X_RATE],
        slider_acceleration=rows[kernel.X_GROWTH],
        spring_force=spring,
        force=force,
        force_crank=into_frame(force, c1, s1),
        force_follower=into_frame(force, c2, s2),
        wrist_force=wrist,
        guide_force=-wrist[1] - m.moving_mass * m.gravity[1],
        bearing_force=m.crank_mass * crank_a - crank_weight + force,
        drive_torque=torque,
        friction_moment=moment,
    )
