"""The start page with four actions and the last tests; and the page that sets up a new rig.

For a new rig the functions of ``rigapp init --real`` search the ports and write the files.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QHideEvent, QKeySequence, QShortcut, QShowEvent
from PySide6.QtWidgets import QComboBox, QFileDialog, QFrame, QLabel, QPushButton, QWidget

from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.panel import Act, Host
from rigapp.gui.panels.results import ResultsPump
from rigapp.gui.results.documents import launch_process
from rigapp.gui.results.resulttable import ROW_HEIGHT, ResultTable
from rigapp.gui.widgets.build import (
    button,
    choice,
    choose_paths,
    column,
    edit,
    key_text,
    named,
    prose,
    row,
    set_property,
    styled_label,
)
from rigapp.gui.widgets.labels import heading
from rigapp.gui.widgets.reflow import WrappingGrid
from rigapp.gui.widgets.tables import PlainTable
from rigapp.prepare.folders import StartingFile, write_files
from rigapp.prepare.real_rig import (
    ABOUT_REAL,
    ROLES,
    Box,
    FoundPort,
    drivers_of,
    real_files,
    search_ports,
)
from rigapp.presentation.numbers import grouped
from rigapp.presentation.states import occupied_text
from rigapp.presentation.tokens import GAP, MARGIN, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.details import error_text
from rigapp.schema.states import ACTIVE
from rigapp.texts import capitalised
from rigapp.viewer.news import News, Takes

LAST = 20
"""Number of listed tests; Results has all of them."""
TRY_KEY: Final = "F11"
WAYS: Final[dict[Act, tuple[Icon, Text, Text, Text, str]]] = {
    Act.TRY: (
        Icon.TRY,
        "Try the simulated rig",
        "A short test on the simulated rig.",
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
    Act.RESULTS: (Icon.RESULTS, "Open results", "View, compare, report.", "Open", "Ctrl+8"),
}
"""The actions in order: icon, title, description, text of the button, and its key.

The keys are those of the whole window: a digit alone would be typed into the focused field.
"""
SIGN = QSize(24, 24)
WAY_WIDTH = 22 * STEP
"""Minimum width of an action."""


def may_begin(news: News) -> bool:
    """Return whether the window shows neither a replay nor an active test."""
    status = news.status
    return not news.is_replay and (status is None or status.engine.state not in ACTIVE)


class WayCard(QFrame):
    """One action: icon, title, description, and its button."""

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
        """Apply a theme."""
        self.sign.setPixmap(icon(self._meaning, theme.highlight).pixmap(SIGN))


class StartPage(QWidget):
    """The four actions, the rig, and the last tests."""

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
        self._pump = ResultsPump(host.results, self._changed, self)
        below = row(heading("last_title", "Last tests"), None, self.all)
        cards = WrappingGrid(WAY_WIDTH, len(WAYS))
        for card in self.ways.values():
            cards.addWidget(card)
        rig = row((self.rig, 1), self.new_rig)
        column(self.title, rig, cards, below, (self.table, 1), on=self, spacing=STEP)
        self.dress(host.theme)

    def showEvent(self, event: QShowEvent) -> None:
        """Read the last tests."""
        super().showEvent(event)
        self._pump.start()
        self._host.results.look()

    def hideEvent(self, event: QHideEvent) -> None:
        """Stop while the page is hidden."""
        super().hideEvent(event)
        self._pump.stop()

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self.table.dress(theme)
        for card in self.ways.values():
            card.dress(theme)

    def show_news(self, news: News) -> None:
        """Show the name of the rig."""
        status = news.status
        free = status is None or status.engine.calibration is None
        self.ways[Act.TRY].button.setEnabled(free)
        if status is not None and not free:
            self.rig.setText(occupied_text(status))
        elif status is None:
            self.rig.setText(
                tr("Searching for the engine of the rig. Results can be opened meanwhile.")
            )
        elif status.rig.simulated:
            self.rig.setText(tr("{} is simulated: no real spindle turns.", status.rig.name))
        else:
            self.rig.setText(
                tr("{} is a real rig. The simulated one opens beside it.", status.rig.name)
            )

    def _changed(self) -> None:
        self.table.refresh()
        number = len(self._host.results.paths)
        self.all.setText(tr("All {} results", grouped(number)) if number else tr("No results yet"))


def start_page(host: Host) -> QWidget:
    """Make the start page."""
    return host.add("start", StartPage(host))


NEW_FOLDER: Final = "my-rig"
CARD_WIDTH = 42 * STEP
LEAST_CHARACTERS = 18
"""Minimum number of visible characters of a device and a port; their names are longer."""
FILES_HEIGHT = 34 * STEP
"""Height of all rows, so that the table does not scroll within the scrolling page."""
OPEN_PORT: Final[Text] = (
    "May stay empty until the port is known; the check of the rig lists the ports."
)


class BoxCard(QFrame):
    """One device of the new rig: type, port, and the device that answers there."""

    def __init__(self, role: str) -> None:
        super().__init__()
        name, words = f"new_{role}", capitalised(translate(ROLES[role].words))
        named(self, name, words, role="card")
        self._role, self._ports = role, dict[str, FoundPort]()
        self.drivers = drivers_of(role)
        titles = [(info.title, driver) for driver, info in self.drivers.items()]
        self.device = choice(f"{name}_device", tr("{}: device", words), titles, self._show_who)
        self.port = choice(f"{name}_port", tr("{}: port", words), ())
        for field in (self.device, self.port):
            field.setSizeAdjustPolicy(
                QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
            )
            field.setMinimumContentsLength(LEAST_CHARACTERS)
        hint: Text = "/dev/serial/by-id/..., can0"
        typed = edit(f"{name}_port_text", tr("{}: port", words), hint=hint)
        self.port.setLineEdit(typed)
        self.port.currentTextChanged.connect(self._show_who)
        self.who = prose(f"{name}_who", tr("{}: who answers", words), role="caption")
        column(
            styled_label(words, "title"),
            row("Device", (self.device, 1)),
            row("Port", (self.port, 1)),
            self.who,
            on=self,
            margins=(MARGIN, GAP),
            spacing=STEP,
        )
        self._show_who()

    @property
    def box(self) -> Box:
        """Return the selected device."""
        driver = self.drivers[self.device.currentData()]
        return Box(self._role, driver, self.port.currentText().strip())

    def show_ports(self, ports: Sequence[FoundPort]) -> None:
        """List ports; select the first on which a device of this kind answers."""
        typed = self.port.currentText()
        self._ports = {port.name: port for port in ports}
        self.port.clear()
        self.port.addItems(list(self._ports))
        answering = [port for port in ports if port.driver in self.drivers]
        chosen = typed or next((port.name for port in answering), "")
        self.port.setEditText(chosen)
        if chosen in self._ports and self._ports[chosen].driver in self.drivers:
            self.device.setCurrentIndex(self.device.findData(self._ports[chosen].driver))
        self._show_who()

    def _show_who(self, *_: object) -> None:
        port, driver = self.port.currentText().strip(), self.device.currentData()
        known = self._ports.get(port)
        another = known is not None and known.driver not in ("", driver)
        text = tr(OPEN_PORT) if not port else translate(known.words) if known is not None else ""
        set_property(self.who, "role", "error" if another else "caption")
        self.who.setText(f"✗ {tr('Another device answers there: {}', text)}" if another else text)


class NewRigPage(QWidget):
    """Choose the devices and the folder, write the files, and open the rig."""

    takes = Takes.STATUS

    def __init__(self, host: Host) -> None:
        super().__init__()
        self._host = host
        self._rig: Path | None = None
        self._searching = self._in_test = False
        named(self, "new_rig_page", "New rig")
        about = prose(
            "new_rig_about",
            "What a new rig is",
            (
                "Writes rig file, test file and calibration settings for real devices, with the"
                " meaning of each key. Nothing is overwritten, and the rig of this window is not"
                " changed."
            ),
            role="secondary",
        )
        self.cards = {role: BoxCard(role) for role in ROLES}
        grid = WrappingGrid(CARD_WIDTH)
        for card in self.cards.values():
            grid.addWidget(card)
        self.search = button(
            "new_rig_search",
            "S&earch the ports",
            self._search,
            tip=("Identifies each USB device. A port behind a USB adapter is listed, not queried."),
        )
        self.searched = prose("new_rig_searched", "Result of the search", role="secondary")
        self.folder = edit("new_rig_folder", "Folder of the new rig", self._enable)
        choose = button("new_rig_choose", "C&hoose…", self._choose, "Choose the folder")
        self.make = button("new_rig_make", "&Make the files", self._make, rank="primary")
        self.outcome = prose("new_rig_told", "Result")
        self.files = PlainTable(
            "new_rig_files", "Files of the new rig", ("File", "What it is"), stretch=(1,)
        )
        self.files.setMinimumHeight(FILES_HEIGHT)
        self.files.hide()
        self.open = button("new_rig_open", "&Open this rig", self._open)
        self.open.hide()
        column(
            about,
            grid,
            row(self.search, (self.searched, 1)),
            row("Folder", (self.folder, 1), choose, self.make),
            row((self.outcome, 1), self.open),
            (self.files, 1),
            None,
            on=self,
            spacing=GAP,
        )
        self.folder.setText(str(Path.cwd() / NEW_FOLDER))

    def show_news(self, news: News) -> None:
        """Disable the search of ports while a test runs."""
        status = news.status
        self._in_test = status is not None and status.engine.state in ACTIVE
        self._enable()

    def _enable(self, *_: object) -> None:
        self.search.setEnabled(not self._searching and not self._in_test)
        self.make.setEnabled(bool(self.folder.text().strip()))

    def _search(self) -> None:
        self._searching = self._host.worker.submit(search_ports, self._list_ports, self._failed)
        self.searched.setText(tr("Searching …"))
        self._enable()

    def _list_ports(self, ports: list[FoundPort]) -> None:
        self._searching = False
        answering = sum(bool(port.driver) for port in ports)
        self.searched.setText(
            tr("Ports found: {}; known devices answer on {}.", len(ports), answering)
        )
        for card in self.cards.values():
            card.show_ports(ports)
        self._enable()

    def _failed(self, error: Exception) -> None:
        self._searching = False
        self.searched.setText(translate(error_text(error, "The ports could not be searched.")))
        self._enable()

    def _choose(self) -> None:
        mode = QFileDialog.FileMode.Directory
        choose_paths(self, "Choose the folder", self._take_folder, mode)

    def _take_folder(self, paths: Sequence[str]) -> None:
        self.folder.setText(paths[0])

    def _make(self) -> None:
        folder = Path(self.folder.text().strip()).expanduser().absolute()
        boxes = [card.box for card in self.cards.values()]
        self.make.setEnabled(False)
        self._host.worker.submit(
            partial(_written, folder, boxes), partial(self._made, folder), self._not_made
        )

    def _made(self, folder: Path, files: list[StartingFile]) -> None:
        self._rig = folder / "rig.toml"
        set_property(self.outcome, "role", "")
        self.outcome.setText(tr("The files are in {}. Open the rig, then check it.", folder))
        self.files.show_rows(
            [(str(file.path), translate(ABOUT_REAL[str(file.path)])) for file in files]
        )
        self.files.show()
        self.open.show()
        self._enable()

    def _not_made(self, error: Exception) -> None:
        set_property(self.outcome, "role", "error")
        self.outcome.setText(f"✗ {translate(error_text(error, 'The files could not be written.'))}")
        self.files.hide()
        self.open.hide()
        self._enable()

    def _open(self) -> None:
        if self._rig is not None:
            launch_process(["gui", "--rig", str(self._rig)], self._rig.parent)
            self._host.say(tr("A window with {} is being opened.", self._rig), True)


def _written(folder: Path, boxes: Sequence[Box]) -> list[StartingFile]:
    files = real_files(boxes)
    write_files(folder, files)
    return files


def new_rig_page(host: Host) -> QWidget:
    """Make the page of a new rig."""
    return host.add("new_rig", NewRigPage(host))
