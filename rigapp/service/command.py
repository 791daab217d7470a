"""Who is in command of an engine: several viewers may look, one of them operates.

Nobody has to take command: as long as nobody has, every viewer may do everything. Once a viewer has
taken it, others are refused whatever changes something, except what makes the rig safe.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from rigapp.schema.messages import Request
from rigapp.schema.states import Refused
from rigapp.schema.verbs import Who, verb_of
from rigapp.texts import say

GONE_AFTER_S = 10.0
"""Command is free again when its holder has not been heard of for so long."""

ASLEEP_S = 2.0
"""A longer pause between two looks is this process's own; it is not held against the holder."""


Log = Callable[[str, str, str, str], None]
"""Takes the text of an event, who did it, who was in command before and who is after."""


@dataclass(frozen=True, slots=True)
class Holder:
    """The viewer in command: its identity and the name that others are told."""

    client: str
    name: str


class ControlLock:
    """Keep the one operator in command; every method may be called from any thread."""

    def __init__(self, log: Log, clock: Callable[[], float] = time.monotonic) -> None:
        """Begin with nobody in command; ``log`` is told of every change."""
        self._log = log
        self._clock = clock
        self._lock = threading.Lock()
        self._holder: Holder | None = None
        self._heard = self._looked = clock()

    @property
    def holder(self) -> str:
        """Return the name of who is in command, empty when nobody is."""
        holder = self._holder
        return holder.name if holder is not None else ""

    def look(self) -> None:
        """Release the command of a holder that is gone; to be called several times a second."""
        with self._lock:
            now = self._clock()
            if now - self._looked > ASLEEP_S:
                self._heard += now - self._looked
            self._looked = now
            holder = self._holder
            silence = now - self._heard
            if holder is None or silence <= GONE_AFTER_S:
                return
            self._holder = None
        text = say("command released: nothing was heard of {} for {:.0f} s", holder.name, silence)
        self._log(text, "engine", holder.name, "")

    def judge(self, request: Request) -> None:
        """Raise Refused when the request is for the operator in command, and comes from another."""
        with self._lock:
            holder = self._holder
            if holder is None:
                return
            if request.client == holder.client:
                self._heard = self._clock()
                return
        if verb_of(request.verb).who is Who.ANYONE:
            return
        raise Refused(
            "{} is in command of this rig, so {} is refused; take command first. Stop,"
            " drive off and acknowledge are possible for everybody",
            holder.name,
            repr(request.verb),
        )

    def take(self, request: Request, force: bool = False) -> dict[str, str]:
        """Give command to the sender; raise Refused while another holds it, unless forced."""
        if not request.client:
            raise Refused("a viewer without an identity cannot take command")
        taker = Holder(request.client, request.operator.strip() or say("another viewer"))
        with self._lock:
            former = self._holder
            same = former is not None and former.client == taker.client
            if former is not None and not same and not force:
                raise Refused(
                    "{} is in command; ask for a release, or take over by force, which is recorded",
                    former.name,
                )
            self._holder = taker
            self._heard = self._clock()
        if not same:
            before = former.name if former is not None else ""
            text = say("took command") + (say(" by force from {}", before) if before else "")
            self._log(text, taker.name, before, taker.name)
        return {"in_command": taker.name}

    def release(self, request: Request) -> None:
        """Give command back; raise Refused when the sender does not hold it."""
        with self._lock:
            holder = self._holder
            if holder is None or holder.client != request.client:
                who = say("{} is", holder.name) if holder is not None else say("nobody is")
                raise Refused("you are not in command of this rig, {}", who)
            self._holder = None
        self._log(say("released command"), holder.name, holder.name, "")

    def present(self, request: Request) -> dict[str, bool]:
        """Tell the sender whether it is still in command (``judge`` has noted that it lives)."""
        holder = self._holder
        return {"in_command": holder is not None and holder.client == request.client}
