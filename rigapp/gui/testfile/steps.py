"""The steps of preparing a test: which sections stand in each, and the bar that shows them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QFrame, QLabel, QPushButton, QWidget

from rigapp.config.ranges import unit_of
from rigapp.config.recipe import TestFile
from rigapp.config.rules import ALWAYS
from rigapp.gui.widgets.build import choice, column, named, row, tell
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.presentation.numbers import grouped, unit_text
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr
from rigapp.schema.criteria import CRITERIA

HEIGHT = 7 * STEP
SIGN_ROOM = 6 * STEP
"""Of a step, in pixels: its sign, and what is around it and its words."""
NAMED_BY_OTHERS = 1
"""The words of so many first steps are names that others have chosen: they may be cut."""


@dataclass(frozen=True, slots=True)
class PrepareStep:
    """One step: its name, its sections, and what it says of a usable test in a few words."""

    title: Text
    sections: tuple[str, ...]
    words: Callable[[TestFile], str]


def _run_words(test: TestFile) -> str:
    count = grouped(test.run.revolutions)
    if test.run.step:
        return tr("{} in {} steps", count, len(test.run.step))
    return tr("{} at {:g} rpm", count, test.run.speed_rpm)


def _record_words(test: TestFile) -> str:
    cycles = test.cycles
    if cycles.schedule == "every":
        return tr("every {}th", grouped(cycles.every_revolutions))
    if cycles.schedule == "logarithmic":
        return tr("{} a decade", cycles.per_decade)
    return tr("no cycles")


def _stop_words(test: TestFile) -> str:
    """Return the first criterion that is set, and what it is set to."""
    for key, one in CRITERIA.items():
        level = getattr(test.stop, key)
        if level is not None:
            return f"{tr(one.title)} {level:g} {unit_text(unit_of(f'stop.{key}'))}"
    return tr("after the last one")


STEPS = (
    PrepareStep(
        "Specimen", ("", "metadata"), lambda test: test.metadata.specimen or tr("not named")
    ),
    PrepareStep(
        "Run",
        ("run",),
        _run_words,
    ),
    PrepareStep(
        "Stop",
        ("stop",),
        _stop_words,
    ),
    PrepareStep("Limits", ("limits",), lambda test: f"{len(ALWAYS)} + {len(test.limits.rule)}"),
    PrepareStep("Record", ("cycles",), _record_words),
    PrepareStep(
        "Model",
        ("prediction",),
        lambda test: tr(test.prediction.joint) if test.prediction.enabled else tr("off"),
    ),
)
"""The last one has, folded, every section that stands in no other."""

MODEL = len(STEPS) - 1

STATES: Final[dict[str, Text]] = {"done": "done", "now": "now", "later": "later", "wrong": "wrong"}


class StepButton(QPushButton):
    """Show one step: a tick when it is right, its number, or a cross; name and a few words."""

    def __init__(self, place: int, title: Text) -> None:
        super().__init__()
        self._place, self._title = place, title
        named(self, f"step_{title.lower()}", title).setProperty("rank", "step")
        self.setCheckable(True)
        self.setAutoExclusive(True)
        self.setFixedHeight(HEIGHT)
        self.mark = QLabel(str(place + 1))
        self.mark.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.mark.setProperty("mark", "later")
        self.title = ElidedLabel(f"step_{title.lower()}_title", title)
        self.title.show_text(title)
        self.title.setProperty("role", "title")
        self.words = ElidedLabel(f"step_{title.lower()}_words", tr("{} in short", tr(title)))
        self.words.setProperty("role", "caption")
        texts = column(None, self.title, self.words, None, spacing=0)
        row(self.mark, (texts, 1), on=self, margins=(STEP, 0, STEP // 2, 0), spacing=STEP)
        for one in (self.mark, self.title, self.words):
            one.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    @property
    def room(self) -> tuple[int, int]:
        """Return the widths that it needs without and with its words, in pixels."""
        title, words = (
            one.fontMetrics().horizontalAdvance(one.whole) for one in (self.title, self.words)
        )
        return SIGN_ROOM + title, SIGN_ROOM + max(title, words)

    @property
    def listed(self) -> str:
        """Return the step as a line of a list."""
        return "  ".join(filter(None, (self.mark.text(), self.title.whole, self.words.whole)))

    def show_step(self, state: str, words: str) -> None:
        """Show a state (done, now, later, wrong) and a few words."""
        tell(self.mark, "mark", state)
        self.mark.setText({"done": "\u2713", "wrong": "\u2717"}.get(state, str(self._place + 1)))
        self.words.show_text(words)
        self.setAccessibleName(tr("Step {}, {}: {}", self._place + 1, tr(self._title), words))
        self.setAccessibleDescription(tr(STATES[state]))


class StepBar(QFrame):
    """The steps in a row; one of them is shown.

    Where there is no room for their words the names stand alone, and where there is none for the
    names either, a list to choose from takes their place.
    """

    chosen = Signal(int)

    def __init__(self, titles: Sequence[Text]) -> None:
        super().__init__()
        named(self, "steps", "Steps of preparing a test", role="card")
        self._offered = len(titles)
        self.buttons = [StepButton(place, title) for place, title in enumerate(titles)]
        for place, one in enumerate(self.buttons):
            one.clicked.connect(partial(self._choose, place))
        self.choice = choice("step_choice", "Step", (), None)
        self.choice.activated.connect(self._choose)
        parts: list[tuple[QWidget, int]] = [(one, 1) for one in self.buttons]
        row(*parts, (self.choice, 1), on=self, margins=1, spacing=0)

    def _choose(self, place: int, checked: bool = True) -> None:
        self.chosen.emit(place)

    def offer(self, count: int) -> None:
        """Offer the first so many steps."""
        self._offered = count
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show as much of the steps as there is room for."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        offered = self.buttons[: self._offered]
        share = (self.width() - 2) // max(len(offered), 1)
        names = max(one.room[0] for one in offered)
        words = max(one.room[1] for one in offered[NAMED_BY_OTHERS:])
        for place, one in enumerate(self.buttons):
            one.setVisible(place < self._offered and names <= share)
            one.words.setVisible(words <= share)
        self.choice.setVisible(names > share)

    def show_steps(self, now: int, words: Sequence[str], wrong: Sequence[int]) -> None:
        """Show the step that is open, a few words on each, and how many mistakes each has."""
        for place, (one, text, count) in enumerate(zip(self.buttons, words, wrong, strict=True)):
            one.setChecked(place == now)
            state = "wrong" if count else "now" if place == now else "done" if text else "later"
            mistakes = tr("{} mistakes", count) if count > 1 else tr("1 mistake")
            one.show_step(state, mistakes if count else text)
        self._show_list(now)
        self._fit()

    def _show_list(self, now: int) -> None:
        texts = [one.listed for one in self.buttons[: self._offered]]
        if texts != [self.choice.itemText(at) for at in range(self.choice.count())]:
            self.choice.clear()
            self.choice.addItems(texts)
        self.choice.setCurrentIndex(now)
