"""`rigapp calibrate probes`: from a CSV of readings, or live on the terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

from calibration.load_cell.live import Readiness
from calibration.probes.alignment import calibrate_pair, split_pair
from calibration.probes.calibrate import calibrate_probe
from calibration.probes.live import ProbeWindow
from calibration.probes.procedure import ProbeStepKind
from calibration.probes.readings import parse_probe
from calibration.taking.readings import ReadingsError
from rigapp.calibrating.live_calibration import Rig
from rigapp.calibrating.live_probes import (
    PROBES,
    LiveProbeSession,
    outcome_lines,
    plan_of,
    usual_reach_um,
)
from rigapp.calibrating.probe_practice import (
    ProbeMistake,
    probe_actions,
    probe_preparation,
    probe_tidy_up,
)
from rigapp.calibrating.probe_results import pair_lines, pair_result, probe_lines, probe_result
from rigapp.calibrating.records import keep_record, refuse_existing
from rigapp.commands.calibrate import say_result
from rigapp.commands.engine_line import Ask, engine_line
from rigapp.commands.terminal_parts import LISTEN_S, act, ask_rejection, take_all, wait_ready
from rigapp.config.calibration_settings import read_probe_settings
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.reading import read_text


def calibrate_probes(readings: Path, settings: Path, to: Path, *, probe: str, as_json: bool) -> int:
    """Fit micrometer readings; keep a record when they are good; return the exit status.

    probe: "1" or "2" for one probe (the readings do not tell which), "both" for a pair, whose
    series are named 1.x and 2.x.
    """
    given, meaning = read_probe_settings(settings)
    if probe not in PROBES:
        raise UnusableInput(f"--probe {probe}: choose {', '.join(PROBES)}.")
    text = read_text(readings)
    try:
        taken = parse_probe(text)
    except ReadingsError as error:
        raise UnusableInput(f"{readings}: {error}.") from error
    refuse_existing(to)
    if probe == "both":
        pair = calibrate_pair(split_pair(taken), (meaning, meaning))
        kind, result, lines = "probe pair", pair_result(pair), pair_lines(pair)
    else:
        found = calibrate_probe(taken, meaning)
        kind, result, lines = "probe", probe_result(found), probe_lines(found)
    if result["accepted"]:
        keep_record(to, kind, text, given, result)
    say_result(result, to, as_json=as_json, lines=lines)
    return 0 if result["accepted"] else 1


class ProbeTerminal:
    """Ask the operator step by step; ``read`` is ``input`` or a script."""

    def __init__(
        self,
        session: LiveProbeSession,
        ask: Ask,
        read: Callable[[str], str],
        say: Callable[[str], None],
        hands: ProbeHands | None = None,
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
            self._take(None)
            return True
        word = self._read(
            "Enter records at this position (or type the micrometer's own um), r rejects,"
            " q closes: "
        )
        answer = word.strip().lower()
        if answer == "q":
            return False
        if answer == "r":
            self._reject()
            return True
        position = None
        if answer and self._session.procedure.step.kind is ProbeStepKind.READING:
            try:
                position = 1e-6 * float(answer.removesuffix("um").replace(",", "."))
            except ValueError:
                self._say("  Enter, a position in um, r or q.")
                return True
        self._take(position)
        return True

    def _reject(self) -> None:
        procedure = self._session.procedure
        standing = [
            f"{number}: series {procedure.steps[one.step].series}, {1e6 * one.position:g} um"
            for number, one in enumerate(procedure.taken, 1)
            if not one.rejected
        ]
        ask_rejection(standing, self._session.reject, self._read, self._say)

    def _wait_ready(self) -> ProbeWindow:
        """Return a window that is ready; raise ProcedureError when none comes in time."""
        session = self._session

        def listen() -> tuple[ProbeWindow, Readiness]:
            window = session.window_of(self._ask("signals", {"window_s": LISTEN_S}))
            return window, session.look(window)

        return wait_ready(listen, self._say if self._hands is None else lambda _: None)

    def _take(self, position: float | None) -> None:
        session = self._session
        window = self._wait_ready()
        found, step = session.look(window), session.procedure.step
        session.take(window, position)
        if step.kind is ProbeStepKind.READING:
            own = found.steadiness.mean[step.probe - 1]
            self._say(
                f"  recorded: {own:+.5f} V (the calibration in use makes {1e6 * found.felt:+.1f} um"
                " of it)"
            )


class ProbeHands:
    """Let the simulated hands do what the step asks, with a mistake from a step on."""

    def __init__(self, ask: Ask, mistake: ProbeMistake = ProbeMistake.NONE, since: int = 8) -> None:
        """Take the engine."""
        self._ask, self._mistake, self._since = ask, mistake, since

    def prepare(self) -> None:
        """Take the follower off."""
        for action in probe_preparation():
            act(self._ask, action)

    def tidy_up(self) -> None:
        """Put the follower on."""
        for action in probe_tidy_up():
            act(self._ask, action)

    def do(self, session: LiveProbeSession) -> None:
        """Do what the step under way asks."""
        procedure = session.procedure
        mistake = self._mistake if procedure.position >= self._since else ProbeMistake.NONE
        view = self._ask("signals", {"window_s": LISTEN_S})
        for action in probe_actions(procedure, mistake, self._since):
            session.changed_at(act(self._ask, action) / view["sample_rate_Hz"])


def calibrate_probes_live(
    rig: Path,
    settings: Path,
    to: Path,
    *,
    probe: str,
    plan: str,
    positions: int,
    reach_um: float | None,
    journal: Path | None,
    practise: bool,
    as_json: bool,
    read: Callable[[str], str] = input,
) -> int:
    """Take micrometer steps on the terminal, keep a record when they are good; the exit status."""
    given, _ = read_probe_settings(settings)
    document = read_rig(rig)
    simulated = document.record.simulation is not None
    if practise and not simulated:
        raise UnusableInput(f"--practise: {rig} is not simulated; simulated hands move nothing.")
    usual = usual_reach_um(
        document.record.probes.sensitivity_um_per_V, given.probe.range_V, max(positions, 2)
    )
    wanted = plan_of(probe, plan, reach_um, positions, usual)
    refuse_existing(to)
    where = journal or to.with_name(f"{to.name}.journal")
    operator = given.paperwork.operator or os.environ.get("USER", "")
    session = LiveProbeSession(
        given,
        Rig(document.record.name, simulated, operator),
        where,
        wanted,
        keep_waiting_times=not practise,
    )

    def say(text: str) -> None:
        print(text, file=sys.stderr if as_json else sys.stdout, flush=True)

    try:
        with engine_line(rig, operator, own=practise) as ask:
            hands = ProbeHands(ask) if practise else None
            if hands is not None:
                hands.prepare()
            if not ProbeTerminal(session, ask, read, say, hands).run():
                say(f"Closed. Take it up again with the same command; the journal is {where}.")
                return 1
            session.look(session.window_of(ask("signals", {"window_s": LISTEN_S})))
            if hands is not None:
                hands.tidy_up()
        return _conclude(session, to, as_json=as_json)
    finally:
        session.close()


def _conclude(session: LiveProbeSession, to: Path, *, as_json: bool) -> int:
    outcome = session.judge()
    if outcome.accepted:
        outcome = session.save(outcome, to)
    say_result(outcome.result, to, as_json=as_json, lines=outcome_lines(outcome))
    return 0 if outcome.accepted else 1
