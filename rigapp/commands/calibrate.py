"""`rigapp calibrate` from tables, printed results of all calibrations, and work on records."""

from __future__ import annotations

import datetime
import json
import os
import sys
import time
from pathlib import Path

from rigapp.calibrating.daily_history import history_lines, history_result, read_history
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.calibrating.session import Outcome
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.calibrating.verification import verified
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document
from rigapp.config.reading import read_bytes, read_text
from rigapp.config.writing import whole_file
from rigapp.process.private import open_to_others
from rigapp.schema.details import error_text
from rigapp_calibration.load_cell.as_found import trend
from rigapp_calibration.records import (
    MALFORMED,
    Record,
    RecordChanged,
    RecordError,
    checked_record,
    in_future,
    seal,
)
from rigapp_calibration.signatures import UnusableKey, fingerprint, new_key, public_key_of, sign
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
    """Fit a table of readings; save a record when they are accepted; return the exit status.

    name: of the subject; which: a variant of it (see the subject's ``fit``). former: the previous
    record, for comparison.
    """
    subject = SUBJECTS[name]
    if readings is None or subject.fit is None:
        raise UnusableInput(ONE_SOURCE)
    parsed = read_document(settings, subject.settings).record
    text = read_text(readings)
    refuse_existing(to)
    try:
        outcome = subject.fit(text, parsed, str(settings), which)
    except ReadingsError as error:
        raise UnusableInput(f"{readings}: {error}.") from error
    if former is not None:
        outcome = outcome.against(read_record(former))
    if outcome.accepted:
        as_found = outcome.as_found[0]
        keep_record(to, outcome.kind, text, parsed, outcome.result, as_found=as_found)
    return say_outcome(outcome, to, as_json=as_json)


def say_outcome(outcome: Outcome, to: Path, *, as_json: bool) -> int:
    """Print an outcome and its problems; return the exit status.

    The numbers of a refused calibration are not printed, those of a check always.
    """
    if as_json:
        as_found = outcome.as_found[0]
        print(json.dumps({**outcome.result, **({"as_found": as_found} if as_found else {})}))
    elif outcome.accepted or outcome.always_shown:
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
    from rigapp.calibrating.certificate import write_worksheet
    from rigapp.config.calibration_settings import LoadCellFile

    refuse_existing(to, "worksheets")
    count = write_worksheet(plan, weights, read_document(settings, LoadCellFile).record, to)
    print(f"The worksheet is {to}, with {count} readings.")
    return 0


def read_record(path: Path) -> Record:
    """Return a record; raises UnusableInput for other files."""
    try:
        return checked_record(read_bytes(path))
    except OSError as error:
        raise UnusableInput(f"{path}: the record cannot be read ({error.strerror}).") from error
    except RecordError as error:
        raise UnusableInput(f"{path}: {error}.") from error


def show_trend(folder: Path, to: Path | None, *, as_json: bool) -> int:
    """Print and draw the records of a folder, oldest first, each compared with the previous."""
    if not folder.is_dir():
        raise UnusableInput(f"{folder}: there is no such folder; check the name.")
    series: dict[tuple[str, str], list[Record]] = {}
    for path in sorted(folder.rglob("*.json")):
        try:
            record = checked_record(path.read_bytes())
            series.setdefault((record.kind, item_of(record)), []).append(record)
        except (OSError, *MALFORMED):
            continue  # journals, results, changed records (reported by verify)
    try:
        trends = [(kind, item, trend(records)) for (kind, item), records in series.items()]
    except RecordError as error:
        raise UnusableInput(f"{folder}: {error}.") from error
    if not trends:
        raise UnusableInput(f"{folder}: no calibration record lies in it.")
    if to is not None:
        from rigapp.calibrating.daily_history import write_trend

        write_trend(trends, to)
    if as_json:
        tree = [
            {
                "kind": kind,
                "item": item,
                "records": [
                    {
                        "number": record.number,
                        "calibrated_at": record.content["calibrated_at"],
                        "changes": [change.tree for change in changes],
                    }
                    for record, changes in records
                ],
            }
            for kind, item, records in trends
        ]
        print(json.dumps(tree))
    else:
        for kind, item, records in trends:
            print(f"{kind} {item}".rstrip())
            for sealed, changes in records:
                words = "; ".join(change.words for change in changes)
                shown = f"the one before told too much: {words}" if words else "nothing to compare"
                print(f"  {str(sealed.content['calibrated_at'])[:10]}  {sealed.number}  {shown}")
    beyond = any(c.beyond for _, _, records in trends for c in records[-1][1])
    return 1 if beyond else 0


def item_of(record: Record) -> str:
    """Return the item of a record from its settings: name and serial number."""
    settings = record.content["settings"]
    cell, paper = settings.get("cell", {}), settings.get("paperwork", {})
    named = cell.get("name") or settings.get("probe", {}).get("name", "")
    serial = cell.get("serial_number") or paper.get("serial_number", "")
    return f"{named} {serial}".strip()


def show_history(store: Path, to: Path | None, rig: str | None, *, as_json: bool) -> int:
    """Print the history and draw its charts; return 1 when a rule requires action."""
    result = read_history(store, rig)
    if as_json:
        print(json.dumps(history_result(result)))
    else:
        print("\n".join(history_lines(result)))
    if to is not None:
        from rigapp.calibrating.daily_history import write_chart

        write_chart(result, to)
        if not as_json:
            print(f"The chart is {to}.")
    return 0 if result.in_control else 1


UNSIGNED = "It is not signed: nothing shows which laboratory made it."


def certify(record: Path, to: Path, issued: str = "") -> int:
    """Write the certificate of a record as PDF or HTML; return the exit status.

    issued: date of issue, such as 2027-04-30; by default that of the record.
    """
    from rigapp.calibrating.certificate import write_certificate

    try:
        day = datetime.date.fromisoformat(issued) if issued else None
    except ValueError as error:
        raise UnusableInput(f"--issued {issued}: write a date such as 2027-04-30.") from error
    mark = write_certificate(record, to, day)
    print(f"The certificate is {to}.")
    if mark:
        print(f"note: each page is marked {mark} ([paperwork] of the settings).", file=sys.stderr)
    return 0


def verify_record(path: Path, public_key: Path | None = None, *, as_json: bool) -> int:
    """Fit the readings of a record again and print the differences; return the exit status.

    public_key: of the laboratory whose signature is required.
    """
    try:
        data, record = _read(path)
    except RecordChanged as error:
        print(f"rigapp: {path}: {error}.", file=sys.stderr)
        return 1
    verification = verified(data)
    against = [*verification.differences]
    if ahead := in_future(record, time.time()):
        against.append(f"It {ahead}.")
    signer = "" if record.signature is None else fingerprint(record.signature.public_key)
    if public_key is not None:
        against += _signature_faults(record, public_key)
    if as_json:
        tree = {
            "number": record.number,
            "kind": record.kind,
            "verified": not against,
            "compared": verification.compared,
            "differences": against,
            "unverified": verification.unverified,
            "signed_by": signer or None,
        }
        print(json.dumps(tree))
        return 1 if against else 0
    print(f"Record {record.number} of a {record.kind}: its digest holds.")
    if verification.compared:
        agree = "differ" if verification.differences else "agree"
        print(
            f"Its readings were fitted again; {verification.compared} results were compared"
            f" and {agree}."
        )
    if signer:
        hint = "" if public_key else "; give --public-key to see whether it is the laboratory's"
        print(f"It is signed by the key {signer}{hint}.")
    for note in (*verification.unverified, *(() if signer else (UNSIGNED,))):
        print(f"note: {note}")
    for difference in against:
        print(f"rigapp: {path}: {difference}", file=sys.stderr)
    return 1 if against else 0


def make_key(to: Path) -> int:
    """Write a private key readable by its owner only, and the public key beside it."""
    public = to.with_suffix(".pub")
    if public == to:
        raise UnusableInput(f"{to}: the public key gets the ending .pub; name another file.")
    for path in (to, public):
        refuse_existing(path, "keys")
    secret, open_to_all = new_key()
    _write(to, secret, 0o600)
    _write(public, open_to_all, 0o644)
    print(f"The private key is {to}: keep it to the laboratory, and keep a copy where it is safe.")
    print(f"The public key is {public}, for everybody; {fingerprint(public_key_of(open_to_all))}.")
    return 0


def sign_record(path: Path, key: Path, to: Path) -> int:
    """Write a record again with the signature of a laboratory's key; return the exit status."""
    try:
        data, record = _read(path)
    except RecordChanged as error:
        raise UnusableInput(f"{path}: {error}.") from error
    if record.signature is not None:
        raise UnusableInput(f"{path}: it is signed already.")
    refuse_existing(to)
    for difference in verified(data).differences:
        print(f"rigapp: {path}: it is not signed: {difference}", file=sys.stderr)
        return 1
    secret = _secret(key)
    try:
        signature = sign(record, secret)
    except UnusableKey as error:
        raise UnusableInput(f"{key}: {error}.") from error
    _write(to, seal(record.content, signature), 0o444)
    print(f"The record {record.number} with its signature is {to}; {path} stays as it was.")
    return 0


def _read(path: Path) -> tuple[bytes, Record]:
    """Return a record and its bytes; raises RecordChanged, or UnusableInput for other files."""
    try:
        data = path.read_bytes()
        return data, checked_record(data)
    except FileNotFoundError as error:
        raise UnusableInput(f"{path}: there is no such record; check the name.") from error
    except RecordChanged:
        raise
    except (OSError, RecordError) as error:
        why = error_text(error, "the record cannot be read")
        raise UnusableInput(f"{path}: {why}.") from error


def _signature_faults(record: Record, public_key: Path) -> list[str]:
    """Return why a record is not signed by a key, empty when it is."""
    try:
        wanted = public_key_of(read_bytes(public_key))
    except OSError as error:
        raise UnusableInput(f"{public_key}: cannot be read ({error.strerror}).") from error
    except UnusableKey as error:
        raise UnusableInput(f"{public_key}: {error}.") from error
    if record.signature is None:
        return [UNSIGNED]
    if record.signature.public_key == wanted:
        return []
    return [f"It is signed by another key than {public_key} ({fingerprint(wanted)})."]


def _secret(key: Path) -> bytes:
    """Return a private key; raises UnusableInput where other users can read it."""
    try:
        others = open_to_others(key.stat())
        secret = key.read_bytes()
    except OSError as error:
        raise UnusableInput(f"{key}: cannot be read ({error.strerror}).") from error
    if others:
        raise UnusableInput(
            f"{key}: others can read or write this key; make it yours alone: chmod 600 {key}"
        )
    return secret


def _write(to: Path, data: bytes, mode: int) -> None:
    """Write a new file with its permissions set before the first byte."""
    with whole_file(to, new=True, mode=mode) as part:
        opened = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(opened, "wb") as stream:
            stream.write(data)
