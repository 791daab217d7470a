"""What a report says of the wear coefficient: of one test, and of several specimens together."""

from __future__ import annotations

import math

from rigapp.presentation.numbers import (
    COEFFICIENT_UNIT,
    coefficient_number,
    coefficient_text,
    grouped,
)
from rigapp.presentation.times import duration
from rigapp.report.page.manuscript import Block, Manuscript, Section, Table, Text
from rigapp.report.testreport.identified import IdentifiedTest, IdentifiedTests
from rigapp.report.testreport.identifiedplots import (
    depth_figure,
    narrowing_figure,
    specimen_figure,
)
from rigapp.report.testreport.identifiedtables import PER_UNIT
from rigapp.report.testreport.wording import UNKNOWN
from rigapp_model.identification import Credible, Prior
from rigapp_model.identification.words import revolution_of

SECTION = "What is known of the wear"


def credible_text(one: Credible, unit: bool = True) -> str:
    """Return a wear coefficient with its 95 % limits in words."""
    median, low, high = (PER_UNIT * x for x in (one.median, one.low, one.high))
    value, limits = coefficient_text(median, low, high)
    return f"{value}, {limits}" if unit else f"{coefficient_number(median)}, {limits}"


def _prior_text(prior: Prior) -> str:
    return f"{coefficient_number(PER_UNIT * prior.coefficient)} · {COEFFICIENT_UNIT}"


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


def known_blocks(test: IdentifiedTest, vector: bool) -> tuple[Block, ...]:
    """Return what a report says of one test."""
    known = test.known
    if known is None:
        return (Text(test.said),)
    rows = (
        ("Wear coefficient", credible_text(known.coefficient)),
        ("Readings up to revolution", grouped(int(known.revolution))),
        ("Remaining", remaining_text(test)),
        ("Record of the probes", test.record),
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
        depth_figure(test, known, vector),
        *([narrowing_figure(test, vector)] if test.course["revolution"].size else []),
    )


def _place(revolution: float) -> str:
    return grouped(round(revolution)) if math.isfinite(revolution) else UNKNOWN


def known_section(test: IdentifiedTest, vector: bool) -> Section:
    """Return the section of a test report."""
    return Section(SECTION, known_blocks(test, vector))


def identified_document(found: IdentifiedTests, vector: bool) -> Manuscript:
    """Return the report of one or several tests."""
    sections = [_together(found, vector)] if len(found.tests) > 1 else []
    sections += [
        Section(f"{one.path.name}: {one.specimen or one.title}", known_blocks(one, vector))
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


def _together(found: IdentifiedTests, vector: bool) -> Section:
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
    figure = specimen_figure(found, vector)
    return Section("Specimens together", (*blocks, *([figure] if figure is not None else [])))
