"""The states of a run and the transitions between them, as one table.

::

    idle -> connecting -> ready -> starting -> running -> pausing -> paused
                            ^         |  ^        |          |         |
                            |         |  +--------|----------|--resume-+
                            |         +-----------+----------+---------+--> stopping
                            +--reset-- stopped <------------------------------+
                            +--reset-- fault   <------------------------------+

Between two steps of different speed a test goes from running back to starting, in which the speed
is changed. Every exit from starting, running, pausing and paused leads through stopping, where the
spindle is stopped and the file is finished; only then is the state stopped or fault.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass

from rigapp.schema.messages import NOTE_CHARACTERS, FinishReason, RunState
from rigapp.texts import SentenceError, joined, say


class Trigger(enum.StrEnum):
    """Triggers of a transition."""

    CONNECT = "connect"
    CONNECTED = "connected"
    START = "start"
    AT_SPEED = "at speed"
    STEP = "step"
    PAUSE = "pause"
    STANDING = "standing"
    RESUME = "resume"
    STOP = "stop"
    ENDED = "ended"
    FAILED = "failed"
    RESET = "reset"
    DISCONNECT = "disconnect"


_R, _T = RunState, Trigger

TABLE: dict[tuple[RunState, Trigger], RunState] = {
    (_R.IDLE, _T.CONNECT): _R.CONNECTING,
    (_R.IDLE, _T.DISCONNECT): _R.IDLE,
    (_R.CONNECTING, _T.CONNECTED): _R.READY,
    (_R.CONNECTING, _T.FAILED): _R.FAULT,
    (_R.READY, _T.START): _R.STARTING,
    (_R.READY, _T.CONNECT): _R.CONNECTING,
    (_R.READY, _T.FAILED): _R.FAULT,
    (_R.READY, _T.RESET): _R.READY,
    (_R.READY, _T.DISCONNECT): _R.IDLE,
    (_R.STARTING, _T.AT_SPEED): _R.RUNNING,
    (_R.STARTING, _T.STEP): _R.STARTING,
    (_R.STARTING, _T.PAUSE): _R.PAUSING,
    (_R.STARTING, _T.STOP): _R.STOPPING,
    (_R.RUNNING, _T.STEP): _R.STARTING,
    (_R.RUNNING, _T.PAUSE): _R.PAUSING,
    (_R.RUNNING, _T.STOP): _R.STOPPING,
    (_R.PAUSING, _T.STANDING): _R.PAUSED,
    (_R.PAUSING, _T.STOP): _R.STOPPING,
    (_R.PAUSED, _T.RESUME): _R.STARTING,
    (_R.PAUSED, _T.STOP): _R.STOPPING,
    (_R.STOPPING, _T.STOP): _R.STOPPING,
    (_R.STOPPING, _T.ENDED): _R.STOPPED,
    (_R.STOPPING, _T.FAILED): _R.FAULT,
    (_R.STOPPED, _T.START): _R.STARTING,
    (_R.STOPPED, _T.RESET): _R.READY,
    (_R.STOPPED, _T.CONNECT): _R.CONNECTING,
    (_R.STOPPED, _T.FAILED): _R.FAULT,
    (_R.STOPPED, _T.DISCONNECT): _R.IDLE,
    (_R.FAULT, _T.RESET): _R.READY,
    (_R.FAULT, _T.CONNECT): _R.CONNECTING,
    (_R.FAULT, _T.FAILED): _R.FAULT,
    (_R.FAULT, _T.DISCONNECT): _R.IDLE,
}
"""(state, trigger) -> next state; other pairs are refused."""

TURNING = frozenset({_R.STARTING, _R.RUNNING, _R.PAUSING, _R.STOPPING})
"""States in which the spindle may turn."""

ACTIVE = TURNING | {_R.PAUSED}
"""States in which a test is open."""

ENDED = frozenset({_R.STOPPED, _R.FAULT})
"""States in which a test has ended."""

FAULTS = frozenset({FinishReason.DEVICE, FinishReason.STORAGE, FinishReason.INTERNAL})
"""Reasons that end in the state fault."""


class Refused(SentenceError):
    """A command cannot be carried out now; one sentence gives the reason and the remedy."""


class Occupied(Refused):
    """A calibration occupies the rig, so that nothing may turn the spindle."""


class InFault(Refused):
    """The engine is in fault; the text gives reason and remedy. code: kind of the failure."""

    def __init__(self, sentence: str, code: FinishReason) -> None:
        super().__init__(sentence)
        self.code = code


def refuse_long(what: str, text: str, most: int = NOTE_CHARACTERS) -> None:
    """Raise Refused when a text exceeds the length that is stored and shown."""
    if len(text) > most:
        raise Refused(
            "the {} has {} characters; shorten it to {}", what, f"{len(text):,}", f"{most:,}"
        )


def transition(state: RunState, trigger: Trigger) -> RunState:
    """Return the next state; raise Refused for a trigger without a transition in this state."""
    following = TABLE.get((state, trigger))
    if following is None:
        possible = [command.value for (at, command) in TABLE if at is state]
        raise Refused(
            '"{}" is not possible while {}; possible now: {}',
            trigger.value,
            state,
            joined(", ", possible) or say("no action, wait"),
        )
    return following


def is_untimely(sentence: str, trigger: Trigger) -> bool:
    """Return whether a refusal means an untimely trigger, not a failure."""
    return sentence.startswith(f'"{trigger.value}" is not possible while ')


def allowed(state: RunState, trigger: Trigger) -> bool:
    """Return whether a trigger is possible in a state."""
    return (state, trigger) in TABLE


@dataclass(frozen=True, slots=True)
class Ending:
    """Reason for the end of a run. off: power off at once instead of a controlled stop."""

    code: FinishReason
    sentence: str
    off: bool = False

    @property
    def fault(self) -> bool:
        """Return whether the run ends in the state fault."""
        return self.code in FAULTS

    @property
    def regular(self) -> bool:
        """Return whether the rig is sound, so that the crank may turn on to its rest position."""
        return not self.off and self.code in (FinishReason.COMPLETE, FinishReason.OPERATOR)

    @property
    def status(self) -> str:
        """Return the status of the file: complete, stopped or fault."""
        if self.code is FinishReason.COMPLETE:
            return "complete"
        return "fault" if self.fault else "stopped"
