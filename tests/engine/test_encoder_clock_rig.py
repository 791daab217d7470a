"""A test on the simulated rig whose data acquisition is clocked by the encoder."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test, read_rig
from rigapp.config.rig import RigFile
from rigapp.engine.engine import Engine
from rigapp.engine.samples.sampleclock import PulseRate
from rigapp.engine.values.calibrate import calibration_of
from rigapp.schema.messages import Flag
from rigapp.schema.states import ENDED
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.storage import open_test
from rigapp_drivers.api import ChannelSpec, SampleClock, StreamSetup
from tests.engine.engine_doubles import eventually

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
LINES = 900


def patient(folder: Path, *changes: tuple[str, str]) -> Document[RigFile]:
    """Return the example rig with a drive that a host held up by other work does not lose."""
    told = (EXAMPLES / "simulated_encoder_clock.toml").read_text(encoding="utf-8")
    for old, new in (("watchdog_timeout_s = 0.5", "watchdog_timeout_s = 20.0"), *changes):
        assert told.count(old) == 1, old
        told = told.replace(old, new, 1)
    path = folder / "rig.toml"
    path.write_text(told, encoding="utf-8")
    rig = read_rig(path)
    # The drive's settings are read again at each start; at 200 ms a busy host loses an answer.
    rig.record.devices["drive"].settings["sdo_timeout_ms"] = 2000.0
    return rig


@pytest.mark.long
def test_a_test_by_the_encoders_pulses(tmp_path: Path) -> None:
    rig = patient(tmp_path)
    # A loaded computer holds the simulated device up; being asked meanwhile would cost it pulses.
    rig.record.devices["daq"].settings["idle_check_s"] = 1.5
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    text = text.replace("revolutions = 500", "revolutions = 12", 1)
    text = text.replace("every_revolutions = 10", "every_revolutions = 1", 1)
    test = Document(Path("quick.toml"), text, parse_test(text, "quick.toml"))
    path = tmp_path / "test.h5"
    devices = SimulatedDevices(rig, parse_speed("max", rig))
    try:
        engine = Engine(rig, ports=devices.ports(test.record.model))
        engine.connect()
        engine.start(test, path, operator="Ada")
        engine.wait(ENDED, 120.0)
        engine.shutdown()
    finally:
        devices.close()
    with open_test(path) as reader:
        assert reader.summary()["status"] == "complete", reader.summary()
        np.testing.assert_array_equal(reader.column("revolution"), np.arange(1, 13))
        good = reader.column("quality") == 0
        assert good.sum() >= 6, reader.column("quality")
        np.testing.assert_array_equal(reader.column("samples")[good], LINES)
        speed = reader.column("speed")
        np.testing.assert_allclose(speed[good], 60.0, rtol=0.01)
        assert speed[good].std() < 0.2
        lasted = np.diff(reader.column("time"))
        np.testing.assert_allclose(lasted[good[1:]], 60.0 / speed[1:][good[1:]], rtol=1e-6)
        assert np.all((reader.column("speed_min") <= speed)[good])
        assert np.all((reader.column("speed_max") >= speed)[good])
        assert not reader.column("lost_samples")[good].any()
        whole = [one for one in reader.cycles() if one.revolution > 1]
        cycle = next(one for one in whole if good[one.revolution - 1])
        np.testing.assert_allclose(
            cycle.columns["angle"], np.arange(LINES) * 360 / LINES, atol=1e-3
        )
        steps = np.diff(cycle.columns["time"])
        assert steps.min() > 0
        np.testing.assert_allclose(steps, 1 / LINES, rtol=0.05)
        begun = reader.column("time")[cycle.revolution - 2]
        assert cycle.columns["time"][0] == pytest.approx(begun, abs=1e-6)
        assert reader.calibration()["acquisition"]["clock"] == "encoder"


@pytest.mark.long
def test_direction_and_index_come_from_digital_lines(tmp_path: Path) -> None:
    rig = patient(
        tmp_path,
        ("direction = 1\nrestarts_at_index", "direction = -1\nrestarts_at_index"),
        ("index_angle_deg = 0.0", "index_angle_deg = 30.0"),
    )
    rig.record.devices["daq"].settings["idle_check_s"] = 1.5
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    test = Document(Path("quick.toml"), text, parse_test(text, "quick.toml"))
    devices = SimulatedDevices(rig, parse_speed("20", rig))
    path = tmp_path / "test.h5"
    try:
        engine = Engine(rig, ports=devices.ports(test.record.model))
        engine.connect()
        view = next(one for one in engine.status().rig.devices if one.name == "daq")
        assert "line B to D0, line Z to D1" in view.wiring
        engine.start(test, path, operator="Ada")
        eventually(lambda: engine.status().test.revolution >= 4)
        engine.stop("Ada")
        engine.wait(ENDED, 60.0)

        def apart_deg() -> float:
            """Return the angle shown less the crank's; the last scans come when asked for."""
            shown = next(one for one in engine.status().rig.channels if one.name == "crank_angle")
            return float(
                (shown.value - devices.process.state()["angle_deg"] + 180.0) % 360.0 - 180.0
            )

        eventually(lambda: abs(apart_deg()) < 3 * 360.0 / LINES)
        engine.shutdown()
    finally:
        devices.close()
    with open_test(path) as reader:
        assert reader.column("speed")[2] == pytest.approx(60.0, rel=0.05)
        wrong = int(Flag.MISSED_INDEX | Flag.COUNT_MISMATCH)
        assert not (reader.column("quality").astype(int) & wrong).any()


@pytest.mark.long
def test_a_reversed_line_b_is_found_in_the_first_turn(tmp_path: Path) -> None:
    rig = patient(tmp_path)
    rig.record.devices["daq"].settings["idle_check_s"] = 1.5
    text = (EXAMPLES / "quick.toml").read_text(encoding="utf-8")
    test = Document(Path("quick.toml"), text, parse_test(text, "quick.toml"))
    devices = SimulatedDevices(rig, parse_speed("1", rig))
    try:
        engine = Engine(rig, ports=devices.ports(test.record.model))
        engine.connect()
        devices.process.inject({"kind": "reversed_encoder", "at_s": 0.0})
        engine.start(test, tmp_path / "test.h5", operator="Ada")
        engine.wait(ENDED, 60.0)
        assert engine.outcome is not None
        assert "encoder.direction = -1" in engine.outcome.sentence
        assert engine.outcome.revolutions == 0
        engine.shutdown()
    finally:
        devices.close()


def test_without_the_pulse_rate_a_simulated_rig_is_refused() -> None:
    """Its time is not the host's, and the samples alone do not tell it."""
    rig = read_rig(EXAMPLES / "simulated_encoder_clock.toml").record
    names = {"analog_1": "mV/V", "analog_2": "mV/V", "analog_3": "V", "analog_4": "V"}
    channels = (
        *(ChannelSpec(name, unit) for name, unit in names.items()),
        ChannelSpec("counter_1", "count"),
    )
    setup = StreamSetup(channels, 900.0, {}, SampleClock.ENCODER)
    with pytest.raises(UnusableInput, match="rate_range_Hz"):
        calibration_of(rig, setup)
    told = replace(setup, channels=(*channels, ChannelSpec("rate_1", "Hz", 0.3)))
    calibration = calibration_of(rig, told)
    assert calibration.counter.pulse_rate == PulseRate(5, 0.3, 0.0)
    assert calibration.counter.fastest_Hz == pytest.approx(700.0 / 60.0 * LINES)
