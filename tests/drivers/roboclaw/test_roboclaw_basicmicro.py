"""The maker's own client against our simulator, and its bytes against our driver's."""

from __future__ import annotations

import time
from collections.abc import Iterator
from typing import Any

import pytest
from basicmicro import Basicmicro

from rigapp_drivers.roboclaw.link import Link
from rigapp_drivers.roboclaw.protocol import Command
from rigapp_drivers.roboclaw.simulator import RoboClawSimulator
from rigapp_drivers.simulator_api import MotorState
from rigapp_drivers.transport import SerialPort

ADDRESS = 0x80


@pytest.fixture
def simulated() -> RoboClawSimulator:
    """Return a simulated drive whose motor nobody turns."""
    return RoboClawSimulator()


@pytest.fixture
def port(wire: Any, simulated: RoboClawSimulator) -> Any:
    """Return the wire of that drive."""
    return wire(simulated.receive, simulated.emit)


@pytest.fixture
def client(port: Any) -> Iterator[Any]:
    """Return the foreign client on it."""
    made = Basicmicro(port.port, 38400, timeout=0.5)
    assert made.Open()
    yield made
    made.close()


def test_the_client_writes_our_golden_bytes_and_is_answered(
    client: Any, port: Any, golden_write: dict[str, Any]
) -> None:
    method, *arguments = golden_write["call"]
    assert getattr(client, method)(ADDRESS, *arguments) is True
    assert bytes(port.received) == bytes.fromhex(golden_write["bytes"])


def test_the_client_accepts_our_replies(
    client: Any, simulated: RoboClawSimulator, golden_read: dict[str, Any]
) -> None:
    if "before" in golden_read:
        simulated.receive(bytes.fromhex(golden_read["before"]), time.monotonic())
    if "fault" in golden_read:
        simulated.inject(golden_read["fault"])
    fields = {"position_count": 0, "speed_count_per_s": 0.0, "current_A": 0.0}
    simulated.observe(MotorState(**fields))  # type: ignore[arg-type]
    simulated.observe(MotorState(**{**fields, **golden_read.get("state", {})}))
    reply = getattr(client, golden_read["call"])(ADDRESS)
    assert bool(reply[0])
    assert list(reply[1:]) == pytest.approx(golden_read["accepted"]) or (
        list(reply[1:]) == golden_read["accepted"]
    )


def test_the_client_reads_the_combined_status(client: Any, simulated: RoboClawSimulator) -> None:
    simulated.observe(MotorState(12345, 100.0, 1.25, supply_V=47.9, temperature_C=30.2))
    reply = client.GetStatus(ADDRESS)
    assert bool(reply[0])
    assert len(reply) == 21
    assert reply[2:7] == (0, 302, 302, 479, 121)
    assert (reply[9], reply[11], reply[15]) == (125, 12345, 100)


def test_the_client_reads_what_the_table_of_motor_2_promises(client: Any) -> None:
    for method in ("ReadEncM2", "ReadSpeedM2", "ReadISpeedM2", "ReadM2VelocityPID"):
        assert bool(getattr(client, method)(ADDRESS)[0])
    for method in ("ReadM2MaxCurrent", "ReadTemp2", "GetVolts", "GetTemps", "GetISpeeds"):
        assert bool(getattr(client, method)(ADDRESS)[0])
    assert client.SpeedAccelM2(ADDRESS, 100, -200)
    assert client.DutyM2(ADDRESS, 0)
    assert client.SpeedM2(ADDRESS, 0)
    assert client.SetEncM2(ADDRESS, 5)
    assert client.ReadEncM2(ADDRESS)[1] == 5


def test_our_bytes_are_the_clients_bytes(
    wire: Any, simulated: RoboClawSimulator, golden_write: dict[str, Any]
) -> None:
    theirs = wire(simulated.receive)
    ours = wire(RoboClawSimulator().receive)
    client = Basicmicro(theirs.port, 38400, timeout=0.5)
    assert client.Open()
    serial = SerialPort("drive", ours.port, 38400)
    serial.open()
    link = Link(serial, "drive", ours.port, ADDRESS, 38400, 0.4)
    method, *arguments = golden_write["call"]
    getattr(client, method)(ADDRESS, *arguments)
    link.write(golden_write["command"], *golden_write["values"])
    assert bytes(ours.received) == bytes(theirs.received)
    for command, read in ((Command.COUNT_M1, "ReadEncM1"), (Command.STATUS, "ReadError")):
        link.read(command)
        getattr(client, read)(ADDRESS)
    assert bytes(ours.received) == bytes(theirs.received)
    client.close()
    serial.close()


def test_the_client_sees_a_wrong_crc_as_a_failure(
    client: Any, simulated: RoboClawSimulator
) -> None:
    simulated.inject("wrong_crc")
    with pytest.raises(Exception, match="Timeout reading"):
        client.ReadError(ADDRESS)
