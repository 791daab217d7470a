"""Devices as cards, channels with their signs, the drive; reconnect, zero."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QFrame, QGridLayout, QLabel, QVBoxLayout, QWidget

from rigapp.gui.look.fonts import sized
from rigapp.gui.panel import Host, StallCounter
from rigapp.gui.panels.linereport import LineReportCard
from rigapp.gui.widgets.build import (
    button,
    column,
    edit,
    filled,
    fit_hint,
    named,
    prose,
    scrolling,
    set_property,
    styled_label,
)
from rigapp.gui.widgets.reflow import WrappingGrid, flowing
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.numbers import grouped, true_minus, unit_text
from rigapp.presentation.tokens import GAP, MARGIN, STEP, VALUE_PT, Theme
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.details import details_of
from rigapp.schema.messages import AT_REST, NO_TEST, DeviceView, RunState, Status
from rigapp.viewer.channels import value_text
from rigapp.viewer.news import News, Takes
from rigapp.viewer.shown import Age, Renewed, age_of

CHANNEL_HEADINGS: Final[tuple[Text, ...]] = (
    "Channel", "Signal", "Value", "Uncertainty", "Calibration", "What is positive",
)  # fmt: skip
SIGNS: Final[dict[str, Text]] = {
    "force_1": (
        "F on the follower, away from the crank's centre (the cell carries the opposite force)"
    ),
    "force_2": "F on the follower, across the crank, counter-clockwise (the cell: the opposite)",
    "probe_1": "the pin moves along the follower towards the slider",
    "probe_2": "the pin moves across the follower, counter-clockwise",
}
"""Meaning of a positive value; see Signs and frames in rig.md."""

RAW_PLACES = 4
"""Decimals of a raw value: 0.02 N (400 N at 2 mV/V), a hundredth of the resolution."""

LINK_WINDOW_S = 60.0
"""Period for which a loss is shown as present: an operator looks again within a minute."""
LINK_READINGS = 256
"""Number of stored readings of a link: twice the window at two readings a second."""

TABLE_HEIGHT = 26 * STEP
CARD_WIDTH = 42 * STEP
"""Minimum width of a card; cards are placed side by side where there is room."""


class LinkWatch:
    """Rate the link to a device by the number and time of losses."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._readings: deque[tuple[float, int, int]] = deque(maxlen=LINK_READINGS)

    def look(self, device: DeviceView) -> tuple[str, bool]:
        """Return the quality of the link in words, and whether it is disturbed now."""
        now, lost, errors = self._clock(), device.lost_samples, device.errors
        if self._readings and (lost, errors) < self._readings[-1][1:]:
            self._readings.clear()  # the counters restart with a new connection
        self._readings.append((now, lost, errors))
        while self._readings[0][0] < now - LINK_WINDOW_S:
            self._readings.popleft()
        _, lost_before, errors_before = self._readings[0]
        if lost > lost_before or errors > errors_before:
            words = tr(
                "disturbed: {} samples lost, {} errors in the last minute",
                grouped(lost - lost_before),
                grouped(errors - errors_before),
            )
            return words, True
        if lost or errors:
            return tr(
                "no errors now; {} samples lost, {} errors before", grouped(lost), errors
            ), False
        return tr("no errors, no data lost"), False


class DeviceCard(QFrame):
    """One device: health, link, warnings; its counters under Details."""

    reconnect_wanted = Signal(str)
    help_wanted = Signal(str)

    def __init__(self, device: str, clock: Callable[[], float]) -> None:
        super().__init__()
        self._link = LinkWatch(clock)
        name = f"device_{device}"
        named(self, name, device, role="card")
        self.chip = named(QLabel(), f"{name}_health", "Health of the device")
        self.title = named(QLabel(device), f"{name}_title", "Device")
        self.title.setFont(sized(self.font(), VALUE_PT, QFont.Weight.DemiBold))
        self.identity = prose(f"{name}_identity", "Driver, identity and port", role="secondary")
        self.link = prose(f"{name}_link", "Quality of the link")
        self.warnings = prose(f"{name}_warnings", "Warnings of the device")
        self.details = prose(f"{name}_details", "Counters of the line", role="caption")
        self.details.hide()
        self.more = button(
            f"{name}_more", "Details", self.details.setVisible, checkable=True, rank="quiet"
        )
        self.reconnect = button(
            f"{name}_reconnect",
            "Reconnect",
            partial(self.reconnect_wanted.emit, device),
            "Reconnect this device",
            guarded=True,
        )
        self.help = button(
            f"{name}_help",
            "What to do",
            self._help,
            tip="Show the section of the troubleshooting guide for the last error",
            rank="quiet",
        )
        self._section = ""
        grid = QGridLayout()
        grid.setHorizontalSpacing(GAP)
        grid.setColumnStretch(1, 1)
        lines: tuple[tuple[Text, QLabel], ...] = (("Link", self.link), ("Device", self.warnings))
        for row, (caption, label) in enumerate(lines):
            grid.addWidget(QLabel(tr(caption)), row, 0)
            grid.addWidget(label, row, 1)
        head = flowing(self.chip, (self.title, 1), self.help, self.more, self.reconnect)
        column(
            head, self.identity, grid, self.details, on=self, margins=(MARGIN, GAP), spacing=STEP
        )

    def show_device(self, device: DeviceView, *, connecting: bool = False) -> None:
        """Show the state of a device; connecting: the rig's devices are being connected."""
        link, disturbed = self._link.look(device)
        awaited = connecting and not device.connected and not device.last_error
        health, word = _health(device, disturbed=disturbed, awaited=awaited)
        set_property(self.chip, "chip", health)
        self.chip.setText(tr(word))
        self.identity.setText(f"{device.identity or device.driver}, {device.port}")
        if not device.connected:
            link = translate(device.last_error)
            link = link or (tr("being connected") if awaited else tr("not connected"))
        elif device.sample_rate_Hz:
            link = tr("{}, {} samples/s", link, f"{device.sample_rate_Hz:g}")
        unsound = disturbed or not (device.connected or awaited)
        set_property(self.link, "role", "caution" if unsound else "")
        self.link.setText(link)
        self.warnings.setText(translate(device.advice) or tr("no warning"))
        details = (details_of(device.last_error), details_of(device.advice), counted(device))
        self.details.setText("\n".join(filter(None, details)))
        self._section = device.help
        self.help.setVisible(bool(device.help))
        self.setAccessibleDescription(f"{tr(word)}, {link}")

    def _help(self) -> None:
        self.help_wanted.emit(self._section)


def _health(device: DeviceView, *, disturbed: bool, awaited: bool) -> tuple[str, Text]:
    """Return the kind and the text of a device's health."""
    if awaited:
        finding: Text = "… Connecting"
        return "calm", finding
    if not device.connected:
        lost: Text = "◆ Not connected"
        return "critical" if device.needed else "attention", lost
    if disturbed or device.advice:
        look: Text = "▲ Attention"
        return "attention", look
    good: Text = "✓ Good"
    return "calm", good


def counted(device: DeviceView) -> str:
    """Return all counters of a device, a line each."""
    counters = {
        tr("samples lost"): device.lost_samples,
        tr("errors"): device.errors,
        **{
            tr(name.replace("_", " ").replace("crc", "CRC")): n
            for name, n in device.counters.items()
        },
    }
    lines = [f"{name}: {grouped(count)}" for name, count in counters.items()]
    error = tr("last error: {}", translate(device.last_error)) if device.last_error else ""
    return "\n".join([*lines, *filter(None, (translate(device.wiring), error))])


class DevicePanel(QWidget):
    """Show devices, channels, drive and this window's own health."""

    wanted = Signal(str, dict)
    help_wanted = Signal(str)

    takes = Takes.HISTORY

    def __init__(
        self,
        theme: Theme,
        watchdog: StallCounter,
        clock: Callable[[], float] = time.monotonic,
        reports: Path = Path("results"),
    ) -> None:
        super().__init__()
        self._theme = theme
        self._watchdog = watchdog
        self._clock = clock
        self.cards: dict[str, DeviceCard] = {}
        named(self, "device_panel", "Devices and channels")
        self.channels = PlainTable(
            "channel_table",
            "Channels, live",
            CHANNEL_HEADINGS,
            marked=2,
            stretch=(4, 5),
            cut=(0, 4),
        )
        self.report = LineReportCard(reports)
        self.report.wanted.connect(self.wanted)
        self.drive = PlainTable("drive_table", "Drive", ("Drive", "Now"))
        self.health = PlainTable("health_table", "Engine and window", ("Engine and window", "Now"))
        self._build()
        self._state: RunState | None = None
        self._enable()

    def _build(self) -> None:
        self.reconnect = button(
            "reconnect",
            "Reconnect all",
            lambda: self.wanted.emit("reconnect", {}),
            "Reconnect all devices",
            guarded=True,
        )
        self.off = button(
            "power_off",
            "Pow&er off",
            lambda: self.wanted.emit("drive_off", {}),
            "Power off the drive",
            tip=(
                "Switch off the motor power at once; a running test ends. This is not the"
                " emergency stop."
            ),
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
            tip=(
                "Take the present signals as zero force: the crank is stationary and the pin"
                " unloaded. Old and new zero are logged; the calibration is not changed."
            ),
        )
        fit_hint(self.reason)
        tools = flowing(
            self.reconnect, self.off, "Zero, with its reason", (self.reason, 1), self.zero
        )
        self._cards = WrappingGrid(CARD_WIDTH)
        inside = QWidget()
        lower = WrappingGrid(CARD_WIDTH)
        for title, table in (("Drive", self.drive), ("Engine and window", self.health)):
            lower.addWidget(_carded(title, table))
        layout = filled(
            QVBoxLayout(inside),
            (self._cards, tools, _carded("Channels", self.channels), self.report, lower),
        )
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(GAP)
        layout.addStretch(1)
        area = scrolling("device_area", "Devices and channels", inside)
        column((area, 1), on=self)

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme

    def show_news(self, news: News) -> None:
        """Show the newest values."""
        status, silence_s = news.status, news.silence_s
        self._state = status.engine.state if status is not None else None
        if status is not None:
            self._show_devices(status)
            received, sampled = age_of(news, Renewed.STATUS), age_of(news, Renewed.SAMPLE)
            self._show_channels(status, received, sampled)
            self._show_drive(status, received)
        self._show_health(status, silence_s)
        self.report.show_status(status)
        self._enable()

    def _show_devices(self, status: Status) -> None:
        names = [device.name for device in status.rig.devices]
        for name in self.cards.keys() - names:
            self.cards.pop(name).deleteLater()
        for device in status.rig.devices:
            if device.name not in self.cards:
                card = DeviceCard(device.name, self._clock)
                card.reconnect_wanted.connect(self._reconnect)
                card.help_wanted.connect(self.help_wanted)
                self.cards[device.name] = card
                self._cards.addWidget(card)
            connecting = status.engine.state is RunState.CONNECTING
            self.cards[device.name].show_device(device, connecting=connecting)

    def _show_channels(self, status: Status, received: Age, sampled: Age) -> None:
        aged_channels = [
            (channel, (sampled if channel.age_s is None else received).and_before(channel.age_s))
            for channel in status.rig.channels
        ]
        rows = [
            (
                channel.name,
                true_minus(f"{round(channel.raw, RAW_PLACES):.5g} ") + unit_text(channel.raw_unit),
                f"{value_text(channel.value, channel.unit)}{_suffix(age)}",
                f"±{channel.uncertainty:.3g} {unit_text(channel.unit)}"
                if channel.uncertainty
                else tr("not known"),
                tr(channel.calibration),
                tr(SIGNS.get(channel.name, "")),
            )
            for channel, age in aged_channels
        ]
        old = (self._theme.base, self._theme.muted)
        self.channels.show_rows(rows, [old if age.old else None for _, age in aged_channels])

    def _show_drive(self, status: Status, received: Age) -> None:
        drive, warning = status.rig.drive, self._theme.mark(critical=False)
        if drive is None:
            self.drive.show_rows([(tr("State"), tr("not connected"))], [warning])
            return
        speed = "–"
        if drive.speed_rpm is not None and drive.setpoint_rpm is not None:
            speed = tr("{:.2f} of {:.2f} rpm", drive.speed_rpm, drive.setpoint_rpm)
        faults, warnings = (
            ", ".join(map(translate, texts)) or tr("none")
            for texts in (drive.faults, drive.warnings)
        )
        rows: list[tuple[Text, Text, object]] = [
            ("Speed", speed, False),
            ("Power", "on" if drive.enabled else "off", False),
            (
                "Emergency stop",
                "▲ pressed" if drive.emergency_stop else "not pressed",
                drive.emergency_stop,
            ),
            ("Current", value_text(drive.current_A, "A"), False),
            ("Supply", value_text(drive.supply_V, "V", 1), False),
            ("Temperature", value_text(drive.temperature_C, "degC", 1), False),
            ("Faults", faults, drive.faults),
            ("Warnings", warnings, drive.warnings),
        ]
        age = received.and_before(drive.age_s)
        old = (self._theme.base, self._theme.muted) if age.old else None
        if old is not None:
            rows.insert(0, ("Last answer", age.text, False))
        marks = [warning if bad else old for _, _, bad in rows]
        self.drive.show_rows([(tr(name), tr(now)) for name, now, _ in rows], marks)

    def _show_health(self, status: Status | None, silence_s: float) -> None:
        rows: list[tuple[Text, str]] = [
            ("Last message from the engine", tr("{:.1f} s ago", silence_s)),
            ("Stalls of this window over 50 ms", str(self._watchdog.stalls)),
            ("Longest stall", f"{1000.0 * self._watchdog.worst_s:.0f} ms"),
        ]
        if status is not None:
            age_s = (status.test or NO_TEST).twin_age_s
            more: list[tuple[Text, str]] = [
                ("Engine process", str(status.engine.pid)),
                ("Rows not sent to this window", str(status.engine.rows_dropped)),
                ("Age of the prediction", value_text(age_s, "s")),
            ]
            rows[1:1] = more
        self.health.show_rows([(tr(name), value) for name, value in rows])

    def _enable(self) -> None:
        standing = self._state in (RunState.READY, RunState.STOPPED)
        self.zero.setEnabled(standing and bool(self.reason.text().strip()))
        self.off.setEnabled(self._state not in (None, RunState.IDLE, RunState.CONNECTING))
        known = self._state in (*AT_REST, RunState.FAULT, RunState.CALIBRATING)
        for control in (self.reconnect, *(card.reconnect for card in self.cards.values())):
            control.setEnabled(known)

    def _reconnect(self, device: str) -> None:
        self.wanted.emit("reconnect", {"device": device})

    def _zero(self) -> None:
        reason = self.reason.text().strip()
        self.reason.clear()
        self.wanted.emit("zero", {"what": ["load_cell"], "reason": reason})


def _carded(title: Text, table: PlainTable) -> QFrame:
    """Return a table on a card, a few rows high."""
    card = named(QFrame(), f"box_{table.objectName()}", title, role="card")
    table.setMinimumHeight(TABLE_HEIGHT)
    column(styled_label(title, "title"), table, on=card, margins=GAP, spacing=STEP)
    return card


def _suffix(age: Age) -> str:
    return f", {age.text}" if age.old else ""


def device_page(host: Host) -> QWidget:
    """Make the page of devices and channels."""
    panel = host.add("devices", DevicePanel(host.theme, host.stalls, reports=host.results_folder))
    panel.wanted.connect(host.ask)
    panel.help_wanted.connect(host.help)
    return panel
