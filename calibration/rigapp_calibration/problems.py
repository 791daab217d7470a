"""What can be wrong with a calibration, as a code and one sentence for the operator."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rigapp.texts import say


@dataclass(frozen=True, slots=True)
class Problem:
    """Name a problem. blocks: the calibration is refused because of it."""

    code: str
    sentence: str
    blocks: bool = True


def refusal(code: str, template: str, *values: object) -> Problem:
    """Return a problem because of which the calibration is refused."""
    return Problem(code, say(template, *values))


def note(code: str, template: str, *values: object) -> Problem:
    """Return a problem that is only reported: nothing is refused because of it."""
    return Problem(code, say(template, *values), blocks=False)


def blocked(problems: Iterable[Problem]) -> bool:
    """Tell whether something is refused because of any of its problems."""
    return any(one.blocks for one in problems)
