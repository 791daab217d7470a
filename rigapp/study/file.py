"""A study file: what is computed, what is varied, and at which points."""

from __future__ import annotations

from typing import Annotated, Any, Literal

import msgspec

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
    """[design]: the points. repeats: each point so often, by another seed, for virtual tests."""

    kind: DesignName = "grid"
    points: Annotated[int, within(1, MOST_POINTS)] = 1024
    seed: Annotated[int, within(0, 2**31 - 1)] = 1
    repeats: Annotated[int, within(1, 100_000)] = 1


class StudyFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A study file; ``rigapp.study.kinds`` says what [run] holds for each kind.

    parameters: the parameter file, from the study file's folder. vary: dotted keys of the parameter
    file, and of [run] with ``run.`` before them.
    """

    schema: int
    kind: str
    run: Any
    parameters: str = ""
    vary: dict[str, Varied] = {}
    design: DesignSection = DesignSection()
