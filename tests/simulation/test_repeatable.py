"""The same seed gives the same test, however long the rig stood before it was started."""

from __future__ import annotations

import numpy as np

from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import RigFile
from rigapp.simulation import layout
from rigapp.simulation.constants import plant_constants
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant, Samples

STANDING = Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 0.0)
TURNING = Drive(layout.VELOCITY, 0.0, 3.0, 0.0, 48.0, 0.0)
ANALOG = ("bridge_1", "bridge_2", "probe_1", "probe_2")


def started_after(rig: RigFile, parameters: ParameterFile, steps: int) -> tuple[Plant, Samples]:
    """Let the rig stand for a number of steps, then turn; return plant and samples of turning."""
    plant = Plant(plant_constants(parameters, rig), seed=7)
    plant.advance(steps, STANDING)
    return plant, plant.advance(2000, TURNING)


def test_the_time_before_the_start_changes_nothing(rig: RigFile, parameters: ParameterFile) -> None:
    _, soon = started_after(rig, parameters, 960)
    _, late = started_after(rig, parameters, 7 * 960)
    shaft = soon.shaft_revolutions
    np.testing.assert_array_equal(shaft, late.shaft_revolutions)
    moving = int(np.flatnonzero(np.diff(shaft))[0]) + 1
    assert moving < 1000
    for name in ANALOG:
        one, other = getattr(soon, name)[moving:], getattr(late, name)[moving:]
        np.testing.assert_array_equal(one, other, err_msg=name)
    assert late.first_sample - soon.first_sample == 6 * 960


def test_noise_is_not_repeated_after_a_stop(rig: RigFile, parameters: ParameterFile) -> None:
    plant, first = started_after(rig, parameters, 960)
    while plant.speed_rad_per_s != 0.0:
        plant.advance(960, Drive(layout.OFF, 0.0, 0.0, 0.0, 48.0, 50.0))
    plant.advance(960, STANDING)
    second = plant.advance(2000, TURNING)
    for name in ANALOG:
        one, two = getattr(first, name), getattr(second, name)
        assert np.mean(one[:200] == two[:200]) < 0.5, name
