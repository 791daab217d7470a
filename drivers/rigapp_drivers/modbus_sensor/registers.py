"""Map registers of a device to quantities and convert their words to numbers; pure."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Annotated, Any, Final, Literal

import msgspec

from rigapp_drivers.api import InvalidRequest

MOST_WORDS: Final = 125
"""Maximum registers per request (Modbus application protocol 1.1b3, 6.3 and 6.4)."""
_FORMATS: Final = {"i16": ">h", "u16": ">H", "i32": ">i", "f32": ">f"}


class Register(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """One entry of the setting ``registers``: value = scale * number + offset.

    quantity: name with the unit at the end, as ``temperature_C``. function: 3 reads holding, 4
    input registers. address: as transmitted, from 0. words: order of the two words of a number.
    invalid: the number that means no value; returned as NaN.
    """

    quantity: Annotated[str, msgspec.Meta(pattern=r"^[a-z][a-z0-9_]*_[A-Za-z0-9]+$")]
    function: Literal[3, 4] = 4
    address: Annotated[int, msgspec.Meta(ge=0, le=0xFFFF)]
    type: Literal["i16", "u16", "i32", "f32"] = "i16"
    scale: float = 1.0
    offset: float = 0.0
    words: Literal["high first", "low first"] = "high first"
    invalid: int | None = None

    @property
    def count(self) -> int:
        """Return its number of words."""
        return struct.calcsize(_FORMATS[self.type]) // 2

    def value(self, words: Sequence[int]) -> float:
        """Return the quantity encoded by the words."""
        ordered = words if self.words == "high first" else words[::-1]
        (number,) = struct.unpack(_FORMATS[self.type], struct.pack(f">{len(words)}H", *ordered))
        return math.nan if number == self.invalid else self.scale * float(number) + self.offset

    def encode(self, value: float) -> tuple[int, ...]:
        """Return the words that encode a quantity, rounded to the nearest step."""
        layout = _FORMATS[self.type]
        number: float = (value - self.offset) / self.scale
        if self.type != "f32":
            bits = 16 * self.count
            low, high = (
                (-(1 << bits - 1), (1 << bits - 1) - 1) if self.type[0] == "i" else (0, 65535)
            )
            number = max(low, min(high, round(number)))
        words = struct.unpack(f">{self.count}H", struct.pack(layout, number))
        return words if self.words == "high first" else words[::-1]


PRESETS: Final[Mapping[str, tuple[Register, ...]]] = {
    "SHT20": (
        Register(quantity="temperature_C", address=1, scale=0.1),
        Register(quantity="humidity_percent", address=2, type="u16", scale=0.1),
    ),
}
"""Sensor -> registers of transmitters sold under many names; 9600 baud, 8N1."""
OWN: Final = "own registers"


def registers_of(settings: Mapping[str, Any]) -> tuple[Register, ...]:
    """Return the registers of the settings; raise InvalidRequest."""
    own = settings["registers"]
    if settings["preset"] != OWN:
        if own:
            raise InvalidRequest('registers are given: write preset = "{}", or take them out.', OWN)
        return PRESETS[settings["preset"]]
    if not own:
        raise InvalidRequest('preset = "{}" needs at least one entry in registers.', OWN)
    registers = []
    for number, table in enumerate(own, start=1):
        try:
            register = msgspec.convert(table, Register)
        except msgspec.ValidationError as error:
            raise InvalidRequest("registers, entry {}: {}.", number, error) from error
        if not (math.isfinite(register.scale) and register.scale != 0.0):
            raise InvalidRequest(
                "registers, entry {}: scale = {:g} gives no value.", number, register.scale
            )
        registers.append(register)
    names = [register.quantity for register in registers]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InvalidRequest("registers name the quantity {} twice.", twice)
    return tuple(registers)


class Question(msgspec.Struct, frozen=True):
    """One request: adjacent registers of one kind."""

    function: int
    address: int
    registers: tuple[Register, ...]

    @property
    def count(self) -> int:
        """Return the number of requested words."""
        last = self.registers[-1]
        return last.address + last.count - self.address

    def values(self, words: Sequence[int]) -> dict[str, float]:
        """Return the quantities in the words of its reply."""
        return {
            register.quantity: register.value(
                words[register.address - self.address :][: register.count]
            )
            for register in self.registers
        }


def questions(registers: Sequence[Register]) -> tuple[Question, ...]:
    """Return the fewest requests for registers; adjacent ones only, as gaps may not be readable."""
    ordered = sorted(registers, key=lambda register: (register.function, register.address))
    groups: list[list[Register]] = [[register] for register in ordered[:1]]
    for before, register in pairwise(ordered):
        near = (
            register.function == before.function
            and register.address == before.address + before.count
        )
        if near and register.address + register.count - groups[-1][0].address <= MOST_WORDS:
            groups[-1].append(register)
        else:
            groups.append([register])
    return tuple(Question(g[0].function, g[0].address, tuple(g)) for g in groups)
