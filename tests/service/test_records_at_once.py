"""A record counts at once: for an engine that runs, and at the next start of a headless one."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S

from rigapp.calibrating.records_in_use import name_record
from rigapp.config.loading import read_rig
from rigapp.schema.messages import Reply, Request
from rigapp.schema.states import ENDED
from rigapp.service.host import EngineHost
from rigapp.storage import open_test
from rigapp_calibration.records import seal

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    rig = tmp_path / "rig.toml"
    rig.write_text((EXAMPLES / "simulated.toml").read_text())
    host = EngineHost(read_rig(rig), 20.0)
    try:
        host.connect()
        yield host
    finally:
        host.close()


def use(rig: Path, record: Path) -> None:
    """Name a record in the rig file, and say why it may be used: it holds no readings."""
    name_record(rig, record)
    text = rig.read_text()
    if "calibration_override" not in text:
        rig.write_text(
            text.replace("[load_cell]", '[load_cell]\ncalibration_override = "trial"', 1)
        )


def ask(host: EngineHost, verb: str, **arguments: Any) -> Reply:
    return host.handle(Request(verb, arguments, "E. Sample"))


def cell(folder: Path, name: str, gain: float, due: str = "2097") -> Path:
    """Write the record of a load cell."""
    content = {
        "kind": "load cell",
        "calibrated_at": "2026-01-01T00:00:00Z",
        "due_at": f"{due}-01-01T00:00:00Z",
        "settings": {"cell": {"signal_unit": "mV/V", "full_scale_N": 400.0}},
        "result": {
            "matrix_N_per_unit": [[gain, 0.0], [0.0, gain]],
            "zero": [0.0, 0.0],
            "uncertainty_line_N": {"constant_N": 2.5, "per_N": 0.001},
        },
    }
    (folder / name).write_bytes(seal(content))
    return folder / name


@pytest.mark.long
def test_a_record_counts_at_once_and_at_the_next_start(host: EngineHost, tmp_path: Path) -> None:
    rig = tmp_path / "rig.toml"
    assert "in use already" in ask(host, "use_records").sentence
    use(rig, cell(tmp_path, "first.json", 201.0))
    reply = ask(host, "use_records")
    assert reply.ok, reply.sentence
    assert "load_cell: record" in reply.sentence
    assert ask(host, "signals", window_s=1.0).result["matrix"] == [[201.0, 0.0], [0.0, 201.0]]
    # Nobody tells the engine of the next one: it looks when a test starts.
    use(rig, cell(tmp_path, "second.json", 203.0))
    out = tmp_path / "test.h5"
    test = str(EXAMPLES / "quick.toml")
    started = ask(host, "start", test=test, out=str(out), revolutions=500)
    assert started.ok, started.sentence
    name_record(rig, cell(tmp_path, "old.json", 205.0, due="2026"))
    assert "is running; stop it first" in ask(host, "use_records").sentence
    assert ask(host, "stop", reason="seen enough").ok
    host.engine.wait(ENDED, PATIENCE_S)
    with open_test(out) as reader:
        used = reader.calibration()["load_cell"]
        assert used["matrix_N_per_mV_per_V"][0][0] == 203.0
        assert "second.json" in reader.configuration()["rig"]
    refused = ask(host, "start", test=test, out=str(tmp_path / "next.h5"))
    assert "expired on 2026-01-01" in refused.sentence
    assert not (tmp_path / "next.h5").exists()


@pytest.mark.long
def test_what_else_was_changed_waits_and_is_said(host: EngineHost, tmp_path: Path) -> None:
    rig = tmp_path / "rig.toml"
    use(rig, cell(tmp_path, "first.json", 201.0))
    rig.write_text(rig.read_text().replace("resolution_N = 2.0", "resolution_N = 1.0"))
    refused = ask(host, "use_records")
    assert not refused.ok
    assert "when the engine is started again" in refused.sentence
    before = ask(host, "signals", window_s=1.0).result["matrix"]
    assert before[0][0] == read_rig(EXAMPLES / "simulated.toml").record.load_cell.full_scale_N / 2.0
    out = tmp_path / "test.h5"
    test = str(EXAMPLES / "quick.toml")
    assert ask(host, "start", test=test, out=str(out), revolutions=2).ok
    host.engine.wait(ENDED, PATIENCE_S)
    with open_test(out) as reader:
        assert any("started again" in event.text for event in reader.events())
