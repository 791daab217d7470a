"""An engine that starts with the computer: connected, told of what was cut off, and at rest."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from stories import COMMAND, NEVER_OVER, RIG, Running, end_soon, numbers, recipe, summary, until

from rigapp.service.client import Client
from rigapp.service.launch import find_engine
from rigapp.service.recorded import cut_off, remember


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    return tmp_path


@pytest.fixture
def cut_off_test(folder: Path) -> Path:
    """Return the file of a test whose engine was killed."""
    file = folder / "t.h5"
    test = Running("run", recipe(folder, NEVER_OVER, twin=False), "--rig", RIG, "--out", file)
    try:
        test.wait_for(lambda: test.committed >= 5, "five revolutions are safe")
        test.kill()
    finally:
        test.close()
    return file


@pytest.fixture
def started(cut_off_test: Path) -> Iterator[Client]:
    """Start the engine as the computer's start does, and look at it."""
    process = subprocess.Popen([*COMMAND, "engine", str(RIG), "--stay"])
    try:
        until(lambda: find_engine(RIG), "the engine is there")
        entry = find_engine(RIG)
        assert entry is not None
        client = Client(entry, "Ada", look=False)
        yield client
        client.close()
    finally:
        process.terminate()
        process.wait(60.0)


def status(client: Client) -> dict[str, Any]:
    return dict(client.request("status", timeout_s=30.0).result)


@pytest.mark.long
def test_it_tells_where_the_test_was_cut_off_and_goes_on_only_when_asked(
    cut_off_test: Path, started: Client
) -> None:
    before = numbers(cut_off_test)
    until(lambda: status(started)["state"] == "ready", "the devices are connected")
    told = status(started)
    (alarm,) = [one for one in told["alarms"] if one["key"] == "cut_off"]
    assert alarm["severity"] == "warning"
    assert f"{cut_off_test}: " in alarm["cause"]
    assert f"at revolution {before[-1]} of {NEVER_OVER}" in alarm["cause"]
    assert not told["drive"]["enabled"]
    assert told["speed_rpm"] == 0.0
    assert len(numbers(cut_off_test)) == len(before)
    gone_on = started.request("resume_file", {"file": str(cut_off_test)}, timeout_s=120.0)
    assert gone_on.ok, gone_on.sentence
    until(lambda: status(started)["committed"] > len(before) + 5, "it goes on")
    assert not [one for one in status(started)["alarms"] if one["active"]]
    end_soon(RIG)
    until(lambda: summary(cut_off_test)["status"] == "complete", "the test is complete")
    assert cut_off(RIG) == ""


def test_nothing_is_told_of_a_file_that_is_gone_or_of_a_rig_without_tests(folder: Path) -> None:
    assert cut_off(RIG) == ""
    remember(RIG, folder / "gone.h5")
    assert cut_off(RIG) == ""


def test_a_test_is_not_held_up_where_its_name_cannot_be_kept(
    folder: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    (folder / "file").touch()
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(folder / "file"))
    remember(RIG, folder / "t.h5")
    assert "the name of the last test is not kept" in caplog.text
