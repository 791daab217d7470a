"""The steps of a test, a line each, with what is wrong or which revolutions they are below."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, Final

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QGroupBox, QLabel, QLineEdit, QVBoxLayout

from rigapp.config.ranges import refusal
from rigapp.config.recipe import TestFile
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
    take_away,
    tell,
)
from rigapp.gui.widgets.numbers import number, whole
from rigapp.gui.widgets.reflow import SentencePart, sentence_row
from rigapp.presentation.numbers import grouped
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr, translate

SENTENCE: Final[Text] = "{name} {length} {kind} at {speed_rpm} rpm, then rest {rest_s} s"
"""The line of a step, with its fields in the place of the braces."""
LENGTH_MISSING: Final[Text] = "Type how many revolutions the step has, or how many seconds."
KINDS: Final[tuple[tuple[Text, str], ...]] = (
    ("revolutions", "revolutions"),
    ("s", "duration_s"),
)
NONE_YET: Final[Text] = "None: the test runs at one speed from its first revolution to its last."

NAME_WIDTH, NUMBER_WIDTH = 16 * STEP, 9 * STEP


class StepLine(QFrame):
    """One step: its name, how long it is, how fast, and the rest after it."""

    changed = Signal()

    def __init__(self, made: int, given: dict[str, Any]) -> None:
        super().__init__()
        self._given, self._words = given, ""
        self.setObjectName(f"sequence_{made}")
        self.place = QLabel()
        name = f"sequence_{made}"
        self.kind = choice(f"{name}_kind", tr("Unit of how long step {} is", made), KINDS)
        self.name = edit(f"{name}_name", tr("Name of step {}", made))
        self.name.setPlaceholderText(tr("name"))
        self.length = edit(f"{name}_length", tr("How long step {} is", made))
        self.speed_rpm = edit(f"{name}_speed", tr("Speed of step {}", made))
        self.rest_s = edit(f"{name}_rest", tr("Rest after step {}", made))
        self.rest_s.setPlaceholderText("0")
        self.note = prose(
            f"{name}_note", tr("What is wrong with step {}, or where it is", made), role="caption"
        )
        self.sooner = button(f"{name}_sooner", "Earlier", spoken=tr("Put step {} earlier", made))
        self.remove = button(f"{name}_remove", "Remove", spoken=tr("Remove step {}", made))
        for one in (self.sooner, self.remove):
            one.setProperty("rank", "quiet")
        self.name.setFixedWidth(NAME_WIDTH)
        for line in (self.length, self.speed_rpm, self.rest_s):
            line.setFixedWidth(NUMBER_WIDTH)
        self._lay_out()
        self._fill()
        for line in (self.name, self.length, self.speed_rpm, self.rest_s):
            line.textEdited.connect(self.changed)
        self.kind.currentIndexChanged.connect(self.changed)

    def _lay_out(self) -> None:
        first = sentence_row(tr(SENTENCE), self._field, before=self.place)
        second = row((self.note, 1), self.sooner, self.remove, spacing=STEP)
        column(first, second, on=self, margins=(0, STEP), spacing=STEP // 2)

    def _field(self, name: str) -> SentencePart:
        return getattr(self, name), None, False

    def _fill(self) -> None:
        given = self._given
        kind = "duration_s" if given.get("duration_s") is not None else "revolutions"
        self.kind.setCurrentIndex(self.kind.findData(kind))
        self.length.setText(show_value(given.get(kind)))
        self.name.setText(str(given.get("name", "")))
        self.speed_rpm.setText(show_value(given.get("speed_rpm")))
        self.rest_s.setText(show_value(given.get("rest_s")))

    def read(self) -> tuple[dict[str, Any], list[str]]:
        """Return the step as the file has it, and what is wrong with it; marks the fields."""
        wrong: list[str] = []
        step = {
            key: value
            for key, value in self._given.items()
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
            tell(self.length, "wrong", True)
            wrong.append(tr(LENGTH_MISSING))
        return step, wrong

    def _number(self, key: str, line: QLineEdit, wrong: list[str]) -> Any:
        text = line.text().strip()
        tell(line, "wrong", False)
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
        tell(line, "wrong", True)
        wrong.append(fault)
        return None

    def show_place(self, number: int, words: str) -> None:
        """Show the number of the step, and below it which revolutions it is."""
        self._words = words
        self.place.setText(f"{number}.")
        self.sooner.setEnabled(number > 1)
        if self.note.property("role") != "error":
            self.say(())

    def say(self, wrong: Sequence[str]) -> None:
        """Show what is wrong below the step, else which revolutions it is."""
        tell(self.note, "role", "error" if wrong else "caption")
        self.note.setText(f"\u2717 {' '.join(wrong)}" if wrong else self._words)


class SequenceCard(QGroupBox):
    """Edit the steps of a test; without any it runs at one speed."""

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
        """Show steps as a test file holds them."""
        for line in self.rows:
            take_away(line, self._list)
        self.rows = []
        for step in steps:
            self._append(dict(step))
        self.none.setVisible(not self.rows)

    def read(self) -> tuple[list[dict[str, Any]], int]:
        """Return the steps and how many of them are wrong, and say at each what is wrong."""
        read = [line.read() for line in self.rows]
        for line, (_, wrong) in zip(self.rows, read, strict=True):
            line.say(wrong)
        return [step for step, _ in read], sum(1 for _, wrong in read if wrong)

    def show_places(self, test: TestFile | None) -> None:
        """Say at each step which revolutions of a usable test it is first; None: not known."""
        known = test is not None and len(test.run.step) == len(self.rows)
        steps, first = Steps(test.run) if test is not None and known else None, 1
        for place, line in enumerate(self.rows, start=1):
            if test is not None:
                line.speed_rpm.setPlaceholderText(show_value(test.run.speed_rpm))
            stage = steps.at(first) if steps is not None else None
            if stage is None:
                line.show_place(place, "")
                continue
            ramp, last = f"{stage.acceleration_rpm_per_s:g} rpm/s", grouped(stage.last)
            line.show_place(place, tr("revolutions {} to {}, ramp {}", grouped(first), last, ramp))
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
        at = self.rows.index(line)
        if at > 0:
            self.rows.insert(at - 1, self.rows.pop(at))
            self._list.removeWidget(line)
            self._list.insertWidget(at - 1, line)
            self.changed.emit()

    def _remove(self, line: StepLine, checked: bool = False) -> None:
        self.rows.remove(line)
        take_away(line, self._list)
        self.none.setVisible(not self.rows)
        self.changed.emit()
