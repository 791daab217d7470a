"""Limits of the running test; changes need a reason for the log."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGroupBox, QLineEdit, QVBoxLayout

from rigapp.config.ranges import refusal
from rigapp.config.recipe import TestFile
from rigapp.config.rules import ALWAYS, limit_refusal
from rigapp.gui.widgets.build import button, edit, filled, fit_hint, named, prose
from rigapp.gui.widgets.numbers import number
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.numbers import grouped, true_minus
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.loglines import newest_limits
from rigapp.schema.messages import NOTE_CHARACTERS, RunState
from rigapp.schema.states import ACTIVE
from rigapp.schema.wire import tree_of
from rigapp.viewer.levels import levels_of, unit_of_quantity
from rigapp.viewer.news import News, Takes

REVOLUTIONS = "revolutions"
VALUE_WIDTH = 10 * STEP
TABLE_HEIGHT = 18 * STEP
"""Height of the heading and three limits, which take two lines each in German."""


@dataclass(frozen=True, slots=True)
class ShownLimit:
    """A limit as text, with its present value and unit."""

    words: str
    value: float
    unit: str = ""


def limits_of(
    test: TestFile | None, changed: Mapping[str, float], table: ChannelTable = BASE
) -> dict[str, ShownLimit]:
    """Return every limit by its name, changes applied."""
    if test is None:
        return {}
    limits = {
        name: ShownLimit(translate(limit.sentence), float(getattr(test.limits, name)), limit.unit)
        for name, limit in ALWAYS.items()
    }
    for level in levels_of([tree_of(rule) for rule in test.limits.rule]):
        if level.value is not None:
            unit = unit_of_quantity(level.quantity, table)
            limits[f"{level.quantity}.{level.bound}"] = ShownLimit(
                level.condition(table), level.value, unit
            )
    for name, value in changed.items():
        known = limits.get(name, ShownLimit(name.replace("_", " "), value))
        limits[name] = replace(known, value=value)
    return limits


class LimitPanel(QGroupBox):
    """Show limits and length of the test and change one; requests "set_limit" or "extend"."""

    wanted = Signal(str, dict)
    takes = Takes.HISTORY | Takes.LOG

    def __init__(self) -> None:
        super().__init__(tr("Limits of the running test"))
        self._shown: dict[str, ShownLimit] = {}
        self._active = False
        self._channels = BASE
        named(self, "limit_panel", "Limits of the running test")
        self.table = PlainTable("limit_table", "Limits", ("Limit", "Now"), stretch=(0,))
        self.table.setMinimumHeight(TABLE_HEIGHT)
        self.table.itemSelectionChanged.connect(self._chosen)
        self.value = edit("limit_value", "New value of the chosen limit", self._enable)
        self.reason = edit(
            "limit_reason",
            "Reason for the new limit",
            self._enable,
            hint="reason, goes into the log",
            most=NOTE_CHARACTERS,
        )
        self.change = button(
            "limit_change", "Chan&ge limit", self._change, "Change the chosen limit", guarded=True
        )
        self.pin = edit("limit_pin", "PIN of the operator", self._enable, hint="PIN")
        self.pin.setEchoMode(QLineEdit.EchoMode.Password)
        self.pin.setMaximumWidth(VALUE_WIDTH)
        self.pin.hide()
        self.problem = prose("limit_problem", "Why the limit cannot be changed")
        self.value.setMinimumWidth(VALUE_WIDTH)
        fit_hint(self.reason)
        first = flowing("New value", (self.value, 1), (self.reason, 3), self.pin, self.change)
        filled(QVBoxLayout(self), ((self.table, 1), first, self.problem))
        self._enable()

    def show_news(self, news: News) -> None:
        """Show the limits of the test, with the changes in its log."""
        status = news.status
        state = status.engine.state if status is not None else None
        self.pin.setVisible(status is not None and status.rig.limits_need_pin)
        planned = status.test.planned if status is not None and status.test is not None else 0
        self._channels = news.data.channels
        self.show_limits(state, news.recipe, newest_limits(news.events), planned)

    def show_limits(
        self,
        state: RunState | None,
        test: TestFile | None,
        changed: Mapping[str, float],
        planned: int = 0,
    ) -> None:
        """Show the present limits; planned: revolutions of the complete test."""
        self._active = state in ACTIVE
        limits = limits_of(test, changed, self._channels)
        if planned > 0:
            limits[REVOLUTIONS] = ShownLimit(tr("Revolutions of the complete test"), float(planned))
        if limits != self._shown:
            self._shown = limits
            self.table.show_rows(
                [
                    (limit.words, f"{_grouped(limit.value)} {limit.unit}".rstrip())
                    for limit in limits.values()
                ]
            )
        self._enable()

    def _name(self) -> str | None:
        return self.table.chosen_of(list(self._shown))

    def _chosen(self) -> None:
        name = self._name()
        if name is not None:
            self.value.setText(_number(self._shown[name].value))
        self._enable()

    def _number(self) -> float | None:
        try:
            typed = number(self.value.text())
        except ValueError:
            return None
        return int(typed) if typed.is_integer() else typed

    def _enable(self) -> None:
        name, number = self._name(), self._number()
        problem = self._problem(name, number)
        self.problem.setText(tr(problem))
        self.change.setEnabled(not problem)

    def _problem(self, name: str | None, number: float | None) -> Text:
        if not self._active:
            return "No test is under way; limits are changed in the test file."
        if name is None:
            return "Choose a limit."
        if number is None:
            return "The new value is not a number."
        if number == self._shown[name].value:
            return "This is the present value."
        if not self.reason.text().strip():
            return "Give the reason."
        if not self.pin.isHidden() and not self.pin.text():
            return "Type the PIN of the operator whom the settings name."
        return translate(self._refusal(name, number))

    def _refusal(self, name: str, number: float) -> str:
        if name == REVOLUTIONS:
            return refusal("run.revolutions", number)
        return limit_refusal(name, number, self._channels)

    def _change(self) -> None:
        name, number = self._name(), self._number()
        if name is None or number is None:
            return
        reason = self.reason.text().strip()
        self.reason.clear()
        arguments = (
            {"reason": reason}
            if self.pin.isHidden()
            else {"reason": reason, "pin": self.pin.text()}
        )
        self.pin.clear()
        if name == REVOLUTIONS:
            self.wanted.emit("extend", {"revolutions": number, **arguments})
        else:
            self.wanted.emit("set_limit", {"name": name, "value": number, **arguments})


def _number(value: float) -> str:
    return f"{value:.9g}"


def _grouped(value: float) -> str:
    return grouped(int(value)) if float(value).is_integer() else true_minus(_number(value))
