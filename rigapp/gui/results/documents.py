"""Reports and tables of a test, written by other processes, and opened."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from PySide6.QtCore import QProcess, QTimer, QUrl
from PySide6.QtGui import QDesktopServices
from PySide6.QtWidgets import QGridLayout, QLabel, QPushButton, QWidget

from rigapp.gui.widgets.build import button, named
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr
from rigapp.process.children import Child, module_command

TIMEOUT_MS = 300_000
"""Time limit of a report: that of 10^7 revolutions takes about a minute."""

Say = Callable[[str, bool], None]
Launch = Callable[[Sequence[str]], None]


@dataclass(frozen=True, slots=True)
class DocumentKind:
    """A kind of document: suffix of its name, title, and the command that writes it."""

    ending: str
    title: Text
    verb: str

    def of(self, test: Path) -> Path:
        """Return the path of the document, in the folder of the test."""
        return test.with_suffix(self.ending)


HTML = DocumentKind(".html", "Report, HTML", "report")
KINDS = (
    DocumentKind(".pdf", "Report, PDF", "report"),
    HTML,
    DocumentKind(".csv", "Table, CSV", "export"),
    DocumentKind(".parquet", "Table, Parquet", "export"),
)


def launch_process(arguments: Sequence[str], folder: Path | None = None) -> None:
    """Start another rigapp, which continues to run when this window closes.

    folder: working folder of the process, by default this window's.
    """
    Child("rigapp", *arguments, folder=folder).leave()


def open_document(path: Path) -> bool:
    """Open a document with the desktop's program for it; return whether there is one."""
    return QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))


class DocumentPanel(QWidget):
    """A line for each kind of document, to write and open it."""

    def __init__(self, name: str, say: Say, show: Callable[[Path], bool] = open_document) -> None:
        super().__init__()
        named(self, f"{name}_documents", "Reports and tables of the test")
        self._say = say
        self._show = show
        self._test: Path | None = None
        self._writing: dict[Path, QProcess] = {}
        self.write: dict[str, QPushButton] = {}
        self.open: dict[str, QPushButton] = {}
        grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(STEP)
        grid.setVerticalSpacing(STEP)
        grid.setColumnStretch(0, 1)
        for row, kind in enumerate(KINDS):
            word = kind.ending[1:]
            self.write[word] = button(
                f"{name}_write_{word}",
                "Write",
                partial(self.begin, kind),
                tr("Write {}", tr(kind.title)),
                tip=tr("Write {} beside the test", tr(kind.title)),
            )
            self.open[word] = button(
                f"{name}_open_{word}",
                "Open",
                partial(self._open, kind),
                tr("Open {}", tr(kind.title)),
            )
            grid.addWidget(QLabel(tr(kind.title)), row, 0)
            grid.addWidget(self.write[word], row, 1)
            grid.addWidget(self.open[word], row, 2)
        self.show_test(None)

    def show_test(self, test: Path | None) -> None:
        """Enable the documents of a test; None: no readable test."""
        self._test = test
        for kind in KINDS:
            word, target = kind.ending[1:], kind.of(test) if test is not None else None
            busy = target in self._writing
            self.write[word].setText(tr("Writing …") if busy else tr("Write"))
            self.write[word].setEnabled(target is not None and not busy)
            exists = target is not None and not busy and target.exists()
            self.open[word].setEnabled(exists)
            missing = tr("{} is not written yet", tr(kind.title))
            self.open[word].setToolTip(str(target) if exists else missing)

    def begin(self, kind: DocumentKind) -> None:
        """Write a document of the shown test; an existing one is replaced."""
        test = self._test
        if test is None or kind.of(test) in self._writing:
            return
        target = kind.of(test)
        process = QProcess(self)
        self._writing[target] = process
        process.finished.connect(partial(self._finished, kind, test))
        process.errorOccurred.connect(partial(self._failed, kind, test))
        limit = QTimer(process, singleShot=True, interval=TIMEOUT_MS)
        limit.timeout.connect(process.kill)
        limit.start()
        program, *arguments = module_command("rigapp", kind.verb, test, "--to", target)
        process.start(program, arguments)
        self._say(tr("Writing {} …", target.name), True)
        self.show_test(test)

    def _failed(self, kind: DocumentKind, test: Path, error: QProcess.ProcessError) -> None:
        if error is QProcess.ProcessError.FailedToStart:
            self._finished(kind, test, 1)

    def _finished(self, kind: DocumentKind, test: Path, status: int, *_: object) -> None:
        target = kind.of(test)
        process = self._writing.pop(target)
        if status == 0 and process.exitStatus() is QProcess.ExitStatus.NormalExit:
            self._say(tr("{} is in {}", tr(kind.title), target), True)
        else:
            output = bytes(process.readAllStandardError().data()).decode(errors="replace").strip()
            why = output.splitlines()[-1] if output else process.errorString()
            self._say(tr("{} is not written: {}", target.name, why), False)
        process.deleteLater()
        self.show_test(self._test)

    def _open(self, kind: DocumentKind) -> None:
        if self._test is not None and not self._show(kind.of(self._test)):
            target = kind.of(self._test)
            none = tr("The desktop has no program for {}; it is in {}", target.suffix, target)
            self._say(none, False)
