"""The live calibration without a face: journal, steadiness, rejection, record, terminal."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.calibrating.journal import Journal
from rigapp.calibrating.load_cell_session import LoadCellSession, load_cell_plan, parse_pieces
from rigapp.calibrating.session import Rig
from rigapp.calibrating.training import WeighingMistake
from rigapp.commands.live.terminal import LISTEN_S, SimulatedActions, Terminal, _keep_check
from rigapp.config.calibration_settings import LoadCellFile, load_cell_meaning
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document
from rigapp_calibration.load_cell.plans import WEIGHING
from rigapp_calibration.records import unseal
from rigapp_calibration.taking.procedure import ProcedureError, StepKind, take_up
from rigapp_calibration.taking.signals import SignalState
from tests.gui_calibration.clumsy import ClumsyHands


def begin(
    path: Path, settings: Path, rig: Rig, plan: str = "routine", **more: Any
) -> LoadCellSession:
    given = read_document(settings, LoadCellFile).record
    wanted = load_cell_plan({"plan": plan, "weights": "5x8, 2, 2, 1, 0.5"}, given)
    more.setdefault("keep_waiting_times", False)
    return LoadCellSession(given, rig, path, wanted, **more)


def finish(
    session: LoadCellSession, scripted: Any, hands: SimulatedActions | None = None
) -> list[str]:
    said: list[str] = []
    hands = hands or SimulatedActions(session, scripted.ask)
    assert Terminal(session, scripted.ask, lambda _: "", said.append, hands).run()
    return said


def test_whole_calibration_finds_the_hidden_matrix(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path, true_matrix: np.ndarray
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    assert not any("CHECK" in line for line in finish(session, scripted))
    outcome = session.judge()
    assert outcome.accepted, outcome.result["problems"]
    found = np.array(outcome.result["matrix_N_per_unit"])
    uncertainty = np.array(outcome.result["matrix_standard_uncertainty_N_per_unit"])
    assert np.all(np.abs(found - true_matrix) < 3.0 * uncertainty)
    saved = session.save(outcome, tmp_path / "c.json")
    record = unseal((tmp_path / "c.json").read_bytes())
    assert saved.saved == tmp_path / "c.json"
    assert record.content["taken"]["simulated"] is True
    assert record.content["taken"]["plan"] == "routine"
    # The hidden cell creeps by 0.1 % from 30 s to 300 s; readings repeat to 0.01 N.
    assert outcome.result["characteristics_percent"]["creep_c"] == pytest.approx(0.1, abs=0.02)
    with pytest.raises(UnusableInput, match="never overwritten"):
        session.save(outcome, tmp_path / "c.json")


def test_planted_mistake_is_named_and_nothing_is_saved(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    wrong = WeighingMistake.WRONG_WEIGHT
    said = finish(session, scripted, ClumsyHands(session, scripted.ask, wrong, 8, only=True))
    # The wrong piece is told at its own reading, and at no other one.
    (told,) = (line for line in said if "Check the pieces" in line)
    assert said.index(told) < 30
    outcome = session.judge()
    assert not outcome.accepted
    assert "wrong_weight" in {one["code"] for one in outcome.result["problems"]}
    with pytest.raises(UnusableInput, match="refused"):
        session.save(outcome, tmp_path / "c.json")
    assert not (tmp_path / "c.json").exists()


def test_the_terminal_goes_one_step_back_and_notes(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session, said = begin(tmp_path / "c.journal", settings_file, simulated), []
    hands, more = SimulatedActions(session, scripted.ask), ["b", "a wrong piece", "n", "door open"]

    def read(prompt: str) -> str:
        if len(session.procedure.taken) == 2 and more:
            return more.pop(0)
        if len(session.procedure.taken) > 2:
            return "q"
        hands.do(session)
        return "s" if "end for end" in prompt else ""

    assert not Terminal(session, scripted.ask, read, said.append).run()
    assert [one.rejected for one in session.procedure.taken] == ["", "a wrong piece", ""]
    assert session.procedure.told("note")["text"] == "door open"
    assert "# rejected (a wrong piece)" in session.readings_csv()


def test_exchanged_plugs_are_told_at_the_first_preload(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    scripted.faults.add("swapped_bridges")
    session.look(session.window_of(scripted.ask("signals", {})))
    session.reference(0.0, 0.001)
    hands = SimulatedActions(session, scripted.ask)
    while session.procedure.step.kind is not StepKind.PRELOAD:
        hands.do(session)
        session.take(session.window_of(scripted.ask("signals", {})))
    hands.do(session)
    with pytest.raises(ProcedureError, match="the two signals are swapped: exchange the two"):
        session.take(session.window_of(scripted.ask("signals", {})))
    assert session.procedure.step.kind is StepKind.PRELOAD
    assert not session.procedure.taken
    scripted.faults.clear()
    session.take(session.window_of(scripted.ask("signals", {})))
    assert session.procedure.step.value == 0.0


def test_swinging_weight_is_never_recorded(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    session.look(session.window_of(scripted.ask("signals", {})))
    session.reference(0.0, 0.001)
    hands = SimulatedActions(session, scripted.ask)
    while (
        session.procedure.step.value < 10.0 or session.procedure.step.kind is not StepKind.READING
    ):
        hands.do(session)
        session.take(session.window_of(scripted.ask("signals", {})))
    hands.do(session)
    scripted.faults.add("swinging_weight")
    window = session.window_of(scripted.ask("signals", {"window_s": LISTEN_S}))
    found = session.look(window)
    assert found.state is SignalState.MOVING
    assert "swinging" in found.words
    before = len(session.procedure.taken)
    with pytest.raises(ProcedureError, match="swinging"):
        session.take(window)
    assert len(session.procedure.taken) == before


def test_waiting_time_is_kept(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    path = tmp_path / "c.journal"
    session = begin(path, settings_file, simulated, "daily", keep_waiting_times=True)
    session.look(session.window_of(scripted.ask("signals", {})))
    session.reference(0.0, 0.001)
    session.take(session.window_of(scripted.ask("signals", {})))
    first = session.look(session.window_of(scripted.ask("signals", {})))
    assert not first.ready
    assert "s of the waiting time are left" in first.words
    scripted.now += 7.0
    assert session.look(session.window_of(scripted.ask("signals", {}))).ready


def test_angle_must_be_known_and_near(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    scripted.angle_deg = None
    assert "index" in session.look(session.window_of(scripted.ask("signals", {}))).words
    scripted.angle_deg = 1.0
    session.look(session.window_of(scripted.ask("signals", {})))
    with pytest.raises(ProcedureError, match="index_angle_deg"):
        session.reference(math.radians(270.0), 0.001)
    session.reference(math.radians(0.4), 0.001)
    assert session.angle_reference["offset"] == pytest.approx(math.radians(-0.4))
    scripted.angle_deg = 40.0
    found = session.look(session.window_of(scripted.ask("signals", {})))
    assert "turn the pin to 0" in found.words
    assert not found.ready


def test_closed_and_taken_up_again(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    path = tmp_path / "c.journal"
    session = begin(path, settings_file, simulated)
    answers = iter([""] * 5 + ["q"])
    terminal = Terminal(session, scripted.ask, lambda _: next(answers), lambda _: None)
    scripted.angle_deg = 0.0
    assert not terminal.run()
    before = session.procedure
    session.close()
    with path.open("ab") as stream:
        stream.write(b'{"event": "record", "ang')
    given = read_document(settings_file, LoadCellFile).record
    again = LoadCellSession(given, simulated, path, None)
    assert again.procedure.position == before.position
    assert again.procedure.taken == before.taken
    assert path.read_bytes().endswith(b"\n")
    with pytest.raises(UnusableInput, match="another calibration"):
        LoadCellSession(given, simulated, path, None)
    again.close()
    with pytest.raises(UnusableInput, match="this is"):
        LoadCellSession(given, Rig("Other", False), path, None)


def test_journal_that_was_never_used_leaves_nothing(
    settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    session.close()
    assert not (tmp_path / "c.journal").exists()


def test_every_event_is_in_the_journal_at_once(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    path = tmp_path / "c.journal"
    session = begin(path, settings_file, simulated, "daily")
    session.look(session.window_of(scripted.ask("signals", {})))
    session.reference(0.0, 0.001)
    for _ in range(4):
        SimulatedActions(session, scripted.ask).do(session)
        session.take(session.window_of(scripted.ask("signals", {})))
        kinds = [json.loads(line)["event"] for line in path.read_text().splitlines()]
        assert kinds == [event["event"] for event in session.procedure.events]


def test_series_with_a_wrong_weight_is_repeated_at_the_end(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    path = tmp_path / "c.journal"
    session = begin(path, settings_file, simulated)
    finish(
        session,
        scripted,
        ClumsyHands(session, scripted.ask, WeighingMistake.WRONG_WEIGHT, 8, only=True),
    )
    assert not session.judge().accepted
    wrong = next(i for i, one in enumerate(session.procedure.taken) if one.step == 8)
    session.reject(wrong, "5 kg instead of 2 kg hung")
    assert session.procedure.step.kind is StepKind.SET_UP
    finish(session, scripted)
    assert len(session.procedure.taken) == 110 + 2 + 11
    outcome = session.judge()
    assert outcome.accepted
    session.save(outcome, tmp_path / "c.json")
    csv = unseal((tmp_path / "c.json").read_bytes()).content["readings_csv"]
    assert csv.count("# rejected (") == 11
    assert "5 kg instead of 2 kg hung" in csv


def test_daily_check_passes_and_fails(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "d.journal", settings_file, simulated, "daily")
    finish(session, scripted)
    outcome = session.judge()
    # The hidden matrix has 1.5 % cross-talk that the calibration in use (200 N per mV/V) has not.
    assert outcome.check is not None
    assert not outcome.accepted
    assert outcome.check.largest == pytest.approx(0.0145 * 400.0, rel=0.2)
    matrix = np.array([[201.0, 3.0], [2.0, 198.0]])
    session.newest = replace(session.newest, matrix=matrix, zero=np.zeros(2))
    assert session.judge().accepted


def test_level_turned_end_for_end_goes_into_record_and_budget(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    answers = iter(["", "0.3", "", "359.9", "q"])
    said: list[str] = []
    Terminal(session, scripted.ask, lambda _: next(answers), said.append).run()
    assert any("off by +0.20 degrees" in text for text in said)
    procedure = take_up(WEIGHING, session.journal.read())
    assert np.degrees(procedure.told("reference")["offset"]) == pytest.approx(-0.1)
    given = session.used_settings()
    settings = load_cell_meaning(given, "settings")
    assert given.angle.level_readings_deg == pytest.approx((0.3, 359.9))
    assert np.degrees(settings.angle_uncertainty) == pytest.approx(0.02 / np.sqrt(2.0))


def test_terminal_rejects_with_a_reason(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    script = ["", "", "s", "", "", "", "", "r", "1", "bumped", "x", "q"]
    said: list[str] = []
    answers = iter(script)
    Terminal(session, scripted.ask, lambda _: next(answers), said.append).run()
    assert [one.rejected for one in session.procedure.taken] == ["bumped"]
    assert any("Enter, b, r, n or q" in text for text in said)


def test_engine_that_refuses_is_said(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "c.journal", settings_file, simulated)
    scripted.refuses = "A test is running."
    with pytest.raises(UnusableInput, match="A test is running"):
        Terminal(session, scripted.ask, lambda _: "", lambda _: None).run()


@pytest.mark.parametrize("text", ["", "abc", "5x0", "9900", "5x8, zwei", "0"])
def test_weights_that_cannot_be_are_refused(text: str) -> None:
    with pytest.raises(UnusableInput, match="weights"):
        parse_pieces(text)


def test_weights_in_words() -> None:
    assert parse_pieces("5x2, 0.5 kg; 2×1") == (5.0, 5.0, 2.0, 0.5)


def test_journal_with_a_bad_line_names_it(tmp_path: Path) -> None:
    path = tmp_path / "j"
    path.write_text('{"event": "begin"}\n[]\n', "utf-8")
    with pytest.raises(UnusableInput, match="line 2"):
        Journal(path).read()


def test_the_command_of_a_kept_daily_check_begins_a_new_one(
    scripted: Any, settings_file: Path, simulated: Rig, tmp_path: Path
) -> None:
    session = begin(tmp_path / "d.journal", settings_file, simulated, "daily")
    finish(session, scripted)
    session.look(session.window_of(scripted.ask("signals", {})))
    store, said = tmp_path / "daily-checks.jsonl", list[str]()
    _keep_check(session, session.judge(), store, as_json=False, say=said.append)
    session.close()
    assert len(list(tmp_path.glob("d.journal.*.kept"))) == 1
    assert begin(tmp_path / "d.journal", settings_file, simulated, "daily").procedure.position == 0
