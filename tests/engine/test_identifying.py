"""Devices that are other ones than the rig file says, exchanged, or absent."""

from __future__ import annotations

import os
import shutil
import threading
import tty
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import pytest

from rigapp.calibrating.records_in_use import with_records
from rigapp.checks.check import CheckVerdict
from rigapp.commands.check import look
from rigapp.config.loading import read_rig, read_test
from rigapp.engine.devices import Devices, make_devices
from rigapp.engine.identifying import identity_words
from rigapp.engine.recording.store import detector_record
from rigapp_drivers.api import ConnectionFailed, DeviceError, WrongDevice
from rigapp_drivers.gsv8.simulator import Gsv8Simulator
from rigapp_drivers.roboclaw.simulator import RoboClawSimulator
from rigapp_drivers.wire.ports import beside

RIG = Path("examples/simulated.toml")


@contextmanager
def on_a_pty(receive: Callable[[bytes, float], bytes]) -> Iterator[str]:
    """Answer on a pty that the program under test did not make; yields its path."""
    device, host = os.openpty()
    tty.setraw(device)
    tty.setraw(host)
    ended = threading.Event()

    def serve() -> None:
        now_s = 0.0
        while not ended.is_set():
            try:
                data = os.read(device, 4096)
            except OSError:
                return
            now_s += 0.001
            answer = receive(data, now_s)
            if answer:
                os.write(device, answer)

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield os.ttyname(host)
    finally:
        ended.set()
        os.write(host, b"\0")
        thread.join(10.0)
        os.close(device)
        os.close(host)


def rig_file(folder: Path, daq: str, drive: str, **keys: str) -> Any:
    """Return a rig file whose two devices are on these ports; keys: of the table of ``daq``."""
    text = RIG.read_text().split("[simulation]")[0] + _after_simulation()
    # Who does not answer is asked several times: the proof is not how long.
    text = text.replace("sample_rate_Hz", "reply_timeout_s = 0.2\nsample_rate_Hz", 1)
    text = text.replace("address = 128", "address = 128\nreply_timeout_ms = 40.0", 1)
    more = "".join(f'{key} = "{value}"\n' for key, value in keys.items())
    text = text.replace('port = "simulated"', f'port = "{daq}"\n{more}', 1)
    text = text.replace('port = "simulated"', f'port = "{drive}"', 1)
    path = folder / "rig.toml"
    path.write_text(text)
    return read_rig(path).record


def _after_simulation() -> str:
    rest = RIG.read_text().split("[simulation]")[1]
    tables = [f"[{one}" for one in rest.split("\n[")[1:]]
    return "\n".join(one for one in tables if not one.startswith("[simulation"))


@pytest.fixture
def ptys() -> Iterator[tuple[str, str]]:
    """Return the ports of a GSV-8 and of a RoboClaw."""
    with ExitStack() as stack:
        yield (
            stack.enter_context(on_a_pty(Gsv8Simulator(serial_number=20123456).receive)),
            stack.enter_context(on_a_pty(RoboClawSimulator().receive)),
        )


def devices(rig: Any) -> Devices:
    return make_devices(rig, {})


def test_exchanged_ports_say_who_answers_on_each(tmp_path: Path, ptys: tuple[str, str]) -> None:
    gsv8, roboclaw = ptys
    with pytest.raises(DeviceError) as failure:
        devices(rig_file(tmp_path, daq=roboclaw, drive=gsv8)).open()
    said = {one.device: one.sentence for one in failure.value.each}
    assert "Roboclaw" in said["daq"]
    assert "a ME-Systeme GSV-8 answers here (serial number 20123456)" in said["drive"]
    assert all("answers here" in one for one in said.values())


def test_every_missing_device_is_named_not_the_first(tmp_path: Path) -> None:
    rig = rig_file(tmp_path, daq="/dev/ttyNONE1", drive="/dev/ttyNONE2")
    with pytest.raises(ConnectionFailed) as failure:
        devices(rig).open()
    assert {one.port for one in failure.value.each} == {"/dev/ttyNONE1", "/dev/ttyNONE2"}
    assert "/dev/ttyNONE1" in str(failure.value)
    assert "/dev/ttyNONE2" in str(failure.value)


def test_a_missing_slow_source_is_named_beside_the_others(tmp_path: Path) -> None:
    rig_file(tmp_path, daq="/dev/ttyNONE1", drive="/dev/ttyNONE2")
    path = tmp_path / "rig.toml"
    path.write_text(
        path.read_text() + '[devices.climate]\ndriver = "modbus_sensor"\nport = "/dev/ttyNONE3"\n'
        '[channels.room_temperature]\nsource = "climate.temperature_C"\n'
    )
    records = with_records(read_rig(path))
    status, found = look(records, read_test(RIG.with_name("quick.toml")).record)
    assert status is None
    assert {one.name: one.verdict for one in found} == {
        "Device drive": CheckVerdict.BLOCKS,
        "Device daq": CheckVerdict.BLOCKS,
        "Device climate": CheckVerdict.ATTENTION,
    }
    assert all(one.advice == "See troubleshooting.md#nothing-answers" for one in found)


def test_a_recording_is_found_beside_its_rig_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rig = rig_file(tmp_path, daq="wire:daq.wire", drive="/dev/ttyNONE2")
    shutil.copy("tests/data/gsv8.wire", tmp_path / "daq.wire")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.chdir(elsewhere)
    source = make_devices(rig, {}, folder=tmp_path).source
    try:
        assert source.open().serial_number == "20123456"
    finally:
        source.close()
    absolute = f"wire:{tmp_path / 'daq.wire'}"
    assert beside(Path("folder"), absolute) == absolute
    assert beside(Path("folder"), "/dev/ttyACM0") == "/dev/ttyACM0"


def test_another_serial_number_is_refused_with_both(tmp_path: Path, ptys: tuple[str, str]) -> None:
    rig = rig_file(tmp_path, *ptys, serial_number="20999999")
    with pytest.raises(WrongDevice, match="20123456 answers, and 20999999 is required"):
        devices(rig).open()


def test_what_a_device_says_of_itself_is_in_the_file(tmp_path: Path, ptys: tuple[str, str]) -> None:
    rig = rig_file(tmp_path, *ptys, serial_number="020123456")
    opened = devices(rig)
    try:
        opened.open()
        found = detector_record(rig, 1000.0, opened.readback)["load_cell"]
        assert (found["serial_number"], found["firmware"]) == ("20123456", "1.56")
        words = identity_words(opened.readback["daq"])
        assert words == "ME-Systeme GSV-8, firmware 1.56, serial number 20123456"
    finally:
        opened.close()
