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
from rigapp.config.reading import read_bytes, read_text
from rigapp_calibration.load_cell.as_found import trend
from rigapp_calibration.records import MALFORMED, Record, RecordError, check_shape, unseal
from rigapp_calibration.taking.readings import ReadingsError

ONE_SOURCE = "give --readings (a CSV) or --rig (live readings), one of the two."


def calibrate_table(
    name: str,
    readings: Path | None,
    settings: Path,
    to: Path,
    *,
    which: str = "",
    former: Path | None = None,
    as_json: bool,
) -> int:
    """Fit a table of readings; keep a record when they are good; return the exit status.

    name: of the subject; which: of several things of it (see the subject's ``fit``). former: the
    record in use until now, which they are compared with.
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
    if former is not None:
        outcome = outcome.against(read_record(former))
    if outcome.accepted:
        found = outcome.as_found[0]
        keep_record(to, outcome.kind, text, given, outcome.result, as_found=found)
    return say_outcome(outcome, to, as_json=as_json)


def say_outcome(outcome: Outcome, to: Path, *, as_json: bool) -> int:
    """Print an outcome and its problems; return the exit status.

    The numbers of a calibration that is refused are kept back; what a check showed is told.
    """
    if as_json:
        found = outcome.as_found[0]
        print(json.dumps({**outcome.result, **({"as_found": found} if found else {})}))
    elif outcome.accepted or outcome.told_always:
        print("".join(f"{line}\n" for line in (*outcome.lines, *outcome.as_found[1])), end="")
    for problem in () if as_json else outcome.result["problems"]:
        mark = "" if problem["blocks"] else "note: "
        print(f"rigapp: {mark}{problem['sentence']}", file=sys.stderr)
    if not outcome.accepted:
        print("rigapp: the calibration is refused, nothing was saved.", file=sys.stderr)
    elif not as_json:
        print(f"The record is {to}.")
    return 0 if outcome.accepted else 1


def make_worksheet(settings: Path, to: Path, plan: str, weights: str) -> int:
    """Write the worksheet of a load-cell calibration; return the exit status."""
    from rigapp.calibrating.worksheet import write_worksheet
    from rigapp.config.calibration_settings import LoadCellFile

    refuse_existing(to, "worksheets")
    count = write_worksheet(plan, weights, read_document(settings, LoadCellFile).record, to)
    print(f"The worksheet is {to}, with {count} readings.")
    return 0


def read_record(path: Path) -> Record:
    """Return a record; raise UnusableInput for what is none."""
    try:
        record = unseal(read_bytes(path))
        check_shape(record)
        return record
    except OSError as error:
        raise UnusableInput(f"{path}: the record cannot be read ({error.strerror}).") from error
    except RecordError as error:
        raise UnusableInput(f"{path}: {error}.") from error


def show_trend(folder: Path, to: Path | None, *, as_json: bool) -> int:
    """Print the records of a folder, oldest first, each against the one before; draw them."""
    if not folder.is_dir():
        raise UnusableInput(f"{folder}: there is no such folder; check the name.")
    series: dict[tuple[str, str], list[Record]] = {}
    for path in sorted(folder.rglob("*.json")):
        try:
            record = unseal(path.read_bytes())
            check_shape(record)
            series.setdefault((record.kind, item_of(record)), []).append(record)
        except (OSError, *MALFORMED):
            continue  # journals, results, records that were changed: verify names these
    try:
        found = [(kind, item, trend(records)) for (kind, item), records in series.items()]
    except RecordError as error:
        raise UnusableInput(f"{folder}: {error}.") from error
    if not found:
        raise UnusableInput(f"{folder}: no calibration record lies in it.")
    if to is not None:
        from rigapp.calibrating.certificates.trend import write_trend

        write_trend(found, to)
    if as_json:
        told = [
            {
                "kind": kind,
                "item": item,
                "records": [
                    {
                        "number": one.number,
                        "calibrated_at": one.content["calibrated_at"],
                        "changes": [change.tree for change in changes],
                    }
                    for one, changes in records
                ],
            }
            for kind, item, records in found
        ]
        print(json.dumps(told))
    else:
        for kind, item, records in found:
            print(f"{kind} {item}".rstrip())
            for one, changes in records:
                words = "; ".join(change.words for change in changes)
                shown = f"the one before told too much: {words}" if words else "nothing to compare"
                print(f"  {str(one.content['calibrated_at'])[:10]}  {one.number}  {shown}")
    beyond = any(c.beyond for _, _, records in found for c in records[-1][1])
    return 1 if beyond else 0


def item_of(record: Record) -> str:
    """Return what a record is of, as its settings name it: name and serial number."""
    settings = record.content["settings"]
    cell, paper = settings.get("cell", {}), settings.get("paperwork", {})
    named = cell.get("name") or settings.get("probe", {}).get("name", "")
    serial = cell.get("serial_number") or paper.get("serial_number", "")
    return f"{named} {serial}".strip()


def show_history(store: Path, to: Path | None, rig: str | None, *, as_json: bool) -> int:
    """Print the history and draw its charts; status 1 when a rule asks for action."""
    found = read_history(store, rig)
    if as_json:
        print(json.dumps(history_result(found)))
    else:
        print("\n".join(history_lines(found)))
    if to is not None:
        from rigapp.calibrating.daily_history import write_chart

        write_chart(found, to)
        if not as_json:
            print(f"The chart is {to}.")
    return 0 if found.in_control else 1
