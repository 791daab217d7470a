"""Layout of the window: pages, newest values, and the recovery from a fault."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from PySide6.QtWidgets import QGridLayout, QWidget

from rigapp.gui.widgets.build import button, row
from rigapp.gui.window.pagestack import PageStack
from rigapp.gui.window.places import PageBar, RailPlace
from rigapp.gui.window.recover import RecoverPanel
from rigapp.gui.window.side import SideColumn
from rigapp.gui.window.tabs import Tabs
from rigapp.presentation.tokens import GAP, MARGIN, STEP, TIGHT_HEIGHT, TIGHT_WIDTH

BESIDE = frozenset({RailPlace.WATCH, RailPlace.RIG})
"""Places with newest values and recovery beside the pages; the others need the width."""

NARROW_WIDTH = 800
"""Width below which the recovery replaces the pages."""

BESIDE_PAGES, OF_PAGES = (0, 1, 2, 1), (1, 0, 1, 1)
"""Row, column and their spans for the side column, beside the pages and in place of them."""


class TightBar(Protocol):
    """A part of the window that needs less room when this is tight."""

    def make_room(self, *, tight: bool) -> None:
        """Switch between reduced and normal size."""
        ...


class PageRoom:
    """Lay out the pages and the side column by the size of the window."""

    def __init__(
        self,
        window: QWidget,
        tabs: Tabs,
        stage: PageStack,
        page_bar: PageBar,
        side: SideColumn,
        recover: RecoverPanel,
        bars: Sequence[TightBar],
    ) -> None:
        self._window, self._tabs, self._stage, self._page_bar = window, tabs, stage, page_bar
        self._side, self._recover, self._bars = side, recover, bars
        self.tight = self._narrow = self._recovery_hidden = False
        self.recover_button = button("show_recover", "Recover", self.show_recover, rank="primary")
        content = self.content = QGridLayout()
        content.addLayout(row((page_bar, 1), self.recover_button), 0, 0)
        content.addWidget(stage, 1, 0)
        content.addWidget(side, *BESIDE_PAGES)
        content.setRowStretch(1, 1)
        content.setColumnStretch(0, 1)
        content.setContentsMargins(MARGIN, STEP, MARGIN, GAP)
        content.setHorizontalSpacing(GAP)
        content.setVerticalSpacing(2)

    def fit(self) -> None:
        """Fit the layout to the size of the window."""
        width, height = self._window.width(), self._window.height()
        tight = width < TIGHT_WIDTH or height < TIGHT_HEIGHT
        self._side.make_room(width, tight=tight, alone=self._narrow)
        if tight is not self.tight:
            self.tight = tight
            for part in self._bars:
                part.make_room(tight=tight)
        self.show_side()

    def show_side(self) -> None:
        """Show newest values and the recovery where there is room."""
        width, height = self._window.width(), self._window.height()
        guiding = self._stage.guiding
        self._page_bar.setVisible(not (guiding and height < TIGHT_HEIGHT))
        tight = self.tight or guiding
        recovering = not self._recover.isHidden()
        wanted = self._tabs.place in BESIDE and (not tight or recovering)
        narrow = wanted and width < NARROW_WIDTH
        self._recovery_hidden = self._recovery_hidden and recovering
        if narrow is not self._narrow:
            self._narrow = narrow
            self.content.removeWidget(self._side)
            self.content.addWidget(self._side, *(OF_PAGES if narrow else BESIDE_PAGES))
            self._side.make_room(width, tight=self.tight, alone=narrow)
        passed = narrow and self._recovery_hidden
        for part, seen in (
            (self._side, wanted and not passed),
            (self._stage, not narrow or passed),
            (self.recover_button, passed),
        ):
            if part.isVisibleTo(self._window) != seen:
                part.setVisible(seen)

    def hide_recover(self) -> None:
        """Show the pages in a window that is too narrow for pages and recovery."""
        self._recovery_hidden = True
        self.show_side()

    def show_recover(self) -> None:
        """Show the recovery again."""
        self._recovery_hidden = False
        self.show_side()
