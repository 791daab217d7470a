"""Identified wear as plots and as sections of a report."""

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
from rigapp.presentation.translation import tr
from rigapp.report.page.document import Block, Figure, Manuscript, Section, Table, Text
from rigapp.report.page.figures import MODEL, canvas_of, name_curves, revolution_axis, saved
from rigapp.report.testreport.formatting import UNKNOWN
from rigapp.report.testreport.identified import IdentifiedTest, IdentifiedTests
from rigapp.report.testreport.identifiedtree import PER_UNIT
from rigapp.report.testreport.plots import COLOURS
from rigapp_model.identification import Credible, Identification, Prior
from rigapp_model.identification.words import revolution_of

COEFFICIENT = f"K in {COEFFICIENT_UNIT}"


def draw_depth(axes: Any, test: IdentifiedTest, known: Identification) -> None:
    """Draw binned depths and predicted bands on matplotlib axes, in um."""
    readings = known.readings
    shades = (COLOURS["probe_2"], MODEL) if len(test.bands) > 1 else (MODEL,)
    for forecast, colour in zip(test.bands, shades, strict=True):
        band, label = forecast.band, tr("95 % band\nfrom {} on", grouped(forecast.after))
        axes.fill_between(
            band.revolution, 1e6 * band.low, 1e6 * band.high, color=colour, alpha=0.25, lw=0
        )
        axes.plot(band.revolution, 1e6 * band.median, color=colour, ls=(0, (4, 2)), label=label)
    uncertainty = 2e6 * readings.noise
    axes.errorbar(
        readings.revolution, 1e6 * readings.depth, yerr=uncertainty, fmt="o", ms=2.5, lw=0.8,
        color=COLOURS["force"], label="measured",
    )  # fmt: skip
    if test.left is not None:
        axes.axhline(1e6 * test.left.depth, color="#444444", lw=0.8, label=tr("end of the\ntest"))
    axes.set_ylabel(tr("wear depth (µm)"))


def depth_figure(test: IdentifiedTest, known: Identification) -> Figure:
    """Draw the binned measured depth with the bands predicted early and last."""
    with canvas_of(2.8) as canvas:
        axes = canvas.subplots()
        draw_depth(axes, test, known)
        name_curves(axes)
        readings = known.readings
        revolution_axis(axes)
        words = tr(
            "Depth measured up to revolution {}, and the bands in which it was predicted to lie.",
            grouped(int(readings.revolution[-1])),
        )
        caption = tr(
            "Means of bins of revolutions (points), and where the depth was "
            "predicted to lie with 95 % probability, from the readings until then."
        )
        return saved(canvas, tr("Wear depth and its prediction"), words, caption)


def narrowing_figure(test: IdentifiedTest) -> Figure:
    """Draw the wear coefficient with its limits against the revolution of the evaluation."""
    at = test.course["revolution"]
    median, low, high = (
        COEFFICIENT_SCALE * test.course[f"wear_coefficient{limit}"]
        for limit in ("", "_low", "_high")
    )
    with canvas_of(2.4) as canvas:
        axes = canvas.subplots()
        axes.fill_between(at, low, high, color=COLOURS["value"], alpha=0.25, lw=0, label="95 %")
        axes.plot(at, median, color=COLOURS["value"], marker="o", ms=2.5, label="median")
        axes.set_xscale("log")
        axes.set_ylabel(COEFFICIENT)
        axes.set_xlabel(tr("revolution"))
        name_curves(axes)
        words = tr(
            "The wear coefficient was known within {:.3g} and {:.3g} at revolution "
            "{}, within {:.3g} and {:.3g} at the end.",
            low[0],
            high[0],
            grouped(int(at[0])),
            low[-1],
            high[-1],
        )
        caption = tr("Estimate from the readings until then: median and 95 % credible limits.")
        return saved(canvas, tr("Wear coefficient against revolution"), words, caption)


def specimen_figure(identified: IdentifiedTests) -> Figure | None:
    """Draw the coefficients of the specimens, of their median and of the next; None without any."""
    if identified.pairing is None:
        return None
    lines: list[tuple[str, Credible]] = [
        (test.specimen or test.path.stem, test.known.coefficient)
        for test in identified.counted
        if test.known is not None
    ]
    lines += [
        (tr("median specimen"), identified.pairing.coefficient),
        (tr("next specimen"), identified.pairing.next),
    ]
    with canvas_of(0.8 + 0.22 * len(lines)) as canvas:
        axes = canvas.subplots()
        for row, (_, credible) in enumerate(lines):
            colour = COLOURS["value"] if row < len(identified.counted) else MODEL
            median, low, high = (
                COEFFICIENT_SCALE * PER_UNIT * x
                for x in (credible.median, credible.low, credible.high)
            )
            axes.plot([low, high], [row, row], color=colour)
            axes.plot([median], [row], "o", ms=3.5, color=colour)
        axes.set_yticks(range(len(lines)), [name for name, _ in lines])
        axes.invert_yaxis()
        axes.set_xlabel(COEFFICIENT)
        canvas.subplots_adjust(left=0.25)
        names = ", ".join(name for name, _ in lines)
        words = tr("Wear coefficients with 95 % limits of {}.", names)
        caption = tr("Median and 95 % limits; the last two by all specimens together.")
        return saved(canvas, tr("Wear coefficients of the specimens"), words, caption)


SECTION = "What is known of the wear"


def credible_text(coefficient: Credible, unit: bool = True) -> str:
    """Return a wear coefficient with its 95 % limits as text."""
    median, low, high = (PER_UNIT * getattr(coefficient, end) for end in ("median", "low", "high"))
    value, limits = coefficient_text(median, low, high)
    return f"{value}, {limits}" if unit else f"{coefficient_number(median)}, {limits}"


def _prior_text(prior: Prior) -> str:
    return f"{coefficient_number(PER_UNIT * prior.coefficient)} · {COEFFICIENT_UNIT}"


def _budget_text(known: Identification) -> str:
    """Return the contributions to the coefficient's limits besides disturbances of readings."""
    errors = known.errors
    return tr(
        "probes {:.2g} %, zero {:.2g} µm, force {:.2g} %, clearance and width {:.2g} %, modulus",
        100.0 * known.sensitivity,
        1000000.0 * errors.reference,
        100.0 * errors.load,
        100.0 * errors.geometry,
    )


def remaining_text(test: IdentifiedTest) -> str:
    """Return the remaining life until the depth that ends the test, as text."""
    left = test.left
    if left is None:
        return tr("not requested: the test has no stop.wear_depth_um")
    if left.revolutions is None:
        return left.reason or UNKNOWN
    ends = left.revolutions
    high = grouped(round(ends.high)) if math.isfinite(ends.high) else tr("what the model computes")
    text = tr(
        "{} (95 %: {} to {}) revolutions",
        grouped(round(ends.median)),
        grouped(round(ends.low)),
        high,
    )
    left_s = test.remaining_s
    after = tr(", {} at the last set speed", duration(left_s)) if left_s > 0.0 else ""
    return tr("{} until {:.4g} µm{}", text, 1000000.0 * left.depth, after)


def known_blocks(test: IdentifiedTest) -> tuple[Block, ...]:
    """Return the blocks of a report about one test."""
    known = test.known
    if known is None:
        return (Text(test.said),)
    rows = (
        (tr("Wear coefficient"), credible_text(known.coefficient)),
        (tr("Readings up to revolution"), grouped(int(known.revolution))),
        (tr("Remaining"), remaining_text(test)),
        (tr("Record of the probes"), test.record),
        (tr("Standard uncertainties in the limits"), _budget_text(known)),
        (tr("Assumed beforehand"), f"{_prior_text(known.prior)}, {known.prior.source}"),
    )
    statements = tuple(
        (
            verdict.name,
            f"{100.0 * verdict.weight:.1f} %",
            credible_text(verdict.coefficient, unit=False),
            credible_text(verdict.before, unit=False) if verdict.before is not None else "–",
            _place(revolution_of(known, verdict.transition.median))
            if verdict.transition is not None
            else "–",
        )
        for verdict in known.verdicts
    )
    header = (
        tr("statement"),
        tr("probability"),
        tr("coefficient now"),
        tr("before"),
        tr("revolution"),
    )
    return (
        Text(test.said),
        Table("", rows),
        Table(tr("Possible range of the coefficient, {}", COEFFICIENT_UNIT), statements, header),
        depth_figure(test, known),
        *([narrowing_figure(test)] if test.course["revolution"].size else []),
    )


def _place(revolution: float) -> str:
    return grouped(round(revolution)) if math.isfinite(revolution) else UNKNOWN


def known_section(test: IdentifiedTest) -> Section:
    """Return the section of a test report."""
    return Section(SECTION, known_blocks(test))


def identified_document(identified: IdentifiedTests) -> Manuscript:
    """Return the report of one or several tests."""
    sections = [_together(identified)] if len(identified.tests) > 1 else []
    sections += [
        Section(f"{test.path.name}: {test.specimen or test.title}", known_blocks(test))
        for test in identified.tests
    ]
    title = tr("What is known of the wear")
    names = ", ".join(test.path.name for test in identified.tests)
    return Manuscript(title, f"{title}: {names}", tuple(sections), tr("Made from {}.", names), ())


def pairing_rows(identified: IdentifiedTests) -> tuple[tuple[str, str], ...]:
    """Return the common result of several specimens, empty without one."""
    pairing = identified.pairing
    if pairing is None:
        return ()
    factor = pairing.scatter
    return (
        (tr("Median specimen"), credible_text(pairing.coefficient)),
        (tr("Next specimen"), credible_text(pairing.next)),
        (
            tr("Scatter between specimens"),
            tr(
                "a factor of {:.2f} (95 %: {:.2f} to {:.2f}) for one standard deviation",
                factor.median,
                factor.low,
                factor.high,
            ),
        ),
        (
            tr("Prior for the next test"),
            tr("{}, spread of ln K {:.3g}", _prior_text(pairing.prior), pairing.prior.spread),
        ),
    )


def _together(identified: IdentifiedTests) -> Section:
    lines = tuple(
        (
            test.path.name,
            test.specimen or UNKNOWN,
            credible_text(test.known.coefficient, unit=False) if test.known is not None else "–",
            test.said,
        )
        for test in identified.tests
    )
    header = (tr("file"), tr("specimen"), tr("coefficient, {}", COEFFICIENT_UNIT), tr("statement"))
    blocks: list[Block] = [Table("", lines, header)]
    rows = pairing_rows(identified)
    if rows:
        blocks.append(Table(tr("Specimens of one pairing"), rows))
    if identified.why_not:
        blocks.append(Text(tr("Not counted: {}", identified.why_not)))
    figure = specimen_figure(identified)
    return Section(tr("Specimens together"), (*blocks, *([figure] if figure is not None else [])))
