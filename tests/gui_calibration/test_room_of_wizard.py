"""Room for every word of the wizard, at each scale and size of the screen, in all languages."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from PySide6.QtCore import QPoint, QPointF, QRect
from PySide6.QtWidgets import QPushButton, QScrollArea, QWidget

from rigapp.gui.language import speak_language
from rigapp.gui.window.window import MainWindow
from rigapp.gui.wizard.scenes import Brush
from rigapp.gui.wizard.widgets import MeasuredCard
from rigapp.gui.wizard.wizard import CalibrationWizard
from rigapp.presentation.translation import ENGLISH
from rigapp.schema.messages import Reply, RunState
from tests.gui.conftest import attach, engine, light_application, no_history, window
from tests.gui.roominess import LONGEST_FIRST, SCALES, SIZES, cut_texts
from tests.gui_calibration.tour import SUBJECTS, tour, tour_of_choices

__all__ = ["attach", "engine", "light_application", "no_history", "window"]


SCREENS = [
    one if one in ("choices", "load cell") else pytest.param(one, marks=pytest.mark.long)
    for one in ("choices", *SUBJECTS)
]
"""The guide with most pages by default, the others too in `make long`."""


@pytest.fixture(autouse=True)
def _english_afterwards(qapp: Any) -> Iterator[None]:
    yield
    speak_language(qapp, ENGLISH)


@pytest.fixture
def drawn_outside(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return what pictures have drawn beyond their edge."""
    found: list[str] = []
    draw = Brush.words

    def words(self: Brush, at: QPointF, text: str, *more: Any) -> None:
        draw(self, at, text, *more)
        metrics = self.painter.fontMetrics()
        place = QRect(QPoint(), metrics.size(0, text))
        place.moveCenter(at.toPoint())
        if not self.painter.window().contains(place):
            found.append(f"{text} at {place.getRect()} of {self.painter.window().getRect()}")

    monkeypatch.setattr(Brush, "words", words)
    return found


def out_of_sight(top: MainWindow, wizard: QWidget) -> Iterator[str]:
    """Yield what leads on and is not seen, and pages that would have to be scrolled sideways."""
    for area in wizard.findChildren(QScrollArea, "guide_page"):
        inside = area.widget()
        if area.isVisibleTo(top) and inside.minimumSizeHint().width() > area.viewport().width():
            yield f"{inside.minimumSizeHint().width()} of {area.viewport().width()} pixels"
    stage = top.stage
    if wizard.minimumSizeHint().width() > stage.width():
        yield "wider than the window"
    for card in wizard.findChildren(MeasuredCard):
        needed = card.heightForWidth(card.width())
        if card.isVisibleTo(top) and card.height() < needed:
            yield f"{card.objectName()}: {card.height()} of {needed} pixels high"
    leading = [
        one
        for one in wizard.findChildren(QPushButton)
        if one.property("rank") == "primary" and one.isVisibleTo(top)
    ]
    if len(leading) != isinstance(wizard, CalibrationWizard):
        yield f"{len(leading)} primary buttons"
    for one in leading:
        place = QRect(one.mapTo(stage, QPoint()), one.size())
        if not stage.rect().contains(place):
            yield f"{one.text()} is beyond the window"


@pytest.mark.sampled
@pytest.mark.parametrize("language", LONGEST_FIRST)
@pytest.mark.parametrize("subject", SCREENS)
def test_no_text_of_a_page_is_cut_at_any_scale_and_size(
    subject: str,
    language: str,
    qapp: Any,
    drawn_outside: list[str],
    tmp_path: Path,
    request: pytest.FixtureRequest,
) -> None:
    """A scale leaves so many fewer pixels to the window; themes share all that has a size."""
    speak_language(qapp, language)
    window: MainWindow = request.getfixturevalue("window")
    told: Callable[[], None] = request.getfixturevalue("attach")
    scripted = request.getfixturevalue("engine")
    scripted.reply = Reply(ok=False, sentence="There are no signals.")
    scripted.say(count=0, curves=False, state=RunState.READY, file="")
    told()
    cut = set()
    pages = tour_of_choices(window) if subject == "choices" else tour(window, tmp_path, subject)
    for name, wizard in pages:
        for scale, size in product(SCALES, SIZES):
            window.resize(int(size[0] / scale), int(size[1] / scale))
            qapp.processEvents()
            qapp.processEvents()
            wrong = [*cut_texts(wizard), *out_of_sight(window, wizard), *drawn_outside]
            drawn_outside.clear()
            cut |= {f"{name}, {scale:g} {size[0]}: {one}" for one in wrong}
    assert sorted(cut) == []
