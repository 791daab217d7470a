"""The documents of a calibration: the certificate of its record, and the worksheet before it.

PDF or HTML, the same bytes each time. The certificate's contents follow ISO/IEC 17025:2017, 7.8.
Everything in it comes from the record, nothing from the clock or the machine, so that anyone can
make the certificate again and compare it byte for byte.
"""

from __future__ import annotations

import csv
import datetime
import io
import math
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from rigapp.calibrating.certificates.formatting import (
    UNSTATED,
    Content,
    Parts,
    taken_words,
    write_page,
)
from rigapp.calibrating.load_cell_session import PLANS, load_cell_plan
from rigapp.calibrating.subjects import subject_of
from rigapp.config.calibration_settings import LoadCellFile
from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.report.page.document import Block, Manuscript, Row, Section, Table, Text
from rigapp_calibration.load_cell.readings import HUNG_COLUMN, LOAD_CELL_COLUMNS
from rigapp_calibration.records import (
    MALFORMED,
    Record,
    RecordError,
    check_shape,
    in_future,
    unseal,
)
from rigapp_calibration.taking.procedure import Step, StepKind

NEEDED = {"laboratory": "the laboratory", "serial_number": "the serial number"}
"""Keys of [paperwork] without which there is only a draft (ISO/IEC 17025, 7.8.2.1 b and g)."""

SURROUNDINGS = (
    ("Temperature", "temperature", "degC", "°C"),
    ("Humidity", "humidity", "percent", "%"),
    ("Pressure", "pressure", "hPa", "hPa"),
)
"""Ambient conditions of the calibration: words, and the parts of the keys of the settings."""
EXPANDED = (
    "U is the expanded uncertainty: the standard uncertainty u times the coverage factor k, so that"
    " the value lies within U with a probability of about 95 % (JCGM 100 and 101). Type A:"
    " evaluated from the readings; type B: from elsewhere."
)


def write_certificate(record: Path, to: Path, issued: datetime.date | None = None) -> str:
    """Write the certificate of a record as PDF or HTML; return its mark, empty for a whole one.

    issued: date of issue, by default that of the record. The record is verified first. Raises
    UnusableInput.
    """
    from rigapp.calibrating.verification import verified

    try:
        data = record.read_bytes()
        sealed = unseal(data)
        subject_of(sealed.kind)
        check_shape(sealed)
    except FileNotFoundError as error:
        raise UnusableInput("{}: there is no such record; check the name.", record) from error
    except (OSError, RecordError, UnusableInput) as error:
        raise UnusableInput("{}: the record cannot be used ‹{}›.", record, error) from error
    verification = verified(data)
    for objection in filter(None, (in_future(sealed, time.time()), *verification.differences)):
        raise UnusableInput("{}: there is no certificate of it: {}", record, objection)
    _check_issue(sealed, issued)
    try:
        write_page(
            to, "certificate", lambda: certificate_of(sealed, verification.unverified, issued)
        )
        return mark_of(sealed)
    except MALFORMED as error:
        raise UnusableInput(
            "{}: a value of the record is missing or cannot be printed ‹{}›.", record, repr(error)
        ) from error


def certificate_of(
    record: Record, unverified: Sequence[str] = (), issued: datetime.date | None = None
) -> Manuscript:
    """Compose the certificate of a record. unverified: its parts that could not be verified."""
    content = record.content
    parts = subject_of(record.kind).certificate(content)
    sections = [
        Section("", (_identity(record, issued), *_notes(record, unverified))),
        Section("Method and conditions", tuple(_method(content, parts))),
        Section("Results", tuple(parts.tables)),
        Section("Uncertainty of measurement", (Text(EXPANDED), *parts.uncertainty)),
        Section(parts.heading, tuple(parts.figures)),
        Section("Readings", tuple(parts.readings)),
    ]
    return Manuscript(
        title=f"Certificate of calibration: {_item(content)}",
        footer=f"Certificate {record.number}",
        sections=tuple(section for section in sections if section.blocks),
        closing=(
            "The results are those of the item named above, as it was when it was calibrated. The"
            " certificate may be passed on as a whole only, unless the laboratory agrees otherwise."
            f" Number {record.number} is the beginning of the SHA-256 digest of the record,"
            f" readings included. Made by {content['software']}."
            f" End of certificate {record.number}."
        ),
        mark=mark_of(record),
    )


def mark_of(record: Record) -> str:
    """Return the mark of every page: a draft, or training; empty for neither."""
    paper = record.content["settings"]["paperwork"]
    marks = []
    if (record.content.get("taken") or {}).get("simulated"):
        marks.append("PRACTICE on a simulated rig")
    missing = [words for key, words in NEEDED.items() if not paper.get(key)]
    if missing:
        marks.append(f"DRAFT, {' and '.join(missing)} not stated")
    return "; ".join(marks)


def _check_issue(record: Record, issued: datetime.date | None) -> None:
    """Refuse a date of issue before the calibration or in the future."""
    if issued is None:
        return
    if issued.isoformat() < str(record.content["calibrated_at"])[:10]:
        raise UnusableInput(
            "--issued {}: the calibration is of {}.", issued, record.content["calibrated_at"][:10]
        )
    if issued > datetime.datetime.now(tz=datetime.UTC).date() + datetime.timedelta(days=1):
        raise UnusableInput("--issued {}: this is in the future.", issued)


def _item(content: Content) -> str:
    """Return the name of the calibrated item: one section of the settings has it."""
    sections = content["settings"].values()
    named = (
        str(section["name"])
        for section in sections
        if isinstance(section, dict) and "name" in section
    )
    return next(named, str(content["kind"]))


def _joined(*texts: str) -> str:
    return ", ".join(filter(None, texts)) or "not stated"


def _identity(record: Record, issued: datetime.date | None) -> Table:
    content = record.content
    missing = {"address": "", "customer": "", "condition_as_received": ""}  # in old records
    paper = {**missing, **content["settings"]["paperwork"]}
    taken = content.get("taken") or {}
    day = issued.isoformat() if issued else content.get("recorded_at", content["calibrated_at"])
    rows = [
        ("Number", record.number),
        ("Laboratory", _joined(paper["laboratory"], paper["address"])),
        ("Place of calibration", _joined(paper["place"])),
        ("Customer", _joined(paper["customer"])),
        ("Item", f"{_item(content)} ({record.kind})"),
        ("Serial number", _joined(paper["serial_number"])),
        ("Condition as received", _joined(paper["condition_as_received"])),
        ("Amplifier, cable", _joined(paper["amplifier"], paper["cable"])),
        ("Excitation, range, filter", _joined(paper["excitation"])),
        ("Date of calibration", content["calibrated_at"][:10]),
        ("Date of issue", day[:10]),
        # No interval was agreed (ISO/IEC 17025, 7.8.4.3): the program uses it no longer.
        ("Used by the program until", content["due_at"][:10]),
        ("As found", _as_found(content.get("as_found"))),
        ("Operator", _joined(paper["operator"] or str(taken.get("operator") or ""))),
        ("Reviewer", _joined(paper["reviewer"])),
        ("Signature of the record", _signer(record)),
    ]
    if words := taken_words(content):
        rows.append(("Readings", words))
    return Table("Identification", tuple(rows))


def _as_found(comparison: Content | None) -> str:
    """Return the as-found result of the record in use until then."""
    if not comparison:
        return "not compared with a calibration before"
    changes = "; ".join(
        f"{change['what']} {change['value']:+.2g} {change['unit']}"
        f" ({change['allowed']:.2g} {change['unit']}"
        f" allowed{', MORE than allowed' * change['beyond']})"
        for change in comparison["changes"]
    )
    day = str(comparison["calibrated_at"])[:10]
    return f"record {comparison['record']} of {day} told too much: {changes}"


def _signer(record: Record) -> str:
    if record.signature is None:
        return "not signed: nothing but the names above says who made it"
    from rigapp_calibration.signatures import fingerprint

    return f"Ed25519, key {fingerprint(record.signature.public_key)}"


def _notes(record: Record, unverified: Sequence[str]) -> Iterator[Text]:
    """Yield the notes of a record, and the objections against it."""
    content = record.content
    if mark := mark_of(record):
        yield Text(f"{mark}.", strong=True)
    for remark in (*unverified, *_untraced(content)):
        yield Text(remark, strong=True)
    for problem in content["result"].get("problems", ()):
        yield Text(f"Note: {problem['sentence']}", strong=True)
    if remarks := content["settings"]["paperwork"]["notes"]:
        yield Text(f"Deviations, remarks: {remarks}")
    for event in (content.get("taken") or {}).get("events", ()):
        if event["event"] == "note":
            yield Text(f"Noted while it was taken: {event['text']}")


def _untraced(content: Content) -> Iterator[str]:
    """Yield the gaps in the chain of calibrations: no standard named, or one that had expired."""
    day, settings = str(content["calibrated_at"])[:10], content["settings"]
    pieces = settings.get("weights", {}).get("piece", ())
    known = [*pieces, *settings.get("standard", ())]
    if not known and not settings["paperwork"]["standards"]:
        yield (
            "No standard is named with its certificate: that the results are traceable is not"
            " shown."
        )
    for standard in known:
        if standard.get("due") and standard["due"] < day:
            yield (
                f"The certificate {standard['certificate']} of {standard['name']} had expired on"
                f" {standard['due']}, before the calibration."
            )


def _method(content: Content, parts: Parts) -> Iterator[Block]:
    yield from map(Text, parts.statements)
    if parts.calibrated:
        yield Text(f"Calibrated range: {parts.calibrated}", strong=True)
    yield Table("Conditions", (*_surroundings(content["settings"]), *parts.conditions))
    yield _standards(content["settings"])


def _surroundings(settings: Content) -> Iterator[Row]:
    """Yield the air at the beginning and, where it is stated, at the end."""
    place = settings.get("place", {})
    for words, name, unit, shown in SURROUNDINGS:
        begin, end = (place.get(f"{name}{when}_{unit}") for when in ("", "_at_end"))
        stated = UNSTATED if begin is None else f"{begin:g} {shown}"
        if end is not None:
            stated = f"{stated} at the beginning, {end:g} {shown} at the end"
        yield (words, stated)


def _standards(settings: Content) -> Table:
    """Return the standards, each with its certificate, due date and uncertainty."""
    rows: list[Row] = [
        (
            f"{standard['name']}, {standard['mass_kg']:g} kg",
            standard["certificate"],
            standard["due"],
            f"U = {standard['expanded_uncertainty_g']:g} g (k = 2)",
        )
        for standard in settings.get("weights", {}).get("piece", ())
    ]
    rows += [
        (
            standard["name"],
            standard["certificate"],
            standard["due"] or "not stated",
            _joined(standard["uncertainty"]),
        )
        for standard in settings.get("standard", ())
    ]
    named = settings["paperwork"]["standards"]
    if named or not rows:
        rows.append((_joined(named), "not stated", "not stated", "not stated"))
    header = ("standard", "certificate", "due", "uncertainty")
    return Table("Standards used, by which the results are traceable", tuple(rows), header)


TYPED_IN = (
    "Write the encoder's angle and both signals of each line that has a series. Type them into the"
    " worksheet that ends in .csv and evaluate it with rigapp calibrate load-cell --readings."
)
LEVEL_FIRST = (
    "The angle reference goes into the settings: [angle] offset_deg is the angle that the encoder"
    " shows with the crank level, with the other sign."
)


def write_worksheet(plan: str, weights: str, file: LoadCellFile, to: Path) -> int:
    """Write the worksheet of a plan as PDF, HTML or CSV; return the number of readings.

    weights: the pieces, as ``parse_pieces`` takes them. Raises UnusableInput.
    """
    if plan == "daily":
        kinds = ", ".join(name for name in PLANS if name != plan)
        raise UnusableInput("--plan daily: a daily check makes no record; choose {}.", kinds)
    steps = load_cell_plan({"plan": plan, "weights": weights}, file).steps()
    if to.suffix.lower() == ".csv":
        with whole_file(to, new=True) as part:
            part.write_text(_table(steps, file), encoding="utf-8", newline="")
    else:
        write_page(to, "worksheet", lambda: _page(steps, plan, file))
    return sum(step.kind is StepKind.READING for step in steps)


def _table(steps: tuple[Step, ...], file: LoadCellFile) -> str:
    """Return a table of readings whose angles and signals are empty, instructions as comments."""
    stream = io.StringIO()
    for words in (f"{file.cell.name}. {TYPED_IN}", LEVEL_FIRST):
        stream.write(f"# {words}\n")
    lines = csv.writer(stream, lineterminator="\n")
    lines.writerow((*LOAD_CELL_COLUMNS, HUNG_COLUMN))
    for step in steps:
        stream.write(f"# {step.words}\n")
        if step.kind is StepKind.READING:
            hung = f"{step.due:g}" if step.due else ""
            lines.writerow((step.series, step.number, f"{step.value:g}", "", "", "", hung))
    return stream.getvalue()


def _page(steps: tuple[Step, ...], plan: str, file: LoadCellFile) -> Manuscript:
    paper = file.paperwork
    facts: tuple[Row, ...] = (
        ("Item", file.cell.name),
        ("Serial number", file.cell.serial_number or paper.serial_number),
        ("Amplifier, cable", ", ".join(filter(None, (paper.amplifier, paper.cable)))),
        ("Date, operator", ""),
        ("Temperature, humidity, pressure at the begin", ""),
        ("Temperature, humidity, pressure at the end", ""),
    )
    unit = file.cell.signal_unit
    header = (
        "Series, step", "What to do", "Wait, s", "Angle, degrees",
        f"Signal 1, {unit}", f"Signal 2, {unit}",
    )  # fmt: skip
    return Manuscript(
        title=f"Worksheet of a calibration: {file.cell.name}, {plan} plan",
        footer=f"{file.cell.name}, {plan} plan",
        sections=(
            Section("", (Table("Identification", facts), Text(TYPED_IN), Text(LEVEL_FIRST))),
            Section("Readings", (Table("In this order", tuple(_rows(steps)), header),)),
        ),
    )


def _rows(steps: tuple[Step, ...]) -> Iterator[Row]:
    for step in steps:
        name = f"{step.series}, {step.number}" if step.kind is StepKind.READING else ""
        planned = ""
        if step.kind is StepKind.SET_UP and step.set_up is not None:
            planned = f"about {math.degrees(step.set_up) % 360.0:.0f}"
        wait = f"{step.wait:g}" if step.wait else ""
        yield name, step.words, wait, planned, "", ""
