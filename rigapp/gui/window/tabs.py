"""The tabs of the window as one table; a page is made when it is first needed.

Each panel draws only while it is visible.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QSettings, Qt, Signal
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QScrollArea, QSplitter, QTabWidget, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.preferences import Preferences
from rigapp.gui.panel import Act, Host, Panel, StallCounter, Themed, ThemedInParts
from rigapp.gui.panels.alarms import alarm_page
from rigapp.gui.panels.cycle import cycle_page
from rigapp.gui.panels.devices import device_page
from rigapp.gui.panels.faults import fault_page
from rigapp.gui.panels.logbook import log_page
from rigapp.gui.panels.own import OwnPage, own_page
from rigapp.gui.panels.queue import queue_page
from rigapp.gui.panels.resultpage import has_result, result_page
from rigapp.gui.panels.results import results_page
from rigapp.gui.panels.start import may_begin, new_rig_page, start_page
from rigapp.gui.panels.studies import StudiesPanel, studies_page
from rigapp.gui.panels.trends import overview_page, trend_page, wear_page
from rigapp.gui.panels.trip import trip_page
from rigapp.gui.plots.plotmenu import offer_menus
from rigapp.gui.plots.plotting import QuietPlot
from rigapp.gui.results.results_index import ResultsIndex
from rigapp.gui.settings.page import SettingsPage, settings_page
from rigapp.gui.testfile.prepare import PreparePanel, prepare_page
from rigapp.gui.widgets.build import follow_in_tab_order, key_text, named
from rigapp.gui.widgets.chunkedtask import ChunkedTask
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
    """One tab: name, title, key, place, function that makes its page, and condition for showing it.

    Which news a page takes is stated by its panels (``Panel.takes``).
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
    """All pages; ``panels`` are the panels on them, by name.

    A page is made when it or a panel of it is needed, and the rest when the window is on the screen
    (``make_all``): the window then appears in less than half the time.

    Signals: ``made`` a page, ``wanted`` a request to the engine, ``reported`` a sentence,
    ``requested`` an action of the window, ``help_wanted`` a section of docs/troubleshooting.md.
    """

    made = Signal(QWidget)
    wanted = Signal(str, dict)
    reported = Signal(str, bool)
    requested = Signal(Act)
    help_wanted = Signal(str)

    def __init__(
        self,
        test: ShownTest,
        theme: Theme,
        results: ResultsIndex,
        worker: TaskWorker,
        wear: WearReader,
        stalls: StallCounter,
        preferences: Preferences,
        rig: Path | None = None,
    ) -> None:
        super().__init__()
        self._test = test
        self._turns, self._rest = ChunkedTask(self), ChunkedTask(self)
        self._news, self._theme = News(), theme
        self._layout: QSettings | None = None
        self._host = host = Host(
            theme,
            results,
            worker,
            stalls,
            self.wanted.emit,
            self.reported.emit,
            test.ask_revolution,
            self.requested.emit,
            self.help_wanted.emit,
            preferences,
            wear,
            rig,
            window_keys(),
        )
        self.panels = host.panels
        self.panels.make = self._make_for
        self._unmade = dict(enumerate(TABS))
        self._last_page = {tab.place: number for number, tab in reversed(list(enumerate(TABS)))}
        named(self, "tabs", "Panels")
        self.tabBar().hide()
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setDocumentMode(True)
        for number, tab in enumerate(TABS):
            self.addTab(_scrolling(tab), f"{tab.key[-1]} {tr(tab.title)}")
            self.setTabToolTip(number, f"{tr(tab.title)} ({key_text(tab.key)})")
        self._offer_tabs()
        self.currentChanged.connect(self._changed)

    def showEvent(self, event: QShowEvent) -> None:
        """Make the first visible page."""
        self._make(self.currentIndex())
        super().showEvent(event)

    def make_all(self, *, at_once: bool = False) -> None:
        """Make the remaining pages, each in a separate turn of the event loop."""
        calls = [partial(self._make, number) for number in self._unmade]
        if at_once:
            for call in calls:
                call()
        else:
            self._rest.then(calls)

    def _make_for(self, name: str) -> None:
        """Make pages until one of them has a panel of that name."""
        likely = NUMBERS.get(name)
        for number in [*([] if likely is None else [likely]), *self._unmade]:
            if name in self.panels:
                return
            self._make(number)

    def _make(self, number: int) -> None:
        tab = self._unmade.pop(number, None)
        if tab is None:
            return
        before = set(self.panels)
        page = tab.make(self._host)
        page.setAutoFillBackground(True)
        area, chain = self._area(number), _tab_chain(page)
        area.setWidget(page)
        # Else Tab visits a later page after all others. Qt inserts nothing after a widget without
        # focus policy, so the area gets one temporarily.
        area.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        follow_in_tab_order(area, *chain)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        offer_menus(page, self.reported.emit)
        panels = [panel for name, panel in self.panels.items() if name not in before]
        for part in self._parts(number):
            dress_part(part, self._theme)
        for panel in panels:
            if isinstance(panel, Themed):
                panel.dress(self._theme)
        self._restore(area)
        if tab.name == "own":
            self.own.save_view = self.prepare.recipe.save_view
            self.take_selected()
        for panel in panels:
            if Takes.STATUS in panel.takes and self._news.status is not None:
                panel.show_news(self._news)
        self.made.emit(area)

    def close_pages(self) -> None:
        """End the processes of pages: live page, study."""
        if "settings" in self.panels:
            self.settings.live.close_page()
        if "studies" in self.panels:
            self.studies.run.close_run()

    @property
    def splitters(self) -> list[QSplitter]:
        """Return the splitters with stored positions on the pages made so far."""
        return [splitter for splitter in self.findChildren(QSplitter) if splitter.objectName()]

    def restore_layout(self, settings: QSettings) -> None:
        """Restore the splitters of pages; those of later pages when they are made."""
        self._layout = settings
        self._restore(self)

    def _restore(self, part: QWidget) -> None:
        if self._layout is None:
            return
        for splitter in part.findChildren(QSplitter):
            state = self._layout.value(f"splitter/{splitter.objectName()}")
            if splitter.objectName() and state is not None:
                splitter.restoreState(state)

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
        """Return the page arranged by the operator."""
        panel = self.panels["own"]
        assert isinstance(panel, OwnPage)
        return panel

    def take_selected(self) -> None:
        """Show the operator's page of the open test file, unless the shown test has one."""
        if "own" not in self.panels:
            return
        selected = self.prepare.recipe.selected
        if selected is not None and selected.test is not None and self._news.recipe is None:
            self.own.take_view(selected.test.view)

    @property
    def settings(self) -> SettingsPage:
        """Return the page of settings."""
        panel = self.panels["settings"]
        assert isinstance(panel, SettingsPage)
        return panel

    @property
    def place(self) -> RailPlace:
        """Return the shown place."""
        return TABS[self.currentIndex()].place

    def pages(self) -> list[PageName]:
        """Return the pages of the shown place."""
        return [
            PageName(number, tab.title, tab.key)
            for number, tab in enumerate(TABS)
            if tab.place is self.place and self.isTabVisible(number)
        ]

    def places(self) -> set[RailPlace]:
        """Return the places that have pages now."""
        return {tab.place for number, tab in enumerate(TABS) if self.isTabVisible(number)}

    def show_place(self, place: RailPlace) -> None:
        """Open the last visited page of a place, initially its first page."""
        self._go_to(self._last_page[place])

    def show_page(self, name: str) -> None:
        """Open a page by its name."""
        self._go_to(NUMBERS[name])

    def dress_calls(self, theme: Theme) -> list[Callable[[], object]]:
        """Return calls that theme the pages part by part, visible ones first."""
        self._theme = theme
        parts = [part for number in range(self.count()) for part in self._parts(number)]
        dressed = [panel for panel in self.panels.values() if isinstance(panel, Themed)]
        calls = [(part.isVisible(), partial(dress_part, part, theme)) for part in parts]
        calls += [(panel.isVisible(), partial(panel.dress, theme)) for panel in dressed]
        return [call for _, call in sorted(calls, key=lambda pair: not pair[0])]

    def _parts(self, number: int) -> list[QWidget]:
        area = self._area(number)
        inside = area.widget()
        if not isinstance(inside, ThemedInParts):
            return [area]
        return [*inside.parts(), area.verticalScrollBar(), area.horizontalScrollBar()]

    def _area(self, number: int) -> QScrollArea:
        area = self.widget(number)
        assert isinstance(area, QScrollArea)
        return area

    def take(self, news: News) -> None:
        """Update visible and hidden panels to a new status."""
        before, self._news = self._news, news
        for panel in list(self.panels.values()):
            if Takes.STATUS in panel.takes:
                panel.show_news(news)
        self._lead(before, news)

    def draw_fast(self, news: News) -> None:
        """Draw the newest revolution where it is visible."""
        self._news = news
        for panel in self._seen(Takes.REVOLUTION):
            panel.show_news(news)

    def draw_slow(self, news: News, part: int = 0, parts: int = 1) -> None:
        """Draw one of ``parts`` parts of the visible trends, tables and lists."""
        self._news = news
        if part == 0 and any(self._seen(Takes.LOG)):
            self._test.follow_log()
        for panel in list(self.panels.values())[part::parts]:
            self._draw_history(panel)

    def _draw_history(self, panel: Panel) -> None:
        if Takes.HISTORY in panel.takes and panel.isVisible():
            panel.show_news(self._news)

    def _seen(self, what: Takes) -> Iterable[Panel]:
        panels = list(self.panels.values())
        return (panel for panel in panels if what in panel.takes and panel.isVisible())

    def _offer_tabs(self) -> None:
        for number, tab in enumerate(TABS):
            if self.isTabVisible(number) != tab.shown(self._news):
                self.setTabVisible(number, tab.shown(self._news))

    def _lead(self, before: News, news: News) -> None:
        """Switch from a page that is no longer needed to that of the next step."""
        was, now = before.status, news.status
        page = TABS[self.currentIndex()].name
        if page in ("start", "result") and not TABS[self.currentIndex()].shown(news):
            self.show_page("overview")
        self._offer_tabs()
        over = has_result(news) and (was is None or was.engine.state in ACTIVE)
        if over and page in ("start", "overview") and now is not None and not tripped(now):
            self.show_page("result")

    def _go_to(self, number: int) -> None:
        if self.isTabVisible(number):
            self.setCurrentIndex(number)

    def _changed(self) -> None:
        self._make(self.currentIndex())
        self._last_page[self.place] = self.currentIndex()
        self.draw_fast(self._news)
        calls: list[Callable[[], object]] = []
        for plot in self.currentWidget().findChildren(QuietPlot):
            plot.setUpdatesEnabled(False)
            calls.append(partial(plot.setUpdatesEnabled, True))
        calls += [partial(self._draw_history, panel) for panel in self._seen(Takes.HISTORY)]
        self._turns.then(calls)


def _tab_chain(page: QWidget) -> list[QWidget]:
    """Return the widgets of a separate page in tab order."""
    chain: list[QWidget] = []
    widget = page.nextInFocusChain()
    while widget is not None and widget is not page:
        if widget.focusPolicy() & Qt.FocusPolicy.TabFocus:
            chain.append(widget)
        widget = widget.nextInFocusChain()
    return chain


def _scrolling(tab: Tab) -> QScrollArea:
    """Return the scroll area of a page; state bar and buttons do not scroll."""
    area = named(QScrollArea(), f"page_{tab.name}", tab.title)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it scrolls to the focused widget
    return area
