"""Limits of a test as sentences to fill in, each with its error and usual range below."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Final

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import (
    QComboBox,
    QFrame,
    QGroupBox,
    QLabel,
    QLineEdit,
    QVBoxLayout,
    QWidget,
)

from rigapp.config.recipe import LimitsSection
from rigapp.gui.testfile.fields import show_value
from rigapp.gui.widgets.build import (
    button,
    choice,
    column,
    edit,
    filled,
    named,
    prose,
    set_property,
    styled_label,
    take_away,
)
from rigapp.gui.widgets.numbers import number, whole
from rigapp.gui.widgets.reflow import SentencePart, flowing, sentence_row
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.viewer.levels import (
    ACTIONS,
    OTHER_ACTIONS,
    LimitLevel,
    faults_of,
    levels_of,
    listed,
    never_comes,
    quantity_choices,
    rules_of,
    unit_of_quantity,
)
from rigapp.viewer.news import News

SENTENCE: Final[Text] = "{action} when {quantity} is {side} {value} in {revolutions} revolutions"
ENDS: Final[Text] = "{note} ends {back} inside"
"""Second line of a limit, after ``SENTENCE``; the braces are fields."""
NUMBER: Final[Text] = "Type a number in place of {}."
WHOLE_NUMBER: Final[Text] = "Type an integer in place of {}."
SIDES: Final[tuple[tuple[Text, str], ...]] = (("above", "above"), ("below", "below"))

NUMBER_WIDTH = 9 * STEP
NOTE_WIDTH = 24 * STEP
COUNT_WIDTH = 7 * STEP
QUANTITY_LETTERS = 10
"""Minimum number of characters of the quantity; the list of quantities is as wide as necessary."""
USUAL_ROWS = 1000
USUAL_PERCENT = (5.0, 95.0)
"""Percentiles of the usual range over ``USUAL_ROWS`` revolutions, without starts and trips."""


class LevelRow(QFrame):
    """One limit: its action, quantity, side, value and number of revolutions."""

    changed = Signal()

    def __init__(self, serial: int, level: LimitLevel, table: ChannelTable) -> None:
        super().__init__()
        self.level = level
        self._table = table
        self._usual = ""
        name = f"limit_{serial}"
        named(self, name, tr("Limit {}", serial))
        actions = [(text, pair) for pair, text in ACTIONS.items()]
        pair = (level.severity, level.action)
        if pair not in ACTIONS:
            actions.append((OTHER_ACTIONS[pair], pair))
        self.action = choice(f"{name}_action", tr("Action of limit {}", serial), actions)
        self.quantity = choice(f"{name}_quantity", tr("Quantity of limit {}", serial), ())
        self.quantity.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.quantity.setMinimumContentsLength(QUANTITY_LETTERS)
        self.side = choice(f"{name}_side", tr("Side of limit {}", serial), SIDES)
        self.value = edit(f"{name}_value", tr("Value of limit {}", serial))
        self.revolutions = edit(
            f"{name}_revolutions", tr("Revolutions in a row of limit {}", serial)
        )
        self.back = edit(f"{name}_back", tr("Margin to limit {} at which its alarm ends", serial))
        self.units = [QLabel(), QLabel()]
        wrong = tr("Error in limit {}, or its usual range", serial)
        self.note = prose(f"{name}_note", wrong, role="caption")
        self.remove = button(f"{name}_remove", "Remove", spoken=tr("Remove limit {}", serial))
        self.remove.setProperty("rank", "quiet")
        for line, width in (
            (self.value, NUMBER_WIDTH),
            (self.revolutions, COUNT_WIDTH),
            (self.back, COUNT_WIDTH),
        ):
            line.setFixedWidth(width)
        self._lay_out()
        self.know(table)
        self._fill(pair)
        for box in (self.action, self.quantity, self.side):
            box.currentIndexChanged.connect(self.changed)
        for line in (self.value, self.revolutions, self.back):
            line.textEdited.connect(self.changed)
        self.quantity.currentIndexChanged.connect(self._show_unit)

    def _lay_out(self) -> None:
        first = sentence_row(tr(SENTENCE), self._field(self.quantity, self.units[0]))
        second = sentence_row(tr(ENDS), self._field(self.note, self.units[1]))
        if self.level.steps:
            second.add(QLabel(tr("in step {} only", listed(self.level.steps))), 0)
        second.add(self.remove, 0)
        self.note.setMinimumWidth(NOTE_WIDTH)
        column(first, second, on=self, margins=(0, STEP), spacing=STEP // 2)

    def _field(self, wide: QWidget, unit: QLabel) -> Callable[[str], SentencePart]:
        """Return a function that maps the name of a field to the field and its unit."""

        def field_of(name: str) -> SentencePart:
            field: QWidget = getattr(self, name)
            return field, unit if field in (self.value, self.back) else None, field is wide

        return field_of

    def _fill(self, pair: tuple[str, str]) -> None:
        level = self.level
        pairs = [tuple(self.action.itemData(index)) for index in range(self.action.count())]
        self.action.setCurrentIndex(pairs.index(pair))
        if self.quantity.findData(level.quantity) < 0:
            self.quantity.addItem(level.quantity, level.quantity)
        self.quantity.setCurrentIndex(self.quantity.findData(level.quantity))
        self.side.setCurrentIndex(self.side.findData(level.side))
        for line, value in (
            (self.value, level.value),
            (self.revolutions, level.revolutions),
            (self.back, level.hysteresis),
        ):
            line.setText(show_value(value))
        self._show_unit()

    def know(self, table: ChannelTable) -> None:
        """List the quantities of a rig's channels."""
        self._table = table
        known = {self.quantity.itemData(index) for index in range(self.quantity.count())}
        for text, name in quantity_choices(table):
            if name not in known:
                self.quantity.addItem(text, name)
        self.quantity.view().setMinimumWidth(self.quantity.view().sizeHintForColumn(0) + 4 * STEP)

    def _show_unit(self) -> None:
        for unit in self.units:
            unit.setText(unit_of_quantity(self.quantity.currentData(), self._table))

    def read(self) -> tuple[LimitLevel, list[str]]:
        """Return the entered level and its errors, and mark the fields."""
        severity, action = self.action.currentData()
        wrong: list[str] = []
        self.level = replace(
            self.level,
            quantity=self.quantity.currentData(),
            severity=severity,
            action=action,
            side=self.side.currentData(),
            value=self._number(self.value, number, NUMBER, wrong, None),
            revolutions=self._number(self.revolutions, whole, WHOLE_NUMBER, wrong, 1),
            hysteresis=self._number(self.back, number, NUMBER, wrong, 0.0),
        )
        return self.level, wrong

    def _number(
        self, line: QLineEdit, parse: Callable[[str], Any], what: Text, wrong: list[str], empty: Any
    ) -> Any:
        text = line.text().strip()
        set_property(line, "wrong", False)
        if not text:
            return empty
        try:
            return parse(text)
        except ValueError:
            set_property(line, "wrong", True)
            wrong.append(tr(what, repr(text)))
            return empty

    def say(self, wrong: Sequence[str], caution: str = "") -> None:
        """Show the errors below the sentence, else a caution, else the usual range."""
        if wrong and not any(line.property("wrong") for line in (self.revolutions, self.back)):
            set_property(self.value, "wrong", True)
        set_property(self.note, "role", "error" if wrong else "caution" if caution else "caption")
        text = f"\u2717 {' '.join(wrong)}" if wrong else f"\u25b2 {caution}" if caution else ""
        self.note.setText(text or self._usual)

    def show_usual(self, news: News) -> None:
        """Show the usual range of the quantity in the shown test."""
        text = ""
        for rows in (news.data.rows, news.data.predictions):
            if self.level.quantity in rows.names:
                values = rows.newest(self.level.quantity, USUAL_ROWS)
                known = values[np.isfinite(values)]
                if len(known):
                    low, high = np.percentile(known, USUAL_PERCENT)
                    unit = unit_of_quantity(self.level.quantity, self._table)
                    text = tr("usual {:.4g} to {:.4g} {}", low, high, unit).rstrip()
                break
        if text != self._usual:
            if self.note.text() == self._usual:
                self.note.setText(text)
            self._usual = text


class LimitSentences(QGroupBox):
    """Edit the limits of a test; a new one is a draft until it is added."""

    changed = Signal()

    def __init__(self) -> None:
        super().__init__(tr("Limits of this test"))
        named(self, "section_rules", "Limits of this test")
        self._given: list[dict[str, Any]] = []
        self._table = BASE
        self._limits: LimitsSection | None = None
        self._made = 0
        self.rows: list[LevelRow] = []
        self.draft: LevelRow | None = None
        self._list = column()
        self.add = button("rule_add", "Add a limit", self.begin)
        self.keep = button("draft_add", "Add limit", self._keep, rank="primary")
        self.discard = button("draft_discard", "Discard", self._discard, "Discard the draft")
        self.chip = styled_label("Draft, not yet part of the test", "caption")
        self.none = prose(
            "no_limits",
            "No limits",
            "None yet: a limit warns when the joint changes.",
            role="secondary",
        )
        tools = flowing(self.add, self.chip, None, self.discard, self.keep)
        filled(QVBoxLayout(self), (self.none, self._list, tools))
        self._show()

    def fill(self, rules: Sequence[dict[str, Any]]) -> None:
        """Show the rules of a test file; a draft is discarded."""
        self._discard()
        for line in self.rows:
            take_away(line, self._list)
        self.rows = []
        self._given = [dict(rule) for rule in rules]
        for level in levels_of(self._given):
            self._append(level)
        self._show()

    def know(self, table: ChannelTable) -> None:
        """List the quantities of a rig's channels."""
        if table != self._table:
            self._table = table
            for line in self._all():
                line.know(table)

    def validate(self, limits: LimitsSection | None) -> tuple[list[dict[str, Any]], int]:
        """Return the rules and the number of wrong limits; show the errors of each.

        limits: the permanent limits; None while not known.
        """
        self._limits = limits
        read = [line.read() for line in self.rows]
        levels = [level for level, _ in read]
        wrong = [list(texts) for _, texts in read]
        rules, origins = rules_of(levels, self._given)
        for rule, indices in zip(rules, origins, strict=True):
            if not any(wrong[index] for index in indices):
                wrong[indices[-1]] += faults_of(rule, None)
        for line, level, texts in zip(self.rows, levels, wrong, strict=True):
            line.say(texts, never_comes(level, limits))
        self._validate_draft(levels)
        return rules, sum(1 for texts in wrong if texts)

    def _validate_draft(self, levels: Sequence[LimitLevel]) -> None:
        if self.draft is None:
            return
        level, wrong = self.draft.read()
        if not wrong:
            (rule,), _ = rules_of([level], ())
            never = never_comes(level, self._limits)
            wrong = [*faults_of(rule, self._table), *([never] if never else [])]
        if any((other.quantity, other.bound) == (level.quantity, level.bound) for other in levels):
            wrong.append(tr("This limit exists already; change it instead."))
        self.draft.say(wrong)
        self.keep.setEnabled(not wrong)
        self.keep.setToolTip(" ".join(wrong))

    def show_usual(self, news: News) -> None:
        """Show the usual range at each limit."""
        for line in self._all():
            line.show_usual(news)

    def _all(self) -> list[LevelRow]:
        return [*self.rows, *([self.draft] if self.draft is not None else [])]

    def begin(self) -> None:
        """Begin a limit as a draft."""
        if self.draft is None:
            self.draft = self._row(LimitLevel(-1))
            self.draft.setProperty("role", "draft")
            self.draft.setContentsMargins(STEP, 0, STEP, 0)
            self.draft.remove.hide()
            self._list.addWidget(self.draft)
            self._show()
            self.draft.value.setFocus()
            self.changed.emit()

    def _row(self, level: LimitLevel) -> LevelRow:
        self._made += 1
        line = LevelRow(self._made, level, self._table)
        line.changed.connect(self.changed)
        return line

    def _append(self, level: LimitLevel) -> None:
        line = self._row(level)
        line.remove.clicked.connect(partial(self._remove, line))
        self.rows.append(line)
        self._list.addWidget(line)

    def _keep(self) -> None:
        draft = self.draft
        if draft is not None:
            level = replace(draft.level, origin=self._origin_for(draft.level))
            self._discard()
            self._append(level)
            self._show()
            self.changed.emit()

    def _origin_for(self, level: LimitLevel) -> int:
        """Return the rule for a new level: an existing one of its quantity, or a new one."""
        for line in self.rows:
            known = line.level
            if (known.quantity, known.revolutions, known.hysteresis) == (
                level.quantity,
                level.revolutions,
                level.hysteresis,
            ):
                return known.origin
        return 1 + max((line.level.origin for line in self.rows), default=len(self._given))

    def _discard(self) -> None:
        if self.draft is not None:
            take_away(self.draft, self._list)
            self.draft = None
            self._show()
            self.changed.emit()

    def _remove(self, line: LevelRow, checked: bool = False) -> None:
        self.rows.remove(line)
        take_away(line, self._list)
        self._show()
        self.changed.emit()

    def _show(self) -> None:
        drafting = self.draft is not None
        for part in (self.chip, self.keep, self.discard):
            part.setVisible(drafting)
        self.add.setVisible(not drafting)
        self.none.setVisible(not self._all())
