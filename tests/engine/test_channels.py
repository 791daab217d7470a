"""Free channels beside load cell and probes: sampled with them, slow ones, limits, the file."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.checks.check import Check, CheckVerdict
from rigapp.checks.start import preflight
from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, parse_test
from rigapp.config.recipe import LimitRule
from rigapp.config.rig import ChannelSection, DeviceSection, RigFile
from rigapp.engine.engine import Engine
from rigapp.engine.recording.store import missing_channels, open_file
from rigapp.engine.samples import slow
from rigapp.engine.samples.assembler import Assembler, EncoderSetup
from rigapp.engine.values.calibrate import Measured, calibrate
from rigapp.engine.values.corrections import follow
from rigapp.engine.values.instruments import InputLine
from rigapp.engine.values.reduce import Reducer
from rigapp.schema.channels import BASE, Channel, ChannelTable, Kind
from rigapp.schema.messages import FinishReason
from rigapp.schema.states import ENDED
from rigapp.schema.wire import json_bytes
from rigapp.storage import open_test
from rigapp.storage.structure.build import detectors
from rigapp.viewer.channels import table_of
from rigapp_drivers.api import (
    Block,
    ChannelSpec,
    DataRequest,
    DeviceLost,
    DriverInfo,
    DriverKind,
    Identity,
    Quality,
    SlowRequest,
    StreamSetup,
)
from tests.engine.calibrations import calibration_by_hand
from tests.engine.engine_doubles import FakeSource, MemoryRig, a_test, eventually

FREE = {
    "bushing_temperature": ChannelSection(
        device="daq", input="analog_5", unit="degC", scale=100.0, offset_V=0.1
    ),
    "gap": ChannelSection(
        device="daq",
        input="analog_6",
        unit="mm",
        table=((0.0, 5.0), (1.0, 3.0), (2.0, 2.5)),
        uncertainty=0.02,
    ),
    "room_temperature": ChannelSection(source="climate.temperature_C"),
    "motor_current": ChannelSection(source="drive.current_A"),
}
QUICK = Path(__file__).resolve().parents[2] / "examples" / "quick.toml"
TOLD = {"temperature_C": 21.5, "humidity_percent": 40.0}


class WiredSource(FakeSource):
    """The rig in memory with two inputs more: 0.5 V, and 1 V plus the cosine of the crank angle."""

    bushing_V = 0.5

    def configure(self, request: DataRequest) -> StreamSetup:
        self.asked = dict(request.inputs)
        setup = super().configure(request)
        more = (ChannelSpec("analog_5", "V"), ChannelSpec("analog_6", "V"))
        return replace(setup, channels=(*setup.channels, *more))

    def read(self, timeout_s: float) -> Block | None:
        block = super().read(timeout_s)
        if block is None:
            return None
        cosine = block.values[2] / 0.1
        more = np.stack((np.full_like(cosine, self.bushing_V), 1.0 + cosine))
        values = np.ascontiguousarray(np.concatenate((block.values, more)), np.float32)
        return Block(
            block.device, block.sequence, block.first_sample, block.sample_rate_Hz,
            block.host_time_ns, values, block.quality, block.lost_before,
        )  # fmt: skip


class Thermometer:
    """A slow source in memory; set ``lost`` to pull its cable."""

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name, self.port = name, port
        self.lost = False
        self.opened = 0
        self.told: dict[str, float] = dict(TOLD)
        self.request: SlowRequest | None = None

    def open(self) -> Identity:
        if self.lost:
            raise DeviceLost(self.name, self.port, "no answer")
        self.opened += 1
        return Identity("test", "thermometer", "1", "3", self.port)

    def configure(self, request: SlowRequest) -> Mapping[str, str | float | int]:
        self.request = request
        return {}

    def read(self) -> Mapping[str, float]:
        if self.lost:
            raise DeviceLost(self.name, self.port, "the cable was pulled")
        return self.told

    def close(self) -> None:
        pass


class ChannelRig(MemoryRig):
    """The rig in memory with free channels, ``free``, and a thermometer."""

    free: Mapping[str, ChannelSection] = FREE

    def __post_init__(self) -> None:
        self.thermometer = Thermometer("climate", "memory", {})
        super().__post_init__()
        self.source = WiredSource("daq", "memory", self.crank)

    def rig_file(self) -> RigFile:
        rig = super().rig_file()
        climate = DeviceSection("memory thermometer", "memory")
        devices = {**rig.devices, "climate": climate}
        return msgspec.structs.replace(rig, devices=devices, channels=dict(self.free))

    def _load(self, name: str) -> DriverInfo:
        told = ("current_A", "supply_V", "temperature_C")
        if name == "memory thermometer":
            return DriverInfo(
                name, "thermometer in memory", DriverKind.SLOW_SOURCE,
                lambda *_: self.thermometer, check=_knows,
            )  # fmt: skip
        info = super()._load(name)
        if info.kind is DriverKind.SPINDLE:
            return DriverInfo(name, "drive in memory", info.kind, info.factory, quantities=told)
        return info


def _knows(request: SlowRequest) -> None:
    for one in request.quantities:
        if one not in TOLD:
            raise ValueError(f"no register tells {one}; there are {', '.join(TOLD)}")


@pytest.fixture
def rig(monkeypatch: pytest.MonkeyPatch) -> Iterator[ChannelRig]:
    monkeypatch.setattr(slow, "PERIOD_S", 0.01)
    monkeypatch.setattr(slow, "REOPEN_S", 0.02)
    rig = ChannelRig()
    rig.engine.connect()
    yield rig
    rig.engine.shutdown()


def heard(engine: Engine, name: str) -> Callable[[], bool]:
    """Return what tells whether a channel has a value."""
    return lambda: any(
        one.name == name and math.isfinite(one.value) for one in engine.status().rig.channels
    )


def ran(rig: MemoryRig, revolutions: int = 5, **options: Any) -> None:
    rig.start(a_test(revolutions), **options)
    rig.engine.wait(ENDED)


def test_columns_of_every_rig_keep_their_places() -> None:
    table = channel_table(ChannelRig().rig_file())
    assert table.names[: len(BASE.names)] == BASE.names
    assert table.names[len(BASE.names) :] == (
        *(f"bushing_temperature_{one}" for one in ("max", "min", "rms", "mean", "angle_of_max")),
        *(f"gap_{one}" for one in ("max", "min", "rms", "mean", "angle_of_max")),
        *(
            f"{channel}{one}"
            for channel in ("room_temperature", "motor_current")
            for one in ("", "_age", "_mean", "_rms", "_max", "_readings")
        ),
    )
    cycle = [one.name for one in table.cycle_columns]
    assert cycle[: len(BASE.cycle_columns)] == [one.name for one in BASE.cycle_columns]
    assert cycle[len(BASE.cycle_columns) :] == [
        "bushing_temperature", "raw_bushing_temperature", "gap", "raw_gap",
    ]  # fmt: skip
    assert table.units["bushing_temperature_rms"] == "degC"
    assert (table.units["room_temperature"], table.units["motor_current"]) == ("degC", "A")


def test_free_and_slow_channels_are_in_every_row_and_cycle(rig: ChannelRig) -> None:
    eventually(heard(rig.engine, "room_temperature"))
    assert isinstance(rig.source, WiredSource)
    assert rig.source.asked["analog_5"] == ("voltage", 10.0)
    assert rig.thermometer.request is not None
    assert rig.thermometer.request.quantities == ("temperature_C",)
    ran(rig)
    table = channel_table(rig.rig_file())
    for row in rig.store.rows:
        named = dict(zip(table.names, row.tolist(), strict=True))
        for one in ("max", "min", "rms", "mean"):
            assert named[f"bushing_temperature_{one}"] == pytest.approx(40.0)
        assert named["gap_max"] == pytest.approx(5.0, abs=2e-3)
        assert named["gap_min"] == pytest.approx(2.5, abs=2e-3)
        assert named["room_temperature"] == 21.5
        assert named["motor_current"] == 1.0
        if named["motor_current_readings"]:
            assert named["motor_current_mean"] == named["motor_current_max"] == 1.0
        else:
            assert np.isnan(named["motor_current_rms"])
        assert 0.0 <= named["room_temperature_age"] < slow.SILENT_S
    _, columns = rig.store.cycles[0]
    assert set(columns) == {one.name for one in table.cycle_columns}
    np.testing.assert_allclose(columns["raw_bushing_temperature"], 0.5)
    volts = np.asarray(columns["raw_gap"], np.float64)
    expected = np.interp(volts, [0.0, 1.0, 2.0], [5.0, 3.0, 2.5])
    np.testing.assert_allclose(columns["gap"], expected, atol=1e-4)


def test_a_viewer_is_told_what_a_row_holds(rig: ChannelRig) -> None:
    viewer = rig.engine.subscribe()
    eventually(heard(rig.engine, "motor_current"))
    ran(rig)
    snapshot = rig.engine.snapshot(viewer)
    table = channel_table(rig.rig_file())
    assert tuple(snapshot.columns) == table.names
    assert len(snapshot.rows) == 8 * 5 * len(table.names)
    assert snapshot.cycle is not None
    assert set(snapshot.cycle.curves) == {one.name for one in table.curves}
    shown = {one.name: one for one in rig.engine.status().rig.channels}
    assert (shown["gap"].raw_unit, shown["gap"].unit) == ("V", "mm")
    assert shown["room_temperature"].age_s is not None
    assert shown["gap"].age_s is None
    assert (shown["gap"].uncertainty, shown["bushing_temperature"].uncertainty) == (0.02, None)
    assert shown["gap"].calibration == "by its line in the rig file"
    named = {one.name for one in rig.engine.status().rig.devices}
    assert named == {"daq", "drive", "climate"}


@pytest.mark.parametrize("quantity", ["bushing_temperature_max", "room_temperature"])
def test_a_rule_on_a_free_channel_stops_the_test(rig: ChannelRig, quantity: str) -> None:
    eventually(heard(rig.engine, "room_temperature"))
    level = 39.0 if quantity.startswith("bushing") else 21.0
    rig.start(a_test(1000, rules=(LimitRule(quantity, critical_above=level),)))
    rig.engine.wait(ENDED)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.reason is FinishReason.LIMIT
    assert quantity in rig.engine.outcome.sentence


def test_a_saturated_free_input_is_told_by_its_name_and_ends_nothing(rig: ChannelRig) -> None:
    assert isinstance(rig.source, WiredSource)
    rig.source.bushing_V, rig.source.quality = 10.0, Quality.SATURATED
    key = "input_saturated:bushing_temperature"
    eventually(lambda: key in {one.key for one in rig.engine.status().alarms if one.active})
    (alarm,) = (one for one in rig.engine.status().alarms if one.key == key)
    assert "bushing_temperature (analog_5 of daq) is at the end of its range, 10 V" in alarm.cause
    ran(rig)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"


def test_the_drives_watchdog_does_not_run_while_many_inputs_are_set_up() -> None:
    rig = ChannelRig()
    order: list[str] = []
    for device in (rig.source, rig.spindle):
        _noting(device, order)
    rig.engine.connect()
    rig.engine.shutdown()
    assert order.index("daq") < order.index("drive")


def _noting(device: Any, order: list[str]) -> None:
    configure = device.configure
    device.configure = lambda request: (order.append(device.name), configure(request))[1]


def test_a_rule_on_a_channel_that_the_rig_has_not_is_refused(rig: ChannelRig) -> None:
    with pytest.raises(UnusableInput, match=r"did you mean bushing_temperature_max"):
        rig.start(a_test(10, rules=(LimitRule("bushing_temperature_maxi", critical_above=1.0),)))


def test_a_silent_thermometer_costs_its_values_and_nothing_else(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    eventually(heard(rig.engine, "room_temperature"))
    monkeypatch.setattr(slow, "SILENT_S", 0.1)
    rig.thermometer.lost = True
    key = "slow_silent:climate"
    eventually(lambda: key in {one.key for one in rig.engine.status().alarms if one.active})
    ran(rig, 10)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    table = channel_table(rig.rig_file())
    values, ages = (
        np.array([row[table.place[name]] for row in rig.store.rows])
        for name in ("room_temperature", "room_temperature_age")
    )
    assert np.isnan(values).all()
    assert (np.diff(ages) > 0.0).all(), "the age grows"
    shown = next(one for one in rig.engine.status().rig.devices if one.name == "climate")
    assert (shown.connected, shown.last_error) == (False, "no answer")
    rig.thermometer.lost = False
    eventually(heard(rig.engine, "room_temperature"))
    eventually(lambda: key not in {one.key for one in rig.engine.status().alarms if one.active})
    assert rig.thermometer.opened == 2


def test_the_first_answers_are_there_when_the_rig_is_connected() -> None:
    rig = ChannelRig()
    rig.engine.connect()
    eventually(heard(rig.engine, "probe_1"))  # nothing is shown before the first sample
    assert heard(rig.engine, "room_temperature")()
    assert not any(one.verdict is CheckVerdict.BLOCKS for one in checks_of(rig, "Device climate"))
    rig.engine.shutdown()


def test_a_missing_thermometer_is_noted_before_a_test_and_blocks_nothing() -> None:
    rig = ChannelRig()
    rig.thermometer.lost = True
    rig.engine.connect()
    (check,) = checks_of(rig, "Device climate")
    assert (check.verdict, check.sentence) == (CheckVerdict.ATTENTION, "no answer")
    assert check.advice == "Check cable and power of memory, or continue without its channels"
    ran(rig)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    rig.engine.shutdown()


def checks_of(rig: ChannelRig, what: str) -> list[Check]:
    """Return the rows of a pre-flight that are about something."""
    return [one for one in preflight(None, None, None, rig.engine.status()) if one.name == what]


@pytest.mark.sampled
@pytest.mark.parametrize("garbled", ["warm", None], ids=["ValueError", "TypeError"])
def test_a_garbled_answer_costs_its_values_until_the_device_is_opened_again(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch, garbled: Any
) -> None:
    monkeypatch.setattr(slow, "PERIOD_S", 0.01)
    monkeypatch.setattr(slow, "REOPEN_S", 0.01)
    monkeypatch.setattr(slow, "SILENT_S", 0.2)
    eventually(heard(rig.engine, "room_temperature"))
    rig.thermometer.told = {"temperature_C": garbled}
    key = "slow_silent:climate"
    eventually(lambda: key in {one.key for one in rig.engine.status().alarms if one.active})
    shown = next(one for one in rig.engine.status().rig.devices if one.name == "climate")
    assert "its driver memory thermometer failed" in shown.last_error
    ran(rig)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    rig.thermometer.told = dict(TOLD)
    eventually(lambda: key not in {one.key for one in rig.engine.status().alarms if one.active})
    assert heard(rig.engine, "room_temperature")()
    assert rig.thermometer.opened > 1


def test_the_pauses_between_attempts_grow_and_are_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    device = slow.SlowDevice(
        Thermometer("climate", "memory", {}),
        SlowRequest(("temperature_C",), 1.0),
        lambda identity, readback: None,
        lambda worker, error: None,
        1.0,
    )
    device.source.lost = True  # type: ignore[attr-defined]
    pauses: list[float] = []
    monkeypatch.setattr(device.worker, "pause", pauses.append)
    for _ in range(6):
        device._step()
    assert pauses == [5.0, 10.0, 20.0, 40.0, 60.0, 60.0]
    device.source.lost = False  # type: ignore[attr-defined]
    device._step()
    device.source.lost = True  # type: ignore[attr-defined]
    device._step()
    assert pauses[-1] == 5.0


def test_a_current_that_swings_is_told_by_its_mean_rms_and_maximum() -> None:
    current = next(
        one for one in channel_table(ChannelRig().rig_file()).slow if "motor" in one.name
    )
    status: list[Any] = [None]
    channels = slow.SlowChannels([current], [], current.device, lambda: status[0], lambda s: 0.0)
    base_ns = time.monotonic_ns()
    for reading, value in enumerate((99.0, 8.0, -6.0, 2.0, float("nan"), -7.0)):
        status[0] = SimpleNamespace(host_time_ns=base_ns + reading * 100_000_000, current_A=value)
        channels.take_drive()
        channels.take_drive()
    told = channels.columns(base_ns + 400_000_000, 0.35)
    assert told["motor_current_readings"] == 3, "before it, after it and no number: not counted"
    assert told["motor_current_mean"] == pytest.approx(4.0 / 3.0)
    assert told["motor_current_rms"] == pytest.approx((104.0 / 3.0) ** 0.5)
    assert told["motor_current_max"] == 8.0
    later = channels.columns(base_ns + 900_000_000, 0.3)
    assert later["motor_current_readings"] == 0
    assert np.isnan(later["motor_current_mean"])
    assert later["motor_current"] == -7.0


def test_a_file_of_before_goes_on_without_the_averages_of_slow_channels() -> None:
    measured = channel_table(ChannelRig().rig_file())
    kept = ChannelTable(tuple(replace(one, averaged=False) for one in measured.channels))
    assert "motor_current_mean" not in kept.names
    assert missing_channels(kept, measured) == ""
    assert "motor_current" in missing_channels(measured, kept)
    assert table_of(kept.units).names == kept.names
    assert table_of(measured.units).names == measured.names


def test_a_limited_channel_without_a_value_does_what_its_limit_says(
    rig: ChannelRig, monkeypatch: pytest.MonkeyPatch
) -> None:
    eventually(heard(rig.engine, "room_temperature"))
    monkeypatch.setattr(slow, "SILENT_S", 0.2)
    rule = LimitRule("room_temperature", critical_above=60.0, action_critical="stop")
    rig.thermometer.lost = True
    rig.start(a_test(500, rules=(rule,)))
    rig.engine.wait(ENDED)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "stopped"
    assert "room_temperature has had no value" in rig.engine.outcome.sentence


def test_a_hanging_thermometer_does_not_hold_up_the_end(rig: ChannelRig) -> None:
    eventually(heard(rig.engine, "room_temperature"))
    hang = threading.Event()
    rig.thermometer.read = lambda: TOLD if hang.wait(60.0) else {}  # type: ignore[method-assign]
    ran(rig)
    assert rig.engine.outcome is not None
    assert rig.engine.outcome.status == "complete"
    hang.set()


def test_what_a_device_does_not_tell_is_refused_before_a_port_is_opened() -> None:
    for source, words in (
        ("climate.pressure_hPa", "there are temperature_C, humidity_percent"),
        ("drive.torque_Nm", "reports current_A, supply_V, temperature_C"),
    ):
        rig = ChannelRig()
        rig.free = {"odd": ChannelSection(source=source)}
        rig.__post_init__()
        with pytest.raises(UnusableInput, match=words):
            rig.engine.connect()
        assert not rig.source.opened
        assert not rig.thermometer.opened


def test_the_file_keeps_them_and_goes_on_with_them(tmp_path: Path) -> None:
    """A later part is measured with more channels, for which the file has no room."""
    rig = ChannelRig(open_store=open_file)
    rig.free = {name: FREE[name] for name in ("bushing_temperature", "motor_current")}
    rig.__post_init__()
    path = tmp_path / "t.h5"
    _run_part(rig, path, 4, resume=False)
    more = ChannelRig(open_store=open_file)
    more.__post_init__()
    _run_part(more, path, 8, resume=True)
    with open_test(path) as reader:
        assert int(reader.column("revolution")[-1]) == 8
        np.testing.assert_allclose(reader.column("bushing_temperature_mean"), 40.0, rtol=1e-6)
        np.testing.assert_allclose(reader.column("motor_current"), 1.0)
        assert "gap_max" not in reader.column_units()
        assert reader.column_units()["bushing_temperature_max"] == "degC"
        cycle = reader.cycle(-1)
        assert "bushing_temperature" in cycle.columns
        assert "gap" not in cycle.columns
        told = reader.calibration()["channel_bushing_temperature"]
        assert (told["scale_per_V"], told["offset_V"]) == (100.0, 0.1)
        even = cycle.resampled(36).columns
        assert set(even) == {"angle", *(one.name for one in reader.plan.table.curves)}


@pytest.mark.long
def test_a_rig_that_lost_a_channel_cannot_go_on(tmp_path: Path) -> None:
    rig = ChannelRig(open_store=open_file)
    rig.__post_init__()
    path = tmp_path / "t.h5"
    _run_part(rig, path, 4, resume=False)
    less = MemoryRig(open_store=open_file)
    with pytest.raises(UnusableInput, match=r"keeps bushing_temperature, gap.*\[channels"):
        _run_part(less, path, 8, resume=True)


def _run_part(rig: MemoryRig, path: Path, until: int, *, resume: bool) -> None:
    """Run a test of 8 revolutions up to one of them."""
    test = parse_test(QUICK.read_text(encoding="utf-8"), "quick.toml")
    run = msgspec.structs.replace(
        test.run, revolutions=8, speed_rpm=80.0, acceleration_rpm_per_s=600.0
    )
    cycles = msgspec.structs.replace(test.cycles, schedule="every", every_revolutions=2)
    document = Document(Path("t.toml"), "", msgspec.structs.replace(test, run=run, cycles=cycles))
    rig.engine.connect()
    try:
        rig.engine.start(document, path, operator="Ada", resume=resume)
        if until < 8:
            eventually(lambda: rig.engine.status().test.revolution >= until)
            rig.engine.stop()
        rig.engine.wait(ENDED)
    finally:
        rig.engine.shutdown()


def saw(points: list[tuple[float, float]]) -> np.ndarray:
    return np.ascontiguousarray(np.array(points).T)


@given(st.integers(0, 2**32 - 1), st.integers(2, 20))
def test_a_table_is_linear_between_and_beyond_its_points(seed: int, points: int) -> None:
    rng = np.random.default_rng(seed)
    table = np.cumsum(rng.uniform(0.1, 1.0, (2, points)), axis=1)
    x = rng.uniform(table[0, 0], table[0, -1], 50)
    got = x.copy()
    follow(got, got.size, table)
    np.testing.assert_allclose(got, np.interp(x, *table), rtol=1e-12)
    out = np.array([table[0, 0] - 1.0, table[0, -1] + 1.0])
    follow(out, 2, table)
    slopes = np.diff(table[1]) / np.diff(table[0])
    np.testing.assert_allclose(out, (table[1, 0] - slopes[0], table[1, -1] + slopes[-1]))


@pytest.mark.parametrize("latency_s", [0.0, 1.4e-3])
def test_a_free_channel_is_shifted_and_reduced_like_all_others(latency_s: float) -> None:
    free = {
        "a": (Channel("a", "degC", "", latency_s=latency_s), InputLine(10.0, 0.5)),
        "b": (Channel("b", "mm", ""), InputLine(table=saw([(-2.0, 1.0), (0.0, 4.0), (2.0, 5.0)]))),
    }
    kind = calibration_by_hand(
        encoder=EncoderSetup(3600), sample_rate_Hz=1000.0, matrix=200 * np.eye(2),
        sensitivity=np.array([100.0, 90.0]), free=free,
    )  # fmt: skip
    turns = 0.3 + np.arange(4000) / 1000.0
    rng = np.random.default_rng(3)
    values = rng.normal(size=(7, turns.size)).astype(np.float32)
    values[6] = np.floor(turns * 3600.0 + 1e-9) % 3600.0
    assembler = Assembler(kind.encoder, 6, 1000.0, kind.margins)
    found = assembler.push(Block("daq", 0, 0, 1000.0, 0, values, np.zeros(4000, np.uint8)))
    assert len(found) >= 2
    for one in found:
        measured = Measured(one, kind)
        row = Reducer(kind).reduce(measured)
        told = calibrate(one, kind)
        for name in kind.table.curves:
            curve = told[name.name]
            place = kind.table.place
            assert row[place[f"{name.name}_max"]] == pytest.approx(curve.max(), rel=1e-9)
            assert row[place[f"{name.name}_mean"]] == pytest.approx(curve.mean(), abs=1e-9)
        inside = slice(one.first_sample, one.end_sample)
        if latency_s == 0.0:
            np.testing.assert_allclose(told["a"], 10.0 * (values[4, inside] - 0.5), rtol=1e-5)


def test_a_table_of_a_file_is_that_of_its_rig() -> None:
    table = channel_table(ChannelRig().rig_file())
    told = msgspec.json.decode(json_bytes(table.channels), type=tuple[Channel, ...])
    assert ChannelTable(told) == table
    assert [one.kind for one in table.slow] == [Kind.SLOW, Kind.SLOW]


def test_a_column_names_the_detector_of_its_own_channel() -> None:
    third = Channel("probe_3", "um", "")
    found = detectors(ChannelTable((*BASE.channels, third, Channel("speed_sensor", "V", ""))))
    assert found["probe_1_max"] == found["raw_probe_2"] == "probes"
    assert found["probe_3_max"] == found["raw_probe_3"] == "probe_3"
    assert found["speed_sensor_rms"] == "speed_sensor"
    assert found["speed_max"] == found["raw_count"] == "encoder"
    assert found["force_angle_of_max"] == "load_cell"
    assert "quality" not in found
