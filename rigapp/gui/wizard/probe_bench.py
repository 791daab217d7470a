"""What the probe wizard's pages share: session, newest window, simulated hands, work elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, QTimer, Signal

from calibration.load_cell.live import Readiness, Verdict
from calibration.load_cell.procedure import ProcedureError
from calibration.probes.live import ProbeWindow
from calibration.probes.procedure import ProbePlan
from rigapp.calibrating.live_calibration import Rig
from rigapp.calibrating.live_probes import LiveProbeSession, ProbeOutcome
from rigapp.calibrating.probe_practice import (
    ProbeMistake,
    probe_actions,
    probe_preparation,
    probe_tidy_up,
)
from rigapp.config.calibration_settings import ProbeFile
from rigapp.config.errors import UnusableInput
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.wizard.bench import LISTEN_S, LOOK_MS
from rigapp.gui.wizard.hands_queue import HandsQueue, Line
from rigapp.schema.messages import Reply


class ProbeBench(QObject):
    """Listen to the engine and hold the calibration under way; nothing here waits."""

    looked = Signal()
    moved = Signal()
    said = Signal(str)
    judged = Signal()

    def __init__(self, line: Line, rig: Rig) -> None:
        super().__init__()
        self._line = line
        self.rig = rig
        self.session: LiveProbeSession | None = None
        self.window: ProbeWindow | None = None
        self.readiness: Readiness | None = None
        self.outcome: ProbeOutcome | None = None
        self.sensitivity_um_per_V: list[float] = []
        self.rate_Hz = 1.0
        self.mistake = ProbeMistake.NONE
        self.goes_ahead = False
        self._since = 0
        self._asked = False
        self._done_for = (-1, -1)
        self._hands = HandsQueue(line, self._acted, self._failed)
        self._worker = TaskWorker("probe-fit", bound=4)
        self._timer = QTimer(self)
        self._timer.setInterval(LOOK_MS)
        self._timer.timeout.connect(self.tick)
        self._timer.start()

    # --- the session -----------------------------------------------------------------------------

    def open(self, given: ProbeFile, journal: Path, plan: ProbePlan | None) -> None:
        """Begin or take up a calibration; raise UnusableInput."""
        self.close_session()
        self.session = LiveProbeSession(
            given, self.rig, journal, plan, keep_waiting_times=not self.rig.simulated
        )
        self.outcome = None
        self._done_for = (-1, -1)
        self.moved.emit()

    def close_session(self) -> None:
        """Let the journal go."""
        if self.session is not None:
            self.session.close()
            self.session = None

    def close(self) -> None:
        """Stop listening, put the simulated rig together again; what was recorded stays."""
        self._timer.stop()
        self._hands.tidy_up(probe_tidy_up())
        self.close_session()
        self._worker.close()

    def tick(self) -> None:
        """Ask for the newest window unless an answer is still due."""
        self._worker.deliver()
        if not self._asked:
            self._asked = True
            self._line("signals", {"window_s": LISTEN_S}, self._heard)

    def _heard(self, reply: Reply) -> None:
        self._asked = False
        if not reply.ok:
            self.window = self.readiness = None
            self.said.emit(reply.sentence)
            self.looked.emit()
            return
        self.rate_Hz = float(reply.result["sample_rate_Hz"])
        self.sensitivity_um_per_V = list(reply.result["sensitivity_um_per_V"])
        session = self.session
        if session is not None:
            self.window = session.window_of(reply.result)
            self.readiness = session.look(self.window)
        self.looked.emit()
        if session is not None and self.goes_ahead and not self.hands_busy:
            self._go_ahead(session)

    # --- what the operator does ------------------------------------------------------------------

    def take(self, position: float | None = None) -> bool:
        """Take the step under way at a position (m); what stands against it is said."""
        window = self.window
        if window is None:
            return False
        return self._try(lambda session: session.take(window, position))

    def reject(self, index: int, reason: str) -> bool:
        """Reject a reading with a reason."""
        return self._try(lambda session: session.reject(index, reason))

    def judge(self) -> None:
        """Fit and check off the screen's thread; ``judged`` tells when it is done."""
        session = self.session
        self.outcome = None
        if session is not None:
            self.run(session.judge, self._judged)

    def run(self, work: Callable[[], Any], done: Callable[[Any], None]) -> None:
        """Do work off the screen's thread; a failure is said."""
        self._worker.submit(work, done, lambda error: self.said.emit(str(error)))

    def _judged(self, outcome: ProbeOutcome) -> None:
        self.outcome = outcome
        self.judged.emit()

    def _try(self, act: Callable[[LiveProbeSession], None]) -> bool:
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

    def plant(self, mistake: ProbeMistake) -> None:
        """Let the simulated hands make a mistake from the step under way on."""
        self.mistake = mistake
        if self.session is not None:
            self._since = self.session.procedure.position

    def lend_a_hand(self) -> None:
        """Let the simulated hands do what the step asks."""
        session = self.session
        if session is None or session.procedure.done:
            return
        self._hands.prepare(probe_preparation())
        self._hands.add(probe_actions(session.procedure, self.mistake, self._since))

    def _go_ahead(self, session: LiveProbeSession) -> None:
        if session.procedure.done:
            return
        here = (session.procedure.position, len(session.procedure.taken))
        if self._done_for != here:
            self._done_for = here
            self.lend_a_hand()
        elif self.readiness is not None and self.readiness.verdict is Verdict.STEADY:
            self.take()

    def _acted(self, after_sample: float) -> None:
        if self.session is not None:
            self.session.changed_at(after_sample / self.rate_Hz)

    def _failed(self, sentence: str) -> None:
        self.goes_ahead = False
        self.said.emit(sentence)
