"""The report of a test: everything that its file says, in one document.

Nothing comes from the clock or the machine, so that the same file gives the same bytes. Sections
about data are in ``datasections``, those about what happened in ``logsections``.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig
from rigapp.config.report import ReportFile
from rigapp.presentation.numbers import grouped
from rigapp.presentation.results import key_numbers, outcome_text
from rigapp.presentation.times import duration
from rigapp.report.page.manuscript import Manuscript, Section, Table
from rigapp.report.results import result_of_open
from rigapp.report.testreport import datasections, logsections, setupsections
from rigapp.report.testreport.cover import cover_of, numbered, report_settings
from rigapp.report.testreport.facts import Rows, rows_of, stated_uncertainties
from rigapp.report.testreport.model_facts import agreement_of, bursts_of, cycles_of
from rigapp.report.testreport.setupsections import step_section
from rigapp.report.testreport.wording import (
    REASONS,
    STATUSES,
    UNKNOWN,
    counted,
    number,
    quantity,
    size,
    stamp,
)
from rigapp.report.testreport.worn import worn_of
from rigapp.schema.details import sentence_of
from rigapp.schema.results import TestResult
from rigapp.storage import (
    NEWEST_BYTES,
    LargestForce,
    TestReader,
    found_damage,
    largest_force,
    open_test,
    trip_capture,
)
from rigapp.texts import capitalised
from rigapp_calibration.load_cell.force_uncertainty import ForceUncertainty, force_uncertainty

LEADS = {
    "running": "The test was still running when this report was made.",
    "stopped": "The test was stopped before the planned end.",
    "interrupted": "The test was interrupted.",
}


@dataclass(frozen=True, slots=True)
class FileIdentity:
    """The file itself. digest: SHA-256 in hexadecimal, empty for a file that still changes."""

    name: str
    octets: int
    digest: str


def report_of(path: Path, settings: Path | None = None) -> Manuscript:
    """Compose the report of a test file. settings: a report.toml, else the one that is found.

    A file that is replaced meanwhile by its compressed form is read again. Raises UnusableInput for
    a file that cannot be read as a test.
    """
    own = report_settings(path, settings)
    while True:
        before = _inode(path)
        with open_test(path) as reader:
            document = _document(reader, path, own)
        if _inode(path) == before:
            return document


def _inode(path: Path) -> int:
    try:
        return path.stat().st_ino
    except OSError:
        return 0


def _document(reader: TestReader, path: Path, settings: tuple[ReportFile, bytes]) -> Manuscript:
    summary, about = reader.summary(), reader.metadata()
    identity = _identity(path, running=summary["status"] == "running")
    rows, agreement = rows_of(reader), agreement_of(reader)
    uncertainty = force_uncertainty(reader.calibration(), reader.configuration())
    file = path.stat()
    result = result_of_open(reader, file.st_mtime, file.st_size, closely=True)
    events = reader.events()
    sections = [
        _summary(
            summary,
            about,
            _simulated(reader, about),
            rows,
            identity,
            largest_force(reader),
            uncertainty,
            result,
        ),
        *datasections.trip(trip_capture(reader), sentence_of(summary["reason"])),
        *logsections.sections(reader, events, rows, summary["reason"]),
        *datasections.extremes(
            rows, agreement, uncertainty, stated_uncertainties(reader.calibration())
        ),
        *step_section(reader),
        *datasections.agreement(agreement, rows, events),
        datasections.cycles(
            cycles_of(reader),
            reader.state("cycles_refused"),
            uncertainty,
            bursts_of(reader),
            [one.revolution for one in reader.unfinished()],
        ),
        datasections.wear(agreement, worn_of(reader)),
        *([] if agreement is None else [_known(reader)]),
        datasections.quality(rows),
        *setupsections.sections(reader),
        _file_section(identity, summary, reader),
    ]
    title = about["title"] or path.stem
    warnings = _warnings(summary, _simulated(reader, about))
    own = settings[0].report
    lines = (f"Test report: {title} ({identity.name})", numbered(own.number, reader, about))
    return Manuscript(
        title=f"Test report: {title}",
        footer=" · ".join(line for line in lines if line),
        cover=cover_of(reader, about, result, rows, agreement, settings, warnings),
        statement=own.statement,
        signatures=own.signatures,
        made_at=_moment(about["ended"] or about["started"]),
        sections=tuple(one for one in sections if one.blocks),
        closing=_closing(identity, about),
    )


def _identity(path: Path, running: bool) -> FileIdentity:
    octets = path.stat().st_size
    if running:
        return FileIdentity(path.name, octets, "")
    with path.open("rb") as file:
        return FileIdentity(path.name, octets, hashlib.file_digest(file, "sha256").hexdigest())


def _closing(identity: FileIdentity, about: dict[str, Any]) -> str:
    origin = f"Made from {identity.name}, test {about['identifier'] or UNKNOWN}"
    if not identity.digest:
        return f"{origin}, while the test was running: a later report will say more."
    return f"{origin}, SHA-256 {identity.digest}."


def _simulated(reader: TestReader, about: dict[str, Any]) -> str:
    """Return what was simulated, as the beginning of a sentence; empty for a real rig.

    The ports in the recorded rig file tell; the file's own flag where they cannot be read.
    """
    try:
        rig = parse_rig(reader.configuration()["rig"], "the rig of the file", recorded=True)
        names = rig.simulated_devices
    except (KeyError, UnusableInput):
        return "The rig was" if about["simulated"] else ""
    if len(names) in (0, len(rig.devices)):
        return "The rig was" if names else ""
    return f"{' and '.join(names)} {'were' if len(names) > 1 else 'was'}"


def _summary(
    summary: dict[str, Any],
    about: dict[str, Any],
    simulated: str,
    rows: Rows | None,
    identity: FileIdentity,
    largest: LargestForce | None,
    uncertainty: ForceUncertainty | None,
    result: TestResult,
) -> Section:
    status, revolutions = summary["status"], summary["revolutions"]
    planned = about["planned_revolutions"]
    lines = [
        ("Title", about["title"]),
        ("Specimen", about["specimen"]),
        ("Bushing", about["bushing"]),
        ("Operator", about["operator"]),
        ("Rig", about["rig"] + (" (simulated)" if simulated else "")),
        ("Started", stamp(about["started"])),
        ("Ended", _ended(status, about)),
        ("Outcome", outcome_text(result)),
        ("Status", _capital(STATUSES.get(status, status))),
        ("Reason", _reason(summary, about)),
        ("Revolutions", f"{grouped(revolutions)} of {grouped(planned)} planned"),
        *_data_lines(summary, rows, largest, uncertainty, result),
        ("Notes", about["notes"]),
        ("File", identity.name),
    ]
    optional = ("Notes", "Bushing")
    shown = tuple((a, b or UNKNOWN) for a, b in lines if b or a not in optional)
    return Section("Summary", (Table("", shown),))


def _known(reader: TestReader) -> Section:
    # Twin and compiler, which a report without a prediction does without.
    from rigapp.report.testreport.identified import identified
    from rigapp.report.testreport.identifiedsections import known_section

    return known_section(identified(reader, reader.path))


def _warnings(summary: dict[str, Any], simulated: str) -> list[str]:
    """Return what must not be overlooked."""
    found = [f"{simulated} simulated: these are not measurements."] if simulated else []
    status = summary["status"]
    if status != "complete":
        sentence = LEADS.get(status, f"The status of the test is {status}.")
        found.append(f"{sentence} {_capital(sentence_of(summary['reason']))}".strip())
    return found


def _moment(text: str) -> float:
    """Return an ISO 8601 time as seconds since 1970, 0 where there is none."""
    try:
        return datetime.fromisoformat(text).timestamp()
    except ValueError:
        return 0.0


def _data_lines(
    summary: dict[str, Any],
    rows: Rows | None,
    largest: LargestForce | None,
    uncertainty: ForceUncertainty | None,
    result: TestResult,
) -> list[tuple[str, str]]:
    force = _force_line(largest, uncertainty)
    if rows is None:
        return [("Data", "no revolution is recorded"), *force]
    missing = sum(gap.missing for gap in rows.gaps)
    gaps = "none"
    if rows.gaps or summary["gaps"]:
        gaps = f"{counted(max(len(rows.gaps), summary['gaps']), 'gap')}"
        gaps += f", {counted(missing, 'revolution')} not recorded" if missing else ""
    speed = f"mean {number(rows.mean_speed, 'rpm')} rpm"
    if rows.speed is not None:
        low, high = rows.speed.smallest.value, rows.speed.largest.value
        speed += f", between {number(low, 'rpm')} and {number(high, 'rpm')} rpm"
    lines = [
        ("Numbers of the revolutions", f"{grouped(rows.first)} to {grouped(rows.last)}"),
        ("Time of the test", f"{duration(rows.test_s, exact=True)} by the device's clock"),
        ("Speed", speed),
    ]
    depth, coefficient, _, residual = key_numbers(result)
    lines += [(one.caption, f"{one.value}, {one.line}") for one in (depth, coefficient, residual)]
    good = f"{grouped(rows.good)} of {grouped(rows.revolutions)}"
    stated = "not stated: no calibration record of the load cell in the file"
    return [
        *lines,
        *force,
        ("Uncertainty of a force", uncertainty.words if uncertainty is not None else stated),
        ("Gaps", gaps),
        ("Revolutions without a quality flag", good),
        ("Whole cycles saved", grouped(summary["cycles_saved"])),
    ]  # fmt: skip


def _force_line(
    largest: LargestForce | None, uncertainty: ForceUncertainty | None
) -> list[tuple[str, str]]:
    if largest is None:
        return []
    doubt = ""
    if uncertainty is not None and not largest.lower_bound:
        told = uncertainty.at(np.array(largest.value_N), of_magnitude=True)
        doubt = f" ± {quantity(float(told), 'N', 2)}"
    place = f" in revolution {grouped(largest.revolution)}"
    place += "" if largest.whole else ", which the end of the test cut off"
    return [("Largest joint force", largest.sign + quantity(largest.value_N, "N") + doubt + place)]


def _ended(status: str, about: dict[str, Any]) -> str:
    if status == "running":
        return "the test is running"
    if not about["ended"]:
        return "unknown, the test was not closed"
    return stamp(about["ended"])


def _reason(summary: dict[str, Any], about: dict[str, Any]) -> str:
    words = REASONS.get(about["reason_code"], "")
    return (
        ". ".join(_capital(one) for one in (words, sentence_of(summary["reason"])) if one)
        or "none given"
    )


def _capital(text: str) -> str:
    """Begin a sentence, unless it begins with the name of a column."""
    name = "_" in text.partition(" ")[0]
    return text if name else capitalised(text)


def _checksums(reader: TestReader) -> str:
    if not reader.plan.checksums:
        return "none, the file is of an older version"
    damage = list(found_damage(reader, NEWEST_BYTES))
    return "DAMAGED: " + " ".join(damage) if damage else "rows, cycles and settings as written"


def _file_section(identity: FileIdentity, summary: dict[str, Any], reader: TestReader) -> Section:
    versions = reader.configuration().get("versions", {})
    form = "compressed, as after the test" if reader.compressed else "in place, as during the test"
    altered = reader.first_altered_event()
    log = "unbroken: every line follows from the one before"
    if altered is not None:
        log = f"BROKEN at line {altered + 1}: the log was changed after it was written"
    rows = (
        ("File", identity.name),
        ("Size", size(reader.used_bytes(identity.octets))),
        ("SHA-256", identity.digest or "not stated, the test is running and the file changes"),
        ("Test", str(reader.metadata()["identifier"])),
        ("Schema, form", f"{summary['schema']}, {form}"),
        ("Chain of the log", log),
        ("Checksums", _checksums(reader)),
    )
    found = tuple((str(name), str(value)) for name, value in versions.items())
    tables = (Table("", rows), Table("Versions that wrote the file", found))
    return Section("File and versions", tuple(one for one in tables if one.rows))
