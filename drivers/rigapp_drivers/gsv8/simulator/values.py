"""Measured values of a simulated GSV-8: electrical signals and shaft angle in, frames out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8.frames import FrameLayout, encode_frames
from rigapp_drivers.gsv8.numbers import OVERRANGE, DataType
from rigapp_drivers.gsv8.protocol import NOMINAL_RANGE, InputType
from rigapp_drivers.gsv8.simulator.state import Device, Gsv8Fault
from rigapp_drivers.simulated import FaultPlan
from rigapp_drivers.simulator_api import RigSignals

CODE_PER_RANGE = 2.0**23 / OVERRANGE
HIGHEST_CODE = (1 << 23) - 1
LOWEST_CODE = -(1 << 23)

_FAR_OUT, _NO_RANGE = 1e6, 1e300

Codes = NDArray[np.int64]


def part_of_range(signal: NDArray[np.float64] | float, kind: InputType) -> NDArray[np.float64]:
    """Return a signal as a fraction of an input's range; an open input (infinite) far outside."""
    part = np.asarray(signal / NOMINAL_RANGE.get(kind, _NO_RANGE))
    return part if np.isfinite(part).all() else np.clip(part, -_FAR_OUT, _FAR_OUT)


def parts_of_ranges(
    signals: Mapping[int, NDArray[np.float64]], samples: int, kinds: Sequence[InputType]
) -> NDArray[np.float64]:
    """Return (8, samples) in fractions of each range."""
    inputs = np.zeros((8, samples))
    for channel, signal in signals.items():
        inputs[channel - 1] = part_of_range(signal, kinds[channel - 1])
    return inputs


def ends_reached(inputs: NDArray[np.float64]) -> int:
    """Return the flags of a value error of kind 1: inputs above their range, and below it."""
    above = np.flatnonzero((inputs >= OVERRANGE).any(axis=1))
    below = np.flatnonzero((inputs <= -OVERRANGE).any(axis=1))
    return sum(1 << int(n) for n in above) | sum(1 << 8 + int(n) for n in below)


def open_inputs(signals: Mapping[int, NDArray[np.float64]]) -> int:
    """Return the flags of a value error of kind 3 for the broken wires: Ud+, Ud-."""
    flags = 0
    for channel, signal in signals.items():
        flags |= bool(signal.max() == np.inf) << 2 * (channel - 1)
        flags |= bool(signal.min() == -np.inf) << 2 * (channel - 1) + 1
    return flags


class AnalogInputs:
    """Convert the eight inputs together; an input without a signal reads zero."""

    def __init__(self) -> None:
        self._stuck: dict[int, float] = {}
        self._last = np.zeros(8)

    def faulty(
        self, inputs: NDArray[np.float64], saturated: int | None, stuck: int | None
    ) -> NDArray[np.float64]:
        """Return the inputs with one channel beyond its range or stuck at its last value."""
        if saturated is not None:
            inputs[saturated - 1] = 2.0
        if stuck is None:
            self._stuck.clear()
        else:
            held = self._stuck.setdefault(stuck, float(self._last[stuck - 1]))
            inputs[stuck - 1] = held
        self._last = inputs[:, -1].copy()
        return inputs


def codes_of(inputs: NDArray[np.float64]) -> Codes:
    """Return the converter's signed 24-bit codes of normalised inputs."""
    codes = np.round(inputs * CODE_PER_RANGE)
    return np.clip(codes, LOWEST_CODE, HIGHEST_CODE).astype(np.int64)


OVERRUN = 0x91
_SATURATED, _SENSOR_BROKEN = 1, 3  # kinds of value errors


class MeasuredValues:
    """Convert the terminal signals into frames, including the effects of faults."""

    def __init__(
        self,
        device: Device,
        plan: FaultPlan,
        rng: np.random.Generator,
    ) -> None:
        self._device = device
        self._plan = plan
        self._rng = rng
        self._inputs = AnalogInputs()
        self._codes = np.zeros((p.ANALOG_CHANNELS, 1), dtype=np.int64)
        self._counts = np.zeros((p.COUNTER_CHANNELS, 1), dtype=np.int64)
        self._terminals: dict[int, NDArray[np.float64]] = {}
        self._converted_as = list(device.settings.input_types)
        self._pending: tuple[NDArray[Any], NDArray[np.bool_]] | None = None
        self._to_drop = 0

    def forget_part(self) -> None:
        """Discard the samples of an incomplete high-speed frame."""
        self._pending = None

    def convert(self, signals: RigSignals, now_s: float) -> NDArray[np.bool_]:
        """Advance inputs and counters by these samples; return which have a saturated input."""
        device, settings = self._device, self._device.settings
        active = self._plan.active
        samples = signals.shaft_revolutions.size
        inputs = parts_of_ranges(signals.analog, samples, settings.input_types)
        saturated = active(Gsv8Fault.SATURATED_INPUT, 1.0)
        stuck = active(Gsv8Fault.STUCK_INPUT, 1.0)
        inputs = self._inputs.faulty(
            inputs,
            None if saturated is None else int(saturated),
            None if stuck is None else int(stuck),
        )
        broken = active(Gsv8Fault.SENSOR_BROKEN, 1.0)
        codes = codes_of(inputs)
        device.state.raw = codes[:, -1].tolist()
        self._terminals = {n: signal[-1:] for n, signal in signals.analog.items()}
        self._converted_as = list(settings.input_types)
        self._count(signals.shaft_revolutions)
        over, above, wires = np.zeros(samples, np.bool_), 0, 0
        if not np.abs(inputs).max() < 1.0:  # skip the slow searches if no input is near its limit
            over = self._over(inputs * CODE_PER_RANGE)
            above, wires = ends_reached(inputs), open_inputs(signals.analog)
        device.note_fault(_SATURATED, above, now_s)
        wires |= 0 if broken is None else 3 << 2 * (int(broken) - 1)
        device.note_fault(_SENSOR_BROKEN, wires, now_s)
        self._codes = codes
        if device.state.injection == 1:
            over[:] = False
        return over

    def convert_again(self) -> None:
        """Convert the last signals again if an input type has changed since."""
        kinds = self._device.settings.input_types
        if kinds == self._converted_as:
            return
        inputs = parts_of_ranges(self._terminals, 1, kinds)
        self._converted_as = list(kinds)
        codes = codes_of(inputs)
        self._device.state.raw = codes[:, 0].tolist()
        self._codes = codes

    def one_frame(self) -> bytes:
        """Return the frame of the last sample, or of the test value once it is injected."""
        codes = self._fed(self._codes[:, -1:])
        values = self._values(codes, self._counts[:, -1:])
        return encode_frames(values, self._layout(), self._over(codes)).tobytes()

    def frames(self, saturated: NDArray[np.bool_]) -> bytes:
        """Return the bytes of the last converted samples."""
        layout = self._layout()
        values: NDArray[Any] = self._values(self._fed(self._codes), self._counts)
        extra = self._plan.active(Gsv8Fault.WRONG_OBJECT_COUNT, 1.0)
        if extra is not None:
            more = np.zeros((int(extra), values.shape[1]), dtype=values.dtype)
            values = np.concatenate((values, more))
            layout = FrameLayout(len(values), layout.data_type, layout.checksum)
        sequences = layout.most_sequences
        if sequences > 1:
            values, saturated = self._whole_frames(values, saturated, sequences)
        return self._damaged(encode_frames(values, layout, saturated, sequences))

    def _fed(self, codes: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the converter's codes: of the inputs, or of the test value instead."""
        injected = self._device.state.injection == 1
        return np.full_like(codes, p.HALF_SCALE_CODE) if injected else codes

    def _count(self, shaft: NDArray[np.float64]) -> None:
        plan, settings = self._plan, self._device.settings
        slip = plan.take(Gsv8Fault.COUNTER_SLIP, 1.0)
        false_index = plan.take(Gsv8Fault.FALSE_INDEX) is not None
        stuck = plan.active(Gsv8Fault.STUCK_COUNTER) is not None
        index = plan.active(Gsv8Fault.MISSING_INDEX) is None
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
        """Return which samples have a channel at the end of the converter's range."""
        used = codes[: max(1, self._device.settings.analog_objects)]
        limit = OVERRANGE * CODE_PER_RANGE - 1.0
        return np.asarray((np.abs(used) >= limit).any(axis=0))

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

    def _whole_frames(
        self, values: NDArray[Any], saturated: NDArray[np.bool_], sequences: int
    ) -> tuple[NDArray[Any], NDArray[np.bool_]]:
        """Keep the samples that do not fill a frame for the next call."""
        if self._pending is not None and len(self._pending[0]) == len(values):
            values = np.concatenate((self._pending[0], values), axis=1)
            saturated = np.concatenate((self._pending[1], saturated))
        count = values.shape[1] // sequences * sequences
        self._pending = (values[:, count:], saturated[count:])
        return values[:, :count], saturated[:count]

    def _damaged(self, frames: NDArray[np.uint8]) -> bytes:
        """Return the bytes of frames with the effects of faults."""
        take = self._plan.take
        overrun = take(Gsv8Fault.OVERRUN, 10.0)
        if overrun is not None:
            self._device.state.asynchronous_error = OVERRUN
        self._to_drop += int(overrun or 0) + int(take(Gsv8Fault.DROPPED_FRAMES, 1.0) or 0)
        if self._to_drop:
            dropped = min(self._to_drop, len(frames))
            self._to_drop -= dropped
            frames = frames[dropped:]
        if len(frames) == 0:
            return b""
        flipped = take(Gsv8Fault.FLIPPED_BIT, 5.0)
        if flipped is not None:
            frames[0, int(flipped) % frames.shape[1]] ^= 0x10
        data = frames.tobytes()
        cut = take(Gsv8Fault.CUT_FRAME, 11.0)
        if cut is not None:
            data = data[: int(cut)] + data[frames.shape[1] :]
        garbage = take(Gsv8Fault.GARBAGE, 7.0)
        if garbage is not None:
            data = self._rng.bytes(max(1, int(garbage))) + data
        return data
