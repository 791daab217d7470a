"""A test on the simulated rig with a gear between the drive's motor and the crank."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test, read_rig
from rigapp.engine.engine import Engine
from rigapp.schema.states import ENDED
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.storage import open_test

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
REVOLUTIONS = 8


def geared(folder: Path, example: str, gear_ratio: str) -> Path:
    """Write an example's rig with a gear, and a drive that a busy computer does not lose."""
    text = (EXAMPLES / example).read_text(encoding="utf-8")
    patient = text.replace("watchdog_timeout_s = 0.5", "watchdog_timeout_s = 20.0", 1)
    told = patient.replace("[spindle]", f"[spindle]\ngear_ratio = {gear_ratio}", 1)
    assert len({text, patient, told}) == 3
    path = folder / "rig.toml"
    path.write_text(told, encoding="utf-8")
    return path


@pytest.mark.long
@pytest.mark.parametrize(
    ("example", "gear_ratio"),
    [
        ("simulated_alternate.toml", 4.8),
        pytest.param("simulated.toml", 3.0, marks=pytest.mark.long),
    ],
)
def test_a_geared_drive_turns_the_crank_at_the_set_speed(
    tmp_path: Path, example: str, gear_ratio: float
) -> None:
    rig = read_rig(geared(tmp_path, example, str(gear_ratio)))
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    text = text.replace("revolutions = 500", f"revolutions = {REVOLUTIONS}", 1)
    test = Document(Path("quick.toml"), text, parse_test(text, "quick.toml"))
    path = tmp_path / "test.h5"
    devices = SimulatedDevices(rig, parse_speed("max", rig))
    try:
        engine = Engine(rig, ports=devices.ports(test.record.model))
        engine.connect()
        assert engine.rest().devices["drive"]["gear_ratio"] == gear_ratio
        before = devices.process.state()["revolutions"]
        engine.start(test, path, operator="Ada")
        engine.wait(ENDED, 120.0)
        turned = devices.process.state()["revolutions"] - before
        engine.shutdown()
    finally:
        devices.close()
    with open_test(path) as reader:
        assert reader.summary()["status"] == "complete", reader.summary()
        np.testing.assert_array_equal(reader.column("revolution"), np.arange(1, REVOLUTIONS + 1))
        assert reader.column("speed")[3:] == pytest.approx(60.0, rel=0.01)
    assert REVOLUTIONS < turned < 2 * REVOLUTIONS, "the crank itself has turned so often"


@pytest.mark.parametrize("gear_ratio", ["0.0", "-3.0", "nan", "inf", '"3:1"'])
def test_a_gear_that_cannot_be_is_refused_with_its_key(tmp_path: Path, gear_ratio: str) -> None:
    with pytest.raises(UnusableInput, match=r"spindle\.gear_ratio"):
        read_rig(geared(tmp_path, "simulated.toml", gear_ratio))
