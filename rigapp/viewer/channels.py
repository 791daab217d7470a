"""The channels that are shown, and their names in the window, from the table of engine or file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from rigapp.presentation.numbers import true_minus, unit_text
from rigapp.presentation.translation import Text, tr
from rigapp.schema.channels import BASE, LOAD_CELL, Channel, ChannelTable, Kind
from rigapp.texts import capitalised
from rigapp.viewer.frames import COMPONENT_NAMES, ForceFrame

COMPONENTS = BASE.names_of(LOAD_CELL)
"""The two axes of the load cell, along and across the crank."""

SIZE = next(
    channel.name
    for channel in BASE.channels
    if channel.instrument == LOAD_CELL and channel.kind is Kind.DERIVED
)
"""The size of the force."""

_DIRECTIONS = dict(zip(COMPONENTS, COMPONENT_NAMES[ForceFrame.CRANK], strict=True))

_QUANTITIES: Final[dict[str, Text]] = {"N": "Force", "um": "Position", "degC": "Temperature"}
"""Unit -> the quantity of an axis."""

_PROBES: Final[tuple[Text, ...]] = ("Probe 1", "Probe 2")
"""Names of the probes; a free channel has that of the rig file."""

_SPANS = {"N": 5.0, "um": 5.0, "rpm": 1.0, "mm": 0.002, "degC": 0.5, "%": 1.0}
"""The smallest range drawn, by unit: about twice the noise of a good instrument."""

OTHER_SPAN = 1e-3
"""The same where nothing is known of a unit: any real change is larger."""


def table_of(units: Mapping[str, str]) -> ChannelTable:
    """Return the channels whose columns a row holds (name -> unit), ``BASE`` first."""
    result = [*BASE.channels]
    for column, unit in units.items():
        name = column.removesuffix("_max")
        if name in BASE:
            continue
        if name != column and f"{name}_angle_of_max" in units:
            result.append(Channel(name, unit, words(name)))
        elif f"{column}_age" in units:
            averaged = f"{column}_readings" in units
            result.append(Channel(column, unit, words(column), Kind.SLOW, averaged=averaged))
    return ChannelTable(tuple(result))


def words(name: str) -> str:
    """Return a name as words."""
    return name.replace("_", " ")


def title_of(channel: Channel) -> str:
    """Return the name of a channel in the window."""
    if channel.name == SIZE:
        return "|F|"
    if channel.name in COMPONENTS:
        return tr("Force {}", tr(_DIRECTIONS[channel.name]))
    text = words(channel.name)
    title = capitalised(text)
    return tr(title) if title in _PROBES else title


def axis_of(channel: Channel) -> str:
    """Return the words at an axis of a channel's values."""
    quantity = tr(_QUANTITIES.get(channel.unit) or title_of(channel))
    return f"{quantity} ({unit_text(channel.unit)})" if channel.unit != "1" else quantity


def span_of(channel: Channel) -> float:
    """Return the smallest range of a channel's values that is drawn, in its unit."""
    return _SPANS.get(channel.unit, OTHER_SPAN)


def value_text(value: float | None, unit: str, decimals: int = 2) -> str:
    """Return a value with its unit; a dash where it is not known."""
    if value is None or not math.isfinite(value):
        return "–"
    return f"{true_minus(f'{value:.{decimals}f}')} {unit_text(unit)}".rstrip()


@dataclass(frozen=True, slots=True)
class FreeValue:
    """A value with its title and a line below it; level, old: see ``shown``."""

    name: str
    title: str
    value: str
    detail: str
    level: int = 0
    old: bool = False
    short: str = ""
