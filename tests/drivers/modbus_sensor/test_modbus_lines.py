"""RS-485 as it is: shared lines, noise, echo, busy devices, and Modbus over TCP."""

from __future__ import annotations

import asyncio
import struct
import threading
import time
from collections.abc import Iterator
from typing import Any, Final

import pytest
from pymodbus import datastore, server

from rigapp_drivers.api import (
    ConnectionFailed,
    DeviceError,
    DeviceFault,
    DeviceLost,
    ReplyTimeout,
    SettingRefused,
    SlowRequest,
)
from rigapp_drivers.modbus_sensor.driver import ModbusSensor
from rigapp_drivers.modbus_sensor.registers import OWN
from rigapp_drivers.modbus_sensor.simulator import crc16

VALUES: Final = {1: 215, 2: 480, 17: 1013}
"""What the devices on the line tell by their address."""


def framed(body: bytes) -> bytes:
    """Return bytes with their checksum, low byte first."""
    return body + crc16(body).to_bytes(2, "little")


class Rs485:
    """Several devices on one line, from the specification; before: what precedes each answer."""

    def __init__(self, *, before: bytes = b"", echo: bool = False, busy: int = 0) -> None:
        self.asked: list[int] = []
        self.before, self.echo, self.busy = before, echo, busy
        self.delay_s: dict[int, float] = {}
        self._due: list[tuple[float, bytes]] = []

    def respond(self, data: bytes, now_s: float) -> bytes:
        """Answer a question, if it is for one of them."""
        device, function = data[0], data[1]
        self.asked.append(device)
        echo = data if self.echo else b""
        if device not in VALUES:
            return echo
        answer = framed(struct.pack(">BBBH", device, function, 2, VALUES[device]))
        if self.busy:
            self.busy -= 1
            answer = framed(bytes((device, function | 0x80, 6)))
        if device in self.delay_s:
            self._due.append((time.monotonic() + self.delay_s[device], answer))
            return echo
        return echo + self.before + answer

    def produce(self, now_s: float) -> bytes:
        """Give what is due."""
        due = [answer for at_s, answer in self._due if at_s <= time.monotonic()]
        self._due = [one for one in self._due if one[0] > time.monotonic()]
        return b"".join(due)


def sensor(name: str, port: str, address: int, **settings: Any) -> ModbusSensor:
    """Return a driver that reads one register of a device."""
    registers = [{"quantity": "x_V", "address": 10, "type": "u16"}]
    return ModbusSensor(
        name, port, {"preset": OWN, "registers": registers, "address": address, **settings}
    )


@pytest.mark.parametrize(
    "line",
    [
        {"before": b"\x00"},
        {"before": b"\xff\x01\x04"},
        {"echo": True},
        {"echo": True, "before": b"\x80"},
        {"busy": 3},
    ],
    ids=str,
)
def test_noise_echo_and_a_busy_device_cost_no_value(wire: Any, line: dict[str, Any]) -> None:
    device = sensor("oil", wire(Rs485(**line).respond).port, 1)
    try:
        device.open()
        assert device.read() == {"x_V": 215.0}
        assert device.counters()["retries"] == 0
    finally:
        device.close()


def test_a_device_that_stays_busy_and_one_that_is_only_echoed_are_named(wire: Any) -> None:
    busy = sensor("oil", wire(Rs485(busy=10_000).respond).port, 1)
    with pytest.raises(DeviceError, match="server device busy"):
        busy.open()
    absent = sensor("oil", wire(Rs485(echo=True).respond).port, 99, reply_timeout_s=0.05)
    with pytest.raises(DeviceError, match="check power, wires A and B, address"):
        absent.open()


def test_devices_share_a_line_in_turn_and_outlive_each_other(wire: Any, wait_until: Any) -> None:
    line = Rs485()
    port = wire(line.respond, line.produce).port
    devices = [sensor(f"s{address}", port, address) for address in VALUES]
    wrong: list[Any] = []

    def ask(device: ModbusSensor, value: int) -> None:
        for _ in range(20):
            try:
                if device.read() != {"x_V": float(value)}:
                    wrong.append(value)
            except DeviceError as error:
                wrong.append(error)

    try:
        for device in devices:
            device.open()
        asking = [
            threading.Thread(target=ask, args=pair)
            for pair in zip(devices, VALUES.values(), strict=True)
        ]
        for one in asking:
            one.start()
        for one in asking:
            one.join()
        assert not wrong
        assert {address: line.asked.count(address) for address in VALUES} == dict.fromkeys(
            VALUES, 21
        )
        twin = sensor("twin", port, 2)
        with pytest.raises(ConnectionFailed, match=r"address 2 on this port is in use .* s2; give"):
            twin.open()
        twin.close()
        devices[0].close()
        assert devices[1].read() == {"x_V": 480.0}
        other = sensor("fast", port, 1, baud_rate=19200)
        with pytest.raises(SettingRefused, match="shares this port with s2; give both the same"):
            other.open()
    finally:
        for device in devices:
            device.close()


def test_the_late_answer_of_one_is_not_taken_by_another_on_the_line(wire: Any) -> None:
    line = Rs485()
    port = wire(line.respond, line.produce).port
    oil, air = sensor("oil", port, 1, reply_timeout_s=0.1), sensor("air", port, 2)
    try:
        oil.open()
        air.open()
        oil.configure(SlowRequest(("x_V",), timeout_s=0.15))
        line.delay_s[1] = 0.3
        with pytest.raises(ReplyTimeout):
            oil.read()
        line.delay_s.clear()
        assert air.read() == {"x_V": 480.0}
        oil.configure(SlowRequest(("x_V",), timeout_s=5.0))
        assert oil.read() == {"x_V": 215.0}
    finally:
        oil.close()
        air.close()


def test_a_line_that_breaks_is_opened_anew_by_each(wire: Any) -> None:
    line = wire(Rs485().respond, tcp=True)
    devices = [sensor(f"s{address}", line.port, address) for address in (1, 2)]
    for device in devices:
        device.open()
    line.unplug()
    for device in devices:
        with pytest.raises(DeviceLost) as lost:
            device.read()
        assert lost.value.device == device.name
        device.close()


@pytest.fixture
def foreign() -> Iterator[tuple[int, Any]]:
    """Start pymodbus's own TCP server with two devices; yield its port and its context."""
    block = datastore.ModbusSequentialDataBlock
    devices = {
        address: datastore.ModbusDeviceContext(ir=block(1, [VALUES[address]] * 64))
        for address in (1, 2)
    }
    context = datastore.ModbusServerContext(devices=devices, single=False)
    loop = asyncio.new_event_loop()
    started = threading.Event()
    made: list[Any] = []

    async def serve() -> None:
        made.append(server.ModbusTcpServer(context, address=("127.0.0.1", 0)))
        await made[0].listen()
        started.set()

    def run() -> None:
        asyncio.set_event_loop(loop)
        loop.run_until_complete(serve())
        loop.run_forever()

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    assert started.wait(60.0)
    yield made[0].transport.sockets[0].getsockname()[1], made[0]
    asyncio.run_coroutine_threadsafe(made[0].shutdown(), loop).result(60.0)
    loop.call_soon_threadsafe(loop.stop)
    thread.join(60.0)
    loop.close()


def test_a_foreign_tcp_server_with_several_devices_is_read(foreign: tuple[int, Any]) -> None:
    port = f"tcp:127.0.0.1:{foreign[0]}"
    devices = [sensor(f"s{address}", port, address) for address in (1, 2)]
    absent = sensor("s9", port, 9, reply_timeout_s=0.2)
    try:
        for device, address in zip(devices, (1, 2), strict=True):
            device.open()
            assert device.read() == {"x_V": float(VALUES[address])}
        with pytest.raises(DeviceError):
            absent.open()
        assert devices[0].read() == {"x_V": 215.0}
    finally:
        for device in (*devices, absent):
            device.close()


def test_a_late_answer_over_tcp_is_known_by_its_transaction(wire: Any) -> None:
    late = [0.0]
    due: list[tuple[float, bytes]] = []

    def respond(data: bytes, now_s: float) -> bytes:
        transaction, device, function = data[:2], data[6], data[7]
        body = struct.pack(">BBBH", device, function, 2, VALUES[device])
        answer = transaction + struct.pack(">HH", 0, len(body)) + body
        due.append((time.monotonic() + late[0], answer))
        return b""

    def produce(now_s: float) -> bytes:
        ready = [one for one in due if one[0] <= time.monotonic()]
        due[:] = [one for one in due if one not in ready]
        return b"".join(answer for _, answer in ready)

    line = wire(respond, produce, tcp=True)
    port = line.port.replace("socket://", "tcp:")
    device = sensor("oil", port, 1, reply_timeout_s=0.1)
    try:
        device.open()
        device.configure(SlowRequest(("x_V",), timeout_s=0.15))
        late[0] = 0.3
        with pytest.raises(ReplyTimeout):
            device.read()
        late[0] = 0.0
        VALUES[1] = 999
        device.configure(SlowRequest(("x_V",), timeout_s=5.0))
        assert device.read() == {"x_V": 999.0}
    finally:
        VALUES[1] = 215
        device.close()


def test_an_exception_other_than_busy_is_a_fault_at_once(foreign: tuple[int, Any]) -> None:
    device = sensor("oil", f"tcp:127.0.0.1:{foreign[0]}", 1)
    device.open()
    try:
        with pytest.raises(DeviceFault, match="illegal data address"):
            device._link.read(4, 5000, 1, time.monotonic() + 60.0)
    finally:
        device.close()
