"""Weights against worked examples; the cylinder correction against quadrature."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import integrate

from rigapp_calibration.load_cell.weights import (
    Place,
    WeightSet,
    force_per_mass,
    normal_gravity,
    pin_force,
    relative_force_uncertainty,
    weight_force,
)
from rigapp_calibration.probes.calibrate import (
    apparent_gap,
    sensitivity_gain,
)


def test_conventional_mass_with_buoyancy() -> None:
    # 4.0786 kg of steel at g = 9.8123: 4.0786 * 9.8123 * (1 - 1.2/8000) = 40.01444 N
    force = weight_force([4.0786], WeightSet(), Place(9.8123, 1e-4))
    assert force[0] == pytest.approx(4.0786 * 9.8123 * (1.0 - 1.2 / 8000.0), rel=1e-12)
    assert force[0] == pytest.approx(40.01445, abs=2e-5)


def test_brass_of_conventional_mass_is_heavier_than_its_mass_in_thin_air() -> None:
    brass = WeightSet(density=8400.0)
    thin = Place(9.81, 0.0, air_density=0.9)
    true_mass = (1 - 1.2 / 8000) / (1 - 1.2 / 8400)
    assert force_per_mass(brass, thin) == pytest.approx(
        9.81 * true_mass * (1 - 0.9 / 8400), rel=1e-14
    )
    at_reference = Place(9.81, 0.0)
    assert force_per_mass(brass, at_reference) == pytest.approx(9.81 * (1 - 1.2 / 8000), rel=1e-14)


def test_true_mass_has_no_convention() -> None:
    weights = WeightSet(mass_kind="true", density=7800.0)
    assert force_per_mass(weights, Place(9.8, 0.0)) == pytest.approx(9.8 * (1 - 1.2 / 7800.0))


@pytest.mark.parametrize(
    ("latitude", "gravity"), [(0.0, 9.7803253359), (45.0, 9.8061977694), (90.0, 9.8321849379)]
)
def test_normal_gravity_of_the_ellipsoid(latitude: float, gravity: float) -> None:
    assert normal_gravity(math.radians(latitude)) == pytest.approx(gravity, abs=2e-9)
    lower = normal_gravity(math.radians(latitude), 1000.0)
    assert gravity - lower == pytest.approx(3.086e-3, abs=1e-6)


def test_hanger_adds_to_loaded_steps_only() -> None:
    weights = WeightSet(hanger_mass=0.5)
    place = Place(9.81, 0.0)
    force = weight_force([0.0, 5.0], weights, place)
    assert force[0] == 0.0
    assert force[1] == pytest.approx(5.5 * force_per_mass(weights, place))


def test_weight_pulls_down_in_the_pin_frame() -> None:
    force = pin_force(100.0, np.radians([0.0, 90.0, 180.0, 270.0]), 0.0)
    assert force == pytest.approx(
        np.array([[0.0, -100.0], [-100.0, 0.0], [0.0, 100.0], [100.0, 0.0]]), abs=1e-12
    )


def test_relative_uncertainty_combines_mass_and_gravity() -> None:
    weights = WeightSet(relative_uncertainty=3e-5, density_uncertainty=0.0)
    place = Place(10.0, 4e-4, air_density_uncertainty=0.0)
    assert relative_force_uncertainty(weights, place) == pytest.approx(5e-5, rel=1e-6)


A, R = 1.5e-3, 5e-3


def test_cylinder_correction_against_quadrature() -> None:
    gap = 250e-6

    def strip(z: float) -> float:
        return 2.0 * math.sqrt(A * A - z * z) / (gap + z * z / (2.0 * R))

    area, _ = integrate.quad(strip, -A, A, epsabs=0.0, epsrel=1e-11)
    flat = math.pi * A * A / area
    assert float(apparent_gap(gap, A, R)) == pytest.approx(flat, rel=1e-6)


def test_cylinder_correction_of_the_worked_example() -> None:
    assert 1e6 * float(apparent_gap(250e-6, A, R)) == pytest.approx(297.3, abs=0.1)
    assert 100 * (float(sensitivity_gain(250e-6, A, R)) - 1) == pytest.approx(2.6, abs=0.1)
    gaps = np.linspace(50e-6, 1e-3, 40)
    step = 1e-9
    slope = (apparent_gap(gaps + step, A, R) - apparent_gap(gaps - step, A, R)) / (2 * step)
    assert sensitivity_gain(gaps, A, R) == pytest.approx(slope, rel=1e-6)
