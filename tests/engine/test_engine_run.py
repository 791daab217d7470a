"""A test from start to end on the rig in memory."""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from patience import PATIENCE_S

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import LimitRule
from rigapp.engine.recording.store import Opened
from rigapp.schema.channels import BASE
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import (
    NO_TEST,
    NOT_STEADY,
    FinishReason,
    Flag,
    Prediction,
    RunState,
    as_array,
)
from rigapp.schema.notices import AlarmChanged, Committed, Finished, Notice, StateChanged
from rigapp.schema.states import ENDED, Refused
from rigapp.schema.wire import decode, encode
from tests.engine.engine_doubles import COUNTS, MemoryRig, a_test, eventually

LONG = 1_000_000


@pytest.fixture
def rig() -> Iterator[MemoryRig]:
    memory = MemoryRig()
    memory.engine.connect()
    yield memory
    memory.engine.shutdown(20.0)
    assert memory.is_stationary


def run(rig: MemoryRig, revolutions: int = 20, **options: object) -> Finished:
    rig.start(a_test(revolutions, **options))  # type: ignore[arg-type]
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    return rig.engine.outcome


def recorded(rig: MemoryRig, rows: int) -> None:
    eventually(lambda: len(rig.store.rows) >= rows)


def test_a_complete_test_has_exactly_the_planned_revolutions(rig: MemoryRig) -> None:
    notices = rig.engine.watch()
    outcome = run(rig, 20)
    assert outcome.reason is FinishReason.COMPLETE
    assert (outcome.status, outcome.revolutions) == ("complete", 20)
    assert rig.store.ending == ("complete", "complete", outcome.sentence)
    assert rig.store.closed
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(1, 21))
    assert rig.is_stationary
    assert rig.spindle.commands[-1][0] == "off"
    seen: list[Notice] = []
    while (notice := notices.get(0.0)) is not None:
        seen.append(notice)
    assert seen[-1] == outcome
    committed = [one.revolutions for one in seen if isinstance(one, Committed)]
    assert committed == sorted(committed)
    assert committed[-1] == 20
    states = [one.state for one in seen if isinstance(one, StateChanged)]
    assert states == [RunState.STARTING, RunState.RUNNING, RunState.STOPPING, RunState.STOPPED]


def test_a_start_waits_out_a_silence_of_a_moment(
    rig: MemoryRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    connection = rig.engine._connection
    assert connection is not None
    looks = iter([10.0])  # the first look finds samples ten seconds old, every other one new ones
    age, starts = connection.rig.age_s, threading.current_thread()

    def seen(since_s: float) -> float:
        # The supervising thread looks as well; ten seconds would end the connection there.
        mine = threading.current_thread() is starts
        return next(looks, age(since_s)) if mine else age(since_s)

    monkeypatch.setattr(connection.rig, "age_s", seen)
    assert run(rig, 3).status == "complete"
    assert not list(looks)


def test_rows_say_what_the_rig_did(rig: MemoryRig) -> None:
    run(rig, 12)
    store = rig.store
    np.testing.assert_allclose(store.column("force_max"), 50.0, rtol=1e-4)
    np.testing.assert_allclose(store.column("force_rms"), 50.0, rtol=1e-4)
    # The signal is minus cosine of the crank angle: the joint force along the crank plus cosine.
    np.testing.assert_allclose(store.column("force_1_max"), 50.0, rtol=1e-3)
    angle = store.column("force_1_angle_of_max")
    assert np.all(np.minimum(angle, 360.0 - angle) < 3.0)
    quality = store.column("quality").astype(int)
    assert quality[0] & Flag.RAMP
    assert not np.any(quality[5:])
    np.testing.assert_allclose(store.column("speed")[5:], 120.0, rtol=5e-3)
    np.testing.assert_allclose(np.diff(store.column("time"))[5:], 0.5, atol=0.01)
    assert np.all(np.diff(store.column("host_time")) >= 0)


def test_whole_cycles_are_kept_by_the_schedule_and_at_the_end(rig: MemoryRig) -> None:
    run(rig, 12, every=5)
    assert [number for number, _ in rig.store.cycles] == [5, 10, 12]
    number, columns = rig.store.cycles[0]
    assert set(columns) == {column.name for column in BASE.cycle_columns}
    row = rig.store.rows[number - 1]
    assert len(columns["angle"]) == row[BASE.place["samples"]]
    np.testing.assert_allclose(columns["force_1"].max(), row[BASE.place["force_1_max"]])
    assert columns["time"][-1] <= row[BASE.place["time"]]


def test_the_last_cycle_of_a_stopped_test_is_kept_too(rig: MemoryRig) -> None:
    rig.start(a_test(LONG, every=LONG))
    recorded(rig, 5)
    rig.engine.stop("Ada", "lunch")
    rig.engine.wait(ENDED, 60.0)
    assert [number for number, _ in rig.store.cycles] == [len(rig.store.rows)]


@pytest.mark.parametrize("off", [False, True])
def test_the_operator_ends_a_test(rig: MemoryRig, off: bool) -> None:
    rig.start(a_test(LONG))
    recorded(rig, 5)
    (rig.engine.drive_off if off else rig.engine.stop)("Ada", "enough")
    assert rig.engine.wait(ENDED, 60.0) is RunState.STOPPED
    outcome = rig.engine.outcome
    assert outcome is not None
    assert (outcome.reason, outcome.status) == (FinishReason.OPERATOR, "stopped")
    assert "Ada" in outcome.sentence
    assert "enough" in outcome.sentence
    assert rig.is_stationary
    stop = [what for what, speed in rig.spindle.commands if speed == 0.0]
    assert stop[0] == ("off" if off else "speed")
    assert stop[-1] == "off"
    assert rig.store.safe == len(rig.store.rows)


def test_a_pause_holds_at_the_safe_angle_and_loses_no_revolution(rig: MemoryRig) -> None:
    rig.start(a_test(60))
    recorded(rig, 5)
    rig.engine.pause("Ada")
    rig.engine.wait((RunState.PAUSED,), 60.0)
    rows = len(rig.store.rows)
    assert rig.is_stationary
    reads = rig.source.reads
    eventually(lambda: rig.source.reads > reads + 40)
    assert len(rig.store.rows) == rows
    rig.engine.resume("Ada")
    rig.engine.wait(ENDED, 60.0)
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(1, 61))
    quality = rig.store.column("quality").astype(int)
    assert quality[rows] & Flag.PAUSED
    assert rig.store.column("samples")[rows] < 4000


def test_a_limit_of_the_test_stops_it(rig: MemoryRig) -> None:
    rule = LimitRule("force_max", warning_above=60.0, critical_above=70.0, delay_revolutions=2)
    notices = rig.engine.watch()
    rig.start(a_test(LONG, rules=(rule,)))
    recorded(rig, 5)
    rig.source.force_N = 65.0
    eventually(lambda: any(a.severity == "warning" for a in rig.engine.status().alarms))
    assert rig.engine.state is RunState.RUNNING
    rig.source.force_N = 75.0
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert (outcome.reason, outcome.status) == (FinishReason.LIMIT, "stopped")
    assert "force_max" in outcome.sentence
    forces = rig.store.column("force_max")
    assert np.count_nonzero(forces > 70.0) >= 2
    raised = []
    while (notice := notices.get(0.0)) is not None:
        if isinstance(notice, AlarmChanged):
            raised.append(notice.alarm)
    assert all(alarm.cause and alarm.consequence and alarm.action for alarm in raised)
    with pytest.raises(Refused, match="alarm list"):
        rig.start(a_test(5))
    rig.engine.acknowledge(operator="Ada")
    rig.engine.reset("Ada")
    rig.source.force_N = 50.0
    assert run(rig, 5).reason is FinishReason.COMPLETE


def test_a_limit_pauses(rig: MemoryRig) -> None:
    rule = LimitRule("force_max", critical_above=70.0, action_critical="pause")
    rig.start(a_test(LONG, rules=(rule,)))
    recorded(rig, 5)
    rig.source.force_N = 75.0
    rig.engine.wait((RunState.PAUSED,), 60.0)
    assert rig.is_stationary
    rig.source.force_N = 50.0


def test_overload_takes_the_power_off_within_a_revolution(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    recorded(rig, 5)
    before = rig.crank.position_rev
    rig.source.force_N = 390.0
    rig.engine.wait(ENDED, 60.0)
    assert rig.spindle.off_at is not None
    first_zero = next(what for what, speed in rig.spindle.commands if speed == 0.0)
    assert first_zero == "off"
    assert rig.crank.position_rev - before < 2.0
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.LIMIT
    alarm = rig.engine.status().alarms[0]
    assert (alarm.key, alarm.first_out) == ("overload", True)


def test_a_signal_that_is_no_number_is_an_overload(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    recorded(rig, 3)
    rig.source.force_N = math.nan
    assert rig.engine.wait(ENDED, 60.0) is RunState.FAULT
    assert "not a number" in rig.engine.status().engine.reason


def test_limits_change_with_an_entry_in_the_log(rig: MemoryRig) -> None:
    rule = LimitRule("force_max", critical_above=70.0)
    rig.start(a_test(LONG, rules=(rule,)))
    recorded(rig, 3)
    with pytest.raises(UnusableInput, match=r"force_max\.critical_above"):
        rig.engine.set_limit("force_max.nonsense", 1.0)
    with pytest.raises(UnusableInput, match=r"is not above run\.speed_rpm = 120"):
        rig.engine.set_limit("overspeed_rpm", 100.0)
    with pytest.raises(UnusableInput, match=r"overload_N = true is not a number; allowed is 1 to"):
        rig.engine.set_limit("overload_N", True)
    with pytest.raises(UnusableInput, match=r"overload_N = 9000 is never reached"):
        rig.engine.set_limit("overload_N", 9000.0)
    rig.engine.set_limit("force_max.critical_above", 40.0, "Ada", "try it")
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.LIMIT
    change = next(e for e in rig.store.events if e.kind == "limit_changed")
    assert (change.source, change.before, change.after) == ("Ada", "70", "40")


def test_the_number_of_revolutions_is_changed_while_the_test_runs(rig: MemoryRig) -> None:
    with pytest.raises(Refused, match="while a test runs"):
        rig.engine.extend(30)
    rig.start(a_test(LONG))
    recorded(rig, 5)
    with pytest.raises(UnusableInput, match=r"run\.revolutions = true is not a number"):
        rig.engine.extend(True, "Ada")
    with pytest.raises(UnusableInput, match="room for"):
        rig.engine.extend(2 * LONG, "Ada")
    assert rig.engine.status().test.planned == LONG
    with pytest.raises(Refused, match="made already"):
        rig.engine.extend(3, "Ada")
    rig.engine.pause("Ada")
    rig.engine.wait((RunState.PAUSED,), 60.0)
    last = int(rig.store.column("revolution")[-1]) + 8
    rig.engine.extend(last, "Ada", "the joint is sound")
    rig.engine.resume("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert int(rig.store.column("revolution")[-1]) == last
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.COMPLETE
    (told,) = [e for e in rig.store.events if "will end after" in e.text]
    assert (told.source, told.before, told.after) == ("Ada", str(LONG), str(last))
    assert told.text.endswith("the joint is sound")


def test_the_zero_is_an_event_with_before_and_after(rig: MemoryRig) -> None:
    tare = rig.engine.zero(operator="Ada", reason="pin unloaded")["load_cell"]
    assert abs(tare[0]) + abs(tare[1]) > 0.1
    eventually(lambda: rig.engine.status().rig.channels != ())
    views = {view.name: view for view in rig.engine.status().rig.channels}
    eventually(
        lambda: abs({v.name: v for v in rig.engine.status().rig.channels}["force"].value) < 1e-3
    )
    assert views["force_1"].raw_unit == "mV/V"
    run(rig, 3)
    calibration = rig.requests[0].calibration
    np.testing.assert_allclose(calibration.load_cell.tare, tare)
    np.testing.assert_allclose(calibration.load_cell.zero, 0.0)
    with pytest.raises(Refused, match="only"):
        rig.engine.zero(("probes",))


def test_no_zero_during_a_test(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    with pytest.raises(Refused, match="before a test"):
        rig.engine.zero()


def test_notes_are_in_the_log(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    rig.engine.note("a squeak", "Ada")
    with pytest.raises(Refused):
        rig.engine.note("  ")
    assert any(e.kind == "note" and e.text == "a squeak" for e in rig.store.events)


def test_a_resumed_test_goes_on_with_number_time_and_a_flag() -> None:
    rig = MemoryRig()
    rig.engine.connect()
    run(rig, 6)
    rig.opened = Opened(rig.store, 6, 6, 3.0, 0.0)
    rig.store.closed = False
    rig.start(a_test(10), resume=True)
    rig.engine.wait(ENDED, 60.0)
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(1, 11))
    quality = rig.store.column("quality").astype(int)
    assert quality[6] & Flag.GAP_BEFORE
    assert not quality[7] & Flag.GAP_BEFORE
    assert np.all(np.diff(rig.store.column("time")) > 0)
    assert rig.engine.status().test.first_revolution == 7
    rig.engine.shutdown()


def test_nothing_is_left_to_resume(rig: MemoryRig) -> None:
    run(rig, 6)
    rig.opened = Opened(rig.store, 6, 6, 3.0, 0.0)
    with pytest.raises(UnusableInput, match="no revolution is left"):
        rig.start(a_test(6), resume=True)
    assert rig.is_stationary


@pytest.mark.parametrize(
    ("test", "words"),
    [
        (a_test(rpm=500.0), "maximum_speed"),
        (a_test(rpm=250.0), "overspeed"),
        (a_test(overload_N=720.0), "saturates at 700 N"),
        (a_test(rules=(LimitRule("force_mx", critical_above=1.0),)), "did you mean force_max"),
    ],
)
def test_an_impossible_test_is_refused_before_anything_turns(
    rig: MemoryRig, test: object, words: str
) -> None:
    with pytest.raises(UnusableInput, match=words):
        rig.start(test)  # type: ignore[arg-type]
    assert rig.engine.state is RunState.READY
    assert rig.spindle.commands == []
    assert rig.stores == []


def test_commands_out_of_place_are_refused(rig: MemoryRig) -> None:
    for command in (rig.engine.pause, rig.engine.resume, rig.engine.stop):
        with pytest.raises(Refused, match="possible"):
            command("Ada")
    rig.start(a_test(LONG))
    with pytest.raises(Refused):
        rig.start(a_test(5))
    with pytest.raises(Refused):
        rig.engine.connect()


def test_shutdown_during_a_test_finishes_it() -> None:
    rig = MemoryRig()
    rig.engine.connect()
    rig.start(a_test(LONG))
    recorded(rig, 3)
    rig.engine.shutdown(20.0)
    assert rig.is_stationary
    assert rig.store.ending is not None
    assert rig.store.ending[:2] == ("stopped", "operator")
    assert rig.engine.state is RunState.IDLE
    rig.engine.shutdown()


def test_a_viewer_gets_rows_the_newest_cycle_and_the_gap_when_it_lags(rig: MemoryRig) -> None:
    lagging = rig.engine.subscribe(rows=4)
    quick = rig.engine.subscribe()
    run(rig, 20)
    snapshot = rig.engine.snapshot(quick)
    rows = np.frombuffer(snapshot.rows).reshape(-1, len(BASE.revolution_columns))
    np.testing.assert_array_equal(rows[:, 0], np.arange(1, 21))
    assert snapshot.first_row == 0
    assert snapshot.cycle is not None
    assert snapshot.cycle.revolution == 20
    assert as_array(snapshot.cycle.curves["force"]).max() == pytest.approx(50.0, rel=1e-4)
    late = rig.engine.snapshot(lagging)
    rows = np.frombuffer(late.rows).reshape(-1, len(BASE.revolution_columns))
    np.testing.assert_array_equal(rows[:, 0], np.arange(17, 21))
    assert (late.first_row, late.status.engine.rows_dropped) == (16, 16)
    assert len(rig.engine.snapshot(quick).rows) == 0


def test_predictions_are_stored_judged_and_shown(rig: MemoryRig) -> None:
    rule = LimitRule("residual_rms", critical_above=20.0)
    measured = LimitRule("force_max", critical_above=60.0)
    viewer = rig.engine.subscribe()
    rig.start(a_test(LONG, every=5, rules=(rule, measured)))
    recorded(rig, 6)
    curve = np.zeros(360, "<f4").tobytes()

    def predicted(revolution: int, residual: float) -> Prediction:
        values = np.zeros(len(prediction_columns()))
        values[:2] = revolution, residual
        values[[c.name for c in prediction_columns()].index("force_max")] = 1000.0
        return Prediction(revolution, values.tobytes(), curve, curve, curve)

    rig.engine.submit_prediction(predicted(6, 3.0))
    status = rig.engine.status()
    assert (status.test.twin_revolution, status.test.residual_rms_N) == (6, 3.0)
    assert len(rig.store.predictions) == 1
    eventually(lambda: rig.store.curves == 1)
    update = rig.engine.snapshot(viewer)
    assert update.prediction is not None
    assert np.frombuffer(update.predictions)[1] == 3.0
    rig.engine.submit_prediction(predicted(7, 30.0))
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert "residual_rms" in rig.engine.outcome.sentence


def test_the_twin_is_asked_for_every_sound_revolution(rig: MemoryRig) -> None:
    run(rig, 10)
    assert [one.revolution for one in rig.measured] == list(range(1, 11))
    angle = as_array(rig.measured[-1].angle_rad, "<f8")
    assert angle[0] == pytest.approx(0.0, abs=2 * math.pi * 3 / COUNTS)


def test_status_shows_the_run(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    recorded(rig, 5)
    status = rig.engine.status()
    assert status.engine.state in (RunState.RUNNING, RunState.STARTING)
    assert status.test.planned == LONG
    assert status.test.target_rpm == 120.0
    assert status.test.file == str(Path("memory.h5"))
    assert status.engine.operator == "Ada"
    assert status.test.worst_margin in ("overspeed", "stale data")
    counters = {device.name: device.counters for device in status.rig.devices}
    assert counters == {"daq": {"bytes_received": 4096, "crc_errors": 2}, "drive": {}}
    assert status.rig.drive is not None
    assert status.rig.drive.enabled
    assert status.rig.simulated


class NumberedStatus(msgspec.Struct):
    """What a viewer of before takes of a status: each of these a number."""

    speed_rpm: float = 0.0
    data_age_s: float = 0.0
    worst_margin_percent: float = math.nan
    twin_age_s: float = 0.0
    residual_rms_N: float = math.nan
    criterion_percent: float = math.nan


def test_no_number_stands_for_one_that_is_not_known(rig: MemoryRig) -> None:
    def numbers(value: object) -> Iterator[float]:
        if isinstance(value, float):
            yield value
        for inner in value.values() if isinstance(value, dict) else ():
            yield from numbers(inner)
        for inner in value if isinstance(value, list | tuple) else ():
            yield from numbers(inner)

    def sent() -> dict[str, Any]:
        status = rig.engine.status()
        parts = decode(encode(status), dict)
        wire = {**parts["engine"], **parts.get("test", {}), **parts["rig"]}
        clock = {"host_time", "started_at", "expected_end_at"}
        told = [one for name in wire.keys() - clock for one in numbers(wire[name])]
        assert all(math.isfinite(one) and abs(one) < 1e9 for one in told), wire
        msgspec.convert(wire, NumberedStatus)
        assert set(status.tree()) >= {"worst_margin_percent", "data_age_s", "twin_age_s"}
        return dict(wire)

    unknown = {"worst_margin_percent", "criterion_percent", "twin_age_s", "revolution_age_s"}
    assert not unknown & set(sent())
    # A drive need not tell everything; its numbers are None then.
    rig.spindle.current_A, rig.spindle.supply_V = math.nan, math.inf
    eventually(lambda: sent()["drive"]["current_A"] is None)
    assert sent()["drive"]["supply_V"] is None
    rig.start(a_test(LONG))
    recorded(rig, 5)
    eventually(lambda: {"worst_margin_percent", "criterion_percent"} <= set(sent()))
    assert 0.0 <= sent()["revolution_age_s"] < PATIENCE_S
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert not {"worst_margin_percent", "criterion_percent"} & set(sent())


def test_the_least_margin_is_of_what_is_judged_now(rig: MemoryRig) -> None:
    def margin() -> tuple[str, bool]:
        test = rig.engine.status().test or NO_TEST
        percent = test.worst_margin_percent
        return test.worst_margin, percent is not None and percent < 100.0 + 1e-9

    assert margin() == ("", False)
    rig.start(a_test(LONG))
    recorded(rig, 5)
    eventually(lambda: rig.engine.state is RunState.RUNNING)
    eventually(lambda: margin() == ("overspeed", True))
    rig.engine.pause("Ada")
    rig.engine.wait((RunState.PAUSED,), 20.0)
    assert margin() == ("stale data", True)  # no revolution is judged now
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 20.0)
    assert margin() == ("", False)


def test_a_ramp_is_no_judged_revolution(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    recorded(rig, 5)
    session = rig.engine._core.test
    assert session is not None
    assert int(rig.store.column("quality")[0]) & Flag.RAMP
    eventually(lambda: session.run.evaluated is not None)
    assert session.run.evaluated is not None
    assert not int(session.run.evaluated.values[BASE.place["quality"]]) & NOT_STEADY


def test_what_a_driver_warns_of_is_in_the_log(rig: MemoryRig) -> None:
    rig.start(a_test(LONG))
    log = logging.getLogger("rigapp_drivers.memory")
    for _ in range(3):
        log.warning("daq: %s is hot", "the amplifier")
    told = [
        event
        for event in rig.store.events
        if event.kind == "device" and event.source not in ("daq", "drive")
    ]
    assert [(event.source, event.text) for event in told] == [
        ("rigapp_drivers.memory", "daq: the amplifier is hot")
    ]


@pytest.mark.sampled
@pytest.mark.parametrize("samples", [7, 48, 700, 3000])
def test_which_revolutions_are_steady_does_not_depend_on_the_size_of_blocks(
    rig: MemoryRig, monkeypatch: pytest.MonkeyPatch, samples: int
) -> None:
    monkeypatch.setattr("engine_doubles.BLOCK", samples)
    run(rig, 8)
    ramp = rig.store.column("quality").astype(int) & Flag.RAMP
    np.testing.assert_array_equal(
        ramp != 0, [True, False, False, False, False, False, False, False]
    )
