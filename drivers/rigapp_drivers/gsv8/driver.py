"""Acquire from a GSV-8: bridges, voltages and the encoder in one simultaneous frame."""

from __future__ import annotations

import contextlib
import logging
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rigapp.texts import joined, say
from rigapp_drivers.api import (
    Block,
    ConnectionFailed,
    DataRequest,
    DeviceError,
    DriverInfo,
    DriverKind,
    Identity,
    InputFault,
    Quality,
    ReplyTimeout,
    SettingRefused,
    SettingSpec,
    StreamSetup,
    WrongDevice,
    filled,
    refusing,
)
from rigapp_drivers.gsv8 import protocol as p
from rigapp_drivers.gsv8.commission import PROBE, Commissioner, identity_of
from rigapp_drivers.gsv8.frames import FrameLayout, Tally
from rigapp_drivers.gsv8.link import Link
from rigapp_drivers.gsv8.numbers import DataType
from rigapp_drivers.gsv8.plan import Plan, make_plan, parse_input
from rigapp_drivers.gsv8.protocol import Command, u8
from rigapp_drivers.gsv8.registers import Registers
from rigapp_drivers.gsv8.stream import BlockMaker, StreamWatch
from rigapp_drivers.gsv8.words import Decoder
from rigapp_drivers.transport import SerialPort, byte_counters, opened

BAUD_RATES = (
    *(19200, 38400, 57600, 115200, 230400, 460800),
    *(921600, 1250000, 1458333, 1750000, 2500000, 3500000),
)
DATA_TYPES = ("float32", "int24", "int16")
QUADRATURES = ("x4", "x2", "x1", say("pulse and direction"))
FILTERS = ("automatic", "28 Hz", "885 Hz", "11400 Hz")

SETTINGS: Mapping[str, SettingSpec] = {
    "sample_rate_Hz": SettingSpec(
        float,
        960.0,
        say("Samples per second: a divisor of 48000 from the device's list."),
        1.0,
        48000.0,
    ),
    "data_type": SettingSpec(
        str,
        "float32",
        say(
            "Number format on the wire: float32 to 12000 /s, int24 to 24000 /s, int16 to"
            " 48000 /s; with a counter to 16000 /s."
        ),
        choices=DATA_TYPES,
    ),
    "baud_rate": SettingSpec(
        int,
        115200,
        say("Speed of a UART or RS-422 line; not used on USB."),
        choices=BAUD_RATES,
    ),
    "command_checksum": SettingSpec(
        bool, False, say("Protect commands and answers by a CRC-8 (firmware 1.56 or newer).")
    ),
    "data_checksum": SettingSpec(
        object,
        "auto",
        say(
            "Protect measured values by a CRC-16 (firmware 1.56 or newer); auto does it"
            " where firmware and line can. Without it a sample waits for the next one."
        ),
        choices=("auto", True, False),
    ),
    "high_speed_frames": SettingSpec(
        bool,
        False,
        say("Allow several samples in one frame from 12000 /s on (USB, firmware 1.54)."),
    ),
    "object_map": SettingSpec(
        list,
        [],
        say(
            'Inputs in the order of the frame\'s objects, for example ["analog_1",'
            ' "analog_2", "counter_1"]; empty: analog inputs first, counters last.'
        ),
    ),
    "counts_per_unit": SettingSpec(
        float,
        1.0,
        say(
            "Counts of the encoder for one unit of the counter's value; 1 is assumed until"
            " one turn by hand has confirmed it."
        ),
    ),
    "counter_quadrature": SettingSpec(
        str, "x4", say("Edges of A and B that count for each encoder line."), choices=QUADRATURES
    ),
    "counter_index": SettingSpec(bool, True, say("Let the encoder's index set the counter.")),
    "counter_index_inverted": SettingSpec(bool, False, say("The index pulse is low, not high.")),
    "counter_home": SettingSpec(
        int, 0, say("Count that the index sets."), minimum=0, maximum=(1 << 23) - 1
    ),
    "counter_saturates": SettingSpec(
        bool, False, say("Hold the count at the end of its range instead of wrapping.")
    ),
    "counter_noise_filter": SettingSpec(bool, False, say("Filter noise on the encoder inputs.")),
    "counter_pull_ups": SettingSpec(
        bool, True, say("Use the 10 kohm pull-ups of the encoder inputs.")
    ),
    "analog_filter": SettingSpec(
        str,
        "automatic",
        say("Limit of the analog filter; automatic follows the rate."),
        choices=FILTERS,
    ),
    "on_overrun": SettingSpec(
        str,
        "flag",
        say("When the device reports that it lost data: flag the samples, or stop the test."),
        choices=("flag", "stop"),
    ),
    "poll_interval_s": SettingSpec(
        float,
        1.0,
        say("How often the device is queried for lost data while it streams."),
        0.1,
        60.0,
    ),
    "reply_timeout_s": SettingSpec(
        float, 1.0, say("How long to wait for the answer to a command."), 0.05, 10.0
    ),
    "block_s": SettingSpec(
        float, 0.02, say("Time of the samples that are handed over together."), 0.001, 1.0
    ),
}


_log = logging.getLogger(__name__)

_INJECT_NOTHING, _INJECT_HALF_SCALE = 0, 1
_HALF_SCALE_TOLERANCE = 1e-3  # relative
_SETTLING_S = 0.005  # of the injected test value, analog
_SETTLING_PERIODS = 5.0  # of the digital filter, in samples
_READ_SLICE_S = 0.05  # maximum delay until a stop is noticed
_ONLY_STREAMS_FROM_HZ = 24000.0  # from this rate the device may not answer commands


@dataclass(frozen=True, slots=True)
class HalfScale:
    """Result of one channel with the device's test value: half of its range is expected."""

    name: str
    measured: float
    expected: float
    unit: str

    @property
    def right(self) -> bool:
        """Return whether the value is within the tolerance."""
        return abs(self.measured - self.expected) <= _HALF_SCALE_TOLERANCE * abs(self.expected)


class Gsv8:
    """One GSV-8 on a serial line or USB; implements ``rigapp_drivers.api.DataSource``."""

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name = name
        self.port = port
        self._own_settings: dict[str, Any] = filled(SETTINGS, settings)
        self._settings = self._own_settings
        self._line = SerialPort(name, port, self._settings["baud_rate"])
        self._link = Link(self._line, self._settings["reply_timeout_s"])
        self._firmware = (0, 0)
        self._plan: Plan | None = None
        self._layout: FrameLayout | None = None
        self._blocks: BlockMaker | None = None
        self._watch: StreamWatch | None = None
        self._streaming = False

    def open(self) -> Identity:
        """Open the port, silence the device and identify it.

        Raises ConnectionFailed (port, or nothing answers) or WrongDevice.
        """
        return opened(self._line, self._identify)

    def configure(self, request: DataRequest) -> StreamSetup:
        """Set what differs, read everything back; raise SettingRefused."""
        self.stop()
        settings = {**self._own_settings, **request.settings}
        with refusing(self):
            plan = make_plan(request, settings)
        self._settings = settings
        self._link.reply_timeout_s = settings["reply_timeout_s"]
        self._link.expect(None)
        commissioner = Commissioner(self._link, self._firmware, settings["baud_rate"])
        self._layout = commissioner.set_up(plan)
        self._plan = plan
        return StreamSetup(plan.specs(), plan.sample_rate_Hz, commissioner.readback)

    def start(self) -> None:
        """Start streaming; sample index and block sequence restart at 0."""
        plan, layout = self._configured()
        if self._streaming:
            return
        self._link.expect(layout, hold=not layout.checksum)
        settings = self._settings
        self._blocks = BlockMaker(self.name, plan.sample_rate_Hz, plan.rows, settings["block_s"])
        known = Registers(self._link, self._firmware).latest_fault()
        self._link.command(Command.RESET_STATUS)
        self._link.command(Command.START_TRANSMISSION)
        self._watch = StreamWatch(
            self._link,
            settings["poll_interval_s"],
            settings["on_overrun"] == "stop",
            plan.sample_rate_Hz < _ONLY_STREAMS_FROM_HZ,
            self._blocks.flag_loss,
            self._blocks.flag_sensor,
            known,
        )
        self._streaming = True

    def read(self, timeout_s: float) -> Block | None:
        """Return the next Block, None on time-out.

        Raises DeviceLost, DataOverrun (``on_overrun = "stop"``), ProtocolError for other frame
        layouts, ReplyTimeout if the device streams but no longer answers.
        """
        blocks, watch = self._blocks, self._watch
        if blocks is None or watch is None:
            _idle(timeout_s)
            return None
        deadline = time.monotonic() + timeout_s
        while True:
            blocks.add(self._link.take())
            left = deadline - time.monotonic()
            if blocks.ready(time.monotonic_ns()) or left <= 0.0:
                break
            if not self._streaming:
                block = blocks.make()
                if block is None:
                    _idle(left)
                return block
            self._link.read(min(left, _READ_SLICE_S))
            if self._streaming:
                watch.step()
        block = blocks.make()
        if block is not None and np.bitwise_or.reduce(block.quality) & Quality.SATURATED:
            watch.saturated()
        return block

    def zero(self, inputs: Sequence[str]) -> None:
        """Zero inputs in the device, which stores the zero; raise SettingRefused."""
        registers = Registers(self._link, self._firmware)
        for name in inputs:
            channel = self._channel(name)
            if registers.zero_prohibited(channel):
                raise SettingRefused.at(
                    self,
                    "zeroing {} is prohibited in the device; allow it with the maker's program.",
                    name,
                )
            registers.set_zero(channel)
            _log.info("%s: %s was zeroed in the device", self.name, name)

    def half_scale(self) -> tuple[HalfScale, ...]:
        """Apply the device's test value to all analog channels and return the measured values.

        An end-to-end check of scales and object order, for commissioning; not while streaming.
        Raises SettingRefused or ReplyTimeout. The normal inputs are restored in any case.
        """
        plan, layout = self._configured()
        if self._streaming:
            raise SettingRefused.at(self, "the half-scale check needs the stream stopped first.")
        self._link.command(Command.SET_INJECTION, u8(_INJECT_HALF_SCALE))
        try:
            time.sleep(_SETTLING_S + _SETTLING_PERIODS / plan.sample_rate_Hz)
            values = self._link.one_frame(layout).values[:, 0]
        finally:
            self._link.command(Command.SET_INJECTION, u8(_INJECT_NOTHING))
            self._link.expect(None)
        results = []
        for spec, row in zip(plan.specs(), plan.rows, strict=True):
            family, number = parse_input(spec.name)
            if family == "analog":
                expected = p.NOMINAL_RANGE[plan.analog[number]] / 2.0
                measured = float(values[row]) * spec.scale + spec.offset
                results.append(HalfScale(spec.name, measured, expected, spec.unit))
        return tuple(results)

    def stop(self) -> None:
        """Stop streaming; safe to call twice. Samples received before can still be read."""
        if self._streaming:
            self._streaming = False
            self._link.command(Command.STOP_TRANSMISSION)

    def close(self) -> None:
        """Stop the stream, return the write access, release the port; never raises."""
        if not self._line.is_open:
            return
        # One try each: a device that hangs must not delay the end of a test.
        last_commands = []
        if self._layout is not None and self._layout.checksum:
            # Other programs expect no checksum.
            last_commands.append((Command.GET_INTERFACE, u8(1)))
        if self._streaming:
            last_commands.append((Command.STOP_TRANSMISSION, b""))
        self._streaming = False
        for command, parameters in (*last_commands, (Command.RELEASE_INTERFACE, b"")):
            with contextlib.suppress(DeviceError):
                self._link.exchange(command, parameters, tries=1)
        self._line.close()

    @property
    def tally(self) -> Tally:
        """Return the counts of line errors since the stream was started."""
        return self._link.tally

    def input_faults(self) -> tuple[InputFault, ...]:
        """Return the input faults reported since the start, oldest first."""
        return () if self._watch is None else self._watch.faults

    def counters(self) -> Mapping[str, int]:
        """Return the counters of the line since it was opened or the stream started."""
        tally = self._link.tally
        return {
            **byte_counters(self._line),
            "lost_samples": tally.lost_samples,
            "crc_errors": tally.checksum_failures,
            "resynchronisations": tally.resynchronisations,
            "dropped_bytes": tally.dropped_bytes,
            "foreign_frames": tally.foreign_frames,
            "device_overruns": 0 if self._watch is None else self._watch.losses,
            "retries": self._link.retries,
            "late_replies": self._link.late_replies,
        }

    def _identify(self) -> Identity:
        self._link.expect(None)
        self._link.checksum = False
        try:
            self._link.command(Command.STOP_TRANSMISSION)
        except ReplyTimeout as error:
            raise self._nothing_answers() from error
        self._line.drain()
        self._link.expect(None)
        reply = p.decode_interface(self._link.command(Command.GET_INTERFACE, u8(1), reply=4))
        if reply.model != p.MODEL_GSV8:
            raise WrongDevice.at(
                self,
                "another device than a GSV-8 answers; check the port in the rig file"
                " ‹model {}, not 08›.",
                f"{reply.model:02X}",
            )
        version = self._link.command(Command.FIRMWARE_VERSION, reply=4)
        self._firmware = p.decode_version(version)
        number = self._link.command(Command.GET_SERIAL_NUMBER, reply=4)
        options = self._link.command(Command.GET_SOFTWARE_CONFIGURATION, reply=4)
        details = {
            "options": joined(", ", p.software_options(int.from_bytes(options, "big"))),
            "interface": say("{} of {}", reply.number, reply.interfaces),
            "objects": str(reply.objects),
            "data_type": DataType(reply.data_type).name.lower(),
        }
        return identity_of("GSV-8", self._firmware, number, self.port, details)

    def _nothing_answers(self) -> DeviceError:
        rate = self._settings["baud_rate"]
        if self._link.tally.dropped_bytes:
            return WrongDevice.at(
                self,
                "something sends data, but not those of a GSV-8; check the port and, on"
                " a UART, baud_rate ({}).",
                rate,
            )
        return ConnectionFailed.at(
            self,
            "no answer; check power, cable and port and, on a UART, baud_rate ({}).",
            rate,
        )

    def _configured(self) -> tuple[Plan, FrameLayout]:
        if self._plan is None or self._layout is None:
            raise SettingRefused.at(self, "it was not configured before the start.")
        return self._plan, self._layout

    def _channel(self, name: str) -> int:
        """Return the device's channel number of an input; counters in use follow the eight."""
        with refusing(self):
            family, number = parse_input(name)
        if family == "analog":
            return number
        counters = sorted(self._plan.counters) if self._plan is not None else []
        if number - 1 not in counters:
            raise SettingRefused.at(self, "{} is not in use.", name)
        return p.ANALOG_CHANNELS + 1 + counters.index(number - 1)


def _idle(left_s: float) -> None:
    """Pause briefly, so that reading a stopped device is no busy loop."""
    time.sleep(min(max(left_s, 0.0), _READ_SLICE_S))


def check(request: DataRequest) -> None:
    """Raise InvalidRequest for what no such device supports; no port is opened."""
    make_plan(request, filled(SETTINGS, request.settings))


DRIVER = DriverInfo(
    name="gsv8",
    title=say("ME-Systeme GSV-8 measuring amplifier"),
    kind=DriverKind.DATA_SOURCE,
    factory=Gsv8,
    settings=SETTINGS,
    simulator="rigapp_drivers.gsv8.simulator:Gsv8Simulator",
    probe=PROBE,
    check=check,
    decoder=Decoder,
)
