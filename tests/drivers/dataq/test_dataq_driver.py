"""The driver against the simulated instrument on a real pty, both clocks, every fault."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from rigapp_drivers.api import (
    ConnectionFailed,
    DataRequest,
    DataSource,
    DeviceLost,
    ProtocolError,
    Quality,
    ReplyTimeout,
    SettingRefused,
    SettingsLost,
    WrongDevice,
)
from rigapp_drivers.dataq.driver import DRIVER, Dataq
from rigapp_drivers.dataq.simulator import COMMANDS, DataqFault, DataqSimulator
from rigapp_drivers.registry import load_driver, load_simulator

FAST = {"command_pause_s": 0.0, "reply_timeout_s": 0.2}
SILENT = {"silence_s": 1.0, "idle_check_s": 1.0}
only_internal = pytest.mark.parametrize("clock", ["internal"])
only_encoder = pytest.mark.parametrize("clock", ["encoder"])


def test_it_is_registered_with_its_simulator() -> None:
    assert load_driver("dataq") is DRIVER
    assert load_simulator(DRIVER) is DataqSimulator
    assert DRIVER.usb_ids == ((0x0683, None),)
    assert isinstance(DRIVER.factory("daq", "nowhere", {}), DataSource)


@pytest.mark.parametrize("model", [2108, 4108])
def test_angle_and_volts_agree_over_the_whole_stream(
    bench: Callable[..., Any], clock: str, model: int
) -> None:
    b = bench(model)
    setup = b.configure(1920.0)
    assert [c.name for c in setup.channels] == ["analog_1", "analog_2", "counter_1"]
    assert setup.sample_rate_Hz == pytest.approx(1920.0, rel=1e-9)
    assert "without direction" in setup.readback["counter"]
    assert ("pulse" in setup.readback["sample_index"]) == (clock == "encoder")
    b.driver.start()
    b.read_until(lambda: b.samples >= 1500, "1500 samples")
    b.rest()
    b.check()
    counts = np.concatenate([block.values[2] for block in b.blocks])
    quality = np.concatenate([block.quality for block in b.blocks])
    assert not quality.any()
    assert all(block.values.dtype == np.int32 for block in b.blocks)
    steps = set(np.diff(counts).tolist())
    assert steps == {1} if clock == "encoder" else steps <= {1, 2}
    assert b.driver.tally.gaps == 0
    assert b.driver.read(0.0) is None


def test_the_device_is_told_what_the_plan_says(bench: Callable[..., Any], clock: str) -> None:
    b = bench(4108, srate_rewrites_ps=True)
    setup = b.configure(480.0, filter="average", digital=True, rate_range_Hz=10e3)
    assert b.simulator.scan_list == (0, 1, 8, 0x0309, 10)
    assert b.simulator.filters == {0: 1, 1: 1}
    wanted = (62500, 2, 1) if clock == "internal" else (3000, 1, 1)
    told = b.simulator.settings
    assert (told["srate"], told["dec"], told["deca"]) == wanted
    assert (setup.readback["srate"], setup.readback["dec"]) == wanted[:2]
    assert b.simulator.packet_bytes == setup.readback["packet_bytes"]
    assert [c.name for c in setup.channels[2:]] == ["digital", "rate_1", "counter_1"]
    b.driver.start()
    b.read_until(lambda: b.samples >= 100, "100 samples")
    rate = setup.channels[3]
    hertz = np.concatenate([block.values[3] for block in b.blocks]) * rate.scale + rate.offset
    assert np.median(hertz) == pytest.approx(2700.0, rel=0.01)
    lines = set(np.concatenate([block.values[2] for block in b.blocks]).tolist())
    high = 1 << 2 | 1 << 3 | 1 << 6  # line A on rate, counter and clock input
    assert lines == ({high} if clock == "encoder" else {0, high})
    assert setup.readback["wiring"].startswith("encoder line A to D")
    assert told["endo"] == 0, "all lines are inputs"


def test_a_second_configuration_leaves_nothing_of_the_first(bench: Callable[..., Any]) -> None:
    b = bench()
    b.configure()
    b.driver.configure(DataRequest(960.0, {"analog_5": ("voltage", 10.0)}))
    assert b.simulator.scan_list == (4, 10)
    b.driver.start()
    block = b.driver.read(2.0)
    assert block is not None
    assert block.values.shape[0] == 1


@pytest.mark.parametrize(
    "options", [{"start_echo": True}, {"echo_nuls": 3}, {"start_echo": True, "echo_nuls": 1}]
)
def test_models_that_echo_otherwise(bench: Callable[..., Any], options: dict[str, Any]) -> None:
    b = bench(**options)
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 200, "200 samples")
    b.rest()
    b.check()
    assert b.driver.tally.restarts == 0


def test_a_start_after_a_stop_begins_at_0(bench: Callable[..., Any]) -> None:
    b = bench()
    b.configure()
    for _ in range(2):
        b.blocks.clear()
        b.driver.start()
        b.driver.start()
        b.read_until(lambda: b.samples >= 100, "100 samples")
        b.rest()
        b.driver.stop()
        assert not b.simulator.streaming
        assert b.blocks[0].first_sample == 0
        b.check()
    assert bytes(b.wire.received).count(b"reset 1\rstart") == 2


def test_it_wakes_up_a_device_that_still_scans(bench: Callable[..., Any]) -> None:
    b = bench()
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 10, "samples")
    other = Dataq("daq", b.wire.port, {**FAST, "model": 2108})
    b.driver._line.close()
    assert b.simulator.streaming
    identity = other.open()
    assert (identity.maker, identity.model, identity.firmware) == (
        "DATAQ Instruments",
        "DI-2108",
        "1.37",
    )
    assert identity.serial_number == "5A0C21F7"
    assert not b.simulator.streaming
    other.close()
    other.close()


# --- faults in the stream -------------------------------------------------------------------------


@pytest.mark.parametrize("drops", ["dropped_byte", "garbage", "overrun_bytes"])
def test_lost_and_added_bytes_cost_a_marked_gap(bench: Callable[..., Any], drops: str) -> None:
    b = bench(4108)
    b.configure(1920.0)
    b.driver.start()
    b.read_until(lambda: b.samples >= 300, "samples before the fault")
    b.simulator.inject(drops)
    b.read_until(lambda: bool(b.gaps), "a gap")
    sound = b.samples + 500
    b.read_until(lambda: b.samples >= sound, "samples after the gap")
    b.rest()
    b.check()
    (gap,) = b.gaps
    assert gap.quality[0] == Quality.LOST_BEFORE | Quality.RESYNCHRONISED | Quality.COUNT_SUSPECT
    tally = b.driver.tally
    assert (tally.gaps, tally.restarts, tally.lost_scans) == (1, 1, gap.lost_before)
    assert "data were lost or added" in tally.sentences[0]


@only_encoder
@pytest.mark.parametrize("fault", [DataqFault.OVERRUN, DataqFault.COUNTER_SLIP])
def test_scans_that_an_overrun_drops_are_counted(bench: Callable[..., Any], fault: str) -> None:
    b = bench()
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 300, "samples before the fault")
    b.simulator.inject(fault, value=5)
    b.read_until(lambda: bool(b.gaps), "a gap")
    b.rest()
    (gap,) = b.gaps
    assert gap.lost_before == 6
    assert gap.quality[0] == Quality.LOST_BEFORE | Quality.COUNT_SUSPECT
    assert (b.driver.tally.restarts, b.driver.tally.lost_scans) == (0, 6)
    b.check(slipped=fault is DataqFault.COUNTER_SLIP)


@only_internal
@pytest.mark.parametrize("fault", [DataqFault.OVERRUN, DataqFault.COUNTER_SLIP])
def test_a_jump_of_the_count_under_the_internal_clock_is_a_suspect_gap(
    bench: Callable[..., Any], fault: str
) -> None:
    b = bench()
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 300, "samples before the fault")
    b.simulator.inject(fault)
    b.read_until(lambda: bool(b.gaps), "a gap")
    sound = b.samples + 300
    b.read_until(lambda: b.samples >= sound, "samples after the gap")
    b.rest()
    assert b.gaps[0].quality[0] & Quality.COUNT_SUSPECT
    assert b.driver.tally.restarts == 1
    b.check(slipped=fault is DataqFault.COUNTER_SLIP)


def test_a_full_link_that_loses_single_bytes(bench: Callable[..., Any]) -> None:
    b = bench(overrun_drops="bytes")
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 200, "samples")
    b.simulator.overrun(0.0)
    b.read_until(lambda: bool(b.gaps), "a gap")
    b.rest()
    b.check()
    assert b.driver.tally.restarts == 1


def test_a_saturated_input_is_flagged_sample_by_sample(bench: Callable[..., Any]) -> None:
    b = bench(4108)
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 100, "samples")
    b.simulator.inject("saturated_input", value=1)
    b.read_until(lambda: bool(b.blocks[-1].quality.any()), "a saturated sample")
    quality = np.concatenate([block.quality for block in b.blocks])
    values = np.concatenate([block.values[0] for block in b.blocks])
    assert ((quality == Quality.SATURATED) == (values == 32764)).all()


def test_an_input_that_is_stuck_is_named(bench: Callable[..., Any]) -> None:
    b = bench()
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 100, "samples")
    assert b.driver.input_faults() == ()
    b.simulator.inject("stuck_input", value=2)
    b.read_until(lambda: bool(b.driver.input_faults()), "a stuck input")
    assert b.driver.input_faults()[0].inputs == ("analog_2",)
    assert "analog_2 has shown the same value" in b.driver.tally.sentences[-1]


@only_encoder
def test_a_counter_that_is_dead_ends_the_stream_with_its_name(bench: Callable[..., Any]) -> None:
    b = bench()
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 100, "samples")
    b.simulator.inject("stuck_counter")
    with pytest.raises(ProtocolError, match=r"stepped by 0 .* check that the encoder drives"):
        b.read_until(lambda: False, "an error")
    b.check()
    assert not b.simulator.streaming


# --- the device -----------------------------------------------------------------------------------


@pytest.mark.sampled
def test_a_hang_is_lost_and_says_so(bench: Callable[..., Any]) -> None:
    b = bench(settings=SILENT)
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 100, "samples")
    b.simulator.inject("hang")
    with pytest.raises(DeviceLost, match="no longer answers stop; switch it off and on"):
        b.read_until(lambda: False, "an error")
    b.check()
    b.driver.stop()


@pytest.mark.sampled
@pytest.mark.parametrize("tells_rate", [True, False])
def test_a_reset_is_lost_and_says_so(
    bench: Callable[..., Any], clock: str, tells_rate: bool
) -> None:
    b = bench(settings=SILENT, tells_rate=tells_rate)
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 100, "samples")
    b.simulator.inject("reset", value=0.05)
    kind, words = SettingsLost, "was probably reset"
    if clock == "encoder":  # what an older firmware does not tell shows in the data only
        kind, words = (SettingsLost, "restarted") if tells_rate else (ProtocolError, "not reset")
    with pytest.raises(kind, match=words):
        b.read_until(lambda: False, "an error")
    b.check()


@only_encoder
def test_a_reset_while_the_shaft_stands_is_no_sign_of_life(bench: Callable[..., Any]) -> None:
    b = bench(settings=SILENT)
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 300, "samples")
    b.shaft.rev_per_s = 0.0
    b.read_until(lambda: b.blocks[-1].quality.size == 0, "a sign of life")
    b.simulator.inject("reset", value=0.05)
    with pytest.raises(SettingsLost, match=r"restarted .* find the index again"):
        b.read_until(lambda: False, "an error")
    b.check()
    assert b.read(0.0) is None
    b.shaft.rev_per_s = 1.0
    b.blocks.clear()
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 300, "samples after it was connected again")
    b.check()


def test_a_cable_that_is_pulled(bench: Callable[..., Any]) -> None:
    b = bench()
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 10, "samples")
    b.wire.unplug()
    with pytest.raises(DeviceLost, match="check cable"):
        b.read_until(lambda: False, "an error")


@pytest.mark.sampled
@only_encoder
@pytest.mark.parametrize("sends_rest", [True, False])
def test_a_standing_shaft_is_not_a_fault(bench: Callable[..., Any], sends_rest: bool) -> None:
    b = bench(stop_sends_rest=sends_rest, settings=SILENT)
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 300, "samples")
    b.shaft.rev_per_s = 0.0
    stops = b.wire.received.count(b"stop\r")
    b.read_until(lambda: b.wire.received.count(b"stop\r") >= stops + 2, "two questions")
    b.read_until(lambda: b.blocks[-1].quality.size == 0, "a sign of life")
    before, asked = b.samples, b.wire.received.count(b"stop\r")
    b.shaft.rev_per_s = 3.0
    b.read_until(lambda: b.samples >= before + 300, "samples after the rest")
    b.rest()
    b.check()
    assert b.driver.tally.restarts == 0
    # A question of a computer that was held up may meet the moving shaft: its pulses are lost.
    asked = b.wire.received.count(b"stop\r") - asked
    assert b.driver.tally.gaps <= asked + (0 if sends_rest else 1)
    counts = np.concatenate([block.values[2] for block in b.blocks])
    index = np.concatenate(
        [block.first_sample + np.arange(block.quality.size) for block in b.blocks]
    )
    assert set((counts - index).tolist()) == {int(counts[0])}


# --- replies --------------------------------------------------------------------------------------


@only_internal
def test_one_lost_reply_is_asked_for_again(bench: Callable[..., Any]) -> None:
    b = bench()
    b.simulator.inject("no_reply", count=1, target=COMMANDS.index("srate"))
    b.configure()
    assert b.wire.received.count(b"srate 62500\r") == 2


@pytest.mark.sampled
@only_internal
@pytest.mark.parametrize(
    ("fault", "error", "words"),
    [
        ("no_reply", ReplyTimeout, "no answer within 1 s, 2 tries"),
        ("wrong_echo", ProtocolError, r"'dec 1' was answered with '\?dec 1'"),
    ],
)
def test_replies_that_fail_name_the_command(
    bench: Callable[..., Any], fault: str, error: type[Exception], words: str
) -> None:
    b = bench()
    b.simulator.inject(fault, target=COMMANDS.index("dec"))
    with pytest.raises(error, match=words):
        b.configure()
    with pytest.raises(SettingRefused, match="not configured"):
        b.driver.start()


@only_internal
def test_a_slow_reply_is_waited_for(bench: Callable[..., Any]) -> None:
    b = bench()
    b.simulator.inject("slow_reply", value=0.15, count=2)
    b.configure()
    b.driver.start()
    b.read_until(lambda: b.samples >= 50, "samples")


# --- refusals -------------------------------------------------------------------------------------


@only_internal
def test_refusals(bench: Callable[..., Any]) -> None:
    b = bench()
    with pytest.raises(SettingRefused, match="no bridge inputs"):
        b.driver.configure(DataRequest(960.0, {"analog_1": ("bridge", 3.5)}))
    with pytest.raises(SettingRefused, match=r"nearest possible: 6999\.53336 or 7000\.35002"):
        b.configure(7000.0)
    with pytest.raises(SettingRefused, match="cannot zero analog_1, analog_2"):
        b.driver.zero(["analog_1", "analog_2"])
    assert b.driver.read(0.0) is None
    b.driver.stop()


@only_internal
def test_the_wrong_model_is_refused(bench: Callable[..., Any]) -> None:
    b = bench()
    with pytest.raises(WrongDevice, match=r"a DI-2108 answers.*set model = 2108"):
        b.configure(model=4108)


def test_old_firmware_is_reported(wire: Any) -> None:
    simulator = DataqSimulator(firmware=120)
    driver = Dataq("daq", wire(simulator.receive).port, FAST)
    identity = driver.open()
    driver.close()
    assert identity.firmware == "1.20"
    assert "load 1.35 or newer" in identity.details["advice"]


def test_another_base_of_the_rates_is_told_and_not_refused(
    wire: Any, caplog: pytest.LogCaptureFixture
) -> None:
    simulator = DataqSimulator(master_clock_Hz=48_000_000)
    driver = Dataq("daq", wire(simulator.receive).port, FAST)
    identity = driver.open()
    driver.close()
    assert "divide 48000000 Hz, where 60000000 Hz is known" in identity.details["advice"]
    assert "compare its sample rate with a clock" in caplog.text


@only_encoder
def test_a_shaft_that_turns_back_counts_back_and_the_index_sets_the_count_to_0(
    bench: Callable[..., Any],
) -> None:
    lines = {"direction_line": "D0", "index_line": "D1"}
    b = bench(settings=lines, rev_per_s=3.0, **lines)
    b.configure()
    b.driver.start()
    for speed, turns in ((3.0, 1.6), (-3.0, 0.8), (3.0, 1.4)):
        b.shaft.rev_per_s = speed
        begun = b.shaft.revolutions

        def turned(begun: float = begun, turns: float = turns) -> bool:
            return bool(abs(b.shaft.revolutions - begun) > turns)

        b.read_until(turned, f"{turns} turns at {speed} rev/s")
    b.rest()
    volts = np.concatenate([block.values[0] for block in b.blocks]) * 10.0 / 32768.0
    counts = np.concatenate([block.values[-1] for block in b.blocks])
    place = volts / 0.25 * 900.0
    assert np.diff(counts).min() < -100, "the index sets it to 0"
    backward = np.diff(place) < 0
    assert 500 < backward.sum() < 1500
    known = np.flatnonzero(np.diff(counts) < -100)[0] + 1
    apart = (place - counts)[known:]
    apart -= 900.0 * np.round(apart / 900.0)
    assert np.abs(apart).max() < 2.5, "the angle is the shaft's, whichever way it turns"
    assert b.driver.tally.gaps == 0


@pytest.mark.parametrize(
    ("answer", "error", "words"),
    [
        (b"", ConnectionFailed, "no answer to stop"),
        (b"\xaa\x50\x00\x85", WrongDevice, "does not answer stop"),
    ],
)
def test_what_is_no_instrument(
    wire: Any, answer: bytes, error: type[Exception], words: str
) -> None:
    def chatter(data: bytes, now_s: float) -> bytes:
        return answer

    driver = Dataq("daq", wire(chatter).port, FAST)
    with pytest.raises(error, match=words):
        driver.open()
    driver.close()
