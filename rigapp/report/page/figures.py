"""Figures of documents: common style, names at the curves, vector graphics."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any

import numpy as np

from rigapp.presentation.numbers import grouped
from rigapp.presentation.tokens import LIGHT
from rigapp.presentation.translation import tr
from rigapp.report.page.document import Figure

WIDTH_IN = 178.0 / 25.4
"""Width of two columns of a journal, 178 mm; one is 86 mm."""
DPI = 200  # of a printed page at reading distance
TITLE_IN, AXIS_IN = 0.25, 0.42
LEFT_IN, NAMES_IN = 0.72, 1.1
"""Margins for numbers and caption of the vertical axis, and for the names of the curves."""

INK, MUTED = LIGHT.text, LIGHT.muted
FIRST, SECOND, MODEL, OTHER = (LIGHT.curves[name] for name in ("first", "second", "model", "other"))
MODEL_LINE: Mapping[str, Any] = {"color": MODEL, "ls": (0, (4, 2)), "lw": 1.1}

STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.0,
    "axes.linewidth": 0.6,
    "axes.edgecolor": MUTED,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": LIGHT.grid,
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.1,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "svg.hashsalt": "rigapp",
    "pdf.fonttype": 42,  # embed TrueType fonts, so that text can be copied and searched
    "path.simplify": True,
}
NAME_PT = 7.5
"""Font size of the names at the curves; their line spacing is a quarter larger."""

_METADATA: Mapping[str, dict[str, None]] = {
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    "png": {"Software": None},
}
"""Format -> metadata with date and version that matplotlib would otherwise add."""


@contextmanager
def in_style() -> Iterator[None]:
    """Apply the style of documents to matplotlib, without the user's settings."""
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        yield


@contextmanager
def canvas_of(height_in: float, width_in: float = WIDTH_IN) -> Iterator[Any]:
    """Yield a matplotlib figure in the style of documents, with common margins."""
    from matplotlib.figure import Figure as Canvas

    with in_style():
        canvas = Canvas(figsize=(width_in, height_in))
        canvas.subplots_adjust(
            left=LEFT_IN / width_in,
            right=1.0 - NAMES_IN / width_in,
            top=1.0 - TITLE_IN / height_in,
            bottom=AXIS_IN / height_in,
        )
        yield canvas


def saved(canvas: Any, title: str, words: str, caption: str = "") -> Figure:
    """Convert a drawn canvas into a figure of a document."""
    return Figure(title, partial(_rendered, canvas), words, caption)


def _rendered(canvas: Any, kind: str, width_mm: float | None = None) -> bytes:
    """Return a canvas in a format of ``Figure.draw``; None: its own width."""
    stream = io.BytesIO()
    kind, _, text = kind.partition(" with ")
    with in_style():
        if text:
            import matplotlib

            matplotlib.rcParams["svg.fonttype"] = "none"
        if width_mm is not None:
            width_in, margins = width_mm / 25.4, canvas.subplotpars
            before = canvas.get_figwidth()
            canvas.set_figwidth(width_in)
            # The margins for numbers and names keep their widths.
            canvas.subplots_adjust(
                left=margins.left * before / width_in,
                right=1.0 - (1.0 - margins.right) * before / width_in,
            )
        canvas.savefig(stream, format=kind, dpi=DPI, metadata=_METADATA[kind])
    return stream.getvalue()


def revolution_axis(axes: Any) -> None:
    """Format an axis for revolutions, from edge to edge."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: grouped(round(x))))
    axes.set_xlabel(tr("revolution"))
    axes.margins(x=0.01)


def name_curves(axes: Any) -> None:
    """Write the name of each labelled curve at its right end, in its colour, without overlap.

    To be called when the limits of the axes are final.
    """
    handles, names = axes.get_legend_handles_labels()
    low, high = axes.get_ylim()
    log = axes.get_yscale() == "log"
    wanted = [_share(_end_of(handle), low, high, log) for handle in handles]
    points = 72.0 * axes.get_figure().get_figheight() * axes.get_position().height
    line = 1.25 * NAME_PT / points
    heights = [line * (1 + name.count("\n")) for name in names]
    for handle, name, at in zip(handles, names, _apart(wanted, heights), strict=True):
        axes.text(
            1.015, at, name, color=_colour_of(handle), fontsize=NAME_PT, transform=axes.transAxes,
            ha="left", va="center", linespacing=1.1,
        )  # fmt: skip


def _share(value: float, low: float, high: float, log: bool) -> float:
    """Return the height of a value between the limits of its axis, 0 to 1."""
    if log:
        value, low, high = (math.log10(max(number, 1e-300)) for number in (value, low, high))
    share = (value - low) / (high - low) if high != low else 0.5
    return min(1.0, max(0.0, share)) if math.isfinite(share) else 0.0


def _parts(handle: Any) -> Any:
    """Return the artist of a curve; for points with error bars, that of the points."""
    return handle[0] if isinstance(handle, tuple) else handle


def _end_of(handle: Any) -> float:
    """Return the last known value of a curve, or the middle of a band's end; NaN without one."""
    part = _parts(handle)
    if hasattr(part, "get_ydata"):
        values = np.asarray(part.get_ydata(), dtype=np.float64)
        known = values[np.isfinite(values)]
        vertical = len(set(np.asarray(part.get_xdata()).tolist())) == 1 and values.size > 1
        return float(known[-1]) if known.size and not vertical else math.nan
    paths = part.get_paths() if hasattr(part, "get_paths") else []
    if not paths:
        return math.nan
    corners = paths[-1].vertices
    last = corners[corners[:, 0] >= np.nanmax(corners[:, 0])]
    return float(np.mean(last[:, 1]))


def _colour_of(handle: Any) -> Any:
    part = _parts(handle)
    if hasattr(part, "get_color"):
        return part.get_color()
    return (*part.get_facecolor()[0][:3], 1.0)


def _apart(wanted: Sequence[float], heights: Sequence[float]) -> list[float]:
    """Return positions near the wanted ones without overlap.

    First each is moved up by the one below it; then those beyond the axes move the others down.
    """
    positions = [0.0 if math.isnan(height) else height for height in wanted]
    order = sorted(range(len(positions)), key=lambda index: positions[index])
    floor = -math.inf
    for index in order:
        half = heights[index] / 2.0
        positions[index] = max(positions[index], floor + half)
        floor = positions[index] + half
    ceiling = max(1.0, min(floor, 1.0 + heights[order[-1]] / 2.0)) if order else 1.0
    for index in reversed(order):
        half = heights[index] / 2.0
        positions[index] = min(positions[index], ceiling - half)
        ceiling = positions[index] - half
    return positions
