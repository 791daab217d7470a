"""Room for every word: at each scale and size of the screen, in both themes and all languages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import (
    QAbstractButton,
    QCheckBox,
    QComboBox,
    QHeaderView,
    QLabel,
    QLineEdit,
    QTableView,
    QWidget,
)

from rigapp.gui.language.catalogue import ENGLISH, LANGUAGES, speak_language
from rigapp.gui.look.tokens import THEMES
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.window.tabs import NUMBERS
from rigapp.gui.window.window import MainWindow
from rigapp.schema.alarms import because
from rigapp.schema.messages import Alarm, Recovery, Remedy, RunState, Severity

SCALES = (1.0, 1.5, 2.0)
SIZES = ((1366, 768), (1920, 1080))

OF_ANY_LENGTH = {"identity", "identity_line", "answer", "state_detail", "alarms_detail"}
"""Labels of what others have named or told: cut with an ellipsis, whole in the tool tip."""


@pytest.fixture(autouse=True)
def _english_afterwards(qapp: Any) -> Iterator[None]:
    yield
    speak_language(qapp, ENGLISH)


def cut_texts(top: QWidget) -> list[str]:
    """Return what has less room than its words need, of all that is to be seen."""
    return [
        f"{one.objectName() or type(one).__name__}: {why}"
        for one in top.findChildren(QWidget)
        if one.isVisibleTo(top) and (why := _cut(one))
    ]


def _cut(one: QWidget) -> str:
    metrics, room = QFontMetrics(one.font()), one.contentsRect().width()
    if isinstance(one, ElidedLabel):
        cut = one.text().endswith("…") and not one.whole.endswith("…")
        return one.text() if cut and one.objectName() not in OF_ANY_LENGTH else ""
    if isinstance(one, QLabel) and one.text():
        if one.wordWrap():
            return one.text() if one.heightForWidth(one.width()) > one.height() + 1 else ""
        plain = one.textFormat() is Qt.TextFormat.RichText
        wide = metrics.size(Qt.TextFlag.TextShowMnemonic, one.text()).width()
        return "" if plain or wide <= room + 1 else one.text()
    if isinstance(one, QCheckBox | QAbstractButton) and one.text():
        return one.text() if one.sizeHint().width() > one.width() + 1 else ""
    if isinstance(one, QComboBox):
        wide = metrics.horizontalAdvance(one.currentText())
        return one.currentText() if wide > one.width() - 24 else ""
    if isinstance(one, QLineEdit) and one.placeholderText():
        wide = metrics.horizontalAdvance(one.placeholderText())
        return one.placeholderText() if wide > one.width() - 16 else ""
    if isinstance(one, QTableView) and one.horizontalHeader().isVisible():
        return ", ".join(_cut_headings(one.horizontalHeader()))
    return ""


def _cut_headings(header: QHeaderView) -> Iterator[str]:
    for at in range(header.count()):
        if not header.isSectionHidden(at) and header.sectionSizeHint(at) > header.sectionSize(at):
            yield str(header.model().headerData(at, Qt.Orientation.Horizontal))


def tripped() -> dict[str, Any]:
    """Return the status after an overload, which asks for the longest words of the shell."""
    cause = because("overload", force_N=391.04, limit_N=380.0)
    alarm = Alarm(
        cause.key,
        Severity.CRITICAL,
        cause.title,
        cause.sentence,
        cause.kind.consequence,
        cause.kind.action,
        1.8e9,
        1200,
        first_out=True,
    )
    step = 'Acknowledge "Overload": say that you have seen it.'
    left = (Remedy.ACKNOWLEDGE, Remedy.RESET, Remedy.GO_ON)
    told = Recovery(Remedy.ACKNOWLEDGE, "acknowledge", step, left)
    return {
        "state": RunState.FAULT, "reason": cause.sentence, "alarms": (alarm,), "recovery": told
    }  # fmt: skip


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_text_is_cut_at_any_scale_size_and_theme(
    language: str, qapp: Any, engine: Any, request: pytest.FixtureRequest
) -> None:
    """Try all twelve at which one may look; a scale leaves so many fewer pixels to the window."""
    speak_language(qapp, language)
    window: MainWindow = request.getfixturevalue("window")
    attach: Callable[[], None] = request.getfixturevalue("attach")
    window.tabs.setCurrentIndex(NUMBERS["log"])  # of the place with the side column; draws little
    cut = set()
    for number, (theme, scale, size) in enumerate(product(THEMES.values(), SCALES, SIZES)):
        if theme is not window.theme:
            window.dress(theme)
        window.resize(int(size[0] / scale), int(size[1] / scale))
        for turn, situation in enumerate(({}, tripped(), {"state": RunState.CONNECTING})):
            engine.say(first=3 * number + turn + 1, count=1, curves=False, **situation)
            attach()
            qapp.processEvents()
            assert (window.width(), window.height()) == (int(size[0] / scale), int(size[1] / scale))
            shell = (window.header, window.messages, window.controls, window.side, window.rail)
            for part in (*shell, window.page_bar):
                edge = part.mapTo(window, part.rect().bottomRight())
                assert edge.x() < window.width()
                assert edge.y() < window.height()
                cut |= {f"{scale:g} {size[0]} {theme.name}: {one}" for one in cut_texts(part)}
    assert sorted(cut) == []
