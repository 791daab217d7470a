"""The four places of the window: a navigation rail, and the pages of the selected place."""

from __future__ import annotations

import enum
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QKeySequence, QResizeEvent, QShortcut
from PySide6.QtWidgets import QButtonGroup, QFrame, QLabel, QPushButton, QToolButton, QWidget

from rigapp.gui.look.dress import dress_part
from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.widgets.build import (
    button,
    choice,
    column,
    follow_in_tab_order,
    key_text,
    named,
    row,
)
from rigapp.presentation.tokens import CAPTION_PT, GAP, STEP, Theme
from rigapp.presentation.translation import Text, marked, tr

RAIL_WIDTH = 13 * STEP
ITEM_HEIGHT = 9 * STEP
TIGHT_ITEM_HEIGHT = 6 * STEP
ICON = QSize(24, 24)
PAGE_BAR_HEIGHT = 6 * STEP


class RailPlace(enum.StrEnum):
    """The places, with their texts in the rail."""

    WATCH = marked("Watch")
    PREPARE = marked("Prepare")
    RIG = marked("Rig")
    RESULTS = marked("Results")
    SETTINGS = marked("Settings")


ICONS = {
    RailPlace.WATCH: Icon.WATCH,
    RailPlace.PREPARE: Icon.PREPARE,
    RailPlace.RIG: Icon.RIG,
    RailPlace.RESULTS: Icon.RESULTS,
    RailPlace.SETTINGS: Icon.SETTINGS,
}


class Rail(QFrame):
    """Buttons of the places; above them the name and kind of the rig, below settings and help."""

    chosen = Signal(RailPlace)

    def __init__(self, theme: Theme, help_: Callable[[], None]):
        super().__init__()
        named(self, "rail", "Places")
        self.setFixedWidth(RAIL_WIDTH)
        self.rig = named(QLabel(), "rail_rig", "Rig")
        self.rig.setWordWrap(True)
        self.kind = named(QLabel(), "rail_kind", "Simulated or replayed")
        for label in (self.rig, self.kind):
            label.setAlignment(Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop)
            label.setTextFormat(Qt.TextFormat.PlainText)
        self.rig.setFixedHeight(7 * STEP)
        self.kind.setFixedHeight(3 * STEP)
        self.kind.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.buttons = {place: self._item(place) for place in RailPlace}
        group = QButtonGroup(self)
        for item in self.buttons.values():
            group.addButton(item)
        self.help_button = button("help_button", "Help F1", help_, "Help", rank="quiet")
        *places, settings = (self.buttons[place] for place in RailPlace)
        above = column(self.rig, self.kind, None)
        above.setSpacing(STEP // 2)
        self._above = QWidget()
        self._above.setLayout(above)
        layout = column(self._above, *places, None, settings, self.help_button, on=self)
        layout.setContentsMargins(1, STEP, 1, STEP)
        layout.setSpacing(STEP // 2)
        self.make_room(tight=False)
        self.dress(theme)

    def make_room(self, *, tight: bool) -> None:
        """Reduce the height in a tight window; SIMULATED is always shown."""
        self.rig.setVisible(not tight)
        self._above.setFixedHeight((4 if tight else 12) * STEP)
        for item in self.buttons.values():
            item.setFixedHeight(TIGHT_ITEM_HEIGHT if tight else ITEM_HEIGHT)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        dress_part(
            self,
            theme,
            f"#rail {{ background: {theme.base}; border-right: 1px solid {theme.hairline}; }}"
            f" QToolButton {{ border: 0; border-radius: 6px; color: {theme.secondary}; }}"
            f" QToolButton:hover {{ background: {theme.alternate}; }}"
            f" QToolButton:checked {{ background: {theme.tint}; color: {theme.highlight};"
            " }"
            f" QToolButton:focus {{ border: 2px solid {theme.highlight}; }}"
            f" #rail_rig {{ font-size: {CAPTION_PT}pt; font-weight: 600; }}"
            f" #rail_kind {{ color: {theme.secondary}; font-size: {CAPTION_PT - 1.5}pt;"
            f" font-weight: 600; border: 1px dashed {theme.border}; border-radius: 4px;"
            " margin: 0 7px; }"
            f" #rail QPushButton {{ font-size: {CAPTION_PT}pt; color: {theme.secondary};"
            " padding: 0; }",
        )
        self._theme = theme
        self._paint_places()
        self.help_button.setIcon(icon(Icon.HELP, theme.secondary))

    def _paint_places(self) -> None:
        theme = self._theme
        for place, item in self.buttons.items():
            chosen = theme.highlight if item.isChecked() else theme.secondary
            item.setIcon(icon(ICONS[place], chosen))

    def show_place(self, place: RailPlace) -> None:
        """Mark the shown place and move the focus to it."""
        if any(item.hasFocus() for item in self.buttons.values()):
            self.buttons[place].setFocus()
        if not self.buttons[place].isChecked():
            self.buttons[place].setChecked(True)
            self._paint_places()

    def offer(self, places: Collection[RailPlace]) -> None:
        """Show the buttons of some places only."""
        for place, item in self.buttons.items():
            item.setVisible(place in places)

    def show_rig(self, rig: str, kind: str) -> None:
        """Show the rig's name and kind: SIMULATED, REPLAY, or empty for a real one."""
        for label, text in ((self.rig, rig), (self.kind, kind)):
            if label.toolTip() != text:
                label.setText(text.replace("-", "\N{NON-BREAKING HYPHEN}"))
                label.setToolTip(text)
        if self.kind.isVisibleTo(self) != bool(kind):
            self.kind.setVisible(bool(kind))

    def _item(self, place: RailPlace) -> QToolButton:
        item = named(QToolButton(), f"place_{place.name.lower()}", place.value)
        item.setText(tr(place.value))
        item.setCheckable(True)
        item.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextUnderIcon)
        item.setIconSize(ICON)
        item.setFixedSize(RAIL_WIDTH - 2, ITEM_HEIGHT)
        key = f"Alt+{list(RailPlace).index(place) + 1}"
        item.setToolTip(f"{tr(place.value)} ({key})")
        item.clicked.connect(partial(self.chosen.emit, place))
        QShortcut(QKeySequence(key), self).activated.connect(partial(self.chosen.emit, place))
        return item


@dataclass(frozen=True, slots=True)
class PageName:
    """A page: its index among all pages, title and key."""

    number: int
    title: Text
    key: str


class PageBar(QWidget):
    """The pages of a place side by side, and further actions on the right.

    Its height is the same for a place with one page, so that nothing below it moves. Where there is
    no room for all buttons, it has a drop-down list.
    """

    chosen = Signal(int)

    def __init__(self, more: Sequence[tuple[RailPlace, QPushButton]]) -> None:
        super().__init__()
        named(self, "page_bar", "Pages")
        self.setFixedHeight(PAGE_BAR_HEIGHT)
        self._more = tuple(more)
        self._shown: tuple[PageName, ...] = ()
        self._seen: tuple[RailPlace, tuple[PageName, ...], int] | None = None
        self.buttons: dict[int, QPushButton] = {}
        self._row = row()
        self._row.setSpacing(STEP)
        self.choice = choice("page_choice", "Pages", (), self._choose_from_list)
        self.setMinimumWidth(20 * STEP)
        self._actions = tuple(action for _, action in self._more)
        layout = row((self._row, 0), self.choice, None, *self._actions, on=self)
        layout.setContentsMargins(0, STEP, 0, STEP)
        layout.setSpacing(GAP)

    def show_pages(self, place: RailPlace, pages: Sequence[PageName], now: int) -> None:
        """Show the pages of a place; now: index of the open one, -1 for none."""
        if (place, tuple(pages), now) == self._seen:
            return
        self._seen = place, tuple(pages), now
        if tuple(pages) != self._shown:
            self._shown = tuple(pages)
            for page_button in self.buttons.values():
                # Immediately, else the window would grow for both rows together.
                self._row.removeWidget(page_button)
                page_button.hide()
                page_button.deleteLater()
            self.buttons = {page.number: self._button(page) for page in pages}
            for page_button in self.buttons.values():
                self._row.addWidget(page_button)
            self.choice.blockSignals(True)
            self.choice.clear()
            for page in pages:
                self.choice.addItem(tr(page.title), page.number)
            self.choice.blockSignals(False)
        for number, page_button in self.buttons.items():
            page_button.setChecked(number == now)
        self.choice.blockSignals(True)
        self.choice.setCurrentIndex(self.choice.findData(now))
        self.choice.blockSignals(False)
        follow_in_tab_order(self.choice, *self.buttons.values(), *self._actions)
        for action_place, action in self._more:
            action.setVisible(action_place is place)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the buttons where there is room for all of them."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        actions = [action for action in self._actions if action.isVisibleTo(self)]
        shown = [*self.buttons.values(), *actions]
        wanted = sum(widget.sizeHint().width() + GAP for widget in shown)
        fits = wanted <= self.width()
        for page_button in self.buttons.values():
            page_button.setVisible(fits)
        self.choice.setVisible(not fits)

    def _choose_from_list(self) -> None:
        self.chosen.emit(self.choice.currentData())

    def _button(self, page: PageName) -> QPushButton:
        name, title = f"page_button_{page.number}", page.title
        page_button = button(name, title, spoken=title, checkable=True)
        page_button.setToolTip(f"{tr(page.title)} ({key_text(page.key)})")
        page_button.clicked.connect(partial(self._choose, page.number))
        return page_button

    def _choose(self, number: int) -> None:
        self.buttons[number].setChecked(True)
        self.chosen.emit(number)
