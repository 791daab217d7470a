"""A GSV-8 at the byte level: requests and electrical signals in, responses and frames out.

It starts as the device does after its power comes: streaming, 8 objects, float32, 10 frames a
second. Both quadrature inputs see the same encoder.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from drivers.api import RigSignals
from drivers.gsv8.frames import Response, encode_response
from drivers.gsv8.protocol import Command
from drivers.gsv8.simulated_channels import ChannelCommands
from drivers.gsv8.simulated_device import Device, Entry, Hardware, Refused, Table
from drivers.gsv8.simulated_faults import FaultKind
from drivers.gsv8.simulated_lines import LineCommands
from drivers.gsv8.simulated_link import LinkCommands
from drivers.gsv8.simulated_memory import Settings
from drivers.gsv8.simulated_requests import RequestReader
from drivers.gsv8.simulated_stream import StreamCommands
from drivers.gsv8.simulated_values import OVERRUN, MeasuredValues
from drivers.simulated_faults import Fault, FaultPlan

_BROKEN_REQUEST = 0x42
_WRITE_ACCESS_ELSEWHERE = 0x75


class Gsv8Simulator:
    """Answer and stream as a GSV-8 does; implements ``drivers.api.SimulatedDataSource``.

    encoder_lines: lines of the encoder; counts_per_revolution, when given, are its edges (4 a
    line). firmware: text such as "1.56". usb: else a UART at uart_baud_rate. counter_present: with
    quadrature inputs. offset_binary: integers as the GSV-8 sends them. zero_prohibited: bit n
    refuses to zero channel n+1. noise: the device's own noise. delays_s: delay of the analog
    filter by channel number, for all by 0. counter_scale: user scale of the counters from the
    factory; 8388608 makes the float equal to counts. faults: ``Fault`` records or tables of their
    fields, see ``FaultKind``.
    """

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
        noise: bool = False,
        delays_s: Mapping[int, float] | None = None,
        counter_scale: float = 8388608.0,
        faults: Iterable[Fault[FaultKind] | Mapping[str, Any]] = (),
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
        settings = Settings(counter_scale=counter_scale, uart_baud_rate=uart_baud_rate)
        self._device = Device(hardware, settings, counts_per_revolution or 4 * encoder_lines)
        self._plan = FaultPlan(FaultKind, faults)
        rng = np.random.default_rng(seed)
        self._measured = MeasuredValues(self._device, self._plan, rng, noise, delays_s or {})
        self._table = _table(self._device)
        self._reader = RequestReader()
        self._delayed: list[tuple[float, bytes]] = []
        self._start_s: float | None = None

    # --- what the rig sees ----------------------------------------------------------------------

    @property
    def sample_rate_Hz(self) -> float:
        """Return the configured sample rate."""
        return self._device.settings.rate_Hz

    @property
    def streaming(self) -> bool:
        """Tell whether measured values are being sent."""
        return self._device.state.transmitting

    @property
    def eeprom_writes(self) -> int:
        """Return how often a stored setting was written."""
        return self._device.writes

    @property
    def settings(self) -> Settings:
        """Return the settings as they stand in the device."""
        return self._device.settings

    def inject(self, kind: FaultKind | str, **data: Any) -> None:
        """Add a fault while the simulation runs; data as in ``Fault``."""
        self._plan.add(kind, **data)

    def clear(self, kind: FaultKind | str) -> None:
        """Forget all faults of a kind."""
        self._plan.clear(kind)

    def overrun(self, now_s: float) -> None:
        """Take note that the link dropped old frames because the host did not read."""
        self._device.state.asynchronous_error = OVERRUN

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Take bytes from the host and return the replies that they cause."""
        time_s = self._time(now_s)
        requests = self._reader.take(data, now_s)
        if self._reader.broken:
            self._reader.broken = False
            self._device.state.asynchronous_error = _BROKEN_REQUEST
        replies = [self._answer(*request, now_s, time_s) for request in requests]
        return self._due(now_s) + b"".join(replies)

    def sample(self, signals: RigSignals, now_s: float) -> bytes:
        """Return the bytes that these samples cause on the wire (b"" when not streaming)."""
        time_s = self._time(now_s)
        answers = self._due(now_s)
        if signals.shaft_revolutions.size == 0:
            return answers
        saturated = self._measured.convert(signals, now_s, time_s)
        if not self._device.state.transmitting:
            self._measured.forget_part()
            return answers
        return answers + self._measured.frames(saturated, time_s)

    # --- the time of the wire -------------------------------------------------------------------

    def _time(self, now_s: float) -> float:
        if self._start_s is None:
            self._start_s = now_s
        time_s = now_s - self._start_s
        if self._plan.take(FaultKind.RESET, time_s) is not None:
            self._device.power_on()
            self._reader = RequestReader()
            self._delayed.clear()
        elsewhere = self._plan.active(FaultKind.WRITE_ACCESS_ELSEWHERE, time_s) is not None
        self._device.write_access = not elsewhere
        return time_s

    def _due(self, now_s: float) -> bytes:
        if not self._delayed:
            return b""
        due = b"".join(reply for when, reply in self._delayed if when <= now_s)
        self._delayed = [(when, reply) for when, reply in self._delayed if when > now_s]
        return due

    # --- replies --------------------------------------------------------------------------------

    def _answer(
        self,
        command: int,
        parameters: bytes,
        status: int,
        checksum: bool,
        now_s: float,
        time_s: float,
    ) -> bytes:
        self._measured.convert_again()
        strike = self._plan.strike
        if strike(FaultKind.LOST_COMMAND, time_s, command) is not None:
            return b""
        refused = strike(FaultKind.REFUSED, time_s, command, _WRITE_ACCESS_ELSEWHERE)
        status = status if refused is None else int(refused)
        if command == Command.GET_VALUE and not (status or parameters):
            reply = b"" if self._device.state.transmitting else self._measured.one_frame()
        else:
            response = self._response(command, parameters, status)
            reply = encode_response(response, checksum=checksum)
        if strike(FaultKind.NO_REPLY, time_s, command) is not None:
            return b""
        delay_s = strike(FaultKind.SLOW_REPLY, time_s, command, 0.3)
        if delay_s is not None:
            self._delayed.append((now_s + delay_s, reply))
            return b""
        return reply

    def _response(self, command: int, parameters: bytes, status: int) -> Response:
        data = b""
        try:
            if status:
                raise Refused(status)
            data = self._obey(command, parameters)
        except Refused as refusal:
            status = refusal.status
            self._device.state.synchronous_error = status
        return Response(status, data)

    def _obey(self, command: int, parameters: bytes) -> bytes:
        entry = self._table.get(command)
        if entry is None:
            raise Refused(0x40)
        if len(parameters) not in entry.lengths:
            raise Refused(0x5B)
        if entry.writes and not self._device.write_access:
            raise Refused(_WRITE_ACCESS_ELSEWHERE)
        data = entry.handler(parameters)
        self._device.writes += entry.writes
        return data


def _table(device: Device) -> Table:
    link = LinkCommands(device)
    table = {
        **link.table(),
        **StreamCommands(device).table(),
        **ChannelCommands(device).table(),
        **LineCommands(device).table(),
        # Answered by a measured value, not by this.
        Command.GET_VALUE: Entry((0,), lambda a: b""),
    }
    link.know(table)
    return table
