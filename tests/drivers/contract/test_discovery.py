"""Every driver's device is found by asking, and no question moves or changes anything."""

from __future__ import annotations

import dataclasses
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import can
import pytest
from patience import PATIENCE_S

from rigapp.testing.bench import Port
from rigapp.testing.contracts import read_contracts
from rigapp_drivers.api import DriverInfo, DriverKind, Probe
from rigapp_drivers.cia402.probe import ABILITIES, listen, node_words
from rigapp_drivers.discovery import ask, drivers_of_usb_id, has_speed, may_be_probed
from rigapp_drivers.registry import load_driver

Make = Callable[..., Any]


def _drivers() -> list[DriverInfo]:
    return [contract.info for contract in read_contracts()]


class Mute:
    """A device that answers nothing, or always the same."""

    def __init__(self, answer: bytes = b"") -> None:
        self.answer = answer

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Answer."""
        return self.answer

    def overrun(self, now_s: float) -> None:
        """Bear a host that does not read."""


@pytest.fixture
def device(tmp_path: Path) -> Iterator[Callable[[Any], Port]]:
    """Put a device of one's own on a port."""
    made: list[Port] = []

    def make(simulator: Any) -> Port:
        made.append(Port(simulator, tmp_path / f"own{len(made)}", lambda now: b"", streams=True))
        return made[-1]

    yield make
    for port in made:
        port.close()


def test_roboclaw_and_can_are_only_read(bench: Make) -> None:
    contracts = {c.info.name: c for c in read_contracts()}
    drive = bench(contracts["roboclaw"])
    assert ask(drive.port.url, [contracts["roboclaw"].info], PATIENCE_S).answer is not None
    assert bytes(drive.port.received) == b"\x80\x15"
    adapter = bench(contracts["cia402"])
    adapter.simulator.node.objects.set(0x1017, 50)
    inquiry = ask(adapter.port.url, [contracts["cia402"].info], PATIENCE_S)
    assert inquiry.answer is not None
    assert inquiry.answer.identity.details["nodes"] == "node 1 (pre-operational)"
    assert inquiry.answer.identity.details["bit_rate"] == "500000"
    details = inquiry.answer.identity.details
    assert "reaction to its silence ‹6007›, unit of speeds ‹60A9›" in details["node_1_has"]
    lines = bytes(adapter.port.received).split(b"\r")
    assert lines[:5] == [b"", b"V", b"C", b"S6", b"L"], "no frame before a node is heard"
    asked = [line for line in lines if line.startswith(b"t")]
    assert len(asked) == len(ABILITIES)
    assert all(line.startswith(b"t601840") for line in asked), "values are read, none is set"
    foreign = dataclasses.replace(
        contracts["cia402"], simulator={"vendor": 1, "lacking": (0x6007, 0x6079)}
    )
    adapter = bench(foreign)
    adapter.simulator.node.objects.set(0x1017, 50)
    inquiry = ask(adapter.port.url, [contracts["cia402"].info], PATIENCE_S)
    assert inquiry.answer is not None
    lacking = "reaction to its silence ‹6007›, supply voltage ‹6079›"
    assert inquiry.answer.identity.details["node_1_lacks"] == lacking


def test_a_drive_at_another_address_is_found(bench: Make, tmp_path: Path) -> None:
    contract = next(c for c in read_contracts() if c.info.name == "roboclaw")
    other = dataclasses.replace(contract, simulator={"address": 0x83})
    inquiry = ask(bench(other).port.url, [contract.info], PATIENCE_S)
    assert inquiry.answer is not None
    assert inquiry.answer.identity.details["address"] == "131"


@pytest.mark.parametrize("answer", [b"", b"?\r\n", b"\xaa\x50\x40\x85", b"\xff" * 9, b"\0" * 99])
def test_a_stranger_is_not_mistaken(device: Callable[[Any], Port], answer: bytes) -> None:
    inquiry = ask(device(Mute(answer)).url, _drivers(), 0.05)
    assert inquiry.answer is None
    assert inquiry.problem == ""
    assert len(inquiry.tried) == len(_drivers())


def test_a_port_that_is_not_there_is_told(tmp_path: Path) -> None:
    inquiry = ask(str(tmp_path / "none"), _drivers())
    assert inquiry.answer is None
    assert "no such port" in inquiry.problem


def test_a_device_that_goes_away_while_asked_is_told(device: Callable[[Any], Port]) -> None:
    port = device(Mute())

    def ask_and_pull(line: Any, timeout_s: float) -> None:
        with port._lock:
            port.wire.endpoint.pull()
        line.write(b"?")
        line.read_some(9, timeout_s)

    info = _info(Probe(ask_and_pull))
    assert "broke" in ask(port.url, [info]).problem


def test_a_faulty_question_of_another_package_ends_nothing(device: Callable[[Any], Port]) -> None:
    def fail(line: Any, timeout_s: float) -> None:
        raise KeyError("oops")

    inquiry = ask(device(Mute()).url, [_info(Probe(fail)), load_driver("gsv8")], 0.05)
    assert len(inquiry.tried) == 2
    assert "its driver other failed while it was identified" in inquiry.problem


def test_usual_baud_rates_are_tried_in_turn(monkeypatch: pytest.MonkeyPatch, device: Any) -> None:
    rates: list[int] = []

    def note(line: Any, timeout_s: float) -> None:
        rates.append(line.baud_rate)

    monkeypatch.setattr("rigapp_drivers.discovery.has_speed", lambda port: True)
    first, second = _info(Probe(note, (9600, 115200))), _info(Probe(note, (115200,)))
    ask(device(Mute()).url, [first, second], 0.05)
    assert rates == [9600, 115200, 115200]


def _info(probe: Probe) -> DriverInfo:
    def factory(name: str, port: str, settings: Any) -> Any:
        raise NotImplementedError("discovery only probes, it opens no device")

    return DriverInfo("other", f"Another box {id(probe)}", DriverKind.SPINDLE, factory, probe=probe)


def test_usb_ids_name_devices_and_decide_who_is_asked() -> None:
    drivers = _drivers()
    assert [d.name for d in drivers_of_usb_id(0x03EB, 0x2404, drivers)] == ["roboclaw"]
    assert [d.name for d in drivers_of_usb_id(0x0683, 0x2108, drivers)] == ["dataq"]
    assert drivers_of_usb_id(0x0403, 0x6001, drivers) == ()
    assert drivers_of_usb_id(None, None, drivers) == ()
    assert may_be_probed("/dev/ttyACM0", ())
    assert may_be_probed("COM3", [load_driver("roboclaw")])
    assert not may_be_probed("/dev/ttyUSB0", ()), "a motor controller may obey any byte"
    assert not may_be_probed("/dev/ttyS0", ())
    assert has_speed("/dev/ttyUSB0")
    assert has_speed("COM3")
    assert not has_speed("/dev/ttyACM0")
    assert not has_speed("socket://127.0.0.1:1")
    assert not has_speed("/dev/pts/3")


def test_heartbeats_are_heard_on_a_bus_without_a_word() -> None:
    with can.Bus(interface="virtual", channel="doctor") as bus:
        heard: dict[int, int] = {}
        listener = threading.Thread(
            target=lambda: heard.update(listen("virtual", "doctor", 1.0)), name="listener"
        )
        listener.start()
        deadline = time.monotonic() + 60.0
        while listener.is_alive() and time.monotonic() < deadline:
            for identifier, data in ((0x705, b"\x05"), (0x701, b"\x7f"), (0x181, b"\0\0")):
                bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False))
            time.sleep(0.02)
        listener.join(60.0)
        assert bus.recv(0.0) is None, "the listener is silent"
    assert heard == {5: 5, 1: 0x7F}
    assert node_words(heard) == "node 1 (pre-operational), node 5 (operational)"
    assert node_words({}) == "no heartbeat received"
