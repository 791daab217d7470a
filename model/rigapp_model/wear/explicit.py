"""The paper's scheme: forward Euler, each step extrapolated over several cycles."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from rigapp.texts import say
from rigapp_model.bushing.contact import simpson_weights
from rigapp_model.bushing.ring import Ring
from rigapp_model.errors import ModelError, OutOfTime, require_positive
from rigapp_model.wear.archard import largest_explicit_step
from rigapp_model.wear.front import (
    Array,
    Front,
    WearProblem,
    refuse_worn_through,
    touched,
    worn_area,
)
from rigapp_model.wear.loads import CycleLoads
from rigapp_model.wear.richardson import (
    LoadsAt,
    Moment,
    RichardsonEstimate,
    first_moment,
    moment_of,
)

STABLE_SHARE = 0.5
"""Default step, as a fraction of the stability limit."""


class UnstableStep(ModelError):
    """An explicit step exceeds the stability limit."""


@dataclass(frozen=True, slots=True)
class Extrapolation:
    """Largest explicit step and stability limit on the mesh, in cycles."""

    step: float
    limit: float


def stable_step(ring: Ring, sectors: int, wear_coefficient: float, loads: CycleLoads) -> float:
    """Return the stability limit of an explicit step on a mesh with this number of sectors, cycles.

    The wear of a step must be below twice the indentation by its pressure: for the shortest wave of
    the mesh (``largest_explicit_step``), and for the wall as an elastic foundation of k Pa/m, the
    limit of a thin wall: 2 / (K s k). All slip of a revolution is included, at any position.
    """
    slip = float(loads.wearing.sum()) + loads.idle
    rate = wear_coefficient * slip * ring.foundation_modulus
    bed = 2.0 / rate if rate > 0.0 else float("inf")
    if ring.contact == "winkler":
        return bed
    spacing = np.pi * ring.inner / sectors
    return min(largest_explicit_step(spacing, wear_coefficient, slip, ring.modulus), bed)


def extrapolation(
    ring: Ring,
    sectors: int,
    wear_coefficient: float,
    loads: CycleLoads,
    step: float | None = None,
) -> Extrapolation:
    """Return the step to use, in cycles, by default half the stability limit.

    Raises UnstableStep above the limit: the pressure would oscillate and the depth overshoot, while
    the worn area remains correct.
    """
    limit = stable_step(ring, sectors, wear_coefficient, loads)
    if step is None:
        return Extrapolation(STABLE_SHARE * limit, limit)
    require_positive("step", step, "cycles")
    if step > limit:
        raise UnstableStep(
            "step",
            step,
            say(
                "explicit extrapolation is stable up to {:.4g} cycles on this mesh of {}"
                " sectors; give fewer, or use implicit steps",
                limit,
                sectors,
            ),
            "cycles",
        )
    return Extrapolation(step, limit)


def explicit_step(problem: WearProblem, front: Front, loads: CycleLoads, cycles: float) -> Front:
    """Advance by paper Eqs 2 and 3: h += K p ds for each position, times the cycles.

    One contact solution per position, on the surface before the step; the result includes them as
    start of the next step. Does not check the stability limit.
    """
    require_positive("cycles", cycles)
    solved = touched(problem, front, loads)
    assert solved.force is not None
    assert solved.pins is not None
    nodes = problem.compliance.nodes
    weights = simpson_weights(front.surface)[nodes]
    nodes_at = front.surface[nodes]
    offset = np.zeros_like(nodes_at)
    for pin, force, slip in zip(solved.pins, solved.force, loads.wearing, strict=True):
        normal = nodes_at - pin
        normal /= np.hypot(normal[:, 0], normal[:, 1])[:, None]
        wear = problem.wear_coefficient * cycles * slip * force / weights
        offset += wear[:, None] * normal
    surface = front.surface.copy()
    surface[nodes] += offset
    refuse_worn_through(problem, surface)
    return Front(surface, solved.pins, solved.touching, solved.force)


def explicit_moments(
    problem: WearProblem,
    loads_at: LoadsAt,
    rows: Array,
    step: float,
    alive: Callable[[float], None] = lambda done: None,
) -> Iterator[Moment]:
    """Yield the moment at 0 cycles and at each row, with steps of at most ``step`` cycles.

    Steps end at rows. A second run has half the step; the scheme is of first order, so that twice
    their difference is the error. rows: increasing cycles above 0; step: not compared with the
    stability limit, see ``extrapolation``; alive: called with the cycles done after each step; if
    it raises OutOfTime, the present moment is the last. Raises ContactError, WornThrough or
    ModelError.
    """
    runs = (problem.unworn(), problem.unworn())
    yield first_moment(problem, loads_at, runs[0])
    since, taken = 0.0, 0
    for row in rows:
        count = max(int(np.ceil((row - since) / step - 1e-9)), 1)
        for number in range(1, count + 1):
            done = since + (row - since) * number / count
            begin = since + (row - since) * (number - 1) / count
            runs = _advance(problem, loads_at, runs, begin, done)
            taken += 1 + 2
            try:
                alive(done)
            except OutOfTime:
                yield _moment(problem, loads_at, runs, done, taken)
                return
        yield _moment(problem, loads_at, runs, row, taken)
        since, taken = row, 0


def _advance(
    problem: WearProblem,
    loads_at: LoadsAt,
    runs: tuple[Front, Front],
    begin: float,
    end: float,
) -> tuple[Front, Front]:
    """Advance one run by a step and the other by two half steps."""
    full, halves = runs
    full = explicit_step(problem, full, loads_at(full, begin), end - begin)
    for at in (begin, 0.5 * (begin + end)):
        halves = explicit_step(problem, halves, loads_at(halves, at), 0.5 * (end - begin))
    return full, halves


def _moment(
    problem: WearProblem,
    loads_at: LoadsAt,
    runs: tuple[Front, Front],
    cycles: float,
    steps: int,
) -> Moment:
    """Return the moment of the run with full steps, with contacts on its present surface."""
    full, halves = runs
    loads = loads_at(full, cycles)
    area = worn_area(problem, full.surface)
    estimate = RichardsonEstimate(
        full.surface,
        2.0 * (full.surface - halves.surface),
        area,
        2.0 * abs(area - worn_area(problem, halves.surface)),
    )
    return moment_of(problem, cycles, touched(problem, full, loads), loads, estimate, steps)
