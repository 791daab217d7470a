"""A page of the wizard: it scrolls where the window is low, and folds where it is narrow."""

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
from rigapp.gui.wizard.widgets import MeasuredCard, ResidualPlot, caption, sentence
from rigapp.presentation.tokens import BODY_PT, GAP, STEP, VALUE_PT
from rigapp.presentation.translation import Text, tr

TWO, FOUR = 64 * STEP, 112 * STEP
"""Least widths of a page on which two and four parts have room beside each other."""
ABOVE_AND_BELOW = 20 * STEP
"""Height of what must be visible with a picture: the sentence above it, the buttons below."""
PLOT_HEIGHT = 64 * STEP
"""Of a page: a lower one has no room for a plot beside its table."""
LEAST_HEIGHT = 24 * STEP
"""Of a page: a lower one has no room for a picture, whose contents are in its words, too."""


class Yielding(QWidget):
    """A widget as high as its content needs at its width, and no higher."""

    def minimumSizeHint(self) -> QSize:
        """Return the least width; the height follows from it."""
        return QSize(super().minimumSizeHint().width(), 0)


class GuidePage(QWizardPage):
    """A page whose content scrolls; its main button is in the foot of the wizard.

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
        """Set the content, from top to bottom."""
        inside = Yielding()
        layout = filled(QVBoxLayout(inside), (self._where, *items))
        layout.setContentsMargins(0, 0, STEP, 0)
        layout.setSpacing(GAP)
        area = scrolling("guide_page", "Page", inside)
        # Only what may grow gets the height of a wizard.
        area.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        column(area, on=self)

    def asking(self, name: str, lines: int = 1) -> QLabel:
        """Return the sentence that says what to do now, legible from the rig.

        lines: its least number, so that nothing below moves from step to step.
        """
        self._lines = lines
        self._asking = sentence(name, "What to do now")
        self._asking.setAlignment(Qt.AlignmentFlag.AlignTop)
        return self._asking

    def beside(self, least: int, *items: Item | tuple[Item, int]) -> QHBoxLayout:
        """Return items side by side, and below each other on a page less wide than ``least``."""
        layout = row(*items)
        layout.setSpacing(GAP)
        self._pairs.append((layout, least))
        return layout

    def take_focus(self) -> None:
        """Give the focus to what had it last on this page, else to the page itself."""
        focused = self.wizard().focusWidget()
        (focused if focused is not None and self.isAncestorOf(focused) else self).setFocus()

    def say_complete(self, *progress: object) -> None:
        """Emit ``completeChanged`` when completeness or progress has changed."""
        now = (self.isComplete(), *progress)
        if now != self._progress:
            self._progress = now
            self.completeChanged.emit()

    def foot(self) -> tuple[tuple[QAbstractButton, bool], ...]:
        """Return the page's own buttons in the foot of the wizard, and whether they are shown."""
        return ()

    def make_room(self, width: int, height: int, *, alone: bool) -> None:
        """Fit the content to the size of the page; alone: no column of steps is beside it."""
        low = height < LEAST_HEIGHT
        self._where.setVisible(alone and not low)
        if self._asking is not None:
            points = BODY_PT if low else VALUE_PT
            self._asking.setFont(sized(self.font(), points, QFont.Weight.DemiBold))
            line = self._asking.fontMetrics().lineSpacing()
            self._asking.setMinimumHeight(0 if low else self._lines * line)
        for layout, least in self._pairs:
            narrow = width < least
            way = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
            layout.setDirection(way)
        for picture in self.findChildren(Picture):
            picture.setVisible(not low)
            picture.stay_within(height - ABOVE_AND_BELOW)
        for plot in self.findChildren(ResidualPlot):
            plot.make_room(low=height < PLOT_HEIGHT)
        for card in self.findChildren(MeasuredCard):
            card.make_room(low=low)
