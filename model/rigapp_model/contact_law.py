"""Stiffness and damping of a pin in a bushing: the settings of technique 3."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from rigapp.texts import say
from rigapp_model.errors import ModelError, require_finite, require_not_negative, require_positive
from rigapp_model.parameters import Joint, Material
from rigapp_model.restitution import (
    CONTACT_LAWS,
    DEFAULT_LAW,
    MISSED,
    check_law,
    restitution_of,
)

Array = NDArray[np.float64]
LARGEST_TOLERANCE = 0.1  # of a step or penetration; a larger one misses impacts


@dataclass(frozen=True, slots=True)
class ContactModel:
    """Settings of the contact force; all but the first two are numerical.

    law: one of ``CONTACT_LAWS``. restitution: normal speed after an impact over that before.
    friction_ramp: sliding speeds (m/s) at which Coulomb friction begins to act and acts in full.
    impact_speed_floor: least d0' (m/s); without it a contact from rest would be damped infinitely.
    foundation: contact over the whole surface as an elastic foundation instead of at one point;
    None: only if the surface is worn, where the pin conforms to it and one point would be wrong.
    stiffness: K in N/m^1.5, for an elastic force K d^1.5 instead of that of the law.
    tolerance: error of one step, as a fraction of the mean penetration.
    """

    law: str = DEFAULT_LAW
    restitution: float = 0.9
    friction_ramp: tuple[float, float] = (1e-4, 1e-3)
    impact_speed_floor: float = 1e-3
    foundation: bool | None = None
    stiffness: float | None = None
    tolerance: float = 1e-8

    def __post_init__(self) -> None:
        check_law(self.law, self.restitution)
        start, end = self.friction_ramp
        require_not_negative("friction_ramp", start, "m/s")
        require_finite("friction_ramp", end, "m/s")
        if end <= start:
            raise ModelError(
                "friction_ramp", self.friction_ramp, say("the end must exceed the start")
            )
        require_positive("impact_speed_floor", self.impact_speed_floor, "m/s")
        require_positive("tolerance", self.tolerance)
        if self.tolerance > LARGEST_TOLERANCE:
            raise ModelError(
                "tolerance", self.tolerance, say("it must not exceed {}", LARGEST_TOLERANCE)
            )
        if self.stiffness is not None:
            require_positive("stiffness", self.stiffness, "N/m^1.5")

    @property
    def hysteresis(self) -> float:
        """Return the damping factor a of the law."""
        return CONTACT_LAWS[self.law].damping(self.restitution)

    def sentence(self) -> str:
        """Return a message if the law does not give the set restitution, else an empty text."""
        actual = restitution_of(self.hysteresis)
        if abs(actual - self.restitution) <= MISSED:
            return ""
        return say(
            (
                "The contact law {} gives a restitution of {:.2f} where {:.2f} is set; choose"
                " the law elements, which reaches it."
            ),
            self.law,
            actual,
            self.restitution,
        )


@dataclass(frozen=True, slots=True)
class WornSurface:
    """Wear depth (m) over the angle (rad) of the bushing's inner surface.

    angle: from the initial contact point (towards the crank), counter-clockwise in the follower
    frame, increasing, within one turn; depth: same shape. The profile is periodic.
    """

    angle: Array
    depth: Array

    def __post_init__(self) -> None:
        if self.angle.ndim != 1 or self.angle.shape != self.depth.shape or len(self.angle) < 8:
            shapes = say("{} angles and {} depths", self.angle.shape, self.depth.shape)
            raise ModelError("profile", shapes, say("give one depth for each of at least 8 angles"))
        if not (np.isfinite(self.angle).all() and np.isfinite(self.depth).all()):
            raise ModelError("profile", say("not finite"), say("give finite numbers only"))
        turn = self.angle[-1] - self.angle[0]
        if np.any(np.diff(self.angle) <= 0.0) or turn > 2.0 * np.pi + 1e-9:
            raise ModelError(
                "profile", say("out of order"), say("give increasing angles within one turn")
            )

    def resampled(self, count: int) -> CubicSpline:
        """Return a periodic spline of the depth on ``count`` equal steps from angle 0."""
        closed = self.angle[-1] - self.angle[0] > 2.0 * np.pi - 1e-9
        angle = self.angle if closed else np.append(self.angle, self.angle[0] + 2.0 * np.pi)
        depth = np.append(self.depth[: len(angle) - 1], self.depth[0])
        spline = CubicSpline(angle, depth, bc_type="periodic")
        steps = np.linspace(0.0, 2.0 * np.pi, count + 1)
        values = spline(steps)
        values[-1] = values[0]
        return CubicSpline(steps, values, bc_type="periodic")


def hertz_stiffness(joint: Joint, bushing: Material, pin: Material) -> float:
    """Return K in FN = K d^1.5, N/m^1.5, of a pin inside a bushing.

    K = 4 / (3 pi (hi + hj)) sqrt(Ri Rj / (Ri - Rj)), h = (1 - nu^2) / (pi E) (Lankarani and
    Nikravesh). Raises ModelError without clearance, where K is infinite.
    """
    if joint.clearance <= 0.0:
        raise ModelError(
            "clearance",
            joint.clearance,
            say("contact of separate bodies needs a bushing larger than its pin"),
            "m",
        )
    compliance = sum(
        (1.0 - m.poissons_ratio**2) / (np.pi * m.youngs_modulus) for m in (bushing, pin)
    )
    curvature = joint.bushing_radius * joint.pin_radius / joint.clearance
    return float(4.0 / (3.0 * np.pi * compliance) * np.sqrt(curvature))


def foundation_modulus(
    youngs_modulus: float, poissons_ratio: float, wall: float, plane: str = "strain"
) -> float:
    """Return pressure per penetration of a laterally confined layer on its rim (Winkler), Pa/m.

    E (1 - nu) / ((1 + nu) (1 - 2 nu)) / wall in plane strain; E / (1 - nu^2) / wall in plane
    stress. youngs_modulus: Pa; wall: thickness, m.
    """
    nu = poissons_ratio
    if plane == "stress":
        return youngs_modulus / (1.0 - nu * nu) / wall
    return youngs_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) / wall
