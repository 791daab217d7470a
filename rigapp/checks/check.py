"""One line of the list of checks before a start."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from dataclasses import dataclass

from rigapp.config.errors import UnusableInput
from rigapp.texts import say


class CheckVerdict(enum.StrEnum):
    """Whether a check lets a test start."""

    GOOD = "good"
    ATTENTION = "attention"
    BLOCKS = "blocks"


GOOD, ATTENTION, BLOCKS = CheckVerdict


@dataclass(frozen=True, slots=True)
class Check:
    """What was checked, whether it lets a test start, what was found, what to do."""

    name: str
    verdict: CheckVerdict
    sentence: str
    advice: str = ""

    @property
    def blocks(self) -> bool:
        """Return whether it forbids a start."""
        return self.verdict is BLOCKS

    def tree(self) -> dict[str, str]:
        """Return it by the keys that scripts read."""
        return {
            "what": self.name,
            "verdict": self.verdict.value,
            "finding": self.sentence,
            "action": self.advice,
        }


def blocked(checks: Iterable[Check]) -> bool:
    """Return whether any check forbids a start."""
    return any(check.blocks for check in checks)


def refuse_blocked(checks: Iterable[Check], where: str = "") -> None:
    """Raise UnusableInput for the first check that forbids a start; where: begins its sentence."""
    for check in checks:
        if check.blocks:
            text = say("{}{}", where, check.sentence)
            raise UnusableInput(say("{}. {}", text, check.advice) if check.advice else text)
