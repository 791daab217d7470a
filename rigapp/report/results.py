"""Reduce test files to what they came to; a process of its own does it for the window.

``python -m rigapp.report.results [--closely]`` reads paths from standard input, one a line, and
writes a result of each to standard output as soon as it is known: four bytes of length
(little-endian), then MessagePack.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.process.priority import give_way
from rigapp.schema.details import error_text
from rigapp.schema.loglines import alarm_change, severity_of
from rigapp.schema.messages import NOT_STEADY, Severity
from rigapp.schema.results import TestResult
from rigapp.storage import TestReader, believed_until, largest_force, open_test

LINE_POINTS = 48
"""Of the small line in a list: two pixels each are as much as is seen."""

NICENESS = 5
"""Lists can wait; the engine and its model on the same computer cannot."""


def result_of(path: Path, *, closely: bool = False) -> TestResult:
    """Return what a test came to; a file that cannot be read says why.

    closely: state the uncertainty of the force, the alarms and why there is no wear coefficient,
    which takes several times as long as all else.
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
    """Return what an open test came to; raise UnusableInput where its file is damaged."""
    known = TestResult(str(test.path), modified, test.used_bytes(size))
    found = _measured(_described(known, test), test)
    if not found.revolutions:
        return found
    found = _compared(found, test)
    return _looked_at_closely(found, test) if closely else found


def _described(known: TestResult, test: TestReader) -> TestResult:
    summary, about = test.summary(), test.metadata()
    return msgspec.structs.replace(
        known,
        status=summary["status"],
        reason=summary["reason"],
        revolutions=summary["revolutions"],
        gaps=summary["gaps"],
        cycles_saved=summary["cycles_saved"],
        reason_code=about["reason_code"],
        planned=about["planned_revolutions"],
        **{name: about[name] for name in ("title", "specimen", "operator", "simulated")},
        **{name: about[name] for name in ("started", "ended")},
    )


def _measured(found: TestResult, test: TestReader) -> TestResult:
    flagged = int(np.count_nonzero(test.column("quality") & ~NOT_STEADY))
    largest = largest_force(test)
    if largest is None:
        return msgspec.structs.replace(found, flagged=flagged)
    return msgspec.structs.replace(
        found,
        flagged=flagged,
        force_max_N=largest.value_N,
        force_max_revolution=largest.revolution,
        force_max_angle_deg=largest.angle_deg,
        force_lower_bound=largest.lower_bound,
    )


def _compared(found: TestResult, test: TestReader) -> TestResult:
    columns = _predictions(test)
    depth, residual = columns["measured_wear_depth"], columns["residual_rms"]
    known_depth = np.where(np.isfinite(depth), columns["wear_depth"], np.nan)
    good = test.column("revolution")[test.column("quality") == 0]
    residual = residual[np.isfinite(residual) & np.isin(columns["revolution"], good)]
    until = believed_until(test)
    rows = slice(None) if until is None else columns["revolution"] <= until
    coefficients = (_last(columns[f"wear_coefficient{end}"][rows]) for end in ("", "_low", "_high"))
    middle, low, high = coefficients
    known = residual.size > 0
    return msgspec.structs.replace(
        found,
        depth_um=1e3 * _last(depth),
        model_depth_um=1e3 * _last(known_depth),
        depth_uncertainty_um=1e3 * _last(columns["measured_wear_depth_uncertainty"]),
        coefficient=middle,
        coefficient_low=low,
        coefficient_high=high,
        residual_rms_N=float(np.sqrt(np.mean(residual**2))) if known else np.nan,
        residual_worst_N=float(residual.max()) if known else np.nan,
        depths_um=_line(1e3 * depth),
    )


def _predictions(test: TestReader) -> dict[str, NDArray[Any]]:
    """Return the columns that are looked at; those that an older file lacks are unknown."""
    names = [
        "revolution",
        "residual_rms",
        "wear_depth",
        "measured_wear_depth",
        "measured_wear_depth_uncertainty",
    ]
    names += [f"wear_coefficient{end}" for end in ("", "_low", "_high")]
    stored = test.column_units("prediction")
    rows = test.committed("prediction")
    return {
        name: test.column(name, stream="prediction") if name in stored else np.full(rows, np.nan)
        for name in names
    }


def _last(values: NDArray[Any]) -> float:
    known = np.flatnonzero(np.isfinite(values))
    return float(values[known[-1]]) if known.size else float("nan")


def _line(values: NDArray[Any]) -> tuple[float, ...]:
    """Return the means of equal parts of a column, what is not known left out."""
    parts = np.array_split(values, min(LINE_POINTS, max(values.size, 1)))
    return tuple(float(part[known].mean()) for part in parts if (known := np.isfinite(part)).any())


def _looked_at_closely(found: TestResult, test: TestReader) -> TestResult:
    from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty

    stated = force_uncertainty(test.calibration(), test.configuration())
    doubt = float("nan")
    if stated is not None and np.isfinite(found.force_max_N):
        doubt = float(stated.at(found.force_max_N, of_magnitude=True))
    reason = "" if found.coefficient > 0.0 else _why_no_coefficient(test)
    return msgspec.structs.replace(
        found, force_uncertainty_N=doubt, alarms=_alarms(test), coefficient_reason=reason
    )


def _alarms(test: TestReader) -> tuple[str, ...]:
    """Return the titles of all alarms that were raised, critical ones first."""
    changes = [(one, alarm_change(one)) for one in test.events()]
    raised = [(one, it.title) for one, it in changes if it is not None and it.what == "raised"]
    raised.sort(key=lambda one: severity_of(one[0]) is not Severity.CRITICAL)
    return tuple(title for _, title in raised)


def _why_no_coefficient(test: TestReader) -> str:
    """Return why ``rigapp identify`` tells no coefficient of a test, as it says it."""
    from rigapp.twin.kept import NO_BIN, kept_of, life_of
    from rigapp_model.identification import CannotBeTold

    try:
        kept, _ = kept_of(test)
        kept.prior()
        kept.errors()
        life_of(kept)
    except CannotBeTold as error:
        return str(error)
    return "" if kept.bins.closed else NO_BIN


def main(arguments: list[str]) -> int:
    """Answer the paths of standard input; return the exit status."""
    give_way(NICENESS)
    encoder = msgspec.msgpack.Encoder()
    try:
        for line in sys.stdin.buffer.read().splitlines():
            path = Path(os.fsdecode(line))
            data = encoder.encode(result_of(path, closely="--closely" in arguments))
            sys.stdout.buffer.write(len(data).to_bytes(4, "little") + data)
            sys.stdout.buffer.flush()
    except BrokenPipeError:
        # Nobody listens any more: the flush at the end would fail again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
