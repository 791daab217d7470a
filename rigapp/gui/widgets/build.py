"""Make widgets with both their names: the stable one, and the one that is read aloud."""

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
"""Left and right of a button's words: edges and padding, see ``look.sheet``."""
HINT_FRAME = 4 * STEP
"""Around the hint of a line: its edges, and the sign that empties it."""
Called = Callable[..., Any]


class GuardedButton(QPushButton):
    """A button that changes something at the rig: closed while another viewer has control.

    What the panel wants (``setEnabled``, ``setToolTip``) is kept and comes back afterwards.
    """

    def __init__(self, text: str = "") -> None:
        super().__init__(text)
        self._wanted = True
        self._tip = ""
        self._why = ""

    def setEnabled(self, enabled: bool) -> None:
        """Enable it, unless it is forbidden."""
        self._wanted = enabled
        allowed = enabled and not self._why
        if allowed != self.isEnabled():
            around = self.parentWidget()
            if not allowed and self.hasFocus() and around is not None:
                # Qt would give the focus to the next field, and scroll the page to it.
                around.setFocus()
            super().setEnabled(allowed)
            if allowed and around is not None and around.hasFocus():
                self.setFocus()

    def setToolTip(self, tip: str) -> None:
        """Take the tool tip; while forbidden, the reason is shown in its place."""
        self._tip = tip
        self._show()

    def forbid(self, why: str) -> None:
        """Close the button with a reason; an empty reason opens it again."""
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
    """Leave the wheel over a field to the page unless the field has the focus."""

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Keep the wheel from a field without the focus."""
        if event.type() is not QEvent.Type.Wheel or not isinstance(watched, QWidget):
            return False
        if watched.hasFocus():
            return False
        event.ignore()
        return True


def steady_field(field: Field) -> Field:
    """Return a field that takes the wheel with the focus only, its number where texts begin."""
    field.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    field.installEventFilter(WheelGuard(field))
    if isinstance(field, QAbstractSpinBox):
        # A style sheet's padding does not reach the line inside.
        field.lineEdit().setTextMargins(STEP - 2, 0, 0, 0)
    return field


def named(widget: Made, name: str, spoken: Text, tip: Text = "", *, role: str = "") -> Made:
    """Set a widget's names, its tool tip where there is one, and its role (see ``look.sheet``)."""
    widget.setObjectName(name)
    widget.setAccessibleName(tr(spoken))
    if role:
        widget.setProperty("role", role)
    if tip:
        widget.setToolTip(tr(tip))
    return widget


def key_text(key: str) -> str:
    """Return a key as keyboards of the window's language bear it: "Strg+5" in German."""
    return QKeySequence(key).toString(QKeySequence.SequenceFormat.NativeText)


def tell(widget: QWidget, name: str, value: object) -> None:
    """Tell a widget what it is now (see ``look.sheet``); it is styled anew where that changed."""
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
    """Return a button; guarded: closed while another viewer has control.

    rank: primary, dangerous or quiet (see ``look.sheet``), ordinary unless told.

    spoken: its text without access key and dots unless told. A checkable button calls with its
    new state, any other without arguments.
    """
    text = tr(text)
    plain = text.replace("&", "").rstrip("…").strip()
    kind = GuardedButton if guarded else QPushButton
    made = named(kind(text), name, spoken or plain, tip)
    if rank:
        made.setProperty("rank", rank)
    if checkable:
        made.setCheckable(True)
        # Chosen, its words are bold (``look.sheet``): it keeps the room for them.
        bold = made.font()
        bold.setWeight(QFont.Weight.DemiBold)
        words = QFontMetrics(bold).size(Qt.TextFlag.TextShowMnemonic, text).width()
        made.setMinimumWidth(words + BUTTON_FRAME)
        if call is not None:
            made.toggled.connect(call)
    elif call is not None:
        # A method is held weakly by the signal, which a function around it would not be.
        made.clicked.connect(call if inspect.ismethod(call) else lambda: call())
    return made


def edit(
    name: str, spoken: Text, changed: Called | None = None, *, hint: Text = "", most: int = 0
) -> QLineEdit:
    """Return a line to type in; most: characters it takes, 0 for any number."""
    made = named(QLineEdit(), name, spoken)
    made.setPlaceholderText(tr(hint))
    if most:
        made.setMaxLength(most)
    if changed is not None:
        made.textChanged.connect(changed)
    return made


def fit_hint(line: QLineEdit) -> None:
    """Give a line the room that its hint needs."""
    hint = line.fontMetrics().horizontalAdvance(line.placeholderText())
    line.setMinimumWidth(hint + HINT_FRAME)


def choice(
    name: str, spoken: Text, items: Iterable[tuple[Text, Any]], chosen: Called | None = None
) -> QComboBox:
    """Return a box to choose from; items: text and the value that it stands for."""
    made = named(steady_field(QComboBox()), name, spoken)
    made.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
    for text, value in items:
        made.addItem(tr(text), value)
    if chosen is not None:
        made.currentIndexChanged.connect(chosen)
    return made


def searched(box: QComboBox) -> QComboBox:
    """Let a box of many items be searched: what is typed may stand anywhere in an item's words."""
    box.setEditable(True)
    box.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
    line, found = box.lineEdit(), box.completer()
    assert line is not None  # an editable box has both
    assert found is not None
    line.setObjectName(f"{box.objectName()}_search")
    line.setAccessibleName(box.accessibleName())
    found.setFilterMode(Qt.MatchFlag.MatchContains)
    found.setCompletionMode(QCompleter.CompletionMode.PopupCompletion)
    found.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
    # What names no item is no choice: the one that holds comes back.
    line.editingFinished.connect(lambda: box.setEditText(box.itemText(box.currentIndex())))
    return box


def add_group(box: QComboBox, items: Mapping[str, str]) -> None:
    """Add items, names and words, to a box; a line parts them from those before."""
    if box.count() and items:
        box.insertSeparator(box.count())
    for name, text in items.items():
        box.addItem(text, name)


def choose(box: QComboBox, name: object) -> None:
    """Choose an item by its name; the first one for None, or where there is none of that name.

    Lines between groups have no name: None must not find one of them.
    """
    box.setCurrentIndex(0 if name is None else max(box.findData(name), 0))


def whole_number(name: str, spoken: Text, low: int, high: int) -> QSpinBox:
    """Return a field for a whole number, read when it is complete."""
    made = named(steady_field(QSpinBox()), name, spoken)
    made.setRange(low, high)
    made.setGroupSeparatorShown(True)
    made.setKeyboardTracking(False)
    return made


def styled_label(text: Text, role: str) -> QLabel:
    """Return a label that names what stands beside or below it; role: see ``look.sheet``."""
    made = QLabel(tr(text))
    made.setProperty("role", role)
    return made


def prose(name: str, spoken: Text, text: Text = "", *, role: str = "") -> QLabel:
    """Return a label for whole sentences."""
    made = named(QLabel(tr(text)), name, spoken, role=role)
    made.setTextFormat(Qt.TextFormat.PlainText)
    made.setWordWrap(True)
    made.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
    return made


def row(
    *items: Item | tuple[Item, int],
    on: QWidget | None = None,
    margins: Margins | None = None,
    spacing: int | None = None,
) -> QHBoxLayout:
    """Return items side by side, by default with the style's distances; see ``filled``."""
    made = filled(QHBoxLayout(on) if on is not None else QHBoxLayout(), items)
    return spaced(made, margins, spacing)


def column(
    *items: Item | tuple[Item, int],
    on: QWidget | None = None,
    margins: Margins = 0,
    spacing: int = 2,
) -> QVBoxLayout:
    """Return items below each other, by default close together; see ``filled``."""
    made = filled(QVBoxLayout(on) if on is not None else QVBoxLayout(), items)
    return spaced(made, margins, spacing)


def spaced(layout: Layout, margins: Margins | None, spacing: int | None) -> Layout:
    """Set the distances of a layout, in pixels; None leaves what the style says.

    margins: on all sides; or beside, above and below; or left, top, right, bottom.
    """
    if isinstance(margins, int):
        layout.setContentsMargins(margins, margins, margins, margins)
    elif margins is not None:
        layout.setContentsMargins(*(margins if len(margins) == 4 else margins * 2))
    if spacing is not None:
        layout.setSpacing(spacing)
    return layout


def signed(size: QSize, text: QLabel, line: QLabel, on: QWidget) -> QLabel:
    """Lay a sign beside a text with a line in small below it; return the sign."""
    sign = QLabel()
    sign.setFixedSize(size)
    line.setProperty("role", "caption")
    words = column(text, line, spacing=0)
    row(sign, (words, 1), on=on, margins=0)
    return sign


def filled(layout: Layout, items: Sequence[Item | tuple[Item, int]]) -> Layout:
    """Fill a layout: widgets and layouts, with their stretch where it is not 0, captions as texts.

    A text is the caption of the widget after it and has its access key; None is room to stretch.
    """
    caption: QLabel | None = None
    for one in items:
        item, stretch = one if isinstance(one, tuple) else (one, 0)
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
    """Let the key Tab visit widgets one after the other, after the first one's place."""
    for first, then in pairwise(widgets):
        QWidget.setTabOrder(first, then)


def page(*items: Item | tuple[Item, int]) -> QWidget:
    """Return a widget that holds items below each other."""
    made = QWidget()
    column(*items, on=made)
    return made


def scrolling(name: str, spoken: Text, inside: QWidget) -> QScrollArea:
    """Return what scrolls up and down only, and takes what height there is."""
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
    """Return parts with movable borders between them."""
    made = named(QSplitter(orientation), name, spoken)
    made.setChildrenCollapsible(False)
    made.setHandleWidth(GAP)
    for part in parts:
        made.addWidget(part)
    made.setSizes(list(sizes))
    return made


def take_away(line: QWidget, layout: QBoxLayout) -> None:
    """Take a line out of a list and destroy it; it is hidden at once, not at the next event."""
    layout.removeWidget(line)
    line.hide()
    line.deleteLater()


def choose_paths(
    parent: QWidget, title: Text, chosen: Called, mode: QFileDialog.FileMode, files: Text = ""
) -> None:
    """Let somebody choose files or a folder, beside the window, so that Stop can be pressed.

    chosen: called with the paths, a list of texts. files: what they are, with their endings.
    """
    dialog = QFileDialog(parent, tr(title), filter=tr(files))
    dialog.setFileMode(mode)
    dialog.filesSelected.connect(chosen)
    dialog.finished.connect(dialog.deleteLater)
    dialog.setModal(False)
    dialog.show()
