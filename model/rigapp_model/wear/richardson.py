"""Integration of wear with an error estimate: three parallel runs, each with half the step.

Backward Euler is of first order; two runs extrapolate to second order (Richardson). Three runs
give two such results, and their difference is three times the error of the better one. The runs
are independent over the whole life, so that the difference is the error of the life and not that
of a step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_model.errors import ModelError
from rigapp_model.wear.front import (
    Front,
    WearProblem,
    contact_pressure,
    implicit_step,
    touched,
    worn_area,
)
from rigapp_model.wear.loads import CycleLoads

Array = NDArray[np.float64]
LoadsAt = Callable[[Front, float], CycleLoads]

# Relative error allowed early in a life, in tolerances; decreases with the root of the cycles.
EARLY_TOLERANCE = 5.0
# Smallest step, relative to the cycles done.
SMALLEST_PART = 0.15
FIRST_PART = 1.2e-3
"""Longest first step, relative to the life: the contact grows fastest at the beginning.

Reaches the first default row, at most 1/900 of the life, in one step."""
LARGEST_GROWTH = 5.0
"""Largest ratio of consecutive steps: a rejected step costs its time."""
_RUNS = (1, 2, 4)  # two extrapolations need three runs


@dataclass(frozen=True, slots=True)
class Moment:
    """Wear after ``cycles``.

    ``surface`` (2 x sectors, 2), m, extrapolated to second order; ``area`` (m^2) likewise;
    ``time_error``, ``area_error``: bounds of the error of depth (m) and area (m^2) due to the
    steps; ``peak_pressure``, Pa; ``mean_force`` and ``peak_force``, N; ``nodes_in_contact``: of the
    widest contact; ``front``: of the run with the finest steps; ``steps``: of all runs since the
    last moment.
    """

    cycles: float
    surface: Array
    area: float
    time_error: float
    area_error: float
    peak_pressure: float
    mean_force: float
    peak_force: float
    nodes_in_contact: int
    front: Front
    steps: int


def first_moment(problem: WearProblem, loads_at: LoadsAt, start: Front) -> Moment:
    """Return the moment before the first cycle."""
    loads = loads_at(start, 0.0)
    front = touched(problem, start, loads)
    no_error = np.zeros_like(front.surface)
    area = worn_area(problem, front.surface)
    return moment_of(
        problem, 0.0, front, loads, RichardsonEstimate(front.surface, no_error, area, 0.0), 0
    )


def integrate(
    problem: WearProblem,
    loads_at: LoadsAt,
    rows: Array,
    tolerance: float,
    start: Front | None = None,
) -> Iterator[Moment]:
    """Yield the moment at 0 cycles, at each row, and at steps between as the error requires.

    loads_at: loads for a front after a number of cycles; rows: increasing cycles above 0;
    tolerance: of the depth at the end, relative; earlier up to five times as large. Raises
    ContactError, WornThrough or ModelError.
    """
    if not tolerance > 0.0:
        raise ModelError("tolerance", tolerance, say("it must be greater than 0"))
    begin = start or problem.unworn()
    runs: tuple[Front, ...] = (begin, begin, begin)
    yield first_moment(problem, loads_at, begin)
    done, step, refused = 0.0, float(min(rows[0], FIRST_PART * rows[-1])), np.inf
    for row in rows:
        while done < row:
            # A step that would leave a small remainder is extended to the row.
            target = row if row - done < 1.3 * step else done + step
            after = _advance(problem, loads_at, runs, done, target)
            moment = _moment(problem, target, after, loads_at(after[-1], target))
            depth = moment.front.depth(problem.ring.inner).max()
            early = float(np.clip(np.sqrt(rows[-1] / target), 1.0, EARLY_TOLERANCE))
            allowed = tolerance * float(depth) * early
            # Suitable factor of the step for an error of second order.
            step_factor = 0.8 * np.sqrt(allowed / max(moment.time_error, 1e-300))
            # Smaller steps do not reduce an earlier error, or that of the mesh, where nodes come
            # into contact one after another.
            effective = target - done > SMALLEST_PART * target
            if effective and allowed < moment.time_error < 0.7 * refused:
                step = (target - done) * float(np.clip(step_factor, 0.2, 0.7))
                refused = moment.time_error
                continue
            refused = np.inf
            # A step shortened by a row does not reduce the next one.
            step = max(step, (target - done) * float(np.clip(step_factor, 1.5, LARGEST_GROWTH)))
            runs, done = after, target
            yield moment


def _advance(
    problem: WearProblem,
    loads_at: LoadsAt,
    runs: tuple[Front, ...],
    done: float,
    target: float,
) -> tuple[Front, ...]:
    """Advance each run by its number of equal steps."""
    after = []
    for run, steps in zip(runs, _RUNS, strict=True):
        front = run
        for part in range(steps):
            at = done + (target - done) * part / steps
            front = implicit_step(problem, front, loads_at(front, at), (target - done) / steps)
        after.append(front)
    return tuple(after)


def _moment(
    problem: WearProblem, cycles: float, runs: tuple[Front, ...], loads: CycleLoads
) -> Moment:
    """Return the extrapolated state of three runs."""
    coarse, middle, fine = runs
    better = 2.0 * fine.surface - middle.surface
    worse = 2.0 * middle.surface - coarse.surface
    areas = [worn_area(problem, run.surface) for run in runs]
    area = 2.0 * areas[2] - areas[1]
    area_error = abs(area - (2.0 * areas[1] - areas[0]))
    estimate = RichardsonEstimate(better, better - worse, area, area_error)
    return moment_of(problem, cycles, fine, loads, estimate, sum(_RUNS))


@dataclass(frozen=True, slots=True)
class RichardsonEstimate:
    """Worn surface (m) and its error, its area (m^2) and the area's error."""

    surface: Array
    off: Array
    area: float
    area_error: float


def moment_of(
    problem: WearProblem,
    cycles: float,
    front: Front,
    loads: CycleLoads,
    estimate: RichardsonEstimate,
    steps: int,
) -> Moment:
    """Return the moment of a front with solved contacts."""
    depth = front.depth(problem.ring.inner)
    # Error inside the contact only: at its moving edge, steps on a mesh are never smooth.
    deep = depth >= 0.5 * depth.max()
    assert front.touching is not None
    return Moment(
        cycles=cycles,
        surface=estimate.surface,
        area=estimate.area,
        time_error=float(np.hypot(estimate.off[deep, 0], estimate.off[deep, 1]).max()),
        area_error=estimate.area_error,
        peak_pressure=float(contact_pressure(problem, front).max()),
        mean_force=loads.mean_force,
        peak_force=float(loads.magnitude.max()),
        nodes_in_contact=int(front.touching.sum(axis=1).max()),
        front=front,
        steps=steps,
    )
