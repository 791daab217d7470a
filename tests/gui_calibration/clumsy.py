"""Simulated hands that make a mistake at one step, or from one on."""

from __future__ import annotations

from enum import StrEnum
from typing import Any

from rigapp.commands.live.engine_line import Ask
from rigapp.commands.live.terminal import SimulatedActions


class ClumsyHands(SimulatedActions):
    """Do what a practice says, with a mistake from the step ``since`` on, or at that one only."""

    def __init__(
        self, session: Any, ask: Ask, mistake: StrEnum, since: int, *, only: bool = False
    ) -> None:
        super().__init__(session, ask)
        self._mistake, self._since, self._only = mistake, since, only

    def do(self, session: Any) -> None:
        """Do what the step under way asks."""
        here = session.procedure.position
        now = here == self._since if self._only else here >= self._since
        mistake = self._mistake if now else next(iter(self.practice.mistakes))
        self.carry_out(self.practice.act(session, mistake, self._since))
