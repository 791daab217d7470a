"""RoboClaw status bits (command 90) in words, for both firmware generations.

The newer firmware sends 32 bits, errors below and warnings above bit 16; the older one sends 16
bits with another map. An error bit without a name is still a fault. Source: RoboClaw user manual
(read status) and the manufacturer's library, which differ from bit 14 and from bit 24 upward.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from rigapp.texts import say
from rigapp_drivers.roboclaw.protocol import NEWER, OLDER, Generation

EMERGENCY_STOP: Final = say("emergency stop")

_ERRORS_32: Final[Mapping[int, str]] = {
    0: EMERGENCY_STOP,
    1: say("over-temperature 1"),
    2: say("over-temperature 2"),
    3: say("main voltage high"),
    4: say("logic voltage high"),
    5: say("logic voltage low"),
    6: say("driver fault M1"),
    7: say("driver fault M2"),
    8: say("speed error M1"),
    9: say("speed error M2"),
    10: say("position error M1"),
    11: say("position error M2"),
    12: say("current error M1"),
    13: say("current error M2"),
    14: say("main voltage low"),
    15: say("main voltage high (until it has fallen again)"),
}

_WARNINGS_32: Final[Mapping[int, str]] = {
    16: say("over-current M1"),
    17: say("over-current M2"),
    18: say("main voltage high"),
    19: say("main voltage low"),
    20: say("temperature 1 high"),
    21: say("temperature 2 high"),
    22: say("input S4 active"),
    23: say("input S5 active"),
    24: say("warning of speed ‹bit 24›"),
    25: say("warning of position, or speed M2 ‹bit 25›"),
    26: say("warning of position M1 ‹bit 26›"),
    27: say("warning of position M2 ‹bit 27›"),
    28: say("warning of CAN ‹bit 28›"),
    29: say("warning of boot ‹bit 29›"),
    30: say("warning of over-regeneration M1 ‹bit 30›"),
    31: say("warning of over-regeneration M2 ‹bit 31›"),
}

_ERRORS_16: Final[Mapping[int, str]] = {
    2: EMERGENCY_STOP,
    3: say("over-temperature 1"),
    4: say("over-temperature 2"),
    5: say("main voltage high"),
    6: say("logic voltage high"),
    7: say("logic voltage low"),
    8: say("driver fault M1"),
    9: say("driver fault M2"),
}

_WARNINGS_16: Final[Mapping[int, str]] = {
    0: say("over-current M1"),
    1: say("over-current M2"),
    10: say("main voltage high"),
    11: say("main voltage low"),
    12: say("temperature 1 high"),
    13: say("temperature 2 high"),
    14: say("home input M1 active"),
    15: say("home input M2 active"),
}

_VERSION: Final = re.compile(r"v(\d+)\.(\d+)(?:\.(\d+))?")
_FIRST_32_BIT: Final = (4, 2)


@dataclass(frozen=True, slots=True)
class StatusWords:
    """Faults and warnings of a status word, in words."""

    emergency_stop: bool
    faults: tuple[str, ...]
    warnings: tuple[str, ...]


def describe_status(state: int, status_bits: int) -> StatusWords:
    """Return faults and warnings of a status word of 16 or 32 bits."""
    errors, warnings = (
        (_ERRORS_32, _WARNINGS_32) if status_bits == 32 else (_ERRORS_16, _WARNINGS_16)
    )
    faults: list[str] = []
    notes: list[str] = []
    for bit in range(status_bits):
        if not state >> bit & 1:
            continue
        if bit in warnings:
            notes.append(warnings[bit])
        else:
            faults.append(errors.get(bit, say("unknown error bit {}", bit)))
    return StatusWords(EMERGENCY_STOP in faults, tuple(faults), tuple(notes))


def generation_of(firmware: str) -> Generation:
    """Return the packet layouts for a firmware text.

    Firmware from 4.2, or with an unreadable text, is assumed to be the newer generation: the driver
    verifies the width by the CRC of a first reply, and a setting overrides both.
    """
    version = _VERSION.search(firmware)
    if version is None:
        return NEWER
    return NEWER if (int(version[1]), int(version[2])) >= _FIRST_32_BIT else OLDER
