"""Reduce test files to their results; in a separate process for the window.

``python -m rigapp.report.results [--closely]`` reads paths from standard input, one per line, and
writes the result of each to standard output as soon as it is available: four bytes of length
(little-endian), then MessagePack.
"""

from __future__ import annotations

import os
import sys
from itertools import pairwise
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.sequence import Sequence
from rigapp.process.children import write_frame
from rigapp.process.priority import lower_priority
from rigapp.schema.details import error_text
from rigapp.schema.loglines import alarm_change, severity_of
from rigapp.schema.messages import NOT_STEADY, Event, Severity
from rigapp.schema.results import TestResult
from rigapp.schema.wire import encode
from rigapp.storage import (
    TestReader,
    blocks,
    largest_force,
    logged_sentence,
    newest_known,
    open_test,
    plausible_until,
    rows_up_to,
)
from rigapp.texts import capitalised, say, sentence_of_error

LINE_POINTS = 48
"""Number of points of the sparkline in a list, about two pixels each."""

NICENESS = 5
"""Priority below that of the engine and its model on the same computer."""


def result_of(path: Path, *, closely: bool = False) -> TestResult:
    """Return the result of a test; for an unreadable file the reason.

    closely: add the uncertainty of the force, the alarms and the reason for a missing wear
    coefficient, which takes several times as long as the rest.
    """
    modified, size = 0.0, 0
    try:
        about = path.stat()
        modified, size = about.st_mtime, about.st_size
        with open_test(path) as test:
            return result_of_open(test, modified, size, closely=closely)
    except (UnusableInput, OSError) as error:
        return TestResult(
            str(path), modified, size, reason=error_text(error, "The file cannot be read.")
        )


def result_of_open(
    test: TestReader, modified: float, size: int, *, closely: bool = False
) -> TestResult:
    """Return the result of an open test; raises UnusableInput for a damaged file."""
    known = TestResult(str(test.path), modified, test.used_bytes(size))
    result = _measured(_described(known, test), test)
    if not result.revolutions:
        return result
    result = _compared(result, test)
    return _with_details(result, test) if closely else result


def _described(known: TestResult, test: TestReader) -> TestResult:
    summary, about = test.summary(), test.metadata()
    return msgspec.structs.replace(
        known,
        status=summary["status"],
        reason=logged_sentence(
            _recorded_reason(summary["reason"], about["planned_revolutions"], about["operator"]),
            test.events(),
        ),
        revolutions=summary["revolutions"],
        gaps=summary["gaps"],
        cycles_saved=summary["cycles_saved"],
        reason_code=about["reason_code"],
        planned=about["planned_revolutions"],
        **{name: about[name] for name in ("title", "specimen", "operator", "simulated")},
        **{name: about[name] for name in ("started", "ended")},
    )


def _recorded_reason(reason: str, planned: int, operator: str) -> str:
    """Return the reason of a test's end as a translatable sentence where it is a usual one.

    A file has only the English text; texts of the operator stay unchanged.
    """
    done = say("The planned {} revolutions are made and recorded.", planned)
    name = capitalised(operator) or say("The operator")
    for ended in (done, say("{} stopped the test", name), say("{} switched the drive off", name)):
        if reason.startswith(ended):
            return ended + reason[len(ended) :]
    return reason


def _measured(result: TestResult, test: TestReader) -> TestResult:
    flagged = sum(
        int(np.count_nonzero(block["quality"].astype(np.int64) & ~NOT_STEADY))
        for _, block in blocks(test, ["quality"])
    )
    largest = largest_force(test)
    if largest is None:
        return msgspec.structs.replace(result, flagged=flagged)
    return msgspec.structs.replace(
        result,
        flagged=flagged,
        force_max_N=largest.value_N,
        force_max_revolution=largest.revolution,
        force_max_angle_deg=largest.angle_deg,
        force_lower_bound=largest.lower_bound,
    )


def _compared(result: TestResult, test: TestReader) -> TestResult:
    until = plausible_until(test)
    plausible = None if until is None else rows_up_to(test, until, "prediction")
    middle, low, high = (
        _newest(test, f"wear_coefficient{end}", stop=plausible) for end in ("", "_low", "_high")
    )
    depth, both = "measured_wear_depth", ("measured_wear_depth", "wear_depth")
    residual_rms, worst = _residual(test)
    good = _unflagged(test)
    return msgspec.structs.replace(
        result,
        depth_um=1e3 * _newest(test, depth, stop=good),
        model_depth_um=1e3 * _newest(test, *both, stop=good),
        depth_uncertainty_um=1e3 * _newest(test, f"{depth}_uncertainty", stop=good),
        coefficient=middle,
        coefficient_low=low,
        coefficient_high=high,
        residual_rms_N=residual_rms,
        residual_worst_N=worst,
        depths_um=_line(test, depth),
    )


def _unflagged(test: TestReader) -> int | None:
    """Return the number of predictions up to the last revolution without quality flags.

    None: up to the end. The failure of a sensor in the last revolution is not wear.
    """
    for _, block in blocks(test, ("revolution", "quality"), backwards=True):
        good = block["quality"].astype(np.int64) & ~NOT_STEADY == 0
        if good.any():
            return rows_up_to(test, int(block["revolution"][good][-1]), "prediction")
    return None


def _residual(test: TestReader) -> tuple[float, float]:
    """Return RMS and maximum of model minus measurement in steady revolutions, NaN if unknown."""
    count, total, worst = 0, 0.0, -np.inf
    for _, block in blocks(test, ("revolution", "residual_rms"), "prediction"):
        number, residual = block["revolution"], block["residual_rms"]
        first, stop = (rows_up_to(test, revolution) for revolution in (number[0] - 1, number[-1]))
        same, quality = (test.column(name, first, stop) for name in ("revolution", "quality"))
        known = residual[np.isfinite(residual) & np.isin(number, same[quality == 0])]
        count += known.size
        total += float(known @ known)
        worst = float(known.max(initial=worst))
    return (float(np.sqrt(total / count)), worst) if count else (np.nan, np.nan)


def _newest(test: TestReader, *names: str, stop: int | None = None) -> float:
    """Return the newest value of the last column where all columns are finite."""
    result = newest_known(test, names, 1, stop)[names[-1]]
    return float(result[-1]) if result.size else float("nan")


def _line(test: TestReader, name: str) -> tuple[float, ...]:
    """Return the means (um) of equal parts of a prediction, without unknown values."""
    rows, means = test.committed("prediction"), []
    parts = min(LINE_POINTS, max(rows, 1))
    bounds = np.linspace(0, rows, parts + 1).astype(int).tolist()
    for start, stop in pairwise(bounds):
        count, total = 0, 0.0
        for _, block in blocks(test, [name], "prediction", start=start, stop=stop):
            known = block[name][np.isfinite(block[name])]
            count, total = count + known.size, total + float(known.sum())
        if count:
            means.append(1e3 * total / count)
    return tuple(means)


def _with_details(result: TestResult, test: TestReader) -> TestResult:
    from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty

    stated = force_uncertainty(test.calibration(), test.configuration())
    uncertainty_N = float("nan")
    if stated is not None and np.isfinite(result.force_max_N):
        uncertainty_N = float(stated.at(result.force_max_N, of_magnitude=True))
    reason, events = "" if result.coefficient > 0.0 else _why_no_coefficient(test), test.events()
    return msgspec.structs.replace(
        result,
        force_uncertainty_N=uncertainty_N,
        alarms=_alarms(events),
        coefficient_reason=reason,
    )


def _alarms(events: list[Event]) -> tuple[str, ...]:
    """Return the titles of all raised alarms, critical ones first."""
    changes = [(event, alarm_change(event)) for event in events]
    raised = [(event, c.title) for event, c in changes if c is not None and c.what == "raised"]
    raised.sort(key=lambda alarm: severity_of(alarm[0]) is not Severity.CRITICAL)
    return tuple(title for _, title in raised)


def _why_no_coefficient(test: TestReader) -> str:
    """Return the reason of ``rigapp identify`` for a missing wear coefficient."""
    from rigapp.twin.kept import NO_BIN, kept_of, life_of
    from rigapp_model.identification import NotIdentifiable

    try:
        kept, _ = kept_of(test)
        kept.prior()
        kept.errors()
        life_of(kept)
    except NotIdentifiable as error:
        return sentence_of_error(error)
    return "" if kept.bins.closed else NO_BIN


def sequence_of(reader: TestReader) -> Sequence | None:
    """Return the steps of a file's test; None without steps or for an unreadable test."""
    try:
        test = parse_test(str(reader.configuration()["test"]), "test", recorded=True)
        return Sequence(test.run) if test.run.step else None
    except (UnusableInput, KeyError, ZeroDivisionError):
        return None


def step_numbers(sequence: Sequence, revolutions: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the number of the step of each revolution, both of shape (n,)."""
    ends, loop = np.array(sequence.ends), sequence.loop
    rounds = np.maximum(0, -(-(revolutions - ends[-1]) // loop))
    indices = np.searchsorted(ends, revolutions - rounds * loop)
    return np.asarray(indices + 1, np.int64)


def main(arguments: list[str]) -> int:
    """Process the paths from standard input; return the exit status."""
    lower_priority(NICENESS)
    try:
        for line in sys.stdin.buffer.read().splitlines():
            path = Path(os.fsdecode(line))
            data = encode(result_of(path, closely="--closely" in arguments))
            write_frame(sys.stdout.buffer, data)
    except BrokenPipeError:
        # The pipe is closed: the flush at the exit would fail again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
