"""Figures of a report: measured solid, model dashed, distinguishable colours."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np

from rigapp.presentation.numbers import grouped
from rigapp.presentation.translation import Text, tr
from rigapp.report.page.document import Figure
from rigapp.report.page.figures import (
    AXIS_IN,
    FIRST,
    INK,
    MODEL,
    MODEL_LINE,
    MUTED,
    OTHER,
    SECOND,
    TITLE_IN,
    canvas_of,
    name_curves,
    revolution_axis,
    saved,
)
from rigapp.report.testreport.envelope import envelope
from rigapp.report.testreport.facts import ChannelFacts, Gap, Stated
from rigapp.report.testreport.formatting import number, quantity, symbol, title_of
from rigapp.report.testreport.model_facts import Agreement, CyclePicture, LastDepth
from rigapp.schema.channels import Channel
from rigapp.storage import TripCapture
from rigapp.texts import capitalised
from rigapp_calibration.load_cell.force_uncertainty import ForceUncertainty

PANEL_IN, BETWEEN_IN = 0.88, 0.3
COLOURS = {
    "force": INK,
    "force_1": FIRST,
    "force_2": SECOND,
    "probe_1": FIRST,
    "probe_2": SECOND,
    "max": FIRST,
    "rms": INK,
    "min": SECOND,
    "value": FIRST,
}
DRIVEN = OTHER
GAP = "#E69F00"
DEPTHS: Mapping[str, tuple[Mapping[str, Any], str, str]] = {
    "measured_wear_depth": ({"color": COLOURS["force"]}, "measured", "measured"),
    "wear_depth": (MODEL_LINE, "model", "predicted"),
    "driven_wear_depth": (
        {"color": DRIVEN, "ls": "-.", "lw": 1.1},
        "model by\nmeasured\nforces",
        "by the measured forces",
    ),
}
"""Wear depth -> style, label, and name in the description."""
GAPS_SHOWN = 40  # more would hide the curves
BAND_WORDS: Text = "Shaded: the expanded uncertainty of a force by the calibration."
STATED_WORDS: Text = "Shaded: the expanded uncertainty of a value by the calibration."
SHORT: dict[str, Text] = {
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


def _height(panels: int) -> float:
    return TITLE_IN + AXIS_IN + panels * PANEL_IN + (panels - 1) * BETWEEN_IN


def _panels(canvas: Any, number: int) -> Sequence[Any]:
    """Return panels below each other with a common axis, each with room for a title."""
    space = {"hspace": BETWEEN_IN / PANEL_IN}
    return tuple(canvas.subplots(number, 1, sharex=True, squeeze=False, gridspec_kw=space)[:, 0])


def _draw(axes: Any, line: tuple[Any, Any], **style: Any) -> None:
    marker = {"marker": "o", "ms": 3} if len(line[0]) == 1 else {}
    axes.plot(*line, **{**marker, **style})


def _mark_gaps(axes: Any, gaps: Sequence[Gap]) -> None:
    for index, gap in enumerate(gaps[:GAPS_SHOWN]):
        begin, end = gap.revolution - gap.missing - 0.5, gap.revolution - 0.5
        axes.axvspan(begin, end, color=GAP, alpha=0.3, lw=0)
        axes.axvline(
            end, color=GAP, lw=1.2, ls=":", label=tr("data missing") if not index else None
        )


def trends(
    channels: Sequence[ChannelFacts],
    agreement: Agreement | None,
    gaps: Sequence[Gap],
    title: str,
    uncertainty: ForceUncertainty | None = None,
    stated: Stated = MappingProxyType({}),
) -> Figure:
    """Draw maximum, RMS and minimum of channels against revolution, one panel per channel.

    uncertainty, stated: of forces and of other channels; drawn as a band around the largest and the
    smallest value.
    """
    predicted = agreement.lines if agreement is not None else {}
    with canvas_of(_height(len(channels))) as canvas:
        panels = _panels(canvas, len(channels))
        zoomed = False
        of_force = next((c.lines["max"] for c in channels if c.name == "force"), None)
        for axes, channel in zip(panels, channels, strict=True):
            _mark_gaps(axes, gaps)
            if uncertainty is not None and channel.unit == "N":
                for statistic in ("max", "min"):
                    x, values = channel.lines[statistic]
                    # An error of the angle projects the total force onto a component.
                    force = values if of_force is None else np.interp(x, *of_force)
                    doubt = uncertainty.at(force, of_magnitude=channel.name == "force")
                    _band(axes, x, values, doubt, COLOURS[statistic])
            of_channel = stated.get(channel.name)
            if of_channel is not None:
                for statistic in ("max", "min"):
                    _band(axes, *channel.lines[statistic], of_channel, COLOURS[statistic])
            with_model = False
            negative = channel.smallest.value < 0.0 and channel.overall > max(
                0.0, channel.largest.value
            )
            for statistic, (x, values) in channel.lines.items():
                turned = statistic == "rms" and negative
                label = tr("−RMS") if turned else tr(SHORT[statistic])
                _draw(
                    axes, (x, -values if turned else values), color=COLOURS[statistic], label=label
                )
            for statistic in ("max", "rms", "min"):
                line = predicted.get(f"{channel.name}_{statistic}")
                if line is not None and np.isfinite(line[1]).any():
                    _draw(axes, line, **MODEL_LINE, label=None if with_model else "model")
                    with_model = True
            zoomed |= _leave_out_unsteady(axes, channel)
            axes.set_title(title_of(channel.channel), loc="left")
            short = tr(SHORT.get(channel.name, ""))
            axes.set_ylabel(f"{short} ({symbol(channel.unit)})".lstrip())
            name_curves(axes)
        revolution_axis(panels[-1])
        words = f"{title}: " + " ".join(
            f"{title_of(channel.channel)} between {number(channel.smallest.value, channel.unit)}"
            f" and {quantity(channel.largest.value, channel.unit)}."
            for channel in channels
        )
        sampled = any("max" in channel.lines for channel in channels)
        caption = tr("Maximum, RMS and minimum") if sampled else tr("The newest value at the end")
        caption += tr(" of every revolution, measured (solid)")
        model = any(f"{channel.name}_max" in predicted for channel in channels)
        caption += tr(" and by the model (dashed).") if model else "."
        if uncertainty is not None:
            caption += f" {BAND_WORDS}"
        if any(channel.name in stated for channel in channels):
            caption += f" {STATED_WORDS}"
        if zoomed:
            caption += tr(" Revolutions in which the speed changed may lie outside the scale.")
        return saved(canvas, title, words, caption)


def _band(axes: Any, x: Any, values: Any, half: Any, colour: str, alpha: float = 0.2) -> None:
    """Shade an expanded uncertainty around its curve."""
    axes.fill_between(x, values - half, values + half, color=colour, alpha=alpha, lw=0)


def _leave_out_unsteady(axes: Any, channel: ChannelFacts) -> bool:
    """Exclude starts and pauses from the range of the axis; return True when values are hidden."""
    if channel.steady is None:
        return False
    low, high = channel.steady
    drawn_low, drawn_high = axes.get_ylim()
    margin = 0.08 * (high - low) or 0.05 * abs(high) or 1.0
    if drawn_high - drawn_low < 1.6 * (high - low + 2 * margin):
        return False
    axes.set_ylim(low - margin, high + margin)
    return channel.smallest.value < low or channel.largest.value > high


def residual_trend(agreement: Agreement, gaps: Sequence[Gap]) -> Figure:
    """Draw the agreement with the model against revolution."""
    residuals = {residual.name: residual for residual in agreement.residuals}
    with canvas_of(_height(2)) as canvas:
        upper, lower = _panels(canvas, 2)
        for axes in (upper, lower):
            _mark_gaps(axes, gaps)
        for channel, name in RESIDUAL_OF.items():
            if name in residuals:
                _draw(upper, residuals[name].line, color=COLOURS[channel], label=tr(SHORT[channel]))
        upper.set_ylim(bottom=0.0)
        upper.set_ylabel(tr("residual RMS (N)"))
        upper.set_title(tr("measured minus model, RMS over a revolution"), loc="left")
        name_curves(upper)
        if "phase_shift" in residuals:
            _draw(lower, residuals["phase_shift"].line, color=COLOURS["force"])
        lower.axhline(0.0, color="#777777", lw=0.6)
        lower.set_ylabel(tr("phase shift (°)"))
        lower.set_title(tr("shift of the measured |F| against the model"), loc="left")
        revolution_axis(lower)
        words = tr("Agreement with the model: ") + " ".join(
            f"{name.replace('_', ' ')}: mean {quantity(residual.mean, residual.unit, 2)}, last "
            f"{quantity(residual.last, residual.unit, 2)}."
            for name, residual in residuals.items()
        )
        return saved(canvas, tr("Agreement with the model"), words, "")


def wear_trend(wear: Mapping[str, LastDepth | None], gaps: Sequence[Gap]) -> Figure | None:
    """Draw wear depth against revolution; None without known depths."""
    known = [(wear[name], *how) for name, how in DEPTHS.items()]
    if all(last is None for last, *_ in known):
        return None
    with canvas_of(2.1) as canvas:
        axes = canvas.subplots()
        _mark_gaps(axes, gaps)
        words = []
        for last, style, label, subject in known:
            if last is not None:
                x, y = last.line
                if last.doubt is not None:
                    half = np.interp(x, *last.doubt)
                    axes.fill_between(
                        x,
                        1e3 * (y - half),
                        1e3 * (y + half),
                        color=style["color"],
                        alpha=0.15,
                        lw=0,
                    )
                _draw(axes, (x, 1e3 * y), **style, label=label)
                words.append(tr("{} {} at the end", subject, quantity(1000.0 * last.depth, "um")))
        axes.set_ylabel(tr("wear depth (µm)"))
        name_curves(axes)
        revolution_axis(axes)
        caption = tr(
            "From the probes (solid), by the model (dashed), by the model from the measured"
        )
        caption += tr(
            " forces (dash-dotted); shaded: the expanded uncertainty of the measured depth."
        )
        description = tr("Wear depth against revolution: {}.", "; ".join(words))
        return saved(canvas, tr("Wear depth"), description, caption)


def trip(capture: TripCapture) -> Figure:
    """Draw force, pin, speed and drive current against time, from before a trip to the standstill.

    Time 0 is that of the force which caused the trip, or the end of the revolution's record.
    """
    tripped = capture.trip
    words = tr("revolution {}", grouped(tripped.revolution))
    if tripped.peak is not None:
        words += f", up to {tripped.peak.sign}{quantity(tripped.peak.value_N, 'N')}"
        words += f" at {tripped.peak.angle_deg:.0f}°"
    if tripped.before is not None:
        words += tr("; grey: revolution {}, before it", grouped(tripped.before.revolution))
    rows: dict[str, tuple[str, ...]] = {"|F| (N)": ("force",), tr("speed (rpm)"): ("speed",)}
    if probes := capture.series(("probe_1", "probe_2")):
        rows["pin (µm)"] = probes
    currents = tuple(channel.name for channel in capture.table.sampled if channel.unit == "A")
    if currents or capture.currents:
        rows["current (A)"] = capture.series(currents)
    with canvas_of(_height(len(rows))) as canvas:
        panels = _panels(canvas, len(rows))
        for axes, (title, names) in zip(panels, rows.items(), strict=True):
            for piece in capture.pieces:
                for name in names:
                    colour = MUTED if piece.before else COLOURS.get(name, INK)
                    label = (
                        tr(SHORT.get(name, name.replace("_", " ")))
                        if piece is capture.pieces[-1]
                        else None
                    )
                    shown = envelope(piece.time_s, piece.values[name])
                    axes.plot(*shown, color=colour, label=label)
            axes.set_ylabel(title)
            axes.axvline(0.0, color=MODEL, lw=0.8, ls=":")
        for name, (time_s, values) in capture.currents.items():
            panels[-1].plot(time_s, values, ".-", color=INK, label=name.replace("_", " "))
        for axes in panels:
            name_curves(axes)
        if math.isfinite(tripped.trigger_N):
            panels[0].plot(0.0, tripped.trigger_N, "o", color=MODEL, ms=4.0)
        panels[-1].set_xlabel(tr("time from the trip (s)"))
        title = tr("The revolution in which the test tripped")
        return saved(canvas, title, tr("Joint force of {}.", words), f"{capitalised(words)}.")


def cycles(pictures: Sequence[CyclePicture], uncertainty: ForceUncertainty | None = None) -> Figure:
    """Draw complete cycles side by side: forces with the model, residual, displacement."""
    force_panel = partial(_force_panel, uncertainty=uncertainty)
    residual_panel = partial(_residual_panel, uncertainty=uncertainty)
    rows: list[tuple[str, Callable[[Any, CyclePicture], None]]] = [(tr("force (N)"), force_panel)]
    if any(picture.residual for picture in pictures):
        rows.append((tr("measured −\nmodel (N)"), residual_panel))
    if any("probe_1" in picture.columns for picture in pictures):
        rows.append((tr("pin, less its\nmean (µm)"), _probe_panel))
    heights = [1.9 if draw is force_panel else 1.1 for _, draw in rows]
    caption = _cycle_caption(pictures)
    if uncertainty is not None:
        caption += f" {BAND_WORDS}"
    which = {1: tr("the only one"), 2: tr("first and last"), 3: tr("first, middle and last")}
    title = tr("Complete cycles, {}", which[len(pictures)])
    return _cycle_grid(pictures, rows, heights, title, _cycle_words(pictures), caption)


def free_cycles(pictures: Sequence[CyclePicture], channels: Sequence[Channel]) -> Figure:
    """Draw complete cycles of free channels side by side, one row of panels per channel."""

    def panel(name: str) -> Callable[[Any, CyclePicture], None]:
        def draw(axes: Any, picture: CyclePicture) -> None:
            _curve(axes, picture, picture.columns[name], color=COLOURS["value"], label="measured")

        return draw

    rows = [
        (
            f"{textwrap.fill(channel.name.replace('_', ' '), 14)}\n({symbol(channel.unit)})",
            panel(channel.name),
        )
        for channel in channels
    ]
    title = tr("Complete cycles of {}", ", ".join(channel.name for channel in channels))
    words = " ".join(
        f"Revolution {picture.revolution}: {title_of(channel)} between "
        f"{number(float(picture.columns[channel.name].min()), channel.unit)} and "
        f"{quantity(float(picture.columns[channel.name].max()), channel.unit)}."
        for picture in pictures
        for channel in channels
    )
    return _cycle_grid(pictures, rows, [1.5] * len(rows), title, words, "")


def _cycle_grid(
    pictures: Sequence[CyclePicture],
    rows: Sequence[tuple[str, Callable[[Any, CyclePicture], None]]],
    heights: Sequence[float],
    title: str,
    words: str,
    caption: str,
) -> Figure:
    """Draw a column of panels per cycle; rows: label and drawing function; heights: inches."""
    with canvas_of(0.55 + sum(heights)) as canvas:
        grid = canvas.subplots(
            len(rows), len(pictures), sharex=True, sharey="row", squeeze=False,
            height_ratios=heights, gridspec_kw={"hspace": 0.14, "wspace": 0.07},
        )  # fmt: skip
        for (label, draw), line in zip(rows, grid, strict=True):
            for axes, picture in zip(line, pictures, strict=True):
                draw(axes, picture)
            line[0].set_ylabel(label)
            name_curves(line[-1])
        for axes, picture in zip(grid[0], pictures, strict=True):
            axes.set_title(tr("revolution {}", grouped(picture.revolution)))
        for axes in grid[-1]:
            axes.set_xlabel(tr("crank angle (°)"))
            axes.set_xticks(range(0, 360, 90))
            axes.set_xlim(0, 360)
        return saved(canvas, title, words, caption)


def _cycle_words(pictures: Sequence[CyclePicture]) -> str:
    parts = []
    for picture in pictures:
        force = picture.columns["force"]
        text = tr(
            "Revolution {}: |F| between {} and ",
            picture.revolution,
            number(float(force.min()), "N"),
        )
        text += quantity(float(force.max()), "N")
        if "force" in picture.residual:
            text += tr(
                ", largest residual {}",
                quantity(float(np.abs(picture.residual["force"]).max()), "N"),
            )
        parts.append(text + ".")
    return " ".join(parts)


def _cycle_caption(pictures: Sequence[CyclePicture]) -> str:
    if not any(picture.model for picture in pictures):
        return tr("Measured (solid). No prediction is saved for these cycles.")
    text = tr("Measured (solid) and by the model (dashed).")
    others = [
        tr(
            "revolution {} is compared with the prediction for {}",
            picture.revolution,
            picture.model_revolution,
        )
        for picture in pictures
        if picture.model_revolution is not None and picture.model_revolution != picture.revolution
    ]
    without = [str(picture.revolution) for picture in pictures if not picture.model]
    if without:
        others.append(tr("no prediction is saved for revolution {}", ", ".join(without)))
    return f"{text} {capitalised('; '.join(others))}." if others else text


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
        _curve(axes, picture, picture.columns[name], color=COLOURS[name], label=tr(SHORT[name]))
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
            style = {"color": COLOURS[name], "lw": 0.6, "label": tr(SHORT[name])}
            _curve(axes, picture, picture.residual[name], **style)
        else:
            axes.plot([], [], color=COLOURS[name], label=tr(SHORT[name]))


def _probe_panel(axes: Any, picture: CyclePicture) -> None:
    means = []
    for name in ("probe_1", "probe_2"):
        values = picture.columns[name]
        mean = float(np.mean(values))
        means.append(number(mean, "um"))
        _curve(axes, picture, values - mean, color=COLOURS[name], label=tr(SHORT[name]))
    axes.set_title(tr("means {} µm", ", ".join(means)), fontsize=7.5, loc="right", pad=2.0)
