"""Help on F1: the guides with pictures where they are installed, and the table of keys."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Final

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
from rigapp.presentation.translation import Text, marked, tr

NO_GUIDE: Final[Text] = (
    "The guides are not installed. Settings (Ctrl+,) list what each key does.\n\n"
    "The emergency stop is the red button on the rig. It works without this program, and no program"
    " replaces it."
)
MARGIN = 64  # px: the scroll bar, and the indent of a list

KEYS: Final[tuple[tuple[Text, Text], ...]] = (
    ("F8", "Go to the line for reasons and notes; Enter adds the note to the log"),
    ("F7", "Acknowledge the alarm that is shown in full; show the alarms where none is in view"),
    (RECOVER_KEY, "Do the next step that the message line or the panel Recover names"),
    ("F11", "Try the simulated rig, from the page Start"),
    ("F1", "Help"),
    ("F2", "Take control of the rig, or release it"),
    ("F3", "Calibrate the load cell or the probes, map the pin's run-out"),
    ("F9", "Light or dark"),
    ("Alt+1 … Alt+5", "Go to a place"),
    (
        "Ctrl+1 … Ctrl+9, Ctrl+0, Ctrl+D, Ctrl+M, Ctrl+N, Ctrl+R, Ctrl+T, Ctrl+U, Ctrl+W",
        "Go to a page",
    ),
    ("Ctrl+,", "Settings"),
    (marked("Alt + underlined letter"), "Press a button, go to a field"),
    (
        marked("← → + − in a trend"),
        "Move and zoom; a click reads the values at a cycle, Esc the newest again",
    ),
    (
        marked("← → in a force plot"),
        "Move the cursor by 1 deg, with Shift by 10 deg; a click puts it there",
    ),
    (
        marked("1, 2 in a plot"),
        "Two cursors with their difference; Shift+click puts one, Esc ends it",
    ),
    (marked("Ctrl+← → in a plot"), "Move the chosen cursor of the two, with Shift further"),
    (marked("Backspace in a plot"), "Show all again after a rectangle was drawn"),
    ("Esc", "Close the start bar or the help"),
)
"""Keys other than those of the buttons at the bottom, and their actions."""


def window_keys() -> tuple[tuple[Text, Text], ...]:
    """Return each key of the window and its action."""
    commands = ((spec.key, f"{spec.spoken.rstrip('…')}: {tr(spec.tip)}") for spec in BUTTONS)
    return (*commands, *KEYS)


def anchor_of(heading: str) -> str:
    """Return the anchor of a heading as on the guides' site."""
    return re.sub(r"[^a-z0-9 -]", "", heading.lower()).replace(" ", "-")


class GuidePages(QTextBrowser):
    """Show guides: pictures fit the window, only links between guides are followed."""

    def __init__(self) -> None:
        super().__init__()
        self.setOpenLinks(False)
        self._loaded_for = 0
        # Reload later, not during the layout.
        self._resized = QTimer(self, singleShot=True, interval=0)
        self._resized.timeout.connect(self._fit_pictures)
        self.setWordWrapMode(QTextOption.WrapMode.WrapAtWordBoundaryOrAnywhere)
        self.anchorClicked.connect(self._follow)

    def loadResource(self, kind: int, name: QUrl | str) -> Any:
        """Load a resource of a page; pictures that are too wide are scaled down."""
        resource = super().loadResource(kind, name)
        if kind != QTextDocument.ResourceType.ImageResource.value or not resource:
            return resource
        picture = resource if isinstance(resource, QPixmap) else QPixmap()
        room = max(self.viewport().width() - MARGIN, 1)
        if not isinstance(resource, QPixmap) and not picture.loadFromData(resource):
            return resource
        if picture.width() <= room:
            return picture
        return picture.scaledToWidth(room, Qt.TransformationMode.SmoothTransformation)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the pictures to the new width."""
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
        """Show a guide with wrapped examples."""
        self._loaded_for = self.viewport().width()
        super().doSetSource(name, type)
        self._wrap()

    def show_markdown(self, text: str) -> None:
        """Show a text without a file."""
        self.setMarkdown(text)
        self._wrap()

    def _wrap(self) -> None:
        """Wrap the lines of examples, which Markdown does not allow."""
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
        """Open another guide or a heading of this one; ignore other links."""
        target = self.source().resolved(link)
        path = Path(target.toLocalFile())
        if path.suffix == ".md" and path.is_file():
            self.setSource(target, QTextDocument.ResourceType.MarkdownResource)
            self.show_heading(target.fragment())

    def show_heading(self, anchor: str) -> None:
        """Scroll to a heading, by its anchor on the guides' site."""
        block = self.document().begin()
        while block.isValid():
            if block.blockFormat().headingLevel() and anchor_of(block.text()) == anchor:
                rectangle = self.document().documentLayout().blockBoundingRect(block)
                self.verticalScrollBar().setValue(int(rectangle.top()))
                return
            block = block.next()


class HelpWindow(QWidget):
    """Show the guides in a separate, non-modal window."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Window)
        named(self, "help", "Help").setWindowTitle(tr("Help"))
        self.browser = named(GuidePages(), "help_text", "Manual")
        self._guide = button("help_guide", "&Guide", self.show_guide)
        back = button("help_back", "&Back", self.browser.backward)
        back.setEnabled(False)
        self.browser.backwardAvailable.connect(back.setEnabled)
        row = QHBoxLayout()
        for control in (self._guide, back):
            row.addWidget(control)
        row.addStretch()
        column = QVBoxLayout(self)
        column.addLayout(row)
        column.addWidget(self.browser)
        QShortcut(QKeySequence(Qt.Key.Key_Escape), self, self.close)
        self.resize(980, 720)
        self.show_guide()

    def show_guide(self) -> None:
        """Show the operator's guide, or a message that no guide is installed."""
        try:
            path = guides_folder() / GUIDE
        except UnusableInput:
            self._guide.setEnabled(False)
            self.browser.show_markdown(tr(NO_GUIDE))
            return
        page = QUrl.fromLocalFile(str(path))
        self.browser.setSource(page, QTextDocument.ResourceType.MarkdownResource)

    def show_section(self, anchor: str) -> None:
        """Show a section of the troubleshooting guide, or a message that none is installed."""
        try:
            page = QUrl.fromLocalFile(str(guides_folder() / TROUBLESHOOTING))
        except UnusableInput:
            self._guide.setEnabled(False)
            self.browser.show_markdown(tr(NO_GUIDE))
            return
        self.browser.setSource(page, QTextDocument.ResourceType.MarkdownResource)
        self.browser.show_heading(anchor)
