"""The force of a hanging weight: mass, local gravity, air buoyancy, and the uncertainty of each."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import GTC
import numpy as np
from numpy.typing import ArrayLike

from rigapp.texts import SentenceError, say
from rigapp_calibration.arrays import Array

REFERENCE_AIR_DENSITY = 1.2
REFERENCE_MASS_DENSITY = 8000.0
"""Reference density of a conventional mass, kg/m^3 (OIML D 28)."""
STANDARD_GRAVITY = 9.80665
"""The standard acceleration of free fall, m/s^2 (CGPM 1901)."""

MassKind = Literal["conventional", "true"]


@dataclass(frozen=True, slots=True)
class Place:
    """Gravity (m/s^2) and air density (kg/m^3) at the weights, with standard uncertainties."""

    gravity: float
    gravity_uncertainty: float
    air_density: float = REFERENCE_AIR_DENSITY
    air_density_uncertainty: float = 0.05


@dataclass(frozen=True, slots=True)
class WeightSet:
    """Properties of the weights: kind of mass, density (kg/m^3), relative uncertainty.

    hanger_mass: mass (kg) at every loaded step besides the pieces. at_zero: mass (kg)
    that stays on the pin at the zeros as well, and is in no load.
    """

    mass_kind: MassKind = "conventional"
    density: float = REFERENCE_MASS_DENSITY
    density_uncertainty: float = 100.0
    relative_uncertainty: float = 5e-5
    hanger_mass: float = 0.0
    at_zero: float = 0.0


def normal_gravity(latitude: float, height: float = 0.0) -> float:
    """Return the normal gravity (m/s^2) at a latitude (rad) and height (m) on the ellipsoid.

    Somigliana's closed formula with the WGS 84 constants and the free-air gradient. A local value
    differs by up to some 1e-4 of it.
    """
    s = math.sin(latitude) ** 2
    on_ellipsoid = (
        9.7803253359 * (1.0 + 0.00193185265241 * s) / math.sqrt(1.0 - 0.00669437999013 * s)
    )
    return on_ellipsoid - 3.086e-6 * height


def force_per_mass(weights: WeightSet, place: Place) -> float:
    """Return newton per kilogram of stated mass: gravity less the buoyancy of the air.

    A conventional mass is that of a reference weight of 8000 kg/m^3 which balances the piece in air
    of 1.2 kg/m^3 (OIML D 28); its true mass follows from the piece's own density.
    """
    factor = 1.0 - place.air_density / weights.density
    if weights.mass_kind == "conventional":
        factor *= (1.0 - REFERENCE_AIR_DENSITY / REFERENCE_MASS_DENSITY) / (
            1.0 - REFERENCE_AIR_DENSITY / weights.density
        )
    return place.gravity * factor


def weight_force(mass: ArrayLike, weights: WeightSet, place: Place) -> Array:
    """Return the downward force (N) of stated masses (kg); the hanger adds to every mass > 0."""
    stated = np.asarray(mass, dtype=np.float64)
    hanging = np.where(stated > 0.0, stated + weights.hanger_mass, 0.0)
    return hanging * force_per_mass(weights, place)


def relative_force_uncertainty(weights: WeightSet, place: Place) -> float:
    """Return the relative standard uncertainty of the force of any load of the set.

    Mass, gravity, air density and weight density by first-order propagation. It is common to all
    loads, so it scales the whole calibration and no residual shows it.
    """
    mass = GTC.ureal(1.0, weights.relative_uncertainty, label=say("mass of the weights"))
    gravity = GTC.ureal(place.gravity, place.gravity_uncertainty, label=say("local gravity"))
    air = GTC.ureal(place.air_density, place.air_density_uncertainty, label=say("air density"))
    density = GTC.ureal(
        weights.density, weights.density_uncertainty, label=say("density of weights")
    )
    force = mass * gravity * (1.0 - air / density)
    if weights.mass_kind == "conventional":
        force *= (1.0 - REFERENCE_AIR_DENSITY / REFERENCE_MASS_DENSITY) / (
            1.0 - REFERENCE_AIR_DENSITY / density
        )
    return float(GTC.uncertainty(force) / GTC.value(force))


def pin_force(weight: ArrayLike, angle: ArrayLike, offset: float) -> Array:
    """Return the force on the pin (n, 2) in the pin (crank) frame of weights (N) at angles (rad).

    The weight pulls towards -y of the fixed frame; ``offset`` comes from the angle reference step.
    """
    turned = np.asarray(angle, dtype=np.float64) + offset
    size = np.asarray(weight, dtype=np.float64)
    return np.stack((-size * np.sin(turned), -size * np.cos(turned)), axis=-1)


GRAM = 1e-3
FEWEST_LOADS = 3
"""Number of loads above zero: two give neither a curvature nor a loop."""
MOST_PIECES = 64
"""Limit of the search for all sums; no laboratory hangs more."""


class PiecesError(SentenceError, ValueError):
    """The laboratory's weights cannot make a load; the text names it."""


@dataclass(frozen=True, slots=True)
class WeightChange:
    """A change at the hanger: masses (kg) to add and to remove, and the resulting pieces."""

    add: tuple[float, ...]
    remove: tuple[float, ...]
    hanging: tuple[float, ...]

    @property
    def mass(self) -> float:
        """Return the resulting mass of the pieces, kg."""
        return sum(self.hanging)


def piece_texts(pieces: Iterable[float]) -> list[str]:
    """Return pieces (kg) in words, heaviest first, equal ones together."""
    ordered = sorted(Counter(pieces).items(), reverse=True)
    return [
        say("{} × {:g} kg", count, mass) if count > 1 else say("{:g} kg", mass)
        for mass, count in ordered
    ]


def next_change(
    target: float, hanging: Sequence[float], available: Sequence[float], tolerance: float = 0.05
) -> WeightChange:
    """Return the change at the hanger whose load is nearest to ``target`` (kg).

    available: every piece of the set, those that hang included. Pieces that hang stay where that
    can make the target. Raises PiecesError when nothing comes within ``tolerance`` (kg).
    """
    if len(available) > MOST_PIECES:
        raise PiecesError("{} pieces are more than {}; name fewer", len(available), MOST_PIECES)
    for strange in _beyond(hanging, available):
        raise PiecesError("a piece of {:g} kg hangs but is not in the set", strange)
    rest, kept = _beyond(available, hanging), _sorted(hanging)
    present = sum(kept)
    if target >= present - tolerance:
        more = _nearest(target - present, rest)
        if abs(sum(more) + present - target) <= tolerance:
            return WeightChange(more, (), _sorted((*kept, *more)))
    fewer = _nearest(target, kept)
    if abs(sum(fewer) - target) <= tolerance:
        return WeightChange((), _beyond(kept, fewer), _sorted(fewer))
    fresh = _nearest(target, available)
    if abs(sum(fresh) - target) > tolerance:
        raise PiecesError(
            "the weights cannot make {:g} kg; the nearest is {:g} kg of {:g} kg in all",
            target,
            sum(fresh),
            sum(available),
        )
    return WeightChange(_beyond(fresh, kept), _beyond(kept, fresh), _sorted(fresh))


def change_to(after: Sequence[float], before: Sequence[float]) -> WeightChange:
    """Return the change at the hanger from some pieces (kg) to others."""
    return WeightChange(_beyond(after, before), _beyond(before, after), _sorted(after))


def possible_loads(heaviest: float, steps: int, available: Sequence[float]) -> tuple[float, ...]:
    """Return ``steps`` feasible rising loads (kg) near equal shares of ``heaviest``."""
    loads: list[float] = []
    for step in range(1, steps + 1):
        load = sum(_nearest(heaviest * step / steps, available))
        if not loads or load > loads[-1] + GRAM:
            loads.append(load)
    return tuple(loads)


def rising_loads(
    heaviest: float, steps: int, available: Sequence[float]
) -> tuple[tuple[float, ...], ...]:
    """Return what hangs (kg) at each of ``steps`` rising loads: each adds pieces to the last.

    The loads are near equal shares of ``heaviest`` (kg) and none is above it; there are fewer where
    the pieces are few. A falling series takes the same pieces off in the reverse order, so that no
    load is approached from the wrong side.
    """
    chain: tuple[tuple[float, ...], ...] = ()
    for many in (False, True):
        largest = _nearest(heaviest, available, heaviest + GRAM, many=many)
        chain = tuple(_chain(heaviest, steps, largest))
        if len(chain) >= min(steps, FEWEST_LOADS):
            break
    return chain


def _chain(heaviest: float, steps: int, largest: Sequence[float]) -> Iterator[tuple[float, ...]]:
    """Yield the pieces of each step, up to those of the largest load."""
    hanging: tuple[float, ...] = ()
    for step in range(1, steps + 1):
        rest, target = _beyond(largest, hanging), heaviest * step / steps
        added = rest if step == steps else _nearest(target - sum(hanging), rest)
        if added:
            hanging = _sorted((*hanging, *added))
            yield hanging


def _nearest(
    target: float, pieces: Sequence[float], most: float = math.inf, *, many: bool = False
) -> tuple[float, ...]:
    """Return the subset whose sum (kg, at most ``most``) is nearest to the target.

    Dynamic programming over sums in whole grams: a sum is reached with the fewest pieces, or with
    ``many``.
    """
    more = -1 if many else 1
    reached: dict[int, tuple[float, ...]] = {0: ()}
    limit = int(min(2.0 * max(target, 0.0) + GRAM, max(most, 0.0)) / GRAM + 0.5)
    for piece in sorted(pieces, reverse=True):
        grams = round(piece / GRAM)
        for total, subset in list(reached.items()):
            larger = total + grams
            if larger > limit:
                continue
            known = reached.get(larger)
            if known is None or more * len(known) > more * (len(subset) + 1):
                reached[larger] = (*subset, piece)
    wanted = round(target / GRAM)
    best = min(reached, key=lambda total: (abs(total - wanted), more * len(reached[total])))
    return _sorted(reached[best])


def _beyond(pieces: Sequence[float], others: Sequence[float]) -> tuple[float, ...]:
    """Return the pieces without the others, as a difference of multisets."""
    return _sorted((Counter(pieces) - Counter(others)).elements())


def _sorted(pieces: Iterable[float]) -> tuple[float, ...]:
    return tuple(sorted(pieces, reverse=True))
