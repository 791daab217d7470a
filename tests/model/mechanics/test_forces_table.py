"""`rigapp model forces`: the columns that users script against, and what is refused."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import numpy as np
import pytest

from rigapp.commands import progress as model_progress
from rigapp.commands.model.cycle import COLUMNS
from rigapp.commands.model.forces import CONTACT_COLUMNS, Impacting, write_forces
from rigapp.config.errors import UnusableInput
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.parameters import Mechanism, Spring

PARAMETERS = """
schema = 1
[mechanism]
crank_radius_mm = 76.2
crank_mass_kg = 0.4045
crank_inertia_kg_m2 = 204e-6
follower_length_mm = 203.2
follower_mass_kg = 0.8175
follower_inertia_kg_m2 = 5500e-6
slider_mass_kg = 5.54871
[spring]
stiffness_N_per_m = 525.0
free_position_mm = 317.4952
[joint]
pin_radius_mm = 9.5
bushing_radius_mm = 10.0
bushing_outer_radius_mm = 20.0
bushing_width_mm = 13.1
[bushing]
youngs_modulus_MPa = 500.0
poissons_ratio = 0.38
density_g_per_cm3 = 2.2
wear_coefficient_mm3_per_Nm = 5.05e-4
[pin]
youngs_modulus_MPa = 206000.0
poissons_ratio = 0.29
"""
SPRING = PARAMETERS[PARAMETERS.index("[spring]") : PARAMETERS.index("[joint]")]
MECHANISM = Mechanism(
    0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871, spring=Spring(525.0, 0.3174952)
)


@pytest.fixture
def params(tmp_path: Path) -> Path:
    path = tmp_path / "params.toml"
    path.write_text(PARAMETERS)
    return path


def read(path: Path) -> dict[str, np.ndarray]:
    header = path.read_text().splitlines()[0].split(",")
    return dict(zip(header, np.loadtxt(path, delimiter=",", skiprows=1).T, strict=True))


def test_the_perfect_joint(params: Path, tmp_path: Path) -> None:
    target = tmp_path / "forces.csv"
    assert write_forces(params, 30.0, "perfect", None, 360, target) == 0
    table = read(target)
    assert tuple(table) == COLUMNS
    np.testing.assert_array_equal(table["crank_angle_deg"], np.arange(360.0))
    motion = inverse_dynamics(MECHANISM, np.deg2rad(np.arange(360.0)), np.pi)
    expected = {
        "fx_N": motion.force[0],
        "fy_N": motion.force[1],
        "f_N": motion.force_magnitude,
        "fx_crank_N": motion.force_crank[0],
        "fy_crank_N": motion.force_crank[1],
        "fx_follower_N": motion.force_follower[0],
        "fy_follower_N": motion.force_follower[1],
        "torque_Nm": motion.drive_torque,
        "slider_position_mm": 1e3 * motion.slider_position,
        "slider_velocity_m_per_s": motion.slider_velocity,
        "slider_acceleration_m_per_s2": motion.slider_acceleration,
    }
    for name, values in expected.items():
        np.testing.assert_allclose(table[name], values, rtol=1e-12, atol=1e-13, err_msg=name)
    assert table["slip_mm"].sum() == pytest.approx(2.0 * np.pi * 9.5, rel=1e-12)


def test_continuous_contact_takes_the_files_clearance_or_the_given_one(
    params: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own, given, none = (tmp_path / f"{n}.csv" for n in ("own", "given", "none"))
    write_forces(params, 30.0, "continuous", None, 720, own)
    write_forces(params, 30.0, "continuous", 1.0, 720, given)
    write_forces(params, 30.0, "continuous", 0.0, 720, none)
    perfect = inverse_dynamics(MECHANISM, np.deg2rad(np.arange(0.0, 360.0, 0.5)), np.pi)
    for path, gap in ((own, 0.5), (given, 1.0), (none, 0.0)):
        table = read(path)
        assert len(table["f_N"]) == 720
        change = table["slider_position_mm"][0] - 1e3 * perfect.slider_position[0]
        assert change == pytest.approx(gap, abs=1e-9)
    assert capsys.readouterr().err == ""


def test_a_failing_assumption_is_said_on_stderr(
    params: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    params.write_text(PARAMETERS.replace(SPRING, ""))
    assert write_forces(params, 30.0, "continuous", None, 360, tmp_path / "a.csv") == 0
    error = capsys.readouterr().err
    assert "71.7 to 288.3 deg" in error
    assert "compression" in error


@pytest.mark.parametrize("rpm", [30.0, -30.0])
def test_contact_has_three_more_columns(params: Path, tmp_path: Path, rpm: float) -> None:
    target = tmp_path / "contact.csv"
    write_forces(params, rpm, "contact", None, 360, target)
    table = read(target)
    assert tuple(table) == COLUMNS + CONTACT_COLUMNS
    speed = rpm * np.pi / 30.0
    other = inverse_dynamics(MECHANISM, np.deg2rad(np.arange(360.0)), speed, clearance=0.5e-3)
    assert np.abs(table["f_N"] - other.force_magnitude).max() < 0.05
    assert np.abs(table["slider_velocity_m_per_s"] - other.slider_velocity).max() < 1e-3
    assert np.abs(table["torque_Nm"] - other.drive_torque).max() < 0.01
    assert (table["contact"] == 1.0).all()
    assert 5.0 < table["penetration_um"].min() < table["penetration_um"].max() < 20.0
    assert np.abs(table["contact_angle_deg"]).max() < 0.5
    assert table["slip_mm"].sum() == pytest.approx(2.0 * np.pi * 9.5, rel=1e-4)
    np.testing.assert_allclose(table["slip_mm"], 1e3 * other.slip_increments(9.5e-3), rtol=2e-3)


def test_lost_contact_shows_in_the_columns(
    params: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    params.write_text(PARAMETERS.replace(SPRING, ""))
    target = tmp_path / "contact.csv"
    write_forces(params, 30.0, "contact", None, 3600, target)
    table = read(target)
    assert set(table["contact"]) == {0.0, 1.0}
    away = table["contact"] == 0.0
    assert (table["penetration_um"][away] == 0.0).all()
    assert (table["f_N"][away] == 0.0).all()
    assert np.ptp(table["contact_angle_deg"]) > 180.0
    assert "In contact" in capsys.readouterr().out


def test_a_contact_too_deep_for_its_law_is_said(
    params: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sphere = Impacting(contact_law="flores")
    write_forces(params, 30.0, "contact", 0.01, 360, tmp_path / "a.csv", sphere)
    assert "the contact law flores does not hold beyond 10 um" in capsys.readouterr().err
    write_forces(params, 30.0, "contact", 0.5, 360, tmp_path / "a.csv")
    assert capsys.readouterr().err == ""


def test_an_earlier_table_is_replaced_whole(params: Path, tmp_path: Path) -> None:
    target = tmp_path / "forces.csv"
    target.write_text("old\n" * 1000)
    write_forces(params, 30.0, "perfect", None, 8, target)
    assert len(target.read_text().splitlines()) == 9
    assert sorted(p.name for p in tmp_path.iterdir()) == ["forces.csv", "params.toml"]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"rpm": 0.0}, "--rpm 0"),
        ({"rpm": float("nan")}, "--rpm nan"),
        ({"joint": "loose"}, "perfect, continuous, contact"),
        ({"points": 3}, "--points 3"),
        ({"clearance_mm": -0.1, "joint": "continuous"}, "--clearance-mm -0.1"),
        ({"clearance_mm": 0.5}, "no meaning for a perfect joint"),
        ({"clearance_mm": 50.0, "joint": "continuous"}, r"params.toml with --clearance-mm 50"),
        ({"clearance_mm": 0.0, "joint": "contact"}, "params.toml: clearance is 0 m"),
        ({"target": Path("forces.txt")}, "ends with .csv"),
        ({"target": Path("nowhere/forces.csv")}, "folder does not exist"),
    ],
)
def test_refusals(params: Path, tmp_path: Path, changes: dict, words: str) -> None:
    arguments = {
        "params_path": params,
        "rpm": 30.0,
        "joint": "perfect",
        "clearance_mm": None,
        "points": 360,
        "target": tmp_path / "out.csv",
    } | changes
    arguments["target"] = tmp_path / arguments["target"]
    with pytest.raises(UnusableInput, match=words):
        write_forces(**arguments)
    assert not (tmp_path / "out.csv").exists()


def test_the_parameter_file_is_never_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "params.csv"
    path.write_text(PARAMETERS)
    with pytest.raises(UnusableInput, match="is the parameter file"):
        write_forces(path, 30.0, "perfect", None, 360, path)
    assert path.read_text() == PARAMETERS


def test_means_stand_beside_one_sample(params: Path, tmp_path: Path, capsys) -> None:  # type: ignore[no-untyped-def]
    params.write_text(PARAMETERS.replace(SPRING, ""))
    target = tmp_path / "a.csv"
    assert write_forces(params, 30.0, "contact", None, 36, target) == 0
    printed = capsys.readouterr()
    assert "this curve is one sample of it" in printed.err
    assert "--revolutions N gives means" in printed.err
    assert list(read(target)) == [*COLUMNS, *CONTACT_COLUMNS]
    assert write_forces(params, 30.0, "contact", None, 36, target, Impacting(6)) == 0
    printed = capsys.readouterr()
    assert "Over 6 revolutions (mean +/- standard error): in contact" in printed.out
    assert "this curve is one sample of it" in printed.err
    table = read(target)
    assert list(table)[: len(COLUMNS) + len(CONTACT_COLUMNS)] == [*COLUMNS, *CONTACT_COLUMNS]
    mean, error = table["f_N_mean"], table["f_N_standard_error"]
    assert np.all(error >= 0.0)
    assert np.abs(table["f_N"] - mean).max() > 3.0 * np.median(error)
    assert np.all((table["contact_mean"] >= 0.0) & (table["contact_mean"] <= 1.0))
    for name in ("fx_N", "fy_crank_N", "fx_follower_N", "torque_Nm"):
        assert {f"{name}_mean", f"{name}_standard_error"} <= set(table)


def test_a_time_limit_leaves_the_revolutions_that_are_done(
    params: Path,
    tmp_path: Path,
    capsys,
    monkeypatch,  # type: ignore[no-untyped-def]
) -> None:
    target = tmp_path / "a.csv"
    # Each look at the clock finds a second gone.
    clock = itertools.count()
    monkeypatch.setattr(model_progress, "monotonic", lambda: float(next(clock)))
    options = Impacting(50, time_limit_s=8.0)
    assert write_forces(params, 30.0, "contact", None, 36, target, options) == 1
    assert "--time-limit-s 8: over after 7 of 50 revolutions" in capsys.readouterr().err
    assert len(read(target)["f_N_mean"]) == 36
    other = tmp_path / "b.csv"
    options = Impacting(50, time_limit_s=0.5)
    assert write_forces(params, 30.0, "contact", None, 36, other, options) == 1
    assert "over before the first revolution" in capsys.readouterr().err
    assert not other.exists()


@pytest.mark.parametrize(
    ("joint", "options", "words"),
    [
        ("perfect", Impacting(10), "--revolutions has no meaning for --joint perfect"),
        ("continuous", Impacting(tolerance=1e-6), "--tolerance has no meaning for --joint cont"),
        ("contact", Impacting(1), "--revolutions 1: give 2 to"),
        ("perfect", Impacting(contact_law="liu"), "--contact-law has no meaning for --joint perf"),
        ("continuous", Impacting(restitution=0.5), "--restitution has no meaning for --joint co"),
        ("contact", Impacting(contact_law="hertz"), "--contact-law hertz: choose elements, pere"),
        ("contact", Impacting(restitution=1.5), "--restitution 1.5: it must not exceed 1"),
        ("contact", Impacting(tolerance=1.0), "--tolerance 1: give 1e-12 to 0.1"),
        ("contact", Impacting(time_limit_s=-1.0), "--time-limit-s -1: give a finite time above 0"),
    ],
)
def test_options_without_meaning_are_refused(
    params: Path, tmp_path: Path, joint: str, options: Impacting, words: str
) -> None:
    with pytest.raises(UnusableInput, match=words):
        write_forces(params, 30.0, joint, None, 36, tmp_path / "a.csv", options)


def test_law_and_restitution_are_keys_of_the_file_and_options(
    params: Path, tmp_path: Path, capsys
) -> None:  # type: ignore[no-untyped-def]
    target = tmp_path / "a.csv"

    def deepest(options: Impacting | None = None) -> tuple[float, str]:
        assert write_forces(params, 30.0, "contact", None, 36, target, options) == 0
        return float(read(target)["penetration_um"].max()), capsys.readouterr().err

    assert deepest() == (pytest.approx(17.5, abs=0.1), "")
    depth, words = deepest(Impacting(contact_law="lankarani-nikravesh", restitution=0.5))
    assert depth == pytest.approx(43.2, abs=0.3)
    assert "gives a restitution of 0.73 where 0.50 is set" in words
    keys = 'contact_law = "pereira"\nrestitution = 0.95\n[bushing]'
    params.write_text(PARAMETERS.replace("[bushing]", keys))
    assert deepest() == (pytest.approx(20.55, abs=0.2), "")
    assert deepest(Impacting(contact_law="liu"))[0] == pytest.approx(41.2, abs=0.4)
    params.write_text(PARAMETERS.replace("[bushing]", 'contact_law = "hertz"\n[bushing]'))
    with pytest.raises(UnusableInput, match=r"contact_law.*elements"):
        write_forces(params, 30.0, "contact", None, 36, target)


def test_numerical_noise_is_said(params: Path, tmp_path: Path, capsys) -> None:  # type: ignore[no-untyped-def]
    target = tmp_path / "a.csv"
    assert write_forces(params, 30.0, "contact", None, 360, target) == 0
    assert capsys.readouterr().err == ""
    fine = read(target)
    assert write_forces(params, 30.0, "contact", None, 360, target, Impacting(tolerance=0.01)) == 0
    words = capsys.readouterr().err
    found = re.search(r"leaves numerical noise of (\S+) N RMS in a force of", words)
    coarse = read(target)
    apart = np.hypot(coarse["fx_N"] - fine["fx_N"], coarse["fy_N"] - fine["fy_N"])
    assert found is not None, words
    assert float(found[1]) == pytest.approx(np.sqrt(np.mean(apart**2)), rel=0.06)
    params.write_text(PARAMETERS.replace(SPRING, ""))
    write_forces(params, 30.0, "contact", None, 36, target, Impacting(tolerance=1e-3))
    assert "cannot be told from the motion" in capsys.readouterr().err


def test_a_crank_too_slow_to_integrate_is_refused_at_once(params: Path, tmp_path: Path) -> None:
    with pytest.raises(UnusableInput, match=r"would swing .* use the technique continuous"):
        write_forces(params, 0.001, "contact", None, 36, tmp_path / "a.csv")


@pytest.mark.long
def test_friction_that_does_not_act_is_said(params: Path, tmp_path: Path, capsys) -> None:  # type: ignore[no-untyped-def]
    params.write_text(PARAMETERS.replace("[bushing]", "friction_coefficient = 0.1\n[bushing]"))
    write_forces(params, 0.5, "contact", None, 36, tmp_path / "a.csv")
    assert "friction acts in full only from 1 mm/s on" in capsys.readouterr().err
