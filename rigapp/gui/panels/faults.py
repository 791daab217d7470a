"""The fault list of the simulated rig: cause one, watch what the program makes of it, end it."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFormLayout, QLabel, QVBoxLayout, QWidget

from rigapp.gui.data.channels import SIZE
from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.tasks import TaskWorker
from rigapp.gui.panel import Host
from rigapp.gui.widgets.build import button, choice, edit, filled, named, prose
from rigapp.schema.channels import BASE
from rigapp.service.faults import FaultChoice, fault_choices


class FaultPanel(QWidget):
    """Choose a fault, cause it, end it."""

    wanted = Signal(str, dict)
    takes = Takes.HISTORY

    def __init__(self, worker: TaskWorker) -> None:
        super().__init__()
        self._worker = worker
        self._devices: tuple[tuple[str, str], ...] | None = None
        self._choices: list[FaultChoice] = []
        named(self, "fault_panel", "Faults of the simulated rig")
        self.kind = choice("fault_kind", "Fault", (), self._chosen)
        self.kind.setMaxVisibleItems(30)
        self.kind.setPlaceholderText("Looking for the faults of the devices …")
        self.channel = choice("fault_channel", "Channel of a signal fault", ())
        self.duration = edit("fault_duration", "Duration in seconds, empty: until ended")
        self.duration.setText("2")
        self.value = edit("fault_value", "Value of the fault, empty: its default", hint="default")
        self.cause = button(
            "fault_cause", "Cause fa&ult", self._cause, "Cause the fault", guarded=True
        )
        self.end = button("fault_end", "&End fault", self._end, "End the fault", guarded=True)
        self.problem = named(QLabel(), "fault_problem", "Why the fault cannot be caused")
        inside = QWidget()
        form = QFormLayout(inside)
        for caption, field in (
            ("Fault", self.kind),
            ("Channel (signal faults)", self.channel),
            ("Duration (s), empty: until ended", self.duration),
            ("Value, empty: default", self.value),
        ):
            form.addRow(caption, field)
        for widget in (self.cause, self.end, self.problem):
            form.addRow(widget)
        inside.setMaximumWidth(self.fontMetrics().horizontalAdvance("M") * 50)
        note = prose(
            "fault_note",
            "What these faults are",
            "These faults happen in the simulated devices, on the wire or on the signals, not in"
            " the program: what you see is what a real fault would show.",
        )
        filled(QVBoxLayout(self), (note, inside, None))

    def show_news(self, news: News) -> None:
        """Offer the faults of the devices that are there, and the inputs of the rig."""
        status = news.status
        if status is None:
            return
        views = [one.name for one in status.channels if one.age_s is None and one.name != SIZE]
        self._offer_channels(views or [one.name for one in BASE.sampled])
        devices = tuple((device.name, device.driver) for device in status.devices)
        if devices == self._devices or not devices:
            return
        self._devices = devices
        self._worker.submit(lambda: fault_choices(devices), self._offer, self._cannot)

    def _cannot(self, error: Exception) -> None:
        self.problem.setText(f"The faults of the simulated rig are not known: {error}")

    def _offer(self, choices: list[FaultChoice]) -> None:
        self._choices = choices
        self.cause.setEnabled(bool(choices))
        self.end.setEnabled(bool(choices))
        self.kind.clear()
        for one in self._choices:
            self.kind.addItem(f"{one.where}: {one.kind.replace('_', ' ')}")
        self.kind.setCurrentIndex(0 if choices else -1)

    def _offer_channels(self, names: list[str]) -> None:
        """Offer the channels with an input; what was chosen stays, where it is still there."""
        if names == [self.channel.itemText(place) for place in range(self.channel.count())]:
            return
        chosen = self.channel.currentText()
        self.channel.clear()
        self.channel.addItems(names)
        self.channel.setCurrentIndex(max(self.channel.findText(chosen), 0))

    def _choice(self) -> FaultChoice | None:
        index = self.kind.currentIndex()
        return self._choices[index] if 0 <= index < len(self._choices) else None

    def _chosen(self) -> None:
        choice = self._choice()
        self.channel.setEnabled(choice is not None and choice.where == "signal")

    def _cause(self) -> None:
        choice = self._choice()
        if choice is None:
            self.problem.setText("No simulated device is connected.")
            return
        arguments: dict[str, Any] = {"kind": choice.kind}
        if choice.where == "signal":
            arguments["channel"] = self.channel.currentText()
        else:
            arguments["device"] = choice.where
        for name, field in (("duration_s", self.duration), ("value", self.value)):
            text = field.text().strip()
            if not text:
                continue
            try:
                arguments[name] = float(text)
            except ValueError:
                self.problem.setText(f"{name} must be a number, not {text!r}.")
                return
        self.problem.setText("")
        self.wanted.emit("inject_fault", arguments)

    def _end(self) -> None:
        choice = self._choice()
        if choice is not None:
            self.wanted.emit("clear_fault", {"kind": choice.kind})


def fault_page(host: Host) -> QWidget:
    """Make the page of the simulated rig's faults."""
    panel = host.add("faults", FaultPanel(host.worker))
    panel.wanted.connect(host.ask)
    return panel
