"""What the tests of bushing and wear share: the reference joint and its reference numbers."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from rigapp_model.bushing.ring import Ring
from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring

DATA = Path(__file__).parents[2] / "data"
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def ring() -> Ring:
    """Return the ring of the reference numbers."""
    return Ring(
        inner=0.010, outer=0.020, pin_radius=0.0095, youngs_modulus=500e6, poissons_ratio=0.38
    )


@pytest.fixture(scope="session")
def parameters() -> Parameters:
    """Return Table 1's mechanism with an outboard spring and the reference bushing."""
    return Parameters(
        Mechanism(
            crank_radius=0.0762,
            crank_mass=0.4045,
            crank_inertia=204e-6,
            follower_length=0.2032,
            follower_mass=0.8175,
            follower_inertia=5500e-6,
            slider_mass=5.54871,
            spring=Spring(525.0, 0.3174952),
        ),
        Joint(0.0095, 0.010, 0.020, 0.0131),
        Bushing(Material(500e6, 0.38), 2200.0, 5.05e-13),
        Material(206e9, 0.29),
    )


@pytest.fixture(scope="session")
def pressure_reference() -> np.ndarray:
    """Return angle (deg), exact pressure (MPa) and two meshes' for 110 N on 13.1 mm."""
    return np.loadtxt(DATA / "pressure_unworn.csv", delimiter=",", skiprows=2)


@pytest.fixture(scope="session")
def wear_reference() -> np.ndarray:
    """Return cycles, depth (mm), area (mm^2), the same on a coarser mesh, and the rigid pin's."""
    return np.loadtxt(DATA / "wear_constant_force.csv", delimiter=",", skiprows=2)
