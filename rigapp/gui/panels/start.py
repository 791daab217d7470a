"""The page to begin with: four ways on, and the last tests."""

from __future__ import annotations

from functools import partial
from typing import Final

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QHideEvent, QKeySequence, QShortcut, QShowEvent
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QWidget

from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.panel import Act, Host
from rigapp.gui.panels.results import ShelfPump
from rigapp.gui.results.resulttable import ROW_HEIGHT, ResultTable
from rigapp.gui.widgets.build import button, column, key_text, named, prose, row
from rigapp.gui.widgets.labels import heading
from rigapp.gui.widgets.reflow import WrappingGrid
from rigapp.presentation.numbers import grouped
from rigapp.presentation.states import occupied_text
from rigapp.presentation.tokens import MARGIN, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.states import ACTIVE
from rigapp.viewer.news import News, Takes

LAST = 20
"""Tests that are listed; all of them stand under Results."""
TRY_KEY: Final = "F11"
WAYS: Final[dict[Act, tuple[Icon, Text, Text, Text, str]]] = {
    Act.TRY: (
        Icon.TRY,
        "Try the simulated rig",
        "A short test on a rig of software.",
        "Try it",
        TRY_KEY,
    ),
    Act.PREPARE: (
        Icon.PREPARE,
        "Prepare a test",
        "A new one, or one like another.",
        "Prepare",
        "Ctrl+5",
    ),
    Act.CALIBRATE: (
        Icon.CALIBRATE,
        "Calibrate",
        "Load cell, probes, daily check.",
        "Calibrate",
        "F3",
    ),
    Act.RESULTS: (Icon.RESULTS, "Open results", "Look, compare, report.", "Open", "Ctrl+8"),
}
"""The ways on in their order: icon, title, what it is, what the button says, and its key.

The keys are those of the whole window: a digit alone would be typed into the field with the focus.
"""
SIGN = QSize(24, 24)
WAY_WIDTH = 22 * STEP
"""Of a way on, at least."""


def may_begin(news: News) -> bool:
    """Tell whether nothing is under way yet."""
    status = news.status
    return not news.is_replay and (status is None or status.engine.state not in ACTIVE)


class WayCard(QFrame):
    """One way on: icon, title, what it is, and its button."""

    chosen = Signal(Act)

    def __init__(self, act: Act) -> None:
        super().__init__()
        meaning, title, text, word, key = WAYS[act]
        self._meaning = meaning
        named(self, f"way_{act.value}", title, role="card")
        self.sign = QLabel()
        head = heading(f"way_title_{act.value}", title)
        head.setWordWrap(True)
        self.text = prose(f"way_text_{act.value}", title, text, role="secondary")
        self.button: QPushButton = button(
            f"way_button_{act.value}",
            tr(word),
            partial(self.chosen.emit, act),
            title,
            tip=f"{tr(title)} ({key_text(key)})",
            rank="primary" if act is Act.TRY else "",
            guarded=act in (Act.TRY, Act.CALIBRATE),
        )
        self.button.setFixedHeight(5 * STEP)
        self.shortcut = prose(f"way_key_{act.value}", title, key_text(key), role="secondary")
        column(
            row((self.sign, 1), self.shortcut),
            head,
            (self.text, 1),
            self.button,
            on=self,
            margins=MARGIN,
            spacing=STEP,
        )

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.sign.setPixmap(icon(self._meaning, theme.highlight).pixmap(SIGN))


class StartPage(QWidget):
    """Offer what can be begun with; what is connected meanwhile stands at the right."""

    takes = Takes.STATUS

    def __init__(self, host: Host) -> None:
        super().__init__()
        self._host = host
        named(self, "start_page", "Where to begin")
        self.title = heading("start_title", "Where would you like to begin?", VALUE_PT)
        self.rig = prose("start_rig", "The rig", role="secondary")
        self.ways = {act: WayCard(act) for act in WAYS}
        for card in self.ways.values():
            card.chosen.connect(host.do)
        QShortcut(QKeySequence(TRY_KEY), self, self.ways[Act.TRY].button.click)
        self.table = ResultTable("last_tests", host.results, host.theme, most=LAST)
        self.table.setMinimumHeight(3 * ROW_HEIGHT)
        self.table.opened.connect(lambda _: host.do(Act.RESULTS))
        self.all = button("all_results", "All results", partial(host.do, Act.RESULTS), rank="quiet")
        self.new_rig = button(
            "start_new_rig",
            "New rig…",
            partial(host.do, Act.NEW_RIG),
            tip="Make the files of a rig with real devices (Ctrl+N)",
            rank="quiet",
        )
        self._pump = ShelfPump(host.results, self._changed, self)
        below = row(heading("last_title", "Last tests"), None, self.all)
        cards = WrappingGrid(WAY_WIDTH, len(WAYS))
        for card in self.ways.values():
            cards.addWidget(card)
        rig = row((self.rig, 1), self.new_rig)
        column(self.title, rig, cards, below, (self.table, 1), on=self, spacing=STEP)
        self.dress(host.theme)

    def showEvent(self, event: QShowEvent) -> None:
        """Look for the last tests."""
        super().showEvent(event)
        self._pump.start()
        self._host.results.look()

    def hideEvent(self, event: QHideEvent) -> None:
        """Take nothing while nobody looks."""
        super().hideEvent(event)
        self._pump.stop()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.table.dress(theme)
        for card in self.ways.values():
            card.dress(theme)

    def show_news(self, news: News) -> None:
        """Say what rig it is."""
        status = news.status
        free = status is None or status.engine.calibration is None
        self.ways[Act.TRY].button.setEnabled(free)
        if status is not None and not free:
            self.rig.setText(occupied_text(status))
        elif status is None:
            self.rig.setText(
                tr("Looking for the engine of the rig. Results can be opened meanwhile.")
            )
        elif status.rig.simulated:
            self.rig.setText(tr("{} is simulated: nothing real turns.", status.rig.name))
        else:
            self.rig.setText(
                tr("{} is a real rig. The simulated one opens beside it.", status.rig.name)
            )

    def _changed(self) -> None:
        self.table.refresh()
        number = len(self._host.results.paths)
        self.all.setText(tr("All {} results", grouped(number)) if number else tr("No results yet"))


def start_page(host: Host) -> QWidget:
    """Make the page to begin with."""
    return host.add("start", StartPage(host))
