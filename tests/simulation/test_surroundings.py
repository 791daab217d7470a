"""Friction warms the bushing, the room has a day, and free inputs and slow devices see both."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import PlantSection, RigFile
from rigapp.simulation import layout
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.handle import start_simulated_rig
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant, Samples
from rigapp.simulation.surroundings import HOUR_S, FreeInputs, slow_values
from rigapp_drivers.modbus_sensor.driver import ModbusSensor

SPEED = 2.0 * math.pi
TURNING = Drive(layout.VELOCITY, SPEED, SPEED, 0.0, 48.0, 0.0)
STANDING = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 1000.0)
GAIN, LAG_S = 30.0, 20.0


@pytest.fixture
def rubbing(flawed: Callable[..., RigFile], parameters: ParameterFile) -> Callable[..., Plant]:
    """Return a maker of plants with friction that warms the bushing by 30 K/W in 20 s."""
    k = plant_constants(parameters, flawed(joint_friction_coefficient=0.1))
    k = k._replace(heating_K_per_W=GAIN, heating_time_s=LAG_S)
    return lambda **options: Plant(k, angle_rad=0.0, **options)


def friction_power_W(samples: Samples, plant: Plant) -> np.ndarray[Any, Any]:
    """Return force along the wall times sliding speed, from what the truth says of each sample."""
    k, truth = plant.constants, samples.truth
    force = np.hypot(truth.force_e1_N, truth.force_n1_N)
    length = k.follower_length + k.lengthening_sign * (k.clearance + truth.wear_depth_m)
    follower = np.arcsin(-k.crank_radius * np.sin(truth.angle_rad) / length)
    turning = np.gradient(truth.angle_rad - follower, truth.time_s)
    return 0.1 / math.hypot(1.0, 0.1) * force * k.pin_radius * np.abs(turning)


def test_the_bushing_follows_the_power_of_friction_and_cools(rubbing: Callable[..., Plant]) -> None:
    plant = rubbing()
    samples = plant.advance(round(60.0 / plant.step_s), TURNING)
    time_s = samples.truth.time_s
    power = friction_power_W(samples, plant)
    kernel = np.exp(-(time_s[-1] - time_s) / LAG_S) / LAG_S
    expected = GAIN * float(np.trapezoid(power * kernel, time_s))
    assert expected > 1.0
    assert samples.bushing_rise_K[-1] == pytest.approx(expected, rel=0.01)
    while plant.speed_rad_per_s != 0.0:
        plant.advance(100, STANDING)
    before, then = plant.state().bushing_rise_K, plant.time_s
    plant.advance(20_000, STANDING)
    left = math.exp(-(plant.time_s - then) / LAG_S)
    assert plant.state().bushing_rise_K == pytest.approx(before * left, rel=1e-3)


def test_heat_and_noise_do_not_depend_on_how_the_time_is_cut(rubbing: Callable[..., Plant]) -> None:
    whole, cut = rubbing(free_inputs=2), rubbing(free_inputs=2)
    steady = Drive(layout.DUTY, 0.0, 0.0, 0.3, 48.0, 0.0)
    one = whole.advance(4000, steady)
    parts = [cut.advance(steps, steady) for steps in (1, 999, 1500, 1500)]
    for name in ("bushing_rise_K", "warm_s"):
        pieces = np.concatenate([getattr(part, name) for part in parts])
        np.testing.assert_array_equal(pieces, getattr(one, name))
    noise = np.concatenate([part.free_noise for part in parts], axis=1)
    np.testing.assert_array_equal(noise, one.free_noise)
    assert abs(float(np.corrcoef(noise)[0, 1])) < 0.1


def test_the_room_has_a_day_and_warmer_air_is_drier() -> None:
    plant = PlantSection(room_temperature_degC=20.0, room_swing_K=2.0, humidity_percent=50.0)
    names = ("temperature_C", "humidity_percent", "bushing_temperature_C", "colour_nm")
    start, noon, night = (
        slow_values(names, plant, 5.0, part * 24.0 * HOUR_S) for part in (0.0, 0.25, 0.75)
    )
    assert start == {"temperature_C": 20.0, "humidity_percent": 50.0, "bushing_temperature_C": 25.0}
    assert (noon["temperature_C"], night["temperature_C"]) == pytest.approx((22.0, 18.0))
    assert noon["humidity_percent"] < 50.0 < night["humidity_percent"]


def channel(**keys: Any) -> SimpleNamespace:
    known = {"source": "", "scale": 1.0, "offset_V": 0.0, "table": ()}
    return SimpleNamespace(**{**known, **keys})


def test_a_free_input_carries_what_its_channel_is_named_after(
    rubbing: Callable[..., Plant],
) -> None:
    rig = SimpleNamespace(
        simulation=None,
        channels={
            "bushing_temperature": channel(input="analog_5", scale=100.0, offset_V=0.5),
            "room_temperature": channel(input="analog_6", table=((0.0, 0.0), (10.0, 50.0))),
            "motor_current": channel(input="", source="drive.current_A"),
            "third_probe": channel(input="analog_7"),
        },
    )
    free = FreeInputs(rig)  # type: ignore[arg-type]
    plant = rubbing(free_inputs=len(free))
    samples = plant.advance(3000, TURNING)
    voltages = free.voltages(samples)
    assert list(voltages) == ["bushing_temperature", "room_temperature", "third_probe"]
    bushing, room, nothing = voltages.values()
    assert 100.0 * (bushing - 0.5) == pytest.approx(21.0 + samples.bushing_rise_K, abs=0.2)
    assert room * 5.0 == pytest.approx(np.full(room.size, 21.0), abs=0.02)
    assert abs(float(nothing.mean())) < 1e-3
    assert 1e-3 < float(nothing.std()) < 3e-3


def test_a_thermometer_of_the_rig_file_is_served_like_any_device(
    rig_path: Path, tmp_path: Path
) -> None:
    text = rig_path.read_text("utf-8")
    path = tmp_path / "rig.toml"
    device = '[devices.climate]\ndriver = "modbus_sensor"\nport = "simulated"\n\n[spindle]\n'
    path.write_text(text.replace("[spindle]\n", device, 1), "utf-8")
    with start_simulated_rig(path, speed=1.0, parameters=None) as running:
        assert list(running.urls) == ["daq", "drive", "climate"]
        sensor = ModbusSensor("climate", running.urls["climate"], {})
        try:
            sensor.open()
            told = sensor.read()
        finally:
            sensor.close()
    assert told == pytest.approx({"temperature_C": 21.0, "humidity_percent": 45.0}, abs=0.11)
