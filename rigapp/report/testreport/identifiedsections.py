"""What was identified of the wear: as plots, and as sections of a report."""

from __future__ import annotations

import math
from typing import Any

from rigapp.presentation.numbers import (
    COEFFICIENT_SCALE,
    COEFFICIENT_UNIT,
    coefficient_number,
    coefficient_text,
    grouped,
)
from rigapp.presentation.times import duration
from rigapp.report.page.figures import MODEL, canvas_of, name_curves, revolution_axis, saved
from rigapp.report.page.manuscript import Block, Figure, Manuscript, Section, Table, Text
from rigapp.report.testreport.identified import IdentifiedTest, IdentifiedTests
from rigapp.report.testreport.identifiedtree import PER_UNIT
from rigapp.report.testreport.plots import COLOURS
from rigapp.report.testreport.wording import UNKNOWN
from rigapp_model.identification import Credible, Identification, Prior
from rigapp_model.identification.words import revolution_of

COEFFICIENT = f"K in {COEFFICIENT_UNIT}"


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


def depth_figure(test: IdentifiedTest, known: Identification) -> Figure:
    """Draw the measured depth in bins with the bands predicted early and last."""
    with canvas_of(2.8) as canvas:
        axes = canvas.subplots()
        draw_depth(axes, test, known)
        name_curves(axes)
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
        return saved(canvas, "Wear depth and its prediction", words, caption)


def narrowing_figure(test: IdentifiedTest) -> Figure:
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
        name_curves(axes)
        words = (
            f"The wear coefficient was known within {low[0]:.3g} and {high[0]:.3g} at revolution"
            f" {grouped(int(at[0]))}, within {low[-1]:.3g} and {high[-1]:.3g} at the end."
        )
        caption = "What the readings until then tell: median and 95 % credible limits."
        return saved(canvas, "Wear coefficient against revolution", words, caption)


def specimen_figure(found: IdentifiedTests) -> Figure | None:
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
        return saved(canvas, "Wear coefficients of the specimens", words, caption)


SECTION = "What is known of the wear"


def credible_text(one: Credible, unit: bool = True) -> str:
    """Return a wear coefficient with its 95 % limits in words."""
    median, low, high = (PER_UNIT * x for x in (one.median, one.low, one.high))
    value, limits = coefficient_text(median, low, high)
    return f"{value}, {limits}" if unit else f"{coefficient_number(median)}, {limits}"


def _prior_text(prior: Prior) -> str:
    return f"{coefficient_number(PER_UNIT * prior.coefficient)} · {COEFFICIENT_UNIT}"


def _budget_text(known: Identification) -> str:
    """Return what the limits of the coefficient hold beside the readings' own disturbances."""
    errors = known.errors
    return (
        f"probes {100.0 * known.sensitivity:.2g} %, zero {1e6 * errors.reference:.2g} µm,"
        f" force {100.0 * errors.load:.2g} %,"
        f" clearance and width {100.0 * errors.geometry:.2g} %, modulus"
    )


def remaining_text(test: IdentifiedTest) -> str:
    """Return how long the test goes on until the depth of its end, in words."""
    left = test.left
    if left is None:
        return "not asked for: the test has no stop.wear_depth_um"
    if left.revolutions is None:
        return left.reason or UNKNOWN
    one = left.revolutions
    high = grouped(round(one.high)) if math.isfinite(one.high) else "what the model computes"
    text = f"{grouped(round(one.median))} (95 %: {grouped(round(one.low))} to {high}) revolutions"
    left_s = test.remaining_s
    after = f", {duration(left_s)} at the last set speed" if left_s > 0.0 else ""
    return f"{text} until {1e6 * left.depth:.4g} µm{after}"


def known_blocks(test: IdentifiedTest) -> tuple[Block, ...]:
    """Return what a report says of one test."""
    known = test.known
    if known is None:
        return (Text(test.said),)
    rows = (
        ("Wear coefficient", credible_text(known.coefficient)),
        ("Readings up to revolution", grouped(int(known.revolution))),
        ("Remaining", remaining_text(test)),
        ("Record of the probes", test.record),
        ("Standard uncertainties in the limits", _budget_text(known)),
        ("Assumed beforehand", f"{_prior_text(known.prior)}, {known.prior.source}"),
    )
    statements = tuple(
        (
            one.name,
            f"{100.0 * one.weight:.1f} %",
            credible_text(one.coefficient, unit=False),
            credible_text(one.before, unit=False) if one.before is not None else "–",
            _place(revolution_of(known, one.place.median)) if one.place is not None else "–",
        )
        for one in known.verdicts
    )
    header = ("statement", "probability", "coefficient now", "before", "revolution")
    return (
        Text(test.said),
        Table("", rows),
        Table(f"What may be true of the coefficient, {COEFFICIENT_UNIT}", statements, header),
        depth_figure(test, known),
        *([narrowing_figure(test)] if test.course["revolution"].size else []),
    )


def _place(revolution: float) -> str:
    return grouped(round(revolution)) if math.isfinite(revolution) else UNKNOWN


def known_section(test: IdentifiedTest) -> Section:
    """Return the section of a test report."""
    return Section(SECTION, known_blocks(test))


def identified_document(found: IdentifiedTests) -> Manuscript:
    """Return the report of one or several tests."""
    sections = [_together(found)] if len(found.tests) > 1 else []
    sections += [
        Section(f"{one.path.name}: {one.specimen or one.title}", known_blocks(one))
        for one in found.tests
    ]
    title = "What is known of the wear"
    names = ", ".join(one.path.name for one in found.tests)
    return Manuscript(title, f"{title}: {names}", tuple(sections), f"Made from {names}.", ())


def pairing_rows(found: IdentifiedTests) -> tuple[tuple[str, str], ...]:
    """Return what several specimens tell together; empty when they tell nothing."""
    pairing = found.pairing
    if pairing is None:
        return ()
    factor = pairing.scatter
    return (
        ("Median specimen", credible_text(pairing.coefficient)),
        ("Next specimen", credible_text(pairing.next)),
        (
            "Scatter between specimens",
            f"a factor of {factor.median:.2f} (95 %: {factor.low:.2f} to {factor.high:.2f}) for one"
            " standard deviation",
        ),
        (
            "Prior for the next test",
            f"{_prior_text(pairing.prior)}, spread of ln K {pairing.prior.spread:.3g}",
        ),
    )


def _together(found: IdentifiedTests) -> Section:
    lines = tuple(
        (
            one.path.name,
            one.specimen or UNKNOWN,
            credible_text(one.known.coefficient, unit=False) if one.known is not None else "–",
            one.said,
        )
        for one in found.tests
    )
    header = ("file", "specimen", f"coefficient, {COEFFICIENT_UNIT}", "statement")
    blocks: list[Block] = [Table("", lines, header)]
    rows = pairing_rows(found)
    if rows:
        blocks.append(Table("Specimens of one pairing", rows))
    if found.why_not:
        blocks.append(Text(f"Not counted: {found.why_not}"))
    figure = specimen_figure(found)
    return Section("Specimens together", (*blocks, *([figure] if figure is not None else [])))
