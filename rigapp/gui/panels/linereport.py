"""Record the traffic between devices and program for a bug report, and pack it."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Final

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QCheckBox, QFrame

from rigapp.gui.widgets.build import button, choice, column, named, prose, styled_label
from rigapp.gui.widgets.reflow import flowing
from rigapp.presentation.tokens import GAP, MARGIN, STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.messages import LineReport, RunState, Status
from rigapp.schema.states import ACTIVE

TIMES: Final[dict[Text, float]] = {
    "10 s": 10.0,
    "1 min": 60.0,
    "10 min": 600.0,
    "until it is ended": 0.0,
}
ABOUT: Final[Text] = (
    "Records all device traffic and packs it with log, rig file and versions into one"
    " file to send with a bug report. Names, folders, addresses and keys are removed."
)


class LineReportCard(QFrame):
    """Choose devices and time, record, end; show the progress and the path of the report.

    folder: where reports are written. wanted: a request to the engine.
    """

    wanted = Signal(str, dict)

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self._folder = folder
        named(self, "line_report", "Record for a bug report", role="card")
        self.devices = choice("report_devices", "Devices to record", [("all devices", "")])
        self.time = choice("report_time", "Time to record", list(TIMES.items()))
        self.reconnect = named(
            QCheckBox(tr("Reconnect first")),
            "report_reconnect",
            "Reconnect first",
            "Also records how the devices are found and set up. Not during a test.",
        )
        self.reconnect.setChecked(True)
        self.record = button(
            "report_begin", "Record", self._begin, "Record for a bug report", guarded=True
        )
        self.end = button(
            "report_end",
            "End and pack",
            lambda: self.wanted.emit("report_end", {}),
            "End the recording and pack it",
            guarded=True,
        )
        self.progress = prose("report_told", "What is recorded for a bug report", role="secondary")
        column(
            styled_label("Record for a bug report", "title"),
            prose("report_about", "What is recorded", ABOUT, role="caption"),
            flowing(self.devices, self.time, self.reconnect, self.record, self.end),
            self.progress,
            on=self,
            margins=(MARGIN, GAP),
            spacing=STEP,
        )
        self.show_status(None)

    def show_status(self, status: Status | None) -> None:
        """Show the recording in progress, or the path of the last report."""
        names = [device.name for device in status.rig.devices] if status is not None else []
        listed = [self.devices.itemData(index) for index in range(1, self.devices.count())]
        if names and listed != names:
            chosen = self.devices.currentData()
            while self.devices.count() > 1:
                self.devices.removeItem(1)
            for name in names:
                self.devices.addItem(name, name)
            self.devices.setCurrentIndex(max(0, self.devices.findData(chosen)))
        report = status.engine.line_report if status is not None else None
        recording = report is not None and not report.sentence
        state = status.engine.state if status is not None else None
        for control in (self.devices, self.time):
            control.setEnabled(not recording)
        self.reconnect.setEnabled(not recording and state not in (*ACTIVE, RunState.CALIBRATING))
        self.record.setEnabled(status is not None and not recording)
        self.end.setEnabled(recording)
        self.progress.setText("" if report is None else words_of(report, time.time()))
        self.progress.setVisible(report is not None)

    def _begin(self) -> None:
        name = time.strftime("bug-report-%Y%m%d-%H%M%S.zip")
        device = self.devices.currentData()
        self.wanted.emit(
            "report_begin",
            {
                "file": str((self._folder / name).resolve()),
                "devices": [device] if device else [],
                "duration_s": self.time.currentData(),
                "reconnect": self.reconnect.isEnabled() and self.reconnect.isChecked(),
            },
        )


def words_of(report: LineReport, now: float) -> str:
    """Return the progress and remaining time of a recording, or its result; now: s since 1970."""
    if report.sentence:
        return translate(report.sentence)
    devices, since = ", ".join(report.devices), max(0.0, now - report.since)
    if report.until:
        left = max(0.0, report.until - now)
        return tr("Recording {}: {:.0f} s, {:.0f} s left.", devices, since, left)
    return tr(
        "Recording {}: {:.0f} s. End and pack it when you have seen the fault.", devices, since
    )
