"""The operator's window: state bar, controls, tabs; one timer polls, nothing is pushed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QSettings
from PySide6.QtGui import (
    QCloseEvent,
    QGuiApplication,
    QKeySequence,
    QResizeEvent,
    QShortcut,
)
from PySide6.QtWidgets import (
    QApplication,
    QMainWindow,
    QPushButton,
    QWidget,
)

from rigapp.gui.look.dress import apply_theme, dress_part
from rigapp.gui.look.preferences import Preference, Preferences
from rigapp.gui.panel import Act
from rigapp.gui.panels.alarms import AlarmPanel
from rigapp.gui.results.documents import launch_process
from rigapp.gui.results.results_index import ResultsIndex
from rigapp.gui.widgets.build import GuardedButton, button, column, follow_in_tab_order, named, row
from rigapp.gui.widgets.chunkedtask import ChunkedTask
from rigapp.gui.window.bars import ReplayBar, ReplayFrame, StartBar
from rigapp.gui.window.calibrating import CalibrationGuide
from rigapp.gui.window.command import KEY as COMMAND_KEY
from rigapp.gui.window.command import ViewerBar, why_forbidden
from rigapp.gui.window.controls import STARTABLE, ControlRow
from rigapp.gui.window.header import Header, MessageLine
from rigapp.gui.window.headline import headline, measured, rig_words
from rigapp.gui.window.help import HelpWindow
from rigapp.gui.window.notice import CloseBar, NoticeBar
from rigapp.gui.window.pagestack import PageStack
from rigapp.gui.window.places import PageBar, Rail, RailPlace
from rigapp.gui.window.recover import KEY as RECOVER_KEY
from rigapp.gui.window.recover import RecoverPanel
from rigapp.gui.window.rhythm import FAST_EVERY, IDLE, IN_TEST, SLOW_EVERY, STATE_EVERY, Pulse
from rigapp.gui.window.room import BESIDE, PageRoom
from rigapp.gui.window.side import SideColumn
from rigapp.gui.window.tabs import TABS, Tabs
from rigapp.gui.window.watchdog import Watchdog
from rigapp.presentation.states import occupied_text
from rigapp.presentation.tokens import MARGIN, STEP, Theme
from rigapp.presentation.translation import Text, tr
from rigapp.schema.messages import NO_TEST, RunState, Snapshot
from rigapp.schema.states import ACTIVE
from rigapp.viewer.connection import ConnectionState, EngineConnection
from rigapp.viewer.knownwear import WearReader
from rigapp.viewer.news import News
from rigapp.viewer.showntest import ShownTest
from rigapp.viewer.tasks import TaskWorker

ACKNOWLEDGE_KEY = "F7"

PROGRAM = "rigapp"

WINDOW = (1440, 900)
"""Size of the window on a sufficiently large screen."""

LEAST = (640, 360)
"""Minimum size of the window: a screen of 1366 x 768 at 200 %, less the frame."""

FRAME_HEIGHT = 40
"""Height reserved for the window manager's frame."""


class MainWindow(QMainWindow):
    """Show one engine; slow operations run on the workers of connection and test."""

    def __init__(
        self,
        connection: EngineConnection,
        test: ShownTest,
        theme: Theme,
        *,
        rig: Path | None = None,
        tests: Sequence[Path] = (),
        results_folder: Path = Path("results"),
        preferences: Preferences | None = None,
        settings: QSettings | None = None,
        again: Sequence[str] = (),
    ) -> None:
        """Make the window; again: the command that opens a window like it."""
        super().__init__()
        self._connection = connection
        self._test = test
        self._settings, self._again = settings, tuple(again)
        self.preferences = preferences or Preferences(settings)
        self._reader = TaskWorker("gui-files", bound=32)
        # A separate worker, since its computations take seconds and would delay reading files.
        self._identifier = TaskWorker("gui-wear", bound=4)
        self._looks = 0
        self._part = 0
        self._help: HelpWindow | None = None
        self._start_bar: StartBar | None = None
        self._start_wanted: Path | None = None
        self._closing = ""
        self._discard = False
        self._rig_file, self._tests, self._results_folder = rig, tuple(tests), results_folder
        self.theme = theme
        self.watchdog = Watchdog(self)
        named(self, "main_window", "Rig control").setWindowTitle(PROGRAM)
        self.header = Header(theme)
        self.controls = ControlRow(connection.request, theme)
        self.close_bar = CloseBar()
        self.notice = NoticeBar(theme)
        self.recover = RecoverPanel(theme)
        self.viewer_bar = ViewerBar(theme)
        self._forbidden = ""
        self.replay_bar = ReplayBar(theme)
        self.replay_bar.hide()
        self.body = ReplayFrame()
        self._results = ResultsIndex(results_folder, self._reader)
        self.tabs = Tabs(
            test,
            theme,
            self._results,
            self._reader,
            WearReader(self._identifier),
            self.watchdog,
            self.preferences,
            rig,
        )
        self.stage = PageStack(self.tabs)
        self.guide = CalibrationGuide(
            connection,
            self._reader,
            self.stage,
            self.tabs,
            self.notice,
            self.preferences,
            self,
            files=(rig, results_folder),
            theme=lambda: self.theme,
        )
        self.side = SideColumn(theme, self.recover)
        self.tabs.panels["side"] = self.side
        self.rail = Rail(theme, self.show_help)
        bars = (self.viewer_bar, self.close_bar, self.guide.end_bar, self.notice)
        self.messages = MessageLine(bars, self.controls.answer_place, theme)
        self._build()
        self.dressing = ChunkedTask(self)
        for call in self._dress_calls():
            call()
        self._connect()
        self.pulse = Pulse(self._look, self._draw_part, self.watchdog, self)
        self._restore_layout()

    def show_first_page(self) -> None:
        """Open the first page, the only one made before the window is shown."""
        if not self._rig_file:  # a recorded test, whichever page was shown last
            self.tabs.show_page("overview")
        elif self.tabs.place is RailPlace.WATCH and self._start_wanted is None:
            self.tabs.show_page("start")

    @property
    def start_bar(self) -> StartBar:
        """Return the start card, made on first access like the page of its test."""
        if self._start_bar is not None:
            return self._start_bar
        bar = self._start_bar = StartBar(
            self.tabs.prepare.recipe, self._tests, self._results_folder
        )
        bar.setParent(self.body)
        bar.installEventFilter(self)
        bar.started.connect(self.guide.leave)
        bar.started.connect(self.controls.start_test)
        dress_part(bar, self.theme)
        self._forbid_buttons(bar)
        self._show_occupied()
        return bar

    def _show_occupied(self) -> None:
        """Show on the start card that a calibration occupies the rig."""
        status = self._connection.status
        if self._start_bar is not None and status is not None:
            running = status.engine.calibration
            self._start_bar.show_occupied(occupied_text(status) if running is not None else "")

    def _take_page(self, area: QWidget) -> None:
        """Prepare a newly made page: open the test file in the form."""
        self._forbid_buttons(area)
        if area.objectName() != "page_prepare":
            return
        recipe = self.tabs.prepare.recipe
        if self._rig_file is not None:
            self.tabs.prepare.set_rig(self._rig_file)
        if self._tests:
            recipe.open_file(self._tests[0])
        recipe.selection_changed.connect(self._name_selected)
        recipe.selection_changed.connect(self.tabs.take_selected)
        self._name_selected()
        self.tabs.take_selected()

    def start(self) -> None:
        """Start polling; called when the window is on the screen."""
        self.show_first_page()
        self.pulse.start()
        self.tabs.make_all()

    def tick(self) -> None:
        """Poll for news and draw all visible parts."""
        self._look()
        self._draw_part()

    def _look(self) -> None:
        """Poll for news; draw the newest revolution and the state."""
        self._looks += 1
        self._test.deliver()
        self._reader.deliver()
        self._identifier.deliver()
        before = self._connection.state
        snapshot = self._connection.pump()
        self.pulse.listen(self._connection.handle)
        if snapshot is not None:
            self._take(snapshot)
        news = snapshot is not None or before is not self._connection.state
        if snapshot is not None and not self.isMinimized():
            self.tabs.draw_fast(self.news)
        if news or self._test.problem or self._looks % STATE_EVERY == 1:
            self._show_state()

    def _draw_part(self) -> None:
        """Draw one part of the trends and tables."""
        self._part = (self._part + 1) % SLOW_EVERY
        if not self.isMinimized():
            if self._part % FAST_EVERY == 0:
                self.tabs.draw_fast(self.news)
            self.tabs.draw_slow(self.news, self._part, SLOW_EVERY)

    def _show_state(self) -> None:
        status, news = self._connection.status, self.news
        state, reason = self._connection.state, self._connection.reason
        replay = self._connection.is_replay
        now = measured(news)
        self.header.show_headline(headline(status, state, reason, now, replay=replay))
        self.notice.take_connection(state, news.silence_s)
        if self.tabs.place in BESIDE:
            self.side.show_news(news)
        self.room.show_side()
        self.rail.show_rig(*rig_words(news))
        self.messages.show_time()
        if not replay:
            self.controls.show_status(status, self._connection.state)
        self._frame_replay(replay)
        if replay and status is not None:
            self.replay_bar.show_status(status, self._connection.last_recorded)
        self._show_control()
        if self._test.problem:
            self.controls.show_answer(self._test.problem, good=False)
            self._test.problem = ""
        self._close_when_stopped()

    def _frame_replay(self, replay: bool) -> None:
        """Show a frame around a replay, and its bar in place of the commands."""
        if replay is not self.replay_bar.isHidden():
            return
        self.replay_bar.setVisible(replay)
        self.controls.setVisible(not replay)
        self.rail.offer(self.tabs.places())
        self._paint_frame()

    def _paint_frame(self) -> None:
        self.body.paint("" if self.replay_bar.isHidden() else self.theme.highlight)

    @property
    def news(self) -> News:
        """Return the present news."""
        test, connection = self._test, self._connection
        return News(
            connection.status,
            test.data,
            test.recipe,
            test.path,
            test.events,
            test.log_problem,
            connection.silence_s(),
            connection.is_replay,
            connection.data_age_s(),
            self._test.trip,
        )

    @property
    def settled(self) -> bool:
        """Return whether the engine has answered and the history of its test is read."""
        return self._connection.status is not None and self._test.settled

    def draw_now(self) -> None:
        """Draw all visible parts without waiting for the next tick."""
        self.tabs.draw_fast(self.news)
        self.tabs.draw_slow(self.news)

    def start_when_idle(self, test: Path) -> None:
        """Start a test as soon as the engine has answered and runs no other test."""
        self._start_wanted = test

    def switch_theme(self) -> None:
        """Change between light and dark."""
        other = "dark" if self.theme.name == "light" else "light"
        self.preferences.put(Preference.THEME, other)

    def _take_choice(self, preference: Preference) -> None:
        """Apply a changed preference immediately, where that is possible."""
        if preference is Preference.THEME and self.preferences.theme is not self.theme:
            self.dress(self.preferences.theme)
        elif preference is Preference.OPERATOR:
            self._connection.sign_as(self.preferences.get(Preference.OPERATOR))

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.theme = theme
        application = QApplication.instance()
        if isinstance(application, QApplication):
            apply_theme(application, theme)
        self.dressing.instead([*self._dress_calls(), self.draw_now])

    def _dress_calls(self) -> Iterator[Callable[[], object]]:
        """Yield short calls that theme each part, visible ones first."""
        theme = self.theme
        yield self._paint_frame
        bars = (self.header, self.rail, self.messages, self.notice, self.viewer_bar, self.controls)
        for part in (*bars, self.replay_bar):
            yield partial(part.dress, theme)
        bar, help_ = self._start_bar, self._help
        for plain in (self.page_bar, self.room.recover_button, bar, self.side, help_):
            if plain is not None:
                yield partial(dress_part, plain, theme)
        yield from self.stage.dress_calls(theme)
        yield from self.tabs.dress_calls(theme)

    def show_help(self) -> None:
        """Open the help window or raise it."""
        if self._help is None:
            self._help = HelpWindow(self)
            dress_part(self._help, self.theme)
        self._front(self._help)

    def help_with(self, section: str) -> None:
        """Show a section of the troubleshooting guide."""
        self.show_help()
        if self._help is not None:
            self._help.show_section(section)

    def _front(self, dialog: QWidget) -> None:
        dialog.show()
        dialog.raise_()
        dialog.activateWindow()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ask while a test is running; else store the layout and detach."""
        status = self._connection.status
        active = status is not None and status.engine.state in ACTIVE
        attached = (
            self._connection.state is ConnectionState.ATTACHED and not self._connection.is_replay
        )
        if active and attached and self._closing != "now" and self.pulse.look.isActive():
            event.ignore()
            self.close_bar.ask()
            return
        if self._keep_unsaved():
            event.ignore()
            return
        self.pulse.stop()
        self._save_layout()
        self.tabs.close_pages()
        self.guide.close()  # releases the rig through the connection, which is closed next
        self._connection.close()
        self._test.close()
        self._results.close()
        self._reader.close()
        self._identifier.close()
        if self._help is not None:
            self._help.close()
        super().closeEvent(event)

    def _keep_unsaved(self) -> bool:
        """Ask when changes of the test file would be lost; return whether the window stays."""
        if self._discard or not self.pulse.look.isActive() or "prepare" not in self.tabs.panels:
            return False
        recipe = self.tabs.prepare.recipe
        if not recipe.unsaved():
            return False
        self.tabs.show_page("prepare")
        recipe.ask_before("closing the window", self._close_for_good)
        return True

    def close_without_question(self) -> None:
        """Close without a question, at a signal or when the terminal is closed."""
        self._closing = "now"
        self._close_for_good()

    def _close_for_good(self) -> None:
        self._discard = True
        self.close()

    def _take(self, snapshot: Snapshot) -> None:
        status = snapshot.status
        busy = status.engine.state in ACTIVE or self._start_wanted is not None
        self.pulse.keep(IN_TEST if busy else IDLE)
        self.recover.take_status(None if self._connection.is_replay else status)
        self.notice.take_status(status, replay=self._connection.is_replay)
        self.guide.take_status(status)
        self._show_occupied()
        self._test.take(snapshot)
        self.tabs.take(self.news)
        self._show_place()
        if self._start_wanted is not None and status.engine.state in STARTABLE:
            test, self._start_wanted = self._start_wanted, None
            self.controls.show_status(status, self._connection.state)
            self.start_bar.start(test)
        title = f"{(status.test or NO_TEST).title or status.rig.name} – {PROGRAM}"
        if self._forbidden and not self._connection.is_replay:
            title = tr("Viewing only: {}", title)
        if self.windowTitle() != title:
            self.setWindowTitle(title)

    def _next_step(self) -> None:
        """Perform the next step named in the message line; none during a calibration."""
        status = self._connection.status
        if status is not None and status.engine.state is RunState.CALIBRATING:
            self.controls.report_occupied()
        self.recover.press()

    def _show_control(self) -> None:
        watch = self._connection.command
        line = self.controls.command_line
        line.setVisible(not self._connection.is_replay and not self.room.tight)
        line.show_holder(watch.holder, watch.name)
        self.viewer_bar.show_holder(watch.holder, watch.name)
        why = why_forbidden(watch.holder, watch.name)
        if self._connection.is_replay:
            why = tr("This is a replay: no rig is connected")
        if why != self._forbidden:
            self._forbidden = why
            self._forbid_buttons(self)

    def _forbid_buttons(self, part: QWidget) -> None:
        for guarded in part.findChildren(GuardedButton):
            guarded.forbid(self._forbidden)

    def _leave(self) -> None:
        self._closing = "now"
        self.close()

    def _stop_and_close(self) -> None:
        self._closing = "when stopped"
        self.controls.act("stop")

    def _close_when_stopped(self) -> None:
        status = self._connection.status
        if self._closing == "when stopped" and status and status.engine.state not in ACTIVE:
            self._leave()

    def _do(self, act: Act) -> None:
        """Perform the action that a panel requests."""
        if act is Act.TRY:
            self._try_simulated()
        elif act is Act.CALIBRATE:
            self.guide.open()
        elif act is Act.AGAIN:
            self._open_again()
        else:
            self.tabs.show_page(act.value)

    def _try_simulated(self) -> None:
        """Start the first test of the list on a simulated rig; for a real one open a new window."""
        status = self._connection.status
        if status is None:
            self._say("Wait for the engine: which rig it drives is not known yet.", good=False)
        elif status.rig.simulated and self.start_bar.first is not None:
            self.start_bar.start(self.start_bar.first)
        else:
            launch_process(["gui", "--start"])
            self._say("A window with the simulated rig is being opened.")

    def _open_again(self) -> None:
        """Open a window like this one with the present settings, and close this one."""
        if self._keep_unsaved():
            return
        self._save_layout()
        launch_process(self._again)
        self._leave()

    def _say_answer(self, text: str, good: bool) -> None:
        self.controls.show_answer(text, good=good)

    def _say(self, text: Text, *, good: bool = True) -> None:
        self.controls.show_answer(tr(text), good=good)

    def _build(self) -> None:
        self.calibrate_button = button(
            "calibrate_button",
            "Calibrate…  F3",
            self.guide.open,
            "Calibrate",
            guarded=True,
        )
        self.page_bar = PageBar(((RailPlace.RIG, self.calibrate_button),))
        bars = (self.header, self.messages, self.rail, self.controls, self.recover)
        self.room = PageRoom(
            self, self.tabs, self.stage, self.page_bar, self.side, self.recover, bars
        )
        upper = column(
            self.header, self.messages, (self.room.content, 1), self.controls, self.replay_bar
        )
        upper.setSpacing(0)
        layout = row(self.rail, (upper, 1), on=self.body)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        self.setCentralWidget(self.body)
        buttons = self.messages.findChildren(QPushButton)
        follow_in_tab_order(self.rail.help_button, *buttons, self.page_bar.choice)
        self._show_place()
        self.setMinimumSize(*LEAST)
        screen = QGuiApplication.primaryScreen()
        room = screen.availableGeometry() if screen is not None else None
        if room is None or QGuiApplication.platformName() == "offscreen":
            self.resize(*WINDOW)
        else:
            width, height = WINDOW
            self.resize(min(width, room.width()), min(height, room.height() - FRAME_HEIGHT))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the layout, and place the start card above the buttons."""
        super().resizeEvent(event)
        self.room.fit()
        self._place_start_bar()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Place the start card when it appears."""
        if event.type() == QEvent.Type.Show:
            self._place_start_bar()
        return super().eventFilter(watched, event)

    def _place_start_bar(self) -> None:
        if self._start_bar is None or self._start_bar.isHidden():
            return
        left, room = self.rail.width() + MARGIN, self.width() - self.rail.width() - 2 * MARGIN
        height = self.start_bar.heightForWidth(room)
        bottom = self.height() - self.controls.height() - STEP
        self.start_bar.setGeometry(left, bottom - height, room, height)
        self.start_bar.raise_()

    def _show_place(self) -> None:
        self.room.show_side()
        self.controls.suspend_access_keys(self.stage.guiding)
        self.rail.show_place(self.tabs.place)
        now = -1 if self.stage.guiding else self.tabs.currentIndex()
        self.page_bar.show_pages(self.tabs.place, self.tabs.pages(), now)

    def _open_start(self) -> None:
        self.start_bar.open()

    def _name_selected(self) -> None:
        path = self.tabs.prepare.recipe.path
        self.controls.show_selected(path.name if path is not None else "")

    def _connect(self) -> None:
        self.rail.chosen.connect(self.tabs.show_place)
        self.page_bar.chosen.connect(self.tabs.setCurrentIndex)
        turned = (self.rail.chosen, self.page_bar.chosen, self.tabs.currentChanged)
        for chosen in turned:
            chosen.connect(self.guide.leave)
        for chosen in (self.rail.chosen, self.page_bar.chosen):
            chosen.connect(self.room.hide_recover)
        self.controls.start_wanted.connect(self._open_start)
        self.controls.show_selected(self._tests[0].name if self._tests else "")
        self.recover.wanted.connect(self.controls.send)
        self.side.alarms.wanted.connect(self.controls.send)
        self.recover.start_wanted.connect(self._open_start)
        self.controls.answered.connect(self.recover.answered)
        self.controls.refused.connect(lambda refused: self.messages.give_room(refused=refused))
        self.guide.moved.connect(self._show_place)
        self.guide.reported.connect(self._say_answer)
        self.guide.occupied.connect(self.controls.report_occupied)
        self.guide.end_bar.wanted.connect(self.controls.send)
        self.close_bar.leave.connect(self._leave)
        self.close_bar.stop_first.connect(self._stop_and_close)
        self.replay_bar.wanted.connect(self.controls.send)
        self.controls.command_line.wanted.connect(self.controls.send)
        self.controls.command_line.take_over_wanted.connect(self.viewer_bar.ask)
        self.viewer_bar.wanted.connect(self.controls.send)
        self.tabs.wanted.connect(self.controls.send)
        self.tabs.reported.connect(self._say_answer)
        self.tabs.requested.connect(self._do)
        self.tabs.made.connect(self._take_page)
        self.tabs.help_wanted.connect(self.help_with)
        self.preferences.changed.connect(self._take_choice)
        self._connection.sign_as(self.preferences.get(Preference.OPERATOR))
        for key, call in (
            ("F1", self.show_help),
            (COMMAND_KEY, self.controls.command_line.act),
            (RECOVER_KEY, self._next_step),
            ("F9", self.switch_theme),
            ("F3", self.guide.open),
        ):
            QShortcut(QKeySequence(key), self, call)
        for number, tab in enumerate(TABS):
            QShortcut(QKeySequence(tab.key), self, partial(self._choose_page, number))
        # On the bar of commands, which a replay lacks: there F7 plays.
        QShortcut(QKeySequence(ACKNOWLEDGE_KEY), self.controls, self._acknowledge)

    def _choose_page(self, number: int) -> None:
        """Open a page by its key, also from a guide or the recovery."""
        if self.tabs.isTabVisible(number):
            self.page_bar.chosen.emit(number)

    def _acknowledge(self) -> None:
        """Acknowledge the alarm shown in full; open the alarms where none is visible."""
        page = self.tabs.panels["alarms"]
        assert isinstance(page, AlarmPanel)
        for alarms in (self.side.alarms, page):
            if alarms.isVisible():
                alarms.acknowledge.click()
                return
        self.tabs.show_page("limits")

    def _restore_layout(self) -> None:
        if self._settings is None:
            return
        geometry = self._settings.value("geometry")
        if geometry is not None:
            self.restoreGeometry(geometry)
        self.tabs.restore_layout(self._settings)
        number = int(str(self._settings.value("tab", 0)))
        if self.tabs.isTabVisible(number):
            self.tabs.setCurrentIndex(number)

    def _save_layout(self) -> None:
        if self._settings is None:
            return
        self._settings.setValue("geometry", self.saveGeometry())
        for splitter in self.tabs.splitters:
            self._settings.setValue(f"splitter/{splitter.objectName()}", splitter.saveState())
        self._settings.setValue("tab", self.tabs.currentIndex())
