"""What the wizard's pages share: session, newest window, simulated hands, work off the screen."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from calibration.load_cell.live import WINDOW_S, Readiness, Verdict, Window
from calibration.load_cell.plans import StepKind
from calibration.load_cell.procedure import ProcedureError
from rigapp.calibrating.live_calibration import LiveSession, Outcome, Rig, Wish, window_of
from rigapp.calibrating.practice import (
    Mistake,
    mistake_actions,
    preparation,
    step_actions,
    tidy_up,
)
from rigapp.config.calibration_settings import LoadCellFile, load_cell_meaning
from rigapp.config.errors import UnusableInput
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.wizard.hands_queue import HandsQueue, Line
from rigapp.schema.messages import Reply

LOOK_MS = 150
LISTEN_S = WINDOW_S + 1.0


class Bench(QObject):
    """Listen to the engine and hold the calibration under way; nothing here waits."""

    looked = Signal()
    moved = Signal()
    said = Signal(str)
    judged = Signal()

    def __init__(self, line: Line, rig: Rig) -> None:
        super().__init__()
        self._line = line
        self.rig = rig
        self.session: LiveSession | None = None
        self.window: Window | None = None
        self.readiness: Readiness | None = None
        self.outcome: Outcome | None = None
        self.rate_Hz = 1.0
        self.mistake = Mistake.NONE
        self.goes_ahead = False
        self._asked = False
        self._done_for = (-1, -1)
        self._hands = HandsQueue(line, self._acted, self._failed)
        self._worker = TaskWorker("calibration-fit", bound=4)
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_MS)
        self._timer.timeout.connect(self.tick)

    # --- the session -----------------------------------------------------------------------------

    def open(self, given: LoadCellFile, journal: Path, wish: Wish | None) -> None:
        """Begin or take up a calibration; raise UnusableInput."""
        self.close_session()
        settings = load_cell_meaning(given, "settings")
        self.session = LiveSession(
            given, settings, self.rig, journal, wish, keep_waiting_times=not self.rig.simulated
        )
        self.outcome = None
        self._timer.start()
        self.moved.emit()

    def close_session(self) -> None:
        """Let the journal go."""
        if self.session is not None:
            self.session.close()
            self.session = None

    def close(self) -> None:
        """Stop listening, put the simulated rig together again; what was recorded stays."""
        self._timer.stop()
        self._hands.tidy_up(tidy_up())
        self.close_session()
        self._worker.close()

    def tick(self) -> None:
        """Ask for the newest window unless an answer is still due."""
        self._worker.deliver()
        if not self._asked and self.session is not None:
            self._asked = True
            self._line("signals", {"window_s": LISTEN_S}, self._heard)

    def _heard(self, reply: Reply) -> None:
        self._asked = False
        session = self.session
        if session is None:
            return
        if not reply.ok:
            self.window = self.readiness = None
            self.said.emit(reply.sentence)
            self.looked.emit()
            return
        self.rate_Hz = float(reply.result["sample_rate_Hz"])
        self.window = window_of(reply.result)
        self.readiness = session.look(self.window)
        self.looked.emit()
        if self.goes_ahead and not self.hands_busy and not session.procedure.done:
            self._go_ahead(session)

    # --- what the operator does ------------------------------------------------------------------

    def take(self) -> bool:
        """Take the step under way; what stands against it is said."""
        if self.session is None or self.window is None:
            return False
        return self._try(lambda session: session.take(self.window))  # type: ignore[arg-type]

    def reference(self, shown: float, uncertainty: float) -> bool:
        """Take the angle reference, rad."""
        return self._try(lambda session: session.reference(shown, uncertainty))

    def reference_reversed(self, first: float, second: float) -> bool:
        """Take the angle reference with the level turned end for end, rad."""
        return self._try(lambda session: session.reference_reversed(first, second))

    def reject(self, index: int, reason: str) -> bool:
        """Reject a reading with a reason."""
        return self._try(lambda session: session.reject(index, reason))

    def judge(self) -> None:
        """Fit and check off the screen's thread; ``judged`` tells when it is done."""
        session = self.session
        self.outcome = None
        if session is None:
            return
        self._worker.submit(session.judge, self._judged, lambda error: self.said.emit(str(error)))

    def run(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Do work off the screen's thread; a failure is said."""
        self._worker.submit(work, done, lambda error: self.said.emit(str(error)))

    def _judged(self, outcome: Outcome) -> None:
        self.outcome = outcome
        self.judged.emit()

    def _try(self, act: Callable[[LiveSession], object]) -> bool:
        if self.session is None:
            return False
        try:
            act(self.session)
        except (ProcedureError, UnusableInput) as error:
            self.said.emit(str(error))
            return False
        self.said.emit("")
        if self.window is not None:
            self.readiness = self.session.look(self.window)
        self.moved.emit()
        self.looked.emit()
        return True

    # --- simulated hands -------------------------------------------------------------------------

    @property
    def hands_busy(self) -> bool:
        """Tell whether the simulated hands are at work."""
        return self._hands.busy

    def plant(self, mistake: Mistake) -> None:
        """Let the simulated hands make a mistake from now on."""
        self.mistake = mistake
        if self._hands.prepared:
            self._hands.add(mistake_actions(mistake))

    def lend_a_hand(self) -> None:
        """Let the simulated hands do what the step asks."""
        session = self.session
        if session is None or session.procedure.done:
            return
        self._hands.prepare((*preparation(), *mistake_actions(self.mistake)))
        settings = session.settings
        self._hands.add(
            step_actions(
                session.procedure,
                self.mistake,
                settings.place.gravity,
                settings.weights.hanger_mass,
            )
        )

    def _go_ahead(self, session: LiveSession) -> None:
        here = (session.procedure.position, len(session.procedure.taken))
        if self._done_for != here:
            self._done_for = here
            self.lend_a_hand()
        elif (
            self.readiness is not None
            and self.readiness.verdict is Verdict.STEADY
            and session.procedure.step.kind is not StepKind.ANGLE_REFERENCE
        ):
            self.take()

    def _acted(self, after_sample: float) -> None:
        if self.session is not None:
            self.session.changed_at(after_sample / self.rate_Hz)

    def _failed(self, sentence: str) -> None:
        self.goes_ahead = False
        self.said.emit(sentence)
