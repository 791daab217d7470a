"""Bad numbers in rig and test files: each refused with file and key before a device is opened."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rigapp.cli import main
from rigapp.engine.engine import Engine
from rigapp.service import simulated

EXAMPLES = Path(__file__).parents[2] / "examples"

Run = Callable[..., tuple[int, str]]


@pytest.fixture
def rigapp(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str], tmp_path: Path
) -> Run:
    """Return the command line, in this process; opening a device fails the test."""

    def opened(*_: Any, **__: Any) -> None:
        pytest.fail("a device was opened")

    monkeypatch.setattr(Engine, "connect", opened)
    monkeypatch.setattr(simulated, "start_simulated_rig", opened)
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))

    def call(*arguments: str | Path) -> tuple[int, str]:
        monkeypatch.setattr(sys, "argv", ["rigapp", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            main()
        code = ended.value.code
        assert isinstance(code, int)
        return code, capfd.readouterr().err

    return call


def changed(name: str, old: str, new: str) -> str:
    text = (EXAMPLES / name).read_text(encoding="utf-8")
    assert f"\n{old}" in text
    return text.replace(f"\n{old}", f"\n{new}", 1)


def value(key: str, number: str) -> tuple[str, str]:
    """Return the line of a key in an example, and the line with another number."""
    for name in ("quick.toml", "simulated.toml"):
        for line in (EXAMPLES / name).read_text(encoding="utf-8").splitlines():
            if line.startswith(f"{key} = "):
                return line.partition("#")[0].rstrip(), f"{key} = {number}"
    raise KeyError(key)


LENGTHS = ("crank_radius_mm", "follower_length_mm", "pin_radius_mm", "bushing_width_mm")
MASSES = ("crank_mass_kg", "follower_mass_kg", "slider_mass_kg", "added_mass_kg")
NOT_FINITE = ("nan", "inf", "-inf")

MODEL = [
    *((key, "0.0", f"{key} = 0 is outside") for key in LENGTHS),
    *((key, "-5.0", f"{key} = -5 is outside") for key in LENGTHS),
    *((key, number, f"{key} = {number} is not") for key in LENGTHS[:2] for number in NOT_FINITE),
    *((key, "-0.1", f"{key} = -0.1 is outside 0 to") for key in MASSES),
    *((key, "nan", f"{key} = nan is not a finite number") for key in MASSES),
    ("slider_mass_kg", "5548.71", "did you mean g? Then write 5.54871"),
    ("crank_radius_mm", "0.0762", "did you mean m? Then write 76.2"),
    ("crank_inertia_kg_m2", "204.0", "did you mean kg mm^2? Then write 0.000204"),
    ("crank_inertia_kg_m2", "-1e-6", "mechanism.crank_inertia_kg_m2 = -1e-06 is outside"),
    ("crank_inertia_kg_m2", "1e300", "mechanism.crank_inertia_kg_m2 = 1e+300 is outside"),
    ("follower_inertia_kg_m2", "inf", "is not a finite number; allowed is 0 to 10 kg m^2"),
    ("follower_length_mm", "70.0", "follower_length_mm = 70.0: it must be longer than the crank"),
    ("gravity_m_s2", "[0.0, nan]", "mechanism.gravity_m_s2 2 = nan is not a finite number"),
    ("gravity_m_s2", "[inf, 0.0]", "mechanism.gravity_m_s2 1 = inf is not a finite number"),
    ("gravity_m_s2", "[0.0, -9810.0]", "did you mean mm/s^2? Then write -9.81"),
    ("gravity_m_s2", "[0.0]", "mechanism.gravity_m_s2"),
    ("gravity_m_s2", "[0.0, true]", "mechanism.gravity_m_s2"),
    ("stiffness_N_per_m", "-525.0", "spring.stiffness_N_per_m = -525 is outside"),
    ("stiffness_N_per_m", "nan", "spring.stiffness_N_per_m = nan is not a finite number"),
    ("free_position_mm", "inf", "spring.free_position_mm = inf is not a finite number"),
    ("pin_radius_mm", "10.5", "joint.pin_radius_mm = 10.5: the pin must fit the bushing"),
    ("bushing_radius_mm", "9.0", "joint.pin_radius_mm = 9.5: the pin must fit the bushing"),
    ("bushing_radius_mm", "0.01", "joint.bushing_radius_mm = 0.01 is outside"),
    ("bushing_outer_radius_mm", "8.0", "bushing_outer_radius_mm = 8.0: it must be greater than"),
    ("bushing_outer_radius_mm", "10.0", "bushing_outer_radius_mm = 10.0: it must be greater than"),
    ("bushing_outer_radius_mm", "nan", "joint.bushing_outer_radius_mm = nan is not"),
    ("friction_coefficient", "-0.1", "joint.friction_coefficient = -0.1 is outside 0 to 2"),
    ("friction_coefficient", "inf", "joint.friction_coefficient = inf is not a finite number"),
    ("friction_coefficient", "50.0", "joint.friction_coefficient = 50 is outside 0 to 2"),
    ("youngs_modulus_MPa", "0.0", "bushing.youngs_modulus_MPa = 0 is outside"),
    ("youngs_modulus_MPa", "-500.0", "bushing.youngs_modulus_MPa = -500 is outside"),
    ("youngs_modulus_MPa", "1e300", "bushing.youngs_modulus_MPa = 1e+300 is outside"),
    ("youngs_modulus_MPa", "500e6", "did you mean Pa? Then write 500"),
    ("youngs_modulus_MPa", "nan", "bushing.youngs_modulus_MPa = nan is not a finite number"),
    ("poissons_ratio", "0.6", "bushing.poissons_ratio = 0.6 is outside 0 to 0.499"),
    ("poissons_ratio", "0.5", "bushing.poissons_ratio = 0.5 is outside 0 to 0.499"),
    ("poissons_ratio", "-0.1", "bushing.poissons_ratio = -0.1 is outside 0 to 0.499"),
    ("poissons_ratio", "inf", "bushing.poissons_ratio = inf is not a finite number"),
    ("density_g_per_cm3", "0.0", "bushing.density_g_per_cm3 = 0 is outside"),
    ("density_g_per_cm3", "2200.0", "did you mean kg/m^3? Then write 2.2"),
    ("density_g_per_cm3", "nan", "bushing.density_g_per_cm3 = nan is not a finite number"),
    ("wear_coefficient_mm3_per_Nm", "-5e-4", "wear_coefficient_mm3_per_Nm = -0.0005 is outside"),
    ("wear_coefficient_mm3_per_Nm", "nan", "wear_coefficient_mm3_per_Nm = nan is not a finite"),
    ("wear_coefficient_mm3_per_Nm", "505.0", "wear_coefficient_mm3_per_Nm = 505 is outside 0 to 1"),
    ("crank_mass_kg", "true", "model.mechanism.crank_mass_kg: expected a number, got true or"),
    ("crank_mass_kg", f"1{'0' * 400}", "model.mechanism.crank_mass_kg"),
]  # fmt: skip
"""Key of [model], a number, what the sentence says."""

RECIPE = [
    ("revolutions", "0", "run.revolutions = 0 is outside 1 to 100000000 revolutions"),
    ("revolutions", "true", "run.revolutions: expected an integer, got true or false"),
    ("speed_rpm", "inf", "run.speed_rpm = inf is not a finite number"),
    ("speed_rpm", "1e300", "run.speed_rpm = 1e+300 is outside 0.1 to 3000 rpm"),
    ("acceleration_rpm_per_s", "nan", "run.acceleration_rpm_per_s = nan is not a finite number"),
    ("overload_N", "1e300", "limits.overload_N = 1e+300 is outside 1 to 10000 N"),
    ("overload_N", "inf", "limits.overload_N = inf is not a finite number; allowed is 1 to 10000"),
    ("overload_N", "0.38", "did you mean kN? Then write 380"),
    ("overload_N", "5000.0", "limits.overload_N = 5000 is never reached"),
    ("overspeed_rpm", "1e300", "limits.overspeed_rpm = 1e+300 is outside"),
    ("overspeed_rpm", "nan", "limits.overspeed_rpm = nan is not a finite number"),
    ("stale_data_s", "inf", "limits.stale_data_s = inf is not a finite number"),
    ("stale_data_s", "2000.0", "limits.stale_data_s = 2000 is outside 0.05 to 60 s; did you mean"),
    ("stale_data_s", "true", "limits.stale_data_s: expected a number, got true or false"),
    ("every_revolutions", "-1", "cycles.every_revolutions = -1 is outside"),
]  # fmt: skip

RULES = [
    ('quantity = "force_mx"\ncritical_above = 9.0', "did you mean force_max"),
    ('quantity = "force_max"', "no level is given"),
    ('quantity = "force_max"\ncritical_above = inf', "critical_above = inf is not a finite number"),
    ('quantity = "force_max"\ncritical_above = 1e300', "1e+300 is outside -10000 to 10000 N"),
    ('quantity = "speed"\nwarning_above = 1e6', "warning_above = 1000000 is outside 0 to 5000 rpm"),
    ('quantity = "force_max"\nwarning_above = 9.0\ncritical_above = 9.0', "must lie beyond"),
    ('quantity = "force_max"\nwarning_above = 9.0\nhysteresis = inf', "hysteresis = inf is not"),
    ('quantity = "force_max"\nwarning_above = 9.0\ndelay_revolutions = 0', "delay_revolutions"),
    (
        'quantity = "force_max"\ncritical_above = 9.0\naction_critical = "none"',
        "action_critical = 'none' would have no effect at critical_above = 9",
    ),
]

CELL_MATRIX = "matrix_N_per_mV_per_V"
RIG = [
    *(("index_angle_deg", n, f"encoder.index_angle_deg = {n} is not") for n in NOT_FINITE),
    ("index_angle_deg", "1e9", "encoder.index_angle_deg = 1000000000 is outside -360 to 360 deg"),
    ("latency_ms", "[-1.0, 1.0]", "load_cell.latency_ms 1 = -1 is outside 0 to 100 ms"),
    ("latency_ms", "[1.0, inf]", "load_cell.latency_ms 2 = inf is not a finite number"),
    ("maximum_speed_rpm", "inf", "spindle.maximum_speed_rpm = inf is not a finite number"),
    ("maximum_speed_rpm", "0.0", "spindle.maximum_speed_rpm = 0 is outside"),
    ("maximum_speed_rpm", "40.0", "run.speed_rpm = 60 is above the rig's spindle.maximum_speed"),
    ("full_scale_N", "inf", "load_cell.full_scale_N = inf is not a finite number"),
    ("full_scale_N", "-400.0", "load_cell.full_scale_N = -400 is outside"),
    ("resolution_N", "500.0", "load_cell.resolution_N = 500 is not below load_cell.full_scale_N"),
    ("watchdog_timeout_s", "inf", "spindle.watchdog_timeout_s = inf is not a finite number"),
    ("watchdog_timeout_s", "500.0", "spindle.watchdog_timeout_s = 500 is outside 0.05 to 25.5 s"),
    ("watchdog_timeout_s", "0.06", "a watchdog time-out of 0.06 s is outside 0.1 to 25.5 s"),
    ("sensitivity_um_per_V", "[0.0, 100.0]", "probes.sensitivity_um_per_V 1 = 0 is outside"),
    ("sensitivity_um_per_V", "[100.0, nan]", "probes.sensitivity_um_per_V 2 = nan is not"),
    ("offset_V", "[inf, 0.0]", "probes.offset_V 1 = inf is not a finite number"),
    ("range_V", "-10.0", "probes.range_V = -10 is outside"),
    ("range_V", "12.0", "probes.input_1 = 'analog_3': analog_3: a range of 12 V is not there"),
    ("range_mV_per_V", "3.0", "load_cell.input_1 = 'analog_1': analog_1: a range of 3 mV/V"),
    (CELL_MATRIX, "[[200.0, 0.0], [400.0, 0.0]]", f"{CELL_MATRIX} = [[200.0, 0.0], [400.0"),
    (CELL_MATRIX, "[[200.0, 0.0], [0.0, nan]]", f"load_cell.{CELL_MATRIX} 2 2 = nan is not"),
    ("zero_mV_per_V", "[4.0, 0.0]", "zero_mV_per_V 1 = 4 is not within load_cell.range_mV_per_V"),
    ("input_1", '"analog_9"', "load_cell.input_1 = 'analog_9': the device has no input"),
    ("input_2", '"counter_1"', "encoder.input and load_cell.input_2 both name 'counter_1'"),
    ("input", '"counter_7"', "encoder.input = 'counter_7': the device has no input"),
    ("input", '"analog_5"', "encoder.input = 'analog_5': analog_5 cannot be a \"counter\""),
    ("counts_per_revolution", "0", "encoder.counts_per_revolution = 0 is outside 1 to"),
    ("encoder_counts_per_revolution", "-3600", "spindle.encoder_counts_per_revolution = -3600"),
    ("sample_rate_Hz", "inf", "[devices.daq.settings] sample_rate_Hz: inf is not a finite number"),
    ("sample_rate_Hz", "961.0", "sample_rate_Hz = 961 is not a rate of this device"),
    ("driver", '"gsv9"', "devices.daq.driver: There is no driver \"gsv9\" (did you mean \"gsv8\""),
    ("speed", "inf", "simulation.speed = inf is not a finite number"),
    ("seed", "-1", "simulation.seed = -1 is outside"),
]  # fmt: skip


def refused(rigapp: Run, tmp_path: Path, rig: str, test: str, culprit: str, words: str) -> None:
    """Expect the same refusal of `check` and `run`: status 2, one sentence, no device opened."""
    rig_path, test_path = tmp_path / "rig.toml", tmp_path / "test.toml"
    rig_path.write_text(rig, encoding="utf-8")
    test_path.write_text(test, encoding="utf-8")
    status, sentence = rigapp("run", test_path, "--rig", rig_path, "--out", tmp_path / "out.h5")
    assert words in sentence
    assert f"{tmp_path / culprit}: " in sentence
    assert "Traceback" not in sentence
    assert sentence.count("\n") == 1
    assert status == 2
    assert not (tmp_path / "out.h5").exists()
    if "is never reached" in words or "above the rig's" in words:
        return  # a good test on another rig: a line of the table, after the devices were looked at
    assert rigapp("check", rig_path, test_path) == (2, sentence)


@pytest.mark.parametrize(("key", "number", "words"), [*MODEL, *RECIPE])
def test_a_number_of_a_test(rigapp: Run, tmp_path: Path, key: str, number: str, words: str) -> None:
    test = changed("quick.toml", *value(key, number))
    rig = (EXAMPLES / "simulated.toml").read_text("utf-8")
    refused(rigapp, tmp_path, rig, test, "test.toml", words)


@pytest.mark.parametrize(("rule", "words"), RULES)
def test_a_rule_of_a_test(rigapp: Run, tmp_path: Path, rule: str, words: str) -> None:
    test = changed("quick.toml", "[prediction]", f"[[limits.rule]]\n{rule}\n\n[prediction]")
    rig = (EXAMPLES / "simulated.toml").read_text("utf-8")
    refused(rigapp, tmp_path, rig, test, "test.toml", words)


@pytest.mark.parametrize(("key", "number", "words"), RIG)
def test_a_number_of_a_rig(rigapp: Run, tmp_path: Path, key: str, number: str, words: str) -> None:
    rig = changed("simulated.toml", *value(key, number))
    test = (EXAMPLES / "quick.toml").read_text("utf-8")
    culprit = "test.toml" if "above the rig's" in words else "rig.toml"
    refused(rigapp, tmp_path, rig, test, culprit, words)


@pytest.mark.parametrize(("key", "number", "words"), MODEL)
def test_a_number_of_a_parameter_file(
    rigapp: Run, tmp_path: Path, key: str, number: str, words: str
) -> None:
    text = changed("parameters.toml", *value(key, number))
    path, table = tmp_path / "parameters.toml", tmp_path / "forces.csv"
    path.write_text(text, encoding="utf-8")
    status, sentence = rigapp("model", "forces", path, "--rpm", "60", "--to", table)
    assert words.removeprefix("model.") in sentence
    assert status == 2
    assert not table.exists()


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("", "--out: '.' names no file; give the name of a file."),
        ("é" * 120 + ".h5", "has 243 bytes, 239 at most; shorten it."),
        ("a" * 300, "has 300 bytes, 239 at most; shorten it."),
        ("folder/" * 600 + "a.h5", "bytes, 4000 at most; choose a folder nearer to the root."),
        ("a\x1b[2J\nb.h5", "holds the character '\\x1b'; take it out."),
    ],
)
def test_a_name_that_no_file_can_have(rigapp: Run, tmp_path: Path, name: str, words: str) -> None:
    out = str(tmp_path / name) if name else ""
    test, rig = EXAMPLES / "quick.toml", EXAMPLES / "simulated.toml"
    status, sentence = rigapp("run", test, "--rig", rig, "--out", out)
    assert status == 2
    assert words in sentence
    assert sentence.count("\n") == 1
    for verb in (
        ("report", "x.h5"),
        ("export", "x.h5"),
        ("model", "forces", "p.toml", "--rpm", "9"),
    ):
        status, sentence = rigapp(*verb, "--to", out)
        assert status == 2
        assert words.replace("--out", "--to") in sentence


@pytest.mark.parametrize("name", ["a" * 300, "folder/" * 600 + "a.h5"])
def test_a_name_that_no_file_has(rigapp: Run, name: str) -> None:
    rig = EXAMPLES / "simulated.toml"
    for verb in (("info", name), ("resume", name, "--rig", rig), ("check", rig, name)):
        status, sentence = rigapp(*verb)
        assert status == 2
        assert sentence.count("\n") == 1
        assert len(sentence) < 200
