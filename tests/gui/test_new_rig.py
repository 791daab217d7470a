"""The page of a new rig: who answers on the ports, and the files that `init --real` writes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from patience import PATIENCE_MS

from rigapp.config.loading import read_rig, read_test
from rigapp.gui.panels import start
from rigapp.gui.panels.start import NewRigPage
from rigapp.gui.window.window import MainWindow
from rigapp.prepare.real_rig import NO_PORT
from rigapp.schema.messages import RunState
from rigapp.testing.bench import SourceBench, SpindleBench
from rigapp.testing.contracts import read_contracts
from rigapp_drivers.api import DriverKind


@dataclass(order=True)
class FakePort:
    """What pyserial tells of a port."""

    device: str
    description: str
    vid: int | None = None
    pid: int | None = None


@pytest.fixture
def plugged_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[dict[str, str]]:
    """Plug in a GSV-8 and a RoboClaw; return their ports. A UART adapter is there, too."""
    benches: dict[str, Any] = {}
    for contract in read_contracts():
        if contract.info.name in ("gsv8", "roboclaw"):
            source = contract.info.kind is DriverKind.DATA_SOURCE
            make = SourceBench if source else SpindleBench
            benches[contract.info.name] = make(contract, tmp_path / contract.info.name, {})
    ports = {name: bench.port.url for name, bench in benches.items()}
    adapter = tmp_path / "ttyUSB0"
    adapter.touch()
    listed = [
        FakePort(str(adapter), "FT232R", 0x0403, 0x6001),
        FakePort(ports["gsv8"], "GSV-8", 0x0683, 0x1001),
        FakePort(ports["roboclaw"], "USB Roboclaw", 0x03EB, 0x2404),
    ]
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: listed)
    known = start.search_ports.__globals__["drivers_of_usb_id"]

    def drivers_of_usb_id(vendor: int | None, product: int | None, drivers: Any) -> Any:
        # A GSV-8 has no USB id of its own among the known ones.
        if vendor == 0x0683:
            return tuple(one for one in drivers if one.name == "gsv8")
        return known(vendor, product, drivers)

    monkeypatch.setattr("rigapp.prepare.real_rig.drivers_of_usb_id", drivers_of_usb_id)
    yield ports
    for bench in benches.values():
        bench.close()


@pytest.fixture
def page(window: MainWindow, attach: Callable[[], None], engine: Any) -> NewRigPage:
    engine.say(state=RunState.READY)
    attach()
    window.tabs.show_page("new_rig")
    found = window.tabs.panels["new_rig"]
    assert isinstance(found, NewRigPage)
    return found


@pytest.fixture
def work(window: MainWindow, page: NewRigPage, qtbot: Any) -> Callable[[], None]:
    """Return what waits until the page's work is done."""

    def done() -> bool:
        window.tick()
        return window._reader.idle

    return lambda: qtbot.waitUntil(done, timeout=PATIENCE_MS)


def test_what_answers_is_chosen_and_the_files_are_written_once(
    plugged_in: dict[str, str],
    page: NewRigPage,
    work: Callable[[], None],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    page.search.click()
    assert not page.search.isEnabled()
    work()
    assert page.searched.text() == "Ports found: 3; known devices answer on 2."
    daq, drive = page.cards["daq"], page.cards["drive"]
    assert (daq.box.driver.name, daq.box.port) == ("gsv8", plugged_in["gsv8"])
    assert (drive.box.driver.name, drive.box.port) == ("roboclaw", plugged_in["roboclaw"])
    assert "serial number 20123456" in daq.who.text()
    drive.port.setEditText(str(tmp_path / "ttyUSB0"))
    assert drive.who.text() == "FT232R: not queried, it is not a USB device itself"
    drive.port.setEditText(plugged_in["gsv8"])
    assert drive.who.text().startswith("✗ Another device answers there: ")
    drive.port.setEditText("")
    folder = tmp_path / "rig 8"
    page.folder.setText(str(folder))
    page.make.click()
    work()
    devices = read_rig(folder / "rig.toml").record.devices
    assert (devices["daq"].driver, devices["daq"].port) == ("gsv8", plugged_in["gsv8"])
    assert (devices["drive"].driver, devices["drive"].port) == ("roboclaw", NO_PORT)
    assert read_test(folder / "test.toml").record.run.revolutions == 50
    written = {str(one.relative_to(folder)) for one in folder.rglob("*") if one.is_file()}
    shown = {page.files.item(row, 0).text() for row in range(page.files.rowCount())}
    assert shown == written
    launched: list[Any] = []
    monkeypatch.setattr(start, "launch_process", lambda *given: launched.append(given))
    page.open.click()
    assert launched == [(["gui", "--rig", str(folder / "rig.toml")], folder)]
    page.make.click()
    work()
    assert "already; nothing was written" in page.outcome.text()
    assert page.open.isHidden()


def test_ports_are_not_searched_while_a_test_runs(
    page: NewRigPage, engine: Any, attach: Callable[[], None]
) -> None:
    assert page.search.isEnabled()
    engine.say(state=RunState.RUNNING)
    attach()
    assert not page.search.isEnabled()
    assert page.make.isEnabled()
    page.folder.setText(" ")
    assert not page.make.isEnabled()
