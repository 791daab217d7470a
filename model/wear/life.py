"""The life of the bushing: mechanism and wear coupled, with the error of the result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from model.bushing.compliance import surface_angles
from model.bushing.contact import refuse_beyond_elasticity
from model.bushing.ring import Ring, ring_of
from model.errors import ModelError, require_finite, require_positive
from model.parameters import Parameters
from model.wear.forces import ForceSource, constant_source, force_source
from model.wear.front import ArcTooSmall, Front, WearProblem, wear_problem
from model.wear.plan import TIME_SHARE, Plan, mesh_error, plan_life
from model.wear.profile import profile
from model.wear.richardson import Moment, integrate

Array = NDArray[np.float64]
Technique = Literal["perfect", "continuous", "contact"]

# What the tolerance of the coupled contact solution can add, as a part of the depth.
_SOLUTION_ERROR = 3e-5
_SAFETY = 1.25


@dataclass(frozen=True, slots=True)
class Life:
    """Hold the life of a bushing in SI; one entry of each column a row, the last is the end.

    Columns: ``cycles``; ``max_depth`` (m); ``worn_area`` (m^2); ``worn_mass`` (kg);
    ``peak_pressure`` (Pa); ``mean_force`` (N, over the slip); ``peak_force`` (N);
    ``clearance`` (m): R2 - R1 as the mechanism sees it; ``estimated_error`` (m) of the depth:
    steps, crank positions, mesh and coupling together, not less than the true one.
    Profile: ``angle`` (rad) from -pi in the follower frame, 0 at the initial contact point;
    ``depth`` (m). ``positions``, ``sectors``, ``steps``: what it took. ``notes``: sentences that
    the user must read. ``tolerance_met``: whether the error at the end is within the tolerance.
    """

    technique: Technique
    cycles: Array
    max_depth: Array
    worn_area: Array
    worn_mass: Array
    peak_pressure: Array
    mean_force: Array
    peak_force: Array
    clearance: Array
    estimated_error: Array
    angle: Array
    depth: Array
    positions: int
    sectors: int
    steps: int
    notes: tuple[str, ...]
    tolerance_met: bool


def life(
    parameters: Parameters,
    speed: float,
    cycles: float,
    technique: Technique = "continuous",
    tolerance: float = 1e-3,
    force: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> Life:
    """Compute the wear of the bushing over so many crank cycles.

    speed: of the crank, rad/s; technique: "perfect" keeps the kinematics, "continuous" lets the
    follower grow by the wear at the contact point, "contact" takes the forces from pin and bushing
    as separate bodies; tolerance: of the depth at the end, as a part of it; force: a constant
    force along the follower, N, instead of the mechanism's; progress: called with the part done.
    Raises ModelError, ContactError or WornThrough naming what is wrong.
    """
    require_positive("cycles", cycles)
    require_finite("speed", speed, "rad/s")
    require_positive("tolerance", tolerance)
    ring = ring_of(parameters.joint, parameters.bushing.material)
    if force is None and speed == 0.0:
        raise ModelError("speed", speed, "a crank that stands still wears nothing", "rad/s")
    source = (
        force_source(parameters, speed, technique)
        if force is None
        else constant_source(force, parameters.joint)
    )
    width, coefficient = parameters.joint.bushing_width, parameters.bushing.wear_coefficient
    plan = plan_life(ring, width, coefficient, source.unworn, cycles, tolerance, source.single)
    moments = _moments(parameters, ring, source, plan, cycles, tolerance, progress)
    return _life(parameters, ring, source, plan, moments, technique, tolerance)


def _moments(
    parameters: Parameters,
    ring: Ring,
    source: ForceSource,
    plan: Plan,
    cycles: float,
    tolerance: float,
    progress: Callable[[float], None] | None,
) -> list[Moment]:
    """Run the life on its plan, again on a larger arc when the contact outgrows it."""
    window = plan.half_angle
    while True:
        problem = wear_problem(
            ring,
            plan.sectors,
            parameters.joint.bushing_width,
            parameters.bushing.wear_coefficient,
            source.unworn(plan.positions),
            window,
        )
        moments: list[Moment] = []
        try:
            for moment in integrate(
                problem,
                lambda front, at: source.at(front, at, plan.positions),
                row_cycles(cycles),
                TIME_SHARE * tolerance,
            ):
                if not moments:
                    _refuse_overload(problem, moment)
                moments.append(moment)
                if progress is not None:
                    progress(moment.cycles / cycles)
        except ArcTooSmall:
            if window >= np.pi:
                raise
            window = min(1.7 * window, np.pi)
        else:
            return moments


def _refuse_overload(problem: WearProblem, unworn: Moment) -> None:
    """Raise ContactError when the unworn bushing is loaded beyond linear elasticity."""
    assert unworn.front.pins is not None
    ring, surface = problem.ring, unworn.front.surface
    refuse_beyond_elasticity(
        unworn.peak_force / problem.width,
        max(ring.indentation(surface, pin) for pin in unworn.front.pins),
        ring.wall,
        unworn.peak_pressure,
        ring.modulus,
    )


def row_cycles(cycles: float) -> Array:
    """Return the cycles to report: 1, 3, 10, ... in the last three and a half decades; the end."""
    series = [lead * 10.0**power for power in range(13) for lead in (1.0, 3.0)]
    rows = [n for n in series if cycles / 3000.0 <= n < 0.95 * cycles]
    return np.array([*rows, cycles])


def _life(
    parameters: Parameters,
    ring: Ring,
    source: ForceSource,
    plan: Plan,
    moments: list[Moment],
    technique: Technique,
    tolerance: float,
) -> Life:
    """Return the record of a run's moments."""
    bushing, width = parameters.bushing, parameters.joint.bushing_width
    angle = np.append(surface_angles(plan.sectors), np.pi)
    fronts = [Front(m.surface) for m in moments]
    depth = np.array([f.depth(ring.inner).max() for f in fronts])
    inside = np.array([0.5 * m.nodes_in_contact for m in moments])
    done = np.array([m.cycles for m in moments])
    parts = {
        "time steps": np.array([m.time_error for m in moments]),
        "crank positions": plan.position_error(done) * depth,
        "mesh": (mesh_error(inside) + _SOLUTION_ERROR) * depth,
        "forces kept while the surface wears": np.array(
            [source.coupling_error(m.cycles) for m in moments]
        ),
    }
    error = _SAFETY * sum(parts.values(), np.zeros(len(moments)))
    area = np.array([m.area for m in moments])
    met = bool(error[-1] <= tolerance * depth[-1] or depth[-1] == 0.0)
    notes = list(source.notes(moments[-1].front))
    if not met:
        worst = max(parts, key=lambda name: float(parts[name][-1]))
        notes.append(
            f"The estimated error of the depth, {error[-1] / depth[-1]:.2g} of it, exceeds the"
            f" tolerance of {tolerance:g}; most of it is by the {worst}."
        )
    ends = profile(moments[-1].surface, ring)
    return Life(
        technique=technique,
        cycles=done,
        max_depth=depth,
        worn_area=area,
        worn_mass=area * width * bushing.density,
        peak_pressure=np.array([m.peak_pressure for m in moments]),
        mean_force=np.array([m.mean_force for m in moments]),
        peak_force=np.array([m.peak_force for m in moments]),
        clearance=np.array([source.clearance(f) for f in fronts]),
        estimated_error=error,
        angle=angle,
        depth=np.append(ends, ends[0]),
        positions=plan.positions,
        sectors=plan.sectors,
        steps=7 * (len(moments) - 1),
        notes=tuple(notes),
        tolerance_met=met,
    )
