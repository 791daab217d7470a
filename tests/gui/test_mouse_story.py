"""A test from start to stop by the mouse alone: each button is hit where the operator sees it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QPushButton

from rigapp.gui.window.window import MainWindow
from rigapp.schema.messages import RunState


def test_start_pause_resume_stop_by_the_mouse_alone(
    window: MainWindow, engine: Any, attach: Callable[[], None], qtbot: Any
) -> None:
    def hit(name: str) -> None:
        """Click where a button is, once nothing covers it there."""
        button = window.findChild(QPushButton, name)
        assert button is not None

        def seen() -> bool:
            window.tick()
            spot = button.mapTo(window, button.rect().center())
            return bool(button.isEnabled() and window.childAt(spot) is button)

        qtbot.waitUntil(seen, timeout=PATIENCE_MS)
        qtbot.mouseClick(button, Qt.MouseButton.LeftButton)

    def asked(verb: str) -> None:
        def came() -> bool:
            window.tick()
            return verb in engine.verbs

        qtbot.waitUntil(came, timeout=PATIENCE_MS)

    engine.say(count=0, curves=False, state=RunState.READY, planned=0, file="")
    attach()
    for buttons, verb, state in (
        (("start", "start_now"), "start", RunState.RUNNING),
        (("pause",), "pause", RunState.PAUSED),
        (("resume",), "resume", RunState.RUNNING),
        (("stop",), "stop", RunState.STOPPED),
    ):
        for name in buttons:
            hit(name)
        asked(verb)
        engine.say(count=0, curves=False, state=state)
        attach()
