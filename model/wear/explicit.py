"""The paper's own scheme: forward Euler, each step extrapolated over some cycles."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from model.bushing.contact import simpson_weights
from model.errors import ModelError, require_positive
from model.wear.archard import largest_explicit_step
from model.wear.front import Front, WearProblem, refuse_worn_through, touched
from model.wear.loads import CycleLoads


def stable_step(problem: WearProblem, loads: CycleLoads) -> float:
    """Return the most cycles that one explicit step may take on this mesh."""
    spacing = np.pi * problem.ring.inner / problem.sectors
    slip = float(loads.slip.sum())
    return largest_explicit_step(spacing, problem.wear_coefficient, slip, problem.ring.modulus)


def explicit_step(problem: WearProblem, front: Front, loads: CycleLoads, cycles: float) -> Front:
    """Advance by paper Eqs 2 and 3: h += K p ds for every position, times the cycles.

    One contact solution a position on the surface as it was; the result carries them as a start
    for the next. Does not look at the stability limit.
    """
    require_positive("cycles", cycles)
    solved = touched(problem, front, loads)
    assert solved.force is not None
    assert solved.pins is not None
    nodes = problem.compliance.nodes
    weights = simpson_weights(front.surface)[nodes]
    near = front.surface[nodes]
    offset = np.zeros_like(near)
    for pin, force, slip in zip(solved.pins, solved.force, loads.slip, strict=True):
        away = near - pin
        away /= np.hypot(away[:, 0], away[:, 1])[:, None]
        wear = problem.wear_coefficient * cycles * slip * force / weights
        offset += wear[:, None] * away
    surface = front.surface.copy()
    surface[nodes] += offset
    refuse_worn_through(problem, surface)
    return Front(surface, solved.pins, solved.touching, solved.force)


def explicit_life(
    problem: WearProblem,
    loads: CycleLoads,
    cycles: float,
    step: float | None = None,
    beyond_limit: bool = False,
) -> Iterator[tuple[float, Front]]:
    """Yield cycles and front after every explicit step, loads unchanged.

    step: cycles of a step, None for the stability limit. A larger one is refused with ModelError,
    because the pressure then rattles and the depth overshoots while the worn area stays right;
    ``beyond_limit`` takes it all the same, to show just that.
    """
    require_positive("cycles", cycles)
    limit = stable_step(problem, loads)
    chosen = min(limit, cycles) if step is None else step
    require_positive("step", chosen)
    if chosen > limit and not beyond_limit:
        raise ModelError(
            "step",
            chosen,
            f"explicit extrapolation is stable up to {limit:.4g} cycles on this mesh; give fewer, "
            "or use implicit steps",
            "cycles",
        )
    count = int(np.ceil(cycles / chosen - 1e-9))
    front = problem.unworn()
    for number in range(1, count + 1):
        front = explicit_step(problem, front, loads, cycles / count)
        yield cycles * number / count, front
