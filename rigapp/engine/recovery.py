"""The way out of a fault: which step is next, from the state and the alarms alone.

The order is always the same: remove the cause, connect, acknowledge, reset, go on. A step that is
not needed is left out. Window, ``rigapp status`` and command line show what is told here.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import Final

from rigapp.schema.messages import Alarm, Ends, Recovery, Remedy, RunState, Severity
from rigapp.texts import say

WAITING: Final = {
    RunState.CONNECTING: say("Wait: the devices are being connected."),
    RunState.STOPPING: say("Wait: the spindle is brought to a stand and the file is finished."),
    RunState.PAUSING: say("Wait: the crank comes to rest at the pause angle."),
}
"""States that pass by themselves, and what is told meanwhile."""

AT_REST: Final = frozenset({RunState.IDLE, RunState.READY, RunState.STOPPED, RunState.FAULT})
"""States in which no test is open and nothing is under way."""


@dataclass(frozen=True, slots=True)
class Situation:
    """What the next step depends on.

    reason: the sentence that goes with the state. connected: the devices are open and their threads
    live. unfinished: file of the last test where it has revolutions left, else empty. not_yet: what
    a start would have to wait for, in words, empty when nothing.
    """

    state: RunState
    reason: str
    connected: bool
    alarms: Sequence[Alarm]
    unfinished: str = ""
    not_yet: str = ""

    def critical(self, *ends: Ends) -> list[Alarm]:
        """Return the critical alarms that hold and end so, or without ``ends`` all on the list."""
        listed = [one for one in self.alarms if one.severity is Severity.CRITICAL]
        return [one for one in listed if one.active and one.ends in ends] if ends else listed


def recovery(now: Situation) -> Recovery:
    """Return the next step of a situation, and what is left after it."""
    if now.state in WAITING:
        return Recovery(sentence=WAITING[now.state])
    if now.state is RunState.PAUSED:
        return Recovery(Remedy.RESUME, "resume", say("Resume the paused test."), (Remedy.RESUME,))
    if now.state not in AT_REST:
        return Recovery()
    lost = now.critical(Ends.CONNECTION)
    seen = now.critical(Ends.SEEN, Ends.STAND)
    drive = now.critical(Ends.DRIVE)
    listed = now.critical()
    fresh = [one for one in listed if not one.acknowledged]
    needed = {
        Remedy.CAUSE: bool(lost or seen or drive),
        Remedy.CONNECT: bool(lost) or not now.connected,
        Remedy.ACKNOWLEDGE: bool(fresh),
        Remedy.RESET: bool(listed) or now.state is RunState.FAULT,
        Remedy.RESUME: True,
    }
    left = tuple(step for step, wanted in needed.items() if wanted)
    # What only a new connection or the drive's reset can end is not waited for.
    watched = bool(seen) and not needed[Remedy.CONNECT]
    step = next(one for one in left if one is not Remedy.CAUSE or watched)
    if step is Remedy.RESUME and now.not_yet:
        return Recovery(sentence=say("Wait: {}.", now.not_yet), left=left)
    about = {
        Remedy.CAUSE: seen,
        Remedy.CONNECT: lost,
        Remedy.ACKNOWLEDGE: fresh,
        Remedy.RESET: drive or _first_out_first(listed),
    }.get(step, [])
    return Recovery(
        step=step,
        verb=_verb(step, now),
        sentence=_sentence(step, about, now),
        left=left,
        cause=about[0].key if about else "",
    )


def _first_out_first(alarms: Iterable[Alarm]) -> list[Alarm]:
    return sorted(alarms, key=lambda one: not one.first_out)


def _verb(step: Remedy, now: Situation) -> str:
    if step is Remedy.CAUSE:
        return ""
    if step is Remedy.RESUME:
        return "resume_file" if now.unfinished else "start"
    return step.value


def _sentence(step: Remedy, about: Sequence[Alarm], now: Situation) -> str:
    if step is Remedy.RESUME:
        if now.unfinished:
            name = PurePath(now.unfinished).name
            return say("Go on with the test in {}, or start another one.", name)
        return say("Start a test.")
    if step is Remedy.ACKNOWLEDGE:
        more = say(" and {} more", len(about) - 1) if len(about) > 1 else ""
        return say('Acknowledge "{}"{}: say that you have seen it.', about[0].title, more)
    if about and about[0].active and about[0].ends is not Ends.TEST:
        return about[0].action
    if step is Remedy.CONNECT:
        return say("Remove the cause, then connect the devices.") if now.reason else say("Connect.")
    return say("Reset: the deliberate step before another start. Nothing moves.")
