"""Problems of a calibration: a code and one sentence for the operator."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rigapp.texts import say


@dataclass(frozen=True, slots=True)
class Problem:
    """A problem. blocks: the calibration is refused because of it."""

    code: str
    sentence: str
    blocks: bool = True


def refusal(code: str, template: str, *values: object) -> Problem:
    """Return a problem that blocks the calibration."""
    return Problem(code, say(template, *values))


def note(code: str, template: str, *values: object) -> Problem:
    """Return a problem that is only reported and blocks nothing."""
    return Problem(code, say(template, *values), blocks=False)


def blocked(problems: Iterable[Problem]) -> bool:
    """Return whether any of the problems blocks."""
    return any(one.blocks for one in problems)
