"""Make widgets with object name and accessible name (read aloud)."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any, TypeVar

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtGui import QFont, QFontMetrics, QKeySequence
from PySide6.QtWidgets import (
    QAbstractSpinBox,
    QBoxLayout,
    QComboBox,
    QCompleter,
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QLayout,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QSpinBox,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from rigapp.presentation.tokens import GAP, STEP
from rigapp.presentation.translation import Text, tr

Made = TypeVar("Made", bound=QWidget)
Layout = TypeVar("Layout", bound=QBoxLayout)
Field = TypeVar("Field", bound=QComboBox | QAbstractSpinBox)
Item = QWidget | QLayout | Text | None
Margins = int | tuple[int, int] | tuple[int, int, int, int]

BUTTON_FRAME = 26
"""Horizontal space of a button besides its text: edges and padding, see ``look.dress``."""
HINT_FRAME = 4 * STEP
"""Horizontal space of a line besides its hint: edges, and the button that clears it."""
Called = Callable[..., Any]


class GuardedButton(QPushButton):
    """A button that changes the rig: disabled while another viewer has control.

    Calls of ``setEnabled`` and ``setToolTip`` meanwhile take effect afterwards.
    """

    def __init__(self, text: str = "") -> None:
        super().__init__(text)
        self._wanted = True
        self._tip = ""
        self._why = ""

    def setEnabled(self, enabled: bool) -> None:
        """Enable the button, unless it is forbidden."""
        self._wanted = enabled
        allowed = enabled and not self._why
        if allowed != self.isEnabled():
            parent = self.parentWidget()
            if not allowed and self.hasFocus() and parent is not None:
                # Else Qt gives the focus to the next field and scrolls the page to it.
                parent.setFocus()
            super().setEnabled(allowed)
            if allowed and parent is not None and parent.hasFocus():
                self.setFocus()

    def setToolTip(self, tip: str) -> None:
        """Set the tool tip; while forbidden, the reason replaces it."""
        self._tip = tip
        self._show()

    def forbid(self, why: str) -> None:
        """Disable the button with a reason; an empty reason enables it again."""
        if why != self._why:
            self._why = why
            self.setEnabled(self._wanted)
            self._show()

    def _show(self) -> None:
        shown = self._why or self._tip
        if shown != self.toolTip():
            super().setToolTip(shown)
            self.setAccessibleDescription(shown)


class WheelGuard(QObject):
    """Pass the wheel over a field to the page unless the field has the focus."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Block the wheel for a field without the focus."""
        if event.type() is not QEvent.Type.Wheel or not isinstance(watched, QWidget):
            return False
        if watched.hasFocus():
            return False
        event.ignore()
        return True


def steady_field(field: Field) -> Field:
    """Return a field that accepts the wheel only with the focus, its number aligned with texts."""
    field.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    field.installEventFilter(WheelGuard(field))
    if isinstance(field, QAbstractSpinBox):
        # The padding of a style sheet does not apply to the line edit inside.
        field.lineEdit().setTextMargins(STEP - 2, 0, 0, 0)
    return field


def named(widget: Made, name: str, spoken: Text, tip: Text = "", *, role: str = "") -> Made:
    """Set a widget's names, its tool tip where there is one, and its role (see ``look.dress``)."""
    widget.setObjectName(name)
    widget.setAccessibleName(tr(spoken))
    if role:
        widget.setProperty("role", role)
    if tip:
        widget.setToolTip(tr(tip))
    return widget


def key_text(key: str) -> str:
    """Return a key as named on keyboards of the window's language: "Strg+5" in German."""
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)


def set_property(widget: QWidget, name: str, value: object) -> None:
    """Set a property of a widget (see ``look.dress``); polish the widget where it changed."""
    if widget.property(name) != value:
        widget.setProperty(name, value)
        style = widget.style()
        style.unpolish(widget)
        style.polish(widget)


def button(
    name: str,
    text: Text,
    call: Called | None = None,
    spoken: Text = "",
    *,
    tip: Text = "",
    guarded: bool = False,
    checkable: bool = False,
    rank: str = "",
) -> QPushButton:
    """Return a button; guarded: disabled while another viewer has control.

    rank: primary, dangerous or quiet (see ``look.dress``), by default ordinary. spoken: by default
    its text without access key and dots. A checkable button calls with its new state, any other
    without arguments.
    """
    text = tr(text)
    plain = text.replace("&", "").rstrip("…").strip()
    kind = GuardedButton if guarded else QPushButton
    control = named(kind(text), name, spoken or plain, tip)
    if rank:
        control.setProperty("rank", rank)
    if checkable:
        control.setCheckable(True)
        # When checked its text is bold (``look.dress``): reserve the room for it.
        bold = control.font()
        bold.setWeight(QFont.Weight.DemiBold)
        words = QFontMetrics(bold).size(Qt.TextFlag.TextShowMnemonic, text).width()
        control.setMinimumWidth(words + BUTTON_FRAME)
        if call is not None:
            control.toggled.connect(call)
    elif call is not None:
        # A signal references a method weakly, but a function around it strongly.
        control.clicked.connect(call if inspect.ismethod(call) else lambda: call())
    return control


def edit(
    name: str, spoken: Text, changed: Called | None = None, *, hint: Text = "", most: int = 0
) -> QLineEdit:
    """Return a line edit; most: maximum number of characters, 0 without limit."""
    line = named(QLineEdit(), name, spoken)
    line.setPlaceholderText(tr(hint))
    if most:
        line.setMaxLength(most)
    if changed is not None:
        line.textChanged.connect(changed)
    return line


def fit_hint(line: QLineEdit) -> None:
    """Set the minimum width of a line to that of its hint."""
    hint = line.fontMetrics().horizontalAdvance(line.placeholderText())
    line.setMinimumWidth(hint + HINT_FRAME)


def choice(
    name: str, spoken: Text, items: Iterable[tuple[Text, Any]], chosen: Called | None = None
) -> QComboBox:
    """Return a combo box; items: text and value."""
    box = named(steady_field(QComboBox()), name, spoken)
    box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
    for text, value in items:
        box.addItem(tr(text), value)
    if chosen is not None:
        box.currentIndexChanged.connect(chosen)
    return box


def searched(box: QComboBox) -> QComboBox:
    """Make a box of many items searchable by any part of an item's text."""
    box.setEditable(True)
    box.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
    line, completer = box.lineEdit(), box.completer()
    assert line is not None  # an editable box has both
    assert completer is not None
    line.setObjectName(f"{box.objectName()}_search")
    line.setAccessibleName(box.accessibleName())
    completer.setFilterMode(Qt.MatchFlag.MatchContains)
    completer.setCompletionMode(QCompleter.CompletionMode.PopupCompletion)
    completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
    # A text without an item selects nothing: restore that of the present item.
    line.editingFinished.connect(lambda: box.setEditText(box.itemText(box.currentIndex())))
    return box


def add_group(box: QComboBox, items: Mapping[str, str]) -> None:
    """Add items (name and text) to a box after a separator."""
    if box.count() and items:
        box.insertSeparator(box.count())
    for name, text in items.items():
        box.addItem(text, name)


def choose(box: QComboBox, name: object) -> None:
    """Select an item by its name; the first one for None or an unknown name.

    Separators have no name: None must not find one of them.
    """
    box.setCurrentIndex(0 if name is None else max(box.findData(name), 0))


def whole_number(name: str, spoken: Text, low: int, high: int) -> QSpinBox:
    """Return a field for an integer, whose value changes when editing is finished."""
    box = named(steady_field(QSpinBox()), name, spoken)
    box.setRange(low, high)
    box.setGroupSeparatorShown(True)
    box.setKeyboardTracking(False)
    return box


def styled_label(text: Text, role: str) -> QLabel:
    """Return a caption for the widget beside or below it; role: see ``look.dress``."""
    label = QLabel(tr(text))
    label.setProperty("role", role)
    return label


def prose(name: str, spoken: Text, text: Text = "", *, role: str = "") -> QLabel:
    """Return a label for whole sentences."""
    label = named(QLabel(tr(text)), name, spoken, role=role)
    label.setTextFormat(Qt.TextFormat.PlainText)
    label.setWordWrap(True)
    label.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
    return label


def row(
    *items: Item | tuple[Item, int],
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | None = None,
) -> QHBoxLayout:
    """Return a row of items, by default with the style's spacing; see ``filled``."""
    layout = filled(QHBoxLayout(on) if on is not None else QHBoxLayout(), items)
    return spaced(layout, margins, spacing)


def column(
    *items: Item | tuple[Item, int],
    on: QWidget | None = None,
    margins: Margins = 0,
    spacing: int = 2,
) -> QVBoxLayout:
    """Return a column of items, by default with small spacing; see ``filled``."""
    layout = filled(QVBoxLayout(on) if on is not None else QVBoxLayout(), items)
    return spaced(layout, margins, spacing)


def spaced(layout: Layout, margins: Margins | None, spacing: int | None) -> Layout:
    """Set margins and spacing of a layout in pixels; None keeps those of the style.

    margins: all sides; or horizontal and vertical; or left, top, right, bottom.
    """
    if isinstance(margins, int):
        layout.setContentsMargins(margins, margins, margins, margins)
    elif margins is not None:
        layout.setContentsMargins(*(margins if len(margins) == 4 else margins * 2))
    if spacing is not None:
        layout.setSpacing(spacing)
    return layout


def signed(size: QSize, text: QLabel, line: QLabel, on: QWidget) -> QLabel:
    """Lay out a sign beside a text with a small line below it; return the sign."""
    sign = QLabel()
    sign.setFixedSize(size)
    line.setProperty("role", "caption")
    words = column(text, line, spacing=0)
    row(sign, (words, 1), on=on, margins=0)
    return sign


def filled(layout: Layout, items: Sequence[Item | tuple[Item, int]]) -> Layout:
    """Add items to a layout: widgets and layouts, optionally with a stretch, and texts.

    A text is the caption of the next widget, with its access key; None is a stretchable space.
    """
    caption: QLabel | None = None
    for entry in items:
        item, stretch = entry if isinstance(entry, tuple) else (entry, 0)
        if item is None:
            layout.addStretch(1)
        elif isinstance(item, str):
            caption = QLabel(tr(item))
            layout.addWidget(caption, stretch)
        elif isinstance(item, QLayout):
            layout.addLayout(item, stretch)
        else:
            if caption is not None:
                caption.setBuddy(item)
                caption = None
            layout.addWidget(item, stretch)
    return layout


def follow_in_tab_order(*widgets: QWidget) -> None:
    """Set the tab order of widgets, one after the other from the position of the first."""
    for first, then in pairwise(widgets):
        QWidget.setTabOrder(first, then)


def page(*items: Item | tuple[Item, int]) -> QWidget:
    """Return a widget that holds items below each other."""
    widget = QWidget()
    column(*items, on=widget)
    return widget


def scrolling(name: str, spoken: Text, inside: QWidget) -> QScrollArea:
    """Return an area that scrolls vertically only, and takes the available height."""
    area = named(QScrollArea(), name, spoken)
    area.setWidgetResizable(True)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    area.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Ignored)
    area.setWidget(inside)
    area.viewport().setAutoFillBackground(False)
    inside.setAutoFillBackground(False)
    return area


def split(
    name: str,
    orientation: Qt.Orientation,
    sizes: Sequence[int],
    *parts: QWidget,
    spoken: Text = "Divided panels",
) -> QSplitter:
    """Return a splitter with parts."""
    splitter = named(QSplitter(orientation), name, spoken)
    splitter.setChildrenCollapsible(False)
    splitter.setHandleWidth(GAP)
    for part in parts:
        splitter.addWidget(part)
    splitter.setSizes(list(sizes))
    return splitter


def take_away(line: QWidget, layout: QBoxLayout) -> None:
    """Remove a line from a list and delete it; it is hidden immediately, not at the next event."""
    layout.removeWidget(line)
    line.hide()
    line.deleteLater()


def choose_paths(
    parent: QWidget, title: Text, chosen: Called, mode: QFileDialog.FileMode, files: Text = ""
) -> None:
    """Show a dialog for files or a folder, not modal, so that Stop can be pressed.

    chosen: called with the paths, a list of texts. files: their description, with suffixes.
    """
    dialog = QFileDialog(parent, tr(title), filter=tr(files))
    dialog.setFileMode(mode)
    dialog.filesSelected.connect(chosen)
    dialog.finished.connect(dialog.deleteLater)
    dialog.setModal(False)
    dialog.show()
