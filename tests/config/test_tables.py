"""One row of a table serves recipe, form, command line, prediction and report."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from model.wear.techniques import SOLVABLE, TECHNIQUES
from rigapp.config.loading import read_parameter_file
from rigapp.gui.testfile.fields import form_fields
from rigapp.twin.worker import TwinSetup, set_up

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_a_recipe_and_its_form_offer_the_joints_that_tell_forces_of_a_measured_revolution() -> None:
    field = next(one for one in form_fields() if one.path == "prediction.joint")
    assert field.choices == SOLVABLE
    assert set(SOLVABLE) < set(TECHNIQUES)


@pytest.mark.parametrize("joint", ["glued", "contact"])
def test_a_twin_takes_an_unknown_or_unsuitable_joint_for_no_other(joint: str) -> None:
    parameters = read_parameter_file(EXAMPLES / "parameters.toml").record
    twin, answer = set_up(msgspec.msgpack.encode(TwinSetup(parameters, joint)))
    assert twin is None
    assert answer.hopeless
    assert f"technique is {joint}: choose perfect or continuous" in answer.failed
