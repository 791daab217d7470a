"""Configure a GSV-8 by a plan: read, compare, write only what differs, and read everything back.

The settings memory of the device allows a limited number of writes (SPEC p24), so values that are
already set are not written.
"""

from __future__ import annotations

import contextlib
import logging
import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Final

from rigapp.texts import say
from rigapp_drivers.api import (
    BytePort,
    Identity,
    Probe,
    ProtocolError,
    ReplyTimeout,
    SettingRefused,
)
from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8 import registers as r
from rigapp_drivers.gsv8.frames import FrameLayout
from rigapp_drivers.gsv8.link import Link
from rigapp_drivers.gsv8.numbers import DataType
from rigapp_drivers.gsv8.plan import Plan
from rigapp_drivers.gsv8.protocol import Command, InputType, u8
from rigapp_drivers.gsv8.registers import Registers, Setting

_NO_CHANGE: Final = 0  # keeps the transmission; the checksum of measured values is off until set


def ask(line: BytePort, timeout_s: float) -> Identity | None:
    """Probe by reading the firmware version; return the identity. The stream is not affected."""
    link = Link(line, timeout_s)
    try:
        version = link.command(Command.FIRMWARE_VERSION, reply=4, tries=1)
        reply = link.command(Command.GET_INTERFACE, u8(_NO_CHANGE), reply=4, tries=1)
        number = link.command(Command.GET_SERIAL_NUMBER, reply=4, tries=1)
    except (ReplyTimeout, ProtocolError, SettingRefused):
        return None
    interface = p.decode_interface(reply)
    known = interface.model == p.MODEL_GSV8
    model = "GSV-8" if known else say("GSV, model {}", f"{interface.model:02X}")
    details = {} if known else {"note": say("rigapp has no driver for this model")}
    return identity_of(model, p.decode_version(version), number, line.port, details)


def identity_of(
    model: str, firmware: tuple[int, int], number: bytes, port: str, details: Mapping[str, str]
) -> Identity:
    """Return the identity; number: the data of the serial number."""
    serial = f"{int.from_bytes(number, 'big'):08d}"
    return Identity("ME-Systeme", model, p.version_words(firmware), serial, port, details)


PROBE: Final = Probe(ask, (115200, 460800, 230400, 57600, 38400, 19200))


_log = logging.getLogger(__name__)

Readback = dict[str, str | float | int]

_FALSIFYING_MODES = p.MODE_MULTI_AXIS | p.MODE_NOISE_CUT | p.MODE_AUTO_ZERO
_LINE_GROUPS = {0: (3, 4), 1: (4,)}  # counter -> groups of four digital lines with its pins
_LINE_SHARE = 0.95  # maximum share of a serial line's capacity for the stream
_BITS_PER_BYTE = 10.0  # with start and stop bit
_SERIAL_LINES = (1, 2, 6)  # kinds of interface with a baud rate


class Commissioner:
    """Configure one device; ``writes`` counts the writes to its settings memory."""

    def __init__(self, link: Link, firmware: tuple[int, int], baud_rate: int) -> None:
        self.writes = 0
        self.readback: Readback = {}
        self._link = link
        self._name = link.port.device
        self._firmware = firmware
        self._registers = Registers(link, firmware)
        self._baud_rate = baud_rate

    def set_up(self, plan: Plan) -> FrameLayout:
        """Configure the device, fill ``readback``; return the layout of its frames."""
        self._check_firmware(plan)
        self._link.checksum = plan.command_checksum
        plan, interface = self._choose_checksum(plan)
        offset_binary = self._check_line(interface.number, plan)
        # Lower a rate that is too high for the new format first; set a higher one last.
        slower = plan.sample_rate_Hz < self._registers.get(r.RATE)
        if slower:
            self._set_rate(plan)
        self._set_modes(plan)
        for channel, kind in sorted(plan.analog.items()):
            self._set_input(channel, kind)
        for counter in range(p.COUNTER_CHANNELS):
            self._set_counter(counter, plan)
        self._set_format(plan)
        if not slower:
            self._set_rate(plan)
        self._read_all(plan, interface)
        self._check_readback(plan)
        return FrameLayout(
            objects=len(plan.objects),
            data_type=plan.data_type,
            checksum=bool(plan.data_checksum),
            high_speed=plan.high_speed and plan.sample_rate_Hz >= p.HIGH_SPEED_FROM_HZ,
            offset_binary=offset_binary,
        )

    # --- the link -------------------------------------------------------------------------------

    def _check_firmware(self, plan: Plan) -> None:
        needs = (
            (bool(plan.counters), p.COUNTER_FIRMWARE, say("the encoder input")),
            (plan.command_checksum, p.CHECKSUM_FIRMWARE, "command_checksum"),
            (bool(plan.data_checksum), p.CHECKSUM_FIRMWARE, "data_checksum"),
            (plan.high_speed, p.HIGH_SPEED_FIRMWARE, "high_speed_frames"),
        )
        for required, minimum, what in needs:
            if required and self._firmware < minimum:
                raise SettingRefused.at(
                    self._link.port,
                    "{} needs firmware {} or newer, this device has {}; let the maker update it.",
                    what,
                    p.version_words(minimum),
                    p.version_words(self._firmware),
                )

    def _choose_checksum(self, plan: Plan) -> tuple[Plan, p.InterfaceReply]:
        """Open the session, with a checksum of the data if allowed and supported."""
        if plan.data_checksum is not None:
            return plan, self._open_session(plan)
        protected = replace(plan, data_checksum=True)
        if self._firmware >= p.CHECKSUM_FIRMWARE:
            with contextlib.suppress(SettingRefused):  # retry without it; that raises other errors
                interface = self._open_session(protected)
                self._check_line(interface.number, protected)
                return protected, interface
        bare = replace(plan, data_checksum=False)
        return bare, self._open_session(bare)

    def _open_session(self, plan: Plan) -> p.InterfaceReply:
        required = bool(plan.data_checksum)
        reply = self._registers.open_session(high_speed=plan.high_speed, data_checksum=required)
        if reply.data_checksum != required:
            raise SettingRefused.at(
                self._link.port, "the device did not take the setting data_checksum."
            )
        if reply.write_protected:
            _log.warning("%s: the device reports write protection", self._name)
        return reply

    def _check_line(self, number: int, plan: Plan) -> bool:
        """Check the line's capabilities; return whether its integers are offset-binary."""
        facts = self.readback
        setting = self._registers.interface_setting(number)
        if setting is None:
            facts["interface"] = "unknown"
            facts["integers"] = say("offset-binary (assumed)")
            return True
        offset_binary = bool(setting.data & p.OFFSET_BINARY_FLAG)
        facts["interface"] = p.INTERFACE_KINDS.get(setting.kind, say("kind {}", setting.kind))
        facts["integers"] = "offset-binary" if offset_binary else say("two's complement")
        if setting.kind in _SERIAL_LINES:
            self._check_capacity(plan)
        return offset_binary

    def _check_capacity(self, plan: Plan) -> None:
        layout = FrameLayout(len(plan.objects), plan.data_type, bool(plan.data_checksum))
        capacity = self._baud_rate / _BITS_PER_BYTE * _LINE_SHARE / layout.length()
        if plan.sample_rate_Hz > capacity:
            raise SettingRefused.at(
                self._link.port,
                "sample_rate_Hz = {:g} needs more than a line of {} baud carries"
                " ({:.0f} samples/s); choose a lower rate, a higher baud rate or USB.",
                plan.sample_rate_Hz,
                self._baud_rate,
                capacity,
            )

    # --- the settings ---------------------------------------------------------------------------

    def _ensure(self, setting: Setting, required: Any) -> None:
        """Write a setting if it differs, and verify it."""
        before = self._registers.get(setting)
        if _same(before, required):
            return
        try:
            self._set_once(setting, required)
        except SettingRefused as error:
            sentence = say("{} cannot be {}: {}", setting.words, _shown(required), error.sentence)
            raise SettingRefused.at(self._link.port, sentence) from error
        self.writes += 1
        _log.info("%s: %s %s -> %s", self._name, setting.words, _shown(before), _shown(required))
        after = self._registers.get(setting)
        if not _same(after, required):
            raise SettingRefused.at(
                self._link.port,
                "{} is {} after {} was written; check the device with the maker's program.",
                setting.words,
                _shown(after),
                _shown(required),
            )

    def _set_once(self, setting: Setting, required: Any) -> None:
        """Write a setting; repeat only if the readback shows the old value."""
        try:
            self._registers.set(setting, required)
        except ReplyTimeout:
            if not _same(self._registers.get(setting), required):
                self._registers.set(setting, required)

    def _set_modes(self, plan: Plan) -> None:
        mode = self._registers.get(r.MODE) & ~_FALSIFYING_MODES & ~p.MODE_FILTER_AUTOMATIC
        self._ensure(r.MODE, mode | (p.MODE_FILTER_AUTOMATIC if plan.filter_Hz is None else 0))
        if plan.filter_Hz is not None:
            self._ensure(r.FILTER, round(plan.filter_Hz))
        self._ensure(r.FLAGS, self._registers.get(r.FLAGS) & p.TX_CHECKSUM)

    def _set_input(self, channel: int, kind: InputType) -> None:
        self._ensure(r.input_type(channel), kind)
        self._ensure(r.scale(channel), p.NOMINAL_RANGE[kind])
        self._ensure(r.offset(channel), 0.0)

    def _set_counter(self, counter: int, plan: Plan) -> None:
        flags = self._registers.get(r.counter_mode(counter))
        if counter in plan.counters:
            if not flags & p.COUNTER_PRESENT:
                raise SettingRefused.at(
                    self._link.port, "counter_{}: this device has no encoder input.", counter + 1
                )
            self._ensure(r.counter_home(counter), plan.counter_home)
            required = plan.counters[counter].encode()
        else:
            # An unused counter would still be an object of the frame.
            required = flags & ~(p.COUNTER_ON | p.SPEED_ON | p.COUNTER_PRESENT)
        self._ensure(r.counter_mode(counter, mask=~p.COUNTER_PRESENT), required)

    def _set_format(self, plan: Plan) -> None:
        self._ensure(r.OBJECTS, len(plan.objects))
        self._ensure(r.DATA_TYPE, int(plan.data_type))

    def _set_rate(self, plan: Plan) -> None:
        rate = plan.sample_rate_Hz
        if not _same(self._registers.get(r.RATE), rate):
            highest = self._registers.highest_rate_Hz()
            if rate > highest:
                other = say(", int24 or int16") if plan.data_type is DataType.FLOAT32 else ""
                raise SettingRefused.at(
                    self._link.port,
                    "sample_rate_Hz = {:g}: the device allows at most {:g} with {}"
                    " inputs as {}; choose a lower rate{}.",
                    rate,
                    highest,
                    len(plan.objects),
                    plan.data_type.name.lower(),
                    other,
                )
        self._ensure(r.RATE, rate)

    # --- reading back ---------------------------------------------------------------------------

    def _read_all(self, plan: Plan, interface: p.InterfaceReply) -> None:
        """Read every setting again, since writing one may change another (status 01)."""
        facts, registers = self.readback, self._registers
        facts["sample_rate_Hz"] = registers.get(r.RATE)
        facts["data_type"] = DataType(registers.get(r.DATA_TYPE)).name.lower()
        facts["objects"] = registers.get(r.OBJECTS)
        facts["object_map"] = ", ".join(plan.objects)
        facts["command_checksum"] = "on" if plan.command_checksum else "off"
        facts["data_checksum"] = "on" if interface.data_checksum else "off"
        facts["mode"] = f"0x{registers.get(r.MODE):08X}"
        facts["analog_filter_Hz"] = registers.get(r.FILTER)
        for channel in sorted(plan.analog):
            name = f"analog_{channel}"
            facts[f"{name}.input_type"] = registers.get(r.input_type(channel)).words
            facts[f"{name}.user_scale"] = registers.get(r.scale(channel))
            facts[f"{name}.user_offset"] = registers.get(r.offset(channel))
            facts[f"{name}.zero"] = registers.zero(channel)
        for index, counter in enumerate(sorted(plan.counters)):
            self._read_counter(plan, counter, p.ANALOG_CHANNELS + 1 + index)
        facts["settings_written"] = self.writes

    def _read_counter(self, plan: Plan, counter: int, channel: int) -> None:
        facts, registers, name = self.readback, self._registers, f"counter_{counter + 1}"
        facts[f"{name}.mode"] = f"0x{registers.get(r.counter_mode(counter)):04X}"
        facts[f"{name}.home"] = registers.get(r.counter_home(counter))
        facts[f"{name}.user_scale"] = registers.get(r.scale(channel))
        assumed = " (assumed)" if plan.counts_per_unit == 1.0 else ""
        facts[f"{name}.counts_per_unit"] = f"{plan.counts_per_unit:g}{assumed}"
        for group in _LINE_GROUPS[counter]:
            if registers.lines_are_outputs(group):
                lines = say("digital lines {} to {} are outputs", 4 * group - 3, 4 * group)
                facts[f"{name}.lines_{group}"] = lines
                _log.warning(
                    "%s: %s, but %s has pins there; make them inputs with the maker's program if "
                    "it does not count",
                    self._name,
                    lines,
                    name,
                )

    def _check_readback(self, plan: Plan) -> None:
        facts = self.readback
        required: Readback = {
            "sample_rate_Hz": plan.sample_rate_Hz,
            "objects": len(plan.objects),
            "data_type": plan.data_type.name.lower(),
        }
        for channel, kind in plan.analog.items():
            required[f"analog_{channel}.input_type"] = kind.words
            required[f"analog_{channel}.user_scale"] = p.NOMINAL_RANGE[kind]
            required[f"analog_{channel}.user_offset"] = 0.0
        for counter, mode in plan.counters.items():
            flags = mode.encode() | p.COUNTER_PRESENT
            required[f"counter_{counter + 1}.mode"] = f"0x{flags:04X}"
        for key, value in required.items():
            if not _same(facts[key], value):
                raise SettingRefused.at(
                    self._link.port,
                    (
                        "{} is {} although {} was set: another setting changed it; check the"
                        " device with the maker's program."
                    ),
                    key,
                    facts[key],
                    value,
                )


def _same(a: object, b: object) -> bool:
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-9)
    return a == b


def _shown(value: object) -> str:
    if isinstance(value, InputType):
        return value.words
    return f"{value:g}" if isinstance(value, float) else str(value)
