"""The study file, and the points of its design."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.numbers import within

MOST_POINTS = 1_000_000
DesignName = Literal["grid", "latin-hypercube", "sobol"]


class Spread(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Vary a number from low to high; levels: its values on a grid."""

    low: float
    high: float
    levels: Annotated[int, msgspec.Meta(ge=2, le=1000)] = 5
    scale: Literal["linear", "log"] = "linear"


Varied = list[float | str] | Spread


class DesignSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[design]: the points. repeats: runs of each point by different seeds, for virtual tests."""

    kind: DesignName = "grid"
    points: Annotated[int, within(1, MOST_POINTS)] = 1024
    seed: Annotated[int, within(0, 2**31 - 1)] = 1
    repeats: Annotated[int, within(1, 100_000)] = 1


class StudyFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A study file; ``rigapp.study.kinds`` has the [run] of each kind.

    parameters: the parameter file, from the study file's folder. vary: dotted keys of the parameter
    file, and of [run] with the prefix ``run.``.
    """

    schema: int
    kind: str
    run: Any
    parameters: str = ""
    vary: dict[str, Varied] = {}
    design: DesignSection = DesignSection()


Value = float | str
Unit = NDArray[np.float64]

FEWEST_BLOCKS = 4
"""Fewer base points give no sensitivities: all rows are plain points then."""


@dataclass(frozen=True, slots=True)
class StudyPoint:
    """One row: its values by key, and the seed of its random numbers."""

    number: int
    values: Mapping[str, Value]
    seed: int


@dataclass(frozen=True, slots=True)
class Design:
    """All rows. blocks: base points of the sensitivities, 0 without.

    With blocks the rows begin with ``blocks`` base points A, then as many B, then for each key
    those of A with that key from B (Saltelli 2010).
    """

    points: tuple[StudyPoint, ...]
    blocks: int = 0


def design_of(vary: Mapping[str, Varied], section: DesignSection) -> Design:
    """Return the points of a study; raise UnusableInput for keys that cannot be varied."""
    for key, varied in vary.items():
        _require_usable(key, varied)
    if section.kind == "grid":
        rows: list[dict[str, Value]] = _grid(vary)
        blocks = 0
    else:
        if not vary:
            raise UnusableInput("design.kind = {}: vary names no keys.", repr(section.kind))
        unit, blocks = _drawn(len(vary), section)
        rows = [
            {key: _at(varied, u) for (key, varied), u in zip(vary.items(), point, strict=True)}
            for point in unit.tolist()
        ]
    if len(rows) * section.repeats > MOST_POINTS:
        raise UnusableInput(
            "the design has {} points; at most {}.",
            f"{len(rows) * section.repeats:,}",
            f"{MOST_POINTS:,}",
        )
    if section.repeats > 1:
        blocks = 0
    repeated = [row for row in rows for _ in range(section.repeats)]
    seeds = np.random.SeedSequence(section.seed).generate_state(len(repeated), np.uint32)
    return Design(
        tuple(
            StudyPoint(number, values, int(seed))
            for number, (values, seed) in enumerate(zip(repeated, seeds.tolist(), strict=True))
        ),
        blocks,
    )


def _require_usable(key: str, varied: Varied) -> None:
    if isinstance(varied, Spread):
        finite = math.isfinite(varied.low) and math.isfinite(varied.high)
        if not (finite and varied.low < varied.high):
            raise UnusableInput(
                "vary.{}: low = {:g} must be below {:g}.", key, varied.low, varied.high
            )
        if varied.scale == "log" and varied.low <= 0.0:
            raise UnusableInput(
                "vary.{}: low = {:g} must be above 0 on a log scale.", key, varied.low
            )
    elif not varied:
        raise UnusableInput("vary.{}: the list is empty; name a value at least.", key)


def _grid(vary: Mapping[str, Varied]) -> list[dict[str, Value]]:
    """Return every combination, the last key changing quickest."""
    sizes = [v.levels if isinstance(v, Spread) else len(v) for v in vary.values()]
    if math.prod(sizes) > MOST_POINTS:
        raise UnusableInput(
            'the grid has {} points; at most {}: take fewer levels, or design.kind = "sobol".',
            f"{math.prod(sizes):,}",
            f"{MOST_POINTS:,}",
        )
    levels: list[Sequence[Value]] = [
        [_at(v, u) for u in np.linspace(0.0, 1.0, v.levels)] if isinstance(v, Spread) else v
        for v in vary.values()
    ]
    return [dict(zip(vary, combination, strict=True)) for combination in itertools.product(*levels)]


def _drawn(dimensions: int, section: DesignSection) -> tuple[Unit, int]:
    """Return points in the unit cube (n, d), and how many base points of sensitivities lead."""
    from scipy.stats import qmc

    count = section.points
    if section.kind == "latin-hypercube":
        return qmc.LatinHypercube(dimensions, rng=section.seed).random(count), 0
    base = 2 ** int(math.log2(max(count // (dimensions + 2), 1)))
    if base < FEWEST_BLOCKS:
        return _sobol(dimensions, count, section.seed), 0
    pair = _sobol(2 * dimensions, base, section.seed)
    a, b = pair[:, :dimensions], pair[:, dimensions:]
    mixed = [a.copy() for _ in range(dimensions)]
    for index, column in enumerate(mixed):
        column[:, index] = b[:, index]
    rest = _sobol(dimensions, count - base * (dimensions + 2), section.seed + 1)
    return np.concatenate([a, b, *mixed, rest]), base


def _sobol(dimensions: int, count: int, seed: int) -> Unit:
    """Return the first points of a scrambled sequence, (count, d)."""
    from scipy.stats import qmc

    if count == 0:
        return np.empty((0, dimensions))
    power = math.ceil(math.log2(max(count, 1)))
    return np.asarray(qmc.Sobol(dimensions, rng=seed).random_base2(power)[:count])


def _at(varied: Varied, unit: float) -> Value:
    """Return the value at a part 0 .. 1 of the range of a key."""
    if not isinstance(varied, Spread):
        return varied[min(int(unit * len(varied)), len(varied) - 1)]
    if varied.scale == "log":
        return float(varied.low * (varied.high / varied.low) ** unit)
    return float(varied.low + (varied.high - varied.low) * unit)
