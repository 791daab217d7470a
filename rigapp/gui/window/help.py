"""Help on F1: the guides with their pictures where they are installed, and always the keys."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, QTimer, QUrl
from PySide6.QtGui import (
    QKeySequence,
    QPixmap,
    QResizeEvent,
    QShortcut,
    QTextCursor,
    QTextDocument,
    QTextOption,
)
from PySide6.QtWidgets import QHBoxLayout, QTextBrowser, QVBoxLayout, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.gui.widgets.build import button, named
from rigapp.gui.window.controls import BUTTONS
from rigapp.gui.window.recover import KEY as RECOVER_KEY
from rigapp.prepare.shipped import GUIDE, TROUBLESHOOTING, guides_folder
from rigapp.presentation.translation import Text, tr

MARGIN = 64  # px: the bar at the side, and what a list is set in from the page's edge

KEYS: Text = """
| Key | Does |
| --- | --- |
{commands}
| F8 | Go to the line for reasons and notes; Enter adds the note to the log |
| F7 | Acknowledge the alarm that is told in full; show the alarms where none is seen |
| {recover} | Do the next step that the message line or the *Recover* panel names |
| F11 | Try the simulated rig, from the page *Start* |
| F1 | This help |
| F3 | Calibrate the load cell or the probes, map the pin's run-out |
| F9 | Light or dark |
| Ctrl+1 … Ctrl+9, Ctrl+0, Ctrl+D, Ctrl+N, Ctrl+R, Ctrl+U, Ctrl+W | Go to a page |
| Alt + underlined letter | Press a button, go to a field |
| ← → + − in a trend | Move and zoom; a click reads the values at a cycle, Esc the newest again |
| ← → in a force plot | Move the cursor by 1 deg, with Shift by 10 deg; a click puts it there |
| Esc | Close the start bar or this window |

The emergency stop is the red button on the rig. It works without this program, and no program
replaces it. "Stop test" ends a test in order: the spindle runs down, the file is closed.
"""


def keys() -> str:
    """Return what each key does, as Markdown."""
    commands = "\n".join(
        f"| {command.key} | {command.spoken.rstrip('…')}: {tr(command.tip)} |"
        for command in BUTTONS
    )
    return f"# {tr('Keys')}\n{tr(KEYS, commands=commands, recover=RECOVER_KEY)}"


def anchor_of(heading: str) -> str:
    """Return the anchor of a heading, as the guides' site makes it."""
    return re.sub(r"[^a-z0-9 -]", "", heading.lower()).replace(" ", "-")


class GuidePages(QTextBrowser):
    """Show guides: their pictures fit the window, their links lead to each other alone."""

    def __init__(self) -> None:
        super().__init__()
        self.setOpenLinks(False)
        self._loaded_for = 0
        # Not while it is being laid out.
        self._resized = QTimer(self, singleShot=True, interval=0)
        self._resized.timeout.connect(self._fit_pictures)
        self.setWordWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
        self.anchorClicked.connect(self._follow)

    def loadResource(self, kind: int, name: QUrl | str) -> Any:
        """Load what a page names; a picture that is too wide is made smaller."""
        found = super().loadResource(kind, name)
        if kind != QTextDocument.ResourceType.ImageResource.value or not found:
            return found
        picture = found if isinstance(found, QPixmap) else QPixmap()
        room = max(self.viewport().width() - MARGIN, 1)
        if not isinstance(found, QPixmap) and not picture.loadFromData(found):
            return found
        if picture.width() <= room:
            return picture
        return picture.scaledToWidth(room, Qt.TransformationMode.SmoothTransformation)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Make the pictures as wide as there is room."""
        super().resizeEvent(event)
        if event.size().width() != event.oldSize().width():
            self._resized.start()

    def _fit_pictures(self) -> None:
        if self._loaded_for != self.viewport().width() and self.source().isValid():
            bar = self.verticalScrollBar()
            share = bar.value() / max(bar.maximum(), 1)
            self.reload()
            bar.setValue(round(share * bar.maximum()))

    def doSetSource(
        self,
        name: QUrl | str,
        /,
        type: QTextDocument.ResourceType = QTextDocument.ResourceType.UnknownResource,
    ) -> None:
        """Show a guide; its examples wrap as its text does."""
        self._loaded_for = self.viewport().width()
        super().doSetSource(name, type)
        self._wrap()

    def show_markdown(self, text: str) -> None:
        """Show a text that is no file."""
        self.setMarkdown(text)
        self._wrap()

    def _wrap(self) -> None:
        """Let lines wrap that Markdown would keep whole, wherever they have to."""
        cursor = QTextCursor(self.document())
        block = self.document().begin()
        while block.isValid():
            if block.blockFormat().nonBreakableLines():
                cursor.setPosition(block.position())
                shape = block.blockFormat()
                shape.setNonBreakableLines(False)
                cursor.setBlockFormat(shape)
            block = block.next()

    def _follow(self, link: QUrl) -> None:
        """Go to another guide, or to a heading of this one; nowhere else."""
        target = self.source().resolved(link)
        path = Path(target.toLocalFile())
        if path.suffix == ".md" and path.is_file():
            self.setSource(target, QTextDocument.ResourceType.MarkdownResource)
            self.show_heading(target.fragment())

    def show_heading(self, anchor: str) -> None:
        """Bring a heading to the top, by the anchor that the guides' site gives it."""
        block = self.document().begin()
        while block.isValid():
            if block.blockFormat().headingLevel() and anchor_of(block.text()) == anchor:
                place = self.document().documentLayout().blockBoundingRect(block)
                self.verticalScrollBar().setValue(int(place.top()))
                return
            block = block.next()


class HelpWindow(QWidget):
    """Show the guides in a window of its own, which never blocks the first one."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Window)
        named(self, "help", "Help").setWindowTitle(tr("Help"))
        self.browser = named(GuidePages(), "help_text", "Manual")
        self._guide = button("help_guide", "&Guide", self.show_guide)
        back = button("help_back", "&Back", self.browser.backward)
        back.setEnabled(False)
        self.browser.backwardAvailable.connect(back.setEnabled)
        row = QHBoxLayout()
        for one in (self._guide, button("help_keys", "&Keys", self.show_keys), back):
            row.addWidget(one)
        row.addStretch()
        column = QVBoxLayout(self)
        column.addLayout(row)
        column.addWidget(self.browser)
        QShortcut(QKeySequence(Qt.Key.Key_Escape), self, self.close)
        self.resize(980, 720)
        self.show_guide()

    def show_guide(self) -> None:
        """Show the operator's guide; the keys where no guide is installed."""
        try:
            path = guides_folder() / GUIDE
        except UnusableInput:
            self._guide.setEnabled(False)
            self.show_keys()
            return
        page = QUrl.fromLocalFile(str(path))
        self.browser.setSource(page, QTextDocument.ResourceType.MarkdownResource)

    def show_section(self, anchor: str) -> None:
        """Show a section of the troubleshooting guide; the keys where no guide is installed."""
        try:
            page = QUrl.fromLocalFile(str(guides_folder() / TROUBLESHOOTING))
        except UnusableInput:
            self.show_keys()
            return
        self.browser.setSource(page, QTextDocument.ResourceType.MarkdownResource)
        self.browser.show_heading(anchor)

    def show_keys(self) -> None:
        """Show what each key does."""
        self.browser.show_markdown(keys())
