"""The worn surface and its steps: explicit as in the paper, and implicit."""

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

# Part of the largest force by which the conditions of contact may fail in an implicit step.
STEP_TOLERANCE = 1e-4
# Rounds of a step whose coefficient depends on the pressure: each leaves a third of the error at an
# exponent of 1.5, a half at 2.
_MOST_ROUNDS = 40
_ROUND_TOLERANCE = 3e-4  # of the coefficient where much wears; its part in the depth is less


@dataclass(frozen=True, slots=True)
class WearProblem:
    """The constants of a life: ring, condensed mesh, width (m), K (m^2/N), wear law.

    ``compliance`` is that between the surface nodes that may ever touch.
    """

    ring: Ring
    sectors: int
    compliance: SurfaceCompliance
    width: float
    wear_coefficient: float
    law: WearLaw = ARCHARD

    def unworn(self) -> Front:
        """Return the surface before any wear."""
        return Front(self.ring.circle(self.sectors))


@dataclass(frozen=True, slots=True)
class Front:
    """A worn surface, (2 x sectors, 2), m, and its last contacts.

    ``pins`` (M, 2), ``touching`` and ``force`` (M, N; N/m) of the crank positions: from them the
    next step starts; empty before the first one.
    """

    surface: Array
    pins: Array | None = None
    touching: Flags | None = None
    force: Array | None = None

    def depth(self, inner: float) -> Array:
        """Return the radial depth of wear at each node, m; exactly 0 where nothing wore."""
        depth = np.hypot(self.surface[:, 0], self.surface[:, 1]) - inner
        depth[np.abs(depth) < 1e-14 * inner] = 0.0
        return depth

    def depth_at_contact_point(self, inner: float) -> float:
        """Return the radial depth at the contact point, m.

        The node at angle 0, where a follower in tension bears, or the one opposite, where one in
        compression does: the deeper of the two.
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
    """Return the problem on a mesh with the given number of sectors.

    half_angle: rad; nodes further than it from every force's direction never touch.
    Raises ModelError for a width or a wear coefficient out of range.
    """
    require_positive("bushing_width", width, "m")
    require_not_negative("wear_coefficient", wear_coefficient, "m^2/N")
    nodes = arc_nodes(sectors, loads.direction, half_angle)
    compliance = ring.compliance(ring.mesh(sectors), nodes)
    return WearProblem(ring, sectors, compliance, width, wear_coefficient, law)


def touched(problem: WearProblem, front: Front, loads: CycleLoads) -> Front:
    """Return the front with the contacts of all positions solved on it, without wear."""
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
    """Return the contacts that a front carries as starts, or None for each."""
    if front.pins is None or len(front.pins) != positions:
        return [None] * positions
    assert front.touching is not None
    assert front.force is not None
    nothing = np.empty((0, 4))
    return [
        Contact(pin, force, nothing, nothing, touching, 0)
        for pin, force, touching in zip(front.pins, front.force, front.touching, strict=True)
    ]


def implicit_step(
    problem: WearProblem, front: Front, loads: CycleLoads, cycles: float, splits: int = 8
) -> Front:
    """Advance by a backward Euler step over a number of cycles, all positions together.

    Unconditionally stable. A step whose sets of touching nodes do not settle, as weak forces in the
    wear of strong ones may cause, is taken in two halves, up to ``splits`` times. Where the law
    depends on the local pressure, the step is repeated with the
    coefficient that its own pressures give. Raises ContactError when a contact cannot carry its
    force.
    """
    require_positive("cycles", cycles)
    if problem.wear_coefficient == 0.0:
        return touched(problem, front, loads)
    if front.pins is None or len(front.pins) != len(loads.slip):
        front = touched(problem, front, loads)
    if problem.law.exponent == 1.0:
        return _step(problem, front, loads, cycles, splits)
    return _raised(problem, front, loads, cycles, splits)


def _raised(
    problem: WearProblem, front: Front, loads: CycleLoads, cycles: float, splits: int
) -> Front:
    """Advance by a step whose coefficient fits the pressures at its end, by a fixed point.

    Where little wears the pressure is given and the first guess is right; where much does the depth
    is, and pressure answers a coefficient that is too large by as much as its exponent. The root of
    that converges in both.
    """
    law, start = problem.law, front
    share = shares(law, contact_pressure(problem, front), loads.wearing)
    for _ in range(_MOST_ROUNDS):
        try:
            worn = _step(problem, start, loads, cycles, 0, share)
        except _Unsettled:
            break
        # Only the pressures of the step give its wear: its surface has moved by then.
        assert worn.force is not None
        weights = simpson_weights(front.surface)[problem.compliance.nodes]
        wanted = shares(law, worn.force / weights, loads.wearing)
        pressed = loads.wearing @ worn.force
        off = np.abs(wanted / share - 1.0)[pressed > FAINT * pressed.max()]
        if off.max(initial=0.0) <= _ROUND_TOLERANCE:
            return worn
        share *= (wanted / share) ** (1.0 / max(law.exponent, 1.0))
        start = replace(front, pins=worn.pins, touching=worn.touching, force=worn.force)
    if splits <= 0:
        raise ContactError("cycles", cycles, say("pressure and wear coefficient found no balance"))
    half = _raised(problem, front, loads, 0.5 * cycles, splits - 1)
    return _raised(problem, half, loads, 0.5 * cycles, splits - 1)


class _Unsettled(Exception):
    """The sets of touching nodes did not settle."""


def _step(
    problem: WearProblem,
    front: Front,
    loads: CycleLoads,
    cycles: float,
    splits: int,
    share: Array | float = 1.0,
) -> Front:
    """Advance by one implicit step; share (N,): factor of K at each node.

    With a share that cannot settle it raises _Unsettled, else it is taken in halves.
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
    """Raise ContactError when a step has no solution or left the arc of nodes."""
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
    """The wear has reached the bushing's rim."""


def refuse_worn_through(problem: WearProblem, surface: Array) -> None:
    """Raise WornThrough when the surface reaches the rim."""
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
    """Return the pressure of every position on the surface nodes of the problem, (M, N), Pa."""
    assert front.force is not None
    return front.force / simpson_weights(front.surface)[problem.compliance.nodes]


def worn_area(problem: WearProblem, surface: Array) -> float:
    """Return the area between the unworn and the worn inner surface, m^2.

    The edges of the elements are parabolas through their three nodes, to which Simpson's weights
    of the pressure belong: so the area is that of the worn length times depth, also on few nodes.
    """
    return _inside(surface) - _unworn_area(problem.ring, problem.sectors)


@lru_cache(maxsize=32)
def _unworn_area(ring: Ring, sectors: int) -> float:
    """Return the area inside the unworn surface on a mesh, m^2, which every step needs."""
    return _inside(ring.circle(sectors))


def _inside(nodes: Array) -> float:
    """Return the area inside a surface, m^2."""
    first, middle = nodes[0::2], nodes[1::2]
    last = np.concatenate([first[1:], first[:1]])
    bulged = _cross(first, middle) + _cross(middle, last)
    return float(np.sum(4.0 * bulged - _cross(first, last))) / 6.0


def _cross(first: Array, second: Array) -> Array:
    return first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
