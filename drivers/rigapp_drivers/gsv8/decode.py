"""Show the bytes of a GSV-8's line in words, for ``rigapp wire``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from rigapp_drivers.gsv8.frames import StreamParser
from rigapp_drivers.gsv8.protocol import Command
from rigapp_drivers.gsv8.words import status_words

_REQUEST: Final = 0x90
_CHECKED_REQUEST: Final = 0xB0
_KIND: Final = 0xF0


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``."""

    def __init__(self) -> None:
        self._parser = StreamParser()
        self._parser.response_expected = True

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield what is asked: the command with its parameters."""
        kind = data[1] & _KIND if len(data) > 3 else 0
        if kind not in (_REQUEST, _CHECKED_REQUEST):
            yield data.hex(" ")
            return
        parameters = data[3 : 3 + (data[1] & 0x0F)]
        known = data[2] in Command.__members__.values()
        name = Command(data[2]).words if known else "command {}".format(f"{data[2]:02X}")
        yield f"{name} {parameters.hex(' ')}".rstrip()

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the responses; measured values are told by their number of bytes."""
        tally = self._parser.tally
        before = tally.dropped_bytes
        parsed = self._parser.feed(data)
        for response in parsed.responses:
            told = response.data.hex(" ") or "-"
            yield f"response: {status_words(response.status)}, {told}"
        dropped = tally.dropped_bytes - before
        rest = len(data) - sum(4 + len(one.data) for one in parsed.responses) - dropped
        if rest > 0:
            yield f"{rest} bytes of measured values"
        if dropped:
            yield f"{dropped} bytes that are no frame"
