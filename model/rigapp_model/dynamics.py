"""Inverse dynamics of the slider-crank in closed form, for a whole cycle of angles at once.

Frames and signs: crank angle from +x, counter-clockwise, 0 at outer dead centre; F is the force on
the follower by the crank pin; e1 points along the crank, e2 from the pin to the wrist.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import joined, say
from rigapp_model.errors import ModelError
from rigapp_model.frames import into_frame
from rigapp_model.parameters import Joint, Mechanism

Array = NDArray[np.float64]

LEAST_TORQUE_NM = 0.01
"""The friction of any crank's bearings holds it against less."""


@dataclass(frozen=True, slots=True)
class MechanismMotion:
    """Hold motion and forces at every angle, in SI; vectors have shape (2, ...), scalars (...).

    Positions, velocities and accelerations are those of the centres of mass; the slider's are
    along x. ``force`` is F on the follower by the pin, ``wrist_force`` is on the slider by the
    follower, ``guide_force`` is on the slider by its guide along y, ``bearing_force`` is on the
    crank by its bearing, ``drive_torque`` acts on the crank. ``friction_moment`` acts on the
    follower about the pin centre.
    """

    angle: Array
    speed: Array
    acceleration: Array
    follower_angle: Array
    follower_speed: Array
    follower_acceleration: Array
    crank_position: Array
    crank_velocity: Array
    crank_acceleration: Array
    follower_position: Array
    follower_velocity: Array
    follower_centre_acceleration: Array
    slider_position: Array
    slider_velocity: Array
    slider_acceleration: Array
    spring_force: Array
    force: Array
    force_crank: Array
    force_follower: Array
    wrist_force: Array
    guide_force: Array
    bearing_force: Array
    drive_torque: Array
    friction_moment: Array

    @property
    def force_magnitude(self) -> Array:
        """Return |F|, N."""
        return np.hypot(self.force[0], self.force[1])

    def slip_rate(self, pin_radius: float) -> Array:
        """Return the sliding speed of the pin in the bushing, m/s, positive with the crank."""
        return pin_radius * (self.speed - self.follower_speed)

    def slip_increments(self, pin_radius: float) -> Array:
        """Return the slip from each angle to the next one, m; the last goes on to the first.

        The angles must be one revolution in steps; the sum is then 2 pi ``pin_radius`` whatever
        the clearance is. (Paper, section 4.1.)
        """
        relative = self.angle - self.follower_angle
        steps = np.empty_like(relative)
        steps[:-1] = np.diff(relative)
        turn = np.copysign(2.0 * np.pi, relative[-1] - relative[0])
        steps[-1] = turn - (relative[-1] - relative[0])
        return pin_radius * np.abs(steps)


def inverse_dynamics(
    mechanism: Mechanism,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike = 0.0,
    clearance: ArrayLike = 0.0,
    contact: Joint | None = None,
) -> MechanismMotion:
    """Compute motion and all forces from the crank's angle (rad), speed and acceleration.

    The arguments broadcast against each other; scalars give 0-d results. ``clearance`` (m) > 0
    makes the follower longer by it between pin and centre of mass: the pin bears on the wall
    towards the crank, the follower is in tension; < 0 is the other wall. ``contact``: the pin
    radius and the friction coefficient of the joint; None is without friction.

    Raises ModelError when the clearance leaves the follower too short for the crank or a number
    is not finite. Sources: paper Eqs 4 and 12 with their multipliers eliminated by hand; friction
    by the friction circle.
    """
    turn, rate, growth, gap = _broadcast(mechanism, angle, speed, acceleration, clearance)
    r, half, k = mechanism.crank_radius, 0.5 * mechanism.follower_length, mechanism.spring
    length = mechanism.follower_length + gap
    ratio = r / length
    c1, s1 = np.cos(turn), np.sin(turn)
    s2 = -ratio * s1
    c2 = np.sqrt(1.0 - s2 * s2)
    rate2 = rate * rate

    w2 = -ratio * c1 * rate / c2
    w2w2 = w2 * w2
    al2 = (s2 * w2w2 + ratio * (s1 * rate2 - c1 * growth)) / c2
    crank_position, crank_velocity, crank_acceleration = _circle(
        0.5 * r, c1, s1, rate, rate2, growth
    )
    arm_position, arm_velocity, arm_acceleration = _circle(half, c2, s2, w2, w2w2, al2)
    slider_position = r * c1 + length * c2
    slider_velocity = -r * s1 * rate - length * s2 * w2
    slider_acceleration = -r * (s1 * growth + c1 * rate2) - length * (s2 * al2 + c2 * w2w2)
    follower_position, follower_velocity, follower_acceleration = (
        _before(slider_position, arm_position),
        _before(slider_velocity, arm_velocity),
        _before(slider_acceleration, arm_acceleration),
    )

    gx, gy = mechanism.gravity
    m1, m2, m3 = mechanism.crank_mass, mechanism.follower_mass, mechanism.moving_mass
    spring = -k.stiffness * (slider_position - k.free_position) if k else 0.0 * slider_position
    load_x = m2 * (follower_acceleration[0] - gx)
    load_y = m2 * (follower_acceleration[1] - gy)
    load_n2 = load_y * c2 - load_x * s2
    wrist = np.empty_like(follower_position)
    wrist[0] = m3 * (slider_acceleration - gx) - spring
    wrist_n2 = (-mechanism.follower_inertia * al2 - (half + gap) * load_n2) / length
    wrist[1] = (wrist_n2 + wrist[0] * s2) / c2
    moment = _friction_moment(contact, rate - w2, wrist[0] + load_x, wrist[1] + load_y, length * c2)
    wrist[1] += moment / (length * c2)
    force = np.empty_like(wrist)
    force[0] = wrist[0] + load_x
    force[1] = wrist[1] + load_y

    bearing = m1 * crank_acceleration + force
    bearing[0] -= m1 * gx
    bearing[1] -= m1 * gy
    torque = (
        (mechanism.crank_inertia + 0.25 * m1 * r * r) * growth
        + r * (c1 * force[1] - s1 * force[0])
        - 0.5 * r * m1 * (c1 * gy - s1 * gx)
        + moment
    )
    return MechanismMotion(
        angle=turn,
        speed=rate,
        acceleration=growth,
        follower_angle=np.arcsin(s2),
        follower_speed=w2,
        follower_acceleration=al2,
        crank_position=crank_position,
        crank_velocity=crank_velocity,
        crank_acceleration=crank_acceleration,
        follower_position=follower_position,
        follower_velocity=follower_velocity,
        follower_centre_acceleration=follower_acceleration,
        slider_position=slider_position,
        slider_velocity=slider_velocity,
        slider_acceleration=slider_acceleration,
        spring_force=spring,
        force=force,
        force_crank=into_frame(force, c1, s1),
        force_follower=into_frame(force, c2, s2),
        wrist_force=wrist,
        guide_force=-wrist[1] - m3 * gy,
        bearing_force=bearing,
        drive_torque=torque,
        friction_moment=moment,
    )


def _broadcast(
    mechanism: Mechanism,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike,
    clearance: ArrayLike,
) -> tuple[Array, Array, Array, Array]:
    """Return the four arguments as float64 arrays of one shape, checked."""
    names = ("angle", "speed", "acceleration", "clearance")
    given = [np.asarray(a, dtype=np.float64) for a in (angle, speed, acceleration, clearance)]
    for name, array in zip(names, given, strict=True):
        if not np.isfinite(array).all():
            raise ModelError(name, say("not finite"), say("give finite numbers only"))
    shortest = mechanism.follower_length + float(given[3].min(initial=0.0))
    if shortest <= mechanism.crank_radius:
        raise ModelError(
            "clearance",
            float(given[3].min()),
            say(
                "it leaves the follower {:g} m long, too short for the crank radius of {:g} m",
                shortest,
                mechanism.crank_radius,
            ),
            "m",
        )
    try:
        turn, rate, growth, gap = np.broadcast_arrays(*given)
    except ValueError as problem:
        shapes = joined(", ", (say("{} {}", n, a.shape) for n, a in zip(names, given, strict=True)))
        raise ModelError("shapes", shapes, say("give arrays of one shape, or scalars")) from problem
    return turn, rate, growth, gap


def _circle(
    radius: float, c: Array, s: Array, rate: Array, rate2: Array, growth: Array
) -> tuple[Array, Array, Array]:
    """Return position, velocity and acceleration of a point on a turning arm, each (2, ...)."""
    position, velocity, acceleration = (np.empty((2, *np.shape(c))) for _ in range(3))
    position[0], position[1] = radius * c, radius * s
    velocity[0], velocity[1] = -position[1] * rate, position[0] * rate
    acceleration[0] = -position[1] * growth - position[0] * rate2
    acceleration[1] = position[0] * growth - position[1] * rate2
    return position, velocity, acceleration


def _before(wrist: Array, arm: Array) -> Array:
    """Return the follower's centre of mass from the wrist (on the x axis) less its arm."""
    centre = -arm
    centre[0] += wrist
    return centre


def _friction_moment(
    contact: Joint | None, relative_speed: Array, fx: Array, fy: Array, lever: Array
) -> Array:
    """Return the moment of friction on the follower about the pin centre, N m.

    fx, fy: pin force without friction. A moment M turns the pin force into (fx, fy + M / lever),
    and M = s rho |F| with rho = R1 mu / sqrt(1 + mu^2) (friction circle) and s the sense of
    sliding, so |F| is the positive root of a quadratic.
    """
    if contact is None or contact.friction_coefficient == 0.0:
        return np.zeros_like(fx)
    mu = contact.friction_coefficient
    rho = contact.pin_radius * mu / np.sqrt(1.0 + mu * mu)
    sense = np.sign(relative_speed)
    q = sense * rho / lever
    remainder = 1.0 - q * q
    if np.any(remainder <= 0.0):
        raise ModelError(
            "friction_coefficient",
            mu,
            say("the joint locks: the friction circle is larger than the follower's lever"),
        )
    size = q * fy + np.sqrt((q * fy) ** 2 + remainder * (fx * fx + fy * fy))
    return sense * rho * size / remainder


def rest_angle(mechanism: Mechanism) -> float | None:
    """Return the crank angle (rad) at which spring and weight hold the crank, None without both.

    The deepest minimum of the potential energy, which is the work of the torque that would turn
    the crank without friction and inertia forces.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    torque = inverse_dynamics(mechanism, angle, 0.0).drive_torque
    if np.abs(torque).max() < LEAST_TORQUE_NM:
        return None
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (torque[1:] + torque[:-1]))])
    return float(angle[int(np.argmin(energy[:-1]))])
