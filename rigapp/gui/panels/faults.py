"""The faults of the simulated rig: find a fault, inject it, end it."""

from __future__ import annotations

import math
from typing import Any, Final

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFormLayout, QFrame, QVBoxLayout, QWidget

from rigapp.gui.panel import Host
from rigapp.gui.widgets.build import (
    button,
    choice,
    column,
    edit,
    filled,
    fit_hint,
    named,
    prose,
    row,
    set_property,
)
from rigapp.gui.widgets.numbers import number
from rigapp.gui.widgets.reflow import FoldingSplitter
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.tokens import GAP, STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.channels import BASE
from rigapp.service.faults import FaultChoice, fault_choices
from rigapp.texts import sentence_of_error
from rigapp.viewer.channels import SIZE
from rigapp.viewer.news import News, Takes
from rigapp.viewer.tasks import TaskWorker

BESIDE_FROM, LIST_HEIGHT, CARD_HEIGHT = 90 * STEP, 32 * STEP, 36 * STEP
"""Width of list and card beside each other; height of each below the other."""
SIGNAL: Final = "signal"
"""Place of a signal fault; its duration is in simulated time, that of others in real time."""

SECONDS: Final[tuple[tuple[Text, str], ...]] = (
    ("real seconds", "real"),
    ("simulated seconds", "simulated"),
)


class FaultPanel(QWidget):
    """Find a fault, inject it, end it."""

    wanted = Signal(str, dict)
    takes = Takes.HISTORY

    def __init__(self, worker: TaskWorker) -> None:
        super().__init__()
        self._worker = worker
        self._devices: tuple[tuple[str, str], ...] | None = None
        self._choices: list[FaultChoice] = []
        self._speed = math.nan
        named(self, "fault_panel", "Faults of the simulated rig")
        self.search = edit(
            "fault_search", "Find a fault", self._show, hint="find, e.g. cable, spikes, daq"
        )
        self.search.setClearButtonEnabled(True)
        self.shown: list[FaultChoice] = []
        self.list = PlainTable("fault_list", "Faults", ("Where", "Fault"), marked=0)
        self.list.itemSelectionChanged.connect(self._chosen)
        self.channel = choice("fault_channel", "Channel of a signal fault", ())
        self.converted = prose("fault_converted", "Duration in the other seconds", role="caption")
        self.seconds = choice("fault_seconds", "Real or simulated seconds", SECONDS)
        self.duration = edit(
            "fault_duration", "Duration, empty: until ended", self._convert, hint="until ended"
        )
        self.duration.setText("2")
        self.seconds.currentIndexChanged.connect(self._convert)
        self.value = edit("fault_value", "Value of the fault, empty: its default", hint="default")
        self.cause = button(
            "fault_cause", "Cause fa&ult", self._cause, "Cause the fault", guarded=True
        )
        self.end = button("fault_end", "&End fault", self._end, "End the fault", guarded=True)
        self.problem = prose("fault_problem", "Why the fault cannot be caused", role="error")
        self._build()
        self._chosen()

    def _build(self) -> None:
        note = prose(
            "fault_note",
            "What these faults are",
            "These faults happen in the simulated devices, on the wire or on the signals, not in"
            " the program: what you see is what a real fault would show.",
        )
        card = named(QFrame(), "fault_card", "The chosen fault", role="card")
        form = QFormLayout()
        form.setRowWrapPolicy(QFormLayout.RowWrapPolicy.WrapLongRows)
        for caption, field in (
            (tr("Channel (signal faults)"), self.channel),
            (tr("Duration, empty: until ended"), row((self.duration, 1), self.seconds)),
            ("", self.converted),
            (tr("Value, empty: default"), self.value),
        ):
            form.addRow(caption, field)
        form.addRow(row(self.cause, self.end, None))
        form.addRow(self.problem)
        column(note, form, None, on=card, margins=(2 * STEP, GAP), spacing=GAP)
        left = filled(QVBoxLayout(), (self.search, (self.list, 1)))
        search = QWidget()
        search.setLayout(left)
        left.setContentsMargins(0, 0, 0, 0)
        for box in (self.search, self.duration, self.value):
            fit_hint(box)
        card.setMinimumHeight(CARD_HEIGHT)
        parts = FoldingSplitter("fault_split", BESIDE_FROM).divide(
            (search, 500, LIST_HEIGHT), (card, 500, CARD_HEIGHT)
        )
        column(parts, on=self)

    def show_news(self, news: News) -> None:
        """List the faults of the connected devices, and the inputs of the rig."""
        status = news.status
        if status is None:
            return
        if status.rig.simulated_speed != self._speed:
            self._speed = status.rig.simulated_speed
            self._convert()
        sampled = [view.name for view in status.rig.channels if view.age_s is None]
        names = [name for name in sampled if name != SIZE]
        self._offer_channels(names or [channel.name for channel in BASE.sampled])
        devices = tuple((device.name, device.driver) for device in status.rig.devices)
        if devices == self._devices or not devices:
            return
        self._devices = devices
        set_property(self.problem, "role", "secondary")
        self.problem.setText(tr("The faults are being listed …"))
        self._worker.submit(lambda: fault_choices(devices), self._offer, self._show_error)

    def _show_error(self, error: Exception) -> None:
        set_property(self.problem, "role", "error")
        self.problem.setText(tr("The faults of the simulated rig are not known: {}", error))

    def _offer(self, choices: list[FaultChoice]) -> None:
        self._choices = choices
        set_property(self.problem, "role", "error")
        self.problem.setText("")
        self._show()

    def _show(self) -> None:
        """List the faults that contain every searched word; the selection stays."""
        chosen = self._choice()
        words = self.search.text().lower().split()
        self.shown = [
            fault
            for fault in self._choices
            if all(word in f"{fault.where} {_words(fault.kind)}".lower() for word in words)
        ]
        self.list.show_rows([(fault.where, _words(fault.kind)) for fault in self.shown])
        if self.shown:
            self.list.selectRow(self.shown.index(chosen) if chosen in self.shown else 0)
        self._chosen()

    def _offer_channels(self, names: list[str]) -> None:
        """List the channels with an input; the selection stays where it still exists."""
        if names == [self.channel.itemText(index) for index in range(self.channel.count())]:
            return
        chosen = self.channel.currentText()
        self.channel.clear()
        self.channel.addItems(names)
        self.channel.setCurrentIndex(max(self.channel.findText(chosen), 0))

    def _choice(self) -> FaultChoice | None:
        return self.list.chosen_of(self.shown)

    def _chosen(self) -> None:
        chosen = self._choice()
        self.channel.setEnabled(chosen is not None and chosen.where == SIGNAL)
        self.cause.setEnabled(chosen is not None)
        self.end.setEnabled(chosen is not None)

    @property
    def _runs_at(self) -> float | None:
        """Return simulated seconds per real second, None where unknown."""
        known = math.isfinite(self._speed) and self._speed > 0.0
        return self._speed if known else None

    def _convert(self) -> None:
        """Show the duration in the other kind of seconds."""
        speed, text = self._runs_at, ""
        try:
            seconds = number(self.duration.text())
        except ValueError:
            seconds = math.nan
        if speed is not None and math.isfinite(seconds):
            if self.seconds.currentData() == "simulated":
                text = tr("= {} s by the clock, at × {}", f"{seconds / speed:.3g}", f"{speed:.3g}")
            else:
                text = tr("= {} s simulated, at × {}", f"{seconds * speed:.3g}", f"{speed:.3g}")
        self.converted.setText(text)

    def _seconds_for(self, fault: FaultChoice, seconds: float) -> float:
        """Return a duration in the seconds that the fault uses; raise ValueError."""
        used = "simulated" if fault.where == SIGNAL else "real"
        if self.seconds.currentData() == used:
            return seconds
        if self._runs_at is None:
            named_so = next(text for text, kind in SECONDS if kind == used)
            raise ValueError(
                tr("This rig runs as fast as it can: choose {} for this fault.", tr(named_so))
            )
        return seconds * self._runs_at if used == "simulated" else seconds / self._runs_at

    def _cause(self) -> None:
        chosen = self._choice()
        if chosen is None:
            return
        arguments: dict[str, Any] = {"kind": chosen.kind}
        if chosen.where == SIGNAL:
            arguments["channel"] = self.channel.currentText()
        else:
            arguments["device"] = chosen.where
        try:
            duration = self._number(self.duration.text(), tr("The duration"))
            if duration is not None:
                arguments["duration_s"] = self._seconds_for(chosen, duration)
            value = self._number(self.value.text(), tr("The value"))
        except ValueError as error:
            self.problem.setText(translate(sentence_of_error(error)))
            return
        if value is not None:
            arguments["value"] = value
        self.problem.setText("")
        self.wanted.emit("inject_fault", arguments)

    def _number(self, text: str, subject: str) -> float | None:
        if not text.strip():
            return None
        try:
            return number(text)
        except ValueError:
            raise ValueError(tr("{} must be a number, not {}.", subject, repr(text))) from None

    def _end(self) -> None:
        chosen = self._choice()
        if chosen is not None:
            self.wanted.emit("clear_fault", {"kind": chosen.kind})


def _words(kind: str) -> str:
    return kind.replace("_", " ")


def fault_page(host: Host) -> QWidget:
    """Make the page of the simulated rig's faults."""
    panel = host.add("faults", FaultPanel(host.worker))
    panel.wanted.connect(host.ask)
    return panel
