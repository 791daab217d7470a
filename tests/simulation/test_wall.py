"""The simulated wall: its elasticity against closed forms and finite elements, its wear against the
model's life at an equal wear coefficient."""

from __future__ import annotations

import math

import msgspec
import numpy as np
import pytest

from rigapp.config.parameters import ParameterFile, to_parameters
from rigapp.config.rig import PlantSection, RigFile
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.layout import VELOCITY, Drive
from rigapp.simulation.plant import Plant
from rigapp.simulation.wall import (
    APPROACH,
    AREA,
    PEAK,
    Bore,
    looked_up,
    unworn_wall,
    wave_compliance,
    worn_wall,
)
from rigapp_model.bushing.ring import Ring, pressure_distribution
from rigapp_model.wear.life import life

INNER, OUTER, WIDTH = 10e-3, 20e-3, 13.1e-3
MODULUS, POISSON = 500e6, 0.38
TURN = 2.0 * math.pi


def bore(clearance: float, wear_coefficient: float = 0.0) -> Bore:
    return Bore(INNER - clearance, INNER, WIDTH, wear_coefficient)


def test_all_round_pressure_widens_the_ring_as_lame_says() -> None:
    # u = A r + B / r with u(outer) = 0 and the radial stress -1 at the bore.
    shear = MODULUS / (2.0 * (1.0 + POISSON))
    lame = 2.0 * shear * POISSON / (1.0 - 2.0 * POISSON)
    conditions = [[2.0 * (lame + shear), -2.0 * shear / INNER**2], [OUTER, 1.0 / OUTER]]
    a, b = np.linalg.solve(conditions, [-1.0, 0.0])
    assert wave_compliance(0.0, INNER, OUTER, MODULUS, POISSON) == pytest.approx(
        a * INNER + b / INNER
    )


def test_short_waves_move_the_bore_like_a_flat_surface() -> None:
    flat = 2.0 * (1.0 - POISSON**2) / MODULUS * INNER / 400.0
    assert wave_compliance(400.0, INNER, OUTER, MODULUS, POISSON) == pytest.approx(flat, rel=3e-3)


def test_where_two_powers_meet_the_limit_is_smooth() -> None:
    around = [wave_compliance(n, INNER, OUTER, MODULUS, POISSON) for n in (0.999, 1.0, 1.001)]
    assert around[1] == pytest.approx(0.5 * (around[0] + around[2]), rel=1e-4)


def test_a_narrow_contact_is_hertzs() -> None:
    clearance, force = 2e-3, 3.0
    k = bore(clearance)
    wall = unworn_wall(k, OUTER, MODULUS, POISSON, force)
    relative = INNER * k.pin_radius / clearance
    half = math.sqrt(4.0 * force * relative * (1.0 - POISSON**2) / (math.pi * WIDTH * MODULUS))
    peak = looked_up(wall.table, wall.state, force, PEAK)
    assert peak == pytest.approx(2.0 * force / (math.pi * half * WIDTH), rel=0.015)


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize("clearance", [1e-3, 0.5e-3, 50e-6, 5e-6])
@pytest.mark.parametrize("force", [20.0, 85.0])
def test_contact_is_that_of_finite_elements_as_the_clearance_closes(
    clearance: float, force: float
) -> None:
    k = bore(clearance)
    wall = unworn_wall(k, OUTER, MODULUS, POISSON, force)
    ring = Ring(INNER, OUTER, k.pin_radius, MODULUS, POISSON)
    found = pressure_distribution(ring, (force / WIDTH, 0.0))
    peak = looked_up(wall.table, wall.state, force, PEAK)
    assert peak == pytest.approx(found.pressure.max(), rel=0.02)
    approach = looked_up(wall.table, wall.state, force, APPROACH)
    assert approach == pytest.approx(float(found.pin[0]) - clearance, rel=0.02)


def test_the_worn_area_is_archards_and_that_of_the_profile() -> None:
    k = bore(0.5e-3)
    depth = 0.2e-3
    wall, area = worn_wall(unworn_wall(k, OUTER, MODULUS, POISSON, 70.0), k, 70.0, depth)
    assert wall.worn[0] == pytest.approx(depth, rel=1e-6)
    cut = 2.0 * np.trapezoid(wall.worn * (INNER + 0.5 * wall.worn), wall.angle)
    assert area == pytest.approx(float(cut), rel=0.01)
    # The pressure all over the contact carries the force along it: the area per slip is more.
    per_slip = looked_up(wall.table, wall.state, 70.0, AREA)
    assert 70.0 / WIDTH < per_slip < 1.15 * 70.0 / WIDTH


def plant_and_model(
    rig: RigFile, parameters: ParameterFile, turns: list[int], faster: float
) -> np.ndarray:
    """Return plant over model at some revolutions, (n,); both wear so many times faster.

    The mechanism is the model's; friction, ripple and what the sensors do wrong are the rig's.
    """
    quicker = msgspec.structs.replace(
        parameters.bushing,
        wear_coefficient_mm3_per_Nm=faster * parameters.bushing.wear_coefficient_mm3_per_Nm,
    )
    parameters = msgspec.structs.replace(parameters, bushing=quicker)
    assert rig.simulation is not None
    effects = msgspec.structs.replace(
        rig.simulation.plant,
        wear_coefficient_factor=1.0,
        slider_mass_factor=1.0,
        spring_stiffness_factor=1.0,
    )
    simulation = msgspec.structs.replace(rig.simulation, plant=effects)
    plant = Plant(
        plant_constants(parameters, msgspec.structs.replace(rig, simulation=simulation)),
        angle_rad=0.0,
    )
    # Rows beside each place where it is asked: between two the depth is no straight line.
    rows = [float(turn + more) for turn in turns for more in (0, 1)]
    worn = life(to_parameters(parameters), TURN, rows[-1], "continuous", 1e-3, rows=rows)
    found = []
    for turn in turns:
        while plant.angle_rad < TURN * turn:
            left = (TURN * turn - plant.angle_rad) / TURN
            steps = min(max(int(left * 960.0), 1), 96_000)
            plant.advance(steps, Drive(VELOCITY, TURN, TURN, 0.0, 48.0, 0.0))
        cycles = plant.angle_rad / TURN
        model = float(np.interp(cycles, worn.cycles, worn.max_depth))
        found.append(plant.state().wear_depth_m / model)
    return np.array(found)


@pytest.mark.sampled
@pytest.mark.parametrize(("turns", "faster"), [([10, 30, 100], 1.0), ([20, 70, 200, 428], 50.0)])
def test_plant_wears_like_the_model_at_an_equal_coefficient(
    rig: RigFile, parameters: ParameterFile, turns: list[int], faster: float
) -> None:
    # 428 revolutions of 50 times the coefficient do what 21,400 do.
    assert PlantSection().wear_coefficient_factor == 1.1
    np.testing.assert_allclose(plant_and_model(rig, parameters, turns, faster), 1.0, atol=0.01)


@pytest.mark.soak
def test_plant_wears_like_the_model_over_a_whole_life(
    rig: RigFile, parameters: ParameterFile
) -> None:
    turns = [10, 30, 100, 300, 1000, 3000, 10_000, 21_377]
    np.testing.assert_allclose(plant_and_model(rig, parameters, turns, 1.0), 1.0, atol=0.01)
