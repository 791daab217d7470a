"""The messages between engine and twin, and the engine's end: a mailbox, a process, a thread.

The mailbox holds ``MAILBOX`` revolutions and drops the oldest: the twin predicts every revolution
that it can keep up with, and never delays the engine. A worker that dies or does not answer within
``ANSWER_S`` is started again with the newest checkpoint, so that its bushings are worn as they
were; the revolution that it failed on is sent once more. Skipped revolutions are reported, and
after ``ATTEMPTS`` workers that predicted nothing no other is started.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import msgspec
import zmq

from rigapp.config.parameters import ParameterFile
from rigapp.config.recipe import PriorSection
from rigapp.process.children import MessageChild, Restarts
from rigapp.schema.messages import Prediction, RevolutionMeasured
from rigapp.texts import say


class IdentificationTarget(msgspec.Struct, frozen=True):
    """Wear parameters to identify in a test, and the record of its probes.

    sensitivity: relative standard uncertainty; drift_um: drift of a position in a decade
    of revolutions, standard; None where no record states it. depth_um: of the stop criterion, None
    without one. planned: the last revolution. record: which one it is. prior: of the wear
    coefficient, None where the test file has none. load: relative standard uncertainty of the
    force, 0 where nothing states it.
    """

    sensitivity: float | None = None
    drift_um: float | None = None
    depth_um: float | None = None
    planned: float = 0.0
    record: str = ""
    prior: PriorSection | None = None
    load: float = 0.0

    @property
    def depth(self) -> float | None:
        """Return the depth of the stop criterion, m."""
        return None if self.depth_um is None else 1e-6 * self.depth_um


class TwinSetup(msgspec.Struct, frozen=True):
    """The model that the twin runs.

    new_position_um: mean pin position (probe_1, probe_2) of the new bushing, where the file of a
    resumed test has it; else the first revolutions give it. checkpoint: of an earlier twin of the
    same test, to continue from. new_test: that was another test of the same specimen, whose
    revolutions begin again; same_model: of both tests, else only the probes' reference of the new
    bushing counts. sought: what is to be identified. force_uncertainty_N: expanded (k = 2) of the
    measured force, constant and per N, None where nothing states it.
    """

    parameters: ParameterFile
    joint: str
    new_position_um: tuple[float, float] | None = None
    checkpoint: bytes = b""
    new_test: bool = False
    same_model: bool = True
    sought: IdentificationTarget = IdentificationTarget()
    force_uncertainty_N: tuple[float, float] | None = None


class TwinAnswer(msgspec.Struct, frozen=True):
    """The answer to the setup or to a revolution.

    refused: why there is no prediction of this revolution; the next one may have one. failed: why
    this process ends and another must take over. hopeless: no other would succeed. remarks:
    further notes to the operator.
    """

    prediction: Prediction | None = None
    refused: str = ""
    failed: str = ""
    hopeless: bool = False
    remarks: tuple[str, ...] = ()


MAILBOX = 64
START_S = 180.0  # importing and compiling, on a computer that is busy
ANSWER_S = 10.0
RESTART_PAUSE_S = 1.0
SEND_PAUSE_S = 0.05
CLOSE_S = 2.0
ATTEMPTS = 5
REPORT_PAUSE_S = 60.0
"""Gaps in the predictions are reported together, no more often than this."""
TOO_SLOW = say("the twin could not keep up")
SINGLE_THREADED = {"OPENBLAS_NUM_THREADS": "1"}
"""Default of the worker's environment: its matrices are small, and threads that wait for each other
make an update of the wear coefficient up to twice as long."""


@dataclass(slots=True)
class SkippedRevolutions:
    """Revolutions that were not predicted since the last report."""

    first: int = 0
    last: int = 0
    count: int = 0
    why: str = TOO_SLOW

    def add(self, revolution: int, why: str = TOO_SLOW) -> None:
        """Add a revolution; the newest reason is reported for all of them."""
        self.why = why
        self.first = revolution if not self.count else min(self.first, revolution)
        self.last = max(self.last, revolution)
        self.count += 1

    def sentence(self) -> str:
        """Return the skipped revolutions as a sentence."""
        span = say("revolutions {} to {}", self.first, self.last) if self.count > 1 else ""
        return say(
            "{}: {} not predicted, {}; their wear is added with the forces of later ones",
            span or say("revolution {}", self.first),
            self.count,
            self.why,
        )


class TwinLink:
    """Offer measured revolutions to the twin and forward its predictions."""

    def __init__(
        self,
        setup: TwinSetup,
        on_prediction: Callable[[Prediction], None],
        folder: Path,
        on_report: Callable[[str], None] | None = None,
    ) -> None:
        """Start the thread and the worker.

        on_prediction, on_report: called from the twin's thread; a report is a sentence on the state
        of the twin, for the log.
        """
        self._setup = setup
        self._on_prediction = on_prediction
        self._on_report = on_report
        self._checkpoint = setup.checkpoint
        self._missed = SkippedRevolutions()
        self._missed_lock = threading.Lock()
        self._next_report = 0.0
        self._asked_again = -1
        self._newest = 0
        self._folder = folder
        self._mailbox: deque[RevolutionMeasured] = deque(maxlen=MAILBOX)
        self._wake = threading.Event()
        self._ready = threading.Event()
        self._stop = threading.Event()
        self.dropped = 0
        self.restarts = -1
        self.given_up = False
        self._attempts = Restarts(RESTART_PAUSE_S, ATTEMPTS)
        self.last_failure = ""
        self._worker: MessageChild | None = None
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
        """Report skipped revolutions, unless the last report is recent."""
        if not self._missed.count or not (at_once or time.monotonic() >= self._next_report):
            return
        with self._missed_lock:
            missed, self._missed = self._missed, SkippedRevolutions()
        self._next_report = time.monotonic() + REPORT_PAUSE_S
        self._report(missed.sentence())

    def wait_ready(self, timeout_s: float) -> bool:
        """Wait until the worker can predict; False if it cannot, or on time-out."""
        return self._ready.wait(timeout_s) and not self.given_up

    @property
    def worker_pid(self) -> int:
        """Return the worker's process number, 0 when there is none."""
        worker = self._worker
        return worker.pid if worker is not None and worker.running else 0

    def close(self, drain_s: float = 0.0) -> None:
        """End the worker, after at most ``drain_s`` for the rest of the mailbox."""
        deadline = time.monotonic() + drain_s
        while self._mailbox and self._thread.is_alive() and time.monotonic() < deadline:
            time.sleep(0.01)
        self._stop.set()
        self._wake.set()
        self._thread.join(timeout=ANSWER_S + 1.0)
        self._report_missed(at_once=True)

    def _run(self) -> None:
        while not self._stop.is_set():
            self._attempts.started()
            self._serve_one_worker()
            self.given_up |= self._attempts.exhausted
            if self._stop.is_set():
                return
            if self.given_up:
                self._report(
                    say("{}: there will be no more predictions in this test", self.last_failure)
                )
                self._ready.set()
                return
            self._report(
                say(
                    "{}, after revolution {}; it is started again and continues from there",
                    self.last_failure,
                    self._newest,
                )
            )
            self._stop.wait(self._attempts.pause_s)

    def _serve_one_worker(self) -> None:
        self.restarts += 1
        worker = self._worker = MessageChild(
            "rigapp.twin.worker", self._folder, "twin", SINGLE_THREADED
        )
        try:
            if not self._introduce(worker):
                return
            while not self._stop.is_set() and worker.running:
                if not self._mailbox:
                    self._wake.wait(0.1)
                    self._wake.clear()
                    continue
                if not self._exchange(worker):
                    return
            if not self._stop.is_set():
                self.last_failure = say("the twin ended with status {}", worker.status)
        except zmq.ZMQError as error:
            self.last_failure = say("the twin cannot be reached ‹{}›", error)
        finally:
            worker.close(CLOSE_S)

    def _introduce(self, worker: MessageChild) -> bool:
        """Send the model to the worker and wait until it can predict; False: start another."""
        deadline = time.monotonic() + START_S
        setup = msgspec.structs.replace(self._setup, checkpoint=self._checkpoint)
        while not worker.send(setup):
            if self._stop.wait(SEND_PAUSE_S) or not worker.running or time.monotonic() > deadline:
                self.last_failure = say("the twin did not start within {:g} s", START_S)
                return False
        answer = self._answer(worker, START_S)
        if answer is None or answer.failed:
            return False
        self._ready.set()
        return True

    def _exchange(self, worker: MessageChild) -> bool:
        """Request one prediction; False when the worker must be started again."""
        with self._missed_lock:
            measured = self._mailbox.popleft()
        worker.send(measured)
        answer = self._answer(worker, ANSWER_S)
        if answer is None or answer.failed:
            self._ask_again(measured)
            return False
        self._attempts.succeeded()
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

    def _answer(self, worker: MessageChild, patience_s: float) -> TwinAnswer | None:
        """Return the worker's next answer; None when it died, is late, or the engine ends."""
        deadline = time.monotonic() + patience_s
        while time.monotonic() < deadline and not self._stop.is_set():
            answer = worker.receive(TwinAnswer, 0.1)
            if answer is not None:
                return self._heard(answer)
            if not worker.running:
                reason = worker.last_words()
                self.last_failure = say("the twin stopped")
                if reason:
                    self.last_failure = say("the twin stopped ‹{}›", reason)
                return None
        self.last_failure = say("the twin did not answer within {:g} s", patience_s)
        return None

    def _heard(self, answer: TwinAnswer) -> TwinAnswer:
        """Forward the remarks of a worker, and record its failure."""
        for text in answer.remarks:
            self._report(text)
        if answer.failed:
            self.given_up |= answer.hopeless
            self.last_failure = answer.failed
        return answer
