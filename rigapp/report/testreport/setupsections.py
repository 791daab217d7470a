"""Sections of the set-up of a test: calibrations, configuration and steps."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.presentation.numbers import grouped
from rigapp.presentation.translation import Text as Words
from rigapp.presentation.translation import tr
from rigapp.report.page.document import Block, Listing, Section, Table, Text
from rigapp.report.results import sequence_of, step_numbers
from rigapp.report.testreport.facts import mean
from rigapp.report.testreport.formatting import UNKNOWN, number, settings, symbol
from rigapp.schema.messages import NOT_STEADY
from rigapp.storage import StoredColumns, TestReader
from rigapp_calibration.records import Record, RecordError, unseal

TITLES: dict[str, Words] = {
    "load_cell": "Load cell",
    "probes": "Displacement probes",
    "encoder": "Crank encoder",
    "acquisition": "Acquisition",
    "force_uncertainty": "Uncertainty of a force",
}
DEVICE, RECORD = "device_", "record_"


def sections(reader: TestReader) -> list[Section]:
    """Return the calibration used, the devices as read back, and the files as given."""
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
    """Return what a sealed calibration record says; its readings stay in the file."""
    title = tr("Calibration record of {}", tr(TITLES.get(name, name.replace("_", " ")).lower()))
    try:
        record = unseal(str(values.get("record", "")).encode())
    except RecordError as error:
        return Table(title, ((tr("record"), tr("cannot be read: {}", error)),))
    return Table(title, tuple(_record_rows(record)))


def _record_rows(record: Record) -> list[tuple[str, str]]:
    content = record.content
    given, result = _mapping(content.get("settings")), _mapping(content.get("result"))
    item = _mapping(
        given.get("cell") or given.get("probe") or given.get("pin") or given.get("channel")
    )
    paper = _mapping(given.get("paperwork"))
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
    return [(one, words or tr(UNKNOWN)) for one, words in rows if words or one != "classification"]


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
    """Return the table of the steps, nothing for a test without them."""
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
        mine = of == step
        if not mine.any():
            continue
        good = mine & steady
        stage = sequence.at(int(revolutions[mine][0]))
        peak = float(columns["force_max"][good].max()) if good.any() else float("nan")
        table.append(
            (
                f"{step} {stage.name}".rstrip(),
                number(stage.speed_rpm),
                grouped(int(np.count_nonzero(mine))),
                grouped(int(np.count_nonzero(good))),
                number(mean(columns["speed"][good])),
                number(peak),
                *(
                    number(mean(columns[one][good]))
                    for one in ("force_max", "force_rms", "residual")
                ),
            )
        )
    told = tr("Judged are revolutions at a steady speed, between the ramps and without a pause.")
    return [Section(tr("Steps"), (Table("", tuple(table), tuple(map(tr, HEADER))), Text(told)))]


def _residuals(reader: TestReader, revolutions: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the RMS of measured minus predicted |F| of each revolution, NaN where none is."""
    found = np.full(len(revolutions), np.nan)
    table = StoredColumns(reader, "prediction")
    if "residual_rms" in table:
        places = np.searchsorted(revolutions, table["revolution"].astype(np.int64))
        inside = places < len(revolutions)
        same = inside.copy()
        same[inside] = revolutions[places[inside]] == table["revolution"][inside]
        found[places[same]] = table["residual_rms"][same]
    return found
