"""A page of the wizard: it scrolls up and down where the window is low, and folds where narrow."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QFont
from PySide6.QtWidgets import (
    QAbstractButton,
    QBoxLayout,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
    QWizardPage,
)

from rigapp.gui.look.fonts import sized
from rigapp.gui.widgets.build import Item, column, filled, row, scrolling
from rigapp.gui.wizard.scenes import Picture
from rigapp.gui.wizard.widgets import MeasuredCard, caption, sentence
from rigapp.presentation.tokens import BODY_PT, GAP, STEP, VALUE_PT
from rigapp.presentation.translation import Text, tr

TWO, FOUR = 64 * STEP, 112 * STEP
"""Least widths of a page on which two and four parts find room beside each other."""
ABOVE_AND_BELOW = 20 * STEP
"""What else is to be seen with a picture: the sentence above it, the buttons below."""
LEAST_HEIGHT = 24 * STEP
"""Of a page: a lower one has no room for a picture; what it shows is said in words, too."""


class Yielding(QWidget):
    """What is as high as its content needs at its width, and no higher."""

    def minimumSizeHint(self) -> QSize:
        """Return the least width; the height follows from it."""
        return QSize(super().minimumSizeHint().width(), 0)


class GuidePage(QWizardPage):
    """A page whose content scrolls; its main button stands in the foot of the wizard.

    step: its name in the column of the steps.
    """

    def __init__(self, step: Text) -> None:
        super().__init__()
        self.step = tr(step)
        self.setAccessibleName(self.step)
        self._where = caption(self.step)
        self._where.hide()
        self._asking: QLabel | None = None
        self._lines = 1
        self._progress: tuple[object, ...] = ()
        self._pairs: list[tuple[QBoxLayout, int]] = []

    def hold(self, *items: Item | tuple[Item, int]) -> None:
        """Take the content, from top to bottom."""
        inside = Yielding()
        made = filled(QVBoxLayout(inside), (self._where, *items))
        made.setContentsMargins(0, 0, STEP, 0)
        made.setSpacing(GAP)
        area = scrolling("guide_page", "Page", inside)
        # Only what wants to grow is given the height of a wizard.
        area.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        column(area, on=self)

    def asking(self, name: str, lines: int = 1) -> QLabel:
        """Return the sentence that says what to do now, to be read from where the hands are.

        lines: that it has at least, so that nothing below moves from step to step.
        """
        self._lines = lines
        self._asking = sentence(name, "What to do now")
        self._asking.setAlignment(Qt.AlignmentFlag.AlignTop)
        return self._asking

    def beside(self, least: int, *items: Item | tuple[Item, int]) -> QHBoxLayout:
        """Return items side by side, and below each other on a page less wide than ``least``."""
        made = row(*items)
        made.setSpacing(GAP)
        self._pairs.append((made, least))
        return made

    def take_focus(self) -> None:
        """Give the focus to what had it last on this page, else to the page itself."""
        one = self.wizard().focusWidget()
        (one if one is not None and self.isAncestorOf(one) else self).setFocus()

    def say_complete(self, *progress: object) -> None:
        """Say whether it is complete and how far it is, when that has changed."""
        now = (self.isComplete(), *progress)
        if now != self._progress:
            self._progress = now
            self.completeChanged.emit()

    def foot(self) -> tuple[tuple[QAbstractButton, bool], ...]:
        """Return the buttons of its own in the foot of the wizard, and whether they are shown."""
        return ()

    def make_room(self, width: int, height: int, *, alone: bool) -> None:
        """Fit the content to the size of the page; alone: no column of steps stands beside it."""
        low = height < LEAST_HEIGHT
        self._where.setVisible(alone and not low)
        if self._asking is not None:
            points = BODY_PT if low else VALUE_PT
            self._asking.setFont(sized(self.font(), points, QFont.Weight.DemiBold))
            line = self._asking.fontMetrics().lineSpacing()
            self._asking.setMinimumHeight(0 if low else self._lines * line)
        for made, least in self._pairs:
            narrow = width < least
            way = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
            made.setDirection(way)
        for picture in self.findChildren(Picture):
            picture.setVisible(not low)
            picture.stay_within(height - ABOVE_AND_BELOW)
        for card in self.findChildren(MeasuredCard):
            card.make_room(low=low)
