"""Hands that rest on the wheel, and a Stop that always answers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import QPoint, QPointF, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QComboBox, QSpinBox, QVBoxLayout, QWidget

from rigapp.gui.widgets.build import choice, scrolling, whole_number
from rigapp.gui.window.tabs import NUMBERS
from rigapp.gui.window.window import MainWindow
from rigapp.presentation.tokens import LIGHT
from rigapp.replay.client import ReplayClient
from rigapp.schema.messages import Reply, RunState
from rigapp.schema.states import Refused, Trigger, transition
from rigapp.viewer.connection import EngineConnection
from rigapp.viewer.showntest import ShownTest

Attach = Callable[[], None]


def roll(over: QWidget) -> None:
    """Turn the wheel by a notch over the middle of a widget."""
    top = over.window()
    place = over.mapTo(top, over.rect().center())
    QTest.wheelEvent(top.windowHandle(), QPointF(place), QPoint(0, -120))
    QApplication.processEvents()


@pytest.mark.parametrize("kind", ["choice", "number"])
def test_the_wheel_scrolls_a_form_and_changes_only_what_has_the_focus(
    kind: str, qtbot: Any, light_application: Any
) -> None:
    inside = QWidget()
    field: Any = whole_number("number", "Number", 0, 9)
    if kind == "choice":
        field = choice("side", "Side", [("above", 1), ("below", 2)])
    other = whole_number("other", "Other", 0, 9)
    QVBoxLayout(inside).addWidget(field)
    inside.layout().addWidget(other)
    inside.layout().addStretch(1)
    inside.setMinimumHeight(2000)
    area = scrolling("form", "Form", inside)
    qtbot.addWidget(area)
    area.resize(300, 200)
    with qtbot.waitActive(area, timeout=PATIENCE_MS):
        area.show()
        area.activateWindow()
    other.setFocus()
    qtbot.waitUntil(other.hasFocus, timeout=PATIENCE_MS)

    def value() -> int:
        return field.currentIndex() if isinstance(field, QComboBox) else field.value()

    if isinstance(field, QSpinBox):
        field.setValue(5)
    before = value()
    roll(field)
    assert value() == before
    assert other.hasFocus()
    assert area.verticalScrollBar().value() > 0
    area.verticalScrollBar().setValue(0)
    field.setFocus()
    qtbot.waitUntil(
        field.hasFocus, timeout=PATIENCE_MS
    )  # a window that ended beside it may take it for a moment

    def changes() -> bool:
        area.activateWindow()
        area.verticalScrollBar().setValue(0)  # a notch without focus scrolled the field away
        field.setFocus()
        roll(field)
        return bool(value() != before)

    # A platform without a screen may lose one notch of a busy computer.
    qtbot.waitUntil(changes, timeout=PATIENCE_MS)
    assert area.verticalScrollBar().value() == 0


@pytest.mark.sampled
@pytest.mark.parametrize(
    "state", [RunState.IDLE, RunState.STOPPED, pytest.param(RunState.READY, marks=pytest.mark.long)]
)
def test_stop_is_never_grey_and_says_when_nothing_runs(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any, state: RunState
) -> None:
    engine.say(count=0, curves=False, state=state, file="")
    attach()
    stop = window.controls.buttons["stop"]
    assert stop.isEnabled()
    with pytest.raises(Refused) as refused:
        transition(state, Trigger.STOP)
    engine.reply = Reply(ok=False, sentence=str(refused.value))
    stop.click()
    attach()
    qtbot.waitUntil(
        lambda: bool(window.tick() or "Nothing" in window.controls.answer.whole),
        timeout=PATIENCE_MS,
    )
    assert window.controls.answer.whole == "Nothing is running, so there is nothing to stop."
    assert engine.verbs == ["stop"]  # a test may have begun since


def test_a_stop_that_fails_at_rest_is_never_called_needless(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=0, curves=False, state=RunState.READY, file="")
    attach()
    engine.reply = Reply(ok=False, sentence="the engine does not answer")
    window.controls.buttons["stop"].click()
    attach()
    answer = window.controls.answer
    qtbot.waitUntil(
        lambda: bool(window.tick() or "does not answer" in answer.whole), timeout=PATIENCE_MS
    )
    assert answer.whole.startswith("\u25b2")


def test_stop_is_pressed_from_the_window_of_the_help_too(
    window: MainWindow, engine: Any, attach: Attach, qtbot: Any
) -> None:
    engine.say(count=3)
    attach()
    window.show_help()
    helped = window._help
    assert helped is not None
    with qtbot.waitActive(helped, timeout=PATIENCE_MS):
        helped.activateWindow()
    qtbot.keyClick(helped.browser, Qt.Key.Key_F12)
    qtbot.waitUntil(lambda: bool(window.tick() or engine.verbs), timeout=PATIENCE_MS)
    assert engine.verbs == ["stop"]


def test_a_recorded_test_is_opened_at_the_overview(recorded: Path, qtbot: Any, qapp: Any) -> None:
    client = ReplayClient(recorded, speed=4.0)
    window = MainWindow(EngineConnection(lambda: client), ShownTest(), LIGHT)
    qtbot.addWidget(window)
    window.tabs.show_page("log")  # as it was left the last time
    window.show()
    window.start()
    assert window.tabs.currentIndex() == NUMBERS["overview"]
    window._discard = True
    window.close()
