"""Which weights to hang next: from what a laboratory has, with as few changes as possible."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

GRAM = 1e-3
MOST_PIECES = 64
"""The sums of so many pieces are found at once; no laboratory hangs more."""


class PiecesError(ValueError):
    """Say which load the laboratory's weights cannot make."""


@dataclass(frozen=True, slots=True)
class WeightChange:
    """Tell what to do at the hanger: masses (kg) to add and to take off, and what hangs then."""

    add: tuple[float, ...]
    remove: tuple[float, ...]
    hanging: tuple[float, ...]

    @property
    def mass(self) -> float:
        """Return the mass of the pieces that hang then, kg."""
        return sum(self.hanging)


def told_pieces(pieces: Iterable[float]) -> list[str]:
    """Return the words for pieces (kg), heaviest first, equal ones together."""
    ordered = sorted(Counter(pieces).items(), reverse=True)
    return [f"{count} × {mass:g} kg" if count > 1 else f"{mass:g} kg" for mass, count in ordered]


def next_change(
    target: float, hanging: Sequence[float], available: Sequence[float], tolerance: float = 0.05
) -> WeightChange:
    """Return the change at the hanger that brings the load nearest to ``target`` (kg).

    available: every piece of the set, those that hang included. Pieces that hang stay where that
    can make the target. Raises PiecesError when nothing comes within ``tolerance`` (kg).
    """
    if len(available) > MOST_PIECES:
        raise PiecesError(f"{len(available)} pieces are more than {MOST_PIECES}; name fewer")
    for strange in _beyond(hanging, available):
        raise PiecesError(f"a piece of {strange:g} kg hangs but is not in the set")
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
            f"the weights cannot make {target:g} kg; the nearest is {sum(fresh):g} kg of"
            f" {sum(available):g} kg in all"
        )
    return WeightChange(_beyond(fresh, kept), _beyond(kept, fresh), _sorted(fresh))


def possible_loads(heaviest: float, steps: int, available: Sequence[float]) -> tuple[float, ...]:
    """Return ``steps`` rising loads (kg) near equal shares of ``heaviest`` that can be made."""
    loads: list[float] = []
    for step in range(1, steps + 1):
        load = sum(_nearest(heaviest * step / steps, available))
        if not loads or load > loads[-1] + GRAM:
            loads.append(load)
    return tuple(loads)


def _nearest(target: float, pieces: Sequence[float]) -> tuple[float, ...]:
    """Return the subset whose sum is nearest to the target, large pieces first.

    Dynamic programming over sums in whole grams: a sum is reached with the fewest pieces.
    """
    reached: dict[int, tuple[float, ...]] = {0: ()}
    limit = round(2.0 * max(target, 0.0) / GRAM) + 1
    for piece in sorted(pieces, reverse=True):
        grams = round(piece / GRAM)
        for total, subset in list(reached.items()):
            larger = total + grams
            if larger > limit:
                continue
            known = reached.get(larger)
            if known is None or len(known) > len(subset) + 1:
                reached[larger] = (*subset, piece)
    wanted = round(target / GRAM)
    best = min(reached, key=lambda total: (abs(total - wanted), len(reached[total])))
    return _sorted(reached[best])


def _beyond(pieces: Sequence[float], others: Sequence[float]) -> tuple[float, ...]:
    """Return the pieces that are not among the others, each counted as often as it is there."""
    return _sorted((Counter(pieces) - Counter(others)).elements())


def _sorted(pieces: Iterable[float]) -> tuple[float, ...]:
    return tuple(sorted(pieces, reverse=True))
