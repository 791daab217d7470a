"""The certificate of a calibration record: PDF or HTML, the same bytes each time.

Everything comes from the record, nothing from the clock or the machine, so that anyone can make the
certificate again and compare it byte for byte.
"""

from __future__ import annotations

import time
from pathlib import Path

from calibration.records import Record, RecordError, in_future, unseal
from rigapp.calibrating.certificates.parts import Content, write_page
from rigapp.calibrating.subjects import subject_of
from rigapp.config.errors import UnusableInput
from rigapp.report.page.manuscript import Manuscript, Section, Table, Text


def write_certificate(record: Path, to: Path) -> None:
    """Write the certificate of a record as PDF or HTML; raise UnusableInput."""
    from rigapp.calibrating.verification import verified

    try:
        data = record.read_bytes()
        sealed = unseal(data)
        subject_of(sealed.kind)
    except FileNotFoundError as error:
        raise UnusableInput(f"{record}: there is no such record; check the name.") from error
    except (OSError, RecordError, UnusableInput) as error:
        raise UnusableInput(f"{record}: {error}.") from error
    against = (in_future(sealed, time.time()), *verified(data).differences)
    for one in filter(None, against):
        raise UnusableInput(f"{record}: there is no certificate of it: {one}")
    write_page(to, "certificate", lambda: certificate_of(sealed))


def certificate_of(record: Record) -> Manuscript:
    """Compose the certificate of a record."""
    content = record.content
    parts = subject_of(record.kind).certificate(content)
    return Manuscript(
        title=f"Certificate of calibration: {_item(content)}",
        footer=f"Certificate {record.number}",
        sections=(
            Section("", (*map(Text, parts.statements), _identity(record), *parts.tables)),
            Section(parts.heading, tuple(parts.figures)),
        ),
        closing=(
            f"Number {record.number} is the beginning of the SHA-256 digest of the record, readings"
            f" included. Made by {content['software']}."
        ),
    )


def _item(content: Content) -> str:
    """Return the name of what was calibrated: the one section of the settings that has a name."""
    sections = content["settings"].values()
    return next(str(one["name"]) for one in sections if isinstance(one, dict) and "name" in one)


def _joined(*texts: str) -> str:
    return ", ".join(filter(None, texts)) or "not stated"


def _identity(record: Record) -> Table:
    content = record.content
    paper = content["settings"]["paperwork"]
    taken = content.get("taken") or {}
    rows = [
        ("Number", record.number),
        ("Item", _item(content)),
        ("Serial number", _joined(paper["serial_number"])),
        ("Amplifier, cable", _joined(paper["amplifier"], paper["cable"])),
        ("Excitation, range, filter", _joined(paper["excitation"])),
        ("Laboratory, place", _joined(paper["laboratory"], paper["place"])),
        ("Calibrated and issued", content["calibrated_at"]),
        ("Due", content["due_at"]),
        ("Standards used", _joined(paper["standards"])),
        ("Operator", _joined(paper["operator"] or str(taken.get("operator") or ""))),
        ("Reviewer", _joined(paper["reviewer"])),
    ]
    if taken.get("rig"):
        simulated = ", SIMULATED: for practice" if taken.get("simulated") else ""
        rows.append(("Taken on the rig", f"{taken['rig']}{simulated}"))
    if paper["notes"]:
        rows.append(("Deviations, remarks", paper["notes"]))
    return Table("Identification", tuple(rows))
