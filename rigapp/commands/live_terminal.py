"""`rigapp calibrate load-cell` with live readings: the terminal's face of ``LiveSession``."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable
from pathlib import Path

from calibration.load_cell.live import Readiness, Window
from calibration.load_cell.plans import PlanKind, StepKind
from calibration.load_cell.procedure import ProcedureError
from rigapp.calibrating.daily_history import STORE, History, history_result, verdict_lines
from rigapp.calibrating.live_calibration import (
    PLANS,
    LiveSession,
    Outcome,
    Rig,
    Wish,
    parse_pieces,
    window_of,
)
from rigapp.calibrating.load_cell_result import cell_lines
from rigapp.calibrating.practice import Mistake, preparation, step_actions, tidy_up
from rigapp.calibrating.records import refuse_existing
from rigapp.commands.calibrate import say_result
from rigapp.commands.engine_line import Ask, engine_line
from rigapp.commands.terminal_parts import LISTEN_S, act, ask_rejection, take_all, wait_ready
from rigapp.config.calibration_settings import read_load_cell_settings
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig


class Terminal:
    """Ask the operator step by step; ``read`` is ``input`` or a script."""

    def __init__(
        self,
        session: LiveSession,
        ask: Ask,
        read: Callable[[str], str],
        say: Callable[[str], None],
        hands: Hands | None = None,
    ) -> None:
        """Take the session, the engine and, for a practice, the simulated hands."""
        self._session, self._ask = session, ask
        self._read, self._say, self._hands = read, say, hands

    def run(self) -> bool:
        """Take every step; return False when the operator closes it to take it up again."""
        session = self._session
        return take_all(lambda: session.procedure, self._step, self._say)

    def _step(self) -> bool:
        if self._hands is not None:
            self._hands.do(self._session)
            self._take(self._wait_ready())
            return True
        answer = self._read("Enter records, r rejects, q closes: ").strip().lower()
        if answer == "q":
            return False
        if answer == "r":
            self._reject()
        elif answer == "":
            self._take(self._wait_ready())
        else:
            self._say("  Enter, r or q.")
        return True

    def _reject(self) -> None:
        taken = self._session.procedure.taken
        standing = [
            f"{number}: {one.mass:g} kg at {math.degrees(one.angle):.1f} degrees"
            for number, one in enumerate(taken, 1)
            if not one.rejected
        ]
        ask_rejection(standing, self._session.reject, self._read, self._say)

    def _wait_ready(self) -> Window:
        """Return a window that is ready; raise ProcedureError when none comes in time."""
        session = self._session

        def listen() -> tuple[Window, Readiness]:
            window = window_of(self._ask("signals", {"window_s": LISTEN_S}))
            return window, session.look(window)

        return wait_ready(listen, self._say if self._hands is None else lambda _: None)

    def _take(self, window: Window) -> None:
        session = self._session
        kind = session.procedure.step.kind
        if kind is StepKind.ANGLE_REFERENCE:
            self._reference(window)
            return
        found = session.look(window)
        session.take(window)
        if kind is StepKind.READING:
            self._say(f"  {_recorded(found, session.given.cell.signal_unit)}")

    def _reference(self, window: Window) -> None:
        assert window.angle is not None
        shown = window.angle
        if self._hands is not None:
            uncertainty = math.radians(self._session.given.angle.standard_uncertainty_deg)
            self._session.reference(shown, uncertainty)
            return
        first = self._angle("  angle with the crank level", shown)
        word = self._read(
            "  Turn the level end for end and the crank until it is level again; Enter, or s to do"
            " without: "
        )
        if word.strip().lower() == "s":
            uncertainty = math.radians(self._session.given.angle.standard_uncertainty_deg)
            self._session.reference(first, uncertainty)
            return
        window = self._wait_ready()
        assert window.angle is not None
        second = self._angle("  angle with the level turned", window.angle)
        found = self._session.reference_reversed(first, second)
        assert found.level_error is not None
        self._say(f"  The level itself is off by {math.degrees(found.level_error):+.2f} degrees.")

    def _angle(self, question: str, shown: float) -> float:
        word = self._read(f"{question} [{math.degrees(shown):.1f} degrees]: ").strip()
        try:
            return math.radians(float(word)) if word else shown
        except ValueError as error:
            raise ProcedureError(f"{word!r} is not a number of degrees") from error


def _recorded(found: Readiness, unit: str) -> str:
    one, two = found.steadiness.mean
    return (
        f"recorded: {one:.5f}, {two:.5f} {unit}"
        f" (the calibration in use makes {found.felt:.1f} N of it)"
    )


class Hands:
    """Let the simulated hands do what the step asks, with a mistake where one is wanted."""

    def __init__(self, ask: Ask, mistake: Mistake = Mistake.NONE, at: int = 8) -> None:
        """Take the engine; the mistake is made at the step number ``at`` only."""
        self._ask, self._mistake, self._at = ask, mistake, at

    def prepare(self) -> None:
        """Take the follower off and find the index."""
        for action in preparation():
            act(self._ask, action)

    def tidy_up(self) -> None:
        """Put the follower on."""
        for action in tidy_up():
            act(self._ask, action)

    def do(self, session: LiveSession) -> None:
        """Do what the step under way asks."""
        settings, procedure = session.settings, session.procedure
        mistake = self._mistake if procedure.position == self._at else Mistake.NONE
        view = self._ask("signals", {"window_s": LISTEN_S})
        for action in step_actions(
            procedure, mistake, settings.place.gravity, settings.weights.hanger_mass
        ):
            after = act(self._ask, action)
            session.changed_at(after / view["sample_rate_Hz"])


def calibrate_live(
    rig: Path,
    settings: Path,
    to: Path,
    *,
    plan: str,
    weights: str,
    journal: Path | None,
    practise: bool,
    as_json: bool,
    read: Callable[[str], str] = input,
) -> int:
    """Take the readings on the terminal and keep a record when they are good; the exit status."""
    given, meaning = read_load_cell_settings(settings)
    document = read_rig(rig)
    if plan not in PLANS:
        raise UnusableInput(f"--plan {plan}: choose {', '.join(PLANS)}.")
    simulated = document.record.simulation is not None
    if practise and not simulated:
        raise UnusableInput(f"--practise: {rig} is not simulated; simulated hands move nothing.")
    refuse_existing(to)
    wish = Wish(PLANS[plan], parse_pieces(weights))
    where = journal or to.with_name(f"{to.name}.journal")
    operator = given.paperwork.operator or os.environ.get("USER", "")
    session = LiveSession(
        given,
        meaning,
        Rig(document.record.name, simulated, operator, rig),
        where,
        wish,
        keep_waiting_times=not practise,
    )

    def say(text: str) -> None:
        print(text, file=sys.stderr if as_json else sys.stdout, flush=True)

    try:
        with engine_line(rig, operator, own=practise) as ask:
            hands = Hands(ask) if practise else None
            if hands is not None:
                hands.prepare()
            if not Terminal(session, ask, read, say, hands).run():
                say(f"Closed. Take it up again with the same command; the journal is {where}.")
                return 1
            session.look(window_of(ask("signals", {"window_s": LISTEN_S})))
            if hands is not None:
                hands.tidy_up()
        return _conclude(session, to, as_json=as_json, say=say)
    finally:
        session.close()


def _conclude(session: LiveSession, to: Path, *, as_json: bool, say: Callable[[str], None]) -> int:
    outcome = session.judge()
    if session.procedure.kind is PlanKind.DAILY:
        history = session.keep_check(outcome, to.parent / STORE)
        return _say_check(outcome, history, as_json=as_json, say=say)
    assert outcome.calibration is not None
    lines = cell_lines(outcome.calibration, outcome.settings)
    if outcome.accepted:
        outcome = session.save(outcome, to)
    say_result(outcome.result, to, as_json=as_json, lines=lines)
    return 0 if outcome.accepted else 1


def _say_check(
    outcome: Outcome, history: History, *, as_json: bool, say: Callable[[str], None]
) -> int:
    if as_json:
        import json

        print(json.dumps({**outcome.result, "history": history_result(history)}))
    assert outcome.check is not None
    say(outcome.check.sentence)
    for line in verdict_lines(history):
        say(line)
    say(f"It is kept in {STORE}; 'rigapp calibrate history' draws the chart.")
    return 0 if outcome.accepted else 1
