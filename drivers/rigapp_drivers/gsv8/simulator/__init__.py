"""The GSV-8 at the byte level: requests and electrical signals in, responses and frames out.

Loaded by the simulated rig and by tests; no driver at run time imports it.

It starts as the device does after power-on: streaming, 8 objects, float32, 10 frames per second.
Both quadrature inputs are connected to the same encoder.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rigapp_drivers.gsv8.frames import PREFIX, SUFFIX, Response, encode_response
from rigapp_drivers.gsv8.protocol import Command, crc8
from rigapp_drivers.gsv8.simulator.commands import WRITE_ACCESS_ELSEWHERE, RequestRefused, obey
from rigapp_drivers.gsv8.simulator.state import Device, Gsv8Fault, Hardware, Memory
from rigapp_drivers.gsv8.simulator.values import OVERRUN, MeasuredValues
from rigapp_drivers.simulated import FaultPlan, Faults
from rigapp_drivers.simulator_api import RigSignals

_PARAMETER_TIMEOUT_S = 0.2
_TOO_LATE, _WRONG_CHECKSUM = 0x5A, 0x43


class RequestRead(NamedTuple):
    """A request with the status of its response (0: execute it)."""

    command: int
    parameters: bytes
    status: int
    checksum: bool


class RequestReader:
    """Collect bytes until a request is complete.

    ``broken`` is set after bytes that violate the frame rules; the device ignores them silently.
    """

    def __init__(self) -> None:
        self.broken = False
        self._buffer = b""
        self._begun_s = 0.0

    def take(self, data: bytes, now_s: float) -> list[RequestRead]:
        """Return the requests completed by these bytes."""
        requests: list[RequestRead] = []
        late = self._too_late(now_s)
        if late is not None:
            requests.append(late)
        if not self._buffer:
            self._begun_s = now_s
        self._buffer += data
        while self._buffer:
            if not self._seems_a_request():
                self.broken = True
                self._buffer = self._buffer[1:]
                continue
            length = self._length()
            if length is None or len(self._buffer) < length:
                break
            request = _decode(self._buffer[:length])
            if request is None:
                self.broken = True
                self._buffer = self._buffer[1:]
                continue
            requests.append(request)
            self._buffer = self._buffer[length:]
            self._begun_s = now_s
        return requests

    def _seems_a_request(self) -> bool:
        if self._buffer[0] != PREFIX:
            return False
        return len(self._buffer) < 2 or self._buffer[1] & 0xF0 in (0x90, 0xB0)

    def _length(self) -> int | None:
        if len(self._buffer) < 2:
            return None
        head = self._buffer[1]
        return 4 + (head & 0x0F) + (1 if head & 0x20 else 0)

    def _too_late(self, now_s: float) -> RequestRead | None:
        """Discard a request whose parameters did not arrive in time."""
        if not self._buffer or now_s - self._begun_s <= _PARAMETER_TIMEOUT_S:
            return None
        begun, self._buffer = self._buffer, b""
        if len(begun) < 3:
            self.broken = True
            return None
        return RequestRead(begun[2], b"", _TOO_LATE, bool(begun[1] & 0x20))


def _decode(frame: bytes) -> RequestRead | None:
    if frame[-1] != SUFFIX:
        return None
    count, checksum = frame[1] & 0x0F, bool(frame[1] & 0x20)
    wrong = checksum and crc8(frame[1:-2]) != frame[-2]
    status = _WRONG_CHECKSUM if wrong else 0
    return RequestRead(frame[2], frame[3 : 3 + count], status, checksum)


_BROKEN_REQUEST = 0x42


class Gsv8Simulator:
    """Respond and stream as a GSV-8 does; implements ``SimulatedDataSource``.

    encoder_lines: lines of the encoder; counts_per_revolution, if given: its edges (4 per line).
    firmware: text such as "1.56". usb: else a UART at uart_baud_rate. counter_present: with
    quadrature inputs. offset_binary: integers as the GSV-8 sends them. zero_prohibited: bit n
    prohibits zeroing channel n+1. counter_scale: factory user scale of the counters; 8388608 makes
    the float equal to counts. seed: of the garbage of faults. faults: ``Fault`` records or tables
    of their fields, see ``Gsv8Fault``.
    """

    kinds = Gsv8Fault

    def __init__(
        self,
        seed: int = 0,
        encoder_lines: int = 900,
        *,
        counts_per_revolution: int = 0,
        firmware: str = "1.56",
        serial_number: int = 20123456,
        usb: bool = True,
        uart_baud_rate: int = 115200,
        counter_present: bool = True,
        offset_binary: bool = True,
        zero_prohibited: int = 0,
        counter_scale: float = 8388608.0,
        faults: Faults = (),
    ) -> None:
        major, _, minor = firmware.partition(".")
        hardware = Hardware(
            firmware=(int(major), int(minor)),
            serial_number=serial_number,
            usb=usb,
            counter_present=counter_present,
            offset_binary=offset_binary,
            zero_prohibited=zero_prohibited,
        )
        settings = Memory(counter_scale=counter_scale, uart_baud_rate=uart_baud_rate)
        self._device = Device(hardware, settings, counts_per_revolution or 4 * encoder_lines)
        self._plan = FaultPlan(Gsv8Fault, faults)
        self.inject, self.clear = self._plan.add, self._plan.clear
        self._measured = MeasuredValues(self._device, self._plan, np.random.default_rng(seed))
        self._reader = RequestReader()

    # --- interface to the rig -------------------------------------------------------------------

    @property
    def sample_rate_Hz(self) -> float:
        """Return the configured sample rate."""
        return self._device.settings.rate_Hz

    @property
    def streaming(self) -> bool:
        """Return whether measured values are being sent."""
        return self._device.state.transmitting

    @property
    def eeprom_writes(self) -> int:
        """Return the number of writes of stored settings."""
        return self._device.writes

    @property
    def settings(self) -> Memory:
        """Return the present settings of the device."""
        return self._device.settings

    def overrun(self, now_s: float) -> None:
        """Record that the link dropped old frames because the host did not read."""
        self._device.state.asynchronous_error = OVERRUN

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process bytes from the host and return the replies."""
        self._tick(now_s)
        requests = self._reader.take(data, now_s)
        if self._reader.broken:
            self._reader.broken = False
            self._device.state.asynchronous_error = _BROKEN_REQUEST
        replies = [self._answer(request) for request in requests]
        return self._plan.due() + b"".join(replies)

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        """Return the bytes sent for these samples (b"" when not streaming)."""
        self._tick(now_s)
        answers = self._plan.due()
        if signals.shaft_revolutions.size == 0:
            return answers
        saturated = self._measured.convert(signals, now_s)
        if not self._device.state.transmitting:
            self._measured.forget_part()
            return answers
        return answers + self._measured.frames(saturated)

    def _tick(self, now_s: float) -> None:
        self._plan.tick(now_s)
        if self._plan.take(Gsv8Fault.RESET) is not None:
            self._device.power_on()
            self._reader = RequestReader()
            self._plan.forget_late()
        self._device.write_access = not self._plan.on(Gsv8Fault.WRITE_ACCESS_ELSEWHERE)

    # --- replies --------------------------------------------------------------------------------

    def _answer(self, requested: RequestRead) -> bytes:
        self._measured.convert_again()
        command, link_fault = requested.command, self._plan.link_fault
        if link_fault(Gsv8Fault.LOST_COMMAND, command) is not None:
            return b""
        refused = link_fault(Gsv8Fault.REFUSED, command, WRITE_ACCESS_ELSEWHERE)
        status = requested.status if refused is None else int(refused)
        if command == Command.GET_VALUE and not (status or requested.parameters):
            reply = b"" if self._device.state.transmitting else self._measured.one_frame()
        else:
            response = self._response(command, requested.parameters, status)
            reply = encode_response(response, checksum=requested.checksum)
        if link_fault(Gsv8Fault.NO_REPLY, command) is not None:
            return b""
        return self._plan.in_time(reply, Gsv8Fault.SLOW_REPLY, command, 0.3)

    def _response(self, command: int, parameters: bytes, status: int) -> Response:
        try:
            if status:
                raise RequestRefused(status)
            return Response(0, obey(self._device, command, parameters))
        except RequestRefused as refusal:
            self._device.state.synchronous_error = refusal.status
            return Response(refusal.status)


__all__ = ["Gsv8Fault", "Gsv8Simulator"]
