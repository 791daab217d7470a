"""Life of the bushing: coupled mechanism and wear, with the error of the result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.bushing.compliance import surface_angles
from rigapp_model.bushing.contact import ArcTooSmall, refuse_beyond_elasticity
from rigapp_model.bushing.ring import ContactModel, Ring, pressure_distribution, ring_of
from rigapp_model.errors import ModelError, OutOfTime, require_finite, require_positive
from rigapp_model.parameters import ARCHARD, Parameters
from rigapp_model.wear.coefficient import cycles_at, steady_cycles
from rigapp_model.wear.explicit import Extrapolation, explicit_moments, extrapolation
from rigapp_model.wear.forces import ForceSource, constant_source
from rigapp_model.wear.front import Front, WearProblem, wear_problem
from rigapp_model.wear.laws import sentence_of
from rigapp_model.wear.loads import CycleLoads
from rigapp_model.wear.plan import (
    TIME_SHARE,
    LifePlan,
    RelativeError,
    mesh_error,
    plan_life,
    sampling_errors,
)
from rigapp_model.wear.profile import profile
from rigapp_model.wear.richardson import Moment, integrate
from rigapp_model.wear.techniques import LifeOptions, technique_of

Array = NDArray[np.float64]
Method = Literal["implicit", "explicit"]

# Error due to the tolerance of the coupled contact solution, relative to the depth.
_SOLUTION_ERROR = 3e-5
FAINTEST_WEAR = 1e-11
"""Least wear depth over the bushing's radius: steps resolve 1e-16 of it, so this depth to 1e-5."""
_SAFETY = 1.25  # factor from estimates by two runs to a bound


@dataclass(frozen=True, slots=True)
class Life:
    """Life of a bushing in SI; each column has one entry per row, the last row is the end.

    Columns: ``cycles``; ``max_depth`` (m); ``worn_area`` (m^2); ``worn_mass`` (kg);
    ``peak_pressure`` (Pa); ``mean_force`` (N, over the slip); ``peak_force`` (N);
    ``clearance`` (m): R2 - R1 in the mechanism; ``estimated_error`` (m) of the depth,
    ``area_error`` (m^2), ``mass_error`` (kg): bounds of the error due to steps, crank positions,
    mesh, coupling and sampled forces together.
    Profile: ``angle`` (rad) from -pi in the follower frame, 0 at the initial contact point;
    ``depth`` (m). ``positions``, ``sectors``, ``steps``: as used. ``notes``: messages that the user
    must read. ``tolerance_met``: whether the error at the end is within the tolerance.
    ``complete``: whether the last row is the requested end; False after a time-out.
    ``extrapolation``: of explicit steps; None for implicit ones.
    """

    technique: str
    cycles: Array
    max_depth: Array
    worn_area: Array
    worn_mass: Array
    peak_pressure: Array
    mean_force: Array
    peak_force: Array
    clearance: Array
    estimated_error: Array
    area_error: Array
    mass_error: Array
    angle: Array
    depth: Array
    positions: int
    sectors: int
    steps: int
    notes: tuple[str, ...]
    tolerance_met: bool
    complete: bool
    extrapolation: Extrapolation | None


def life(
    parameters: Parameters,
    speed: float,
    cycles: float,
    technique: str = "continuous",
    tolerance: float = 1e-3,
    force: float | None = None,
    progress: Callable[[float], None] | None = None,
    evolving: bool = True,
    method: Method = "implicit",
    step: float | None = None,
    contact: ContactModel = "finite-element",
    rows: ArrayLike | None = None,
) -> Life:
    """Compute the wear of the bushing over a number of crank cycles.

    speed: of the crank, rad/s; technique: one of ``TECHNIQUES``; tolerance: of the depth at the
    end, relative; force: constant force along the follower, N, instead of that of the mechanism;
    evolving: False uses the initial clearance in "continuous" throughout; method: "implicit", with
    steps to suit the tolerance, or "explicit", as in the paper, with steps of at most ``step``
    cycles, None: half the stability limit; contact: elastic bushing or elastic foundation,
    "winkler"; rows: cycles to report, increasing, with or without the end, None: 1, 3, 10, ...;
    progress: called with the fraction done. It may raise OutOfTime: the life then ends with the
    last row, or the exception propagates if there is none. Raises ModelError, ContactError or
    WornThrough with the cause, UnstableStep for a step beyond the stability limit.
    """
    require_positive("cycles", cycles)
    require_finite("speed", speed, "rad/s")
    require_positive("tolerance", tolerance)
    law = parameters.bushing.law
    if method == "explicit" and law.exponent != 1.0:
        raise ModelError(
            "exponent",
            law.exponent,
            say(
                "a limit for explicit steps is known only for wear proportional to pressure;"
                " use implicit steps"
            ),
        )
    ring = ring_of(parameters.joint, parameters.bushing.material, contact=contact)
    if force is None and speed == 0.0:
        raise ModelError("speed", speed, say("a stationary crank causes no wear"), "rad/s")
    report = progress or (lambda part: None)
    source = (
        technique_of(technique).source(
            parameters, LifeOptions(speed, tolerance, lambda: report(0.0), evolving)
        )
        if force is None
        else constant_source(force, parameters.joint, speed, law)
    )
    width, coefficient = parameters.joint.bushing_width, parameters.bushing.wear_coefficient
    joint = (ring, width, coefficient, law)
    steady = float(steady_cycles(law, cycles))
    plan = plan_life(*joint, source.unworn, steady, tolerance, source.single, lambda: report(0.0))
    unworn = source.unworn(plan.positions)
    _refuse_faint_wear(parameters, unworn, steady)
    explicit = None
    if method == "explicit":
        explicit = extrapolation(ring, plan.sectors, coefficient, unworn, step)
    model_notes = simplification(ring, float(unworn.magnitude.max()) / width)
    parts = source.samples(plan.positions)
    sampling = sampling_errors(*joint, plan, unworn.pressing(), parts, steady)
    reported_rows = row_cycles(cycles) if rows is None else _requested_rows(rows, cycles)
    task = _Task(
        parameters, ring, source, plan, technique, tolerance, cycles, explicit, reported_rows
    )
    computed = _life(task, sampling, _moments(task, report))
    by_law = () if law == ARCHARD else (sentence_of(law.name),)
    return replace(computed, notes=model_notes + by_law + computed.notes)


@dataclass(frozen=True, slots=True)
class _Task:
    """Inputs, plan and options of a life."""

    parameters: Parameters
    ring: Ring
    source: ForceSource
    plan: LifePlan
    technique: str
    tolerance: float
    cycles: float
    explicit: Extrapolation | None
    rows: Array


def _moments(task: _Task, report: Callable[[float], None]) -> list[Moment]:
    """Integrate the life; repeat it on a larger arc if the contact exceeds the arc.

    If ``report`` raises OutOfTime after the first step, the moments so far are returned. Rows,
    steps and moments are in the law's progress: cycles at the steady coefficient.
    """
    plan, source, explicit = task.plan, task.source, task.explicit
    window, law = plan.half_angle, task.parameters.bushing.law
    rows = steady_cycles(law, task.rows)
    end = float(rows[-1])

    def loads_at(front: Front, at: float) -> CycleLoads:
        return source.at(front, float(cycles_at(law, at)), plan.positions)

    while True:
        problem = wear_problem(
            task.ring,
            plan.sectors,
            task.parameters.joint.bushing_width,
            task.parameters.bushing.wear_coefficient,
            source.unworn(plan.positions),
            window,
            law,
        )
        moments: list[Moment] = []
        try:
            course = (
                integrate(problem, loads_at, rows, TIME_SHARE * task.tolerance)
                if explicit is None
                else explicit_moments(
                    problem, loads_at, rows, explicit.step, lambda done: report(done / end)
                )
            )
            for moment in course:
                if not moments:
                    _refuse_overload(problem, moment)
                moments.append(moment)
                report(moment.cycles / end)
        except OutOfTime:
            if len(moments) < 2:
                raise
            return moments
        except ArcTooSmall:
            if window >= np.pi:
                raise
            window = min(1.7 * window, np.pi)
        else:
            return moments


def simplification(ring: Ring, force: float) -> tuple[str, ...]:
    """Return a message on the unworn pressure of an elastic foundation under a force (N/m).

    Empty for an elastic bushing. Raises ContactError if the foundation cannot carry the force.
    """
    if ring.contact == "finite-element":
        return ()
    foundation, elastic = (
        1e-6 * float(pressure_distribution(each, (force, 0.0)).pressure.max())
        for each in (ring, replace(ring, contact="finite-element"))
    )
    side = "below" if foundation < elastic else "above"
    return (
        say(
            "Contact winkler: the bushing is a bed of springs. Unworn, its peak pressure of"
            " {:.4g} MPa is {:.0%} {} the {:.4g} MPa of an elastic bushing; the stated"
            " errors are those of the computation, not of this simplification.",
            foundation,
            abs(foundation / elastic - 1.0),
            side,
            elastic,
        ),
    )


def _refuse_faint_wear(parameters: Parameters, loads: CycleLoads, cycles: float) -> None:
    """Raise ModelError if the wear is lost in rounding; a coefficient of 0 is allowed."""
    joint, coefficient = parameters.joint, parameters.bushing.wear_coefficient
    pressure = loads.mean_force / (2.0 * joint.pin_radius * joint.bushing_width)
    unit = pressure * float(loads.wearing.sum()) * cycles
    least = FAINTEST_WEAR * joint.bushing_radius
    if 0.0 < coefficient * unit < least:
        raise ModelError(
            "wear_coefficient",
            coefficient,
            say(
                "the wear of these cycles is below the resolution of the numbers; give 0, or at"
                " least {:.1g}, or more cycles",
                least / unit,
            ),
            "m^2/N",
        )


def _refuse_overload(problem: WearProblem, unworn: Moment) -> None:
    """Raise ContactError if the unworn bushing is loaded beyond linear elasticity."""
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
    """Return the default rows: 1, 3, 10, ... of the last three and a half decades, and the end."""
    series = [lead * 10.0**power for power in range(13) for lead in (1.0, 3.0)]
    rows = [n for n in series if cycles / 3000.0 <= n < 0.95 * cycles]
    return np.array([*rows, cycles])


def _requested_rows(rows: ArrayLike, cycles: float) -> Array:
    """Return the requested rows with the end of the life; raise ModelError if not increasing."""
    selected = np.atleast_1d(np.asarray(rows, dtype=np.float64))
    selected = selected[selected < cycles]
    if selected.size and not (selected[0] > 0.0 and np.all(np.diff(selected) > 0.0)):
        raise ModelError("rows", say("not increasing"), say("give increasing cycles above 0"))
    return np.append(selected, cycles)


def _life(
    task: _Task, sampling: tuple[RelativeError, RelativeError], moments: list[Moment]
) -> Life:
    """Return the life from its moments."""
    parameters, source, cycles = task.parameters, task.source, task.cycles
    fronts = [Front(m.surface) for m in moments]
    depth = np.array([f.depth(task.ring.inner).max() for f in fronts])
    done = np.array([m.cycles for m in moments])
    area = np.array([m.area for m in moments])
    mean_force = np.array([m.mean_force for m in moments])
    by_depth, by_area = _errors(task, sampling, moments, depth, area)
    error, area_error = (
        _SAFETY * sum(parts.values(), np.zeros(len(moments))) for parts in (by_depth, by_area)
    )
    mass_per_area = parameters.joint.bushing_width * parameters.bushing.density
    met = bool(error[-1] <= task.tolerance * depth[-1] or depth[-1] == 0.0)
    notes = list(source.notes(moments[-1].front))
    if not met:
        worst = max(by_depth, key=lambda name: float(by_depth[name][-1]))
        shorter = task.explicit is not None and worst == "time steps"
        notes.append(
            say(
                "The estimated error of the depth, {:.2g} of it, exceeds the tolerance of"
                " {:g}; most of it is by the {}{}.",
                error[-1] / depth[-1],
                task.tolerance,
                worst,
                say(": take shorter explicit steps") if shorter else "",
            )
        )
    law = parameters.bushing.law
    if law.exponent == 1.0 and law.beyond == 1.0:
        least = _least_area(parameters, done, mean_force)
        notes += below_archard(area[-1], area_error[-1], least)
    complete = bool(done[-1] >= steady_cycles(law, cycles))
    done = cycles_at(law, done)
    if not complete:
        notes.append(
            say(
                "Time ran out after {:.6g} of {:.0f} cycles; the last row is not the end of"
                " the life.",
                done[-1],
                cycles,
            )
        )
    ends = profile(moments[-1].surface, task.ring)
    return Life(
        technique=task.technique,
        cycles=done,
        max_depth=depth,
        worn_area=area,
        worn_mass=area * mass_per_area,
        peak_pressure=np.array([m.peak_pressure for m in moments]),
        mean_force=mean_force,
        peak_force=np.array([m.peak_force for m in moments]),
        clearance=np.array([source.clearance(f) for f in fronts]),
        estimated_error=error,
        area_error=area_error,
        mass_error=area_error * mass_per_area,
        angle=np.append(surface_angles(task.plan.sectors), np.pi),
        depth=np.append(ends, ends[0]),
        positions=task.plan.positions,
        sectors=task.plan.sectors,
        steps=sum(m.steps for m in moments),
        notes=tuple(notes),
        tolerance_met=met,
        complete=complete,
        extrapolation=task.explicit,
    )


def _errors(
    task: _Task,
    sampling: tuple[RelativeError, RelativeError],
    moments: list[Moment],
    depth: Array,
    area: Array,
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Return the errors of the depth (m) and of the worn area (m^2), by cause.

    The mesh's bound for the depth is used for both, as the area converges faster. The relative
    error of a force is that of the area, and an upper bound for the depth.
    """
    done = np.array([m.cycles for m in moments])
    mesh = mesh_error(np.array([0.5 * m.nodes_in_contact for m in moments])) + _SOLUTION_ERROR
    law = task.parameters.bushing.law
    coupling = np.array([task.source.coupling_error(float(cycles_at(law, c))) for c in done])
    of_depth = {
        "time steps": np.array([m.time_error for m in moments]),
        "crank positions": task.plan.depth_error.after(done) * depth,
        "mesh": mesh * depth,
        "forces kept while the surface wears": coupling,
        "sampling of revolutions with lost contact": sampling[0].after(done) * depth,
    }
    of_area = {
        "time steps": np.array([m.area_error for m in moments]),
        "crank positions": task.plan.area_error.after(done) * area,
        "mesh": mesh * area,
        "forces kept while the surface wears": area * coupling / np.maximum(depth, 1e-300),
        "sampling of revolutions with lost contact": sampling[1].after(done) * area,
    }
    return of_depth, of_area


def _least_area(parameters: Parameters, cycles: Array, mean_force: Array) -> float:
    """Return the worn area (m^2) by Archard's law with the force for the sum of the pressure."""
    weaker = np.minimum(mean_force[1:], mean_force[:-1])
    joint = parameters.joint
    slip = 2.0 * np.pi * joint.pin_radius
    rate = parameters.bushing.wear_coefficient * slip / joint.bushing_width
    return float(rate * (weaker @ np.diff(cycles)))


def below_archard(area: float, error: float, least: float) -> list[str]:
    """Return a message if a worn area (m^2) plus its error is less than physically possible.

    Pressures on both sides of a contact partly cancel, so that their sum is at least the force.
    """
    if area + error >= least:
        return []
    return [
        say(
            "The worn area, {:.4f} of what Archard's law makes of the force itself, is less"
            " than possible even with its stated error: do not use this result; give a"
            " smaller tolerance.",
            area / least,
        )
    ]
