"""Alarms as cards with condition, consequence and remedy; acknowledge and shelve."""

from __future__ import annotations

import time
from collections.abc import Sequence
from functools import partial
from typing import Final

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QFont, QKeyEvent, QMouseEvent
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLabel,
    QLayout,
    QSizePolicy,
    QSplitter,
    QWidget,
)

from rigapp.gui.look.fonts import sized
from rigapp.gui.panel import Host
from rigapp.gui.panels.limits import LimitPanel
from rigapp.gui.panels.logbook import AlarmJournal
from rigapp.gui.widgets.build import (
    button,
    column,
    edit,
    fit_hint,
    named,
    prose,
    row,
    scrolling,
    set_property,
    split,
    styled_label,
    whole_number,
)
from rigapp.gui.widgets.details import FoldedDetails
from rigapp.gui.widgets.reflow import FoldingSplitter, flowing
from rigapp.presentation.tokens import GAP, STEP, VALUE_PT
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.details import details_of
from rigapp.schema.messages import NOTE_CHARACTERS, Alarm, RunState, Severity
from rigapp.schema.words import WORDS
from rigapp.viewer.news import News, Takes

MARKS: Final[dict[Severity, Text]] = {
    Severity.WARNING: "▲ Warning",
    Severity.CRITICAL: "◆ Critical",
}
LINES: Final[dict[str, Text]] = {
    "cause": "Cause",
    "consequence": "Effect",
    "action": "To do",
}
"""Fields of an alarm that a card shows in full, with their captions."""

RECORDED: Final[Text] = "This is a replay: the recording is not changed"
BESIDE_FROM, LIST = 100 * STEP, 32 * STEP
"""Width for limits and journal beside each other, height of each below the other."""
TITLE_WIDTH = 16 * STEP
HEIGHTS = (360, 340)
"""Heights of the alarms and of the part below them."""
CARDS_HEIGHTS = (0, 32 * STEP, 42 * STEP)
"""Minimum heights of the alarms by their number: complete cards, and the tools below them."""


def order(alarms: tuple[Alarm, ...]) -> list[Alarm]:
    """Return the alarms to show: first-out, then unacknowledged, then worst, then oldest."""
    return sorted(
        (alarm for alarm in alarms if alarm.state != "normal"),
        key=lambda alarm: (
            not alarm.first_out,
            alarm.acknowledged,
            alarm.severity is not Severity.CRITICAL,
            alarm.raised_at,
        ),
    )


def newest_critical(alarms: Sequence[Alarm]) -> Alarm | None:
    """Return the newest critical alarm, unacknowledged ones first."""
    critical = [alarm for alarm in alarms if alarm.severity is Severity.CRITICAL]
    return max(critical, key=lambda alarm: (not alarm.acknowledged, alarm.raised_at), default=None)


class AlarmCard(QFrame):
    """One alarm: severity as shape and word, name, start time, and its texts."""

    pressed = Signal()

    def __init__(self, name: str, *, large: bool) -> None:
        super().__init__()
        named(self, name, "Alarm")
        self._large = large
        self.chip = named(QLabel(), f"{name}_chip", "Severity")
        self.title = prose(f"{name}_title", "Alarm", role="title")
        if large:
            self.title.setFont(sized(self.font(), VALUE_PT, QFont.Weight.DemiBold))
        self.state = named(QLabel(), f"{name}_state", "State of the alarm")
        self.since = named(QLabel(), f"{name}_since", "Since when", role="caption")
        grid = QGridLayout()
        grid.setHorizontalSpacing(GAP)
        grid.setVerticalSpacing(STEP // 2)
        grid.setColumnStretch(1, 1)
        self.texts: dict[str, QLabel] = {}
        self.captions: list[QLabel] = []
        for line, (key, caption) in enumerate(LINES.items()):
            self.captions.append(styled_label(caption, "secondary"))
            self.texts[key] = prose(f"{name}_{key}", caption)
            grid.addWidget(self.captions[-1], line, 0, Qt.AlignmentFlag.AlignTop)
            grid.addWidget(self.texts[key], line, 1)
        self.texts["action"].setProperty("role", "title")
        self.details = FoldedDetails(name)
        grid.addWidget(self.details, len(LINES), 1)
        if large:
            head: list[QWidget | QLayout] = [
                flowing(self.chip, (self.title, 1), self.state, self.since)
            ]
            self.title.setMinimumWidth(TITLE_WIDTH)
        else:
            head = [flowing(self.chip, None, self.since), self.title, self.state]
        column(*head, grid, on=self, margins=(GAP, STEP), spacing=STEP)

    def show_alarm(self, alarm: Alarm, *, full: bool, chosen: bool) -> None:
        """Show an alarm; full: with all its texts, else only with its name."""
        severity = "critical" if alarm.severity is Severity.CRITICAL else "attention"
        set_property(self, "role", "card" if alarm.acknowledged else severity)
        set_property(self, "chosen", chosen)
        set_property(self.chip, "chip", "calm" if alarm.acknowledged else severity)
        first = f", {tr('first')}" if alarm.first_out else ""
        self.chip.setText(f"{tr(MARKS[alarm.severity])}{first}")
        self.chip.setToolTip(_explained("first") if alarm.first_out else "")
        self.title.setText(translate(alarm.title))
        self.title.setToolTip(_explained(alarm.title))
        self.state.setText(tr(alarm.state))
        self.state.setToolTip(_explained(alarm.state))
        stamp = time.strftime("%H:%M:%S", time.localtime(alarm.raised_at))
        cycle = tr("{}, cycle {}", stamp, alarm.revolution)
        self.since.setText(cycle if self._large else stamp)
        self.since.setToolTip(cycle)
        for key, label in self.texts.items():
            label.setText(translate(getattr(alarm, key)))
        for part in (*self.captions, *self.texts.values()):
            part.setVisible(full)
        self.details.show_details(details_of(alarm.cause) if full else "")
        name = f"{tr(MARKS[alarm.severity])}: {translate(alarm.title)}, {tr(alarm.state)}"
        self.setAccessibleName(name)
        self.setAccessibleDescription(translate(alarm.action))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Select the alarm."""
        self.pressed.emit()
        super().mousePressEvent(event)


def _explained(word: str) -> str:
    """Return a word with its meaning, empty where the table has none."""
    return f"{tr(word)}: {tr(WORDS[word])}" if word in WORDS else ""


class AlarmCards(QWidget):
    """The alarms below each other; one of them is chosen, a new critical one automatically.

    large: every card shows all texts, and the keys Up and Down choose; else only the chosen one.
    """

    changed = Signal()

    def __init__(self, prefix: str, *, large: bool) -> None:
        super().__init__()
        self._prefix, self._large = prefix, large
        self._alarms: list[Alarm] = []
        self._chosen = ""
        named(self, f"{prefix}_alarm_cards", "List of alarms")
        if large:
            self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.cards: list[AlarmCard] = []
        self.none = prose(f"{prefix}_no_alarms", "No alarms", "No alarms.", role="secondary")
        self._list = column(self.none, None, on=self, spacing=STEP)

    @property
    def alarms(self) -> list[Alarm]:
        """Return the shown alarms in order."""
        return self._alarms

    def show_alarms(self, alarms: tuple[Alarm, ...]) -> None:
        """Show the alarms; the selection stays unless there is a new critical one."""
        ordered = order(alarms)
        if ordered == self._alarms:
            return
        known = {alarm.key for alarm in self._alarms}
        newest = newest_critical([alarm for alarm in ordered if alarm.key not in known])
        self._alarms = ordered
        if newest is not None:
            self._chosen = newest.key
        elif self._chosen not in {alarm.key for alarm in ordered}:
            first = newest_critical(ordered) or next(iter(ordered), None)
            self._chosen = first.key if first is not None else ""
        self._fill()

    def chosen(self) -> Alarm | None:
        """Return the chosen alarm."""
        return next((alarm for alarm in self._alarms if alarm.key == self._chosen), None)

    def choose(self, index: int) -> None:
        """Choose a card."""
        if 0 <= index < len(self._alarms):
            self._chosen = self._alarms[index].key
            self._fill()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Up and Down choose another card."""
        step = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1}.get(Qt.Key(event.key()))
        chosen = self.chosen()
        if step is None or chosen is None:
            super().keyPressEvent(event)
        else:
            self.choose(self._alarms.index(chosen) + step)

    def _fill(self) -> None:
        while len(self.cards) < len(self._alarms):
            index = len(self.cards)
            card = AlarmCard(f"{self._prefix}_alarm_{index + 1}", large=self._large)
            card.pressed.connect(partial(self.choose, index))
            self.cards.append(card)
            self._list.insertWidget(self._list.count() - 1, card)
        for card, alarm in zip(self.cards, self._alarms, strict=False):
            chosen = alarm.key == self._chosen
            card.show_alarm(alarm, full=self._large or chosen, chosen=self._large and chosen)
        for index, card in enumerate(self.cards):
            card.setVisible(index < len(self._alarms))
        self.none.setVisible(not self._alarms)
        self.changed.emit()


def waiting(alarms: Sequence[Alarm]) -> bool:
    """Return whether any alarm is unacknowledged."""
    return any(not alarm.acknowledged for alarm in alarms)


class AlarmGlance(QFrame):
    """The alarms in the side column, hidden while there is none; emits (verb, arguments)."""

    wanted = Signal(str, dict)

    def __init__(self) -> None:
        super().__init__()
        self._recorded = False
        named(self, "alarm_glance", "Alarms", role="card")
        self.title = named(QLabel(tr("Alarms")), "alarm_glance_title", "Alarms", role="title")
        self.cards = AlarmCards("glance", large=False)
        self.acknowledge = button(
            "glance_acknowledge",
            "Ac&knowledge",
            self._acknowledge,
            "Acknowledge the alarm that is shown in full",
        )
        self.cards.changed.connect(self._enable)
        column(
            row(self.title, None, self.acknowledge), self.cards, on=self, margins=STEP, spacing=STEP
        )
        self.hide()

    def show_alarms(self, alarms: tuple[Alarm, ...], *, recorded: bool = False) -> None:
        """Show the alarms; recorded ones cannot be acknowledged."""
        self._recorded = recorded
        self.cards.show_alarms(alarms)
        self._enable()
        used = bool(self.cards.alarms)
        if self.isHidden() == used:
            self.setVisible(used)

    def _enable(self) -> None:
        alarm = None if self._recorded else self.cards.chosen()
        self.acknowledge.setEnabled(alarm is not None and not alarm.acknowledged)
        self.acknowledge.setToolTip(tr(RECORDED) if self._recorded else "")

    def _acknowledge(self) -> None:
        alarm = self.cards.chosen()
        if alarm is not None:
            self.wanted.emit("acknowledge", {"key": alarm.key})


class AlarmPanel(QWidget):
    """Show the alarms in full with all actions; emits requests as (verb, arguments)."""

    wanted = Signal(str, dict)
    takes = Takes.STATUS

    def __init__(self) -> None:
        super().__init__()
        self._recorded = False
        named(self, "alarm_panel", "Alarms")
        self.cards = AlarmCards("all", large=True)
        self.cards.changed.connect(self._enable)
        self.area = scrolling("alarm_area", "List of alarms", self.cards)
        self.all = button(
            "acknowledge_all",
            "Acknowledge all",
            lambda: self.wanted.emit("acknowledge", {}),
            rank="primary",
        )
        self.acknowledge = button(
            "acknowledge", "Acknowledge", self._acknowledge, "Acknowledge the chosen alarm"
        )
        self.reason = edit(
            "shelve_reason",
            "Reason for shelving",
            self._enable,
            hint="reason for shelving",
            most=NOTE_CHARACTERS,
        )
        self.minutes = whole_number("shelve_minutes", "Minutes of shelving", 1, 480)
        self.minutes.setValue(15)
        self.minutes.setSuffix(" min")
        self.shelve = button(
            "shelve", "S&helve", self._shelve, "Shelve the chosen alarm", guarded=True
        )
        self.reset = button(
            "reset",
            "Reset after trip",
            lambda: self.wanted.emit("reset", {}),
            "Reset after a trip",
            guarded=True,
            tip=(
                "Reset before the next start. Every critical alarm must be acknowledged and"
                " its cause removed. Nothing moves."
            ),
        )
        tools = flowing(
            self.all, self.acknowledge, self.reset, (self.reason, 1), self.minutes, self.shelve
        )
        fit_hint(self.reason)
        self.setMinimumHeight(CARDS_HEIGHTS[1])
        column((self.area, 1), tools, on=self, spacing=STEP)
        self.show_alarms(())
        self._enable()

    def show_news(self, news: News) -> None:
        """Show the alarms of a status."""
        self._recorded = news.is_replay
        if news.status is not None:
            self.show_alarms(news.status.alarms)
            self.show_state(news.status.engine.state)
            self._enable_buttons()

    def show_state(self, state: RunState | None) -> None:
        """Enable the reset after a trip, and whenever an alarm requires it."""
        latched = any(alarm.severity is Severity.CRITICAL for alarm in self.cards.alarms)
        ended = state in (RunState.FAULT, RunState.STOPPED)
        self.reset.setEnabled((latched or ended) and not self._recorded)

    def show_alarms(self, alarms: tuple[Alarm, ...]) -> None:
        """Show the alarms."""
        self.cards.show_alarms(alarms)
        self._take_height(min(len(self.cards.alarms), len(CARDS_HEIGHTS) - 1))

    def _take_height(self, cards: int) -> None:
        """Set the minimum height for a number of cards; without any the journal gets the space."""
        least, before = CARDS_HEIGHTS[cards], self.minimumHeight()
        if least == before:
            return
        self.setMinimumHeight(least)
        self.area.setMinimumHeight(0 if cards else self.cards.none.sizeHint().height())
        policy = QSizePolicy.Policy
        self.setSizePolicy(policy.Preferred, policy.Preferred if cards else policy.Maximum)
        splitter = self.parentWidget()
        if before == CARDS_HEIGHTS[0] and isinstance(splitter, QSplitter):
            splitter.setSizes(list(HEIGHTS))

    def _enable(self) -> None:
        alarm = self.cards.chosen()
        if alarm is not None:
            card = self.cards.cards[self.cards.alarms.index(alarm)]
            # Only after the cards are laid out.
            QTimer.singleShot(0, card, partial(self.area.ensureWidgetVisible, card))
        self._enable_buttons()

    def _enable_buttons(self) -> None:
        """Enable the actions on the selected alarm; a recorded one has none."""
        alarm = None if self._recorded else self.cards.chosen()
        self.all.setEnabled(waiting(self.cards.alarms) and not self._recorded)
        self.acknowledge.setEnabled(alarm is not None and not alarm.acknowledged)
        self.shelve.setEnabled(alarm is not None and bool(self.reason.text().strip()))
        for control in (self.all, self.acknowledge):
            control.setToolTip(tr(RECORDED) if self._recorded else "")

    def _acknowledge(self) -> None:
        alarm = self.cards.chosen()
        if alarm is not None:
            self.wanted.emit("acknowledge", {"key": alarm.key})

    def _shelve(self) -> None:
        alarm = self.cards.chosen()
        if alarm is None:
            return
        self.minutes.interpretText()
        reason, minutes = self.reason.text().strip(), self.minutes.value()
        self.reason.clear()
        self.wanted.emit("shelve", {"key": alarm.key, "reason": reason, "minutes": minutes})


def alarm_page(host: Host) -> QWidget:
    """Make the page of the alarms, their journal and the limits."""
    alarms = host.add("alarms", AlarmPanel())
    limits = host.add("limits", LimitPanel())
    journal = host.add("journal", AlarmJournal())
    for panel in (alarms, limits):
        panel.wanted.connect(host.ask)
    below = FoldingSplitter("alarm_below", BESIDE_FROM).divide(
        (journal, 460, LIST), (limits, 460, LIST)
    )
    return split("alarm_split", Qt.Orientation.Vertical, HEIGHTS, alarms, below)
