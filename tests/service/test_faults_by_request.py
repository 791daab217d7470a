"""A fault that a window asks for reaches the simulated rig, and a wrong one is told in words."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from stories import recipe

from rigapp.config.loading import read_rig
from rigapp.schema.messages import FinishReason, Request, RunState
from rigapp.schema.states import ENDED
from rigapp.service.host import EngineHost, read_test
from rigapp.service.simulated import parse_speed

RIG = Path(__file__).parents[2] / "examples" / "simulated.toml"


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    rig = read_rig(RIG)
    host = EngineHost(rig, parse_speed("1", rig))
    yield host
    host.close()


@pytest.mark.long
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
    assert "daq" in host.engine.status().engine.reason


@pytest.mark.long
def test_a_reversed_encoder_ends_the_test_in_its_first_turn_and_names_the_key(
    host: EngineHost, tmp_path: Path
) -> None:
    plan = read_test(recipe(tmp_path, 5, twin=False))
    host.connect(plan.record)
    done = host.handle(
        Request(verb="inject_fault", arguments={"kind": "reversed_encoder", "at_s": 0.0})
    )
    assert done.ok, done.sentence
    out = tmp_path / "reversed.h5"
    host.start(plan, out, "Ada", resume=False)
    state = host.engine.wait(ENDED, 60.0)
    outcome = host.engine.outcome
    assert state is RunState.FAULT, outcome
    assert outcome is not None
    assert outcome.reason is FinishReason.DEVICE
    assert outcome.revolutions == 0
    assert "exchange A and B" in outcome.sentence
    assert "encoder.direction = -1" in outcome.sentence
