"""Show the bytes of a DATAQ instrument's line in words, for ``rigapp wire``."""

from __future__ import annotations

from collections.abc import Iterator

from rigapp_drivers.dataq.protocol import line, split_replies


class Decoder:
    """Decode both directions of one line; implements ``api.WireDecoder``.

    Between ``start`` and the echo of ``stop`` come samples, which are told by their number of
    bytes: they have no mark of their own.
    """

    def __init__(self) -> None:
        self._scans = False
        self._rest = b""

    def sent(self, data: bytes) -> Iterator[str]:
        """Yield the command lines."""
        text = data.decode("ascii", "replace")
        for one in filter(None, text.split("\r")):
            self._scans |= one.startswith("start")
            yield one

    def received(self, data: bytes) -> Iterator[str]:
        """Yield the answering lines, or how many bytes of samples came."""
        if self._scans:
            place = data.rfind(line("stop"))
            samples = data if place < 0 else data[:place]
            if samples:
                yield f"{len(samples)} bytes of samples"
            if place < 0:
                return
            self._scans, data = False, data[place:]
        replies, self._rest = split_replies(self._rest + data)
        yield from replies
