"""A whole simulated test with its twin: the worn profile against the plant's truth.

The plant is driven here without devices and without a clock, so that thousands of samples take
milliseconds; what it wears is known.
"""

from __future__ import annotations

from dataclasses import replace

import msgspec
import numpy as np
import pytest
from plant_revolutions import PARAMETERS, column, measured_revolutions

from rigapp.schema.columns import profile_columns
from rigapp.schema.messages import Prediction, WornProfile, as_array
from rigapp.twin.checkpoint import Checkpoint, packed, restore, take_over
from rigapp.twin.measureddepth import ANGLES
from rigapp.twin.predict import MeasuredRevolution
from rigapp.twin.twin import Twin, profile_is_due


def followed(twin: Twin, revolutions: list[tuple[MeasuredRevolution, float]]) -> list[Prediction]:
    return [twin.predict(measured) for measured, _ in revolutions]


def last_profile(predictions: list[Prediction]) -> WornProfile:
    return [one.profile for one in predictions if one.profile is not None][-1]


def true_profile(revolutions: list[tuple[MeasuredRevolution, float]]) -> np.ndarray:
    """Cut the pin's circle out of the bushing at all its true places: depth at ANGLES, mm.

    The places are those of a pin that does not indent: clearance and depth from the middle. By
    points on the circles, sorted into degrees; deepest of each. NaN where none comes beyond.
    """
    joint = PARAMETERS.joint
    round_pin = joint.pin_radius * np.exp(1j * np.radians(np.arange(-60.0, 60.0, 0.02)))
    deepest = np.full(ANGLES.size, -np.inf)
    for one, depth in revolutions:
        seen = -(one.probe_1 + 1j * one.probe_2)[::20]
        for place in seen / np.abs(seen) * (joint.clearance + depth):
            points = place + round_pin
            degree = np.degrees(np.angle(points))
            near = np.abs(degree - np.round(degree)) < 0.011
            index = np.round(degree[near]).astype(int) + 180
            np.maximum.at(deepest, index, np.abs(points[near]) - joint.bushing_radius)
    return 1e3 * np.where(deepest > 0.0, deepest, np.nan)


@pytest.mark.long
def test_measured_profile_is_the_plants_within_its_uncertainty() -> None:
    revolutions = measured_revolutions(100.0, 60)
    predictions = followed(Twin(PARAMETERS, "continuous"), revolutions)
    depth = revolutions[-1][1]
    assert depth > 50e-6
    profile = last_profile(predictions)
    measured, doubt = as_array(profile.measured), as_array(profile.uncertainty)
    averaged = int(as_array(profile.values, "<f8")[1])
    clean = measured_revolutions(100.0, profile.revolution, probe_noise_um=0.0, pin_run_out_um=0.0)
    expected = true_profile(clean[-averaged:])
    seen, worn = np.isfinite(measured), np.isfinite(expected)
    assert seen[180]
    assert not seen[0]
    error = np.abs(measured - expected)[seen & worn]
    assert (error <= doubt[seen & worn]).all()
    assert error.max() < 4e-3
    assert measured[seen & ~worn].max(initial=0.0) < 4e-3
    assert expected[worn & ~seen].max(initial=0.0) < 4e-3
    values = dict(
        zip((one.name for one in profile_columns()), as_array(profile.values, "<f8"), strict=True)
    )
    assert values["run_out"] == pytest.approx(3.0, abs=0.2)
    assert values["centred"] == 1.0
    assert 1e-3 * column(predictions[-1], "measured_wear_depth") == pytest.approx(depth, rel=0.02)


@pytest.mark.parametrize(
    ("factor", "number"),
    [(0.8, 60), *(pytest.param(one, 220, marks=pytest.mark.long) for one in (0.8, 1.1))],
)
def test_measured_depth_is_the_plants_within_its_uncertainty(factor: float, number: int) -> None:
    # Within 220 revolutions the elastic approach falls by a third: 4 um at a wear of 8 to 11 um.
    revolutions = measured_revolutions(factor, number)
    predictions = followed(Twin(PARAMETERS, "continuous"), revolutions)
    true = np.array([depth for _, depth in revolutions])[9:]
    depth, doubt = (
        1e-3 * np.array([column(one, name) for one in predictions[9:]])
        for name in ("measured_wear_depth", "measured_wear_depth_uncertainty")
    )
    assert (np.abs(depth - true) <= doubt).mean() >= 0.95
    assert np.abs(depth - true).max() < 0.5e-6
    assert doubt.max() < 1.5e-6


@pytest.mark.soak
@pytest.mark.timeout(1800)
def test_measured_depth_is_the_plants_over_thousands_of_revolutions() -> None:
    for factor, number in ((1.1, 1500), (50.0, 300)):
        revolutions = measured_revolutions(factor, number)
        predictions = followed(Twin(PARAMETERS, "continuous"), revolutions)
        errors = np.array(
            [
                abs(1e-3 * column(one, "measured_wear_depth") - true)
                / (1e-3 * column(one, "measured_wear_depth_uncertainty"))
                for one, (_, true) in zip(predictions[9:], revolutions[9:], strict=True)
            ]
        )
        assert (errors <= 1.0).mean() >= 0.95


@pytest.mark.long
def test_wear_coefficients_a_tenth_apart_are_told_apart() -> None:
    depths, doubts = [], []
    for factor in (80.0, 88.0):
        revolutions = measured_revolutions(factor, 50)
        predictions = followed(Twin(PARAMETERS, "continuous"), revolutions)
        measured = 1e-3 * column(predictions[-1], "measured_wear_depth")
        depths.append((measured, revolutions[-1][1]))
        doubts.append(1e-3 * float(as_array(last_profile(predictions).uncertainty)[180]))
    (low, true_low), (high, true_high) = depths
    assert abs(low - true_low) < doubts[0]
    assert abs(high - true_high) < doubts[1]
    assert high - low == pytest.approx(true_high - true_low, rel=0.1)
    assert high / low == pytest.approx(true_high / true_low, rel=0.01)
    # What both measurements have wrong in common does not matter between them.
    assert high - low > 10.0 * abs((high - true_high) - (low - true_low))


@pytest.mark.long
def test_a_twin_goes_on_from_its_checkpoint_as_if_nothing_had_happened() -> None:
    revolutions = measured_revolutions(1.0, 36)
    unbroken, before = Twin(PARAMETERS, "continuous"), Twin(PARAMETERS, "continuous")
    whole = followed(unbroken, revolutions)
    followed(before, revolutions[:24])
    state = packed(before)
    assert msgspec.msgpack.decode(state, type=Checkpoint).newest == 24
    after = Twin(PARAMETERS, "continuous")
    assert restore(after, state)
    rest = followed(after, revolutions[24:])
    for name in ("wear_depth", "driven_wear_depth", "measured_wear_depth"):
        assert column(rest[0], name) == pytest.approx(column(whole[24], name), rel=1e-6)
        assert column(rest[-1], name) == pytest.approx(column(whole[-1], name), rel=1e-3)


@pytest.mark.long
def test_another_test_of_the_specimen_goes_on_with_its_bushing() -> None:
    revolutions = measured_revolutions(1.0, 36)
    whole = followed(Twin(PARAMETERS, "continuous"), revolutions)
    before = Twin(PARAMETERS, "continuous")
    followed(before, revolutions[:24])
    later = [(replace(one, revolution=one.revolution - 24), depth) for one, depth in revolutions]
    after, other = Twin(PARAMETERS, "continuous"), Twin(PARAMETERS, "continuous")
    take_over(after, packed(before), same_model=True)
    take_over(other, packed(before), same_model=False)
    rest, apart = followed(after, later[24:]), followed(other, later[24:])
    for name in ("wear_depth", "driven_wear_depth", "measured_wear_depth"):
        assert column(rest[0], name) == pytest.approx(column(whole[24], name), rel=1e-6)
        assert column(rest[-1], name) == pytest.approx(column(whole[-1], name), rel=1e-3)
    assert column(rest[-1], "revolution") == 12
    resumed = Twin(PARAMETERS, "continuous")
    assert restore(resumed, packed(after))
    assert (resumed.before, resumed.newest) == (24, 12)
    # Another model has bushings of its own; what the probes saw of the new one stays.
    name = "measured_wear_depth"
    doubt = column(whole[-1], f"{name}_uncertainty")
    assert column(apart[-1], name) == pytest.approx(column(whole[-1], name), abs=doubt)
    assert column(apart[-1], "wear_depth") < 0.5 * column(whole[-1], "wear_depth")


def test_a_checkpoint_that_does_not_fit_is_refused() -> None:
    twin, other = Twin(PARAMETERS, "continuous"), Twin(PARAMETERS, "continuous")
    followed(twin, measured_revolutions(1.0, 9))
    state = packed(twin)
    assert not restore(other, b"")
    assert not restore(other, state[:-20])
    assert other.newest == 0
    assert other.predicted.state is None
    joint = PARAMETERS.joint
    wide = type(joint)(joint.pin_radius, 0.012, 0.02, joint.bushing_width)
    foreign = type(PARAMETERS)(PARAMETERS.mechanism, wide, PARAMETERS.bushing, PARAMETERS.pin)
    assert not restore(Twin(foreign, "continuous"), state)


def test_profiles_are_kept_evenly_in_the_logarithm() -> None:
    kept, last = [], 0
    for number in range(1, 10_001):
        if profile_is_due(last, number):
            kept.append(number)
            last = number
    assert kept[:4] == [1, 2, 3, 4]
    assert kept[-1] == 10_000
    late = np.array(kept[30:])
    assert np.diff(np.log10(late)).max() < 1.6 / 24
    assert len(kept) <= 24 * 4 + 3
