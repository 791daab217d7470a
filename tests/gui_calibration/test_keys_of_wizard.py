"""The wizard in the window by keys alone: Space does what is asked, whatever Qt hides meanwhile."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from shiboken6 import isValid

from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import DARK
from rigapp.schema.messages import Reply, RunState
from tests.gui.conftest import attach, engine, light_application, no_history, window
from tests.gui_calibration.conftest import ScriptedRig
from tests.gui_calibration.tour import looked, make_wizard

__all__ = ["attach", "engine", "light_application", "no_history", "window"]


@pytest.fixture
def shown(window: MainWindow, engine: Any, attach: Callable[[], None], qtbot: Any) -> MainWindow:
    """Return the window as the active one, with an engine that is ready."""
    engine.reply = Reply(ok=False, sentence="There are no signals.")
    engine.say(count=0, curves=False, state=RunState.READY, file="")
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    return window


def test_a_calibration_that_is_closed_while_it_takes_a_theme_is_let_go(
    shown: MainWindow, qtbot: Any, tmp_path: Path
) -> None:
    wizard = make_wizard(shown, tmp_path, ScriptedRig().line, "daily")
    shown.dress(DARK)
    wizard.reject()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
    assert not isValid(wizard)
    qtbot.waitUntil(lambda: not shown.dressing.isActive(), timeout=PATIENCE_MS)


def test_the_focus_waits_where_the_next_step_is_taken(
    shown: MainWindow, qtbot: Any, tmp_path: Path
) -> None:
    wizard = make_wizard(shown, tmp_path, ScriptedRig().line, "daily")
    live, page = wizard.live, wizard.readings
    assert shown.focusWidget() is wizard.plan.begin
    wizard.next()
    looked(wizard, wizard.angle.isComplete)
    assert wizard.angle.isAncestorOf(shown.focusWidget())
    wizard.next()
    taken = 0
    while not page.isComplete():
        live.perform_step()
        looked(wizard, page.record.isEnabled)
        assert shown.focusWidget() is page.record
        before = live.session.procedure.position
        qtbot.keyClick(shown.focusWidget(), Qt.Key.Key_Space)
        assert live.session.procedure.position == before + 1
        taken += 1
    assert taken > 12
    assert shown.focusWidget().objectName() == "wizard_next"
    qtbot.keyClick(shown.focusWidget(), Qt.Key.Key_Space)
    looked(wizard, lambda: live.outcome is not None)
    assert shown.stage.guiding
    assert shown.focusWidget().objectName() == "wizard_finish"
    qtbot.keyClick(shown.focusWidget(), Qt.Key.Key_Space)
    assert not shown.stage.guiding
    assert len((tmp_path / "daily-checks.jsonl").read_text("utf-8").splitlines()) == 1
