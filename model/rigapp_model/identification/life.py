"""Depth at the measured point against progress: one computed life serves every wear coefficient.

By Archard's law the profile after n cycles at coefficient K is that after (K/K0) n cycles at K0.
Progress is counted in nominal cycles: a revolution adds its work of friction per unit of the
coefficient of friction, the integral of |F| ds, divided by that of the reference revolution.
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
"""Progress (n,) at K0: itself (H, n), and its slopes (S, H, n) by S parameters."""

FINENESS = 4096
"""Parts of the table in the root of progress: straight lines between them are off by 1e-7."""
GROWTH = 0.05
"""Relative growth of the progress in a step: halving it moves no depth by more than 1e-3."""
FIRST_CYCLES = 2.0
"""The first step of a new bushing, whose contact is narrow, in nominal cycles."""


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """Depth (m,), m, against progress (m,), nominal cycles; both rise."""

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
        """Return depth (m) and its slope (m a nominal cycle); beyond the end the last depth, 0."""
        position = np.sqrt(np.maximum(progress - self.progress[0], 0.0)) / self._step
        beyond = position >= FINENESS
        part = np.where(beyond, FINENESS - 1.0, position).astype(np.int64)
        share = np.where(beyond, 1.0, position - part)
        depth, slope = self._rows
        low, up = depth[part], slope[part]
        depth_at = low + share * (depth[part + 1] - low)
        rising = np.where(beyond, 0.0, up + share * (slope[part + 1] - up))
        # The cubic's own last value is a bit below the last depth on some processors.
        return np.where(beyond, self.depth[-1], depth_at), rising


@dataclass(frozen=True, slots=True, eq=False)
class DepthLife:
    """The depth at the measured point against progress, as far as it is computed.

    coefficient: K0 that it was computed with, m^2/N; course: of one revolution as the reference
    revolution is, again and again; relative_error: bound of the computation's own error, as a part
    of the depth; elastic (m,): standard uncertainty, m, by the bushing's modulus of a reading at
    each row of the course, all of one sign, None without any. It is never extrapolated: beyond
    ``computed_depth`` only a lower bound of the depth is known. A load whose *size* changes is in
    the progress; one whose shape changes needs another life.
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
        """Return the largest depth that is computed, m."""
        return float(self.course.depth[-1])

    def elastic_doubt(self, depth: Array) -> Array:
        """Return the standard uncertainty by the modulus of readings at depths (n,), m."""
        if self.elastic is None:
            return np.zeros(depth.shape)
        return np.interp(depth, self.course.depth, self.elastic)

    def depth(self, progress: Array, scaled: Scaled) -> tuple[Array, Array]:
        """Return depths (H, n), m, at measured progress (n,), and their slopes (S, H, n).

        scaled: measured progress at K0 by each of H hypotheses.
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
    """Return the life of one load: depth (m,), m, at progress (m,), nominal cycles, from a new one.

    coefficient: K0, m^2/N; relative_error, elastic: see ``DepthLife``. Raises ModelError for rows
    that do not rise.
    """
    course = Course(np.array(progress, dtype=float), np.array(depth, dtype=float))
    return DepthLife(coefficient, course, relative_error, elastic)


def worn_ahead(state: WearState, loads: CycleLoads, depth: float) -> tuple[Array, Array]:
    """Return progress (m,), nominal cycles from now, and depth (m,), m, up to a depth.

    state: the bushing now, new or worn; loads: the repeated revolution. The depth is that at
    the contact point, as the probes measure it. Raises ContactError, ModelError, and WornThrough
    for a depth beyond the wall.
    """
    require_positive("depth", depth, "m")
    progress, reached = [0.0], [state.depth_at_contact]
    while reached[-1] < depth:
        step = max(FIRST_CYCLES, GROWTH * state.cycles)
        state = state.advance_by(loads, step)
        if state.depth_at_contact <= reached[-1]:
            raise ModelError(
                "loads", loads.mean_force, say("they do not wear the contact point"), "N"
            )
        progress.append(progress[-1] + step)
        reached.append(state.depth_at_contact)
    return np.array(progress), np.array(reached)


def weight(loads: CycleLoads, reference: CycleLoads) -> float:
    """Return the progress of one revolution, nominal cycles: its work by that of the reference."""
    work = float(loads.slip @ loads.magnitude)
    usual = float(reference.slip @ reference.magnitude)
    if usual <= 0.0:
        raise ModelError(
            "reference", usual, say("there is no contact force in the reference revolution"), "J"
        )
    return work / usual
