"""Free channel: fit of its voltage against a reference, by a line or a table, with uncertainty.

Values are in the channel's own unit, signals in V. The line is fitted to the signals and inverted:
the reference is known better. A table has a point at each reference value, the mean of its
readings, and is linear between its points.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import GTC
import numpy as np

from rigapp.texts import say
from rigapp_calibration.arrays import Array, Whole
from rigapp_calibration.problems import Problem, blocked, refusal
from rigapp_calibration.taking.readings import (
    Rows,
    check_columns,
    check_steps,
    not_numbers,
    numbers,
    series_and_steps,
    unused_columns,
)
from rigapp_calibration.taking.uncertainty import (
    Budget,
    Contribution,
    at_most,
    combine,
    straight_line,
)

CHANNEL_COLUMNS = ("series", "step", "reference", "signal_V")
FEWEST_POINTS = 3
"""Reference points: two define a line or a table, the third checks it in between."""
SAME_POINT = 0.01
"""Part of the span within which references are one point: repeatability of a bath at a mark."""
TOO_UNCERTAIN = 0.05
"""Part of the span: the error of an uncalibrated transmitter is below it."""
DEAD = 1e-4
"""V: below the resolution of a 10 V input with 16 bits."""


@dataclass(frozen=True, slots=True)
class ChannelSettings:
    """Settings of a channel's calibration: characteristic and uncertainty of the reference.

    reference_uncertainty: standard, unit of the channel. resolution_volts: step of the signal.
    """

    method: Literal["line", "table"]
    reference_uncertainty: float
    resolution_volts: float = 0.0


@dataclass(frozen=True, slots=True)
class ChannelReadings:
    """Readings in the order taken: reference (n,) in the channel's unit, signal (n,) in V."""

    series: tuple[str, ...]
    step: Whole
    reference: Array
    signal: Array
    unused: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ChannelCalibration:
    """The result. points: (2, m) signals and values, rising signals; of a line its two ends.

    scale, offset: value = scale (signal - offset), of a line. residual: (n,) value of the
    calibration less reference. None where the readings are refused before they are fitted.
    """

    problems: tuple[Problem, ...]
    points: Array | None = None
    scale: float | None = None
    offset: float | None = None
    residual: Array | None = None
    budget: Budget | None = None

    @property
    def accepted(self) -> bool:
        """Return whether no problem blocks its use."""
        return not blocked(self.problems)


def channel_table(rows: Rows) -> ChannelReadings:
    """Return the readings of a table with the columns ``CHANNEL_COLUMNS``; raise ReadingsError."""
    return ChannelReadings(
        *series_and_steps(rows),
        reference=numbers(rows, "reference"),
        signal=numbers(rows, "signal_V"),
        unused=unused_columns(rows, CHANNEL_COLUMNS),
    )


def calibrate_channel(readings: ChannelReadings, settings: ChannelSettings) -> ChannelCalibration:
    """Fit the readings; mistakes are listed in the result's ``problems``."""
    problems = list(_unusable(readings))
    if blocked(problems):
        return ChannelCalibration(tuple(problems))
    place = _points_of(readings.reference)
    if settings.method == "table":
        points = _means(readings, place)
        problems += _no_table(points, len(readings.signal))
        if blocked(problems):
            return ChannelCalibration(tuple(problems))
        scale = offset = None
        lines = _of_table(readings, points, place)
    else:
        line = straight_line(readings.reference, readings.signal)
        scale, offset = float(1.0 / GTC.value(line[1])), float(GTC.value(line[0]))
        ends = np.array([readings.signal.min(), readings.signal.max()])
        points = np.stack([ends, scale * (ends - offset)])
        lines = _of_line(readings, points, line)
    steepest = float(np.abs(np.diff(points[1]) / np.diff(points[0])).max())
    lines += (
        Contribution("reference", settings.reference_uncertainty),
        at_most("resolution", 0.5 * settings.resolution_volts * steepest),
    )
    budget = combine(0.0, lines)
    problems += _too_uncertain(budget, float(np.ptp(readings.reference)))
    residual = value_at(points, readings.signal) - readings.reference
    return ChannelCalibration(tuple(problems), points, scale, offset, residual, budget)


def value_at(points: Array, signal: Array) -> Array:
    """Return the values of points (2, m) at signals (n,): linear, also beyond the ends."""
    low = np.clip(np.searchsorted(points[0], signal) - 1, 0, points.shape[1] - 2)
    slope = np.diff(points[1])[low] / np.diff(points[0])[low]
    return np.asarray(points[1, low] + slope * (signal - points[0, low]), np.float64)


def rule_of(result: Mapping[str, Any]) -> str:
    """Return in words how a recorded result converts a voltage to a value."""
    if result["table"] is not None:
        ends = result["table"][0], result["table"][-1]
        return say(
            "Table of {} points, {:.4g} V to {:.4g} V", len(result["table"]), ends[0][0], ends[1][0]
        )
    scale, offset = result["scale_per_V"], result["offset_V"]
    return say("Value = {:.6g} {}/V (voltage {:+.6f} V)", scale, result["unit"], -offset)


def _unusable(readings: ChannelReadings) -> Iterator[Problem]:
    yield from check_columns(readings.unused)
    odd = list(not_numbers(readings, np.column_stack([readings.reference, readings.signal])))
    if odd:
        yield from odd
        return
    yield from check_steps(readings, readings.series)
    count = len(set(_points_of(readings.reference).tolist()))
    if count < FEWEST_POINTS or len(readings.signal) <= FEWEST_POINTS:
        yield refusal(
            "too_few_points",
            "{} readings at {} references; take at least {} references, up and down.",
            len(readings.signal),
            count,
            FEWEST_POINTS,
        )
    elif float(np.ptp(readings.signal)) < DEAD:
        yield refusal(
            "signal_dead",
            "The voltage does not follow the reference; is the channel connected?",
        )


def _points_of(reference: Array) -> Whole:
    """Return for each reading the number of its point; (n,), from 0, references rising."""
    order = np.argsort(reference, kind="stable")
    apart = np.diff(reference[order]) > SAME_POINT * np.ptp(reference)
    place = np.empty(len(reference), np.int64)
    place[order] = np.concatenate([[0], np.cumsum(apart)])
    return place


def _means(readings: ChannelReadings, place: Whole) -> Array:
    count = np.bincount(place)
    points = np.stack(
        [np.bincount(place, one) / count for one in (readings.signal, readings.reference)]
    )
    return points if points[0, -1] > points[0, 0] else np.ascontiguousarray(points[:, ::-1])


def _no_table(points: Array, readings: int) -> Iterator[Problem]:
    wrong = np.flatnonzero(np.diff(points[0]) <= 0.0)
    if len(wrong):
        value = points[1, wrong[0] + 1]
        yield refusal(
            "not_monotonic",
            "The voltage at the reference {:g} turns back: it would mean two values."
            " Take the reading again, or leave the point out.",
            value,
        )
    if readings <= points.shape[1]:
        yield refusal(
            "no_repeats",
            (
                "Each reference was read once, so the repeatability of a reading is not known;"
                " take a second series."
            ),
        )


def _of_line(
    readings: ChannelReadings, points: Array, line: tuple[Any, Any]
) -> tuple[Contribution, ...]:
    residual = value_at(points, readings.signal) - readings.reference
    free = len(residual) - 2
    std = math.sqrt(float(residual @ residual) / free)
    ends = float(readings.reference.min()), float(readings.reference.max())
    fit = max(float(GTC.uncertainty(line[0] + line[1] * end)) for end in ends)
    fit /= abs(float(GTC.value(line[1])))
    return (
        Contribution(say("residual of the line"), std, free, "A"),
        Contribution(say("line, at the end of its range"), fit, free, "A"),
    )


def _of_table(readings: ChannelReadings, points: Array, place: Whole) -> tuple[Contribution, ...]:
    """Return the repeatability, the uncertainty of the means and the error between the points.

    Leaving out a point shows the error of the table at the middle of an interval of twice the
    width; for a smooth curve the error in a single interval is a quarter of that.
    """
    residual = value_at(points, readings.signal) - readings.reference
    free = len(residual) - points.shape[1]
    std = math.sqrt(float(residual @ residual) / free)
    fewest = int(np.bincount(place).min())
    between = 0.0
    for one in range(1, points.shape[1] - 1):
        rest = np.delete(points, one, axis=1)
        off = abs(float(value_at(rest, points[:1, one])[0] - points[1, one]))
        widths = np.diff(points[0, one - 1 : one + 2])
        between = max(between, 0.25 * off * float(widths.max() / widths.min()))
    return (
        Contribution(say("repeatability of a reading"), std, free, "A"),
        Contribution(say("mean of a point"), std / math.sqrt(fewest), free, "A"),
        at_most(say("between the points"), between),
    )


def _too_uncertain(budget: Budget, span: float) -> Iterator[Problem]:
    if budget.expanded <= TOO_UNCERTAIN * span:
        return
    worst = max(budget.contributions, key=lambda one: one.uncertainty)
    yield refusal(
        "too_uncertain",
        "The expanded uncertainty {:.3g} is more than {:g} % of the span {:.4g}; its"
        " largest part is {}.",
        budget.expanded,
        100 * TOO_UNCERTAIN,
        span,
        worst.name,
    )
