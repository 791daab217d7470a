"""The SDO server of a simulated drive: expedited transfers, and segmented uploads of texts."""

from __future__ import annotations

import struct

from rigapp_drivers.cia402.simulator.objects import Abort, AbortTransfer, Dictionary

DOWNLOAD, _UPLOAD, _UPLOAD_SEGMENT, _ABORT = 1, 2, 3, 4


class SdoServer:
    """Answer the requests of one client, 8 bytes each."""

    def __init__(self, objects: Dictionary) -> None:
        self._objects = objects
        self._rest = b""
        self._toggle = 0
        self._place = (0, 0)

    def answer(
        self, request: bytes, forced_abort: int | None = None, *, obey: bool = True
    ) -> bytes | None:
        """Return the reply, None where the protocol has none.

        forced_abort: a fault to show. obey: whether a download that is confirmed is carried out.
        """
        if len(request) != 8:
            return None
        command = request[0] >> 5
        if command == _ABORT:
            self._rest = b""
            return None
        if command != _UPLOAD_SEGMENT:
            index, subindex = struct.unpack_from("<HB", request, 1)
            self._place = (index, subindex)
        try:
            if forced_abort is not None:
                raise AbortTransfer(forced_abort)
            return self._obey(command, request) if obey else self._confirmed()
        except AbortTransfer as abort:
            self._rest = b""
            return struct.pack("<BHBI", 0x80, *self._place, abort.code)

    def _confirmed(self) -> bytes:
        return struct.pack("<BHBI", 0x60, *self._place, 0)

    def _obey(self, command: int, request: bytes) -> bytes:
        if command == DOWNLOAD:
            return self._download(request)
        if command == _UPLOAD:
            return self._upload()
        if command == _UPLOAD_SEGMENT:
            return self._upload_segment(request[0] >> 4 & 1)
        raise AbortTransfer(Abort.COMMAND)

    def _download(self, request: bytes) -> bytes:
        expedited, sized = request[0] & 2, request[0] & 1
        if not expedited:
            raise AbortTransfer(Abort.COMMAND)
        index, subindex = self._place
        entry = self._objects.find(index, subindex)
        length = 4 - (request[0] >> 2 & 3) if sized else entry.length
        self._objects.write(index, subindex, request[4 : 4 + length])
        return self._confirmed()

    def _upload(self) -> bytes:
        index, subindex = self._place
        data = self._objects.read(index, subindex)
        if len(data) <= 4:
            head = 0x43 | (4 - len(data)) << 2
            return struct.pack("<BHB", head, index, subindex) + data.ljust(4, b"\0")
        self._rest, self._toggle = data, 0
        return struct.pack("<BHBI", 0x41, index, subindex, len(data))

    def _upload_segment(self, toggle: int) -> bytes:
        if not self._rest:
            raise AbortTransfer(Abort.COMMAND)
        if toggle != self._toggle:
            raise AbortTransfer(Abort.TOGGLE)
        part, self._rest = self._rest[:7], self._rest[7:]
        self._toggle ^= 1
        head = toggle << 4 | (7 - len(part)) << 1 | (0 if self._rest else 1)
        return bytes((head,)) + part.ljust(7, b"\0")
