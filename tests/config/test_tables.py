"""One row of a table serves recipe, form, command line, prediction and report."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from rigapp.config.loading import read_parameter_file
from rigapp.config.ranges import unit_of
from rigapp.config.recipe import StopSection
from rigapp.gui.testfile.fields import form_fields
from rigapp.schema.channels import BASE
from rigapp.schema.columns import prediction_columns
from rigapp.schema.criteria import CRITERIA, Criterion, Sight
from rigapp.schema.verbs import VERBS, Priority, Verb, Who
from rigapp.service.bounds import parse_arguments
from rigapp.twin.link import TwinSetup
from rigapp.twin.worker import set_up
from rigapp_model.wear.techniques import SOLVABLE, TECHNIQUES

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"


def test_a_recipe_and_its_form_offer_the_joints_that_tell_forces_of_a_measured_revolution() -> None:
    field = next(one for one in form_fields() if one.path == "prediction.joint")
    assert field.choices == SOLVABLE
    assert all(TECHNIQUES[name].sentence in field.hint for name in SOLVABLE)
    assert set(SOLVABLE) < set(TECHNIQUES)


@pytest.mark.parametrize("joint", ["glued", "contact"])
def test_a_twin_takes_an_unknown_or_unsuitable_joint_for_no_other(joint: str) -> None:
    parameters = read_parameter_file(EXAMPLES / "parameters.toml").record
    twin, answer = set_up(TwinSetup(parameters, joint))
    assert twin is None
    assert answer.hopeless
    assert f"technique is {joint}: choose perfect or continuous" in answer.failed


COLUMNS = {
    Sight.CLOCK: {"time", "running_time"},
    Sight.ROW: {one.name for one in BASE.revolution_columns},
    Sight.PREDICTION: {one.name for one in prediction_columns()},
}


@pytest.mark.parametrize("criterion", CRITERIA.values(), ids=CRITERIA)
def test_a_criterion_has_keys_columns_and_a_row_of_the_manual(criterion: Criterion) -> None:
    keys = StopSection.__struct_fields__
    assert {criterion.key, criterion.count or criterion.key, criterion.window or criterion.key} <= {
        *keys
    }
    assert unit_of(f"stop.{criterion.key}")
    asked: set[str] = set()

    def at(name: str) -> float:
        asked.add(name)
        return 1.0

    assert criterion.value(at) > 0.0
    assert asked <= COLUMNS[criterion.sight]
    manual = (ROOT / "docs" / "rig.md").read_text(encoding="utf-8")
    row = next(line for line in manual.splitlines() if line.startswith(f"| `{criterion.key}` |"))
    assert row.endswith("| complete |" if criterion.planned else "| stopped |")
    assert all(f"`{key}`" in row for key in (criterion.count, criterion.window) if key) or (
        criterion.key == "deviation_percent"
    )


def test_every_level_of_the_section_is_a_criterion() -> None:
    levels = {one.name for one in msgspec.structs.fields(StopSection) if one.default is None}
    assert levels == set(CRITERIA)


@pytest.mark.parametrize("verb", VERBS.values(), ids=VERBS)
def test_a_verb_and_its_arguments_stand_in_the_manual(verb: Verb) -> None:
    manual = (ROOT / "docs" / "service.md").read_text(encoding="utf-8")
    rows = [line.split("|") for line in manual.splitlines() if line.startswith("| `")]
    row = next(cells for cells in rows if f"`{verb.name}`" in cells[1])
    assert {f"`{name}`" for name in verb.record.__struct_fields__} <= set(
        row[2].replace("(all without it)", "").replace(",", " ").split()
    )


@pytest.mark.parametrize("verb", VERBS.values(), ids=VERBS)
def test_what_makes_safe_is_asked_by_anyone_with_anything(verb: Verb) -> None:
    if verb.lane is Priority.SAFETY:
        asked = parse_arguments(verb, {"reason": 7, "key": ["x"], "other": [[[]]]})
        assert asked == verb.record()
        assert verb.urgent
    assert (verb.who is Who.ANYONE) or verb.name not in {"stop", "drive_off", "acknowledge"}
