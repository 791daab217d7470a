"""Means over many revolutions: what they are worth, and that a smooth motion has no scatter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rigapp_model.contact.ensemble import MOST_BATCHES, BatchMeans, ensemble
from rigapp_model.contact.impact_system import ClearanceSystem, clearance_system
from rigapp_model.errors import ModelError, OutOfTime
from rigapp_model.parameters import Joint, Material, Mechanism, Spring

CASE_A = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
CASE_B = replace(CASE_A, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))


def system_of(mechanism: Mechanism) -> ClearanceSystem:
    joint = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3)
    return clearance_system(mechanism, joint, Material(500e6, 0.38), Material(206e9, 0.29), np.pi)


@pytest.mark.parametrize("count", [2, 19, 20, 21, 39, 40, 100, 1000])
def test_the_mean_is_that_of_all_and_its_error_that_of_batches(count: int) -> None:
    samples = np.random.default_rng(count).normal(3.0, 2.0, (count, 2))
    means = BatchMeans()
    for sample in samples:
        means.add(sample)
    found = means.result()
    np.testing.assert_allclose(found.value, samples.mean(axis=0))
    size = 1
    while count // size >= MOST_BATCHES:
        size *= 2
    batches = samples[: count // size * size].reshape(-1, size, 2).mean(axis=1)
    error = batches.std(axis=0, ddof=1) / np.sqrt(len(batches))
    np.testing.assert_allclose(found.standard_error, error)


def test_samples_that_hang_together_are_not_taken_for_many() -> None:
    rng = np.random.default_rng(1)
    ratios = []
    for _ in range(60):
        value, means, samples = 0.0, BatchMeans(), []
        for _ in range(640):
            value = 0.8 * value + rng.normal()
            samples.append(value)
            means.add(value)
        found = means.result()
        ratios.append(float(found.value / found.standard_error))
    # The naive error of 640 samples would be three times too small.
    assert 0.7 < np.std(ratios) < 1.5


def test_one_revolution_has_no_error() -> None:
    means = BatchMeans()
    means.add(2.0)
    assert means.result().value == 2.0
    assert np.isnan(means.result().standard_error)


def test_lost_contact_scatters_and_the_errors_cover_it() -> None:
    system = system_of(CASE_A)
    found = ensemble(system, 24, points=90)
    assert found.revolutions == 24
    assert found.contact_fraction.value == pytest.approx(0.575, abs=0.04)
    assert 0.002 < found.contact_fraction.standard_error < 0.02
    assert found.force.value.shape == (2, 90)
    assert np.all(found.force_magnitude.standard_error >= 0.0)
    moved = replace(system.joint, pin_radius=system.joint.pin_radius + 1e-12)
    other = ensemble(
        clearance_system(CASE_A, moved, Material(500e6, 0.38), Material(206e9, 0.29), np.pi),
        24,
        points=90,
    )
    both = (found.sample.motion.force_magnitude, other.sample.motion.force_magnitude)
    assert np.abs(both[0] - both[1]).max() > 1.0
    for one, two in ((found.mean_force, other.mean_force), (found.touching, other.touching)):
        error = np.hypot(one.standard_error, two.standard_error)
        apart = np.abs(one.value - two.value) / np.maximum(error, 1e-12)
        assert np.sqrt(np.mean(np.square(np.minimum(apart, 10.0)))) < 2.0


def test_a_motion_in_contact_has_no_scatter() -> None:
    found = ensemble(system_of(CASE_B), 4, points=60)
    assert found.contact_fraction.value == 1.0
    assert found.impacts.value == 0.0
    size = found.force_magnitude
    assert size.standard_error.max() < 1e-4 * size.value.max()


def test_time_that_runs_out_leaves_what_is_there() -> None:
    def tell(part: float) -> None:
        if part >= 0.5:
            raise OutOfTime

    found = ensemble(system_of(CASE_B), 6, points=30, progress=tell)
    assert found.revolutions == 3
    assert found.mean_force.value == pytest.approx(59.2, abs=0.2)

    def at_once(part: float) -> None:
        raise OutOfTime

    with pytest.raises(OutOfTime):
        ensemble(system_of(CASE_B), 6, points=30, progress=at_once)
    with pytest.raises(ModelError, match="revolutions is 0: give at least 1"):
        ensemble(system_of(CASE_B), 0)
