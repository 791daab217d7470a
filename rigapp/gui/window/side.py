"""The column on the right: newest values, connection, limits, or the recovery."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import replace

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent
from PySide6.QtWidgets import QFrame, QGridLayout, QProgressBar, QScrollArea, QWidget

from rigapp.gui.look.fonts import sized
from rigapp.gui.panels.alarms import AlarmGlance
from rigapp.gui.widgets.build import column, named
from rigapp.gui.widgets.labels import ElidedLabel, FittedLabel
from rigapp.gui.widgets.steps import ShownStep, StepRow
from rigapp.gui.window.headline import TileText, data_age
from rigapp.gui.window.recover import RecoverPanel
from rigapp.presentation.tokens import BODY_PT, CAPTION_PT, GAP, MARGIN, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.messages import RunState
from rigapp.viewer.channels import SIZE, FreeValue, value_text
from rigapp.viewer.knownwear import COEFFICIENT, REMAINING, wear_of
from rigapp.viewer.margins import Margin, margins
from rigapp.viewer.news import News, Takes
from rigapp.viewer.shown import (
    MARKS,
    Level,
    Renewed,
    age_of,
    aged,
    free_values,
    level_of,
    quantity_level,
)

BEFORE = frozenset({RunState.IDLE, RunState.CONNECTING, RunState.READY, RunState.CALIBRATING})
"""States before a test, in which the connection matters."""
MOST = 8


def connection_steps(news: News) -> list[ShownStep]:
    """Return the steps until the rig is ready, in order; the first pending one is next."""
    status = news.status
    if status is None:
        looking = marked("searching for it, or starting it")
        later = [ShownStep(name, "after the engine") for name in ("Devices", "First samples")]
        return _marked([ShownStep("Engine", looking), *later])
    steps = [ShownStep("Engine", status.rig.name, done=True)]
    waits = status.engine.state is RunState.IDLE
    for device in status.rig.devices:
        identity = device.identity or tr("{} on {}", device.driver, device.port)
        line = translate(device.last_error) or (
            identity if device.connected else tr("finding {}", identity)
        )
        steps.append(ShownStep(device.name, line, device.connected))
    if not status.rig.devices:
        steps.append(ShownStep("Devices", "not connected yet" if waits else "making the ports"))
    age = news.data_age_s
    data = age is not None and math.isfinite(age) and not waits
    steps.append(ShownStep("First samples", "arriving" if data else "after the devices", data))
    return _marked(steps)


def _marked(steps: Sequence[ShownStep]) -> list[ShownStep]:
    first = next((step for step in steps if not step.done), None)
    return [replace(step, now=step is first) for step in steps]


class ConnectingCard(QFrame):
    """Show the steps in place of the limits, which are irrelevant before a test."""

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
        """Apply a theme."""
        self._theme = theme
        self._show()

    def show_news(self, news: News) -> None:
        """Show the progress of the connection."""
        self._steps = connection_steps(news)
        self._show()

    def _show(self) -> None:
        done, total = sum(step.done for step in self._steps), len(self._steps)
        title = tr("Connected") if done == total else tr("Connecting, {} of {} done", done, total)
        self.title.show_text(title)
        self.bar.setMaximum(max(total, 1))
        self.bar.setValue(done)
        for row, step in zip(self.rows, self._steps, strict=False):
            row.show_step(step, self._theme)
        for number, row in enumerate(self.rows):
            if row.isVisibleTo(self) != (number < total):
                row.setVisible(number < total)


WIDTH = 42 * STEP
NARROW_WIDTH = 39 * STEP
MOST_WIDTH = 16_777_215
"""Qt's value for no maximum width."""
NARROW_WINDOW = 1440
"""Window width below which the column is narrow."""

MOST_MARGINS = 8
"""Maximum number of listed limits; their page has all of them."""


SHORT_NAME = 9
"""Number of characters of a value's name that leave room for its age."""

TICK = 0.9
"""Position of the limit in the bar's width, with room beyond it for a value above the limit."""

WIDE = dict.fromkeys((COEFFICIENT, REMAINING)).keys()
"""Values whose texts need the whole width, in order."""


LIVE: tuple[tuple[str, Text], ...] = (
    ("force", "|F| now"),
    ("rms", "|F| RMS"),
    ("speed", "Speed"),
    ("age", "Data age"),
)
"""Values of every rig, with their captions."""


class Value(QWidget):
    """A caption and a value."""

    def __init__(self, name: str, caption: Text, theme: Theme) -> None:
        super().__init__()
        named(self, f"live_{name}", caption)
        self.caption = ElidedLabel(f"live_{name}_caption", caption)
        self.caption.setFont(sized(self.font(), CAPTION_PT))
        bold = sized(self.font(), VALUE_PT, QFont.Weight.DemiBold)
        self.value = FittedLabel(f"live_{name}_value", caption, bold)
        column(self.caption, self.value, on=self).setSpacing(0)
        self._name, self._theme = tr(caption), theme
        self._look: tuple[int, bool] = Level.NORMAL, False
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        level, old = self._look
        self.value.setStyleSheet(f"color: {theme.muted if old else theme.ink(level)};")
        self.caption.setStyleSheet(f"color: {theme.muted};")

    def show_field(self, field: TileText) -> None:
        """Show a value, with its optional line beside the caption."""
        detail = tr(field.detail)
        # Where there is no room, the name is cut rather than the age.
        short = f"{self._name[:SHORT_NAME].rstrip()}…, {tr(field.short)}" if field.short else ""
        self.caption.show_text(f"{self._name}, {detail}" if detail else self._name, short)
        self.value.show_text(f"{MARKS[Level(field.level)]}{tr(field.value)}")
        if (field.level, field.old) != self._look:
            self._look = field.level, field.old
            self.dress(self._theme)


class LiveCard(QFrame):
    """The newest values: force, speed, age of the data, and every free channel."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        named(self, "live", "Newest values").setProperty("role", "card")
        self.values = {name: Value(name, caption, theme) for name, caption in LIVE}
        self.free: dict[str, Value] = {}
        self._grid = QGridLayout(self)
        self._grid.setContentsMargins(MARGIN, GAP, MARGIN, GAP)
        self._grid.setHorizontalSpacing(MARGIN)
        self._grid.setVerticalSpacing(STEP)
        for side in (0, 1):
            self._grid.setColumnStretch(side, 1)
        self._place()

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        for value in (*self.values.values(), *self.free.values()):
            value.dress(theme)

    def show_news(self, news: News) -> None:
        """Show the newest values."""
        status, rows = news.status, news.data.rows
        views = {view.name: view for view in status.rig.channels} if status is not None else {}
        parts = [views[name].value for name in ("force_1", "force_2") if name in views]
        force = math.hypot(*parts) if len(parts) == 2 else math.nan
        alarms = status.alarms if status is not None else ()
        rms, rpm = rows.last(f"{SIZE}_rms"), status.rig.speed_rpm if status is not None else None
        fields = {
            name: aged(TileText(value_text(value, unit, 1), level=level), age_of(news, renewed))
            for name, value, unit, level, renewed in (
                ("force", force, "N", level_of(alarms, SIZE), Renewed.SAMPLE),
                ("rms", rms, "N", level_of(alarms, f"{SIZE}_rms"), Renewed.REVOLUTION),
                ("speed", rpm, "rpm", quantity_level(alarms, "speed"), Renewed.SAMPLE),
            )
        }
        fields["age"] = data_age(status, news.data_age_s)
        for name, field in fields.items():
            self.values[name].show_field(field)
        predicted = age_of(news, Renewed.PREDICTION)
        wear = (aged(quantity, predicted) for quantity in wear_of(news, time.time()))
        self.show_free([*free_values(news), *wear])

    def show_free(self, values: Sequence[FreeValue]) -> None:
        """Show a value for each free channel of the rig."""
        names = [value.name for value in values]
        if names != list(self.free):
            for old in self.free.values():
                old.deleteLater()
            self.free = {item.name: Value(item.name, item.title, self._theme) for item in values}
            self._place()
        for value in values:
            self.free[value.name].show_field(
                TileText(value.value, value.detail, value.level, value.short, value.old)
            )

    def _place(self) -> None:
        values = {**self.values, **self.free}
        narrow = [value for name, value in values.items() if name not in WIDE]
        for number, value in enumerate(narrow):
            self._grid.addWidget(value, number // 2, number % 2)
        below = (len(narrow) + 1) // 2
        for number, name in enumerate(WIDE & values.keys()):
            self._grid.addWidget(values[name], below + number, 0, 1, 2)


class MarginBar(QProgressBar):
    """A bar that fills towards a tick at the limit, and beyond it when the limit is exceeded."""

    def __init__(self, name: str, theme: Theme) -> None:
        super().__init__()
        named(self, name, "Distance to the limit")
        self.theme, self.passed, self.level = theme, False, Level.NORMAL
        self.setTextVisible(False)
        self.setMaximum(1000)
        self.setFixedHeight(STEP)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint track, filled part and tick."""
        theme, painter = self.theme, QPainter(self)
        tick = round(TICK * self.width())
        share = 1.0 if self.passed else TICK * self.value() / self.maximum()
        painter.fillRect(0, 2, self.width(), 4, QColor(theme.track))
        colour = QColor((theme.bar, theme.warning, theme.critical)[self.level])
        painter.fillRect(0, 2, round(share * self.width()), 4, colour)
        painter.fillRect(tick, 0, 2, self.height(), QColor(theme.text))
        painter.end()


class MarginRow(QWidget):
    """A limit: quantity, value and limit as text, and a bar with a tick at the limit."""

    def __init__(self, number: int, theme: Theme) -> None:
        super().__init__()
        named(self, f"margin_{number}", "Limit")
        self._theme = theme
        self._look = Level.NORMAL, False, False
        self.title = ElidedLabel(f"margin_{number}_title", "Limited quantity")
        self.text = ElidedLabel(f"margin_{number}_text", "Value and limit")
        self.text.setFont(sized(self.font(), CAPTION_PT))
        self.bar = MarginBar(f"margin_{number}_bar", theme)
        column(self.title, self.text, self.bar, on=self).setSpacing(2)
        self.dress(theme)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        level, passed, old = self._look
        ink = theme.muted if old else theme.ink(level, theme.secondary)
        self.text.setStyleSheet(f"color: {ink};")
        self.title.setStyleSheet(f"color: {theme.muted if old else theme.text};")
        self.bar.theme, self.bar.passed, self.bar.level = theme, passed, level
        self.bar.update()

    def show_margin(self, margin: Margin, *, old: bool) -> None:
        """Show a limit; old: the revolution is not recent."""
        self.title.show_text(margin.limit.title)
        self.text.show_text(MARKS[margin.level] + margin.text)
        self.bar.setValue(round(1000 * margin.used))
        self.setAccessibleDescription(f"{margin.limit.title}: {margin.text}")
        look = margin.level, margin.passed, old
        if look != self._look:
            self._look = look
            self.dress(self._theme)


class LimitsCard(QFrame):
    """The limits for the newest revolution."""

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        named(self, "limits_watched", "Limits watched").setProperty("role", "card")
        self.title = ElidedLabel("limits_watched_title", "Limits watched")
        self.title.setProperty("role", "title")
        self.rows = [MarginRow(number, theme) for number in range(MOST_MARGINS)]
        layout = column(self.title, *self.rows, on=self)
        layout.setContentsMargins(MARGIN, GAP, MARGIN, GAP)
        layout.setSpacing(STEP)
        for row in self.rows:
            row.hide()

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        for row in self.rows:
            row.dress(theme)

    def show_news(self, news: News) -> None:
        """Show the newest revolution beside its limits."""
        limits = margins(news)[:MOST_MARGINS]
        age = age_of(news, Renewed.REVOLUTION)
        title = tr("Limits watched") if limits else tr("No limit is watched now")
        self.title.show_text(f"{title}, {age.text}" if limits and age.old else title)
        for row, margin in zip(self.rows, limits, strict=False):
            row.show_margin(margin, old=age.old)
        for number, row in enumerate(self.rows):
            if row.isVisibleTo(self) != (number < len(limits)):
                row.setVisible(number < len(limits))


class SideColumn(QScrollArea):
    """The cards; the recovery replaces the limits, and nothing else moves.

    The window updates it together with the state bar, since its ages increase; as a panel it only
    requires the log, for changed limits.
    """

    takes = Takes.LOG

    def __init__(self, theme: Theme, recover: RecoverPanel) -> None:
        super().__init__()
        named(self, "side", "Newest values and limits")
        self.live = LiveCard(theme)
        self.limits = LimitsCard(theme)
        self.connecting = ConnectingCard(theme)
        self.recover = recover
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.setWidgetResizable(True)
        content = QWidget()
        self.alarms = AlarmGlance()
        cards = (self.live, recover, self.alarms, self.connecting, self.limits)
        column(*cards, None, on=content).setSpacing(GAP)
        self.setWidget(content)
        self.make_room(NARROW_WINDOW, tight=False)

    def make_room(self, width: int, *, tight: bool, alone: bool = False) -> None:
        """Fit the column to the width of the window; a tight one shows no newest values.

        alone: the column has the whole width, without a page beside it.
        """
        beside = WIDTH if width >= NARROW_WINDOW else NARROW_WIDTH
        self.setMinimumWidth(0 if alone else beside)
        self.setMaximumWidth(MOST_WIDTH if alone else beside)
        self.live.setVisible(not tight)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        for card in (self.live, self.limits, self.connecting, self.recover):
            card.dress(theme)

    def show_news(self, news: News) -> None:
        """Show newest values, and the limits, the recovery or (before a test) the connection."""
        self.live.show_news(news)
        if news.status is not None:
            self.alarms.show_alarms(news.status.alarms, recorded=news.is_replay)
        before = not news.is_replay and (news.status is None or news.status.engine.state in BEFORE)
        normal = self.recover.isHidden()
        for card, wanted in (
            (self.connecting, normal and before),
            (self.limits, normal and not before),
        ):
            if card.isVisibleTo(self) != wanted:
                card.setVisible(wanted)
            if wanted:
                card.show_news(news)
