"""The running calibration for the wizard's pages: session, newest window, background work."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from enum import StrEnum
from pathlib import Path
from typing import Any, Protocol

from PySide6.QtCore import QObject, QTimer, Signal

from rigapp.calibrating.session import LiveSession, Outcome, Rig
from rigapp.calibrating.training import Action
from rigapp.config.calibration_settings import CalibrationFile
from rigapp.config.errors import UnusableInput
from rigapp.presentation.translation import translate
from rigapp.schema.messages import Reply
from rigapp.texts import sentence_of_error
from rigapp.viewer.tasks import TaskWorker
from rigapp_calibration.taking.procedure import ProcedureError
from rigapp_calibration.taking.signals import LISTEN_S, Readiness, SignalState

POLL_MS = 150
"""Polling period, short enough for an operator who waits; an answer has the last seconds."""
NOWHERE = (-1, -1)
Question = tuple[str, dict[str, Any]]
"""A verb of the engine and its arguments."""
AnySession = LiveSession[Any, Any, Any]


class AskLater(Protocol):
    """Send a request to the engine; the handler is called later on the GUI thread."""

    def __call__(
        self, verb: str, arguments: dict[str, Any], handler: Callable[[Reply], None], /
    ) -> None:
        """Send a request."""
        ...


class ActionQueue:
    """Send actions to the engine, each after the answer to the previous; a failure drops all."""

    def __init__(
        self, line: AskLater, acted: Callable[[float], None], failed: Callable[[str], None]
    ) -> None:
        """Set the engine; acted: called with the first device sample after an action."""
        self._line, self._acted, self._failed = line, acted, failed
        self._actions: deque[Action] = deque()
        self.busy = False
        self.prepared = False

    def add(self, actions: Iterable[Action]) -> None:
        """Append actions."""
        self._actions.extend(actions)
        if not self.busy:
            self._next()

    def prepare(self, actions: Iterable[Action]) -> None:
        """Append actions unless the rig is already prepared."""
        if not self.prepared:
            self.prepared = True
            self.add(actions)

    def drop(self) -> None:
        """Drop all actions; the engine restores the rig when the calibration ends."""
        self._actions.clear()

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


class LiveCalibration(QObject):
    """Poll the engine and hold the running calibration without blocking.

    question: the request sent periodically. view: the newest answer, None before the first. key: of
    the calibration that occupies the rig.
    """

    question: Question = ("signals", {"window_s": LISTEN_S})

    looked = Signal()
    moved = Signal()
    reported = Signal(str)
    evaluated = Signal()

    def __init__(self, line: AskLater, rig: Rig, session_type: type[AnySession]) -> None:
        """Set the engine, the source of the readings, and the type of the calibration."""
        super().__init__()
        self._line, self._session_type = line, session_type
        self.rig, self.practice = rig, session_type.practice
        self.key = ""
        self.hands_offered = True
        self.session: Any = None
        self.view: Mapping[str, Any] | None = None
        self.window: Any = None
        self.readiness: Readiness | None = None
        self.outcome: Outcome | None = None
        self.mistake: StrEnum = next(iter(self.practice.mistakes))
        self.goes_ahead = False
        self._since, self._acted_at = 0, -1
        self._requested = False
        self._done_for = NOWHERE
        self._hands = ActionQueue(line, self._acted, self._failed)
        self._worker = TaskWorker("calibration-fit", bound=4)
        self._timer = QTimer(self)
        self._timer.setInterval(POLL_MS)
        self._timer.timeout.connect(self.tick)
        self._timer.start()

    @property
    def trains(self) -> bool:
        """Return whether there is a simulated operator (simulated rig in training mode)."""
        return self.rig.simulated and self.hands_offered

    # --- the session -----------------------------------------------------------------------------

    def open(self, settings: CalibrationFile, journal: Path, plan: Any) -> None:
        """Start a calibration, or resume it if plan is None; raises UnusableInput."""
        self.close_session()
        self.session = self._session_type(
            settings, self.rig, journal, plan, keep_waiting_times=not self.trains
        )
        self.outcome = None
        self._since, self._acted_at, self._done_for = 0, -1, NOWHERE
        self.moved.emit()

    def close_session(self) -> None:
        """Close the session and its journal."""
        if self.session is not None:
            self.session.close()
            self.session = None

    def close(self) -> None:
        """Stop polling and release the rig; recorded readings stay."""
        self._timer.stop()
        self._hands.drop()
        self.close_session()
        self._worker.close()
        if self.key:
            self._line("calibration_end", {"key": self.key}, lambda reply: None)

    def tick(self) -> None:
        """Send the request again unless an answer is pending."""
        self._worker.deliver()
        if not self._requested:
            self._requested = True
            self._line(*self.question, self._received)

    def _received(self, reply: Reply) -> None:
        self._requested = False
        if not reply.ok:
            self.window = self.readiness = None
            if self.session is not None:
                self.reported.emit(translate(reply.sentence))
            self.looked.emit()
            return
        self.view = reply.result
        session = self.session
        if session is not None:
            self.window = session.window_of(reply.result)
            self.readiness = session.look(self.window)
        self.looked.emit()
        if session is None or self.hands_busy:
            return
        if self.goes_ahead:
            self._go_ahead(session)
        elif session.takes_itself and self.readiness is not None and self.readiness.ready:
            self.take()

    # --- actions of the operator -----------------------------------------------------------------

    def take(self, at: float | None = None) -> bool:
        """Record the present step, at the value read off (SI units); report a failure."""
        window = self.window
        return window is not None and self.attempt(lambda session: session.take(window, at))

    def reject(self, index: int, reason: str) -> bool:
        """Reject a reading with a reason."""
        return self.attempt(lambda session: session.reject(index, reason))

    def attempt(self, act: Callable[[Any], object]) -> bool:
        """Call a function with the session; report a failure."""
        if self.session is None:
            return False
        try:
            act(self.session)
        except (ProcedureError, UnusableInput) as error:
            self.reported.emit(translate(sentence_of_error(error)))
            self.moved.emit()
            return False
        self.reported.emit("")
        if self.window is not None:
            self.readiness = self.session.look(self.window)
        self.moved.emit()
        self.looked.emit()
        return True

    def evaluate(self) -> None:
        """Fit and check on a worker thread; ``evaluated`` is emitted afterwards."""
        self.outcome = None
        if self.session is not None:
            self.run(self.session.judge, self._evaluated)

    def run(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Run a function on a worker thread; report a failure."""
        self._worker.submit(
            work, done, lambda error: self.reported.emit(translate(sentence_of_error(error)))
        )

    def ask(self, verb: str, handler: Callable[[Reply], None]) -> None:
        """Send a request without arguments; the handler is called later."""
        self._line(verb, {}, handler)

    def _evaluated(self, outcome: Outcome) -> None:
        self.outcome = outcome
        self.evaluated.emit()

    # --- simulated operator ----------------------------------------------------------------------

    @property
    def hands_busy(self) -> bool:
        """Return whether the simulated operator is acting."""
        return self._hands.busy

    def plant(self, mistake: StrEnum) -> None:
        """Make the simulated operator err from the next action on."""
        self.mistake = mistake
        if self.session is not None:
            position = self.session.procedure.position
            self._since = position + (self._acted_at == position)
        if self._hands.prepared:
            self._hands.add(self.practice.plant(mistake))

    def perform_step(self) -> None:
        """Make the simulated operator perform the step."""
        if self.session is None or self.session.procedure.done:
            return
        self._acted_at = self.session.procedure.position
        self._hands.prepare((*self.practice.prepare, *self.practice.plant(self.mistake)))
        self._hands.add(self.practice.act(self.session, self.mistake, self._since))

    def _go_ahead(self, session: AnySession) -> None:
        if session.procedure.done:
            return
        here = (session.procedure.position, len(session.procedure.taken))
        steady = self.readiness is not None and self.readiness.state is SignalState.STEADY
        if self._done_for != here:
            self._done_for = here
            self.perform_step()
        elif steady and not session.reference_is_due:
            self.take()

    def _acted(self, after_sample: float) -> None:
        if self.session is not None and self.view is not None:
            self.session.changed_at(after_sample / float(self.view["sample_rate_Hz"]))

    def _failed(self, sentence: str) -> None:
        self.goes_ahead = False
        self.reported.emit(translate(sentence))
