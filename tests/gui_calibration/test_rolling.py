"""The wizard maps the run-out of the simulated rig's pin, is closed in the middle and taken up."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S

from rigapp.config.loading import read_rig
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.presentation.tokens import LIGHT
from rigapp_calibration.records import unseal
from tests.gui_calibration.test_story import EXAMPLE, HostLine, line
from tests.gui_calibration.tour import rolling_rig

__all__ = ["line"]
FEW = {"routine": 6, "full": 4}


def pump(wizard: CalibrationWizard, line: HostLine, until: Callable[[], bool], what: str) -> None:
    deadline = time.monotonic() + 4.0 * PATIENCE_S
    while not until():
        if time.monotonic() > deadline:
            pytest.fail(f"{what} did not come: {wizard.readings.problem.text()}")
        wizard.live.tick()
        line.worker.deliver()
        time.sleep(0.005)


def opened(qtbot: Any, line: HostLine, folder: Path) -> CalibrationWizard:
    wizard = CalibrationWizard(line, rolling_rig(folder), LIGHT, folder, subject="run-out")
    qtbot.addWidget(wizard)
    wizard.live._timer.stop()
    wizard.show()
    return wizard


@pytest.mark.long
def test_rolls_are_taken_up_and_make_a_map_that_the_engine_uses(
    qtbot: Any, line: HostLine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("rigapp.calibrating.subjects.REVOLUTIONS", FEW)
    text = (EXAMPLE.parent / "quick.toml").read_text("utf-8")
    # A loaded machine may hold the samples back for a while; that is not what is tested here.
    (tmp_path / "t.toml").write_text(text.replace("stale_data_s = 2.0", "stale_data_s = 60"))
    wizard = opened(qtbot, line, tmp_path)
    wizard.plan.fields["speeds"].setText("3, 90")
    assert "--rpm 3, 90" in wizard.plan.summary.text()
    wizard.plan.fields["speeds"].setText("10, 15")
    wizard.next()
    assert wizard.currentPage() is wizard.readings, wizard.plan.problem.text()
    assert not wizard.readings.isComplete()
    wizard.readings.roll.click()
    runs = wizard.live.session.runs
    engine = line._host.engine
    pump(
        wizard, line, lambda: runs.position == 1 and engine.state.value == "running", "roll 2"
    )  # fmt: skip
    wizard.readings.stop.click()
    pump(wizard, line, lambda: engine.state.value == "stopped", "the end of the roll")
    wizard.reject()
    wizard = opened(qtbot, line, tmp_path)
    wizard.plan.begin.setCurrentIndex(1)
    assert "those of the journal" in wizard.plan.summary.text()
    wizard.next()
    assert wizard.currentPage() is wizard.readings, wizard.plan.problem.text()
    wizard.readings.roll.click()
    pump(wizard, line, wizard.readings.isComplete, "the last roll")
    assert len(list(tmp_path.glob("*.cut-off-1.h5"))) == 1
    wizard.next()
    pump(wizard, line, lambda: wizard.live.outcome is not None, "the map")
    assert wizard.result_page.verdict.text() == "✓ Accepted", wizard.result_page.problems.text()
    assert "run-out" in wizard.result_page.words.text()
    wizard.next()
    saved = wizard.live.outcome.saved
    record = unseal(saved.read_bytes())
    assert record.kind == "run-out map"
    assert record.content["taken"]["simulated"] is True
    assert record.content["result"]["peak_to_peak_um"] == pytest.approx([6.0, 6.0], abs=0.6)
    wizard.certificate.use.click()
    wizard.certificate.use.click()
    assert read_rig(tmp_path / "rig.toml").record.probes.run_out == saved.name
    used = wizard.certificate.used
    pump(wizard, line, lambda: "from now on" in used.text(), "the engine's answer")
    wizard.reject()
