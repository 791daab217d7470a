"""The operator's window: state bar, controls, tabs; one timer pulls, hidden tabs do not draw."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QSettings, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QApplication,
    QHBoxLayout,
    QMainWindow,
    QPushButton,
    QSplitter,
    QTabWidget,
    QVBoxLayout,
    QWidget,
)

from rigapp.config.rig import RigFile
from rigapp.engine.messages import Snapshot, Status
from rigapp.gui.alarms import AlarmPanel
from rigapp.gui.controls import STARTABLE, ControlRow
from rigapp.gui.cycle import CyclePanel
from rigapp.gui.header import Header
from rigapp.gui.headline import headline, is_stale
from rigapp.gui.help import HelpWindow
from rigapp.gui.link import Link
from rigapp.gui.overlay import OverlayPanel
from rigapp.gui.palette import THEMES, Theme, apply_theme
from rigapp.gui.prepare import PreparePanel
from rigapp.gui.session import Session
from rigapp.gui.startbar import StartBar
from rigapp.gui.tasks import Worker
from rigapp.gui.trend import TrendPanel
from rigapp.gui.watchdog import Watchdog

log = logging.getLogger(__name__)

TICK_MS = 100
TREND_EVERY = 5
"""Ticks between two drawings of a trend: twice a second."""


class MainWindow(QMainWindow):
    """Show one engine. Everything slow happens on the workers of link and session."""

    def __init__(
        self,
        link: Link,
        session: Session,
        theme: Theme,
        *,
        rig: RigFile | None = None,
        tests: Sequence[Path] = (),
        results_folder: Path = Path("results"),
        settings: QSettings | None = None,
    ) -> None:
        super().__init__()
        self._link = link
        self._session = session
        self._settings = settings
        self._ticks = 0
        self._help: HelpWindow | None = None
        self._start_wanted: Path | None = None
        self.theme = theme
        self.setObjectName("main_window")
        self.setWindowTitle("rigapp")
        self.setAccessibleName("Rig control")
        self.header = Header(theme)
        self.controls = ControlRow(link.request, theme)
        self.start_bar = StartBar(tests, results_folder)
        self.tabs = QTabWidget()
        self.tabs.setObjectName("tabs")
        self.tabs.setAccessibleName("Panels")
        self.overview = OverlayPanel("overview", theme)
        self.overview_trend = TrendPanel("overview", theme)
        self.overview_alarms = AlarmPanel("overview", theme)
        self.overview_wear = TrendPanel("overview_wear", theme, "wear", access_keys=False)
        self.cycle = CyclePanel(theme)
        self.trend_upper = TrendPanel("upper", theme, "force")
        self.trend_lower = TrendPanel("lower", theme, "wear", access_keys=False)
        self.alarms = AlarmPanel("all", theme)
        self._reader = Worker("gui-files", bound=16)
        self.prepare = PreparePanel(theme, results_folder, self._reader)
        self._trends = (
            self.overview_trend,
            self.overview_wear,
            self.trend_upper,
            self.trend_lower,
        )
        if rig is not None:
            self.prepare.set_rig(rig)
        if tests:
            self.prepare.recipe.open_file(tests[0])
        self._splitters: list[QSplitter] = []
        self._build()
        self._connect()
        self.watchdog = Watchdog(self)
        self._timer = QTimer(self)
        self._timer.setInterval(TICK_MS)
        self._timer.timeout.connect(self.tick)
        self._restore_layout()

    def start(self) -> None:
        """Begin to pull; called when the window is on the screen."""
        self._timer.start()
        self.watchdog.start()

    def tick(self) -> None:
        """Pull what is new and draw what is visible."""
        self._ticks += 1
        self._session.deliver()
        self._reader.deliver()
        snapshot = self._link.pump()
        if snapshot is not None:
            self._take(snapshot)
        status = self._link.status
        self.header.show_headline(
            headline(status, self._link.state, self._link.reason, self._link.data_age_s())
        )
        self.controls.show_status(status, self._link.state)
        if self._session.problem:
            self.controls.show_answer(self._session.problem, good=False)
            self._session.problem = ""
        self.draw(status)

    def draw(self, status: Status | None, *, at_once: bool = False) -> None:
        """Draw the panels that can be seen; a minimised window draws nothing."""
        if self.isMinimized():
            return
        data = self._session.data
        ratio = self._session.crank_over_follower
        stale = status is not None and is_stale(status)
        if self.overview.isVisible():
            self.overview.set_mechanism(ratio)
            self.overview.refresh(data, stale=stale)
        if self.cycle.isVisible():
            self.cycle.overlay.set_mechanism(ratio)
            self.cycle.show_newest(data, stale=stale)
        if at_once or self._ticks % TREND_EVERY == 0:
            if self.prepare.isVisible():
                self.prepare.show_status(status)
            for trend in self._trends:
                if trend.isVisible():
                    trend.refresh(data)

    @property
    def settled(self) -> bool:
        """Tell whether the engine has spoken and the history of its test is read."""
        return self._link.status is not None and self._session.settled

    def draw_now(self) -> None:
        """Draw what is visible without waiting for the next tick."""
        self.draw(self._link.status, at_once=True)

    def start_when_idle(self, test: Path) -> None:
        """Start a test as soon as the engine has been heard and runs no other."""
        self._start_wanted = test

    def switch_theme(self) -> None:
        """Change between light and dark."""
        self.dress(THEMES["dark" if self.theme.name == "light" else "light"])

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self.theme = theme
        application = QApplication.instance()
        if isinstance(application, QApplication):
            apply_theme(application, theme)
        for panel in (
            self.header,
            self.controls,
            self.overview,
            self.overview_trend,
            self.overview_alarms,
            self.overview_wear,
            self.cycle,
            self.trend_upper,
            self.trend_lower,
            self.alarms,
            self.prepare,
        ):
            panel.dress(theme)

    def show_help(self) -> None:
        """Open the help window, or bring it to the front."""
        if self._help is None:
            self._help = HelpWindow(self)
        self._help.show()
        self._help.raise_()
        self._help.activateWindow()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Remember the layout and detach; a running test goes on."""
        self._timer.stop()
        self._save_layout()
        self._link.close()
        self._session.close()
        self._reader.close()
        super().closeEvent(event)

    def _take(self, snapshot: Snapshot) -> None:
        self._session.take(snapshot)
        if self._start_wanted is not None and snapshot.status.state in STARTABLE:
            test, self._start_wanted = self._start_wanted, None
            self.controls.show_status(snapshot.status, self._link.state)
            self.start_bar.start(test)
        for overlay in (self.overview, self.cycle.overlay):
            overlay.set_channels(snapshot.status.channels)
        self.overview_alarms.show_alarms(snapshot.status.alarms)
        self.alarms.show_alarms(snapshot.status.alarms)
        title = snapshot.status.test or "rigapp"
        if self.windowTitle() != title:
            self.setWindowTitle(title)

    def _start_prepared(self, path: Path) -> None:
        self.start_bar.choose(path)
        self.start_bar.open()

    def _ask_revolution(self, revolution: int) -> None:
        def failed(error: Exception) -> None:
            self.controls.show_answer(f"No stored revolution: {error}", good=False)
            self.cycle.no_revolution()

        self._session.ask_revolution(revolution, self.cycle.show_revolution, failed)

    def _build(self) -> None:
        right = self._splitter("overview_right", Qt.Orientation.Vertical)
        right.addWidget(self.overview_trend)
        right.addWidget(self.overview_wear)
        right.addWidget(self.overview_alarms)
        right.setSizes([330, 220, 150])
        overview = self._splitter("overview_split", Qt.Orientation.Horizontal)
        overview.addWidget(self.overview)
        overview.addWidget(right)
        overview.setSizes([700, 700])
        self._splitters += [self.cycle, self.cycle.right, self.prepare]
        trends = self._splitter("trend_split", Qt.Orientation.Vertical)
        trends.addWidget(self.trend_upper)
        trends.addWidget(self.trend_lower)
        for widget, text in (
            (overview, "1 Overview"),
            (self.cycle, "2 Cycle"),
            (trends, "3 Trends"),
            (self.alarms, "4 Alarms"),
            (self.prepare, "5 Prepare"),
        ):
            widget.setAutoFillBackground(True)
            self.tabs.addTab(widget, text)
        self.help_button = QPushButton("Help  F1")
        self.help_button.setObjectName("help_button")
        self.help_button.setAccessibleName("Help")
        self.theme_button = QPushButton("Light / dark  F9")
        self.theme_button.setObjectName("theme_button")
        self.theme_button.setAccessibleName("Light or dark")
        corner = QWidget()
        row = QHBoxLayout(corner)
        row.setContentsMargins(0, 0, 0, 2)
        row.addWidget(self.theme_button)
        row.addWidget(self.help_button)
        self.tabs.setCornerWidget(corner)
        body = QWidget()
        column = QVBoxLayout(body)
        column.setContentsMargins(6, 6, 6, 6)
        column.setSpacing(6)
        column.addWidget(self.header)
        column.addWidget(self.controls)
        column.addWidget(self.start_bar)
        column.addWidget(self.tabs, 1)
        self.setCentralWidget(body)
        self.resize(1400, 900)

    def _splitter(self, name: str, orientation: Qt.Orientation) -> QSplitter:
        splitter = QSplitter(orientation)
        splitter.setObjectName(name)
        splitter.setAccessibleName("Divided panels")
        splitter.setChildrenCollapsible(False)
        self._splitters.append(splitter)
        return splitter

    def _connect(self) -> None:
        self.controls.start_wanted.connect(self.start_bar.open)
        self.start_bar.started.connect(self.controls.start_test)
        for panel in (self.overview_alarms, self.alarms):
            panel.wanted.connect(self.controls.send)
        self.prepare.recipe.start_wanted.connect(self._start_prepared)
        self.cycle.revolution_wanted.connect(self._ask_revolution)
        self.tabs.currentChanged.connect(lambda _: self.draw_now())
        self.help_button.clicked.connect(self.show_help)
        self.theme_button.clicked.connect(self.switch_theme)
        QShortcut(QKeySequence("F1"), self, self.show_help)
        QShortcut(QKeySequence("F9"), self, self.switch_theme)
        for index in range(self.tabs.count()):
            shortcut = QShortcut(QKeySequence(f"Ctrl+{index + 1}"), self)
            shortcut.activated.connect(partial(self.tabs.setCurrentIndex, index))

    def _restore_layout(self) -> None:
        if self._settings is None:
            return
        geometry = self._settings.value("geometry")
        if geometry is not None:
            self.restoreGeometry(geometry)
        for splitter in self._splitters:
            state = self._settings.value(f"splitter/{splitter.objectName()}")
            if state is not None:
                splitter.restoreState(state)
        self.tabs.setCurrentIndex(int(str(self._settings.value("tab", 0))))

    def _save_layout(self) -> None:
        if self._settings is None:
            return
        self._settings.setValue("geometry", self.saveGeometry())
        for splitter in self._splitters:
            self._settings.setValue(f"splitter/{splitter.objectName()}", splitter.saveState())
        self._settings.setValue("tab", self.tabs.currentIndex())
        self._settings.setValue("theme", self.theme.name)
