"""States, figures and results as window, page, report and command line show them."""

from __future__ import annotations

import math

import msgspec
import pytest

from rigapp.config.ranges import refusal
from rigapp.presentation.numbers import (
    bytes_text,
    coefficient_number,
    coefficient_text,
    with_uncertainty,
)
from rigapp.presentation.results import file_line, key_numbers, outcome_text, trust_lines
from rigapp.presentation.states import state_line, state_word
from rigapp.presentation.translation import translate
from rigapp.schema.messages import (
    Alarm,
    FinishReason,
    HowEnded,
    Recovery,
    Remedy,
    RunState,
    Severity,
    Status,
)
from rigapp.schema.results import TestResult, how_ended


def test_a_rest_is_no_pause() -> None:
    paused = Status.of_flat(
        {
            "state": RunState.PAUSED,
            "recovery": Recovery(
                Remedy.RESUME, "resume", "Resume the paused test.", (Remedy.RESUME,)
            ),
        }
    )
    assert state_line(paused, "F10") == "Resume the paused test. (F10)"
    resting = Status.of_flat(
        paused.flat() | {"resting": True, "rest_left_s": 11.2, "step": 3, "steps": 5}
    )
    line = "Resting, 12 s left, step 3 of 5. The test resumes by itself."
    assert state_line(resting, "F10") == line


def test_a_test_with_an_alarm_does_not_run_as_planned() -> None:
    warning = Alarm(
        "rule:force_rms:warning:above", Severity.WARNING, "RMS of |F| above limit",
        "RMS of |F| is 12, above the warning limit 10.", "", "", 1.0, 7,
    )  # fmt: skip
    line = "Running. RMS of |F| above limit: RMS of |F| is 12, above the warning limit 10."
    for changed in ({}, {"acknowledged": True, "state": "acknowledged"}):
        alarm = msgspec.structs.replace(warning, **changed)
        assert state_line(Status.of_flat({"state": RunState.RUNNING, "alarms": (alarm,)})) == line
    first = msgspec.structs.replace(warning, key="b", title="Overspeed", raised_at=2.0)
    known = msgspec.structs.replace(warning, acknowledged=True, state="acknowledged")
    assert "Overspeed" in state_line(
        Status.of_flat({"state": RunState.RUNNING, "alarms": (known, first)})
    )
    for over in ("normal", "shelved"):
        alarm = msgspec.structs.replace(warning, state=over)
        status = Status.of_flat({"state": RunState.RUNNING, "alarms": (alarm,)})
        assert state_line(status) == "Running as planned."


@pytest.mark.parametrize(
    ("status", "reason", "word"),
    [
        ("complete", FinishReason.COMPLETE, "Complete"),
        ("stopped", FinishReason.OPERATOR, "Stopped"),
        ("stopped", FinishReason.LIMIT, "Tripped"),
        ("stopped", FinishReason.DEVICE, "Fault"),
    ],
)
def test_strip_and_card_say_the_same_of_an_end(
    status: str, reason: FinishReason, word: str
) -> None:
    result = TestResult("t.h5", status=status, reason_code=reason.value)
    state = RunState.FAULT if word == "Fault" else RunState.STOPPED
    shown = Status.of_flat({"state": state, "outcome": how_ended(status, reason)})
    assert state_word(shown) == outcome_text(result) == word


def test_a_wear_coefficient_has_one_power_of_ten() -> None:
    assert coefficient_text(5.05e-4, 4.8e-4, 5.31e-4) == (
        "505 · 10⁻⁶ mm³/(N m)",
        "480 to 531 (95 %)",
    )
    assert coefficient_number(8.314e-6) == "8.31"
    assert coefficient_number(math.nan) == "–"


def test_a_value_has_the_decimals_of_its_uncertainty() -> None:
    assert with_uncertainty(14.72, 1.58, "µm") == "14.7 ± 1.6 µm"
    assert with_uncertainty(3.414, 0.0996, "µm") == "3.41 ± 0.10 µm"
    assert with_uncertainty(86.8, 12.3, "N") == "87 ± 12 N"
    assert with_uncertainty(86.84, math.nan, "N") == "86.8 N"
    assert with_uncertainty(math.nan, 1.0, "N") == "–"


def test_a_size_is_said_in_one_way() -> None:
    assert [bytes_text(one) for one in (12_300, 730_000, 152e6)] == ["12.3 kB", "0.73 MB", "152 MB"]


def test_a_result_says_what_to_bear_in_mind() -> None:
    result = TestResult(
        "t.h5",
        status="complete",
        revolutions=500,
        depth_um=14.7,
        depth_uncertainty_um=1.6,
        model_depth_um=18.7,
        alarms=("Input saturated: probe_1", "Input saturated: probe_1"),
        coefficient_reason="the probes have no calibration record",
    )
    assert result.outcome is HowEnded.COMPLETE
    lines = [one for one in trust_lines(result) if not one.good]
    assert [(one.text, one.line) for one in lines] == [
        ("2 alarms in the test", "Input saturated: probe_1"),
        ("Wear differs from the model", "14.7 ± 1.6 µm, model 18.7 µm"),
    ]
    depth, coefficient, *_ = key_numbers(result)
    assert depth.line == "by the probes, k = 2; model 18.7 µm"
    assert coefficient.line == "The probes have no calibration record"


def test_operators_see_no_error_numbers_powers_and_epoch_dates() -> None:
    told = "could not open port /dev/ttyUSB0: [Errno 2] No such file or directory"
    assert translate(told) == "could not open port /dev/ttyUSB0: No such file or directory"
    assert "run.revolutions = 5000000000 is" in refusal("run.revolutions", 5_000_000_000)
    assert file_line(TestResult("gone.h5")) == ""
    assert "1970" not in file_line(TestResult("broken.h5", 1.8e9, 100))
