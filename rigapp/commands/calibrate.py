"""`rigapp calibrate` from tables of readings, and what is printed of every calibration."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from rigapp.calibrating.daily_history import history_lines, history_result, read_history
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.calibrating.session import Outcome
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document
from rigapp.config.reading import read_text
from rigapp_calibration.taking.readings import ReadingsError

ONE_SOURCE = "give --readings (a CSV) or --rig (live readings), one of the two."


def calibrate_table(
    name: str, readings: Path | None, settings: Path, to: Path, *, which: str = "", as_json: bool
) -> int:
    """Fit a table of readings; keep a record when they are good; return the exit status.

    name: of the subject; which: of several things of it (see the subject's ``fit``).
    """
    subject = SUBJECTS[name]
    if readings is None or subject.fit is None:
        raise UnusableInput(ONE_SOURCE)
    given = read_document(settings, subject.settings).record
    text = read_text(readings)
    refuse_existing(to)
    try:
        outcome = subject.fit(text, given, str(settings), which)
    except ReadingsError as error:
        raise UnusableInput(f"{readings}: {error}.") from error
    if outcome.accepted:
        keep_record(to, outcome.kind, text, given, outcome.result)
    return say_outcome(outcome, to, as_json=as_json)


def say_outcome(outcome: Outcome, to: Path, *, as_json: bool) -> int:
    """Print an outcome and its problems; return the exit status.

    The numbers of a calibration that is refused are kept back; what a check showed is told.
    """
    if as_json:
        print(json.dumps(outcome.result))
    elif outcome.accepted or outcome.told_always:
        print("".join(f"{line}\n" for line in outcome.lines), end="")
    for problem in () if as_json else outcome.result["problems"]:
        mark = "" if problem["blocks"] else "note: "
        print(f"rigapp: {mark}{problem['sentence']}", file=sys.stderr)
    if not outcome.accepted:
        print("rigapp: the calibration is refused, nothing was saved.", file=sys.stderr)
    elif not as_json:
        print(f"The record is {to}.")
    return 0 if outcome.accepted else 1


def show_history(store: Path, to: Path | None, rig: str | None, *, as_json: bool) -> int:
    """Print the history and draw its charts; status 1 when a rule asks for action."""
    found = read_history(store, rig)
    if as_json:
        print(json.dumps(history_result(found)))
    else:
        print("\n".join(history_lines(found)))
    if to is not None:
        from rigapp.calibrating.daily_chart import write_chart

        write_chart(found, to)
        if not as_json:
            print(f"The chart is {to}.")
    return 0 if found.in_control else 1
