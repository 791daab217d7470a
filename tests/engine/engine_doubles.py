"""A rig in memory: a crank whose time advances with the samples that are read from it.

``FakeSource`` and ``FakeSpindle`` satisfy the drivers' Protocols. Faults are switched on by setting
an attribute; everything else is deterministic.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from patience import PATIENCE_S

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.recipe import (
    CyclesSection,
    LimitRule,
    LimitsSection,
    PredictionSection,
    RunSection,
    TestFile,
)
from rigapp.config.rig import (
    DeviceSection,
    EncoderSection,
    LoadCellSection,
    ProbesSection,
    RigFile,
    SimulationSection,
    SpindleSection,
)
from rigapp.engine.drive.timing import Timing
from rigapp.engine.engine import Engine
from rigapp.engine.recording.store import Opened, OpenRequest, OpenStore
from rigapp.schema.channels import BASE
from rigapp.schema.messages import Event, FinishReason, PathReport
from rigapp.schema.states import ENDED
from rigapp.simulation.constants import packaged_parameters
from rigapp_drivers.api import (
    Block,
    ChannelSpec,
    DataRequest,
    DeviceFault,
    DeviceLost,
    DriveRequest,
    DriverInfo,
    DriverKind,
    DriveStatus,
    Identity,
    Quality,
    ReplyTimeout,
    SettingSpec,
    StreamSetup,
)

COUNTS = 360
RATE = 480.0
BLOCK = 48
GAIN = 200.0
WATCHDOG_S = 0.3


@dataclass
class Crank:
    """The turning part: a speed that ramps to a target."""

    position_rev: float = 0.25
    speed: float = 0.0
    target: float = 0.0
    acceleration: float = 10.0
    powered: bool = True
    jammed: bool = False
    deaf: bool = False
    fed_at: float = math.inf
    lock: threading.Lock = field(default_factory=threading.Lock)

    turned_at: float = 0.0

    def turn(self, samples: int) -> NDArray[np.float64]:
        """Advance and return the position at each sample, in revolutions."""
        step = 1.0 / RATE
        self.turned_at = time.monotonic()
        with self.lock:
            if self.turned_at - self.fed_at > WATCHDOG_S:
                self.powered = False
            target, most = self.target if self.powered else 0.0, self.acceleration * step
            speeds = np.empty(samples)
            for i in range(samples):  # no NumPy for single numbers: it costs ten times as much
                self.speed += min(max(target - self.speed, -most), most)
                speeds[i] = self.speed = 0.0 if self.jammed else self.speed
            turns = self.position_rev + step * np.cumsum(speeds)
            self.position_rev += step * float(speeds.sum())
        return turns


class FakeSource:
    """A data source in memory."""

    def __init__(self, name: str, port: str, crank: Crank) -> None:
        self.name, self.port, self.crank = name, port, crank
        self.force_N = 50.0
        self.lost = False
        self.silent = False
        self.broken: BaseException | None = None
        self.encoder_dead = False
        self.encoder_back = False
        self.index_dead = False
        self.lose_samples = 0
        self.quality = Quality.GOOD
        self.saturated: int | None = None
        # Samples from now on until the crank jams and the first bridge saturates.
        self.jam_at: int | None = None
        self.opened = False
        self.open_fails = False
        self.streaming = False
        self.reads = 0
        self._sample = self._sequence = 0
        self._dead_count = 0.0

    def open(self) -> Identity:
        if self.open_fails or self.lost:
            raise DeviceLost(self.name, self.port, "nothing answers")
        self.opened = True
        return Identity("test", "memory source", "1", "1", self.port)

    def configure(self, request: DataRequest) -> StreamSetup:
        assert request.inputs["analog_1"] == ("bridge", 3.5)
        assert request.inputs["counter_1"] == ("counter", float(COUNTS))
        channels = (
            ChannelSpec("analog_1", "mV/V"),
            ChannelSpec("analog_2", "mV/V"),
            ChannelSpec("analog_3", "V"),
            ChannelSpec("analog_4", "V"),
            ChannelSpec("counter_1", "count"),
        )
        return StreamSetup(channels, request.sample_rate_Hz, {"rate": request.sample_rate_Hz})

    def start(self) -> None:
        self.streaming = True
        self._sample = self._sequence = 0

    def read(self, timeout_s: float) -> Block | None:
        if self.broken is not None:
            raise self.broken
        if self.lost:
            raise DeviceLost(self.name, self.port, "the cable was pulled")
        if self.silent or not self.streaming:
            time.sleep(min(timeout_s, 0.01))
            return None
        self.reads += 1
        time.sleep(0.0005)
        lost, self.lose_samples = self.lose_samples, 0
        if lost:
            self.crank.turn(lost)
        jam_at = self.jam_at
        if jam_at is not None:
            self.jam_at = jam_at - BLOCK if jam_at >= BLOCK else None
        if jam_at is None or self.jam_at is not None:
            turns, jam_at = self.crank.turn(BLOCK), None
        else:
            before = self.crank.turn(jam_at)
            self.crank.jammed = True
            turns = np.append(before, self.crank.turn(BLOCK - jam_at))
        angle = 2 * np.pi * turns
        values = np.empty((5, BLOCK), np.float32)
        values[0] = -self.force_N / GAIN * np.cos(angle)
        values[1] = -self.force_N / GAIN * np.sin(angle)
        values[2] = 0.1 * np.cos(angle)
        values[3] = 0.1 * np.sin(angle)
        seen = -turns if self.encoder_back else turns
        count = np.floor(seen * COUNTS + 1e-9)
        values[4] = count if self.index_dead else count % COUNTS
        if self.encoder_dead:
            values[4] = self._dead_count
        self._dead_count = float(values[4, -1])
        quality = np.full(BLOCK, self.quality, np.uint8)
        if self.saturated is not None:
            values[self.saturated] = 1.05 * 3.5 if self.saturated < 2 else 10.0
            quality |= np.uint8(Quality.SATURATED)
        if jam_at is not None:
            values[0, jam_at : jam_at + 2] = 1.05 * 3.5
            quality[jam_at : jam_at + 2] |= np.uint8(Quality.SATURATED)
        self._sample += lost
        block = Block(
            device=self.name,
            sequence=self._sequence,
            first_sample=self._sample,
            sample_rate_Hz=RATE,
            host_time_ns=time.monotonic_ns(),
            values=values,
            quality=quality,
            lost_before=lost,
        )
        self._sample += BLOCK
        self._sequence += 1
        return block

    def counters(self) -> dict[str, int]:
        return {"bytes_received": 4096, "crc_errors": 2}

    @property
    def gives(self) -> bool:
        """Tell whether samples come, so that the crank turns when they are read."""
        return self.streaming and not (self.lost or self.silent or self.broken is not None)

    def zero(self, inputs: Sequence[str]) -> None:
        raise NotImplementedError("the engine averages the samples for a zero itself")

    def stop(self) -> None:
        self.streaming = False

    def close(self) -> None:
        self.opened = False
        self.streaming = False


class FakeSpindle:
    """A drive in memory."""

    def __init__(self, name: str, port: str, crank: Crank) -> None:
        self.name, self.port, self.crank = name, port, crank
        self.lost = False
        self.is_read: Callable[[], bool] = lambda: True
        self.hang: threading.Event | None = None
        self.faults: tuple[str, ...] = ()
        self.cause_remains = False
        self.warnings: tuple[str, ...] = ()
        self.emergency_stop = False
        self.latches_stop = False
        self._stop_latched = False
        self.commands: list[tuple[str, float]] = []
        self.tells_ratio = 1.0
        self.current_A, self.supply_V = 1.0, 48.0
        self.off_at: float | None = None
        self.ignores = 0.0
        self.polls = 0

    def reset_fault(self) -> None:
        if self.cause_remains:
            raise DeviceFault(self.name, self.port, "the cause is still there")
        self.faults = ()
        self._stop_latched = False

    def open(self) -> Identity:
        if self.lost:
            raise DeviceLost(self.name, self.port, "nothing answers")
        return Identity("test", "memory drive", "1", "2", self.port)

    def configure(self, request: DriveRequest) -> Mapping[str, str | float | int]:
        return {"watchdog_s": request.watchdog_timeout_s}

    def set_speed(self, speed_rev_per_s: float, acceleration_rev_per_s2: float) -> None:
        self._alive()
        self.commands.append(("speed", speed_rev_per_s))
        if self._ignored():
            return
        with self.crank.lock:
            self.crank.powered = True
            self.crank.target = speed_rev_per_s
            self.crank.acceleration = acceleration_rev_per_s2

    def drive_off(self) -> None:
        self._alive()
        self.commands.append(("off", 0.0))
        self.off_at = time.monotonic()
        if self._ignored():
            return
        with self.crank.lock:
            self.crank.powered = False
            self.crank.target = 0.0
            self.crank.acceleration = 20.0

    def status(self) -> DriveStatus:
        self._alive()
        self.polls += 1
        self.crank.fed_at = time.monotonic() if self.ignores else math.inf
        if not self.is_read() or time.monotonic() - self.crank.turned_at > 5.0:
            self.crank.turn(BLOCK)  # nobody reads; time goes on
        self._stop_latched |= self.emergency_stop and self.latches_stop
        return DriveStatus(
            host_time_ns=time.monotonic_ns(),
            speed_rev_per_s=self.tells_ratio * self.crank.speed,
            setpoint_rev_per_s=self.crank.target,
            position_count=round(self.crank.position_rev * COUNTS),
            current_A=self.current_A,
            supply_V=self.supply_V,
            temperature_C=30.0,
            enabled=self.crank.powered,
            emergency_stop=self.emergency_stop or self._stop_latched,
            faults=self.faults,
            warnings=self.warnings,
        )

    def close(self) -> None:
        with self.crank.lock:
            self.crank.powered = False
            self.crank.target = 0.0

    def _ignored(self) -> bool:
        """Tell whether a command is confirmed and not obeyed; then its watchdog counts."""
        ignored = self.crank.deaf or self.ignores > 0
        self.ignores = max(0.0, self.ignores - 1)
        self.crank.fed_at = time.monotonic() if self.ignores else math.inf
        return ignored

    def turn_by_itself(self) -> None:
        """Turn as nobody has commanded."""
        with self.crank.lock:
            self.crank.powered, self.crank.target = True, 0.5

    def _alive(self) -> None:
        if self.hang is not None:
            self.hang.wait(30.0)
        if self.lost:
            with self.crank.lock:  # what the drive's watchdog does
                self.crank.powered = False
            raise ReplyTimeout(self.name, self.port, "no answer in 0.1 s")


@dataclass
class FakeStore:
    """A test file in memory. Set ``broken`` to make it fail like a full disk."""

    rows: list[NDArray[np.float64]] = field(default_factory=list)
    cycles: list[tuple[int, dict[str, ArrayLike]]] = field(default_factory=list)
    whys: list[tuple[int, str, int]] = field(default_factory=list)
    unfinished: list[tuple[int, dict[str, ArrayLike], int]] = field(default_factory=list)
    predictions: list[NDArray[np.float64]] = field(default_factory=list)
    curves: int = 0
    profiles: list[tuple[int, dict[str, ArrayLike]]] = field(default_factory=list)
    checkpoint: tuple[int, bytes] | None = None
    events: list[Event] = field(default_factory=list)
    gaps: list[Event] = field(default_factory=list)
    safe: int = 0
    ending: tuple[str, str, str] | None = None
    closed: bool = False
    discarded: bool = False
    broken: BaseException | None = None
    commit_waits: threading.Event | None = None
    cycles_refused: int = 0
    room: int = 1_000_000
    path: Path = Path("test.h5")
    looked_after: PathReport | None = None

    def watch_path(self, notice: Callable[[str], object]) -> PathReport | None:
        if self.looked_after is not None:
            notice("t.h5 lost its name; everything in it is being saved.")
        return self.looked_after

    def extend(self, revolutions: int) -> None:
        if revolutions > self.room:
            raise UnusableInput(f"the file has room for {self.room} revolutions")
        self.room = max(self.room, revolutions)

    @property
    def revolutions(self) -> int:
        return len(self.rows)

    def _check(self) -> None:
        assert not self.closed
        if self.broken is not None:
            raise self.broken

    def append_row(self, values: NDArray[np.float64]) -> None:
        self._check()
        self.rows.append(values.copy())

    def append_cycle(
        self, revolution: int, columns: Mapping[str, ArrayLike], why: str, quality: int
    ) -> bool:
        self._check()
        self.cycles.append((revolution, {k: np.array(v) for k, v in columns.items()}))
        self.whys.append((revolution, why, quality))
        return True

    def append_unfinished(
        self, revolution: int, columns: Mapping[str, ArrayLike], quality: int
    ) -> bool:
        self._check()
        self.unfinished.append((revolution, {k: np.array(v) for k, v in columns.items()}, quality))
        return True

    def append_prediction(self, values: NDArray[np.float64]) -> bool:
        self._check()
        self.predictions.append(values)
        return True

    def append_curves(self, revolution: int, curves: Mapping[str, ArrayLike]) -> bool:
        self._check()
        self.curves += 1
        return True

    def append_profile(self, values: NDArray[np.float64], curves: Mapping[str, ArrayLike]) -> bool:
        self._check()
        self.profiles.append((int(values[0]), {k: np.array(v) for k, v in curves.items()}))
        return True

    def hold_cycle(
        self, revolution: int, columns: Mapping[str, ArrayLike], why: str, quality: int
    ) -> None:
        self._check()
        self.held = revolution

    def keep_checkpoint(self, revolution: int, state: bytes) -> None:
        self._check()
        self.checkpoint = (revolution, state)

    def append_event(self, event: Event) -> bool:
        self.events.append(event)
        return True

    def note_gap(self, event: Event) -> None:
        self.gaps.append(event)

    def place(self) -> None:
        if not self.closed:
            self._check()

    def commit(self) -> int:
        self._check()
        if self.commit_waits is not None:
            self.commit_waits.wait(30.0)
        self.safe = len(self.rows)
        return self.safe

    def finish(self, status: str, reason_code: str, sentence: str) -> None:
        self.commit()
        self.ending = (status, reason_code, sentence)

    def close(self) -> None:
        self.closed = True

    def discard(self) -> None:
        assert not self.rows
        self.discarded = self.closed = True

    def column(self, name: str) -> NDArray[np.float64]:
        return np.array([row[BASE.place[name]] for row in self.rows])


@dataclass
class MemoryRig:
    """Everything of a rig in memory, with an engine on it."""

    crank: Crank = field(default_factory=Crank)
    simulated: bool = True
    timing: Timing = field(
        default_factory=lambda: Timing(
            read=0.02,
            poll=0.02,
            commit=0.05,
            supervise=0.01,
            silence=4.0,
            silence_commit=4.0,
            stop_margin=1.0,
            coast=1.5,
            start_margin=15.0,
            zero=0.2,
        )
    )
    stores: list[FakeStore] = field(default_factory=list)
    requests: list[OpenRequest] = field(default_factory=list)
    opened: Opened | None = None
    latency_ms: float = 0.0
    measured: list[Any] = field(default_factory=list)
    open_store: OpenStore | None = None

    def __post_init__(self) -> None:
        self.source = FakeSource("daq", "memory", self.crank)
        self.spindle = FakeSpindle("drive", "memory", self.crank)
        self.engine = Engine(
            Document(Path("rig.toml"), "rig text", self.rig_file()),
            ports={"daq": "memory", "drive": "memory"},
            load=self._load,
            open_store=self.open_store or self._open,
            timing=self.timing,
            on_measured=self.measured.append,
        )

        self.spindle.is_read = self._is_read

    def _is_read(self) -> bool:
        """Tell whether the engine still reads the samples with which the crank turns."""
        connection = self.engine._connection
        if connection is None or any(one.ended for one in connection.workers):
            return False
        return self.source.gives and connection.reader.well and connection.process.well

    @property
    def store(self) -> FakeStore:
        return self.stores[-1]

    def rig_file(self) -> RigFile:
        port = "simulated" if self.simulated else "memory"
        return RigFile(
            schema=1,
            name="Rig in memory",
            devices={
                "daq": DeviceSection("memory source", port, {"sample_rate_Hz": RATE}),
                "drive": DeviceSection("memory drive", port),
            },
            spindle=SpindleSection("drive", COUNTS, 400.0, watchdog_timeout_s=WATCHDOG_S),
            encoder=EncoderSection("daq", "counter_1", COUNTS),
            load_cell=LoadCellSection(
                "daq",
                "analog_1",
                "analog_2",
                ((GAIN, 0.0), (0.0, GAIN)),
                latency_ms=(self.latency_ms, self.latency_ms),
            ),
            probes=ProbesSection("daq", "analog_3", "analog_4", (100.0, 100.0)),
            simulation=SimulationSection(speed="max") if self.simulated else None,
        )

    def _load(self, name: str) -> DriverInfo:
        if name == "memory source":
            return DriverInfo(
                name,
                "",
                DriverKind.DATA_SOURCE,
                lambda *_: self.source,
                {"sample_rate_Hz": SettingSpec(float, RATE, "Sample rate.")},
            )
        return DriverInfo(name, "", DriverKind.SPINDLE, lambda *_: self.spindle)

    def _open(self, request: OpenRequest) -> Opened:
        self.requests.append(request)
        if self.opened is not None:
            opened, self.opened = self.opened, None
            assert isinstance(opened.store, FakeStore)
            self.stores.append(opened.store)
            return opened
        self.stores.append(FakeStore(path=request.path))
        return Opened(self.store)

    def start(self, test: TestFile | None = None, **options: Any) -> None:
        """Start a test as an operator would."""
        document = Document(Path("test.toml"), "test text", test or a_test())
        self.engine.start(document, Path("memory.h5"), operator="Ada", **options)

    @property
    def is_stationary(self) -> bool:
        """Tell whether the crank is stationary for good: no speed, nothing that would turn it."""
        return abs(self.crank.speed) < 1e-6 and (not self.crank.powered or self.crank.target == 0.0)


def a_test(
    revolutions: int = 20,
    rpm: float = 120.0,
    every: int = 5,
    rules: tuple[LimitRule, ...] = (),
    schedule: Any = "every",
    overload_N: float = 380.0,
) -> TestFile:
    """Return a short test."""
    return TestFile(
        schema=1,
        title="A short test",
        run=RunSection(revolutions, rpm, acceleration_rpm_per_s=600.0),
        model=packaged_parameters(),
        cycles=CyclesSection(schedule, every, 3, before_alarm=0, after_alarm=0),
        limits=LimitsSection(
            overload_N=overload_N, overspeed_rpm=200.0, stale_data_s=3.0, rule=rules
        ),
        prediction=PredictionSection(),
    )


def eventually(condition: Any, seconds: float = PATIENCE_S) -> None:
    """Wait until a condition holds; fail with its name when it does not in time."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"did not come about in {seconds} s"
        time.sleep(0.001)


def back_to_work(rig: MemoryRig) -> None:
    """Repair, reconnect, acknowledge, reset, and run a test to its end."""
    rig.engine.connect()
    # A repaired fault ends with the next look of the thread that monitors it.
    eventually(lambda: not any(one.active for one in rig.engine.status().alarms))
    rig.engine.acknowledge(operator="Ada")
    rig.engine.reset("Ada")
    rig.start(a_test(5))
    rig.engine.wait(ENDED, 60.0)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.COMPLETE
