"""CiA 402 over CANopen: encode and decode numbers, without any input or output.

Sources: CiA 301 (COB-IDs, NMT, emergencies), CiA 402 (state machine, objects, unit notation), the
EPOS firmware specification (error codes) and the EPOS4 object dictionary (objects 2xxx and 3xxx).
"""

from __future__ import annotations

import enum
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from rigapp.texts import say

PROFILE_402: Final = 0x0192
VENDOR_MAXON: Final = 0x0000_00FB
PROFILE_VELOCITY: Final = 3
PROFILE_VELOCITY_BIT: Final = 1 << 2

NMT_ID: Final = 0x000
SYNC_ID: Final = 0x080
EMERGENCY_BASE: Final = 0x080
RPDO1_BASE: Final = 0x200
SDO_REQUEST_BASE: Final = 0x600
SDO_REPLY_BASE: Final = 0x580
HEARTBEAT_BASE: Final = 0x700
TPDO_BASES: Final = (0x180, 0x280, 0x380, 0x480)

PDO_INVALID: Final = 1 << 31
COB_MASK: Final = 0x7FF
SYNCHRONOUS: Final = 1


class Nmt(enum.IntEnum):
    """Commands of network management."""

    START = 0x01
    STOP = 0x02
    PRE_OPERATIONAL = 0x80
    RESET_NODE = 0x81
    RESET_COMMUNICATION = 0x82


class NodeState(enum.IntEnum):
    """States reported by a heartbeat; 0 is the boot-up message."""

    BOOT_UP = 0x00
    STOPPED = 0x04
    OPERATIONAL = 0x05
    PRE_OPERATIONAL = 0x7F


class State(enum.StrEnum):
    """States of the drive's state machine."""

    NOT_READY = "not ready to switch on"
    SWITCH_ON_DISABLED = "switch on disabled"
    READY = "ready to switch on"
    SWITCHED_ON = "switched on"
    ENABLED = "operation enabled"
    QUICK_STOP = "quick stop active"
    FAULT_REACTION = "fault reaction active"
    FAULT = "fault"


class Control(enum.IntEnum):
    """Control words of object 6040."""

    DISABLE_VOLTAGE = 0x00
    QUICK_STOP = 0x02
    SHUTDOWN = 0x06
    SWITCH_ON = 0x07
    ENABLE = 0x0F
    FAULT_RESET = 0x80


_STATES: Final[tuple[tuple[int, int, State], ...]] = (
    (0x4F, 0x00, State.NOT_READY),
    (0x4F, 0x40, State.SWITCH_ON_DISABLED),
    (0x6F, 0x21, State.READY),
    (0x6F, 0x23, State.SWITCHED_ON),
    (0x6F, 0x27, State.ENABLED),
    (0x6F, 0x07, State.QUICK_STOP),
    (0x4F, 0x0F, State.FAULT_REACTION),
    (0x4F, 0x08, State.FAULT),
)

_STEP_UP: Final[Mapping[State, Control]] = {
    State.SWITCH_ON_DISABLED: Control.SHUTDOWN,
    State.READY: Control.SWITCH_ON,
    State.SWITCHED_ON: Control.ENABLE,
    State.QUICK_STOP: Control.DISABLE_VOLTAGE,
}

WARNING_BIT: Final = 1 << 7
TARGET_REACHED_BIT: Final = 1 << 10
INTERNAL_LIMIT_BIT: Final = 1 << 11
STANDSTILL_BIT: Final = 1 << 12


def state_of(status_word: int) -> State | None:
    """Return the state encoded by a status word (6041), None for an undefined pattern."""
    for mask, value, state in _STATES:
        if status_word & mask == value:
            return state
    return None


def step_towards_enabled(state: State | None) -> Control | None:
    """Return the control word of the next step towards operation enabled; None: no such step."""
    return None if state is None else _STEP_UP.get(state)


# --- units ----------------------------------------------------------------------------------------

RPM: Final = 0x00B4_4700
MILLI_RPM: Final = 0xFDB4_4700
_REVOLUTIONS: Final = 0xB4
_PER_TIME_S: Final[Mapping[int, float]] = {0x03: 1.0, 0x47: 60.0}


def velocity_unit_rev_per_s(unit: int) -> float | None:
    """Return rev/s per step of a velocity unit (60A9), None if it is unknown.

    Bits 31..24 are the signed power of ten, 23..16 the numerator (B4 revolutions), 15..8 the
    denominator (03 second, 47 minute).
    """
    power, numerator, denominator, rest = struct.unpack(">bBBB", struct.pack(">I", unit))
    if numerator != _REVOLUTIONS or denominator not in _PER_TIME_S or rest != 0:
        return None
    return float(10.0**power) / _PER_TIME_S[denominator]


# --- emergencies ----------------------------------------------------------------------------------

_EPOS_CODES: Final[Mapping[int, str]] = {
    0x1000: say("generic error"),
    0x2310: say("over-current"),
    0x3210: say("over-voltage"),
    0x3220: say("under-voltage"),
    0x4210: say("over-temperature"),
    0x5113: say("5 V supply low"),
    0x6100: say("internal software error"),
    0x6320: say("wrong parameter"),
    0x7320: say("position sensor error"),
    0x8110: say("CAN overrun"),
    0x8111: say("CAN overrun"),
    0x8120: say("CAN error passive"),
    0x8130: say("heartbeat of the host lost"),
    0x8150: say("two senders use one identifier"),
    0x81FD: say("CAN bus off"),
    0x81FE: say("CAN receive queue overrun"),
    0x81FF: say("CAN transmit queue overrun"),
    0x8210: say("a message of a wrong length"),
    0x8611: say("following error"),
    0xFF0B: say("overload"),
}

_CLASSES: Final[Mapping[int, str]] = {
    0x1: say("generic error"),
    0x2: say("current"),
    0x3: say("voltage"),
    0x4: say("temperature"),
    0x5: say("hardware"),
    0x6: say("software"),
    0x7: say("additional modules or sensors"),
    0x8: say("communication or monitoring"),
    0x9: say("external error"),
    0xF: say("specific to the drive"),
}


def describe_code(code: int | None) -> str:
    """Return an error code (603F, emergency) in words, always with its number; None: no code.

    The texts of known codes are those of the EPOS1 generation and are marked so; an unknown code
    gets the text of its class (CiA 301).
    """
    if code is None:
        return say("a fault of which it gives no code")
    if code in _EPOS_CODES:
        return say("{} ‹EPOS1, error {}›", _EPOS_CODES[code], f"{code:04X}")
    if 0xFF01 <= code <= 0xFF0A:
        return say("Hall sensor or encoder ‹EPOS1, error {}›", f"{code:04X}")
    return say("{} ‹error {}›", _CLASSES.get(code >> 12, say("unknown error")), f"{code:04X}")


@dataclass(frozen=True, slots=True)
class Emergency:
    """One emergency message; code 0 means that the errors have ended."""

    host_time_ns: int
    code: int
    register: int
    details: bytes

    @property
    def words(self) -> str:
        """Return the message in words."""
        return describe_code(self.code) if self.code else say("errors are gone")


def parse_emergency(data: bytes, host_time_ns: int) -> Emergency | None:
    """Return an emergency message, None if the frame is too short."""
    if len(data) < 3:
        return None
    code, register = struct.unpack_from("<HB", data)
    return Emergency(host_time_ns, code, register, bytes(data[3:]))


# --- PDOs -----------------------------------------------------------------------------------------


def mapping_entry(index: int, subindex: int, bits: int) -> int:
    """Return the mapping parameter of an object: index, sub-index, length in bits."""
    return index << 16 | subindex << 8 | bits


STATUS_AND_POSITION: Final = (mapping_entry(0x6041, 0, 16), mapping_entry(0x6064, 0, 32))
STATUS_AND_VELOCITY: Final = (mapping_entry(0x6041, 0, 16), mapping_entry(0x606C, 0, 32))


def parse_status_and_value(data: bytes) -> tuple[int, int] | None:
    """Return status word and signed 32-bit value of a TPDO, None if its length is wrong."""
    if len(data) != 6:
        return None
    status_word, value = struct.unpack("<Hi", data)
    return status_word, value


def parse_status(data: bytes) -> int | None:
    """Return the status word at the beginning of a TPDO, None if it is too short."""
    return int.from_bytes(data[:2], "little") if len(data) >= 2 else None


def consumer_heartbeat(node_id: int, milliseconds: int) -> int:
    """Return the value of 1016 that supervises a node's heartbeat."""
    return node_id << 16 | milliseconds
