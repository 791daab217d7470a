"""Shared set-up: the simulated rig of the examples, with and without its imperfections."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest

from rigapp.config.loading import read_rig
from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import PlantSection, RigFile, SimulationSection
from rigapp.simulation.constants import packaged_parameters

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"

PERFECT = PlantSection(
    slider_mass_factor=1.0,
    spring_stiffness_factor=1.0,
    joint_friction_coefficient=0.0,
    wear_coefficient_factor=0.0,
    motor_torque_limit_Nm=1000.0,
    speed_ripple_percent=0.0,
    cross_talk_percent=0.0,
    force_noise_N=0.0,
    force_resolution_N=0.0,
    force_drift_N_per_hour=0.0,
    pin_run_out_um=0.0,
    probe_noise_um=0.0,
    filter_delay_ms=0.0,
)


@pytest.fixture(scope="session")
def rig_path() -> Path:
    return EXAMPLES / "simulated.toml"


@pytest.fixture(scope="session")
def rig(rig_path: Path) -> RigFile:
    return read_rig(rig_path).record


@pytest.fixture(scope="session")
def perfect_rig(rig: RigFile) -> RigFile:
    return with_plant(rig, PERFECT)


@pytest.fixture(scope="session")
def parameters() -> ParameterFile:
    return packaged_parameters()


@pytest.fixture(scope="session")
def flawed(rig: RigFile) -> Callable[..., RigFile]:
    """Return a maker of rigs that are perfect but for the named flaws of [simulation.plant]."""

    def make(**flaws: float) -> RigFile:
        return with_plant(rig, msgspec.structs.replace(PERFECT, **flaws))

    return make


def with_plant(rig: RigFile, plant: PlantSection) -> RigFile:
    return msgspec.structs.replace(rig, simulation=SimulationSection(plant=plant))
