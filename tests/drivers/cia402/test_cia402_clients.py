"""Independent clients against the simulated drive: python-can's slcan, canopen, BaseNode402."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from functools import partial
from importlib.resources import files
from typing import Any

import can
import canopen
import pytest
from canopen.profiles import p402

from rigapp_drivers.cia402.simulator import Cia402Simulator

NODE = 5
EDS = str(files("rigapp_drivers.cia402") / "objects.eds")


@pytest.fixture
def options() -> dict[str, Any]:
    """Return the simulator's options; a test may overrule them by parametrisation."""
    return {"node_id": NODE}


@pytest.fixture
def rig(drive_rig: Any, options: dict[str, Any]) -> Any:
    """Return a simulated drive with a motor on a pty."""
    return drive_rig(**options)


@pytest.fixture
def bus(rig: Any) -> Iterator[Any]:
    """Return python-can's slcan bus on it."""
    made = can.Bus(interface="slcan", channel=rig.port, bitrate=500_000, sleep_after_open=0.0)
    yield made
    made.shutdown()


@pytest.fixture
def network(bus: Any) -> Iterator[Any]:
    """Return canopen's network on that bus."""
    made = canopen.Network(bus=bus)
    made.NOTIFIER_CYCLE = 0.02
    made.connect()
    yield made
    for node in made.nodes.values():
        node.pdo.stop()
    made.notifier.stop()


@pytest.fixture
def node(network: Any) -> Any:
    """Return canopen's remote node with our object dictionary."""
    made = network.add_node(NODE, EDS)
    made.sdo.RESPONSE_TIMEOUT = 60.0
    return made


def test_python_can_exchanges_raw_frames(bus: Any) -> None:
    bus.send(
        can.Message(
            arbitration_id=0x605, data=bytes.fromhex("4000100000000000"), is_extended_id=False
        )
    )
    reply = bus.recv(60.0)
    assert reply is not None
    assert reply.arbitration_id == 0x585
    assert reply.data.hex() == "4300100092010200"


def test_the_eds_agrees_with_the_simulated_drive() -> None:
    objects = Cia402Simulator(node_id=NODE).node.objects
    dictionary = canopen.import_od(EDS, NODE)
    known = {
        (index, variable.subindex if hasattr(entry, "values") else 0): variable
        for index, entry in dictionary.items()
        for variable in (entry.values() if hasattr(entry, "values") else [entry])
    }
    assert set(known) == set(objects.entries)
    for (index, subindex), entry in objects.entries.items():
        variable = known[index, subindex]
        where = f"{index:04X}:{subindex}"
        if entry.kind == "text":
            assert variable.data_type == canopen.objectdictionary.VISIBLE_STRING, where
            continue
        assert len(variable) == 8 * entry.length, where
        assert variable.writable == (entry.access == "rw"), where
        assert variable.pdo_mappable == entry.mappable, where
        if index in range(0x1400, 0x1404) or index in range(0x1800, 0x1804):
            assert variable.default == entry.value, where


def test_canopen_sends_the_golden_requests(
    node: Any, rig: Any, client_transfer: dict[str, Any]
) -> None:
    request = bytes.fromhex(client_transfer["request"][4:])
    index, subindex = int.from_bytes(request[1:3], "little"), request[3]
    if request[0] == 0x40:
        transfer = partial(node.sdo.upload, index, subindex)
    else:
        data = request[4 : 8 - (request[0] >> 2 & 3)]
        transfer = partial(node.sdo.download, index, subindex, data)
    if client_transfer["reply"].startswith("585 80"):
        with pytest.raises(canopen.SdoAbortedError):
            transfer()
    else:
        transfer()
    line = b"\rt6058" + request.hex().upper().encode() + b"\r"
    assert bytes(rig.wire.received).endswith(line)


def test_our_driver_sends_the_golden_requests(rig: Any, connect: Any) -> None:
    # The drive's own supervision may fire on a busy host: only the bytes are looked at.
    drive = connect(rig, node_id=NODE, watchdog_s=0.3, heartbeat_ms=100)
    drive.set_speed(10.0, 1000.0)
    drive.status()
    drive.drive_off()
    sent = bytes(rig.wire.received)
    for line in (
        b"t60582B17100064000000",  # producer heartbeat 100 ms
        b"t6058231610012C017F00",  # consumer heartbeat, node 127, 300 ms
        b"t60582F60600003000000",  # mode 3
        b"t605823FF600058020000",  # target velocity 600
        b"t00020105",  # NMT start
        b"t77F105",  # heartbeat of the host
        b"t0800",  # SYNC
        b"t20520000",  # disable voltage by RPDO1
    ):
        assert line + b"\r" in sent, line


def test_canopen_transfers_by_sdo(node: Any) -> None:
    assert node.sdo[0x1000].raw == 0x0002_0192
    assert node.sdo[0x1008].raw == "Simulated CiA 402 drive"
    assert node.sdo[0x1018][1].raw == 0xFB
    node.sdo[0x6084].raw = 4321
    assert node.sdo[0x6084].raw == 4321
    node.sdo[0x60FF].raw = -600
    assert node.sdo[0x60FF].raw == -600
    node.sdo[0x6060].raw = 3
    assert node.sdo[0x6061].raw == 3
    with pytest.raises(canopen.SdoAbortedError) as refused:
        node.sdo[0x6041].raw = 1
    assert refused.value.code == 0x0601_0002
    with pytest.raises(canopen.SdoAbortedError) as missing:
        node.sdo.upload(0x4321, 0)
    assert missing.value.code == 0x0602_0000


def test_canopen_sees_nmt_states_heartbeats_and_the_boot_up(
    node: Any, rig: Any, wait_until: Any
) -> None:
    heard: list[int] = []
    node.nmt.add_heartbeat_callback(heard.append)
    node.sdo[0x1017].raw = 20
    for state, code in (("PRE-OPERATIONAL", 0x7F), ("OPERATIONAL", 0x05), ("STOPPED", 0x04)):
        node.nmt.state = state
        wait_until(lambda code=code: heard[-1:] == [code], f"a heartbeat of {state}")
        assert node.nmt.state == state
    node.nmt.send_command(0x81)
    wait_until(lambda: 0 in heard, "the boot-up message")
    assert node.sdo[0x1017].raw == 0


def test_canopen_sees_emergencies(node: Any, rig: Any, wait_until: Any) -> None:
    rig.simulator.inject("emergency", value=0x3210)
    wait_until(lambda: node.emcy.active != [], "the emergency message")
    assert node.emcy.active[-1].code == 0x3210
    assert node.emcy.active[-1].register == 0x04


def test_canopen_maps_and_receives_pdos(node: Any, rig: Any, wait_until: Any) -> None:
    node.tpdo.read()
    velocity = node.tpdo[4]
    assert [f"{v.index:04X}" for v in velocity] == ["6041", "606C"]
    velocity.clear()
    velocity.add_variable(0x606C)
    velocity.add_variable(0x6061)
    velocity.trans_type = 1
    velocity.enabled = True
    velocity.save()
    node.sdo[0x6060].raw = 3
    arrived = threading.Event()
    velocity.add_callback(lambda _: arrived.set())
    node.nmt.state = "OPERATIONAL"
    node.network.sync.transmit()
    wait_until(arrived.is_set, "the TPDO after the SYNC")
    assert velocity[0x606C].raw == 0
    assert velocity[0x6061].raw == 3


def test_canopen_drives_by_rpdo(node: Any, rig: Any, wait_until: Any) -> None:
    node.rpdo.read()
    node.sdo[0x6060].raw = 3
    node.nmt.state = "OPERATIONAL"
    target = node.rpdo[4]
    target.enabled = True
    target.save()
    node.sdo[0x6083].raw = 60000
    for control in (0x06, 0x07, 0x0F):
        target[0x6040].raw = control
        target[0x60FF].raw = 600
        target.transmit()
    wait_until(lambda: rig.speed_rpm == 600, "the speed")
    assert node.sdo[0x606C].raw == 600


@pytest.fixture
def periodic(drive_rig: Any) -> Any:
    """Return a simulated drive that sends TPDO1 every 50 ms, as BaseNode402 needs it."""
    return drive_rig(node_id=NODE, tpdo1_period_s=0.05)


@pytest.fixture
def node402(periodic: Any) -> Iterator[Any]:
    """Return canopen's CiA 402 node, set up."""
    bus = can.Bus(interface="slcan", channel=periodic.port, bitrate=500_000, sleep_after_open=0.0)
    network = canopen.Network(bus=bus)
    network.NOTIFIER_CYCLE = 0.02
    network.connect()
    made = p402.BaseNode402(NODE, EDS)
    made.TIMEOUT_CHECK_TPDO = 30.0
    made.TIMEOUT_SWITCH_STATE_SINGLE = 60.0
    made.TIMEOUT_SWITCH_STATE_FINAL = 60.0
    network.add_node(made)
    made.sdo.RESPONSE_TIMEOUT = 60.0
    made.sdo[0x1017].raw = 50
    made.nmt.wait_for_heartbeat(60.0)
    made.setup_402_state_machine()
    made.nmt.state = "OPERATIONAL"
    yield made
    made.pdo.stop()
    network.notifier.stop()
    bus.shutdown()


def test_the_402_client_walks_through_the_state_machine(
    node402: Any, periodic: Any, wait_until: Any
) -> None:
    wait_until(lambda: node402.state == "SWITCH ON DISABLED", "the first TPDO1")
    node402.op_mode = "PROFILED VELOCITY"
    assert node402.op_mode == "PROFILED VELOCITY"
    for wanted in ("READY TO SWITCH ON", "SWITCHED ON", "OPERATION ENABLED"):
        node402.state = wanted
        assert node402.state == wanted
    node402.sdo[0x6083].raw = 60000
    node402.sdo[0x60FF].raw = 300
    wait_until(lambda: periodic.speed_rpm == 300, "the speed")
    node402.state = "QUICK STOP ACTIVE"
    wait_until(lambda: periodic.speed_rpm == 0, "the quick stop")
    node402.state = "SWITCH ON DISABLED"
    assert node402.state == "SWITCH ON DISABLED"


def test_the_402_client_resets_a_fault(node402: Any, periodic: Any, wait_until: Any) -> None:
    node402.op_mode = "PROFILED VELOCITY"
    node402.state = "OPERATION ENABLED"
    periodic.simulator.inject("emergency", value=0x2310)
    wait_until(lambda: node402.state == "FAULT", "the fault")
    node402.reset_from_fault()
    assert node402.state == "OPERATION ENABLED"
