"""The steps of preparing a test, and an editor of the steps of the test itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Final

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import (
    QFrame,
    QGroupBox,
    QLabel,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from rigapp.config.ranges import refusal, unit_of
from rigapp.config.recipe import TestFile
from rigapp.config.rules import ALWAYS
from rigapp.config.sequence import Sequence as Steps
from rigapp.gui.testfile.fields import show_value
from rigapp.gui.testfile.rules import NUMBER, WHOLE_NUMBER
from rigapp.gui.widgets.build import (
    button,
    choice,
    column,
    edit,
    filled,
    named,
    prose,
    row,
    set_property,
    take_away,
)
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.widgets.numbers import number, whole
from rigapp.gui.widgets.reflow import SentencePart, sentence_row
from rigapp.presentation.numbers import grouped, unit_text
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.criteria import CRITERIA

HEIGHT = 7 * STEP
SIGN_ROOM = 6 * STEP
"""Width of a step's sign and the space around sign and texts, pixels."""
NAMED_BY_OTHERS = 1
"""Number of first steps whose texts are names chosen by users, which may be cut."""


@dataclass(frozen=True, slots=True)
class PrepareStep:
    """One step: its name, its sections, and its short summary of a usable test."""

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
    """Return the first criterion that is set, with its value."""
    for key, criterion in CRITERIA.items():
        level = getattr(test.stop, key)
        if level is not None:
            return f"{tr(criterion.title)} {level:g} {unit_text(unit_of(f'stop.{key}'))}"
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
"""The steps; the last one has all remaining sections, folded."""

MODEL = len(STEPS) - 1

STATES: Final[dict[str, Text]] = {"done": "done", "now": "now", "later": "later", "wrong": "wrong"}


class StepButton(QPushButton):
    """One step: a tick when it is complete, its number, or a cross; name and a short text."""

    def __init__(self, index: int, title: Text) -> None:
        super().__init__()
        self._index, self._title = index, title
        named(self, f"step_{title.lower()}", title).setProperty("rank", "step")
        self.setCheckable(True)
        self.setAutoExclusive(True)
        self.setFixedHeight(HEIGHT)
        self.mark = QLabel(str(index + 1))
        self.mark.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self.mark.setProperty("mark", "later")
        self.title = ElidedLabel(f"step_{title.lower()}_title", title)
        self.title.show_text(title)
        self.title.setProperty("role", "title")
        self.words = ElidedLabel(f"step_{title.lower()}_words", tr("{} in short", tr(title)))
        self.words.setProperty("role", "caption")
        texts = column(None, self.title, self.words, None, spacing=0)
        row(self.mark, (texts, 1), on=self, margins=(STEP, 0, STEP // 2, 0), spacing=STEP)
        for label in (self.mark, self.title, self.words):
            label.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)

    @property
    def room(self) -> tuple[int, int]:
        """Return the required widths without and with the short text, pixels."""
        title, words = (
            label.fontMetrics().horizontalAdvance(label.whole) for label in (self.title, self.words)
        )
        return SIGN_ROOM + title, SIGN_ROOM + max(title, words)

    @property
    def listed(self) -> str:
        """Return the step as a line of a list."""
        return "  ".join(filter(None, (self.mark.text(), self.title.whole, self.words.whole)))

    def show_step(self, state: str, words: str) -> None:
        """Show a state (done, now, later, wrong) and a short text."""
        set_property(self.mark, "mark", state)
        self.mark.setText({"done": "\u2713", "wrong": "\u2717"}.get(state, str(self._index + 1)))
        self.words.show_text(words)
        self.setAccessibleName(tr("Step {}, {}: {}", self._index + 1, tr(self._title), words))
        self.setAccessibleDescription(tr(STATES[state]))


class StepBar(QFrame):
    """The steps in a row; one of them is open.

    Where there is no room for the short texts only the names are shown, and where there is none for
    the names, a drop-down list.
    """

    chosen = Signal(int)

    def __init__(self, titles: Sequence[Text]) -> None:
        super().__init__()
        named(self, "steps", "Steps of preparing a test", role="card")
        self._offered = len(titles)
        self.buttons = [StepButton(index, title) for index, title in enumerate(titles)]
        for index, step in enumerate(self.buttons):
            step.clicked.connect(partial(self._choose, index))
        self.choice = choice("step_choice", "Step", (), None)
        self.choice.activated.connect(self._choose)
        parts: list[tuple[QWidget, int]] = [(step, 1) for step in self.buttons]
        row(*parts, (self.choice, 1), on=self, margins=1, spacing=0)

    def _choose(self, index: int, checked: bool = True) -> None:
        self.chosen.emit(index)

    def offer(self, count: int) -> None:
        """Show only the first ``count`` steps."""
        self._offered = count
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show as much of the steps as fits."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        offered = self.buttons[: self._offered]
        share = (self.width() - 2) // max(len(offered), 1)
        names = max(step.room[0] for step in offered)
        words = max(step.room[1] for step in offered[NAMED_BY_OTHERS:])
        for index, step in enumerate(self.buttons):
            step.setVisible(index < self._offered and names <= share)
            step.words.setVisible(words <= share)
        self.choice.setVisible(names > share)

    def show_steps(self, now: int, words: Sequence[str], wrong: Sequence[int]) -> None:
        """Show the open step, and the short text and number of errors of each step."""
        for index, (step, text, count) in enumerate(zip(self.buttons, words, wrong, strict=True)):
            step.setChecked(index == now)
            state = "wrong" if count else "now" if index == now else "done" if text else "later"
            mistakes = tr("{} mistakes", count) if count > 1 else tr("1 mistake")
            step.show_step(state, mistakes if count else text)
        self._show_list(now)
        self._fit()

    def _show_list(self, now: int) -> None:
        texts = [step.listed for step in self.buttons[: self._offered]]
        if texts != [self.choice.itemText(index) for index in range(self.choice.count())]:
            self.choice.clear()
            self.choice.addItems(texts)
        self.choice.setCurrentIndex(now)


SENTENCE: Final[Text] = "{name} {length} {kind} at {speed_rpm} rpm, then rest {rest_s} s"
"""Line of a step; the braces are its fields."""
LENGTH_MISSING: Final[Text] = "Type how many revolutions the step has, or how many seconds."
KINDS: Final[tuple[tuple[Text, str], ...]] = (
    ("revolutions", "revolutions"),
    ("s", "duration_s"),
)
NONE_YET: Final[Text] = "None: the test runs at one speed from its first revolution to its last."

NAME_WIDTH, NUMBER_WIDTH = 16 * STEP, 9 * STEP


class StepLine(QFrame):
    """One step: its name, length, speed, and the rest after it."""

    changed = Signal()

    def __init__(self, serial: int, step: dict[str, Any]) -> None:
        super().__init__()
        self._step, self._words = step, ""
        self.setObjectName(f"sequence_{serial}")
        self.number = QLabel()
        name = f"sequence_{serial}"
        self.kind = choice(f"{name}_kind", tr("Unit of how long step {} is", serial), KINDS)
        self.name = edit(f"{name}_name", tr("Name of step {}", serial))
        self.name.setPlaceholderText(tr("name"))
        self.length = edit(f"{name}_length", tr("Length of step {}", serial))
        self.speed_rpm = edit(f"{name}_speed", tr("Speed of step {}", serial))
        self.rest_s = edit(f"{name}_rest", tr("Rest after step {}", serial))
        self.rest_s.setPlaceholderText("0")
        self.note = prose(
            f"{name}_note", tr("What is wrong with step {}, or where it is", serial), role="caption"
        )
        self.sooner = button(f"{name}_sooner", "Earlier", spoken=tr("Put step {} earlier", serial))
        self.remove = button(f"{name}_remove", "Remove", spoken=tr("Remove step {}", serial))
        for control in (self.sooner, self.remove):
            control.setProperty("rank", "quiet")
        self.name.setFixedWidth(NAME_WIDTH)
        for line in (self.length, self.speed_rpm, self.rest_s):
            line.setFixedWidth(NUMBER_WIDTH)
        self._lay_out()
        self._fill()
        for line in (self.name, self.length, self.speed_rpm, self.rest_s):
            line.textEdited.connect(self.changed)
        self.kind.currentIndexChanged.connect(self.changed)

    def _lay_out(self) -> None:
        first = sentence_row(tr(SENTENCE), self._field, before=self.number)
        second = row((self.note, 1), self.sooner, self.remove, spacing=STEP)
        column(first, second, on=self, margins=(0, STEP), spacing=STEP // 2)

    def _field(self, name: str) -> SentencePart:
        return getattr(self, name), None, False

    def _fill(self) -> None:
        step = self._step
        kind = "duration_s" if step.get("duration_s") is not None else "revolutions"
        self.kind.setCurrentIndex(self.kind.findData(kind))
        self.length.setText(show_value(step.get(kind)))
        self.name.setText(str(step.get("name", "")))
        self.speed_rpm.setText(show_value(step.get("speed_rpm")))
        self.rest_s.setText(show_value(step.get("rest_s")))

    def read(self) -> tuple[dict[str, Any], list[str]]:
        """Return the step as in the file, and its errors; mark the fields."""
        wrong: list[str] = []
        step = {
            key: value
            for key, value in self._step.items()
            if key not in ("name", "revolutions", "duration_s", "speed_rpm", "rest_s")
        }
        if self.name.text().strip():
            step = {"name": self.name.text().strip(), **step}
        kind = self.kind.currentData()
        for key, line in (
            (kind, self.length),
            ("speed_rpm", self.speed_rpm),
            ("rest_s", self.rest_s),
        ):
            value = self._number(key, line, wrong)
            if value is not None:
                step[key] = value
        if kind not in step and not wrong:
            set_property(self.length, "wrong", True)
            wrong.append(tr(LENGTH_MISSING))
        return step, wrong

    def _number(self, key: str, line: QLineEdit, wrong: list[str]) -> Any:
        text = line.text().strip()
        set_property(line, "wrong", False)
        if not text:
            return None
        counted = key == "revolutions"
        try:
            value = whole(text) if counted else number(text)
        except ValueError:
            fault = tr(WHOLE_NUMBER if counted else NUMBER, repr(text))
        else:
            fault = translate(refusal(f"run.step.{key}", value))
        if not fault:
            return value
        set_property(line, "wrong", True)
        wrong.append(fault)
        return None

    def show_place(self, number: int, words: str) -> None:
        """Show the number of the step, and below it its range of revolutions."""
        self._words = words
        self.number.setText(f"{number}.")
        self.sooner.setEnabled(number > 1)
        if self.note.property("role") != "error":
            self.say(())

    def say(self, wrong: Sequence[str]) -> None:
        """Show the errors below the step, else its range of revolutions."""
        set_property(self.note, "role", "error" if wrong else "caption")
        self.note.setText(f"\u2717 {' '.join(wrong)}" if wrong else self._words)


class SequenceCard(QGroupBox):
    """Edit the steps of a test; without steps it runs at one speed."""

    changed = Signal()

    def __init__(self) -> None:
        super().__init__(tr("Steps of this test"))
        named(self, "section_sequence", "Steps of this test")
        self.rows: list[StepLine] = []
        self._made = 0
        self._list = column()
        self.none = prose("no_steps", "No steps", NONE_YET, role="secondary")
        self.add = button("step_add", "Add a step", self._begin)
        filled(QVBoxLayout(self), (self.none, self._list, row(self.add, None)))

    def fill(self, steps: Sequence[dict[str, Any]]) -> None:
        """Show the steps of a test file."""
        for line in self.rows:
            take_away(line, self._list)
        self.rows = []
        for step in steps:
            self._append(dict(step))
        self.none.setVisible(not self.rows)

    def read(self) -> tuple[list[dict[str, Any]], int]:
        """Return the steps and the number of wrong ones; show the errors of each."""
        read = [line.read() for line in self.rows]
        for line, (_, wrong) in zip(self.rows, read, strict=True):
            line.say(wrong)
        return [step for step, _ in read], sum(1 for _, wrong in read if wrong)

    def show_places(self, test: TestFile | None) -> None:
        """Show the range of revolutions of each step of a usable test; None: not known."""
        known = test is not None and len(test.run.step) == len(self.rows)
        steps, first = Steps(test.run) if test is not None and known else None, 1
        for count, line in enumerate(self.rows, start=1):
            if test is not None:
                line.speed_rpm.setPlaceholderText(show_value(test.run.speed_rpm))
            stage = steps.at(first) if steps is not None else None
            if stage is None:
                line.show_place(count, "")
                continue
            ramp, last = f"{stage.acceleration_rpm_per_s:g} rpm/s", grouped(stage.last)
            line.show_place(count, tr("revolutions {} to {}, ramp {}", grouped(first), last, ramp))
            first = stage.last + 1

    def _begin(self) -> None:
        self._append({})
        self.rows[-1].length.setFocus()
        self.changed.emit()

    def _append(self, step: dict[str, Any]) -> None:
        self._made += 1
        line = StepLine(self._made, step)
        line.changed.connect(self.changed)
        line.remove.clicked.connect(partial(self._remove, line))
        line.sooner.clicked.connect(partial(self._sooner, line))
        self.rows.append(line)
        self._list.addWidget(line)
        self.none.hide()

    def _sooner(self, line: StepLine, checked: bool = False) -> None:
        index = self.rows.index(line)
        if index > 0:
            self.rows.insert(index - 1, self.rows.pop(index))
            self._list.removeWidget(line)
            self._list.insertWidget(index - 1, line)
            self.changed.emit()

    def _remove(self, line: StepLine, checked: bool = False) -> None:
        self.rows.remove(line)
        take_away(line, self._list)
        self.none.setVisible(not self.rows)
        self.changed.emit()
