"""Every key says what it means, and an editor is told of the same ranges as a reader."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.config.commented import commented
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import parse_rig, parse_test
from rigapp.config.meanings import KINDS, json_schema, meanings
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import keys_of
from rigapp.config.toml import toml_text
from rigapp.prepare.schemas import schema_text
from rigapp_drivers.registry import available_drivers, load_driver

EXAMPLES = Path(__file__).parents[2] / "examples"
READERS = {"rig": (parse_rig, "simulated.toml"), "test": (parse_test, "paper.toml")}


def tree_of_example(name: str) -> dict[str, Any]:
    return tomllib.loads((EXAMPLES / name).read_text("utf-8"))


def validator(kind: str) -> jsonschema.Draft7Validator:
    return jsonschema.Draft7Validator(json_schema(KINDS[kind]))


@pytest.mark.parametrize("kind", [*KINDS.values(), ParameterFile])
def test_every_key_has_a_meaning_and_none_is_left_over(kind: Any) -> None:
    assert set(meanings()[kind]) == {key.path for key in keys_of(kind)}
    assert all(words.endswith(".") for words in meanings()[kind].values())


@pytest.mark.parametrize("example", sorted(EXAMPLES.glob("*.toml")), ids=lambda one: one.stem)
def test_the_examples_are_what_their_schema_says(example: Path) -> None:
    tree = tree_of_example(example.name)
    kind = "rig" if "devices" in tree else "test" if "title" in tree else None
    if kind is not None:
        assert list(validator(kind).iter_errors(tree)) == []


def test_a_schema_knows_the_settings_of_each_driver() -> None:
    whole = json.loads(schema_text("rig"))
    jsonschema.Draft7Validator.check_schema(whole)
    checks = jsonschema.Draft7Validator(whole)
    tree = tree_of_example("simulated.toml")
    assert checks.is_valid(tree)
    tree["devices"]["drive"]["settings"]["address"] = 12
    (wrong,) = checks.iter_errors(tree)
    assert "address" in wrong.absolute_path or "12" in wrong.message
    device = whole["properties"]["devices"]["additionalProperties"]
    assert device["properties"]["driver"]["examples"] == sorted(available_drivers())


def number_keys() -> list[tuple[str, str]]:
    """Return kind and path of every number that stands in an example."""
    found = []
    for kind, (_, name) in READERS.items():
        tree = tree_of_example(name)
        for key in keys_of(KINDS[kind]):
            where: Any = tree
            for part in key.path.split("."):
                where = where.get(part) if isinstance(where, dict) else None
            if isinstance(where, int | float) and not isinstance(where, bool):
                found.append((kind, key.path))
    return found


@given(st.sampled_from(number_keys()), st.floats(-1e7, 1e7) | st.integers(-(10**7), 10**7))
def test_what_a_schema_refuses_is_refused_by_the_reader_too(
    place: tuple[str, str], value: float
) -> None:
    kind, path = place
    reader, name = READERS[kind]
    tree = tree_of_example(name)
    *way, last = path.split(".")
    section = tree
    for part in way:
        section = section[part]
    section[last] = value
    if validator(kind).is_valid(tree):
        return
    with pytest.raises(UnusableInput):
        reader(toml_text(tree), name)


@pytest.mark.parametrize(
    ("kind", "name"), [("rig", "simulated_channels.toml"), ("test", "steps.toml")]
)
def test_a_commented_file_means_what_was_stated(kind: str, name: str) -> None:
    tree = tree_of_example(name)
    settings = {
        device: load_driver(section["driver"]).settings
        for device, section in tree.get("devices", {}).items()
    }
    text = commented(KINDS[kind], tree, {}, settings)
    reader = READERS[kind][0]
    assert reader(text, name) == reader(toml_text(tree), name)
    for key in keys_of(KINDS[kind]):
        assert key.path.rsplit(".", 1)[-1] in text, key.path
    assert max(map(len, text.splitlines())) <= 100 + max(map(len, toml_text(tree).splitlines()))


def test_a_key_of_a_commented_file_can_be_taken_in_by_its_comment_mark() -> None:
    text = commented(KINDS["rig"], tree_of_example("simulated.toml"))
    changed = text.replace("# gear_ratio = 1.0", "gear_ratio = 1.0")
    assert changed != text
    assert parse_rig(changed, "rig.toml").spindle.gear_ratio == 1.0
