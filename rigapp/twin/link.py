"""The engine's end of the twin: a mailbox, a worker process, and a thread that keeps both going.

The mailbox holds ``MAILBOX`` revolutions and drops the oldest: the twin predicts every revolution
that it can keep up with, and never delays the engine. A worker that dies or does not answer within
``ANSWER_S`` is started again with the newest checkpoint, so that its bushings are worn as they
were; the revolution that it failed on is asked once more. What is never predicted is reported, and
after ``ATTEMPTS`` workers that predicted nothing no other is started.
"""

from __future__ import annotations

import os
import subprocess
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import msgspec
import zmq

from rigapp.process.children import start_module
from rigapp.process.link import bind_link, link_address
from rigapp.schema.messages import Prediction, RevolutionMeasured
from rigapp.twin.messages import TwinAnswer, TwinSetup

MAILBOX = 64
START_S = 180.0  # importing and compiling, on a computer that is busy
ANSWER_S = 10.0
RESTART_PAUSE_S = 1.0
ATTEMPTS = 5
REPORT_PAUSE_S = 60.0
"""Gaps in the predictions are reported together, no more often than this."""
TOO_SLOW = "the twin could not keep up"
SINGLE_THREADED = {"OPENBLAS_NUM_THREADS": "1"}
"""Of the worker, unless somebody says otherwise: its matrices are small, and threads that wait for
each other make an update of the wear coefficient up to twice as long."""


@dataclass(slots=True)
class Missed:
    """Revolutions that were not predicted since the last report."""

    first: int = 0
    last: int = 0
    count: int = 0
    why: str = TOO_SLOW

    def add(self, revolution: int, why: str = TOO_SLOW) -> None:
        """Add a revolution; the newest reason stands for all."""
        self.why = why
        self.first = revolution if not self.count else min(self.first, revolution)
        self.last = max(self.last, revolution)
        self.count += 1

    def sentence(self) -> str:
        """Say which ones they are."""
        span = f"revolutions {self.first} to {self.last}" if self.count > 1 else ""
        return (
            f"{span or f'revolution {self.first}'}: {self.count} not predicted, {self.why}; "
            "their wear is made up for with the forces of later ones"
        )


class TwinLink:
    """Offer measured revolutions to the twin and hand its predictions on."""

    def __init__(
        self,
        setup: TwinSetup,
        on_prediction: Callable[[Prediction], None],
        folder: Path,
        on_report: Callable[[str], None] | None = None,
    ) -> None:
        """Start the thread and the worker.

        on_prediction, on_report: called from the twin's thread; a report is a sentence on what
        became of the twin, for the log.
        """
        self._setup = setup
        self._on_prediction = on_prediction
        self._on_report = on_report
        self._checkpoint = setup.checkpoint
        self._missed = Missed()
        self._missed_lock = threading.Lock()
        self._next_report = 0.0
        self._asked_again = -1
        self._newest = 0
        self._address = link_address(folder, f"twin-{os.getpid()}-{id(self):x}")
        self._mailbox: deque[RevolutionMeasured] = deque(maxlen=MAILBOX)
        self._wake = threading.Event()
        self._ready = threading.Event()
        self._stop = threading.Event()
        self.dropped = 0
        self.restarts = -1
        self.given_up = False
        self._barren = 0
        self.last_failure = ""
        self._worker: subprocess.Popen[bytes] | None = None
        self._thread = threading.Thread(target=self._run, name="twin", daemon=True)
        self._thread.start()

    def offer(self, measured: RevolutionMeasured) -> None:
        """Put a revolution into the mailbox; never blocks, drops the oldest when full."""
        if self.given_up:
            return
        with self._missed_lock:
            if len(self._mailbox) == MAILBOX:
                self._missed.add(self._mailbox.popleft().revolution)
                self.dropped += 1
            self._mailbox.append(measured)
        self._wake.set()

    def _report(self, sentence: str) -> None:
        if self._on_report is not None:
            self._on_report(sentence)

    def _report_missed(self, at_once: bool = False) -> None:
        """Report what was missed, unless the last report is fresh."""
        if not self._missed.count or not (at_once or time.monotonic() >= self._next_report):
            return
        with self._missed_lock:
            missed, self._missed = self._missed, Missed()
        self._next_report = time.monotonic() + REPORT_PAUSE_S
        self._report(missed.sentence())

    def wait_ready(self, timeout_s: float) -> bool:
        """Wait until the worker can predict; False when it cannot, or not within the time."""
        return self._ready.wait(timeout_s) and not self.given_up

    @property
    def worker_pid(self) -> int:
        """Return the worker's process number, 0 when there is none."""
        worker = self._worker
        return worker.pid if worker is not None and worker.poll() is None else 0

    def close(self, drain_s: float = 0.0) -> None:
        """End the worker, after at most ``drain_s`` for what is still in the mailbox."""
        deadline = time.monotonic() + drain_s
        while self._mailbox and self._thread.is_alive() and time.monotonic() < deadline:
            time.sleep(0.01)
        self._stop.set()
        self._wake.set()
        self._thread.join(timeout=ANSWER_S + 1.0)
        self._report_missed(at_once=True)

    def _run(self) -> None:
        context = zmq.Context()
        try:
            while not self._stop.is_set():
                self._barren += 1
                self._serve_one_worker(context)
                self.given_up |= self._barren >= ATTEMPTS
                if self._stop.is_set():
                    return
                if self.given_up:
                    self._report(f"{self.last_failure}: nothing more is predicted in this test")
                    self._ready.set()
                    return
                self._report(
                    f"{self.last_failure}, after revolution {self._newest}; it is started again"
                    " and goes on from there"
                )
                self._stop.wait(RESTART_PAUSE_S)
        finally:
            context.destroy(linger=0)
            if self._address.startswith("ipc://"):
                Path(self._address.removeprefix("ipc://")).unlink(missing_ok=True)

    def _serve_one_worker(self, context: zmq.Context[zmq.Socket[bytes]]) -> None:
        socket = context.socket(zmq.PAIR)
        socket.setsockopt(zmq.LINGER, 0)
        socket.setsockopt(zmq.SNDTIMEO, 1000)
        endpoint, environment = bind_link(socket, self._address)
        self.restarts += 1
        # What matters comes in its answers, not on its standard error.
        self._worker = start_module(
            "rigapp.twin.worker", endpoint, os.getpid(), environment=SINGLE_THREADED | environment
        )
        try:
            if not self._introduce(socket):
                return
            while not self._stop.is_set() and self._worker.poll() is None:
                if not self._mailbox:
                    self._wake.wait(0.1)
                    self._wake.clear()
                    continue
                if not self._exchange(socket):
                    return
            if not self._stop.is_set():
                self.last_failure = f"the twin ended with status {self._worker.returncode}"
        except zmq.ZMQError as error:
            self.last_failure = f"the twin cannot be reached ‹{error}›"
        finally:
            socket.close()
            self._worker.terminate()
            try:
                self._worker.wait(timeout=2.0)
            except subprocess.TimeoutExpired:
                self._worker.kill()
                self._worker.wait()

    def _introduce(self, socket: zmq.Socket[bytes]) -> bool:
        """Give the worker its model and wait until it can predict; False: start another."""
        deadline = time.monotonic() + START_S
        while not socket.poll(100, zmq.POLLOUT):
            if self._stop.is_set() or not self.worker_pid or time.monotonic() > deadline:
                self.last_failure = f"the twin did not come up within {START_S:g} s"
                return False
        setup = msgspec.structs.replace(self._setup, checkpoint=self._checkpoint)
        socket.send(msgspec.msgpack.encode(setup))
        answer = self._answer(socket, START_S)
        if answer is None or answer.failed:
            return False
        self._ready.set()
        return True

    def _exchange(self, socket: zmq.Socket[bytes]) -> bool:
        """Ask for one prediction; False when the worker must be started again."""
        with self._missed_lock:
            measured = self._mailbox.popleft()
        socket.send(msgspec.msgpack.encode(measured))
        answer = self._answer(socket, ANSWER_S)
        if answer is None or answer.failed:
            self._ask_again(measured)
            return False
        self._barren = 0
        prediction = answer.prediction
        if prediction is None:
            with self._missed_lock:
                self._missed.add(measured.revolution, answer.refused)
        else:
            self._checkpoint = prediction.checkpoint or self._checkpoint
            self._newest = prediction.revolution
            self._on_prediction(prediction)
        self._report_missed()
        return True

    def _ask_again(self, measured: RevolutionMeasured) -> None:
        """Keep a revolution for the next worker, unless two have failed on it."""
        with self._missed_lock:
            if self._asked_again == measured.revolution or len(self._mailbox) == MAILBOX:
                self._missed.add(measured.revolution, self.last_failure)
                self.dropped += 1
            else:
                self._asked_again = measured.revolution
                self._mailbox.appendleft(measured)

    def _answer(self, socket: zmq.Socket[bytes], patience: float) -> TwinAnswer | None:
        """Return what the worker says next; None when it died, is late, or nobody waits."""
        deadline = time.monotonic() + patience
        while time.monotonic() < deadline and not self._stop.is_set():
            gone = self._worker is None or self._worker.poll() is not None
            if socket.poll(100):
                return self._heard(msgspec.msgpack.decode(socket.recv(), type=TwinAnswer))
            if gone:
                self.last_failure = "the twin died"
                return None
        self.last_failure = f"the twin did not answer within {patience:g} s"
        return None

    def _heard(self, answer: TwinAnswer) -> TwinAnswer:
        """Pass on what a worker has to say besides its prediction."""
        for text in answer.said:
            self._report(text)
        if answer.failed:
            self.given_up |= answer.hopeless
            self.last_failure = answer.failed
        return answer
