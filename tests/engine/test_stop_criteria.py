"""What ends a test before its last revolution: each criterion alone, after a gap, and in a run."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace
from numpy.typing import NDArray

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_test
from rigapp.config.recipe import StopSection, TestFile
from rigapp.config.rules import described
from rigapp.engine.judging.criteria import (
    DEPTH_COLUMNS,
    HISTORY_COLUMNS,
    NO_DATA_REVOLUTIONS,
    StopMonitor,
)
from rigapp.engine.recording.store import Opened
from rigapp.schema.channels import BASE
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import FinishReason, Flag, Prediction, RunState
from rigapp.schema.states import ENDED
from tests.engine.engine_doubles import FakeStore, MemoryRig, a_test, eventually

RPM = 60.0
QUICK = Path(__file__).parents[2] / "examples" / "quick.toml"


def a_row(number: int, quality: int = 0, **values: float) -> NDArray[np.float64]:
    """Return a row one second after the one before; the pin lies 500 um from the middle."""
    row = np.zeros(len(BASE.names))
    given_values = {
        "revolution": number,
        "time": float(number),
        "speed": RPM,
        "quality": quality,
        "probe_1_mean": 500.0,
        **values,
    }
    for name, value in given_values.items():
        row[BASE.place[name]] = value
    return row


def feed(monitor: StopMonitor, rows: Any) -> tuple[int, Any]:
    """Return the number of the first row that met a criterion, and which."""
    for row in rows:
        met = monitor.row(row)
        if met is not None:
            return int(row[BASE.place["revolution"]]), met
    return 0, None


def test_hours_are_those_of_the_test_and_of_the_turning_crank() -> None:
    rows = [a_row(n, time=10.0 * n) for n in range(1, 500)]
    number, met = feed(StopMonitor(StopSection(elapsed_time_h=0.5)), rows)
    assert (number, met.name, met.planned) == (180, "elapsed_time_h", True)
    number, met = feed(StopMonitor(StopSection(running_time_h=0.1)), rows)
    assert (number, met.name, met.planned) == (360, "running_time_h", True)
    assert "0.1 h" in met.sentence


@given(
    forces=st.lists(st.sampled_from([100.0, 250.0, 300.0, math.nan]), max_size=40),
    needed=st.integers(1, 5),
)
def test_a_force_counts_in_a_row_and_nan_neither_counts_nor_interrupts(
    forces: list[float], needed: int
) -> None:
    stop = StopSection(force_N=250.0, force_revolutions=needed)
    rows = [a_row(n, force_max=force) for n, force in enumerate(forces, 1)]
    number, met = feed(StopMonitor(stop), rows)
    streak, expected = 0, 0
    for n, force in enumerate(forces, 1):
        if math.isnan(force):
            continue
        streak = streak + 1 if force >= 250.0 else 0
        if streak == needed:
            expected = n
            break
    assert number == expected
    assert met is None or not met.planned


@pytest.mark.parametrize("flag", [Flag.RAMP, Flag.PAUSED, Flag.PARTIAL])
def test_a_revolution_that_is_not_judged_ends_nothing(flag: Flag) -> None:
    stop = StopSection(force_N=100.0, force_revolutions=1)
    monitor = StopMonitor(stop)
    assert monitor.row(a_row(1, int(flag), force_max=300.0)) is None
    met = monitor.row(a_row(2, force_max=300.0))
    assert met is not None
    assert "300 N" in met.sentence


def test_the_hold_off_lets_a_joint_run_in() -> None:
    stop = StopSection(force_N=100.0, force_revolutions=2, hold_off_revolutions=30)
    number, _ = feed(StopMonitor(stop), (a_row(n, force_max=300.0) for n in range(1, 100)))
    assert number == 32


def an_answer(**given_values: float) -> dict[str, float]:
    """Return the twin's columns: what is given, else not known."""
    return dict.fromkeys((one.name for one in prediction_columns()), math.nan) | given_values


Step = tuple[NDArray[np.float64], dict[str, float]]


def worn(depth_um: Callable[[int], float], numbers: range) -> Iterator[Step]:
    """Yield rows and the twin's answers to them, the depth with the noise of the probes."""
    noise = np.random.default_rng(1).normal(0.0, 0.2, size=numbers.stop)
    for n in numbers:
        depth = 1e-3 * (depth_um(n) + noise[n]) if n >= 8 else math.nan
        doubt = 0.5e-3 if n >= 8 else math.nan
        yield a_row(n), an_answer(measured_wear_depth=depth, measured_wear_depth_uncertainty=doubt)


def answered(monitor: StopMonitor, steps: Iterable[Step]) -> tuple[int, Any]:
    """Return the number of the first revolution whose row or answer met a criterion, and which."""
    for row, answer in steps:
        number = int(row[BASE.place["revolution"]])
        met = monitor.row(row) or monitor.prediction(number, answer)
        if met is not None:
            return number, met
    return 0, None


def test_the_wear_depth_is_a_planned_end() -> None:
    stop = StopSection(wear_depth_um=50.0, wear_depth_revolutions=20)
    number, met = answered(StopMonitor(stop), worn(lambda n: 0.05 * n, range(1, 2000)))
    assert met.planned
    assert 1000 <= number <= 1060
    assert "50 um" in met.sentence
    assert met.sentence.endswith("in the last one, +/- 0.5 um (k = 2).")


def test_the_number_judged_is_the_one_of_the_file() -> None:
    monitor = StopMonitor(StopSection(wear_depth_um=50.0, wear_depth_revolutions=1))
    # The pin lies anywhere: only what the twin says of the depth counts.
    assert monitor.row(a_row(1, probe_1_mean=5000.0)) is None
    assert monitor.prediction(1, an_answer(measured_wear_depth=0.0499)) is None
    met = monitor.prediction(2, an_answer(measured_wear_depth=0.0501))
    assert met is not None
    assert "50.1 um" in met.sentence


def test_the_wear_rate_is_a_slope_over_the_window() -> None:
    def breaking(n: int) -> float:
        return 0.002 * n + 0.02 * max(0, n - 3000)

    stop = StopSection(wear_rate_um_per_1000_revolutions=15.0, wear_rate_window_revolutions=500)
    number, met = answered(StopMonitor(stop), worn(breaking, range(1, 6000)))
    assert not met.planned
    assert 3200 <= number <= 3500
    steady = StopMonitor(stop)
    assert answered(steady, worn(lambda n: 0.002 * n, range(1, 3000))) == (0, None)


@pytest.mark.sampled(every=4)
@pytest.mark.parametrize("cut", [1, 4, 7, 50, 1999, 2519, 3000])
@pytest.mark.parametrize("chunk", [3, 400, 100_000])
def test_a_resumed_test_knows_its_past(cut: int, chunk: int) -> None:
    stop = StopSection(
        running_time_h=0.7,
        wear_depth_um=100.0,
        wear_depth_revolutions=1,
        wear_rate_um_per_1000_revolutions=60.0,
        wear_rate_window_revolutions=400,
    )
    steps = list(worn(lambda n: 0.02 * n, range(1, 3002)))
    past, rest = steps[:cut], steps[cut:]
    places = [BASE.place[name] for name in HISTORY_COLUMNS]
    columns = np.array([row for row, _ in past]).T[places]
    depths = np.array([(n, answer[DEPTH_COLUMNS[1]]) for n, (_, answer) in enumerate(past, 1)]).T
    resumed = StopMonitor(stop)
    resumed.remember(
        (columns[:, n : n + chunk] for n in range(0, cut, chunk)),
        cut,
        depths,
    )
    assert resumed.running_h == pytest.approx(cut / 3600.0)
    number, met = answered(resumed, rest)
    assert number == max(cut + 1, 2520)
    assert met.name == "running_time_h"


def deviating(residual_N: float, force_N: float) -> dict[str, float]:
    return an_answer(residual_rms=residual_N, force_rms=force_N)


def test_the_deviation_is_judged_where_the_twin_answers() -> None:
    monitor = StopMonitor(StopSection(deviation_N=10.0, deviation_revolutions=2))
    for n in (1, 2, 3):
        monitor.row(a_row(n, int(Flag.RAMP) if n == 1 else 0))
    assert monitor.prediction(1, deviating(50.0, 100.0)) is None  # in the ramp
    assert monitor.prediction(2, deviating(50.0, 100.0)) is None
    assert monitor.prediction(2, deviating(math.nan, 100.0)) is None
    met = monitor.prediction(3, deviating(12.0, 100.0))
    assert met is not None
    assert not met.planned
    share = StopMonitor(StopSection(deviation_percent=10.0, deviation_revolutions=1))
    share.row(a_row(1))
    assert share.prediction(1, deviating(12.0, 0.0)) is None
    found = share.prediction(1, deviating(12.0, 100.0))
    assert found is not None
    assert "12 %" in found.sentence


def test_a_criterion_that_sees_nothing_is_named() -> None:
    monitor = StopMonitor(StopSection(wear_depth_um=50.0, force_N=300.0))
    for n in range(1, NO_DATA_REVOLUTIONS + 1):
        monitor.row(a_row(n))
        monitor.prediction(n, an_answer())
    assert monitor.no_data() == ["wear_depth_um"]
    monitor.row(a_row(NO_DATA_REVOLUTIONS + 1))
    monitor.prediction(NO_DATA_REVOLUTIONS + 1, an_answer(measured_wear_depth=0.001))
    assert monitor.no_data() == []


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("elapsed_time_s = 5.0", "did you mean elapsed_time_h"),
        ("elapsed_time_h = -1.0", "stop.elapsed_time_h"),
        ("force_N = 400.0", "can never be met"),
        ("force_revolutions = 0", "stop.force_revolutions"),
        ("wear_depth_um = inf", "not a finite number"),
        ('wear_depth_um = "deep"', "expected a number"),
        ("deviation_N = 5.0\n[prediction]\nenabled = false", "prediction.enabled is false"),
        ("wear_depth_um = 5.0\n[prediction]\nenabled = false", "needs the model's"),
    ],
)
def test_a_bad_key_is_one_sentence(line: str, words: str) -> None:
    text = QUICK.read_text(encoding="utf-8")
    if "[prediction]" in line:
        text = text.replace('[prediction]\njoint = "continuous"', "")
    text = text.replace("[model] ", f"[stop]\n{line}\n[model] ")
    with pytest.raises(UnusableInput, match=words) as caught:
        parse_test(text, "t.toml")
    assert str(caught.value).count("\n") == 0


def test_a_file_without_the_section_has_no_criteria() -> None:
    test = parse_test(QUICK.read_text(encoding="utf-8"), "t.toml")
    assert described(test.stop) == []
    assert not StopMonitor(test.stop).any
    some = StopSection(running_time_h=2.0, wear_rate_um_per_1000_revolutions=3.0, force_N=9.0)
    assert described(some) == [
        "running time 2 h",
        "force 9 N",
        "wear rate 3 um per 1000 revolutions",
    ]


# --- in a run ------------------------------------------------------------------------------------


@pytest.fixture
def rig() -> Iterator[MemoryRig]:
    made = MemoryRig()
    made.engine.connect()
    yield made
    made.engine.shutdown(10.0)


def with_stop(**keys: Any) -> TestFile:
    return replace(a_test(100_000), stop=StopSection(**keys))


def test_a_planned_end_is_a_complete_test(rig: MemoryRig) -> None:
    rig.start(with_stop(running_time_h=10.0 / 60.0 / 120.0))
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert (outcome.reason, outcome.status) == (FinishReason.COMPLETE, "complete")
    assert "turned for" in outcome.sentence
    assert "of at most 100000" in outcome.sentence
    assert rig.engine.state is RunState.STOPPED
    assert rig.engine.status().alarms == ()
    assert rig.is_stationary


def test_a_limit_of_the_joint_stops_the_test_with_an_alarm(rig: MemoryRig) -> None:
    rig.start(with_stop(force_N=40.0, force_revolutions=3))
    rig.engine.wait(ENDED, 60.0)
    outcome = rig.engine.outcome
    assert outcome is not None
    assert (outcome.reason, outcome.status) == (FinishReason.LIMIT, "stopped")
    assert "40 N in 3 revolutions" in outcome.sentence
    (alarm,) = rig.engine.status().alarms
    assert alarm.key == "stop:force_N"
    assert alarm.first_out
    assert all((alarm.cause, alarm.consequence, alarm.action))


def test_the_twin_ends_the_test_by_its_deviation(rig: MemoryRig) -> None:
    rig.start(with_stop(deviation_N=5.0, deviation_revolutions=1))
    eventually(lambda: rig.engine.state is RunState.RUNNING and len(rig.store.rows) > 8, 60.0)
    number = len(rig.store.rows)
    values = np.array([*an_answer(revolution=number, residual_rms=7.5, force_rms=50.0).values()])
    rig.engine.submit_prediction(Prediction(number, values.tobytes(), b"", b"", b""))
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert "7.5 N" in rig.engine.outcome.sentence


def test_time_counts_over_an_interruption(rig: MemoryRig) -> None:
    past = np.array([np.arange(1, 8), np.full(7, 120.0), np.zeros(7)])

    def opened() -> Opened:
        rig.stores.append(FakeStore())
        return Opened(rig.store, 7, 7, 3.5, history=lambda: iter([past]))

    rig.opened = opened()
    rig.start(with_stop(running_time_h=10.0 / 60.0 / 120.0), resume=True)
    rig.engine.wait(ENDED, 60.0)
    numbers = rig.store.column("revolution")
    assert numbers[0] == 8
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    rig.opened = opened()
    with pytest.raises(UnusableInput, match="no revolution is left to do"):
        rig.start(with_stop(running_time_h=6.5 / 60.0 / 120.0), resume=True)
