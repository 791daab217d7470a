"""The window without a mouse and without eyes: each control is reached, seen to be, and named."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSpinBox,
    QComboBox,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QSlider,
    QWidget,
)

from rigapp.gui.window.tabs import TABS
from rigapp.gui.window.window import MainWindow

Attach = Callable[[], None]
CONTROLS = (
    QAbstractButton, QAbstractItemView, QAbstractSpinBox, QComboBox, QLineEdit, QPlainTextEdit,
    QSlider,
)  # fmt: skip


def controls(top: QWidget) -> list[QWidget]:
    """Return what can be pressed, chosen or typed into, of all that is seen, parts left out."""
    seen = [one for one in top.findChildren(QWidget) if one.isVisibleTo(top) and one.isEnabled()]
    found = [one for one in seen if isinstance(one, CONTROLS)]
    return [one for one in found if not isinstance(one.parentWidget(), CONTROLS)]


def tab_chain(window: QWidget) -> list[QWidget]:
    """Return what the key Tab visits, in its order."""
    chain, one = [], window.nextInFocusChain()
    while one is not window:
        if one.focusPolicy() & Qt.FocusPolicy.TabFocus and one.isVisible() and one.isEnabled():
            chain.append(one)
        one = one.nextInFocusChain()
    return chain


def reached(control: QWidget, chain: list[QWidget]) -> bool:
    """Tell whether a control is in the chain, or reached by arrows from one of its group."""
    group = control.group() if isinstance(control, QAbstractButton) else None
    by_arrows = group is not None and group.exclusive() and {*group.buttons()} & {*chain}
    return control in chain or bool(by_arrows)


@pytest.fixture
def attached(window: MainWindow, engine: Any, attach: Attach, qtbot: Any) -> MainWindow:
    engine.say(count=5, simulated=True)
    attach()
    with qtbot.waitActive(window, timeout=PATIENCE_MS):
        window.activateWindow()
    return window


def pages(window: MainWindow) -> Iterator[str]:
    """Yield the names of all pages, one after the other in sight."""
    for number, tab in enumerate(TABS):
        if window.tabs.isTabVisible(number):
            window.tabs.setCurrentIndex(number)
            yield tab.name


def test_tab_reaches_every_control_in_reading_order(attached: MainWindow) -> None:
    window = attached
    areas = (
        window.rail,
        window.messages,
        window.page_bar,
        window.tabs,
        window.side,
        window.controls,
    )
    for name in pages(window):
        chain = tab_chain(window)
        missed = [one.objectName() for one in controls(window) if not reached(one, chain)]
        assert missed == [], name
        visited = [
            next(number for number, area in enumerate(areas) if area.isAncestorOf(one))
            for one in chain
            if any(area.isAncestorOf(one) for area in areas)
        ]
        assert visited == sorted(visited), name
        assert chain[-1] is window.controls.buttons["stop"], name


def test_the_control_with_the_keyboard_shows_it(attached: MainWindow, qapp: Any) -> None:
    attached.setAttribute(Qt.WidgetAttribute.WA_KeyboardFocusChange)  # as the key Tab does
    unseen = set()
    for name in pages(attached):
        for one in controls(attached):
            attached.setFocus()
            before = one.grab().toImage()
            one.setFocus(Qt.FocusReason.TabFocusReason)
            assert one.hasFocus() or one.focusProxy() is not None, one.objectName()
            if one.grab().toImage() == before:
                unseen.add(f"{name}: {one.objectName()}")
    assert sorted(unseen) == []


def test_whatever_is_pressed_typed_or_read_has_a_name_to_be_spoken(attached: MainWindow) -> None:
    nameless = set()
    for name in pages(attached):
        for one in controls(attached):
            if not one.accessibleName() or not one.objectName():
                nameless.add(f"{name}: {type(one).__name__} {one.objectName()}")
        for label in attached.findChildren(QLabel):
            plain = label.isVisible() and label.text() and not label.buddy()
            if plain and label.objectName() and not label.accessibleName():
                nameless.add(f"{name}: {label.objectName()}")
    assert sorted(nameless) == []
