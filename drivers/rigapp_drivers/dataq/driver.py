"""Acquire from a DATAQ DI-2108 or DI-4108: voltages, and scans clocked by the encoder.

Internal clock: the sample index is time; the counter row gives the angle.

Encoder clock (``clock = "encoder"``, ``start 2``): encoder line A on input D6 triggers one scan per
pulse. The sample index is then the angle: sample i is pulse i since the start, lost scans are
counted by the counter. ``StreamSetup.sample_rate_Hz`` is then nominal, the requested rate, and
sizes buffers. The time of a sample follows from the pulse rate if that is recorded
(``rate_range_Hz``, line A on the rate input as well), else from ``Block.host_time_ns`` only. With a
stationary shaft nothing is sent: the device is polled every ``idle_check_s``, and its reply is
reported as a Block without samples.

The device's counter counts one edge of one input regardless of direction: it also counts up when
the shaft turns back. Counts per revolution are the encoder's lines, not its edges after quadrature.
With the encoder clock, lines B and Z on digital inputs (``direction_line``, ``index_line``) give
direction and index, see ``stream.CountDirection``; with the internal clock there is neither.

Inputs of a DI-4108: rate D2, counter D3; D6 is the external scan clock only. All digital lines are
set to input, as a switching output would short the encoder.

Assumed until commissioning: that a DI-2108 has the same inputs, the edge that is used, the smallest
pulse width, the highest pulse rate, that a DI-4108 accepts ``start 2`` as a DI-2108 does, and that
the counter continues while the device does not scan.
"""

from __future__ import annotations

import contextlib
import logging
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

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
    ProtocolError,
    ReplyTimeout,
    SampleClock,
    SettingRefused,
    StreamSetup,
    WrongDevice,
    filled,
    refusing,
)
from rigapp_drivers.dataq import protocol as p
from rigapp_drivers.dataq.link import PROBE, Link, identity_of, version_words
from rigapp_drivers.dataq.plan import Plan, make_plan
from rigapp_drivers.dataq.protocol import Clock, Decoder, Info
from rigapp_drivers.dataq.settings import SETTINGS
from rigapp_drivers.dataq.stream import Pace, Stream, Tally
from rigapp_drivers.transport import SerialPort, byte_counters, opened

_log = logging.getLogger(__name__)

_USB_VENDOR: Final = 0x0683
_BAUD_RATE: Final = 115200  # no effect on USB


class Dataq:
    """One DI-2108 or DI-4108 in CDC mode; implements ``rigapp_drivers.api.DataSource``."""

    def __init__(self, name: str, port: str, settings: Mapping[str, Any]) -> None:
        self.name = name
        self.port = port
        self._settings: dict[str, Any] = filled(SETTINGS, settings)
        self._line = SerialPort(name, port, _BAUD_RATE)
        self._link = Link(
            self._line, self._settings["reply_timeout_s"], self._settings["command_pause_s"]
        )
        self._model = 0
        self._firmware = 0
        self._master_clock = ""
        self._plan: Plan | None = None
        self._rate = ""
        self._stream: Stream | None = None

    def open(self) -> Identity:
        """Open the port, stop scanning and identify the device.

        Raises ConnectionFailed (port, or nothing answers) or WrongDevice.
        """
        return opened(self._line, self._identify)

    def configure(self, request: DataRequest) -> StreamSetup:
        """Send all settings and check every echo; raise SettingRefused."""
        self.stop()
        settings = {**self._settings, **request.settings}
        with refusing(self):
            plan = make_plan(request, settings)
        self._check_model(settings["model"])
        self._settings = settings
        self._link.reply_timeout_s = settings["reply_timeout_s"]
        self._link.pause_s = settings["command_pause_s"]
        self._rest()
        for command in plan.commands(end_list=settings["end_scan_list"]):
            self._link.set(command)
        self._line.drain()
        self._rate = self._reported_rate()
        self._plan = plan
        self._stream = None
        clock = SampleClock.ENCODER if plan.clock is Clock.ENCODER else SampleClock.TIME
        return StreamSetup(plan.channels, plan.sample_rate_Hz, self._readback(plan), clock)

    def start(self) -> None:
        """Start streaming; sample index, block sequence and counter restart at 0."""
        if self._plan is None:
            raise SettingRefused.at(self, "it was not configured before the start.")
        if self._stream is not None and self._stream.running:
            return
        settings = self._settings
        pace = Pace(settings["block_s"], settings["silence_s"], settings["idle_check_s"])
        self._rest()
        stream = Stream(self._link, self._plan, pace, self._rate)
        stream.start()
        self._stream = stream

    def read(self, timeout_s: float) -> Block | None:
        """Return the next Block, None on time-out.

        Raises DeviceLost (port, hang, reset) or ProtocolError (repeated failures of the counter
        check).
        """
        return None if self._stream is None else self._stream.read(timeout_s)

    def zero(self, inputs: Sequence[str]) -> None:
        """Refuse: the device cannot zero its inputs."""
        raise SettingRefused.at(
            self,
            "it cannot zero {} itself; the zero belongs to the calibration.",
            joined(", ", inputs),
        )

    def stop(self) -> None:
        """Stop streaming; safe to call twice. Samples received before can still be read."""
        if self._stream is not None:
            self._stream.stop()

    def close(self) -> None:
        """Stop the stream and release the port; never raises."""
        if not self._line.is_open:
            return
        with contextlib.suppress(DeviceError):
            self.stop()
        self._line.close()

    @property
    def tally(self) -> Tally:
        """Return the counts of errors since the stream was started."""
        return Tally() if self._stream is None else self._stream.tally

    def input_faults(self) -> tuple[InputFault, ...]:
        """Return inputs with a constant value while the shaft turned, since the start."""
        return self.tally.faults

    def counters(self) -> Mapping[str, int]:
        """Return the counters of the line since it was opened or the stream started."""
        tally = self.tally
        return {
            **byte_counters(self._line),
            "lost_samples": tally.lost_scans,
            "gaps": tally.gaps,
            "restarts": tally.restarts,
            "retries": self._link.retries,
        }

    # --- set-up ---------------------------------------------------------------------------------

    def _rest(self) -> None:
        """Stop scanning from any state; raise ConnectionFailed, WrongDevice."""
        for _ in range(2):
            data = self._link.stop()
            if data is not None:
                return
        if self._link.heard:
            raise WrongDevice.at(
                self,
                "something sends data, but does not answer stop as a DATAQ instrument"
                " does; check the port in the rig file, and switch the device off and"
                " on.",
            )
        raise ConnectionFailed.at(
            self,
            (
                "no answer to stop; check power and cable, and that the LED blinks yellow (CDC"
                " mode)."
            ),
        )

    def _reported_rate(self) -> str:
        """Return the rate reported by the device, empty if its firmware does not report it."""
        try:
            return self._link.rate(tries=1)
        except (ReplyTimeout, ProtocolError):
            self._line.drain()
            return ""

    def _identify(self) -> Identity:
        self._rest()
        model = self._link.query(Info.MODEL)
        digits = re.sub(r"\D", "", model)
        self._model = int(digits) if digits else 0
        self._check_model(self._settings["model"])
        self._master_clock = self._link.query(Info.MASTER_CLOCK)
        firmware = self._link.query(Info.FIRMWARE)
        self._firmware = int(firmware, 16) if re.fullmatch(r"[0-9A-Fa-f]+", firmware) else 0
        for advice in self._advice().values():
            _log.warning("%s on %s: %s", self.name, self.port, advice)
        serial = self._link.query(Info.SERIAL_NUMBER)
        known = identity_of(str(self._model), firmware, serial, self.port)
        return replace(known, details=self._advice())

    def _check_model(self, required: int) -> None:
        if self._model == required:
            return
        advice = (
            say("set model = {} in the rig file", self._model)
            if self._model in p.MODELS
            else say("check the port in the rig file")
        )
        raise WrongDevice.at(
            self, "a DI-{} answers, and the rig file says DI-{}; {}.", self._model, required, advice
        )

    def _advice(self) -> dict[str, str]:
        """Return advice on this device, as item of a readback."""
        advice = []
        if 0 < self._firmware < p.ADVISED_FIRMWARE:
            advice.append(
                say(
                    "firmware {} is known to fail in binary mode and at high rates; load {}"
                    " or newer.",
                    version_words(self._firmware),
                    version_words(p.ADVISED_FIRMWARE),
                )
            )
        if self._master_clock != str(p.MASTER_CLOCK_HZ):
            advice.append(
                say(
                    (
                        "it reports that its scan rates divide {} Hz, where {} Hz is known:"
                        " compare its sample rate with a clock."
                    ),
                    self._master_clock,
                    p.MASTER_CLOCK_HZ,
                )
            )
        return {"advice": joined(" ", advice)} if advice else {}

    def _readback(self, plan: Plan) -> dict[str, str | float | int]:
        encoder = plan.clock is Clock.ENCODER
        return {
            "model": plan.model.name,
            "clock": plan.clock.value,
            "srate": plan.rate.srate,
            "dec": plan.rate.dec,
            "deca": plan.rate.deca,
            "sample_rate_Hz": plan.sample_rate_Hz,
            "sample_index": say("pulse of the encoder; sample_rate_Hz is nominal")
            if encoder
            else say("scan of the internal clock"),
            "scan_list": " ".join(str(word) for word in plan.scan_list),
            "filter": plan.filter_mode,
            "packet_bytes": p.PACKET_SIZES[plan.packet_code],
            "counter": _counter_words(plan),
            "wiring": plan.wiring,
            "pulses_per_revolution": plan.pulses_per_revolution,
            "largest_counter_step": plan.steps.highest,
            "odds_of_unseen_byte_loss_per_scan": plan.steps.odds,
            "assumed": say(
                "the counter counts on while the device does not scan; the pulse edge,"
                " width and highest rate on {}",
                p.CLOCK_LINE,
            ),
            **self._advice(),
        }


def _counter_words(plan: Plan) -> str:
    lines = {"direction": plan.direction_line, "index": plan.index_line}
    known = [name for name, line in lines.items() if line is not None]
    missing = [name for name, line in lines.items() if line is None]
    words = [say("16 bit, pulses of one input edge")]
    words += [say("with {} by digital lines", joined(say(" and "), known))] if known else []
    words += [say("without {}", joined(say(" or "), missing))] if missing else []
    return joined(", ", words)


def check(request: DataRequest) -> None:
    """Raise InvalidRequest for what no such device supports; no port is opened."""
    make_plan(request, filled(SETTINGS, request.settings))


DRIVER = DriverInfo(
    name="dataq",
    title=say("DATAQ DI-2108 or DI-4108 data acquisition"),
    kind=DriverKind.DATA_SOURCE,
    factory=Dataq,
    settings=SETTINGS,
    simulator="rigapp_drivers.dataq.simulator:DataqSimulator",
    usb_ids=((_USB_VENDOR, None),),
    probe=PROBE,
    check=check,
    decoder=Decoder,
)
