"""What the plant's terminals see: sign, frame, delay, noise; standstill, reversal, seed."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import msgspec
import numpy as np
import pytest

from rigapp.config.parameters import ParameterFile, SpringSection
from rigapp.config.rig import PlantSection, RigFile
from rigapp.simulation import layout
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant, Samples

Flawed = Callable[..., RigFile]

COAST = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 0.0)
JAMMED = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 1000.0)


def velocity(speed: float, start: float | None = None) -> Drive:
    return Drive(layout.VELOCITY, speed if start is None else start, speed, 0.0, 48.0, 0.0)


def running(rig: RigFile, parameters: ParameterFile, speed: float = 2 * math.pi) -> Plant:
    delay = rig.simulation.plant.filter_delay_ms * 1e-3 if rig.simulation else 0.0
    plant = Plant(plant_constants(parameters, rig), filter_delay_s=delay)
    plant.advance(960, velocity(speed, 0.0))
    return plant


def test_load_cell_measures_the_force_on_the_pin_in_the_crank_frame(
    perfect_rig: RigFile, parameters: ParameterFile
) -> None:
    # Crank held at 90 degrees, e1 = +y and n1 = -x. The spring pulls the slider outwards (+x), so
    # the follower pulls the pin towards the wrist: along -n1, and a little along -e1.
    k = plant_constants(parameters, perfect_rig)
    plant = Plant(k, angle_rad=math.pi / 2)
    samples = plant.advance(10, JAMMED)
    length = 0.2032 + 0.5e-3
    sine = 0.0762 / length
    cosine = math.sqrt(1.0 - sine**2)
    pull = 525.0 * (0.3174952 - length * cosine)
    on_pin = (-pull * sine / cosine, -pull)
    assert 200.0 * samples.bridge_1[-1] == pytest.approx(on_pin[0], abs=1e-9)
    assert 200.0 * samples.bridge_2[-1] == pytest.approx(on_pin[1], abs=1e-9)
    assert samples.truth.force_e1_N[-1] == pytest.approx(-on_pin[0])
    assert samples.truth.force_n1_N[-1] == pytest.approx(-on_pin[1])


@pytest.mark.parametrize(("free_position_mm", "sign"), [(317.4952, -1.0), (80.0, 1.0)])
def test_probes_see_the_pin_at_the_loaded_wall(
    perfect_rig: RigFile, parameters: ParameterFile, free_position_mm: float, sign: float
) -> None:
    # Spring outboard: follower in tension, pin at -c along e2. Spring inboard: compression, +c.
    spring = SpringSection(525.0, free_position_mm)
    k = plant_constants(msgspec.structs.replace(parameters, spring=spring), perfect_rig)
    plant = Plant(k, angle_rad=1.0)
    samples = plant.advance(10, JAMMED)
    away = 500.0 + 1e6 * plant.approach_m(plant.state().joint_force_N)
    assert away > 505.0
    assert 100.0 * samples.probe_1[-1] == pytest.approx(sign * away, abs=0.1)
    assert 100.0 * samples.probe_2[-1] == pytest.approx(0.0, abs=0.1)


def test_friction_moves_the_contact_against_the_sense_of_turning(
    parameters: ParameterFile, flawed: Flawed
) -> None:
    rig = flawed(joint_friction_coefficient=0.1)
    for speed in (1.0, -1.0):
        k = plant_constants(parameters, rig)
        samples = running(rig, parameters, speed).advance(4000, velocity(speed))
        lean = math.copysign(500.0 * 0.1 / math.hypot(1.0, 0.1), speed)
        assert 100.0 * np.mean(samples.probe_2) == pytest.approx(lean, abs=4.0)
        assert k.joint_friction == pytest.approx(0.0995, abs=1e-4)


def test_wear_is_seen_by_the_probes(parameters: ParameterFile, flawed: Flawed) -> None:
    rig = flawed(wear_coefficient_factor=50.0)
    plant = running(rig, parameters)
    samples = plant.advance(30 * 960, velocity(2 * math.pi))
    depth_um = 1e6 * samples.truth.wear_depth_m
    assert depth_um[-1] > 30.0
    assert np.all(np.diff(depth_um) >= 0.0)
    distance = 100.0 * np.hypot(samples.probe_1, samples.probe_2)
    force = np.hypot(samples.truth.force_e1_N, samples.truth.force_n1_N)[-960:]
    approach_um = [1e6 * plant.approach_m(one) for one in force]
    np.testing.assert_allclose(distance[-960:], 500.0 + depth_um[-960:] + approach_um, atol=0.3)


def test_the_wear_coefficient_runs_in_and_changes_by_the_depth(
    parameters: ParameterFile, flawed: Flawed
) -> None:
    def depths(**laws: float) -> list[float]:
        plant = running(flawed(wear_coefficient_factor=50.0, **laws), parameters)
        found = []
        for _ in range(12):
            plant.advance(960, velocity(2 * math.pi))
            found.append(plant.state().wear_depth_m)
        return found

    usual = depths()
    early = depths(running_in_factor=3.0, running_in_depth_um=2.0)
    late = depths(wear_change_factor=2.0, wear_change_depth_um=1e6 * usual[5] - 0.01)
    assert early[0] > 1.5 * usual[0]
    assert early[-1] - early[-2] == pytest.approx(usual[-1] - usual[-2], rel=0.1)
    assert late[:6] == usual[:6]
    assert late[6] - late[5] == pytest.approx(2.0 * (usual[6] - usual[5]), rel=0.15)
    resumed = running(flawed(wear_change_factor=2.0, wear_change_depth_um=5.0), parameters)
    resumed.wear_to(6e-6)
    assert resumed.wear_coefficient == 2.0 * resumed.constants.wear_coefficient


def test_worn_plant_goes_on_like_one_that_wore_by_itself(
    parameters: ParameterFile, flawed: Flawed
) -> None:
    rig = flawed(wear_coefficient_factor=500.0)
    old = running(rig, parameters)
    turns = round(20.0 / old.step_s)
    old.advance(turns, velocity(2 * math.pi))
    worn = old.state()
    assert worn.wear_depth_m > 5e-6
    new = Plant(plant_constants(parameters, rig))
    new.wear_to(worn.wear_depth_m)
    assert new.state().wear_depth_m == worn.wear_depth_m
    assert new.state().worn_area_m2 == pytest.approx(worn.worn_area_m2, rel=0.1)
    new.wear_to(worn.wear_depth_m, worn.worn_area_m2)
    assert new.state().worn_area_m2 == worn.worn_area_m2
    assert new.state().time_s == 0.0
    new.advance(turns, velocity(2 * math.pi))
    old.advance(turns, velocity(2 * math.pi))
    grown = old.state().wear_depth_m - worn.wear_depth_m
    assert new.state().wear_depth_m - worn.wear_depth_m == pytest.approx(grown, rel=0.1)
    new.wear_to(0.0)
    assert (new.state().wear_depth_m, new.state().worn_area_m2) == (0.0, 0.0)
    for depth, area in ((-1e-6, None), (1.0, None), (math.nan, None), (1e-6, -1.0)):
        with pytest.raises(ValueError, match="is not possible"):
            new.wear_to(depth, area)


def test_shaft_counts_from_the_index_in_the_encoders_sense(
    rig: RigFile, parameters: ParameterFile
) -> None:
    turned = msgspec.structs.replace(rig.encoder, direction=-1, index_angle_deg=30.0)
    k = plant_constants(parameters, msgspec.structs.replace(rig, encoder=turned))
    samples = Plant(k, angle_rad=math.radians(120.0)).advance(2, JAMMED)
    assert samples.shaft_revolutions[0] == pytest.approx(-0.25)


def cut(plant: Plant, sizes: list[int]) -> Samples:
    parts = [plant.advance(size, velocity(2 * math.pi)) for size in sizes]
    names = ("shaft_revolutions", "bridge_1", "bridge_2", "probe_1", "probe_2")
    joined = {name: np.concatenate([getattr(p, name) for p in parts]) for name in names}
    return replace(parts[0], **joined)


@pytest.mark.parametrize("rate", [10.0, 960.0, 12000.0])
def test_samples_do_not_depend_on_chunks(
    rig: RigFile, parameters: ParameterFile, rate: float
) -> None:
    k = plant_constants(parameters, rig)
    whole = Plant(k, seed=7, filter_delay_s=1e-3, sample_rate_Hz=rate)
    pieces = Plant(k, seed=7, filter_delay_s=1e-3, sample_rate_Hz=rate)
    one = cut(whole, [3000])
    many = cut(pieces, [1, 2, 700, 3, 1000, 94, 1200])
    for name in ("shaft_revolutions", "bridge_1", "bridge_2", "probe_1", "probe_2"):
        np.testing.assert_array_equal(getattr(one, name), getattr(many, name))


def test_same_seed_same_noise_other_seed_other_noise(
    rig: RigFile, parameters: ParameterFile
) -> None:
    k = plant_constants(parameters, rig)
    first, again, other = (
        Plant(k, seed=seed).advance(500, velocity(3.0)).probe_1 for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert np.mean(first != other) > 0.99


def test_noise_resolution_and_drift_have_the_stated_size(
    parameters: ParameterFile, flawed: Flawed
) -> None:
    def held(**changes: float) -> Samples:
        rig = flawed(**changes)
        return Plant(plant_constants(parameters, rig), angle_rad=1.0).advance(40_000, JAMMED)

    quiet = held()
    noisy = held(force_noise_N=0.7, probe_noise_um=0.2)
    for name, scale, size in (("bridge_1", 200.0, 0.7), ("probe_2", 100.0, 0.2)):
        noise = scale * (getattr(noisy, name) - getattr(quiet, name))
        assert np.std(noise) == pytest.approx(size, rel=0.02)
        assert np.mean(noise) == pytest.approx(0.0, abs=4 * size / math.sqrt(noise.size))
        assert abs(np.mean(noise[1:] * noise[:-1])) < 4 * size**2 / math.sqrt(noise.size)
    assert abs(np.corrcoef(noisy.bridge_1, noisy.bridge_2)[0, 1]) < 0.02
    steps = 200.0 * held(force_resolution_N=2.0, force_noise_N=0.7).bridge_2 / 2.0
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-9)
    assert len(np.unique(np.round(steps))) > 1
    drift = 200.0 * (held(force_drift_N_per_hour=360.0).bridge_1 - quiet.bridge_1)
    assert drift[9600] - drift[0] == pytest.approx(1.0, abs=1e-6)


def test_cross_talk_is_that_of_the_true_cell(parameters: ParameterFile, flawed: Flawed) -> None:
    rig = flawed(cross_talk_percent=1.5)
    samples = Plant(plant_constants(parameters, rig), angle_rad=1.0).advance(5, JAMMED)
    true = -np.array([samples.truth.force_e1_N[-1], samples.truth.force_n1_N[-1]])
    believed = 200.0 * np.array([samples.bridge_1[-1], samples.bridge_2[-1]])
    np.testing.assert_allclose(np.array([[1, 0.015], [0.015, 1]]) @ believed, true, rtol=1e-12)
    assert abs(believed - true).max() > 0.2


@pytest.mark.sampled
@pytest.mark.parametrize("rate", [10.0, 960.0, 12000.0])
def test_analog_is_late_by_the_filter_delay_and_the_encoder_is_not(
    perfect_rig: RigFile, parameters: ParameterFile, rate: float
) -> None:
    k = plant_constants(parameters, perfect_rig)
    late = Plant(k, filter_delay_s=3e-3, sample_rate_Hz=rate)
    fine = Plant(k, sample_rate_Hz=12000.0)
    seen = late.advance(round(3.0 / late.step_s), velocity(6.0))
    exact = fine.advance(36_000, velocity(6.0))
    time = seen.truth.time_s
    settled = time > 0.5
    late_force = 200.0 * np.interp(time - 3e-3, exact.truth.time_s, exact.bridge_2)
    np.testing.assert_allclose(200.0 * seen.bridge_2[settled], late_force[settled], atol=0.1)
    angle = np.interp(time, exact.truth.time_s, exact.shaft_revolutions)
    np.testing.assert_allclose(seen.shaft_revolutions, angle, atol=1e-4)


def test_run_out_turns_with_the_pin_against_the_follower(
    perfect_rig: RigFile, parameters: ParameterFile, flawed: Flawed
) -> None:
    rig = flawed(pin_run_out_um=3.0)
    eccentric = running(rig, parameters).advance(960, velocity(2 * math.pi))
    round_pin = running(perfect_rig, parameters).advance(960, velocity(2 * math.pi))
    along = 100.0 * (eccentric.probe_1 - round_pin.probe_1)
    across = 100.0 * (eccentric.probe_2 - round_pin.probe_2)
    np.testing.assert_allclose(np.hypot(along, across), 3.0, atol=1e-6)
    turned = np.unwrap(np.arctan2(across, along))
    assert turned[-1] - turned[0] == pytest.approx(2 * math.pi, rel=0.03)


def test_starts_from_standstill_and_holds_speed(rig: RigFile, parameters: ParameterFile) -> None:
    plant = Plant(plant_constants(parameters, rig))
    still = plant.advance(960, COAST)
    assert np.ptp(still.shaft_revolutions) == 0.0
    plant.advance(960, velocity(6.0, 0.0))
    speed = plant.advance(1920, velocity(6.0)).truth.speed_rad_per_s
    assert np.mean(speed) == pytest.approx(6.0, rel=0.01)
    assert speed.min() > 5.5


def test_reverses_through_zero(rig: RigFile, parameters: ParameterFile) -> None:
    plant = running(rig, parameters)
    reversing = plant.advance(1920, velocity(-6.0, 6.0)).truth
    assert reversing.speed_rad_per_s[0] > 5.0
    assert reversing.speed_rad_per_s[-1] < -5.0
    assert np.all(np.isfinite(reversing.force_e1_N))
    # Backwards at the same speed the mechanism's force is the same; only friction changes side.
    back = plant.advance(960, velocity(-6.0)).truth
    assert np.hypot(back.force_e1_N, back.force_n1_N).max() == pytest.approx(86.0, abs=6.0)


def test_off_coasts_to_rest_and_stays(rig: RigFile, parameters: ParameterFile) -> None:
    plant = running(rig, parameters)
    plant.advance(60 * 960, COAST)
    rest = plant.advance(960, COAST)
    assert np.ptp(rest.shaft_revolutions) == 0.0
    assert plant.state().speed_rad_per_s == 0.0


def test_zero_duty_brakes_more_than_coasting(rig: RigFile, parameters: ParameterFile) -> None:
    brake = Drive(layout.DUTY, 0.0, 0.0, 0.0, 48.0, 0.0)
    ends = []
    for command in (brake, COAST):
        plant = running(rig, parameters)
        before = plant.state().angle_rad
        plant.advance(240, command)
        ends.append(plant.state().angle_rad - before)
    assert 0.0 < ends[0] < 0.8 * ends[1]


def test_torque_limit_and_supply_bound_the_motor(rig: RigFile, parameters: ParameterFile) -> None:
    plant = Plant(plant_constants(parameters, rig))
    plant.advance(1, velocity(70.0))
    assert plant.state().motor_torque_Nm == pytest.approx(6.0)
    full = Drive(layout.DUTY, 0.0, 0.0, 1.0, 24.0, 0.0)
    plant.advance(20 * 960, full)
    mean_speed = np.mean(plant.advance(960, full).truth.speed_rad_per_s)
    assert mean_speed == pytest.approx(24.0 / 0.573, rel=0.05)


def test_sample_rate_changes_on_the_run(rig: RigFile, parameters: ParameterFile) -> None:
    plant = running(rig, parameters)
    before = plant.state()
    plant.set_sample_rate(4800.0)
    samples = plant.advance(4800, velocity(2 * math.pi))
    assert samples.shaft_revolutions.size == 4800
    assert samples.first_sample == before.samples
    assert samples.truth.angle_rad[0] == before.angle_rad
    assert np.abs(np.diff(200 * samples.bridge_2)).max() < 10.0
    with pytest.raises(ValueError, match="not positive"):
        plant.set_sample_rate(0.0)


def test_speed_ripples_twice_a_turn_by_the_stated_amount(
    parameters: ParameterFile, flawed: Flawed
) -> None:
    free = msgspec.structs.replace(parameters, spring=None)
    plant = running(flawed(speed_ripple_percent=2.0), free, math.pi)
    truth = plant.advance(4 * 960, velocity(math.pi)).truth
    angle = truth.angle_rad
    second = np.column_stack([np.ones_like(angle), np.sin(2 * angle), np.cos(2 * angle)])
    fit, *_ = np.linalg.lstsq(second, truth.speed_rad_per_s / math.pi, rcond=None)
    assert math.hypot(fit[1], fit[2]) == pytest.approx(0.02, rel=0.15)


def test_factors_scale_slider_and_spring(parameters: ParameterFile, flawed: Flawed) -> None:
    heavier = plant_constants(parameters, flawed(slider_mass_factor=1.2))
    assert heavier.slider_mass == pytest.approx(1.2 * 5.54871)
    softer = Plant(plant_constants(parameters, flawed(spring_stiffness_factor=0.5)), angle_rad=2.0)
    stiff = Plant(plant_constants(parameters, flawed()), angle_rad=2.0)
    ratio = softer.advance(2, JAMMED).bridge_2[-1] / stiff.advance(2, JAMMED).bridge_2[-1]
    assert ratio == pytest.approx(0.5)


def test_added_mass_rides_on_the_slider(parameters: ParameterFile, perfect_rig: RigFile) -> None:
    loaded = msgspec.structs.replace(parameters.mechanism, added_mass_kg=2.0)
    k = plant_constants(msgspec.structs.replace(parameters, mechanism=loaded), perfect_rig)
    assert k.slider_mass == pytest.approx(7.54871)


def test_default_plant_differs_from_the_model_by_what_is_stated() -> None:
    assert PlantSection() == PlantSection(
        1.01, 0.985, 0.05, 1.1, 6.0, 0.5, 1.5, 0.7, 2.0, 0.2, 3.0, 0.2, 1.0
    )
