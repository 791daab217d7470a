"""The bench: weights on the free pin, the pin turned by hand, micrometers before the probes."""

from __future__ import annotations

import math

import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import RigFile
from rigapp.simulation import layout
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant
from rigapp.simulation.simulated_operator import SimulatedOperator, hand_of

LOCKED = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 1e6)


@pytest.fixture
def plant(perfect_rig: RigFile, parameters: ParameterFile) -> Plant:
    return Plant(plant_constants(parameters, perfect_rig))


@pytest.mark.parametrize("angle_deg", [0.0, 90.0, 215.0])
def test_weight_pulls_the_pin_down_in_the_crank_frame(plant: Plant, angle_deg: float) -> None:
    hands = SimulatedOperator(plant)
    hands.do(hand_of({"hand": "take_off_follower"}))
    hands.do(hand_of({"hand": "hang_weight", "mass_kg": 10.0, "gravity_m_s2": 9.8123}))
    hands.do(hand_of({"hand": "turn_pin", "angle_deg": angle_deg}))
    samples = plant.advance(5, LOCKED)
    weight = 10.0 * 9.8123 * (1.0 - 1.2 / 8000.0)
    angle = math.radians(angle_deg)
    assert 200.0 * samples.bridge_1[-1] == pytest.approx(-weight * math.sin(angle), abs=1e-9)
    assert 200.0 * samples.bridge_2[-1] == pytest.approx(-weight * math.cos(angle), abs=1e-9)
    assert samples.shaft_revolutions[-1] % 1.0 == pytest.approx(angle_deg / 360.0)


def test_micrometer_moves_one_probe(plant: Plant) -> None:
    hands = SimulatedOperator(plant)
    hands.do(hand_of({"hand": "take_off_follower"}))
    hands.do(hand_of({"hand": "set_micrometer", "probe": 2, "position_um": -250.0}))
    samples = plant.advance(5, LOCKED)
    assert samples.probe_2[-1] == pytest.approx(-2.5)
    assert samples.probe_1[-1] == 0.0


def test_follower_on_again_is_the_mechanism_again(plant: Plant) -> None:
    before = plant.advance(5, LOCKED).bridge_1[-1]
    hands = SimulatedOperator(plant)
    hands.do(hand_of({"hand": "take_off_follower"}))
    assert hands.lock_Nm > 1000.0
    assert plant.advance(5, LOCKED).bridge_1[-1] == 0.0
    hands.do(hand_of({"hand": "put_on_follower"}))
    assert hands.lock_Nm == 0.0
    assert plant.advance(5, LOCKED).bridge_1[-1] == pytest.approx(before)


def test_hands_refuse_what_nobody_could_do(plant: Plant) -> None:
    hands = SimulatedOperator(plant)
    with pytest.raises(UnusableInput, match="take_off_follower first"):
        hands.do(hand_of({"hand": "hang_weight", "mass_kg": 1.0}))
    with pytest.raises(UnusableInput, match="hand:"):
        hand_of({"hand": "hang_weight", "mass_kg": -1.0})
    with pytest.raises(UnusableInput, match="hand:"):
        hand_of({"hand": "hit_it"})
    plant.advance(900, Drive(layout.VELOCITY, 0.0, 6.0, 0.0, 48.0, 0.0))
    with pytest.raises(UnusableInput, match="stop it first"):
        hands.do(hand_of({"hand": "take_off_follower"}))


def test_a_new_specimen_is_not_worn(plant: Plant) -> None:
    plant.wear_to(50e-6)
    worn = plant.approach_m(80.0)
    SimulatedOperator(plant).do(hand_of({"hand": "new_specimen"}))
    assert (plant.state().wear_depth_m, plant.state().worn_area_m2) == (0.0, 0.0)
    assert plant.approach_m(80.0) > 1.2 * worn
