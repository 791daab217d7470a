"""What can be wrong with a calibration, as a code and one sentence for the operator."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Problem:
    """Name a problem. blocks: the calibration is refused because of it."""

    code: str
    sentence: str
    blocks: bool = True


def note(code: str, sentence: str) -> Problem:
    """Return a problem that is only told: nothing is refused because of it."""
    return Problem(code, sentence, blocks=False)


def blocked(problems: Iterable[Problem]) -> bool:
    """Tell whether something is refused because of any of its problems."""
    return any(one.blocks for one in problems)
