"""Preparing a test: the form says what the file will say, the checks say what blocks."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from patience import PATIENCE_MS
from PySide6.QtWidgets import QLabel, QLineEdit

from rigapp.calibrating.records_in_use import with_records
from rigapp.checks.check import CheckVerdict
from rigapp.checks.start import DiskFacts, preflight
from rigapp.config.loading import parse_test, read_rig, read_test
from rigapp.gui.testfile.fields import (
    changes,
    form_fields,
    get_path,
    parse_value,
    set_path,
    show_value,
)
from rigapp.gui.testfile.prepare import MARKS, PreparePanel
from rigapp.gui.testfile.recipe import RecipePanel
from rigapp.gui.testfile.rules import LevelRow
from rigapp.gui.widgets.numbers import number
from rigapp.schema.channels import BASE
from rigapp.schema.messages import DriveView, RunState, Status
from rigapp.service.preflight import disk_facts
from rigapp.viewer.levels import LimitLevel, levels_of, rules_of
from rigapp.viewer.news import News
from rigapp.viewer.tasks import TaskWorker

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def panel(qtbot: Any, qapp: Any, tmp_path: Path) -> RecipePanel:
    path = tmp_path / "quick.toml"
    path.write_text((EXAMPLES / "quick.toml").read_text(encoding="utf-8"), encoding="utf-8")
    panel = RecipePanel()
    qtbot.addWidget(panel)
    panel.open_file(path)
    return panel


def field_editor(panel: RecipePanel, path: str) -> QLineEdit:
    editor = panel.form.editors[path]
    assert isinstance(editor, QLineEdit)
    return editor


def type_into(panel: RecipePanel, path: str, text: str) -> None:
    editor = field_editor(panel, path)
    editor.setText(text)
    editor.textEdited.emit(text)


@pytest.mark.parametrize("name", ["quick.toml", "paper.toml"])
def test_a_shipped_test_goes_through_the_form_unchanged(
    panel: RecipePanel, name: str, tmp_path: Path
) -> None:
    original = read_test(EXAMPLES / name).record
    panel.open_file(EXAMPLES / name)
    assert "As in the file" in panel.verdict.text()
    assert panel.test == original
    target = tmp_path / "saved.toml"
    assert panel.save(target)
    assert read_test(target).record == original


def test_every_key_of_a_test_file_has_a_field(panel: RecipePanel) -> None:
    paths = {field.path for field in form_fields()}
    tree = tomllib.loads((EXAMPLES / "quick.toml").read_text(encoding="utf-8"))
    for field in ("run.revolutions", "model.spring.stiffness_N_per_m", "limits.overload_N"):
        assert field in paths
        assert get_path(tree, field) is not None
    flat = {line.split(":")[0] for line in changes({}, tree)}
    assert flat - paths == {"schema", "model.schema"}


def test_a_change_is_named_before_it_is_saved(panel: RecipePanel) -> None:
    type_into(panel, "run.speed_rpm", "45")
    assert "run.speed_rpm: 60 → 45" in panel.verdict.text()
    assert panel.test is not None
    assert panel.test.run.speed_rpm == 45.0
    panel.buttons["save"].click()
    assert panel.path is not None
    assert read_test(panel.path).record.run.speed_rpm == 45.0
    assert "As in the file" in panel.verdict.text()


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("path", "text", "sentence"),
    [
        ("run.revolutions", "many", "Revolutions must be an integer"),
        ("run.revolutions", "0", "outside 1 to"),
        ("run.speed_rpm", "", "Speed is missing; type 0.1 to 3000 rpm"),
        ("limits.overspeed_rpm", "50", "“Overspeed” = 50 is not above “Speed” = 60"),
        ("model.bushing.poissons_ratio", "0.7", "outside 0 to 0.499"),
        ("model.mechanism.gravity_m_s2", "1 2 3", "two numbers"),
    ],
)
def test_a_mistake_stands_at_its_field_and_cannot_be_saved(
    panel: RecipePanel, path: str, text: str, sentence: str
) -> None:
    type_into(panel, path, text)
    assert sentence in panel.verdict.text()
    assert sentence in note_of(panel, path)
    assert field_editor(panel, path).property("wrong")
    assert panel.test is None
    assert not panel.buttons["save"].isEnabled()


def note_of(panel: RecipePanel, path: str) -> str:
    note = panel.findChild(QLabel, f"note_{path}")
    assert note is not None
    return note.text()


def test_all_mistakes_are_shown_at_once_and_counted_at_their_steps(panel: RecipePanel) -> None:
    type_into(panel, "run.revolutions", "many")
    type_into(panel, "run.speed_rpm", "fast")
    type_into(panel, "stop.force_N", "-1")
    panel.rules.begin()
    assert "many" in note_of(panel, "run.revolutions")
    assert "fast" in note_of(panel, "run.speed_rpm")
    assert "outside 1 to" in note_of(panel, "stop.force_N")
    assert "3 mistakes" in panel.verdict.text()
    shown = [one.words.whole for one in panel.steps.buttons[:6]]
    assert shown[1] == "2 mistakes"
    assert shown[2] == "1 mistake"
    assert shown[0] == "PTFE bushing 1"
    type_into(panel, "run.speed_rpm", "120")
    assert "“Overspeed” = 90 is not above" in note_of(panel, "limits.overspeed_rpm")
    type_into(panel, "run.revolutions", "500")
    assert note_of(panel, "run.revolutions").startswith("1 to")
    type_into(panel, "model.pin.poissons_ratio", "2")
    assert panel.unfold.isChecked()  # what is wrong is not folded away


@pytest.mark.parametrize(
    ("text", "means"),
    [("37,5", 37.5), ("37.5", 37.5), ("1\u2009037,5", 1037.5), ("\u22121", -1.0)],
)
def test_comma_and_point_are_both_read(text: str, means: float) -> None:
    assert number(text) == means


@pytest.mark.parametrize("text", ["1,037.5", "1,0,0", "", "x"])
def test_what_may_mean_two_numbers_means_none(text: str) -> None:
    with pytest.raises(ValueError, match="could not convert"):
        number(text)


@pytest.mark.parametrize("text", ["0, 9.81", "0 9,81", "0; 9,81", "0,9.81"])
def test_a_pair_is_read_with_comma_and_point(text: str) -> None:
    field = next(one for one in form_fields() if one.path.endswith("gravity_m_s2"))
    assert parse_value(field, text) == [0.0, 9.81]


def test_a_test_without_a_spring_has_no_spring(panel: RecipePanel, tmp_path: Path) -> None:
    panel.form.sections["model.spring"].setChecked(False)
    assert panel.test is not None
    assert panel.test.model.spring is None
    assert panel.save(tmp_path / "free.toml")
    panel.open_file(EXAMPLES / "quick.toml")
    assert panel.form.sections["model.spring"].isChecked()
    panel.open_file(tmp_path / "free.toml")
    assert not panel.form.sections["model.spring"].isChecked()


def fill_in(line: LevelRow, value: str, *, action: str = "warn", revolutions: str = "1") -> None:
    """Fill a sentence in as a person does."""
    data = [line.action.itemData(at)[1] for at in range(line.action.count())]
    line.action.setCurrentIndex(data.index(action))
    for editor, text in ((line.value, value), (line.revolutions, revolutions)):
        editor.setText(text)
        editor.textEdited.emit(text)


def test_a_limit_is_a_draft_until_it_is_added_and_a_sentence_then(
    panel: RecipePanel, tmp_path: Path
) -> None:
    rules = panel.rules
    panel.show()
    rules.add.click()
    draft = rules.draft
    assert draft is not None
    assert "Type the value" in draft.note.text()
    fill_in(draft, "3800")
    assert "is never reached: the drive switches off at 380 N" in draft.note.text()
    assert not rules.keep.isEnabled()
    fill_in(draft, "95,5", revolutions="3")
    assert panel.test is not None
    assert panel.test.limits.rule == ()
    assert "One draft limit is not part of it" in panel.verdict.text()
    rules.keep.click()
    sentence = "new limit: Warn when maximum |F| is above 95.5 N in 3 revolutions"
    assert sentence in panel.verdict.text()
    rules.begin()
    assert rules.draft is not None
    fill_in(rules.draft, "200", action="drive_off", revolutions="3")
    rules.keep.click()
    assert panel.test is not None
    rule = panel.test.limits.rule[0]
    assert (rule.quantity, rule.warning_above, rule.critical_above) == ("force_max", 95.5, 200.0)
    assert (rule.action_critical, rule.delay_revolutions) == ("drive_off", 3)
    assert panel.save(tmp_path / "limits.toml")
    panel.open_file(tmp_path / "limits.toml")
    assert panel.test is not None
    assert panel.test.limits.rule == (rule,)
    fill_in(rules.rows[1], "90", action="drive_off", revolutions="3")
    assert "90 must lie beyond 95.5" in rules.rows[1].note.text()
    assert panel.test is None
    for line in list(rules.rows):
        line.remove.click()
    assert panel.test is not None
    assert panel.test.limits.rule == ()


LEVELS = st.builds(
    LimitLevel,
    origin=st.integers(0, 3),
    quantity=st.sampled_from(["force_max", "speed"]),
    severity=st.sampled_from(["warning", "critical"]),
    side=st.sampled_from(["above", "below"]),
    value=st.integers(1, 9),
    action=st.sampled_from(["warn", "pause"]),
    revolutions=st.integers(1, 2),
)


@given(st.lists(LEVELS, max_size=6))
def test_the_rules_of_sentences_say_the_same_sentences(levels: list[LimitLevel]) -> None:
    rules, places = rules_of(levels, [])
    assert sorted(at for mine in places for at in mine) == list(range(len(levels)))
    again = levels_of(rules)
    said = sorted(one.sentence(BASE) for one in levels)
    assert sorted(one.sentence(BASE) for one in again) == said
    assert rules_of(again, rules)[0] == rules


def test_a_rule_keeps_what_the_table_does_not_show(panel: RecipePanel, tmp_path: Path) -> None:
    path = tmp_path / "more.toml"
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    rule = '\n[[limits.rule]]\nquantity = "speed"\nwarning_above = 70.0\naction_warning = "pause"\n'
    path.write_text(text + rule, encoding="utf-8")
    original = read_test(path).record
    panel.open_file(path)
    assert panel.save(path)
    assert read_test(path).record == original


def test_a_file_that_is_no_test_is_said(panel: RecipePanel, tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text("this is [not toml", encoding="utf-8")
    panel.open_file(path)
    assert "not valid TOML" in panel.verdict.text()
    assert panel.path != path


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e4, max_value=1e4))
def test_numbers_survive_the_form(value: float) -> None:
    field = next(f for f in form_fields() if f.path == "model.spring.free_position_mm")
    assert parse_value(field, show_value(value)) == pytest.approx(value, rel=1e-9, abs=1e-12)


def test_paths_are_set_and_found() -> None:
    tree: dict[str, Any] = {}
    set_path(tree, "a.b.c", 1)
    assert tree == {"a": {"b": {"c": 1}}}
    assert get_path(tree, "a.b.x") is None


def ready(make_status: Any, **more: Any) -> Any:
    return make_status(state=RunState.READY, alarms=(), **more)


def test_nothing_blocks_a_sound_rig(make_status: Any, tmp_path: Path) -> None:
    test = read_test(EXAMPLES / "quick.toml").record
    rig = with_records(read_rig(EXAMPLES / "simulated.toml"))
    disk = disk_facts(test, 960.0, tmp_path)
    assert disk.needed_bytes > 1e5
    found = preflight(test, rig, disk, ready(make_status))
    assert not [check for check in found if check.verdict is CheckVerdict.BLOCKS]
    attention = {check.name for check in found if check.verdict is CheckVerdict.ATTENTION}
    assert attention == {"Limits", "Calibration of load cell", "Calibration of probes"}


@pytest.mark.parametrize(
    ("changes_", "what"),
    [
        ({"data_age_s": float("inf")}, "Samples"),
        ({"drive": DriveView(0, 0, 0, 48, 30, False, True, (), ())}, "Emergency stop"),
        ({"drive": DriveView(0, 0, 0, 48, 30, False, False, ("over-current",), ())}, "Drive"),
        ({"state": RunState.RUNNING}, "State"),
    ],
)
def test_what_is_wrong_blocks_with_an_action(
    make_status: Any, changes_: dict[str, Any], what: str
) -> None:
    test = read_test(EXAMPLES / "quick.toml").record
    status = Status.of_flat(ready(make_status).flat() | dict(**changes_))
    found = {check.name: check for check in preflight(test, None, None, status)}
    assert found[what].verdict is CheckVerdict.BLOCKS
    assert found[what].advice


def test_rig_and_test_are_held_against_each_other(make_status: Any) -> None:
    rig = with_records(read_rig(EXAMPLES / "simulated.toml"))
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    text = text.replace("speed_rpm = 60.0", "speed_rpm = 900.0")
    text = text.replace("overspeed_rpm = 90.0", "overspeed_rpm = 950.0")
    test = parse_test(text.replace("overload_N = 380.0", "overload_N = 500.0"), "x")
    status = ready(make_status)
    probe = msgspec.structs.replace(status.rig.channels[2], raw=9.9)
    status = Status.of_flat(status.flat() | {"channels": (probe,)})
    found = {check.name: check.verdict for check in preflight(test, rig, None, status)}
    assert found["Speed"] is CheckVerdict.BLOCKS
    assert found["Overload"] is CheckVerdict.ATTENTION
    assert found["Channel probe_1"] is CheckVerdict.BLOCKS


@pytest.mark.parametrize(("raw", "verdict"), [(0.09, None), (3.4, CheckVerdict.BLOCKS)])
def test_the_end_of_a_range_is_judged_only_where_the_range_is_known(
    make_status: Any, raw: float, verdict: CheckVerdict | None
) -> None:
    test = read_test(EXAMPLES / "quick.toml").record
    rig = with_records(read_rig(EXAMPLES / "simulated.toml"))
    status = ready(make_status)
    cell = msgspec.structs.replace(status.rig.channels[0], raw=raw, raw_unit="mV/V")
    status = Status.of_flat(status.flat() | {"channels": (cell,)})
    known = {check.name: check.verdict for check in preflight(test, rig, None, status)}
    before = {check.name for check in preflight(test, None, None, status)}
    assert known.get("Channel force_1") is verdict
    assert "Channel force_1" not in before  # the rig file is still being read


def test_too_little_room_and_a_missing_folder_block(tmp_path: Path) -> None:
    test = read_test(EXAMPLES / "paper.toml").record
    missing = preflight(test, None, disk_facts(test, 960.0, tmp_path / "nowhere"), None)
    full = preflight(test, None, DiskFacts(tmp_path, 10**9, 10**6), None)
    for found in (missing, full):
        disk = next(check for check in found if check.name == "Disk")
        assert disk.verdict is CheckVerdict.BLOCKS
    assert any(check.name == "Engine" and check.verdict is CheckVerdict.BLOCKS for check in full)


def test_the_list_follows_selected_test_and_engine(
    qtbot: Any, qapp: Any, tmp_path: Path, make_status: Any
) -> None:
    worker = TaskWorker("test-files")
    panel = PreparePanel(tmp_path, worker)
    qtbot.addWidget(panel)
    panel.recipe.open_file(EXAMPLES / "quick.toml")

    def shown() -> dict[str, str]:
        worker.deliver()
        panel.show_news(News(ready(make_status)))
        return {check.name: check.verdict.value for check in panel.checks.shown}

    qtbot.waitUntil(lambda: "Disk" in shown(), timeout=PATIENCE_MS)
    assert "good" in shown()["Disk"]
    type_into(panel.recipe, "run.revolutions", "x")
    assert shown()["Form"] == "attention"  # what is typed is not part of the selected test
    assert shown()["Test"] == "good"
    panel.recipe.begin({"schema": 1})
    assert shown()["Selected test"] == "blocks"
    worker.close()


def test_window_and_command_line_show_one_list(
    qtbot: Any,
    qapp: Any,
    tmp_path: Path,
    make_status: Any,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    from rigapp.commands import check

    status = ready(make_status)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(check, "look", lambda records, test: (status, []))
    assert check.check_rig(EXAMPLES / "simulated.toml", EXAMPLES / "quick.toml") == 0
    lines = capsys.readouterr().out.splitlines()
    worker = TaskWorker("test-files")
    panel = PreparePanel(tmp_path, worker)
    qtbot.addWidget(panel)
    panel.set_rig(EXAMPLES / "simulated.toml")
    panel.recipe.open_file(EXAMPLES / "quick.toml")

    def rows() -> list[list[str]]:
        worker.deliver()
        panel.show_news(News(status))
        return [[one.verdict, one.name, one.sentence, one.advice] for one in panel.checks.shown]

    qtbot.waitUntil(lambda: {"Disk", "Speed"} <= {row[1] for row in rows()}, timeout=PATIENCE_MS)
    marks = {"good": "ok", "attention": "note", "blocks": "BLOCKS"}
    shown = rows()
    assert len(shown) == len(lines)
    told = [(line.mark.text(), line.what.text()) for line in panel.checks.rows[: len(shown)]]
    for (verdict, what, finding, action), (mark, title) in zip(shown, told, strict=True):
        free = finding.split(",")[0] if what == "Disk" else finding
        found = [line for line in lines if line.startswith(marks[verdict]) and what in line]
        assert any(free in line and action in line for line in found)
        assert mark == MARKS[CheckVerdict(verdict)]
        assert title.startswith(what)
    worker.close()


def test_a_rig_file_that_became_unusable_blocks(
    qtbot: Any, qapp: Any, tmp_path: Path, make_status: Any
) -> None:
    rig = tmp_path / "rig.toml"
    text = (EXAMPLES / "simulated.toml").read_text(encoding="utf-8")
    rig.write_text(text, encoding="utf-8")
    worker, now = TaskWorker("test-files"), [0.0]
    panel = PreparePanel(tmp_path, worker, clock=lambda: now[0])
    qtbot.addWidget(panel)
    panel.set_rig(rig)
    panel.recipe.open_file(EXAMPLES / "quick.toml")

    def what() -> set[str]:
        worker.deliver()
        panel.show_news(News(ready(make_status)))
        return {check.name for check in panel.checks.shown}

    qtbot.waitUntil(lambda: "Speed" in what(), timeout=PATIENCE_MS)
    rig.write_text(text.replace("[spindle]", "[spindel]"), encoding="utf-8")
    now[0] = 100.0
    qtbot.waitUntil(lambda: "Rig file" in what(), timeout=PATIENCE_MS)
    worker.close()
