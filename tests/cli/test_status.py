"""`rigapp status` and `rigapp keys`: what runs here, and the key to hand over."""

from __future__ import annotations

import json
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest

from rigapp.commands.status import show_engines
from rigapp.config.loading import read_rig
from rigapp.schema.messages import Request, RunState
from rigapp.service.client import Client
from rigapp.service.host import EngineHost
from rigapp.service.registry import EngineEntry, announce, running_engines, withdraw
from rigapp.service.simulated import parse_speed

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    return tmp_path / "run"


@pytest.fixture
def host() -> Iterator[EngineHost]:
    document = read_rig(RIG)
    host = EngineHost(document, parse_speed(None, document))
    yield host
    host.close()


def test_nothing_runs(capsys: pytest.CaptureFixture[str]) -> None:
    assert show_engines(None, as_json=False) == 1
    assert capsys.readouterr().out == "No engine runs.\n"
    assert show_engines(RIG, as_json=True) == 1
    assert json.loads(capsys.readouterr().out) == []


def test_running_engine_is_shown(host: EngineHost, capsys: pytest.CaptureFixture[str]) -> None:
    taken = host.handle(Request(verb="take_command", operator="Ada", client="1"))
    assert taken.ok, taken.sentence
    assert show_engines(RIG, as_json=False) == 0
    shown = capsys.readouterr().out
    assert "\n  Idle. Connect.\n" in shown
    assert "in command: Ada" in shown
    assert show_engines(None, as_json=True) == 0
    (one,) = json.loads(capsys.readouterr().out)
    assert (one["state"], one["in_command"], one["alarms"]) == ("idle", "Ada", [])
    assert one["data_age_s"] is None
    assert one["next"]["verb"] == "connect"
    assert (one["state_word"], one["state_line"]) == ("Idle", "Connect.")
    assert not host.watched  # who only asks is no viewer


def test_status_has_everything_a_header_shows(host: EngineHost) -> None:
    (entry,) = running_engines()
    client = Client(entry, "Ada")
    try:
        status = client.request("status", timeout_s=60.0).result
    finally:
        client.close()
    assert status["state"] == RunState.IDLE
    assert status["engine_pid"] == entry.pid
    wanted = {"revolution", "planned", "committed", "alarms", "devices", "channels", "in_command"}
    assert wanted <= set(status)


def test_engine_of_another_version_is_listed_with_the_reason(
    capsys: pytest.CaptureFixture[str],
) -> None:
    import os

    announce(EngineEntry(os.getpid(), "ipc:///nowhere", "ipc:///nowhere", "r", 0.0, version=99))
    try:
        assert show_engines(None, as_json=False) == 0
        assert "version 99" in capsys.readouterr().out
    finally:
        withdraw(os.getpid())


def test_keys_are_made_once_and_the_secret_is_private(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from rigapp.cli.rig import keys

    keys()
    path = Path(capsys.readouterr().out.strip())
    first = path.read_bytes()
    assert b"secret" not in first
    assert stat.S_IMODE((folder / "keys" / "viewer.key_secret").stat().st_mode) & 0o077 == 0
    keys()
    assert path.read_bytes() == first
