"""What a user chose of the window, kept for the next time."""

from __future__ import annotations

import enum

from PySide6.QtCore import QObject, QSettings, Qt, Signal
from PySide6.QtGui import QGuiApplication

from rigapp.presentation.tokens import THEMES, Theme


class Preference(enum.StrEnum):
    """Name what can be chosen; the value is its key in the user's settings."""

    THEME = "theme"
    LANGUAGE = "language"
    OPERATOR = "operator"
    RESULTS_FOLDER = "results_folder"
    HANDS = "simulated_hands"
    PAGE = "page_address"


AS_SYSTEM = "system"
"""A theme: light or dark as the desktop is."""
OFF = "off"


class Preferences(QObject):
    """The choices of a user; ``changed`` carries the one that has another value."""

    changed = Signal(Preference)

    def __init__(self, store: QSettings | None = None) -> None:
        """Take where they are kept; None: they last as long as the window."""
        super().__init__()
        self._store = store
        self._values: dict[str, str] = {}

    def get(self, what: Preference) -> str:
        """Return a choice, empty where none was made."""
        if self._store is None:
            return self._values.get(what, "")
        return str(self._store.value(what.value, ""))

    def put(self, what: Preference, value: str) -> None:
        """Keep a choice; an empty one is as if none had been made."""
        if value == self.get(what):
            return
        if self._store is None:
            self._values[what] = value
        else:
            self._store.setValue(what.value, value)
        self.changed.emit(what)

    @property
    def theme(self) -> Theme:
        """Return the chosen theme, the light one unless chosen."""
        name = self.get(Preference.THEME)
        if name == AS_SYSTEM:
            dark = QGuiApplication.styleHints().colorScheme() is Qt.ColorScheme.Dark
            name = "dark" if dark else "light"
        return THEMES.get(name, THEMES["light"])
