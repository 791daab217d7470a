"""What must be right before a test starts: one line each, with what to do."""

from __future__ import annotations

import enum
import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtGui import QBrush, QColor
from PySide6.QtWidgets import (
    QAbstractItemView,
    QGroupBox,
    QHeaderView,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
)

from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.engine.messages import RunState, Severity, Status
from rigapp.gui.palette import Theme


class Verdict(enum.StrEnum):
    """Tell whether a check lets a test start."""

    GOOD = "good"
    ATTENTION = "attention"
    BLOCKS = "blocks"


@dataclass(frozen=True, slots=True)
class Check:
    """One line of the list: what, how it stands, what to do."""

    what: str
    verdict: Verdict
    finding: str
    action: str = ""


@dataclass(frozen=True, slots=True)
class DiskFacts:
    """How much room a test needs and has; problem: one sentence when it cannot be found out."""

    folder: Path
    needed_bytes: int
    free_bytes: int
    problem: str = ""


def disk_facts(test: TestFile, sample_rate_Hz: float, folder: Path) -> DiskFacts:
    """Return the room that a test needs in a folder; reads the disk, call it on a worker."""
    from rigapp.engine.schedule import Schedule
    from rigapp.storage.layout import FilePlan, reserved_bytes, streams_of

    samples = math.ceil(60.0 / test.run.speed_rpm * sample_rate_Hz * 1.05)
    plan = FilePlan(
        revolutions=test.run.revolutions,
        cycles=Schedule(test.cycles, test.run.revolutions).planned(),
        samples_per_cycle=max(1, samples),
        prediction=test.prediction.enabled,
    )
    needed = reserved_bytes(streams_of(plan).values())
    try:
        if not os.access(folder, os.W_OK | os.X_OK):
            return DiskFacts(folder, needed, 0, f"{folder} does not exist or cannot be written to")
        disk = os.statvfs(folder)
    except OSError as error:
        return DiskFacts(folder, needed, 0, f"{folder}: {error}")
    return DiskFacts(folder, needed, disk.f_bavail * disk.f_frsize)


def preflight(
    status: Status | None, test: TestFile | None, rig: RigFile | None, disk: DiskFacts | None
) -> list[Check]:
    """Return every check, in the order in which an operator would go through them."""
    found = [*_of_test(test, rig), *_of_disk(disk)]
    if status is None:
        found.append(
            Check("Engine", Verdict.BLOCKS, "not reachable", "Wait, or start rigapp again")
        )
        return found
    return [*found, *_of_engine(status), *_of_drive(status), *_of_channels(status, rig)]


def _of_test(test: TestFile | None, rig: RigFile | None) -> Iterator[Check]:
    if test is None:
        yield Check("Test", Verdict.BLOCKS, "not usable yet", "See the sentence above the form")
        return
    run = test.run
    text = f"{run.revolutions:,} revolutions at {run.speed_rpm:g} rpm".replace(",", "\u2009")
    hours = run.revolutions / run.speed_rpm / 60.0
    yield Check("Test", Verdict.GOOD, f"{text}, {hours:.1f} h")
    if rig is not None and run.speed_rpm > rig.spindle.maximum_speed_rpm:
        yield Check(
            "Speed",
            Verdict.BLOCKS,
            f"{run.speed_rpm:g} rpm, the rig allows {rig.spindle.maximum_speed_rpm:g} rpm",
            "Lower the speed",
        )
    if rig is not None and test.limits.overload_N > rig.load_cell.full_scale_N:
        yield Check(
            "Overload",
            Verdict.ATTENTION,
            f"{test.limits.overload_N:g} N is above the cell's {rig.load_cell.full_scale_N:g} N",
            "Lower overload_N to what the cell can measure",
        )
    rules = len(test.limits.rule)
    yield Check(
        "Limits",
        Verdict.GOOD if rules else Verdict.ATTENTION,
        f"{rules} of this test, beside overload, overspeed and stale data",
        "" if rules else "Add a limit that tells when the joint has changed",
    )
    if not test.metadata.specimen:
        yield Check("Specimen", Verdict.ATTENTION, "not named", "Name the specimen")


def _of_disk(disk: DiskFacts | None) -> Iterator[Check]:
    if disk is None:
        return
    if disk.problem:
        yield Check("Disk", Verdict.BLOCKS, disk.problem, "Choose a folder that can be written to")
        return
    text = f"{disk.needed_bytes / 1e6:.0f} MB needed, {disk.free_bytes / 1e9:.1f} GB free"
    enough = disk.free_bytes > disk.needed_bytes + 32e6
    yield Check(
        "Disk",
        Verdict.GOOD if enough else Verdict.BLOCKS,
        f"{text} in {disk.folder}",
        "" if enough else "Free some room or keep fewer whole cycles",
    )


def _of_engine(status: Status) -> Iterator[Check]:
    state = status.state
    if state in (RunState.READY, RunState.STOPPED):
        yield Check("State", Verdict.GOOD, state.value)
    elif state is RunState.IDLE:
        yield Check("State", Verdict.ATTENTION, "not connected", "Connect (F4); Start does it too")
    else:
        yield Check("State", Verdict.BLOCKS, state.value, "Wait until no test is under way")
    for device in status.devices:
        verdict = Verdict.GOOD if device.connected else Verdict.BLOCKS
        text = device.identity or device.driver
        if not device.connected:
            text = device.last_error or "not connected"
        action = "" if device.connected else f"Check cable and power of {device.port}, reconnect"
        yield Check(f"Device {device.name}", verdict, text, action)
    blocking = [a for a in status.alarms if a.severity is Severity.CRITICAL]
    others = [a for a in status.alarms if a.severity is not Severity.CRITICAL]
    if blocking:
        yield Check("Alarms", Verdict.BLOCKS, blocking[0].title, blocking[0].action)
    elif others:
        yield Check("Alarms", Verdict.ATTENTION, others[0].title, others[0].action)
    else:
        yield Check("Alarms", Verdict.GOOD, "none")


def _of_drive(status: Status) -> Iterator[Check]:
    drive = status.drive
    if drive is None:
        return
    if drive.emergency_stop:
        yield Check("Emergency stop", Verdict.BLOCKS, "pressed", "Release it at the rig")
    else:
        yield Check("Emergency stop", Verdict.GOOD, "not pressed")
    if drive.faults:
        yield Check("Drive", Verdict.BLOCKS, ", ".join(drive.faults), "Reset the drive")
    elif drive.warnings:
        yield Check("Drive", Verdict.ATTENTION, ", ".join(drive.warnings), "See the drive's manual")
    else:
        text = f"{drive.supply_V:.1f} V, {drive.temperature_C:.0f} °C"
        yield Check("Drive", Verdict.GOOD, text)


def _of_channels(status: Status, rig: RigFile | None) -> Iterator[Check]:
    if not status.channels:
        return
    if not math.isfinite(status.data_age_s) or status.data_age_s > 2.0:
        yield Check("Samples", Verdict.BLOCKS, "none are coming", "Check the device, reconnect")
    else:
        yield Check("Samples", Verdict.GOOD, f"{status.data_age_s:.1f} s old")
    for channel in status.channels:
        bound = _bound(channel.name, rig)
        if bound is not None and abs(channel.raw) > 0.95 * bound:
            yield Check(
                f"Channel {channel.name}",
                Verdict.BLOCKS,
                f"{channel.raw:.3g} {channel.raw_unit} is at the end of the range",
                "Check sensor and wiring, or adjust the probe",
            )
    plain = [c.name for c in status.channels if c.calibration == "rig file"]
    if plain:
        yield Check(
            "Calibration",
            Verdict.ATTENTION,
            f"no record for {', '.join(plain)}: the numbers of the rig file count",
            "Calibrate (rigapp calibrate) for a known uncertainty",
        )
    else:
        yield Check("Calibration", Verdict.GOOD, "a record for each channel")


def _bound(channel: str, rig: RigFile | None) -> float | None:
    if rig is None:
        return None
    if channel in ("force_1", "force_2"):
        return rig.load_cell.range_mV_per_V
    return rig.probes.range_V if channel in ("probe_1", "probe_2") else None


MARKS = {Verdict.GOOD: "✓", Verdict.ATTENTION: "▲", Verdict.BLOCKS: "◆"}
HEADINGS = ("", "Check", "Finding", "What to do")


class PreflightPanel(QGroupBox):
    """Show the checks."""

    def __init__(self, theme: Theme) -> None:
        super().__init__("Before the start")
        self._theme = theme
        self._shown: list[Check] = []
        self.setObjectName("preflight_panel")
        self.setAccessibleName("Checks before the start")
        self.table = QTableWidget(0, len(HEADINGS))
        self.table.setObjectName("preflight_table")
        self.table.setAccessibleName("List of checks")
        self.table.setHorizontalHeaderLabels(list(HEADINGS))
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionMode(QAbstractItemView.SelectionMode.NoSelection)
        self.table.setTabKeyNavigation(False)
        self.table.setWordWrap(True)
        self.table.verticalHeader().hide()
        header = self.table.horizontalHeader()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)
        header.setSectionResizeMode(3, QHeaderView.ResizeMode.Stretch)
        column = QVBoxLayout(self)
        column.addWidget(self.table)

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme
        shown, self._shown = self._shown, []
        self.show_checks(shown)

    def show_checks(self, checks: list[Check]) -> None:
        """Fill the table; nothing is done when nothing changed."""
        if checks == self._shown:
            return
        self._shown = checks
        self.table.setRowCount(len(checks))
        theme = self._theme
        backs = {Verdict.ATTENTION: theme.warning, Verdict.BLOCKS: theme.critical}
        for row, check in enumerate(checks):
            texts = (
                f"{MARKS[check.verdict]} {check.verdict}",
                check.what,
                check.finding,
                check.action,
            )
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                item.setToolTip(text)
                if column == 0 and check.verdict in backs:
                    item.setBackground(QBrush(QColor(backs[check.verdict])))
                    dark_back = check.verdict is Verdict.BLOCKS and theme.name == "light"
                    item.setForeground(QBrush(QColor("#ffffff" if dark_back else "#000000")))
                self.table.setItem(row, column, item)
        self.table.resizeRowsToContents()
