"""Choose test, length and file of a start, on a card above the buttons that hides no state."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFileDialog, QFrame

from rigapp.config.ranges import RANGES
from rigapp.gui.language.words import tr
from rigapp.gui.widgets.build import button, choice, edit, named, row, whole_number

MOST_REVOLUTIONS = int(RANGES["run.revolutions"].high)


class StartBar(QFrame):
    """Ask for test, length and file on a card that floats above the bar of buttons."""

    started = Signal(dict)

    def __init__(self, tests: Sequence[Path], results_folder: Path) -> None:
        super().__init__()
        self._results = results_folder
        named(self, "start_bar", "Start a test")
        self.setProperty("role", "card")
        self.test = choice("start_test", "Test to start", (), self._name_file)
        self.out = edit("start_file", "File that the test is written to")
        self.revolutions = whole_number(
            "start_revolutions", "Revolutions, 0: as in the test", 0, MOST_REVOLUTIONS
        )
        self.revolutions.setSpecialValueText(tr("as in the test"))
        browse = button("start_browse", "&Browse…", self._browse, "Choose another test file")
        self.go = button("start_now", "Start no&w", self._go, guarded=True, rank="primary")
        cancel = button("start_cancel", "Cancel", self.hide, "Do not start")
        row(
            "Test &file", (self.test, 2), browse,
            "Re&volutions", (self.revolutions, 1),
            "Write t&o", (self.out, 3),
            self.go, cancel,
            on=self,
        )  # fmt: skip
        self.offer(tests)
        self.hide()

    def offer(self, tests: Sequence[Path]) -> None:
        """Offer test files, the first one chosen."""
        self.test.clear()
        for path in tests:
            self.test.addItem(path.name, str(path))

    def choose(self, path: Path) -> None:
        """Choose a test file, adding it when it is new."""
        index = self.test.findData(str(path))
        if index < 0:
            self.test.addItem(path.name, str(path))
            index = self.test.count() - 1
        self.test.setCurrentIndex(index)

    def open(self) -> None:
        """Show the bar with a fresh file name and the focus on the test."""
        self._name_file()
        self.go.setEnabled(self.test.count() > 0)
        self.show()
        self.test.setFocus(Qt.FocusReason.OtherFocusReason)

    def start(self, path: Path) -> None:
        """Start a test file as it is, into a fresh file."""
        self.choose(path)
        self._name_file()
        self.revolutions.setValue(0)
        self._go()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Enter starts, Esc closes the bar."""
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._go()
        else:
            super().keyPressEvent(event)

    def _name_file(self) -> None:
        path = self.test.currentData()
        if path:
            stamp = time.strftime("%Y%m%d-%H%M%S")
            self.out.setText(str(self._results / f"{Path(path).stem}-{stamp}.h5"))

    def _browse(self) -> None:
        dialog = QFileDialog(self, tr("Choose a test"), filter=tr("Tests (*.toml)"))
        dialog.setObjectName("choose_test")
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
        dialog.setModal(False)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.fileSelected.connect(lambda name: self.choose(Path(name)))
        dialog.show()

    def _go(self) -> None:
        self.revolutions.interpretText()
        if not self.test.currentData() or not self.out.text().strip():
            return
        arguments: dict[str, Any] = {
            "test": self.test.currentData(),
            "out": self.out.text().strip(),
        }
        if self.revolutions.value():
            arguments["revolutions"] = self.revolutions.value()
        self.hide()
        self.started.emit(arguments)
