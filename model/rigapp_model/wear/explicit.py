"""The paper's own scheme: forward Euler, each step extrapolated over some cycles."""

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
"""Part of the stability limit that a step takes by default."""


class UnstableStep(ModelError):
    """An explicit step is beyond the stability limit."""


@dataclass(frozen=True, slots=True)
class Extrapolation:
    """The most cycles of an explicit step, and the most that would be stable on the mesh."""

    step: float
    limit: float


def stable_step(ring: Ring, sectors: int, wear_coefficient: float, loads: CycleLoads) -> float:
    """Return the most cycles of one explicit step on a mesh with the given number of sectors.

    The wear of a step must be below twice the indentation by its pressure: of the shortest wave of
    the mesh (``largest_explicit_step``), and of the wall as a bed of springs of k Pa/m, the
    limit in a thin one: 2 / (K s k). All slip of a revolution counts, wherever it presses.
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
    """Return the steps to take: of ``step`` cycles, by default half the stability limit.

    Raises UnstableStep for more than the limit, because the pressure then oscillates and the depth
    overshoots while the worn area stays right.
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
    """Advance by paper Eqs 2 and 3: h += K p ds for every position, times the cycles.

    One contact solution a position on the surface as it was; the result carries them as a start
    for the next. Does not check the stability limit.
    """
    require_positive("cycles", cycles)
    solved = touched(problem, front, loads)
    assert solved.force is not None
    assert solved.pins is not None
    nodes = problem.compliance.nodes
    weights = simpson_weights(front.surface)[nodes]
    near = front.surface[nodes]
    offset = np.zeros_like(near)
    for pin, force, slip in zip(solved.pins, solved.force, loads.wearing, strict=True):
        away = near - pin
        away /= np.hypot(away[:, 0], away[:, 1])[:, None]
        wear = problem.wear_coefficient * cycles * slip * force / weights
        offset += wear[:, None] * away
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
    """Yield the moment at every row, from 0 cycles on, by steps of at most ``step`` cycles.

    A step that would pass a row ends there. A second life with half the steps goes beside it; the
    scheme is of first order, so that twice their difference is the error. rows: increasing cycles
    above 0; step: not compared with the stability limit, see ``extrapolation``; alive: called with
    the cycles done after every step; where it raises OutOfTime, the moment reached is the last.
    Raises ContactError, WornThrough or ModelError.
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
    """Advance one run by a step and the other by two halves of it."""
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
    """Return the moment of the whole steps, its contacts solved on the surface as it is."""
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
