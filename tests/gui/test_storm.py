"""A storm at the window: its pages and its buttons at random; nothing fails, nothing piles up.

RIGAPP_STORM_UPDATES (100,000) sets how many revolutions the long form draws (``make soak``).
"""

from __future__ import annotations

import gc
import logging
import os
import random
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QCoreApplication, QEvent, QPoint, Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QDialog,
    QLineEdit,
    QTableView,
    QWidget,
)

from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.window.tabs import TABS
from rigapp.gui.window.window import MainWindow
from rigapp.schema.messages import Reply, RunState
from tests.soak.footprint import MEGABYTE, footprint

SEED = 14
EXAMPLES = Path(__file__).parents[2] / "examples"
LONG_UPDATES = int(os.environ.get("RIGAPP_STORM_UPDATES", "100000"))
ROUNDS = 5
"""Tests of the long form, one after the other: each forgets the one before it."""

GROWTH = 8 * MEGABYTE
"""Of memory between the end of the second test and that of the last: what the allocator leaves
unused differs by some megabytes from one end to the next."""

SPARED = ("_write_", "_open_", "help_button")
"""Parts of names of what starts another program (the reports' writers, the desktop's viewers, and
the reader of the help), which tests of their own look at."""

OFFSCREEN = "This plugin"
"""Of what Qt says where there is no screen, whenever a dialog opens."""

CLICKED = (QAbstractButton, QComboBox, QAbstractSpinBox, QLineEdit, QTableView, QuietPlot)
TYPED = "12,5 a-"
LEADS_TO = {
    "start": RunState.RUNNING,
    "pause": RunState.PAUSED,
    "resume": RunState.RUNNING,
    "stop": RunState.STOPPED,
    "drive_off": RunState.FAULT,
    "reset": RunState.READY,
    "connect": RunState.READY,
}
"""What the scripted rig does when it is asked."""


class Storm:
    """Go to pages and click at random; what was asked of the rig happens with the next news."""

    def __init__(self, window: MainWindow, seed: int = SEED) -> None:
        self.window, self.dice = window, random.Random(seed)
        self.dialogs = self.clicks = 0

    def change_page(self) -> None:
        """Go to a page by its key, whatever is shown."""
        self.window.activateWindow()
        keys = QKeySequence(self.dice.choice(TABS).key)
        QTest.keySequence(self.window, keys)

    def click(self) -> None:
        """Click, type or choose at something that can be used now, then answer what it asks."""
        top = self._top()
        found = [
            one
            for one in top.findChildren(QWidget)
            if isinstance(one, CLICKED) and self._usable(one)
        ]
        if found:
            self._use(self.dice.choice(found))
            self.clicks += 1
        self.answer()

    def answer(self) -> None:
        """Close a list that is open, and one of two dialogs; the other is clicked at first."""
        popup = QApplication.activePopupWidget()
        if popup is not None:
            QTest.keyClick(popup, self.dice.choice((Qt.Key.Key_Return, Qt.Key.Key_Escape)))
        if self._top() is not self.window and self.dice.random() < 0.5:
            self.close_dialogs()

    def close_dialogs(self) -> None:
        """Answer every dialog with Esc."""
        while (top := self._top()) is not self.window:
            QTest.keyClick(top, Qt.Key.Key_Escape)
            assert not top.isVisible(), f"Esc does not close {top.objectName() or top}"
            self.dialogs += 1

    def _top(self) -> QWidget:
        dialogs = [
            one for one in self.window.findChildren(QDialog) if one.isWindow() and one.isVisible()
        ]
        return dialogs[-1] if dialogs else self.window

    def _usable(self, one: QWidget) -> bool:
        seen = one.isVisible() and one.isEnabled() and not one.visibleRegion().isEmpty()
        return seen and not any(part in one.objectName() for part in SPARED)

    def _use(self, one: QWidget) -> None:
        within = QPoint(self.dice.randrange(one.width()), self.dice.randrange(one.height()))
        target: Any = one.viewport() if isinstance(one, QTableView | QuietPlot) else one
        QTest.mouseClick(target, Qt.MouseButton.LeftButton, pos=within)
        if isinstance(one, QLineEdit | QAbstractSpinBox):
            QTest.keyClicks(one, self.dice.choice(TYPED))


@pytest.fixture
def storm(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, qtlog: Any, caplog: Any
) -> Iterator[Storm]:
    """Return a storm; after it, neither log nor Qt may have told of anything wrong.

    The test files are copies: somebody presses Save in a storm.
    """
    monkeypatch.setattr("rigapp.gui.window.window.launch_process", lambda arguments: None)
    monkeypatch.chdir(tmp_path)
    copy = tmp_path / "quick.toml"
    shutil.copy(EXAMPLES / copy.name, copy)
    window.tabs.prepare.recipe.open_file(copy)
    storm = Storm(window)
    yield storm
    storm.close_dialogs()
    window._discard = True
    told = [one for one in caplog.records if one.levelno >= logging.ERROR]
    assert told == []
    assert [one.message for one in qtlog.records if OFFSCREEN not in one.message] == []


def rides_out(
    storm: Storm, engine: Any, attach: Callable[[], None], pages: int, clicks: int
) -> None:
    """Change so many pages and click so often, news between them."""
    deeds = [storm.change_page] * pages + [storm.click] * clicks
    storm.dice.shuffle(deeds)
    state, row = RunState.READY, 1
    for deed in deeds:
        deed()
        running = state in (RunState.RUNNING, RunState.PAUSED)
        engine.say(first=row, count=int(running), curves=running, state=state)
        attach()
        QCoreApplication.processEvents()
        row += int(running)
        for verb in engine.verbs:
            state = LEADS_TO.get(verb, state)
        engine.requests.clear()


def refused(engine: Any) -> None:
    """Let the scripted engine refuse: it has no devices that could be calibrated."""
    engine.reply = Reply(ok=False, sentence="There are no signals.")


@pytest.mark.long
@pytest.mark.parametrize(
    ("pages", "clicks"), [(20, 40), pytest.param(225, 500, marks=pytest.mark.soak)]
)
def test_pages_and_clicks_at_random_lead_to_no_error(
    storm: Storm, engine: Any, attach: Callable[[], None], pages: int, clicks: int
) -> None:
    refused(engine)
    rides_out(storm, engine, attach, pages, clicks)
    assert storm.clicks > clicks // 2


@pytest.mark.soak
@pytest.mark.timeout(7200)
def test_memory_stays_after_many_updates_on_every_page(
    window: MainWindow, engine: Any, attach: Callable[[], None]
) -> None:
    """Draw test after test, each page in turn; the end of each holds what the second one's did."""
    each, held = LONG_UPDATES // ROUNDS, []
    for test in range(ROUNDS):
        for row in range(1, each + 1):
            if row % 50 == 1:
                window.tabs.setCurrentIndex(row // 50 % len(TABS))
            engine.say(first=row, count=1, planned=each, started_at=1.8e9 + test)
            attach()
            QCoreApplication.processEvents()
            # Without a loop that runs, nobody else deletes what is to be deleted later.
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete.value)
        gc.collect()
        held.append((footprint(os.getpid()).memory, len(QApplication.allWidgets())))
    assert held[-1][0] - held[1][0] < GROWTH, held
    assert held[-1][1] <= held[1][1], held
