"""The creep at the end of a plan: read when it is due, left out, late, taken up after a kill."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from rigapp.calibrating import session as live_session
from rigapp.calibrating.certificate import write_certificate
from rigapp.calibrating.load_cell_session import LoadCellSession
from rigapp.calibrating.session import Rig
from rigapp.commands.live import terminal
from rigapp.commands.live.terminal import Terminal
from rigapp.config.calibration_settings import LoadCellFile
from rigapp.config.loading import read_document
from rigapp.gui.wizard.live_calibration import LiveCalibration
from rigapp_calibration.taking.procedure import ProcedureError, StepKind
from tests.calibration.test_procedure import at_the_creep
from tests.gui_calibration.conftest import BUOYANCY, ScriptedRig

REAL = Rig("Real rig", False)
HANGS_AT_DEG = 90.0


class CreepingRig(ScriptedRig):
    """A rig at the last pin angle, with 40 kg on, whose bridges stand as the readings say."""

    def __init__(self) -> None:
        super().__init__()
        self.angle_deg = HANGS_AT_DEG
        self.force = 40.0 * 9.8123 * BUOYANCY


def taken_up(folder: Path, settings: Path) -> LoadCellSession:
    """Take up a calibration of which only the creep is missing, on a rig that is no simulation."""
    path = folder / "c.journal"
    if not path.exists():
        first, *others = at_the_creep().events
        begun = {**first, "rig": REAL.name, "simulated": REAL.simulated}
        path.write_text("".join(f"{json.dumps(one)}\n" for one in (begun, *others)))
    given = read_document(settings, LoadCellFile).record
    return LoadCellSession(given, REAL, path, None)


def killed(session: LoadCellSession) -> None:
    """Let the journal go as the system does."""
    session.journal.close()


def look(session: LoadCellSession, rig: ScriptedRig) -> Any:
    window = session.window_of(rig.ask("signals", {}))
    session.look(window)
    return window


def take_ready(session: LoadCellSession, rig: ScriptedRig) -> None:
    """Take the step under way as soon as it is ready."""
    for _ in range(100):
        window = look(session, rig)
        if session.look(window).ready:
            session.take(window)
            return
    pytest.fail(f"never ready: {session.procedure.instruction}")


def record(session: LoadCellSession, folder: Path) -> tuple[dict[str, Any], str]:
    """Return the result that is saved, and the certificate's text."""
    outcome = session.judge()
    assert outcome.accepted, outcome.result["problems"]
    session.save(outcome, folder / "c.json")
    write_certificate(folder / "c.json", folder / "c.html")
    return dict(outcome.result), (folder / "c.html").read_text("utf-8")


@pytest.fixture
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The rig goes on at each look; nobody sleeps between two."""
    monkeypatch.setattr(terminal, "POLL_S", 0.0)


@pytest.mark.usefixtures("at_once")
def test_terminal_counts_the_seconds_and_reads_both_times_by_itself(
    settings_file: Path, tmp_path: Path
) -> None:
    session, rig = taken_up(tmp_path, settings_file), CreepingRig()
    asked: list[str] = []
    said: list[str] = []

    def read(prompt: str) -> str:
        asked.append(prompt)
        return ""

    assert Terminal(session, rig.ask, read, said.append).run()
    assert len(asked) == 1
    assert asked[0].startswith("s leaves the creep out, ")
    counted = [text for text in said if "are left at most" in text]
    assert [text.partition("; ")[2].partition(" s ")[0] for text in counted[-9:]] == [
        str(left) for left in range(270, 0, -30)
    ]
    hung = [one.hung for one in session.procedure.taken[-2:]]
    assert hung == pytest.approx([32.0, 302.0], abs=2.1)
    result, certificate = record(session, tmp_path)
    assert result["creep"]["hung_s"] == hung
    # Nothing creeps here: what counts is what the scatter of the readings may hide.
    assert abs(result["creep"]["change_N"]) < 0.1
    assert result["creep"]["half_width_percent"] > 0.05
    assert "creep, measured" in {one["name"] for one in result["magnitude"]["budget"]}
    assert "as measured" in certificate
    assert "Readings of the creep" in certificate


@pytest.mark.sampled
@pytest.mark.usefixtures("at_once")
@pytest.mark.parametrize("interrupted", [False, True])
def test_the_operator_leaves_it_out_and_the_stated_one_counts(
    settings_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, interrupted: bool
) -> None:
    session, rig = taken_up(tmp_path, settings_file), CreepingRig()
    answers = iter(["", "", "s"] if interrupted else ["s"])
    waits = iter([KeyboardInterrupt] * 2)

    def sleep(_: float) -> None:
        if session.takes_itself:
            raise next(waits)

    monkeypatch.setattr(terminal, "time", SimpleNamespace(sleep=sleep, monotonic=lambda: 0.0))
    assert Terminal(session, rig.ask, lambda _: next(answers), lambda _: None).run()
    result, certificate = record(session, tmp_path)
    assert result["creep"] is None
    assert result["characteristics_percent"]["creep_c"] is None
    names = {one["name"] for one in result["magnitude"]["budget"]}
    assert "creep" in names
    assert "creep, measured" not in names
    assert "Creep: not measured; U has the 0.05 % that the settings state." in certificate
    assert "the creep was left out" in certificate


@pytest.mark.parametrize(("away_s", "in_time"), [(20.0, True), (100.0, False)])
def test_killed_under_the_load_the_time_goes_on_and_a_late_reading_begins_again(
    settings_file: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    away_s: float,
    in_time: bool,
) -> None:
    clock = SimpleNamespace(now=1.8e9)
    monkeypatch.setattr(live_session, "time", SimpleNamespace(time=lambda: clock.now))
    session, rig = taken_up(tmp_path, settings_file), CreepingRig()
    take_ready(session, rig)
    assert session.takes_itself
    killed(session)
    clock.now += away_s
    session, rig = taken_up(tmp_path, settings_file), CreepingRig()
    assert session.takes_itself
    if in_time:
        take_ready(session, rig)
        assert session.procedure.taken[-1].hung == pytest.approx(32.0, abs=2.1)
    else:
        with pytest.raises(ProcedureError, match=r"has hung for 1\d\d s instead of 30 s"):
            take_ready(session, rig)
        assert session.procedure.step.kind is StepKind.PRELOAD
        # Of a fresh load both are read.
    while not session.procedure.done:
        take_ready(session, rig)
    assert session.judge().result["creep"] is not None
    killed(session)


def test_window_reads_it_by_itself_and_tells_what_is_left(
    qtbot: Any, settings_file: Path, tmp_path: Path
) -> None:
    killed(taken_up(tmp_path, settings_file))
    rig = CreepingRig()
    live = LiveCalibration(rig.line, REAL, LoadCellSession)
    given = read_document(settings_file, LoadCellFile).record
    live.open(given, tmp_path / "c.journal", None)
    words: set[str] = set()
    live.looked.connect(lambda: words.add(live.readiness.words if live.readiness else ""))
    weight, rig.force = rig.force, 0.0
    for _ in range(3):
        live.tick()
    # The time does not begin before the load hangs.
    assert live.readiness is not None
    assert live.readiness.words == "the 40 kg are not on the pin yet"
    assert not live.take()
    rig.force = weight
    live.tick()
    assert live.take()
    assert len(live.session.procedure.taken) == 110
    for _ in range(90):
        live.tick()
    assert live.session.procedure.done
    assert [one.hung for one in live.session.procedure.taken[110:]] == pytest.approx(
        [32.0, 302.0], abs=2.1
    )
    assert any(one.startswith("steady; 2") and one.endswith("time are left") for one in words)
    live.close()
