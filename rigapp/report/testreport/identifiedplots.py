"""Pictures of what is known of the wear: depth with its bands, narrowing posterior, specimens."""

from __future__ import annotations

from typing import Any

from rigapp.presentation.numbers import (
    COEFFICIENT_SCALE,
    COEFFICIENT_UNIT,
    grouped,
)
from rigapp.report.page.manuscript import Figure
from rigapp.report.testreport.identified import IdentifiedTest, IdentifiedTests
from rigapp.report.testreport.identifiedtables import PER_UNIT
from rigapp.report.testreport.plots import (
    COLOURS,
    MODEL,
    canvas_of,
    revolution_axis,
    saved,
)
from rigapp_model.identification import Credible, Identification

COEFFICIENT = f"K in {COEFFICIENT_UNIT}"
LEGEND: dict[str, Any] = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}


def draw_depth(axes: Any, test: IdentifiedTest, known: Identification) -> None:
    """Draw depth in bins and its predicted bands on matplotlib axes, in um."""
    readings = known.readings
    shades = (COLOURS["probe_2"], MODEL) if len(test.bands) > 1 else (MODEL,)
    for one, colour in zip(test.bands, shades, strict=True):
        band, label = one.band, f"95 % band\nfrom {grouped(one.after)} on"
        axes.fill_between(
            band.revolution, 1e6 * band.low, 1e6 * band.high, color=colour, alpha=0.25, lw=0
        )
        axes.plot(band.revolution, 1e6 * band.median, color=colour, ls=(0, (4, 2)), label=label)
    doubt = 2e6 * readings.noise
    axes.errorbar(
        readings.revolution, 1e6 * readings.depth, yerr=doubt, fmt="o", ms=2.5, lw=0.8,
        color=COLOURS["force"], label="measured",
    )  # fmt: skip
    if test.left is not None:
        axes.axhline(1e6 * test.left.depth, color="#444444", lw=0.8, label="end of the\ntest")
    axes.set_ylabel("wear depth (µm)")


def depth_figure(test: IdentifiedTest, known: Identification, vector: bool) -> Figure:
    """Draw the measured depth in bins with the bands predicted early and last."""
    with canvas_of(2.8) as canvas:
        axes = canvas.subplots()
        draw_depth(axes, test, known)
        axes.legend(**LEGEND)
        readings = known.readings
        revolution_axis(axes)
        words = (
            f"Depth measured up to revolution {grouped(int(readings.revolution[-1]))}, and the"
            " bands in which it was predicted to lie."
        )
        caption = (
            "Means of bins of revolutions (points), and where the depth was predicted to lie with"
            " 95 % probability, from the readings until then."
        )
        return saved(canvas, "Wear depth and its prediction", words, caption, vector)


def narrowing_figure(test: IdentifiedTest, vector: bool) -> Figure:
    """Draw the wear coefficient with its limits against the revolution at which it was known."""
    at = test.course["revolution"]
    median, low, high = (
        COEFFICIENT_SCALE * test.course[f"wear_coefficient{one}"] for one in ("", "_low", "_high")
    )
    with canvas_of(2.4) as canvas:
        axes = canvas.subplots()
        axes.fill_between(at, low, high, color=COLOURS["value"], alpha=0.25, lw=0, label="95 %")
        axes.plot(at, median, color=COLOURS["value"], marker="o", ms=2.5, label="median")
        axes.set_xscale("log")
        axes.set_ylabel(COEFFICIENT)
        axes.set_xlabel("revolution")
        axes.legend(**LEGEND)
        words = (
            f"The wear coefficient was known within {low[0]:.3g} and {high[0]:.3g} at revolution"
            f" {grouped(int(at[0]))}, within {low[-1]:.3g} and {high[-1]:.3g} at the end."
        )
        caption = "What the readings until then tell: median and 95 % credible limits."
        return saved(canvas, "Wear coefficient against revolution", words, caption, vector)


def specimen_figure(found: IdentifiedTests, vector: bool) -> Figure | None:
    """Draw the coefficient of each specimen, of their median and of the next; None without any."""
    if found.pairing is None:
        return None
    lines: list[tuple[str, Credible]] = [
        (one.specimen or one.path.stem, one.known.coefficient)
        for one in found.counted
        if one.known is not None
    ]
    lines += [("median specimen", found.pairing.coefficient), ("next specimen", found.pairing.next)]
    with canvas_of(0.8 + 0.22 * len(lines)) as canvas:
        axes = canvas.subplots()
        for place, (_, one) in enumerate(lines):
            colour = COLOURS["value"] if place < len(found.counted) else MODEL
            median, low, high = (
                COEFFICIENT_SCALE * PER_UNIT * x for x in (one.median, one.low, one.high)
            )
            axes.plot([low, high], [place, place], color=colour)
            axes.plot([median], [place], "o", ms=3.5, color=colour)
        axes.set_yticks(range(len(lines)), [name for name, _ in lines])
        axes.invert_yaxis()
        axes.set_xlabel(COEFFICIENT)
        canvas.subplots_adjust(left=0.25)
        names = ", ".join(name for name, _ in lines)
        words = f"Wear coefficients with 95 % limits of {names}."
        caption = "Median and 95 % limits; the last two by all specimens together."
        return saved(canvas, "Wear coefficients of the specimens", words, caption, vector)
