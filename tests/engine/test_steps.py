"""A test of several steps: each at its speed, with its limits and rests, also when resumed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import msgspec
import numpy as np
import pytest

from rigapp.config.recipe import LimitRule, RunStep, TestFile
from rigapp.engine import activetest
from rigapp.engine.recording.store import Opened
from rigapp.presentation.states import state_line
from rigapp.schema.loglines import REST
from rigapp.schema.messages import Event, Flag, RunState
from rigapp.schema.notices import Finished, Notice, StateChanged
from rigapp.schema.states import ENDED, Refused
from tests.engine.engine_doubles import FakeStore, MemoryRig, a_test, eventually

PACE = 40.0
"""The rig in memory runs at least so many times as fast as the computer's clock."""


@pytest.fixture
def rig() -> Iterator[MemoryRig]:
    memory = MemoryRig()
    memory.engine.connect()
    yield memory
    memory.engine.shutdown(20.0)
    assert memory.is_stationary


def sequence(
    revolutions: int, *steps: RunStep, again: int = 1, rules: tuple[LimitRule, ...] = ()
) -> TestFile:
    test = a_test(revolutions, rules=rules)
    run = msgspec.structs.replace(test.run, step=steps, repeat_from_step=again)
    return msgspec.structs.replace(test, run=run)


def run(rig: MemoryRig, test: TestFile) -> Finished:
    rig.start(test)
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    return rig.engine.outcome


def speeds(rig: MemoryRig) -> list[float]:
    """Return the speeds that the drive was told while the test ran, without repetitions."""
    told = [60.0 * value for kind, value in rig.spindle.commands if kind == "speed"]
    return [one for place, one in enumerate(told) if place == 0 or one != told[place - 1]]


def notices_of(watched: Any) -> list[Notice]:
    """Return what was told so far."""
    return list(iter(lambda: watched.get(0.0), None))


def steps_told(rig: MemoryRig) -> list[Event]:
    return [one for one in rig.store.events if one.kind == "step"]


def test_each_step_has_its_speed_and_no_revolution_is_lost(rig: MemoryRig) -> None:
    outcome = run(
        rig,
        sequence(
            60,
            RunStep(revolutions=20, speed_rpm=60.0),
            RunStep(revolutions=20),
            RunStep("slow", revolutions=20, speed_rpm=30.0),
        ),
    )
    assert (outcome.status, outcome.revolutions) == ("complete", 60)
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(1, 61))
    speed, ramp = rig.store.column("speed"), rig.store.column("quality").astype(int) & Flag.RAMP
    for first, rpm in ((1, 60.0), (21, 120.0), (41, 30.0)):
        assert ramp[first - 1], f"the speed changes in revolution {first}"
        steady = [n for n in range(first, first + 20) if not ramp[n - 1]]
        assert len(steady) > 5
        np.testing.assert_allclose(speed[np.array(steady) - 1], rpm, rtol=0.05)
    assert speeds(rig)[:3] == pytest.approx([60.0, 120.0, 30.0])
    assert [one.revolution for one in steps_told(rig)] == [20, 40]
    assert steps_told(rig)[1].text == "step 3 (slow): 30 rpm to revolution 60"
    assert not [one for one in rig.engine.status().alarms if one.active]


def test_the_steps_come_again_from_the_one_that_is_named(rig: MemoryRig) -> None:
    run(
        rig,
        sequence(
            50,
            RunStep(revolutions=10, speed_rpm=60.0),
            RunStep(revolutions=10, speed_rpm=120.0),
            RunStep(revolutions=10, speed_rpm=90.0),
            again=2,
        ),
    )
    assert [one.after for one in steps_told(rig)] == ["step 2", "step 3", "step 2", "step 3"]
    assert [one.revolution for one in steps_told(rig)] == [10, 20, 30, 40]


def test_a_rest_stands_at_the_safe_angle_notes_the_creep_and_goes_on_by_itself(
    rig: MemoryRig,
) -> None:
    watched = rig.engine.watch()
    outcome = run(
        rig,
        sequence(
            310,
            RunStep(revolutions=10, rest_s=2.0 * PACE),
            RunStep(revolutions=300, speed_rpm=60.0),
        ),
    )
    assert outcome.status == "complete"
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(1, 311))
    paused = rig.store.column("quality").astype(int) & Flag.PAUSED
    assert np.count_nonzero(paused) == 1
    states = [one for one in notices_of(watched) if isinstance(one, StateChanged)]
    assert [one.resting for one in states if one.state is RunState.PAUSED] == [True]
    assert not any(one.resting for one in states if one.state is RunState.RUNNING)
    rests = [one.text for one in rig.store.events if one.kind == REST]
    assert "at the beginning of a rest of 80 s" in rests[-2]
    assert "at the end of a rest of 80 s, in which it crept by" in rests[-1]
    reached_standstill = [one.time for one in rig.store.events if one.kind == REST][-2:]
    assert reached_standstill[1] > reached_standstill[0]


@pytest.mark.long
def test_a_pause_of_the_operator_in_a_rest_lasts_until_somebody_goes_on(rig: MemoryRig) -> None:
    rig.start(sequence(505, RunStep(revolutions=5, rest_s=1e6), RunStep(revolutions=500)))
    rig.engine.wait((RunState.PAUSED,), 60.0)
    end = rig.engine.status().test.expected_end_at
    assert end > 0.0
    notices = rig.engine.watch()
    rig.engine.pause("Ada")
    (told,) = [one for one in notices_of(notices) if isinstance(one, StateChanged)]
    assert (told.state, told.resting) == (RunState.PAUSED, False)
    assert "the rest has become a pause" in told.reason
    active = rig.engine._core.test
    assert active is not None
    assert active.resting is None
    assert rig.engine.status().test.expected_end_at < end
    with pytest.raises(Refused):
        rig.engine.pause("Ada")
    rig.engine.resume("Ada")
    rig.engine.wait(ENDED, 60.0)
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(1, 506))


def test_a_rest_says_how_long_it_lasts_still(rig: MemoryRig) -> None:
    # Long behind the rest: at this pace a busy computer sees a short test only when it has ended.
    steps = [RunStep(revolutions=2, rest_s=one) for one in (0.0, 0.0, 1e6)]
    rig.start(sequence(50_006, *steps, *(RunStep(revolutions=25_000) for _ in range(2))))
    rig.engine.wait((RunState.PAUSED,), 60.0)
    # By the computer's clock, which the measured pace of a simulated rig stretches and shortens.
    left = [rig.engine.status().test.rest_left_s]
    assert 0.0 < left[0] <= 1e6

    def goes_down() -> bool:  # from one look to the next, as a new pace may raise it once
        left.append(rig.engine.status().test.rest_left_s)
        return 0.0 < left[-1] < left[-2]

    eventually(goes_down)
    told = rig.engine.status()
    left = math.ceil(told.test.rest_left_s)
    line = f"Resting, {left} s left, step 3 of 5. The test resumes by itself."
    assert state_line(told, "F10") == line
    rig.engine.resume("Ada")
    rig.engine.wait((RunState.RUNNING,), 60.0)
    assert rig.engine.status().test.rest_left_s == 0.0
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.status().test.rest_left_s == 0.0


def test_an_operator_can_end_a_rest_and_end_the_test_in_one(rig: MemoryRig) -> None:
    test = sequence(100_000, RunStep(revolutions=5, rest_s=1e6))
    rig.start(test)
    rig.engine.wait((RunState.PAUSED,), 60.0)
    rig.engine.resume("Ada")
    eventually(lambda: len(rig.store.rows) >= 10)
    rig.engine.wait((RunState.PAUSED,), 60.0)
    rig.engine.stop("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "stopped"


def test_a_pause_across_the_end_of_a_step_goes_on_at_the_next_speed(rig: MemoryRig) -> None:
    rig.start(sequence(40, RunStep(revolutions=10, speed_rpm=60.0), RunStep(revolutions=30)))
    eventually(lambda: len(rig.store.rows) >= 9)
    rig.engine.pause("Ada")
    rig.engine.wait((RunState.PAUSED,), 60.0)
    rig.engine.resume("Ada")
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    quality = rig.store.column("quality").astype(int)
    assert rig.store.column("speed")[-1] == pytest.approx(120.0, rel=0.05)
    assert not quality[-1] & Flag.RAMP


def test_a_resumed_test_goes_on_in_its_step(rig: MemoryRig) -> None:
    rig.stores.append(FakeStore())
    rig.opened = Opened(rig.store, 15, 15, 10.0, 0.0)
    rig.start(
        sequence(30, RunStep(revolutions=10, speed_rpm=60.0), RunStep(revolutions=20)), resume=True
    )
    rig.engine.wait(ENDED, 60.0)
    assert speeds(rig)[0] == pytest.approx(120.0)
    np.testing.assert_array_equal(rig.store.column("revolution"), np.arange(16, 31))


def test_a_rule_of_a_step_is_judged_in_it_alone(rig: MemoryRig) -> None:
    rule = LimitRule("force_max", warning_above=40.0, steps=(2,))
    rig.start(
        sequence(
            100_000,
            RunStep(revolutions=10, speed_rpm=60.0),
            RunStep(revolutions=10),
            RunStep(revolutions=100_000),
            rules=(rule,),
        )
    )

    def raised() -> bool:
        return any("force_max" in one.key and one.active for one in rig.engine.status().alarms)

    eventually(raised)
    assert len(rig.store.rows) > 10
    limits = [one for one in rig.store.events if "force_max" in one.key]
    assert limits[0].revolution > 10
    eventually(lambda: not raised())
    assert len(rig.store.rows) > 20


def test_a_drive_that_does_not_reach_the_speed_of_a_step_ends_the_test() -> None:
    rig = MemoryRig(timing=replace(MemoryRig().timing, start_margin=1.0))
    rig.engine.connect()
    try:
        rig.start(
            sequence(100_000, RunStep(revolutions=20, speed_rpm=60.0), RunStep(revolutions=99_980))
        )
        eventually(lambda: len(rig.store.rows) >= 3)
        rig.crank.deaf = True  # the drive takes commands, and turns as before
        eventually(lambda: any(one.key == "start_failed" for one in rig.engine.status().alarms))
        rig.crank.deaf = False
        rig.engine.wait(ENDED, 60.0)
        assert rig.engine.outcome is not None
        assert "120" in rig.engine.outcome.sentence
    finally:
        rig.crank.deaf = False
        rig.engine.shutdown(20.0)
    assert rig.is_stationary


@pytest.mark.long
def test_rests_of_steps_that_are_over_while_the_crank_slows_down_are_one(rig: MemoryRig) -> None:
    watched = rig.engine.watch()
    outcome = run(rig, sequence(9, RunStep(revolutions=1, rest_s=PACE)))
    assert (outcome.status, outcome.revolutions) == ("complete", 9)
    states = [one for one in notices_of(watched) if isinstance(one, StateChanged)]
    paused = [one.resting for one in states if one.state is RunState.PAUSED]
    assert paused
    assert all(paused)


def test_a_sequence_of_many_changes_leaves_the_log_its_room(
    rig: MemoryRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(activetest, "STEPS_LOGGED", 4)
    slow, rests = RunStep(revolutions=2, speed_rpm=60.0), RunStep(revolutions=2, rest_s=1.0)
    outcome = run(rig, sequence(40, slow, rests))
    assert outcome.status == "complete"
    assert len([one for one in steps_told(rig) if one.after]) == 4
    assert max(one.revolution for one in rig.store.events if one.kind == REST) <= 12
    states = [one for one in rig.store.events if one.kind == "state"]
    assert states[-1].after == "stopping"
    assert len(states) < 30


def test_a_cable_that_is_pulled_in_a_rest_is_recovered_from_and_the_test_completed(
    rig: MemoryRig,
) -> None:
    test = sequence(20, RunStep(revolutions=5, rest_s=1e6), RunStep(revolutions=15, speed_rpm=60.0))
    rig.start(test)
    rig.engine.wait((RunState.PAUSED,), 60.0)
    rig.source.lost = True
    rig.engine.wait((RunState.FAULT,), 60.0)
    rig.source.lost = False
    rig.engine.connect()
    rig.engine.acknowledge(operator="Ada")
    eventually(lambda: not any(one.active for one in rig.engine.status().alarms))
    rig.engine.reset("Ada")
    store = rig.store
    last = int(store.column("revolution")[-1])
    assert 5 <= last < 20, "it slows down, and aims at the angle, as soon as the engine runs"
    rig.opened, store.closed = Opened(store, len(store.rows), last, 10.0, 0.0), False
    rig.start(test, resume=True)
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    np.testing.assert_array_equal(store.column("revolution"), np.arange(1, 21))
    assert store.column("speed")[-1] == pytest.approx(60.0, rel=0.05)
