"""The control charts of the daily checks, as a picture or a page."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np

from rigapp.calibrating.certificates.parts import write_page
from rigapp.calibrating.daily_history import CHARTED, DailyHistory, verdict_lines, when
from rigapp.report.page.manuscript import Figure, Manuscript, Section, Table, Text

BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#666666"


def write_chart(found: DailyHistory, to: Path) -> None:
    """Write the charts as .png, .html or .pdf; raise UnusableInput."""
    write_page(to, "chart", lambda: document(found), {".png": lambda: draw(found)})


def document(found: DailyHistory) -> Manuscript:
    """Compose the page: verdict, charts, table."""
    rows = tuple(
        (
            when(one),
            f"{one['sensitivity_ratio']:.5f}",
            f"{one['cross_talk_ratio']:+.5f}",
            f"{one['largest_N']:.2f}",
            "passed" if one["passed"] else "failed",
            str(one["operator"]),
        )
        for one in found.entries
    )
    head = ("when (UTC)", "sensitivity", "cross-talk", "largest N", "verdict", "operator")
    words = tuple(Text(line) for line in verdict_lines(found))
    return Manuscript(
        title=f"Daily checks of {found.entries[-1]['rig']}",
        footer="Control chart of the daily checks",
        sections=(
            Section("", words),
            Section("Charts", (Figure("Gains, cross-talk and zeros", draw(found), words[0].text),)),
            Section("Checks", (Table("Checks with the calibration in use", rows, head),)),
        ),
        closing="Sensitivity, gain: felt over applied force. Cross-talk: share felt across the"
        " weight, or by one axis of a force along the other. Zero: less that of the calibration.",
    )


def draw(found: DailyHistory) -> bytes:
    """Return the charts as PNG."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure as Canvas
    from matplotlib.ticker import MaxNLocator

    columns = 2 if len(found.charts) > 2 else 1
    rows = -(-len(found.charts) // columns)
    canvas = Canvas(figsize=(7.5, 2.2 * rows + 0.4), dpi=120, layout="constrained")
    for place, (name, one) in enumerate(found.charts.items(), 1):
        of_zero = CHARTED[name].of_zero
        axes = canvas.add_subplot(rows, columns, place)
        count = np.arange(1, len(one.values) + 1)
        axes.plot(count, one.values, "-o", color=BLUE, ms=4, lw=1, label="checks")
        if one.findings:
            axes.plot(count[-1:], one.values[-1:], "s", color=ORANGE, ms=9, mfc="none",
                      mew=1.8, label="see the words")  # fmt: skip
        axes.axhline(one.promised, color=GREY, lw=1.0)
        if one.expanded is not None:
            words = "allowed" if of_zero else "U of the calibration"
            axes.axhspan(one.promised - one.expanded, one.promised + one.expanded, color=GREY,
                         alpha=0.15, label=words)  # fmt: skip
        if one.limits is not None:
            for limit in one.limits:
                axes.axhline(limit, color=ORANGE, ls="--", lw=1.0)
            axes.plot([], [], "--", color=ORANGE, label="limits of the history")
        axes.set_title(CHARTED[name].words + (" (N)" if of_zero else ""), fontsize=9, loc="left")
        axes.set_xlabel("check")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.legend(fontsize=6, loc="best")
    FigureCanvasAgg(canvas)
    stream = io.BytesIO()
    canvas.savefig(stream, format="png", metadata={"Software": None})
    return stream.getvalue()
