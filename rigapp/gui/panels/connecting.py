"""What is connected, step by step: engine, devices, first samples."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtGui import QFont
from PySide6.QtWidgets import QFrame, QProgressBar

from rigapp.gui.look.fonts import sized
from rigapp.gui.widgets.build import column, named
from rigapp.gui.widgets.labels import ElidedLabel
from rigapp.gui.widgets.steps import ShownStep, StepRow
from rigapp.presentation.tokens import BODY_PT, GAP, MARGIN, STEP, Theme
from rigapp.presentation.translation import marked, tr, translate
from rigapp.schema.messages import RunState
from rigapp.viewer.news import News

BEFORE = frozenset({RunState.IDLE, RunState.CONNECTING, RunState.READY, RunState.CALIBRATING})
"""States before a test, in which it matters what is connected."""
MOST = 8


def connection_steps(news: News) -> list[ShownStep]:
    """Return the steps to a rig that is ready, in their order; the first one not done is next."""
    status = news.status
    if status is None:
        looking = marked("looking for it, or starting it")
        later = [ShownStep(name, "after the engine") for name in ("Devices", "First samples")]
        return _marked([ShownStep("Engine", looking), *later])
    steps = [ShownStep("Engine", status.rig.name, done=True)]
    waits = status.engine.state is RunState.IDLE
    for device in status.rig.devices:
        found = device.identity or tr("{} on {}", device.driver, device.port)
        line = translate(device.last_error) or (
            found if device.connected else tr("finding {}", found)
        )
        steps.append(ShownStep(device.name, line, device.connected))
    if not status.rig.devices:
        steps.append(ShownStep("Devices", "not connected yet" if waits else "making the ports"))
    age = news.data_age_s
    data = age is not None and math.isfinite(age) and not waits
    steps.append(ShownStep("First samples", "they come" if data else "after the devices", data))
    return _marked(steps)


def _marked(steps: Sequence[ShownStep]) -> list[ShownStep]:
    first = next((one for one in steps if not one.done), None)
    return [replace(one, now=one is first) for one in steps]


class ConnectingCard(QFrame):
    """Show the steps in the place of the limits, which nobody watches before a test."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._steps: list[ShownStep] = []
        named(self, "connecting", "Connection of the rig", role="card")
        self.title = ElidedLabel("connecting_title", "Connection of the rig")
        self.title.setFont(sized(self.font(), BODY_PT, QFont.Weight.DemiBold))
        self.bar = named(QProgressBar(), "connecting_bar", "Steps that are done")
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(STEP // 2)
        self.rows = [StepRow("connecting", number) for number in range(MOST)]
        column(self.title, self.bar, *self.rows, on=self, margins=(MARGIN, GAP), spacing=STEP)

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
