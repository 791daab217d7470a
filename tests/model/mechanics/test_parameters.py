"""Parameters are refused in one clear sentence, and the file's units become SI."""

from __future__ import annotations

from pathlib import Path

import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_parameters
from rigapp_model.errors import ModelError
from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Spring

TABLE_1 = {
    "crank_radius": 0.0762,
    "crank_mass": 0.4045,
    "crank_inertia": 204e-6,
    "follower_length": 0.2032,
    "follower_mass": 0.8175,
    "follower_inertia": 5500e-6,
    "slider_mass": 5.54871,
}
JOINT = {
    "pin_radius": 9.5e-3,
    "bushing_radius": 10e-3,
    "bushing_outer_radius": 20e-3,
    "bushing_width": 13e-3,
}
FILE = """
schema = 1
[mechanism]
crank_radius_mm = 76.2
crank_mass_kg = 0.4045
crank_inertia_kg_m2 = 204e-6
follower_length_mm = 203.2
follower_mass_kg = 0.8175
follower_inertia_kg_m2 = 5500e-6
slider_mass_kg = 5.54871
added_mass_kg = 1.0
gravity_m_s2 = [0.0, -9.81]
[spring]
stiffness_N_per_m = 525.0
free_position_mm = 317.4952
[joint]
pin_radius_mm = 9.5
bushing_radius_mm = 10.0
bushing_outer_radius_mm = 20.0
bushing_width_mm = 13.1
friction_coefficient = 0.1
[bushing]
youngs_modulus_MPa = 500.0
poissons_ratio = 0.38
density_g_per_cm3 = 2.2
wear_coefficient_mm3_per_Nm = 5.05e-4
[pin]
youngs_modulus_MPa = 206000.0
poissons_ratio = 0.29
"""


@pytest.mark.parametrize(
    ("change", "quantity", "words"),
    [
        ({"follower_length": 0.07}, "follower_length", "longer than the crank radius of 0.0762 m"),
        ({"follower_length": 0.0762}, "follower_length", "cannot turn"),
        ({"crank_radius": 0.0}, "crank_radius", "greater than 0"),
        ({"crank_radius": float("nan")}, "crank_radius", "finite"),
        ({"slider_mass": -1.0}, "slider_mass", "slider mass is -1 kg: it must not be negative"),
        ({"follower_inertia": float("inf")}, "follower_inertia", "finite"),
        ({"crank_mass": True}, "crank_mass", "finite number"),
        ({"added_mass": "5"}, "added_mass", "finite number"),
        ({"gravity": (0.0, float("nan"))}, "gravity", "finite"),
        ({"gravity": (0.0,)}, "gravity", "two components"),
    ],
)
def test_mechanism_refusals(change: dict, quantity: str, words: str) -> None:
    with pytest.raises(ModelError, match=words) as caught:
        Mechanism(**(TABLE_1 | change))
    assert caught.value.quantity == quantity
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize(
    ("change", "quantity", "words"),
    [
        ({"pin_radius": 11e-3}, "pin_radius", "must fit the bushing of radius 0.01 m"),
        ({"bushing_outer_radius": 10e-3}, "bushing_outer_radius", "greater than the bushing"),
        ({"friction_coefficient": -0.1}, "friction_coefficient", "not be negative"),
        ({"bushing_width": 0.0}, "bushing_width", "greater than 0"),
    ],
)
def test_joint_refusals(change: dict, quantity: str, words: str) -> None:
    with pytest.raises(ModelError, match=words) as caught:
        Joint(**(JOINT | change))
    assert caught.value.quantity == quantity


@pytest.mark.parametrize("ratio", [-0.1, 0.5, 0.7, float("nan")])
def test_material_refusals(ratio: float) -> None:
    with pytest.raises(ModelError, match="poissons ratio"):
        Material(206e9, ratio)
    with pytest.raises(ModelError, match="youngs modulus"):
        Material(-1.0, 0.3)


def test_other_refusals() -> None:
    with pytest.raises(ModelError, match="stiffness is -1 N/m"):
        Spring(-1.0, 0.3)
    with pytest.raises(ModelError, match="density"):
        Bushing(Material(5e8, 0.38), 0.0, 1e-12)
    with pytest.raises(ModelError, match="wear coefficient"):
        Bushing(Material(5e8, 0.38), 2200.0, -1e-12)


def test_a_pin_may_fill_its_bushing() -> None:
    assert Joint(**(JOINT | {"pin_radius": 10e-3})).clearance == 0.0


def write(folder: Path, text: str) -> Path:
    path = folder / "params.toml"
    path.write_text(text)
    return path


def test_the_files_units_become_si(tmp_path: Path) -> None:
    p = read_parameters(write(tmp_path, FILE))
    assert p.mechanism.crank_radius == pytest.approx(0.0762)
    assert p.mechanism.follower_length == pytest.approx(0.2032)
    assert p.mechanism.crank_inertia == 204e-6
    assert p.mechanism.gravity == (0.0, -9.81)
    assert p.mechanism.moving_mass == pytest.approx(6.54871)
    assert p.mechanism.spring is not None
    assert p.mechanism.spring.stiffness == 525.0
    assert p.mechanism.spring.free_position == pytest.approx(0.3174952)
    assert p.joint.pin_radius == pytest.approx(9.5e-3)
    assert p.joint.clearance == pytest.approx(0.5e-3)
    assert p.joint.bushing_width == pytest.approx(13.1e-3)
    assert p.joint.friction_coefficient == 0.1
    assert p.bushing.material == Material(5e8, 0.38)
    assert p.bushing.density == pytest.approx(2200.0)
    assert p.bushing.wear_coefficient == pytest.approx(5.05e-13)
    assert p.pin == Material(206e9, 0.29)


def test_the_spring_is_optional(tmp_path: Path) -> None:
    text = FILE.replace("[spring]\nstiffness_N_per_m = 525.0\nfree_position_mm = 317.4952\n", "")
    assert read_parameters(write(tmp_path, text)).mechanism.spring is None


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        (
            "crank_radius_mm = 76.2",
            "crank_radius_mm = -76.2",
            "params.toml: mechanism.crank_radius_mm = -76.2 is outside 1 to 1000 mm.",
        ),
        ("follower_length_mm = 203.2", "follower_length_mm = 70", "cannot turn"),
        ("pin_radius_mm = 9.5", "pin_radius_mm = 10.5", "joint.pin_radius_mm = 10.5: the pin must"),
        ("stiffness_N_per_m = 525.0", "stiffness_N_per_m = -5", "spring.stiffness_N_per_m = -5"),
        ("poissons_ratio = 0.38", "poissons_ratio = 0.5", "bushing.poissons_ratio = 0.5"),
        ("poissons_ratio = 0.29", "poissons_ratio = nan", "pin.poissons_ratio = nan"),
        ("[0.0, -9.81]", "[0.0, inf]", "mechanism.gravity_m_s2 2 = inf is not a finite number"),
        ("density_g_per_cm3 = 2.2", "density_g_per_cm3 = 0", "bushing.density_g_per_cm3 = 0"),
        ("pin_radius_mm", "pin_radius_cm", "did you mean pin_radius_mm"),
        ("crank_mass_kg = 0.4045\n", "", "mechanism.crank_mass_kg is missing"),
    ],
)
def test_unusable_files_are_named(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    path = write(tmp_path, FILE.replace(old, new, 1))
    with pytest.raises(UnusableInput, match=sentence) as caught:
        read_parameters(path)
    assert str(path) in str(caught.value)
