"""The probe wizard on a scripted rig with two crooked probes, driven by keyboard."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWizard

from rigapp.calibrating.probe_session import ProbeSession, probe_plan
from rigapp.calibrating.session import Rig
from rigapp.calibrating.training import MicrometerMistake
from rigapp.commands.live.terminal import Terminal
from rigapp.config.calibration_settings import ProbeFile
from rigapp.config.errors import UnusableInput
from rigapp.gui.window.calibrating import CalibrationChooser
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.presentation.tokens import LIGHT
from rigapp.schema.messages import Reply
from rigapp_calibration.probes.plans import ProbePlan
from rigapp_calibration.records import unseal
from tests.gui_calibration.clumsy import ClumsyHands

SENSITIVITY = np.array([101.0, 98.5])
OFFSET = np.array([0.12, -0.31])
ANGLE = np.radians([1.5, -0.8])
RATE = 1000.0
NEXT, COMMIT = QWizard.WizardButton.NextButton, QWizard.WizardButton.CommitButton


class ScriptedProbes:
    """Obey hands at the micrometer and answer ``signals``; each question comes 4 s later."""

    def __init__(self) -> None:
        self.noise = np.random.default_rng(5)
        self.now = 50.0
        self.micrometers = np.zeros(2)
        self.off = False
        self.shakes = 0.0
        self.stands = True

    def ask(self, verb: str, arguments: dict[str, Any]) -> Any:
        """Answer as a terminal's line does."""
        return self.answer(verb, arguments).result

    def line(self, verb: str, arguments: dict[str, Any], handler: Callable[[Reply], None]) -> None:
        """Answer as the window's link does."""
        handler(self.answer(verb, arguments))

    def answer(self, verb: str, arguments: dict[str, Any]) -> Reply:
        """Answer one request."""
        if verb == "hand":
            what, details = arguments["what"], arguments["details"]
            if what == "set_micrometer":
                assert self.off
                self.micrometers[details["probe"] - 1] = details["position_um"]
            else:
                self.off = what == "take_off_follower"
            return Reply(ok=True, result={"after_sample": int(self.now * RATE)})
        assert verb == "signals"
        self.now += 4.0
        end = np.arange(self.now - 4.0, self.now, 0.05) + 0.05
        x, y = self.micrometers
        one = math.cos(ANGLE[0]) * x + math.sin(ANGLE[0]) * y
        two = -math.sin(ANGLE[1]) * x + math.cos(ANGLE[1]) * y
        volts = np.array([one, two]) / SENSITIVITY + OFFSET
        signal = volts[:, None] + self.noise.normal(0.0, 3e-4 + self.shakes, (2, len(end)))
        return Reply(
            ok=True,
            result={
                "end": np.round(end * RATE).astype(int).tolist(),
                "signals": dict(zip(("probe_1", "probe_2"), signal.tolist(), strict=True)),
                "samples_per_mean": 50,
                "sample_rate_Hz": RATE,
                "stands": self.stands,
                "sensitivity_um_per_V": [100.0, 100.0],
                "probe_offset_V": [0.0, 0.0],
            },
        )


RIG = Rig("Scripted rig", True, "E. Sample")


@pytest.fixture
def probes() -> ScriptedProbes:
    return ScriptedProbes()


@pytest.fixture
def wizard(qtbot: Any, probes: ScriptedProbes, tmp_path: Path) -> Iterator[CalibrationWizard]:
    wizard = CalibrationWizard(
        probes.line, RIG, LIGHT, tmp_path, subject="probes", fields={"which": "both"}
    )
    wizard.live._timer.stop()
    qtbot.addWidget(wizard)
    wizard.show()
    wizard.live.tick()
    yield wizard
    wizard.reject()


def go_ahead(wizard: CalibrationWizard) -> None:
    wizard.live.goes_ahead = True
    for _ in range(600):
        wizard.live.tick()
        if wizard.readings.isComplete():
            wizard.live.goes_ahead = False
            return
    pytest.fail(f"not finished: {wizard.live.readiness} {wizard.readings.problem.text()}")


def judged(wizard: CalibrationWizard, qtbot: Any) -> None:
    def ready() -> bool:
        wizard.live.tick()
        return wizard.live.outcome is not None

    qtbot.waitUntil(ready, timeout=PATIENCE_MS)


def test_whole_wizard_finds_both_probes_and_how_they_stand(
    wizard: CalibrationWizard, qtbot: Any, probes: ScriptedProbes
) -> None:
    # 80 % of the range with the sensitivity in use: steps of 160 um.
    assert wizard.plan.fields["reach"].value() == pytest.approx(800.0)
    assert "Steps of 160 µm; 126 readings" in wizard.plan.summary.text()
    wizard.plan.fields["plan"].setCurrentIndex(0)
    assert "42 readings" in wizard.plan.summary.text()
    qtbot.keyClick(wizard.button(COMMIT), Qt.Key.Key_Space)
    assert wizard.currentPage() is wizard.readings
    assert not wizard.button(NEXT).isEnabled()
    assert "target in front of probe 1" in wizard.readings.instruction.text()
    go_ahead(wizard)
    assert wizard.readings.table.rowCount() == 42
    qtbot.keyClick(wizard.button(NEXT), Qt.Key.Key_Space)
    judged(wizard, qtbot)
    assert wizard.result_page.verdict.text() == "✓ Accepted", wizard.result_page.problems.text()
    assert "Probe 1 is +1.50 degrees" in wizard.result_page.words.text()
    qtbot.keyClick(wizard.button(NEXT), Qt.Key.Key_Space)
    assert wizard.currentPage() is wizard.certificate
    saved = wizard.live.outcome.saved
    record = unseal(saved.read_bytes())
    assert record.kind == "probe pair"
    result = record.content["result"]
    for number in (0, 1):
        found = result["probes"][number]
        expected = SENSITIVITY[number] / math.cos(ANGLE[number])
        assert found["sensitivity_um_per_V"] == pytest.approx(expected, rel=2e-4)
    assert result["alignment"]["angle_deg"] == pytest.approx(np.degrees(ANGLE), abs=0.02)
    qtbot.keyClick(wizard.certificate.html, Qt.Key.Key_Space)

    def written() -> bool:
        wizard.live.tick()
        return "The certificate is" in wizard.certificate.words.text()

    qtbot.waitUntil(written, timeout=PATIENCE_MS)
    assert saved.with_suffix(".html").stat().st_size > 1000
    wizard.accept()


def test_mistake_is_refused_rejected_and_put_right(wizard: CalibrationWizard, qtbot: Any) -> None:
    wizard.plan.fields["plan"].setCurrentIndex(0)
    wizard.plan.fields["which"].setCurrentIndex(0)
    wizard.next()
    combo = wizard.readings.hands.mistake
    combo.setCurrentIndex(list(MicrometerMistake).index(MicrometerMistake.BACKLASH))
    go_ahead(wizard)
    wizard.next()
    judged(wizard, qtbot)
    assert wizard.result_page.verdict.text() == "✗ Refused"
    assert "approach every position from one side" in wizard.result_page.problems.text()
    assert not wizard.result_page.target.isVisible()
    assert wizard.button(QWizard.WizardButton.FinishButton).isVisible()
    assert not wizard.button(NEXT).isVisible()
    wizard.back()
    page = wizard.readings
    combo.setCurrentIndex(0)
    page.table.selectRow(14)
    page.reason.setText("came from the wrong side")
    qtbot.keyClick(page.reject_button, Qt.Key.Key_Space)
    assert not page.isComplete()
    assert page.table.item(14, 5).text() == "rejected: came from the wrong side"
    go_ahead(wizard)
    assert page.table.rowCount() == 42
    wizard.next()
    judged(wizard, qtbot)
    assert wizard.result_page.verdict.text() == "✓ Accepted", wizard.result_page.problems.text()


def test_typed_position_is_recorded_and_a_moving_one_is_not(
    wizard: CalibrationWizard, qtbot: Any, probes: ScriptedProbes
) -> None:
    wizard.plan.fields["which"].setCurrentIndex(0)
    wizard.next()
    live, page = wizard.live, wizard.readings
    live.perform_step()
    live.tick()
    qtbot.keyClick(page.record, Qt.Key.Key_Space)
    assert "back to -880 µm" in page.instruction.text()
    probes.shakes = 0.2
    live.tick()
    assert page.stability.word.text() == "NOT STEADY"
    assert not page.record.isEnabled()
    probes.shakes, probes.stands = 0.0, False
    live.tick()
    assert "Stop the crank" in page.stability.why.text()
    probes.stands = True
    probes.micrometers[0] = -790.0
    live.tick()
    assert page.stability.word.text() == "STEADY"
    page.shown.setFocus()
    page.shown.selectAll()
    qtbot.keyClicks(page.shown, "-790")
    qtbot.keyClick(page.record, Qt.Key.Key_Space)
    assert page.table.item(0, 2).text() == "-790.0"
    assert live.session.procedure.taken[0].value == pytest.approx(-790e-6)


def test_closed_wizard_is_taken_up_again(
    wizard: CalibrationWizard, qtbot: Any, probes: ScriptedProbes, tmp_path: Path
) -> None:
    wizard.plan.fields["plan"].setCurrentIndex(0)
    wizard.next()
    wizard.live.goes_ahead = True
    for _ in range(40):
        wizard.live.tick()
    taken = len(wizard.live.session.procedure.taken)
    assert taken > 3
    wizard.reject()
    again = CalibrationWizard(
        probes.line, RIG, LIGHT, tmp_path, subject="probes", fields={"which": "1"}
    )
    again.live._timer.stop()
    qtbot.addWidget(again)
    again.show()
    assert again.plan.begin.count() == 2
    again.plan.begin.setCurrentIndex(1)
    again.next()
    assert again.readings.table.rowCount() == taken
    go_ahead(again)
    assert again.live.session.procedure.plan.probes == (1, 2)
    again.reject()


def test_every_field_has_a_name_that_is_read_aloud(wizard: CalibrationWizard) -> None:
    from PySide6.QtWidgets import QAbstractButton, QComboBox, QLineEdit, QSpinBox, QTableWidget

    for kind in (QAbstractButton, QComboBox, QLineEdit, QSpinBox, QTableWidget):
        for page in (wizard.plan, wizard.readings, wizard.result_page, wizard.certificate):
            for widget in page.findChildren(kind):
                if widget.objectName().startswith("qt_") or not widget.objectName():
                    continue
                assert widget.accessibleName(), widget.objectName()


def test_chooser_tells_what_was_chosen_by_key(qtbot: Any) -> None:
    chooser = CalibrationChooser()
    qtbot.addWidget(chooser)
    chooser.show()
    with qtbot.waitSignal(chooser.chosen, timeout=PATIENCE_MS) as heard:
        qtbot.keyClick(chooser.buttons["both"], Qt.Key.Key_Space)
    assert heard.args == ["both"]
    assert not chooser.isVisible()


# --- the terminal's face ----------------------------------------------------------------------


def planned(which: str, plan: str, positions: int) -> ProbePlan:
    asked = {"which": which, "plan": plan, "reach": 800.0, "positions": positions}
    return probe_plan(asked, ProbeFile(schema=1))


def session(folder: Path, probe: str = "1", name: str = "probe.journal") -> ProbeSession:
    plan = planned(probe, "routine", 5)
    return ProbeSession(ProbeFile(schema=1), RIG, folder / name, plan, keep_waiting_times=False)


def test_terminal_takes_closes_takes_up_and_rejects(probes: ScriptedProbes, tmp_path: Path) -> None:
    probes.answer("hand", {"what": "take_off_follower", "details": {}})
    said: list[str] = []
    answers = iter(["", "", "abc", "-350", "r", "1", "bumped", "q"])

    def read(prompt: str) -> str:
        if live.procedure.step.series:
            probes.micrometers[0] = 1e6 * live.procedure.step.value
        return next(answers)

    live = session(tmp_path)
    assert not Terminal(live, probes.ask, read, said.append).run()
    live.close()
    assert any("Enter, a position in um" in line for line in said)
    assert [one.rejected for one in live.procedure.taken] == [
        "bumped",
        "series repeated: bumped",
    ]
    assert live.procedure.taken[1].value == pytest.approx(-350e-6)
    live = session(tmp_path)
    answers = iter([""] * 9)
    assert Terminal(live, probes.ask, read, said.append).run()
    outcome = live.judge()
    assert outcome.accepted, outcome.result["problems"]
    assert "# rejected (bumped): 1.1,1,-800.0" in live.readings_csv()
    saved = live.save(outcome, tmp_path / "probe.json").saved
    assert saved is not None
    settings = unseal(saved.read_bytes()).content["settings"]
    assert settings["probe"]["nominal_sensitivity_um_per_V"] == pytest.approx(100.0)
    live.close()


@pytest.mark.parametrize(
    ("mistake", "code"),
    [
        (MicrometerMistake.WRONG_POSITION, "wrong_position"),
        (MicrometerMistake.SKIPPED, "skipped_step"),
        (MicrometerMistake.OTHER_WAY, "direction_reversed"),
        (MicrometerMistake.BACKLASH, "backlash"),
        (MicrometerMistake.OTHER_PROBE, "wrong_probe"),
        (MicrometerMistake.TOO_FAR, "wrong_sensitivity"),
        (MicrometerMistake.DRIFT, "drift"),
    ],
)
def test_practised_mistakes_are_named(
    probes: ScriptedProbes, tmp_path: Path, mistake: MicrometerMistake, code: str
) -> None:
    plan = planned("1", "routine", 11)
    live = ProbeSession(
        ProbeFile(schema=1), RIG, tmp_path / "one.journal", plan, keep_waiting_times=False
    )
    at_once = mistake in (
        MicrometerMistake.OTHER_WAY,
        MicrometerMistake.OTHER_PROBE,
        MicrometerMistake.TOO_FAR,
    )
    hands = ClumsyHands(live, probes.ask, mistake, 1 if at_once else 5)
    hands.carry_out(live.practice.prepare)
    assert Terminal(live, probes.ask, lambda _: "", lambda _: None, hands).run()
    outcome = live.judge()
    assert not outcome.accepted
    assert [one["code"] for one in outcome.result["problems"] if one["blocks"]] == [code]
    with pytest.raises(UnusableInput, match="refused is not saved"):
        live.save(outcome, tmp_path / "one.json")
    live.close()


def test_foreign_journal_and_impossible_plan_are_refused(tmp_path: Path) -> None:
    live = session(tmp_path)
    live.adopt(live.procedure.set_up())
    live.close()
    other = Rig("Another rig", False, "E. Sample")
    with pytest.raises(UnusableInput, match="these readings are from the rig 'Scripted rig'"):
        ProbeSession(ProbeFile(schema=1), other, tmp_path / "probe.journal", None)
    with pytest.raises(UnusableInput, match="choose 1, 2, both"):
        planned("3", "full", 11)
    with pytest.raises(UnusableInput, match="choose routine, full"):
        planned("1", "fast", 11)
    with pytest.raises(UnusableInput, match="5 to 101"):
        planned("1", "full", 2)
