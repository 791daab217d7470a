"""The parts, plots and pages of certificates, the same bytes each time."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.report.page.document import Figure, Manuscript, Row, Table
from rigapp.report.page.figures import canvas_of, name_curves, saved
from rigapp_calibration.coverage import by_uncertainty

Content = Mapping[str, Any]
"""The content of a record, or a part of it."""

UNSTATED = "not stated"
STYLES = (("#0072B2", "o", "-"), ("#D55E00", "s", "--"))


@dataclass(frozen=True, slots=True)
class Parts:
    """The parts of a certificate specific to a calibration type.

    statements: method, and limits of the results. tables: of the results. heading: of the figures.
    calibrated: the range that was calibrated, in words. conditions: rows of further conditions.
    uncertainty: budgets. readings: the tables at the end.
    """

    statements: Sequence[str]
    tables: Sequence[Table]
    figures: Sequence[Figure]
    heading: str = "Residuals"
    calibrated: str = ""
    conditions: Sequence[Row] = ()
    uncertainty: Sequence[Table] = ()
    readings: Sequence[Table] = ()


def say(template: str, content: Content, otherwise: str = UNSTATED) -> str:
    """Return a template (``str.format``) filled from a record; otherwise: if a value is missing."""
    try:
        return template.format_map(content)
    except (KeyError, IndexError, TypeError):
        return otherwise


def rows_of(lines: Mapping[str, str], content: Content, otherwise: str = UNSTATED) -> list[Row]:
    """Return rows of a name and its filled template; lines: name -> template."""
    return [(name, say(line, content, otherwise)) for name, line in lines.items()]


def table(
    title: str, columns: Mapping[str, str], items: Iterable[Content], otherwise: str = UNSTATED
) -> Table:
    """Return a table with a row of each item; columns: header -> template."""
    cells = columns.values()
    rows = tuple(tuple(say(cell, item, otherwise) for cell in cells) for item in items)
    return Table(title, rows, tuple(columns))


def elements(letter: str, content: Content, columns: Mapping[str, str]) -> list[Row]:
    """Return a row of each element of 2 x 2 matrices; columns: key of the matrix -> format."""
    return [
        (
            f"{letter}{i + 1}{j + 1}",
            *(say(f"{{{key}[{i}][{j}]:{form}}}", content) for key, form in columns.items()),
        )
        for i in range(2)
        for j in range(2)
    ]


def budget_table(title: str, result: Content, unit: str, shown: str) -> list[Table]:
    """Return the budget of a result: its parts with type, distribution, degrees of freedom.

    unit: in the keys of the result; shown: on the page. Older records state names and sizes
    only; none where there is no budget.
    """
    lines = result.get("budget")
    if not lines:
        return []
    key = f"standard_uncertainty_{unit}"
    of_all = {
        "name": "combined",
        "type": "",
        "distribution": "",
        "degrees_of_freedom": result.get("effective_degrees_of_freedom", UNSTATED),
        key: math.hypot(*(line[key] for line in lines)),
    }
    expanded = {
        **of_all,
        "name": say("expanded, k = {coverage_factor:.2f}, about 95 %", result),
        "degrees_of_freedom": "",
        key: result[f"expanded_uncertainty_{unit}"],
    }
    columns = {
        "contribution": "{name}",
        "type": "{type}",
        "distribution": "{distribution}",
        "degrees of freedom": "{degrees}",
        f"u, {shown}": "{size}",
    }
    items = (
        {**line, "degrees": _degrees(line), "size": by_uncertainty(line[key], expanded[key], 1)}
        for line in (*lines, of_all, expanded)
    )
    return [table(title, columns, items)]


def _degrees(line: Content) -> str:
    degrees = line.get("degrees_of_freedom", UNSTATED)
    if degrees is None or isinstance(degrees, str):
        return "∞" if degrees is None else degrees
    return f"{degrees:.3g}" if degrees < 1000 else f"{degrees:.0f}"


def taken_words(content: Content) -> str:
    """Return how readings were taken live, empty for those that came as a table."""
    taken = content.get("taken") or {}
    if not taken.get("rig"):
        return ""
    words = f"live on the rig {taken['rig']}"
    if taken.get("operator"):
        words += f" by {taken['operator']}"
    events = [event["event"] for event in taken.get("events", ())]
    rejected = events.count("reject")
    words += f"; {rejected} series rejected and repeated" if rejected else "; nothing rejected"
    again = events.count("back")
    if again:
        words += f"; {again} single reading{'s' * (again > 1)} taken again"
    words += "; the creep was left out" * ("left out" in events)
    return words + ("; SIMULATED rig, for practice" if taken.get("simulated") else "")


def write_page(
    to: Path,
    what: str,
    document: Callable[[], Manuscript],
    others: Mapping[str, Callable[[], bytes]] | None = None,
) -> None:
    """Write a document by its suffix, .pdf or .html, or one of others; raise UnusableInput."""
    from rigapp.report.page.document import as_html
    from rigapp.report.page.pdf import as_pdf

    writers: dict[str, Callable[[], bytes]] = {
        **(others or {}),
        ".html": lambda: as_html(document()),
        ".pdf": lambda: as_pdf(document()),
    }
    writer = writers.get(to.suffix.lower())
    if writer is None:
        *first, last = writers
        raise UnusableInput("{}: a {} is {} or {}; name it so.", to, what, ", ".join(first), last)
    with whole_file(to) as part:
        part.write_bytes(writer())


def plot(
    title: str, x_label: str, x: Any, y: Any, y_label: str, names: Sequence[str] = (),
    half_widths: Any = None,
) -> Figure:  # fmt: skip
    """Return points of (n, columns) over x, or curves with a band of half widths about each.

    names: of the columns, none for one.
    """
    with canvas_of(2.3) as canvas:
        axes = canvas.subplots()
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.set_title(title, loc="left")
    for axis, middle in enumerate(y.T):
        colour, marker, style = STYLES[axis % 2]
        label = names[axis] if names else None
        if half_widths is None:
            axes.plot(x, middle, marker, color=colour, ms=3.5, mfc="none", label=label)
            continue
        half = half_widths[:, axis]
        axes.fill_between(x, middle - half, middle + half, color=colour, alpha=0.25, lw=0.0)
        axes.plot(x, middle, style, color=colour, lw=1.2, label=label)
    axes.axhline(0.0, color="#000000", lw=0.6)
    if names:
        name_curves(axes)
    return saved(canvas, title, f"{title}: largest {np.abs(y).max():.3g}.")
