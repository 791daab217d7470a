"""The map of the pin's run-out: what slow rolls tell, how well, and what they cannot tell."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rigapp.config.loading import read_rig
from rigapp.config.parameters import to_parameters
from rigapp.simulation import layout
from rigapp.simulation.constants import packaged_parameters, plant_constants
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant
from rigapp.twin.predict import DOUBTS, elastic_motions
from rigapp_calibration.turning.run_out import (
    FASTEST,
    Roll,
    RunOutError,
    SlowRevolution,
    evaluate,
    make_map,
    spread_at,
)

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"
GRID = np.linspace(0.0, 2.0 * math.pi, 360, endpoint=False)
TRUTH = np.array([[2e-6, 1e-6, 0.4e-6, 0.0], [-1e-6, 2e-6, 0.0, 0.3e-6]])
RPM = 2.0 * math.pi / 60.0


def roll(
    rng: np.random.Generator,
    speed: float = 3.0 * RPM,
    turns: int = 10,
    moved: np.ndarray | None = None,
    wander: float = 0.05e-6,
) -> Roll:
    """Return a roll of a pin with run-out TRUTH that also moves by ``moved``; each turn differs."""
    made = []
    for number in range(1, turns + 1):
        angle = np.sort(rng.uniform(0.0, 2.0 * math.pi, 600))
        coefficients = TRUTH + rng.normal(0.0, wander, TRUTH.shape)
        if moved is not None:
            coefficients = coefficients + moved
        probes = evaluate(coefficients, angle) + rng.normal(0.0, 0.2e-6, (2, 600))
        probes += np.array([[30e-6], [-400e-6]]) + 1e-7 * rng.normal() * angle
        made.append(SlowRevolution(number, angle, probes))
    return Roll(f"{speed / RPM:g} rpm", speed, tuple(made))


def test_stated_uncertainty_covers_the_truth() -> None:
    """Of 200 maps the 95 % intervals of both probes at 12 angles hold the truth in 93 to 97 %."""
    rng = np.random.default_rng(8)
    at = GRID[::30]
    inside = 0
    for _ in range(200):
        found = make_map([roll(rng, turns=8)], 2)
        assert found.accepted
        off = np.abs(evaluate(found.coefficients - TRUTH, at))
        inside += int(np.sum(off < found.coverage_factor * spread_at(found.covariance, at)))
    assert 0.92 < inside / (200 * 24) < 0.975


def test_what_grows_with_the_square_of_the_speed_is_taken_off() -> None:
    rng = np.random.default_rng(2)
    moved = np.array([[0.0, 0.0, 0.2e-6, 0.0], [0.0, 0.3e-6, 0.0, 0.0]])
    rolls = [roll(rng, 3.0 * RPM, moved=moved), roll(rng, 6.0 * RPM, moved=4.0 * moved)]
    found = make_map(rolls, 2)
    assert found.accepted
    assert found.inertia == pytest.approx([0.2e-6, 0.3e-6], abs=0.05e-6)
    off = np.abs(evaluate(found.coefficients - TRUTH, GRID)).max(axis=1)
    assert np.all(off < found.expanded)
    alone = make_map(rolls[1:], 2)
    assert alone.inertia is None
    assert np.abs(evaluate(alone.coefficients - TRUTH, GRID)).max() > 0.9e-6


def test_motion_with_the_load_is_said_and_counted_as_uncertainty() -> None:
    rng = np.random.default_rng(4)
    moved = np.array([[0.0] * 4, [1.5e-6, 0.0, 0.0, 0.0]])
    found = make_map([roll(rng), roll(rng, moved=moved)], 2)
    assert found.accepted
    assert [one.code for one in found.problems] == ["not_run_out"]
    assert "Probe 2" in found.problems[0].sentence
    assert found.expanded[1] > 1.0e-6
    assert found.expanded[0] < 0.3e-6


def spoilt(values: np.ndarray, made: Roll) -> Roll:
    first = replace(made.turns[0], probes=values)
    return replace(made, turns=(first, *made.turns[1:]))


def test_each_mistake_has_its_name() -> None:
    rng = np.random.default_rng(6)
    good = roll(rng)

    def codes(made: Roll) -> list[str]:
        found = make_map([made], 2)
        assert found.accepted == (not any(one.blocks for one in found.problems))
        return [one.code for one in found.problems]

    assert codes(good) == []
    assert codes(roll(rng, turns=4)) == ["too_few_revolutions"]
    assert codes(roll(rng, turns=7)) == ["few_revolutions"]
    assert codes(replace(good, speed=60.0 * RPM)) == ["too_fast"]
    # As fast as a plan may be, by a drive that turns a little faster.
    assert codes(replace(good, speed=1.005 * FASTEST)) == []
    assert codes(replace(good, speed=0.0)) == ["too_fast"]
    assert codes(spoilt(np.full((2, 600), np.nan), good)) == ["not_a_number"]
    late = replace(good, turns=tuple(replace(one, saturated=True) for one in good.turns))
    assert codes(late) == ["saturated"]
    dead = replace(
        good,
        turns=tuple(replace(t, probes=t.probes * np.array([[1.0], [0.0]])) for t in good.turns),
    )
    assert codes(dead) == ["probe_dead"]
    few = replace(
        good,
        turns=tuple(SlowRevolution(t.number, t.angle[:20], t.probes[:, :20]) for t in good.turns),
    )
    assert codes(few) == ["too_few_samples"]
    loose = np.array([[150e-6, 0.0, 0.0, 0.0], [0.0] * 4])
    assert "too_large" in codes(roll(rng, moved=loose))
    early = roll(rng, turns=6).turns
    changed = roll(rng, turns=6, moved=np.array([[2e-6, 0.0, 0.0, 0.0], [0.0] * 4])).turns
    assert "unsteady" in codes(replace(good, turns=early + changed))
    round_pin = roll(rng, moved=-TRUTH)
    assert "below_uncertainty" in codes(round_pin)
    with pytest.raises(RunOutError, match="there is no roll"):
        make_map([], 2)
    with pytest.raises(RunOutError, match="choose 1 to 32"):
        make_map([good], 0)


def rolling(rpm: float, turns: int, wear: float) -> tuple[Plant, Roll, list[np.ndarray]]:
    """Roll the simulated plant slowly; probes at the angle where they were sensed.

    wear: part of the plant's wear coefficient. Returns plant, roll and the force on the follower in
    each revolution (2, n), N, crank frame.
    """
    constants = plant_constants(packaged_parameters(), read_rig(RIG).record)
    constants = constants._replace(wear_coefficient=wear * constants.wear_coefficient)
    plant = Plant(constants, sample_rate_Hz=200.0, angle_rad=0.0)
    drive = Drive(layout.VELOCITY, rpm * RPM, rpm * RPM, 0.0, 48.0, 0.0)
    samples = plant.advance(round((turns + 1.5) * 60.0 / rpm / plant.step_s), drive)
    angle = samples.truth.angle_rad
    scale = 100e-6
    made, forces = [], []
    for number in range(1, turns + 1):
        rows = (angle >= 2.0 * math.pi * number) & (angle < 2.0 * math.pi * (number + 1))
        probes = scale * np.array([samples.probe_1[rows], samples.probe_2[rows]])
        made.append(SlowRevolution(number, angle[rows], probes))
        forces.append(np.array([samples.truth.force_e1_N[rows], samples.truth.force_n1_N[rows]]))
    return plant, Roll(f"{rpm:g} rpm", rpm * RPM, tuple(made)), forces


def moving(rolled: Roll, motions: list[np.ndarray]) -> Roll:
    """Return a roll whose revolutions tell their elastic motion."""
    turns = zip(rolled.turns, motions, strict=True)
    return replace(rolled, turns=tuple(replace(one, elastic=moved) for one, moved in turns))


def against_follower(angle: np.ndarray) -> np.ndarray:
    """Return crank angle less follower angle, rad."""
    mechanism = packaged_parameters().mechanism
    ratio = mechanism.crank_radius_mm / (mechanism.follower_length_mm + 0.5)
    return angle + np.arcsin(ratio * np.sin(angle))


def run_out_of_the_plant() -> np.ndarray:
    against = against_follower(GRID)
    truth = 3e-6 * np.array([np.cos(against), np.sin(against)])
    return truth - truth.mean(axis=1, keepdims=True)


def elastic_motion_of_the_plant(plant: Plant, angle: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Return how far the plant's own bushing gives way, along the plant's normal, (2, n), m."""
    lean = against_follower(angle) - math.asin(plant.constants.joint_friction)
    cosine, sine = np.cos(lean), np.sin(lean)
    size = np.hypot(*force)
    nearer = np.array([plant.approach_m(one) for one in size]) / size
    return nearer * np.array(
        [cosine * force[0] - sine * force[1], sine * force[0] + cosine * force[1]]
    )


def test_map_of_the_simulated_rig_is_the_plants_truth() -> None:
    """The plant's pin is eccentric by 3 um and turns against the follower by crank less follower.

    In the crank angle this has many orders, and a mean that no roll can tell. The bushing gives way
    by three times as much; where that is known exactly, nothing of it is left in the map.
    """
    rolls = []
    for rpm in (3.0, 6.0):
        plant, rolled, forces = rolling(rpm, 10, wear=0.0)
        motions = [
            elastic_motion_of_the_plant(plant, turn.angle, force)
            for turn, force in zip(rolled.turns, forces, strict=True)
        ]
        rolls.append(moving(rolled, motions))
    found = make_map(rolls, 8)
    assert found.accepted, found.problems
    off = np.abs(evaluate(found.coefficients, GRID) - run_out_of_the_plant()).max(axis=1)
    assert np.all(off < np.maximum(found.expanded, 0.03e-6))
    assert found.peak == pytest.approx([6e-6, 6e-6], rel=0.02)
    assert found.elastic[0] > 5e-6
    # The motion with the speed is real: at 60 rpm it would be a hundred times that at 6 rpm.
    assert 0.01e-6 < found.inertia[1] < 0.06e-6


def test_model_tells_the_elastic_motion_of_a_bushing_that_wears_meanwhile() -> None:
    parameters = to_parameters(packaged_parameters())
    rolls = []
    for rpm in (3.0, 6.0):
        _, rolled, forces = rolling(rpm, 10, wear=1.0)
        motions = elastic_motions(parameters, [turn.angle for turn in rolled.turns], forces)
        rolls.append(moving(rolled, motions))
    found = make_map(rolls, 8, elastic_doubts=DOUBTS)
    assert found.accepted, found.problems
    off = np.abs(evaluate(found.coefficients, GRID) - run_out_of_the_plant()).max(axis=1)
    assert np.all(off < [0.3e-6, 0.4e-6])
    assert np.all(off < found.expanded)
    # 20 % of its size along the force, 0.1 rad of its direction across it.
    least = found.coverage_factor * np.array([0.2, 0.1]) * found.elastic[0]
    assert found.expanded == pytest.approx(least, rel=0.1)
    rigid = make_map(
        [replace(one, turns=tuple(replace(t, elastic=None) for t in one.turns)) for one in rolls], 8
    )
    assert rigid.elastic is None
    assert rigid.peak[0] > 15e-6
