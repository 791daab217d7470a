"""Depth at the measured point against progress: one computed life for all wear coefficients.

By Archard's law the profile after n cycles at coefficient K is that after (K/K0) n cycles at K0.
Progress is in nominal cycles: that of a revolution is its friction work per unit of the friction
coefficient, the integral of |F| ds, divided by that of the reference revolution.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.errors import ModelError, require_not_negative, require_positive
from rigapp_model.wear.loads import CycleLoads
from rigapp_model.wear.state import WearState

Array = NDArray[np.float64]
Scaled = Callable[[Array], tuple[Array, Array]]
"""From progress (n,): progress at K0 (H, n), and its slopes (S, H, n) by S parameters."""

FINENESS = 4096
"""Intervals of the table in the root of progress: linear interpolation is exact to 1e-7."""
GROWTH = 0.05
"""Step as a fraction of the progress: halving it changes no depth by more than 1e-3."""
FIRST_CYCLES = 2.0
"""First step of a new bushing, whose contact is narrow, in nominal cycles."""


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """Depth (m,), m, against progress (m,), nominal cycles; both increase."""

    progress: Array
    depth: Array
    _rows: Array = field(init=False, repr=False)
    _step: float = field(init=False, repr=False)

    def __post_init__(self) -> None:
        p, d = self.progress, self.depth
        if p.ndim != 1 or p.shape != d.shape or p.size < 3 or not np.isfinite([p, d]).all():
            raise ModelError("life", p.shape, say("give three rows at least of progress and depth"))
        if p[0] < 0.0 or (np.diff(p) <= 0.0).any() or (np.diff(d) <= 0.0).any():
            raise ModelError(
                "life", say("not rising"), say("progress and depth must rise from row to row")
            )
        from scipy.interpolate import PchipInterpolator

        roots = np.linspace(0.0, np.sqrt(p[-1] - p[0]), FINENESS + 1)
        curve = PchipInterpolator(p, d)
        at = np.minimum(p[0] + roots**2, p[-1])
        object.__setattr__(self, "_rows", np.stack([curve(at), curve.derivative()(at)]))
        object.__setattr__(self, "_step", float(roots[1]))

    def at(self, progress: Array) -> tuple[Array, Array]:
        """Return depth (m) and its slope (m per nominal cycle); last depth and 0 beyond the end."""
        position = np.sqrt(np.maximum(progress - self.progress[0], 0.0)) / self._step
        beyond = position >= FINENESS
        part = np.where(beyond, FINENESS - 1.0, position).astype(np.int64)
        share = np.where(beyond, 1.0, position - part)
        depth, slope = self._rows
        low, slope_at = depth[part], slope[part]
        depth_at = low + share * (depth[part + 1] - low)
        rising = np.where(beyond, 0.0, slope_at + share * (slope[part + 1] - slope_at))
        # The last value of the cubic is slightly below the last depth on some processors.
        return np.where(beyond, self.depth[-1], depth_at), rising


@dataclass(frozen=True, slots=True, eq=False)
class DepthLife:
    """Computed depth at the measured point against progress.

    coefficient: K0 of the computation, m^2/N; course: for repeated reference revolutions;
    relative_error: bound of the computation's error, relative to the depth; elastic (m,): standard
    uncertainty, m, of a reading at each row of the course due to the bushing's modulus, all of one
    sign, None: none. Not extrapolated: beyond ``computed_depth`` only a lower bound of the depth is
    known. A change of the load's *size* is part of the progress; one of its shape needs another
    life.
    """

    coefficient: float
    course: Course
    relative_error: float = 0.0
    elastic: Array | None = None

    def __post_init__(self) -> None:
        require_positive("coefficient", self.coefficient, "m^2/N")
        require_not_negative("relative_error", self.relative_error)

    @property
    def computed_depth(self) -> float:
        """Return the largest computed depth, m."""
        return float(self.course.depth[-1])

    def elastic_doubt(self, depth: Array) -> Array:
        """Return the standard uncertainty of readings at depths (n,) due to the modulus, m."""
        if self.elastic is None:
            return np.zeros(depth.shape)
        return np.interp(depth, self.course.depth, self.elastic)

    def depth(self, progress: Array, scaled: Scaled) -> tuple[Array, Array]:
        """Return depths (H, n), m, at measured progress (n,), and their slopes (S, H, n).

        scaled: from measured progress to that at K0, for H hypotheses.
        """
        q, by = scaled(progress)
        depth, rate = self.course.at(q)
        return depth, rate * by


def depth_life(
    coefficient: float,
    progress: ArrayLike,
    depth: ArrayLike,
    relative_error: float = 0.0,
    elastic: Array | None = None,
) -> DepthLife:
    """Return the life of a new bushing: depth (m,), m, at progress (m,), nominal cycles.

    coefficient: K0, m^2/N; relative_error, elastic: see ``DepthLife``. Raises ModelError unless
    the rows increase.
    """
    course = Course(np.array(progress, dtype=float), np.array(depth, dtype=float))
    return DepthLife(coefficient, course, relative_error, elastic)


def worn_ahead(state: WearState, loads: CycleLoads, depth: float) -> tuple[Array, Array]:
    """Return progress (m,), nominal cycles from the present, and depth (m,), m, up to a depth.

    state: the present bushing, new or worn; loads: of the repeated revolution. The depth is that at
    the contact point, as measured by the probes. Raises ContactError, ModelError, and WornThrough
    for a depth beyond the wall.
    """
    require_positive("depth", depth, "m")
    progress, depths = [0.0], [state.depth_at_contact]
    while depths[-1] < depth:
        step = max(FIRST_CYCLES, GROWTH * state.cycles)
        state = state.advance_by(loads, step)
        if state.depth_at_contact <= depths[-1]:
            raise ModelError(
                "loads", loads.mean_force, say("they do not wear the contact point"), "N"
            )
        progress.append(progress[-1] + step)
        depths.append(state.depth_at_contact)
    return np.array(progress), np.array(depths)


def weight(loads: CycleLoads, reference: CycleLoads) -> float:
    """Return the progress of a revolution, nominal cycles: its work over that of the reference."""
    work = float(loads.slip @ loads.magnitude)
    reference_work = float(reference.slip @ reference.magnitude)
    if reference_work <= 0.0:
        raise ModelError(
            "reference",
            reference_work,
            say("there is no contact force in the reference revolution"),
            "J",
        )
    return work / reference_work
