"""What the form does to the file: comments stay, nothing is lost without a question."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from patience import PATIENCE_MS
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLineEdit

from rigapp.config.loading import read_test
from rigapp.gui.testfile.fields import form_fields
from rigapp.gui.testfile.recipe import RecipePanel
from rigapp.gui.testfile.selected_test import edited
from rigapp.gui.testfile.unsaved import listed
from rigapp.schema.messages import RunState

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def panel(qtbot: Any, qapp: Any, tmp_path: Path) -> RecipePanel:
    path = tmp_path / "quick.toml"
    path.write_text((EXAMPLES / "quick.toml").read_text(encoding="utf-8"), encoding="utf-8")
    panel = RecipePanel()
    qtbot.addWidget(panel)
    panel.open_file(path)
    return panel


def type_into(panel: RecipePanel, path: str, text: str) -> None:
    editor = panel.form.editors[path]
    assert isinstance(editor, QLineEdit)
    editor.setText(text)
    editor.textEdited.emit(text)


def test_a_saved_file_keeps_comments_order_and_untouched_numbers(panel: RecipePanel) -> None:
    assert panel.path is not None
    before = panel.path.read_text(encoding="utf-8").splitlines()
    type_into(panel, "limits.overspeed_rpm", "80")
    type_into(panel, "run.speed_rpm", "45")
    panel.buttons["save"].click()
    after = panel.path.read_text(encoding="utf-8").splitlines()
    assert len(after) == len(before)
    changed = [line for old, line in zip(before, after, strict=True) if old != line]
    assert len(changed) == 2
    assert changed[0] == "speed_rpm = 45.0"
    assert changed[1].startswith("overspeed_rpm = 80.0")
    assert changed[1].endswith("# speed above it: drive off")
    assert "crank_inertia_kg_m2 = 204e-6" in after


def test_a_file_saved_unchanged_is_the_same_bytes(panel: RecipePanel, tmp_path: Path) -> None:
    assert panel.path is not None
    assert panel.save(tmp_path / "copy.toml")
    assert (tmp_path / "copy.toml").read_bytes() == (EXAMPLES / "quick.toml").read_bytes()


def test_stop_criteria_and_cycles_around_alarms_are_edited(panel: RecipePanel) -> None:
    assert panel.path is not None
    for path, text in (
        ("stop.wear_depth_um", "250"),
        ("stop.wear_depth_revolutions", "30"),
        ("stop.force_N", "150"),
        ("cycles.before_alarm", "7"),
    ):
        type_into(panel, path, text)
    panel.buttons["save"].click()
    test = read_test(panel.path).record
    assert (test.stop.wear_depth_um, test.stop.wear_depth_revolutions) == (250.0, 30)
    assert test.stop.force_N == 150.0
    assert test.stop.deviation_N is None
    assert test.cycles.before_alarm == 7
    type_into(panel, "stop.force_N", "")
    panel.buttons["save"].click()
    assert read_test(panel.path).record.stop.force_N is None
    type_into(panel, "stop.force_N", "500")
    assert "can never be met" in panel.verdict.text()


def test_fields_of_stop_criteria_have_units_ranges_and_say_when_they_are_off(
    panel: RecipePanel,
) -> None:
    fields = {field.path: field for field in form_fields() if field.section == "stop"}
    assert fields["stop.wear_rate_um_per_1000_revolutions"].unit == "µm per 1000 rev"
    for field in fields.values():
        assert field.unit, field.path
        assert "None" not in field.hint
    editor = panel.form.editors["stop.elapsed_time_h"]
    assert isinstance(editor, QLineEdit)
    assert editor.placeholderText() == "off"
    type_into(panel, "stop.wear_depth_um", "-3")
    assert "outside 0.1 to" in panel.verdict.text()


def test_opening_another_file_asks_by_the_names_of_what_is_lost(
    panel: RecipePanel, qtbot: Any
) -> None:
    panel.show()
    type_into(panel, "run.speed_rpm", "45")
    bar = panel.unsaved_bar
    panel.open_wanted(EXAMPLES / "paper.toml")
    assert bar.isVisible()
    assert "run.speed_rpm: 60 → 45" in bar.text.text()
    assert "opening paper.toml" in bar.text.text()
    assert bar.discard.text() == "Discard 1 change"
    qtbot.keyClick(bar, Qt.Key.Key_Escape)
    assert not bar.isVisible()
    assert panel.path is not None
    assert panel.path.name == "quick.toml"
    first = panel.path
    panel.open_wanted(EXAMPLES / "paper.toml")
    bar.save.click()
    assert read_test(first).record.run.speed_rpm == 45.0
    assert panel.path.name == "paper.toml"
    type_into(panel, "title", "other")
    panel.open_wanted(first)
    bar.discard.click()
    assert panel.path == first
    assert panel.unsaved() == []


def test_what_cannot_be_read_is_not_lost_in_silence(panel: RecipePanel) -> None:
    panel.show()
    type_into(panel, "run.revolutions", "many")
    panel.open_wanted(EXAMPLES / "paper.toml")
    assert panel.unsaved_bar.isVisible()
    panel.unsaved_bar.save.click()
    assert panel.unsaved_bar.isVisible()
    assert panel.path is not None
    assert panel.path.name == "quick.toml"


def test_a_file_that_another_program_changed_is_not_overwritten(panel: RecipePanel) -> None:
    assert panel.path is not None
    theirs = panel.path.read_text(encoding="utf-8").replace("Quick test", "Their test")
    panel.path.write_text(theirs, encoding="utf-8")
    type_into(panel, "run.speed_rpm", "45")
    panel.buttons["save"].click()
    assert "changed by another program" in panel.verdict.text()
    assert panel.path.read_text(encoding="utf-8") == theirs


def test_new_and_duplicate_have_no_file_until_they_are_saved(
    panel: RecipePanel, tmp_path: Path
) -> None:
    panel.buttons["new"].click()
    assert (panel.path, panel.selected) == (None, None)
    assert "Revolutions is missing" in panel.verdict.text()
    assert panel.unsaved() == []  # nothing typed, nothing lost
    type_into(panel, "run.revolutions", "20")
    type_into(panel, "run.speed_rpm", "37,5")
    type_into(panel, "limits.overspeed_rpm", "90")
    assert panel.test is not None
    assert panel.save(tmp_path / "mine.toml")
    assert read_test(tmp_path / "mine.toml").record.run.speed_rpm == 37.5
    panel.buttons["duplicate"].click()
    assert panel.selected is None
    assert panel.unsaved() == ["title:  → (copy)"]
    assert panel.save(tmp_path / "other.toml")
    other = read_test(tmp_path / "other.toml").record
    assert (other.title, other.run.revolutions) == ("(copy)", 20)
    assert read_test(tmp_path / "mine.toml").record.title == ""


def test_a_start_means_the_file_and_shows_what_differs(
    window: Any, engine: Any, attach: Callable[[], None], qtbot: Any, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text((EXAMPLES / "quick.toml").read_text(encoding="utf-8"), encoding="utf-8")
    recipe, card = window.tabs.prepare.recipe, window.start_bar
    recipe.open_file(path)
    engine.say(count=0, curves=False, state=RunState.READY, file="", test="")
    attach()
    assert window.controls.test.whole == "mine.toml, selected"
    engine.say(count=0, curves=False, state=RunState.STOPPED, file="", test="The one before")
    attach()
    assert window.controls.test.whole == "mine.toml, selected"
    engine.say(count=0, curves=False, state=RunState.READY, file="", test="")
    attach()
    type_into(recipe, "run.speed_rpm", "45")
    window.controls.buttons["start"].click()
    assert "mine.toml starts as it is saved" in card.message.text()
    assert "run.speed_rpm: 60 → 45" in card.message.text()
    path.write_text(path.read_text("utf-8").replace("= 500", "= 700", 1), "utf-8")
    card.go.click()
    assert card.isVisible()
    assert engine.verbs == []
    assert "run.revolutions: 500 → 700" in card.message.text()
    card.read.click()
    assert recipe.unsaved_bar.isVisibleTo(recipe)  # the typed speed would be lost
    recipe.unsaved_bar.discard.click()
    assert recipe.test.run.revolutions == 700
    assert card.go.isEnabled()
    card.go.click()
    qtbot.waitUntil(lambda: "start" in engine.verbs, timeout=PATIENCE_MS)
    assert engine.requests[-1][1]["test"] == str(path)


def test_closing_the_window_asks_for_unsaved_changes(
    window: Any, engine: Any, attach: Callable[[], None], qtbot: Any, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text((EXAMPLES / "quick.toml").read_text(encoding="utf-8"), encoding="utf-8")
    engine.say(count=0, curves=False, state=RunState.READY, file="")
    attach()
    window.start()
    recipe = window.tabs.prepare.recipe
    recipe.open_file(path)
    type_into(recipe, "run.speed_rpm", "45")
    window.close()
    assert window.isVisible()
    assert window.tabs.prepare.isVisible()
    assert "run.speed_rpm: 60 → 45" in recipe.unsaved_bar.text.text()
    recipe.unsaved_bar.discard.click()
    qtbot.waitUntil(lambda: not window.isVisible(), timeout=PATIENCE_MS)
    assert read_test(path).record.run.speed_rpm == 60.0


def test_many_changes_are_counted() -> None:
    assert listed(["a"]) == "a."
    assert listed(list("abcdef")) == "a; b; c; d; and 2 more."


KEYS = st.sampled_from(["a", "b", "c"])
VALUES = st.one_of(
    st.integers(-9, 9), st.booleans(), st.text("xy\"'#=[", max_size=4), st.lists(st.integers(0, 9))
)
TREES = st.dictionaries(
    KEYS, st.one_of(VALUES, st.dictionaries(KEYS, VALUES, min_size=1)), max_size=3
)


@pytest.mark.parametrize("below", ["", "\n[prediction]\nenabled = false\n"])
@pytest.mark.parametrize("known", [0, 1])
def test_a_new_table_of_an_array_stands_between_empty_lines(below: str, known: int) -> None:
    text = "[limits]\noverload_N = 380\n" + known * "\n[[limits.rule]]\nquantity = 1\n" + below
    tree = tomllib.loads(text)
    tree["limits"]["rule"] = [*tree["limits"].get("rule", []), {"quantity": 2}]
    found = edited(text, tree)
    assert tomllib.loads(found) == tree
    assert "\n\n[[limits.rule]]\nquantity = 2\n" in found
    assert "\n\n\n" not in found
    assert not below or found.endswith(below)


@given(TREES, TREES)
def test_an_edited_text_means_the_tree(before: dict[str, Any], after: dict[str, Any]) -> None:
    text = edited("# first\n", before)
    assert tomllib.loads(text) == before
    again = tomllib.loads(edited(text, after))
    assert {key: value for key, value in again.items() if value != {}} == after
    assert edited(text, tomllib.loads(text)) == text


@pytest.mark.parametrize(
    "text", ["spring = {a = 1, b = 2}\nz = 1\n", "run.speed = 1.0\nrun.n = 2\n"]
)
def test_other_ways_to_write_tables_are_edited_too(text: str) -> None:
    tree = tomllib.loads(text)
    next(table for table in tree.values() if isinstance(table, dict))["b"] = 7
    tree["run2"] = {"x": 1}
    assert tomllib.loads(edited(text, tree)) == tree
