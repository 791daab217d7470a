"""Start the armed test, on a card above the buttons that hides no state."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFileDialog, QFrame

from rigapp.config.names import new_result
from rigapp.config.ranges import RANGES
from rigapp.gui.testfile.recipe import RecipePanel
from rigapp.gui.testfile.unsaved import listed
from rigapp.gui.widgets.build import (
    button,
    choice,
    column,
    edit,
    named,
    prose,
    tell,
    whole_number,
)
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import GAP, MARGIN, STEP
from rigapp.presentation.translation import tr

FILE_WIDTH, TOLD_WIDTH = 24 * STEP, 28 * STEP
MOST_REVOLUTIONS = int(RANGES["run.revolutions"].high)


class StartBar(QFrame):
    """Ask for length and file of the selected test on a card that floats above the buttons.

    The selected test is that of the form (``RecipePanel.selected``); another one that is chosen
    here is opened there. Its file is read again before the start; what differs is shown first.
    """

    started = Signal(dict)

    def __init__(self, recipe: RecipePanel, tests: Sequence[Path], results_folder: Path) -> None:
        super().__init__()
        self._recipe = recipe
        self._results = results_folder
        self._occupied = ""
        named(self, "start_bar", "Start a test")
        self.setProperty("role", "card")
        self.test = choice("start_test", "Armed test", ())
        self.test.activated.connect(self._chosen)
        self.out = edit("start_file", "File that the test is written to")
        self.revolutions = whole_number(
            "start_revolutions", "Revolutions, 0: as in the test", 0, MOST_REVOLUTIONS
        )
        self.revolutions.setSpecialValueText(tr("as in the test"))
        browse = button("start_browse", "&Browse…", self._browse, "Choose another test file")
        self.go = button("start_now", "Start no&w", self._go, guarded=True, rank="primary")
        cancel = button("start_cancel", "Cancel", self.hide, "Do not start")
        self.told = prose("start_told", "What is started")
        self.told.setMinimumSize(TOLD_WIDTH, 5 * STEP)
        self.read = button("start_read", "Read it again", self._read_again)
        self.save = button("start_save", "Save the changes", self._save)
        self.out.setMinimumWidth(FILE_WIDTH)
        fields = flowing(
            "Test &file", (self.test, 2), browse,
            "Re&volutions", (self.revolutions, 1),
            "Write t&o", (self.out, 3),
        )  # fmt: skip
        below = flowing((self.told, 1), self.read, self.save, self.go, cancel)
        column(fields, below, on=self).setContentsMargins(MARGIN, GAP, MARGIN, GAP)
        self.offer(tests)
        recipe.selection_changed.connect(self._show_armed)
        self._show_armed()
        self.hide()

    def offer(self, tests: Sequence[Path]) -> None:
        """Offer test files."""
        for path in tests:
            self._add(path)

    def show_occupied(self, words: str) -> None:
        """Start nothing while a calibration occupies the rig, and say so; empty: it is free."""
        if words != self._occupied:
            self._occupied = words
            self._show_armed()

    @property
    def first(self) -> Path | None:
        """Return the first test that is offered, None without one."""
        path = self.test.itemData(0)
        return Path(path) if path else None

    def _add(self, path: Path) -> int:
        at = self.test.findData(str(path))
        if at < 0:
            self.test.addItem(path.name, str(path))
            at = self.test.count() - 1
        return at

    def choose(self, path: Path) -> bool:
        """Arm a test file; False where it cannot be read, or changes would be lost by it."""
        if path == self._recipe.path or self._recipe.open_wanted(path):
            self._show_armed()
            return self._recipe.path == path
        self._show_armed()
        return False

    def open(self) -> None:
        """Show the card with a fresh file name and the focus on the test."""
        self._show_armed()
        self.show()
        self.test.setFocus(Qt.FocusReason.OtherFocusReason)

    def start(self, path: Path) -> None:
        """Start a test file as it is, into a fresh file; show the card where that is impossible."""
        self.revolutions.setValue(0)
        if self.choose(path) and self.go.isEnabled():
            self._go()
        else:
            self.open()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter starts, Esc closes the bar."""
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._go()
        else:
            super().keyPressEvent(event)

    def _show_armed(self) -> None:
        """Show the armed test, and what of the form or of the disk is not part of it."""
        selected = self._recipe.selected
        self.test.setCurrentIndex(-1 if selected is None else self._add(selected.path))
        changed = selected.on_disk() if selected is not None else []
        lost = self._recipe.unsaved()
        wrong = selected is None or bool(changed or selected.problem or self._occupied)
        text = self._sentence(changed, lost)
        if selected is not None and not wrong:
            self.out.setText(str(new_result(self._results, selected.path.stem)))
        self.told.setText(f"▲ {text}" if wrong else text)
        tell(self.told, "role", "error" if wrong else "caution" if lost else "secondary")
        self.read.setVisible(bool(changed))
        self.save.setVisible(bool(lost) and not wrong)
        self.go.setEnabled(not wrong)

    def _sentence(self, changed: Sequence[str], lost: Sequence[str]) -> str:
        """Say what is armed; changed: what differs on the disk, lost: what is not saved."""
        selected = self._recipe.selected
        if self._occupied:
            return self._occupied
        if selected is None:
            return tr("No test is armed. Choose a test file, or save the new one in Prepare.")
        name = selected.path.name
        if changed:
            return tr("{} is another one on the disk now: {}", name, listed(changed))
        if selected.problem:
            return tr("{} cannot be started: {}.", name, selected.problem)
        if lost:
            return tr("{} is armed as it is saved. Not part of it: {}", name, listed(lost))
        if self._recipe.rules.draft is not None:
            return tr("{} is armed as it is saved. One draft limit is not part of it.", name)
        return tr("{} is armed as it is saved.", name)

    def _chosen(self) -> None:
        if not self.choose(Path(self.test.currentData())):
            text = tr("Changes in Prepare are not saved: save or discard them first.")
            self.told.setText(f"▲ {text}")
            tell(self.told, "role", "error")

    def _read_again(self) -> None:
        path = self._recipe.path
        if path is not None:
            self._recipe.ask_before(f"reading {path.name} again", self._take_disk)
        self._show_armed()

    def _take_disk(self) -> None:
        if self._recipe.path is not None:
            self._recipe.open_file(self._recipe.path)

    def _save(self) -> None:
        if self._recipe.path is not None:
            self._recipe.save(self._recipe.path)
        self._show_armed()

    def _browse(self) -> None:
        dialog = QFileDialog(self, tr("Choose a test"), filter=tr("Tests (*.toml)"))
        dialog.setObjectName("choose_test")
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.setModal(False)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.fileSelected.connect(lambda name: self.choose(Path(name)))
        dialog.show()

    def _go(self) -> None:
        """Start, unless the file has become another one since it was armed."""
        self.revolutions.interpretText()
        out, selected = self.out.text().strip(), self._recipe.selected
        if selected is None or not out or selected.on_disk() or self._occupied:
            self._show_armed()
            return
        arguments: dict[str, Any] = {"test": str(selected.path), "out": out}
        if self.revolutions.value():
            arguments["revolutions"] = self.revolutions.value()
        self.hide()
        self.started.emit(arguments)
