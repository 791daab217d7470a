"""Devices and channels as they are now: raw signal, scaled value, losses; reconnect, zero."""

from __future__ import annotations

from collections.abc import Mapping

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QGroupBox, QVBoxLayout, QWidget

from rigapp.gui.data.channels import value_text
from rigapp.gui.data.news import News, Takes
from rigapp.gui.data.texts import duration, unit_text
from rigapp.gui.look.tokens import Theme
from rigapp.gui.panel import Host, StallCounter
from rigapp.gui.widgets.build import button, edit, filled, named, row
from rigapp.gui.widgets.tables import PlainTable
from rigapp.schema.messages import ChannelView, RunState, Status

DEVICE_HEADINGS = (
    "Device",
    "State",
    "Port",
    "Identity",
    "Samples/s",
    "Lost",
    "Errors",
    "Last error",
    "Counted on the line",
)
CHANNEL_HEADINGS = ("Channel", "Raw signal", "Value", "Uncertainty", "Calibration")


class DevicePanel(QWidget):
    """Show devices, channels, drive and this window's own health."""

    wanted = Signal(str, dict)

    takes = Takes.HISTORY

    def __init__(self, theme: Theme, watchdog: StallCounter) -> None:
        super().__init__()
        self._theme = theme
        self._watchdog = watchdog
        named(self, "device_panel", "Devices and channels")
        self.devices = PlainTable("device_table", "Devices", DEVICE_HEADINGS)
        self.channels = PlainTable("channel_table", "Channels, live", CHANNEL_HEADINGS)
        self.drive = PlainTable("drive_table", "Drive", ("Drive", "Now"))
        self.health = PlainTable("health_table", "Engine and window", ("Engine and window", "Now"))
        self.devices.itemSelectionChanged.connect(self._enable)
        self._build()
        self._state: RunState | None = None
        self._enable()

    def _build(self) -> None:
        self.reconnect = button(
            "reconnect", "Reconnect", self._reconnect, "Reconnect the devices", guarded=True
        )
        self.reason = edit(
            "zero_reason",
            "Reason for zeroing",
            self._enable,
            hint="reason, e.g. pin unloaded, new specimen",
        )
        self.zero = button(
            "zero",
            "&Zero load cell",
            self._zero,
            "Zero the load cell",
            guarded=True,
            tip="Take the present signals as zero force: the crank stands, the pin carries nothing."
            " Old and new zero are logged; the calibration is not touched.",
        )
        tools = row(self.reconnect, "Zero, with its reason", (self.reason, 1), self.zero)
        boxes = (
            (_boxed("Channels", self.channels), 3),
            (_boxed("Drive", self.drive), 2),
            (_boxed("Engine and window", self.health), 2),
        )
        filled(QVBoxLayout(self), ((self.devices, 2), tools, (row(*boxes), 4)))

    def dress(self, theme: Theme) -> None:
        """Take a theme."""
        self._theme = theme

    def show_news(self, news: News) -> None:
        """Show the newest values."""
        status, silence_s = news.status, news.silence_s
        self._state = status.state if status is not None else None
        if status is not None:
            self._show_devices(status)
            self._show_channels(status)
            self._show_drive(status)
        self._show_health(status, silence_s)
        self._enable()

    def _show_devices(self, status: Status) -> None:
        rows = [
            (
                device.name,
                "connected" if device.connected else "▲ not connected",
                device.port,
                f"{device.driver}: {device.identity}",
                f"{device.sample_rate_Hz:g}" if device.sample_rate_Hz else "–",
                str(device.lost_samples),
                str(device.errors),
                device.last_error,
                _counted(device.counters),
            )
            for device in status.devices
        ]
        warning = self._theme.mark(critical=False)
        marks = [None if device.connected else warning for device in status.devices]
        self.devices.show_rows(rows, marks)

    def _show_channels(self, status: Status) -> None:
        rows = [
            (
                channel.name,
                f"{channel.raw:.5g} {unit_text(channel.raw_unit)}",
                _value(channel),
                f"±{channel.uncertainty:.3g} {unit_text(channel.unit)}"
                if channel.uncertainty
                else "not known",
                channel.calibration,
            )
            for channel in status.channels
        ]
        self.channels.show_rows(rows)

    def _show_drive(self, status: Status) -> None:
        drive, warning = status.drive, self._theme.mark(critical=False)
        if drive is None:
            self.drive.show_rows([("State", "not connected")], [warning])
            return
        rows: list[tuple[str, str, object]] = [
            ("Speed", f"{drive.speed_rpm:.2f} of {drive.setpoint_rpm:.2f} rpm", False),
            ("Power", "on" if drive.enabled else "off", False),
            (
                "Emergency stop",
                "▲ pressed" if drive.emergency_stop else "not pressed",
                drive.emergency_stop,
            ),
            ("Current", f"{drive.current_A:.2f} A", False),
            ("Supply", f"{drive.supply_V:.1f} V", False),
            ("Temperature", f"{drive.temperature_C:.1f} °C", False),
            ("Faults", ", ".join(drive.faults) or "none", drive.faults),
            ("Warnings", ", ".join(drive.warnings) or "none", drive.warnings),
        ]
        marks = [warning if bad else None for _, _, bad in rows]
        self.drive.show_rows([(name, now) for name, now, _ in rows], marks)

    def _show_health(self, status: Status | None, silence_s: float) -> None:
        rows = [
            ("Last word of the engine", f"{silence_s:.1f} s ago"),
            ("Stalls of this window over 50 ms", str(self._watchdog.stalls)),
            ("Longest stall", f"{1000.0 * self._watchdog.worst_s:.0f} ms"),
        ]
        if status is not None:
            rows[1:1] = [
                ("Engine process", str(status.engine_pid)),
                ("Rows not sent to this window", str(status.rows_dropped)),
                ("Age of the prediction", value_text(status.twin_age_s, "s")),
            ]
        self.health.show_rows(rows)

    def _enable(self) -> None:
        standing = self._state in (RunState.READY, RunState.STOPPED)
        self.zero.setEnabled(standing and bool(self.reason.text().strip()))
        known = self._state in (RunState.IDLE, RunState.READY, RunState.STOPPED, RunState.FAULT)
        self.reconnect.setEnabled(known)

    def _reconnect(self) -> None:
        row = self.devices.currentRow()
        item = self.devices.item(row, 0) if row >= 0 else None
        self.wanted.emit("reconnect", {"device": item.text()} if item is not None else {})

    def _zero(self) -> None:
        reason = self.reason.text().strip()
        self.reason.clear()
        self.wanted.emit("zero", {"what": ["load_cell"], "reason": reason})


def _boxed(title: str, table: PlainTable) -> QGroupBox:
    box = named(QGroupBox(title), f"box_{table.objectName()}", title)
    QVBoxLayout(box).addWidget(table)
    return box


def _counted(counters: Mapping[str, int]) -> str:
    """Return a driver's counters in words; a dash where it counts nothing."""
    words = [f"{name.replace('_', ' ')} {count}" for name, count in counters.items()]
    return ", ".join(words).replace("crc", "CRC") or "–"


def _value(view: ChannelView) -> str:
    text = value_text(view.value, view.unit)
    return text if view.age_s is None else f"{text}, {duration(view.age_s)} old"


def device_page(host: Host) -> QWidget:
    """Make the page of devices and channels."""
    panel = host.add("devices", DevicePanel(host.theme, host.stalls))
    panel.wanted.connect(host.ask)
    return panel
