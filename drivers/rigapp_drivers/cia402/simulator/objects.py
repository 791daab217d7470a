"""The object dictionary of a simulated CiA 402 drive: entries, access, abort codes; its PDOs."""

from __future__ import annotations

import enum
from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Final

from rigapp_drivers.cia402.slcan import Frame

Key = tuple[int, int]


class Abort(enum.IntEnum):
    """SDO abort codes in use (CiA 301)."""

    TOGGLE = 0x0503_0000
    COMMAND = 0x0504_0001
    READ_ONLY = 0x0601_0002
    NO_OBJECT = 0x0602_0000
    NOT_MAPPABLE = 0x0604_0041
    MAPPING_TOO_LONG = 0x0604_0042
    LENGTH = 0x0607_0010
    NO_SUBINDEX = 0x0609_0011
    VALUE = 0x0609_0030
    STATE = 0x0800_0022


class AbortTransfer(Exception):
    """Abort an SDO transfer with an abort code."""

    def __init__(self, code: int) -> None:
        super().__init__(f"abort {code:08X}")
        self.code = code


@dataclass(slots=True)
class Entry:
    """One object: kind as u8, i16, u32, ... or text; access ro or rw; mappable into PDOs.

    read, if set, computes the value; written, if set, checks and applies a new value.
    """

    kind: str
    value: int | str = 0
    access: str = "rw"
    mappable: bool = False
    read: Callable[[], int] | None = None
    written: Callable[[int], None] | None = None

    @property
    def length(self) -> int:
        """Return the length in bytes of a number."""
        return int(self.kind[1:]) // 8

    @property
    def signed(self) -> bool:
        """Return whether the number has a sign."""
        return self.kind.startswith("i")


class Dictionary:
    """Read and write objects as bytes; objects in ``lacking`` do not exist from outside."""

    def __init__(self, lacking: Collection[int] = ()) -> None:
        self.entries: dict[Key, Entry] = {}
        self._lacking = lacking

    def add(self, index: int, subindex: int, entry: Entry) -> None:
        """Add an object."""
        self.entries[index, subindex] = entry

    def number(self, index: int, subindex: int = 0) -> int:
        """Return the present value of a number."""
        entry = self.entries[index, subindex]
        value = entry.value if entry.read is None else entry.read()
        assert isinstance(value, int)
        return value

    def set(self, index: int, value: int, subindex: int = 0) -> None:
        """Set a number from inside the drive."""
        self.entries[index, subindex].value = value

    def find(self, index: int, subindex: int) -> Entry:
        """Return an entry; raise AbortTransfer if there is none."""
        entry = None if index in self._lacking else self.entries.get((index, subindex))
        if entry is None:
            known = index not in self._lacking and any(key[0] == index for key in self.entries)
            raise AbortTransfer(Abort.NO_SUBINDEX if known else Abort.NO_OBJECT)
        return entry

    def read(self, index: int, subindex: int) -> bytes:
        """Return an object's bytes, little-endian; raise AbortTransfer."""
        entry = self.find(index, subindex)
        if entry.kind == "text":
            return str(entry.value).encode("ascii")
        value = self.number(index, subindex)
        return (value & (1 << 8 * entry.length) - 1).to_bytes(entry.length, "little")

    def write(self, index: int, subindex: int, data: bytes) -> None:
        """Write bytes from outside; raise AbortTransfer."""
        entry = self.find(index, subindex)
        if entry.access == "ro":
            raise AbortTransfer(Abort.READ_ONLY)
        if entry.kind == "text" or len(data) != entry.length:
            raise AbortTransfer(Abort.LENGTH)
        value = int.from_bytes(data, "little", signed=entry.signed)
        if entry.written is not None:
            entry.written(value)
        entry.value = value


PDO_COUNT: Final = 4
PDO_ENTRIES: Final = 8


def add_communication(objects: Dictionary, name: str) -> None:
    """Add the objects of CiA 301 except the PDOs."""
    objects.add(0x1000, 0, Entry("u32", 0x0002_0192, "ro"))
    objects.add(0x1001, 0, Entry("u8", 0, "ro", mappable=True))
    objects.add(0x1005, 0, Entry("u32", 0x80, "ro"))
    objects.add(0x1008, 0, Entry("text", name, "ro"))
    objects.add(0x1016, 0, Entry("u8", 2, "ro"))
    objects.add(0x1016, 1, Entry("u32"))
    objects.add(0x1016, 2, Entry("u32"))
    objects.add(0x1017, 0, Entry("u16"))
    objects.add(0x1029, 0, Entry("u8", 1, "ro"))
    objects.add(0x1029, 1, Entry("u8"))
    objects.add(0x1003, 0, Entry("u8"))
    for subindex in range(1, PDO_ENTRIES + 1):
        objects.add(0x1003, subindex, Entry("u32", 0, "ro"))


def add_identity(objects: Dictionary, numbers: tuple[int, int, int, int]) -> None:
    """Add 1018: vendor, product, revision, serial number."""
    objects.add(0x1018, 0, Entry("u8", 4, "ro"))
    for subindex, value in enumerate(numbers, start=1):
        objects.add(0x1018, subindex, Entry("u32", value, "ro"))


def add_profile(objects: Dictionary) -> None:
    """Add the objects of CiA 402 with the defaults of the EPOS4."""
    objects.add(0x6007, 0, Entry("i16", 3))
    objects.add(0x603F, 0, Entry("u16", 0, "ro", mappable=True))
    objects.add(0x6040, 0, Entry("u16", 0, mappable=True))
    objects.add(0x6041, 0, Entry("u16", 0, "ro", mappable=True))
    objects.add(0x605A, 0, Entry("i16", 6))
    objects.add(0x605B, 0, Entry("i16", 0))
    objects.add(0x605C, 0, Entry("i16", 1))
    objects.add(0x605E, 0, Entry("i16", 2))
    objects.add(0x6060, 0, Entry("i8", 1, mappable=True))
    objects.add(0x6061, 0, Entry("i8", 1, "ro", mappable=True))
    for index in (0x6064, 0x606B, 0x606C):
        objects.add(index, 0, Entry("i32", 0, "ro", mappable=True))
    objects.add(0x6075, 0, Entry("u32", 12000, "ro"))
    objects.add(0x6076, 0, Entry("u32", 600, "ro"))
    for index in (0x6077, 0x6078):
        objects.add(index, 0, Entry("i16", 0, "ro", mappable=True))
    objects.add(0x6079, 0, Entry("u32", 48000, "ro", mappable=True))
    objects.add(0x607A, 0, Entry("i32", 0, mappable=True))
    objects.add(0x607F, 0, Entry("u32", 50000, mappable=True))
    objects.add(0x6080, 0, Entry("u32", 50000, mappable=True))
    for index in (0x6083, 0x6084, 0x6085):
        objects.add(index, 0, Entry("u32", 10000, mappable=True))
    objects.add(0x6086, 0, Entry("i16", 0))
    objects.add(0x60A9, 0, Entry("u32", 0x00B4_4700))
    objects.add(0x60FF, 0, Entry("i32", 0, mappable=True))
    objects.add(0x6402, 0, Entry("u16", 1))
    objects.add(0x6502, 0, Entry("u32", 0x3FF, "ro"))


def add_epos(objects: Dictionary, node_id: int, encoder_pulses: int) -> None:
    """Add the manufacturer's objects that this program reads."""
    objects.add(0x2000, 0, Entry("u8", node_id))
    objects.add(0x2001, 0, Entry("u8", 0))
    objects.add(0x2200, 0, Entry("u8", 1, "ro"))
    objects.add(0x2200, 1, Entry("u16", 480, "ro", mappable=True))
    objects.add(0x3001, 0, Entry("u8", 4, "ro"))
    objects.add(0x3001, 1, Entry("u32", 12000))
    objects.add(0x3001, 2, Entry("u32", 15000))
    objects.add(0x3001, 3, Entry("u8", 1))
    objects.add(0x3001, 4, Entry("u16", 40))
    objects.add(0x3010, 0, Entry("u8", 1, "ro"))
    objects.add(0x3010, 1, Entry("u32", encoder_pulses))
    objects.add(0x30D1, 0, Entry("u8", 2, "ro"))
    objects.add(0x30D1, 1, Entry("i32", 0, "ro", mappable=True))
    objects.add(0x30D1, 2, Entry("i32", 0, "ro", mappable=True))
    objects.add(0x30D3, 0, Entry("u8", 1, "ro"))
    objects.add(0x30D3, 1, Entry("i32", 0, "ro", mappable=True))
    objects.add(0x3201, 0, Entry("u8", 1, "ro"))
    objects.add(0x3201, 1, Entry("i16", 315, "ro", mappable=True))
    objects.add(0x3202, 0, Entry("u8", 1, "ro"))
    objects.add(0x3202, 1, Entry("u8", 3, "ro", mappable=True))


_INVALID: Final = 1 << 31
_IDENTIFIER: Final = 0x7FF
_INHIBIT_UNIT_S: Final = 1e-4

RECEIVE_DEFAULTS: Final = (
    (0x6040_0010,),
    (0x6040_0010, 0x6060_0008),
    (0x6040_0010, 0x607A_0020),
    (0x6040_0010, 0x60FF_0020),
)
TRANSMIT_DEFAULTS: Final = (
    (0x6041_0010,),
    (0x6041_0010, 0x6061_0008),
    (0x6041_0010, 0x6064_0020),
    (0x6041_0010, 0x606C_0020),
)
_INHIBIT_DEFAULTS: Final = (10, 0, 0, 10)


@dataclass(slots=True)
class _Sent:
    """Last transmission of a TPDO."""

    data: bytes | None = None
    time_s: float = 0.0
    syncs: int = 0


class Pdos:
    """Build TPDOs from the dictionary and write RPDOs into it."""

    def __init__(self, objects: Dictionary, node_id: int, tpdo1_period_s: float | None) -> None:
        self._objects = objects
        self._period_s = tpdo1_period_s
        self._sent = [_Sent() for _ in range(PDO_COUNT)]
        for number in range(PDO_COUNT):
            invalid = 0 if number == 0 else _INVALID
            self._add(0x1400 + number, invalid | 0x200 + 0x100 * number + node_id, None)
            self._add_mapping(0x1600 + number, RECEIVE_DEFAULTS[number])
            cob_id = invalid | 0x4000_0000 | 0x180 + 0x100 * number + node_id
            self._add(0x1800 + number, cob_id, _INHIBIT_DEFAULTS[number])
            self._add_mapping(0x1A00 + number, TRANSMIT_DEFAULTS[number])

    def _add(self, index: int, cob_id: int, inhibit: int | None) -> None:
        objects = self._objects
        objects.add(index, 0, Entry("u8", 2 if inhibit is None else 3, "ro"))
        objects.add(index, 1, Entry("u32", cob_id))
        objects.add(index, 2, Entry("u8", 255, written=lambda _: self._must_be_off(index)))
        if inhibit is not None:
            objects.add(index, 3, Entry("u16", inhibit, written=lambda _: self._must_be_off(index)))

    def _add_mapping(self, index: int, entries: tuple[int, ...]) -> None:
        objects = self._objects
        parameters = index - 0x200

        def count_written(count: int) -> None:
            self._must_be_off(parameters)
            mapped = [objects.number(index, sub) for sub in range(1, min(count, PDO_ENTRIES) + 1)]
            if count > PDO_ENTRIES or sum(entry & 0xFF for entry in mapped) > 64:
                raise AbortTransfer(Abort.MAPPING_TOO_LONG)

        def entry_written(entry: int) -> None:
            self._must_be_off(parameters)
            if objects.number(index, 0) != 0:
                raise AbortTransfer(Abort.STATE)
            mapped = objects.entries.get((entry >> 16, entry >> 8 & 0xFF))
            if entry and (
                mapped is None or not mapped.mappable or mapped.length * 8 != entry & 0xFF
            ):
                raise AbortTransfer(Abort.NOT_MAPPABLE)

        objects.add(index, 0, Entry("u8", len(entries), written=count_written))
        for subindex in range(1, PDO_ENTRIES + 1):
            value = entries[subindex - 1] if subindex <= len(entries) else 0
            objects.add(index, subindex, Entry("u32", value, written=entry_written))

    def _must_be_off(self, parameters: int) -> None:
        if not self._objects.number(parameters, 1) & _INVALID:
            raise AbortTransfer(Abort.STATE)

    def forget(self) -> None:
        """Mark every TPDO as not sent, as on entering operational."""
        self._sent = [_Sent() for _ in range(PDO_COUNT)]

    def receive(self, frame: Frame) -> bool | None:
        """Write an RPDO into the dictionary: True done, False wrong length, None not addressed."""
        for number in range(PDO_COUNT):
            cob_id = self._objects.number(0x1400 + number, 1)
            if cob_id & _INVALID or cob_id & _IDENTIFIER != frame.identifier:
                continue
            return self._unpack(self._mapped(0x1600 + number), frame.data)
        return None

    def _unpack(self, mapped: list[int], data: bytes) -> bool:
        if len(data) < sum(entry & 0xFF for entry in mapped) // 8:
            return False
        pieces = []
        for entry in mapped:
            length = (entry & 0xFF) // 8
            pieces.append((entry, data[:length]))
            data = data[length:]
        for entry, piece in reversed(pieces):  # the control word is first, and is executed last
            self._objects.write(entry >> 16, entry >> 8 & 0xFF, piece)
        return True

    def on_sync(self, time_s: float) -> list[Frame]:
        """Return the TPDOs triggered by a SYNC."""
        frames = []
        for number, sent in enumerate(self._sent):
            kind = self._objects.number(0x1800 + number, 2)
            if not self._valid(number) or kind > 240:
                continue
            sent.syncs += 1
            changed = sent.data != self._data(number)
            if (kind == 0 and changed) or (kind and sent.syncs % kind == 0):
                frames.append(self._send(number, time_s))
        return frames

    def on_time(self, time_s: float) -> list[Frame]:
        """Return the TPDOs that are due by a change or by time."""
        frames = []
        for number, sent in enumerate(self._sent):
            if not self._valid(number) or self._objects.number(0x1800 + number, 2) < 254:
                continue
            inhibit_s = self._objects.number(0x1800 + number, 3) * _INHIBIT_UNIT_S
            first = sent.data is None
            periodic = number == 0 and self._period_s is not None
            due = periodic and time_s - sent.time_s >= (self._period_s or 0.0)
            changed = sent.data != self._data(number) and time_s - sent.time_s >= inhibit_s
            if first or due or changed:
                frames.append(self._send(number, time_s))
        return frames

    def _valid(self, number: int) -> bool:
        return not self._objects.number(0x1800 + number, 1) & _INVALID

    def _mapped(self, index: int) -> list[int]:
        count = self._objects.number(index, 0)
        return [self._objects.number(index, sub) for sub in range(1, count + 1)]

    def _data(self, number: int) -> bytes:
        return b"".join(
            self._objects.read(entry >> 16, entry >> 8 & 0xFF)
            for entry in self._mapped(0x1A00 + number)
        )

    def _send(self, number: int, time_s: float) -> Frame:
        data = self._data(number)
        sent = self._sent[number]
        sent.data, sent.time_s = data, time_s
        return Frame(self._objects.number(0x1800 + number, 1) & _IDENTIFIER, data)
