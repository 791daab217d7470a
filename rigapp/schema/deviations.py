"""Explanations of a deviation of a rig from its model: causes, columns, and a sentence."""

from __future__ import annotations

import math
from functools import cache

from rigapp.schema.channels import Column
from rigapp.texts import Sentence, say

DEVIATIONS = {
    say("nothing"): "",
    say("slider mass"): "%",
    say("follower mass"): "%",
    say("spring stiffness"): "%",
    say("free position of the spring"): "mm",
    say("friction coefficient"): "1",
    say("friction of the slider's guide"): "N",
    say("crank angle at the index"): "deg",
    say("gain of the load cell"): "%",
    say("weight of the pin at the load cell"): "N",
    say("clearance"): "um",
}
"""Causes with the unit of their deviation; ``deviation_cause`` is an index of them."""

NO_CAUSE, CLEARANCE_CAUSE = "nothing", "clearance"
_SHOWN_UNITS = {"1": "", "deg": "°", "um": " µm", "%": " %", "mm": " mm", "N": " N"}


@cache
def deviation_columns() -> tuple[Column, ...]:
    """Return the columns of the explanation of a deviation from the model, see ``DEVIATIONS``."""
    return (
        Column(
            "deviation_cause",
            "<f8",
            "1",
            "what explains that measurement and model differ by more than tolerances allow: "
            + ", ".join(f"{n} {name}" for n, name in enumerate(DEVIATIONS)),
        ),
        Column(
            "deviation",
            "<f8",
            "1",
            "by how much that is larger than stated: "
            + ", ".join(f"{name} {unit}" for name, unit in DEVIATIONS.items() if unit),
        ),
        Column("deviation_uncertainty", "<f8", "1", "expanded uncertainty (k = 2) of it"),
        Column(
            "deviation_alternative",
            "<f8",
            "1",
            "another cause that explains it nearly as well, numbered like deviation_cause",
        ),
    )


def deviation_sentence(
    cause: float, value: float, uncertainty: float, alternative: float = 0.0
) -> Sentence:
    """Return the explanation of a deviation beyond all tolerances in at most two lines, else empty.

    Arguments as in the columns: an index of ``DEVIATIONS``, value and U (k = 2) in its unit,
    another index.
    """
    if not _is_cause(cause):  # none, or a number unknown to this version
        return Sentence()
    causes = list(DEVIATIONS.items())
    name, unit = causes[int(cause)]
    shown = _SHOWN_UNITS[unit]
    digits = 2
    if 0.0 < uncertainty < math.inf:
        digits = max(0, 1 - math.floor(math.log10(uncertainty)))
    number = f"{value:+.{digits}f} ± {uncertainty:.{digits}f}{shown}".replace("-", "−")
    if _is_cause(alternative):
        other = causes[int(alternative)][0]
        return say("beyond tolerances: {} {} would explain it, or {}", name, number, other)
    return say("beyond tolerances: {} {} would explain it", name, number)


def _is_cause(number: float) -> bool:
    return number in range(1, len(DEVIATIONS))
