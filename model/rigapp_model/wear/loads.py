"""Normal force and sliding distance of one revolution, at selected crank positions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.texts import say
from rigapp_model.errors import ModelError

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class CycleLoads:
    """Forces of one revolution in the wear frame, and the slip under each.

    ``force`` (M, 2), N: normal force on the bushing by the pin; x points from the bushing's
    centre to the initial contact point, which is towards the crank, y is 90 degrees further
    counter-clockwise: minus the components in the follower frame. ``slip`` (M,), m: its sum and
    ``idle``, the slip without force, add up to the pin's circumference; if the pin moves in its
    clearance the sum can be larger, and ``idle`` negative. ``rate`` (M,): factor of the wear
    coefficient at each position, None if it is 1.
    """

    force: Array
    slip: Array
    idle: float = 0.0
    rate: Array | None = None

    def __post_init__(self) -> None:
        if self.force.ndim != 2 or self.force.shape[1] != 2 or len(self.slip) != len(self.force):
            shapes = say("{} forces and {} slips", self.force.shape, self.slip.shape)
            raise ModelError("loads", shapes, say("give (M, 2) forces and (M,) slips"))
        if not (np.isfinite(self.force).all() and np.isfinite(self.slip).all()):
            raise ModelError("loads", say("not finite"), say("give finite numbers only"))
        if self.slip.min(initial=0.0) < 0.0:
            raise ModelError("slip", float(self.slip.min()), say("it must not be negative"), "m")

    @property
    def wearing(self) -> Array:
        """Return the slip of each position times its rate, m."""
        return self.slip if self.rate is None else self.slip * self.rate

    @property
    def magnitude(self) -> Array:
        """Return the magnitude of each force, N."""
        return np.hypot(self.force[:, 0], self.force[:, 1])

    @property
    def direction(self) -> Array:
        """Return the direction of each force in the wear frame, rad."""
        return np.arctan2(self.force[:, 1], self.force[:, 0])

    @property
    def mean_force(self) -> float:
        """Return the mean magnitude of the force over the slip, N, which sets the worn volume.

        The constant force with the same sliding work over slip and ``idle``.
        """
        total = float(self.slip.sum()) + self.idle
        return float(self.slip @ self.magnitude) / total if total > 0.0 else 0.0

    def pressing(self) -> CycleLoads:
        """Return the positions with force and slip; the slip of the others is added to ``idle``."""
        size = self.magnitude
        active = (size > 1e-9 * size.max(initial=0.0)) & (self.slip > 0.0)
        if active.all():
            return self
        return replace(self._selected(active), idle=self.idle + float(self.slip[~active].sum()))

    def by_direction(self) -> CycleLoads:
        """Return the positions ordered by the direction of the force."""
        order = np.argsort(self.direction, kind="stable")
        return self._selected(order)

    def _selected(self, selected: NDArray[np.bool_] | NDArray[np.int64]) -> CycleLoads:
        """Return the selected positions."""
        rate = None if self.rate is None else self.rate[selected]
        return CycleLoads(self.force[selected], self.slip[selected], self.idle, rate)


def constant_load(force: float, pin_radius: float) -> CycleLoads:
    """Return a constant force (N) along the follower, positive towards the crank.

    The slip per revolution is the pin's circumference.
    """
    if not np.isfinite(force) or force == 0.0:
        raise ModelError("force", force, say("give a finite force other than 0"), "N")
    return CycleLoads(np.array([[force, 0.0]]), np.array([2.0 * np.pi * pin_radius]))


def loads_of_cycle(
    force_follower: ArrayLike,
    slip: ArrayLike,
    friction_coefficient: float = 0.0,
    sliding: ArrayLike = 1.0,
) -> CycleLoads:
    """Return loads from a force on the follower in the follower frame.

    force_follower: (2, M), N; slip: (M,), m. With friction the force is not normal to the surface:
    the normal component is the force turned back by atan(mu) against the direction of sliding (sign
    of ``sliding``), times the cosine of that angle.
    """
    fx, fy = -np.asarray(force_follower, dtype=np.float64)
    turn = -np.sign(np.asarray(sliding)) * np.arctan(friction_coefficient)
    share = 1.0 / np.sqrt(1.0 + friction_coefficient**2)
    c, s = share * np.cos(turn), share * np.sin(turn)
    force, distance = np.empty((*fx.shape, 2)), np.empty(fx.shape)
    force[..., 0], force[..., 1] = c * fx - s * fy, s * fx + c * fy
    distance[...] = slip
    return CycleLoads(force, distance)


WIDE_SWING = 1.0
"""Range of the force's direction, rad, above which equal crank angles are unsuitable."""


def swing(loads: CycleLoads) -> float:
    """Return the range of the force's direction in a revolution, rad."""
    return float(np.ptp(np.unwrap(loads.direction))) if loads.slip.size else 0.0


SWING_WEIGHT = 2.0
"""Weight of a change of the force's direction relative to the same crank angle."""


def _edges(loads: CycleLoads, positions: int) -> NDArray[np.int64]:
    """Return the first sample of each part.

    The parts are equal in a weighted sum of crank angle and change of direction; the latter is
    weighted with the root of the force, as a weak force causes little wear in any direction.
    """
    count = len(loads.slip)
    direction = loads.direction
    swing = np.abs(np.angle(np.exp(1j * (np.roll(direction, -1) - direction))))
    size = loads.magnitude / max(loads.mean_force, 1e-300)
    weight = 2.0 * np.pi / count + SWING_WEIGHT * swing * np.sqrt(np.minimum(size, 1.0))
    cumulative = np.cumsum(weight)
    targets = cumulative[-1] * np.arange(1, positions) / positions
    edges = np.r_[0, np.searchsorted(cumulative, targets * (1.0 - 1e-12), side="left") + 1]
    # At least one sample in each part, counted from the front and from the back.
    first = np.arange(positions)
    edges = np.maximum.accumulate(np.maximum(edges - first, 0)) + first
    return np.minimum(edges, count - positions + first)


def gathered(loads: CycleLoads, positions: int) -> CycleLoads:
    """Merge a densely sampled revolution into fewer positions, each the mean of its part.

    The parts are shorter where the direction changes fast, so that the contact of a part is at one
    place. Magnitude and direction are averaged separately, weighted with the slip, which conserves
    force times slip and so the worn volume.
    """
    count = len(loads.slip)
    if positions >= count:
        return loads
    edges = _edges(loads, positions)
    slip = np.add.reduceat(loads.slip, edges)
    sums = np.add.reduceat(loads.force * loads.slip[:, None], edges, axis=0)
    work = np.add.reduceat(loads.magnitude * loads.slip, edges)
    length = np.hypot(sums[:, 0], sums[:, 1])
    active = (slip > 0.0) & (length > 0.0)
    size = work[active] / slip[active]
    idle = loads.idle + float(slip[~active].sum())
    rate = None
    if loads.rate is not None:
        rate = np.add.reduceat(loads.magnitude * loads.wearing, edges)[active] / work[active]
    return CycleLoads(sums[active] / length[active, None] * size[:, None], slip[active], idle, rate)
