"""Reduce the prediction of a test file: agreement with the model, wear, complete cycles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.report.testreport.envelope import Floats, envelope
from rigapp.report.testreport.facts import Line, Peak, furthest, mean, parts_of
from rigapp.schema.channels import Channel
from rigapp.schema.deviations import deviation_columns, deviation_sentence
from rigapp.schema.rownumbers import RowNumbers
from rigapp.storage import Columns, StoredColumns, TestReader, blocks, row_numbers
from rigapp.texts import capitalised
from rigapp_model.errors import ModelError
from rigapp_model.wear.techniques import technique_of

TRIGGERED = ("before", "trigger", "after")
RESIDUALS = ("residual_rms", "residual_1_rms", "residual_2_rms", "phase_shift")
WEAR = ("wear_depth", "measured_wear_depth", "driven_wear_depth")
COMPARED = tuple(
    f"{channel}_{statistic}" for channel in ("force", "force_1", "force_2")
    for statistic in ("max", "min", "rms")
)  # fmt: skip


@dataclass(frozen=True, slots=True, eq=False)
class Residual:
    """A measure of agreement over the test. worst: the largest magnitude."""

    name: str
    unit: str
    mean: float
    worst: Peak
    last: float
    line: Line


@dataclass(frozen=True, slots=True)
class Pair:
    """The mean of a statistic over the compared revolutions, measured and predicted."""

    name: str
    measured: float
    predicted: float


@dataclass(frozen=True, slots=True, eq=False)
class LastDepth:
    """The last known wear depth (mm), and its revolution.

    rate: mm per revolution over the last half of the revolutions with a depth. uncertainty:
    expanded (k = 2), mm, NaN where the file has none. doubt: the same against revolution.
    """

    depth: float
    revolution: int
    rate: float
    line: Line
    uncertainty: float = float("nan")
    doubt: Line | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Agreement:
    """The prediction for the test. compared: number of compared revolutions.

    joint: assumption of the joint technique, empty when not in the file. deviation: final
    explanation of a difference beyond the tolerances, empty without such a difference.
    """

    compared: int
    residuals: tuple[Residual, ...]
    pairs: tuple[Pair, ...]
    lines: Mapping[str, Line]
    wear: Mapping[str, LastDepth | None]
    joint: str = ""
    deviation: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class CyclePicture:
    """A saved cycle over the angle, with the model's curves where they are saved.

    columns: angle and channels, sorted by angle. model: angle and curves of model_revolution.
    residual: measured minus predicted by channel, at the measured angles. free: the free channels
    among the columns.
    """

    revolution: int
    columns: Columns
    model_revolution: int | None
    model: Columns
    residual: Mapping[str, Floats]
    free: tuple[Channel, ...] = ()


@dataclass(frozen=True, slots=True)
class Burst:
    """Complete cycles stored around a trigger. trigger: its revolution, 0 if it has no cycle.

    quality: combined flags of the cycles.
    """

    trigger: int
    first: int
    last: int
    cycles: int
    quality: int


def bursts_of(reader: TestReader) -> tuple[Burst, ...]:
    """Return the complete cycles stored by triggers, consecutive ones as one burst."""
    reasons = reader.cycle_reasons()
    indices = [i for i, why in enumerate(reasons) if why in TRIGGERED]
    if not indices:
        return ()
    numbers = reader.cycle_revolutions()
    qualities = reader.cycle_qualities()
    result: list[Burst] = []
    for index in indices:
        number, quality = int(numbers[index]), int(qualities[index])
        trigger = number if reasons[index] == "trigger" else 0
        newest = result[-1] if result else None
        following = newest is not None and number - newest.last <= 1
        if newest is None or not following or (trigger and newest.trigger):
            result.append(Burst(trigger, number, number, 1, quality))
            continue
        result[-1] = Burst(
            newest.trigger or trigger, newest.first, number, newest.cycles + 1,
            newest.quality | quality,
        )  # fmt: skip
    return tuple(result)


def agreement_of(reader: TestReader) -> Agreement | None:
    """Return the prediction for the test; None when nothing is predicted."""
    table = StoredColumns(reader, "prediction")
    number = row_numbers(reader, "prediction")
    if not len(number):
        return None
    units = reader.column_units("prediction")
    return Agreement(
        compared=len(number),
        residuals=tuple(
            _residual(name, units[name], number, table[name]) for name in RESIDUALS if name in table
        ),
        pairs=_pairs(reader, number),
        lines={name: envelope(number, table[name]) for name in COMPARED if name in table},
        wear=wear_of(reader),
        joint=_assumption(reader),
        deviation=_deviation(table),
    )


def wear_of(reader: TestReader) -> dict[str, LastDepth | None]:
    """Return the depths of a test by column, None if unknown."""
    table, number = StoredColumns(reader, "prediction"), row_numbers(reader, "prediction")
    return {
        name: _wear(number, table[name], table.get(f"{name}_uncertainty"))
        if name in table and len(number)
        else None
        for name in WEAR
    }


def _deviation(table: StoredColumns) -> str:
    """Return the last prediction's explanation of a difference; empty without one."""
    names = [column.name for column in deviation_columns()]
    if not all(name in table for name in names):
        return ""
    return capitalised(deviation_sentence(*(float(table[name][-1]) for name in names)))


def _assumption(reader: TestReader) -> str:
    """Return the assumption of the test file's joint technique; empty when it is not readable."""
    try:
        test = parse_test(str(reader.configuration()["test"]), "test", recorded=True)
        return technique_of(test.prediction.joint).sentence
    except (UnusableInput, KeyError, ModelError):
        return ""


def _residual(name: str, unit: str, number: RowNumbers, values: NDArray[Any]) -> Residual:
    worst, last = Peak(float("nan"), 0, 0), float("nan")
    row = furthest(values, np.abs)
    if row is not None:
        worst = Peak(float(values[row]), int(number[row]), 0)
        last = float(values[np.flatnonzero(np.isfinite(values))[-1]])
    return Residual(name, unit, mean(values), worst, last, envelope(number, values))


def _pairs(reader: TestReader, number: RowNumbers) -> tuple[Pair, ...]:
    measured_number = row_numbers(reader, "revolutions")
    known, predicted = reader.column_units(), reader.column_units("prediction")
    names = [name for name in COMPARED if name in known and name in predicted]
    if not names or not len(measured_number):
        return ()
    sums = {name: np.zeros(3) for name in names}
    for first, block in blocks(reader, names, "prediction"):
        predicted_numbers = number[first : first + len(block[names[0]])]
        start = measured_number.searchsorted(predicted_numbers[0])
        stop = measured_number.searchsorted(predicted_numbers[-1], "right")
        numbers = measured_number[start:stop]
        _, at_mine, at_there = np.intersect1d(predicted_numbers, numbers, True, True)
        for name in names:
            measured = reader.column(name, start, stop)[at_there].astype(np.float64)
            model = block[name][at_mine].astype(np.float64)
            both = np.isfinite(measured) & np.isfinite(model)
            sums[name] += (both.sum(), measured[both].sum(), model[both].sum())
    result = []
    for name, (count, measured_sum, model_sum) in sums.items():
        unknown = float("nan")
        means = (measured_sum / count, model_sum / count) if count else (unknown, unknown)
        result.append(Pair(name, *map(float, means)))
    return tuple(result)


def _wear(number: RowNumbers, depth: NDArray[Any], doubt: NDArray[Any] | None) -> LastDepth | None:
    known = np.isfinite(depth)
    count = int(np.count_nonzero(known))
    if not count:
        return None
    all_known = count == len(depth)
    # Indices of a long test would need as much memory as its depths.
    finite = np.arange(0) if all_known else np.flatnonzero(known)
    late = np.arange(count // 2, count) if all_known else finite[count // 2 :]
    last = int(late[-1])
    uncertainty = float("nan") if doubt is None else float(doubt[last])
    line = envelope(number, depth) if all_known else envelope(number[finite], depth[finite])
    band = None
    if doubt is not None:
        band = envelope(number, doubt) if all_known else envelope(number[finite], doubt[finite])
    del finite, known
    value = float(depth[last])
    return LastDepth(value, int(number[last]), _rate(number, depth, late), line, uncertainty, band)


def _rate(number: RowNumbers, depth: NDArray[Any], late: NDArray[np.intp]) -> float:
    """Return the slope of a straight line through the depths of some rows, mm per revolution."""
    if late.size < 2 or number[int(late[-1])] <= number[int(late[0])]:
        return float("nan")
    begin, count = float(number[int(late[0])]), float(late.size)
    sums = np.zeros(4)
    level = float(depth[late[0]])
    for _, rows in parts_of(late):
        x, y = number[rows] - begin, depth[rows] - level
        sums += (x.sum(), y.sum(), x @ x, x @ y)
    x_sum, y_sum, square, product = sums.tolist()
    return (product - x_sum * y_sum / count) / (square - x_sum**2 / count)


def cycles_of(reader: TestReader) -> tuple[CyclePicture, ...]:
    """Return the first, the middle and the last saved cycle, fewer when fewer are saved."""
    total = reader.committed("cycles")
    return cycles_at(reader, sorted({0, total // 2, total - 1}) if total else [])


def cycles_at(reader: TestReader, indices: Sequence[int]) -> tuple[CyclePicture, ...]:
    """Return the saved cycles at some indices, each with its model curves."""
    curves, saved = reader.curve_revolutions(), reader.cycle_revolutions()
    result = []
    for index in indices:
        following = int(saved[index + 1]) if index + 1 < len(saved) else None
        result.append(_picture(reader, index, following, curves))
    return tuple(result)


def _picture(
    reader: TestReader, index: int, following: int | None, curves: NDArray[np.int64]
) -> CyclePicture:
    stored = reader.cycle(index)
    order = np.argsort(stored.columns["angle"], kind="stable")
    columns = {name: values[order] for name, values in stored.columns.items()}
    later = curves[curves >= stored.revolution]
    later = later if following is None else later[later < following]
    model_revolution = int(later.min()) if later.size else None
    model: Columns = {}
    if model_revolution is not None:
        model = reader.predicted_curve(model_revolution) or {}
    residual = {
        name: columns[name] - np.interp(columns["angle"], model["angle"], model[name], period=360.0)
        for name in model
        if name != "angle" and name in columns
    }
    free = tuple(channel for channel in reader.plan.table.free if channel.name in columns)
    return CyclePicture(stored.revolution, columns, model_revolution, model, residual, free)
