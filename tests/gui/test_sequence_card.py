"""The steps of a test in the form: made, changed, moved and taken out, the file as one reads it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from PySide6.QtWidgets import QLineEdit

from rigapp.config.loading import read_test
from rigapp.config.recipe import LimitRule
from rigapp.gui.testfile.recipe import RecipePanel

EXAMPLES = Path(__file__).parents[2] / "examples"
STEPS = """
# first slowly
[[run.step]]
name = "running in"
revolutions = 100
speed_rpm = 30.0                    # half of it
acceleration_rpm_per_s = 10.0

[[run.step]]
duration_s = 60.0
rest_s = 20.0

"""


def test_file(path: Path, steps: str) -> Path:
    head, found, rest = (EXAMPLES / "quick.toml").read_text("utf-8").partition("[metadata]")
    path.write_text(f"{head}{steps}{found}{rest}", encoding="utf-8")
    return path


test_file.__test__ = False  # type: ignore[attr-defined]


@pytest.fixture
def panel(qtbot: Any, qapp: Any, tmp_path: Path) -> RecipePanel:
    panel = RecipePanel()
    qtbot.addWidget(panel)
    panel.open_file(test_file(tmp_path / "steps.toml", STEPS))
    return panel


def type_into(line: QLineEdit, text: str) -> None:
    line.setText(text)
    line.textEdited.emit(text)


def test_steps_are_shown_with_their_revolutions_and_kept_as_they_are_written(
    panel: RecipePanel, tmp_path: Path
) -> None:
    assert panel.unsaved() == []
    first, second = panel.sequence.rows
    assert (first.name.text(), first.length.text(), first.speed_rpm.text()) == (
        "running in", "100", "30",
    )  # fmt: skip
    assert second.kind.currentData() == "duration_s"
    assert second.rest_s.text() == "20"
    assert first.note.text() == "revolutions 1 to 100, ramp 10 rpm/s"
    assert second.note.text() == "revolutions 101 to 160, ramp 60 rpm/s"
    assert panel.steps.buttons[1].words.whole == "500 in 2 steps"
    assert panel.save(tmp_path / "copy.toml")
    assert (tmp_path / "copy.toml").read_bytes() == (tmp_path / "steps.toml").read_bytes()


def test_a_step_is_changed_added_moved_and_taken_out(panel: RecipePanel) -> None:
    assert panel.path is not None
    type_into(panel.sequence.rows[0].speed_rpm, "45")
    panel.sequence.add.click()
    assert panel.test is None
    new = panel.sequence.rows[2]
    assert "how many revolutions" in new.note.text()
    assert not panel.buttons["save"].isEnabled()
    type_into(new.length, "7")
    type_into(new.name, "slow")
    new.sooner.click()
    panel.buttons["save"].click()
    run = read_test(panel.path).record.run
    assert [one.name for one in run.step] == ["running in", "slow", ""]
    assert [one.speed_rpm for one in run.step] == [45.0, None, None]
    assert run.step[0].acceleration_rpm_per_s == 10.0
    assert run.step[1].revolutions == 7
    assert "# first slowly" in panel.path.read_text("utf-8")
    for line in list(panel.sequence.rows):
        line.remove.click()
    panel.buttons["save"].click()
    assert read_test(panel.path).record.run.step == ()
    assert not panel.sequence.none.isHidden()


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("field", "text", "said"),
    [
        ("length", "2.5", "integer"),
        ("length", "0", "1 to"),
        ("speed_rpm", "fast", "number in place of 'fast'"),
        ("speed_rpm", "4000", "3000"),
        ("rest_s", "-1", "0 to"),
    ],
)
def test_what_is_wrong_stands_at_the_step(
    panel: RecipePanel, field: str, text: str, said: str
) -> None:
    type_into(getattr(panel.sequence.rows[0], field), text)
    assert said in panel.sequence.rows[0].note.text()
    assert panel.test is None
    assert "1 of the steps" in panel.verdict.text() or said in panel.verdict.text()


def test_the_step_of_a_limit_stays_when_the_limit_is_edited(
    qtbot: Any, qapp: Any, tmp_path: Path
) -> None:
    rule = (
        '[[limits.rule]]\nquantity = "force_max"\nwarning_above = 90.0\ncritical_above = 95.0\n'
        "steps = [2]\n\n"
    )
    panel = RecipePanel()
    qtbot.addWidget(panel)
    head, found, rest = (
        test_file(tmp_path / "t.toml", STEPS).read_text("utf-8").partition("[prediction]")
    )
    (tmp_path / "t.toml").write_text(f"{head}{rule}{found}{rest}", "utf-8")
    panel.open_file(tmp_path / "t.toml")
    assert panel.unsaved() == []
    line = panel.rules.rows[1]
    type_into(line.revolutions, "3")
    panel.buttons["save"].click()
    assert panel.path is not None
    rules = read_test(panel.path).record.limits.rule
    assert [one.steps for one in rules] == [(2,), (2,)]
    assert isinstance(rules[0], LimitRule)
