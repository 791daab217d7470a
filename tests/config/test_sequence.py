"""The steps of a test: every revolution belongs to one, whatever is repeated."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.recipe import MOST_STEPS, RunSection, RunStep
from rigapp.config.sequence import Sequence, revolutions_of

QUICK = (Path(__file__).parents[2] / "examples" / "quick.toml").read_text("utf-8")

STEPS = """
[[run.step]]
name = "running in"
revolutions = 100
speed_rpm = 30.0
[[run.step]]
duration_s = 60.0
rest_s = 10.0
[[run.step]]
revolutions = 20
speed_rpm = 80.0
acceleration_rpm_per_s = 10.0
"""


def with_steps(text: str = STEPS, **run: float) -> str:
    """Return the quick test at 60 rpm with other steps and keys of its run."""
    keys = "".join(f"{name} = {value}\n" for name, value in run.items())
    head, found, rest = QUICK.partition("[metadata]")
    assert found
    return f"{head}{keys}{text}\n[metadata]{rest}"


steps = st.builds(
    RunStep,
    revolutions=st.integers(1, 7),
    speed_rpm=st.one_of(st.none(), st.sampled_from([30.0, 60.0, 120.0])),
    rest_s=st.sampled_from([0.0, 5.0]),
)


@given(st.lists(steps, min_size=1, max_size=5), st.integers(1, 5), st.integers(1, 60))
def test_every_revolution_has_its_step_and_its_time(
    made: list[RunStep], again: int, last: int
) -> None:
    again = min(again, len(made))
    run = RunSection(last, 60.0, repeat_from_step=again, step=tuple(made))
    sequence = Sequence(run)
    order = [
        number for number, one in enumerate(made, start=1) for _ in range(revolutions_of(one, run))
    ]
    block = [number for number in order if number >= again]
    while len(order) < last:
        order += block
    assert [sequence.at(number).step for number in range(1, last + 1)] == order[:last]
    seconds = 0.0
    for number in range(1, last + 1):
        stage = sequence.at(number)
        assert stage.first <= number <= stage.last
        seconds += 60.0 / stage.speed_rpm
        if number == stage.last and number < last:
            seconds += stage.rest_s
            assert sequence.at(number + 1).first == number + 1
    assert sequence.seconds(1, last) == pytest.approx(seconds)
    middle = (last + 1) // 2
    between = made[sequence.at(middle).step - 1].rest_s
    rest = between if sequence.at(middle).last == middle and middle < last else 0.0
    parts = sequence.seconds(1, middle) + rest + sequence.seconds(middle + 1, last)
    assert parts == pytest.approx(seconds)


def test_a_test_of_a_hundred_million_revolutions_is_timed_at_once() -> None:
    made = (RunStep(revolutions=1, rest_s=1.0), RunStep(revolutions=2, speed_rpm=120.0))
    sequence = Sequence(RunSection(100_000_000, 60.0, step=made))
    assert sequence.seconds(1, 99_999_999) == pytest.approx(33_333_333 * 3.0)


def test_steps_are_read_with_the_speed_of_the_run_where_they_name_none() -> None:
    test = parse_test(with_steps(), "test.toml")
    sequence = Sequence(test.run)
    assert (sequence.count, sequence.length) == (3, 180)
    assert [sequence.at(one).step for one in (1, 100, 101, 160, 161, 180, 181)] == [
        1, 1, 2, 2, 3, 3, 1,
    ]  # fmt: skip
    assert sequence.at(101).speed_rpm == 60.0
    assert sequence.at(161).acceleration_rpm_per_s == 10.0
    assert (sequence.slowest_rpm, sequence.fastest_rpm) == (30.0, 80.0)
    assert sequence.fastest_key == "run.step 3 speed_rpm"
    assert sequence.at(100).words == "step 1 (running in)"
    assert msgspec.structs.asdict(test.run)["repeat_from_step"] == 1


def test_a_test_without_steps_is_one() -> None:
    sequence = Sequence(RunSection(50, 60.0))
    stage = sequence.at(50)
    assert (sequence.count, stage.step, stage.first, stage.last) == (0, 0, 1, 50)
    assert sequence.at(60).speed_rpm == 60.0, "of a test that was extended"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            with_steps("[[run.step]]\nspeed_rpm = 30.0"),
            "run.step 1: give revolutions or duration_s",
        ),
        (with_steps("[[run.step]]\nrevolutions = 1\nduration_s = 2.0"), "one of the two"),
        (with_steps(repeat_from_step=4), "run.repeat_from_step = 4, but there are 3 entries"),
        (with_steps("", repeat_from_step=2), "there are 0 entries of run.step"),
        (with_steps("[[run.step]]\nrevolutions = 0"), "run.step"),
        (with_steps("[[run.step]]\nrevolutions = 5\nspeed_rpm = 800.0"), "limits.overspeed_rpm"),
        (with_steps("[[run.step]]\nrevolution = 5"), "revolution is not a known key"),
        (
            with_steps("[[run.step]]\nrevolutions = 1\n" * (MOST_STEPS + 1)),
            f"{MOST_STEPS} are possible",
        ),
        (
            with_steps()
            + '\n[[limits.rule]]\nquantity = "force_max"\nwarning_above = 90.0\nsteps = [4]\n',
            "steps names step 4",
        ),
    ],
)
def test_steps_that_do_not_fit_are_refused_by_name(text: str, said: str) -> None:
    with pytest.raises(UnusableInput) as refused:
        parse_test(text, "test.toml")
    assert said in str(refused.value)
