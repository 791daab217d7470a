"""The quantities of trends and comparisons: statistics of every channel, and predictions."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Final

from rigapp.presentation.numbers import unit_text
from rigapp.presentation.translation import Text, marked, tr
from rigapp.schema.channels import (
    AVERAGES,
    BASE,
    LOAD_CELL,
    PROBES,
    Channel,
    ChannelTable,
    Kind,
)
from rigapp.schema.columns import prediction_columns
from rigapp.viewer.channels import SIZE, axis_of, span_of, title_of

STATISTICS: Final[dict[str, tuple[Text, str]]] = {
    "max": ("maximum", "first"),
    "rms": ("RMS", "main"),
    "min": ("minimum", "second"),
}
"""The statistics of a channel that are drawn: their words, and the role of their colour."""

COMPARED = {**{name: text for name, (text, _) in STATISTICS.items()}, "mean": marked("mean")}
"""The statistics for comparing tests."""

UM_PER_MM = 1e3
LARGEST = f"{SIZE}_max"
_DERIVED = Kind.DERIVED
_PREDICTED = frozenset(column.name for column in prediction_columns())


@dataclass(frozen=True, slots=True)
class TrendLine:
    """One line of a trend: its column, the role of its colour, its name in the legend.

    doubt: the column of its expanded uncertainty (k = 2), age: of its age, where it has one.
    """

    column: str
    role: str
    text: Text
    doubt: str = ""
    age: str = ""

    def translated(self) -> TrendLine:
        """Return it in the language of the window."""
        return replace(self, text=tr(self.text))


@dataclass(frozen=True, slots=True)
class TrendQuantity:
    """A quantity of a trend: measured and predicted lines of one unit, scale times their columns.

    measured are columns of rows, predicted of predictions.
    """

    title: Text
    axis: Text
    minimum_span: float
    measured: tuple[TrendLine, ...]
    predicted: tuple[TrendLine, ...] = ()
    scale: float = 1.0

    @property
    def unit(self) -> str:
        """Return the unit of its values, as the window writes it."""
        return self.axis.rpartition("(")[2].rstrip(")") if "(" in self.axis else ""

    def translated(self) -> TrendQuantity:
        """Return it in the language of the window."""
        measured, predicted = (
            tuple(line.translated() for line in lines) for lines in (self.measured, self.predicted)
        )
        return replace(
            self, title=tr(self.title), axis=tr(self.axis), measured=measured, predicted=predicted
        )


_OTHERS = {
    "wear": TrendQuantity(
        "Wear depth",
        "Depth (µm)",
        2.0,
        (),
        (
            TrendLine(
                "measured_wear_depth", "first", "measured", "measured_wear_depth_uncertainty"
            ),
            TrendLine("wear_depth", "model", "model"),
        ),
        UM_PER_MM,
    ),
    "residual": TrendQuantity(
        "Measured − model",
        "RMS (N)",
        1.0,
        (),
        (
            TrendLine("residual_rms", "main", "|F|"),
            TrendLine("residual_1_rms", "first", "along crank"),
            TrendLine("residual_2_rms", "second", "across crank"),
        ),
    ),
    "speed": TrendQuantity(
        "Speed",
        "Speed (rpm)",
        1.0,
        (
            TrendLine("speed_max", "first", "maximum"),
            TrendLine("speed", "main", "mean"),
            TrendLine("speed_min", "second", "minimum"),
        ),
    ),
}
"""Quantities that are no channels."""


def trend_quantities(table: ChannelTable) -> dict[str, TrendQuantity]:
    """Return the quantities of a trend, those of a table's channels and all others, by name.

    It is in the language of the window, so that nothing is translated when it is drawn.
    """
    force = _of_channel(BASE[SIZE])
    # The largest force alone: on an axis with the smallest its changes are invisible.
    largest = replace(
        force,
        title=tr("{} maximum", force.title),
        measured=force.measured[:1],
        predicted=force.predicted[:1],
    )
    result = {channel.name: _of_channel(channel) for channel in _ordered(table)}
    return {name: q.translated() for name, q in {**result, LARGEST: largest, **_OTHERS}.items()}


def _ordered(table: ChannelTable) -> list[Channel]:
    """Return the channels, the derived size of the force first: it is viewed most."""
    return sorted(table.channels, key=lambda c: (not c.instrument, c.kind is not _DERIVED))


def _of_channel(channel: Channel) -> TrendQuantity:
    if channel.kind is Kind.SLOW:
        lines: tuple[TrendLine, ...] = (
            TrendLine(channel.name, "main", "newest", age=f"{channel.name}_age"),
        )
        if channel.averaged:
            lines += (
                TrendLine(f"{channel.name}_max", "first", "maximum"),
                TrendLine(f"{channel.name}_mean", "second", "mean"),
            )
    else:
        lines = tuple(
            TrendLine(f"{channel.name}_{name}", role, text)
            for name, (text, role) in STATISTICS.items()
        )
    predicted: tuple[TrendLine, ...] = ()
    if lines[0].column in _PREDICTED:
        # The stored uncertainty is the largest of a revolution.
        predicted = (replace(lines[0], doubt="force_uncertainty"), *lines[1:])
    return TrendQuantity(title_of(channel), axis_of(channel), span_of(channel), lines, predicted)


def compared_columns(table: ChannelTable) -> dict[str, str]:
    """Return the columns for comparing tests, each with its words and unit."""
    result: dict[str, str] = {}
    for channel in _ordered(table):
        title, unit = title_of(channel), unit_text(channel.unit)
        averages = {name: COMPARED[name] for name in AVERAGES if channel.averaged}
        names = {"": "", **averages} if channel.kind is Kind.SLOW else COMPARED
        for name, word in names.items():
            column = f"{channel.name}_{name}".rstrip("_")
            result[column] = f"{title}, {tr(word)} ({unit})" if word else f"{title} ({unit})"
    for quantity in (item.translated() for item in _OTHERS.values()):
        for line in (*quantity.measured, *quantity.predicted):
            result[line.column] = f"{quantity.title}, {line.text} ({quantity.unit})"
    return result


def grouped_quantities(names: Iterable[str], table: ChannelTable) -> list[tuple[str, ...]]:
    """Return names of columns or quantities in groups: forces, probes, free channels, the others.

    A group without names is left out; within one they keep their order.
    """
    kinds = (LOAD_CELL, PROBES, "")

    def group(name: str) -> int:
        owner = max(
            (
                channel
                for channel in table.channels
                if name == channel.name or name.startswith(f"{channel.name}_")
            ),
            key=lambda channel: len(channel.name),
            default=None,
        )
        return kinds.index(owner.instrument) if owner is not None else len(kinds)

    result: dict[int, list[str]] = {}
    for name in names:
        result.setdefault(group(name), []).append(name)
    return [tuple(result[at]) for at in sorted(result)]


def scale_of(column: str) -> float:
    """Return the factor from a column's unit to that of its words."""
    for quantity in _OTHERS.values():
        if any(line.column == column for line in quantity.predicted):
            return quantity.scale
    return 1.0
