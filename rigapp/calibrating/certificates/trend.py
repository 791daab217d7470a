"""The trend of calibrations as a document: sensitivities with their U over the years, vector."""

from __future__ import annotations

import datetime
from collections.abc import Sequence
from pathlib import Path

from rigapp.calibrating.certificates.formatting import STYLES, write_page
from rigapp.report.page.document import Block, Figure, Manuscript, Section, Table, Text
from rigapp.report.page.figures import canvas_of, saved
from rigapp_calibration.load_cell.as_found import Change, Output, outputs
from rigapp_calibration.records import Record, moment

Item = tuple[str, str, Sequence[tuple[Record, Sequence[Change]]]]
"""Kind, name, and the records, oldest first, each with what it found of the one before."""
MOST_TICKS = 6
"""Dates that have room beside each other below a chart."""


def write_trend(items: Sequence[Item], to: Path) -> None:
    """Write the trend of some items as .pdf or .html; raise UnusableInput."""
    write_page(to, "trend", lambda: document(items))


def document(items: Sequence[Item]) -> Manuscript:
    """Compose the page: of each item its charts, and what each record found of the one before."""
    return Manuscript(
        title="Trend of calibrations",
        footer="Trend of calibrations",
        sections=tuple(
            Section(f"{kind} {name}".strip(), tuple(_blocks(records)))
            for kind, name, records in items
        ),
        closing="Bars: expanded uncertainty U of the calibration, about 95 %. As found: what the"
        " record before told too much; allowed is the root of the sum of the squares of both U.",
        signatures=(),
    )


def _blocks(records: Sequence[tuple[Record, Sequence[Change]]]) -> list[Block]:
    table = Table(
        "Records",
        tuple(
            (
                str(one.content["calibrated_at"])[:10],
                one.number,
                "; ".join(change.words for change in changes) or "nothing to compare",
            )
            for one, changes in records
        ),
        ("calibrated", "record", "as found"),
    )
    told = [(one, outputs(one.kind, one.content["result"])) for one, _ in records]
    names = list(dict.fromkeys(output.what for _, found in told for output in found))
    if not names:
        return [Text("Records of this kind state no sensitivity with its U: no chart."), table]
    return [*(_chart(name, told) for name in names), table]


def _chart(name: str, told: Sequence[tuple[Record, Sequence[Output]]]) -> Figure:
    """Return the values of one sensitivity over the dates, with bars of U."""
    points = [(one, output) for one, found in told for output in found if output.what == name]
    values = [output.value for _, output in points]
    bars = [output.expanded for _, output in points]
    days = [
        datetime.datetime.fromtimestamp(moment(str(one.content["calibrated_at"])), datetime.UTC)
        for one, _ in points
    ]
    colour, marker, _ = STYLES[0]
    with canvas_of(2.3) as canvas:
        axes = canvas.subplots()
    axes.errorbar(days, values, bars, fmt=marker, color=colour, ms=4.0, capsize=3.0, lw=1.2)
    axes.axhline(values[0], color="#000000", lw=0.6, ls=":")
    axes.set_ylabel(points[0][1].unit.replace("um", "µm"))
    axes.set_xlabel("date of calibration")
    axes.set_title(name[:1].upper() + name[1:], loc="left")
    ticks = days if len(days) <= MOST_TICKS else days[:: -(-len(days) // MOST_TICKS)]
    axes.set_xticks(ticks, [day.date().isoformat() for day in ticks])
    change = 100.0 * (values[-1] / values[0] - 1.0)
    words = f"{name}: {len(values)} calibrations, the last {change:+.2g} % from the first."
    return saved(canvas, name[:1].upper() + name[1:], words)
