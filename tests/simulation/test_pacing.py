"""The rule of the plant's time: never slower than real time, never faster than it is taken."""

from __future__ import annotations

import math

import pytest

from rigapp.process.processclock import DEVICE_SHARE, LONGEST_PASS_S, ProcessClock
from rigapp.simulation.rig import LONGEST_CATCH_UP_S, PlantPace


def run(pace: PlantPace, wall_s: float, *, taken: bool, chunk_s: float = 0.01) -> float:
    """Return the plant time of ``wall_s`` seconds in passes of 5 ms, at most 100 chunks each."""
    plant = 0.0
    start = pace._last
    for step in range(1, round(wall_s / 0.005) + 1):
        pace.tick(start + step * 0.005)
        for _ in range(100):
            if not pace.due(chunk_s, taken=taken):
                break
            pace.advanced(chunk_s)
            plant += chunk_s
    return plant


@pytest.mark.parametrize(
    ("speed", "taken", "expected"),
    [
        (1.0, True, 10.0),
        (1.0, False, 10.0),
        (20.0, True, 200.0),
        (20.0, False, 10.0),
        (math.inf, False, 10.0),
        (0.5, True, 5.0),
    ],
)
def test_plant_time_in_ten_seconds(speed: float, taken: bool, expected: float) -> None:
    assert run(PlantPace(speed, 100.0), 10.0, taken=taken) == pytest.approx(expected, rel=0.01)


def test_as_fast_as_taken_is_bounded_by_the_work_only() -> None:
    assert run(PlantPace(math.inf, 0.0), 1.0, taken=True) == pytest.approx(200 * 100 * 0.01)


def test_a_stall_of_the_host_gives_no_credit_beyond_real_time() -> None:
    pace = PlantPace(20.0, 0.0)
    run(pace, 5.0, taken=False)
    # Afterwards the plant runs at 20 times, plus one burst of a tenth of a second.
    assert run(pace, 1.0, taken=True) == pytest.approx(20.0, abs=2.1)


def test_a_suspended_process_catches_up_one_second_only() -> None:
    pace = PlantPace(1.0, 0.0)
    pace.tick(60.0)
    plant = 0.0
    while pace.due(0.01, taken=False):
        pace.advanced(0.01)
        plant += 0.01
    assert plant == pytest.approx(LONGEST_CATCH_UP_S, abs=0.011)


def test_running_ahead_does_not_pay_for_standing_later() -> None:
    pace = PlantPace(math.inf, 0.0)
    run(pace, 1.0, taken=True)
    assert run(pace, 2.0, taken=False) == pytest.approx(2.0, rel=0.02)


def test_wait_is_until_the_next_chunk() -> None:
    pace = PlantPace(1.0, 0.0)
    pace.tick(0.004)
    assert pace.wait_s(0.01, may_be_taken=True) == pytest.approx(0.006)
    fast = PlantPace(math.inf, 0.0)
    fast.tick(0.0)
    assert fast.wait_s(0.01, may_be_taken=True) == 0.0
    assert fast.wait_s(0.01, may_be_taken=False) == pytest.approx(0.01)


def test_own_time_is_the_wall_clock_where_nothing_else_runs() -> None:
    own, wall, ran = ProcessClock(100.0, 3.0), 100.0, 3.0
    for _ in range(1000):
        wall, ran = wall + 0.0106, ran + 0.0005  # woken 0.1 ms late
        assert own.tick(wall, ran, 0.010) == pytest.approx(wall)


def test_own_time_leaves_out_what_the_process_stood_in_line() -> None:
    own = ProcessClock(0.0, 0.0)
    assert own.tick(1.0, 0.002, 0.010) == pytest.approx(0.013)
    before = own.time_s
    # A computer that stood still may book the time on whoever ran.
    assert own.tick(3.0, 2.0, 0.0) == pytest.approx(before + LONGEST_PASS_S)
    assert own.tick(2.9, 2.0, 0.0) == pytest.approx(before + LONGEST_PASS_S), "never back"
    busy = ProcessClock(0.0, 0.0)
    for step in range(1, 501):  # a fifth of a processor
        busy.tick(step * 0.02, step * 0.004, 0.0)
    assert busy.time_s == pytest.approx(2.5)


def test_the_watchdog_of_a_simulated_device_fires_on_a_busy_computer_too() -> None:
    busy = ProcessClock(0.0, 0.0, DEVICE_SHARE)
    for step in range(1, 501):  # a fifth of a processor
        busy.tick(step * 0.02, step * 0.004, 0.0)
    assert busy.time_s == pytest.approx(DEVICE_SHARE * 10.0)
    before = busy.time_s
    assert busy.tick(12.0, 2.0, 0.0) == pytest.approx(before + LONGEST_PASS_S), "it stood still"
