"""What the simulated hands still have to do, one action after another."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Protocol

from rigapp.calibrating.practice import Action
from rigapp.schema.messages import Reply


class AskLater(Protocol):
    """Ask the engine; the handler is called later on the screen's thread."""

    def __call__(
        self, verb: str, arguments: dict[str, Any], handler: Callable[[Reply], None], /
    ) -> None:
        """Ask."""
        ...


class HandsQueue:
    """Send actions to the engine, each after the answer to the one before; a failure drops all."""

    def __init__(
        self, line: AskLater, acted: Callable[[float], None], failed: Callable[[str], None]
    ) -> None:
        """Take the engine; ``acted`` is told the first device sample after an action."""
        self._line, self._acted, self._failed = line, acted, failed
        self._actions: deque[Action] = deque()
        self.busy = False
        self.prepared = False

    def add(self, actions: Iterable[Action]) -> None:
        """Do these after all others."""
        self._actions.extend(actions)
        if not self.busy:
            self._next()

    def prepare(self, actions: Iterable[Action]) -> None:
        """Do these unless the rig is prepared already."""
        if not self.prepared:
            self.prepared = True
            self.add(actions)

    def tidy_up(self, actions: Iterable[Action]) -> None:
        """Put a prepared rig together again, waiting for no answer."""
        if self.prepared:
            for action in actions:
                self._line(action.verb, dict(action.arguments), lambda reply: None)
            self.prepared = False

    def _next(self) -> None:
        self.busy = bool(self._actions)
        if self.busy:
            action = self._actions.popleft()
            self._line(action.verb, dict(action.arguments), self._answered)

    def _answered(self, reply: Reply) -> None:
        if not reply.ok:
            self._actions.clear()
            self.busy = self.prepared = False
            self._failed(reply.sentence)
            return
        if isinstance(reply.result, Mapping):
            self._acted(float(reply.result["after_sample"]))
        self._next()
