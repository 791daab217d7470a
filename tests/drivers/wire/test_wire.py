"""Lines of devices: recorded, read back, played; what is damaged is told in one sentence."""

from __future__ import annotations

import logging
import random
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigapp.commands.status import shown
from rigapp.config.errors import UnusableInput
from rigapp.engine.wirerecording import WireRecording
from rigapp.testing.traces import check_trace
from rigapp_drivers.api import ConnectionFailed, DataRequest, ReplyTimeout, SlowRequest
from rigapp_drivers.edge import make_driver
from rigapp_drivers.registry import load_driver
from rigapp_drivers.simulator_api import RigSignals
from rigapp_drivers.transport import SerialPort
from rigapp_drivers.wire.ports import PortNotFound, actual_port, port_of_number, stable_name
from rigapp_drivers.wire.recorder import LIMIT_BYTES, WireRecorder, record_line, recorders_of
from rigapp_drivers.wire.trace import MAGIC, RecordKind, TraceError, read_trace

HEADER = {"device": "d", "driver": "roboclaw", "protocol": "bytes", "settings": {}}
GOLDEN = Path(__file__).parents[2] / "data"
GSV8_BYTES_PER_S = 288_000  # 12000 frames of 24 bytes
READS_PER_S = 200


def steady(index: Any) -> RigSignals:
    """Return a constant signal and a shaft that stands."""
    return RigSignals({1: np.full(len(index), 0.5)}, np.zeros(len(index)))


def recorded(path: Path, pieces: int = 50, **options: Any) -> list[tuple[RecordKind, bytes]]:
    """Record pieces of random bytes; return what was recorded."""
    recorder = WireRecorder(path, HEADER, **options)
    source = random.Random(1)
    said = []
    for number in range(pieces):
        data = source.randbytes(source.randrange(1, 400))
        (recorder.sent if number % 2 else recorder.received)(data)
        said.append((RecordKind.SENT if number % 2 else RecordKind.RECEIVED, data))
    recorder.close()
    return said


def test_every_byte_is_kept_with_direction_and_rising_time(tmp_path: Path) -> None:
    path = tmp_path / "a.wire"
    said = recorded(path)
    trace = read_trace(path)
    assert [(one.kind, one.data) for one in trace.records] == said
    times = [one.time_ns for one in trace.records]
    assert times == sorted(times)
    assert trace.header["driver"] == "roboclaw"
    assert not trace.problem


def test_a_recording_that_is_closed_goes_on_in_the_same_file(tmp_path: Path) -> None:
    recorder = WireRecorder(tmp_path / "a.wire", HEADER)
    for data in (b"one", b"two"):
        recorder.sent(data)
        recorder.close()
    assert [one.data for one in read_trace(recorder.path).records] == [b"one", b"two"]


def test_a_recording_is_bounded_and_keeps_its_beginning(tmp_path: Path) -> None:
    path, limit = tmp_path / "a.wire", 10_000
    recorder = WireRecorder(path, HEADER, limit)
    for number in range(100):
        recorder.received(number.to_bytes(2, "big") + bytes(2000))
        if number % 5 == 0:
            recorder.close()  # writes what waits
    recorder.close()
    files = sorted(tmp_path.iterdir())
    assert [one.name for one in files] == ["a.wire", "a.wire.1", "a.wire.2"]
    assert sum(one.stat().st_size for one in files) < 3 * (limit + 6 * 2100)
    assert read_trace(tmp_path / "a.wire.1").records[0].data[:2] == bytes(2)
    last = [one for name in files for one in read_trace(name).records][-1]
    numbers = {int.from_bytes(one.data[:2], "big") for one in read_trace(path).records}
    assert 99 in numbers or int.from_bytes(last.data[:2], "big") == 99


def test_an_earlier_recording_keeps_its_name_and_its_content(tmp_path: Path) -> None:
    path = tmp_path / "a.wire"
    for limit in (LIMIT_BYTES, 1000, LIMIT_BYTES):
        said = recorded(path, limit_bytes=limit)
        if limit == LIMIT_BYTES:
            newest = max(tmp_path.glob("a*.wire"), key=lambda one: one.stat().st_mtime_ns)
            assert [(one.kind, one.data) for one in read_trace(newest).records] == said
    names = {one.name for one in tmp_path.iterdir()}
    assert names >= {"a.wire", "a-2.wire.1", "a-3.wire"}, names


def test_a_file_that_is_being_made_is_readable_at_any_time(tmp_path: Path) -> None:
    path, stopped, unread = tmp_path / "a.wire", threading.Event(), list[str]()

    def read() -> None:
        while not stopped.is_set():
            for one in tmp_path.glob("[!.]*"):
                try:
                    read_trace(one)
                except TraceError as error:
                    if one.exists():  # it was not renamed in between
                        unread.append(str(error))

    reader = threading.Thread(target=read)
    reader.start()
    for _ in range(100):
        recorded(path, 2)
    stopped.set()
    reader.join(10.0)
    assert not unread
    assert len(list(tmp_path.iterdir())) == 100


@pytest.mark.parametrize("by", ["file", "key"])
def test_every_connection_has_a_recording_of_its_own(tmp_path: Path, by: str) -> None:
    recording = WireRecording(tmp_path, tmp_path / "line.wire" if by == "file" else None)
    driver = load_driver("gsv8")
    for port in ("loop://1", "loop://2", "loop://2"):
        recording.attach("daq", port, by == "key", driver, {})
        for recorder in recorders_of("daq", port):
            recorder.sent(port.encode())
    recording.attach("oil", "loop://3", False, driver, {})
    recording.end()
    assert not [port for port in ("loop://1", "loop://2", "loop://3") if recorders_of("daq", port)]
    folder = tmp_path if by == "file" else tmp_path / "wire"
    kept = [read_trace(one).records for one in folder.iterdir()]
    assert sorted(one.data for (one,) in kept) == [b"loop://1", b"loop://2", b"loop://2"]
    if by == "file":
        names = {one.name for one in folder.iterdir()}
        assert names == {"line-daq.wire", "line-daq-2.wire", "line-daq-3.wire"}


def test_a_cut_file_gives_what_is_before_and_one_sentence_for_every_cut(tmp_path: Path) -> None:
    path = tmp_path / "a.wire"
    said = recorded(path, 6)
    whole = path.read_bytes()
    cut = tmp_path / "cut.wire"
    told, sentences = 0, set[int]()
    for length in range(len(whole)):
        cut.write_bytes(whole[:length])
        try:
            trace = read_trace(cut)
        except TraceError as error:
            sentences.add(str(error).count(". "))
            continue
        got = [(one.kind, one.data) for one in trace.records]
        assert got == said[: len(got)]
        told += bool(trace.problem)
    assert told > len(whole) // 2
    assert sentences == {0}


def test_no_flipped_bit_gives_other_bytes_in_silence(tmp_path: Path) -> None:
    path = tmp_path / "a.wire"
    said = recorded(path, 6)
    whole = path.read_bytes()
    spoiled = tmp_path / "spoiled.wire"
    source = random.Random(2)
    for _ in range(400):
        place, bit = source.randrange(len(whole)), source.randrange(8)
        data = bytearray(whole)
        data[place] ^= 1 << bit
        spoiled.write_bytes(data)
        try:
            trace = read_trace(spoiled)
        except TraceError:
            continue
        got = [(one.kind, one.data) for one in trace.records]
        assert got == said[: len(got)]
        assert trace.problem, f"bit {bit} of byte {place}"


@pytest.mark.parametrize("content", [b"", b"x", MAGIC, b"\0" * 1000, MAGIC + b"\xff" * 500])
def test_what_is_no_recording_is_refused_in_a_sentence(tmp_path: Path, content: bytes) -> None:
    from rigapp.commands.status import show_line

    path = tmp_path / "a.wire"
    path.write_bytes(content)
    with pytest.raises(UnusableInput, match="recorded line"):
        show_line(path)
    with pytest.raises(ConnectionFailed, match="recorded line") as failure:
        SerialPort("daq", f"wire:{path}", 115200).open()
    assert "Traceback" not in str(failure.value)


def test_recording_costs_less_than_three_percent_of_a_core(tmp_path: Path) -> None:
    """At the full rate of a GSV-8, in the time of the processor, both threads together."""
    recorder = WireRecorder(tmp_path / "a.wire", HEADER, 1 << 30)
    seconds = 5
    piece = bytes(GSV8_BYTES_PER_S // READS_PER_S)
    began = time.process_time()
    for number in range(READS_PER_S * seconds):
        recorder.received(piece)
        if number % 40 == 0:
            time.sleep(0.005)  # lets the writer write in between
    recorder.close()
    used = (time.process_time() - began) / seconds
    assert len(read_trace(recorder.path).records) == READS_PER_S * seconds
    assert used < 0.03, f"{used:.2%} of a core"


def test_a_disk_that_fails_ends_the_recording_and_not_the_line(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    blocked = tmp_path / "file"
    blocked.write_bytes(b"")
    recorder = WireRecorder(blocked / "a.wire", HEADER)
    with caplog.at_level(logging.WARNING):
        for _ in range(3):
            recorder.sent(b"x")
            recorder.close()
    assert len([one for one in caplog.records if "no longer recorded" in one.message]) == 1


def test_a_gsv8_is_recorded_shown_replayed_and_a_test(wire: Any, tmp_path: Path) -> None:
    from rigapp_drivers.gsv8.simulator import Gsv8Simulator

    simulator = Gsv8Simulator()
    device, _ = wire.source(simulator, steady)
    path = tmp_path / "daq.wire"
    settings = {"sample_rate_Hz": 1000.0}
    driver = make_driver(load_driver("gsv8"), "daq", device.port, settings)
    header = {"device": "daq", "driver": "gsv8", "protocol": "bytes", "settings": settings}
    record_line("daq", device.port, WireRecorder(path, header))
    try:
        driver.open()
        driver.configure(DataRequest(1000.0, {"analog_1": ("bridge", 3.5)}, settings))
        driver.start()
        samples = 0
        while samples < 600:
            block = driver.read(1.0)
            samples += block.values.shape[1] if block is not None else 0
        driver.stop()
    finally:
        driver.close()
        record_line("daq", device.port, None)
    lines = "\n".join(shown(read_trace(path)))
    for words in ("firmware version", "bytes of measured values", "start transmission", "done"):
        assert words in lines
    replayed = check_trace(path)
    assert replayed.samples >= samples
    assert replayed.lost_samples == 0


@pytest.mark.parametrize("driver", ["gsv8", "modbus_sensor", "roboclaw"])
def test_a_recorded_device_is_understood_as_on_the_day_it_was_recorded(driver: str) -> None:
    check_trace(GOLDEN / f"{driver}.wire")


def test_an_answer_is_given_to_its_question_in_any_order(wire: Any, tmp_path: Path) -> None:
    from rigapp_drivers.modbus_sensor.registers import OWN
    from rigapp_drivers.modbus_sensor.simulator import ModbusSensorSimulator

    registers = [
        {"quantity": "oil_C", "address": 10, "scale": 0.1, "function": 4},
        {"quantity": "air_C", "address": 40, "scale": 0.1, "function": 4},
    ]
    settings = {"preset": OWN, "registers": registers}
    simulator = ModbusSensorSimulator(preset=OWN, registers=registers)
    simulator.observe({"oil_C": 71.5, "air_C": 22.0})
    device = wire(simulator.receive)
    path = tmp_path / "oil.wire"
    header = {"device": "oil", "driver": "modbus_sensor", "protocol": "bytes", "settings": settings}
    record_line("oil", device.port, WireRecorder(path, header))
    info = load_driver("modbus_sensor")
    driver = make_driver(info, "oil", device.port, settings)
    driver.open()
    driver.configure(SlowRequest(("oil_C", "air_C")))
    driver.read()
    driver.close()
    record_line("oil", device.port, None)
    turned = make_driver(info, "oil", f"wire:{path}", settings | {"registers": registers[::-1]})
    try:
        turned.open()
        for names in (("air_C",), ("oil_C",), ("air_C", "oil_C")):
            turned.configure(SlowRequest(names))
            values = {"oil_C": 71.5, "air_C": 22.0}
            assert turned.read() == pytest.approx({name: values[name] for name in names})
    finally:
        turned.close()
    other = settings | {"registers": [registers[0] | {"address": 11}], "reply_timeout_s": 0.05}
    stranger = make_driver(info, "oil", f"wire:{path}", other)
    with pytest.raises((ConnectionFailed, ReplyTimeout)):
        stranger.open()


class UsbPort:
    def __init__(self, device: str, number: str | None) -> None:
        self.device, self.serial_number = device, number


def test_a_port_is_found_by_its_usb_number_under_any_name() -> None:
    for name in ("/dev/ttyACM0", "/dev/ttyACM7", "COM12"):
        found = [UsbPort("/dev/ttyS0", None), UsbPort(name, "A4B3"), UsbPort("/dev/x", "Q")]
        assert port_of_number("a4b3 ", found) == name
    with pytest.raises(PortNotFound, match=r"no port has .* 99; there are: A4B3"):
        port_of_number("99", [UsbPort("/dev/ttyACM0", "A4B3")])
    with pytest.raises(PortNotFound, match="2 ports have"):
        port_of_number("0001", [UsbPort("a", "0001"), UsbPort("b", "0001")])


def test_a_port_that_comes_back_under_another_name_is_found(
    wire: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from rigapp_drivers.wire import ports

    first, second = (wire(lambda data, now_s: data) for _ in range(2))
    there = [UsbPort(first.port, "77")]
    monkeypatch.setattr(ports.list_ports, "comports", lambda: there)
    line = SerialPort("daq", "serial:77", 115200)
    line.open()
    line.write(b"one")
    line.close()
    there[0] = UsbPort(second.port, "77")
    line.open()
    line.write(b"two")
    assert line.read_some(3, 10.0) == b"two"
    line.close()
    there.clear()
    with pytest.raises(ConnectionFailed, match="no port has the USB serial number 77"):
        line.open()


def test_the_stable_name_of_a_port_is_its_name_by_id(tmp_path: Path) -> None:
    port, folder = tmp_path / "ttyACM3", tmp_path / "by-id"
    port.touch()
    folder.mkdir()
    (folder / "usb-ME_GSV-8-if00").symlink_to(port)
    assert stable_name(str(port), folder) == str(folder / "usb-ME_GSV-8-if00")
    assert not stable_name(str(tmp_path / "other"), folder)
    assert not stable_name(str(port), tmp_path / "none")


def test_other_ports_are_left_as_they_are() -> None:
    for port in ("/dev/ttyACM0", "socket://127.0.0.1:5", "COM4", "0", "wire://a"):
        assert actual_port(port) == port
