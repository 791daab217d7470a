"""The report of a test: the contents of its file in one document.

Nothing depends on the time or the machine, so that the same file gives the same bytes. Sections
about data are in ``datasections``, those about events in ``logsections``.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, Final

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig
from rigapp.config.report import ReportFile
from rigapp.presentation.numbers import grouped
from rigapp.presentation.results import key_numbers, outcome_text
from rigapp.presentation.times import duration
from rigapp.presentation.translation import Text, tr, translate
from rigapp.report.page.document import Figure, Manuscript, Section, Table
from rigapp.report.results import result_of_open
from rigapp.report.testreport import datasections, logsections, plots
from rigapp.report.testreport.cover import (
    cover_of,
    numbered,
    parameters_of,
    report_settings,
    scheme,
    setup_sections,
    step_section,
)
from rigapp.report.testreport.facts import (
    Rows,
    gaps_of,
    rows_of,
    stated_uncertainties,
)
from rigapp.report.testreport.formatting import (
    REASONS,
    STATUSES,
    UNKNOWN,
    counted,
    number,
    quantity,
    size,
    stamp,
)
from rigapp.report.testreport.model_facts import agreement_of, bursts_of, cycles_of, wear_of
from rigapp.report.testreport.worn import picture, worn_of
from rigapp.schema.channels import LOAD_CELL
from rigapp.schema.results import TestResult
from rigapp.storage import (
    NEWEST_BYTES,
    LargestForce,
    TestReader,
    find_damage,
    largest_force,
    open_test,
    trip_capture,
)
from rigapp.texts import capitalised
from rigapp_calibration.load_cell.force_uncertainty import ForceUncertainty, force_uncertainty

LEADS: dict[str, Text] = {
    "running": "The test was still running when this report was made.",
    "stopped": "The test was stopped before the planned end.",
    "interrupted": "The test was interrupted.",
}


@dataclass(frozen=True, slots=True)
class FileIdentity:
    """Identity of the file. digest: hexadecimal SHA-256, empty for a file that still changes."""

    name: str
    octets: int
    digest: str


def report_of(path: Path, settings: Path | None = None) -> Manuscript:
    """Compose the report of a test file. settings: a report.toml, else see ``report_settings``.

    A file that is replaced by its compressed form meanwhile is read again. Raises UnusableInput for
    a file that is not a readable test.
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
    events, simulated = reader.events(), _simulated(reader, about)
    sections = [
        _summary(
            summary, about, simulated, rows, identity, largest_force(reader), uncertainty, result
        ),
        *datasections.trip(trip_capture(reader), translate(summary["reason"])),
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
            [cycle.revolution for cycle in reader.unfinished()],
        ),
        datasections.wear(agreement, worn_of(reader)),
        *([] if agreement is None else [_known(reader)]),
        datasections.quality(rows),
        *setup_sections(reader),
        _file_section(identity, summary, reader),
    ]
    title = about["title"] or path.stem
    warnings = _warnings(summary, simulated)
    own = settings[0].report
    lines = (tr("Test report: {} ({})", title, identity.name), numbered(own.number, reader, about))
    return Manuscript(
        title=tr("Test report: {}", title),
        footer=" · ".join(line for line in lines if line),
        cover=cover_of(reader, about, result, rows, agreement, settings, warnings),
        statement=own.statement,
        signatures=tuple(map(tr, own.signatures)),
        made_at=_moment(about["ended"] or about["started"]),
        sections=tuple(section for section in sections if section.blocks),
        closing=_closing(identity, about),
    )


def _identity(path: Path, running: bool) -> FileIdentity:
    octets = path.stat().st_size
    if running:
        return FileIdentity(path.name, octets, "")
    with path.open("rb") as file:
        return FileIdentity(path.name, octets, hashlib.file_digest(file, "sha256").hexdigest())


def _closing(identity: FileIdentity, about: dict[str, Any]) -> str:
    origin = tr("Made from {}, test {}", identity.name, about["identifier"] or tr(UNKNOWN))
    if not identity.digest:
        return tr("{}, while the test was running: a later report will say more.", origin)
    return tr("{}, SHA-256 {}.", origin, identity.digest)


def _simulated(reader: TestReader, about: dict[str, Any]) -> str:
    """Return what was simulated, as the start of a sentence; empty for a real rig.

    From the ports in the recorded rig file, or from the file's flag where they are unreadable.
    """
    try:
        rig = parse_rig(reader.configuration()["rig"], "the rig of the file", recorded=True)
        names = rig.simulated_devices
    except (KeyError, UnusableInput):
        return tr("The rig was") if about["simulated"] else ""
    if len(names) in (0, len(rig.devices)):
        return tr("The rig was") if names else ""
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
        (tr("Title"), about["title"]),
        (tr("Specimen"), about["specimen"]),
        (tr("Bushing"), about["bushing"]),
        (tr("Operator"), about["operator"]),
        (tr("Rig"), about["rig"] + (tr(" (simulated)") if simulated else "")),
        (tr("Started"), stamp(about["started"])),
        (tr("Ended"), _ended(status, about)),
        (tr("Outcome"), outcome_text(result)),
        (tr("Status"), _capital(tr(STATUSES.get(status, status)))),
        (tr("Reason"), _reason(summary, about)),
        (tr("Revolutions"), tr("{} of {} planned", grouped(revolutions), grouped(planned))),
        *_data_lines(summary, rows, largest, uncertainty, result),
        (tr("Notes"), about["notes"]),
        (tr("File"), identity.name),
    ]
    optional = (tr("Notes"), tr("Bushing"))
    shown = tuple((a, b or tr(UNKNOWN)) for a, b in lines if b or a not in optional)
    return Section(tr("Summary"), (Table("", shown),))


def _known(reader: TestReader) -> Section:
    # Imports twin and compiler, which a report without prediction does not need.
    from rigapp.report.testreport.identified import identified
    from rigapp.report.testreport.identifiedsections import known_section

    return known_section(identified(reader, reader.path))


def _warnings(summary: dict[str, Any], simulated: str) -> list[str]:
    """Return the warnings of the report."""
    result = [tr("{} simulated: these are not measurements.", simulated)] if simulated else []
    status = summary["status"]
    if status != "complete":
        sentence = (
            tr(LEADS[status]) if status in LEADS else tr("The status of the test is {}.", status)
        )
        result.append(f"{sentence} {_capital(translate(summary['reason']))}".strip())
    return result


def _moment(text: str) -> float:
    """Return an ISO 8601 time as seconds since 1970, 0 without one."""
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
        return [(tr("Data"), tr("no revolution is recorded")), *force]
    missing = sum(gap.missing for gap in rows.gaps)
    gaps = tr("none")
    if rows.gaps or summary["gaps"]:
        gaps = f"{counted(max(len(rows.gaps), summary['gaps']), 'gap')}"
        gaps += tr(", {} not recorded", counted(missing, "revolution")) if missing else ""
    speed = tr("mean {} rpm", number(rows.mean_speed, "rpm"))
    if rows.speed is not None:
        low, high = rows.speed.smallest.value, rows.speed.largest.value
        speed += tr(", between {} and {} rpm", number(low, "rpm"), number(high, "rpm"))
    lines = [
        (tr("Numbers of the revolutions"), tr("{} to {}", grouped(rows.first), grouped(rows.last))),
        (tr("Time of the test"), tr("{} by the device's clock", duration(rows.test_s, exact=True))),
        (tr("Speed"), speed),
    ]
    depth, coefficient, _, residual = key_numbers(result)
    lines += [
        (tr(figure.caption), f"{figure.value}, {figure.line}")
        for figure in (depth, coefficient, residual)
    ]
    good = tr("{} of {}", grouped(rows.good), grouped(rows.revolutions))
    stated = tr("not stated: no calibration record of the load cell in the file")
    return [
        *lines,
        *force,
        (tr("Uncertainty of a force"), uncertainty.words if uncertainty is not None else stated),
        (tr("Gaps"), gaps),
        (tr("Revolutions without a quality flag"), good),
        (tr("Complete cycles saved"), grouped(summary["cycles_saved"])),
    ]  # fmt: skip


def _force_line(
    largest: LargestForce | None, uncertainty: ForceUncertainty | None
) -> list[tuple[str, str]]:
    if largest is None:
        return []
    doubt = ""
    if uncertainty is not None and not largest.lower_bound:
        uncertainty_N = uncertainty.at(np.array(largest.value_N), of_magnitude=True)
        doubt = f" ± {quantity(float(uncertainty_N), 'N', 2)}"
    where = tr(" in revolution {}", grouped(largest.revolution))
    where += "" if largest.complete else tr(", which the end of the test cut off")
    return [
        (tr("Largest joint force"), largest.sign + quantity(largest.value_N, "N") + doubt + where)
    ]


def _ended(status: str, about: dict[str, Any]) -> str:
    if status == "running":
        return tr("the test is running")
    if not about["ended"]:
        return tr("unknown, the test was not closed")
    return stamp(about["ended"])


def _reason(summary: dict[str, Any], about: dict[str, Any]) -> str:
    words = tr(REASONS.get(about["reason_code"], ""))
    return ". ".join(
        _capital(text) for text in (words, translate(summary["reason"])) if text
    ) or tr("none given")


def _capital(text: str) -> str:
    """Capitalise a sentence, unless it starts with the name of a column."""
    name = "_" in text.partition(" ")[0]
    return text if name else capitalised(text)


def _checksums(reader: TestReader) -> str:
    if not reader.plan.checksums:
        return tr("none, the file is of an older version")
    damage = list(find_damage(reader, NEWEST_BYTES))
    return (
        tr("DAMAGED: ") + " ".join(damage) if damage else tr("rows, cycles and settings as written")
    )


def _file_section(identity: FileIdentity, summary: dict[str, Any], reader: TestReader) -> Section:
    versions = reader.configuration().get("versions", {})
    form = (
        tr("compressed, as after the test")
        if reader.compressed
        else tr("in place, as during the test")
    )
    altered = reader.first_altered_event()
    log = tr("unbroken: every line follows from the one before")
    if altered is not None:
        log = tr("BROKEN at line {}: the log was changed after it was written", altered + 1)
    rows = (
        (tr("File"), identity.name),
        (tr("Size"), size(reader.used_bytes(identity.octets))),
        (
            tr("SHA-256"),
            identity.digest or tr("not stated, the test is running and the file changes"),
        ),
        (tr("Test"), str(reader.metadata()["identifier"])),
        (tr("Schema, form"), f"{summary['schema']}, {form}"),
        (tr("Chain of the log"), log),
        (tr("Checksums"), _checksums(reader)),
    )
    version_rows = tuple((str(name), str(value)) for name, value in versions.items())
    tables = (Table("", rows), Table(tr("Versions that wrote the file"), version_rows))
    return Section(tr("File and versions"), tuple(table for table in tables if table.rows))


def figure_of(path: Path, name: str = "") -> Figure:
    """Return a figure of a test by its name in FIGURES; by default the first available one.

    Raises UnusableInput for a file that is not a test, and for a figure without data in the test.
    """
    with open_test(path) as reader:
        for candidate in (name,) if name else FIGURES:
            figure = FIGURES[candidate](reader)
            if figure is not None:
                return figure
    raise UnusableInput("{}: holds no data for the figure {}.", path, name or next(iter(FIGURES)))


def _wear(reader: TestReader) -> Figure | None:
    return plots.wear_trend(wear_of(reader), gaps_of(reader))


def _forces(reader: TestReader) -> Figure | None:
    rows, doubt = rows_of(reader), force_uncertainty(reader.calibration(), reader.configuration())
    channels = (
        [channel for channel in rows.channels if channel.channel.instrument == LOAD_CELL]
        if rows
        else []
    )
    if rows is None or not channels:
        return None
    title = "Forces against revolution"
    return plots.trends(channels, agreement_of(reader), rows.gaps, title, doubt)


def _displacement(reader: TestReader) -> Figure | None:
    rows = rows_of(reader)
    channels = [c for c in rows.channels if c.name.startswith("probe_")] if rows else []
    if rows is None or not channels:
        return None
    stated = stated_uncertainties(reader.calibration())
    title = "Displacement against revolution"
    return plots.trends(channels, None, rows.gaps, title, stated=stated)


def _agreement(reader: TestReader) -> Figure | None:
    agreement = agreement_of(reader)
    return plots.residual_trend(agreement, gaps_of(reader)) if agreement else None


def _cycles(reader: TestReader) -> Figure | None:
    result = cycles_of(reader)
    doubt = force_uncertainty(reader.calibration(), reader.configuration())
    return plots.cycles(result, doubt) if result else None


def _profile(reader: TestReader) -> Figure | None:
    result = worn_of(reader)
    return picture(result) if result is not None else None


def _prediction(reader: TestReader) -> Figure | None:
    # Imports twin and compiler (190 MB), which the other figures do not need.
    from rigapp.report.testreport.identified import identified
    from rigapp.report.testreport.identifiedsections import depth_figure

    test = identified(reader, reader.path)
    return depth_figure(test, test.known) if test.known is not None else None


def _trip(reader: TestReader) -> Figure | None:
    result = trip_capture(reader)
    return plots.trip(result) if result is not None else None


def _mechanism(reader: TestReader) -> Figure | None:
    return scheme(parameters_of(reader))


FIGURES: Final[Mapping[str, Callable[[TestReader], Figure | None]]] = {
    "wear": _wear,
    "forces": _forces,
    "displacement": _displacement,
    "agreement": _agreement,
    "cycles": _cycles,
    "profile": _profile,
    "prediction": _prediction,
    "trip": _trip,
    "mechanism": _mechanism,
}
"""Name of a figure -> function that draws it; this returns None without data in the test."""
