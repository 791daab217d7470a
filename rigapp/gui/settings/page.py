"""One page of settings: look, operator, folder, messages, live page, training, keys."""

from __future__ import annotations

from collections.abc import Iterable
from functools import partial
from typing import Any, Final

from PySide6.QtCore import QSignalBlocker
from PySide6.QtWidgets import QCheckBox, QComboBox, QFileDialog, QFrame, QWidget

from rigapp.config.names import login_name
from rigapp.gui.look.preferences import AS_SYSTEM, OFF, Preference
from rigapp.gui.panel import Act, Host
from rigapp.gui.settings.livepage import LivePageCard
from rigapp.gui.settings.messages import MessageCard
from rigapp.gui.settings.pins import PinPart
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
from rigapp.presentation.translation import Text, tr
from rigapp.viewer.news import News, Takes

CARD_WIDTH = 56 * STEP
THEME_NAMES: Final[tuple[tuple[Text, str], ...]] = (
    ("Light", "light"),
    ("Dark", "dark"),
    ("As the desktop", AS_SYSTEM),
)
NAME_CHARACTERS = 60
LATER: Final[Text] = "Language and folder count when the window is opened again."
TRAINING: Final[Text] = (
    "Simulated hands do the steps of a calibration, without waiting times. Simulated rig only."
)


def settings_card(name: str, title: Text, *items: Any) -> QFrame:
    """Return a card with a title and items below each other."""
    card = named(QFrame(), f"{name}_card", title, role="card")
    head = heading(f"{name}_title", title)
    column(head, *items, None, on=card, margins=(MARGIN, GAP), spacing=STEP)
    return card


def show_choice(box: QComboBox, value: str) -> None:
    """Show the item of a value without calling what a choice calls."""
    with QSignalBlocker(box):
        box.setCurrentIndex(max(box.findData(value), 0))


class SettingsPage(QWidget):
    """Show each setting, and keep what is changed at once."""

    takes = Takes(0)

    def __init__(self, host: Host) -> None:
        super().__init__()
        self._host = host
        self._choices = host.preferences
        self._begun = {one: self._choices.get(one) for one in Preference}
        named(self, "settings_page", "Settings")
        self.messages = MessageCard(host.worker, host.rig, host.say)
        self.live = LivePageCard(self._choices, host.rig)
        self.later = prose("settings_later", "What counts later", LATER, role="caution")
        again: Text = "Open the window a&gain"
        self.again = button("settings_again", again, partial(host.do, Act.AGAIN))
        left = (
            settings_card("look", "Look", self._look()),
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
        """Take nothing: settings are the user's, not the test's."""

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
        why: Text = "Stands in the log at what is done from this window. Empty: the login name."
        yield flowing("N&ame", (self.operator, 1))
        yield prose("operator_why", "What the name is for", why, role="caption")
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
            get(one) != self._begun[one] for one in (Preference.LANGUAGE, Preference.RESULTS_FOLDER)
        )
        self.later.setVisible(later)
        self.again.setVisible(later)


def settings_page(host: Host) -> QWidget:
    """Make the page of settings."""
    return host.add("settings", SettingsPage(host))
