"""The plan of a load-cell calibration on paper, and as a table of readings to be typed in."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator
from pathlib import Path

from rigapp.calibrating.certificates.formatting import write_page
from rigapp.calibrating.load_cell_session import PLANS, load_cell_plan
from rigapp.config.calibration_settings import LoadCellFile
from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.report.page.document import Manuscript, Row, Section, Table, Text
from rigapp_calibration.load_cell.readings import HUNG_COLUMN, LOAD_CELL_COLUMNS
from rigapp_calibration.taking.procedure import Step, StepKind

TYPED_IN = (
    "Write the encoder's angle and both signals of each line that has a series. Type them into the"
    " worksheet that ends in .csv and evaluate it with rigapp calibrate load-cell --readings."
)
LEVEL_FIRST = (
    "The angle reference goes into the settings: [angle] offset_deg is the angle that the encoder"
    " shows with the crank level, with the other sign."
)


def write_worksheet(plan: str, weights: str, given: LoadCellFile, to: Path) -> int:
    """Write the worksheet of a plan as PDF, HTML or CSV; return the number of readings.

    weights: the pieces, as ``parse_pieces`` takes them. Raises UnusableInput.
    """
    if plan == "daily":
        kinds = ", ".join(one for one in PLANS if one != plan)
        raise UnusableInput("--plan daily: a daily check makes no record; choose {}.", kinds)
    steps = load_cell_plan({"plan": plan, "weights": weights}, given).steps()
    if to.suffix.lower() == ".csv":
        with whole_file(to, new=True) as part:
            part.write_text(_table(steps, given), encoding="utf-8", newline="")
    else:
        write_page(to, "worksheet", lambda: _page(steps, plan, given))
    return sum(one.kind is StepKind.READING for one in steps)


def _table(steps: tuple[Step, ...], given: LoadCellFile) -> str:
    """Return a table of readings whose angles and signals are empty, instructions as comments."""
    stream = io.StringIO()
    for words in (f"{given.cell.name}. {TYPED_IN}", LEVEL_FIRST):
        stream.write(f"# {words}\n")
    lines = csv.writer(stream, lineterminator="\n")
    lines.writerow((*LOAD_CELL_COLUMNS, HUNG_COLUMN))
    for step in steps:
        stream.write(f"# {step.words}\n")
        if step.kind is StepKind.READING:
            hung = f"{step.due:g}" if step.due else ""
            lines.writerow((step.series, step.number, f"{step.value:g}", "", "", "", hung))
    return stream.getvalue()


def _page(steps: tuple[Step, ...], plan: str, given: LoadCellFile) -> Manuscript:
    paper = given.paperwork
    facts: tuple[Row, ...] = (
        ("Item", given.cell.name),
        ("Serial number", given.cell.serial_number or paper.serial_number),
        ("Amplifier, cable", ", ".join(filter(None, (paper.amplifier, paper.cable)))),
        ("Date, operator", ""),
        ("Temperature, humidity, pressure at the begin", ""),
        ("Temperature, humidity, pressure at the end", ""),
    )
    unit = given.cell.signal_unit
    header = (
        "Series, step", "What to do", "Wait, s", "Angle, degrees",
        f"Signal 1, {unit}", f"Signal 2, {unit}",
    )  # fmt: skip
    return Manuscript(
        title=f"Worksheet of a calibration: {given.cell.name}, {plan} plan",
        footer=f"{given.cell.name}, {plan} plan",
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
