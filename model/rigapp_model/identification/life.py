"""Depth in the measured place against progress: one computed life serves every wear coefficient.

By Archard's law the profile after n cycles at coefficient K is that after (K/K0) n cycles at K0.
Progress is counted in nominal cycles: a revolution adds its work of friction per unit of the
coefficient of friction, the integral of |F| ds, divided by that of the reference revolution.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp_model.errors import ModelError, require_not_negative, require_positive
from rigapp_model.wear.loads import CycleLoads
from rigapp_model.wear.state import WearState

Array = NDArray[np.float64]
Scaled = Callable[[Array], tuple[Array, Array]]
"""What progress (n,) counts at K0: itself (H, n), and its slopes (S, H, n) by S parameters."""

FINENESS = 4096
"""Parts of the table in the root of progress: straight lines between them are off by 1e-7."""
GROWTH = 0.05
"""A step goes on by so much of the progress: halving it moves no depth by more than 1e-3."""
FIRST_CYCLES = 2.0
"""The first step of a new bushing, whose contact is narrow, in nominal cycles."""


@dataclass(frozen=True, slots=True, eq=False)
class Stretch:
    """Hold depth (m,), m, against progress (m,), nominal cycles, under one load; both rise.

    start: the measured progress at which this load began. Where it continues another stretch, the
    table begins at the profile left by that one, or before it, and progress counts from there.
    """

    start: float
    progress: Array
    depth: Array
    _rows: Array = field(init=False, repr=False)
    _step: float = field(init=False, repr=False)

    def __post_init__(self) -> None:
        p, d = self.progress, self.depth
        if p.ndim != 1 or p.shape != d.shape or p.size < 3 or not np.isfinite([p, d]).all():
            raise ModelError("life", p.shape, "give three rows at least of progress and depth")
        if p[0] < 0.0 or (np.diff(p) <= 0.0).any() or (np.diff(d) <= 0.0).any():
            raise ModelError("life", "not rising", "progress and depth must rise from row to row")
        from scipy.interpolate import PchipInterpolator

        roots = np.linspace(0.0, np.sqrt(p[-1] - p[0]), FINENESS + 1)
        curve = PchipInterpolator(p, d)
        at = np.minimum(p[0] + roots**2, p[-1])
        object.__setattr__(self, "_rows", np.stack([curve(at), curve.derivative()(at)]))
        object.__setattr__(self, "_step", float(roots[1]))

    def at(self, progress: Array) -> tuple[Array, Array]:
        """Return depth (m) and its slope (m a nominal cycle); beyond the end the last depth, 0."""
        place = np.sqrt(np.maximum(progress - self.progress[0], 0.0)) / self._step
        beyond = place >= FINENESS
        part = np.where(beyond, FINENESS - 1.0, place).astype(np.int64)
        share = np.where(beyond, 1.0, place - part)
        depth, slope = self._rows
        low, up = depth[part], slope[part]
        found = low + share * (depth[part + 1] - low)
        rising = np.where(beyond, 0.0, up + share * (slope[part + 1] - up))
        # The cubic's own last value is a bit below the last depth on some processors.
        return np.where(beyond, self.depth[-1], found), rising

    def progress_of(self, depth: Array) -> Array:
        """Return the progress at some depths, m; the first or last one outside."""
        roots = np.interp(depth, self._rows[0], self._step * np.arange(FINENESS + 1))
        return np.asarray(self.progress[0] + roots**2)


@dataclass(frozen=True, slots=True, eq=False)
class DepthLife:
    """Hold the depth in the measured place against progress, as far as it is computed.

    coefficient: K0 that it was computed with, m^2/N; stretches: one for each load, in the order of
    the test; relative_error: bound of the computation's own error, as a part of the depth; elastic
    (m,): standard uncertainty, m, by the bushing's modulus of a reading at each row of the first
    stretch, all of one sign, None without any. It is never extrapolated: beyond ``reach`` nothing
    is known but that the depth is larger.
    """

    coefficient: float
    stretches: tuple[Stretch, ...]
    relative_error: float = 0.0
    elastic: Array | None = None

    def __post_init__(self) -> None:
        require_positive("coefficient", self.coefficient, "m^2/N")
        require_not_negative("relative_error", self.relative_error)

    @property
    def reach(self) -> float:
        """Return the largest depth that is computed, m."""
        return float(self.stretches[-1].depth[-1])

    def elastic_doubt(self, depth: Array) -> Array:
        """Return the standard uncertainty by the modulus of readings at depths (n,), m."""
        if self.elastic is None:
            return np.zeros(depth.shape)
        return np.interp(depth, self.stretches[0].depth, self.elastic)

    def continued(self, start: float, progress: ArrayLike, depth: ArrayLike) -> DepthLife:
        """Return the life as it continues under another load from a measured progress on.

        progress, depth: (m,), nominal cycles and m, from the profile at that time or before it.
        """
        if start <= self.stretches[-1].start:
            raise ModelError("start", start, "a load begins after the one before it", "cycles")
        more = _stretch(start, progress, depth)
        return replace(self, stretches=(*self.stretches, more))

    def depth(self, progress: Array, scaled: Scaled) -> tuple[Array, Array]:
        """Return depths (H, n), m, at measured progress (n,), and their slopes (S, H, n).

        scaled: what measured progress counts at K0 by each of H hypotheses. A new load goes on
        from the depth that each hypothesis had reached by then.
        """
        if len(self.stretches) == 1:
            q, by = scaled(progress)
            found, rate = self.stretches[0].at(q)
            return found, rate * by
        starts = np.array([one.start for one in self.stretches[1:]])
        q, by = scaled(np.concatenate([progress, starts]))
        count = progress.size
        found, rate = self.stretches[0].at(q)
        slopes = rate * by
        for index, one in enumerate(self.stretches[1:]):
            begin = slice(count + index, count + index + 1)
            offset = one.progress_of(found[:, begin])
            moved, rate = one.at(offset + q - q[:, begin])
            first = one.at(offset)[1]
            shift = slopes[:, :, begin] / np.maximum(first, 1e-300)
            after = np.concatenate([progress, starts]) > one.start
            after[count + index] = False
            found = np.where(after, moved, found)
            slopes = np.where(after, rate * (shift + by - by[:, :, begin]), slopes)
        return found[:, :count], slopes[:, :, :count]


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
    return DepthLife(coefficient, (_stretch(0.0, progress, depth),), relative_error, elastic)


def _stretch(start: float, progress: ArrayLike, depth: ArrayLike) -> Stretch:
    return Stretch(start, np.array(progress, dtype=float), np.array(depth, dtype=float))


def worn_ahead(state: WearState, loads: CycleLoads, depth: float) -> tuple[Array, Array]:
    """Return progress (m,), nominal cycles from now, and depth (m,), m, worn on to a depth.

    state: the bushing now, new or worn; loads: the revolution that goes on. The depth is that at
    the contact point, as the probes measure it. Raises ContactError, ModelError, and WornThrough
    for a depth that the wall does not have.
    """
    require_positive("depth", depth, "m")
    progress, reached = [0.0], [state.depth_at_contact]
    while reached[-1] < depth:
        step = max(FIRST_CYCLES, GROWTH * state.cycles)
        state = state.advance_by(loads, step)
        if state.depth_at_contact <= reached[-1]:
            raise ModelError("loads", loads.mean_force, "they do not wear the contact point", "N")
        progress.append(progress[-1] + step)
        reached.append(state.depth_at_contact)
    return np.array(progress), np.array(reached)


def weight(loads: CycleLoads, reference: CycleLoads) -> float:
    """Return what one revolution adds to progress, in nominal cycles: its work to that of one."""
    work = float(loads.slip @ loads.magnitude)
    usual = float(reference.slip @ reference.magnitude)
    if usual <= 0.0:
        raise ModelError("reference", usual, "nothing presses in the reference revolution", "J")
    return work / usual
