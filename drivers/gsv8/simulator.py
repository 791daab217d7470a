"""A GSV-8 at the byte level: requests and electrical signals in, responses and frames out.

It starts as the device does after its power comes: streaming, 8 objects, float32, 10 frames a
second. Both quadrature inputs see the same encoder.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drivers.api import RigSignals
from drivers.gsv8 import protocol as p
from drivers.gsv8.frames import FrameLayout, Response, encode_frames, encode_response
from drivers.gsv8.numbers import OVERRANGE, DataType
from drivers.gsv8.protocol import Command
from drivers.gsv8.simulated_channels import ChannelCommands
from drivers.gsv8.simulated_device import Device, Hardware, Refused, Table
from drivers.gsv8.simulated_faults import FaultKind
from drivers.gsv8.simulated_inputs import CODE_PER_RANGE, AnalogInputs, codes_of
from drivers.gsv8.simulated_lines import LineCommands
from drivers.gsv8.simulated_link import LinkCommands
from drivers.gsv8.simulated_memory import Settings
from drivers.gsv8.simulated_requests import RequestReader
from drivers.gsv8.simulated_stream import StreamCommands
from drivers.simulated_faults import Fault, FaultPlan

_OVERRUN = 0x91
_BROKEN_REQUEST = 0x42
_WRITE_ACCESS_ELSEWHERE = 0x75
_SATURATED, _SENSOR_BROKEN = 1, 3  # kinds of value errors


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
        self._rng = np.random.default_rng(seed)
        self._inputs = AnalogInputs(self._rng, noise, delays_s or {})
        self._table = _table(self._device)
        self._reader = RequestReader()
        self._delayed: list[tuple[float, bytes]] = []
        self._start_s: float | None = None
        self._codes = np.zeros((p.ANALOG_CHANNELS, 1), dtype=np.int64)
        self._counts = np.zeros((p.COUNTER_CHANNELS, 1), dtype=np.int64)
        self._pending: tuple[NDArray[Any], NDArray[np.bool_]] | None = None
        self._to_drop = 0
        self._terminals: dict[int, float] = {}
        self._converted_as = list(settings.input_types)

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
        self._device.state.asynchronous_error = _OVERRUN

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
        saturated = self._convert(signals, now_s, time_s)
        if not self._device.state.transmitting:
            self._pending = None
            return answers
        return answers + self._frames(saturated, time_s)

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
        self._convert_again()
        strike = self._plan.strike
        if strike(FaultKind.LOST_COMMAND, time_s, command) is not None:
            return b""
        refused = strike(FaultKind.REFUSED, time_s, command, _WRITE_ACCESS_ELSEWHERE)
        status = status if refused is None else int(refused)
        if command == Command.GET_VALUE and not (status or parameters):
            reply = b"" if self._device.state.transmitting else self._one_frame()
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

    def _one_frame(self) -> bytes:
        values = self._values(self._codes[:, -1:], self._counts[:, -1:])
        return encode_frames(values, self._layout(), self._over(self._codes[:, -1:])).tobytes()

    # --- measured values ------------------------------------------------------------------------

    def _convert(self, signals: RigSignals, now_s: float, time_s: float) -> NDArray[np.bool_]:
        """Advance inputs and counters by these samples; return where an input is saturated."""
        device, settings = self._device, self._device.settings
        active = self._plan.active
        samples = signals.shaft_revolutions.size
        inputs = self._inputs.normalised(
            signals.analog, samples, settings.input_types, settings.rate_Hz
        )
        saturated = active(FaultKind.SATURATED_INPUT, time_s, 1.0)
        stuck = active(FaultKind.STUCK_INPUT, time_s, 1.0)
        inputs = self._inputs.faulty(
            inputs,
            None if saturated is None else int(saturated),
            None if stuck is None else int(stuck),
        )
        broken = active(FaultKind.SENSOR_BROKEN, time_s, 1.0)
        if broken is not None:
            device.note_fault(_SENSOR_BROKEN, 3 << 2 * (int(broken) - 1), now_s)
        codes = codes_of(inputs)
        device.state.raw = codes[:, -1].tolist()
        self._terminals = {n: float(signal[-1]) for n, signal in signals.analog.items()}
        self._converted_as = list(settings.input_types)
        self._count(signals.shaft_revolutions, time_s)
        over = self._over(inputs * CODE_PER_RANGE)
        if over.any():
            self._note_saturation(inputs, now_s)
        self._codes = codes
        if device.state.injection == 1:
            self._codes = np.full_like(codes, p.HALF_SCALE_CODE)
            over[:] = False
        return over

    def _convert_again(self) -> None:
        """Convert the last signals anew when an input type was changed since they came."""
        kinds = self._device.settings.input_types
        if kinds == self._converted_as:
            return
        inputs = np.zeros((p.ANALOG_CHANNELS, 1))
        for channel, signal in self._terminals.items():
            inputs[channel - 1] = signal / p.NOMINAL_RANGE.get(kinds[channel - 1], np.inf)
        self._converted_as = list(kinds)
        codes = codes_of(inputs)
        self._device.state.raw = codes[:, 0].tolist()
        if self._device.state.injection != 1:
            self._codes = codes

    def _count(self, shaft: NDArray[np.float64], time_s: float) -> None:
        plan, settings = self._plan, self._device.settings
        slip = plan.take(FaultKind.COUNTER_SLIP, time_s, 1.0)
        false_index = plan.take(FaultKind.FALSE_INDEX, time_s) is not None
        stuck = plan.active(FaultKind.STUCK_COUNTER, time_s) is not None
        index = plan.active(FaultKind.MISSING_INDEX, time_s) is None
        rows = []
        for number, counter in enumerate(self._device.counters):
            mode = p.decode_counter_mode(settings.counter_modes[number])
            home = settings.counter_homes[number]
            if slip is not None:
                counter.slip(int(slip))
            if false_index and mode.use_index:
                counter.clear(mode, home)
            before = counter.last_count
            counts = counter.advance(shaft, mode, home, index=index)
            rows.append(np.full_like(counts, before) if stuck else counts)
            if stuck:
                counter.last_count = before
        self._counts = np.stack(rows)

    def _over(self, codes: NDArray[Any]) -> NDArray[np.bool_]:
        """Return where any channel of the frame is at the end of the converter's range."""
        used = codes[: max(1, self._device.settings.analog_objects)]
        limit = OVERRANGE * CODE_PER_RANGE - 1.0
        return np.asarray((np.abs(used) >= limit).any(axis=0))

    def _note_saturation(self, inputs: NDArray[np.float64], now_s: float) -> None:
        above = np.flatnonzero((inputs >= OVERRANGE).any(axis=1))
        below = np.flatnonzero((inputs <= -OVERRANGE).any(axis=1))
        flags = sum(1 << int(n) for n in above) | sum(1 << 8 + int(n) for n in below)
        self._device.note_fault(_SATURATED, flags, now_s)

    def _layout(self) -> FrameLayout:
        settings, state = self._device.settings, self._device.state
        fast = settings.rate_Hz >= p.HIGH_SPEED_FROM_HZ and state.high_speed
        return FrameLayout(
            objects=settings.objects,
            data_type=settings.data_type,
            checksum=state.data_checksum,
            high_speed=fast,
            offset_binary=self._device.hardware.offset_binary,
        )

    def _values(
        self, codes: NDArray[np.int64], counts: NDArray[np.int64]
    ) -> NDArray[np.float64] | NDArray[np.int64]:
        """Return the objects of the frame: analog channels first, counters last."""
        settings = self._device.settings
        analog = settings.analog_objects
        zeros = np.array(settings.zeros[:analog])[:, None]
        injected = self._device.state.injection == 1
        codes = codes[:analog] - (0 if injected else zeros)
        np.clip(codes, -(1 << 23), (1 << 23) - 1, out=codes)
        counts = counts[list(settings.counters)]
        if settings.data_type is DataType.FLOAT32:
            scales, offsets = (
                np.array(settings.scales)[:, None],
                np.array(settings.offsets)[:, None],
            )
            places = [p.ANALOG_CHANNELS + number for number in settings.counters]
            signal = codes * (1.0 / CODE_PER_RANGE) * scales[:analog] + offsets[:analog]
            angle = counts * 2.0**-23 * scales[places] + offsets[places]
            return np.concatenate((signal, angle))
        values = np.concatenate((codes, counts))
        return values >> 8 if settings.data_type is DataType.INT16 else values

    def _frames(self, saturated: NDArray[np.bool_], time_s: float) -> bytes:
        layout = self._layout()
        values: NDArray[Any] = self._values(self._codes, self._counts)
        extra = self._plan.active(FaultKind.WRONG_OBJECT_COUNT, time_s, 1.0)
        if extra is not None:
            more = np.zeros((int(extra), values.shape[1]), dtype=values.dtype)
            values = np.concatenate((values, more))
            layout = FrameLayout(len(values), layout.data_type, layout.checksum)
        sequences = layout.most_sequences
        if sequences > 1:
            values, saturated = self._whole_frames(values, saturated, sequences)
        return self._damaged(encode_frames(values, layout, saturated, sequences), time_s)

    def _whole_frames(
        self, values: NDArray[Any], saturated: NDArray[np.bool_], sequences: int
    ) -> tuple[NDArray[Any], NDArray[np.bool_]]:
        """Keep the samples that do not fill a frame for the next call."""
        if self._pending is not None and len(self._pending[0]) == len(values):
            values = np.concatenate((self._pending[0], values), axis=1)
            saturated = np.concatenate((self._pending[1], saturated))
        whole = values.shape[1] // sequences * sequences
        self._pending = (values[:, whole:], saturated[whole:])
        return values[:, :whole], saturated[:whole]

    def _damaged(self, frames: NDArray[np.uint8], time_s: float) -> bytes:
        """Return the bytes of frames with what faults do to them."""
        take = self._plan.take
        overrun = take(FaultKind.OVERRUN, time_s, 10.0)
        if overrun is not None:
            self._device.state.asynchronous_error = _OVERRUN
        self._to_drop += int(overrun or 0) + int(take(FaultKind.DROPPED_FRAMES, time_s, 1.0) or 0)
        if self._to_drop:
            dropped = min(self._to_drop, len(frames))
            self._to_drop -= dropped
            frames = frames[dropped:]
        if len(frames) == 0:
            return b""
        flipped = take(FaultKind.FLIPPED_BIT, time_s, 5.0)
        if flipped is not None:
            frames[0, int(flipped) % frames.shape[1]] ^= 0x10
        data = frames.tobytes()
        cut = take(FaultKind.CUT_FRAME, time_s, 11.0)
        if cut is not None:
            data = data[: int(cut)] + data[frames.shape[1] :]
        garbage = take(FaultKind.GARBAGE, time_s, 7.0)
        if garbage is not None:
            data = self._rng.bytes(max(1, int(garbage))) + data
        return data


def _table(device: Device) -> Table:
    link = LinkCommands(device)
    table = {
        **link.table(),
        **StreamCommands(device).table(),
        **ChannelCommands(device).table(),
        **LineCommands(device).table(),
    }
    link.know({**table, Command.GET_VALUE: table[Command.RESET_STATUS]})
    return table
