"""Inverse dynamics of the slider-crank in closed form, for a whole cycle of angles at once.

Frames and signs: crank angle from +x, counter-clockwise, 0 at outer dead centre; F is the force on
the follower by the crank pin; e1 points along the crank, e2 from the pin to the wrist.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import joined, say
from rigapp_model import dynamics_kernel as kernel
from rigapp_model.errors import ModelError
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
    given = _given(mechanism, angle, speed, acceleration, clearance)
    shape = given.shape[1:]
    given = given.reshape((kernel.GIVEN, -1))
    np.cos(given[kernel.ANGLE], out=given[kernel.COSINE])
    np.sin(given[kernel.ANGLE], out=given[kernel.SINE])
    found = np.empty((kernel.FOUND, given.shape[1]))
    if not kernel.solve(_constants(mechanism, contact), given, found):
        assert contact is not None
        raise ModelError(
            "friction_coefficient",
            contact.friction_coefficient,
            say("the joint locks: the friction circle is larger than the follower's lever"),
        )
    given, found = given.reshape((len(given), *shape)), found.reshape((len(found), *shape))

    def vector(row: int) -> Array:
        return found[row : row + 2]

    return MechanismMotion(
        angle=given[kernel.ANGLE],
        speed=given[kernel.SPEED],
        acceleration=given[kernel.ACCELERATION],
        follower_angle=np.arcsin(found[kernel.FOLLOWER_SINE]),
        follower_speed=found[kernel.FOLLOWER_SPEED],
        follower_acceleration=found[kernel.FOLLOWER_ACCELERATION],
        crank_position=vector(kernel.CRANK_POSITION),
        crank_velocity=vector(kernel.CRANK_VELOCITY),
        crank_acceleration=vector(kernel.CRANK_ACCELERATION),
        follower_position=vector(kernel.CENTRE_POSITION),
        follower_velocity=vector(kernel.CENTRE_VELOCITY),
        follower_centre_acceleration=vector(kernel.CENTRE_ACCELERATION),
        slider_position=found[kernel.SLIDER_POSITION],
        slider_velocity=found[kernel.SLIDER_VELOCITY],
        slider_acceleration=found[kernel.SLIDER_ACCELERATION],
        spring_force=found[kernel.SPRING_FORCE],
        force=vector(kernel.FORCE),
        force_crank=vector(kernel.FORCE_CRANK),
        force_follower=vector(kernel.FORCE_FOLLOWER),
        wrist_force=vector(kernel.WRIST_FORCE),
        guide_force=found[kernel.GUIDE_FORCE],
        bearing_force=vector(kernel.BEARING_FORCE),
        drive_torque=found[kernel.DRIVE_TORQUE],
        friction_moment=found[kernel.FRICTION_MOMENT],
    )


def _constants(mechanism: Mechanism, contact: Joint | None) -> Array:
    """Return what the compiled solution takes of mechanism and joint."""
    constants = np.zeros(kernel.CONSTANTS)
    constants[kernel.CRANK_RADIUS] = mechanism.crank_radius
    constants[kernel.FOLLOWER_LENGTH] = mechanism.follower_length
    constants[kernel.CRANK_MASS] = mechanism.crank_mass
    constants[kernel.FOLLOWER_MASS] = mechanism.follower_mass
    constants[kernel.MOVING_MASS] = mechanism.moving_mass
    constants[kernel.CRANK_INERTIA] = mechanism.crank_inertia
    constants[kernel.FOLLOWER_INERTIA] = mechanism.follower_inertia
    if mechanism.spring:
        constants[kernel.STIFFNESS] = mechanism.spring.stiffness
        constants[kernel.FREE_POSITION] = mechanism.spring.free_position
    constants[kernel.GRAVITY_X], constants[kernel.GRAVITY_Y] = mechanism.gravity
    if contact is not None:
        mu = contact.friction_coefficient
        constants[kernel.FRICTION_RADIUS] = contact.pin_radius * mu / np.sqrt(1.0 + mu * mu)
    return constants


def _given(
    mechanism: Mechanism,
    angle: ArrayLike,
    speed: ArrayLike,
    acceleration: ArrayLike,
    clearance: ArrayLike,
) -> Array:
    """Return the four arguments, checked, as rows of what the compiled solution takes."""
    names = ("angle", "speed", "acceleration", "clearance")
    arrays = [np.asarray(a, dtype=np.float64) for a in (angle, speed, acceleration, clearance)]
    try:
        shape = np.broadcast(*arrays).shape
    except ValueError as problem:
        shapes = joined(
            ", ", (say("{} {}", n, a.shape) for n, a in zip(names, arrays, strict=True))
        )
        raise ModelError("shapes", shapes, say("give arrays of one shape, or scalars")) from problem
    given = np.empty((kernel.GIVEN, *shape))
    for row, array in enumerate(arrays):
        given[row] = array
    if not np.isfinite(given[: len(arrays)]).all():
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
    return given


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
