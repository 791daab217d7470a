"""Mechanism with a clearance joint, as input of the compiled integration, and its states."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.contact import impact_laws as laws
from rigapp_model.contact.impact_motion import AT_CRANK, AT_WRIST
from rigapp_model.contact.indentation import Indentation, indentation
from rigapp_model.contact_law import ContactModel, WornSurface, foundation_modulus
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.errors import ModelError, require_finite, require_positive
from rigapp_model.parameters import Joint, Material, Mechanism

Array = NDArray[np.float64]
Location = Literal["crank", "wrist"]
NODES = 360  # of the worn surface: one per degree


@dataclass(frozen=True, slots=True)
class ContactState:
    """State of the mechanism: slider (m, m/s), follower (rad, rad/s), and the contact.

    ``impact_speed``: normal speed (m/s) at the start of the present contact.
    """

    slider_position: float
    follower_angle: float
    slider_velocity: float
    follower_speed: float
    touching: bool = False
    impact_speed: float = 0.0

    def __post_init__(self) -> None:
        for name in ("slider_position", "follower_angle", "slider_velocity", "follower_speed"):
            require_finite(name, getattr(self, name))


@dataclass(frozen=True, slots=True)
class ClearanceSystem:
    """Slider-crank with one clearance joint at a constant speed (rad/s).

    location "crank": between crank pin and follower (the joint of interest); "wrist": between
    follower and slider. The bushing is part of the follower in both. ``vector``, ``table`` and
    ``options`` are arguments of the compiled functions; ``scales``: reference values of the state
    for the tolerances. ``elastic``: force over penetration at one point, as a curve or as K
    (N/m^1.5) of K d^1.5.
    """

    mechanism: Mechanism
    joint: Joint
    contact: ContactModel
    speed: float
    start_angle: float
    location: Location
    elastic: Indentation | float
    vector: Array
    table: Array
    options: NDArray[np.int64]
    scales: Array

    @property
    def deepest(self) -> float:
        """Return the penetration (m) up to which the law at one point is valid.

        K d^1.5, a law of small contacts, is valid up to the clearance.
        """
        return self.elastic.end if isinstance(self.elastic, Indentation) else self.joint.clearance

    def penetration_under(self, force: float) -> float:
        """Return the penetration (m) under a force (N) at one point; 0 without a force."""
        if force <= 0.0:
            return 0.0
        if isinstance(self.elastic, Indentation):
            return float(self.elastic.depth(force))
        return float((force / self.elastic) ** (2.0 / 3.0))


def clearance_system(
    mechanism: Mechanism,
    joint: Joint,
    bushing: Material,
    pin: Material,
    speed: float,
    contact: ContactModel | None = None,
    location: Location = "crank",
    profile: WornSurface | None = None,
    start_angle: float = 0.0,
) -> ClearanceSystem:
    """Return a clearance system; raise ModelError for one that cannot move or touch.

    contact: by default with law and restitution of the joint. profile: wear of the bushing's
    surface; None: circular. A worn surface is an elastic foundation, unless ``contact`` requires
    one point and the surface is everywhere flatter than the pin.
    """
    settings = contact or ContactModel(joint.contact_law, joint.restitution)
    require_finite("speed", speed, "rad/s")
    require_finite("start_angle", start_angle, "rad")
    require_positive("moving_mass", mechanism.moving_mass, "kg")
    if location not in ("crank", "wrist"):
        raise ModelError("location", location, say("choose crank or wrist"))
    inertia = mechanism.follower_inertia + 0.25 * mechanism.follower_mass * (
        mechanism.follower_length**2
    )
    require_positive("follower_inertia", inertia, say("kg m^2"))
    elastic = indentation(joint, bushing, pin, settings)
    table = _surface(joint, profile)
    foundation = profile is not None if settings.foundation is None else settings.foundation
    shape = laws.CIRCLE if profile is None else laws.PROFILE
    if foundation:
        shape = laws.ELASTIC_FOUNDATION
    if shape == laws.PROFILE:
        _check_one_contact(joint, table)
    spring = mechanism.spring
    vector = np.zeros(laws.PARAMETERS)
    vector[laws.RADIUS] = mechanism.crank_radius
    vector[laws.LENGTH] = mechanism.follower_length
    vector[laws.MASS] = mechanism.follower_mass
    vector[laws.INERTIA] = inertia
    vector[laws.STATIC_MOMENT] = 0.5 * mechanism.follower_mass * mechanism.follower_length
    vector[laws.SLIDER_MASS] = mechanism.moving_mass
    vector[laws.STIFFNESS] = spring.stiffness if spring else 0.0
    vector[laws.FREE_POSITION] = spring.free_position if spring else 0.0
    vector[laws.GRAVITY_X], vector[laws.GRAVITY_Y] = mechanism.gravity
    vector[laws.PIN_RADIUS] = joint.pin_radius
    vector[laws.CLEARANCE] = joint.clearance
    if isinstance(elastic, Indentation):
        vector[laws.CURVE_BEGIN], vector[laws.CURVE_SPACING] = elastic.begin, elastic.spacing
        vector[laws.CURVE :] = elastic.table.ravel()
    else:
        vector[laws.CONTACT_STIFFNESS] = elastic
    vector[laws.HYSTERESIS] = settings.hysteresis
    vector[laws.FRICTION] = joint.friction_coefficient
    vector[laws.RAMP_START], vector[laws.RAMP_END] = settings.friction_ramp
    vector[laws.FOUNDATION] = joint.bushing_width * foundation_modulus(
        bushing.youngs_modulus,
        bushing.poissons_ratio,
        joint.bushing_outer_radius - joint.bushing_radius,
    )
    vector[laws.SPEED], vector[laws.START_ANGLE] = speed, start_angle
    vector[laws.LEAST_RADIUS] = float(table[:, laws.CONSTANT].min())
    vector[laws.REFERENCE_LENGTH] = _reference_length(mechanism, joint, speed)
    where = AT_CRANK if location == "crank" else AT_WRIST
    system = ClearanceSystem(
        mechanism=mechanism,
        joint=joint,
        contact=settings,
        speed=speed,
        start_angle=start_angle,
        location=location,
        elastic=elastic,
        vector=vector,
        table=table,
        options=np.array([where, shape], dtype=np.int64),
        scales=np.ones(4),
    )
    return replace(system, scales=_scales(system))


def _reference_length(mechanism: Mechanism, joint: Joint, speed: float) -> float:
    """Return the joint-to-joint length of the follower with contact on its axis, m.

    The side is that of the mean force of the perfect joint.
    """
    motion = inverse_dynamics(mechanism, np.linspace(0.0, 2.0 * np.pi, 73), speed)
    sign = -1.0 if float(motion.force_follower[0].mean()) > 0.0 else 1.0
    length = mechanism.follower_length + sign * joint.clearance
    if length <= mechanism.crank_radius:
        raise ModelError("clearance", joint.clearance, say("it leaves the follower too short"), "m")
    return length


def settled_state(system: ClearanceSystem) -> ContactState:
    """Return a state in contact at the start angle, close to steady contact.

    The contact is in the direction of the perfect joint's force, turned by the friction angle;
    velocities are central differences of this position.
    """
    step = 1e-4 / max(abs(system.speed), 1.0)
    before, now, after = (_contact_position(system, t) for t in (-step, 0.0, step))
    rates = (after - before) / (2.0 * step)
    return ContactState(
        slider_position=float(now[0]),
        follower_angle=float(now[1]),
        slider_velocity=float(rates[0]),
        follower_speed=float(rates[1]),
        touching=True,
        impact_speed=0.0,
    )


def _contact_position(system: ClearanceSystem, time: float) -> Array:
    """Return slider position and follower angle with the contact in the force's direction."""
    m = system.mechanism
    angle = system.start_angle + system.speed * time
    at_crank = system.location == "crank"
    # Friction at the pin turns the follower and so changes the force. A start from the frictionless
    # force would oscillate for the whole cycle, as only friction damps it.
    joint = system.joint if at_crank else None
    motion = inverse_dynamics(m, angle, system.speed, contact=joint)
    force = motion.force if at_crank else -motion.wrist_force
    sliding = (system.speed if at_crank else 0.0) - float(motion.follower_speed)
    direction = float(np.arctan2(force[1], force[0]))
    direction -= np.sign(sliding) * np.arctan(system.joint.friction_coefficient)
    size = float(np.hypot(force[0], force[1]))
    reach = system.joint.clearance + system.penetration_under(size)
    dx, dy = reach * np.cos(direction), reach * np.sin(direction)
    if not at_crank:
        dx, dy = -dx, -dy
    px, py = m.crank_radius * np.cos(angle), m.crank_radius * np.sin(angle)
    sine = -(py - dy) / m.follower_length
    if abs(sine) >= 1.0:
        raise ModelError(
            "clearance", system.joint.clearance, say("it leaves the follower too short"), "m"
        )
    return np.array([px - dx + m.follower_length * np.sqrt(1.0 - sine * sine), np.arcsin(sine)])


def _scales(system: ClearanceSystem) -> Array:
    """Return typical values of the four states in contact under the perfect joint's RMS force."""
    mechanism = system.mechanism
    motion = inverse_dynamics(mechanism, np.linspace(0.0, 2.0 * np.pi, 73), system.speed)
    vector = motion.force if system.location == "crank" else motion.wrist_force
    force = max(float(np.sqrt(np.mean(np.sum(vector**2, axis=0)))), 1e-3)
    depth = system.penetration_under(force)
    mass = mechanism.moving_mass + mechanism.follower_mass
    pace = depth * np.sqrt(1.5 * force / (depth * mass))
    length = mechanism.follower_length
    return np.array([depth, depth / length, pace, pace / length])


def _surface(joint: Joint, profile: WornSurface | None) -> Array:
    """Return the table of surface nodes, arc lengths and the radius spline of the bushing."""
    angle = 2.0 * np.pi / NODES * np.arange(NODES)
    table = np.zeros((NODES, 7))
    radius = np.full(NODES, joint.bushing_radius)
    slope = np.zeros(NODES)
    table[:, laws.CONSTANT] = radius
    if profile is not None:
        spline = profile.resampled(NODES)
        radius += spline.c[3]
        slope = spline.c[2]
        table[:, laws.CUBIC : laws.CONSTANT] = spline.c[:3].T
        table[:, laws.CONSTANT] = radius
    table[:, laws.NODE_X] = -radius * np.cos(angle)
    table[:, laws.NODE_Y] = -radius * np.sin(angle)
    table[:, laws.NODE_LENGTH] = np.hypot(radius, slope) * (2.0 * np.pi / NODES)
    if radius.min() <= joint.pin_radius:
        raise ModelError("profile", float(radius.min()), say("it leaves no room for the pin"), "m")
    return table


def _check_one_contact(joint: Joint, table: Array) -> None:
    """Raise ModelError if the pin can touch at two points: a surface as curved as the pin."""
    rho, rho1, rho2 = (
        table[:, laws.CONSTANT],
        table[:, laws.LINEAR],
        2.0 * table[:, laws.SQUARE],
    )
    curvature = (rho**2 + 2.0 * rho1**2 - rho * rho2) / (rho**2 + rho1**2) ** 1.5
    roundest = float(1.0 / curvature.max())
    if roundest <= joint.pin_radius:
        raise ModelError(
            "profile",
            roundest,
            say(
                "it is rounder than the pin, which touches it at more than one place; use"
                " the elastic foundation"
            ),
            say("m in its smallest radius"),
        )
