"""Sections of a report about data: extremes, model, cycles, wear, quality."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from types import MappingProxyType
from typing import Any

from rigapp.presentation.numbers import grouped
from rigapp.presentation.times import duration
from rigapp.presentation.translation import Text as Words
from rigapp.presentation.translation import tr, translate
from rigapp.report.page.document import Block, Section, Table, Text
from rigapp.report.testreport import plots
from rigapp.report.testreport.facts import ENDS, ChannelFacts, Peak, Rows, Stated
from rigapp.report.testreport.formatting import (
    FLAGS,
    UNKNOWN,
    counted,
    flags,
    number,
    quantity,
    symbol,
    title_of,
    utc,
)
from rigapp.report.testreport.model_facts import Agreement, Burst, CyclePicture, LastDepth
from rigapp.report.testreport.worn import Worn, profile_blocks
from rigapp.schema.channels import LOAD_CELL, Kind
from rigapp.schema.messages import Event
from rigapp.storage import TripCapture
from rigapp.texts import capitalised
from rigapp_calibration.load_cell.force_uncertainty import ForceUncertainty

PANELS = 4
"""Number of free channels in one figure: five would not fit on a page with their texts."""

BURSTS_SHOWN = 40  # a page
LINES = 20  # half a page; the heading has the total number

RESIDUALS: dict[str, Words] = {
    "residual_rms": "residual of |F|, RMS",
    "residual_1_rms": "residual of force_1, RMS",
    "residual_2_rms": "residual of force_2, RMS",
    "phase_shift": "phase shift of |F|",
}
WEAR: dict[str, Words] = {
    "measured_wear_depth": "measured (probes)",
    "wear_depth": "predicted (model)",
    "driven_wear_depth": "model driven by the measured forces",
}
STATISTICS: dict[str, Words] = {"max": "maximum", "min": "minimum", "rms": "RMS"}


def extremes(
    rows: Rows | None,
    agreement: Agreement | None,
    uncertainty: ForceUncertainty | None = None,
    stated: Stated = MappingProxyType({}),
) -> list[Section]:
    """Return the table of extremes and the trends of every channel."""
    if rows is None:
        nothing = Text(tr("No revolution is recorded."))
        return [Section(tr("Extremes and RMS of every channel"), (nothing,))]
    slow = [channel for channel in rows.channels if channel.channel.kind is Kind.SLOW]
    sampled = [channel for channel in rows.channels if channel not in slow]
    speed = [rows.speed] if rows.speed is not None else []
    noted: dict[str, str] = {}
    blocks: list[Block] = [_extremes_table(tr("Over the whole test"), [*sampled, *speed], noted)]
    if slow:
        title = tr("Slow channels, one value a revolution")
        blocks.append(_extremes_table(title, slow, noted, of="mean"))
        ages = ", ".join(f"{c.name} {duration(c.age_s, exact=True)}" for c in slow)
        blocks.append(Text(tr("Oldest value at the end of a revolution: {}.", ages)))
    if noted:
        notes = "; ".join(tr("revolution {}: {}", *item) for item in noted.items())
        blocks.append(Text(tr("* The revolution carries a quality flag. {}.", notes)))
    blocks.append(
        Text(
            tr(
                "First and last {}: mean over the first and last {} revolutions "
                "without a quality flag.",
                ENDS,
                ENDS,
            )
        )
    )
    doubts = [
        f"± {stated[channel.name]:.3g} {symbol(channel.unit)} ({channel.name.replace('_', ' ')})"
        for channel in sampled
        if channel.name in stated
    ]
    if doubts:
        blocks.append(Text(tr("Expanded uncertainty of a value: {}.", ", ".join(doubts))))
    forces = [channel for channel in sampled if channel.channel.instrument == LOAD_CELL]
    if forces:
        name = tr("Forces against revolution")
        blocks.append(plots.trends(forces, agreement, rows.gaps, name, uncertainty))
    free = [channel for channel in rows.channels if not channel.channel.instrument]
    others = [*(channel for channel in sampled if channel not in (*forces, *free)), *speed]
    if others:
        name = tr("Displacement and speed against revolution")
        blocks.append(plots.trends(others, None, rows.gaps, name, stated=stated))
    for some in batched(free):
        name = tr("{} against revolution", ", ".join(channel.name for channel in some))
        blocks.append(plots.trends(some, None, rows.gaps, name, stated=stated))
    return [Section(tr("Extremes and RMS of every channel"), tuple(blocks))]


def batched(channels: Sequence[Any]) -> Iterator[Sequence[Any]]:
    """Yield the channels in groups of ``PANELS``, for one figure each."""
    for first in range(0, len(channels), PANELS):
        yield channels[first : first + PANELS]


def _extremes_table(
    title: str, channels: Sequence[ChannelFacts], noted: dict[str, str], of: str = "RMS"
) -> Table:
    return Table(
        title,
        tuple(_extremes_row(channel, noted) for channel in channels),
        (
            tr("channel"),
            tr("unit"),
            tr("largest"),
            tr("in revolution"),
            tr("smallest"),
            tr("in revolution"),
            tr("{} over the test", of),
            tr("{}, first {}", of, ENDS),
            tr("{}, last {}", of, ENDS),
        ),
    )


def _extremes_row(channel: ChannelFacts, noted: dict[str, str]) -> tuple[str, ...]:
    def marked(peak: Peak) -> str:
        if not math.isfinite(peak.value):
            return tr(UNKNOWN)
        if not peak.quality:
            return grouped(peak.revolution)
        noted[grouped(peak.revolution)] = flags(peak.quality) or tr("flag {}", peak.quality)
        return f"{grouped(peak.revolution)}*"

    values = (channel.overall, channel.start, channel.end)
    return (
        title_of(channel.channel),
        symbol(channel.unit),
        channel.largest.sign + number(channel.largest.value, channel.unit),
        marked(channel.largest),
        number(channel.smallest.value, channel.unit),
        marked(channel.smallest),
        *(number(value, channel.unit) for value in values),
    )


def agreement(
    agreed: Agreement | None, rows: Rows | None, events: Sequence[Event] = ()
) -> list[Section]:
    """Return the section about the agreement of model and measurement."""
    title = tr("Agreement with the model")
    if agreed is None or rows is None:
        return [Section(title, (Text(tr("No prediction is recorded in the file.")),))]
    residuals = Table(
        tr("Measured minus model"),
        tuple(
            (tr(RESIDUALS[residual.name]), symbol(residual.unit),
             number(residual.mean, residual.unit, 2),
             number(residual.worst.value, residual.unit, 2),
             grouped(residual.worst.revolution)
             if math.isfinite(residual.worst.value) else tr(UNKNOWN),
             number(residual.last, residual.unit, 2))
            for residual in agreed.residuals
        ),
        (tr("quantity"), tr("unit"), tr("mean"), tr("largest"), tr("in revolution"), tr("last")),
    )  # fmt: skip
    pairs = Table(
        tr("Mean of the statistics over the compared revolutions, N"),
        tuple(
            (_statistic(pair.name), number(pair.measured, "N"), number(pair.predicted, "N"),
             number(pair.measured - pair.predicted, "N"))
            for pair in agreed.pairs
        ),
        (tr("statistic"), tr("measured"), tr("model"), tr("difference")),
    )  # fmt: skip
    lead = Text(
        tr("{} of {} compared.", counted(agreed.compared, "revolution"), grouped(rows.revolutions))
        + _relative(agreed, rows)
        + (tr(" The model: {}.", agreed.joint) if agreed.joint else "")
    )
    blocks: list[Block] = [lead, residuals]
    if agreed.deviation:
        blocks.insert(1, Text(tr("{} (the last revolution).", agreed.deviation), strong=True))
    if agreed.pairs:
        blocks.append(pairs)
    blocks.append(plots.residual_trend(agreed, rows.gaps))
    lines = [event for event in events if event.kind == "twin"]
    if lines:
        table = tuple(
            (utc(event.time), grouped(event.revolution), translate(event.text))
            for event in lines[:LINES]
        )
        header = (tr("time, UTC"), tr("revolution"), tr("what became of the prediction"))
        left = tr("First {} of {} lines", LINES, grouped(len(lines))) if len(lines) > LINES else ""
        blocks.append(Table(left, table, header))
    return [Section(title, tuple(blocks))]


def _relative(agreed: Agreement, rows: Rows) -> str:
    residual = next(
        (residual.mean for residual in agreed.residuals if residual.name == "residual_rms"),
        math.nan,
    )
    force = next(
        (channel.overall for channel in rows.channels if channel.name == "force"), math.nan
    )
    if not (math.isfinite(residual) and force > 0):
        return ""
    return tr(" The mean residual of |F| is {:.1f} % of the RMS force.", 100 * residual / force)


def _statistic(name: str) -> str:
    channel, _, statistic = name.rpartition("_")
    return tr("{} of {}", tr(STATISTICS[statistic]), tr(plots.SHORT[channel]))


def trip(capture: TripCapture | None, reason: str) -> list[Section]:
    """Return the section about the trip and the time around it; empty for a test without trip."""
    if capture is None:
        return []
    text = capitalised(reason)
    if capture.turned_s > 0.0:
        text += tr(" The crank turned for {:.2f} s more, by the device's clock.", capture.turned_s)
    if math.isfinite(capture.stood_s):
        text += tr(" It was at rest {:.2f} s after the alarm.", capture.stood_s)
    return [Section(tr("Trip"), (Text(text, strong=True), plots.trip(capture)))]


def cycles(
    pictures: Sequence[CyclePicture],
    refused: int,
    uncertainty: ForceUncertainty | None = None,
    bursts: Sequence[Burst] = (),
    unfinished: Sequence[int] = (),
) -> Section:
    """Return the figures of the first, middle and last saved cycle.

    Below them the cycles stored by triggers are listed.
    """
    blocks: list[Block] = []
    if refused:
        text = tr(
            "{} had no room in the file and could not be kept.", counted(refused, "complete cycle")
        )
        blocks.append(Text(text, strong=True))
    if pictures:
        blocks.append(plots.cycles(pictures, uncertainty))
        free = batched(pictures[0].free)
        blocks += [plots.free_cycles(pictures, some) for some in free]
    else:
        blocks.append(Text(tr("No complete cycle is saved.")))
    blocks += _bursts(bursts)
    if unfinished:
        numbers = ", ".join(grouped(cycle) for cycle in unfinished)
        blocks.append(
            Text(tr("Cut off by the end of the test, and kept apart: revolution {}.", numbers))
        )
    return Section(tr("Complete cycles"), tuple(blocks))


def _bursts(bursts: Sequence[Burst]) -> list[Block]:
    """Return the blocks about complete cycles stored by alarms, limits and notes."""
    if not bursts:
        return []
    table = tuple(
        (grouped(burst.trigger) if burst.trigger else "–", grouped(burst.first),
         grouped(burst.last), grouped(burst.cycles), flags(burst.quality) or tr("good"))
        for burst in bursts[:BURSTS_SHOWN]
    )  # fmt: skip
    header = (tr("trigger in revolution"), tr("kept from"), tr("to"), tr("cycles"), tr("quality"))
    title = tr("Cycles stored around alarms, limits and notes")
    blocks: list[Block] = [Table(title, table, header)]
    if len(bursts) > BURSTS_SHOWN:
        left = counted(len(bursts) - BURSTS_SHOWN, tr("more trigger"))
        blocks.append(Text(tr("{} left out here; the cycles are in the file.", left)))
    return blocks


def wear(agreed: Agreement | None, worn: Worn | None = None) -> Section:
    """Return the section about wear depth, measured and predicted, and its rate, or the reason."""
    known = agreed.wear if agreed is not None else {}
    table = Table(
        "",
        tuple((tr(words), *_wear_cells(known.get(name))) for name, words in WEAR.items()),
        (
            tr("wear depth"),
            tr("depth, µm"),
            tr("at revolution"),
            tr("rate, µm per 1000 revolutions"),
        ),
    )
    blocks: list[Block] = [table]
    if any(known.values()):
        blocks.append(
            Text(
                tr(
                    "The rate is that of a straight line through the last half. The "
                    "uncertainty of the measured depth (k = 2) holds noise, the wear "
                    "before the reference and the change of the elastic approach, not the "
                    "probes' calibration. Figure 1 shows the depth."
                )
            )
        )
    blocks += profile_blocks(worn)
    return Section(tr("Wear"), tuple(blocks))


def _wear_cells(last: LastDepth | None) -> tuple[str, str, str]:
    if last is None:
        return tr(UNKNOWN), tr(UNKNOWN), tr(UNKNOWN)
    rate = tr(UNKNOWN) if math.isnan(last.rate) else f"{1e6 * last.rate:.3g}"
    depth = number(1e3 * last.depth, "um", 2)
    if math.isfinite(last.uncertainty):
        depth += f" ± {number(1e3 * last.uncertainty, 'um', 2)}"
    return depth, grouped(last.revolution), rate


def quality(rows: Rows | None) -> Section:
    """Return the section with the number of revolutions for each quality flag."""
    title = tr("Quality of the data")
    if rows is None:
        return Section(title, (Text(tr("No revolution is recorded.")),))
    counted_flags = [
        (tr(FLAGS[flag]), grouped(value)) for flag, value in rows.flags.items() if value
    ]
    if rows.unknown_flags:
        counted_flags.append((tr("flags unknown to this version"), grouped(rows.unknown_flags)))
    table = Table(
        "",
        ((tr("no flag, good"), grouped(rows.good)), *counted_flags),
        (tr("quality"), tr("revolutions")),
    )
    text = tr(
        "{} lost in all; a revolution has about {} samples. A revolution can carry several flags.",
        counted(rows.lost_samples, "sample"),
        quantity(rows.samples_each, "1"),
    )
    return Section(title, (table, Text(text)))
