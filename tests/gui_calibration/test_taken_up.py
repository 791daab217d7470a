"""Every calibration is taken up after the program was killed, at whatever step that was."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from rigapp.calibrating.load_cell_session import LoadCellSession, load_cell_plan
from rigapp.calibrating.probe_session import ProbeSession, probe_plan
from rigapp.calibrating.rolls import roll_test
from rigapp.calibrating.session import LiveSession, Rig
from rigapp.calibrating.spindle import SpindleRun, SpindleRuns
from rigapp.commands.live.spindle_runs import plain_test, running_test, take_runs
from rigapp.commands.live.terminal import SimulatedActions, Terminal
from rigapp.config.calibration_settings import LoadCellFile, ProbeFile
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_document, read_rig, read_test
from rigapp.storage import FilePlan, open_test
from rigapp_calibration.taking.procedure import ProcedureError
from tests.gui_calibration.conftest import ScriptedRig
from tests.gui_calibration.test_probe_wizard import ScriptedProbes
from tests.storage.storage_samples import new_test, row

RIG = Rig("Scripted rig", True, "E. Sample")
AnySession = LiveSession[Any, Any, Any]
Begin = Callable[[Path], AnySession]


class Killed(BaseException):
    """The program ends here and now: nothing is put in order."""


class HandsThatDie(SimulatedActions):
    """Do some steps, then the program is killed: before a step, or with its work half done."""

    def __init__(self, session: AnySession, ask: Any, steps: int, half: bool) -> None:
        super().__init__(session, ask)
        self._left, self._half = steps, half

    def do(self, session: AnySession) -> None:
        if self._left == 0 and not self._half:
            raise Killed
        super().do(session)
        if self._left == 0:
            raise Killed
        self._left -= 1


def load_cell(folder: Path, plan: str) -> AnySession:
    given = read_document(folder / "settings.toml", LoadCellFile).record
    wanted = load_cell_plan({"plan": plan, "weights": "5x8, 2, 2, 1, 0.5"}, given)
    return LoadCellSession(given, RIG, folder / "j", wanted, keep_waiting_times=False)


def probes(folder: Path, which: str, plan: str, positions: int) -> AnySession:
    asked = {"which": which, "plan": plan, "reach": 800.0, "positions": positions}
    wanted = probe_plan(asked, ProbeFile(schema=1))
    return ProbeSession(ProbeFile(schema=1), RIG, folder / "j", wanted, keep_waiting_times=False)


PROCEDURES: dict[str, tuple[Callable[[], Any], Begin]] = {
    "daily check": (ScriptedRig, lambda folder: load_cell(folder, "daily")),
    "load cell": (ScriptedRig, lambda folder: load_cell(folder, "routine")),
    "one probe": (ScriptedProbes, lambda folder: probes(folder, "2", "full", 5)),
    "both probes": (ScriptedProbes, lambda folder: probes(folder, "both", "routine", 7)),
}


def run(session: AnySession, rig: Any, steps: int, half: bool = False) -> bool:
    """Take some steps on a rig that was just started; return whether the program was killed."""
    hands = HandsThatDie(session, rig.ask, steps, half)
    try:
        hands.carry_out(session.practice.prepare)
        assert Terminal(session, rig.ask, lambda _: "", lambda _: None, hands).run()
    except Killed:
        # The system closes the file of a killed program; nothing else is done.
        os.close(session.journal._file)
        session.journal._file = -1
        return True
    session.look(session.window_of(rig.ask("signals", {})))
    return False


def started(new_rig: Callable[[], Any], seed: int) -> Any:
    """Return a rig that was just started, with noise of its own."""
    rig = new_rig()
    rig.noise = np.random.default_rng(seed)
    return rig


def judged(session: AnySession) -> None:
    """Assert that the readings are a good calibration, or the check of a cell that is 0.4 % off."""
    outcome = session.judge()
    if outcome.check is None:
        assert outcome.accepted, outcome.result["problems"]
    else:
        assert outcome.check.largest < 8.0
    session.close()


@pytest.mark.sampled
@pytest.mark.parametrize("name", PROCEDURES)
def test_each_step_can_be_the_first_after_a_restart(
    name: str, settings_file: Path, tmp_path: Path
) -> None:
    new_rig, begin = PROCEDURES[name]
    killed = 0
    session = begin(tmp_path)
    while run(session, started(new_rig, killed), steps=1):
        killed += 1
        session = begin(tmp_path)
    # The run after the last step had nothing left to do, so that nothing killed it.
    assert killed == len(session.procedure.steps) - 1
    judged(session)


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@example(name="load cell", breaks=[(13, False, b"")], rejects=False)
@given(
    name=st.sampled_from(sorted(PROCEDURES)),
    breaks=st.lists(
        st.tuples(st.integers(0, 12), st.booleans(), st.sampled_from([b"", b'{"event": "rec'])),
        max_size=4,
    ),
    rejects=st.booleans(),
)
def test_it_is_taken_up_wherever_it_was_killed(
    name: str,
    breaks: list[tuple[int, bool, bytes]],
    rejects: bool,
    settings_file: Path,
    tmp_path: Path,
) -> None:
    new_rig, begin = PROCEDURES[name]
    (tmp_path / "j").unlink(missing_ok=True)
    session = begin(tmp_path)
    for number, (steps, half, cut_off) in enumerate(breaks):
        if not run(session, started(new_rig, number), steps, half):
            break
        with (tmp_path / "j").open("ab") as stream:
            stream.write(cut_off)
        before = session.procedure
        session = begin(tmp_path)
        assert session.procedure == before
        if rejects and before.taken:
            with suppress(ProcedureError):  # the last one is rejected already
                session.reject(len(before.taken) - 1, "bumped")
    assert not run(session, started(new_rig, len(breaks)), steps=1000)
    judged(session)


# --- runs of the spindle --------------------------------------------------------------------------


class ScriptedSpindle:
    """Turn two revolutions a look and leave real test files; it dies with whoever hosts it."""

    def __init__(self, looks: int, part: Path, whole: Path) -> None:
        self._looks, self._part, self._whole = looks, part, whole
        self._out = ""
        self._turns = False
        self._done = self._planned = 0
        self.starts = 0

    def ask(self, verb: str, arguments: dict[str, Any]) -> Any:
        if verb.startswith("calibration_"):
            return {"key": "of this session", "since": 1.0}
        if self._looks == 0:
            raise Killed
        self._looks -= 1
        if verb == "start":
            self.starts += 1
            self._turns, self._out, self._done = True, arguments["out"], 0
            self._planned = read_test(Path(arguments["test"])).record.run.revolutions
            assert not Path(self._out).exists()
            shutil.copyfile(self._part, self._out)
            return None
        assert verb == "status"
        if self._turns:
            self._done += 2
            self._turns = self._done < self._planned
            if not self._turns:
                shutil.copyfile(self._whole, self._out)
        return {
            "state": "running" if self._turns else "stopped",
            "file": self._out,
            "revolution": self._done,
            "reason": "",
        }


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Return a test file that was cut off, and a whole one."""
    folder, plan = tmp_path_factory.mktemp("files"), FilePlan(4, 0, 50)
    for name in ("part.h5", "whole.h5"):
        writer = new_test(folder, plan, name)
        writer.append_row(row(1, plan))
        if name == "whole.h5":
            writer.finish("complete", "complete", "All revolutions are done.")
        writer.close()
    return folder / "part.h5", folder / "whole.h5"


def runs_of(kind: str, folder: Path) -> list[SpindleRun]:
    example_rig = read_rig(Path(__file__).parents[2] / "examples" / "simulated.toml").record
    if kind == "run-out":
        tests = [(rpm, roll_test(example_rig, plain_test(), rpm, 2, "")) for rpm in (3.0, 6.0)]
    else:
        tests = [(rpm, running_test(example_rig, rpm, 2, "")) for rpm in (30.0, 60.0)]
    return [SpindleRun(rpm, test, folder / f"map.{rpm:g}rpm") for rpm, test in tests]


@pytest.mark.long
@pytest.mark.parametrize("kind", ["run-out", "running check"])
def test_spindle_runs_are_taken_up_wherever_they_were_killed(
    kind: str, files: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.commands.live.spindle_runs.POLL_S", 0.0)
    # Takes a second a file, and other tests look at it.
    monkeypatch.setattr(SpindleRuns, "compress", lambda _: None)
    looks, killed = 0, True
    while killed:
        folder = tmp_path / str(looks)
        folder.mkdir()
        runs, said = runs_of(kind, folder), list[str]()
        spindle, killed = ScriptedSpindle(looks, *files), False
        try:
            take_runs(SpindleRuns(runs, kind), nullcontext(spindle.ask), said.append)
        except Killed:
            killed = True
        whole = [run.out for run in runs if run.out.exists() and not is_cut_off(run.out)]
        again = ScriptedSpindle(1000, *files)
        take_runs(SpindleRuns(runs, kind), nullcontext(again.ask), said.append)
        taken = [run.out for run in runs]
        assert not any(map(is_cut_off, taken))
        assert again.starts == len(runs) - len(whole)
        aside = list(folder.glob("*.cut-off-1.h5"))
        assert len(aside) == spindle.starts - len(whole)
        assert all(map(is_cut_off, aside))
        looks += 1
    assert looks > 8
    runs[0].recipe.write_text("another test")
    with pytest.raises(UnusableInput, match="not overwritten"):
        SpindleRuns(runs, kind)


def is_cut_off(path: Path) -> bool:
    with open_test(path) as reader:
        return bool(reader.summary()["status"] != "complete")
