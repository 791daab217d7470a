"""Page of settings: appearance, operator, folder, messages, live page, training, keys."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Any, Final

from PySide6.QtCore import QProcess, QSignalBlocker, QUrl
from PySide6.QtGui import QDesktopServices, QShowEvent
from PySide6.QtWidgets import QCheckBox, QComboBox, QFileDialog, QFrame, QLineEdit, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.names import login_name
from rigapp.gui.look.preferences import AS_SYSTEM, OFF, Preference, Preferences
from rigapp.gui.panel import Act, Host
from rigapp.gui.settings.messages import MessageCard
from rigapp.gui.widgets.build import (
    button,
    choice,
    choose_paths,
    column,
    edit,
    named,
    page,
    prose,
    row,
)
from rigapp.gui.widgets.labels import ElidedLabel, heading
from rigapp.gui.widgets.reflow import WrappingGrid, flowing
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.catalogue import LANGUAGES
from rigapp.presentation.tokens import GAP, MARGIN, STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.process.children import module_command
from rigapp.schema.details import error_text
from rigapp.service.pins import operators_file, pins_in, set_pin
from rigapp.viewer.news import News, Takes

ADDRESS: Final = "127.0.0.1:8750"
"""Local address; others need token, certificate and key, by ``rigapp page``."""
NOT_SERVED: Final[Text] = "Shows this rig in browsers of this computer, while the window is open."
END_MS = 3000


class LivePageCard(QWidget):
    """Serve the live page in a child process of this window, and open it in a browser."""

    def __init__(self, choices: Preferences, rig: Path | None) -> None:
        super().__init__()
        self._choices, self._rig, self._url = choices, rig, ""
        named(self, "live_page", "Live page")
        self.address = edit("page_address", "Address and port of the page", hint=ADDRESS)
        self.address.setText(choices.get(Preference.PAGE))
        self.serve = button("page_serve", "Serve", self._serve, "Serve the page")
        self.end = button("page_end", "End", self.close_page, "Stop serving the page")
        self.open = button("page_open", "Open", self._open, "Open the page in a browser")
        self.state = prose("page_told", "State of the page", NOT_SERVED, role="caption")
        fields = flowing("Address", (self.address, 1), self.serve, self.end, self.open)
        column(fields, self.state, on=self, spacing=STEP)
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.finished.connect(self._ended)
        self._show()

    def close_page(self) -> None:
        """End the page and wait briefly for its process."""
        if self._process.state() is not QProcess.ProcessState.NotRunning:
            self._process.terminate()
            if not self._process.waitForFinished(END_MS):
                self._process.kill()
                self._process.waitForFinished(END_MS)

    def _serve(self) -> None:
        address = self.address.text().strip()
        self._choices.put(Preference.PAGE, address)
        rigs = ["--rig", self._rig] if self._rig is not None else []
        program, *arguments = module_command("rigapp", "page", "--bind", address or ADDRESS, *rigs)
        self._url = ""
        self.state.setText(tr("Starting the page …"))
        self._process.start(program, arguments)
        self._show()

    def _read(self) -> None:
        text = bytes(self._process.readAllStandardOutput().data()).decode(errors="replace")
        for word in text.split():
            if "://" in word:
                self._url = word
                self.state.setText(tr("The page is at {}", word))
        self._show()

    def _ended(self) -> None:
        errors = bytes(self._process.readAllStandardError().data()).decode(errors="replace").strip()
        lines = errors.splitlines()
        self._url = ""
        self.state.setText(lines[0].removeprefix("rigapp: ") if lines else tr(NOT_SERVED))
        self._show()

    def _show(self) -> None:
        runs = self._process.state() is not QProcess.ProcessState.NotRunning
        self.serve.setEnabled(not runs)
        self.end.setEnabled(runs)
        self.open.setEnabled(bool(self._url))

    def _open(self) -> None:
        QDesktopServices.openUrl(QUrl(self._url))


NO_PINS: Final[Text] = (
    "This rig needs no PIN for limits. To require one, add [operators] with a file to the rig file."
)
FIRST: Final[Text] = "Nobody has a PIN yet, so limits of a running test cannot be changed."
PIN_HOLDERS: Final[Text] = "Have a PIN and may change limits: {}."


class PinPart(QWidget):
    """List the operators with a PIN, and set that of the operator named in the settings."""

    def __init__(self, rig: Path | None, choices: Preferences) -> None:
        super().__init__()
        self._rig, self._choices = rig, choices
        self._file: Path | None = None
        named(self, "pins", "PINs for limits")
        self.holders = prose("pins_told", "Who has a PIN", role="caption")
        self.pin = edit("pin_new", "New PIN of the operator", self._enable, hint="New PIN")
        self.by_pin = edit("pin_present", "PIN of an operator who has one", hint="A present PIN")
        for field in (self.pin, self.by_pin):
            field.setEchoMode(QLineEdit.EchoMode.Password)
        self.set = button("pin_set", "Set PIN", self._set, "Set the PIN of the operator")
        self._fields = QWidget()
        flowing((self.pin, 1), (self.by_pin, 1), self.set, on=self._fields)
        column(self.holders, self._fields, on=self, spacing=STEP)
        self._enable()

    def showEvent(self, event: QShowEvent) -> None:
        """Read the operators with a PIN again."""
        super().showEvent(event)
        self.look()

    def look(self) -> None:
        """Read the file of operators, where the rig file names one."""
        try:
            self._file = operators_file(read_rig(self._rig)) if self._rig is not None else None
            names = list(pins_in(self._file)) if self._file is not None else []
        except UnusableInput as error:
            self._fields.hide()
            self.holders.setText(translate(error_text(error, "The operators cannot be read.")))
            return
        self._fields.setVisible(self._file is not None)
        self.by_pin.setVisible(bool(names))
        if self._file is None:
            self.holders.setText(tr(NO_PINS))
        else:
            self.holders.setText(tr(PIN_HOLDERS, ", ".join(names)) if names else tr(FIRST))

    def _enable(self) -> None:
        self.set.setEnabled(bool(self.pin.text()))

    def _set(self) -> None:
        name = self._choices.get(Preference.OPERATOR) or login_name()
        assert self._file is not None
        try:
            set_pin(self._file, name, self.pin.text(), self.by_pin.text())
        except UnusableInput as error:
            self.holders.setText(translate(error_text(error, "The PIN cannot be set.")))
            return
        finally:
            self.by_pin.clear()
        self.pin.clear()
        self.look()


CARD_WIDTH = 56 * STEP
THEME_NAMES: Final[tuple[tuple[Text, str], ...]] = (
    ("Light", "light"),
    ("Dark", "dark"),
    ("As the desktop", AS_SYSTEM),
)
NAME_CHARACTERS = 60
LATER: Final[Text] = "Language and folder take effect when the window is opened again."
TRAINING: Final[Text] = (
    "A simulated operator does the steps of a calibration, without waiting times."
    " Simulated rig only."
)


def settings_card(name: str, title: Text, *items: Any) -> QFrame:
    """Return a card with a title and items below each other."""
    card = named(QFrame(), f"{name}_card", title, role="card")
    head = heading(f"{name}_title", title)
    column(head, *items, None, on=card, margins=(MARGIN, GAP), spacing=STEP)
    return card


def show_choice(box: QComboBox, value: str) -> None:
    """Select the item of a value without emitting signals."""
    with QSignalBlocker(box):
        box.setCurrentIndex(max(box.findData(value), 0))


class SettingsPage(QWidget):
    """Show each setting, and store changes immediately."""

    takes = Takes(0)

    def __init__(self, host: Host) -> None:
        super().__init__()
        self._host = host
        self._choices = host.preferences
        self._begun = {key: self._choices.get(key) for key in Preference}
        named(self, "settings_page", "Settings")
        self.messages = MessageCard(host.worker, host.rig, host.say)
        self.live = LivePageCard(self._choices, host.rig)
        self.later = prose("settings_later", "What takes effect later", LATER, role="caution")
        again: Text = "Open the window a&gain"
        self.again = button("settings_again", again, partial(host.do, Act.AGAIN))
        left = (
            settings_card("look", "View", self._look()),
            settings_card("operator", "Operator", *self._operator()),
            settings_card("folder", "Results folder", *self._folder()),
            settings_card("training", "Training", *self._training()),
            settings_card("live_page", "Live page", self.live),
        )
        right = (
            settings_card("messages", "Messages", self.messages),
            settings_card("keys", "Keys", self._keys(host.keys)),
        )
        columns = WrappingGrid(CARD_WIDTH)
        for cards in (left, right):
            columns.addWidget(page(column(*cards, None, spacing=GAP)))
        later = row((self.later, 1), self.again, spacing=GAP)
        column(later, columns, None, on=self, spacing=GAP)
        self._choices.changed.connect(self._show)
        self._show()

    def show_news(self, news: News) -> None:
        """Ignore the news: settings belong to the user, not to the test."""

    def _look(self) -> Any:
        put = self._choices.put
        self.theme = choice("theme_choice", "Theme", THEME_NAMES)
        self.theme.activated.connect(lambda: put(Preference.THEME, self.theme.currentData()))
        languages = [("As the desktop", ""), *((name, code) for code, name in LANGUAGES.items())]
        self.language = choice("language_choice", "Language", languages)
        self.language.activated.connect(
            lambda: put(Preference.LANGUAGE, self.language.currentData())
        )
        return flowing("Th&eme (F9)", self.theme, "&Language", self.language)

    def _operator(self) -> Any:
        self.operator = edit(
            "operator_name", "Name of the operator", hint=login_name(), most=NAME_CHARACTERS
        )
        self.operator.editingFinished.connect(
            lambda: self._choices.put(Preference.OPERATOR, self.operator.text().strip())
        )
        why: Text = "Name in the log for all actions from this window. Empty: the login name."
        yield flowing("N&ame", (self.operator, 1))
        yield prose("operator_why", "Purpose of the name", why, role="caption")
        yield PinPart(self._host.rig, self._choices)

    def _folder(self) -> Iterable[Any]:
        self.folder = ElidedLabel("results_folder", "Folder of the results")
        browse = button(
            "folder_browse", "C&hoose…", self._choose, "Choose the folder of the results"
        )
        default = button(
            "folder_default",
            "As starte&d",
            partial(self._choices.put, Preference.RESULTS_FOLDER, ""),
            tip="The folder results, where the program is started",
        )
        yield self.folder
        yield flowing(browse, default, None)

    def _training(self) -> Iterable[Any]:
        words: Text = "Tra&ining mode"
        self.training = named(QCheckBox(tr(words)), "training_mode", "Training mode")
        self.training.toggled.connect(
            lambda on: self._choices.put(Preference.HANDS, "" if on else OFF)
        )
        yield self.training
        yield prose("training_why", "What the training mode does", TRAINING, role="caption")

    def _keys(self, keys: Iterable[tuple[Text, Text]]) -> PlainTable:
        table = PlainTable("key_table", "Keys", ("Key", "Does"), stretch=(1,))
        table.show_rows([(tr(key), tr(does)) for key, does in keys])
        table.setMinimumHeight(40 * STEP)
        return table

    def _choose(self) -> None:
        choose_paths(
            self,
            "Folder of the results",
            lambda folders: self._choices.put(Preference.RESULTS_FOLDER, folders[0]),
            QFileDialog.FileMode.Directory,
        )

    def _show(self, *_: object) -> None:
        get = self._choices.get
        show_choice(self.theme, get(Preference.THEME) or "light")
        show_choice(self.language, get(Preference.LANGUAGE))
        self.operator.setText(get(Preference.OPERATOR))
        folder = get(Preference.RESULTS_FOLDER)
        self.folder.show_text(folder or tr("As started: {}", self._host.results_folder))
        with QSignalBlocker(self.training):
            self.training.setChecked(get(Preference.HANDS) != OFF)
        later = any(
            get(key) != self._begun[key] for key in (Preference.LANGUAGE, Preference.RESULTS_FOLDER)
        )
        self.later.setVisible(later)
        self.again.setVisible(later)


def settings_page(host: Host) -> QWidget:
    """Make the page of settings."""
    return host.add("settings", SettingsPage(host))
