"""The read-only page for browsers, begun and ended from the window."""

from __future__ import annotations

from pathlib import Path
from typing import Final

from PySide6.QtCore import QProcess, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QWidget

from rigapp.gui.look.preferences import Preference, Preferences
from rigapp.gui.widgets.build import button, column, edit, named, prose
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr
from rigapp.process.children import module_command

ADDRESS: Final = "127.0.0.1:8750"
"""Of this computer alone; others need token, certificate and key, by ``rigapp page``."""
NOT_SERVED: Final[Text] = "Shows this rig in browsers of this computer, while the window is open."
END_MS = 3000


class LivePageCard(QWidget):
    """Serve the page as a process of this window, and open it in a browser."""

    def __init__(self, choices: Preferences, rig: Path | None) -> None:
        super().__init__()
        self._choices, self._rig, self._url = choices, rig, ""
        named(self, "live_page", "Live page")
        self.address = edit("page_address", "Address and port of the page", hint=ADDRESS)
        self.address.setText(choices.get(Preference.PAGE))
        self.serve = button("page_serve", "Serve", self._serve, "Serve the page")
        self.end = button("page_end", "End", self.close_page, "Serve the page no longer")
        self.open = button("page_open", "Open", self._open, "Open the page in a browser")
        self.told = prose("page_told", "How the page is", NOT_SERVED, role="caption")
        fields = flowing("Address", (self.address, 1), self.serve, self.end, self.open)
        column(fields, self.told, on=self, spacing=STEP)
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.finished.connect(self._ended)
        self._show()

    def close_page(self) -> None:
        """End the page; the window waits a moment for it."""
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
        self.told.setText(tr("Starting the page …"))
        self._process.start(program, arguments)
        self._show()

    def _read(self) -> None:
        text = bytes(self._process.readAllStandardOutput().data()).decode(errors="replace")
        for word in text.split():
            if "://" in word:
                self._url = word
                self.told.setText(tr("The page is at {}", word))
        self._show()

    def _ended(self) -> None:
        told = bytes(self._process.readAllStandardError().data()).decode(errors="replace").strip()
        lines = told.splitlines()
        self._url = ""
        self.told.setText(lines[0].removeprefix("rigapp: ") if lines else tr(NOT_SERVED))
        self._show()

    def _show(self) -> None:
        runs = self._process.state() is not QProcess.ProcessState.NotRunning
        self.serve.setEnabled(not runs)
        self.end.setEnabled(runs)
        self.open.setEnabled(bool(self._url))

    def _open(self) -> None:
        QDesktopServices.openUrl(QUrl(self._url))
