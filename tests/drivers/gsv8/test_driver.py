"""The driver against the simulator over a pty: set-up, stream, losses, faults in words."""

from __future__ import annotations

import contextlib
import logging
import threading
from typing import Any

import numpy as np
import pytest

from rigapp_drivers.api import (
    ConnectionFailed,
    DataOverrun,
    DataRequest,
    DataSource,
    DeviceLost,
    InputFaultKind,
    InputSupervision,
    LineCounters,
    ProtocolError,
    Quality,
    ReplyTimeout,
    SettingRefused,
    WrongDevice,
)
from rigapp_drivers.gsv8.driver import DRIVER, Gsv8
from rigapp_drivers.gsv8.protocol import Command, InputType
from rigapp_drivers.gsv8.simulator import Gsv8Simulator
from rigapp_drivers.registry import check_settings, load_driver, load_simulator

RIG = {
    "analog_1": ("bridge", 3.5),
    "analog_2": ("bridge", 3.5),
    "analog_3": ("voltage", 10.0),
    "analog_4": ("voltage", 10.0),
    "counter_1": ("counter", 3600.0),
}
ELECTRICAL = [0.5, -0.25, 2.5, -2.5]


def _request(rate: float = 960.0, **settings: Any) -> DataRequest:
    return DataRequest(rate, RIG, settings)


def _joined(blocks: list[Any]) -> tuple[np.ndarray, np.ndarray]:
    values = np.concatenate([block.values for block in blocks], axis=1)
    return values, np.concatenate([block.quality for block in blocks])


def _expected_counts(values: np.ndarray, per_sample: float = 7.5) -> np.ndarray:
    """Return the counts that follow the first one when the index restarts at 3600."""
    return values[0] + np.arange(len(values)) * per_sample


def test_it_is_a_data_source_with_an_entry_point() -> None:
    info = load_driver("gsv8")
    assert info is DRIVER
    driver = info.factory("daq", "/dev/null", check_settings(info, {}, "rig"))
    assert isinstance(driver, DataSource)
    assert load_simulator(info) is Gsv8Simulator
    assert driver.read(0.0) is None
    driver.stop()
    driver.close()


def test_identity(bench: Any) -> None:
    b = bench(firmware="1.60", serial_number=1234567)
    assert b.simulator.streaming
    identity = b.driver.open()
    assert (identity.maker, identity.model) == ("ME-Systeme", "GSV-8")
    assert identity.firmware == "1.60"
    assert identity.serial_number == "01234567"
    assert identity.port == b.wire.port
    assert "analog outputs" in identity.details["options"]
    assert not b.simulator.streaming


def test_set_up_reads_back_and_writes_only_what_differs(bench: Any) -> None:
    b = bench()
    b.driver.open()
    setup = b.driver.configure(_request())
    assert setup.sample_rate_Hz == b.simulator.sample_rate_Hz == 960.0
    assert setup.readback["settings_written"] == b.simulator.eeprom_writes == 5
    assert setup.readback["analog_3.input_type"] == "single-ended, 10 V"
    assert setup.readback["counter_1.mode"] == "0x003B"
    assert setup.readback["counter_1.counts_per_unit"] == "1 (assumed)"
    assert setup.readback["interface"] == "USB"
    assert [spec.unit for spec in setup.channels] == ["mV/V", "mV/V", "V", "V", "count"]
    again = b.driver.configure(_request())
    assert again.readback["settings_written"] == 0
    assert b.simulator.eeprom_writes == 5
    b.driver.configure(_request(1000.0))
    assert b.simulator.eeprom_writes == 6


def test_user_scale_and_offset_left_by_someone_else_are_put_right(bench: Any) -> None:
    b = bench()
    b.simulator.settings.scales[0] = 100.0
    b.simulator.settings.offsets[1] = 7.0
    b.simulator.settings.mode |= 1 | 1 << 22
    setup = b.stream()
    values, _ = _joined(b.blocks(50))
    assert values[:4, -1] == pytest.approx(ELECTRICAL, abs=1e-5)
    assert setup.readback["mode"] == "0x00000002"


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize(
    ("settings", "rate"),
    [
        ({}, 960.0),
        ({}, 12000.0),
        ({"data_checksum": True, "command_checksum": True}, 960.0),
        ({"data_type": "int24"}, 960.0),
        ({"data_type": "int24", "data_checksum": True}, 16000.0),
        ({"high_speed_frames": True}, 12000.0),
    ],
)
def test_every_format_gives_the_same_signals(
    bench: Any, settings: dict[str, Any], rate: float
) -> None:
    b = bench()
    setup = b.stream(rate, **settings)
    blocks = b.blocks(int(rate / 4))
    values, quality = _joined(blocks)
    integers = settings.get("data_type") == "int24"
    assert values.dtype == (np.int32 if integers else np.float32)
    scales = [spec.scale for spec in setup.channels]
    electrical = values[:4] * np.array(scales[:4])[:, None]
    np.testing.assert_allclose(electrical.T, np.tile(ELECTRICAL, (values.shape[1], 1)), atol=2e-6)
    counts = values[4] * scales[4]
    turned = np.unwrap(counts, period=3600.0)
    assert np.abs(turned - _expected_counts(turned)).max() <= 1.0
    assert counts.max() <= 3599
    assert not quality.any()
    assert [block.sequence for block in blocks] == list(range(len(blocks)))
    assert blocks[0].first_sample == 0
    ends = [block.first_sample + block.values.shape[1] for block in blocks]
    assert [block.first_sample for block in blocks[1:]] == ends[:-1]
    assert all(block.lost_before == 0 for block in blocks)
    times = [block.host_time_ns for block in blocks]
    assert times == sorted(times)


def test_sixteen_bit_values_without_a_counter(bench: Any) -> None:
    b = bench()
    b.driver.open()
    inputs = {"analog_3": ("voltage", 10.0), "analog_1": ("bridge", 3.5)}
    setup = b.driver.configure(DataRequest(48000.0, inputs, {"data_type": "int16"}))
    b.driver.start()
    values, _ = _joined(b.blocks(4800))
    scales = np.array([spec.scale for spec in setup.channels])
    assert values.shape[0] == 2
    assert values[:, -1] * scales == pytest.approx([2.5, 0.5], abs=4e-4)


def test_twos_complement_is_read_from_the_interface(bench: Any) -> None:
    b = bench(offset_binary=False)
    setup = b.stream(960.0, data_type="int24")
    assert setup.readback["integers"] == "two's complement"
    values, _ = _joined(b.blocks(50))
    assert values[0, -1] * setup.channels[0].scale == pytest.approx(0.5, abs=1e-6)


def test_channels_come_in_the_order_of_the_request(bench: Any) -> None:
    b = bench()
    b.driver.open()
    inputs = {"counter_1": ("counter", 3600.0), "analog_4": ("voltage", 10.0)}
    setup = b.driver.configure(DataRequest(960.0, inputs))
    assert [spec.name for spec in setup.channels] == ["counter_1", "analog_4"]
    assert setup.readback["objects"] == 5
    b.driver.start()
    values, _ = _joined(b.blocks(20))
    assert values[1] == pytest.approx(np.full(values.shape[1], -2.5), abs=1e-5)
    assert values[0].max() > 100


def test_second_counter_alone(bench: Any) -> None:
    b = bench()
    b.simulator.settings.counter_modes[0] |= 2
    b.simulator.settings.objects += 1
    b.driver.open()
    inputs = {"analog_1": ("bridge", 3.5), "counter_2": ("counter", 3600.0)}
    setup = b.driver.configure(DataRequest(960.0, inputs))
    assert setup.readback["objects"] == 2
    b.driver.start()
    values, _ = _joined(b.blocks(50))
    assert values[0, -1] == pytest.approx(0.5, abs=1e-5)
    assert values[1].max() > 100


def test_object_map_decides_what_an_object_means(bench: Any) -> None:
    b = bench()
    swapped = ["analog_2", "analog_1", "analog_3", "analog_4", "counter_1"]
    b.stream(960.0, object_map=swapped)
    values, _ = _joined(b.blocks(20))
    assert values[:2, -1] == pytest.approx([-0.25, 0.5], abs=1e-5)


def test_counts_per_unit_scales_a_counter_of_another_default(bench: Any) -> None:
    b = bench(counter_scale=1.0)
    setup = b.stream(960.0, counts_per_unit=8388608.0)
    values, _ = _joined(b.blocks(100))
    counts = values[4].astype(np.float64) * setup.channels[4].scale
    assert counts.max() > 300
    assert np.abs(counts - np.round(counts)).max() < 0.01


def test_stop_and_start_count_from_zero_again(bench: Any) -> None:
    b = bench()
    b.stream()
    b.blocks(50)
    b.driver.stop()
    b.driver.stop()
    assert not b.simulator.streaming
    while b.driver.read(0.0) is not None:
        pass
    b.driver.start()
    first = b.blocks(10)[0]
    assert (first.sequence, first.first_sample, first.lost_before) == (0, 0, 0)


def test_stop_from_another_thread_while_reading(bench: Any) -> None:
    b = bench()
    b.stream(12000.0)
    stopped = threading.Event()
    failures: list[BaseException] = []

    def read() -> None:
        try:
            while not stopped.is_set():
                b.driver.read(0.05)
        except BaseException as failure:
            failures.append(failure)

    reader = threading.Thread(target=read, name="reader")
    reader.start()
    b.driver.zero(["analog_1"])
    b.driver.stop()
    stopped.set()
    reader.join(60.0)
    assert not reader.is_alive()
    assert failures == []
    assert not b.simulator.streaming


def test_zero_is_stored_in_the_device_and_logged(bench: Any, caplog: Any) -> None:
    b = bench()
    caplog.set_level(logging.INFO)
    b.stream()
    b.blocks(20)
    before = b.simulator.eeprom_writes
    b.driver.zero(["analog_1", "counter_1"])
    assert b.simulator.eeprom_writes == before + 2
    assert "analog_1 was zeroed" in caplog.text
    values, _ = _joined(b.blocks(100))
    assert values[0, -1] == pytest.approx(0.0, abs=1e-5)
    assert values[1, -1] == pytest.approx(-0.25, abs=1e-5)


def test_zero_that_is_not_allowed_is_refused(bench: Any) -> None:
    b = bench(zero_prohibited=0b10)
    b.driver.open()
    with pytest.raises(SettingRefused, match="analog_2 is prohibited"):
        b.driver.zero(["analog_2"])
    with pytest.raises(SettingRefused, match="counter_1 is not in use"):
        b.driver.zero(["counter_1"])
    with pytest.raises(SettingRefused, match="no input"):
        b.driver.zero(["analog_9"])


def test_half_scale_check_proves_scales_and_order(bench: Any) -> None:
    b = bench()
    b.driver.open()
    for data_type in ("float32", "int24"):
        b.driver.configure(_request(data_type=data_type))
        results = b.driver.half_scale()
        assert [result.expected for result in results] == [1.75, 1.75, 5.0, 5.0]
        assert all(result.right for result in results)
    b.driver.configure(_request())
    b.simulator.settings.scales[1] = 3.6
    assert [result.right for result in b.driver.half_scale()] == [True, False, True, True]
    b.driver.start()
    with pytest.raises(SettingRefused, match="stopped first"):
        b.driver.half_scale()
    values, _ = _joined(b.blocks(20))
    assert values[0, -1] == pytest.approx(0.5, abs=1e-5)


# --- refused settings -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        (_request(961.0), "nearest are 960 or 1000"),
        (_request(16000.0), "at most 12000 with 5 inputs as float32"),
        (_request(24000.0, data_type="int24"), "at most 16000"),
        (_request(data_type="int16"), "one of 256 counts"),
        (DataRequest(960.0, {"analog_1": ("bridge", 3.0)}), "choose 2, 3.5, 7"),
        (DataRequest(960.0, {"analog_1": ("voltage", 20.0)}), "the range is 10 V"),
        (DataRequest(960.0, {"analog_9": ("bridge", 3.5)}), "no input"),
        (DataRequest(960.0, {"counter_1": ("bridge", 3.5)}), "cannot measure a bridge"),
        (DataRequest(960.0, {"analog_1": ("counter", 3600.0)}), "a bridge or a voltage"),
        (DataRequest(960.0, {}), "no input is requested"),
        (_request(object_map=["analog_1", "counter_1"]), "lacks analog_2"),
    ],
)
def test_impossible_requests_are_explained(bench: Any, request_: Any, words: str) -> None:
    b = bench()
    b.driver.open()
    with pytest.raises(SettingRefused, match=words) as caught:
        b.driver.configure(request_)
    assert str(caught.value).startswith(f"daq on {b.wire.port}: ")


@pytest.mark.parametrize(
    ("options", "settings", "words"),
    [
        ({"firmware": "1.44"}, {}, "encoder input needs firmware 1.45"),
        ({"firmware": "1.55"}, {"data_checksum": True}, "data_checksum needs firmware 1.56"),
        ({"firmware": "1.55"}, {"command_checksum": True}, "command_checksum needs"),
        ({"firmware": "1.50"}, {"high_speed_frames": True}, "high_speed_frames needs"),
        ({"counter_present": False}, {}, "no encoder input"),
        ({"usb": False}, {}, "line of 115200 baud carries"),
    ],
)
def test_what_the_device_cannot_do_is_explained(
    bench: Any, options: dict[str, Any], settings: dict[str, Any], words: str
) -> None:
    b = bench(**options)
    b.driver.open()
    with pytest.raises(SettingRefused, match=words):
        b.driver.configure(_request(**settings))


def test_old_firmware_serves_without_an_encoder(bench: Any) -> None:
    b = bench(firmware="1.38")
    b.driver.open()
    setup = b.driver.configure(DataRequest(960.0, {"analog_1": ("bridge", 3.5)}))
    assert setup.readback["objects"] == 2
    b.driver.start()
    values, _ = _joined(b.blocks(20))
    assert values[0, -1] == pytest.approx(0.5, abs=1e-5)


def test_uart_carries_what_fits(bench: Any) -> None:
    b = bench(usb=False)
    b.driver.open()
    setup = b.driver.configure(_request(400.0))
    assert setup.readback["interface"] == "UART 3.3 V"


@pytest.mark.parametrize(
    ("command", "status", "words"),
    [
        (Command.WRITE_DATA_RATE, 0x64, "sample_rate_Hz cannot be 960.*data rate is too high"),
        (Command.SET_INPUT_TYPE, 0x75, "input type of analog_3.*another port"),
        (Command.WRITE_COUNTER_MODE, 0x71, "mode of counter_1.*locked"),
        (Command.SET_TX_MAPPING, 0x54, "number of inputs.*too big"),
    ],
)
def test_refused_commands_are_named_in_words(
    bench: Any, command: Command, status: int, words: str
) -> None:
    b = bench()
    b.driver.open()
    b.simulator.inject("refused", target=command, value=status)
    with pytest.raises(SettingRefused, match=words) as caught:
        b.driver.configure(_request())
    assert command.words in str(caught.value)


def test_write_access_held_elsewhere(bench: Any) -> None:
    b = bench()
    b.driver.open()
    b.simulator.inject("write_access_elsewhere")
    with pytest.raises(SettingRefused, match="field bus or a second program"):
        b.driver.configure(_request())


def test_a_setting_that_does_not_stand_is_refused(bench: Any) -> None:
    b = bench()
    b.driver.open()
    b.simulator.inject("refused", target=Command.WRITE_DATA_RATE, value=1)
    with pytest.raises(SettingRefused, match=r"sample_rate_Hz is 10 after 960 was written"):
        b.driver.configure(_request())


def test_start_needs_a_configuration(bench: Any) -> None:
    b = bench()
    b.driver.open()
    with pytest.raises(SettingRefused, match="not configured"):
        b.driver.start()


# --- connections that fail --------------------------------------------------------------------


def test_nothing_answers(wire: Any) -> None:
    driver = Gsv8("daq", wire(lambda data, now: b"").port, {"reply_timeout_s": 0.05})
    with pytest.raises(ConnectionFailed, match="no answer; check power"):
        driver.open()
    driver.close()


def test_something_else_answers(wire: Any) -> None:
    driver = Gsv8("daq", wire(lambda data, now: b"?\r\n" * 9).port, {"reply_timeout_s": 0.05})
    with pytest.raises(WrongDevice, match="not those of a GSV-8"):
        driver.open()


def test_another_model_answers(wire: Any) -> None:
    simulator = Gsv8Simulator()

    def answer(data: bytes, now: float) -> bytes:
        reply = simulator.receive(data, now)
        return reply.replace(b"\xaa\x54\x00\x48", b"\xaa\x54\x00\x46")

    with pytest.raises(WrongDevice, match="model 06"):
        Gsv8("daq", wire(answer).port, {}).open()


def test_no_such_port() -> None:
    with pytest.raises(ConnectionFailed, match="no such port"):
        Gsv8("daq", "/dev/ttyNOSUCH", {}).open()


def test_unplugged_while_streaming(bench: Any) -> None:
    b = bench()
    b.stream()
    b.blocks(10)
    b.wire.unplug()
    with pytest.raises(DeviceLost, match="check cable and power"):
        b.blocks(100_000)
    with contextlib.suppress(DeviceLost):
        b.driver.stop()
    b.driver.close()


# --- answers that fail ------------------------------------------------------------------------


@pytest.mark.parametrize("fault", ["no_reply", "lost_command"])
def test_a_lost_answer_is_asked_for_again(bench: Any, fault: str) -> None:
    b = bench(settings={"reply_timeout_s": 0.5})
    b.driver.open()
    b.simulator.inject(fault, target=Command.READ_DATA_RATE, count=1)
    b.driver.configure(_request())
    assert b.simulator.sample_rate_Hz == 960.0


def test_a_late_answer_is_not_taken_for_another(bench: Any) -> None:
    b = bench(settings={"reply_timeout_s": 0.5})
    b.driver.open()
    b.simulator.inject("slow_reply", target=Command.READ_USER_SCALE, count=1, value=0.6)
    setup = b.driver.configure(_request())
    assert setup.readback["analog_1.user_scale"] == 3.5
    assert setup.readback["analog_1.user_offset"] == 0.0


def test_close_does_not_wait_long_for_a_device_that_hangs(bench: Any) -> None:
    b = bench()
    b.stream()
    b.driver._link.reply_timeout_s = 0.1
    b.simulator.inject("lost_command")
    b.driver.close()
    sent = bytes(b.wire.received)
    assert sent.endswith(bytes.fromhex("AA902385AA907A85"))


def test_it_streams_over_a_socket(bench: Any) -> None:
    b = bench(tcp=True)
    b.stream(12000.0)
    values, quality = _joined(b.blocks(6000))
    assert values[0] == pytest.approx(np.full(values.shape[1], 0.5), abs=1e-5)
    assert not quality.any()
    b.wire.unplug()
    with pytest.raises(DeviceLost, match="check cable and power"):
        b.blocks(100_000)


def test_a_device_that_falls_silent(bench: Any) -> None:
    b = bench(settings={"reply_timeout_s": 0.3})
    b.driver.open()
    b.simulator.inject("lost_command")
    with pytest.raises(ReplyTimeout, match="no answer to get interface"):
        b.driver.configure(_request())


# --- losses and faults in the stream ----------------------------------------------------------


def test_a_cut_frame_is_counted(bench: Any) -> None:
    b = bench()
    b.stream()
    blocks = b.blocks(20)
    b.simulator.inject("cut_frame")
    blocks += b.blocks(200)
    lost = [block for block in blocks if block.lost_before]
    assert [block.lost_before for block in lost] == [1]
    assert lost[0].quality[0] == Quality.LOST_BEFORE | Quality.RESYNCHRONISED
    ends = [block.first_sample + block.values.shape[1] for block in blocks]
    gaps = [after.first_sample - end for after, end in zip(blocks[1:], ends, strict=False)]
    assert sum(gaps) == 1
    turned = np.unwrap(_joined(blocks)[0][4], period=3600.0)
    assert np.diff(turned).max() == pytest.approx(15.0, abs=1.0)


@pytest.mark.parametrize(
    ("options", "settings", "rate", "protected"),
    [
        ({}, {}, 960.0, "on"),
        ({}, {"data_checksum": False}, 960.0, "off"),
        ({"firmware": "1.55"}, {}, 960.0, "off"),
        ({"usb": False}, {}, 750.0, "on"),
        ({"usb": False}, {}, 800.0, "off"),  # what the line carries without two more bytes
    ],
)
def test_data_are_protected_where_firmware_and_line_can(
    bench: Any, options: dict[str, Any], settings: dict[str, Any], rate: float, protected: str
) -> None:
    b = bench(**options)
    b.driver.open()
    inputs = {"analog_1": ("bridge", 3.5), "analog_2": ("bridge", 3.5)}
    setup = b.driver.configure(DataRequest(rate, inputs, settings))
    assert setup.readback["data_checksum"] == protected
    b.driver.start()
    values, quality = _joined(b.blocks(50))
    assert values[0] == pytest.approx(np.full(values.shape[1], 0.5), abs=1e-5)
    assert not quality.any()


def test_a_splice_of_old_firmware_is_not_given_as_a_sample(bench: Any) -> None:
    b = bench(firmware="1.55")
    b.stream()
    blocks = b.blocks(20)
    for _ in range(5):
        b.simulator.inject("cut_frame")
        blocks += b.blocks(60)
    values, quality = _joined(blocks)
    assert np.count_nonzero(quality & Quality.LOST_BEFORE) == 5
    assert values[0] == pytest.approx(np.full(values.shape[1], 0.5), abs=1e-5)


@pytest.mark.parametrize("settings", [{"data_checksum": False}, {}])
def test_a_flipped_bit(bench: Any, settings: dict[str, Any]) -> None:
    b = bench()
    b.stream(960.0, **settings)
    b.blocks(20)
    b.simulator.inject("flipped_bit", value=3)
    values, quality = _joined(b.blocks(200))
    wrong = np.abs(values[0] - 0.5) > 1e-3
    protected = not settings
    assert wrong.sum() == (0 if protected else 1)
    assert np.any(quality & Quality.LOST_BEFORE) == protected


def test_garbage_between_frames(bench: Any) -> None:
    b = bench()
    b.stream()
    b.blocks(20)
    b.simulator.inject("garbage", value=7)
    values, quality = _joined(b.blocks(200))
    assert np.count_nonzero(quality & Quality.RESYNCHRONISED) == 1
    assert values[0] == pytest.approx(np.full(values.shape[1], 0.5), abs=1e-5)
    assert b.driver.tally.resynchronisations == 1


def test_wrong_object_count_is_an_error(bench: Any) -> None:
    b = bench()
    b.stream()
    b.blocks(20)
    b.simulator.inject("wrong_object_count")
    with pytest.raises(ProtocolError, match="another number of inputs"):
        b.blocks(10_000)


def test_overrun_is_flagged_and_cleared(bench: Any, caplog: Any) -> None:
    b = bench(settings={"poll_interval_s": 0.1})
    b.stream()
    b.blocks(20)
    b.simulator.inject("overrun", value=50)
    _, quality = _joined(b.blocks(500))
    assert np.count_nonzero(quality & Quality.LOST_BEFORE) == 1
    assert "dropped measured values" in caplog.text
    b.simulator.inject("overrun", value=50)
    _, quality = _joined(b.blocks(500))
    assert np.count_nonzero(quality & Quality.LOST_BEFORE) == 1


def test_overrun_can_stop_the_test(bench: Any) -> None:
    b = bench(settings={"poll_interval_s": 0.1, "on_overrun": "stop"})
    b.stream()
    b.simulator.inject("overrun")
    with pytest.raises(DataOverrun, match="not read in time"):
        b.blocks(10_000)


def test_a_host_that_does_not_read_causes_an_overrun(bench: Any, wait_until: Any) -> None:
    b = bench(settings={"poll_interval_s": 0.1}, speed=20.0)
    b.stream(12000.0)
    wait_until(lambda: b.clock.samples > 40_000, "samples of the simulator")
    values, quality = _joined(b.blocks(20_000))
    assert np.any(quality & Quality.LOST_BEFORE)
    steps = np.diff(values[4]) % 3600.0
    assert np.count_nonzero(np.abs(steps - 7.5) > 1.0) >= 1


def test_saturation_is_flagged_and_named(bench: Any, caplog: Any) -> None:
    b = bench(settings={"poll_interval_s": 0.1})
    b.stream()
    _, quality = _joined(b.blocks(20))
    assert not quality.any()
    b.simulator.inject("saturated_input", value=3)
    blocks = b.blocks(400)
    _, quality = _joined(blocks)
    assert np.all(quality[-100:] == Quality.SATURATED)
    assert "channel 3 above its range" in caplog.text
    (told,) = b.driver.input_faults()
    assert (told.kind, told.inputs) == (InputFaultKind.SATURATED, ("analog_3",))
    assert told.host_time_ns > 0


def test_a_broken_wire_is_told_and_marks_every_sample_from_then_on(
    bench: Any, wait_until: Any
) -> None:
    b = bench(settings={"poll_interval_s": 0.1})
    b.stream()
    assert isinstance(b.driver, InputSupervision)
    assert b.driver.input_faults() == ()
    b.simulator.inject("sensor_broken", value=2)

    def told() -> bool:
        return any((block.quality & Quality.SENSOR_FAULT).all() for block in b.blocks(1))

    wait_until(told, "the flag of the broken wire")
    (fault,) = b.driver.input_faults()
    assert (fault.kind, fault.inputs) == (InputFaultKind.SENSOR_BROKEN, ("analog_2",))
    assert fault.words == "sensor or its cable is broken: channel 2 Ud+, channel 2 Ud-"
    b.simulator.clear("sensor_broken")
    b.driver.stop()
    b.driver.start()
    (before,) = b.driver.input_faults()
    assert before.host_time_ns == 0
    assert before.words == f"{fault.words} (reported before the start)"
    assert not _joined(b.blocks(20))[1].any()


def test_the_line_is_counted(bench: Any, wait_until: Any) -> None:
    b = bench(settings={"data_checksum": True})
    b.stream()
    assert isinstance(b.driver, LineCounters)
    b.blocks(50)
    before = b.driver.counters()
    assert before["bytes_received"] > 50 * 24
    assert before["bytes_sent"] > 0
    assert not any(count for name, count in before.items() if "bytes" not in name), before
    b.simulator.inject("flipped_bit")
    wait_until(
        lambda: bool(b.blocks(10)) and b.driver.counters()["crc_errors"] == 1, "the bad frame"
    )
    after = b.driver.counters()
    assert after["lost_samples"] == 1
    assert after["bytes_received"] > before["bytes_received"]


def test_a_device_that_streams_but_answers_no_more(bench: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr("rigapp_drivers.gsv8.stream._PATIENCE_S", 0.1)
    b = bench(settings={"poll_interval_s": 0.1})
    b.stream()
    b.driver._link.reply_timeout_s = 0.1
    b.simulator.inject("lost_command")
    with pytest.raises(ReplyTimeout, match="lost data would not be noticed"):
        b.blocks(100_000)


def test_a_power_cut_of_the_device_is_noticed(bench: Any) -> None:
    b = bench()
    b.stream(960.0, data_checksum=True)
    b.blocks(20)
    b.simulator.inject("reset")
    with pytest.raises(ProtocolError, match="another number of inputs or another format"):
        b.blocks(10_000)


def test_close_gives_the_device_back(bench: Any) -> None:
    b = bench()
    b.stream()
    b.driver.close()
    b.driver.close()
    assert not b.simulator.streaming
    assert bytes.fromhex("AA907A85") in bytes(b.wire.received)


def test_input_types_for_all_bridge_ranges(bench: Any) -> None:
    b = bench()
    b.driver.open()
    ranges = {"analog_1": ("bridge", 2.0), "analog_2": ("bridge", 7.0)}
    setup = b.driver.configure(DataRequest(100.0, ranges))
    assert b.simulator.settings.input_types[:2] == [InputType.BRIDGE_8V75, InputType.BRIDGE_2V5]
    assert [spec.maximum for spec in setup.channels] == pytest.approx([2.1, 7.35])
    b.driver.start()
    values, _ = _joined(b.blocks(10))
    assert values[:, -1] == pytest.approx([0.5, -0.25], abs=1e-5)
    assert setup.readback["analog_1.user_scale"] == 2.0
