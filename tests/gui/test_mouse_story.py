"""A day by the mouse alone: each button is hit where the operator sees it."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QAbstractButton, QScrollArea

from rigapp.gui.panels.results import ResultsPanel
from rigapp.gui.results import documents
from rigapp.gui.window.window import MainWindow
from rigapp.schema.messages import RunState


def test_start_to_stop_report_compare_and_power_off_by_the_mouse_alone(
    window: MainWindow,
    engine: Any,
    attach: Callable[[], None],
    qtbot: Any,
    recorded: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def hit(name: str) -> None:
        """Click where a button is, once nothing covers it there; scroll to it as by the wheel."""

        def seen() -> bool:
            window.tick()
            button = window.findChild(QAbstractButton, name)
            if button is None or not button.isEnabled():
                return False
            area = button.parentWidget()
            while area is not None and not isinstance(area, QScrollArea):
                area = area.parentWidget()
            if area is not None:
                area.ensureWidgetVisible(button)
            spot = button.mapTo(window, button.rect().center())
            return window.childAt(spot) is button

        qtbot.waitUntil(seen, timeout=PATIENCE_MS)
        qtbot.mouseClick(window.findChild(QAbstractButton, name), Qt.MouseButton.LeftButton)

    def asked(verb: str) -> None:
        def came() -> bool:
            window.tick()
            return verb in engine.verbs

        qtbot.waitUntil(came, timeout=PATIENCE_MS)

    engine.keeps_talking = True  # this story starts processes, which takes long on a busy computer
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
    hit("place_results")
    results = window.tabs.panels["results"]
    assert isinstance(results, ResultsPanel)

    def listed() -> bool:
        window.tick()
        return results.chosen() != [] or bool(results.table.rows.rowCount())

    qtbot.waitUntil(listed, timeout=PATIENCE_MS)
    row = results.table.visualRect(results.table.rows.index(0, 1)).center()
    qtbot.mouseClick(results.table.viewport(), Qt.MouseButton.LeftButton, pos=row)
    writes = ("-c", "import sys; open(sys.argv[-1], 'w').close()")
    monkeypatch.setattr(
        documents, "module_command", lambda *one: [sys.executable, *writes, *map(str, one)]
    )
    hit("result_write_pdf")
    qtbot.waitUntil(recorded.with_suffix(".pdf").exists, timeout=PATIENCE_MS)
    hit("result_compare")
    qtbot.waitUntil(lambda: window.tick() or bool(results.compare.runs), timeout=PATIENCE_MS)
    assert [one.text for one in results.compare.plot.marks.names] == [recorded.stem]
    hit("place_settings")
    hit("place_rig")
    hit("power_off")
    asked("drive_off")
