"""The bushing of the simulated rig is that of the test's specimen."""

from __future__ import annotations

from pathlib import Path

import pytest

from rigapp.config.loading import read_rig
from rigapp.service.simulated import SimulatedDevices

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_another_specimen_is_an_unworn_bushing() -> None:
    devices = SimulatedDevices(read_rig(EXAMPLES / "simulated.toml"), "max")
    try:
        devices.ports(None)
        assert not devices.fit("bushing 1")
        devices.process.wear_to(50.0)
        assert not devices.fit("bushing 1")
        assert devices.process.state()["wear_depth_um"] == pytest.approx(50.0)
        assert devices.fit("bushing 2")
        assert devices.process.state()["wear_depth_um"] == 0.0
    finally:
        devices.close()
