"""A test on the simulated rig whose data acquisition is clocked by the encoder."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from drivers.api import ChannelSpec, SampleClock, StreamSetup
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test, read_rig
from rigapp.config.rig import RigFile
from rigapp.engine.calibrate import calibration_of
from rigapp.engine.engine import Engine
from rigapp.engine.run import ENDED
from rigapp.engine.sampleclock import PulseRate
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.storage import open_test

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
LINES = 900


def patient(folder: Path) -> Document[RigFile]:
    """Return the example rig with a drive that a host held up by other work does not lose."""
    text = (EXAMPLES / "simulated_encoder_clock.toml").read_text(encoding="utf-8")
    told = text.replace("watchdog_timeout_s = 0.5", "watchdog_timeout_s = 20.0", 1)
    assert told != text
    path = folder / "rig.toml"
    path.write_text(told, encoding="utf-8")
    return read_rig(path)


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
    assert calibration.pulse_rate == PulseRate(5, 0.3, 0.0)
    assert calibration.fastest_Hz == pytest.approx(700.0 / 60.0 * LINES)
