"""The certificate of a calibration record: PDF or HTML, the same bytes each time.

Its contents follow ISO/IEC 17025:2017, 7.8. Everything comes from the record, nothing from the
clock or the machine, so that anyone can make the certificate again and compare it byte for byte.
"""

from __future__ import annotations

import datetime
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
from rigapp.calibrating.subjects import subject_of
from rigapp.config.errors import UnusableInput
from rigapp.report.page.document import Block, Manuscript, Row, Section, Table, Text
from rigapp_calibration.records import (
    MALFORMED,
    Record,
    RecordError,
    check_shape,
    in_future,
    unseal,
)

NEEDED = {"laboratory": "the laboratory", "serial_number": "the serial number"}
"""Keys of [paperwork] without which there is only a draft (ISO/IEC 17025, 7.8.2.1 b and g)."""

SURROUNDINGS = (
    ("Temperature", "temperature", "degC", "°C"),
    ("Humidity", "humidity", "percent", "%"),
    ("Pressure", "pressure", "hPa", "hPa"),
)
"""What was around at the calibration: words, and the parts of the keys of the settings."""
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
    found = verified(data)
    for one in filter(None, (in_future(sealed, time.time()), *found.differences)):
        raise UnusableInput("{}: there is no certificate of it: {}", record, one)
    _check_issue(sealed, issued)
    try:
        write_page(to, "certificate", lambda: certificate_of(sealed, found.unverified, issued))
        return mark_of(sealed)
    except MALFORMED as error:
        raise UnusableInput(
            "{}: a value of the record is missing or cannot be printed ‹{}›.", record, repr(error)
        ) from error


def certificate_of(
    record: Record, unverified: Sequence[str] = (), issued: datetime.date | None = None
) -> Manuscript:
    """Compose the certificate of a record. unverified: what of it could not be verified."""
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
        sections=tuple(one for one in sections if one.blocks),
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
    """Return what every page must say: that it is a draft, or practice; empty for neither."""
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
    """Return the name of what was calibrated: the one section of the settings that has a name."""
    sections = content["settings"].values()
    named = (str(one["name"]) for one in sections if isinstance(one, dict) and "name" in one)
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
        # Nobody agreed on an interval (ISO/IEC 17025, 7.8.4.3): the program uses it no longer.
        ("Used by the program until", content["due_at"][:10]),
        ("As found", _as_found(content.get("as_found"))),
        ("Operator", _joined(paper["operator"] or str(taken.get("operator") or ""))),
        ("Reviewer", _joined(paper["reviewer"])),
        ("Signature of the record", _signer(record)),
    ]
    if words := taken_words(content):
        rows.append(("Readings", words))
    return Table("Identification", tuple(rows))


def _as_found(found: Content | None) -> str:
    """Return what the calibration found of the record in use until then."""
    if not found:
        return "not compared with a calibration before"
    changes = "; ".join(
        f"{one['what']} {one['value']:+.2g} {one['unit']} ({one['allowed']:.2g} {one['unit']}"
        f" allowed{', MORE than allowed' * one['beyond']})"
        for one in found["changes"]
    )
    day = str(found["calibrated_at"])[:10]
    return f"record {found['record']} of {day} told too much: {changes}"


def _signer(record: Record) -> str:
    if record.signature is None:
        return "not signed: nothing but the names above says who made it"
    from rigapp_calibration.signatures import fingerprint

    return f"Ed25519, key {fingerprint(record.signature.public_key)}"


def _notes(record: Record, unverified: Sequence[str]) -> Iterator[Text]:
    """Yield all that must not be overlooked: the record's own notes, and what stands against it."""
    content = record.content
    if mark := mark_of(record):
        yield Text(f"{mark}.", strong=True)
    for one in (*unverified, *_untraced(content)):
        yield Text(one, strong=True)
    for problem in content["result"].get("problems", ()):
        yield Text(f"Note: {problem['sentence']}", strong=True)
    if remarks := content["settings"]["paperwork"]["notes"]:
        yield Text(f"Deviations, remarks: {remarks}")
    for event in (content.get("taken") or {}).get("events", ()):
        if event["event"] == "note":
            yield Text(f"Noted while it was taken: {event['text']}")


def _untraced(content: Content) -> Iterator[str]:
    """Yield what the chain of calibrations lacks: no standard named, or one that had expired."""
    day, settings = str(content["calibrated_at"])[:10], content["settings"]
    pieces = settings.get("weights", {}).get("piece", ())
    known = [*pieces, *settings.get("standard", ())]
    if not known and not settings["paperwork"]["standards"]:
        yield (
            "No standard is named with its certificate: that the results are traceable is not"
            " shown."
        )
    for one in known:
        if one.get("due") and one["due"] < day:
            yield (
                f"The certificate {one['certificate']} of {one['name']} had expired on"
                f" {one['due']}, before the calibration."
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
        told = UNSTATED if begin is None else f"{begin:g} {shown}"
        if end is not None:
            told = f"{told} at the beginning, {end:g} {shown} at the end"
        yield (words, told)


def _standards(settings: Content) -> Table:
    """Return what was measured with: each with its certificate, due date and uncertainty."""
    rows: list[Row] = [
        (
            f"{one['name']}, {one['mass_kg']:g} kg",
            one["certificate"],
            one["due"],
            f"U = {one['expanded_uncertainty_g']:g} g (k = 2)",
        )
        for one in settings.get("weights", {}).get("piece", ())
    ]
    rows += [
        (one["name"], one["certificate"], one["due"] or "not stated", _joined(one["uncertainty"]))
        for one in settings.get("standard", ())
    ]
    named = settings["paperwork"]["standards"]
    if named or not rows:
        rows.append((_joined(named), "not stated", "not stated", "not stated"))
    header = ("standard", "certificate", "due", "uncertainty")
    return Table("Standards used, by which the results are traceable", tuple(rows), header)
