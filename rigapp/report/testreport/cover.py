"""The first page of a report, and the setup: calibrations, configuration, steps."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import platformdirs
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_parameters, read_document
from rigapp.config.reading import read_bytes
from rigapp.config.report import ReportFile, report_number
from rigapp.presentation.numbers import UNKNOWN as NOTHING
from rigapp.presentation.numbers import grouped
from rigapp.presentation.results import key_numbers, outcome_text
from rigapp.presentation.translation import Text as Words
from rigapp.presentation.translation import tr, translate
from rigapp.report.page.document import (
    JPEG,
    PNG,
    Block,
    Cover,
    Figure,
    Listing,
    Row,
    Section,
    Table,
    Text,
)
from rigapp.report.page.figures import INK, MODEL, MUTED, canvas_of, saved
from rigapp.report.results import sequence_of, step_numbers
from rigapp.report.testreport.facts import Rows, mean
from rigapp.report.testreport.formatting import UNKNOWN, counted, number, settings, stamp, symbol
from rigapp.report.testreport.model_facts import Agreement
from rigapp.report.testreport.plots import trends, wear_trend
from rigapp.schema.messages import NOT_STEADY
from rigapp.schema.results import TestResult
from rigapp.storage import StoredColumns, TestReader
from rigapp.texts import capitalised
from rigapp_calibration.records import Record, RecordError, unseal
from rigapp_model.parameters import Parameters

SETTINGS: Final = "report.toml"
LARGEST_LOGO_BYTES: Final = 1 << 20
ALARMS_NAMED: Final = 2
"""Number of alarms in the line of a result; the log of the report has all of them."""

NOTE: Final[Words] = (
    "± is an expanded uncertainty with k = 2, about 95 %, as stated by the records in the file for"
    " the point of use. A value without ± has no such record."
)
FIGURES_WIDTH_IN: Final = 86.0 / 25.4


def report_settings(test: Path, file: Path | None = None) -> tuple[ReportFile, bytes]:
    """Return the settings of reports and the logo; without any file, the defaults.

    Without ``file`` the one beside the test file is used, then the user's. Raises UnusableInput for
    unreadable settings or an unreadable logo.
    """
    own = platformdirs.user_config_path("rigapp") / SETTINGS
    path = file or next((p for p in (test.parent / SETTINGS, own) if p.is_file()), None)
    if path is None:
        return ReportFile(schema=1), b""
    settings = read_document(path, ReportFile).record
    report_number(settings.report.number, dict.fromkeys(("file", "title", "specimen", "date"), ""))
    return settings, _logo(path, settings.laboratory.logo)


def _logo(settings: Path, name: str) -> bytes:
    if not name:
        return b""
    if Path(name).name != name:
        raise UnusableInput(
            "{}: laboratory.logo = {}: there is no such file beside it; name a file there.",
            settings,
            repr(name),
        )
    try:
        data = read_bytes(settings.parent / name, LARGEST_LOGO_BYTES)
    except OSError as error:
        raise UnusableInput(
            "{}: laboratory.logo = {} cannot be read ‹{}›.", settings, repr(name), error.strerror
        ) from error
    if not data.startswith((PNG, JPEG)):
        raise UnusableInput("{}: this is neither PNG nor JPEG.", settings.parent / name)
    return data


def cover_of(
    reader: TestReader,
    about: Mapping[str, Any],
    result: TestResult,
    rows: Rows | None,
    agreement: Agreement | None,
    settings: tuple[ReportFile, bytes],
    warnings: Sequence[str],
) -> Cover:
    """Return the first page. warnings: important remarks."""
    file, logo = settings
    parameters = parameters_of(reader)
    wear = wear_trend(agreement.wear, rows.gaps if rows is not None else ()) if agreement else None
    figures = [f for f in (wear or _forces(rows, agreement), scheme(parameters)) if f]
    letterhead = (file.laboratory.name, *file.laboratory.address.splitlines())
    return Cover(
        subtitle=_subtitle(about, rows),
        facts=tuple(_facts(reader, about, file, result)),
        results=tuple(_results(result)),
        letterhead=tuple(line for line in letterhead if line.strip()),
        logo=logo,
        warnings=tuple(warnings),
        note=tr(NOTE),
        figures=tuple(figures),
        texts=tuple(_texts(reader, result, rows)),
    )


def _forces(rows: Rows | None, agreement: Agreement | None) -> Figure | None:
    """Return the figure of the largest force, for tests without wear depth; None without forces."""
    size = (
        [channel for channel in rows.channels if channel.name == "force"]
        if rows is not None
        else []
    )
    if rows is None or not size:
        return None
    return trends(size, agreement, rows.gaps, tr("The joint force over the test"), None)


def numbered(pattern: str, reader: TestReader, about: Mapping[str, Any]) -> str:
    """Return the number of a report from the pattern in its settings; empty without one."""
    values = {
        "file": reader.path.stem,
        "title": about["title"],
        "specimen": about["specimen"],
        "date": about["started"][:10],
    }
    return report_number(pattern, values)


def _subtitle(about: Mapping[str, Any], rows: Rows | None) -> str:
    speed = tr("{} rpm", number(rows.mean_speed, "rpm", 0)) if rows is not None else ""
    return ", ".join(part for part in (about["specimen"], about["bushing"], speed) if part)


def _facts(
    reader: TestReader, about: Mapping[str, Any], file: ReportFile, result: TestResult
) -> list[Row]:
    rig = about["rig"] + (tr(" (simulated)") if result.simulated else "")
    facts = [
        (tr("Customer"), file.report.customer),
        (tr("Specimen"), about["specimen"]),
        (tr("Operator"), about["operator"]),
        (tr("Report"), numbered(file.report.number, reader, about)),
        (tr("Begun"), stamp(about["started"])),
        (tr("Ended"), stamp(about["ended"])),
        (tr("Rig"), rig),
        (tr("Calibrations valid until"), _valid_until(reader.calibration())),
    ]
    return [(name, value) for name, value in facts if value and value != UNKNOWN]


def _valid_until(calibration: Mapping[str, Any]) -> str:
    """Return the expiry dates of the records in a file."""
    days = []
    for label, name in (("record_load_cell", tr("cell")), ("record_probes", tr("probes"))):
        values = calibration.get(label)
        try:
            text = str(values["record"]) if isinstance(values, Mapping) else ""
            due = str(unseal(text.encode()).content.get("due_at", "")) if text else ""
        except (KeyError, RecordError):
            due = ""
        if due:
            days.append(f"{name} {due[:10]}")
    return ", ".join(days) or tr("no records in the file")


def _results(result: TestResult) -> list[Row]:
    rows = [
        (tr(figure.caption), tr(UNKNOWN) if figure.value == NOTHING else figure.value, figure.line)
        for figure in key_numbers(result)
    ]
    ended = f"{outcome_text(result)}, {counted(result.revolutions, 'revolution')}"
    return [*rows, (tr("End of the test"), ended, _end(result))]


def _end(result: TestResult) -> str:
    names = [capitalised(translate(title)) for title in dict.fromkeys(result.alarms)]
    alarms = counted(len(result.alarms), "alarm") if names else tr("no alarm")
    if names:
        more = ", …" if len(names) > ALARMS_NAMED else ""
        alarms += f" ({', '.join(names[:ALARMS_NAMED])}{more})"
    gaps = counted(result.gaps, "gap") if result.gaps else tr("no gap")
    return tr("{}; {}; {} revolutions with a quality flag", alarms, gaps, grouped(result.flagged))


def _texts(reader: TestReader, result: TestResult, rows: Rows | None) -> list[Row]:
    done = tr("{} of {} planned revolutions", grouped(result.revolutions), grouped(result.planned))
    if rows is not None:
        done += tr(" at {} rpm", number(rows.mean_speed, "rpm"))
    kept = tr("maximum, minimum and RMS of each, {} whole", grouped(result.cycles_saved))
    return [
        (tr("What was done."), tr("{}; recorded: {}.", done, kept)),
        (
            tr("Data."),
            tr("{}, test {}.", reader.path.name, reader.metadata()["identifier"] or tr(UNKNOWN)),
        ),
    ]


def parameters_of(reader: TestReader) -> Parameters | None:
    """Return the model's parameters of a file; None without readable ones."""
    tree = reader.configuration().get("parameters")
    try:
        return parse_parameters(tree, "parameters of the file") if tree else None
    except (UnusableInput, TypeError, ValueError):
        return None


CRANK_AT_DEG: Final = 55.0
"""Crank angle in the drawing."""


def scheme(parameters: Parameters | None) -> Figure | None:
    """Draw the mechanism to scale with its dimensions; None without parameters."""
    if parameters is None:
        return None
    mechanism, joint = parameters.mechanism, parameters.joint
    crank, follower = mechanism.crank_radius, mechanism.follower_length
    angle = math.radians(CRANK_AT_DEG)
    pin = np.array([crank * math.cos(angle), crank * math.sin(angle)])
    slider = np.array([pin[0] + math.sqrt(follower**2 - pin[1] ** 2), 0.0])
    unit = (crank + follower) / 10.0
    with canvas_of(1.4, FIGURES_WIDTH_IN) as canvas:
        axes = canvas.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set_aspect("equal")
        axes.axis("off")
        axes.axhline(0.0, color=MUTED, lw=0.5)
        for begin, end in ((np.zeros(2), pin), (pin, slider)):
            axes.plot(*zip(begin, end, strict=True), color=INK, lw=2.2, solid_capstyle="round")
        half = np.array([0.75, 0.45]) * unit
        axes.fill(
            slider[0] + half[0] * np.array([-1, 1, 1, -1]), half[1] * np.array([-1, -1, 1, 1]),
            facecolor="#eef1f4", edgecolor=INK, lw=1.0, zorder=3,
        )  # fmt: skip
        axes.plot(0.0, 0.0, "o", ms=6, mfc="white", mec=INK, zorder=4)
        axes.plot(*pin, "o", ms=10, mfc="white", mec=MODEL, mew=1.5, zorder=4)
        axes.plot(*pin, "o", ms=4.5, color=INK, zorder=5)
        axes.plot(*slider, "o", ms=4, mfc="white", mec=INK, zorder=5)
        right = slider[0] + half[0]
        if mechanism.spring is not None and mechanism.spring.stiffness > 0.0:
            wall = right + 2.2 * unit
            zig = np.linspace(right, wall, 12)
            axes.plot(zig, 0.28 * unit * np.array([0, 0, *[1, -1] * 4, 0, 0]), color=INK, lw=1.0)
            axes.plot([wall, wall], [-0.6 * unit, 0.6 * unit], color=INK, lw=1.5)
            text = f"{mechanism.spring.stiffness:.4g} N/m"
            axes.text((right + wall) / 2, 0.65 * unit, text, ha="center", fontsize=7.5, color=MUTED)
            right = wall
        small = {"fontsize": 7.5, "color": MUTED}
        left = pin / 2 + np.array([-0.25, 0.1]) * unit
        axes.text(*left, f"{1e3 * crank:.4g} mm", ha="right", **small)
        middle = (pin + slider) / 2 + np.array([0.0, 0.35]) * unit
        axes.text(*middle, f"{1e3 * follower:.4g} mm", ha="left", **small)
        mass = mechanism.slider_mass + mechanism.added_mass
        axes.text(slider[0], -1.15 * unit, f"{mass:.4g} kg", ha="center", **small)
        sizes = tr(
            "joint: pin {:.4g}, bushing {:.4g}",
            2000.0 * joint.pin_radius,
            2000.0 * joint.bushing_radius,
        )
        sizes += f" × {1e3 * joint.bushing_width:.4g} mm"
        above = pin + np.array([0.0, 0.7]) * unit
        axes.text(*above, sizes, ha="left", fontsize=7.5, color=MODEL)
        axes.set_xlim(-1.6 * unit, right + 1.2 * unit)
        axes.set_ylim(-1.6 * unit, pin[1] + 1.5 * unit)
    plane = tr("vertical") if any(mechanism.gravity) else tr("horizontal")
    caption = tr(
        "Crank {:.4g} kg, follower {:.4g} kg; {} plane.",
        mechanism.crank_mass,
        mechanism.follower_mass,
        plane,
    )
    words = tr(
        "Slider-crank, crank {:.4g} mm, follower {:.4g} mm; {}.",
        1000.0 * crank,
        1000.0 * follower,
        sizes,
    )
    return saved(canvas, tr("The mechanism"), words, caption)


TITLES: dict[str, Words] = {
    "load_cell": "Load cell",
    "probes": "Displacement probes",
    "encoder": "Crank encoder",
    "acquisition": "Acquisition",
    "force_uncertainty": "Uncertainty of a force",
}
DEVICE, RECORD = "device_", "record_"


def setup_sections(reader: TestReader) -> list[Section]:
    """Return sections of the calibration, the devices as read back, and the settings files."""
    calibration = reader.calibration()
    used = [name for name in TITLES if name in calibration]
    used += [
        name for name in calibration if name not in TITLES and not name.startswith((DEVICE, RECORD))
    ]
    tables: list[Block] = [
        Table(tr(TITLES.get(name, name)), tuple(settings(_mapping(calibration[name]))))
        for name in used
    ]
    tables += [
        _record(name.removeprefix(RECORD), _mapping(values))
        for name, values in calibration.items()
        if name.startswith(RECORD)
    ]
    devices = tuple(
        Table(
            tr("Device {}, as read back", name.removeprefix(DEVICE)),
            tuple(settings(_mapping(values))),
        )
        for name, values in calibration.items()
        if name.startswith(DEVICE) and values
    )
    missing = (Text(tr("The file holds no calibration.")),)
    return [
        Section(tr("Calibration used"), tuple(tables) or missing),
        Section(tr("Devices"), devices),
        _configuration(reader.configuration()),
    ]


def _record(name: str, values: Mapping[str, Any]) -> Table:
    """Return the contents of a sealed calibration record, without its readings."""
    title = tr("Calibration record of {}", tr(TITLES.get(name, name.replace("_", " ")).lower()))
    try:
        record = unseal(str(values.get("record", "")).encode())
    except RecordError as error:
        return Table(title, ((tr("record"), tr("cannot be read: {}", error)),))
    return Table(title, tuple(_record_rows(record)))


def _record_rows(record: Record) -> list[tuple[str, str]]:
    content = record.content
    used, result = _mapping(content.get("settings")), _mapping(content.get("result"))
    item = _mapping(used.get("cell") or used.get("probe") or used.get("pin") or used.get("channel"))
    paper = _mapping(used.get("paperwork"))
    rows = [
        (tr("number"), tr("{}, the digest of the record holds", record.number)),
        (tr("item"), str(item.get("name", ""))),
        (tr("serial number"), str(paper.get("serial_number", ""))),
        (tr("calibrated"), str(content.get("calibrated_at", ""))),
        (tr("due"), str(content.get("due_at", ""))),
        (tr("classification"), str(result.get("classification", ""))),
    ]
    factor = result.get("coverage_factor")
    known = f"k = {factor:.2f}" if isinstance(factor, float) else tr("k unknown")
    own = symbol(str(result.get("unit", "")))
    for key, unit, form in (
        ("expanded_uncertainty_N", "N", ".2f"),
        ("expanded_uncertainty_um", "µm", ".2f"),
        ("expanded_uncertainty_value", own, ".3g"),
    ):
        if isinstance(result.get(key), float):
            rows.append((tr("expanded uncertainty"), f"{result[key]:{form}} {unit} ({known})"))
    for key, unit in (("residual_std_N", "N"), ("residual_std_um", "µm")):
        if isinstance(result.get(key), float):
            rows.append((tr("residual standard deviation"), f"{result[key]:.3f} {unit}"))
    return [(row, words or tr(UNKNOWN)) for row, words in rows if words or row != "classification"]


def _mapping(value: Any) -> dict[str, Any]:
    if isinstance(value, Mapping):
        return dict(value)
    return {} if value is None else {"value": value}


def _configuration(configuration: dict[str, Any]) -> Section:
    blocks: list[Block] = []
    parameters = settings(configuration.get("parameters", {}))
    if parameters:
        blocks.append(Table(tr("Parameters of the model"), tuple(parameters)))
    for name, title in (
        ("test", tr("Test file, as given")),
        ("rig", tr("Rig file, as given")),
    ):
        text = str(configuration.get(name, ""))
        blocks.append(
            Listing(title, text.rstrip())
            if text.strip()
            else Text(tr("{}: not in the file.", title))
        )
    return Section(tr("Configuration"), tuple(blocks))


HEADER: tuple[Words, ...] = (
    "step", "set speed, rpm", "revolutions", "judged", "speed, rpm", "largest |F|, N",
    "mean of the maxima of |F|, N", "mean RMS of |F|, N", "mean residual, RMS, N",
)  # fmt: skip


def step_section(reader: TestReader) -> list[Section]:
    """Return the section with the table of steps, empty for a test without steps."""
    sequence, rows = sequence_of(reader), reader.committed()
    if sequence is None or not rows:
        return []
    revolutions = reader.column("revolution", 0, rows).astype(np.int64)
    steady = (reader.column("quality", 0, rows).astype(np.int64) & NOT_STEADY) == 0
    of = step_numbers(sequence, revolutions)
    columns = {
        name: reader.column(name, 0, rows).astype(float)
        for name in ("speed", "force_max", "force_rms")
    }
    columns["residual"] = _residuals(reader, revolutions)
    table = []
    for step in range(1, sequence.count + 1):
        within = of == step
        if not within.any():
            continue
        good = within & steady
        stage = sequence.at(int(revolutions[within][0]))
        peak = float(columns["force_max"][good].max()) if good.any() else float("nan")
        table.append(
            (
                f"{step} {stage.name}".rstrip(),
                number(stage.speed_rpm),
                grouped(int(np.count_nonzero(within))),
                grouped(int(np.count_nonzero(good))),
                number(mean(columns["speed"][good])),
                number(peak),
                *(
                    number(mean(columns[column][good]))
                    for column in ("force_max", "force_rms", "residual")
                ),
            )
        )
    notes = tr(
        "Evaluated are revolutions at a steady speed, between the ramps and without a pause."
    )
    return [Section(tr("Steps"), (Table("", tuple(table), tuple(map(tr, HEADER))), Text(notes)))]


def _residuals(reader: TestReader, revolutions: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the RMS of measured minus predicted |F| of each revolution, NaN if unknown."""
    result = np.full(len(revolutions), np.nan)
    table = StoredColumns(reader, "prediction")
    if "residual_rms" in table:
        indices = np.searchsorted(revolutions, table["revolution"].astype(np.int64))
        inside = indices < len(revolutions)
        same = inside.copy()
        same[inside] = revolutions[indices[inside]] == table["revolution"][inside]
        result[indices[same]] = table["residual_rms"][same]
    return result
