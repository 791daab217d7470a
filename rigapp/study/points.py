"""Work of a worker: compute some points of a study, one row each, failed or not."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_parameters
from rigapp.schema.details import error_text
from rigapp.study.design import StudyPoint, Value
from rigapp.study.kinds import KINDS, Noted
from rigapp.texts import joined, say

if TYPE_CHECKING:
    from rigapp_model.parameters import Parameters

RUN = "run."
"""Prefix of the keys of [run] among the varied ones."""


class StudyRow(msgspec.Struct, frozen=True):
    """The row of a point: its known results by name, or why there are none.

    notes: remarks on the results, sentences.
    """

    number: int
    numbers: dict[str, float] = {}
    problem: str = ""
    notes: str = ""


class Batch(msgspec.Struct, frozen=True):
    """Some points with everything that a worker needs, on any computer.

    parameters: the parameter file's tables; run: those of [run].
    """

    kind: str
    parameters: dict[str, Any]
    run: dict[str, Any]
    points: tuple[StudyPoint, ...]


def computed(batch: Batch) -> list[StudyRow]:
    """Return the rows of some points, in their order."""
    return [_row(batch, point) for point in batch.points]


def _row(batch: Batch, point: StudyPoint) -> StudyRow:
    kind = KINDS[batch.kind]
    try:
        parameters, run = meant(batch, point.values)
        computed_point = kind.compute(parameters, run, point.seed)
    except (ValueError, ArithmeticError, UnusableInput, OSError) as error:
        return StudyRow(
            point.number, problem=joined(" ", error_text(error, "it cannot be computed").split())
        )
    noted = computed_point if isinstance(computed_point, Noted) else Noted(computed_point)
    known = {key: number for key, number in noted.numbers.items() if math.isfinite(number)}
    return StudyRow(point.number, known, notes=str(joined(" ", noted.notes)))


def meant(batch: Batch, values: Mapping[str, Value]) -> tuple[Parameters | None, Any]:
    """Return the parameters and settings of a point; raise UnusableInput."""
    kind, run = KINDS[batch.kind], dict(batch.run)
    tree = copy.deepcopy(batch.parameters)
    for key, value in values.items():
        if key.startswith(RUN):
            run[key.removeprefix(RUN)] = value
        else:
            *path, last = key.split(".")
            table = tree
            for part in path:
                table = table.setdefault(part, {})
            table[last] = value
    try:
        settings = msgspec.convert(run, kind.settings, strict=False)
    except msgspec.ValidationError as error:
        raise UnusableInput("[run]: the values cannot be used ‹{}›", error) from error
    return parse_parameters(tree, say("the point")) if kind.modelled else None, settings
