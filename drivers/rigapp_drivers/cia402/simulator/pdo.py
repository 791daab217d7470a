"""The PDOs of a simulated drive: parameters, mapping, sending on change, on SYNC, periodically."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from rigapp_drivers.cia402.simulator.objects import (
    PDO_COUNT,
    PDO_ENTRIES,
    Abort,
    AbortTransfer,
    Dictionary,
    Entry,
)
from rigapp_drivers.cia402.slcan import Frame

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
    """Remember what a TPDO sent last."""

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
            found = objects.entries.get((entry >> 16, entry >> 8 & 0xFF))
            if entry and (found is None or not found.mappable or found.length * 8 != entry & 0xFF):
                raise AbortTransfer(Abort.NOT_MAPPABLE)

        objects.add(index, 0, Entry("u8", len(entries), written=count_written))
        for subindex in range(1, PDO_ENTRIES + 1):
            value = entries[subindex - 1] if subindex <= len(entries) else 0
            objects.add(index, subindex, Entry("u32", value, written=entry_written))

    def _must_be_off(self, parameters: int) -> None:
        if not self._objects.number(parameters, 1) & _INVALID:
            raise AbortTransfer(Abort.STATE)

    def forget(self) -> None:
        """Take every TPDO as not sent yet, as on entering operational."""
        self._sent = [_Sent() for _ in range(PDO_COUNT)]

    def receive(self, frame: Frame) -> bool | None:
        """Write an RPDO into the dictionary: True obeyed, False wrong length, None not for us."""
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
        for entry, piece in reversed(pieces):  # the control word comes first, is obeyed last
            self._objects.write(entry >> 16, entry >> 8 & 0xFF, piece)
        return True

    def on_sync(self, time_s: float) -> list[Frame]:
        """Return the TPDOs that a SYNC causes."""
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
        """Return the TPDOs that are due by change or by time."""
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
