"""Texts of the result of a recorded test: headline figures and their reliability."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime

from rigapp.presentation.numbers import (
    UNKNOWN,
    bytes_text,
    coefficient_text,
    grouped,
    with_uncertainty,
)
from rigapp.presentation.states import OUTCOMES
from rigapp.presentation.times import dated, duration
from rigapp.presentation.translation import tr, translate
from rigapp.schema.messages import HowEnded
from rigapp.schema.results import TestResult
from rigapp.texts import capitalised

ALARMS_NAMED = 3
"""Titles of alarms in one line; the log has all of them."""


@dataclass(frozen=True, slots=True)
class KeyNumber:
    """A figure of a result: caption, value with unit, and its basis or why it is missing."""

    caption: str
    value: str
    line: str


@dataclass(frozen=True, slots=True)
class TrustLine:
    """A reason to trust a result, or a caution."""

    good: bool
    text: str
    line: str


def outcome_text(result: TestResult) -> str:
    """Return how a test ended, in a word or two."""
    return tr(OUTCOMES[result.outcome])


def key_numbers(result: TestResult) -> list[KeyNumber]:
    """Return the fixed set of headline figures of a result."""
    return [_depth(result), _coefficient(result), _force(result), _residual(result)]


def _depth(result: TestResult) -> KeyNumber:
    measured = math.isfinite(result.depth_um)
    line = tr("by the probes, k = 2") if measured else tr("not measured")
    if math.isfinite(result.model_depth_um):
        line += "; " + tr("model {}", f"{result.model_depth_um:.1f} µm")
    value = with_uncertainty(result.depth_um, result.depth_uncertainty_um, "µm")
    return KeyNumber(tr("Wear depth"), value, line)


def _coefficient(result: TestResult) -> KeyNumber:
    value, line = UNKNOWN, translate(result.coefficient_reason) or tr("not known")
    if result.coefficient > 0.0:
        value, line = coefficient_text(
            result.coefficient, result.coefficient_low, result.coefficient_high
        )
    return KeyNumber(tr("Wear coefficient"), value, capitalised(line) if value == UNKNOWN else line)


def _force(result: TestResult) -> KeyNumber:
    line = tr("no force was recorded")
    if math.isfinite(result.force_max_N):
        number = grouped(result.force_max_revolution)
        line = tr("cycle {} at {:.0f}°", number, result.force_max_angle_deg)
    value = with_uncertainty(result.force_max_N, result.force_uncertainty_N, "N")
    if result.force_lower_bound:  # beyond the measuring range its uncertainty is unknown
        value = f"≥ {with_uncertainty(result.force_max_N, math.nan, 'N')}"
    return KeyNumber(tr("Largest force"), value, line)


def _residual(result: TestResult) -> KeyNumber:
    line = tr("no prediction")
    if math.isfinite(result.residual_rms_N):
        line = tr("RMS to the model; worst cycle {:.1f} N", result.residual_worst_N)
    value = with_uncertainty(result.residual_rms_N, math.nan, "N")
    return KeyNumber(tr("Measured − model"), value, line)


def trust_lines(result: TestResult) -> Iterator[TrustLine]:
    """Yield cautions about a result, then reasons to trust it; none for an unreadable file."""
    if result.outcome is not HowEnded.NOT_READABLE:
        yield from sorted(_remarks(result), key=lambda line: line.good)


def _remarks(result: TestResult) -> Iterator[TrustLine]:
    if result.alarms:
        titles = list(dict.fromkeys(map(translate, result.alarms)))
        more = ", …" if len(titles) > ALARMS_NAMED else ""
        count = len(result.alarms)
        text = tr("1 alarm in the test") if count == 1 else tr("{} alarms in the test", count)
        yield TrustLine(False, text, ", ".join(titles[:ALARMS_NAMED]) + more)
    if abs(result.depth_um - result.model_depth_um) > result.depth_uncertainty_um:
        depth = with_uncertainty(result.depth_um, result.depth_uncertainty_um, "µm")
        model = f"{result.model_depth_um:.1f} µm"
        yield TrustLine(False, tr("Wear differs from the model"), tr("{}, model {}", depth, model))
    cycles = grouped(result.revolutions)
    lossless = result.gaps == 0 and result.flagged == 0
    marked = tr("{} gaps, {} of {} cycles flagged", result.gaps, grouped(result.flagged), cycles)
    lost = tr("No data lost") if lossless else tr("Data are missing or doubtful")
    yield TrustLine(lossless, lost, marked)
    if result.outcome is HowEnded.INTERRUPTED:
        safe = tr("{} cycles are safe; it can be resumed", cycles)
        yield TrustLine(False, tr("Not closed"), safe)
    elif result.outcome is not HowEnded.RUNNING:
        yield TrustLine(True, tr("Closed"), tr("all {} cycles are in the file", cycles))
    if math.isfinite(result.force_uncertainty_N):
        by = tr("from the calibration in the file")
        yield TrustLine(True, tr("Force with its uncertainty"), by)
    if result.simulated:
        yield TrustLine(False, tr("Simulated"), tr("these are no measurements"))


def reason_of(result: TestResult) -> str:
    """Return why a test ended, as a sentence."""
    return capitalised(translate(result.reason))


def origin_of(result: TestResult) -> str:
    """Return specimen, cycles and times in one line."""
    cycles = tr("{} of {} cycles", grouped(result.revolutions), grouped(result.planned))
    began, ended = moment(result.started), moment(result.ended)
    took = ""
    if result.started and result.ended:
        took = duration((_when(result.ended) - _when(result.started)).total_seconds())
    span = tr("{} to {}, {}", began, ended, took) if took else began
    return "  ·  ".join(part for part in (result.title, result.specimen, cycles, span) if part)


def file_line(result: TestResult) -> str:
    """Return size and date of the file in one line, empty for a missing one."""
    if not result.modified:
        return ""
    size, changed = bytes_text(result.size_bytes), _dated(datetime.fromtimestamp(result.modified))
    kept = grouped(result.cycles_saved)
    return tr("{}; {} complete cycles stored; changed {}", size, kept, changed)


def moment(text: str) -> str:
    """Return the date and time of an ISO text by the clock of this place; empty stays empty."""
    return _dated(_when(text)) if text else ""


def day(text: str) -> str:
    """Return day and time of an ISO text; of another year the date."""
    if not text:
        return ""
    when = _when(text)
    same = when.year == datetime.now().year
    return _dated(when, "%a %d %b %H:%M" if same else "%d %b %Y")


def _when(text: str) -> datetime:
    return datetime.fromisoformat(text).astimezone()


def _dated(when: datetime, pattern: str = "%a %d %b %Y %H:%M") -> str:
    return dated(pattern, when.timetuple())
