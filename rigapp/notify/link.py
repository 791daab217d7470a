"""The engine's end of the notifier: a bounded list of facts, and a thread that forwards them.

The thread gathers the engine's notices, hands them to the notifier's process and starts another one
where it has died or does not respond. Nothing of the engine ever waits for it: of more than
``WAITING`` facts the oldest are dropped, which is reported.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path

import zmq

from rigapp.notify.facts import (
    Fact,
    Farewell,
    Heartbeat,
    NotifierAnswer,
    NotifierSetup,
    Observation,
)
from rigapp.process.children import MessageChild, Restarts
from rigapp.schema.messages import Status
from rigapp.schema.notices import Committed, Notices

WAITING = 1000
"""Facts not yet processed by the notifier; alarms come by the dozen, not by the thousand."""
SIGN_EVERY_S = 2.0
START_S = 480.0  # importing, on a busy computer, and the end of the notifier before it
ANSWERS_S = 60.0
"""A notifier that does not respond for this time is started again; it never waits for a server."""
RESTART_PAUSE_S = 2.0
ATTEMPTS = 5
FAREWELL_S = 30.0
"""Time at the end for the notifier to process all facts, not for its deliveries."""


class NotifierLink:
    """Feed a notifier with the engine's notices; never blocks the thread that made it.

    look: returns the state of the rig, several times a minute. log: called with lines for the log.
    wrong: called with the reason why somebody may get no message, empty when that is over.
    """

    def __init__(
        self,
        setup: NotifierSetup,
        notices: Notices,
        look: Callable[[], Status],
        log: Callable[[str], None],
        wrong: Callable[[str], None],
        folder: Path,
    ) -> None:
        self._setup, self._notices, self._look = setup, notices, look
        self._log, self._on_wrong = log, wrong
        self._folder = folder
        self._facts: deque[Fact] = deque()
        self._number = self._handed = self._processed = 0
        self._signed_at = -SIGN_EVERY_S
        self._answered_at = 0.0
        self._attempts = Restarts(RESTART_PAUSE_S, ATTEMPTS)
        self._introduced = False
        self._process: MessageChild | None = None
        self._stop = threading.Event()
        self.dropped = 0
        self._thread = threading.Thread(target=self._run, name="messages", daemon=True)
        self._thread.start()

    @property
    def notifier_pid(self) -> int:
        """Return the notifier's process number, 0 when there is none."""
        process = self._process
        return process.pid if process is not None and process.running else 0

    def close(self) -> None:
        """Send a farewell; waiting messages are left to the notifier."""
        self._stop.set()
        self._thread.join(FAREWELL_S + 5.0)

    # --- the thread ------------------------------------------------------------------------------

    def _run(self) -> None:
        try:
            while not self._stop.is_set() and not self._attempts.exhausted:
                self._serve_one_notifier()
                pause = time.monotonic() + self._attempts.pause_s
                while not self._stop.is_set() and time.monotonic() < pause:
                    self._gather()
            if self._attempts.exhausted:
                self._on_wrong("The process that sends messages does not stay up.")
        except Exception as error:
            self._on_wrong(f"The engine's part of the messages failed ‹{error}›.")

    def _serve_one_notifier(self) -> None:
        """Start a notifier and feed it until it has ended or the engine does."""
        notifier = self._process = MessageChild("rigapp.notify.notifier", self._folder, "notifier")
        self._attempts.started()
        self._introduced = False
        self._handed, self._answered_at = self._processed, time.monotonic() + START_S
        try:
            self._feed(notifier)
            if self._stop.is_set():
                self._part(notifier)
        except zmq.ZMQError as error:
            self._log(f"the notifier cannot be reached ‹{error}›")
        finally:
            if self._stop.is_set():
                notifier.leave()  # it outlives its engine, to report the end
            else:
                notifier.close()

    def _feed(self, notifier: MessageChild) -> None:
        while not self._stop.is_set() and notifier.running:
            self._gather()
            self._hand_over(notifier)
            if self._facts and time.monotonic() - self._answered_at > ANSWERS_S:
                self._log(f"the notifier hears nothing for {ANSWERS_S:g} s; it is started again")
                return
        if not self._stop.is_set():
            reason = notifier.last_words()
            self._log(
                f"the notifier has ended{f' ‹{reason}›' if reason else ''}; it is started again"
            )

    def _gather(self) -> None:
        """Take the engine's notices; wait a little for the first one."""
        notice = self._notices.get(0.1)
        while notice is not None:
            if not isinstance(notice, Committed):
                self._add(notice)
            notice = self._notices.get(0.0)
        if time.monotonic() - self._signed_at >= SIGN_EVERY_S:
            self._signed_at = time.monotonic()
            self._add(Heartbeat(self._look()))

    def _add(self, seen: Observation) -> None:
        """Add a fact; a heartbeat replaces one that is not handed over yet."""
        self._number += 1
        facts = self._facts
        newest = facts[-1] if facts and facts[-1].number > self._handed else None
        if (
            newest is not None
            and isinstance(seen, Heartbeat)
            and isinstance(newest.seen, Heartbeat)
        ):
            facts.pop()
        facts.append(Fact(time.time(), seen, self._number))
        if len(facts) > WAITING:
            facts.popleft()
            self.dropped += 1

    def _hand_over(self, notifier: MessageChild) -> None:
        """Hand over new facts, as far as the notifier accepts them, and process its answers."""
        self._introduced = self._introduced or notifier.send(self._setup)
        if not self._introduced:
            return
        for fact in [fact for fact in self._facts if fact.number > self._handed]:
            if not notifier.send(fact):
                break
            self._handed = fact.number
        while (answer := notifier.receive(NotifierAnswer)) is not None:
            self._take(answer)

    def _take(self, answer: NotifierAnswer) -> None:
        self._attempts.succeeded()
        self._answered_at = time.monotonic()
        self._processed = max(self._processed, answer.processed)
        while self._facts and self._facts[0].number <= self._processed:
            self._facts.popleft()
        if self.dropped:
            self._log(f"{self.dropped} happenings were not judged for messages: too many came")
            self.dropped = 0
        for sentence in answer.remarks:
            self._log(sentence)
        if answer.wrong is not None:
            self._on_wrong(answer.wrong)

    def _part(self, notifier: MessageChild) -> None:
        """Hand over all facts, the farewell last."""
        self._gather()
        self._add(Farewell())
        deadline = time.monotonic() + FAREWELL_S
        while self._facts and time.monotonic() < deadline and notifier.running:
            self._hand_over(notifier)
            time.sleep(0.02)
