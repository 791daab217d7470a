"""Sequences, motion, time, threads and queues: the parts that make a stop sure."""

from __future__ import annotations

import math
import threading
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp.engine.drive.sequences import (
    CREEP_RPM,
    DriveStep,
    PauseSequence,
    StandstillEvidence,
    StopSequence,
)
from rigapp.engine.publish import NoticeStream
from rigapp.engine.samples.buffers import BlockQueue
from rigapp.engine.samples.motion import MotionWindow, Point
from rigapp.engine.watches import LATE_S, LagWatch
from rigapp.process.threads import Worker
from rigapp.schema.messages import FinishReason, RunState
from rigapp.schema.notices import Committed, Finished, StateChanged
from rigapp_drivers.api import Block
from tests.engine.engine_doubles import eventually

WATCHDOG_S = 0.5

# --- the stop ------------------------------------------------------------------------------------


class Spinning:
    """A spindle for the sequences: obeys, or does not."""

    def __init__(self, obeys_ramp: bool, obeys_off: bool, takes: bool = True) -> None:
        self.rpm = 30.0
        self.obeys_ramp, self.obeys_off, self.takes = obeys_ramp, obeys_off, takes
        self.done: list[DriveStep] = []
        self.drive = self.encoder = True

    def run(self, sequence: StopSequence, start: float = 0.0) -> tuple[DriveStep, float]:
        now = start
        slowing = False
        while True:
            now += 0.01
            if slowing:
                self.rpm = max(0.0, self.rpm - 1.0)
            is_stationary = self.rpm == 0.0
            do = sequence.step(
                StandstillEvidence(
                    now,
                    self.rpm if self.drive else None,
                    self.rpm if self.encoder else None,
                    is_stationary if self.encoder else None,
                    drive_s=now,
                    encoder_s=now,
                )
            )
            if do is DriveStep.STANDING:
                assert sequence.step(StandstillEvidence(now, 0.0, 0.0, True)) is DriveStep.WAIT
            if do in (DriveStep.STANDING, DriveStep.GIVE_UP):
                return do, now
            if do in (DriveStep.WAIT, DriveStep.NO_EFFECT):
                continue
            self.done.append(do)
            if self.takes:
                sequence.commanded(do, now)
                slowing |= self.obeys_ramp if do is DriveStep.RAMP_DOWN else self.obeys_off
            assert now < 1000.0


def test_a_controlled_stop_ends_without_power() -> None:
    spindle = Spinning(obeys_ramp=True, obeys_off=False)
    sequence = StopSequence(False, 0.0, ramp_s=2.0, coast_s=2.0)
    do, _ = spindle.run(sequence)
    assert do is DriveStep.STANDING
    assert spindle.done == [DriveStep.RAMP_DOWN, DriveStep.POWER_OFF]
    assert not sequence.escalated
    assert sequence.witnesses == "drive and encoder"


def test_a_stop_that_is_not_obeyed_is_escalated() -> None:
    spindle = Spinning(obeys_ramp=False, obeys_off=True)
    sequence = StopSequence(False, 0.0, ramp_s=2.0, coast_s=2.0)
    do, now = spindle.run(sequence)
    assert do is DriveStep.STANDING
    assert sequence.escalated
    assert 2.0 < now < 3.0


def test_a_spindle_that_obeys_nothing_is_given_up_in_time() -> None:
    do, now = Spinning(False, False).run(StopSequence(False, 0.0, ramp_s=2.0, coast_s=3.0))
    assert do is DriveStep.GIVE_UP
    assert 5.0 < now < 5.2


def test_a_command_that_is_not_taken_is_given_again() -> None:
    spindle = Spinning(True, True, takes=False)
    do, _ = spindle.run(StopSequence(False, 0.0, ramp_s=1.0, coast_s=1.0))
    assert do is DriveStep.GIVE_UP
    assert spindle.done.count(DriveStep.RAMP_DOWN) > 2
    assert spindle.done.count(DriveStep.POWER_OFF) > 2


def test_a_ramp_that_is_confirmed_and_ignored_is_repeated() -> None:
    sequence, now, repeated = StopSequence(False, 0.0, 10.0, 15.0), 0.0, 0
    sequence.commanded(DriveStep.RAMP_DOWN, 0.0)
    while now < 5.0:
        now += 0.01
        do = sequence.step(StandstillEvidence(now, 60.0, 60.0, False, turns=now, turns_s=now))
        if do is DriveStep.RAMP_DOWN:
            repeated += 1
            sequence.commanded(do, now)
    assert repeated > 2
    assert not sequence.escalated


def test_a_drive_that_does_not_hear_is_left_to_its_watchdog() -> None:
    sequence = StopSequence(False, 0.0, ramp_s=5.0, coast_s=5.0, watchdog_s=0.5)
    rpm, now, heard, silences = 30.0, 0.0, 0.0, []
    while True:
        now += 0.01
        if now - heard > 0.5:  # what the watchdog does
            rpm = max(0.0, rpm - 1.0)
        do = sequence.step(StandstillEvidence(now, None, rpm, rpm == 0.0, encoder_s=now))
        if do is DriveStep.STANDING:
            break
        if do in (DriveStep.RAMP_DOWN, DriveStep.POWER_OFF) or not sequence.quiet:
            heard = now  # polled, or asked to stop: it hears and does not obey
        else:
            silences.append(now)
        assert now < 3.0
    assert sequence.escalated
    assert len(silences) > 50


class Disobedient:
    """A drive that confirms all and obeys the power-off after so many; its watchdog works."""

    WATCHDOG_S = 0.5

    def __init__(self, ignores: float, rpm: float = 60.0, coast_rpm_per_s: float = 20.0) -> None:
        self.ignores, self.rpm, self.slows = ignores, rpm, coast_rpm_per_s
        self.fired: float | None = None
        self.now = self.fed = self.turns = 0.0
        self.steps: list[tuple[float, DriveStep]] = []

    def run(self, sequence: StopSequence, seconds: float) -> float | None:
        """Run for so long; return when it was seen to stand."""
        reached_standstill = None
        end = self.now + seconds
        while self.now < end:
            self.now += 0.01
            if self.now - self.fed > self.WATCHDOG_S and self.fired is None and self.ignores > 0:
                self.fired, self.rpm = self.now, 0.0
            if self.ignores <= 0:
                self.rpm = max(0.0, self.rpm - 0.01 * self.slows)
            self.turns += self.rpm / 60.0 * 0.01
            told = None if self.now - self.fed > 0.5 else self.rpm
            do = sequence.step(
                StandstillEvidence(
                    self.now, told, self.rpm, self.rpm == 0.0, turns=self.turns, turns_s=self.now
                )
            )
            if do is DriveStep.POWER_OFF:
                self.ignores -= 1
                sequence.commanded(do, self.now)
            if not sequence.quiet or do is DriveStep.POWER_OFF:
                self.fed = self.now
            if do is not DriveStep.WAIT:
                self.steps.append((self.now, do))
            if do is DriveStep.STANDING:
                reached_standstill = self.now
        return reached_standstill


@pytest.mark.parametrize("ignored", [1, 5])
def test_a_power_off_that_is_confirmed_and_ignored_is_repeated(ignored: int) -> None:
    drive = Disobedient(ignored)
    reached_standstill = drive.run(StopSequence(True, 0.0, 1.0, 15.0), 10.0)
    assert reached_standstill == pytest.approx(3.0 + 0.1 * ignored, abs=0.2)
    assert drive.fired is None


@pytest.mark.parametrize(("rpm", "within_s"), [(60.0, 3.5), (400.0, 3.5), (30.0, 5.5), (2.0, 16.5)])
def test_a_drive_that_confirms_and_ignores_every_power_off_is_left_to_its_watchdog(
    rpm: float, within_s: float
) -> None:
    drive = Disobedient(math.inf, rpm)
    reached_standstill = drive.run(StopSequence(True, 0.0, 1.0, 15.0), 20.0)
    assert drive.fired is not None
    assert reached_standstill is not None
    assert reached_standstill < within_s
    steps = [do for _, do in drive.steps]
    assert steps.count(DriveStep.NO_EFFECT) == 1
    assert (DriveStep.GIVE_UP in steps) == (rpm == 2.0), "before its second turn"


@pytest.mark.parametrize(("rpm", "slows"), [(600.0, 42.0), (60.0, 5.0), (60.0, 60.0), (10.0, 1.0)])
def test_a_crank_that_coasts_is_not_taken_for_one_that_is_driven(rpm: float, slows: float) -> None:
    drive = Disobedient(1, rpm, slows)
    sequence = StopSequence(True, 0.0, 1.0, 15.0)
    assert drive.run(sequence, 16.0) is not None
    assert not sequence.ignored


def test_a_stop_that_was_given_up_goes_on_until_the_crank_stands() -> None:
    drive = Disobedient(math.inf)
    drive.WATCHDOG_S = 3.0  # longer than the engine was told
    sequence = StopSequence(True, 0.0, 1.0, 2.0, watchdog_s=0.5)
    assert drive.run(sequence, 10.0) is None
    assert [do for _, do in drive.steps].count(DriveStep.GIVE_UP) == 1
    drive.ignores = 1
    assert drive.run(sequence, 10.0) is not None


def test_a_crank_that_begins_to_turn_by_itself_is_switched_off_again() -> None:
    sequence = StopSequence.at_rest(15.0, 0.5)
    drive = Disobedient(2, rpm=0.0)
    drive.run(sequence, 1.0)
    assert drive.steps == []
    drive.rpm = 30.0
    assert drive.run(sequence, 5.0) is not None
    assert sequence.by_itself
    drive.ignores, drive.rpm = math.inf, 30.0
    drive.run(sequence, 20.0)
    assert drive.fired is not None, "in every state, nothing is sent to a drive that ignores it"
    assert drive.rpm == 0.0


def test_a_crank_that_is_turned_by_hand_leaves_the_drive_in_peace() -> None:
    sequence = StopSequence.at_rest(15.0, 0.5)
    now = turns = 0.0
    for i in range(6000):
        now += 0.01
        rpm = 25.0 + 8.0 * math.sin(0.003 * i) + 5.0 * math.sin(0.11 * i)
        turns += rpm / 60.0 * 0.01
        assert sequence.step(
            StandstillEvidence(now, rpm, rpm, False, turns=turns, turns_s=now)
        ) in (
            DriveStep.WAIT,
            DriveStep.POWER_OFF,
        )
        sequence.commanded(DriveStep.POWER_OFF, now)
        assert not sequence.quiet


def test_one_witness_is_enough_and_none_is_not() -> None:
    for drive, encoder, words in (
        (True, False, "the drive only"),
        (False, True, "the encoder only"),
    ):
        spindle = Spinning(True, True)
        spindle.drive, spindle.encoder = drive, encoder
        sequence = StopSequence(True, 0.0, ramp_s=1.0, coast_s=2.0)
        do, ended_s = spindle.run(sequence)
        assert do is DriveStep.STANDING
        assert sequence.witnesses == words
        assert sequence.unseen is drive, "a drive alone is left to its watchdog before"
        assert (ended_s > 0.3 + 2.0 * WATCHDOG_S) is drive
    spindle = Spinning(True, True)
    spindle.drive = spindle.encoder = False
    sequence = StopSequence(True, 0.0, ramp_s=1.0, coast_s=2.0)
    assert spindle.run(sequence)[0] is DriveStep.GIVE_UP
    assert sequence.witnesses == "nobody"


def test_what_was_seen_before_the_command_does_not_count() -> None:
    sequence = StopSequence(True, 0.0, ramp_s=1.0, coast_s=2.0)
    sequence.commanded(DriveStep.POWER_OFF, 0.5)
    old = StandstillEvidence(0.6, 0.0, 0.0, True, drive_s=0.4, encoder_s=0.6)
    assert sequence.step(old) is DriveStep.WAIT
    assert sequence.step(replace(old, drive_s=0.55)) is DriveStep.STANDING


@settings(max_examples=15, deadline=None)
@given(
    st.floats(0.0, 359.9),
    st.floats(1.0, 600.0),
    st.floats(20.0, 2000.0),
    st.floats(0.0, 359.9),
)
def test_a_pause_comes_to_rest_at_its_angle(
    wanted: float, rpm: float, deceleration: float, start: float
) -> None:
    sequence = PauseSequence(wanted, rpm, deceleration, 0.0, limit_s=1e9)
    angle, speed, target, now, step = start, rpm, rpm, 0.0, 0.001
    while True:
        now += step
        change = deceleration * step
        speed += max(-change, min(change, target - speed))
        angle = (angle + 6.0 * speed * step) % 360.0
        is_stationary = speed == 0.0
        do = sequence.step(StandstillEvidence(now, speed, speed, is_stationary, angle, 6.0 * speed))
        if do is DriveStep.CREEP:
            target = sequence.creep_rpm
            assert target == min(rpm, CREEP_RPM)
        elif do is DriveStep.RAMP_DOWN:
            target = 0.0
        elif do is DriveStep.STANDING:
            break
        assert do is not DriveStep.GIVE_UP
    error = (angle - wanted + 180.0) % 360.0 - 180.0
    assert abs(error) < 1.0


def test_a_pause_that_does_not_come_is_given_up() -> None:
    sequence = PauseSequence(90.0, 30.0, 60.0, 0.0, limit_s=5.0)
    assert sequence.step(StandstillEvidence(0.1, 30.0, None, None)) is DriveStep.CREEP
    assert sequence.step(StandstillEvidence(4.9, 30.0, None, None)) is DriveStep.WAIT
    assert sequence.step(StandstillEvidence(5.1, 30.0, None, None)) is DriveStep.GIVE_UP


# --- motion --------------------------------------------------------------------------------------


def moving(rpm: float, seconds: float, block: int = 48, pace: float = 1.0) -> MotionWindow:
    window = MotionWindow(360, 480.0, 30.0)
    for i in range(int(seconds * 480 / block)):
        end = (i + 1) * block - 1
        count = math.floor(rpm * 6.0 * end / 480.0)
        window.add(None, Point(end, count, 100.0 + end / 480.0 / pace, count % 360))
    return window


def test_motion_tells_speed_pace_and_angle() -> None:
    window = moving(30.0, 5.0, pace=20.0)
    assert window.speed_rpm(0.5) == pytest.approx(30.0, rel=0.01)
    assert window.pace() == pytest.approx(20.0, rel=0.01)
    assert not window.standing(0.2)
    newest = window.newest()
    assert newest is not None
    assert newest.phase is not None
    angle = window.angle_deg(newest.host_s + 0.01)
    # 30 rpm at twenty times real time: 3600 degrees a second.
    assert angle == pytest.approx((30.0 + newest.phase + 36.0) % 360.0, abs=1.0)


def test_a_dithering_edge_is_a_stand() -> None:
    window = MotionWindow(360, 480.0, 0.0)
    for i in range(20):
        window.add(None, Point(i * 48, 100 + i % 2, i * 0.1, 100))
    assert window.standing(0.25)
    window.add(None, Point(20 * 48, 105, 2.0, 105))
    assert not window.standing(0.25)


def test_a_stand_needs_data_for_the_whole_time() -> None:
    window = MotionWindow(360, 480.0, 0.0)
    assert not window.standing(0.25)
    window.add(None, Point(0, 5, 0.0, 5))
    assert not window.standing(0.25)
    window.add(None, Point(130, 5, 0.3, 5))
    assert window.standing(0.25)


def test_an_unknown_index_is_an_unknown_angle() -> None:
    window = MotionWindow(360, 480.0, 0.0)
    assert window.angle_deg(0.0) is None
    window.add(None, Point(0, 5, 0.0, None))
    assert window.angle_deg(0.0) is None


# --- time ----------------------------------------------------------------------------------------


def jumps(delays: list[float]) -> list[float]:
    watch = LagWatch()
    found = [watch.add(delay, i * 0.05 + delay) for i, delay in enumerate(delays)]
    return [grown for grown in found if grown > LATE_S]


def test_samples_lost_unseen_show_as_a_jump_of_time() -> None:
    found = jumps([0.01] * 100 + [3.01] * 100)
    assert len(found) == 1
    assert found[0] == pytest.approx(3.0)


def test_a_late_reader_is_no_jump() -> None:
    late = [0.01] * 100 + [1.0 - 0.05 * i for i in range(20)] + [0.01] * 100
    assert jumps(late) == []


def test_a_clock_that_drifts_is_no_jump() -> None:
    assert jumps([0.01 + 2e-4 * 0.05 * i for i in range(5000)]) == []


# --- threads -------------------------------------------------------------------------------------


def block(sequence: int, samples: int = 10) -> Block:
    return Block(
        "daq", sequence, sequence * samples, 100.0, 0,
        np.zeros((5, samples), np.float32), np.zeros(samples, np.uint8),
    )  # fmt: skip


def test_a_full_queue_refuses_and_counts() -> None:
    queue = BlockQueue(25)
    assert [queue.put(block(i)) for i in range(4)] == [True, True, False, False]
    assert queue.refused_blocks == 2
    first = queue.get(0.0)
    assert first is not None
    assert first.sequence == 0
    assert queue.put(block(4))
    assert queue.samples == 20


def test_a_reader_that_waits_for_room_loses_nothing() -> None:
    queue = BlockQueue(25)
    sent = list(range(50))

    def read() -> None:
        for i in sent:
            while not queue.wait_below(11, 0.05):
                pass
            assert queue.put(block(i))

    reader = threading.Thread(target=read)
    reader.start()
    got = [queue.get(5.0) for _ in sent]
    reader.join(5.0)
    assert [one.sequence for one in got if one is not None] == sent
    assert not BlockQueue(25).wait_below(0, 0.0)


def test_a_block_larger_than_the_queue_passes() -> None:
    queue = BlockQueue(5)
    assert queue.put(block(0, 10))


def test_an_empty_queue_returns_nothing_in_time() -> None:
    assert BlockQueue(5).get(0.0) is None


def test_a_worker_dies_loudly_and_ends_quietly() -> None:
    deaths: list[tuple[str, BaseException]] = []
    steps = iter([None, None])

    def step() -> None:
        next(steps)

    worker = Worker("test", step, lambda w, e: deaths.append((w.name, e)), 1.0)
    worker.start()
    assert worker.join(5.0)
    assert [(name, type(error)) for name, error in deaths] == [("test", StopIteration)]
    assert not worker.well
    quiet = Worker("quiet", lambda: False, lambda w, e: deaths.append((w.name, e)), 1.0)
    quiet.start()
    assert quiet.join(5.0)
    assert quiet.well
    assert len(deaths) == 1


def test_a_worker_that_hangs_is_not_well() -> None:
    release = threading.Event()
    worker = Worker("test", lambda: release.wait(10.0) and None, lambda *_: None, 0.05)
    worker.start()
    eventually(lambda: not worker.well)
    assert worker.silent_for() > 0.04
    worker.halt()
    release.set()
    assert worker.join(5.0)


# --- notices -------------------------------------------------------------------------------------


def test_a_full_stream_forgets_commits_before_anything_else() -> None:
    stream = NoticeStream(bound=4)
    finished = Finished(FinishReason.COMPLETE, "", "complete", 9, "x.h5")
    for notice in (
        StateChanged(RunState.RUNNING, ""),
        Committed(1),
        Committed(2),
        Committed(3),
        StateChanged(RunState.STOPPING, ""),
        finished,
    ):
        stream.put(notice)
    got = [stream.get(0.0) for _ in range(5)]
    assert got == [
        StateChanged(RunState.RUNNING, ""),
        Committed(3),
        StateChanged(RunState.STOPPING, ""),
        finished,
        None,
    ]
    assert stream.dropped == 2
