"""What certificates are made of: their parts, plots and pages, the same bytes each time."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.report.page.manuscript import Figure, Manuscript, Row, Table

Content = Mapping[str, Any]
"""The content of a record, or a part of it."""

UNSTATED = "not stated"
STYLES = (("#0072B2", "o", "-"), ("#D55E00", "s", "--"))


@dataclass(frozen=True, slots=True)
class Parts:
    """What is particular in the certificate of a subject.

    statements: method, and what the results do not say. tables: of the results. heading: of the
    figures. calibrated: the range that was calibrated, in words. conditions: rows of what was
    around. uncertainty: budgets. readings: the tables at the end.
    """

    statements: Sequence[str]
    tables: Sequence[Table]
    figures: Sequence[Figure]
    heading: str = "Residuals"
    calibrated: str = ""
    conditions: Sequence[Row] = ()
    uncertainty: Sequence[Table] = ()
    readings: Sequence[Table] = ()


def budget_table(title: str, result: Content, unit: str, shown: str) -> Table | None:
    """Return the budget of a result: its parts with type, distribution, degrees of freedom.

    unit: in the keys of the result; shown: on the page. Records of before state names and sizes
    only.
    """
    lines = result.get("budget")
    if not lines:
        return None
    rows: list[Row] = [
        (
            one["name"],
            one.get("type", UNSTATED),
            one.get("distribution", UNSTATED),
            _degrees(one, "degrees_of_freedom"),
            f"{one[f'standard_uncertainty_{unit}']:.4g}",
        )
        for one in lines
    ]
    combined = math.hypot(*(one[f"standard_uncertainty_{unit}"] for one in lines))
    effective = _degrees(result, "effective_degrees_of_freedom")
    expanded = f"{result[f'expanded_uncertainty_{unit}']:.4g}"
    factor = f"expanded, k = {result['coverage_factor']:.2f}, about 95 %"
    rows += [("combined", "", "", effective, f"{combined:.4g}"), (factor, "", "", "", expanded)]
    return Table(
        title,
        tuple(rows),
        ("contribution", "type", "distribution", "degrees of freedom", f"u, {shown}"),
    )


def _degrees(stated: Content, key: str) -> str:
    if key not in stated:
        return UNSTATED
    degrees = stated[key]
    return "∞" if degrees is None else f"{degrees:.3g}" if degrees < 1000 else f"{degrees:.0f}"


def surroundings(settings: Content) -> list[Row]:
    """Return temperature, humidity and pressure at the calibration, as far as they are stated."""
    place = settings.get("place") or {}
    return [
        (name, UNSTATED if place.get(key) is None else f"{place[key]:g} {unit}")
        for name, key, unit in (
            ("Temperature", "temperature_degC", "°C"),
            ("Humidity", "humidity_percent", "%"),
            ("Pressure", "pressure_hPa", "hPa"),
        )
    ]


def taken_words(content: Content) -> str:
    """Return how readings were taken live, empty for those that came as a table."""
    taken = content.get("taken") or {}
    if not taken.get("rig"):
        return ""
    words = f"live on the rig {taken['rig']}"
    if taken.get("operator"):
        words += f" by {taken['operator']}"
    rejected = sum(1 for event in taken.get("events", ()) if event["event"] == "reject")
    words += f"; {rejected} series rejected and repeated" if rejected else "; nothing rejected"
    return words + ("; SIMULATED rig, for practice" if taken.get("simulated") else "")


def write_page(
    to: Path,
    what: str,
    document: Callable[[], Manuscript],
    others: Mapping[str, Callable[[], bytes]] | None = None,
) -> None:
    """Write a document as its ending says, .pdf or .html, or as one of others; UnusableInput."""
    from rigapp.report.page.html import as_html
    from rigapp.report.page.pdf import as_pdf

    writers: dict[str, Callable[[], bytes]] = {
        **(others or {}),
        ".html": lambda: as_html(document()),
        ".pdf": lambda: as_pdf(document()),
    }
    writer = writers.get(to.suffix.lower())
    if writer is None:
        *first, last = writers
        raise UnusableInput(f"{to}: a {what} is {', '.join(first)} or {last}; name it so.")
    with whole_file(to) as part:
        part.write_bytes(writer())


def scatter(
    title: str, x_label: str, x: Any, residual: Any, y_label: str, names: Sequence[str] = ()
) -> Figure:
    """Return points of (n, columns) residuals over x; names: of the columns, none for one."""
    canvas, axes = _canvas(title, x_label, y_label)
    for axis in range(residual.shape[1]):
        colour, marker, _ = STYLES[axis % 2]
        label = names[axis] if names else None
        axes.plot(x, residual[:, axis], marker, color=colour, ms=3.5, mfc="none", label=label)
    axes.axhline(0.0, color="#000000", lw=0.6)
    if names:
        axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return _figure(canvas, title, f"{title}: largest {np.abs(residual).max():.3g}.")


def bands(
    title: str, x_label: str, x: Any, curves: Any, half_widths: Any, y_label: str,
    names: Sequence[str],
) -> Figure:  # fmt: skip
    """Return curves (n, columns) over x with a band about each."""
    canvas, axes = _canvas(title, x_label, y_label)
    for axis in range(curves.shape[1]):
        colour, _, style = STYLES[axis % 2]
        middle, half = curves[:, axis], half_widths[:, axis]
        axes.fill_between(x, middle - half, middle + half, color=colour, alpha=0.25, lw=0.0)
        axes.plot(x, middle, style, color=colour, lw=1.2, label=names[axis])
    axes.axhline(0.0, color="#000000", lw=0.6)
    axes.legend(fontsize=7, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return _figure(canvas, title, f"{title}: largest {np.abs(curves).max():.3g}.")


def _canvas(title: str, x_label: str, y_label: str) -> tuple[Any, Any]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas

    canvas = Canvas(figsize=(6.0, 2.6), dpi=150, layout="constrained")
    axes = canvas.add_subplot()
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.set_title(title, fontsize=9)
    FigureCanvasAgg(canvas)
    return canvas, axes


def _figure(canvas: Any, title: str, words: str) -> Figure:
    stream = io.BytesIO()
    canvas.savefig(stream, format="png", metadata={"Software": None})
    return Figure(title, stream.getvalue(), words)
