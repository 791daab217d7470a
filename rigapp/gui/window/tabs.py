"""The tabs of the window; each panel draws only while it can be seen."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import Protocol

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QScrollArea, QSplitter, QTabWidget, QVBoxLayout, QWidget

from rigapp.gui.data.connection import EngineConnection
from rigapp.gui.data.showntest import ShownTest
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.panels.alarms import AlarmPanel
from rigapp.gui.panels.browser import BrowserPanel
from rigapp.gui.panels.cycle import CyclePanel
from rigapp.gui.panels.devices import DevicePanel
from rigapp.gui.panels.faults import FaultPanel
from rigapp.gui.panels.limits import LimitPanel
from rigapp.gui.panels.logbook import LogPanel
from rigapp.gui.plots.overlay import OverlayPanel
from rigapp.gui.plots.palette import Theme
from rigapp.gui.plots.trend import TrendPanel
from rigapp.gui.plots.wearprofile import WearProfilePanel
from rigapp.gui.testfile.prepare import PreparePanel
from rigapp.gui.window.headline import is_stale
from rigapp.gui.window.watchdog import Watchdog
from rigapp.schema.loglines import newest_limits
from rigapp.schema.messages import Status

Drawing = Callable[[Status | None], None]

PREPARE_INDEX = 4
TURN_MS = 10
"""Between two parts of a long drawing, so that keys and the state bar come in between."""

HORIZONTAL, VERTICAL = Qt.Orientation.Horizontal, Qt.Orientation.Vertical


class Dressed(Protocol):
    """A panel that takes a theme."""

    def isVisible(self) -> bool:
        """Tell whether it is on the screen, as Qt has it."""
        ...

    def dress(self, theme: Theme) -> None:
        """Take the colours of a theme."""
        ...


class Tabs(QTabWidget):
    """Own every panel. ``wanted`` carries requests to the engine, ``said`` sentences."""

    wanted = Signal(str, dict)
    said = Signal(str, bool)
    start_wanted = Signal(Path)

    def __init__(
        self,
        connection: EngineConnection,
        test: ShownTest,
        theme: Theme,
        results_folder: Path,
        worker: TaskWorker,
        watchdog: Watchdog,
    ) -> None:
        super().__init__()
        self._connection = connection
        self._test = test
        self.setObjectName("tabs")
        self.setAccessibleName("Panels")
        self.overview = OverlayPanel("overview", theme)
        self.overview_trend = TrendPanel("overview", theme)
        self.overview_wear = TrendPanel("overview_wear", theme, "wear", access_keys=False)
        self.overview_alarms = AlarmPanel("overview", theme, compact=True)
        self.cycle = CyclePanel(theme)
        self.upper_trend = TrendPanel("upper", theme, "force")
        self.lower_trend = TrendPanel("lower", theme, "wear", access_keys=False)
        self.residual_trend = TrendPanel("residual", theme, "residual", access_keys=False)
        self.profile = WearProfilePanel("trends", theme)
        self.alarms = AlarmPanel("all", theme)
        self.limits = LimitPanel()
        self.prepare = PreparePanel(theme, results_folder, worker)
        self.devices = DevicePanel(theme, watchdog)
        self.log = LogPanel(worker)
        self.browser = BrowserPanel(theme, results_folder, worker)
        self.faults = FaultPanel(worker)
        self.splitters: list[QSplitter] = [self.cycle, self.cycle.right, self.prepare]
        self.splitters.append(self.browser)
        self._trends = (
            self.overview_trend,
            self.overview_wear,
            self.upper_trend,
            self.lower_trend,
            self.residual_trend,
        )
        self._slow = self._slow_drawings()
        self._staged: list[QWidget] = [*self._trends, self.profile]
        self._staged += [self.overview.residual_plot, self.cycle.overlay.residual_plot]
        self._staged += [self.cycle.polar, self.cycle.probes, self.cycle.values]
        self._build()
        self._connect()

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        dressed: tuple[Dressed, ...] = (
            self.overview,
            self.overview_alarms,
            self.cycle,
            self.profile,
            self.alarms,
            self.prepare,
            self.devices,
            self.browser,
            *self._trends,
        )
        # What is seen first; the sort is stable. The first panel of those at once.
        first, *others = sorted(dressed, key=lambda panel: not panel.isVisible())
        first.dress(theme)
        self._in_turns(partial(panel.dress, theme) for panel in others)

    def take_status(self, status: Status) -> None:
        """Take what every new status means for panels, seen or not."""
        for overlay in (self.overview, self.cycle.overlay):
            overlay.set_channels(status.channels)
        for panel in (self.overview_alarms, self.alarms):
            panel.show_alarms(status.alarms)
            panel.show_state(status.state)
        simulated = status.simulated and not self._connection.is_replay
        if self.isTabVisible(self._fault_index) != simulated:
            self.setTabVisible(self._fault_index, simulated)

    def draw_fast(self, status: Status | None) -> None:
        """Draw the newest revolution where it can be seen."""
        data = self._test.data
        ratio = self._test.crank_over_follower
        stale = status is not None and is_stale(status)
        if self.overview.isVisible():
            self.overview.set_mechanism(ratio)
            self.overview.refresh(data, stale=stale)
        if self.cycle.isVisible():
            self.cycle.overlay.set_mechanism(ratio)
            self.cycle.show_newest(data, stale=stale)

    def draw_slow(self, status: Status | None) -> None:
        """Draw trends, tables and lists where they can be seen."""
        for panel, draw in self._slow:
            if panel.isVisible():
                draw(status)

    def draw_part(self, status: Status | None, part: int, parts: int) -> None:
        """Draw one of so many parts of what ``draw_slow`` draws, so that no turn is long."""
        for panel, draw in self._slow[part::parts]:
            if panel.isVisible():
                draw(status)

    def _slow_drawings(self) -> list[tuple[QWidget, Drawing]]:
        trends = [(trend, partial(self._draw_trend, trend)) for trend in self._trends]
        return [
            *trends,
            (self.profile, self._draw_profile),
            (self.prepare, self.prepare.show_status),
            (self.devices, self._draw_devices),
            (self.log, self._follow_log),
            (self.limits, self._follow_log),
            (self.limits, self._draw_limits),
            (self.faults, self.faults.show_status),
        ]

    def _draw_trend(self, trend: TrendPanel, status: Status | None) -> None:
        trend.refresh(self._test.data)

    def _draw_profile(self, status: Status | None) -> None:
        test = self._test.recipe
        self.profile.refresh(self._test.data, test.model.joint if test is not None else None)

    def _draw_devices(self, status: Status | None) -> None:
        self.devices.show_status(status, self._connection.silence_s())

    def _follow_log(self, status: Status | None) -> None:
        self.log.follow(self._test.path)

    def _draw_limits(self, status: Status | None) -> None:
        state = status.state if status is not None else None
        planned = status.planned if status is not None else 0
        changed = newest_limits(self.log.events)
        self.limits.show_limits(state, self._test.recipe, changed, planned)

    def show_prepare(self) -> None:
        """Go to the tab that prepares a test."""
        self.setCurrentIndex(PREPARE_INDEX)

    def open_tests(self, tests: list[Path]) -> None:
        """Offer the first test file in the form."""
        if tests:
            self.prepare.recipe.open_file(tests[0])

    def _build(self) -> None:
        right = self._split("overview_right", VERTICAL, [380, 260])
        right.addWidget(self.overview_trend)
        right.addWidget(self.overview_wear)
        upper = self._split("overview_split", HORIZONTAL, [700, 700])
        upper.addWidget(self.overview)
        upper.addWidget(right)
        overview = QWidget()
        column = QVBoxLayout(overview)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(upper, 1)
        column.addWidget(self.overview_alarms)
        lower = self._split("trend_lower", HORIZONTAL, [700, 700])
        lower.addWidget(self.lower_trend)
        lower.addWidget(self.profile)
        trends = self._split("trend_split", VERTICAL, [300, 180, 300])
        for part in (self.upper_trend, self.residual_trend, lower):
            trends.addWidget(part)
        alarms = self._split("alarm_split", VERTICAL, [400, 300])
        alarms.addWidget(self.alarms)
        alarms.addWidget(self.limits)
        pages = (
            (overview, "Overview"),
            (self.cycle, "Cycle"),
            (trends, "Trends"),
            (alarms, "Alarms and limits"),
            (self.prepare, "Prepare"),
            (self.devices, "Devices"),
            (self.log, "Log"),
            (self.browser, "Results"),
            (self.faults, "Simulated faults"),
        )
        for number, (page, text) in enumerate(pages, start=1):
            page.setAutoFillBackground(True)
            self.addTab(_scrolling(page, text), f"{number} {text}")
            self.setTabToolTip(number - 1, f"{text} (Ctrl+{number})")
        self._fault_index = self.count() - 1
        self.setTabVisible(self._fault_index, False)

    def _split(self, name: str, orientation: Qt.Orientation, sizes: list[int]) -> QSplitter:
        splitter = SizedSplitter(orientation, sizes)
        splitter.setObjectName(name)
        splitter.setAccessibleName("Divided panels")
        splitter.setChildrenCollapsible(False)
        self.splitters.append(splitter)
        return splitter

    def _connect(self) -> None:
        for panel in (
            self.overview_alarms,
            self.alarms,
            self.limits,
            self.devices,
            self.browser,
            self.faults,
        ):
            panel.wanted.connect(self.wanted)
        self.browser.said.connect(self.said)
        self.prepare.recipe.start_wanted.connect(self.start_wanted)
        self.cycle.revolution_wanted.connect(self._ask_revolution)
        self.currentChanged.connect(self._changed)
        for index in range(self.count()):
            shortcut = QShortcut(QKeySequence(f"Ctrl+{index + 1}"), self)
            shortcut.activated.connect(partial(self._go_to, index))

    def _go_to(self, index: int) -> None:
        if self.isTabVisible(index):
            self.setCurrentIndex(index)

    def _changed(self) -> None:
        self.draw_fast(self._connection.status)
        calls: list[Callable[[], object]] = []
        for panel in self._staged:
            if panel.isVisible():
                panel.setUpdatesEnabled(False)
                calls.append(partial(panel.setUpdatesEnabled, True))
        for panel, draw in self._slow:
            if panel.isVisible():
                calls.append(partial(self._draw_later, panel, draw))
        self._in_turns(calls)
        if self.browser.isVisible():
            self.browser.look()

    def _in_turns(self, calls: Iterable[Callable[[], object]]) -> None:
        """Make each call in a turn of the event loop of its own, so that none is long."""
        for number, call in enumerate(calls, 1):
            QTimer.singleShot(number * TURN_MS, self, call)

    def _draw_later(self, panel: QWidget, draw: Drawing) -> None:
        if panel.isVisible():
            draw(self._connection.status)

    def _ask_revolution(self, revolution: int) -> None:
        def failed(error: Exception) -> None:
            self.said.emit(f"No stored revolution: {error}", False)
            self.cycle.no_revolution()

        self._test.ask_revolution(revolution, self.cycle.show_revolution, failed)


def _scrolling(page: QWidget, text: str) -> QScrollArea:
    """Return a page that scrolls on a screen too small for it; state and buttons stay in sight."""
    area = QScrollArea()
    area.setObjectName(f"page_{text.split()[-1].lower()}")
    area.setAccessibleName(text)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setWidget(page)
    return area


class SizedSplitter(QSplitter):
    """A splitter that takes its first sizes when its last panel arrives."""

    def __init__(self, orientation: Qt.Orientation, sizes: list[int]) -> None:
        super().__init__(orientation)
        self._sizes = sizes

    def addWidget(self, widget: QWidget) -> None:
        """Add a panel."""
        super().addWidget(widget)
        if self.count() == len(self._sizes):
            self.setSizes(self._sizes)
