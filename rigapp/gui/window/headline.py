"""Texts of the header: pure functions of the engine's status and the connection."""

from __future__ import annotations

import enum
import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import PurePath

from rigapp.presentation.numbers import grouped, true_minus
from rigapp.presentation.states import (
    calibration_text,
    is_resting,
    listed_alarms,
    rest_text,
    state_word,
)
from rigapp.presentation.times import dated, duration
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.messages import NO_TEST, HowEnded, RunState, Severity, Status
from rigapp.schema.states import ACTIVE
from rigapp.viewer.connection import ConnectionState
from rigapp.viewer.lines import newest_good
from rigapp.viewer.margins import DEPTH, Margin, nearest_margin, newest_force, overload_limit
from rigapp.viewer.news import News
from rigapp.viewer.quantities import LARGEST
from rigapp.viewer.shown import UNKNOWN_AGE, Age, Level, Renewed, age_of, aged, level_of


class StateShape(enum.StrEnum):
    """Shape beside the state, which is legible without colour."""

    CIRCLE = marked("circle")
    TRIANGLE = marked("triangle")
    BARS = marked("bars")
    SQUARE = marked("square")
    ARROWS = marked("arrows")
    DIAMOND = marked("diamond")
    BROKEN = marked("broken")


@dataclass(frozen=True, slots=True)
class TileText:
    """One tile: a large value, a line below it, and its level. short: a shorter line.

    old: the value is too old to be shown as current.
    """

    value: Text
    detail: Text = ""
    level: int = Level.NORMAL
    short: Text = ""
    old: bool = False


@dataclass(frozen=True, slots=True)
class Headline:
    """All contents of the header."""

    shape: StateShape
    state: TileText
    cycle: TileText
    progress: float
    force: TileText
    used: float
    wear: TileText
    agreement: TileText
    alarms: TileText


@dataclass(frozen=True, slots=True)
class NewestMeasured:
    """Values of the newest revolutions: NaN where not known.

    force_max_N: largest |F| of the newest revolution, or of the one in which the test tripped;
    force_sign: "≥ " where it exceeded the measuring range. overload_N: force at which the drive is
    switched off.
    wear_um, wear_uncertainty_um: measured wear depth with its expanded uncertainty (k = 2).
    nearest: of the limits of the largest |F|. answered, turned, predicted: age of the engine's
    status, of the newest revolution, and of its prediction.
    """

    force_max_N: float = math.nan
    force_sign: str = ""
    overload_N: float = math.nan
    wear_um: float = math.nan
    wear_uncertainty_um: float = math.nan
    nearest: Margin | None = None
    answered: Age = UNKNOWN_AGE
    turned: Age = UNKNOWN_AGE
    predicted: Age = UNKNOWN_AGE


_SHAPES: dict[RunState, StateShape] = {
    RunState.IDLE: StateShape.CIRCLE,
    RunState.READY: StateShape.CIRCLE,
    RunState.RUNNING: StateShape.TRIANGLE,
    RunState.PAUSED: StateShape.BARS,
    RunState.STOPPED: StateShape.SQUARE,
    RunState.FAULT: StateShape.DIAMOND,
    RunState.CALIBRATING: StateShape.BARS,
}
"""Shapes of states; those without one are transitions."""
_OUTCOME_SHAPES: dict[HowEnded, StateShape] = {
    HowEnded.COMPLETE: StateShape.CIRCLE,
    HowEnded.TRIPPED: StateShape.DIAMOND,
}
"""Shapes of ended tests by outcome; other outcomes have the shape of the state."""


def headline(
    status: Status | None,
    connection: ConnectionState,
    connection_reason: str,
    measured: NewestMeasured,
    now: Callable[[], float] = time.time,
    *,
    replay: bool = False,
) -> Headline:
    """Return the contents of the header for a status (None: no answer of the engine yet)."""
    unknown = TileText("–")
    if status is None:
        state = TileText("Attaching", translate(connection_reason))
        return Headline(
            StateShape.ARROWS, state, unknown, 0.0, unknown, 0.0, unknown, unknown, unknown
        )
    shape, state = _state(status, connection, connection_reason)
    test = status.test or NO_TEST
    if replay:
        state = TileText(tr("REPLAY"), f"{state.value}: {state.detail}", state.level)
    return Headline(
        shape=shape,
        state=state,
        cycle=aged(_cycle(status, now(), connection), measured.answered),
        progress=test.revolution / test.planned if test.planned > 0 else 0.0,
        force=aged(_force(status, measured, replay), measured.turned),
        used=_used(measured),
        wear=aged(_wear(status, measured), measured.predicted),
        agreement=aged(_agreement(status), measured.predicted),
        alarms=aged(_alarms(status), measured.answered),
    )


def _state(
    status: Status, connection: ConnectionState, connection_reason: str
) -> tuple[StateShape, TileText]:
    test = status.test or NO_TEST
    if connection is ConnectionState.LOST:
        return StateShape.BROKEN, TileText(
            "No engine", tr("{}; trying again", translate(connection_reason)), Level.CRITICAL
        )
    if connection is ConnectionState.SILENT:
        word = tr(status.engine.state.value)
        return StateShape.BROKEN, TileText(
            "Silent", tr("was {}; {}", word, translate(connection_reason)), Level.WARNING
        )
    shape = _SHAPES.get(status.engine.state, StateShape.ARROWS)
    if status.engine.state is RunState.STOPPED and test.outcome is not None:
        shape = _OUTCOME_SHAPES.get(test.outcome, shape)
    level = Level.CRITICAL if shape is StateShape.DIAMOND else Level.NORMAL
    detail = rest_text(status) if is_resting(status) else translate(status.engine.reason)
    if status.engine.state is RunState.CALIBRATING:
        detail = calibration_text(status)
    return shape, TileText(state_word(status), detail, level)


def _cycle(status: Status, now: float, connection: ConnectionState) -> TileText:
    test = status.test or NO_TEST
    if test.planned <= 0:
        return TileText("–", "no test")
    count = tr("{} of {}", grouped(test.revolution), grouped(test.planned))
    saved = tr("{} saved", grouped(test.committed))
    # The end of the test is not known while the engine does not answer.
    end, when = _end(status, now) if connection is ConnectionState.ATTACHED else ("", "")
    return TileText(count, f"{saved}, {end}" if end else saved, short=when)


def _end(status: Status, now: float) -> tuple[Text, Text]:
    """Return the expected end of the test as long and short text; unknown while paused."""
    test = status.test or NO_TEST
    if status.engine.state in (RunState.PAUSED, RunState.PAUSING) and not test.resting:
        return tr("the end waits"), "the end waits"
    if status.engine.state not in ACTIVE or test.expected_end_at <= 0.0:
        return "", ""
    left = max(0.0, test.expected_end_at - now)
    moment = time.localtime(test.expected_end_at)
    today = time.localtime(now)
    days = (moment.tm_year, moment.tm_yday) != (today.tm_year, today.tm_yday)
    when = dated("%a %H:%M" if days else "%H:%M", moment)
    return tr("ends {}, in {}", when, duration(left)), tr("ends {}", when)


def data_age(status: Status | None, data_age_s: float | None) -> TileText:
    """Return the age of the newest sample."""
    if status is None or data_age_s is None or not math.isfinite(data_age_s):
        return TileText("–", "no data yet")
    text = f"{data_age_s:.1f} s" if data_age_s < 100.0 else duration(data_age_s)
    return TileText(text, "", level_of(status.alarms, "data_age"))


def _force(status: Status, measured: NewestMeasured, replay: bool) -> TileText:
    known = math.isfinite(measured.force_max_N)
    value = f"{measured.force_sign}{measured.force_max_N:.1f} N" if known else "–"
    if known and math.isfinite(measured.overload_N):
        value = tr("{} of {}", value, f"{measured.overload_N:.0f} N")
    level = level_of(status.alarms, LARGEST)
    active = status.engine.state in ACTIVE
    if measured.nearest is not None and (active or replay):
        return TileText(value, measured.nearest.left, level, measured.nearest.short)
    if active:
        return TileText(value, "not evaluated yet", level, "not yet")
    return TileText(value, "no test running", level, "no test")


def _used(measured: NewestMeasured) -> float:
    """Return the force as a share of the overload limit, 0 .. 1; 0 where not known."""
    share = measured.force_max_N / measured.overload_N
    return min(1.0, share) if math.isfinite(share) else 0.0


def _wear(status: Status, measured: NewestMeasured) -> TileText:
    level = level_of(status.alarms, DEPTH)
    if not math.isfinite(measured.wear_um):
        if status.engine.state in ACTIVE:
            return TileText("–", "not measured yet", level, "not yet")
        return TileText("–", "no test running", level, "no test")
    value = true_minus(f"{measured.wear_um:.1f}")
    if math.isfinite(measured.wear_uncertainty_um):
        value += f" ± {measured.wear_uncertainty_um:.1f}"
    return TileText(f"{value} µm", "measured by the probes, k = 2", level, "probes, k = 2")


def _agreement(status: Status) -> TileText:
    test = status.test or NO_TEST
    if test.twin_revolution <= 0 or test.residual_rms_N is None:
        return TileText("–", "no prediction", short="none")
    behind = test.revolution - test.twin_revolution
    value = f"±{test.residual_rms_N:.1f} N"
    late = tr("RMS, {} cycles ago", grouped(behind))
    level = level_of(status.alarms, "residual_rms")
    return TileText(value, "RMS, this cycle" if behind <= 1 else late, level, "RMS")


def _alarms(status: Status) -> TileText:
    shown = listed_alarms(status.alarms)
    if not shown:
        return TileText("None")
    new = sum(1 for alarm in shown if not alarm.acknowledged)
    critical = any(alarm.severity is Severity.CRITICAL for alarm in shown)
    first = next((alarm for alarm in shown if alarm.first_out), shown[0])
    count = f"{len(shown)}" if not new else tr("{}, {} new", len(shown), new)
    if new == len(shown):
        count = tr("{} new", new)
    return TileText(count, translate(first.title), Level.CRITICAL if critical else Level.WARNING)


def measured(news: News) -> NewestMeasured:
    """Return the values of the newest revolutions of a test."""
    predictions = news.data.predictions
    good = newest_good(predictions, news.data.rows)
    depth, doubt = (1e3 * predictions.at(name, good) for name in (DEPTH, f"{DEPTH}_uncertainty"))
    force, sign = newest_force(news)
    return NewestMeasured(
        force,
        sign,
        overload_limit(news),
        depth,
        doubt,
        nearest_margin(news, LARGEST),
        age_of(news, Renewed.STATUS),
        age_of(news, Renewed.REVOLUTION),
        age_of(news, Renewed.PREDICTION),
    )


def rig_words(news: News) -> tuple[str, str]:
    """Return the rig's name, and its kind unless it is a real rig."""
    if news.status is None:
        return "", ""
    kind: Text = "REPLAY" if news.is_replay else "SIMULATED" if news.status.rig.simulated else ""
    return news.status.rig.name, tr(kind)


def identity(status: Status) -> tuple[str, str]:
    """Return a line with the running test, and one with rig, speed, operator and file."""
    test = status.test or NO_TEST
    parts = []
    if status.rig.simulated:
        speed = status.rig.simulated_speed
        known = math.isfinite(speed) and speed > 0
        parts.append(tr("simulated") + (f" × {speed:.3g}" if known else ""))
    if status.engine.state in ACTIVE and test.step:
        parts.append(tr("step {} of {}", test.step, test.steps))
    if status.engine.state in ACTIVE:
        parts.append(tr("{:.1f} rpm", test.target_rpm))
    if status.engine.operator:
        parts.append(status.engine.operator)
    if test.file:
        parts.append(PurePath(test.file).name)
    return translate(test.title) or tr("No test yet"), ", ".join(parts)
