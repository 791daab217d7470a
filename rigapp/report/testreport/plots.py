"""The pictures of a report: measured solid, model dashed, colours that everybody can tell apart."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any

import numpy as np

from rigapp.presentation.numbers import grouped
from rigapp.report.page.manuscript import Figure
from rigapp.report.testreport.envelope import envelope
from rigapp.report.testreport.facts import ChannelFacts, Gap
from rigapp.report.testreport.model_facts import Agreement, CyclePicture
from rigapp.report.testreport.uncertainty import Stated
from rigapp.report.testreport.wording import number, quantity, symbol, title_of
from rigapp.schema.channels import Channel
from rigapp.storage import StoredCycle, Trip
from rigapp_calibration.load_cell.force_uncertainty import ForceUncertainty

WIDTH_IN = 7.2
DPI = 200  # of a printed page at arm's length
TITLE_IN, AXIS_IN = 0.25, 0.4
PANEL_IN, BETWEEN_IN = 1.1, 0.3
COLOURS = {
    "force": "#000000",
    "force_1": "#0072B2",
    "force_2": "#009E73",
    "probe_1": "#0072B2",
    "probe_2": "#009E73",
    "max": "#0072B2",
    "rms": "#000000",
    "min": "#009E73",
    "value": "#0072B2",
}
MODEL = "#D55E00"
DRIVEN = "#CC79A7"
GAP = "#E69F00"
MODEL_LINE: Mapping[str, Any] = {"color": MODEL, "ls": (0, (4, 2)), "lw": 1.1}
DEPTHS: Mapping[str, tuple[Mapping[str, Any], str, str]] = {
    "measured_wear_depth": ({"color": COLOURS["force"]}, "measured", "measured"),
    "wear_depth": (MODEL_LINE, "model", "predicted"),
    "driven_wear_depth": (
        {"color": DRIVEN, "ls": "-.", "lw": 1.1},
        "model by\nmeasured\nforces",
        "by the measured forces",
    ),
}
"""Depth of wear -> how it is drawn, its label, how it is told."""
GAPS_SHOWN = 40  # more would hide the curves
BAND_WORDS = "Shaded: the expanded uncertainty of a force by the calibration."
STATED_WORDS = "Shaded: the expanded uncertainty of a value by the calibration."
SHORT = {
    "force": "|F|",
    "force_1": "force_1",
    "force_2": "force_2",
    "probe_1": "probe_1",
    "probe_2": "probe_2",
    "max": "maximum",
    "rms": "RMS",
    "min": "minimum",
    "value": "value",
    "speed": "speed",
}
RESIDUAL_OF = {
    "force": "residual_rms",
    "force_1": "residual_1_rms",
    "force_2": "residual_2_rms",
}
STYLE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8.0,
    "axes.titlesize": 8.5,
    "axes.labelsize": 8.0,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "lines.linewidth": 1.1,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "svg.hashsalt": "rigapp",
    "path.simplify": True,
}


@contextmanager
def canvas_of(height_in: float) -> Iterator[Any]:
    """Yield a matplotlib figure in the report's style; its margins are the same in all."""
    import matplotlib
    from matplotlib.figure import Figure as Canvas

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        canvas = Canvas(figsize=(WIDTH_IN, height_in))
        canvas.subplots_adjust(
            left=0.105,
            right=0.84,
            top=1.0 - TITLE_IN / height_in,
            bottom=AXIS_IN / height_in,
        )
        yield canvas


def _height(panels: int) -> float:
    return TITLE_IN + AXIS_IN + panels * PANEL_IN + (panels - 1) * BETWEEN_IN


def _panels(canvas: Any, number: int) -> Sequence[Any]:
    """Return panels below each other over one axis, with room for a title each."""
    space = {"hspace": BETWEEN_IN / PANEL_IN}
    return tuple(canvas.subplots(number, 1, sharex=True, squeeze=False, gridspec_kw=space)[:, 0])


def saved(canvas: Any, title: str, words: str, caption: str, vector: bool) -> Figure:
    """Return a drawn canvas as a figure of a document: SVG when vector, else PNG."""
    stream = io.BytesIO()
    if vector:
        canvas.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
        return Figure(title, stream.getvalue(), words, "image/svg+xml", caption)
    canvas.savefig(stream, format="png", dpi=DPI, metadata={"Software": None})
    return Figure(title, stream.getvalue(), words, "image/png", caption)


def revolution_axis(axes: Any) -> None:
    """Let an axis count revolutions, from edge to edge."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: grouped(round(x))))
    axes.set_xlabel("revolution")
    axes.margins(x=0.01)


def _draw(axes: Any, line: tuple[Any, Any], **style: Any) -> None:
    marker = {"marker": "o", "ms": 3} if len(line[0]) == 1 else {}
    axes.plot(*line, **{**marker, **style})


def _mark_gaps(axes: Any, gaps: Sequence[Gap]) -> None:
    for place, gap in enumerate(gaps[:GAPS_SHOWN]):
        begin, end = gap.revolution - gap.missing - 0.5, gap.revolution - 0.5
        axes.axvspan(begin, end, color=GAP, alpha=0.3, lw=0)
        axes.axvline(end, color=GAP, lw=1.2, ls=":", label="data missing" if not place else None)


def trends(
    channels: Sequence[ChannelFacts],
    agreement: Agreement | None,
    gaps: Sequence[Gap],
    title: str,
    vector: bool,
    uncertainty: ForceUncertainty | None = None,
    stated: Stated = MappingProxyType({}),
) -> Figure:
    """Draw maximum, RMS and minimum of channels against revolution, one panel a channel.

    uncertainty, stated: of forces and of other channels; drawn as a band about the largest and the
    smallest value.
    """
    predicted = agreement.lines if agreement is not None else {}
    with canvas_of(_height(len(channels))) as canvas:
        panels = _panels(canvas, len(channels))
        zoomed = False
        whole = next((one.lines["max"] for one in channels if one.name == "force"), None)
        for axes, channel in zip(panels, channels, strict=True):
            _mark_gaps(axes, gaps)
            if uncertainty is not None and channel.unit == "N":
                for one in ("max", "min"):
                    x, values = channel.lines[one]
                    # An error of the angle turns the whole force into a component.
                    force = values if whole is None else np.interp(x, whole[0], whole[1])
                    doubt = uncertainty.at(force, of_magnitude=channel.name == "force")
                    _band(axes, x, values, doubt, COLOURS[one])
            of_channel = stated.get(channel.name)
            if of_channel is not None:
                for one in ("max", "min"):
                    _band(axes, *channel.lines[one], of_channel, COLOURS[one])
            with_model = False
            negative = channel.smallest.value < 0.0 and channel.overall > max(
                0.0, channel.largest.value
            )
            for one, (x, values) in channel.lines.items():
                turned = one == "rms" and negative
                label = "−RMS" if turned else SHORT[one]
                _draw(axes, (x, -values if turned else values), color=COLOURS[one], label=label)
            for one in ("max", "rms", "min"):
                line = predicted.get(f"{channel.name}_{one}")
                if line is not None and np.isfinite(line[1]).any():
                    _draw(axes, line, **MODEL_LINE, label=None if with_model else "model")
                    with_model = True
            zoomed |= _leave_out_unsteady(axes, channel)
            axes.set_title(title_of(channel.channel), loc="left")
            short = SHORT.get(channel.name, "")
            axes.set_ylabel(f"{short} ({symbol(channel.unit)})".lstrip())
            axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        revolution_axis(panels[-1])
        words = f"{title}: " + " ".join(
            f"{title_of(one.channel)} between {number(one.smallest.value, one.unit)} and "
            f"{quantity(one.largest.value, one.unit)}."
            for one in channels
        )
        sampled = any("max" in one.lines for one in channels)
        caption = "Maximum, RMS and minimum" if sampled else "The newest value at the end"
        caption += " of every revolution, measured (solid)"
        model = any(f"{one.name}_max" in predicted for one in channels)
        caption += " and by the model (dashed)." if model else "."
        if uncertainty is not None:
            caption += f" {BAND_WORDS}"
        if any(one.name in stated for one in channels):
            caption += f" {STATED_WORDS}"
        if zoomed:
            caption += " Revolutions in which the speed changed may lie outside the scale."
        return saved(canvas, title, words, caption, vector)


def _band(axes: Any, x: Any, values: Any, doubt: Any, colour: str, alpha: float = 0.2) -> None:
    """Shade an expanded uncertainty about its curve."""
    axes.fill_between(x, values - doubt, values + doubt, color=colour, alpha=alpha, lw=0)


def _leave_out_unsteady(axes: Any, channel: ChannelFacts) -> bool:
    """Keep a start or a pause from flattening the curves; True when something is out of sight."""
    if channel.steady is None:
        return False
    low, high = channel.steady
    drawn_low, drawn_high = axes.get_ylim()
    margin = 0.08 * (high - low) or 0.05 * abs(high) or 1.0
    if drawn_high - drawn_low < 1.6 * (high - low + 2 * margin):
        return False
    axes.set_ylim(low - margin, high + margin)
    return channel.smallest.value < low or channel.largest.value > high


def residual_trend(agreement: Agreement, gaps: Sequence[Gap], vector: bool) -> Figure:
    """Draw the agreement with the model against revolution."""
    found = {one.name: one for one in agreement.residuals}
    with canvas_of(_height(2)) as canvas:
        upper, lower = _panels(canvas, 2)
        for axes in (upper, lower):
            _mark_gaps(axes, gaps)
        for channel, name in RESIDUAL_OF.items():
            if name in found:
                _draw(upper, found[name].line, color=COLOURS[channel], label=SHORT[channel])
        upper.set_ylim(bottom=0.0)
        upper.set_ylabel("residual RMS (N)")
        upper.set_title("measured minus model, RMS over a revolution", loc="left")
        upper.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        if "phase_shift" in found:
            _draw(lower, found["phase_shift"].line, color=COLOURS["force"])
        lower.axhline(0.0, color="#777777", lw=0.6)
        lower.set_ylabel("phase shift (°)")
        lower.set_title("shift of the measured |F| against the model", loc="left")
        revolution_axis(lower)
        words = "Agreement with the model: " + " ".join(
            f"{name.replace('_', ' ')}: mean {quantity(one.mean, one.unit, 2)}, last "
            f"{quantity(one.last, one.unit, 2)}."
            for name, one in found.items()
        )
        return saved(canvas, "Agreement with the model", words, "", vector)


def wear_trend(agreement: Agreement, gaps: Sequence[Gap], vector: bool) -> Figure | None:
    """Draw wear depth against revolution; None when none is known."""
    known = [(agreement.wear[name], *how) for name, how in DEPTHS.items()]
    if all(found is None for found, *_ in known):
        return None
    with canvas_of(2.6) as canvas:
        axes = canvas.subplots()
        _mark_gaps(axes, gaps)
        words = []
        for found, style, label, said in known:
            if found is not None:
                x, y = found.line
                _draw(axes, (x, 1e3 * y), **style, label=label)
                words.append(f"{said} {quantity(1e3 * found.depth, 'um')} at the end")
        axes.set_ylabel("wear depth (µm)")
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        revolution_axis(axes)
        caption = "From the probes (solid), by the model (dashed), by the model from the measured"
        caption += " forces (dash-dotted); what is unknown is not drawn."
        told = f"Wear depth against revolution: {'; '.join(words)}."
        return saved(canvas, "Wear depth", told, caption, vector)


def trip(found: Trip, cycle: StoredCycle, vector: bool) -> Figure:
    """Draw |F| of the revolution in which a test tripped over that of the one before."""
    force, angle = cycle.columns["force"], cycle.columns["angle"]
    told = f"revolution {grouped(found.revolution)}"
    if found.peak is not None:
        told += f", up to {found.peak.sign}{quantity(found.peak.value_N, 'N')}"
        told += f" at {found.peak.angle_deg:.0f}°"
    with canvas_of(2.6) as canvas:
        axes = canvas.subplots()
        if found.before is not None:
            before = found.before.columns
            label = f"revolution\n{grouped(found.before.revolution)}"
            axes.plot(before["angle"], before["force"], color="#999999", lw=0.9, label=label)
            told += f"; grey: revolution {grouped(found.before.revolution)}, before it"
        label = f"revolution\n{grouped(found.revolution)}"
        axes.plot(angle, force, color=COLOURS["force"], label=label)
        if found.peak is not None:
            axes.plot(found.peak.angle_deg, found.peak.value_N, "o", color=MODEL, ms=4.0)
        axes.set_xlim(0.0, 360.0)
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel("crank angle (°)")
        axes.set_ylabel("|F| (N)")
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        title = "The revolution in which the test tripped"
        return saved(canvas, title, f"Joint force of {told}.", "", vector)


def cycles(
    pictures: Sequence[CyclePicture], vector: bool, uncertainty: ForceUncertainty | None = None
) -> Figure:
    """Draw whole cycles side by side: forces with the model, residual, displacement."""

    def force_panel(axes: Any, picture: CyclePicture) -> None:
        _force_panel(axes, picture, uncertainty)

    def residual_panel(axes: Any, picture: CyclePicture) -> None:
        _residual_panel(axes, picture, uncertainty)

    rows: list[tuple[str, Callable[[Any, CyclePicture], None]]] = [("force (N)", force_panel)]
    if any(one.residual for one in pictures):
        rows.append(("measured −\nmodel (N)", residual_panel))
    if any("probe_1" in one.columns for one in pictures):
        rows.append(("pin, less its\nmean (µm)", _probe_panel))
    heights = [2.4 if draw is force_panel else 1.5 for _, draw in rows]
    caption = _cycle_caption(pictures)
    if uncertainty is not None:
        caption += f" {BAND_WORDS}"
    which = {1: "the only one", 2: "first and last", 3: "first, middle and last"}
    title = f"Whole cycles, {which[len(pictures)]}"
    return _cycle_grid(pictures, rows, heights, title, _cycle_words(pictures), caption, vector)


def free_cycles(
    pictures: Sequence[CyclePicture], channels: Sequence[Channel], vector: bool
) -> Figure:
    """Draw whole cycles of free channels side by side, one line of panels a channel."""

    def panel(name: str) -> Callable[[Any, CyclePicture], None]:
        def draw(axes: Any, picture: CyclePicture) -> None:
            _curve(axes, picture, picture.columns[name], color=COLOURS["value"], label="measured")

        return draw

    rows = [
        (f"{textwrap.fill(one.name.replace('_', ' '), 14)}\n({symbol(one.unit)})", panel(one.name))
        for one in channels
    ]
    title = f"Whole cycles of {', '.join(one.name for one in channels)}"
    words = " ".join(
        f"Revolution {picture.revolution}: {title_of(one)} between "
        f"{number(float(picture.columns[one.name].min()), one.unit)} and "
        f"{quantity(float(picture.columns[one.name].max()), one.unit)}."
        for picture in pictures
        for one in channels
    )
    return _cycle_grid(pictures, rows, [1.5] * len(rows), title, words, "", vector)


def _cycle_grid(
    pictures: Sequence[CyclePicture],
    rows: Sequence[tuple[str, Callable[[Any, CyclePicture], None]]],
    heights: Sequence[float],
    title: str,
    words: str,
    caption: str,
    vector: bool,
) -> Figure:
    """Draw a column of panels a cycle; rows: label and what draws it. heights: of these, inches."""
    with canvas_of(0.55 + sum(heights)) as canvas:
        grid = canvas.subplots(
            len(rows), len(pictures), sharex=True, sharey="row", squeeze=False,
            height_ratios=heights, gridspec_kw={"hspace": 0.14, "wspace": 0.07},
        )  # fmt: skip
        for (label, draw), line in zip(rows, grid, strict=True):
            for axes, picture in zip(line, pictures, strict=True):
                draw(axes, picture)
            line[0].set_ylabel(label)
            line[-1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        for axes, picture in zip(grid[0], pictures, strict=True):
            axes.set_title(f"revolution {grouped(picture.revolution)}")
        for axes in grid[-1]:
            axes.set_xlabel("crank angle (°)")
            axes.set_xticks(range(0, 360, 90))
            axes.set_xlim(0, 360)
        return saved(canvas, title, words, caption, vector)


def _cycle_words(pictures: Sequence[CyclePicture]) -> str:
    parts = []
    for one in pictures:
        force = one.columns["force"]
        text = f"Revolution {one.revolution}: |F| between {number(float(force.min()), 'N')} and "
        text += quantity(float(force.max()), "N")
        if "force" in one.residual:
            text += (
                f", largest residual {quantity(float(np.abs(one.residual['force']).max()), 'N')}"
            )
        parts.append(text + ".")
    return " ".join(parts)


def _cycle_caption(pictures: Sequence[CyclePicture]) -> str:
    if not any(one.model for one in pictures):
        return "Measured (solid). No prediction is saved for these cycles."
    text = "Measured (solid) and by the model (dashed)."
    others = [
        f"revolution {one.revolution} is compared with the prediction for {one.model_revolution}"
        for one in pictures
        if one.model_revolution is not None and one.model_revolution != one.revolution
    ]
    without = [str(one.revolution) for one in pictures if not one.model]
    if without:
        others.append(f"no prediction is saved for revolution {', '.join(without)}")
    return f"{text} {'; '.join(others).capitalize()}." if others else text


def _curve(axes: Any, picture: CyclePicture, values: Any, **style: Any) -> None:
    axes.plot(*envelope(picture.columns["angle"], values), **style)


def _force_panel(axes: Any, picture: CyclePicture, uncertainty: ForceUncertainty | None) -> None:
    for name in ("force", "force_1", "force_2"):
        if uncertainty is not None:
            angle = picture.columns["angle"]
            x, values = envelope(angle, picture.columns[name])
            force = np.interp(x, angle, picture.columns["force"])
            doubt = uncertainty.at(force, of_magnitude=name == "force")
            _band(axes, x, values, doubt, COLOURS[name], 0.15)
        _curve(axes, picture, picture.columns[name], color=COLOURS[name], label=SHORT[name])
    label = "model"
    for name in ("force", "force_1", "force_2"):
        if name in picture.model:
            axes.plot(picture.model["angle"], picture.model[name], **MODEL_LINE, label=label)
            label = ""


def _residual_panel(axes: Any, picture: CyclePicture, uncertainty: ForceUncertainty | None) -> None:
    if uncertainty is not None:
        doubt = uncertainty.at(picture.columns["force"])
        x, high = envelope(picture.columns["angle"], doubt)
        axes.fill_between(x, -high, high, color=COLOURS["force"], alpha=0.12, lw=0)
    axes.axhline(0.0, color="#777777", lw=0.6)
    for name in ("force", "force_1", "force_2"):
        if name in picture.residual:
            style = {"color": COLOURS[name], "lw": 0.6, "label": SHORT[name]}
            _curve(axes, picture, picture.residual[name], **style)
        else:
            axes.plot([], [], color=COLOURS[name], label=SHORT[name])


def _probe_panel(axes: Any, picture: CyclePicture) -> None:
    means = []
    for name in ("probe_1", "probe_2"):
        values = picture.columns[name]
        mean = float(np.mean(values))
        means.append(number(mean, "um"))
        _curve(axes, picture, values - mean, color=COLOURS[name], label=SHORT[name])
    axes.set_title(f"means {', '.join(means)} µm", fontsize=7.0, loc="right", pad=2.0)
