"""The worn surface and its implicit steps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.bushing import active_set
from rigapp_model.bushing.compliance import SurfaceCompliance
from rigapp_model.bushing.contact import (
    ArcTooSmall,
    Contact,
    ContactError,
    simpson_weights,
    solve_contact,
)
from rigapp_model.bushing.ring import Ring, arc_nodes
from rigapp_model.errors import ModelError, require_not_negative, require_positive
from rigapp_model.parameters import ARCHARD, WearLaw
from rigapp_model.wear.coefficient import FAINT, shares
from rigapp_model.wear.coupled import wear_step
from rigapp_model.wear.loads import CycleLoads

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Tolerance of the conditions of contact in an implicit step, relative to the largest force.
STEP_TOLERANCE = 1e-4
# Iterations of a step whose coefficient depends on the pressure: each reduces the error to a third
# at an exponent of 1.5, to a half at 2.
_MOST_ROUNDS = 40
_ROUND_TOLERANCE = 3e-4  # of the coefficient, where wear is large; its effect on the depth is less


@dataclass(frozen=True, slots=True)
class WearProblem:
    """Constants of a life: ring, condensed mesh, width (m), K (m^2/N), wear law.

    ``compliance``: between the surface nodes that may touch.
    """

    ring: Ring
    sectors: int
    compliance: SurfaceCompliance
    width: float
    wear_coefficient: float
    law: WearLaw = ARCHARD

    def unworn(self) -> Front:
        """Return the unworn surface."""
        return Front(self.ring.circle(self.sectors))


@dataclass(frozen=True, slots=True)
class Front:
    """Worn surface, (2 x sectors, 2), m, and its last contacts.

    ``pins`` (M, 2), ``touching`` and ``force`` (M, N; N/m) of the crank positions: start of the
    next step; None before the first one.
    """

    surface: Array
    pins: Array | None = None
    touching: Flags | None = None
    force: Array | None = None

    def depth(self, inner: float) -> Array:
        """Return the radial depth of wear at each node, m; exactly 0 at unworn nodes."""
        depth = np.hypot(self.surface[:, 0], self.surface[:, 1]) - inner
        depth[np.abs(depth) < 1e-14 * inner] = 0.0
        return depth

    def depth_at_contact_point(self, inner: float) -> float:
        """Return the radial depth at the contact point, m.

        The larger one of the nodes at angle 0, the contact of a follower in tension, and opposite,
        that of a follower in compression.
        """
        depth = self.depth(inner)
        return max(float(depth[len(self.surface) // 2]), float(depth[0]), 0.0)


def wear_problem(
    ring: Ring,
    sectors: int,
    width: float,
    wear_coefficient: float,
    loads: CycleLoads,
    half_angle: float,
    law: WearLaw = ARCHARD,
) -> WearProblem:
    """Return the problem on a mesh with this number of sectors.

    half_angle: rad, of the arc about each force's direction in which nodes may touch. Raises
    ModelError for a width or a wear coefficient out of range.
    """
    require_positive("bushing_width", width, "m")
    require_not_negative("wear_coefficient", wear_coefficient, "m^2/N")
    nodes = arc_nodes(sectors, loads.direction, half_angle)
    compliance = ring.compliance(ring.mesh(sectors), nodes)
    return WearProblem(ring, sectors, compliance, width, wear_coefficient, law)


def touched(problem: WearProblem, front: Front, loads: CycleLoads) -> Front:
    """Return the front with the solved contacts of all positions, without wear."""
    surface = np.ascontiguousarray(front.surface[problem.compliance.nodes])
    force = loads.force / problem.width
    contacts = [
        solve_contact(problem.compliance, surface, problem.ring.pin_radius, each, start=start)
        for each, start in zip(force, _starts(front, len(force)), strict=True)
    ]
    return replace(
        front,
        pins=np.array([c.pin for c in contacts]),
        touching=np.array([c.touching for c in contacts]),
        force=np.array([c.force for c in contacts]),
    )


def _starts(front: Front, positions: int) -> list[Contact | None]:
    """Return the contacts of a front as starts, or None for each position."""
    if front.pins is None or len(front.pins) != positions:
        return [None] * positions
    assert front.touching is not None
    assert front.force is not None
    empty_frame = np.empty((0, 4))
    return [
        Contact(pin, force, empty_frame, empty_frame, touching, 0)
        for pin, force, touching in zip(front.pins, front.force, front.touching, strict=True)
    ]


def implicit_step(
    problem: WearProblem, front: Front, loads: CycleLoads, cycles: float, splits: int = 8
) -> Front:
    """Advance by a backward Euler step over ``cycles``, coupled over all positions.

    Unconditionally stable. If the sets of touching nodes do not converge, as with weak forces in
    the wear of strong ones, the step is halved, up to ``splits`` times. If the law depends on the
    local pressure, the step is repeated with the coefficient of its own pressures. Raises
    ContactError if a contact cannot carry its force.
    """
    require_positive("cycles", cycles)
    if problem.wear_coefficient == 0.0:
        return touched(problem, front, loads)
    if front.pins is None or len(front.pins) != len(loads.slip):
        front = touched(problem, front, loads)
    if problem.law.exponent == 1.0:
        return _step(problem, front, loads, cycles, splits)
    return _pressure_dependent_step(problem, front, loads, cycles, splits)


def _pressure_dependent_step(
    problem: WearProblem, front: Front, loads: CycleLoads, cycles: float, splits: int
) -> Front:
    """Advance by a step with the coefficient of the pressures at its end, by fixed-point iteration.

    With little wear the pressure is nearly constant and the first guess correct. With much wear the
    depth is, the pressure is inverse to the coefficient, and the correction of that is too large by
    the power of the exponent. Its root converges in both cases.
    """
    law, start = problem.law, front
    share = shares(law, contact_pressure(problem, front), loads.wearing)
    for _ in range(_MOST_ROUNDS):
        try:
            worn = _step(problem, start, loads, cycles, 0, share)
        except _Unsettled:
            break
        # Weights of the surface before the step: the step's wear is that of its pressures on these.
        assert worn.force is not None
        weights = simpson_weights(front.surface)[problem.compliance.nodes]
        target = shares(law, worn.force / weights, loads.wearing)
        pressed = loads.wearing @ worn.force
        error = np.abs(target / share - 1.0)[pressed > FAINT * pressed.max()]
        if error.max(initial=0.0) <= _ROUND_TOLERANCE:
            return worn
        share *= (target / share) ** (1.0 / max(law.exponent, 1.0))
        start = replace(front, pins=worn.pins, touching=worn.touching, force=worn.force)
    if splits <= 0:
        raise ContactError("cycles", cycles, say("pressure and wear coefficient found no balance"))
    half = _pressure_dependent_step(problem, front, loads, 0.5 * cycles, splits - 1)
    return _pressure_dependent_step(problem, half, loads, 0.5 * cycles, splits - 1)


class _Unsettled(Exception):
    """The sets of touching nodes did not converge."""


def _step(
    problem: WearProblem,
    front: Front,
    loads: CycleLoads,
    cycles: float,
    splits: int,
    share: Array | float = 1.0,
) -> Front:
    """Advance by one implicit step; share (N,): factor of K at each node.

    Without convergence it raises _Unsettled if the law has a pressure exponent, else the step is
    halved.
    """
    assert front.pins is not None
    assert front.touching is not None
    assert front.force is not None
    nodes = problem.compliance.nodes
    weights = simpson_weights(front.surface)[nodes]
    pins, touching, force = front.pins.copy(), front.touching.copy(), front.force.copy()
    surface = np.ascontiguousarray(front.surface[nodes])
    offset = np.empty((len(nodes), 2))
    resistance = weights / (cycles * problem.wear_coefficient * share)
    load = np.ascontiguousarray(loads.force / problem.width)
    compliance = problem.compliance
    if len(load) == 1:
        gap, frame = np.empty(len(nodes)), np.empty((len(nodes), 4))
        extra = loads.wearing[0] / resistance
        status, _ = active_set.solve(
            surface,
            compliance.axis,
            compliance.polar,
            extra,
            problem.ring.pin_radius,
            load[0],
            pins[0],
            touching[0],
            force[0],
            gap,
            frame,
        )
        offset = (extra * force[0])[:, None] * frame[:, :2]
    else:
        status, _ = wear_step(
            surface,
            compliance.axis,
            compliance.polar,
            resistance,
            problem.ring.pin_radius,
            load,
            loads.wearing,
            STEP_TOLERANCE,
            pins,
            touching,
            force,
            offset,
        )
    if status == active_set.NOT_SETTLED and problem.law.exponent != 1.0:
        raise _Unsettled
    if status == active_set.NOT_SETTLED and splits > 0:
        half = implicit_step(problem, front, loads, 0.5 * cycles, splits - 1)
        return implicit_step(problem, half, loads, 0.5 * cycles, splits - 1)
    _check(problem, status, touching, float(np.hypot(load[:, 0], load[:, 1]).max()))
    worn = front.surface.copy()
    worn[nodes] += offset
    refuse_worn_through(problem, worn)
    return Front(worn, pins, touching, force)


def _check(problem: WearProblem, status: int, touching: Flags, force: float) -> None:
    """Raise ContactError if a step has no solution or exceeds the arc of nodes."""
    if status != active_set.CARRIED:
        raise ContactError(
            "force",
            force,
            say("the contact of the worn bushing found no balance; the load is too high for it"),
            say("N per metre of width"),
        )
    if touching[:, problem.compliance.ends].any():
        raise ArcTooSmall(
            "force", force, say("the contact reaches beyond the arc"), say("N per metre of width")
        )


class WornThrough(ModelError):
    """The wear reaches the bushing's rim."""


def refuse_worn_through(problem: WearProblem, surface: Array) -> None:
    """Raise WornThrough if the surface reaches the rim."""
    deepest = float(np.hypot(surface[:, 0], surface[:, 1]).max()) - problem.ring.inner
    if deepest >= problem.ring.wall:
        raise WornThrough(
            "wear_depth",
            deepest * 1e3,
            say(
                "the bushing's wall of {:g} mm is worn through; give fewer cycles",
                problem.ring.wall * 1000.0,
            ),
            "mm",
        )


def contact_pressure(problem: WearProblem, front: Front) -> Array:
    """Return the pressure of each position on the surface nodes of the problem, (M, N), Pa."""
    assert front.force is not None
    return front.force / simpson_weights(front.surface)[problem.compliance.nodes]


def worn_area(problem: WearProblem, surface: Array) -> float:
    """Return the area between the unworn and the worn inner surface, m^2.

    The edges of the elements are parabolas through their three nodes, consistent with Simpson's
    weights of the pressure, so that the area is accurate on few nodes as well.
    """
    return _inside(surface) - _unworn_area(problem.ring, problem.sectors)


@lru_cache(maxsize=32)
def _unworn_area(ring: Ring, sectors: int) -> float:
    """Return the area inside the unworn surface on a mesh, m^2; cached, as each step needs it."""
    return _inside(ring.circle(sectors))


def _inside(nodes: Array) -> float:
    """Return the area inside a surface, m^2."""
    first, middle = nodes[0::2], nodes[1::2]
    last = np.concatenate([first[1:], first[:1]])
    twice_area = _cross(first, middle) + _cross(middle, last)
    return float(np.sum(4.0 * twice_area - _cross(first, last))) / 6.0


def _cross(first: Array, second: Array) -> Array:
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
