"""What a study computes of a point: what the model's own commands compute; a failure has words."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from study.studies import EXAMPLES, PRESSURE, written
from twin.recorded_plants import RECORDED, record

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_parameters
from rigapp.study.points import Batch, StudyRow, computed
from rigapp.study.running import read_study
from rigapp_model.bushing.ring import pressure_distribution, ring_of
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.wear.life import life

PARAMETERS = read_parameters(EXAMPLES / "parameters.toml")
SPEED = 30.0 * np.pi / 30.0


def rows(folder: Path, text: str) -> list[StudyRow]:
    """Return the rows of a study, computed here."""
    study = read_study(written(folder, text))
    known = study.template
    return computed(Batch(known.kind, known.parameters, known.run, study.design.points))


def test_forces_are_those_of_the_mechanism(tmp_path: Path) -> None:
    text = (
        'schema = 1\nkind = "forces"\nparameters = "parameters.toml"\n[run]\nrpm = 30.0\n'
        '[vary]\n"run.rpm" = [30.0, 60.0]\n'
    )
    slow, fast = rows(tmp_path, text)
    angle = 2.0 * np.pi / 360 * np.arange(360)
    for row, speed in ((slow, SPEED), (fast, 2.0 * SPEED)):
        motion = inverse_dynamics(PARAMETERS.mechanism, angle, speed)
        assert row.numbers["force_max_N"] == pytest.approx(float(motion.force_magnitude.max()))
        assert row.numbers["torque_max_Nm"] == pytest.approx(float(abs(motion.drive_torque).max()))


def test_pressure_is_that_of_one_contact(tmp_path: Path) -> None:
    text = PRESSURE.partition("[vary]")[0]
    (row,) = rows(tmp_path, text)
    ring = ring_of(PARAMETERS.joint, PARAMETERS.bushing.material)
    found = pressure_distribution(ring, (100.0 / PARAMETERS.joint.bushing_width, 0.0))
    assert row.numbers["peak_pressure_MPa"] == pytest.approx(1e-6 * float(found.pressure.max()))


def test_a_life_is_that_of_the_model(tmp_path: Path) -> None:
    text = (
        'schema = 1\nkind = "life"\nparameters = "parameters.toml"\n'
        "[run]\nrpm = 30.0\ncycles = 2000\n"
        '[vary]\n"run.joint" = ["perfect", "continuous"]\n'
    )
    for row, joint in zip(rows(tmp_path, text), ("perfect", "continuous"), strict=True):
        found = life(PARAMETERS, SPEED, 2000.0, joint, 0.01, rows=(2000.0,))
        assert row.numbers["max_depth_mm"] == pytest.approx(1e3 * float(found.max_depth[-1]))
        assert row.numbers["tolerance_met"] == 1.0


@pytest.mark.long
def test_a_virtual_test_tells_its_coefficient_and_a_seed_gives_the_same(tmp_path: Path) -> None:
    text = (
        'schema = 1\nkind = "simulate"\nparameters = "parameters.toml"\n'
        "[run]\nrpm = 30.0\nrevolutions = 1500\n"
        '[vary]\n"run.coefficient_factor" = [1.0, 4.0]\n[design]\nrepeats = 2\n'
    )
    found = rows(tmp_path, text)
    assert found == rows(tmp_path, text)
    coefficients = [row.numbers["wear_coefficient_mm3_per_Nm"] for row in found]
    assert len(set(coefficients)) == 4
    true = 1e9 * PARAMETERS.bushing.wear_coefficient
    np.testing.assert_allclose(coefficients, true * np.array([1, 1, 4, 4]), rtol=0.25)
    assert "seen_revolution" not in found[0].numbers or found[0].numbers["covered"] == 0.0
    assert all(row.numbers["seen_revolution"] <= 1500 for row in found[2:])


@pytest.mark.long
def test_recorded_tests_are_points_too(tmp_path: Path) -> None:
    record(tmp_path / "first.h5", 1.1, RECORDED)
    (tmp_path / "broken.h5").write_bytes(b"none")
    text = (
        'schema = 1\nkind = "identify"\n[run]\nfiles = ["*.h5"]\n'
        '[vary]\n"run.after_revolution" = [60, 0]\n'
    )
    found = rows(tmp_path, text)
    assert "not an HDF5 file" in found[0].problem
    known = [row.numbers["wear_coefficient_mm3_per_Nm"] for row in found if not row.problem]
    assert len(known) == 2
    assert known[0] != known[1]


def test_a_point_that_cannot_be_is_a_row_with_its_sentence(tmp_path: Path) -> None:
    text = PRESSURE.partition("[vary]")[0] + '[vary]\n"joint.bushing_radius_mm" = [9.0, 10.0]\n'
    bad, good = rows(tmp_path, text)
    assert good.numbers
    assert not good.problem
    assert not bad.numbers
    assert "the pin must fit the bushing of radius 0.009 m" in bad.problem


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('kind = "pressure"', 'kind = "presure"', "choose one of forces, pressure"),
        ('"joint.bushing_radius_mm"', '"joint.bushing_radius"', "is not a known key"),
        ('"run.force_N"', '"run.force"', "is not a known key"),
        ("force_N = 100.0", "force = 100.0", "force"),
        ("force_N = 100.0", "", "force_N is missing"),
        ('parameters = "parameters.toml"', "", "parameters are missing"),
        ('"parameters.toml"', '"none.toml"', "none.toml"),
        ("points = 64", "points = 0", "points"),
        ('kind = "sobol"', 'kind = "random"', "random"),
        ("low = 9.6", "low = 11.0", "low = 11 must be below 10.5"),
        ("{ low = 9.6, high = 10.5 }", '["wide"]', "bushing_radius_mm"),
    ],
)
def test_a_wrong_study_file_is_refused_with_its_key(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    assert old in PRESSURE
    with pytest.raises(UnusableInput, match=words) as refused:
        read_study(written(tmp_path, PRESSURE.replace(old, new, 1)))
    assert str(tmp_path) in str(refused.value)


def test_what_the_single_command_says_about_a_life_stands_beside_it(tmp_path: Path) -> None:
    text = (
        'schema = 1\nkind = "life"\nparameters = "parameters.toml"\n'
        "[run]\nrpm = 30.0\ncycles = 2000\ntolerance = 0.1\n"
        '[vary]\n"run.joint" = ["contact", "continuous"]\n'
    )
    for row, joint in zip(rows(tmp_path, text), ("contact", "continuous"), strict=True):
        found = life(PARAMETERS, SPEED, 2000.0, joint, 0.1)
        assert row.notes == " ".join(map(str, found.notes))
