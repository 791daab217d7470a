"""`rigapp calibrate`: fit recorded readings, judge them, keep an immutable record."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from calibration.load_cell.calibrate import calibrate_load_cell
from calibration.load_cell.readings import parse_load_cell
from calibration.taking.readings import ReadingsError
from rigapp.calibrating.daily_history import history_lines, history_result, read_history
from rigapp.calibrating.load_cell_result import cell_lines, load_cell_result
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.config.calibration_settings import (
    read_load_cell_settings,
)
from rigapp.config.errors import UnusableInput
from rigapp.config.reading import read_text


def calibrate_cell(readings: Path, settings: Path, to: Path, *, as_json: bool) -> int:
    """Fit load-cell readings; keep a record when they are good; return the exit status."""
    given, meaning = read_load_cell_settings(settings)
    text = read_text(readings)
    try:
        taken = parse_load_cell(text)
    except ReadingsError as error:
        raise UnusableInput(f"{readings}: {error}.") from error
    refuse_existing(to)
    found = calibrate_load_cell(taken, meaning)
    result = load_cell_result(found, meaning)
    if found.accepted:
        keep_record(to, "load cell", text, given, result)
    say_result(result, to, as_json=as_json, lines=cell_lines(found, meaning))
    return 0 if found.accepted else 1


def say_result(result: Mapping[str, Any], to: Path, *, as_json: bool, lines: Sequence[str]) -> None:
    """Print a result and its problems; the numbers of one that is refused are kept back."""
    if as_json:
        print(json.dumps(result))
    elif result["accepted"]:
        for line in lines:
            print(line)
    for problem in result["problems"]:
        if not as_json:
            mark = "" if problem["blocks"] else "note: "
            print(f"rigapp: {mark}{problem['sentence']}", file=sys.stderr)
    if not result["accepted"]:
        print("rigapp: the calibration is refused, nothing was saved.", file=sys.stderr)
    elif not as_json:
        print(f"The record is {to}.")


def certify(record: Path, to: Path) -> int:
    """Write the certificate of a record as PDF or HTML; return the exit status."""
    from rigapp.calibrating.certificates.certificate import write_certificate

    write_certificate(record, to)
    print(f"The certificate is {to}.")
    return 0


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
