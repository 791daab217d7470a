"""Spindle, encoder, load cell and probes as the rig file describes them, on every pair of boxes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.engine.devices import Devices, make_devices
from rigapp.testing.bench import COUNTS, PERIOD, SourceBench, SpindleBench, truth, wait_until
from rigapp.testing.contracts import Contract, read_contracts

pytestmark = pytest.mark.rigapp_contract

Make = Callable[..., Any]
RIG = """
schema = 1
name = "Instruments"
[devices.daq]
driver = "{source}"
port = "none"
[devices.daq.settings]
{source_settings}
[devices.drive]
driver = "{spindle}"
port = "none"
[devices.drive.settings]
{spindle_settings}
[spindle]
device = "drive"
encoder_counts_per_revolution = 3600
direction = -1
maximum_speed_rpm = 700.0
[encoder]
device = "daq"
input = "counter_1"
counts_per_revolution = {counts}
quadrature = "{quadrature}"
[load_cell]
device = "daq"
input_1 = "{bridges[0]}"
input_2 = "{bridges[1]}"
range_mV_per_V = 3.5
matrix_N_per_mV_per_V = [[200.0, 0.0], [0.0, 200.0]]
[probes]
device = "daq"
input_1 = "analog_3"
input_2 = "analog_4"
range_V = 10.0
sensitivity_um_per_V = [100.0, 100.0]
"""


def _lines(settings: dict[str, Any]) -> str:
    def shown(value: Any) -> str:
        if isinstance(value, bool):
            return str(value).lower()
        if isinstance(value, dict):
            return "{ " + ", ".join(f"{key} = {shown(item)}" for key, item in value.items()) + " }"
        return repr(value)

    return "\n".join(f"{key} = {shown(value)}" for key, value in settings.items())


def devices_of(
    source: SourceBench,
    spindle: SpindleBench,
    folder: Path,
    *,
    bridges: tuple[str, str] = ("analog_1", "analog_2"),
    quadrature: str = "after",
) -> Devices:
    """Return the devices of a rig file on the ports of two benches."""
    path = folder / "rig.toml"
    path.write_text(
        RIG.format(
            source=source.contract.info.name,
            spindle=spindle.contract.info.name,
            source_settings=_lines(source.contract.settings),
            spindle_settings=_lines(spindle.contract.settings),
            bridges=bridges,
            counts=COUNTS if quadrature == "after" else COUNTS // 4,
            quadrature=quadrature,
        )
    )
    ports = {"daq": source.port.url, "drive": spindle.port.url}
    return make_devices(read_rig(path).record, ports)


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize("quadrature", ["after", "before"])
def test_every_instrument_is_reached_by_the_rig_file(
    source: Contract, spindle: Contract, bench: Make, tmp_path: Path, quadrature: str
) -> None:
    if "counter_1" not in source.inputs:
        pytest.skip(f"{source.info.name} has no encoder input")
    daq, drive = bench(source), bench(spindle)
    devices = devices_of(daq, drive, tmp_path, quadrature=quadrature)
    try:
        setup = devices.open()
        units = {spec.name: spec.unit for spec in setup.channels}
        assert [units[f"analog_{n}"] for n in (1, 2, 3, 4)] == ["mV/V", "mV/V", "V", "V"]
        assert units["counter_1"] == "count"
        assert devices.data_request.inputs["counter_1"] == ("counter", float(COUNTS))
        devices.source.start()
        daq.driver, daq.setup = devices.source, setup
        blocks = daq.blocks(100)
        daq.judge(blocks)
        rows = [spec.name for spec in setup.channels]
        values = np.concatenate([block.values for block in blocks], axis=1).astype(float)
        signals = {
            spec.name: row * spec.scale + spec.offset
            for spec, row in zip(setup.channels, values, strict=True)
        }
        place = np.rint((signals["analog_1"] / 3.5 / 0.9 + 1.0) / 2.0 * PERIOD) % PERIOD
        np.testing.assert_allclose(signals["analog_4"], 10.0 * truth(3, place), atol=0.02)
        assert rows.index("counter_1") >= 0
        devices.spindle.set_speed(1.0, 1000.0)

        def turns() -> bool:
            status = devices.spindle.status()
            return drive.motor.speed_count_per_s == -COUNTS and status.speed_rev_per_s > 0.98

        wait_until(turns, "the spindle to turn against the drive's own sense")
    finally:
        devices.close()
    wait_until(drive.is_safe, "the motor to be off")


def test_a_bridge_without_an_amplifier_is_explained(bench: Make, tmp_path: Path) -> None:
    contracts = {c.info.name: c for c in read_contracts()}
    daq, drive = bench(contracts["dataq"]), bench(contracts["roboclaw"])
    with pytest.raises(UnusableInput, match=r"bridge_amplifiers = \{ analog_5"):
        devices_of(daq, drive, tmp_path, bridges=("analog_5", "analog_6"))


def test_the_half_scale_check_passes_through_the_whole_chain(bench: Make) -> None:
    b = bench(next(c for c in read_contracts() if c.info.name == "gsv8"))
    b.connect()
    b.driver.stop()
    results = b.driver.half_scale()
    assert [(r.name, r.expected, r.unit) for r in results[:3]] == [
        ("analog_1", 1.75, "mV/V"),
        ("analog_2", 1.75, "mV/V"),
        ("analog_3", 5.0, "V"),
    ]
    assert all(result.right for result in results)
