"""The wizard's pages on a scripted rig, driven by keyboard."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtGui import QAccessible
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QComboBox,
    QLineEdit,
    QTableWidget,
    QWidget,
    QWizard,
)

from rigapp.calibrating.training import WeighingMistake
from rigapp.gui.wizard.plan_page import NEW
from rigapp_calibration.taking.procedure import StepKind

NEXT, COMMIT, BACK = (
    QWizard.WizardButton.NextButton,
    QWizard.WizardButton.CommitButton,
    QWizard.WizardButton.BackButton,
)


def to_readings(wizard: Any) -> None:
    wizard.next()
    wizard.live.tick()
    wizard.next()
    assert wizard.currentPage() is wizard.readings


def go_ahead(wizard: Any, until: Any) -> None:
    wizard.live.goes_ahead = True
    for _ in range(400):
        wizard.live.tick()
        if until():
            wizard.live.goes_ahead = False
            return
    pytest.fail(f"not reached: {wizard.live.readiness}")


def done(wizard: Any) -> bool:
    return bool(wizard.live.session.procedure.done)


def loaded(wizard: Any) -> bool:
    step = wizard.live.session.procedure.step
    return step.kind is StepKind.READING and step.value > 20.0


def judged(wizard: Any, qtbot: Any) -> None:
    def ready() -> bool:
        wizard.live.tick()
        return wizard.live.outcome is not None

    qtbot.waitUntil(ready, timeout=PATIENCE_MS)


def test_level_is_turned_end_for_end(wizard: Any, scripted: Any) -> None:
    scripted.angle_deg = 0.3
    wizard.next()
    page = wizard.angle
    for _ in range(3):
        wizard.live.tick()
    assert page.turn.isEnabled()
    page.turn.click()
    scripted.angle_deg = 359.9
    wizard.live.tick()
    assert "mean +0.10" in page.first.text()
    assert "off by +0.20" in page.first.text()
    wizard.next()
    procedure = wizard.live.session.procedure
    assert math.degrees(procedure.told("reference")["offset"]) == pytest.approx(-0.1, abs=1e-6)
    assert math.degrees(procedure.told("reference")["uncertainty"]) == pytest.approx(
        0.02 / math.sqrt(2.0)
    )


def test_daily_check_is_kept_once_and_charted(wizard: Any, qtbot: Any, tmp_path: Path) -> None:
    wizard.plan.fields["plan"].setCurrentIndex(0)
    to_readings(wizard)
    go_ahead(wizard, lambda: done(wizard))
    page = wizard.result_page
    for _ in range(2):  # judged again, it counts once
        wizard.next()
        judged(wizard, qtbot)

        def charted() -> bool:
            wizard.live.tick()
            return page.chart is not None and page.chart.isVisible()

        qtbot.waitUntil(charted, timeout=PATIENCE_MS)
        # The hidden matrix has cross-talk that the calibration in use has not.
        assert page.verdict.text() == "✗ The check failed"
        assert page.chart.words.text().startswith("The last check failed: The cell is off by")
        wizard.back()
    assert len((tmp_path / "daily-checks.jsonl").read_text().splitlines()) == 1
    # There is nothing to take up of it.
    wizard.live.close_session()
    assert len(list(tmp_path.glob("calibration-*.journal.*.kept"))) == 1
    wizard.plan.initializePage()
    assert wizard.plan.begin.count() == 1


def test_whole_wizard_to_the_certificate(wizard: Any, qtbot: Any, tmp_path: Path) -> None:
    assert "45.5 kg in all" in wizard.plan.summary.text()
    to_readings(wizard)
    assert not wizard.button(NEXT).isEnabled()
    assert not wizard.button(BACK).isEnabled()
    assert not wizard.readings.leave_out.isVisible()
    go_ahead(wizard, lambda: wizard.live.session.procedure.step.optional)
    wizard.readings._show_step()
    assert wizard.readings.instruction.text().startswith("Creep, from no load. Hang 8 × 5 kg")
    assert wizard.readings.leave_out.isVisible()
    wizard.readings.leave_out.click()
    assert done(wizard)
    assert wizard.readings.table.rowCount() == 110
    assert wizard.button(NEXT).isEnabled()
    wizard.next()
    judged(wizard, qtbot)
    page = wizard.result_page
    assert page.verdict.text() == "✓ Accepted"
    assert float(page.matrix.item(0, 0).text()) == pytest.approx(201.0, abs=0.2)
    assert "Expanded uncertainty in use at 400 N" in page.words.text()
    assert "Not classifiable" in page.words.text()
    wizard.next()
    assert wizard.currentPage() is wizard.certificate
    record = wizard.live.outcome.saved
    assert record is not None
    assert record.exists()
    qtbot.keyClick(wizard.certificate.html, Qt.Key.Key_Space)

    def written() -> bool:
        wizard.live.tick()
        return "The certificate is" in wizard.certificate.words.text()

    qtbot.waitUntil(written, timeout=PATIENCE_MS)
    assert record.with_suffix(".html").stat().st_size > 1000


def test_record_is_disabled_until_steady_and_counts_by_keyboard(
    wizard: Any, qtbot: Any, scripted: Any
) -> None:
    to_readings(wizard)
    page, live = wizard.readings, wizard.live
    live.tick()
    qtbot.keyClick(page.record, Qt.Key.Key_Space)
    go_ahead(wizard, lambda: loaded(wizard))
    scripted.faults.add("swinging_weight")
    live.perform_step()
    live.tick()
    assert not page.record.isEnabled()
    assert page.stability.word.text() == "NOT STEADY"
    assert "swinging" in page.stability.why.text()
    before = page.table.rowCount()
    qtbot.keyClick(page.record, Qt.Key.Key_Space)
    assert page.table.rowCount() == before
    scripted.faults.clear()
    live.tick()
    assert page.stability.word.text() == "STEADY"
    qtbot.keyClick(page.record, Qt.Key.Key_Space)
    assert page.table.rowCount() == before + 1


def test_a_wrong_piece_is_told_before_it_is_recorded(wizard: Any) -> None:
    to_readings(wizard)
    page, live = wizard.readings, wizard.live
    go_ahead(wizard, lambda: loaded(wizard))
    live.tick()
    assert page.stability.word.text() == "WAIT"
    assert page.stability.why.text() == "the load has not changed yet"
    for mistake, word, why in ((1, "CHECK", "than should hang"), (0, "STEADY", "")):
        page.hands.mistake.setCurrentIndex(mistake)
        live.perform_step()
        live.tick()
        assert page.stability.word.text() == word
        assert why in page.stability.why.text()


@pytest.mark.long
def test_wrong_weight_is_refused_rejected_and_repeated(wizard: Any, qtbot: Any) -> None:
    to_readings(wizard)
    live = wizard.live
    go_ahead(wizard, lambda: loaded(wizard))
    wizard.readings.hands.mistake.setCurrentIndex(1)
    assert live.mistake is WeighingMistake.WRONG_WEIGHT
    count = len(live.session.procedure.taken)
    live._done_for = (-1, -1)
    go_ahead(wizard, lambda: len(live.session.procedure.taken) > count)
    wizard.readings.hands.mistake.setCurrentIndex(0)
    go_ahead(wizard, lambda: done(wizard))
    wizard.next()
    judged(wizard, qtbot)
    page = wizard.result_page
    assert page.verdict.text() == "✗ Refused"
    assert "check the weights of that step" in page.problems.text()
    assert page.target.isHidden()
    assert page.nextId() == -1
    wizard.back()
    wizard.readings.table.selectRow(count)
    assert not wizard.readings.reject_button.isEnabled()
    qtbot.keyClicks(wizard.readings.reason, "wrong piece")
    qtbot.keyClick(wizard.readings.reject_button, Qt.Key.Key_Space)
    assert not wizard.button(NEXT).isEnabled()
    assert wizard.readings.table.item(count, 6).text() == "rejected: wrong piece"
    go_ahead(wizard, lambda: done(wizard))
    wizard.next()
    judged(wizard, qtbot)
    assert page.verdict.text() == "✓ Accepted"


def test_escape_keeps_the_readings_and_they_are_taken_up(
    wizard: Any, qtbot: Any, tmp_path: Path
) -> None:
    to_readings(wizard)
    live = wizard.live
    go_ahead(wizard, lambda: len(live.session.procedure.taken) >= 3)
    taken = live.session.procedure.taken
    qtbot.keyClick(wizard, Qt.Key.Key_Escape)
    assert not wizard.isVisible()
    assert live.session is None
    wizard.restart()
    wizard.show()
    assert wizard.plan.begin.itemText(0) == NEW
    wizard.plan.begin.setCurrentIndex(1)
    wizard.next()
    wizard.next()
    assert wizard.currentPage() is wizard.readings
    assert live.session.procedure.taken == taken
    assert wizard.readings.table.rowCount() == len(taken)


def test_typed_value_counts_without_leaving_the_field(wizard: Any, qtbot: Any) -> None:
    box = wizard.plan.fields["hanger"]
    box.lineEdit().selectAll()
    qtbot.keyClicks(box, "0.25")
    wizard.next()
    assert wizard.live.session.settings.weights.hanger_mass == pytest.approx(0.25)


def test_wrong_weights_are_said_on_the_page(wizard: Any) -> None:
    wizard.plan.fields["weights"].setText("five")
    wizard.next()
    assert wizard.currentPage() is wizard.plan
    assert "five" in wizard.plan.problem.text()


def test_angle_page_waits_for_the_encoder(wizard: Any, scripted: Any) -> None:
    scripted.angle_deg = None
    wizard.next()
    wizard.live.tick()
    assert not wizard.button(COMMIT).isEnabled()
    assert "index" in wizard.angle.stability.why.text()
    scripted.angle_deg = 359.6
    wizard.live.tick()
    assert wizard.button(COMMIT).isEnabled()
    assert wizard.angle.shown.value() == pytest.approx(-0.4)


def test_engine_that_refuses_is_said_on_the_page(wizard: Any, scripted: Any) -> None:
    wizard.next()
    scripted.refuses = "A test is running."
    wizard.live.tick()
    assert wizard.angle.problem.text() == "A test is running."
    assert not wizard.button(COMMIT).isEnabled()


def test_every_control_has_a_name(wizard: Any, qtbot: Any) -> None:
    kinds = (QAbstractButton, QAbstractSpinBox, QComboBox, QLineEdit, QTableWidget)
    for page in (wizard.plan, wizard.angle, wizard.readings, wizard.result_page):
        for widget in page.findChildren(QWidget):
            inside = isinstance(widget.parent(), (QAbstractSpinBox, QComboBox, QTableWidget))
            if isinstance(widget, kinds) and not inside:
                interface = QAccessible.queryAccessibleInterface(widget)
                assert interface is not None
                assert interface.text(QAccessible.Text.Name), widget.objectName()
