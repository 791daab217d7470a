"""The engine's end of the courier: a bounded list of facts, and a thread that keeps both going.

The thread gathers what the engine tells everybody who looks on, hands it to the courier's process
and starts another one where it has died or does not hear. Nothing of the engine ever waits for it:
of more than ``WAITING`` facts the oldest are dropped, and that is said.
"""

from __future__ import annotations

import os
import subprocess
import threading
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path

import msgspec
import zmq

from rigapp.notify.facts import CourierAnswer, CourierSetup, Fact, Farewell, Seen, SignOfLife
from rigapp.process.children import start_module
from rigapp.process.ending import Background
from rigapp.process.link import bind_link, link_address
from rigapp.schema.messages import Status
from rigapp.schema.notices import Committed, Notices

WAITING = 1000
"""Facts that the courier has not heard yet; alarms come by the dozen, not by the thousand."""
SIGN_EVERY_S = 2.0
START_S = 480.0  # importing, on a computer that is busy, and a courier before it that ends
HEARS_S = 60.0
"""A courier that hears nothing for so long is started again; it never waits for a server."""
RESTART_PAUSE_S = 2.0
ATTEMPTS = 5
FAREWELL_S = 30.0
"""The end waits so long until the courier has heard all, and not for what it sends."""


def sign_of_life(status: Status) -> SignOfLife:
    """Return what a status tells an absent operator."""
    return SignOfLife(
        rig=status.rig,
        state=status.state,
        test=status.test,
        file=status.file,
        revolution=status.revolution,
        planned=status.planned,
        expected_end_at=status.expected_end_at,
        worst_margin_percent=status.worst_margin_percent,
        worst_margin=status.worst_margin,
        criterion_percent=status.criterion_percent,
        criterion=status.criterion,
        alarms=tuple(alarm for alarm in status.alarms if alarm.active),
    )


class CourierLink:
    """Feed a courier with what an engine tells; never blocks who made it.

    look: tells how the rig stands, several times a minute. said: told what the log should say.
    wrong: told why somebody may not be told, and with empty words that it is over.
    """

    def __init__(
        self,
        setup: CourierSetup,
        notices: Notices,
        look: Callable[[], Status],
        said: Callable[[str], None],
        wrong: Callable[[str], None],
        folder: Path,
    ) -> None:
        self._setup, self._notices, self._look = setup, notices, look
        self._on_said, self._on_wrong = said, wrong
        self._address = link_address(folder, f"courier-{os.getpid()}-{id(self):x}")
        self._facts: deque[Fact] = deque()
        self._number = self._handed = self._heard = 0
        self._signed_at = -SIGN_EVERY_S
        self._heard_at = 0.0
        self._barren = 0
        self._introduced = False
        self._process: subprocess.Popen[bytes] | None = None
        self._stop = threading.Event()
        self.dropped = 0
        self._thread = threading.Thread(target=self._run, name="messages", daemon=True)
        self._thread.start()

    @property
    def courier_pid(self) -> int:
        """Return the courier's process number, 0 when there is none."""
        process = self._process
        return process.pid if process is not None and process.poll() is None else 0

    def close(self) -> None:
        """Say farewell; what waits to be sent is left to the courier."""
        self._stop.set()
        self._thread.join(FAREWELL_S + 5.0)

    # --- the thread ------------------------------------------------------------------------------

    def _run(self) -> None:
        context = zmq.Context()
        try:
            while not self._stop.is_set() and self._barren < ATTEMPTS:
                self._serve_one_courier(context)
                pause = time.monotonic() + RESTART_PAUSE_S * 2.0**self._barren
                while not self._stop.is_set() and time.monotonic() < pause:
                    self._gather()
            if self._barren >= ATTEMPTS:
                self._on_wrong("The process that sends messages does not stay up.")
        except Exception as error:
            self._on_wrong(f"The engine's part of the messages failed ‹{error}›.")
        finally:
            context.destroy(linger=0)
            if self._address.startswith("ipc://"):
                Path(self._address.removeprefix("ipc://")).unlink(missing_ok=True)

    def _serve_one_courier(self, context: zmq.Context[zmq.Socket[bytes]]) -> None:
        """Start a courier and feed it until it has ended or the engine does."""
        socket = context.socket(zmq.PAIR)
        socket.setsockopt(zmq.LINGER, 0)
        endpoint, environment = bind_link(socket, self._address)
        # It outlives its engine, to tell of its end.
        process = start_module(
            "rigapp.notify.courier", endpoint, os.getpid(), environment=environment
        )
        self._process = process
        Background(process.wait, "courier's end")
        self._barren += 1
        self._introduced = False
        self._handed, self._heard_at = self._heard, time.monotonic() + START_S
        try:
            self._feed(socket, process)
            if self._stop.is_set():
                self._part(socket)
        except zmq.ZMQError as error:
            self._on_said(f"the courier cannot be reached ‹{error}›")
        finally:
            socket.close()
            if not self._stop.is_set():
                process.kill()

    def _feed(self, socket: zmq.Socket[bytes], process: subprocess.Popen[bytes]) -> None:
        while not self._stop.is_set() and process.poll() is None:
            self._gather()
            self._hand_over(socket)
            if self._facts and time.monotonic() - self._heard_at > HEARS_S:
                self._on_said(f"the courier hears nothing for {HEARS_S:g} s; it is started again")
                return
        if not self._stop.is_set():
            self._on_said("the courier has ended; it is started again")

    def _gather(self) -> None:
        """Take what the engine tells; wait a little for the first of it."""
        notice = self._notices.get(0.1)
        while notice is not None:
            if not isinstance(notice, Committed):
                self._add(notice)
            notice = self._notices.get(0.0)
        if time.monotonic() - self._signed_at >= SIGN_EVERY_S:
            self._signed_at = time.monotonic()
            self._add(sign_of_life(self._look()))

    def _add(self, seen: Seen) -> None:
        """Note a fact; a sign of life takes the place of one that is not handed over yet."""
        self._number += 1
        facts = self._facts
        newest = facts[-1] if facts and facts[-1].number > self._handed else None
        if (
            newest is not None
            and isinstance(seen, SignOfLife)
            and isinstance(newest.seen, SignOfLife)
        ):
            facts.pop()
        facts.append(Fact(time.time(), seen, self._number))
        if len(facts) > WAITING:
            facts.popleft()
            self.dropped += 1

    def _hand_over(self, socket: zmq.Socket[bytes]) -> None:
        """Hand over what is new, as far as there is room, and hear the answers."""
        if not self._introduced and socket.poll(0, zmq.POLLOUT):
            socket.send(msgspec.msgpack.encode(self._setup))
            self._introduced = True
        if not self._introduced:
            return
        for fact in [one for one in self._facts if one.number > self._handed]:
            if not socket.poll(0, zmq.POLLOUT):
                break
            socket.send(msgspec.msgpack.encode(fact), zmq.NOBLOCK)
            self._handed = fact.number
        while socket.poll(0):
            self._take(msgspec.msgpack.decode(socket.recv(), type=CourierAnswer))

    def _take(self, answer: CourierAnswer) -> None:
        self._barren, self._heard_at = 0, time.monotonic()
        self._heard = max(self._heard, answer.heard)
        while self._facts and self._facts[0].number <= self._heard:
            self._facts.popleft()
        if self.dropped:
            self._on_said(f"{self.dropped} happenings were not judged for messages: too many came")
            self.dropped = 0
        for sentence in answer.said:
            self._on_said(sentence)
        if answer.wrong is not None:
            self._on_wrong(answer.wrong)

    def _part(self, socket: zmq.Socket[bytes]) -> None:
        """Hand over what there is to the end, and say farewell."""
        self._gather()
        self._add(Farewell())
        deadline = time.monotonic() + FAREWELL_S
        while self._facts and time.monotonic() < deadline and self.courier_pid:
            self._hand_over(socket)
            time.sleep(0.02)
