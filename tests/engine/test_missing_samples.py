"""An amplifier that is silent, late or drifts: what was lost is a gap, what is late is none.

How long a silence lasts is told by the simulated crank's own turns, so that a busy computer changes
nothing.
"""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import product
from pathlib import Path

import msgspec
import numpy as np
import pytest

from rigapp.config.loading import Document, read_rig, read_test
from rigapp.engine.engine import Engine
from rigapp.schema.messages import Event, FinishReason, Flag, RunState
from rigapp.schema.states import ENDED, Refused
from rigapp.service.simulated import SimulatedDevices, parse_speed
from rigapp.storage import open_test
from rigapp_drivers.api import DeviceError
from tests.engine.engine_doubles import eventually

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
GSV8, DATAQ, BY_ENCODER = "simulated", "simulated_alternate", "simulated_encoder_clock"
LIMIT_TURNS = 2.0
"""Of quick.toml: stale_data_s = 2 at 60 rpm."""
WRONG = {"count_mismatch", "overspeed", "speed_lost", "speeds_differ", "index_missed"}
"""What a gap is not."""


NODE = """driver = "cia402"
port = "simulated"
[devices.drive.settings]
velocity_unit = "milli-rpm"
"""
ROBOCLAW = """driver = "roboclaw"
port = "simulated"
[devices.drive.settings]
address = 128
"""
"""One drive for all: it is the amplifiers that are looked at."""
SILENT = {"stale_data", "samples_missing", "device_lost", "time_jump"}
"""What it is, where it is too long; some devices are asked when they are silent, and found lost. On
a computer that is late the samples may be back before the limit is seen to be passed."""
ELSEWHERE = [
    pytest.param(name, speed, marks=pytest.mark.long if speed in ("1", "max") else pytest.mark.soak)
    for name, speed in product((GSV8, DATAQ, BY_ENCODER), ("1", "20", "100", "max"))
    if (name, speed) != (GSV8, "1")
]
"""The same on more instruments and at more speeds. A computer with other work cannot keep 20 or 100
times the speed of a rig, and an engine that is behind ends the test late; ``max`` waits for it."""
MORE = ((GSV8, "20"), (DATAQ, "1"), (BY_ENCODER, "1"), (BY_ENCODER, "20"))


class Rig:
    """A test under way on a simulated rig."""

    def __init__(self, name: str, speed: str, path: Path, revolutions: int = 100_000) -> None:
        file = path.with_name("rig.toml")
        text = (EXAMPLES / f"{name}.toml").read_text()
        file.write_text(text.replace(NODE, ROBOCLAW))
        rig, test = read_rig(file), read_test(EXAMPLES / "quick.toml")
        run = msgspec.structs.replace(test.record.run, revolutions=revolutions)
        self.test = Document(test.path, test.text, msgspec.structs.replace(test.record, run=run))
        self.devices, self.path = SimulatedDevices(rig, parse_speed(speed, rig)), path
        self.engine = Engine(rig, ports=self.devices.ports(self.test.record.model))

    def start(self) -> None:
        self.engine.connect()
        self.engine.start(self.test, self.path, operator="Ada")

    def run(self, revolutions: int = 3) -> None:
        """Go on for some revolutions at the set speed."""
        self.engine.wait({RunState.RUNNING}, 240.0)
        until = self.engine.status().test.revolution + revolutions
        eventually(lambda: self.engine.status().test.revolution >= until)

    def turned(self) -> float:
        return float(self.devices.process.state()["revolutions"])

    def disturb(self, kind: str, turns: float) -> float:
        """Let the amplifier be silent until the crank has turned so far; return how far it did."""
        begun = self.turned()
        self.devices.process.inject({"kind": kind, "device": "daq"})
        eventually(lambda: self.turned() - begun >= turns or self.engine.state in ENDED)
        self.devices.process.clear(kind)
        return self.turned() - begun

    def stop(self) -> None:
        self.engine.stop("Ada")
        self.engine.wait(ENDED, 240.0)

    def ready(self) -> None:
        """Go back to Ready, as an operator does: a device that is lost is connected again."""
        self.engine.wait(ENDED, 240.0)

        def back() -> bool:
            lost = any(one.key.startswith("device_lost") for one in self.engine.status().alarms)
            try:
                if lost:
                    self.engine.connect()
                else:
                    self.engine.acknowledge(operator="Ada")
                    self.engine.reset(operator="Ada")
            except (DeviceError, Refused):
                return False
            return self.engine.state is RunState.READY

        eventually(back)

    def events(self) -> list[Event]:
        self.engine.shutdown()
        with open_test(self.path) as reader:
            return reader.events()

    def gaps(self) -> list[str]:
        return [one.text for one in self.events() if one.kind == "gap"]

    def alarms(self) -> list[str]:
        """Return the kinds of alarms that were raised, in their order."""
        keys = (one.key.partition(":")[0] for one in self.events() if one.kind == "alarm")
        return list(dict.fromkeys(keys))


@contextmanager
def rig(name: str, speed: str, folder: Path, revolutions: int = 100_000) -> Iterator[Rig]:
    one = Rig(name, speed, folder / "t.h5", revolutions)
    try:
        yield one
    finally:
        one.engine.shutdown()
        one.devices.close()


@pytest.mark.parametrize(
    ("name", "speed"),
    [(GSV8, "1"), *ELSEWHERE],
)
def test_a_silence_beyond_the_limit_ends_the_test_and_is_the_reason(
    tmp_path: Path, name: str, speed: str
) -> None:
    with rig(name, speed, tmp_path) as one:
        one.start()
        one.run()
        # Far beyond the limit: without waits the crank makes 100 turns a second, and the limit is
        # in this computer's time. The silence lasts no longer than the test.
        one.disturb("hang", (500.0 if speed == "max" else 2.0) * LIMIT_TURNS)
        one.engine.wait(ENDED, 240.0)
        assert one.engine.outcome is not None
        assert one.engine.outcome.reason is FinishReason.DEVICE
        one.ready()
        alarms = one.alarms()
        assert alarms[0] in SILENT, alarms
        assert not WRONG.intersection(alarms), alarms


@pytest.mark.parametrize(
    "turns", [pytest.param(one, marks=pytest.mark.long) for one in (0.1, 0.3, 0.7, 1.2)]
)
def test_a_short_gap_has_its_length_and_the_encoder_is_not_blamed(
    tmp_path: Path, turns: float
) -> None:
    with rig(GSV8, "1", tmp_path) as one:
        one.start()
        one.run()
        turned = one.disturb("hang", turns)
        one.run(4)
        one.stop()
        (gap,) = one.gaps()
        seconds = float(gap.split(" for ")[1].split(" s,")[0])
        assert seconds == pytest.approx(turned, abs=0.08)  # at 60 rpm; orders take their time
        assert one.alarms() == ["time_jump"]


@pytest.mark.long
def test_a_gap_after_a_gap_is_another_one(tmp_path: Path) -> None:
    with rig(GSV8, "1", tmp_path) as one:
        one.start()
        one.run()
        for _ in range(2):
            one.disturb("hang", 0.4)
            one.run(2)
        one.stop()
        assert len(one.gaps()) == 2
        assert one.alarms() == ["time_jump"]


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "speed"),
    [
        (DATAQ, "20"),
        pytest.param(GSV8, "1", marks=pytest.mark.long),
        *(pytest.param(*one, marks=pytest.mark.long) for one in MORE),
    ],
)
def test_what_comes_late_is_no_gap(tmp_path: Path, name: str, speed: str) -> None:
    with rig(name, speed, tmp_path) as one:
        one.start()
        one.run()
        one.disturb("hold", 0.3)
        one.run(5)
        one.stop()
        assert one.gaps() == []
        alarms = one.alarms()
        with open_test(one.path) as reader:
            rows = reader.rows()
        if name == BY_ENCODER and alarms:
            # Silence may be a shaft at rest: to ask, its driver must stop the scan. The pulses that
            # pass meanwhile are missing, and counted.
            assert alarms == ["lost_samples"]
            assert 0 < rows["lost_samples"].sum() < 0.3 * 3600
            return
        assert alarms == []
        assert not any(rows["quality"][1:] & ~int(Flag.RAMP | Flag.PARTIAL | Flag.PAUSED))


@pytest.mark.long
def test_what_comes_later_than_the_limit_ends_the_test_as_stale(tmp_path: Path) -> None:
    with rig(GSV8, "1", tmp_path) as one:
        one.start()
        one.run()
        one.disturb("hold", 3.0 * LIMIT_TURNS)
        one.ready()
        # While nothing comes no encoder sees the stop.
        assert one.alarms()[0] == "stale_data"
        assert set(one.alarms()) <= {"stale_data", "stop_unseen"}
        assert one.gaps() == []


@pytest.mark.long
@pytest.mark.parametrize("name", [GSV8, DATAQ])
def test_a_clock_that_drifts_makes_no_gap(tmp_path: Path, name: str) -> None:
    with rig(name, "20", tmp_path) as one:
        one.engine.connect()
        one.devices.process.inject({"kind": "clock_drift", "value": 1000.0})
        one.engine.start(one.test, one.path, operator="Ada")
        one.run(200)
        one.stop()
        assert one.gaps() == []
        assert one.alarms() == []


@pytest.mark.long
@pytest.mark.parametrize("name", [GSV8, DATAQ])
def test_a_gap_in_the_run_up(tmp_path: Path, name: str) -> None:
    with rig(name, "1", tmp_path) as one:
        one.start()
        begun = one.turned()
        eventually(lambda: one.turned() > begun + 0.3)
        one.disturb("hang", 0.3)
        one.run()
        one.stop()
        if name == GSV8:
            assert one.alarms() == ["time_jump"]
            assert len(one.gaps()) == 1
        else:  # its driver sees the count of each scan, and tells the number
            assert one.alarms() == ["lost_samples"]


@pytest.mark.long
def test_a_silence_in_a_pause_loses_no_motion(tmp_path: Path) -> None:
    with rig(GSV8, "1", tmp_path) as one:
        one.start()
        one.run()
        one.engine.pause("Ada")
        one.engine.wait({RunState.PAUSED}, 240.0)
        one.devices.process.inject({"kind": "hang", "device": "daq"})
        eventually(lambda: (one.engine.status().rig.data_age_s or 0.0) > 0.3)
        one.devices.process.clear("hang")
        one.engine.resume("Ada")
        one.run()
        one.stop()
        assert one.alarms() == []
        assert one.gaps() == []


@pytest.mark.long
@pytest.mark.parametrize("name", [GSV8, DATAQ])
def test_a_gap_at_the_regular_end_leaves_the_test_complete(tmp_path: Path, name: str) -> None:
    with rig(name, "1", tmp_path, revolutions=3) as one:
        one.start()
        one.engine.wait({RunState.STOPPING}, 240.0)
        one.disturb("hang", 0.1)
        one.engine.wait(ENDED, 240.0)
        assert one.engine.outcome is not None
        assert one.engine.outcome.status == "complete"
        alarms = one.alarms()
        assert not WRONG.intersection(alarms), alarms


@pytest.mark.long
def test_a_clock_of_the_computer_that_is_set_moves_utc_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An administrator or a time server sets it an hour forward, and back again."""
    ahead_s, real = [0.0], time.time
    monkeypatch.setattr(time, "time", lambda: real() + ahead_s[0])
    with rig(GSV8, "20", tmp_path) as one:
        one.start()
        one.run(20)
        for ahead in (3600.0, 0.0):
            ahead_s[0] = ahead
            one.run(40)
        one.stop()
        told = [event.text for event in one.events() if event.kind == "clock"]
        assert [text.rsplit(" by ")[1][:5] for text in told] == ["3600.", "-3600"]
        assert one.alarms() == []
        assert one.gaps() == []
        with open_test(one.path) as reader:
            rows = reader.rows()
    steps = np.diff(rows["host_time"])
    assert [round(step / 3600.0) for step in steps if abs(step) > 1800.0] == [1, -1]
    assert np.all(np.diff(rows["time"]) < 60.0)


@pytest.mark.long
@pytest.mark.parametrize("name", [GSV8, DATAQ])
def test_a_simulated_rig_that_does_not_run_is_silent_and_has_no_gap(
    tmp_path: Path, name: str
) -> None:
    """Its crank stands still as well, so that no samples are missing when it runs again."""
    with rig(name, "20", tmp_path) as one:
        one.start()
        one.run()
        os.kill(one.devices.process.pid, signal.SIGSTOP)
        eventually(lambda: one.engine.status().alarms)
        os.kill(one.devices.process.pid, signal.SIGCONT)
        rows = one.engine.status().test.revolution
        one.ready()
        assert one.alarms()[0] in {"drive_silent", "stale_data", "device_lost"}
        assert not WRONG.intersection(one.alarms())
        assert one.gaps() == []
        with open_test(one.path) as reader:
            assert len(reader.rows()) >= rows
