"""Identify a RoboClaw, set it up for a run, and read everything back."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Final

from rigapp.texts import joined, say
from rigapp_drivers.api import (
    ConnectionFailed,
    DriveRequest,
    Identity,
    InvalidRequest,
    ProtocolError,
    ReplyTimeout,
    SettingRefused,
    WrongDevice,
)
from rigapp_drivers.roboclaw.link import Link
from rigapp_drivers.roboclaw.probe import identity_of
from rigapp_drivers.roboclaw.protocol import (
    CURRENT_UNIT_A,
    MAXIMUM_DUTY,
    MAXIMUM_DUTY_ACCELERATION,
    TIMEOUT_UNIT_S,
    VOLTAGE_UNIT_V,
    Command,
    Generation,
    velocity_pid_of,
)
from rigapp_drivers.roboclaw.readings import can_combine
from rigapp_drivers.roboclaw.status import generation_of

_MAXIMUM_TIMEOUT: Final = 255  # one byte
_BOTH_WIDTHS: Final = 16 + 32
_TWICE: Final = 2  # tries of an optional command; one lost reply must not make it seem missing
_LONGEST_POWER_OFF_S: Final = 0.1
"""Longest duty ramp that counts as an immediate power-off: 36 deg of a crank at 60 rpm."""
_S3_WORDS: Final[Mapping[int, str]] = {
    0x00: say("emergency stop, latching (default)"),
    0x01: say("emergency stop"),
    0x81: say("emergency stop, latching"),
}
_S3_WORDS_OLDER: Final[Mapping[int, str]] = {
    0: say("emergency stop, latching (default)"),
    1: say("emergency stop, latching"),
    2: say("emergency stop"),
}


@dataclass(frozen=True, slots=True)
class Setup:
    """Set-up of the drive for this run; watchdog in units of the wire, qpps in counts/s."""

    request: DriveRequest
    watchdog_units: int
    combined: bool
    qpps: int
    readback: Mapping[str, str | float | int]

    @property
    def watchdog_s(self) -> float:
        """Return the serial time-out in s."""
        return self.watchdog_units * TIMEOUT_UNIT_S


def identify(link: Link, status_width: str) -> Identity:
    """Return the drive's identity and set the link's packet layouts; no setting is changed.

    Raises ConnectionFailed if nothing answers, WrongDevice if another device does.
    """
    try:
        text = link.version()
    except ReplyTimeout as error:
        raise ConnectionFailed.at(
            link, "no RoboClaw answers at address {}: {}", link.address, error.sentence
        ) from error
    except ProtocolError as error:
        raise WrongDevice.at(
            link, "what answers is no RoboClaw at address {}: {}", link.address, error.sentence
        ) from error
    if not text.strip():
        raise WrongDevice.at(link, "the firmware text is empty.")
    link.generation = _generation(link, text, status_width)
    details = {"status_bits": str(link.generation.status_bits)}
    return identity_of(text, link.port, link.address, details)


def _generation(link: Link, firmware: str, status_width: str) -> Generation:
    """Return the packet layouts: from the setting, or from the text and verified by a reply."""
    announced = generation_of(firmware)
    if status_width != "auto":
        return replace(announced, status_bits=int(status_width))
    for status_bits in (announced.status_bits, _BOTH_WIDTHS - announced.status_bits):
        link.generation = replace(announced, status_bits=status_bits)
        try:
            link.read(Command.STATUS)
        except (ProtocolError, ReplyTimeout):
            continue
        link.crc_errors = link.retries = link.late_bytes = 0
        return link.generation
    raise WrongDevice.at(
        link,
        'the status of firmware "{}" has neither 16 nor 32 bits; set status_width from'
        " the drive's manual.",
        firmware,
    )


def commission(link: Link, request: DriveRequest, motor: int, combined: bool) -> Setup:
    """Set the serial time-out and the duty ramp, and read back all settings used in the run.

    combined: use command 73 if the drive has it. Raises SettingRefused if one of the two is not
    read back as set, ReplyTimeout, ProtocolError, DeviceLost.
    """
    units = _watchdog_units(request)
    _set_watchdog(link, units)
    power_off, input_S3 = _power_off(link, motor), _emergency_stop_input(link)
    advice = joined(" ", filter(None, (power_off.pop("advice", ""), input_S3.pop("advice", ""))))
    combined = combined and can_combine(link)
    pid = velocity_pid_of(link.read(Command.VELOCITY_PID_M1 + motor - 1))
    (main,) = link.read(Command.MAIN_VOLTAGE)
    (logic,) = link.read(Command.LOGIC_VOLTAGE)
    modes = link.read(Command.ENCODER_MODES)
    current, _ = link.read(Command.CURRENT_LIMIT_M1 + motor - 1)
    readback: dict[str, str | float | int] = {
        "watchdog_timeout_s": round(units * TIMEOUT_UNIT_S, 1),
        "status_bits": link.generation.status_bits,
        "combined_status": int(combined),
        "encoder_mode": modes[motor - 1],
        "current_limit_A": current * CURRENT_UNIT_A,
        "supply_V": main * VOLTAGE_UNIT_V,
        "logic_V": logic * VOLTAGE_UNIT_V,
        "counts_per_revolution": request.counts_per_revolution,
        "gear_ratio": request.gear_ratio,
        "direction": request.direction,
        "velocity_p": pid.p,
        "velocity_i": pid.i,
        "velocity_d": pid.d,
        "speed_limit_count_per_s": pid.qpps,
        "speed_limit_rev_per_s": pid.qpps / request.counts_per_crank_revolution,
        **power_off,
        **input_S3,
        "wiring": say(
            "power off in {}, input S3: {}", power_off["power_off_ramp"], input_S3["input_S3"]
        ),
    }
    if link.late_words:
        advice = joined(" ", filter(None, (advice, say("Its {}.", link.late_words))))
    if advice:
        readback["advice"] = advice
    return Setup(request, units, combined, pid.qpps, readback)


def _power_off(link: Link, motor: int) -> dict[str, str]:
    """Set the duty ramp so that duty 0 removes the power at once; return its duration as readback.

    Duty commands follow a ramp stored in the drive (commands 68, 69 and 81). This program does not
    use it otherwise, and does not save it. Raises SettingRefused if the drive keeps a ramp that is
    too long.
    """
    try:
        acceleration = link.read(Command.DUTY_ACCELERATIONS, _TWICE)[motor - 1]
        if acceleration < MAXIMUM_DUTY_ACCELERATION:
            link.write(Command.SET_DUTY_ACCELERATION_M1 + motor - 1, MAXIMUM_DUTY_ACCELERATION)
            acceleration = link.read(Command.DUTY_ACCELERATIONS)[motor - 1]
    except ReplyTimeout:
        link.read(Command.STATUS)  # a drive that answers this is not silent: it lacks the command
        return {
            "power_off_ramp": say("an unknown time"),
            "advice": say(
                "This firmware does not report how fast it removes the power: watch it at"
                " the first stop."
            ),
        }
    ramp_s = MAXIMUM_DUTY / acceleration if acceleration else math.inf
    if ramp_s > _LONGEST_POWER_OFF_S:
        raise SettingRefused.at(
            link,
            (
                "switching the power off is a ramp of {:.2g} s; set the default duty"
                " acceleration of motor {} to {} with the maker's tool."
            ),
            ramp_s,
            motor,
            MAXIMUM_DUTY_ACCELERATION,
        )
    return {"power_off_ramp": f"{ramp_s:.2f} s"}


def _emergency_stop_input(link: Link) -> dict[str, str]:
    """Return the function of input S3, with a recommendation if it is no emergency stop."""
    try:
        mode = link.read(Command.PIN_FUNCTIONS, _TWICE)[0]
    except (ReplyTimeout, ProtocolError):
        link.read(Command.STATUS)
        return {
            "input_S3": "unknown",
            "advice": say(
                "The function of the drive's input S3 is unknown: press the emergency stop"
                " before the first test."
            ),
        }
    words = (_S3_WORDS if link.generation.pin_modes == 5 else _S3_WORDS_OLDER).get(mode)
    if words is not None:
        return {"input_S3": words}
    return {
        "input_S3": say("mode {}", f"{mode:02X}"),
        "advice": say(
            "Input S3 is not set to emergency stop: a button on it has no effect. Set it"
            " with the maker's tool."
        ),
    }


def check_watchdog(request: DriveRequest) -> None:
    """Raise InvalidRequest for a time-out outside the range of a RoboClaw."""
    if not 1 <= _watchdog_units(request) <= _MAXIMUM_TIMEOUT:
        raise InvalidRequest(
            "a watchdog time-out of {:g} s is outside 0.1 to 25.5 s.", request.watchdog_timeout_s
        )


def _watchdog_units(request: DriveRequest) -> int:
    """Return the time-out in units of the wire, rounded down to the safe side."""
    return math.floor(request.watchdog_timeout_s / TIMEOUT_UNIT_S + 1e-9)


def _set_watchdog(link: Link, units: int) -> None:
    def in_effect() -> bool:
        return link.read(Command.GET_TIMEOUT) == (units,)

    try:
        link.write(Command.SET_TIMEOUT, units, in_effect=in_effect)
        (readback,) = link.read(Command.GET_TIMEOUT)
    except ReplyTimeout as error:
        link.read(Command.STATUS)  # a drive that answers this is not silent: it lacks the command
        raise SettingRefused.at(
            link,
            "this firmware has no watchdog: it does not answer SET_TIMEOUT and"
            " GET_TIMEOUT ({:d}, {:d}), and the spindle must not turn without one;"
            " update the drive's firmware.",
            Command.SET_TIMEOUT,
            Command.GET_TIMEOUT,
        ) from error
    if readback != units:
        raise SettingRefused.at(
            link,
            "the serial time-out reads {:.1f} s after {:.1f} s was set; the spindle"
            " must not turn without it.",
            readback * TIMEOUT_UNIT_S,
            units * TIMEOUT_UNIT_S,
        )
