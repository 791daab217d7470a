"""The tabs of the window, as one table; each panel draws only while it can be seen."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QScrollArea, QSplitter, QTabWidget, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.preferences import Preferences
from rigapp.gui.panel import Act, Dressed, Host, InParts, Panel, StallCounter
from rigapp.gui.panels.alarms import alarm_page
from rigapp.gui.panels.cycle import cycle_page
from rigapp.gui.panels.devices import device_page
from rigapp.gui.panels.faults import fault_page
from rigapp.gui.panels.logbook import log_page
from rigapp.gui.panels.newrig import new_rig_page
from rigapp.gui.panels.own import OwnPage, own_page
from rigapp.gui.panels.queue import queue_page
from rigapp.gui.panels.resultpage import has_result, result_page
from rigapp.gui.panels.results import results_page
from rigapp.gui.panels.start import may_begin, start_page
from rigapp.gui.panels.studies import StudiesPanel, studies_page
from rigapp.gui.panels.trends import overview_page, trend_page
from rigapp.gui.panels.trip import trip_page
from rigapp.gui.panels.wear import wear_page
from rigapp.gui.plots.plotmenu import offer_menus
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.results.shelf import ResultShelf
from rigapp.gui.settings.page import SettingsPage, settings_page
from rigapp.gui.testfile.prepare import PreparePanel, prepare_page
from rigapp.gui.widgets.build import named
from rigapp.gui.widgets.turns import Turns
from rigapp.gui.window.help import window_keys
from rigapp.gui.window.places import PageName, RailPlace
from rigapp.presentation.tokens import Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.states import ACTIVE
from rigapp.viewer.knownwear import WearReader
from rigapp.viewer.news import News, Takes, tripped
from rigapp.viewer.showntest import ShownTest
from rigapp.viewer.tasks import TaskWorker


def _always(news: News) -> bool:
    return True


def _with_rig(news: News) -> bool:
    return not news.is_replay


def _simulated(news: News) -> bool:
    return news.status is not None and news.status.rig.simulated and not news.is_replay


@dataclass(frozen=True, slots=True)
class Tab:
    """One tab: its name, title, key and place, who makes its page, and when it is shown.

    What a page takes of the news is said by its panels (``Panel.takes``).
    """

    name: str
    title: Text
    key: str
    place: RailPlace
    make: Callable[[Host], QWidget]
    shown: Callable[[News], bool] = _always


TABS = (
    Tab("overview", "Overview", "Ctrl+1", RailPlace.WATCH, overview_page),
    Tab("cycle", "Cycle", "Ctrl+2", RailPlace.WATCH, cycle_page),
    Tab("trends", "Trends", "Ctrl+3", RailPlace.WATCH, trend_page),
    Tab("limits", "Alarms and limits", "Ctrl+4", RailPlace.WATCH, alarm_page),
    Tab("prepare", "Prepare", "Ctrl+5", RailPlace.PREPARE, prepare_page, _with_rig),
    Tab("queue", "Queue", "Ctrl+U", RailPlace.PREPARE, queue_page, _with_rig),
    Tab("devices", "Devices", "Ctrl+6", RailPlace.RIG, device_page, _with_rig),
    Tab("log", "Log", "Ctrl+7", RailPlace.WATCH, log_page),
    Tab("results", "Results", "Ctrl+8", RailPlace.RESULTS, results_page),
    Tab("wear", "Wear", "Ctrl+W", RailPlace.WATCH, wear_page),
    Tab("start", "Start", "Ctrl+0", RailPlace.WATCH, start_page, may_begin),
    Tab("result", "Result", "Ctrl+R", RailPlace.WATCH, result_page, has_result),
    Tab("own", "My page", "Ctrl+M", RailPlace.WATCH, own_page),
    Tab("studies", "Studies", "Ctrl+D", RailPlace.RESULTS, studies_page),
    Tab("trip", "Trip", "Ctrl+T", RailPlace.RESULTS, trip_page),
    Tab("settings", "Settings", "Ctrl+,", RailPlace.SETTINGS, settings_page),
    Tab("faults", "Simulated faults", "Ctrl+9", RailPlace.RIG, fault_page, _simulated),
    Tab("new_rig", "New rig", "Ctrl+N", RailPlace.RIG, new_rig_page, _with_rig),
)
NUMBERS = {tab.name: number for number, tab in enumerate(TABS)}


class Tabs(QTabWidget):
    """Own every page; ``panels`` are all panels on them, by name.

    ``wanted`` carries requests to the engine, ``said`` sentences, ``asked`` what the window is to
    do, ``help_wanted`` a section of docs/troubleshooting.md.
    """

    wanted = Signal(str, dict)
    said = Signal(str, bool)
    asked = Signal(Act)
    help_wanted = Signal(str)

    def __init__(
        self,
        test: ShownTest,
        theme: Theme,
        results: ResultShelf,
        worker: TaskWorker,
        stalls: StallCounter,
        preferences: Preferences,
        rig: Path | None = None,
    ) -> None:
        super().__init__()
        self._test = test
        self._turns = Turns(self)
        self._news = News()
        host = Host(
            theme,
            results,
            worker,
            stalls,
            self.wanted.emit,
            self.said.emit,
            test.ask_revolution,
            self.asked.emit,
            self.help_wanted.emit,
            preferences,
            WearReader(worker),
            rig,
            window_keys(),
        )
        self.panels = host.panels
        self._last_page = {tab.place: number for number, tab in reversed(list(enumerate(TABS)))}
        named(self, "tabs", "Panels")
        self.tabBar().hide()
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setDocumentMode(True)
        for place, tab in enumerate(TABS):
            page = tab.make(host)
            page.setAutoFillBackground(True)
            self.addTab(_scrolling(page, tab), f"{tab.key[-1]} {tr(tab.title)}")
            self.setTabToolTip(place, f"{tr(tab.title)} ({tab.key})")
            shortcut = QShortcut(QKeySequence(tab.key), self)
            shortcut.activated.connect(partial(self._go_to, place))
        offer_menus(self, self.said.emit)
        self.own.save_view = self.prepare.recipe.save_view
        self._offer_tabs()
        self.splitters = [one for one in self.findChildren(QSplitter) if one.objectName()]
        self.currentChanged.connect(self._changed)

    @property
    def prepare(self) -> PreparePanel:
        """Return the panel that prepares a test."""
        panel = self.panels["prepare"]
        assert isinstance(panel, PreparePanel)
        return panel

    @property
    def studies(self) -> StudiesPanel:
        """Return the page of the studies."""
        panel = self.panels["studies"]
        assert isinstance(panel, StudiesPanel)
        return panel

    @property
    def own(self) -> OwnPage:
        """Return the page that the operator arranges."""
        panel = self.panels["own"]
        assert isinstance(panel, OwnPage)
        return panel

    def take_armed(self) -> None:
        """Show the own page of the test file that is open, while no test brings one along."""
        armed = self.prepare.recipe.armed
        if armed is not None and armed.test is not None and self._news.recipe is None:
            self.own.take_view(armed.test.view)

    @property
    def settings(self) -> SettingsPage:
        """Return the page of settings."""
        panel = self.panels["settings"]
        assert isinstance(panel, SettingsPage)
        return panel

    @property
    def place(self) -> RailPlace:
        """Return the place that is shown."""
        return TABS[self.currentIndex()].place

    def pages(self) -> list[PageName]:
        """Return the pages of the place that is shown."""
        return [
            PageName(number, tab.title, tab.key)
            for number, tab in enumerate(TABS)
            if tab.place is self.place and self.isTabVisible(number)
        ]

    def places(self) -> set[RailPlace]:
        """Return the places that have pages now."""
        return {tab.place for at, tab in enumerate(TABS) if self.isTabVisible(at)}

    def show_place(self, place: RailPlace) -> None:
        """Go to the page of a place that was seen last, its first one at the beginning."""
        self._go_to(self._last_page[place])

    def show_page(self, name: str) -> None:
        """Go to a page by its name."""
        self._go_to(NUMBERS[name])

    def dress_calls(self, theme: Theme) -> list[Callable[[], object]]:
        """Return what puts the pages in a theme, a part each, what is seen first."""
        parts = [part for number in range(self.count()) for part in self._parts(number)]
        dressed = [panel for panel in self.panels.values() if isinstance(panel, Dressed)]
        calls = [(part.isVisible(), partial(dress_part, part, theme)) for part in parts]
        calls += [(panel.isVisible(), partial(panel.dress, theme)) for panel in dressed]
        return [call for _, call in sorted(calls, key=lambda one: not one[0])]

    def _parts(self, number: int) -> list[QWidget]:
        area = self.widget(number)
        assert isinstance(area, QScrollArea)
        inside = area.widget()
        if not isinstance(inside, InParts):
            return [area]
        return [*inside.parts(), area.verticalScrollBar(), area.horizontalScrollBar()]

    def take(self, news: News) -> None:
        """Take what every new status means, for panels that are seen or not."""
        before, self._news = self._news, news
        for panel in self.panels.values():
            if Takes.STATUS in panel.takes:
                panel.show_news(news)
        self._lead(before, news)

    def draw_fast(self, news: News) -> None:
        """Draw the newest revolution where it can be seen."""
        self._news = news
        for panel in self._seen(Takes.REVOLUTION):
            panel.show_news(news)

    def draw_slow(self, news: News, part: int = 0, parts: int = 1) -> None:
        """Draw trends, tables and lists where they can be seen; one of so many parts of them."""
        self._news = news
        if part == 0 and any(self._seen(Takes.LOG)):
            self._test.follow_log()
        for panel in list(self.panels.values())[part::parts]:
            self._draw_history(panel)

    def _draw_history(self, panel: Panel) -> None:
        if Takes.HISTORY in panel.takes and panel.isVisible():
            panel.show_news(self._news)

    def _seen(self, what: Takes) -> Iterable[Panel]:
        return (one for one in self.panels.values() if what in one.takes and one.isVisible())

    def _offer_tabs(self) -> None:
        for place, tab in enumerate(TABS):
            if self.isTabVisible(place) != tab.shown(self._news):
                self.setTabVisible(place, tab.shown(self._news))

    def _lead(self, before: News, news: News) -> None:
        """Go where the next step is, for somebody who looks at a page that has become idle."""
        was, now = before.status, news.status
        page = TABS[self.currentIndex()].name
        if page in ("start", "result") and not TABS[self.currentIndex()].shown(news):
            self.show_page("overview")
        self._offer_tabs()
        over = has_result(news) and (was is None or was.engine.state in ACTIVE)
        if over and page in ("start", "overview") and now is not None and not tripped(now):
            self.show_page("result")

    def _go_to(self, place: int) -> None:
        if self.isTabVisible(place):
            self.setCurrentIndex(place)

    def _changed(self) -> None:
        self._last_page[self.place] = self.currentIndex()
        self.draw_fast(self._news)
        calls: list[Callable[[], object]] = []
        for plot in self.currentWidget().findChildren(QuietPlot):
            plot.setUpdatesEnabled(False)
            calls.append(partial(plot.setUpdatesEnabled, True))
        calls += [partial(self._draw_history, panel) for panel in self._seen(Takes.HISTORY)]
        self._turns.then(calls)


def _scrolling(page: QWidget, tab: Tab) -> QScrollArea:
    """Return a page that scrolls on a screen too small for it; state and buttons stay in sight."""
    area = named(QScrollArea(), f"page_{tab.name}", tab.title)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it scrolls to what has the focus
    area.setWidget(page)
    return area
