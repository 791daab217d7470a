"""The one table of what ends a test before its last revolution: the criteria of ``[stop]``.

A new criterion is one row here and its key in ``config.recipe.StopSection``. Judged are they by
``engine.judging.criteria``; recipe, form, check, alarms and report read the words here.
"""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass

At = Callable[[str], float]
"""Gives the value of a column, by name."""

Sentence = Callable[[float, float, int], str]
"""Says what met a criterion: value, level, and the number of revolutions of its row or window."""


class Sight(enum.Enum):
    """Where the value comes from: the clocks, every judged revolution, or the twin's answer."""

    CLOCK = enum.auto()
    ROW = enum.auto()
    PREDICTION = enum.auto()


@dataclass(frozen=True, slots=True)
class Criterion:
    """What ends a test when its value, in the unit of its key, is at or above the key's level.

    falls: it is met at or below the level instead.
    value: of the columns that ``sight`` gives; a clock has ``time`` (s) and ``running_time`` (h).
    planned: it is the end that was planned (complete), else a limit (stopped). count: key of how
    many judged revolutions in a row must reach the level. window: key of the revolutions over which
    the slope of the value, per 1000 revolutions, is judged in its place. model: why nothing is
    known of it without the prediction. doubt: the value's expanded uncertainty (k = 2). of_depth:
    its columns that follow from the measured wear depth.
    """

    key: str
    title: str
    sight: Sight
    value: Callable[[At], float]
    sentence: Sentence
    planned: bool = False
    count: str = ""
    window: str = ""
    model: str = ""
    doubt: Callable[[At], float] | None = None
    falls: bool = False
    of_depth: tuple[str, ...] = ()


def _in_a_row(what: str, unit: str, side: str = "above") -> Sentence:
    def sentence(value: float, level: float, number: int) -> str:
        if number > 1:
            return (
                f"{what} was at or {side} {level:g} {unit} in {number} revolutions in a row,"
                f" {value:.4g} {unit} in the last one."
            )
        return (
            f"{what} was at or {side} {level:g} {unit} in one revolution, {value:.4g} {unit} in"
            " the last one."
        )

    return sentence


def _share(at: At) -> float:
    """Return the deviation in percent of the predicted RMS; NaN where that is 0."""
    force = at("force_rms")
    return 100.0 * at("residual_rms") / force if force > 0.0 else float("nan")


_ELASTIC = "needs the model's elastic approach"
_COMPARED = "compares with the model"
_IDENTIFIED = "is identified beside the model"
_DEVIATION = "The RMS of measured less predicted |F|"

CRITERIA = {
    one.key: one
    for one in (
        Criterion(
            "elapsed_time_h",
            "elapsed time",
            Sight.CLOCK,
            lambda at: at("time") / 3600.0,
            lambda value, level, _: (
                f"The test has lasted {value:.4g} h; it was planned for {level:g} h."
            ),
            planned=True,
        ),
        Criterion(
            "running_time_h",
            "running time",
            Sight.CLOCK,
            lambda at: at("running_time"),
            lambda value, level, _: (
                f"The crank has turned for {value:.4g} h; {level:g} h were planned."
            ),
            planned=True,
        ),
        Criterion(
            "wear_depth_um",
            "wear depth",
            Sight.PREDICTION,
            lambda at: 1e3 * at("measured_wear_depth"),
            _in_a_row("The measured wear depth", "um"),
            planned=True,
            count="wear_depth_revolutions",
            model=_ELASTIC,
            doubt=lambda at: 1e3 * at("measured_wear_depth_uncertainty"),
            of_depth=("measured_wear_depth",),
        ),
        Criterion(
            "force_N",
            "force",
            Sight.ROW,
            lambda at: at("force_max"),
            _in_a_row("The maximum of |F|", "N"),
            count="force_revolutions",
        ),
        Criterion(
            "wear_rate_um_per_1000_revolutions",
            "wear rate",
            Sight.PREDICTION,
            lambda at: 1e3 * at("measured_wear_depth"),
            lambda value, level, window: (
                f"The wear rate over {window} revolutions was {value:.4g} um per 1000 revolutions;"
                f" the limit is {level:g}."
            ),
            window="wear_rate_window_revolutions",
            model=_ELASTIC,
            of_depth=("measured_wear_depth",),
        ),
        Criterion(
            "deviation_N",
            "deviation from the model",
            Sight.PREDICTION,
            lambda at: at("residual_rms"),
            _in_a_row(_DEVIATION, "N"),
            count="deviation_revolutions",
            model=_COMPARED,
        ),
        Criterion(
            "deviation_percent",
            "deviation from the model",
            Sight.PREDICTION,
            _share,
            _in_a_row(_DEVIATION, "% of the predicted RMS"),
            count="deviation_revolutions",
            model=_COMPARED,
        ),
        Criterion(
            "wear_coefficient_mm3_per_Nm",
            "wear coefficient",
            Sight.PREDICTION,
            lambda at: at("wear_coefficient_low"),
            _in_a_row("The lower 95 % limit of the wear coefficient", "mm^3/(N m)"),
            count="identified_revolutions",
            model=_IDENTIFIED,
            of_depth=("wear_coefficient_low",),
        ),
        Criterion(
            "remaining_revolutions",
            "remaining revolutions",
            Sight.PREDICTION,
            lambda at: at("remaining_revolutions_low"),
            _in_a_row("The lower 95 % limit of what remains", "revolutions", "below"),
            planned=True,
            count="identified_revolutions",
            model=_IDENTIFIED,
            falls=True,
            of_depth=("remaining_revolutions_low",),
        ),
        Criterion(
            "wear_consistency",
            "wear consistency",
            Sight.PREDICTION,
            lambda at: abs(at("wear_consistency")),
            _in_a_row("The wear's departure from what was expected", "standard deviations"),
            count="identified_revolutions",
            model=_IDENTIFIED,
            of_depth=("wear_consistency",),
        ),
    )
}
