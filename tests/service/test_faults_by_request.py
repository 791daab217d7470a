"""A fault that a window asks for reaches the simulated rig, and a wrong one is told in words."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from rigapp.config.loading import read_rig
from rigapp.engine.messages import Request, RunState
from rigapp.service.host import EngineHost
from rigapp.service.simulated import parse_speed

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    rig = read_rig(RIG)
    host = EngineHost(rig, parse_speed("1", rig))
    yield host
    host.close()


def test_fault_is_injected_on_request(host: EngineHost) -> None:
    early = host.handle(Request(verb="inject_fault", arguments={"kind": "cable_pull"}))
    assert not early.ok
    assert "connect it first" in early.sentence
    host.connect()
    wrong = host.handle(Request(verb="inject_fault", arguments={"kind": "earthquake"}))
    assert not wrong.ok
    pull = {"kind": "cable_pull", "device": "daq"}
    done = host.handle(Request(verb="inject_fault", arguments=pull))
    assert done.ok, done.sentence
    assert host.engine.wait((RunState.FAULT,), 30.0) is RunState.FAULT
    assert "daq" in host.engine.status().reason
