"""Make widgets with both their names: the stable one, and the one that is read aloud."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Any, TypeVar

from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QBoxLayout,
    QComboBox,
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

from rigapp.gui.look.tokens import GAP, STEP
from rigapp.gui.widgets.guarded import GuardedButton
from rigapp.gui.widgets.wheel import steady_field
from rigapp.presentation.translation import Text, tr

Made = TypeVar("Made", bound=QWidget)
Layout = TypeVar("Layout", bound=QBoxLayout)
Item = QWidget | QLayout | Text | None

HINT_FRAME = 4 * STEP
"""Around the hint of a line: its edges, and the sign that empties it."""
Called = Callable[..., Any]


def named(widget: Made, name: str, spoken: Text, tip: Text = "") -> Made:
    """Give a widget its names, and a tool tip where there is one."""
    widget.setObjectName(name)
    widget.setAccessibleName(tr(spoken))
    if tip:
        widget.setToolTip(tr(tip))
    return widget


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
    """Return a button; guarded: closed while another viewer is in command.

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


def whole_number(name: str, spoken: Text, low: int, high: int) -> QSpinBox:
    """Return a field for a whole number, read when it is complete."""
    made = named(steady_field(QSpinBox()), name, spoken)
    made.setRange(low, high)
    made.setGroupSeparatorShown(True)
    made.setKeyboardTracking(False)
    return made


def prose(name: str, spoken: Text, text: Text = "") -> QLabel:
    """Return a label for whole sentences."""
    made = named(QLabel(tr(text)), name, spoken)
    made.setTextFormat(Qt.TextFormat.PlainText)
    made.setWordWrap(True)
    made.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)
    return made


def row(*items: Item | tuple[Item, int], on: QWidget | None = None) -> QHBoxLayout:
    """Return items side by side; see ``filled``."""
    return filled(QHBoxLayout(on) if on is not None else QHBoxLayout(), items)


def column(*items: Item | tuple[Item, int], on: QWidget | None = None) -> QVBoxLayout:
    """Return items below each other, close together; see ``filled``."""
    made = filled(QVBoxLayout(on) if on is not None else QVBoxLayout(), items)
    made.setContentsMargins(0, 0, 0, 0)
    made.setSpacing(2)
    return made


def signed(size: QSize, text: QLabel, line: QLabel, on: QWidget) -> QLabel:
    """Lay a sign beside a text with a line in small below it; return the sign."""
    sign = QLabel()
    sign.setFixedSize(size)
    line.setProperty("role", "caption")
    words = column(text, line)
    words.setSpacing(0)
    row(sign, (words, 1), on=on).setContentsMargins(0, 0, 0, 0)
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
