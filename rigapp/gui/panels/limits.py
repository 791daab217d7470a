"""The limits of the running test: seen, and changed with a reason that goes into the log."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGroupBox, QLabel, QVBoxLayout

from rigapp.config.ranges import refusal
from rigapp.config.recipe import TestFile
from rigapp.config.rules import ALWAYS, BOUNDS, limit_refusal
from rigapp.gui.data.news import News, Takes
from rigapp.gui.widgets.build import button, edit, filled, named, row
from rigapp.gui.widgets.tables import PlainTable
from rigapp.schema.channels import BASE
from rigapp.schema.loglines import newest_limits
from rigapp.schema.messages import NOTE_CHARACTERS, RunState
from rigapp.schema.states import ACTIVE

REVOLUTIONS = "revolutions"
WORDS = {
    REVOLUTIONS: "the test ends after so many, more or fewer than planned",
    "overload_N": "overload: drive off above (N)",
    "overspeed_rpm": "overspeed: drive off above (rpm)",
    "stale_data_s": "no samples: drive off after (s)",
}


def limits_of(test: TestFile | None, changed: Mapping[str, float]) -> dict[str, tuple[float, str]]:
    """Return every limit by its name: present value and what happens, changes applied."""
    if test is None:
        return {}
    found: dict[str, tuple[float, str]] = {}
    for name in ALWAYS:
        found[name] = (float(getattr(test.limits, name)), "drive off")
    for rule in test.limits.rule:
        for level in reversed(BOUNDS):
            value = getattr(rule, level)
            if value is not None:
                critical = level.startswith("critical")
                wanted = rule.action_critical if critical else rule.action_warning
                found[f"{rule.quantity}.{level}"] = (value, wanted.replace("_", " "))
    for name, value in changed.items():
        found[name] = (value, found.get(name, (0.0, "as in the test"))[1])
    return found


class LimitPanel(QGroupBox):
    """Show the limits and the length of the test, and change one; asks "set_limit" or "extend"."""

    wanted = Signal(str, dict)
    takes = Takes.HISTORY | Takes.LOG

    def __init__(self) -> None:
        super().__init__("Limits of the running test")
        self._shown: dict[str, tuple[float, str]] = {}
        self._active = False
        self._channels = BASE
        named(self, "limit_panel", "Limits of the running test")
        self.table = PlainTable("limit_table", "Limits", ("Limit", "Now", "Action", "Meaning"))
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
        self.problem = named(QLabel(), "limit_problem", "Why the limit cannot be changed")
        tools = row("New value", (self.value, 1), (self.reason, 3), self.change, (self.problem, 2))
        filled(QVBoxLayout(self), ((self.table, 1), tools))
        self._enable()

    def show_news(self, news: News) -> None:
        """Show the limits of the test, with the changes that its log tells of."""
        status = news.status
        state, planned = (status.state, status.planned) if status is not None else (None, 0)
        self._channels = news.data.channels
        self.show_limits(state, news.recipe, newest_limits(news.events), planned)

    def show_limits(
        self,
        state: RunState | None,
        test: TestFile | None,
        changed: Mapping[str, float],
        planned: int = 0,
    ) -> None:
        """Show the limits as they are now; planned: revolutions of the complete test."""
        self._active = state in ACTIVE
        limits = limits_of(test, changed)
        if planned > 0:
            limits[REVOLUTIONS] = (float(planned), "test complete")
        if limits != self._shown:
            self._shown = limits
            self.table.show_rows(
                [
                    (name, _number(value), action, WORDS.get(name, name.replace("_", " ")))
                    for name, (value, action) in limits.items()
                ]
            )
        self._enable()

    def _name(self) -> str | None:
        at = self.table.chosen()
        return list(self._shown)[at] if at is not None and at < len(self._shown) else None

    def _chosen(self) -> None:
        name = self._name()
        if name is not None:
            self.value.setText(_number(self._shown[name][0]))
        self._enable()

    def _number(self) -> float | None:
        try:
            number = float(self.value.text())
        except ValueError:
            return None
        return int(number) if number.is_integer() else number

    def _enable(self) -> None:
        name, number = self._name(), self._number()
        if not self._active:
            problem = "No test is under way; limits are changed in the test file."
        elif name is None:
            problem = "Choose a limit."
        elif number is None:
            problem = "The new value is not a number."
        elif number == self._shown[name][0]:
            problem = "This is the present value."
        elif not self.reason.text().strip():
            problem = "Give the reason."
        else:
            problem = self._refusal(name, number)
        self.problem.setText(problem)
        self.change.setEnabled(not problem)

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
        if name == REVOLUTIONS:
            self.wanted.emit("extend", {"revolutions": number, "reason": reason})
        else:
            self.wanted.emit("set_limit", {"name": name, "value": number, "reason": reason})


def _number(value: float) -> str:
    return f"{value:.9g}"
