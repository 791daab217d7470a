"""Table of the criteria that end a test before its last revolution, see ``[stop]``.

A new criterion is one row here and its key in ``config.recipe.StopSection``. They are evaluated by
``engine.judging.criteria``; recipe, form, check, alarms and report read the words here.
"""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass

from rigapp.texts import say

At = Callable[[str], float]
"""Returns the value of a column, by name."""

Sentence = Callable[[float, float, int], str]
"""Describes how a criterion was met: value, level, and the number of revolutions of its row or
window."""


class Sight(enum.Enum):
    """Source of the value: the clocks, every evaluated revolution, or the twin's answer."""

    CLOCK = enum.auto()
    ROW = enum.auto()
    PREDICTION = enum.auto()


@dataclass(frozen=True, slots=True)
class Criterion:
    """Ends a test when its value, in the unit of its key, is at or above the key's level.

    falls: it is met at or below the level instead.
    value: of the columns that ``sight`` gives; a clock has ``time`` (s) and ``running_time`` (h).
    planned: a planned end (complete), else a limit (stopped). count: key of the
    number of successive revolutions that must reach the level. window: key of the revolutions over
    which the slope of the value, per 1000 revolutions, is evaluated instead. model: why it is
    unknown without the prediction. doubt: the value's expanded uncertainty (k = 2). of_depth:
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


def _in_a_row(what: str, unit: str, side: str = say("above")) -> Sentence:
    def sentence(value: float, level: float, number: int) -> str:
        if number > 1:
            return say(
                "{} was at or {} {:g} {} in {} revolutions in a row, {:.4g} {} in the last one.",
                what,
                side,
                level,
                unit,
                number,
                value,
                unit,
            )
        return say(
            "{} was at or {} {:g} {} in one revolution, {:.4g} {} in the last one.",
            what,
            side,
            level,
            unit,
            value,
            unit,
        )

    return sentence


def _share(at: At) -> float:
    """Return the deviation in percent of the predicted RMS; NaN where that is 0."""
    force = at("force_rms")
    return 100.0 * at("residual_rms") / force if force > 0.0 else float("nan")


_ELASTIC = say("needs the model's elastic approach")
_COMPARED = say("compares with the model")
_IDENTIFIED = say("is identified by the twin")
_DEVIATION = say("The RMS of measured less predicted |F|")

CRITERIA = {
    criterion.key: criterion
    for criterion in (
        Criterion(
            "elapsed_time_h",
            say("elapsed time"),
            Sight.CLOCK,
            lambda at: at("time") / 3600.0,
            lambda value, level, _: say(
                "The test has lasted {:.4g} h; it was planned for {:g} h.", value, level
            ),
            planned=True,
        ),
        Criterion(
            "running_time_h",
            say("running time"),
            Sight.CLOCK,
            lambda at: at("running_time"),
            lambda value, level, _: say(
                "The crank has turned for {:.4g} h; {:g} h were planned.", value, level
            ),
            planned=True,
        ),
        Criterion(
            "wear_depth_um",
            say("wear depth"),
            Sight.PREDICTION,
            lambda at: 1e3 * at("measured_wear_depth"),
            _in_a_row(say("The measured wear depth"), "um"),
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
            _in_a_row(say("The maximum of |F|"), "N"),
            count="force_revolutions",
        ),
        Criterion(
            "wear_rate_um_per_1000_revolutions",
            say("wear rate"),
            Sight.PREDICTION,
            lambda at: 1e3 * at("measured_wear_depth"),
            lambda value, level, window: say(
                "The wear rate over {} revolutions was {:.4g} um per 1000 revolutions;"
                " the limit is {:g}.",
                window,
                value,
                level,
            ),
            window="wear_rate_window_revolutions",
            model=_ELASTIC,
            of_depth=("measured_wear_depth",),
        ),
        Criterion(
            "deviation_N",
            say("deviation from the model"),
            Sight.PREDICTION,
            lambda at: at("residual_rms"),
            _in_a_row(_DEVIATION, "N"),
            count="deviation_revolutions",
            model=_COMPARED,
        ),
        Criterion(
            "deviation_percent",
            say("deviation from the model"),
            Sight.PREDICTION,
            _share,
            _in_a_row(_DEVIATION, say("% of the predicted RMS")),
            count="deviation_revolutions",
            model=_COMPARED,
        ),
        Criterion(
            "wear_coefficient_mm3_per_Nm",
            say("wear coefficient"),
            Sight.PREDICTION,
            lambda at: at("wear_coefficient_low"),
            _in_a_row(say("The lower 95 % limit of the wear coefficient"), "mm^3/(N m)"),
            count="identified_revolutions",
            model=_IDENTIFIED,
            of_depth=("wear_coefficient_low",),
        ),
        Criterion(
            "remaining_revolutions",
            say("remaining revolutions"),
            Sight.PREDICTION,
            lambda at: at("remaining_revolutions_low"),
            _in_a_row(say("The lower 95 % limit of what remains"), "revolutions", say("below")),
            planned=True,
            count="identified_revolutions",
            model=_IDENTIFIED,
            falls=True,
            of_depth=("remaining_revolutions_low",),
        ),
        Criterion(
            "wear_consistency",
            say("wear consistency"),
            Sight.PREDICTION,
            lambda at: abs(at("wear_consistency")),
            _in_a_row(say("Deviation of the wear from the forecast"), say("standard deviations")),
            count="identified_revolutions",
            model=_IDENTIFIED,
            of_depth=("wear_consistency",),
        ),
    )
}
