"""The mechanism, its joint and its materials: validated records in SI units."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp.texts import say
from rigapp_model.errors import ModelError, require_finite, require_not_negative, require_positive
from rigapp_model.restitution import DEFAULT_LAW, check_law


@dataclass(frozen=True, slots=True)
class Spring:
    """Spring on the slider: force along +x = -stiffness (position - free_position).

    The paper does not state the spring's anchor. The assumed arrangement is a free position beyond
    the slider's travel (anchor outboard), which keeps the follower in tension.
    """

    stiffness: float
    free_position: float

    def __post_init__(self) -> None:
        require_not_negative("stiffness", self.stiffness, "N/m")
        require_finite("free_position", self.free_position, "m")


@dataclass(frozen=True, slots=True)
class Mechanism:
    """Lengths (m), masses (kg) and inertias about the centres of mass (kg m^2).

    Crank and follower lengths are full lengths, joint to joint, with the centre of mass half-way
    (the paper's l1 and l2 are half of them). ``gravity`` is the acceleration of free fall as
    (x, y) in m/s^2; (0, 0) is the horizontal plane.
    """

    crank_radius: float
    crank_mass: float
    crank_inertia: float
    follower_length: float
    follower_mass: float
    follower_inertia: float
    slider_mass: float
    added_mass: float = 0.0
    gravity: tuple[float, float] = (0.0, 0.0)
    spring: Spring | None = None

    def __post_init__(self) -> None:
        require_positive("crank_radius", self.crank_radius, "m")
        require_positive("follower_length", self.follower_length, "m")
        if self.follower_length <= self.crank_radius:
            raise ModelError(
                "follower_length",
                self.follower_length,
                say(
                    "it must be longer than the crank radius of {:g} m, or the crank cannot turn",
                    self.crank_radius,
                ),
                "m",
            )
        for name in ("crank_mass", "follower_mass", "slider_mass", "added_mass"):
            require_not_negative(name, getattr(self, name), "kg")
        for name in ("crank_inertia", "follower_inertia"):
            require_not_negative(name, getattr(self, name), say("kg m^2"))
        if len(self.gravity) != 2:
            raise ModelError("gravity", self.gravity, say("give two components, along x and y"))
        for component in self.gravity:
            require_finite("gravity", component, "m/s^2")

    @property
    def moving_mass(self) -> float:
        """Return the sliding mass: slider and added mass, kg."""
        return self.slider_mass + self.added_mass


@dataclass(frozen=True, slots=True)
class Joint:
    """Joint of interest: pin and bushing radii and width (m), Coulomb friction.

    ``restitution`` and ``contact_law`` apply to pin and bushing as separate bodies; see
    ``rigapp_model.contact_law``.
    """

    pin_radius: float
    bushing_radius: float
    bushing_outer_radius: float
    bushing_width: float
    friction_coefficient: float = 0.0
    restitution: float = 0.9
    contact_law: str = DEFAULT_LAW

    def __post_init__(self) -> None:
        for name in ("pin_radius", "bushing_radius", "bushing_outer_radius", "bushing_width"):
            require_positive(name, getattr(self, name), "m")
        require_not_negative("friction_coefficient", self.friction_coefficient)
        check_law(self.contact_law, self.restitution)
        if self.pin_radius > self.bushing_radius:
            raise ModelError(
                "pin_radius",
                self.pin_radius,
                say("the pin must fit the bushing of radius {:g} m", self.bushing_radius),
                "m",
            )
        if self.bushing_outer_radius <= self.bushing_radius:
            raise ModelError(
                "bushing_outer_radius",
                self.bushing_outer_radius,
                say("it must be greater than the bushing radius of {:g} m", self.bushing_radius),
                "m",
            )

    @property
    def clearance(self) -> float:
        """Return the radial clearance R2 - R1, m."""
        return self.bushing_radius - self.pin_radius

    @property
    def projected_area(self) -> float:
        """Return the area of the nominal pressure: diameter x width, m^2."""
        return 2.0 * self.pin_radius * self.bushing_width


@dataclass(frozen=True, slots=True)
class Material:
    """Linear elastic material: Young's modulus (Pa) and Poisson's ratio."""

    youngs_modulus: float
    poissons_ratio: float

    def __post_init__(self) -> None:
        require_positive("youngs_modulus", self.youngs_modulus, "Pa")
        require_finite("poissons_ratio", self.poissons_ratio)
        if not 0.0 <= self.poissons_ratio < 0.5:
            raise ModelError(
                "poissons_ratio",
                self.poissons_ratio,
                say(
                    "it must be at least 0 and below 0.5 (0.5 is incompressible; use 0.499 instead)"
                ),
            )


@dataclass(frozen=True, slots=True)
class WearLaw:
    """Deviation from Archard's dh/ds = K p; none by default.

    name: from ``rigapp_model.wear.laws``. excess: relative increase of K in the first revolution;
    running_in: revolutions in which it falls to 1/e. exponent: of the pressure;
    reference_pressure: where K is Archard's, Pa. transition: product of nominal pressure and
    sliding speed, W/m^2, from which K is multiplied by ``beyond``.
    """

    name: str = "archard"
    excess: float = 0.0
    running_in: float = 1.0
    exponent: float = 1.0
    reference_pressure: float = 1e6
    transition: float = float("inf")
    beyond: float = 1.0

    def __post_init__(self) -> None:
        require_not_negative("excess", self.excess)
        for name in ("running_in", "exponent", "reference_pressure", "beyond"):
            require_positive(name, getattr(self, name))
        if not self.transition > 0.0:
            raise ModelError(
                "transition", self.transition, say("it must be greater than 0"), "W/m^2"
            )


ARCHARD = WearLaw()


@dataclass(frozen=True, slots=True)
class Bushing:
    """Bushing: material, density (kg/m^3), wear coefficient (m^2/N) and wear law.

    1 mm^3/(N m) = 1e-9 m^2/N.
    """

    material: Material
    density: float
    wear_coefficient: float
    law: WearLaw = ARCHARD

    def __post_init__(self) -> None:
        require_positive("density", self.density, "kg/m^3")
        require_not_negative("wear_coefficient", self.wear_coefficient, "m^2/N")


@dataclass(frozen=True, slots=True)
class Parameters:
    """All inputs of a computation: mechanism, joint, bushing, and the pin's material."""

    mechanism: Mechanism
    joint: Joint
    bushing: Bushing
    pin: Material
