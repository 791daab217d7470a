"""What is connected, step by step: engine, devices, first samples."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSize
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QFrame, QLabel, QProgressBar, QWidget

from rigapp.gui.data.news import News
from rigapp.gui.language.told import retold
from rigapp.gui.language.words import Text, marked, tr
from rigapp.gui.look.fonts import sized
from rigapp.gui.look.icons import Icon, icon
from rigapp.gui.look.tokens import BODY_PT, GAP, MARGIN, STEP, Theme
from rigapp.gui.widgets.build import column, named, row
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.schema.messages import RunState

SIGN = QSize(2 * STEP + 4, 2 * STEP + 4)
BEFORE = frozenset({RunState.IDLE, RunState.CONNECTING, RunState.READY})
"""States before a test, in which it matters what is connected."""
MOST = 8


@dataclass(frozen=True, slots=True)
class ConnectionStep:
    """One step: its name, how it stands in words, and whether it is done or under way."""

    name: Text
    line: Text
    done: bool = False
    now: bool = False


def connection_steps(news: News) -> list[ConnectionStep]:
    """Return the steps to a rig that is ready, in their order; the first one not done is next."""
    status = news.status
    if status is None:
        looking = marked("looking for it, or starting it")
        later = [ConnectionStep(name, "after the engine") for name in ("Devices", "First samples")]
        return _marked([ConnectionStep("Engine", looking), *later])
    steps = [ConnectionStep("Engine", status.rig, done=True)]
    waits = status.state is RunState.IDLE
    for device in status.devices:
        found = device.identity or tr("{} on {}", device.driver, device.port)
        line = retold(device.last_error) or (found if device.connected else tr("finding {}", found))
        steps.append(ConnectionStep(device.name, line, device.connected))
    if not status.devices:
        steps.append(
            ConnectionStep("Devices", "not connected yet" if waits else "making the ports")
        )
    age = news.data_age_s
    data = age is not None and math.isfinite(age) and not waits
    steps.append(
        ConnectionStep("First samples", "they come" if data else "after the devices", data)
    )
    return _marked(steps)


def _marked(steps: Sequence[ConnectionStep]) -> list[ConnectionStep]:
    first = next((one for one in steps if not one.done), None)
    return [ConnectionStep(one.name, one.line, one.done, one is first) for one in steps]


class StepRow(QWidget):
    """A sign for done, now or later, the step, and how it stands."""

    def __init__(self, number: int) -> None:
        super().__init__()
        named(self, f"connecting_step_{number}", "Step")
        self._shown: tuple[ConnectionStep, str] | None = None
        self.sign = QLabel()
        self.sign.setFixedSize(SIGN)
        self.name = ElidedLabel(f"connecting_name_{number}", "Step")
        self.line = ElidedLabel(f"connecting_line_{number}", "How it stands")
        self.line.setProperty("role", "caption")
        words = column(self.name, self.line)
        words.setSpacing(0)
        row(self.sign, (words, 1), on=self).setContentsMargins(0, 0, 0, 0)

    def show_step(self, step: ConnectionStep, theme: Theme) -> None:
        """Show a step; nothing is drawn again when it is the one shown."""
        if (step, theme.name) == self._shown:
            return
        self._shown = step, theme.name
        meaning, colour, word = Icon.LATER, theme.muted, marked("later")
        if step.done:
            meaning, colour, word = Icon.COMPLETE, theme.secondary, marked("done")
        elif step.now:
            meaning, colour, word = Icon.NOW, theme.highlight, marked("now")
        self.sign.setPixmap(icon(meaning, colour).pixmap(SIGN))
        self.name.show_text(tr(step.name))
        self.line.show_text(tr(step.line))
        self.setAccessibleDescription(f"{tr(step.name)}: {tr(word)}, {tr(step.line)}")


class ConnectingCard(QFrame):
    """Show the steps in the place of the limits, which nobody watches before a test."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._steps: list[ConnectionStep] = []
        named(self, "connecting", "Connection of the rig").setProperty("role", "card")
        self.title = ElidedLabel("connecting_title", "Connection of the rig")
        self.title.setFont(sized(self.font(), BODY_PT, QFont.Weight.DemiBold))
        self.bar = named(QProgressBar(), "connecting_bar", "Steps that are done")
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(STEP // 2)
        self.rows = [StepRow(number) for number in range(MOST)]
        made = column(self.title, self.bar, *self.rows, on=self)
        made.setContentsMargins(MARGIN, GAP, MARGIN, GAP)
        made.setSpacing(STEP)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        self._show()

    def show_news(self, news: News) -> None:
        """Show how far the connection is."""
        self._steps = connection_steps(news)
        self._show()

    def _show(self) -> None:
        done, all_ = sum(one.done for one in self._steps), len(self._steps)
        told = tr("Connected") if done == all_ else tr("Connecting, {} of {} done", done, all_)
        self.title.show_text(told)
        self.bar.setMaximum(max(all_, 1))
        self.bar.setValue(done)
        for shown, step in zip(self.rows, self._steps, strict=False):
            shown.show_step(step, self._theme)
        for number, shown in enumerate(self.rows):
            if shown.isVisibleTo(self) != (number < all_):
                shown.setVisible(number < all_)
