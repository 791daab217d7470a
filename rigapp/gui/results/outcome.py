"""What a recorded test came to, in the words and numbers that lists and cards show."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from typing import Final

from rigapp.gui.data.knownwear import coefficient_words
from rigapp.presentation.numbers import capitalised, grouped
from rigapp.presentation.times import dated, duration
from rigapp.presentation.told import retold
from rigapp.presentation.translation import Text, tr
from rigapp.schema.results import HowEnded, TestResult

HEADLINES: Final[dict[HowEnded, Text]] = {
    HowEnded.COMPLETE: "Complete",
    HowEnded.OPERATOR: "Stopped by the operator",
    HowEnded.TRIPPED: "Tripped",
    HowEnded.INTERRUPTED: "Interrupted",
    HowEnded.RUNNING: "Running",
    HowEnded.NOT_READABLE: "Cannot be read",
}
UNKNOWN = "–"


@dataclass(frozen=True, slots=True)
class KeyNumber:
    """A number of a card: caption, value with unit, and one line below it."""

    caption: str
    value: str
    line: str


@dataclass(frozen=True, slots=True)
class TrustLine:
    """A reason to trust a result, or what to bear in mind."""

    good: bool
    text: str
    line: str


def key_numbers(result: TestResult) -> list[KeyNumber]:
    """Return what matters most of a result, always as many."""
    turn = tr(
        "cycle {} at {:.0f}°", grouped(result.force_max_revolution), result.force_max_angle_deg
    )
    known = math.isfinite(result.coefficient) and result.coefficient > 0.0
    value, limits = UNKNOWN, tr("not known yet: too little wear")
    if known:
        value, limits = coefficient_words(
            result.coefficient, result.coefficient_low, result.coefficient_high
        )
    worst = tr("RMS to the model; worst cycle {:.1f} N", result.residual_worst_N)
    return [
        KeyNumber(
            tr("Wear depth"),
            _with_doubt(result.depth_um, result.depth_uncertainty_um, "µm"),
            tr("by the probes, k = 2") if math.isfinite(result.depth_um) else tr("not measured"),
        ),
        KeyNumber(tr("Wear coefficient"), value, limits),
        KeyNumber(
            tr("Largest force"),
            f"≥ {_with_doubt(result.force_max_N, math.nan, 'N')}"
            if result.force_lower_bound
            else _with_doubt(result.force_max_N, result.force_uncertainty_N, "N"),
            turn if math.isfinite(result.force_max_N) else tr("no force was recorded"),
        ),
        KeyNumber(
            tr("Measured − model"),
            _with_doubt(math.nan, result.residual_rms_N, "N"),
            worst if math.isfinite(result.residual_rms_N) else tr("no prediction"),
        ),
    ]


def _with_doubt(value: float, doubt: float, unit: str) -> str:
    parts = [f"{value:.1f}"] if math.isfinite(value) else []
    if math.isfinite(doubt):
        parts.append(f"± {doubt:.1f}" if parts else f"±{doubt:.1f}")
    return f"{' '.join(parts)} {unit}" if parts else UNKNOWN


def trust_lines(result: TestResult) -> Iterator[TrustLine]:
    """Yield why a result can be trusted; nothing of a file that cannot be read."""
    if result.outcome is HowEnded.NOT_READABLE:
        return
    cycles = grouped(result.revolutions)
    whole = result.gaps == 0 and result.flagged == 0
    marked = tr("{} gaps, {} of {} cycles flagged", result.gaps, grouped(result.flagged), cycles)
    told = tr("Nothing lost") if whole else tr("Data are missing or doubtful")
    yield TrustLine(whole, told, marked)
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
    told = retold(result.reason)
    return capitalised(told)


def origin_of(result: TestResult) -> str:
    """Return specimen, cycles and times in one line."""
    cycles = tr("{} of {} cycles", grouped(result.revolutions), grouped(result.planned))
    began, ended = moment(result.started), moment(result.ended)
    took = ""
    if result.started and result.ended:
        took = duration((_when(result.ended) - _when(result.started)).total_seconds())
    span = tr("{} to {}, {}", began, ended, took) if took else began
    return "  ·  ".join(one for one in (result.title, result.specimen, cycles, span) if one)


def file_line(result: TestResult) -> str:
    """Return what the file is, in one line."""
    size, changed = megabytes(result.size_bytes), _said(datetime.fromtimestamp(result.modified))
    kept = grouped(result.cycles_saved)
    return tr("{}; {} cycles kept whole; changed {}", size, kept, changed)


def megabytes(size: int) -> str:
    """Return a size of a file."""
    return f"{size / 1e6:.3g} MB" if size >= 1e5 else f"{size / 1e3:.3g} kB"


def moment(text: str) -> str:
    """Return the date and time of an ISO text by the clock of this place; empty stays empty."""
    return _said(_when(text)) if text else ""


def day(text: str) -> str:
    """Return day and time of an ISO text; of another year the date."""
    if not text:
        return ""
    when = _when(text)
    same = when.year == datetime.now().year
    return _said(when, "%a %d %b %H:%M" if same else "%d %b %Y")


def _when(text: str) -> datetime:
    return datetime.fromisoformat(text).astimezone()


def _said(when: datetime, pattern: str = "%a %d %b %Y %H:%M") -> str:
    return dated(pattern, when.timetuple())
