"""Where the pin's centre is in the bushing, by crank angle, from the probes. Pure functions.

All vectors are in the wear frame: the follower frame turned by 180 degrees, x from the bushing's
centre to the initial contact point. The probes measure the position of the pin's centre, the
eccentricity of its surface (run-out, which turns with the crank against the follower) and the
position of their zero. The revolutions of a new bushing give the last two: there the pin's
centre is the clearance away from the bushing's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.twin.approach import RIGID, Approach

Array = NDArray[np.float64]

BINS = 120
"""Parts of a revolution, of equal crank angle, in which positions and forces are averaged."""
LOADED = 0.1
"""Parts of a revolution with less than this share of the largest force are left out."""
LEAST_PARTS = 8
"""Fewer loaded parts of a revolution than this give no reference."""
CENTRED = 0.1
"""The probes' zero is the bushing's centre if the new pin is the clearance from it to this part."""
LARGEST_LEAN = 0.2
"""More than this (rad) between force and pin is not friction: the probes' zero is elsewhere."""
EARLY_DOUBT = 0.3
"""Part of the wear before the reference that may be wrong (standard uncertainty)."""
ACROSS = 0.05
"""Weight of what is across the force: its direction's error is multiplied by the clearance."""
FRICTION_DOUBT = 0.1
"""Standard uncertainty of the friction's angle, rad, where only forces give the direction."""


@dataclass(frozen=True, slots=True)
class PathSum:
    """Sums over revolutions, by crank angle; ``+`` joins two.

    count (BINS,); position, squares, force (2, BINS): m, m^2, N; turn (BINS,): crank angle less
    follower angle, rad, at the middle of the part; revolutions.
    """

    count: Array
    position: Array
    squares: Array
    force: Array
    turn: Array
    revolutions: int

    def __add__(self, other: PathSum) -> PathSum:
        return PathSum(
            self.count + other.count,
            self.position + other.position,
            self.squares + other.squares,
            self.force + other.force,
            other.turn,
            self.revolutions + other.revolutions,
        )

    @property
    def filled(self) -> NDArray[np.bool_]:
        """Return which parts have a sample."""
        return np.asarray(self.count > 0)

    @property
    def mean_position(self) -> Array:
        """Return the mean position of each part with a sample, (2, n), m."""
        return np.asarray(self.position[:, self.filled] / self.count[self.filled])

    @property
    def mean_force(self) -> Array:
        """Return the mean force of each part with a sample, (2, n), N."""
        return np.asarray(self.force[:, self.filled] / self.count[self.filled])

    @property
    def spread(self) -> float:
        """Return the standard deviation of a sample about the mean of its part, m, a component."""
        kept = self.filled
        square = (self.squares[:, kept] - self.position[:, kept] ** 2 / self.count[kept]).sum()
        return float(np.sqrt(max(square, 0.0) / max(2.0 * self.count.sum(), 1.0)))

    @property
    def standard_error(self) -> float:
        """Return the standard uncertainty of a part's mean by the samples' spread, m."""
        return self.spread / float(np.sqrt(max(np.median(self.count[self.filled]), 1.0)))


@dataclass(frozen=True, slots=True)
class Reference:
    """The reference of the probes by a new bushing.

    centre (2,): reading at the bushing's centre, m; run_out (2,): the pin's eccentricity at equal
    crank and follower angle, m; centred: whether the probes' own zero gives the direction (else
    forces do); radial, across: standard uncertainties of the centre along the mean direction of
    load and across it, m; approach: elastic approach of pin and bushing then at the largest force,
    m, by the model; elastic: whether it was taken out of the centre (else the centre has that of
    the unworn bushing). beyond: how much farther from the probes' zero the new pin was than
    clearance, wear and approach put it, m; lean: the angle between its position and the force, rad;
    NaN where they are not known.
    """

    centre: Array
    run_out: Array
    centred: bool
    radial: float
    across: float
    approach: float
    elastic: bool = False
    beyond: float = float("nan")
    lean: float = float("nan")


def path_of(angle: Array, position: Array, force: Array, turn: Array) -> PathSum:
    """Sort the samples of one revolution by crank angle.

    angle (n,): rad; position, force (2, n): m, N, wear frame; turn (n,): crank angle less follower
    angle, rad. Samples that are not finite are left out.
    """
    good = np.isfinite(position).all(axis=0) & np.isfinite(force).all(axis=0)
    part = (np.mod(angle[good], 2.0 * np.pi) * (BINS / (2.0 * np.pi))).astype(np.int64)
    part = np.minimum(part, BINS - 1)

    def total(values: Array) -> Array:
        return np.bincount(part, weights=values, minlength=BINS).astype(np.float64)

    count = total(np.ones(part.size))
    middle = np.arange(BINS) * (2.0 * np.pi / BINS) + np.pi / BINS
    turned_by = np.interp(middle, angle, np.unwrap(turn), period=None) if angle.size else middle
    p, f = position[:, good], force[:, good]
    return PathSum(
        count=count,
        position=np.stack([total(p[0]), total(p[1])]),
        squares=np.stack([total(p[0] ** 2), total(p[1] ** 2)]),
        force=np.stack([total(f[0]), total(f[1])]),
        turn=np.asarray(turned_by, dtype=np.float64),
        revolutions=1,
    )


def reference_of(
    path: PathSum,
    clearance: float,
    worn: float = 0.0,
    friction: float = 0.0,
    approach: Approach = RIGID,
) -> Reference | None:
    """Return the reference by a nearly new bushing, None without enough data.

    worn: depth by then, m; friction: coefficient of the joint, which turns the force away from the
    normal. Solved by least squares: reading = centre + (clearance + worn + elastic approach) normal
    + run-out turned by the crank. Where the probes' zero is near the bushing's centre, its
    direction is used, and only the distance from it is taken from the clearance.
    """
    force, position = path.mean_force, path.mean_position
    size = np.hypot(*force)
    loaded = size > LOADED * size.max(initial=0.0)
    if np.count_nonzero(loaded) < LEAST_PARTS:
        return None
    position, turn = position[:, loaded], path.turn[path.filled][loaded]
    normal = rotated(force[:, loaded] / size[loaded], -float(np.arctan(friction)))
    reach = clearance + worn + approach.at(worn, size[loaded])
    weight = np.sqrt(size[loaded] / size.max())
    centre, run_out = _fitted(position - reach * normal, normal, turn, weight)
    middle = (reach * normal).mean(axis=1)
    distance = centre + middle
    length, wanted = float(np.hypot(*distance)), float(np.hypot(*middle))
    lean = float(np.arctan2(_cross(middle, distance), middle @ distance))
    centred = abs(length - wanted) < CENTRED * wanted and abs(lean) < LARGEST_LEAN
    if centred:
        normal = position / np.hypot(*position)
        centre, run_out = _fitted(position - reach * normal, normal, turn, weight)
        centre = centre @ distance / length**2 * distance
    left = position - reach * normal - centre[:, None] - turned(run_out, turn)
    along = float(np.sqrt(np.average((left * normal).sum(axis=0) ** 2, weights=weight)))
    across = float(np.sqrt(np.average(_cross(normal, left) ** 2, weights=weight)))
    noise = float(np.hypot(path.standard_error, EARLY_DOUBT * worn))
    return Reference(
        centre=centre,
        run_out=run_out,
        centred=centred,
        radial=float(np.hypot(noise, along)),
        across=along if centred else float(np.hypot(across, FRICTION_DOUBT * clearance)),
        approach=float(approach.at(worn, size.max(keepdims=True))[0]),
        elastic=True,
        beyond=length - wanted,
        lean=lean,
    )


def early_wear(
    revolutions: Sequence[int], paths: Sequence[PathSum], approach: Approach = RIGID
) -> float:
    """Return the depth, m, that a new bushing has in the middle of some of its first revolutions.

    The pin's mean position along the force moves by the wear of a revolution less the fall of the
    elastic approach; a straight line through the revolutions, extrapolated to 0. Never below 0.
    """
    force = sum((path.force.sum(axis=1) for path in paths), np.zeros(2))
    direction = force / max(float(np.hypot(*force)), 1e-300)
    number = np.asarray(revolutions, dtype=np.float64)
    if number.size < 2 or number.max() <= number.min():
        return 0.0
    position = np.array([direction @ path.mean_position.mean(axis=1) for path in paths])
    away = number - number.mean()
    moved = float(away @ position / (away @ away)) * float(number.mean())
    usual = np.concatenate([np.hypot(*path.mean_force) for path in paths])
    mean = approach.mean(usual)
    return max(mean.depth_of(moved + mean.at(0.0)), 0.0)


def reference_from_mean(position: Array, clearance: float, path: PathSum) -> Reference:
    """Return the reference by the mean reading (2,), m, of the new bushing and a path when worn.

    The run-out turns with the crank, wear does not: the worn bushing's path has it as well.
    """
    length = float(np.hypot(*position))
    centred = clearance > 0.0 and abs(length / clearance - 1.0) < CENTRED
    away = position / length if centred else np.array([1.0, 0.0])
    run_out, across = np.zeros(2), 0.0 if centred else FRICTION_DOUBT * clearance
    force, at = path.mean_force, path.mean_position
    size = np.hypot(*force)
    loaded = size > LOADED * size.max(initial=0.0)
    if np.count_nonzero(loaded) >= LEAST_PARTS:
        normal = force[:, loaded] / size[loaded]
        offset = at[:, loaded] - clearance * normal
        weight = np.sqrt(size[loaded] / size.max())
        _, run_out = _fitted(offset, normal, path.turn[path.filled][loaded], weight)
    return Reference(position - clearance * away, run_out, centred, 0.0, across, 0.0)


def centres(
    path: PathSum, reference: Reference, depth: float = 0.0, approach: Approach = RIGID
) -> Array:
    """Return the pin's centre from the bushing's for each part with a sample, (2, n), m.

    The elastic approach of the bushing worn to a depth (m) is removed along the force.
    """
    turn = path.turn[path.filled]
    moved = path.mean_position - reference.centre[:, None] - turned(reference.run_out, turn)
    force = path.mean_force
    size = np.hypot(*force)
    nearer = approach.at(depth, size)
    if not reference.elastic:
        nearer = nearer - approach.at(0.0, size)
    return np.asarray(moved - nearer * force / np.maximum(size, 1e-300))


def rotated(vectors: Array, angle: float) -> Array:
    """Return vectors (2, n) turned counter-clockwise by an angle, rad."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * vectors[0] - s * vectors[1], s * vectors[0] + c * vectors[1]])


def turned(vector: Array, angle: Array) -> Array:
    """Return one vector (2,) turned counter-clockwise by angles (n,), rad: (2, n)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def _cross(first: Array, second: Array) -> Array:
    return np.asarray(first[0] * second[1] - first[1] * second[0])


def _fitted(offset: Array, normal: Array, turn: Array, weight: Array) -> tuple[Array, Array]:
    """Fit offset (2, n) = centre + run-out turned by ``turn``, m.

    Across the normal, where an error of the force's direction is multiplied by the clearance, the
    offset counts for ACROSS of what it counts along it.
    """
    c, s = np.cos(turn), np.sin(turn)
    rows, wanted = [], []
    for (x, y), share in ((normal, 1.0), ((-normal[1], normal[0]), ACROSS)):
        row = np.stack([x, y, x * c + y * s, y * c - x * s], axis=1)
        rows.append(row * (share * weight)[:, None])
        wanted.append((x * offset[0] + y * offset[1]) * share * weight)
    solution, *_ = np.linalg.lstsq(np.concatenate(rows), np.concatenate(wanted), rcond=None)
    return solution[:2], solution[2:]
