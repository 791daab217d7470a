"""A test that was killed when all its revolutions were safe is ended by going on with it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from storage_samples import PLAN, check, new_test, write

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.schema.messages import Request
from rigapp.service.resumption import read_past
from rigapp.storage import finish_whole_test, open_test

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"


def killed(folder: Path, revolutions: int = PLAN.revolutions) -> Path:
    """Return a file whose writer went away after the last commit."""
    writer = new_test(folder)
    write(writer, 1, revolutions)
    assert writer.commit() == revolutions
    writer.close()
    return folder / "test.h5"


def test_whole_test_is_ended_once_without_a_gap(quick_folder: Path) -> None:
    path = killed(quick_folder)
    with open_test(path) as reader:
        assert reader.summary()["status"] == "interrupted"
    assert finish_whole_test(path) == PLAN.revolutions
    assert finish_whole_test(path) == 0
    with open_test(path) as reader:
        found = reader.summary()
        assert (found["status"], found["gaps"]) == ("complete", 0)
        assert found["reason"].startswith("The test is complete: all 300 revolutions were in")
        assert check(reader) == PLAN.revolutions
        assert [event.kind for event in reader.events()] == ["resumed"]
        assert reader.first_altered_event() is None
        assert len(reader.predictions()["revolution"]) == PLAN.revolutions


def test_what_is_not_whole_or_not_interrupted_is_left_alone(quick_folder: Path) -> None:
    path = killed(quick_folder, PLAN.revolutions - 1)
    with open_test(path) as reader:
        assert "resume continues after them" in reader.summary()["reason"]
    before = path.read_bytes()
    assert finish_whole_test(path) == 0
    assert path.read_bytes() == before
    path.unlink()
    with new_test(quick_folder) as writer:
        write(writer, 1, PLAN.revolutions)
        writer.commit()
        assert finish_whole_test(path) == 0
        writer.finish("stopped", "operator", "at the last moment")
    assert finish_whole_test(path) == 0
    with pytest.raises(UnusableInput, match="was stopped with all its 300 revolutions"):
        read_past(path)


def test_resume_of_a_whole_test_ends_it_without_a_device(
    quick_folder: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    from rigapp.commands import run

    path = killed(quick_folder)
    ended: list[str] = []
    monkeypatch.setattr("rigapp.service.recorded.settle", lambda end: ended.append(end.file))
    assert run.resume_test(path, RIG, "json", None) == 0
    said = capsys.readouterr()
    event = json.loads(said.out)
    assert (event["event"], event["reason"]) == ("finished", "complete")
    assert event["revolutions"] == PLAN.revolutions
    assert "300 revolutions, complete." in said.err
    assert ended == [str(path)]
    with pytest.raises(UnusableInput, match="the test is complete with 300 revolutions"):
        read_past(path)


def test_request_to_go_on_with_a_whole_test_ends_it(
    quick_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from rigapp.service.host import EngineHost

    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    monkeypatch.setattr("rigapp.service.recorded.settle", lambda end: None)
    path = killed(quick_folder)
    host = EngineHost(read_rig(RIG), 1.0)
    try:
        reply = host.handle(Request("resume_file", {"file": str(path)}))
        assert reply.ok
        assert "all 300 revolutions" in reply.sentence
        assert host.engine.state.value == "idle"
    finally:
        host.close()
