"""`rigapp doctor` names devices, says what to do, and never shows a traceback."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_S

from rigapp.commands import doctor
from rigapp.simulation.wire.link import WireFault
from rigapp.testing.bench import SourceBench, SpindleBench
from rigapp.testing.contracts import read_contracts
from rigapp_drivers import registry
from rigapp_drivers.api import DriverKind


@dataclass(order=True)
class FakePort:
    """What pyserial tells of a port."""

    device: str
    description: str = "n/a"
    vid: int | None = None
    pid: int | None = None


@pytest.fixture
def device(tmp_path: Path) -> Iterator[Callable[[str], Any]]:
    """Put the simulated device of a driver on a pty."""
    made: list[Any] = []
    contracts = {contract.info.name: contract for contract in read_contracts()}

    def make(name: str) -> Any:
        contract = contracts[name]
        source = contract.info.kind is DriverKind.DATA_SOURCE
        bench = (SourceBench if source else SpindleBench)(contract, tmp_path / name, {})
        made.append(bench)
        return bench

    yield make
    for bench in made:
        bench.close()


@pytest.fixture
def listed(monkeypatch: pytest.MonkeyPatch) -> Callable[..., list[doctor.Observation]]:
    """Examine these serial ports."""

    def examine(*ports: FakePort) -> list[doctor.Observation]:
        monkeypatch.setattr("serial.tools.list_ports.comports", lambda: list(ports))
        return list(doctor.ports())

    return examine


@pytest.mark.sampled
@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("gsv8", "ME-Systeme GSV-8, firmware 1.56, serial number 20123456 (driver gsv8)"),
        ("roboclaw", "Basicmicro USB Roboclaw 2x30a, firmware v4.2.4, address 128"),
        ("dataq", "DATAQ Instruments DI-2108, firmware"),
        ("cia402", "slcan CAN adapter, firmware 1013, nodes no heartbeat received"),
    ],
)
def test_a_named_port_is_asked(
    device: Callable[[str], Any], capsys: pytest.CaptureFixture[str], name: str, words: str
) -> None:
    url = device(name).port.url
    assert doctor.examine(url) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert words in told
    assert f'driver = "{name}", port = "{url}"' in told


def test_a_named_port_in_use_is_told(
    device: Callable[[str], Any], capsys: pytest.CaptureFixture[str]
) -> None:
    bench = device("gsv8")
    bench.connect()
    assert doctor.examine(bench.port.url) == 1
    told = " ".join(capsys.readouterr().out.split())
    assert "in use by another program" in told
    bench.judge(bench.blocks(50))


def test_the_rules_for_ports_are_printed_and_their_absence_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert doctor.print_rules() == 0
    lines = capsys.readouterr().out.splitlines()
    known = [line for line in lines if "ID_MM_DEVICE_IGNORE" in line]
    assert ['"0683"' in known[1], '"03eb"' in known[0]] == [True, True]
    rules = [line for line in lines if line and not line.startswith("#")]
    pair = r'[A-Z_]+(\{\w+\})?(==|=|\+=)"[^"]*"'
    assert all(re.fullmatch(rf"{pair}(, {pair})*", line) for line in rules), "as udev reads them"
    (told,) = doctor.rules_advice([tmp_path])
    assert "rigapp doctor --rules | sudo tee" in told.text
    (tmp_path / doctor.RULES_NAME).write_text("", "utf-8")
    (told,) = doctor.rules_advice([tmp_path])
    assert told.text == "installed"
    assert not list(doctor.rules_advice([tmp_path / "no udev here"]))


def test_known_usb_devices_are_asked_and_adapters_are_not(
    device: Callable[[str], Any], listed: Callable[..., list[doctor.Observation]]
) -> None:
    drive, adapter = device("roboclaw"), device("gsv8")
    findings = listed(
        FakePort(drive.port.url, "USB Roboclaw", 0x03EB, 0x2404),
        FakePort(adapter.port.url, "FT232R USB UART", 0x0403, 0x6001),
    )
    told = {finding.subject: finding for finding in findings}
    assert "Roboclaw 2x30a" in told[drive.port.url].text
    assert "could take any byte for a speed" in told[adapter.port.url].text
    assert f"rigapp doctor --port {adapter.port.url}" in told[adapter.port.url].text
    assert not adapter.port.received
    assert all(finding.good for finding in findings)


def test_a_known_device_that_is_silent_needs_action(
    device: Callable[[str], Any], listed: Callable[..., list[doctor.Observation]]
) -> None:
    bench = device("dataq")
    bench.port.wire.start_fault(WireFault.HANG)
    findings = listed(FakePort(bench.port.url, "DI-2108", 0x0683, 0x2108))
    assert findings[-1].good is False
    assert "does not answer" in findings[-1].text
    assert "CDC" in findings[-1].text


def test_permissions_are_explained(
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    listed: Callable[..., list[doctor.Observation]],
    capsys: pytest.CaptureFixture[str],
) -> None:
    port = tmp_path / "ttyUSB7"
    port.touch()
    monkeypatch.setattr("os.access", lambda path, mode: False)
    finding = listed(FakePort(str(port), "FT232R"))[-1]
    assert not finding.good
    assert "sudo usermod -aG" in finding.text
    assert "log in again" in finding.text
    assert doctor.examine(str(port)) == 1
    assert "sudo usermod" in capsys.readouterr().out


def test_no_port_at_all_is_no_fault(listed: Callable[..., list[doctor.Observation]]) -> None:
    findings = listed()
    assert "none found" in findings[-1].text
    assert all(finding.good for finding in findings)


@pytest.mark.parametrize(("text", "advised"), [("16\n", True), ("1\n", False)])
def test_the_latency_timer_is_explained(tmp_path: Path, text: str, advised: bool) -> None:
    timer = tmp_path / "ttyUSB0" / "latency_timer"
    timer.parent.mkdir()
    timer.write_text(text)
    (finding,) = doctor.latency_timer("ttyUSB0", tmp_path)
    assert finding.good
    assert (f"echo 1 | sudo tee {timer}" in finding.text) == advised
    timer.write_text("nonsense")
    assert not list(doctor.latency_timer("ttyUSB0", tmp_path))
    assert not list(doctor.latency_timer("ttyACM0", tmp_path))


def test_can_interfaces(tmp_path: Path) -> None:
    assert "none found" in next(iter(doctor.can_interfaces(tmp_path / "none"))).text
    for name, kind, state in (("can7", "280", "down"), ("eth0", "1", "up")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "type").write_text(f"{kind}\n")
        (tmp_path / name / "operstate").write_text(f"{state}\n")
    (finding,) = doctor.can_interfaces(tmp_path)
    assert finding.subject == "can7"
    assert finding.good
    assert "sudo ip link set can7 up type can bitrate 500000" in finding.text
    (tmp_path / "can7" / "operstate").write_text("up\n")
    (finding,) = doctor.can_interfaces(tmp_path)
    assert not finding.good, "there is no such interface in this machine"
    assert "cannot be listened to" in finding.text


def test_broken_packages_of_others_are_findings(monkeypatch: pytest.MonkeyPatch) -> None:
    entries = (
        EntryPoint("absent", "no_such_package_at_all:X", registry.GROUP),
        EntryPoint("wrong", "math:pi", registry.GROUP),
        EntryPoint("gsv8", "rigapp_drivers.gsv8.driver:DRIVER", registry.GROUP),
    )
    monkeypatch.setattr(registry, "entry_points", lambda group: entries)
    findings: list[doctor.Observation] = []
    assert [info.name for info in doctor.installed_drivers(findings)] == ["gsv8"]
    assert [finding.subject for finding in findings] == ["Driver absent", "Driver wrong"]
    assert not any(finding.good for finding in findings)


@pytest.mark.parametrize(
    ("port", "words"),
    [("/dev/does-not-exist", "no such port"), ("socket://127.0.0.1:9", "no connection")],
)
def test_the_command_line_says_what_is_wrong_without_a_traceback(port: str, words: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "rigapp", "doctor", "--port", port],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert done.returncode == 1
    assert words in " ".join(done.stdout.split())
    assert "Traceback" not in done.stdout + done.stderr


def test_the_whole_examination_runs_with_nothing_connected() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "rigapp", "doctor"],
        capture_output=True,
        text=True,
        timeout=PATIENCE_S,
        check=False,
    )
    assert "Traceback" not in done.stdout + done.stderr
    assert ("ACT" in done.stdout) == (done.returncode == 1)
    for subject in ("Python", "Drivers", "CAN interfaces", "Window self test"):
        assert subject in done.stdout


def test_an_installation_without_the_window_is_no_fault(
    listed: Callable[..., list[doctor.Observation]], monkeypatch: pytest.MonkeyPatch
) -> None:
    versions = dict.fromkeys(doctor.PACKAGES, "1.0")
    monkeypatch.setattr(doctor, "_version", lambda package: versions.get(package, ""))
    listed()
    found = list(doctor._all())
    assert all(one.good for one in found)
    assert any("rigapp[gui]" in one.text for one in found)
    versions["pyqtgraph"] = "0.14.0"
    assert [one.subject for one in doctor._all() if not one.good] == ["PySide6-Essentials"]
