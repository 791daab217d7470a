"""Inverse dynamics of the slider-crank in closed form, for a whole cycle of angles at once.

Frames and signs: crank angle from +x, counter-clockwise, 0 at outer dead centre; F is the force on
the follower by the crank pin; e1 points along the crank, e2 from the pin to the wrist.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numba import float64, types
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import joined, say
from rigapp_model.compiled import njit
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Joint, Mechanism

# The kernel computes motion and forces of all angles in one compiled pass. Numpy would need one
# pass over all angles for each of the 130 operations.
#
# Each block of angles is solved in a small array with a fixed distance between rows: only then can
# the compiler exclude overlapping rows, and vectorise.

CRANK_RADIUS, FOLLOWER_LENGTH, CRANK_MASS, FOLLOWER_MASS, MOVING_MASS = range(5)
CRANK_INERTIA, FOLLOWER_INERTIA, STIFFNESS, FREE_POSITION = range(5, 9)
GRAVITY_X, GRAVITY_Y, FRICTION_RADIUS = range(9, 12)
CONSTANTS = 12
"""Indices of the constants; FRICTION_RADIUS: of the friction circle, m, 0 without friction."""

ANGLE, SPEED, ACCELERATION, GAP, COSINE, SINE = range(6)
INPUTS = 6
"""Rows of the inputs at each angle: the crank's motion, clearance, cosine and sine."""

(
    FOLLOWER_SINE,
    FOLLOWER_SPEED,
    FOLLOWER_ACCELERATION,
    SLIDER_POSITION,
    SLIDER_VELOCITY,
    SLIDER_ACCELERATION,
    SPRING_FORCE,
    GUIDE_FORCE,
    DRIVE_TORQUE,
    FRICTION_MOMENT,
) = range(10)
CRANK_POSITION, CRANK_VELOCITY, CRANK_ACCELERATION = range(10, 16, 2)
CENTRE_POSITION, CENTRE_VELOCITY, CENTRE_ACCELERATION = range(16, 22, 2)
FORCE, FORCE_CRANK, FORCE_FOLLOWER, WRIST_FORCE, BEARING_FORCE = range(22, 32, 2)
OUTPUTS = 32
"""Rows of the outputs; from ``CRANK_POSITION`` on each is the first of a pair x, y."""

SPAN = 64  # angles per block: its rows fit in the L1 cache
BLOCK = (OUTPUTS + INPUTS) * SPAN

ROWS = float64[:, ::1]


@njit(
    types.boolean(types.Array(float64, 1, "C", readonly=True), ROWS, ROWS),
    cache=True,
    error_model="numpy",
)
def solve(constants, inputs, outputs):  # type: ignore[no-untyped-def]
    """Fill ``outputs`` (OUTPUTS, n) for ``inputs`` (INPUTS, n); return False if the joint locks.

    It locks where the friction circle is larger than the follower's lever. A moment M changes the
    pin force to (fx, fy + M / lever), and M = s rho |F| with the radius rho of the circle and the
    direction of sliding s, so |F| is the positive root of a quadratic.
    """
    r, rod = constants[CRANK_RADIUS], constants[FOLLOWER_LENGTH]
    m1, m2, m3 = constants[CRANK_MASS], constants[FOLLOWER_MASS], constants[MOVING_MASS]
    turning = constants[CRANK_INERTIA] + 0.25 * m1 * r * r
    gx, gy, rho = constants[GRAVITY_X], constants[GRAVITY_Y], constants[FRICTION_RADIUS]
    stiffness, free = constants[STIFFNESS], constants[FREE_POSITION]
    inertia = constants[FOLLOWER_INERTIA]
    half, locked = 0.5 * rod, 0
    block = np.empty(BLOCK)
    count = inputs.shape[1]
    for begin in range(0, count, SPAN):
        size = min(SPAN, count - begin)
        for row in range(SPEED, INPUTS):
            for j in range(size):
                block[(OUTPUTS + row) * SPAN + j] = inputs[row, begin + j]
        for j in range(size):
            rate = block[(OUTPUTS + SPEED) * SPAN + j]
            growth = block[(OUTPUTS + ACCELERATION) * SPAN + j]
            gap = block[(OUTPUTS + GAP) * SPAN + j]
            c1, s1 = block[(OUTPUTS + COSINE) * SPAN + j], block[(OUTPUTS + SINE) * SPAN + j]
            length = rod + gap
            ratio = r / length
            s2 = -ratio * s1
            c2 = math.sqrt(1.0 - s2 * s2)
            rate2 = rate * rate
            w2 = -ratio * c1 * rate / c2
            w2w2 = w2 * w2
            al2 = (s2 * w2w2 + ratio * (s1 * rate2 - c1 * growth)) / c2

            crank_x, crank_y = 0.5 * r * c1, 0.5 * r * s1
            crank_ax = -crank_y * growth - crank_x * rate2
            crank_ay = crank_x * growth - crank_y * rate2
            arm_x, arm_y = half * c2, half * s2
            position = r * c1 + length * c2
            velocity = -r * s1 * rate - length * s2 * w2
            acceleration = -r * (s1 * growth + c1 * rate2) - length * (s2 * al2 + c2 * w2w2)
            centre_ax = acceleration - (-arm_y * al2 - arm_x * w2w2)
            centre_ay = -(arm_x * al2 - arm_y * w2w2)

            spring = -stiffness * (position - free)
            load_x, load_y = m2 * (centre_ax - gx), m2 * (centre_ay - gy)
            load_n2 = load_y * c2 - load_x * s2
            wrist_x = m3 * (acceleration - gx) - spring
            wrist_n2 = (-inertia * al2 - (half + gap) * load_n2) / length
            wrist_y = (wrist_n2 + wrist_x * s2) / c2
            fx, fy, lever = wrist_x + load_x, wrist_y + load_y, length * c2
            sliding = math.copysign(rho, rate - w2) if rate != w2 else 0.0
            q = sliding / lever
            remainder = 1.0 - q * q
            locked += 1 if remainder <= 0.0 else 0
            pressed = q * fy + math.sqrt((q * fy) ** 2 + remainder * (fx * fx + fy * fy))
            moment = sliding * pressed / remainder
            wrist_y += moment / lever
            fx, fy = wrist_x + load_x, wrist_y + load_y

            block[FOLLOWER_SINE * SPAN + j] = s2
            block[FOLLOWER_SPEED * SPAN + j] = w2
            block[FOLLOWER_ACCELERATION * SPAN + j] = al2
            block[SLIDER_POSITION * SPAN + j] = position
            block[SLIDER_VELOCITY * SPAN + j] = velocity
            block[SLIDER_ACCELERATION * SPAN + j] = acceleration
            block[SPRING_FORCE * SPAN + j] = spring
            block[GUIDE_FORCE * SPAN + j] = -wrist_y - m3 * gy
            block[DRIVE_TORQUE * SPAN + j] = (
                turning * growth
                + r * (c1 * fy - s1 * fx)
                - 0.5 * r * m1 * (c1 * gy - s1 * gx)
                + moment
            )
            block[FRICTION_MOMENT * SPAN + j] = moment
            block[CRANK_POSITION * SPAN + j], block[(CRANK_POSITION + 1) * SPAN + j] = (
                crank_x,
                crank_y,
            )
            block[CRANK_VELOCITY * SPAN + j] = -crank_y * rate
            block[(CRANK_VELOCITY + 1) * SPAN + j] = crank_x * rate
            block[CRANK_ACCELERATION * SPAN + j], block[(CRANK_ACCELERATION + 1) * SPAN + j] = (
                crank_ax,
                crank_ay,
            )
            block[CENTRE_POSITION * SPAN + j], block[(CENTRE_POSITION + 1) * SPAN + j] = (
                position - arm_x,
                -arm_y,
            )
            block[CENTRE_VELOCITY * SPAN + j] = velocity + arm_y * w2
            block[(CENTRE_VELOCITY + 1) * SPAN + j] = -arm_x * w2
            block[CENTRE_ACCELERATION * SPAN + j] = centre_ax
            block[(CENTRE_ACCELERATION + 1) * SPAN + j] = centre_ay
            block[FORCE * SPAN + j], block[(FORCE + 1) * SPAN + j] = fx, fy
            block[FORCE_CRANK * SPAN + j], block[(FORCE_CRANK + 1) * SPAN + j] = (
                fx * c1 + fy * s1,
                fy * c1 - fx * s1,
            )
            block[FORCE_FOLLOWER * SPAN + j] = fx * c2 + fy * s2
            block[(FORCE_FOLLOWER + 1) * SPAN + j] = fy * c2 - fx * s2
            block[WRIST_FORCE * SPAN + j], block[(WRIST_FORCE + 1) * SPAN + j] = wrist_x, wrist_y
            block[BEARING_FORCE * SPAN + j] = m1 * crank_ax + fx - m1 * gx
            block[(BEARING_FORCE + 1) * SPAN + j] = m1 * crank_ay + fy - m1 * gy
        for row in range(OUTPUTS):
            outputs[row, begin : begin + size] = block[row * SPAN : row * SPAN + size]
    return locked == 0


Array = NDArray[np.float64]

LEAST_TORQUE_NM = 0.01
"""Torques below this are held by the bearing friction of any crank."""


@dataclass(frozen=True, slots=True)
class MechanismMotion:
    """Motion and forces at every angle, in SI; vectors have shape (2, ...), scalars (...).

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
        """Return the slip from each angle to the next, m; the last value is that to the first.

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
    lengthens the follower by as much between pin and centre of mass: the pin bears on the wall
    towards the crank, the follower is in tension; < 0 is the other wall. ``contact``: the pin
    radius and the friction coefficient of the joint; None: frictionless.

    Raises ModelError if the clearance leaves the follower too short for the crank or a number is
    not finite. Sources: paper Eqs 4 and 12 with the multipliers eliminated by hand; friction by
    the friction circle.
    """
    inputs = _inputs(mechanism, angle, speed, acceleration, clearance)
    shape = inputs.shape[1:]
    inputs = inputs.reshape((INPUTS, -1))
    np.cos(inputs[ANGLE], out=inputs[COSINE])
    np.sin(inputs[ANGLE], out=inputs[SINE])
    outputs = np.empty((OUTPUTS, inputs.shape[1]))
    if not solve(_constants(mechanism, contact), inputs, outputs):
        assert contact is not None
        raise ModelError(
            "friction_coefficient",
            contact.friction_coefficient,
            say("the joint locks: the friction circle is larger than the follower's lever"),
        )
    inputs, outputs = inputs.reshape((len(inputs), *shape)), outputs.reshape((len(outputs), *shape))

    def vector(row: int) -> Array:
        return outputs[row : row + 2]

    return MechanismMotion(
        angle=inputs[ANGLE],
        speed=inputs[SPEED],
        acceleration=inputs[ACCELERATION],
        follower_angle=np.arcsin(outputs[FOLLOWER_SINE]),
        follower_speed=outputs[FOLLOWER_SPEED],
        follower_acceleration=outputs[FOLLOWER_ACCELERATION],
        crank_position=vector(CRANK_POSITION),
        crank_velocity=vector(CRANK_VELOCITY),
        crank_acceleration=vector(CRANK_ACCELERATION),
        follower_position=vector(CENTRE_POSITION),
        follower_velocity=vector(CENTRE_VELOCITY),
        follower_centre_acceleration=vector(CENTRE_ACCELERATION),
        slider_position=outputs[SLIDER_POSITION],
        slider_velocity=outputs[SLIDER_VELOCITY],
        slider_acceleration=outputs[SLIDER_ACCELERATION],
        spring_force=outputs[SPRING_FORCE],
        force=vector(FORCE),
        force_crank=vector(FORCE_CRANK),
        force_follower=vector(FORCE_FOLLOWER),
        wrist_force=vector(WRIST_FORCE),
        guide_force=outputs[GUIDE_FORCE],
        bearing_force=vector(BEARING_FORCE),
        drive_torque=outputs[DRIVE_TORQUE],
        friction_moment=outputs[FRICTION_MOMENT],
    )


def _constants(mechanism: Mechanism, contact: Joint | None) -> Array:
    """Return the constants of mechanism and joint for the kernel."""
    constants = np.zeros(CONSTANTS)
    constants[CRANK_RADIUS] = mechanism.crank_radius
    constants[FOLLOWER_LENGTH] = mechanism.follower_length
    constants[CRANK_MASS] = mechanism.crank_mass
    constants[FOLLOWER_MASS] = mechanism.follower_mass
    constants[MOVING_MASS] = mechanism.moving_mass
    constants[CRANK_INERTIA] = mechanism.crank_inertia
    constants[FOLLOWER_INERTIA] = mechanism.follower_inertia
    if mechanism.spring:
        constants[STIFFNESS] = mechanism.spring.stiffness
        constants[FREE_POSITION] = mechanism.spring.free_position
    constants[GRAVITY_X], constants[GRAVITY_Y] = mechanism.gravity
    if contact is not None:
        mu = contact.friction_coefficient
        constants[FRICTION_RADIUS] = contact.pin_radius * mu / np.sqrt(1.0 + mu * mu)
    return constants


def _inputs(
    mechanism: Mechanism,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike,
    clearance: ArrayLike,
) -> Array:
    """Validate the four arguments and return them as input rows of the kernel."""
    names = ("angle", "speed", "acceleration", "clearance")
    arrays = [np.asarray(a, dtype=np.float64) for a in (angle, speed, acceleration, clearance)]
    try:
        shape = np.broadcast(*arrays).shape
    except ValueError as problem:
        shapes = joined(
            ", ", (say("{} {}", n, a.shape) for n, a in zip(names, arrays, strict=True))
        )
        raise ModelError("shapes", shapes, say("give arrays of one shape, or scalars")) from problem
    inputs = np.empty((INPUTS, *shape))
    for row, array in enumerate(arrays):
        inputs[row] = array
    if not np.isfinite(inputs[: len(arrays)]).all():
        name = next(n for n, a in zip(names, arrays, strict=True) if not np.isfinite(a).all())
        raise ModelError(name, say("not finite"), say("give finite numbers only"))
    least = float(arrays[3].min(initial=0.0))
    shortest = mechanism.follower_length + least
    if shortest <= mechanism.crank_radius:
        raise ModelError(
            "clearance",
            float(arrays[3].min()),
            say(
                "it leaves the follower {:g} m long, too short for the crank radius of {:g} m",
                shortest,
                mechanism.crank_radius,
            ),
            "m",
        )
    return inputs


def rest_angle(mechanism: Mechanism) -> float | None:
    """Return the equilibrium angle (rad) of the crank under spring and weight, None without both.

    The deepest minimum of the potential energy, which is the work of the torque that turns the
    crank without friction and inertia forces.
    """
    angle = np.linspace(0.0, 2.0 * np.pi, 721)
    torque = inverse_dynamics(mechanism, angle, 0.0).drive_torque
    if np.abs(torque).max() < LEAST_TORQUE_NM:
        return None
    energy = np.concatenate([[0.0], np.cumsum(0.5 * (torque[1:] + torque[:-1]))])
    return float(angle[int(np.argmin(energy[:-1]))])
