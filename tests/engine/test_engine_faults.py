"""Whatever breaks, the spindle comes to rest, the file is finished, and a reason is given."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from rigapp.engine.drive.timing import Timing
from rigapp.engine.judging.checks import ANSWERS
from rigapp.schema.messages import Alarm, FinishReason, Flag, PathReport, RunState, Severity
from rigapp.schema.notices import Finished
from rigapp.schema.states import ENDED, Refused
from rigapp_drivers.api import (
    Block,
    DeviceError,
    DriveStatus,
    ProtocolError,
    SettingRefused,
    SettingsLost,
)
from tests.engine.engine_doubles import MemoryRig, a_test, back_to_work, eventually

LONG = 1_000_000


@pytest.fixture
def rig() -> Iterator[MemoryRig]:
    memory = MemoryRig()
    memory.engine.connect()
    memory.start(a_test(LONG))
    eventually(lambda: len(memory.store.rows) >= 5)
    yield memory
    memory.engine.shutdown(20.0)


def ended(rig: MemoryRig, reason: FinishReason, *words: str) -> Finished:
    """Wait for the end; check what must hold at every end."""
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is reason
    for word in words:
        assert word in outcome.sentence
    assert rig.engine.status().engine.reason == outcome.sentence
    assert rig.store.closed
    return outcome


def test_a_pulled_cable_ends_the_test_names_the_port_and_can_be_mended(rig: MemoryRig) -> None:
    rig.source.lost = True
    outcome = ended(rig, FinishReason.DEVICE, "daq", "memory", "cable")
    assert outcome.status == "fault"
    assert rig.engine.state is RunState.FAULT
    assert rig.is_stationary
    assert any("the drive only" in event.text for event in rig.store.events)
    assert rig.store.safe == len(rig.store.rows)
    with pytest.raises(Refused):
        rig.start(a_test(5))
    with pytest.raises(DeviceError):
        rig.engine.connect()
    assert rig.engine.state is RunState.FAULT
    rig.source.lost = False
    back_to_work(rig)


def test_nonsense_from_the_device_ends_the_test(rig: MemoryRig) -> None:
    rig.source.broken = ProtocolError("daq", "memory", "bytes that mean nothing")
    ended(rig, FinishReason.DEVICE, "bytes that mean nothing")
    assert rig.is_stationary


def test_stale_data_takes_the_power_off(rig: MemoryRig) -> None:
    rig.source.silent = True
    rig.engine.set_limit("stale_data_s", 0.5)
    ended(rig, FinishReason.DEVICE, "no samples")
    first_zero = next(what for what, speed in rig.spindle.commands if speed == 0.0)
    assert first_zero == "off"
    assert rig.engine.state is RunState.FAULT


def test_a_drive_fault_ends_the_test(rig: MemoryRig) -> None:
    rig.spindle.faults = ("overcurrent",)
    ended(rig, FinishReason.DEVICE, "overcurrent")
    assert rig.is_stationary
    rig.engine.acknowledge(operator="Ada")
    rig.spindle.cause_remains = True
    with pytest.raises(Refused, match="keeps its fault"):
        rig.engine.reset("Ada")
    rig.spindle.cause_remains = False
    rig.engine.reset("Ada")
    assert rig.spindle.faults == ()
    assert rig.engine.state is RunState.READY


def test_the_emergency_stop_ends_the_test(rig: MemoryRig) -> None:
    rig.spindle.emergency_stop = True
    ended(rig, FinishReason.DEVICE, "emergency stop")
    assert rig.engine.status().alarms[0].key == "emergency_stop"
    assert rig.is_stationary


def test_a_drive_that_falls_silent_is_stopped_by_its_watchdog_and_seen_by_the_encoder(
    rig: MemoryRig,
) -> None:
    rig.spindle.lost = True
    ended(rig, FinishReason.DEVICE, "no answer")
    assert any("the encoder only" in event.text for event in rig.store.events)
    assert rig.is_stationary


def test_a_lost_encoder_takes_the_power_off(rig: MemoryRig) -> None:
    rig.source.encoder_dead = True
    ended(rig, FinishReason.DEVICE, "encoder does not move")
    assert rig.is_stationary


@pytest.mark.parametrize(
    ("encoder", "drive", "words"),
    [
        (True, False, ("encoder shows the crank turning backwards",)),
        (False, True, ("drive reports that it turns backwards",)),
        (True, True, ("backwards",)),
    ],
)
def test_a_wrong_sense_ends_the_test_in_the_first_quarter_turn(
    encoder: bool, drive: bool, words: tuple[str, ...]
) -> None:
    memory = MemoryRig()
    memory.source.encoder_back = encoder
    memory.spindle.tells_ratio = -1.0 if drive else 1.0
    memory.engine.connect()
    try:
        memory.start(a_test(LONG))
        ended(memory, FinishReason.DEVICE, *words)
        assert memory.is_stationary
        if encoder:  # what the drive says comes with its next answer
            first = next(event for event in memory.store.events if event.key == "senses_differ")
            assert first.revolution == 0, "judged by the samples of a quarter turn, however late"
        assert memory.engine.outcome is not None
        advice = memory.engine.outcome.sentence
        assert any(a.key == "senses_differ" for a in memory.engine.status().alarms)
        named = "encoder.direction = -1" in advice and "spindle.direction = -1" in advice
        if not (encoder and drive):  # the drive's answer may come after the encoder's quarter turn
            assert named == encoder
    finally:
        memory.engine.shutdown(20.0)


@pytest.mark.parametrize("ratio", [0.6, 0.8, 1.25])
def test_a_drive_that_tells_another_speed_ends_the_test_and_names_the_keys(ratio: float) -> None:
    memory = MemoryRig()
    memory.spindle.tells_ratio = ratio
    memory.engine.connect()
    try:
        memory.start(a_test(LONG))
        keys = ("spindle.gear_ratio", "encoder.counts_per_revolution")
        ended(memory, FinishReason.DEVICE, "the drive", *keys)
        assert memory.is_stationary
        assert [alarm.key for alarm in memory.engine.status().alarms] == ["speeds_differ"]
        memory.spindle.tells_ratio = 1.0
        for verb in ("acknowledge", "reset"):
            getattr(memory.engine, verb)()
        assert memory.engine.status().alarms == ()
    finally:
        memory.engine.shutdown(20.0)


def test_a_drive_that_once_told_the_encoders_speed_may_stammer_later(rig: MemoryRig) -> None:
    answers = rig.spindle.polls
    eventually(lambda: rig.spindle.polls > answers + 2 * ANSWERS)
    rig.spindle.tells_ratio = 0.5
    answers = rig.spindle.polls
    eventually(lambda: rig.spindle.polls > answers + 2 * ANSWERS)
    assert rig.engine.status().alarms == ()


def test_a_missing_index_ends_the_test(rig: MemoryRig) -> None:
    rig.source.index_dead = True
    ended(rig, FinishReason.DEVICE, "index")
    quality = rig.store.column("quality").astype(int)
    assert quality[-1] & Flag.MISSED_INDEX
    assert rig.is_stationary


def test_overspeed_takes_the_power_off(rig: MemoryRig) -> None:
    with rig.crank.lock:
        rig.crank.target, rig.crank.acceleration = 5.0, 100.0
    ended(rig, FinishReason.LIMIT, "shows", "limit is 200")
    assert rig.is_stationary


def test_an_overload_at_every_turn_of_a_coasting_crank_is_one_alarm() -> None:
    rig = MemoryRig(timing=replace(MemoryRig().timing, coast=60.0))
    rig.engine.connect()
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 2, 60.0)
    rig.crank.deaf = True
    rig.source.force_N = 390.0
    eventually(lambda: rig.engine.state is RunState.STOPPING, 60.0)
    with rig.crank.lock:  # and the spring swings it faster than it ran
        rig.crank.target, rig.crank.acceleration = 5.0, 100.0
    for force_N in (50.0, 390.0, 50.0, 390.0, 50.0):
        rig.source.force_N = force_N
        reads = rig.source.reads
        eventually(lambda before=reads: rig.source.reads > before + 3, 60.0)  # type: ignore[misc]
    with rig.crank.lock:
        rig.crank.target = 0.0
    ended(rig, FinishReason.LIMIT, "390")
    told = [e.text.partition(". ")[0] for e in rig.store.events if e.kind == "alarm"]
    assert told.count("Overload: raised, first out") == 1
    assert "Overload: raised" not in told
    assert not any("Overspeed" in text for text in told)
    eventually(lambda: rig.engine.status().alarms[0].state == "latched")
    rig.crank.deaf = False
    back_to_work(rig)
    rig.engine.shutdown(20.0)


def test_a_jammed_crank_ends_the_test(rig: MemoryRig) -> None:
    rig.crank.jammed = True
    ended(rig, FinishReason.DEVICE, "rpm are set")


def test_lost_samples_are_flagged_counted_and_logged(rig: MemoryRig) -> None:
    rows = len(rig.store.rows)
    rig.source.lose_samples = 20
    eventually(lambda: any(a.key == "lost_samples" for a in rig.engine.status().alarms))
    eventually(lambda: len(rig.store.rows) >= rows + 5)
    rig.engine.stop("Ada")
    ended(rig, FinishReason.OPERATOR)
    assert rig.store.column("lost_samples").sum() == 20
    flagged = rig.store.column("quality").astype(int) & Flag.LOST_SAMPLES
    assert 1 <= (flagged > 0).sum() <= 2


def test_a_gap_of_several_revolutions_leaves_a_gap_in_the_numbers(rig: MemoryRig) -> None:
    rows = len(rig.store.rows)
    rig.source.lose_samples = 1200  # 2.5 s at 2 rev/s: five revolutions
    eventually(lambda: len(rig.store.rows) >= rows + 6)
    rig.engine.stop("Ada")
    ended(rig, FinishReason.OPERATOR)
    steps = rig.store.column("revolution")[1:] - rig.store.column("revolution")[:-1]
    assert sorted(set(steps.tolist())) in ([1.0, 5.0], [1.0, 6.0])
    assert len(rig.store.gaps) == 1
    assert rig.store.column("revolution")[-1] == pytest.approx(rig.crank.position_rev, abs=3.0)


def test_a_file_that_cannot_be_written_ends_the_test(rig: MemoryRig) -> None:
    rig.store.broken = OSError("input/output error")
    outcome = ended(rig, FinishReason.STORAGE, "memory.h5", "input/output error")
    assert outcome.status == "fault"
    assert rig.is_stationary
    rig.engine.acknowledge(operator="Ada")
    rig.engine.reset("Ada")
    assert rig.engine.state is RunState.READY


def test_a_hanging_disk_ends_the_test(rig: MemoryRig) -> None:
    rig.store.commit_waits = release = threading.Event()
    eventually(lambda: rig.engine.state is not RunState.RUNNING)
    eventually(lambda: rig.is_stationary)
    release.set()
    ended(rig, FinishReason.INTERNAL, "commit")


@pytest.mark.parametrize("name", ["read daq", "process", "commit", "drive", "supervise"])
def test_a_dead_thread_ends_the_test(rig: MemoryRig, name: str) -> None:
    connection = rig.engine._connection
    assert connection is not None
    worker = next(one for one in connection.workers if one.name == name)

    def die() -> None:
        raise RuntimeError("a bug")

    worker._step = die
    outcome = ended(rig, FinishReason.INTERNAL, name, "a bug")
    assert outcome.status == "fault"
    assert rig.is_stationary
    assert rig.store.ending is not None
    back_to_work(rig)


@pytest.mark.sampled
@pytest.mark.parametrize("name", ["process", "commit", "drive", "supervise"])
def test_a_silent_thread_ends_the_test(rig: MemoryRig, name: str) -> None:
    connection = rig.engine._connection
    assert connection is not None
    worker = next(one for one in connection.workers if one.name == name)
    rig.engine._core.timing = replace(rig.engine._core.timing, queue_age=600.0)  # would be first
    release = threading.Event()

    def hang() -> None:
        release.wait(30.0)

    worker._step = hang
    try:
        ended(rig, FinishReason.INTERNAL, name, "sent no heartbeat")
        assert rig.is_stationary
    finally:
        release.set()


def test_a_slow_disk_is_told_while_it_is_slow_and_costs_nothing(
    rig: MemoryRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in ("core", "supervisor"):
        monkeypatch.setattr(f"rigapp.engine.{module}.SLOW_DISK_S", 0.1)
    go_on = rig.store.commit_waits = threading.Event()
    eventually(lambda: any(a.key == "disk_slow" for a in rig.engine.status().alarms), 60.0)
    rows = len(rig.store.rows)
    eventually(lambda: len(rig.store.rows) > rows + 3, 60.0)
    rig.store.commit_waits = None
    go_on.set()
    eventually(lambda: any(event.kind == "disk" for event in rig.store.events), 60.0)
    eventually(
        lambda: not any(a.key == "disk_slow" and a.active for a in rig.engine.status().alarms), 60.0
    )
    rig.engine.stop("Ada")
    ended(rig, FinishReason.OPERATOR)
    numbers = rig.store.column("revolution")
    assert list(numbers) == list(range(1, len(numbers) + 1))
    assert rig.store.safe == len(numbers)


def test_a_jump_of_the_computers_clock_is_in_the_log(
    rig: MemoryRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    core = rig.engine._core
    core.anchor = (core.anchor[0], core.anchor[1] - 3600.0)
    monkeypatch.setattr("rigapp.engine.supervisor.ANCHOR_S", 0.0)
    eventually(lambda: any(event.kind == "clock" for event in rig.store.events), 60.0)
    (told,) = [event for event in rig.store.events if event.kind == "clock"]
    assert "jumped by 3600" in told.text
    assert rig.engine.state is RunState.RUNNING


def test_a_hanging_drive_call_is_no_hanging_test() -> None:
    quick = Timing(
        read=0.02, poll=0.02, commit=0.05, supervise=0.01, silence=0.5, stop_margin=0.2,
        coast=0.3, make_safe=0.05,
    )  # fmt: skip
    rig = MemoryRig(timing=quick)
    rig.engine.connect()
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 5)
    rig.spindle.hang = threading.Event()
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.INTERNAL
    assert any(a.key == "will_not_stop" for a in rig.engine.status().alarms)
    rig.spindle.hang.set()
    rig.engine.shutdown()


def test_a_spindle_that_does_not_stop_raises_the_loudest_alarm(rig: MemoryRig) -> None:
    rig.crank.deaf = True
    rig.engine.stop("Ada")
    assert rig.engine.wait(ENDED, 60.0) is RunState.FAULT
    keys = [alarm.key for alarm in rig.engine.status().alarms]
    assert "will_not_stop" in keys
    offs = [what for what, _ in rig.spindle.commands]
    assert "off" in offs
    rig.crank.deaf = False
    rig.engine.drive_off("Ada")
    eventually(lambda: rig.is_stationary)
    eventually(lambda: not any(a.active for a in rig.engine.status().alarms))


def test_a_drive_that_confirms_and_ignores_every_command_is_stopped_by_its_watchdog() -> None:
    # A loaded computer needs longer than the others' coast time to see that it does not slow down.
    rig = MemoryRig(timing=replace(MemoryRig().timing, coast=30.0))
    rig.engine.connect()
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 5)
    rig.spindle.ignores = math.inf
    rig.engine.drive_off("Ada")
    ended(rig, FinishReason.OPERATOR, "confirmed the power-off, but the crank still turns")
    assert rig.is_stationary
    assert rig.engine.state is RunState.FAULT
    rig.spindle.ignores = 0.0
    back_to_work(rig)
    rig.engine.shutdown(20.0)


@pytest.mark.sampled
@pytest.mark.parametrize("healthy", [True, False])
def test_a_standstill_that_only_the_drive_reports_is_left_to_its_watchdog_and_told(
    rig: MemoryRig, healthy: bool
) -> None:
    rig.engine.set_limit("stale_data_s", 60.0)  # a loaded computer is late with what follows
    rig.source.silent = True
    if not healthy:
        rig.spindle.ignores, rig.spindle.tells_ratio = math.inf, 0.0
    eventually(lambda: rig.engine.status().rig.data_age_s > 1.0)
    rig.engine.drive_off("Ada")
    ended(rig, FinishReason.OPERATOR, "The stop cannot be confirmed", "drive reports a standstill")
    assert rig.engine.state is RunState.FAULT
    rig.source.silent = False
    eventually(lambda: rig.is_stationary)
    assert not rig.crank.powered
    rig.spindle.ignores, rig.spindle.tells_ratio = 0.0, 1.0
    back_to_work(rig)


def test_a_crank_that_turns_by_itself_is_switched_off_in_every_state_and_told() -> None:
    memory = MemoryRig()
    memory.engine.connect()
    memory.spindle.turn_by_itself()
    memory.engine.wait((RunState.FAULT,), 60.0)
    eventually(lambda: memory.is_stationary)
    assert "without a command" in memory.engine.status().engine.reason
    eventually(lambda: not any(a.active for a in memory.engine.status().alarms))
    memory.spindle.ignores = math.inf
    memory.spindle.turn_by_itself()
    eventually(lambda: any(a.key == "will_not_stop" for a in memory.engine.status().alarms))
    eventually(lambda: memory.is_stationary)
    memory.spindle.ignores = 0.0
    back_to_work(memory)
    memory.engine.shutdown(20.0)


def test_a_crank_that_moves_in_a_pause_ends_the_test(rig: MemoryRig) -> None:
    rig.engine.pause("Ada")
    rig.engine.wait((RunState.PAUSED,), 60.0)
    with rig.crank.lock:
        rig.crank.target = 0.5
    ended(rig, FinishReason.DEVICE, "paused")
    assert rig.is_stationary


def test_a_drive_that_has_lost_its_settings_is_switched_off(rig: MemoryRig) -> None:
    polled = rig.spindle.status
    errors = iter([SettingsLost("drive", "memory", "the drive has lost its settings")])

    def status() -> DriveStatus:
        raise next(errors, SettingRefused("drive", "memory", "configure the drive first"))

    rig.spindle.status = status  # type: ignore[method-assign]
    ended(rig, FinishReason.DEVICE, "lost its settings")
    assert rig.spindle.commands[-1] == ("off", 0.0)
    critical = {one.key for one in rig.engine.status().alarms if one.severity is Severity.CRITICAL}
    assert critical == {"drive_settings_lost"}
    rig.spindle.status = polled  # type: ignore[method-assign]
    back_to_work(rig)


def test_a_device_lost_while_ready_is_a_fault() -> None:
    memory = MemoryRig()
    memory.engine.connect()
    memory.source.lost = True
    memory.engine.wait((RunState.FAULT,), 60.0)
    assert "cable" in memory.engine.status().engine.reason
    memory.source.lost = False
    back_to_work(memory)
    memory.engine.shutdown()


def test_a_rig_that_cannot_be_connected_is_a_fault_with_a_reason() -> None:
    memory = MemoryRig()
    memory.source.open_fails = True
    with pytest.raises(DeviceError, match="nothing answers"):
        memory.engine.connect()
    assert memory.engine.state is RunState.FAULT
    assert "daq on memory" in memory.engine.status().engine.reason
    memory.source.open_fails = False
    back_to_work(memory)
    memory.engine.shutdown()


def test_no_thread_is_left_behind() -> None:
    before = set(threading.enumerate())
    memory = MemoryRig()
    memory.engine.connect()
    memory.start(a_test(5))
    memory.engine.wait(ENDED, 60.0)
    memory.engine.shutdown()
    eventually(lambda: set(threading.enumerate()) <= before)


def test_a_full_queue_of_a_real_rig_is_an_overrun_and_a_gap() -> None:
    rig = MemoryRig(simulated=False)
    rig.engine._core.timing = replace(rig.timing, queue_age=600.0, silence=60.0)
    rig.engine.connect()
    rig.start(a_test(LONG))
    eventually(lambda: len(rig.store.rows) >= 5)
    connection = rig.engine._connection
    assert connection is not None
    handle = connection.rig.processor.handle
    go_on = threading.Event()

    def slow(block: Block) -> None:
        go_on.wait(0.9)
        handle(block)

    connection.rig.processor.handle = slow  # type: ignore[method-assign]
    eventually(lambda: connection.rig.queue.refused_blocks > 10)
    go_on.set()
    connection.rig.processor.handle = handle  # type: ignore[method-assign]
    eventually(lambda: any(a.key == "overrun" for a in rig.engine.status().alarms))
    eventually(lambda: connection.rig.processor.assembler.lost_samples > 0)
    rows = len(rig.store.rows)
    eventually(lambda: len(rig.store.rows) >= rows + 3)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert rig.store.column("lost_samples").sum() == connection.rig.processor.assembler.lost_samples
    assert len(rig.store.gaps) == 1
    rig.engine.shutdown()
    assert rig.is_stationary


# --- the name of the file ------------------------------------------------------------------------


def test_a_file_that_lost_its_name_is_told_while_the_test_goes_on(rig: MemoryRig) -> None:
    rig.store.path = Path("elsewhere.h5")
    rig.store.looked_after = PathReport("t.h5 was moved; elsewhere.h5 is its new name.", saved=True)
    eventually(lambda: "was moved" in cause_of(rig, "file_moved"))
    rig.store.looked_after = None
    lines = [one for one in rig.store.events if one.key == "file_moved"]
    assert "is being saved" in lines[0].data["cause"]
    eventually(lambda: not any(a.active for a in rig.engine.status().alarms))
    eventually(lambda: rig.engine.status().test.file == "elsewhere.h5")
    assert rig.engine.state is RunState.RUNNING


def test_a_file_that_cannot_be_saved_is_critical_and_ends_no_test(rig: MemoryRig) -> None:
    rig.store.looked_after = PathReport("t.h5 was deleted, and could not be saved", saved=False)
    eventually(lambda: alarm_of(rig, "file_unsaved") is not None)
    told = alarm_of(rig, "file_unsaved")
    assert told is not None
    assert told.severity == "critical"
    assert told.active
    assert rig.engine.state is RunState.RUNNING
    rig.store.looked_after = None
    eventually(lambda: not any(a.active for a in rig.engine.status().alarms))
    assert rig.engine.state is RunState.RUNNING


def cause_of(rig: MemoryRig, key: str) -> str:
    found = alarm_of(rig, key)
    return "" if found is None else found.cause


def alarm_of(rig: MemoryRig, key: str) -> Alarm | None:
    return next((one for one in rig.engine.status().alarms if one.key == key), None)
