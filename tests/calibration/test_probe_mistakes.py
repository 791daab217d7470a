"""Micrometer steps taken by a simulated technician: each mistake is called by its own name."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rigapp_calibration.probes.calibrate import align, calibrate_pair, calibrate_probe
from rigapp_calibration.probes.plans import MEASURING, ProbePlan, probe_readings
from rigapp_calibration.probes.readings import ProbeReadings, ProbeSettings
from rigapp_calibration.taking.procedure import (
    Procedure,
    ProcedureError,
    Step,
    StepKind,
    begin,
    take_up,
)

SETTINGS = ProbeSettings("probe", 10.0, 0.5e-6, nominal=100e-6)
SENSITIVITY = (101e-6, 98.5e-6)
OFFSET = (0.12, -0.31)
ANGLE = (math.radians(1.5), math.radians(-0.8))
Technician = Callable[[Step, int], tuple[float, float]]


def honest(step: Step, at: int) -> tuple[float, float]:
    """Return where the target really stands along e2 and n2."""
    return (step.value, 0.0) if step.set_up == 1 else (0.0, step.value)


def voltages(true: tuple[float, float], rng: np.random.Generator) -> tuple[float, float]:
    x, y = true
    one = math.cos(ANGLE[0]) * x + math.sin(ANGLE[0]) * y
    two = -math.sin(ANGLE[1]) * x + math.cos(ANGLE[1]) * y
    noise = rng.normal(0.0, 0.3e-3, 2)
    return (
        one / SENSITIVITY[0] + OFFSET[0] + noise[0],
        two / SENSITIVITY[1] + OFFSET[1] + noise[1],
    )


def calibration(
    technician: Technician, probes: tuple[int, ...] = (1,), runs: int = 3, positions: int = 11
) -> Procedure[ProbePlan]:
    rng = np.random.default_rng(11)
    procedure = begin(MEASURING, ProbePlan(probes, 800e-6, positions, runs))
    while not procedure.done:
        step = procedure.step
        if step.kind is StepKind.SET_UP:
            procedure = procedure.set_up()
            continue
        signal = voltages(technician(step, procedure.position), rng)
        procedure = procedure.record(signal, 0.0, float(procedure.position))
    return procedure


def codes(readings: ProbeReadings, settings: ProbeSettings = SETTINGS) -> list[str]:
    found = calibrate_probe(readings, settings)
    blocking = [one.code for one in found.problems if one.blocks]
    assert found.accepted == (not blocking)
    return blocking


def test_honest_steps_find_sensitivity_offset_and_how_the_pair_stands() -> None:
    procedure = calibration(honest, (1, 2))
    pair = calibrate_pair(
        (probe_readings(procedure, 1), probe_readings(procedure, 2)),
        (replace(SETTINGS, direction=math.radians(0.1)),) * 2,
    )
    assert pair.accepted, pair.problems
    for found, sensitivity, offset, angle in zip(
        pair.probes, SENSITIVITY, OFFSET, ANGLE, strict=True
    ):
        assert found.sensitivity == pytest.approx(sensitivity / math.cos(angle), rel=1e-4)
        assert found.offset == pytest.approx(offset, abs=3e-4)
        assert found.expanded is not None
        assert 0.97e-6 < found.expanded < 1.05e-6
    alignment = pair.alignment
    assert alignment is not None
    assert alignment.angle == pytest.approx(ANGLE, abs=math.radians(0.02))
    assert math.degrees(alignment.orthogonality) == pytest.approx(-2.3, abs=0.03)
    # The matrix gives the true position of the pin back.
    x, y = 40e-6, -700e-6
    rest = np.random.default_rng(1)
    one, two = voltages((x, y), rest)
    told = alignment.matrix @ [
        pair.probes[0].sensitivity * (one - pair.probes[0].offset),
        pair.probes[1].sensitivity * (two - pair.probes[1].offset),
    ]
    assert told == pytest.approx([x, y], abs=0.5e-6)


def test_uncertainty_of_the_alignment_covers_the_truth() -> None:
    """Of 200 calibrations with a stage that is crooked by chance, about 95 % hold the truth."""
    rng = np.random.default_rng(3)
    direction, inside = math.radians(0.2), 0
    position = np.tile(np.linspace(-800e-6, 800e-6, 11), 2)
    for _ in range(200):
        tilt = rng.normal(0.0, direction, 2)
        pairs = []
        for own in (0, 1):
            true = np.zeros((2, len(position)))
            true[own] = position * math.cos(tilt[own])
            true[1 - own] = position * math.sin(tilt[own]) * (1.0 if own == 0 else -1.0)
            both = np.array([voltages((x, y), rng) for x, y in true.T]).T
            pairs.append(
                ProbeReadings(("1",) * 22, np.arange(22), position, both[own], both[1 - own])
            )
        found = align((pairs[0], pairs[1]), (direction, direction))
        # Probe 2 is seen by the motion along e2 and the reverse, so the tilts enter crosswise.
        inside += int(
            np.sum(np.abs(found.angle - np.array(ANGLE)) < 1.96 * found.angle_uncertainty)
        )
    assert 0.91 * 400 < inside < 0.985 * 400


def wrong_once(step: Step, at: int) -> tuple[float, float]:
    return (step.value + (40e-6 if at == 8 else 0.0), 0.0)


def skipped(step: Step, at: int) -> tuple[float, float]:
    late = step.series == "1.2" and step.number >= 5
    return (step.value + (160e-6 if late and not step.falling else 0.0), 0.0)


def not_turned(step: Step, at: int) -> tuple[float, float]:
    late = step.series == "1.2" and step.number >= 5
    return (step.value - (160e-6 if late and not step.falling else 0.0), 0.0)


def other_way(step: Step, at: int) -> tuple[float, float]:
    return (-step.value, 0.0)


def from_the_wrong_side(step: Step, at: int) -> tuple[float, float]:
    return (step.value + (15e-6 if step.falling else 0.0), 0.0)


def other_probe(step: Step, at: int) -> tuple[float, float]:
    return (0.0, step.value)


def other_probe_once(step: Step, at: int) -> tuple[float, float]:
    return (step.value - 160e-6, 160e-6) if at == 8 else (step.value, 0.0)


def too_far(step: Step, at: int) -> tuple[float, float]:
    return (1.24 * step.value, 0.0)


def slipping(step: Step, at: int) -> tuple[float, float]:
    return (step.value + 0.5e-6 * at, 0.0)


def bent(step: Step, at: int) -> tuple[float, float]:
    return (step.value + 40e-6 * (step.value / 800e-6) ** 2, 0.0)


def crooked(step: Step, at: int) -> tuple[float, float]:
    return (step.value, 0.4 * step.value)


def other_screw(step: Step, at: int) -> tuple[float, float]:
    return (0.5 * step.value, 0.0)


@pytest.mark.parametrize(
    ("technician", "code"),
    [
        (wrong_once, "wrong_position"),
        (skipped, "skipped_step"),
        (not_turned, "repeated_step"),
        (other_way, "direction_reversed"),
        (from_the_wrong_side, "backlash"),
        (other_probe, "wrong_probe"),
        (other_probe_once, "wrong_probe"),
        (slipping, "drift"),
        (bent, "nonlinear"),
        (crooked, "crooked"),
        (other_screw, "wrong_sensitivity"),
    ],
)
@pytest.mark.parametrize("runs", [1, 3])
def test_each_mistake_has_its_name(technician: Technician, code: str, runs: int) -> None:
    if runs == 1 and technician in (skipped, not_turned):

        def first_run(step: Step, at: int) -> tuple[float, float]:
            return technician(replace(step, series="1.2"), at)

        found = codes(probe_readings(calibration(first_run, runs=1), 1))
    else:
        found = codes(probe_readings(calibration(technician, runs=runs), 1))
    assert found == [code]


def test_mistakes_of_the_table_are_named() -> None:
    good = probe_readings(calibration(honest), 1)
    assert codes(good) == []
    assert codes(replace(good, position=1e-3 * good.position)) == ["unit"]
    assert codes(replace(good, position=1e-3 * good.position), replace(SETTINGS, nominal=None)) == [
        "unit"
    ]
    clipped = replace(good, signal=np.clip(1.4 * good.signal, -10.0, 10.0))
    assert codes(clipped, replace(SETTINGS, nominal=71e-6)) == ["saturated"]
    copied = good.signal.copy()
    copied[21:42] = copied[:21]
    assert codes(replace(good, signal=copied)) == ["copied_series"]
    holed = good.signal.copy()
    holed[3] = np.nan
    assert codes(replace(good, signal=holed)) == ["not_a_number"]
    assert codes(replace(good, signal=np.full(63, 0.2))) == ["probe_dead"]
    assert codes(replace(good, other=None)) == []
    tight = replace(SETTINGS, gap_at_zero=500e-6, target_radius=9.5e-3, sensor_radius=1.5e-3)
    assert codes(good, tight) == ["gap"]


def test_exchanged_readings_are_named() -> None:
    good = probe_readings(calibration(honest), 1)
    signal = good.signal.copy()
    assert good.other is not None
    signal[[4, 5]] = signal[[5, 4]]
    assert codes(replace(good, signal=signal)) == ["swapped_steps"]


def test_cylindrical_target_adds_its_share_to_the_budget() -> None:
    good = probe_readings(calibration(honest), 1)
    plain = calibrate_probe(good, SETTINGS)
    pin = replace(
        SETTINGS,
        target_radius=5e-3,
        sensor_radius=1.5e-3,
        gap_at_zero=1.2e-3,
        off_axis=50e-6,
        direction=math.radians(0.5),
    )
    found = calibrate_probe(good, pin)
    assert found.budget is not None
    shares = {one.name: one.uncertainty for one in found.budget.contributions}
    # 50 um across a pin of 5 mm radius read as 0.25 um.
    assert shares["motion across the axis"] == pytest.approx(0.25e-6 / math.sqrt(3.0))
    assert shares["cylindrical target, change of sensitivity"] > 0.0
    assert shares["direction of the probe"] == pytest.approx(
        50e-6 * math.radians(0.5) / math.sqrt(3.0)
    )
    assert found.gain > 1.0
    assert found.sensitivity == pytest.approx(plain.sensitivity / found.gain)
    assert found.expanded > plain.expanded


def test_procedure_is_taken_up_from_its_events_after_every_one() -> None:
    whole = calibration(honest, (1, 2), runs=1, positions=5)
    for count in range(1, len(whole.events) + 1):
        again = take_up(MEASURING, whole.events[:count])
        assert again.events == whole.events[:count]
    assert again == whole
    assert whole.instruction.startswith("All readings")
    assert sorted({step.series for step in whole.steps if step.series}) == ["1.1", "2.1"]


def test_rejected_series_is_mounted_and_taken_again() -> None:
    whole = calibration(honest, (1, 2), runs=1, positions=5)
    with pytest.raises(ProcedureError, match="needs a reason"):
        whole.reject(0, " ")
    again = whole.reject(2, "bumped into\nthe table")
    assert again.step.kind is StepKind.SET_UP
    assert again.step.set_up == 1
    assert len(again.taken) == len(whole.taken)
    assert again.taken[2].rejected == "bumped into the table"
    assert again.taken[3].rejected == "series repeated: bumped into the table"
    assert len(probe_readings(again, 1).position) == 0
    with pytest.raises(ProcedureError, match=r"setting up, not reading: .*in front of probe 1"):
        again.record((0.0, 0.0), 0.0, 1.0)
    again = again.set_up()
    again = again.record((0.0, 0.0), 0.0, 1.0)
    with pytest.raises(ProcedureError, match=r"series 1\.1 is not finished"):
        again.reject(len(whole.taken) - 1, "too")
    while not again.done:
        again = again.record((0.0, 0.0), 0.0, 1.0)
    assert len(probe_readings(again, 1).position) == 9
    assert take_up(MEASURING, again.events) == again


def test_last_series_is_repeated_without_mounting() -> None:
    whole = calibration(honest, (1, 2), runs=1, positions=5)
    again = whole.reject(len(whole.taken) - 1, "bumped")
    assert again.step.kind is StepKind.READING
    assert again.step.series == "2.1"


@pytest.mark.parametrize(
    ("plan", "needle"),
    [
        (ProbePlan((3,), 1e-3), "1, 2, or both"),
        (ProbePlan((1,), 0.0), "above 0"),
        (ProbePlan((1,), 1e-3, 4), "5 to 101"),
        (ProbePlan((1,), 1e-3, 11, 0), "1 to 10"),
    ],
)
def test_impossible_plans_are_refused(plan: ProbePlan, needle: str) -> None:
    with pytest.raises(ProcedureError, match=needle):
        begin(MEASURING, plan)


def test_instruction_names_positions_and_the_side_of_approach() -> None:
    procedure = begin(MEASURING, ProbePlan((1,), 800e-6, 11, 1)).set_up()
    assert (
        procedure.instruction == "Turn the micrometer 1 back to -880 um, then forward to -800 um."
    )
    procedure = procedure.record((-8.0, 0.0), 0.0, 0.0)
    assert "forward to -640 um" in procedure.instruction
    while not procedure.step.falling:
        procedure = procedure.record((0.0, 0.0), 0.0, 0.0)
    assert "back past the position, to 560 um, then forward to 640 um" in procedure.instruction
    with pytest.raises(ProcedureError, match="not a number"):
        procedure.record((math.nan, 0.0), 0.0, 0.0)
