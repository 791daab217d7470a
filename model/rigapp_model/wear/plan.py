"""Discretisation for a tolerance: crank positions, mesh and arc."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.bushing.contact import ArcTooSmall
from rigapp_model.bushing.ring import MOST_NODES, SECTORS, Ring, arc_nodes, sectors_at_least
from rigapp_model.errors import ModelError
from rigapp_model.parameters import WearLaw
from rigapp_model.wear.archard import rigid_half_angle, rigid_wear
from rigapp_model.wear.front import (
    Front,
    WearProblem,
    implicit_step,
    wear_problem,
    worn_area,
)
from rigapp_model.wear.loads import WIDE_SWING, CycleLoads, swing
from rigapp_model.wear.richardson import EARLY_TOLERANCE

Array = NDArray[np.float64]
LoadsOf = Callable[[int], CycleLoads]

# Limited to 96: without a spring the remaining error is 0.3 % of the depth, and is reported.
POSITIONS = (4, 6, 8, 12, 16, 24, 32, 48, 64, 96)
_MESH_ERROR = 0.3  # twice the largest error in a comparison of meshes
# Shares of the tolerance: positions, mesh and steps, with life's _SAFETY, are below 0.9 of it.
_POSITION_SHARE, _MESH_SHARE, TIME_SHARE = 0.15, 0.33, 0.22
_WIDE_SHARE = 0.165  # share of positions that converge slowly, with a varying force direction
_EARLY_PART = 0.01  # of a life: the contact is narrow, and the relative error large
FAINTEST = 1e-9
"""Least force over modulus, radius and width: the finest mesh does not resolve a weaker contact."""
SAMPLING_COVERAGE = 3.0
"""Bound of the error of sampled forces, in standard errors."""


@dataclass(frozen=True, slots=True)
class RelativeError:
    """Relative error of a depth or of an area over a life of ``cycles``.

    ``early``, ``late``: after a hundredth and at the end of the life.
    """

    early: float
    late: float
    cycles: float

    def after(self, cycles: Array) -> Array:
        """Return a bound of the relative error after ``cycles``.

        A power law between the two known values. Before the early one the contact is narrower, with
        the root of the cycles, and has fewer positions: there it is proportional to the inverse of
        the cycles, which bounded 14 random lives; the inverse root was up to 1.3 times too low.
        """
        part = np.maximum(cycles / self.cycles, 1e-12)
        early, late = max(self.early, 1e-12), max(self.late, 1e-12)
        power = np.log(late / early) / np.log(1.0 / _EARLY_PART)
        before = np.minimum(early * _EARLY_PART / part, 1.0)
        return np.where(part < _EARLY_PART, before, early * (part / _EARLY_PART) ** power)


@dataclass(frozen=True, slots=True)
class LifePlan:
    """Discretisation of a life.

    ``positions``: of the crank, with their errors in depth and in worn area, by comparison with
    twice as many; ``sectors`` of the mesh, and of the ``coarse`` mesh of that comparison;
    ``half_angle`` (rad) of the arc of nodes.
    """

    positions: int
    depth_error: RelativeError
    area_error: RelativeError
    sectors: int
    coarse: int
    half_angle: float


def plan_life(
    ring: Ring,
    width: float,
    wear_coefficient: float,
    law: WearLaw,
    loads_of: LoadsOf,
    cycles: float,
    tolerance: float,
    single: bool = False,
    alive: Callable[[], None] = lambda: None,
) -> LifePlan:
    """Choose crank positions and mesh by a few steps over the whole life on a coarse mesh.

    loads_of: loads of a revolution for a number of positions; single: one force, the same for any
    number; alive: called between steps, may raise. Raises ContactError if the bushing cannot carry
    the force.
    """
    loads = loads_of(1 if single else 72).pressing()
    if not loads.slip.size:
        raise ModelError("force", 0.0, say("without force or slip there is no wear"), "N")
    force = float(loads.magnitude.max())
    least = FAINTEST * ring.modulus * ring.inner * width
    if force < least:
        raise ModelError(
            "force",
            force,
            say("too small for a contact that elements can see; it needs {:.1g} N", least),
            "N",
        )
    half = expected_half_angle(ring, width, wear_coefficient, loads, cycles)
    window = min(1.4 * half + 0.15, np.pi)
    arguments = (ring, width, wear_coefficient, law, loads_of, cycles, tolerance, single)
    while True:
        try:
            return _planned(*arguments, window, alive)
        except ArcTooSmall:
            if window >= np.pi:
                raise
            window = min(1.7 * window, np.pi)


def mesh_error(nodes_in_half: Array) -> Array:
    """Return a bound of the depth's relative error for a number q of nodes in half the contact.

    0.3 / q^2 (1 + 12 / q^2), from a comparison of meshes: about twice the largest error.
    """
    inverse = 1.0 / np.square(nodes_in_half)
    return np.minimum(_MESH_ERROR * inverse * (1.0 + 12.0 * inverse), 1.0)


def nodes_for(error: float) -> float:
    """Return the nodes in half the contact for a bound of the relative error."""
    inverse = (np.sqrt(1.0 + 48.0 * error / _MESH_ERROR) - 1.0) / 24.0
    return float(1.0 / np.sqrt(inverse))


def expected_half_angle(
    ring: Ring, width: float, wear_coefficient: float, loads: CycleLoads, cycles: float
) -> float:
    """Return an upper estimate of the contact's half-angle at the end, rad.

    The larger one of that of the unworn bushing and that of a rigid pin that wears at one angle.
    """
    elastic = ring.half_angle(float(loads.magnitude.max()) / width)
    if ring.clearance <= 0.0:
        return float(0.5 * np.pi)
    try:
        depth = rigid_wear(
            ring.inner,
            ring.pin_radius,
            loads.mean_force / width,
            wear_coefficient,
            float(loads.wearing.sum()),
            cycles,
        ).depth
    except ModelError:
        return float(0.5 * np.pi)
    return max(elastic, rigid_half_angle(ring.inner, ring.pin_radius, float(depth)))


def _planned(
    ring: Ring,
    width: float,
    wear_coefficient: float,
    law: WearLaw,
    loads_of: LoadsOf,
    cycles: float,
    tolerance: float,
    single: bool,
    window: float,
    alive: Callable[[], None],
) -> LifePlan:
    """Return the plan for an arc of nodes; raise ArcTooSmall if the contact exceeds it."""

    def problem(sectors: int, loads: CycleLoads) -> WearProblem:
        return wear_problem(ring, sectors, width, wear_coefficient, loads, window, law)

    dense = loads_of(1 if single else 72).pressing()
    wide = swing(dense) > WIDE_SWING
    unworn_half = ring.half_angle(float(dense.magnitude.max()) / width)
    most = _most_sectors(dense, window)
    coarse = min(sectors_at_least(np.pi / 2.0 * 4.0 / unworn_half), most)
    ends: dict[int, tuple[tuple[Front, float], ...]] = {}

    def end(positions: int) -> tuple[tuple[Front, float], ...]:
        if positions not in ends:
            alive()
            loads = loads_of(positions).pressing()
            ends[positions] = _coarse_life(problem(coarse, loads), loads, cycles)
        return ends[positions]

    positions, early, late = 1, 0.0, 0.0
    areas = (0.0, 0.0)
    compared = _difference if wide else _largest_difference
    if not single:
        for positions in POSITIONS:
            (first, first_area), (last, last_area) = end(positions)
            (other_first, other_first_area), (other_last, other_last_area) = end(2 * positions)
            early = _largest_difference(first, other_first, ring.inner)
            late = compared(last, other_last, ring.inner)
            areas = (
                _relative_difference(first_area, other_first_area),
                _relative_difference(last_area, other_last_area),
            )
            share = _WIDE_SHARE if wide else _POSITION_SHARE
            if late <= share * tolerance and early <= EARLY_TOLERANCE * tolerance:
                break
    final = end(positions)[-1][0]
    assert final.touching is not None
    worn_half = 0.5 * (float(final.touching.sum(axis=1).max()) - 1.0) * np.pi / coarse
    nodes_per_rad = max(
        nodes_for(_MESH_SHARE * tolerance) / max(worn_half, unworn_half),
        nodes_for(8.0 * tolerance) / unworn_half,
        3.0 / unworn_half,
    )
    sectors = min(sectors_at_least(nodes_per_rad * np.pi), most)
    return LifePlan(
        positions,
        RelativeError(1.5 * early, 1.5 * late, cycles),
        RelativeError(1.5 * areas[0], 1.5 * areas[1], cycles),
        sectors,
        coarse,
        window,
    )


def _coarse_life(
    problem: WearProblem, loads: CycleLoads, cycles: float
) -> tuple[tuple[Front, float], ...]:
    """Return fronts and areas after a hundredth and at the end of the life, in three steps."""
    early = implicit_step(problem, problem.unworn(), loads, _EARLY_PART * cycles)
    middle = implicit_step(problem, early, loads, 0.2 * cycles)
    late = implicit_step(problem, middle, loads, (0.8 - _EARLY_PART) * cycles)
    return tuple((front, worn_area(problem, front.surface)) for front in (early, late))


def sampling_errors(
    ring: Ring,
    width: float,
    wear_coefficient: float,
    law: WearLaw,
    plan: LifePlan,
    all_loads: CycleLoads,
    samples: Sequence[CycleLoads],
    cycles: float,
) -> tuple[RelativeError, RelativeError]:
    """Return bounds of the errors of depth and of area due to the sampling of forces.

    all_loads: of all revolutions; samples: of parts of them. Each part gives a coarse life; the
    standard error of the mean is their spread over sqrt(parts). The bound is three times that plus
    the bias of their mean, as the larger scatter of a part causes more local depth.
    """
    none = RelativeError(0.0, 0.0, cycles)
    if len(samples) < 2:
        return none, none
    lives = []
    for loads in (all_loads, *samples):
        problem = wear_problem(
            ring, plan.coarse, width, wear_coefficient, loads, plan.half_angle, law
        )
        ends = _coarse_life(problem, loads, cycles)
        lives.append([(float(front.depth(ring.inner).max()), area) for front, area in ends])
    all_life, parts = np.array(lives[0]), np.array(lives[1:])
    spread = parts.std(axis=0, ddof=1) / np.sqrt(len(samples))
    bias = np.abs(parts.mean(axis=0) - all_life) / (len(samples) - 1)
    part = (SAMPLING_COVERAGE * spread + bias) / np.maximum(np.abs(all_life), 1e-300)
    of_depth, of_area = (RelativeError(float(e), float(end), cycles) for e, end in part.T)
    return of_depth, of_area


def _relative_difference(first: float, second: float) -> float:
    """Return the difference of two areas relative to the second."""
    return abs(first - second) / max(abs(second), 1e-300)


def _largest_difference(first: Front, second: Front, inner: float) -> float:
    """Return the largest difference of two fronts in the deep region, relative to the depth."""
    a, b = first.depth(inner), second.depth(inner)
    deepest = float(b.max())
    return float(np.abs(a - b)[b >= 0.5 * deepest].max()) / max(deepest, 1e-300)


def _difference(first: Front, second: Front, inner: float) -> float:
    """Return the difference of two fronts relative to the depth.

    The larger one of the difference of their largest depths and of the root mean square in the deep
    region: few positions cause small pits, which do not affect the depth.
    """
    a, b = first.depth(inner), second.depth(inner)
    deepest = float(b.max())
    deep = b >= 0.5 * deepest
    spread = float(np.sqrt(np.mean(np.square(a - b)[deep])))
    return max(abs(float(a.max()) - deepest), spread) / max(deepest, 1e-300)


def _most_sectors(loads: CycleLoads, window: float) -> int:
    """Return the largest number of sectors with at most MOST_NODES on the arc."""
    share = len(arc_nodes(1440, loads.direction, window)) / 2880.0
    most = 0.5 * MOST_NODES / share
    return max([n for n in SECTORS if n <= most], default=SECTORS[0])
