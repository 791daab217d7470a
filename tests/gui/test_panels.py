"""Devices, limits, log, results, comparison, faults, wear profile, notices."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QSplitter

from rigapp.config.loading import parse_test
from rigapp.gui.panels.alarms import AlarmGlance, AlarmJournal, AlarmPanel
from rigapp.gui.panels.compare import line_of
from rigapp.gui.panels.devices import DeviceCard, DevicePanel
from rigapp.gui.panels.faults import FaultPanel
from rigapp.gui.panels.limits import LimitPanel, limits_of
from rigapp.gui.panels.logbook import LogPanel
from rigapp.gui.panels.trends import ANGLES_DEG, WearProfilePanel, worn_profile
from rigapp.gui.window.notice import NoticeBar
from rigapp.gui.window.watchdog import STALL_S, Watchdog
from rigapp.presentation.tokens import DARK, LIGHT
from rigapp.schema.loglines import newest_limits
from rigapp.schema.messages import (
    Alarm,
    ChannelView,
    DeviceView,
    DriveView,
    Event,
    LineReport,
    RunState,
    Severity,
    Status,
)
from rigapp.service.faults import fault_choices
from rigapp.storage.structure.events import translated
from rigapp.viewer.news import News
from rigapp.viewer.recording import load_history
from rigapp.viewer.showntest import ShownTest
from rigapp.viewer.tasks import TaskWorker

EXAMPLES = Path(__file__).parents[2] / "examples"
RULE = (
    '\n[[limits.rule]]\nquantity = "force_max"\nwarning_above = 150.0\ncritical_above = 200.0\n'
    'action_critical = "drive_off"\n'
)

MakeStatus = Callable[..., Status]


@pytest.fixture
def worker() -> Iterator[TaskWorker]:
    worker = TaskWorker("test-files")
    yield worker
    worker.close()


@pytest.fixture
def asked() -> list[tuple[str, dict[str, Any]]]:
    return []


def collect(panel: Any, asked: list[tuple[str, dict[str, Any]]]) -> None:
    panel.wanted.connect(lambda verb, arguments: asked.append((verb, arguments)))


def test_a_device_card_tells_link_and_warnings_apart_and_counts_under_details(
    qtbot: Any, qapp: Any, make_status: MakeStatus
) -> None:
    now = [0.0]
    panel = DevicePanel(LIGHT, Watchdog(), clock=lambda: now[0])
    qtbot.addWidget(panel)

    def show(device: DeviceView) -> DeviceCard:
        status = make_status()
        devices = (device, *status.rig.devices[1:])
        panel.show_news(News(Status.of_flat(status.flat() | {"devices": devices}), silence_s=0.2))
        return panel.cards["daq"]

    counters = {"bytes_received": 4096, "crc_errors": 2, "retries": 0}
    daq = DeviceView("daq", "gsv8", "COM3", True, "GSV-8", 960.0, 12, 3, "", counters)
    card = show(daq)
    assert card.chip.text() == "✓ Good"
    assert card.link.text() == "no errors now; 12 samples lost, 3 errors before, 960 samples/s"
    assert card.warnings.text() == "no warning"
    assert card.details.isHidden()
    card.more.click()
    assert not card.details.isHidden()
    assert card.details.text().splitlines() == [
        "samples lost: 12", "errors: 3", "bytes received: 4\u202f096", "CRC errors: 2",
        "retries: 0",
    ]  # fmt: skip
    now[0] = 10.0
    card = show(msgspec.structs.replace(daq, lost_samples=20))
    assert card.chip.text() == "▲ Attention"
    assert "disturbed: 8 samples lost, 0 errors in the last minute" in card.link.text()
    now[0] = 80.0
    card = show(msgspec.structs.replace(daq, lost_samples=20, advice="Its fan stands still"))
    assert card.link.text().startswith("no errors now")
    assert card.chip.text() == "▲ Attention"
    assert card.warnings.text() == "Its fan stands still"
    error = "no reply within 0.5 s"
    card = show(msgspec.structs.replace(daq, connected=False, last_error=error))
    assert card.chip.text() == "◆ Not connected"
    assert card.chip.property("chip") == "critical"
    assert card.link.text() == error
    panel.show_news(
        News(
            make_status(
                state=RunState.CONNECTING, devices=(DeviceView("daq", "gsv8", "COM3", False, ""),)
            )
        )
    )
    assert (card.chip.text(), card.link.text()) == ("… Connecting", "being connected")
    card = show(msgspec.structs.replace(daq, connected=False, last_error=error))
    assert card.help.isHidden()  # an engine of before names no section
    card = show(msgspec.structs.replace(daq, last_error=error, help="no-answer-or-a-late-one"))
    assert not card.help.isHidden()
    with qtbot.waitSignal(panel.help_wanted, timeout=PATIENCE_MS) as told:
        card.help.click()
    assert told.args == ["no-answer-or-a-late-one"]


def test_lines_are_recorded_for_a_report_and_its_file_is_named(
    qtbot: Any, qapp: Any, make_status: MakeStatus, asked: list[Any], tmp_path: Path
) -> None:
    panel = DevicePanel(LIGHT, Watchdog(), reports=tmp_path)
    qtbot.addWidget(panel)
    collect(panel, asked)
    card = panel.report

    def show(state: RunState, report: LineReport | None) -> None:
        panel.show_news(News(make_status(state=state, line_report=report)))

    show(RunState.READY, None)
    assert [card.devices.itemText(at) for at in range(3)] == ["all devices", "daq", "drive"]
    assert card.progress.isHidden()
    assert not card.end.isEnabled()
    card.record.click()
    card.devices.setCurrentIndex(2)
    card.time.setCurrentIndex(3)
    show(RunState.RUNNING, None)  # a test is not disturbed
    card.record.click()
    (_, all_of_them), (_, one) = asked
    assert (all_of_them["devices"], all_of_them["duration_s"]) == ([], 10.0)
    assert all_of_them["reconnect"]
    assert Path(all_of_them["file"]).parent == tmp_path
    assert (one["devices"], one["duration_s"], one["reconnect"]) == (["drive"], 0.0, False)
    report = LineReport(one["file"], ("drive",), time.time() - 5.0)
    show(RunState.RUNNING, report)
    assert card.progress.text().startswith("Recording drive: 5 s. End and pack it")
    assert not card.record.isEnabled()
    card.end.click()
    assert asked[-1] == ("report_end", {})
    show(RunState.RUNNING, msgspec.structs.replace(report, sentence="The report is in a.zip."))
    assert card.progress.text() == "The report is in a.zip."
    assert card.record.isEnabled()


def test_channels_show_signal_value_and_what_is_positive(
    qtbot: Any, qapp: Any, make_status: MakeStatus
) -> None:
    panel = DevicePanel(LIGHT, Watchdog())
    qtbot.addWidget(panel)
    status = make_status()
    panel.show_news(News(status))
    channels = {row[0]: row[1:] for row in panel.channels.texts()}
    assert channels["force_1"][:4] == ["\u22120.431 mV/V", "\u221286.20 N", "±2 N", "rig file"]
    assert "away from the crank's centre" in channels["force_1"][4]
    assert channels["probe_1"][1:3] == ["121.00 µm", "not known"]
    assert channels["probe_1"][4].endswith("towards the slider")
    assert ["Emergency stop", "not pressed"] in panel.drive.texts()
    stopped = DriveView(0, 0, 0, 48, 30, False, True, ("S3",), ())
    panel.show_news(News(Status.of_flat(status.flat() | {"drive": stopped})))
    assert ["Emergency stop", "▲ pressed"] in panel.drive.texts()
    panel.show_news(News(Status.of_flat(status.flat() | {"drive": None})))
    assert panel.drive.texts() == [["State", "not connected"]]


def test_zero_needs_a_standing_crank_and_a_reason(
    qtbot: Any, qapp: Any, make_status: MakeStatus, asked: list[Any]
) -> None:
    panel = DevicePanel(LIGHT, Watchdog())
    qtbot.addWidget(panel)
    collect(panel, asked)
    panel.show_news(News(make_status()))
    panel.reason.setText("new specimen")
    assert not panel.zero.isEnabled()
    assert not panel.cards["drive"].reconnect.isEnabled()
    panel.show_news(News(make_status(state=RunState.READY)))
    panel.zero.click()
    panel.cards["drive"].reconnect.click()
    panel.reconnect.click()
    assert asked == [
        ("zero", {"what": ["load_cell"], "reason": "new specimen"}),
        ("reconnect", {"device": "drive"}),
        ("reconnect", {}),
    ]
    assert not panel.zero.isEnabled()


def test_limits_are_changed_with_a_reason_while_a_test_runs(
    qtbot: Any, qapp: Any, asked: list[Any]
) -> None:
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    test = parse_test(text + RULE, "x")
    panel = LimitPanel()
    qtbot.addWidget(panel)
    collect(panel, asked)
    panel.show_limits(RunState.READY, test, {})
    assert "No test is under way" in panel.problem.text()
    panel.show_limits(RunState.RUNNING, test, {})
    sentence = "Switch the drive off when maximum |F| is above"
    assert [sentence, "200 N"] in panel.table.texts()
    panel.table.selectRow([row[0] for row in panel.table.texts()].index(sentence))
    assert panel.value.text() == "200"
    assert "present value" in panel.problem.text()
    panel.value.setText("lots")
    assert "not a number" in panel.problem.text()
    panel.reason.setText("off with it")
    panel.value.setText("1e300")
    assert "outside -10000 to 10000 N" in panel.problem.text()
    assert not panel.change.isEnabled()
    panel.reason.clear()
    panel.value.setText("180,0")
    assert "reason" in panel.problem.text()
    assert not panel.change.isEnabled()
    panel.reason.setText("bearing is new")
    panel.change.click()
    assert asked == [
        (
            "set_limit",
            {"name": "force_max.critical_above", "value": 180.0, "reason": "bearing is new"},
        )
    ]
    panel.show_limits(RunState.RUNNING, test, {"force_max.critical_above": 180.0})
    panel.show_limits(RunState.RUNNING, test, {}, 21_377)
    rows = panel.table.texts()
    panel.table.selectRow([row[0] for row in rows].index("Revolutions of the complete test"))
    assert panel.value.text() == "21377"
    panel.reason.setText("the joint is still good")
    panel.value.setText("30000.5")
    assert "not an integer" in panel.problem.text()
    panel.value.setText("30000")
    panel.change.click()
    assert asked[-1] == ("extend", {"revolutions": 30_000, "reason": "the joint is still good"})
    panel.show_limits(RunState.RUNNING, test, {"force_max.critical_above": 180.0})
    assert limits_of(test, {"overload_N": 300.0})["overload_N"].value == 300.0
    assert [sentence, "180 N"] in panel.table.texts()


def test_changed_limits_are_read_from_the_log() -> None:
    events = [
        Event(1.0, 5, "limit_changed", "Ann", "limit overload_N changed: x", "380", "350"),
        Event(2.0, 9, "limit_changed", "Ann", "limit overload_N changed", "350", "340"),
        Event(3.0, 9, "note", "Ann", "limit speed changed", "1", "2"),
        Event(4.0, 9, "limit_changed", "Ann", "limit f.x changed", "1", "none"),
    ]
    assert newest_limits(translated(events)) == {"overload_N": 340.0}


FollowLog = Callable[[LogPanel, Path], News]


@pytest.fixture
def follow_log(no_history: Any, make_snapshot: Any) -> Iterator[FollowLog]:
    """Return a function that shows a panel what is read of a file's log by now."""
    shown = ShownTest(no_history)

    def follow(panel: LogPanel, path: Path) -> News:
        shown.take(make_snapshot(file=str(path)))
        shown.follow_log()
        shown.deliver()
        news = News(events=shown.events, log_problem=shown.log_problem)
        panel.show_news(news)
        return news

    yield follow
    shown.close()


def test_the_log_is_read_from_the_file_and_searched(
    qtbot: Any, qapp: Any, recorded: Path, follow_log: FollowLog
) -> None:
    panel = LogPanel()
    qtbot.addWidget(panel)
    qtbot.waitUntil(lambda: bool(follow_log(panel, recorded).events), timeout=PATIENCE_MS)
    assert panel.table.texts()[0][1:4] == ["120", "note", "Ann"]
    panel.filter.setText("water")
    assert panel.table.texts() == []
    panel.filter.setText("OIL")
    assert panel.table.texts()[0][-1] == "oil added"
    panel.show_news(News())
    assert panel.table.texts() == []


def test_a_log_that_cannot_be_read_is_said(
    qtbot: Any, qapp: Any, tmp_path: Path, follow_log: FollowLog
) -> None:
    panel = LogPanel()
    qtbot.addWidget(panel)
    gone = tmp_path / "gone.h5"
    qtbot.waitUntil(lambda: bool(follow_log(panel, gone).log_problem), timeout=PATIENCE_MS)
    assert "cannot be read" in panel.count.text()


def test_a_comparison_on_the_wear_axis_ascends(recorded: Path) -> None:
    data = load_history(recorded).data
    line = line_of(data, "force_max", "measured_wear_depth")
    assert len(line.x) == len(line.y) == 300
    assert (np.diff(line.x) >= 0.0).all()
    depth = data.predictions.series("measured_wear_depth").values[0]
    assert line.x[0] == pytest.approx(1e3 * depth, rel=1e-5)


def test_faults_of_the_simulated_rig_are_found_caused_and_ended(
    qtbot: Any, qapp: Any, make_status: MakeStatus, worker: TaskWorker, asked: list[Any]
) -> None:
    panel = FaultPanel(worker)
    qtbot.addWidget(panel)
    collect(panel, asked)
    panel.cause.click()
    assert asked == []
    free = ChannelView("bushing_temperature", 0.21, "V", 21.0, "degC", "by its line", None)
    slow = ChannelView("room_temperature", 21.0, "degC", 21.0, "degC", "", None, 0.5)
    status = make_status(channels=(*make_status().rig.channels, free, slow), simulated_speed=20.0)

    def offered() -> bool:
        panel.show_news(News(status))
        worker.deliver()
        return panel.list.rowCount() > 10

    qtbot.waitUntil(offered, timeout=PATIENCE_MS)
    assert panel.list.chosen() == 0
    panel.search.setText("stuck value")
    assert panel.list.texts() == [["signal", "stuck value"]]
    panel.channel.setCurrentText("bushing_temperature")
    panel.show_news(News(status))
    offered_now = [panel.channel.itemText(at) for at in range(panel.channel.count())]
    assert offered_now == ["force_1", "force_2", "probe_1", "probe_2", "bushing_temperature"]
    assert panel.converted.text() == "= 40 s simulated, at × 20"
    panel.cause.click()  # a signal lives by simulated time, a wire by the clock's
    panel.seconds.setCurrentIndex(1)
    panel.cause.click()
    panel.search.setText("cable DRIVE")
    assert panel.list.texts() == [["drive", "cable pull"]]
    assert not panel.channel.isEnabled()
    panel.duration.setText("3,0")
    assert panel.converted.text() == "= 0.15 s by the clock, at × 20"
    panel.cause.click()
    panel.duration.setText("")
    panel.value.setText("3")
    panel.cause.click()
    panel.end.click()
    stuck = {"kind": "stuck_value", "channel": "bushing_temperature"}
    pulled = {"kind": "cable_pull", "device": "drive"}
    assert asked == [
        ("inject_fault", {**stuck, "duration_s": 40.0}),
        ("inject_fault", {**stuck, "duration_s": 2.0}),
        ("inject_fault", {**pulled, "duration_s": 0.15}),
        ("inject_fault", {**pulled, "value": 3.0}),
        ("clear_fault", {"kind": "cable_pull"}),
    ]
    panel.value.setText("much")
    panel.cause.click()
    assert "must be a number" in panel.problem.text()
    panel.value.setText("")
    panel.duration.setText("2")
    panel.show_news(News(Status.of_flat(status.flat() | {"simulated_speed": 0.0})))
    panel.cause.click()
    assert "choose real seconds" in panel.problem.text()
    panel.search.setText("no such fault")
    assert not panel.cause.isEnabled()
    assert len(asked) == 5


def test_the_faults_of_each_device_are_its_own() -> None:
    found = fault_choices((("daq", "gsv8"), ("drive", "roboclaw"), ("other", "unheard_of")))
    kinds = {(choice.where, choice.kind) for choice in found}
    assert ("drive", "emergency_stop") in kinds
    assert ("daq", "emergency_stop") not in kinds
    assert ("other", "cable_pull") in kinds
    assert len(kinds) == len(found)


def test_the_worn_profile_is_deepest_at_the_contact_point() -> None:
    profile = worn_profile(0.45, 9.5, 10.0)
    assert profile[len(profile) // 2] == pytest.approx(0.45)
    assert profile.argmax() == len(profile) // 2
    np.testing.assert_allclose(profile, profile[::-1], atol=1e-12)
    assert profile[0] == 0.0
    assert worn_profile(0.0, 9.5, 10.0).max() == pytest.approx(0.0, abs=1e-12)


def test_the_worn_area_is_that_of_the_two_circles() -> None:
    """The area between profile and bushing is the lens that the pin's circle cuts out."""
    depth, pin, bushing = 0.45, 9.5, 10.0
    radius = bushing + worn_profile(depth, pin, bushing)
    area = 0.5 * np.trapezoid(radius**2 - bushing**2, np.radians(ANGLES_DEG))
    distance = bushing - pin + depth
    first = np.arccos((distance**2 + pin**2 - bushing**2) / (2 * distance * pin))
    second = np.arccos((distance**2 + bushing**2 - pin**2) / (2 * distance * bushing))
    triangle = distance * bushing * np.sin(second)
    lens = pin**2 * first + bushing**2 * second - triangle
    assert area == pytest.approx(np.pi * pin**2 - lens, rel=1e-3)


def test_the_profile_panel_shows_both_depths(qtbot: Any, qapp: Any, recorded: Path) -> None:
    history = load_history(recorded)
    assert history.recipe is not None
    panel = WearProfilePanel("test", LIGHT)
    qtbot.addWidget(panel)
    panel.show_news(News(data=history.data, recipe=history.recipe))
    predicted = history.data.predictions.last("wear_depth")
    assert panel._model.y.max() == pytest.approx(1e3 * predicted)
    assert f"model {1e3 * predicted:.1f}" in panel.plot.accessibleDescription()
    panel.dress(DARK)


def test_the_reason_of_a_fault_is_shown_whole(
    qtbot: Any, qapp: Any, make_status: MakeStatus
) -> None:
    bar = NoticeBar(LIGHT)
    qtbot.addWidget(bar)
    bar.take_status(make_status())
    assert bar.text.text() == "Running as planned."
    reason = "daq on /dev/ttyUSB0: the connection broke while reading; check cable and power."
    bar.take_status(make_status(state=RunState.FAULT, reason=reason))
    assert not bar.isHidden()
    assert bar.text.text() == f"Fault: {reason}"
    bar.take_status(make_status(state=RunState.READY, reason=""))
    assert bar.text.text().startswith("Ready:")


def test_a_new_engine_in_the_middle_of_a_test_is_told_until_understood(
    qtbot: Any, qapp: Any, make_status: MakeStatus
) -> None:
    bar = NoticeBar(DARK)
    qtbot.addWidget(bar)
    bar.take_status(make_status(committed=1233))
    bar.take_status(make_status(state=RunState.READY, engine_pid=5000, file="", test=""))
    bar.take_status(make_status(state=RunState.READY, engine_pid=5000, file="", test=""))
    assert "1\u202f233 revolutions are saved" in bar.text.text()
    bar.away.click()
    assert bar.text.text().startswith("Ready:")
    assert bar.away.isHidden()


def critical(alarm: Alarm, key: str, at: float, **more: Any) -> Alarm:
    """Return a critical alarm like another one."""
    changes = {"key": key, "severity": Severity.CRITICAL, "title": key, "raised_at": at} | more
    return msgspec.structs.replace(alarm, **changes)


def test_alarms_stand_in_the_side_column_while_there_are_any(
    qtbot: Any, qapp: Any, alarm: Any, asked: list[Any]
) -> None:
    glance = AlarmGlance()
    qtbot.addWidget(glance)
    collect(glance, asked)
    assert glance.isHidden()
    glance.show_alarms((alarm, critical(alarm, "overload", alarm.raised_at + 1.0)))
    assert not glance.isHidden()
    told, name_alone = glance.cards.cards
    assert told.title.text() == "overload"
    assert told.texts["action"].text() == alarm.action
    assert not told.texts["action"].isHidden()
    assert name_alone.texts["action"].isHidden()
    glance.acknowledge.click()
    assert asked == [("acknowledge", {"key": "overload"})]
    glance.show_alarms(())
    assert glance.isHidden()


def test_a_recorded_alarm_cannot_be_acknowledged(
    qtbot: Any, alarm: Alarm, make_status: Any
) -> None:
    panel, glance = AlarmPanel(), AlarmGlance()
    for one in (panel, glance):
        qtbot.addWidget(one)
    for replayed in (False, True, False):
        panel.show_news(News(make_status(alarms=(alarm,)), is_replay=replayed))
        glance.show_alarms((alarm,), recorded=replayed)
        for one in (panel.all, panel.acknowledge, glance.acknowledge):
            assert one.isEnabled() is not replayed
            assert ("replay" in one.toolTip()) is replayed


def test_the_newest_critical_alarm_is_chosen_and_all_are_acknowledged_at_once(
    qtbot: Any, qapp: Any, alarm: Any, asked: list[Any]
) -> None:
    panel = AlarmPanel()
    qtbot.addWidget(panel)
    collect(panel, asked)
    first = critical(alarm, "first", alarm.raised_at, first_out=True)
    panel.show_alarms((alarm, first))
    assert panel.cards.chosen() == first
    panel.show()
    qtbot.mouseClick(panel.cards.cards[1], Qt.MouseButton.LeftButton)
    assert panel.cards.chosen() == alarm
    again = msgspec.structs.replace(first, active=False, state="latched")
    panel.show_alarms((alarm, again))
    assert panel.cards.chosen() == alarm  # what somebody chose stays
    second = critical(alarm, "second", alarm.raised_at + 5.0)
    panel.show_alarms((alarm, again, second))
    assert panel.cards.chosen() == second
    assert [card.title.text() for card in panel.cards.cards] == ["first", "second", alarm.title]
    assert panel.cards.cards[1].property("chosen")
    qtbot.keyClick(panel.cards, Qt.Key.Key_Up)
    assert panel.cards.chosen() == again
    panel.all.click()
    assert asked == [("acknowledge", {})]
    done = msgspec.structs.replace(alarm, acknowledged=True, state="acknowledged")
    panel.show_alarms((done,))
    assert not panel.all.isEnabled()
    assert not panel.acknowledge.isEnabled()
    assert panel.cards.cards[0].property("role") == "card"


def test_the_journal_has_the_alarms_alone_newest_first(qtbot: Any, qapp: Any) -> None:
    journal = AlarmJournal()
    qtbot.addWidget(journal)
    events = [
        Event(1.8e9 + second, 7, kind, "engine", f"line {second}")
        for second, kind in enumerate(("alarm", "note", "alarm"))
    ]
    journal.show_news(News(events=events))
    assert [row[2] for row in journal.table.texts()] == ["line 2", "line 0"]


def test_a_reset_is_offered_after_a_trip(qtbot: Any, qapp: Any, asked: list[Any]) -> None:
    panel = AlarmPanel()
    qtbot.addWidget(panel)
    collect(panel, asked)
    panel.show_state(RunState.RUNNING)
    assert not panel.reset.isEnabled()
    panel.show_state(RunState.FAULT)
    panel.reset.click()
    assert asked == [("reset", {})]


def test_the_watchdog_notes_a_stall(qapp: Any) -> None:
    now = [0.0]
    watchdog = Watchdog(clock=lambda: now[0])
    for step in (0.0, 0.020, 0.021, 0.020 + STALL_S + 0.001, 0.020):
        now[0] += step
        watchdog.beat()
    assert watchdog.stalls == 1
    assert watchdog.worst_s == pytest.approx(STALL_S + 0.001)


def test_a_window_that_stalls_for_hours_says_so_once_a_minute(
    qapp: Any, caplog: pytest.LogCaptureFixture
) -> None:
    now = [0.0]
    watchdog = Watchdog(clock=lambda: now[0], own_clock=lambda: 0.5 * now[0])
    watchdog.start()
    while now[0] < 3600.0:
        watchdog.beat()
        now[0] += 0.5
    watchdog.stop()
    assert watchdog.stalls == 7199
    lines = [record.getMessage() for record in caplog.records]
    assert 58 <= len(lines) <= 62
    assert lines[0].startswith("The window stood still once, 480 ms the longest, 250 ms of them")
    assert "120 times" in lines[1]


def test_the_cursor_reads_values_with_units(
    window: Any, engine: Any, attach: Callable[[], None], qtbot: Any
) -> None:
    engine.say(count=5)
    attach()
    overlay = window.tabs.panels["overview"]
    overlay.set_cursor(180.0)
    assert overlay.readout.whole.startswith("N: |F| +")
    text = overlay.plot.accessibleDescription()
    assert "|F| 9" in text
    assert "model 96.0 ±" in text
    qtbot.keyClick(overlay.plot, Qt.Key.Key_Right)
    assert overlay.plot.cursor_line.value() == 181.0
    qtbot.keyClick(overlay.residual_plot, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    assert overlay.plot.cursor_line.value() == 171.0
    qtbot.keyClick(overlay.plot, Qt.Key.Key_Escape)
    assert not overlay.plot.cursor_line.isVisible()


def test_hold_keeps_the_picture_and_a_stored_revolution_is_compared(
    window: Any, engine: Any, attach: Callable[[], None], qtbot: Any, recorded: Path
) -> None:
    window._test._revolution = lambda path, revolution: load_it(recorded, revolution)
    window.tabs.setCurrentIndex(1)
    engine.say(count=5)
    attach()
    cycle = window.tabs.panels["cycle"]
    cycle.hold.setChecked(True)
    engine.say(first=6, count=1)
    attach()
    assert cycle.overlay.shown.measured_revolution == 5
    cycle.hold.setChecked(False)
    window.draw_now()
    assert cycle.overlay.shown.measured_revolution == 6
    cycle.stored.setValue(37)
    cycle.show_stored.setChecked(True)

    def compared() -> bool:
        window.tick()
        return "stored 40" in cycle.overlay.plot.accessibleDescription()

    qtbot.waitUntil(compared, timeout=PATIENCE_MS)
    assert cycle.stored.value() == 40
    assert len(cycle.overlay._behind["stored"]["force"].x) > 100
    cycle.show_stored.setChecked(False)
    window.draw_now()
    assert "stored" not in cycle.overlay.plot.accessibleDescription()
    numbers = set(cycle.values.texts()[0])
    assert "96.00" in numbers


def load_it(path: Path, revolution: int) -> Any:
    from rigapp.viewer.recording import load_revolution

    return load_revolution(path, revolution)


def test_every_trend_draws_what_it_names(
    window: Any, engine: Any, attach: Callable[[], None]
) -> None:
    window.tabs.setCurrentIndex(2)
    engine.say(count=1500)
    attach()
    trend = window.tabs.panels["upper_trend"]
    choices = range(trend.choice.count())
    quantities = [one for one in choices if trend.choice.itemData(one) is not None]
    for index in quantities:  # lines part the groups, and cannot be chosen
        trend.choice.setCurrentIndex(index)
        window.draw_now()
        assert trend._curves
        assert all(len(one.trace.x) > 0 for one in trend._curves)
        if trend.choice.currentData() == "wear":
            assert "± 1.1" in trend.words
    trend.choice.setCurrentIndex(quantities[0])
    trend.modes["last"].click()
    window.draw_now()
    low, high = trend.plot.viewRange()[0]
    assert high - low == pytest.approx(1000.0)
    assert low <= 1500 <= high
    trend.modes["whole"].click()
    window.draw_now()
    assert trend.plot.viewRange()[0][0] == 1.0
    assert "maximum" in trend.words


def test_a_trend_is_zoomed_by_keys(
    window: Any, engine: Any, attach: Callable[[], None], qtbot: Any
) -> None:
    window.tabs.setCurrentIndex(2)
    engine.say(count=1500)
    attach()
    trend = window.tabs.panels["upper_trend"]
    before = trend.plot.viewRange()[0]
    qtbot.keyClick(trend.plot, Qt.Key.Key_Plus)
    window.draw_now()
    after = trend.plot.viewRange()[0]
    assert after[1] - after[0] == pytest.approx((before[1] - before[0]) / 2)
    engine.say(first=1501, count=500)
    attach()
    assert trend.plot.viewRange()[0] == after
    qtbot.keyClick(trend.plot, Qt.Key.Key_Right)
    assert trend.plot.viewRange()[0][0] > after[0]


def test_a_trend_is_read_at_a_cycle(
    window: Any, engine: Any, attach: Callable[[], None], qtbot: Any
) -> None:
    window.tabs.setCurrentIndex(2)
    engine.say(count=1500)
    attach()
    trend = window.tabs.panels["upper_trend"]
    trend.view.point_at(700.3)
    window.draw_now()
    expected = window._test.data.rows.series("force_max").values[699]
    assert f"At cycle 700: maximum {expected:.4g}" in trend.words
    assert "model maximum" in trend.words
    trend.view.point_at(99_999.0)
    window.draw_now()
    assert trend.words == ""
    qtbot.keyClick(trend.plot, Qt.Key.Key_Escape)
    window.draw_now()
    assert trend.words.startswith("Now: maximum")


def test_closing_asks_while_a_test_is_under_way(
    window: Any, engine: Any, attach: Callable[[], None], qtbot: Any
) -> None:
    engine.say(count=5)
    attach()
    window.start()
    window.close()
    assert window.isVisible()
    assert window.close_bar.isVisible()
    qtbot.keyClick(window.close_bar, Qt.Key.Key_Escape)
    assert not window.close_bar.isVisible()
    window.close()
    window.close_bar.stop_first.emit()

    def asked() -> bool:
        return "stop" in engine.verbs

    qtbot.waitUntil(asked, timeout=PATIENCE_MS)
    assert window.isVisible()
    engine.say(first=6, count=1, state=RunState.STOPPED)
    qtbot.waitUntil(lambda: not window.isVisible(), timeout=PATIENCE_MS)


def test_a_minimised_window_draws_nothing(
    window: Any, engine: Any, attach: Callable[[], None]
) -> None:
    engine.say(count=5)
    attach()
    window.showMinimized()
    engine.say(first=6, count=1)
    window.tick()
    assert window.tabs.panels["overview"].shown.measured_revolution == 5
    assert len(window._test.data.rows) == 6


@pytest.mark.long
def test_a_replay_starts_again(recorded: Path, qtbot: Any, qapp: Any) -> None:
    from rigapp.gui.window.tabs import NUMBERS
    from rigapp.gui.window.window import MainWindow
    from rigapp.replay.client import ReplayClient
    from rigapp.viewer.connection import EngineConnection
    from rigapp.viewer.showntest import ShownTest

    client = ReplayClient(recorded, at_end=True)
    window = MainWindow(EngineConnection(lambda: client), ShownTest(), LIGHT)
    qtbot.addWidget(window)
    window.show()

    def rows(count: int) -> bool:
        window.tick()
        return len(window._test.data.rows) == count

    qtbot.waitUntil(lambda: rows(300), timeout=PATIENCE_MS)
    assert window.replay_bar.isVisible()
    assert not window.tabs.isTabVisible(NUMBERS["faults"])
    client.request("replay", {"speed": 0.0})
    client.request("rewind")
    qtbot.waitUntil(lambda: rows(0), timeout=PATIENCE_MS)
    client.request("replay", {"speed": 3000.0})
    qtbot.waitUntil(lambda: rows(300), timeout=PATIENCE_MS)
    window.close()


def laid_out(splitter: QSplitter) -> list[int]:
    """Return the sizes that stay: a page higher than its window is laid out in several turns."""
    seen: list[list[int]] = []
    while len(seen) < 3 or seen[-1] != seen[-3]:
        QApplication.processEvents()
        seen.append(splitter.sizes())
    return seen[-1]


@pytest.mark.parametrize(
    ("page", "divided", "wanted"),
    [
        ("cycle", "cycle_right", [300, 180]),
        pytest.param("trends", "trend_split", [100, 300, 200], marks=pytest.mark.long),
    ],
)
def test_the_layout_is_remembered(
    engine: Any,
    qtbot: Any,
    tmp_path: Path,
    no_history: Any,
    page: str,
    divided: str,
    wanted: list[int],
) -> None:
    from PySide6.QtCore import QSettings

    from rigapp.gui.window.window import MainWindow
    from rigapp.viewer.connection import EngineConnection
    from rigapp.viewer.showntest import ShownTest

    def make() -> MainWindow:
        settings = QSettings(str(tmp_path / "layout.ini"), QSettings.Format.IniFormat)
        window = MainWindow(
            EngineConnection(engine.client), ShownTest(no_history), LIGHT, settings=settings
        )
        qtbot.addWidget(window)
        window.show()
        return window

    first = make()
    # Within the screen: a wider one would come back narrower, its bars tight.
    first.resize(780, 740)
    first.tabs.show_page(page)
    splitter = next(s for s in first.tabs.splitters if s.objectName() == divided)
    laid_out(splitter)
    splitter.setSizes(wanted)
    sizes, at = laid_out(splitter), first.tabs.currentIndex()
    first.close()
    second = make()
    assert second.tabs.currentIndex() == at
    again = next(s for s in second.tabs.splitters if s.objectName() == divided)
    assert laid_out(again) == sizes
    second.close()


def test_help_opens_beside_the_window(window: Any, qtbot: Any) -> None:
    window.show_help()
    help_window = window._help
    assert help_window.isVisible()
    assert "emergency stop" in help_window.browser.toPlainText().lower()
    qtbot.keyClick(help_window.browser, Qt.Key.Key_F12)
    assert help_window.isVisible()
    help_window.close()
