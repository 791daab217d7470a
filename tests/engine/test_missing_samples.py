"""An amplifier that hangs and drops its samples leaves a gap, at every speed of the simulation."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from engine_doubles import eventually

from rigapp.config.loading import Document, read_rig, read_test
from rigapp.engine.engine import Engine
from rigapp.schema.messages import RunState
from rigapp.schema.states import ENDED
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.storage import open_test

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.mark.parametrize("speed", ["20", "max"])
def test_a_silence_shorter_than_the_limit_of_the_host_is_a_gap_of_the_rig(
    tmp_path: Path, speed: str
) -> None:
    rig, test = read_rig(EXAMPLES / "simulated.toml"), read_test(EXAMPLES / "quick.toml")
    run = msgspec.structs.replace(test.record.run, revolutions=100_000)
    test = Document(test.path, test.text, msgspec.structs.replace(test.record, run=run))
    devices, path = SimulatedDevices(rig, parse_speed(speed, rig)), tmp_path / "t.h5"
    try:
        engine = Engine(rig, ports=devices.ports(test.record.model))
        engine.connect()
        engine.start(test, path, operator="Ada")
        engine.wait({RunState.RUNNING}, 60.0)
        begun = engine.status().revolution
        eventually(lambda: engine.status().revolution > begun + 100)
        devices.process.inject({"kind": "hang", "device": "daq", "duration_s": 0.5})
        engine.wait(ENDED, 60.0)
        assert engine.outcome is not None
        assert "daq sent no samples for" in engine.outcome.sentence
        engine.shutdown()
    finally:
        devices.close()
    with open_test(path) as reader:
        assert reader.summary()["gaps"] == 1
