"""Bar that lists unsaved changes and asks whether to save or discard them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QWidget

from rigapp.gui.widgets.bars import Bar
from rigapp.gui.widgets.build import button
from rigapp.presentation.translation import tr

NAMED = 4
"""Maximum number of changes named one by one; further ones are counted."""


class UnsavedBar(Bar):
    """List the changes; save them, discard them, or continue editing, which is the default.

    replaced: the widget in whose place the bar is shown.
    """

    def __init__(self, save: Callable[[], bool], replaced: QWidget) -> None:
        super().__init__("unsaved", "Changes that are not saved", "Changes that would be lost")
        self._save = save
        self._replaced = replaced
        self._then: Callable[[], None] | None = None
        self.escape = self.put_away
        self.save = button("unsaved_save", "Save", self._save_first)
        self.discard = button("unsaved_discard", "Discard", self._continue)
        self.stay = button("unsaved_stay", "Continue editing", self.put_away)
        self.lay_out((self.save, self.discard, self.stay))

    def ask(self, changes: Sequence[str], what: str, then: Callable[[], None]) -> None:
        """Ask before the action ``what``; ``then`` performs it, after saving or discarding."""
        self._then = then
        self.say(tr("Not saved before {}: {}", tr(what), listed(changes)))
        many = len(changes) > 1
        discard = tr("Discard {} changes", len(changes)) if many else tr("Discard 1 change")
        self.discard.setText(discard)
        self.discard.setAccessibleName(discard)
        self._replaced.hide()
        self.show()
        self.stay.setFocus(Qt.FocusReason.OtherFocusReason)

    def put_away(self) -> None:
        """Continue editing."""
        self._then = None
        self.hide()
        self._replaced.show()

    def _save_first(self) -> None:
        if self._save():
            self._continue()

    def _continue(self) -> None:
        then = self._then
        self.put_away()
        if then is not None:
            then()


def listed(changes: Sequence[str]) -> str:
    """Return changes in one sentence."""
    text = "; ".join(changes[:NAMED])
    more = len(changes) - NAMED
    return text + (tr("; and {} more", more) if more > 0 else "") + "."
