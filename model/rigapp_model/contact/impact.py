"""Technique 3, contact that may be lost: pin and bushing as separate bodies.

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

MOST_STEPS = 20_000_000  # ends an integration that does not advance, after minutes
MOST_SWINGS = 3_000_000  # oscillations of the contact; about as many steps: a minute or two
MOST_IMPACTS = 100_000  # 800 revolutions with 120 impacts each
CONTINUOUS = 1e-12  # of a cycle: a shorter loss of contact is rounding
STEPS_AT_ONCE = 20_000
"""Steps between two calls of ``progress``, which may stop the integration."""

# Longest steps; longer ones could miss an impact, or a peak within one contact.
LONGEST_FLIGHT_TURN, LONGEST_FLIGHT_S = float(np.deg2rad(1.0)), 1e-3
LONGEST_CONTACT_TURN, LONGEST_CONTACT_S = float(np.deg2rad(5.0)), 1e-2
SHORTEST_PART = 1e-17
"""Smallest step, as a fraction of the integrated time."""

FINER = 1e-2
"""Factor from a tolerance to the finer one that measures its error."""

ROUNDING = 2e-16
"""Least tolerance as a fraction of the mechanism's size: the resolution of double precision."""

FIRST_CONTACT_PART = 0.1
"""First step of a contact as a fraction of its time constant (1 / angular frequency)."""


@dataclass(frozen=True, slots=True)
class Impacts:
    """Start of each contact: time (s), crank angle (rad), normal speed (m/s).

    ``peak`` (N) is the greatest force of that contact, also between the samples; if it lasts beyond
    the end, until the end.
    """

    time: Array
    angle: Array
    speed: Array
    peak: Array

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True, slots=True)
class ContactCycle:
    """Motion and contact at each sample, and integrals between samples.

    ``motion`` as for the other techniques; its force is that of the pin on the follower.
    ``penetration`` (m) is negative in flight: the gap. ``contact_angle`` (rad) is the point of the
    bushing nearest to the pin, in the follower frame from the point towards the crank.
    ``normal_force`` (N) acts in the clearance joint. ``contact_fraction`` is the fraction of the
    recorded time in contact, exact between the samples. ``final_state``: at the last sample.

    ``sliding`` (m/s) is the sliding speed of the pin's surface on the bushing's at the contact, as
    used for friction; 0 in flight. From each time to the next, (m,), integrated over all steps:
    ``slip`` (m), sliding distance in contact; ``work`` (J), normal force times slip; ``pressed``
    (2, m), J, work times the direction of the pin's pressure, along (from the bushing's centre
    towards the crank) and across. ``greatest_force`` (N): also between the samples.
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
        """Return whether contact is never lost."""
        return self.contact_fraction >= 1.0 - CONTINUOUS


def contact_cycle(
    system: ClearanceSystem,
    points: int = 360,
    revolutions: int = 1,
    settling_revolutions: int = 1,
    start: ContactState | None = None,
    progress: Callable[[float], None] | None = None,
) -> ContactCycle:
    """Simulate complete revolutions and sample each at ``points`` equal crank angles.

    The first ``settling_revolutions`` are not sampled. start: by default in contact (see
    ``settled_state``); progress: called with the fraction done, may raise. Raises ModelError for
    a speed of 0 or if the integration fails.
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
    """Return the numerical error of the force of a cycle with ``points`` angles, N RMS.

    By comparison with the same revolution at the default tolerance, or at a hundredth of that of
    the cycle if that is less. NaN if it loses contact: a chaotic motion is not reproducible.
    """
    settings = system.contact
    finer = min(ContactModel().tolerance, FINER * settings.tolerance)
    fine = contact_cycle(
        replace(system, contact=replace(settings, tolerance=finer)), points, progress=progress
    )
    if not fine.contact_is_continuous:
        return float("nan")
    difference = cycle.motion.force - fine.motion.force
    return float(np.sqrt(np.mean(np.sum(difference**2, axis=0))))


def integrate_contact(
    system: ClearanceSystem,
    start: ContactState,
    times: ArrayLike,
    drop_last: bool = False,
    progress: Callable[[float], None] | None = None,
) -> ContactCycle:
    """Integrate from time 0 and sample at ``times`` (s, increasing, at least 0).

    Contact statistics and impacts are those from the first to the last of ``times``;
    ``drop_last`` omits the last sample (the end of a cycle is its beginning). Raises ModelError if
    a step is too small or there are too many.
    """
    times_s = np.ascontiguousarray(times, dtype=np.float64)
    if times_s.ndim != 1 or len(times_s) < 2 or np.any(np.diff(times_s) <= 0.0):
        raise ModelError("times", times_s.shape, say("give at least two increasing times"))
    require_not_negative("times", float(times_s[0]), "s")
    require_positive("times", float(times_s[-1]), "s")
    state = np.zeros(motion_of.STATE)
    state[: motion_of.COORDINATES] = (
        start.slider_position,
        start.follower_angle,
        start.slider_velocity,
        start.follower_speed,
    )
    kernel.add_reference(system.vector, 0.0, -1.0, state)
    integrator = np.zeros(kernel.INTEGRATOR)
    integrator[kernel.IN_TOUCH], integrator[kernel.IMPACT_SPEED_NOW] = (
        float(start.touching),
        start.impact_speed,
    )
    integrator[kernel.PRESENT] = -1.0
    samples = np.empty((len(times_s), kernel.SAMPLE))
    impacts = np.empty((MOST_IMPACTS, kernel.IMPACT))
    tally = np.zeros(kernel.TALLY)
    control = _control(system, times_s)
    integrator[kernel.NEXT_STEP] = control[kernel.FIRST_CONTACT]
    workspace = kernel.make_workspace()
    status = kernel.UNFINISHED
    while status == kernel.UNFINISHED and tally[kernel.STEPS] < MOST_STEPS:
        status = kernel.integrate(
            system.vector,
            system.table,
            system.options,
            state,
            integrator,
            control,
            times_s,
            STEPS_AT_ONCE,
            samples,
            impacts,
            tally,
            workspace,
        )
        if progress is not None:
            progress(float(integrator[kernel.TIME] / times_s[-1]))
    kernel.add_reference(system.vector, float(integrator[kernel.TIME]), 1.0, state)
    _check(status, float(integrator[kernel.TIME]), state)
    count = min(int(tally[kernel.IMPACTS]), MOST_IMPACTS)
    at = impacts[:count, kernel.IMPACT_TIME].copy()
    recorded = slice(0, len(times_s) - 1 if drop_last else len(times_s))
    rows = np.ascontiguousarray(samples[recorded].T)
    motion = _motion(system, times_s[recorded], rows)
    integrals = np.diff(samples[:, motion_of.SLID : motion_of.STATE], axis=0).T
    return ContactCycle(
        time=times_s[recorded],
        motion=motion,
        touching=rows[kernel.TOUCHING] > 0.5,
        penetration=rows[kernel.DEPTH],
        contact_angle=_contact_angle(rows),
        normal_force=rows[kernel.NORMAL],
        sliding=rows[kernel.SLIDING],
        slip=np.maximum(integrals[0], 0.0),
        work=np.maximum(integrals[1], 0.0),
        pressed=integrals[2:],
        greatest_force=max(float(tally[kernel.GREATEST]), float(motion.force_magnitude.max())),
        contact_fraction=float(tally[kernel.TOUCH_TIME] / (times_s[-1] - times_s[0])),
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
            touching=bool(integrator[kernel.IN_TOUCH] > 0.5),
            impact_speed=float(integrator[kernel.IMPACT_SPEED_NOW]),
        ),
        steps=int(tally[kernel.STEPS]),
    )


def _check_duration(system: ClearanceSystem, duration: float) -> None:
    """Raise ModelError if the contact oscillates too often in the duration (s): a slow crank."""
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


def _control(system: ClearanceSystem, times_s: Array) -> Array:
    """Return the step control; tolerances are not below the rounding of positions."""
    mechanism, settings = system.mechanism, system.contact
    depth, _, pace, _ = system.scales
    reach = mechanism.crank_radius + mechanism.follower_length
    tolerance = max(settings.tolerance, ROUNDING * reach / float(depth))
    turn = abs(system.speed)
    control = np.empty(kernel.CONTROL)
    control[:4] = tolerance * system.scales
    control[kernel.SHORTEST] = SHORTEST_PART * times_s[-1]
    control[kernel.LONGEST_FLIGHT] = min(
        LONGEST_FLIGHT_S, LONGEST_FLIGHT_TURN / turn if turn else np.inf
    )
    control[kernel.LONGEST_CONTACT] = min(
        LONGEST_CONTACT_S, LONGEST_CONTACT_TURN / turn if turn else np.inf
    )
    control[kernel.FIRST_CONTACT] = FIRST_CONTACT_PART * depth / pace
    control[kernel.FLOOR] = settings.impact_speed_floor
    control[kernel.TALLY_FROM] = times_s[0]
    return control


def _check(status: int, time: float, state: Array) -> None:
    """Raise ModelError unless the integration reached its end."""
    if status == kernel.UNFINISHED:
        raise ModelError("steps", MOST_STEPS, say("too many by {:g} s; raise the tolerance", time))
    if status == kernel.STEP_TOO_SMALL or not np.isfinite(state).all():
        raise ModelError(
            "step",
            say("too small"),
            say("no progress at {:g} s; check masses and stiffness, or raise the tolerance", time),
        )


def _contact_angle(rows: Array) -> Array:
    """Return the direction of the normal in the follower frame from the point towards the crank."""
    normal = np.arctan2(rows[kernel.NORMAL_Y], rows[kernel.NORMAL_X])
    turned = normal - rows[motion_of.THETA] - np.pi
    return np.asarray((turned + np.pi) % (2.0 * np.pi) - np.pi)


def _motion(system: ClearanceSystem, times: Array, rows: Array) -> MechanismMotion:
    """Return the motion at the samples, including the forces outside the clearance joint."""
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
    zeros = np.zeros_like(angle)
    slider = [np.array([rows[i], zeros]) for i in (motion_of.X, motion_of.X_RATE, kernel.X_GROWTH)]
    at_crank = system.location == "crank"
    if at_crank:
        bodies = [slider[i] - (arm, arm_v, arm_a)[i] for i in range(3)]
    else:
        bodies = [(pin, pin_v, pin_a)[i] + (arm, arm_v, arm_a)[i] for i in range(3)]
    gravity = np.array(m.gravity)[:, None]
    inertial = m.follower_mass * (bodies[2] - gravity)
    contact_force = rows[[kernel.FORCE_X, kernel.FORCE_Y]]
    force = contact_force if at_crank else inertial - contact_force
    wrist = contact_force - inertial if at_crank else -contact_force
    moment = zeros
    if at_crank:
        bushing = slider[0] - 2.0 * arm
        dx, dy = pin - bushing
        moment = rows[kernel.MOMENT] - (dx * force[1] - dy * force[0])
    spring = zeros
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
        acceleration=zeros,
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
