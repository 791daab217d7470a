"""Which whole cycles are kept around a trigger: in order, none twice, within their room."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp.config.recipe import CyclesSection
from rigapp.engine.recording.history import (
    TRIGGERED,
    History,
    RetainedCycle,
    RetentionReason,
    Schedule,
    triggered_cycles,
)
from rigapp.engine.samples.assembler import EncoderSetup, Revolution
from rigapp.engine.values.calibrate import Measured
from rigapp.schema.messages import Flag
from tests.engine.calibrations import calibration_by_hand

KIND = calibration_by_hand(
    encoder=EncoderSetup(8), sample_rate_Hz=960.0, matrix=np.eye(2), sensitivity=np.ones(2)
)


def revolution(number: int, samples: int = 8) -> Measured:
    """Return a revolution whose samples carry its number."""
    buffer = np.full((5, 4 * samples), number, np.float32)
    cut = Revolution(
        ordinal=number,
        values=buffer[:, :samples],
        before=0,
        counts=np.arange(samples, dtype=np.int64),
        end_count=samples,
        segments=np.array([[0, 0]], np.int64),
        first_sample=number * samples,
        end_sample=(number + 1) * samples,
        sample_rate_Hz=960.0,
        host_time_ns=0,
        later_samples=0,
        lost_samples=0,
        idle_samples=0,
        flags=Flag.GOOD,
    )
    return Measured(cut, KIND)


def run(
    section: CyclesSection, revolutions: int, triggers: dict[int, bool], last: int | None = None
) -> tuple[list[RetainedCycle], History]:
    """Feed revolutions 1 .. last; ``triggers``: revolution before which one comes -> critical."""
    history = History(section, revolutions)
    written: list[RetainedCycle] = []
    for number in range(1, (last or revolutions) + 1):
        if number in triggers:
            history.trigger(triggers[number])
        written += history.add(number, revolution(number))
        if written:
            assert written[-1].number <= history.decided
    if (last or revolutions) + 1 in triggers:
        history.trigger(triggers[(last or revolutions) + 1])
    return written + history.close(), history


def words(kept: list[RetainedCycle]) -> dict[int, RetentionReason | None]:
    return {one.number: one.why for one in kept}


def test_a_trigger_keeps_what_was_before_and_comes_after() -> None:
    section = CyclesSection("every", every_revolutions=10, before_alarm=3, after_alarm=2)
    kept, _ = run(section, 40, {22: False})
    assert words(kept) == {
        10: RetentionReason.SCHEDULED,
        19: RetentionReason.BEFORE,
        20: RetentionReason.SCHEDULED,
        21: RetentionReason.BEFORE,
        22: RetentionReason.TRIGGER,
        23: RetentionReason.AFTER,
        24: RetentionReason.AFTER,
        30: RetentionReason.SCHEDULED,
        40: RetentionReason.SCHEDULED,
    }
    for one in kept:
        assert np.all(one.measured.revolution.values == one.number)


def test_triggers_close_together_make_one_burst() -> None:
    section = CyclesSection("none", before_alarm=2, after_alarm=3)
    kept, _ = run(section, 30, {10: False, 12: False})
    assert words(kept) == {
        8: RetentionReason.BEFORE,
        9: RetentionReason.BEFORE,
        10: RetentionReason.TRIGGER,
        11: RetentionReason.AFTER,
        12: RetentionReason.TRIGGER,
        13: RetentionReason.AFTER,
        14: RetentionReason.AFTER,
        15: RetentionReason.AFTER,
    }


def test_a_trigger_whose_revolution_never_ends_keeps_what_was_before() -> None:
    section = CyclesSection("none", before_alarm=4, after_alarm=4)
    kept, _ = run(section, 50, {21: True}, last=20)
    assert words(kept) == dict.fromkeys(range(17, 21), RetentionReason.BEFORE)


def test_after_a_trigger_nothing_waits() -> None:
    history = History(CyclesSection("none", before_alarm=5, after_alarm=2), 100)
    for number in range(1, 10):
        assert history.add(number, revolution(number)) == []
    history.trigger()
    assert [one.number for one in history.add(10, revolution(10))] == [5, 6, 7, 8, 9, 10]
    assert [one.number for one in history.add(11, revolution(11))] == [11]


def test_zero_and_zero_keep_nothing() -> None:
    section = CyclesSection("none", before_alarm=0, after_alarm=0)
    kept, history = run(section, 20, {10: True})
    assert kept == []
    assert history.refused == 0
    assert triggered_cycles(section, 1000) == 0


def test_the_last_room_is_for_critical_alarms() -> None:
    section = CyclesSection("none", before_alarm=1, after_alarm=1)
    room = triggered_cycles(section, 2000)
    assert room == 30
    warnings = dict.fromkeys(range(10, 1500, 10), False)
    kept, history = run(section, 2000, {**warnings, 1800: True, 1850: True})
    triggers = [one.number for one in kept if one.why is RetentionReason.TRIGGER]
    assert triggers[-2:] == [1800, 1850]
    assert history.refused > 0
    assert len(kept) <= room


def test_memory_is_bounded() -> None:
    one = revolution(1, 1000).revolution
    size = one.values.nbytes + one.counts.nbytes + one.segments.nbytes
    section = CyclesSection("none", before_alarm=100, after_alarm=0)
    history = History(section, 10_000, limit_bytes=5 * size)
    most = 0
    for number in range(1, 300):
        assert history.add(number, revolution(number, 1000)) == []
        most = max(most, history.bytes)
    assert most <= 5 * size
    assert history.shortened > 0
    history.trigger()
    kept = history.add(300, revolution(300, 1000))
    assert [one.number for one in kept] == list(range(295, 301))
    assert all(one.measured.revolution.values.base is None for one in kept[:-1])


def test_an_early_end_keeps_the_last_cycle() -> None:
    section = CyclesSection("every", every_revolutions=10)
    for before in (0, 5):
        kept, _ = run(CyclesSection("every", 10, before_alarm=before), 100, {}, last=33)
        assert words(kept) == {
            **dict.fromkeys((10, 20, 30), RetentionReason.SCHEDULED),
            33: RetentionReason.LAST,
        }
    kept, _ = run(section, 100, {}, last=30)
    assert words(kept) == dict.fromkeys((10, 20, 30), RetentionReason.SCHEDULED)


@settings(max_examples=150, deadline=None)
@given(
    before=st.integers(0, 6),
    after=st.integers(0, 6),
    every=st.integers(1, 12),
    schedule=st.sampled_from(["every", "logarithmic", "none"]),
    triggers=st.dictionaries(st.integers(1, 130), st.booleans(), max_size=25),
    last=st.integers(1, 120),
)
def test_any_triggers(
    before: int, after: int, every: int, schedule: str, triggers: dict[int, bool], last: int
) -> None:
    section = CyclesSection(schedule, every, 5, before, after)  # type: ignore[arg-type]
    kept, history = run(section, 120, triggers, last)
    numbers = [one.number for one in kept]
    assert numbers == sorted(set(numbers))
    found = words(kept)
    scheduled = Schedule(section, 120)
    for number in range(1, last + 1):
        if scheduled.keeps(number):
            assert number in found
    around = sum(why in TRIGGERED and not scheduled.keeps(n) for n, why in found.items())
    assert around <= triggered_cycles(section, 120)
    if history.refused == 0 and before + after > 0:
        for trigger in triggers:
            for number in range(max(1, trigger - before), min(last, trigger + after) + 1):
                if trigger <= last + 1:
                    assert number in found, (trigger, number)


@pytest.mark.parametrize("revolutions", [1, 50, 500, 21_377, 10_000_000])
def test_room_is_never_more_than_the_test(revolutions: int) -> None:
    section = CyclesSection()
    assert triggered_cycles(section, revolutions) <= min(revolutions, 100 * 11)
