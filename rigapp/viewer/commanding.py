"""Who is in command of the rig, as this viewer knows it."""

from __future__ import annotations

import enum
from collections.abc import Callable

from rigapp.schema.messages import Reply

ASK_EVERY_S = 2.0  # a lost command is seen within two looks at the screen


class CommandHolder(enum.Enum):
    """Tell who is in command, as seen from this window."""

    NOBODY = "nobody"
    THIS = "this window"
    OTHER = "another viewer"


class CommandWatch:
    """Know who is in command. A name is not enough, for two viewers may bear the same one.

    The engine is asked whether it is this viewer whenever the name changes, and every two seconds
    while somebody is in command.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._asked_at = -ASK_EVERY_S
        self._mine = False
        self.name = ""

    @property
    def holder(self) -> CommandHolder:
        """Return who is in command."""
        if not self.name:
            return CommandHolder.NOBODY
        return CommandHolder.THIS if self._mine else CommandHolder.OTHER

    def take_name(self, name: str) -> bool:
        """Take the name that the engine tells; return whether it is to be asked whose it is."""
        now = self._clock()
        if name != self.name:
            self.name = name
            self._mine = False
            self._asked_at = -ASK_EVERY_S
        if not name or now - self._asked_at < ASK_EVERY_S:
            return False
        self._asked_at = now
        return True

    def answered(self, reply: Reply) -> None:
        """Take the engine's answer to ``present``."""
        result = reply.result
        if reply.ok and isinstance(result, dict):
            self._mine = bool(result.get("in_command"))

    def forget(self) -> None:
        """Know nothing: another engine may answer next."""
        self.name, self._mine = "", False
        self._asked_at = -ASK_EVERY_S
