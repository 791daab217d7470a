"""Set a GSV-8 to a plan: read, compare, write only what differs, and read everything back.

The settings memory of the device bears a limited number of writes (SPEC p24), so nothing is
written that already stands there.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from drivers.api import SettingRefused
from drivers.gsv8 import protocol as p
from drivers.gsv8.frames import FrameLayout
from drivers.gsv8.link import Link
from drivers.gsv8.numbers import DataType
from drivers.gsv8.plan import Plan
from drivers.gsv8.protocol import Command, InputType, f32, read_f32, u8, u16, u32

_log = logging.getLogger(__name__)

T = TypeVar("T")
Readback = dict[str, str | float | int]

_NO_SUCH_COMMAND = (0x40, 0x41)
_FALSIFYING_MODES = p.MODE_MULTI_AXIS | p.MODE_NOISE_CUT | p.MODE_AUTO_ZERO
_DISTURBING_FLAGS = p.TX_ALWAYS_OFF | p.TX_MAXIMA | p.TX_MINIMA
_LINE_GROUPS = {0: (3, 4), 1: (4,)}  # groups of four digital lines that a counter's pins are in
_LINE_SHARE = 0.95  # of a serial line's capacity that the stream may take
_MAPPING_NOT_READABLE = (1, 38)


class Commissioner:
    """Set one device; ``writes`` counts the writes to its settings memory."""

    def __init__(self, link: Link, firmware: tuple[int, int], baud_rate: int) -> None:
        self.writes = 0
        self.readback: Readback = {}
        self._link = link
        self._firmware = firmware
        self._baud_rate = baud_rate

    def set_up(self, plan: Plan) -> FrameLayout:
        """Set the device to the plan, fill ``readback``; return the frames that it will send."""
        self._check_firmware(plan)
        self._link.checksum = plan.command_checksum
        interface = self._interface(plan)
        offset_binary = self._line(interface.number, plan)
        slower = plan.sample_rate_Hz < self._rate()
        if slower:
            self._set_rate(plan)
        self._set_modes(plan)
        self._set_inputs(plan)
        self._set_counters(plan)
        self._set_objects(plan)
        self._set_data_type(plan)
        if not slower:
            self._set_rate(plan)
        self._read_all(plan, interface)
        return FrameLayout(
            objects=len(plan.objects),
            data_type=plan.data_type,
            checksum=plan.data_checksum,
            high_speed=plan.high_speed and plan.sample_rate_Hz >= p.HIGH_SPEED_FROM_HZ,
            offset_binary=offset_binary,
        )

    # --- the link -------------------------------------------------------------------------------

    def _check_firmware(self, plan: Plan) -> None:
        needs = (
            (bool(plan.counters), p.COUNTER_FIRMWARE, "the encoder input"),
            (plan.command_checksum, p.CHECKSUM_FIRMWARE, "command_checksum"),
            (plan.data_checksum, p.CHECKSUM_FIRMWARE, "data_checksum"),
            (plan.high_speed, p.HIGH_SPEED_FIRMWARE, "high_speed_frames"),
        )
        for wanted, least, what in needs:
            if wanted and self._firmware < least:
                raise self._refused(
                    f"{what} needs firmware {_version(least)} or newer, this device has "
                    f"{_version(self._firmware)}; let the maker update it."
                )

    def _interface(self, plan: Plan) -> p.InterfaceReply:
        """Open the session: every call decides anew on checksum and high-speed frames."""
        flags = 0x01 | (0x04 if plan.high_speed else 0) | (0x08 if plan.data_checksum else 0)
        reply = p.decode_interface(self._link.command(Command.GET_INTERFACE, u8(flags), reply=4))
        if reply.data_checksum != plan.data_checksum:
            raise self._refused("the device did not take the setting data_checksum.")
        if reply.write_protected:
            _log.warning("%s: the device reports write protection", self._link.port.device)
        return reply

    def _line(self, number: int, plan: Plan) -> bool:
        """Check what the line carries; return whether integers are offset-binary on it."""
        response = self._link.exchange(Command.READ_INTERFACE_SETTING, u8(number))
        if response.status or len(response.data) != 6:
            self.readback["interface"] = "unknown"
            self.readback["integers"] = "offset-binary (assumed)"
            return True
        setting = p.decode_interface_setting(response.data)
        self.readback["interface"] = p.INTERFACE_KINDS.get(setting.kind, f"kind {setting.kind}")
        offset_binary = bool(setting.data & p.OFFSET_BINARY_FLAG)
        self.readback["integers"] = "offset-binary" if offset_binary else "two's complement"
        if setting.kind in (1, 2, 6):
            self._check_capacity(plan)
        return offset_binary

    def _check_capacity(self, plan: Plan) -> None:
        layout = FrameLayout(len(plan.objects), plan.data_type, plan.data_checksum)
        capacity = self._baud_rate / 10.0 * _LINE_SHARE / layout.length()
        if plan.sample_rate_Hz > capacity:
            raise self._refused(
                f"sample_rate_Hz = {plan.sample_rate_Hz:g} needs more than a line of "
                f"{self._baud_rate} baud carries ({capacity:.0f} samples/s); choose a lower rate, "
                "a higher baud rate or USB."
            )

    # --- the settings ---------------------------------------------------------------------------

    def _ensure(
        self,
        what: str,
        wanted: T,
        read: Callable[[], T],
        write: Callable[[], object],
        same: Callable[[T, T], bool] = lambda a, b: a == b,
    ) -> bool:
        """Write a setting if it differs and check that it stands; tell whether it was written."""
        before = read()
        if same(before, wanted):
            return False
        try:
            write()
        except SettingRefused as error:
            raise self._refused(f"{what} cannot be {_shown(wanted)}: {error.sentence}") from error
        self.writes += 1
        _log.info("%s: %s %s -> %s", self._link.port.device, what, _shown(before), _shown(wanted))
        after = read()
        if not same(after, wanted):
            raise self._refused(
                f"{what} is {_shown(after)} after {_shown(wanted)} was written; check the device "
                "with the maker's program."
            )
        return True

    def _set_modes(self, plan: Plan) -> None:
        mode = self._u32(Command.GET_MODE)
        wanted = mode & ~_FALSIFYING_MODES & ~p.MODE_FILTER_AUTOMATIC
        wanted |= p.MODE_FILTER_AUTOMATIC if plan.filter_Hz is None else 0
        self._ensure(
            "mode (multi-axis, noise cut, auto-zero off; analog filter)",
            wanted & ~p.MODE_WRITE_LOCK,
            lambda: self._u32(Command.GET_MODE) & ~p.MODE_WRITE_LOCK,
            lambda: self._link.command(Command.SET_MODE, u32(wanted & ~p.MODE_WRITE_LOCK)),
        )
        if plan.filter_Hz is not None:
            limit = plan.filter_Hz
            self._ensure(
                "analog_filter",
                round(limit),
                self._filter,
                lambda: self._link.command(Command.WRITE_ANALOG_FILTER, f32(limit)),
            )
        flags = self._transmit_mode(p.TX_FLAGS)
        keep = flags & p.TX_CHECKSUM
        self._ensure(
            "transmission (always off, maxima and minima in the frame)",
            0,
            lambda: self._transmit_mode(p.TX_FLAGS) & _DISTURBING_FLAGS,
            lambda: self._link.command(Command.SET_TX_MODE, u8(p.TX_FLAGS) + u16(keep)),
        )

    def _set_inputs(self, plan: Plan) -> None:
        for channel, kind in sorted(plan.analog.items()):
            self._ensure(
                f"input type of analog_{channel}",
                kind,
                lambda channel=channel: self._input_type(channel),  # type: ignore[misc]
                lambda channel=channel, kind=kind: self._link.command(  # type: ignore[misc]
                    Command.SET_INPUT_TYPE, u8(channel, kind)
                ),
            )
            self._set_float(
                f"user scale of analog_{channel}",
                channel,
                p.NOMINAL_RANGE[kind],
                Command.READ_USER_SCALE,
                Command.WRITE_USER_SCALE,
            )
            self._set_float(
                f"user offset of analog_{channel}",
                channel,
                0.0,
                Command.READ_USER_OFFSET,
                Command.WRITE_USER_OFFSET,
            )

    def _set_float(
        self, what: str, channel: int, wanted: float, reader: Command, writer: Command
    ) -> None:
        self._ensure(
            what,
            wanted,
            lambda: self._f32(reader, u8(channel)),
            lambda: self._link.command(writer, u8(channel) + f32(wanted)),
            _same_float,
        )

    def _set_counters(self, plan: Plan) -> None:
        if self._firmware < p.COUNTER_FIRMWARE:
            return
        # A counter that is not wanted would still take a place in the frame.
        for number in range(p.COUNTER_CHANNELS):
            if number not in plan.counters:
                self._switch_counter_off(number)
        for number, mode in sorted(plan.counters.items()):
            name = f"counter_{number + 1}"
            if not self._counter(number, 0) & p.COUNTER_PRESENT:
                raise self._refused(
                    f"{name}: this device has no encoder input; use another input or device."
                )
            self._ensure(
                f"home value of {name}",
                plan.counter_home,
                lambda number=number: self._counter(number, 2),  # type: ignore[misc]
                lambda number=number: self._write_counter(  # type: ignore[misc]
                    number, 2, plan.counter_home
                ),
            )
            flags = mode.encode()
            self._ensure(
                f"mode of {name}",
                flags,
                lambda number=number: self._counter(number, 0) & ~p.COUNTER_PRESENT,  # type: ignore[misc]
                lambda number=number, flags=flags: self._write_counter(  # type: ignore[misc]
                    number, 0, flags
                ),
            )

    def _switch_counter_off(self, number: int) -> None:
        response = self._link.exchange(Command.READ_COUNTER_MODE, u8(p.counter_index(number, 0)))
        if response.status or len(response.data) != 4:
            return
        on = p.COUNTER_ON | p.SPEED_ON
        flags = int.from_bytes(response.data, "big") & ~p.COUNTER_PRESENT
        self._ensure(
            f"counter_{number + 1} (not in use)",
            0,
            lambda: self._counter(number, 0) & on,
            lambda: self._write_counter(number, 0, flags & ~on),
        )

    def _set_objects(self, plan: Plan) -> None:
        self._ensure(
            "number of objects in the frame",
            len(plan.objects),
            lambda: self._objects(plan),
            lambda: self._link.command(
                Command.SET_TX_MAPPING, u8(p.MAPPED_OBJECTS) + u16(len(plan.objects))
            ),
        )

    def _set_data_type(self, plan: Plan) -> None:
        self._ensure(
            "data_type",
            int(plan.data_type),
            lambda: self._transmit_mode(p.TX_DATA_TYPE),
            lambda: self._link.command(
                Command.SET_TX_MODE, u8(p.TX_DATA_TYPE) + u16(plan.data_type)
            ),
        )

    def _set_rate(self, plan: Plan) -> None:
        rate = plan.sample_rate_Hz
        if _same_float(self._rate(), rate):
            return
        highest = self._f32(Command.READ_DATA_RATE_RANGE, u8(0))
        if rate > highest:
            raise self._refused(
                f"sample_rate_Hz = {rate:g}: the device allows at most {highest:g} with "
                f"{len(plan.objects)} objects as {plan.data_type.name.lower()}; choose a lower "
                "rate" + (", int24 or int16." if plan.data_type is DataType.FLOAT32 else ".")
            )
        self._ensure(
            "sample_rate_Hz",
            rate,
            self._rate,
            lambda: self._link.command(Command.WRITE_DATA_RATE, f32(rate)),
            _same_float,
        )

    # --- reading back ---------------------------------------------------------------------------

    def _read_all(self, plan: Plan, interface: p.InterfaceReply) -> None:
        """Read every setting once more, since one may have changed another (status 01)."""
        facts = self.readback
        facts["sample_rate_Hz"] = self._rate()
        facts["data_type"] = DataType(self._transmit_mode(p.TX_DATA_TYPE)).name.lower()
        facts["objects"] = self._objects(plan)
        facts["object_map"] = ", ".join(plan.objects)
        facts["command_checksum"] = "on" if plan.command_checksum else "off"
        facts["data_checksum"] = "on" if interface.data_checksum else "off"
        facts["mode"] = f"0x{self._u32(Command.GET_MODE):08X}"
        facts["analog_filter_Hz"] = self._filter()
        for channel in sorted(plan.analog):
            name = f"analog_{channel}"
            facts[f"{name}.input_type"] = self._input_type(channel).words
            facts[f"{name}.user_scale"] = self._f32(Command.READ_USER_SCALE, u8(channel))
            facts[f"{name}.user_offset"] = self._f32(Command.READ_USER_OFFSET, u8(channel))
            facts[f"{name}.zero"] = self._zero(channel)
        for number in sorted(plan.counters):
            self._read_counter(plan, number)
        facts["settings_written"] = self.writes
        self._check_readback(plan)

    def _read_counter(self, plan: Plan, number: int) -> None:
        name, facts = f"counter_{number + 1}", self.readback
        facts[f"{name}.mode"] = f"0x{self._counter(number, 0):04X}"
        facts[f"{name}.home"] = self._counter(number, 2)
        scale = self._link.exchange(
            Command.READ_USER_SCALE, u8(p.ANALOG_CHANNELS + 1 + sorted(plan.counters).index(number))
        )
        if scale.status == 0 and len(scale.data) == 4:
            facts[f"{name}.user_scale"] = read_f32(scale.data)
        assumed = " (assumed)" if plan.counts_per_unit == 1.0 else ""
        facts[f"{name}.counts_per_unit"] = f"{plan.counts_per_unit:g}{assumed}"
        for group in _LINE_GROUPS[number]:
            direction = self._link.exchange(Command.GET_DIO_DIRECTION, u8(group))
            if direction.status == 0 and direction.data[:1] == b"\x00":
                facts[f"{name}.lines"] = f"digital lines {4 * group - 3} to {4 * group} are outputs"
                _log.warning(
                    "%s: digital lines %d to %d are outputs, but %s has pins there; make them "
                    "inputs if it does not count",
                    self._link.port.device,
                    4 * group - 3,
                    4 * group,
                    name,
                )

    def _check_readback(self, plan: Plan) -> None:
        facts = self.readback
        wanted: Readback = {
            "sample_rate_Hz": plan.sample_rate_Hz,
            "objects": len(plan.objects),
            "data_type": plan.data_type.name.lower(),
        }
        for channel, kind in plan.analog.items():
            wanted[f"analog_{channel}.input_type"] = kind.words
            wanted[f"analog_{channel}.user_scale"] = p.NOMINAL_RANGE[kind]
            wanted[f"analog_{channel}.user_offset"] = 0.0
        for key, value in wanted.items():
            if facts[key] != value:
                raise self._refused(
                    f"{key} is {facts[key]} in the end, {value} was asked for: another setting "
                    "changed it; check the device with the maker's program."
                )

    def _rate(self) -> float:
        return self._f32(Command.READ_DATA_RATE)

    def _zero(self, channel: int) -> int:
        data = self._link.command(Command.READ_ZERO, u8(channel), reply=4)
        return int.from_bytes(data, "big", signed=True)

    def _filter(self) -> int:
        return int.from_bytes(self._link.command(Command.READ_ANALOG_FILTER, reply=2), "big")

    def _input_type(self, channel: int) -> InputType:
        return InputType(self._link.command(Command.GET_INPUT_TYPE, u8(channel, 0xFF), reply=5)[0])

    def _transmit_mode(self, index: int) -> int:
        return int.from_bytes(self._link.command(Command.GET_TX_MODE, u8(index), reply=2), "big")

    def _counter(self, number: int, index: int) -> int:
        return self._u32(Command.READ_COUNTER_MODE, u8(p.counter_index(number, index)))

    def _write_counter(self, number: int, index: int, value: int) -> bytes:
        return self._link.command(
            Command.WRITE_COUNTER_MODE, u8(p.counter_index(number, index)) + u32(value)
        )

    def _objects(self, plan: Plan) -> int:
        if self._firmware <= _MAPPING_NOT_READABLE:
            return self._interface(replace(plan)).objects
        data = self._link.command(Command.GET_TX_MAPPING, u8(p.MAPPED_OBJECTS), reply=2)
        return int.from_bytes(data, "big")

    def _u32(self, command: Command, parameters: bytes = b"") -> int:
        return int.from_bytes(self._link.command(command, parameters, reply=4), "big")

    def _f32(self, command: Command, parameters: bytes = b"") -> float:
        return read_f32(self._link.command(command, parameters, reply=4))

    def _refused(self, sentence: str) -> SettingRefused:
        return SettingRefused(self._link.port.device, self._link.port.port, sentence)


def _same_float(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-9)


def _shown(value: object) -> str:
    if isinstance(value, InputType):
        return value.words
    return f"{value:g}" if isinstance(value, float) else str(value)


def _version(firmware: tuple[int, int]) -> str:
    return f"{firmware[0]}.{firmware[1]:02d}"
