"""The notifier's process: receives facts on the rig, decides what is reported, and delivers it.

Started by ``rigapp.notify.link``. It does not end with its engine: it reports that the engine is
gone, and sends waiting messages, for ``LINGER_S``; the rest is sent by the notifier of the next
engine of the rig.
"""

from __future__ import annotations

import datetime
import logging
import shutil
import sys
import time
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from msgspec.structs import replace

from rigapp.config.errors import UnusableInput
from rigapp.config.notify import NotifySection
from rigapp.notify.channels import address, attempt, tell
from rigapp.notify.delivery import AttemptRequest, DeliveryResult
from rigapp.notify.facts import (
    DiskSeen,
    Fact,
    Farewell,
    Heartbeat,
    NotifierAnswer,
    NotifierSetup,
    Silence,
)
from rigapp.notify.message import Message, clock
from rigapp.notify.outbox import due, failed, put, sent
from rigapp.notify.rules import pass_time, update
from rigapp.notify.store import (
    NotifierState,
    WayState,
    identity,
    owned,
    read_state,
    settled,
    state_file,
    write_state,
)
from rigapp.process.children import Parent
from rigapp.process.ending import Background
from rigapp.process.logs import in_file
from rigapp.schema.messages import RunState, Severity, Status

log = logging.getLogger("rigapp.notify.notifier")  # its process calls the module __main__

LOOK_S = 0.2
LINGER_S = 3600.0
"""Time after the end of an engine during which its notifier sends waiting messages."""
LOCK_S = 300.0
"""Wait of a notifier for the previous one, which may be in the middle of an attempt."""
DISK_EVERY_S = 60.0
WELL_S = 30.0
"""Maximum age of the newest heartbeat for a ping; one comes every few seconds."""
FAILING_S = 300.0
"""A channel that fails for this time is an alarm of the rig: somebody relies on it."""
STANDSTILL_S = 5.0
"""A pass that took longer shows that the whole computer stalled, which is not silence."""


@dataclass(slots=True)
class _OnItsWay:
    """A delivery under way by a channel."""

    batch: tuple[Message, ...]
    work: Background[DeliveryResult]


class Notifier:
    """Turn facts into messages and deliver them; ``step`` is called again and again."""

    def __init__(self, setup: NotifierSetup) -> None:
        """Continue from the stored state of the last notifier of the rig."""
        self._setup = setup
        self._file = state_file(Path(setup.folder), setup.rig)
        self._ways = {identity(way): way for way in setup.ways}
        self._going: dict[str, _OnItsWay] = {}
        self._status: Status | None = None
        self._heartbeat_at = self._passed_at = time.monotonic()
        self._disk: Background[int] | None = None
        self._ping: Background[DeliveryResult] | None = None
        self._disk_at = self._ping_at = -1e9
        self._ping_fails = False
        self._remarks: list[str] = []
        self._wrong = ""
        self._unsaved = ""
        self.farewell = False
        self.take_up()

    def take_up(self) -> None:
        """Read the state again: another notifier may have sent some messages."""
        state = read_state(self._file)
        same = state.run == self._setup.run
        ways = {name: state.ways.get(name, WayState()) for name in self._ways}
        self.state = NotifierState(ways, self._setup.run, state.processed if same else 0)
        self._kept = settled(state)
        left = sum(len(way.outbox.waiting) for name, way in state.ways.items() if name not in ways)
        if left:
            self._say(f"{left} messages waited for a way that is set up no more; they are dropped")

    @property
    def idle(self) -> bool:
        """Return whether nothing waits and no delivery is under way."""
        return not self._going and not any(way.outbox.waiting for way in self.state.ways.values())

    @property
    def busy(self) -> bool:
        """Return whether a delivery is under way."""
        return bool(self._going)

    def step(self, facts: Sequence[Fact], *, gone: bool = False) -> NotifierAnswer | None:
        """Process facts, collect finished deliveries, begin others; return an answer.

        gone: the engine's process has ended.
        """
        now = time.time()
        processed = self.state.processed
        for fact in facts:
            if fact.number > self.state.processed:
                self._process(fact)
                processed = fact.number
        self.state = replace(self.state, processed=processed)
        for fact in self._own_facts(now, gone):
            self._process(fact)
        for name, way in self._ways.items():
            way_state = self.state.ways[name]
            after, messages = pass_time(way, way_state.conditions, now, datetime.datetime.now())
            self._note(name, replace(way_state, conditions=after), messages)
            self._deliver(name, way, now)
        if not gone and not self.farewell:
            self._ping_if_due()
        self._write_state()
        return self._answer(bool(facts), now)

    # --- facts -----------------------------------------------------------------------------------

    def _process(self, fact: Fact) -> None:
        if isinstance(fact.seen, Heartbeat):
            self._status, self._heartbeat_at = fact.seen.status, time.monotonic()
        self.farewell |= isinstance(fact.seen, Farewell)
        for name, way in self._ways.items():
            way_state = self.state.ways[name]
            conditions, messages = update(way, way_state.conditions, fact)
            self._note(name, replace(way_state, conditions=conditions), messages)

    def _note(self, name: str, way: WayState, messages: Sequence[Message]) -> None:
        outbox = way.outbox
        for message in messages:
            outbox = put(outbox, message)
        self._set(name, replace(way, outbox=outbox))

    def _set(self, name: str, way: WayState) -> None:
        ways = {**self.state.ways, name: way}
        self.state = replace(self.state, ways=ways)

    def _own_facts(self, now: float, gone: bool) -> list[Fact]:
        """Return the notifier's own facts: silence of the engine, free disk space."""
        passed, self._passed_at = time.monotonic() - self._passed_at, time.monotonic()
        if passed > STANDSTILL_S:
            self._heartbeat_at += passed
        facts = []
        silent = time.monotonic() - self._heartbeat_at
        if not self.farewell and (gone or silent > 1.0):
            facts.append(Fact(now, Silence(silent, gone)))
        free = self._disk_seen()
        return [*facts, Fact(now, free)] if free is not None else facts

    def _disk_seen(self) -> DiskSeen | None:
        """Return the free disk space for the test's file, read in the background: it may hang."""
        test = self._status.test if self._status is not None else None
        if test is None or not test.file:
            return None
        folder = Path(test.file).absolute().parent
        wanted = any("disk" in way.when for way in self._ways.values())
        if self._disk is None:
            if wanted and time.monotonic() - self._disk_at > DISK_EVERY_S:
                self._disk_at = time.monotonic()
                self._disk = Background(lambda: shutil.disk_usage(folder).free, "look at the disk")
            return None
        if not self._disk.done:
            return None
        done, self._disk = self._disk, None
        return DiskSeen(str(folder), done.result()) if done.error is None else None

    # --- deliveries ------------------------------------------------------------------------------

    def _deliver(self, name: str, way: NotifySection, now: float) -> None:
        delivery = self._going.get(name)
        if delivery is not None:
            if delivery.work.done:
                del self._going[name]
                self._record_result(name, way, delivery, now)
            return
        batch = due(self.state.ways[name].outbox, now, way.most_per_hour)
        if batch:
            self._write_state()  # before sending: the next notifier must not report it again
            lost = self.state.ways[name].outbox.lost
            messages = (*batch, _lost(lost, now)) if lost else batch
            secrets, rig = Path(self._setup.secrets), self._setup.name
            work = Background(lambda: tell(way, secrets, rig, messages), f"tell by {way.name}")
            self._going[name] = _OnItsWay(batch, work)

    def _record_result(
        self, name: str, way: NotifySection, delivery: _OnItsWay, now: float
    ) -> None:
        """Record the result of an attempt."""
        way_state = self.state.ways[name]
        error = delivery.work.error
        result = (
            delivery.work.result() if error is None else DeliveryResult(False, type(error).__name__)
        )
        titles = ", ".join(f"{message.title} ({message.turn})" for message in delivery.batch)
        where = way.command[0] if way.command else address(way.url)
        if result.ok:
            outbox = sent(way_state.outbox, delivery.batch, now)
            tries = (
                f", at attempt {way_state.outbox.failures + 1}" if way_state.outbox.failures else ""
            )
            self._say(f"told by {way.name}, {where}{tries}: {titles}")
        else:
            outbox = failed(way_state.outbox, now)
            if not way_state.outbox.failures:
                self._say(
                    f"{way.name}, {where}, could not be told: {titles}."
                    f" {result.reason.rstrip('.')}; it is tried again and again"
                )
        self._set(name, replace(way_state, outbox=outbox))

    def _ping_if_due(self) -> None:
        """Ping while all is well, at the set interval."""
        ping = self._setup.ping
        if ping is None:
            return
        if self._ping is not None:
            if self._ping.done:
                result = self._ping.result() if self._ping.error is None else DeliveryResult(False)
                self._note_ping(result, address(ping.url))
                self._ping = None
        elif time.monotonic() - self._ping_at >= ping.interval_s and self._well():
            self._ping_at = time.monotonic()
            request = AttemptRequest("ping", ping.url, self._setup.secrets)
            self._ping = Background(lambda: attempt(request), "ping")

    def _well(self) -> bool:
        status = self._status
        return (
            status is not None
            and time.monotonic() - self._heartbeat_at < WELL_S
            and status.engine.state is not RunState.FAULT
            and not any(a.active and a.severity is Severity.CRITICAL for a in status.alarms)
        )

    def _note_ping(self, result: DeliveryResult, where: str) -> None:
        if result.ok is self._ping_fails:
            why = "arrives" if result.ok else f"does not arrive: {result.reason}"
            self._say(f"the ping to {where} {why}")
        self._ping_fails = not result.ok

    # --- state and remarks -----------------------------------------------------------------------

    def _write_state(self) -> None:
        """Write the state if it has changed; if that fails it stays in memory."""
        kept = settled(self.state)
        if replace(kept, processed=0) == replace(self._kept, processed=0):
            return
        try:
            write_state(self._file, kept)
        except UnusableInput as error:
            self._unsaved = str(error)
        else:
            self._kept, self._unsaved = kept, ""

    def _say(self, sentence: str) -> None:
        log.info("%s", sentence)
        self._remarks.append(sentence)

    def _answer(self, heard: bool, now: float) -> NotifierAnswer | None:
        wrong = self._unsaved or next(
            (
                f"{way.name} has failed since {clock(outbox.failing_since)}."
                for name, way in self._ways.items()
                if (outbox := self.state.ways[name].outbox).failing_since
                and now - outbox.failing_since > FAILING_S
            ),
            "",
        )
        if not heard and not self._remarks and wrong == self._wrong:
            return None
        remarks, self._remarks = tuple(self._remarks), []
        changed = None if wrong == self._wrong else wrong
        self._wrong = wrong
        return NotifierAnswer(self.state.processed, remarks, changed)


def _lost(number: int, now: float) -> Message:
    text = f"{number} messages before these had no room and were dropped."
    return Message("lost", "told", "warning", "Messages lost", text, now)


def serve(engine: Parent, setup: NotifierSetup) -> None:
    """Deliver while the engine runs, and for a while after it."""
    file = state_file(Path(setup.folder), setup.rig)
    with ExitStack() as holding:
        deadline = time.monotonic() + LOCK_S
        while not holding.enter_context(owned(file)):
            holding.pop_all().close()
            if time.monotonic() > deadline:
                return
            time.sleep(LOOK_S)
        notifier = Notifier(setup)
        while engine.alive and not notifier.farewell:
            answer = notifier.step(_received(engine, LOOK_S))
            if answer is not None:
                engine.send(answer)
        notifier.step(_received(engine), gone=not notifier.farewell)
        while notifier.busy:
            time.sleep(LOOK_S)
            notifier.step((), gone=not notifier.farewell)
    _linger(notifier, file)


def _linger(notifier: Notifier, file: Path) -> None:
    """Send waiting messages, unless another notifier of the rig has taken them over."""
    deadline = time.monotonic() + LINGER_S
    while not notifier.idle and time.monotonic() < deadline:
        with owned(file) as ours:
            if not ours:
                return
            notifier.take_up()
            notifier.step(())
            while notifier.busy:
                time.sleep(LOOK_S)
                notifier.step(())
        time.sleep(1.0)


def _received(engine: Parent, timeout_s: float = 0.0) -> list[Fact]:
    """Return received facts, after a wait for the first."""
    facts = []
    fact = engine.receive(Fact, timeout_s)
    while fact is not None:
        facts.append(fact)
        fact = engine.receive(Fact)
    return facts


def main(arguments: list[str]) -> int:
    """Serve one engine."""
    engine = Parent(arguments)
    try:
        setup = engine.wait_for(NotifierSetup)
        if setup is not None:
            with in_file(Path(setup.folder) / "messages.log"):
                serve(engine, setup)
    finally:
        engine.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
