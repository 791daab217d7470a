"""The engine on the rig in memory, with a real file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test
from rigapp.config.recipe import TestFile
from rigapp.engine.recording.store import open_file
from rigapp.schema.channels import BASE
from rigapp.schema.messages import Flag, RunState
from rigapp.schema.states import ENDED
from rigapp.storage import open_test
from rigapp_drivers.api import DeviceFault
from tests.engine.engine_doubles import MemoryRig, eventually

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture
def rig() -> MemoryRig:
    return MemoryRig(open_store=open_file)


def document(revolutions: int) -> Document[TestFile]:
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    text = text.replace("revolutions = 500", f"revolutions = {revolutions}")
    text = text.replace("speed_rpm = 60.0", "speed_rpm = 120.0").replace(
        "acceleration_rpm_per_s = 60.0", "acceleration_rpm_per_s = 600.0"
    )
    text = text.replace("overspeed_rpm = 90.0", "overspeed_rpm = 180.0")
    text = text.replace("[cycles]", "[cycles]\nbefore_alarm = 0\nafter_alarm = 0")
    return Document(Path("quick.toml"), text, parse_test(text, "quick.toml"))


def test_a_test_is_in_its_file(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    viewer = rig.engine.subscribe()
    rig.engine.start(document(25), path, operator="Ada")
    assert rig.engine.wait(ENDED, 60.0) is RunState.STOPPED
    rig.engine.note("after the end")
    rig.engine.shutdown()
    taken = rig.engine.snapshot(viewer)
    shown = np.frombuffer(taken.rows).reshape(-1, len(taken.columns))
    with open_test(path) as reader:
        summary = reader.summary()
        assert (summary["status"], summary["revolutions"]) == ("complete", 25)
        assert summary["cycles_saved"] == 3
        for place, name in enumerate(BASE.names):
            np.testing.assert_array_equal(
                reader.column(name), shown[:, place].astype(reader.column(name).dtype)
            )
        kinds = [event.kind for event in reader.events()]
        assert kinds.count("state") >= 3
        assert "stopped" in kinds


def test_a_stopped_test_goes_on_in_its_file(rig: MemoryRig, tmp_path: Path) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(40), path, operator="Ada")
    eventually(lambda: rig.engine.status().test.committed >= 5)
    rig.engine.stop("Ada", "lunch")
    rig.engine.wait(ENDED, 60.0)
    with pytest.raises(UnusableInput, match="exists"):
        rig.engine.start(document(40), path)
    with open_test(path) as reader:
        first = int(reader.column("revolution")[-1])
        assert reader.summary()["status"] == "stopped"
    rig.engine.start(document(40), path, resume=True)
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        np.testing.assert_array_equal(reader.column("revolution"), np.arange(1, 41))
        assert reader.column("quality")[first] & Flag.GAP_BEFORE
        assert np.all(np.diff(reader.column("time")) > 0)
        assert reader.summary()["status"] == "complete"
        assert reader.summary()["gaps"] == 1


def test_a_file_that_cannot_be_made_starts_nothing(rig: MemoryRig, tmp_path: Path) -> None:
    rig.engine.connect()
    with pytest.raises(UnusableInput, match="folder"):
        rig.engine.start(document(5), tmp_path / "nowhere" / "test.h5")
    assert rig.engine.state is RunState.READY
    assert rig.spindle.commands == []
    rig.engine.shutdown()


@pytest.mark.long
@pytest.mark.parametrize("when", ["the drive refuses to turn", "the ramp fails"])
def test_a_start_that_fails_leaves_no_file_in_its_own_way(
    rig: MemoryRig, tmp_path: Path, when: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    if when == "the ramp fails":
        rig.crank.jammed = True
        rig.engine.start(document(5), path)
        rig.spindle.faults = ("overcurrent",)
    else:
        refusal = DeviceFault("drive", "memory", "overcurrent")
        with monkeypatch.context() as patched:
            patched.setattr(rig.spindle, "set_speed", _raises(refusal))
            with pytest.raises(DeviceFault):
                rig.engine.start(document(5), path)
    assert rig.engine.wait(ENDED, 60.0) is RunState.FAULT
    assert "no file is left" in rig.engine.status().engine.reason
    assert list(tmp_path.iterdir()) == []
    rig.crank.jammed = False
    rig.engine.acknowledge()
    rig.engine.reset()
    rig.engine.start(document(5), path)
    rig.engine.wait(ENDED, 60.0)
    rig.engine.shutdown()
    with open_test(path) as reader:
        assert reader.summary()["status"] == "complete"


def _raises(error: Exception) -> Callable[..., None]:
    def refuse(*_: float) -> None:
        raise error

    return refuse


def test_a_fault_leaves_every_revolution_and_every_older_file(
    rig: MemoryRig, tmp_path: Path
) -> None:
    path = tmp_path / "test.h5"
    rig.engine.connect()
    rig.engine.start(document(5000), path)
    eventually(lambda: rig.engine.status().test.committed >= 5)
    rig.spindle.faults = ("overcurrent",)
    assert rig.engine.wait(ENDED, 60.0) is RunState.FAULT
    rig.engine.acknowledge()
    rig.engine.reset()
    rig.crank.jammed = True
    rig.engine.start(document(5000), path, resume=True)
    rig.spindle.faults = ("overcurrent",)
    assert rig.engine.wait(ENDED, 60.0) is RunState.FAULT
    rig.engine.shutdown()
    with open_test(path) as reader:
        assert reader.summary()["revolutions"] >= 5
