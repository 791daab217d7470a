"""A wizard that is a program of its own is killed in the midst; another one takes it up."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from rigapp.calibrating.verification import verify
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.presentation.tokens import LIGHT
from rigapp_calibration.records import unseal
from tests.gui_calibration.test_probe_wizard import RIG, ScriptedProbes, go_ahead, judged
from tests.gui_calibration.test_rolling import opened, pump
from tests.gui_calibration.test_story import EXAMPLE, HostLine, line

__all__ = ["line"]
APP = Path(__file__).with_name("wizard_app.py")


@contextmanager
def killed_at(subject: str, folder: Path, least: int) -> Iterator[None]:
    """Run the wizard of a subject until so much is done, and kill it with all that it started."""
    command = [sys.executable, str(APP), subject, str(folder)]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, start_new_session=True
    ) as program:
        try:
            assert program.stdout is not None
            told = (int(words.partition(" of ")[0]) for words in program.stdout)
            assert any(done >= least for done in told), "it ended by itself"
        finally:
            os.killpg(program.pid, signal.SIGKILL)
    assert program.returncode == -signal.SIGKILL
    yield


def saved(wizard: CalibrationWizard) -> None:
    """Go from the result to the record, which must follow from its readings."""
    page = wizard.result_page
    assert page.verdict.text() == "✓ Accepted", page.problems.text()
    wizard.next()
    found = verify(unseal(wizard.live.outcome.saved.read_bytes()))
    assert found.compared > 10
    assert not found.differences
    wizard.reject()


def taken_up(wizard: CalibrationWizard) -> None:
    """Choose the one calibration that waits, and go to its readings."""
    assert wizard.plan.begin.count() == 2
    wizard.plan.begin.setCurrentIndex(1)
    wizard.next()
    assert wizard.currentPage() is wizard.readings, wizard.plan.problem.text()


@pytest.mark.long
def test_probes_are_taken_up_after_a_kill(qtbot: Any, tmp_path: Path) -> None:
    with killed_at("probes", tmp_path, 4):
        rig = ScriptedProbes()
    wizard = CalibrationWizard(rig.line, RIG, LIGHT, tmp_path, subject="probes")
    wizard.live._timer.stop()
    qtbot.addWidget(wizard)
    wizard.show()
    wizard.live.tick()
    taken_up(wizard)
    assert 4 <= wizard.readings.table.rowCount() < 66
    go_ahead(wizard)
    wizard.next()
    judged(wizard, qtbot)
    saved(wizard)


@pytest.mark.long
def test_rolls_are_taken_up_after_a_kill(qtbot: Any, line: HostLine, tmp_path: Path) -> None:
    text = (EXAMPLE.parent / "quick.toml").read_text("utf-8")
    # A loaded machine may hold the samples back for a while; that is not what is tested here.
    (tmp_path / "t.toml").write_text(text.replace("stale_data_s = 2.0", "stale_data_s = 60"))
    with killed_at("run-out", tmp_path, 3):
        wizard = opened(qtbot, line, tmp_path)
    taken_up(wizard)
    wizard.readings.roll.click()
    pump(wizard, line, wizard.readings.isComplete, "the last roll")
    assert len(list(tmp_path.glob("*.roll-15rpm.cut-off-1.h5"))) == 1
    wizard.next()
    pump(wizard, line, lambda: wizard.live.outcome is not None, "the map")
    saved(wizard)
