"""The user's choices for the window, stored for the next start."""

from __future__ import annotations

import enum

from PySide6.QtCore import QObject, QSettings, Qt, Signal
from PySide6.QtGui import QGuiApplication

from rigapp.presentation.tokens import THEMES, Theme


class Preference(enum.StrEnum):
    """Name a preference; the value is its key in the user's settings."""

    THEME = "theme"
    LANGUAGE = "language"
    OPERATOR = "operator"
    RESULTS_FOLDER = "results_folder"
    HANDS = "simulated_hands"
    PAGE = "page_address"


AS_SYSTEM = "system"
"""Theme that follows the desktop, light or dark."""
OFF = "off"


class Preferences(QObject):
    """Preferences of a user; ``changed`` is emitted with the preference that has a new value."""

    changed = Signal(Preference)

    def __init__(self, store: QSettings | None = None) -> None:
        """Set the store; None: preferences last as long as the window."""
        super().__init__()
        self._store = store
        self._values: dict[str, str] = {}

    def get(self, preference: Preference) -> str:
        """Return a choice, empty where none was made."""
        if self._store is None:
            return self._values.get(preference, "")
        return str(self._store.value(preference.value, ""))

    def put(self, preference: Preference, value: str) -> None:
        """Store a choice; an empty one deletes it."""
        if value == self.get(preference):
            return
        if self._store is None:
            self._values[preference] = value
        else:
            self._store.setValue(preference.value, value)
        self.changed.emit(preference)

    @property
    def theme(self) -> Theme:
        """Return the chosen theme, by default the light one."""
        name = self.get(Preference.THEME)
        if name == AS_SYSTEM:
            dark = QGuiApplication.styleHints().colorScheme() is Qt.ColorScheme.Dark
            name = "dark" if dark else "light"
        return THEMES.get(name, THEMES["light"])
