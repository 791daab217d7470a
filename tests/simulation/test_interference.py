"""What a laboratory adds: each switch by itself has the effect that it says, on signals alone."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest

from rigapp.config.loading import read_rig
from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import PlantSection, RigFile
from rigapp.simulation import layout
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.disturbances import Interference, WiredSignals, terminals, wander
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant, Samples

Make = Callable[..., RigFile]
RATE_HZ = 96.0
UM_PER_V = 100.0
TURNING = Drive(layout.VELOCITY, 6.0, 6.0, 0.0, 48.0, 0.0)
RESTING = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 0.0)
HARSH = Path(__file__).parents[2] / "examples" / "harsh.toml"


def quiet(seconds: float, per_s: float = 1.0, rate_Hz: float = RATE_HZ) -> Samples:
    """Return samples of a rig whose signals are 0, turning ``per_s`` revolutions a second."""
    at = np.arange(round(seconds * rate_Hz)) / rate_Hz
    nothing = np.zeros_like(at)
    return Samples(
        0, per_s * at, nothing, nothing, nothing, nothing, nothing, at, np.empty((0, at.size)),
        None,  # type: ignore[arg-type]  # the truth is of no use here
    )  # fmt: skip


def seen(rig: RigFile, samples: Samples, rate_Hz: float = RATE_HZ) -> WiredSignals:
    return Interference(rig, 1).apply(terminals(samples, {}), samples, rate_Hz)


def test_by_default_nothing_is_added() -> None:
    before = msgspec.to_builtins(PlantSection())
    off = {name: 0.0 for name in before if name.startswith(("probe_wander_um", "touched_probe"))}
    assert {name: before[name] for name in off} == off
    assert PlantSection().clearance_error_um == PlantSection().cell_gain_error_percent == 0.0
    assert PlantSection().pin_mass_kg == PlantSection().cell_creep_percent == 0.0
    assert PlantSection().bushing_creep_um_per_decade == 0.0
    assert PlantSection().probe_temperature_um_per_K == (0.0, 0.0)


def test_a_probe_wanders_by_its_deviation_and_forgets_in_its_time(flawed: Make) -> None:
    rig = flawed(probe_wander_um=0.4, probe_wander_revolutions=20.0)
    probes = seen(rig, quiet(20_000.0, rate_Hz=1.0), 1.0).analog
    one, two = (UM_PER_V * probes[name] for name in ("probe_1", "probe_2"))
    assert np.std(one) == pytest.approx(0.4, rel=0.08)

    def correlation(lag: int) -> float:
        return float(np.corrcoef(one[:-lag], one[lag:])[0, 1])

    assert correlation(2) > 0.9
    assert 0.3 < correlation(10) < 0.9
    assert abs(correlation(60)) < 0.1
    assert abs(np.corrcoef(one, two)[0, 1]) < 0.15


def test_the_wandering_is_the_same_however_it_is_cut(flawed: Make) -> None:
    rig, whole = flawed(probe_wander_um=0.4, cell_creep_percent=1.0), quiet(100.0)
    whole = replace(whole, bridge_1=np.sin(whole.warm_s))
    together = seen(rig, whole).analog
    pieces = Interference(rig, 1)
    arrays = ("shaft_revolutions", "bridge_1", "bridge_2", "probe_1", "probe_2", "warm_s")
    parts = []
    for cut in np.array_split(np.arange(whole.warm_s.size), 37):
        part = replace(whole, **{name: getattr(whole, name)[cut] for name in arrays})
        parts.append(pieces.apply(terminals(part, {}), part, RATE_HZ).analog)
    for name in together:
        np.testing.assert_allclose(
            np.concatenate([one[name] for one in parts]), together[name], atol=1e-12
        )


def test_nothing_at_all_wanders_nowhere() -> None:
    assert wander(np.empty(0), np.uint64(1), 0).size == 0


def test_probes_follow_the_room_by_their_coefficient(flawed: Make) -> None:
    rig = flawed(probe_temperature_um_per_K=(0.8, -0.5), room_swing_K=2.0, room_swing_hours=1.0)
    probes = seen(rig, quiet(3600.0, rate_Hz=1.0), 1.0).analog
    quarter = 900
    assert UM_PER_V * probes["probe_1"][quarter] == pytest.approx(1.6, rel=1e-3)
    assert UM_PER_V * probes["probe_2"][quarter] == pytest.approx(-1.0, rel=1e-3)
    assert UM_PER_V * probes["probe_1"][2 * quarter] == pytest.approx(0.0, abs=1e-3)


def test_a_touched_probe_reads_more_from_then_on(flawed: Make) -> None:
    probes = seen(flawed(touched_probe_um=2.0, touched_at_revolution=50.0), quiet(100.0)).analog
    step = UM_PER_V * probes["probe_1"]
    assert step[: round(49.9 * RATE_HZ)].max() == 0.0
    np.testing.assert_allclose(step[round(50.1 * RATE_HZ) :], 2.0)
    assert np.all(probes["probe_2"] == 0.0)


def test_the_cell_creeps_to_its_part_of_a_lasting_load(flawed: Make) -> None:
    samples = quiet(1000.0)
    loaded = replace(samples, bridge_1=np.ones_like(samples.warm_s))
    rig = flawed(cell_creep_percent=0.2, cell_creep_time_s=100.0)
    bridge = seen(rig, loaded).analog["force_1"]
    assert bridge[0] == pytest.approx(1.0, abs=1e-5)
    after = bridge[round(100.0 * RATE_HZ)] - 1.0
    assert after == pytest.approx(0.002 * (1.0 - math.exp(-1.0)), rel=0.01)
    assert bridge[-1] == pytest.approx(1.002, rel=1e-6)


def plant_of(rig: RigFile, parameters: ParameterFile) -> Plant:
    return Plant(plant_constants(parameters, rig), sample_rate_Hz=960.0)


def test_the_pins_own_weight_turns_about_the_cell_and_is_no_force_of_the_follower(
    flawed: Make, parameters: ParameterFile
) -> None:
    readings, truths = [], []
    for mass in (0.0, 0.05):
        plant = plant_of(flawed(pin_mass_kg=mass), parameters)
        plant.bench(0.0, (0.0, 0.0))
        at = []
        for degrees in (0.0, 90.0, 180.0, 270.0):
            plant.turn_by_hand(math.radians(degrees))
            samples = plant.advance(20, Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 1e3))
            at.append((samples.bridge_1[-1], samples.bridge_2[-1]))
            truths.append((samples.truth.force_e1_N[-1], samples.truth.force_n1_N[-1]))
        readings.append(np.array(at))
    newtons = 200.0 * (readings[1] - readings[0])  # 200 N per mV/V, force on the pin
    weight = 0.05 * 9.80665
    # The crank's own axis is vertical at 90 degrees: the weight then presses inwards, along -e1.
    expected = weight * np.array([(0.0, -1.0), (-1.0, 0.0), (0.0, 1.0), (1.0, 0.0)])
    np.testing.assert_allclose(newtons, expected, atol=1e-6)
    np.testing.assert_allclose(truths, 0.0, atol=1e-9)


def test_a_gain_error_multiplies_what_the_cell_gives(
    flawed: Make, parameters: ParameterFile
) -> None:
    signals = []
    for error in (0.0, 2.0):
        plant = plant_of(flawed(cell_gain_error_percent=error), parameters)
        signals.append(plant.advance(2000, TURNING).bridge_2)
    np.testing.assert_allclose(signals[1], 1.02 * signals[0], rtol=1e-12)


def test_creep_and_clearance_are_seen_by_the_probes_and_are_no_wear(
    flawed: Make, parameters: ParameterFile
) -> None:
    def span_um(seconds: float, **flaws: float) -> tuple[float, float]:
        rig = flawed(**flaws, wear_coefficient_factor=0.0)
        plant = plant_of(rig, parameters)
        plant.advance(960, RESTING)
        plant.advance(round(seconds / plant.step_s), TURNING)
        samples = plant.advance(round(1.05 / plant.step_s), TURNING)
        seen_um = UM_PER_V * np.hypot(samples.probe_1, samples.probe_2)
        return float(np.mean(seen_um)), float(samples.truth.wear_depth_m[-1])

    plain, _ = span_um(600.0)
    wider, _ = span_um(600.0, clearance_error_um=20.0)
    assert wider - plain == pytest.approx(20.0, abs=0.1)
    creeping, depth = span_um(540.0, bushing_creep_um_per_decade=3.0)
    assert creeping - plain == pytest.approx(3.0, abs=0.05)  # 540 s and the first minute: a decade
    assert depth == 0.0


def test_the_example_has_every_switch_on() -> None:
    rig = read_rig(HARSH).record
    assert rig.simulation is not None
    usual = PlantSection()
    on = {
        name
        for name in usual.__struct_fields__
        if getattr(rig.simulation.plant, name) != getattr(usual, name)
    }
    assert on >= {
        "follower_mass_factor", "clearance_error_um", "cell_gain_error_percent",
        "cell_creep_percent", "pin_mass_kg", "probe_wander_um", "probe_temperature_um_per_K",
        "touched_probe_um", "bushing_creep_um_per_decade", "running_in_factor",
        "restitution",
    }  # fmt: skip
