"""`rigapp calibrate` with live readings step by step: a ``LiveSession`` on a terminal."""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from rigapp.calibrating.daily_history import STORE, history_result, verdict_lines
from rigapp.calibrating.load_cell_session import LoadCellSession
from rigapp.calibrating.records import refuse_existing
from rigapp.calibrating.session import LiveSession, Outcome, Rig
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.calibrating.training import Actions
from rigapp.commands.calibrate import ONE_SOURCE, calibrate_table, read_record, say_outcome
from rigapp.commands.live.engine_line import Ask, engine_line, occupied
from rigapp.config.calibration_settings import CalibrationFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document, read_rig
from rigapp.config.names import login_name
from rigapp_calibration.taking.procedure import ProcedureError
from rigapp_calibration.taking.signals import LISTEN_S

PATIENCE_S = 60.0
"""Longest wait for a steady signal: a weight that still swings then must be steadied by hand."""
COUNTED_S = 30.0
"""Period of messages about the remaining loading time."""
LEAVES_OUT = "s leaves the creep out, "
POLL_S = 0.03  # as fast as numbers can be read during an adjustment

AnySession = LiveSession[Any, Any, Any]
Say = Callable[[str], None]
Read = Callable[[str], str]


class SimulatedActions:
    """The simulated operator of a simulated rig, controlled by the practice of a calibration."""

    def __init__(self, session: AnySession, ask: Ask) -> None:
        """Set the calibration with its practice, and the engine."""
        self._session, self._ask = session, ask
        self.practice = session.practice

    def do(self, session: AnySession) -> None:
        """Perform the present step."""
        self.carry_out(self.practice.act(session, next(iter(self.practice.mistakes)), 0))

    def carry_out(self, actions: Actions) -> None:
        """Perform actions; report the device time of each change to the session."""
        rate = float(self._ask("signals", {"window_s": LISTEN_S})["sample_rate_Hz"])
        for action in actions:
            result = self._ask(action.verb, dict(action.arguments))
            after = float(result["after_sample"]) if isinstance(result, dict) else 0.0
            self._session.changed_at(after / rate)


class Terminal:
    """Guide the operator step by step; ``read`` is ``input`` or a script."""

    def __init__(
        self,
        session: AnySession,
        ask: Ask,
        read: Read,
        say: Say,
        hands: SimulatedActions | None = None,
    ) -> None:
        """Set the session, the engine and, in training, the simulated operator."""
        self._session, self._ask = session, ask
        self._read, self._say, self._hands = read, say, hands

    def run(self) -> bool:
        """Perform all steps; return False when the operator closes the session to resume later."""
        while not (procedure := self._session.procedure).done:
            self._say(f"\n[{procedure.progress}] {procedure.instruction}")
            try:
                if not self._step():
                    return False
            except ProcedureError as error:
                self._say(f"  {error}")
        return True

    def listen(self) -> Any:
        """Return the newest window."""
        return self._session.window_of(self._ask("signals", {"window_s": LISTEN_S}))

    def _step(self) -> bool:
        session = self._session
        at = None
        if self._hands is not None:
            self._hands.do(session)
        elif not session.takes_itself:
            optional = session.procedure.step.optional
            prompt = f"{LEAVES_OUT}{session.prompt}" if optional else session.prompt
            answer = self._read(prompt).strip().lower()
            if answer == "q":
                return False
            other = {"r": self._reject, "b": self._back, "n": self._note}.get(answer)
            if other is not None:
                other()
                return True
            if answer == "s" and optional:
                session.leave_out()
                return True
            at = session.typed(answer)
        try:
            window = self._wait_ready()
        except KeyboardInterrupt:
            if not session.takes_itself:
                raise
            return self._interrupted()
        if isinstance(session, LoadCellSession) and session.reference_is_due:
            self._reference(session, window.angle)
            return True
        seen, before = session.look(window), len(session.procedure.taken)
        session.take(window, at)
        if len(session.procedure.taken) > before:
            self._say(f"  recorded: {session.recorded(seen)}")
        return True

    def _interrupted(self) -> bool:
        """Ask whether to end the wait; return False when the operator closes the session."""
        answer = self._read(f"\n  {LEAVES_OUT}Enter goes on waiting, q closes: ").strip().lower()
        if answer == "s":
            self._session.leave_out()
        return answer != "q"

    def _reject(self) -> None:
        """List the valid readings, and reject one with a reason."""
        session = self._session
        for number, reading in enumerate(session.procedure.taken, 1):
            if not reading.rejected:
                self._say(f"  {number}: {session.describe(reading)}")
        word = self._read("  number of the reading: ").strip()
        if not word.isdigit():
            raise ProcedureError("That is not a number; nothing was rejected.")
        session.reject(int(word) - 1, self._read("  reason: "))

    def _back(self) -> None:
        """Repeat the newest reading, with a reason."""
        self._session.back(self._read("  reason: "))

    def _note(self) -> None:
        """Add a remark for record and certificate."""
        self._session.note(self._read("  note: "))
        self._say("  noted.")

    def _wait_ready(self) -> Any:
        """Return a window that is ready; raises ProcedureError after a time-out."""
        deadline = time.monotonic() + PATIENCE_S
        shown = ""
        while True:
            window = self.listen()
            seen = self._session.look(window)
            if seen.ready:
                return window
            text, words = seen.words, seen.words.partition(";")[0]
            if seen.left > 0.0:
                deadline = time.monotonic() + PATIENCE_S
                if self._session.takes_itself:
                    left = COUNTED_S * math.ceil(seen.left / COUNTED_S)
                    text = words = f"{words}; {left:g} s are left at most, Ctrl-C leaves it out"
            if words != shown and self._hands is None:
                self._say(f"  {text} …")
            shown = words
            if time.monotonic() > deadline:
                raise ProcedureError(f"it did not become steady in {PATIENCE_S:g} s: {seen.words}")
            time.sleep(POLL_S)

    def _reference(self, session: LoadCellSession, shown: float) -> None:
        """Enter the angle reference; the operator may turn the level end for end."""
        uncertainty = math.radians(session.settings_file.angle.standard_uncertainty_deg)
        if self._hands is not None:
            session.reference(shown, uncertainty)
            return
        first = self._angle("  angle with the crank level", shown)
        word = self._read(
            "  Turn the level end for end and the crank until it is level again; Enter, or s to do"
            " without: "
        )
        if word.strip().lower() == "s":
            session.reference(first, uncertainty)
            return
        second = self._angle("  angle with the level turned", self._wait_ready().angle)
        reference = session.reference_reversed(first, second)
        assert reference.level_error is not None
        self._say(
            f"  The level itself is off by {math.degrees(reference.level_error):+.2f} degrees."
        )

    def _angle(self, question: str, shown: float) -> float:
        word = self._read(f"{question} [{math.degrees(shown):.1f} degrees]: ").strip()
        try:
            return math.radians(float(word)) if word else shown
        except ValueError as error:
            raise ProcedureError(f"{word!r} is not a number of degrees") from error


def operator_of(settings: CalibrationFile) -> str:
    """Return the operator of the settings, else the login name."""
    return settings.paperwork.operator or login_name()


def sayer(as_json: bool) -> Say:
    """Return the function for messages to the operator, on standard error if JSON is printed."""

    def say(text: str) -> None:
        print(text, file=sys.stderr if as_json else sys.stdout, flush=True)

    return say


def calibrate(
    name: str,
    requested: Mapping[str, Any],
    settings: Path,
    to: Path,
    readings: Path | None,
    rig: Path | None,
    *,
    journal: Path | None,
    practise: bool,
    as_json: bool,
    former: Path | None = None,
    read: Read = input,
) -> int:
    """Calibrate a subject from a table or live; save an accepted record; return the exit status.

    requested: values of the plan by name (see the subject's ``plan``).
    """
    if (readings is None) == (rig is None):
        raise UnusableInput(ONE_SOURCE)
    if rig is None:
        which = requested.get("which", "")
        return calibrate_table(
            name, readings, settings, to, which=which, former=former, as_json=as_json
        )
    subject = SUBJECTS[name]
    assert subject.session is not None
    assert subject.plan is not None
    file = read_document(settings, subject.settings).record
    document = read_rig(rig)
    simulated = document.record.simulated
    if practise and not simulated:
        raise UnusableInput(
            f"--practise: {rig} is not simulated; a simulated operator moves nothing."
        )
    sensitivity = document.record.probes.sensitivity_um_per_V
    wanted = subject.plan({**requested, "sensitivity": sensitivity}, file)
    refuse_existing(to)
    where = journal or to.with_name(f"{to.name}.journal")
    operator = operator_of(file)
    here = Rig(document.record.name, simulated, operator, rig)
    session = subject.session(file, here, where, wanted, keep_waiting_times=not practise)
    say = sayer(as_json)
    try:
        with (
            engine_line(rig, operator, own=practise) as ask,
            occupied(ask, "daily check" if requested.get("plan") == "daily" else name),
        ):
            hands = SimulatedActions(session, ask) if practise else None
            if hands is not None:
                hands.carry_out(session.practice.prepare)
            terminal = Terminal(session, ask, read, say, hands)
            if not terminal.run():
                say(f"Closed. Take it up again with the same command; the journal is {where}.")
                return 1
            session.look(terminal.listen())
        outcome = session.judge()
        if outcome.check is not None:
            return _keep_check(session, outcome, to.parent / STORE, as_json=as_json, say=say)
        if former is not None:
            outcome = outcome.against(read_record(former))
        if outcome.accepted:
            outcome = session.save(outcome, to)
        return say_outcome(outcome, to, as_json=as_json)
    finally:
        session.close()


def _keep_check(
    session: AnySession, outcome: Outcome, store: Path, *, as_json: bool, say: Say
) -> int:
    assert isinstance(session, LoadCellSession)
    history = session.keep_check(outcome, store)
    if as_json:
        print(json.dumps({**outcome.result, "history": history_result(history)}))
    for line in dict.fromkeys((*outcome.lines, *verdict_lines(history))):
        say(line)
    say(f"It is kept in {STORE}; 'rigapp calibrate history' draws the chart.")
    return 0 if outcome.accepted and history.in_control else 1
