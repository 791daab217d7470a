"""A page of the wizard, which scrolls in a low window and wraps in a narrow one."""

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
"""Minimum widths of a page for two and for four parts side by side."""
ABOVE_AND_BELOW = 20 * STEP
"""Height of the sentence above a picture and the buttons below it, which must be visible."""
PLOT_HEIGHT = 64 * STEP
"""Minimum height of a page for a plot beside its table."""
LEAST_HEIGHT = 24 * STEP
"""Minimum height of a page for a picture, whose contents are also given as text."""


class ContentHeight(QWidget):
    """A widget with the height of its content at the present width."""

    def minimumSizeHint(self) -> QSize:
        """Return the minimum width without a height, which depends on the width."""
        return QSize(super().minimumSizeHint().width(), 0)


class GuidePage(QWizardPage):
    """A page whose content scrolls; its main button is in the wizard's button row.

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
        inside = ContentHeight()
        layout = filled(QVBoxLayout(inside), (self._where, *items))
        layout.setContentsMargins(0, 0, STEP, 0)
        layout.setSpacing(GAP)
        area = scrolling("guide_page", "Page", inside)
        # Only an expanding page gets the full height of the wizard.
        area.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        column(area, on=self)

    def asking(self, name: str, lines: int = 1) -> QLabel:
        """Return the label of the present instruction, legible from the rig.

        lines: minimum number of lines, so that nothing below moves from step to step.
        """
        self._lines = lines
        self._asking = sentence(name, "What to do now")
        self._asking.setAlignment(Qt.AlignmentFlag.AlignTop)
        return self._asking

    def beside(self, least: int, *items: Item | tuple[Item, int]) -> QHBoxLayout:
        """Return items side by side, below each other on a page narrower than ``least``."""
        layout = row(*items)
        layout.setSpacing(GAP)
        self._pairs.append((layout, least))
        return layout

    def take_focus(self) -> None:
        """Give the focus to the last focused widget of this page, else to the page."""
        focused = self.wizard().focusWidget()
        (focused if focused is not None and self.isAncestorOf(focused) else self).setFocus()

    def say_complete(self, *progress: object) -> None:
        """Emit ``completeChanged`` when completeness or progress has changed."""
        now = (self.isComplete(), *progress)
        if now != self._progress:
            self._progress = now
            self.completeChanged.emit()

    def foot(self) -> tuple[tuple[QAbstractButton, bool], ...]:
        """Return the page's buttons in the wizard's button row, and whether they are shown."""
        return ()

    def make_room(self, width: int, height: int, *, alone: bool) -> None:
        """Fit the content to the size of the page; alone: without the column of steps."""
        low = height < LEAST_HEIGHT
        self._where.setVisible(alone and not low)
        if self._asking is not None:
            points = BODY_PT if low else VALUE_PT
            self._asking.setFont(sized(self.font(), points, QFont.Weight.DemiBold))
            line = self._asking.fontMetrics().lineSpacing()
            self._asking.setMinimumHeight(0 if low else self._lines * line)
        for layout, least in self._pairs:
            narrow = width < least
            flow = QBoxLayout.Direction.TopToBottom if narrow else QBoxLayout.Direction.LeftToRight
            layout.setDirection(flow)
        for picture in self.findChildren(Picture):
            picture.setVisible(not low)
            picture.stay_within(height - ABOVE_AND_BELOW)
        for plot in self.findChildren(ResidualPlot):
            plot.make_room(low=height < PLOT_HEIGHT)
        for card in self.findChildren(MeasuredCard):
            card.make_room(low=low)
