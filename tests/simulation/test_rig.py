"""The rig's loop on a clock of the test's own, with doubles of both devices."""

from __future__ import annotations

import math
import os
import select
import struct
import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import ChannelSection, RigFile
from rigapp.schema.faults import FaultRecord
from rigapp.simulation import devices
from rigapp.simulation.handle import Lines, answer
from rigapp.simulation.rig import RigSimulation
from rigapp.simulation.truth import COLUMNS, TruthRecorder
from rigapp.simulation.wire.pty import PtyEndpoint
from rigapp_drivers.edge import failure_words
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState, RigSignals

NONE: Mapping[str, ChannelSection] = {}
FREE = {
    "third_probe": ChannelSection(device="daq", input="analog_5", unit="um"),
    "bushing_temperature": ChannelSection(device="daq", input="analog_6", unit="degC", scale=100.0),
    "room": ChannelSection(source="climate.temperature_C"),
}
FRAME = 24
PTY_S = 17408 / FRAME / 960.0
"""Plant time of what a pty takes in before it shows that the host does not read."""


class Source:
    """A data source that streams on S, stops on P, 24 bytes a sample."""

    sample_rate_Hz = 960.0
    streaming = False

    def __init__(self) -> None:
        self.overruns = 0
        self.signals: list[RigSignals] = []

    def receive(self, data: bytes, now_s: float) -> bytes:
        for byte in data:
            self.streaming = {ord("S"): True, ord("P"): False}.get(byte, self.streaming)
        return b"k" * len(data)

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        self.signals.append(signals)
        return b"\xaa" * FRAME * signals.shaft_revolutions.size if self.streaming else b""

    def overrun(self, now_s: float) -> None:
        self.overruns += 1


class Motor:
    """A drive that takes a speed in rev/s a line, ramps at 10 rev/s2, and watches the host."""

    watchdog_s = 0.5

    def __init__(self) -> None:
        self.target = self.setpoint = 0.0
        self.fed: float | None = None
        self.watchdog_tripped = False
        self.state = MotorState(0, 0.0, 0.0)
        self.faults: list[tuple[str, dict[str, Any]]] = []

    def receive(self, data: bytes, now_s: float) -> bytes:
        self.fed = now_s
        self.target = float(data.split()[-1])
        return b"\xff"

    def command(self, elapsed_s: float, now_s: float) -> DriveCommand:
        if self.fed is None:
            return DriveCommand(DriveMode.OFF)
        if now_s - self.fed > self.watchdog_s:
            self.watchdog_tripped = True
            return DriveCommand(DriveMode.OFF)
        gap = self.target - self.setpoint
        self.setpoint += max(-10.0 * elapsed_s, min(10.0 * elapsed_s, gap))
        return DriveCommand(DriveMode.VELOCITY, speed_count_per_s=self.setpoint * 3600.0)

    def observe(self, state: MotorState) -> None:
        self.state = state

    def emit(self, now_s: float) -> bytes:
        return b""

    def inject(self, kind: str, **data: Any) -> None:
        if kind != "driver_fault":
            raise ValueError(f"{kind} is unknown")
        self.faults.append((kind, data))

    def clear(self, kind: str) -> None:
        self.faults.append((f"no {kind}", {}))


class Bench:
    """The rig, both hosts' ends and a clock that the test turns."""

    def __init__(self, rig: RigSimulation, source: Source, motor: Motor) -> None:
        self.rig, self.source, self.motor = rig, source, motor
        self.now = 1000.0
        self.hosts: dict[str, int] = {}
        self.heard = 0

    def open(self, name: str) -> None:
        flags = os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK
        self.hosts[name] = os.open(self.rig.urls[name], flags)

    def close(self, name: str) -> None:
        os.close(self.hosts.pop(name))

    def say(self, name: str, data: bytes) -> None:
        os.write(self.hosts[name], data)

    def run(self, wall_s: float, *, feed: bytes = b"", read: bool = True) -> None:
        """Let the wall clock run in passes of 5 ms; feed the drive and read the stream."""
        for _ in range(round(wall_s / 0.005)):
            self.now += 0.005
            if feed:
                self.say("drive", feed)
            self.rig.step(self.now)
            if read and "daq" in self.hosts:
                self.heard += self.take()

    def take(self, settle_s: float = 0.0) -> int:
        """Read what is there; the kernel passes it on a little after it was written."""
        count = 0
        while select.select([self.hosts["daq"]], [], [], settle_s)[0]:
            count += len(os.read(self.hosts["daq"], 65536))
        return count


@pytest.fixture
def make(
    rig: RigFile, parameters: ParameterFile, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Callable[..., Bench]]:
    source, motor = Source(), Motor()
    monkeypatch.setattr(devices, "_load", lambda name, device, kind: (name, {}))
    made = {"daq": source, "drive": motor}
    monkeypatch.setattr(devices, "_simulator", lambda name, *_: made[name])
    benches: list[Bench] = []

    def endpoint(name: str) -> PtyEndpoint:
        return PtyEndpoint(tmp_path / name, lambda: benches[0].now if benches else 1e3)

    def build(
        speed: float = 1.0, channels: Mapping[str, ChannelSection] = NONE, **options: Any
    ) -> Bench:
        wanted = msgspec.structs.replace(rig, channels=dict(channels))
        simulation = RigSimulation(wanted, parameters, endpoint, speed=speed, now_s=1e3, **options)
        benches.append(Bench(simulation, source, motor))
        return benches[0]

    yield build
    for bench in benches:
        for host in bench.hosts.values():
            os.close(host)
        bench.rig.close()


def test_command_turns_the_spindle_and_the_drive_sees_it(make: Callable[..., Bench]) -> None:
    bench = make()
    bench.open("drive")
    bench.run(3.0, feed=b"1.0\n")
    report = bench.rig.report()
    assert report["speed_rpm"] == pytest.approx(60.0, rel=0.03)
    assert bench.motor.state.speed_count_per_s == pytest.approx(3600.0, rel=0.03)
    turned = bench.motor.state.position_count / 3600.0
    assert turned == pytest.approx(report["revolutions"], abs=1e-3)
    assert turned == pytest.approx(2.9, abs=0.1)
    assert report["time_s"] == pytest.approx(3.0, abs=0.05)


def test_negative_direction_turns_the_other_way(
    make: Callable[..., Bench], monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = make()
    monkeypatch.setattr(bench.rig, "_direction", -1)
    bench.open("drive")
    bench.run(1.0, feed=b"1.0\n")
    assert bench.rig.report()["revolutions"] < -0.5
    assert bench.motor.state.position_count > 1800


def test_silent_host_stops_the_spindle_at_any_speed(make: Callable[..., Bench]) -> None:
    bench = make(math.inf)
    bench.open("daq")
    bench.open("drive")
    bench.say("daq", b"S")
    bench.run(0.2, feed=b"1.0\n")
    ahead = bench.rig.report()["time_s"]
    assert ahead > 0.8, "the plant runs as fast as the host takes the data"
    bench.close("daq")
    bench.close("drive")
    bench.run(0.4, read=False)
    assert not bench.motor.watchdog_tripped
    bench.run(0.2, read=False)
    assert bench.motor.watchdog_tripped
    report = bench.rig.report()
    assert report["drive_mode"] == "off"
    assert report["time_s"] - ahead < 0.7 + PTY_S, "without a host the plant runs in real time"
    bench.run(30.0, read=False)
    assert bench.rig.still()


def test_hung_host_gets_real_time_and_overruns_not_a_standing_plant(
    make: Callable[..., Bench],
) -> None:
    bench = make(math.inf)
    bench.open("daq")
    bench.say("daq", b"S")
    bench.run(0.1)
    before = bench.rig.report()["time_s"]
    bench.run(10.0, read=False)
    passed = bench.rig.report()["time_s"] - before
    assert 9.9 < passed < 10.1 + PTY_S
    assert bench.source.overruns > 0
    assert bench.rig.report()["overruns"]["daq"] == bench.source.overruns


def test_real_time_stream_loses_nothing(make: Callable[..., Bench]) -> None:
    bench = make()
    bench.open("daq")
    bench.open("drive")
    bench.say("daq", b"S")
    bench.run(2.0, feed=b"5.0\n")
    samples = sum(s.shaft_revolutions.size for s in bench.source.signals)
    shaft = np.concatenate([s.shaft_revolutions for s in bench.source.signals])
    assert samples == pytest.approx(1920, abs=25)
    expected = len(b"k") + FRAME * samples
    deadline = time.monotonic() + 60.0
    while bench.heard < expected and time.monotonic() < deadline:
        bench.heard += bench.take()
    assert bench.heard == expected
    assert bench.source.overruns == 0
    assert np.abs(np.diff(shaft)).max() < 6.0 / 960.0
    assert set(bench.source.signals[0].analog) == {1, 2, 3, 4}


def test_what_the_host_has_not_seen_stays_below_a_fifth_of_a_turn(
    make: Callable[..., Bench],
) -> None:
    bench = make(math.inf)
    bench.open("daq")
    bench.open("drive")
    bench.say("daq", b"S")
    bench.run(0.3, feed=b"1.0\n")
    bench.take(settle_s=0.005)
    for _ in range(50):
        bench.run(0.005, feed=b"1.0\n", read=False)
        unseen = bench.take(settle_s=0.005)
        # Two chunks and what real time asks for in 5 ms.
        assert unseen <= FRAME * 960 * (1 / 5 + 0.012)


def test_faults_come_and_go_on_their_clocks(make: Callable[..., Bench]) -> None:
    faults = (
        FaultRecord("cable_pull", device="daq", at_s=0.5, duration_s=0.25),
        FaultRecord("stuck_value", channel="force_2", at_revolution=1.0, duration_s=0.5),
        FaultRecord("driver_fault", device="drive", at_s=0.1, duration_s=0.2, count=2),
    )
    bench = make(faults=faults)
    bench.open("drive")
    bench.run(0.45, feed=b"2.0\n")
    tried, struck = bench.motor.faults[:2], bench.motor.faults[2:]
    assert tried == struck == [("driver_fault", {"count": 2}), ("no driver_fault", {})]
    url = bench.rig.urls["daq"]
    assert os.path.exists(url)
    bench.run(0.15, feed=b"2.0\n")
    assert not os.path.exists(url)
    bench.run(0.25, feed=b"2.0\n")
    assert os.path.exists(url)
    bench.run(1.0, feed=b"2.0\n")
    shaft = np.concatenate([s.shaft_revolutions for s in bench.source.signals])
    signal = np.concatenate([s.analog[2] for s in bench.source.signals])
    still = np.convolve(np.diff(signal) == 0.0, np.ones(300), "valid") == 300
    assert shaft[np.argmax(still)] == pytest.approx(1.0, abs=0.1)
    assert 400 < 300 + still.sum() < 520, "stuck for half a second, then alive again"


@pytest.mark.parametrize(
    ("fault", "sentence"),
    [
        (FaultRecord("cable_pull", device="dac"), "'dac' is not in the rig"),
        (FaultRecord("stuck_value"), "channel is missing"),
        (FaultRecord("rust", device="drive"), "cannot have it"),
        (FaultRecord("saturated_input", channel="probe_3"), "choose one of force_1, .*third_probe"),
        (FaultRecord("swapped_bridges", channel="third_probe"), "choose one of force_1, force_2"),
        (FaultRecord("stuck_value", channel="room"), "has no input; give device = 'climate'"),
    ],
)
def test_impossible_fault_is_refused(
    make: Callable[..., Bench], fault: FaultRecord, sentence: str
) -> None:
    bench = make(channels=FREE)
    with pytest.raises(UnusableInput, match=sentence):
        bench.rig.inject(fault)


def test_signal_faults_do_what_they_say(make: Callable[..., Bench]) -> None:
    bench = make()
    bench.rig.inject(FaultRecord("broken_bridge_wire", channel="force_1"))
    bench.rig.inject(FaultRecord("saturated_input", channel="probe_2", value=-1.0))
    bench.rig.inject(FaultRecord("slip_ring_spikes", channel="force_2", value=2.0, rate_per_s=20))
    bench.run(10.0)
    analog = {k: np.concatenate([s.analog[k] for s in bench.source.signals]) for k in (1, 2, 3, 4)}
    assert np.all(analog[1] > 100.0)
    assert np.all(analog[4] < -100.0)
    assert np.abs(analog[3]).max() < 10.0
    spikes = np.abs(analog[2] - np.median(analog[2])) > 1.0
    assert 120 < spikes.sum() < 290
    bench.rig.clear("broken_bridge_wire")
    bench.run(0.1)
    assert np.all(np.abs(bench.source.signals[-1].analog[1]) < 5.0)


def test_the_signal_of_a_free_channel_is_spoilt_alone(make: Callable[..., Bench]) -> None:
    bench = make(channels=FREE)
    bench.rig.inject(FaultRecord("saturated_input", channel="third_probe", duration_s=1.0))
    bench.rig.inject(FaultRecord("stuck_value", channel="bushing_temperature"))
    bench.run(0.5)
    analog = bench.source.signals[-1].analog
    assert set(analog) == {1, 2, 3, 4, 5, 6}
    assert np.all(analog[5] > 100.0)
    assert np.ptp(analog[6]) == 0.0
    assert all(np.ptp(analog[k]) > 0.0 and np.abs(analog[k]).max() < 10.0 for k in (1, 2, 3, 4))
    bench.run(1.0)
    assert np.abs(bench.source.signals[-1].analog[5]).max() < 1.0


def test_jam_stalls_the_motor_at_its_torque_limit(make: Callable[..., Bench]) -> None:
    bench = make()
    bench.open("drive")
    bench.run(1.5, feed=b"1.0\n")
    bench.rig.inject(FaultRecord("jam", duration_s=1.0))
    bench.run(0.5, feed=b"1.0\n")
    report = bench.rig.report()
    assert report["speed_rpm"] == 0.0
    assert report["motor_torque_Nm"] == pytest.approx(6.0)
    assert bench.motor.state.current_A == pytest.approx(6.0 / 0.573)
    bench.run(1.5, feed=b"1.0\n")
    assert bench.rig.report()["speed_rpm"] == pytest.approx(60.0, rel=0.05)


def test_control_channel_answers_every_line(make: Callable[..., Bench]) -> None:
    bench = make()
    lines = Lines()
    assert lines.feed(b'{"query": "st') == []
    (line,) = lines.feed(b'ate"}\n\n')
    assert b'"wear_depth_um"' in answer(bench.rig, line)
    assert answer(bench.rig, b'{"fault": "jam", "value": 3.0}') == b'{"ok":true}\n'
    assert bench.rig._disturbances.jam_Nm == 3.0
    assert answer(bench.rig, b'{"clear": "jam"}') == b'{"ok":true}\n'
    assert bench.rig._disturbances.jam_Nm == 0.0
    for wrong in (b"nonsense", b"[]", b"{}", b'{"query": "x"}', b'{"fault": "jam", "size": 1}'):
        assert answer(bench.rig, wrong).startswith(b'{"error":')


def test_wear_of_an_earlier_test_is_set_while_the_crank_stands(make: Callable[..., Bench]) -> None:
    bench = make()
    line = b'{"state": {"wear_depth_um": 12.5, "worn_area_mm2": 0.25}}'
    assert answer(bench.rig, line) == b'{"ok":true}\n'
    report = bench.rig.report()
    assert report["wear_depth_um"] == pytest.approx(12.5)
    assert report["worn_area_mm2"] == pytest.approx(0.25)
    for wrong, why in (
        (b'{"state": {"wear_depth_um": -1.0}}', b"not possible"),
        (b'{"state": {"depth": 1.0}}', b"unknown field `depth`"),
        (b'{"state": 3}', b"object"),
    ):
        reply = answer(bench.rig, wrong)
        assert reply.startswith(b'{"error":')
        assert why in reply
    bench.open("drive")
    bench.run(1.0, feed=b"1.0\n")
    assert b"the spindle turns" in answer(bench.rig, line)
    assert bench.rig.report()["wear_depth_um"] > 12.5


def test_truth_is_thinned_to_the_room(make: Callable[..., Bench], tmp_path: Path) -> None:
    path = tmp_path / "truth.npz"
    bench = make(truth=TruthRecorder(path, stride=1, room=500))
    bench.open("drive")
    bench.run(4.0, feed=b"1.0\n")
    bench.rig.close()
    with np.load(path) as truth:
        assert sorted(truth.files) == sorted(COLUMNS)
        number = truth["sample"]
        assert 125 < number.size <= 500
        assert len(set(np.diff(number))) == 1
        assert number[-1] > 3700
        time = truth["time_s"]
        np.testing.assert_allclose(time, number / 960.0, atol=1e-9)


@pytest.mark.sampled(every=5)
@pytest.mark.parametrize("error", [KeyError("x"), SystemExit(2), struct.error("4 bytes")], ids=str)
@pytest.mark.parametrize(
    ("name", "method"),
    [
        *(("daq", one) for one in ("receive", "sample")),
        *(("drive", one) for one in ("receive", "emit", "command", "observe")),
    ],
)
def test_a_simulator_that_raises_falls_silent_and_the_rig_goes_on(
    make: Callable[..., Bench],
    capsys: pytest.CaptureFixture[str],
    name: str,
    method: str,
    error: BaseException,
) -> None:
    bench = make()
    for one in ("drive", "daq"):
        bench.open(one)
    bench.say("daq", b"S")
    bench.run(0.5, feed=b"1.0\n")
    assert bench.heard > 0

    def fails(*_: Any) -> Any:
        raise error

    device = {"daq": bench.source, "drive": bench.motor}[name]
    setattr(device, method, fails)
    before_s = bench.rig.report()["time_s"]
    # What was called once is called as it was then: the guard keeps it.
    vars(bench.rig._devices[name].simulator).pop(method, None)
    bench.say("daq", b"S")
    bench.run(0.5, feed=b"1.0\n")
    heard, report = bench.heard, bench.rig.report()
    assert report["time_s"] > before_s + 0.4
    assert f"The simulator of {name} has failed ({failure_words(error)})" in report["failed"][name]
    assert "author of the package rigapp" in report["failed"][name]
    assert [key for key, words in report["failed"].items() if words] == [name]
    assert capsys.readouterr().err.count("has failed") == 1
    bench.run(0.2, feed=b"1.0\n")
    assert (bench.heard > heard) == (name == "drive")
    if name == "drive":
        assert report["drive_mode"] == "off"
