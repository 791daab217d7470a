"""The bushing of the simulated rig is that of the test's specimen, and its wear goes on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from patience import PATIENCE_S
from stories import log, recipe, until

from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.report.testreport.identified import identified_test
from rigapp.schema.messages import Request
from rigapp.schema.states import ENDED
from rigapp.service.host import EngineHost
from rigapp.service.recorded import last_wear
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.storage import open_test, plausible_until

EXAMPLES = Path(__file__).parents[2] / "examples"
RIG = EXAMPLES / "simulated.toml"


@pytest.mark.long
def test_each_specimen_is_a_bushing_of_its_own_wear() -> None:
    devices = SimulatedDevices(read_rig(RIG), "max")
    try:
        devices.ports(None)
        assert not devices.fit("bushing 1")
        devices.process.wear_to(50.0)
        assert not devices.fit("bushing 1", 20.0), "it is in the rig"
        assert devices.process.state()["wear_depth_um"] == pytest.approx(50.0)
        assert devices.fit("bushing 2")
        assert devices.process.state()["wear_depth_um"] == 0.0
        assert devices.fit("bushing 1", 50.0)
        assert devices.process.state()["wear_depth_um"] == pytest.approx(50.0)
    finally:
        devices.close()


@pytest.fixture
def host(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[EngineHost]:
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    document = read_rig(RIG)
    host = EngineHost(document, parse_speed("max", document))
    yield host
    host.close()


def made(host: EngineHost, test: Document[TestFile], out: Path) -> None:
    host.start(test, out, "Ada", resume=False)
    host.engine.wait(ENDED, PATIENCE_S)
    assert host.engine.outcome is not None
    assert host.engine.outcome.status == "complete"


def depths_um(out: Path) -> tuple[np.ndarray, np.ndarray]:
    with open_test(out) as reader:
        table = reader.predictions()
    depth, doubt = (
        1e3 * table[f"measured_wear_depth{end}"].astype(float) for end in ("", "_uncertainty")
    )
    known = np.isfinite(depth)
    return depth[known], doubt[known]


@pytest.mark.long
def test_the_second_test_of_a_specimen_goes_on_with_its_depth_and_a_moved_probe_is_told(
    host: EngineHost, tmp_path: Path
) -> None:
    first, second, third = (tmp_path / f"{name}.h5" for name in ("first", "second", "third"))
    test = read_test(recipe(tmp_path, 60, twin=True, every=1000))
    specimen = test.record.metadata.specimen
    assert last_wear(RIG, specimen) is None
    made(host, test, first)
    known = last_wear(RIG, specimen)
    assert known is not None
    assert known.depth_um > 2.0 * known.uncertainty_um
    # A simulated rig that is started again has the same bushing.
    host.engine.shutdown()
    host.simulated.close()
    made(host, test, second)
    depth, doubt = depths_um(second)
    assert abs(depth[0] - known.depth_um) < np.hypot(doubt[0], known.uncertainty_um)
    assert depth[-1] > depth[0] + 1.0, "it wears on"
    assert host.engine.status().alarms == ()
    assert any("first.h5" in one.text for one in log(second) if one.kind == "specimen")
    with open_test(second) as reader:
        assert plausible_until(reader) is None

    moved = {"kind": "moved_probe", "channel": "probe_1", "value": 0.5}
    assert host.handle(Request(verb="inject_fault", arguments=moved)).ok
    made(host, test, third)
    (alarm,) = host.engine.status().alarms
    assert alarm.key == "wear_jumped"
    assert "in revolution 60 of second.h5 it was" in alarm.cause
    assert host.engine.outcome is not None
    assert "not reliable" in host.engine.outcome.sentence
    assert "not reliable" in identified_test(third).said
    again = last_wear(RIG, specimen)
    assert again is not None
    assert again.file == str(second), "the last depth that was believed"


@pytest.mark.long
@pytest.mark.parametrize(
    "what",
    [
        "moved probe",
        pytest.param("exchanged specimen", marks=pytest.mark.soak),
        pytest.param("nothing", marks=pytest.mark.soak),
    ],
)
def test_a_depth_that_jumps_between_stop_and_resume_is_told(
    host: EngineHost, tmp_path: Path, what: str
) -> None:
    out, engine = tmp_path / "t.h5", host.engine
    test = read_test(recipe(tmp_path, 5000, twin=True, every=1000))
    host.start(test, out, "Ada", resume=False)
    until(lambda: engine.status().test.revolution >= 150, "the bushing is worn")
    engine.stop("Ada")
    engine.wait(ENDED, PATIENCE_S)
    host.handle(Request(verb="reset"))
    depth, doubt = depths_um(out)
    assert depth[-1] > 3.0 * doubt[-1], "an exchanged specimen shows"
    if what == "moved probe":
        fault = {"kind": "moved_probe", "channel": "probe_1", "value": 0.5}
        assert host.handle(Request(verb="inject_fault", arguments=fault)).ok
    elif what == "exchanged specimen":
        assert host.simulated.process is not None
        host.simulated.process.wear_to(0.0)
    reply = host.handle(Request(verb="resume_file", arguments={"file": str(out)}))
    assert reply.ok, reply.sentence
    engine.extend(engine.status().test.revolution + 60)
    engine.wait(ENDED, PATIENCE_S)
    alarms = engine.status().alarms
    assert engine.outcome is not None
    assert engine.outcome.status == "complete"
    if what == "nothing":
        assert alarms == ()
        return
    (alarm,) = alarms
    assert alarm.key == "wear_jumped"
    assert "of t.h5 it was" in alarm.cause
    assert "a probe was moved, or the specimen exchanged" in alarm.cause
    assert "not reliable" in engine.outcome.sentence
    with open_test(out) as reader:
        assert plausible_until(reader) is not None
