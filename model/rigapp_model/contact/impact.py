"""Technique 3, non-continuous contact: pin and bushing as separate bodies.

The crank turns at a prescribed constant speed; slider and follower move freely under spring,
gravity and the contact force in the joint with clearance.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.contact import impact_kernel as kernel
from rigapp_model.contact import impact_motion as motion_of
from rigapp_model.contact.impact_system import ClearanceSystem, ContactState, settled_state
from rigapp_model.contact_law import ContactModel
from rigapp_model.dynamics import MechanismMotion
from rigapp_model.errors import ModelError, require_not_negative, require_positive
from rigapp_model.frames import into_frame

Array = NDArray[np.float64]

MOST_STEPS = 20_000_000  # ends a motion without a suitable step, in minutes
MOST_SWINGS = 3_000_000  # about as many steps: a minute or two
MOST_IMPACTS = 100_000  # 800 revolutions at 120 impacts: as many as one call may want
CONTINUOUS = 1e-12  # of a cycle: a shorter flight is rounding of the times of contact
STEPS_AT_ONCE = 20_000
"""Steps between two calls of ``progress``, which may stop the integration."""

# A longer step could miss a touch, or a rise and fall within one contact.
LONGEST_FLIGHT_TURN, LONGEST_FLIGHT_S = float(np.deg2rad(1.0)), 1e-3
LONGEST_CONTACT_TURN, LONGEST_CONTACT_S = float(np.deg2rad(5.0)), 1e-2
SHORTEST_PART = 1e-17
"""No step is so small a part of the time integrated over."""

FINER = 1e-2
"""Of a tolerance: the finer one that measures its error."""

ROUNDING = 2e-16
"""Least tolerance as a part of the mechanism's size: the resolution of double precision."""

FIRST_CONTACT_PART = 0.1
"""First step of a contact as a part of the time in which a contact swings."""


@dataclass(frozen=True, slots=True)
class Impacts:
    """Every beginning of a contact: time (s), crank angle (rad), normal speed (m/s).

    ``peak`` (N) is the greatest force of the contact that began, found between the samples too; of
    one that has not ended, up to the last sample.
    """

    time: Array
    angle: Array
    speed: Array
    peak: Array

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True, slots=True)
class ContactCycle:
    """Motion and contact at every sample, and integrals between them.

    ``motion`` as for the other techniques; its force is that of the pin on the follower.
    ``penetration`` (m) is negative in flight: the gap. ``contact_angle`` (rad) is where the pin is
    nearest to the bushing, in the follower frame from the point towards the crank. ``normal_force``
    (N) acts in the clearance joint. ``contact_fraction`` is the part of the recorded time in
    contact, exact between the samples. ``final_state`` is that at the last sample.

    ``sliding`` (m/s) is the speed at which the pin's surface slides on the bushing's where they
    touch, as friction takes it; 0 in flight. Between one of the times and the next, (m,): ``slip``
    (m), the distance slid in contact; ``work`` (J), normal force times slip; ``pressed`` (2, m), J,
    the same with the direction in which the pin presses, from the bushing's centre towards the
    crank, and across. They are integrals over all steps. ``greatest_force`` (N) is that between the
    samples too.
    """

    time: Array
    motion: MechanismMotion
    touching: NDArray[np.bool_]
    penetration: Array
    contact_angle: Array
    normal_force: Array
    sliding: Array
    slip: Array
    work: Array
    pressed: Array
    greatest_force: float
    contact_fraction: float
    impacts: Impacts
    final_state: ContactState
    steps: int

    @property
    def contact_is_continuous(self) -> bool:
        """Return whether the pin never left the bushing."""
        return self.contact_fraction >= 1.0 - CONTINUOUS


def contact_cycle(
    system: ClearanceSystem,
    points: int = 360,
    revolutions: int = 1,
    settling_revolutions: int = 1,
    start: ContactState | None = None,
    progress: Callable[[float], None] | None = None,
) -> ContactCycle:
    """Run the mechanism and record whole revolutions on ``points`` equal crank angles each.

    The first ``settling_revolutions`` are not recorded. start: None starts in contact (see
    ``settled_state``); progress: called with the part done, may raise. Raises ModelError at
    standstill or when the integration fails.
    """
    if points < 1 or revolutions < 1 or settling_revolutions < 0:
        raise ModelError(
            say("points and revolutions"),
            (points, revolutions, settling_revolutions),
            say("give at least 1 point, 1 revolution and 0 settling revolutions"),
        )
    if system.speed == 0.0:
        raise ModelError("speed", 0.0, say("a revolution needs a crank that turns"), "rad/s")
    period = 2.0 * np.pi / abs(system.speed)
    _check_duration(system, (settling_revolutions + revolutions) * period)
    first = settling_revolutions * period
    times = first + period / points * np.arange(points * revolutions + 1)
    begin = start or settled_state(system)
    return integrate_contact(system, begin, times, drop_last=True, progress=progress)


def numerical_noise(
    system: ClearanceSystem,
    cycle: ContactCycle,
    points: int,
    progress: Callable[[float], None] | None = None,
) -> float:
    """Return the error of the force of a cycle on ``points`` angles by the tolerance, N RMS.

    Compared with the same revolution at the default tolerance, or at a hundredth of a finer one.
    NaN where that one loses contact: no two runs of a chaotic motion are alike.
    """
    settings = system.contact
    finer = min(ContactModel().tolerance, FINER * settings.tolerance)
    fine = contact_cycle(
        replace(system, contact=replace(settings, tolerance=finer)), points, progress=progress
    )
    if not fine.contact_is_continuous:
        return float("nan")
    apart = cycle.motion.force - fine.motion.force
    return float(np.sqrt(np.mean(np.sum(apart**2, axis=0))))


def integrate_contact(
    system: ClearanceSystem,
    start: ContactState,
    times: ArrayLike,
    drop_last: bool = False,
    progress: Callable[[float], None] | None = None,
) -> ContactCycle:
    """Integrate from time 0 and sample at ``times`` (s, increasing, from 0 on).

    Contact is tallied and impacts are recorded from the first to the last of ``times``;
    ``drop_last`` leaves the last one out of the samples (the end of a cycle is its beginning).
    Raises ModelError when the step becomes too small or the steps too many.
    """
    moments = np.ascontiguousarray(times, dtype=np.float64)
    if moments.ndim != 1 or len(moments) < 2 or np.any(np.diff(moments) <= 0.0):
        raise ModelError("times", moments.shape, say("give at least two increasing times"))
    require_not_negative("times", float(moments[0]), "s")
    require_positive("times", float(moments[-1]), "s")
    state = np.zeros(motion_of.STATE)
    state[: motion_of.COORDINATES] = (
        start.slider_position,
        start.follower_angle,
        start.slider_velocity,
        start.follower_speed,
    )
    kernel.refer(system.vector, 0.0, -1.0, state)
    course = np.zeros(kernel.COURSE)
    course[kernel.IN_TOUCH], course[kernel.BEGAN_AT] = float(start.touching), start.impact_speed
    course[kernel.PRESENT] = -1.0
    samples = np.empty((len(moments), kernel.SAMPLE))
    impacts = np.empty((MOST_IMPACTS, kernel.IMPACT))
    tally = np.zeros(kernel.TALLY)
    control = _control(system, moments)
    course[kernel.NEXT_STEP] = control[kernel.FIRST_CONTACT]
    workspace = kernel.make_workspace()
    status = kernel.UNFINISHED
    while status == kernel.UNFINISHED and tally[kernel.STEPS] < MOST_STEPS:
        status = kernel.integrate(
            system.vector,
            system.table,
            system.options,
            state,
            course,
            control,
            moments,
            STEPS_AT_ONCE,
            samples,
            impacts,
            tally,
            workspace,
        )
        if progress is not None:
            progress(float(course[kernel.TIME] / moments[-1]))
    kernel.refer(system.vector, float(course[kernel.TIME]), 1.0, state)
    _check(status, float(course[kernel.TIME]), state)
    count = min(int(tally[kernel.IMPACTS]), MOST_IMPACTS)
    at = impacts[:count, kernel.IMPACT_TIME].copy()
    kept = slice(0, len(moments) - 1 if drop_last else len(moments))
    rows = np.ascontiguousarray(samples[kept].T)
    motion = _motion(system, moments[kept], rows)
    passed = np.diff(samples[:, motion_of.SLID : motion_of.STATE], axis=0).T
    return ContactCycle(
        time=moments[kept],
        motion=motion,
        touching=rows[kernel.TOUCHING] > 0.5,
        penetration=rows[kernel.DEPTH],
        contact_angle=_contact_angle(rows),
        normal_force=rows[kernel.NORMAL],
        sliding=rows[kernel.SLIDING],
        slip=np.maximum(passed[0], 0.0),
        work=np.maximum(passed[1], 0.0),
        pressed=passed[2:],
        greatest_force=max(float(tally[kernel.GREATEST]), float(motion.force_magnitude.max())),
        contact_fraction=float(tally[kernel.TOUCH_TIME] / (moments[-1] - moments[0])),
        impacts=Impacts(
            time=at,
            angle=system.start_angle + system.speed * at,
            speed=impacts[:count, kernel.IMPACT_SPEED].copy(),
            peak=impacts[:count, kernel.IMPACT_PEAK].copy(),
        ),
        final_state=ContactState(
            slider_position=float(state[motion_of.X]),
            follower_angle=float(state[motion_of.THETA]),
            slider_velocity=float(state[motion_of.X_RATE]),
            follower_speed=float(state[motion_of.THETA_RATE]),
            touching=bool(course[kernel.IN_TOUCH] > 0.5),
            impact_speed=float(course[kernel.BEGAN_AT]),
        ),
        steps=int(tally[kernel.STEPS]),
    )


def _check_duration(system: ClearanceSystem, duration: float) -> None:
    """Refuse a crank so slow that the contact swings too often in the time (s) to integrate."""
    depth, _, pace, _ = system.scales
    swings = duration * float(pace / depth) / (2.0 * np.pi)
    if swings > MOST_SWINGS:
        raise ModelError(
            "speed",
            system.speed,
            say(
                (
                    "in the {:g} s to integrate the contact would swing {:.1e} times, {:.0e} at"
                    " most; at this speed inertia is negligible: use the technique continuous"
                ),
                duration,
                swings,
                MOST_SWINGS,
            ),
            "rad/s",
        )


def _control(system: ClearanceSystem, moments: Array) -> Array:
    """Return the control of the steps; tolerances never below the rounding of positions."""
    mechanism, settings = system.mechanism, system.contact
    depth, _, pace, _ = system.scales
    reach = mechanism.crank_radius + mechanism.follower_length
    tolerance = max(settings.tolerance, ROUNDING * reach / float(depth))
    turn = abs(system.speed)
    control = np.empty(kernel.CONTROL)
    control[:4] = tolerance * system.scales
    control[kernel.SHORTEST] = SHORTEST_PART * moments[-1]
    control[kernel.LONGEST_FLIGHT] = min(
        LONGEST_FLIGHT_S, LONGEST_FLIGHT_TURN / turn if turn else np.inf
    )
    control[kernel.LONGEST_CONTACT] = min(
        LONGEST_CONTACT_S, LONGEST_CONTACT_TURN / turn if turn else np.inf
    )
    control[kernel.FIRST_CONTACT] = FIRST_CONTACT_PART * depth / pace
    control[kernel.FLOOR] = settings.impact_speed_floor
    control[kernel.TALLY_FROM] = moments[0]
    return control


def _check(status: int, time: float, state: Array) -> None:
    """Raise ModelError when the integration did not reach its end."""
    if status == kernel.UNFINISHED:
        raise ModelError("steps", MOST_STEPS, say("too many by {:g} s; raise the tolerance", time))
    if status == kernel.STEP_TOO_SMALL or not np.isfinite(state).all():
        raise ModelError(
            "step",
            say("too small"),
            say("no progress at {:g} s; check masses and stiffness, or raise the tolerance", time),
        )


def _contact_angle(rows: Array) -> Array:
    """Return the normal's direction in the follower frame from the point towards the crank."""
    normal = np.arctan2(rows[kernel.NORMAL_Y], rows[kernel.NORMAL_X])
    turned = normal - rows[motion_of.THETA] - np.pi
    return np.asarray((turned + np.pi) % (2.0 * np.pi) - np.pi)


def _motion(system: ClearanceSystem, times: Array, rows: Array) -> MechanismMotion:
    """Return the samples as a motion, with the forces that the clearance joint does not give."""
    m = system.mechanism
    angle = system.start_angle + system.speed * times
    c1, s1 = np.cos(angle), np.sin(angle)
    c2, s2 = np.cos(rows[motion_of.THETA]), np.sin(rows[motion_of.THETA])
    w, w2, al2 = system.speed, rows[motion_of.THETA_RATE], rows[kernel.THETA_GROWTH]
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
    slider = [np.array([rows[i], still]) for i in (motion_of.X, motion_of.X_RATE, kernel.X_GROWTH)]
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
        spring = -m.spring.stiffness * (rows[motion_of.X] - m.spring.free_position)
    crank_a = 0.5 * pin_a
    crank_weight = m.crank_mass * gravity
    torque = (
        pin[0] * force[1]
        - pin[1] * force[0]
        + moment
        - 0.5 * (pin[0] * crank_weight[1] - pin[1] * crank_weight[0])
    )
    return MechanismMotion(
        angle=angle,
        speed=np.full_like(angle, w),
        acceleration=still,
        follower_angle=rows[motion_of.THETA],
        follower_speed=w2,
        follower_acceleration=al2,
        crank_position=0.5 * pin,
        crank_velocity=0.5 * pin_v,
        crank_acceleration=crank_a,
        follower_position=bodies[0],
        follower_velocity=bodies[1],
        follower_centre_acceleration=bodies[2],
        slider_position=rows[motion_of.X],
        slider_velocity=rows[motion_of.X_RATE],
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
