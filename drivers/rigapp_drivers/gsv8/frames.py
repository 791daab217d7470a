"""Split the byte stream of a GSV-8 into responses and measured values.

Serial frames (SPEC p9-16): prefix AA, header, third byte, data, optional checksum, suffix 85. The
payload may contain AA and 85, so frames are found by their length and never split at delimiters: on
any mismatch one byte is dropped and the search starts again (the safe rule of the protocol).
The normal case, contiguous frames of one kind, is checked and decoded in bulk; so is the search.

If bytes are lost inside a frame, its head and a later frame's end can look like one complete frame.
A checksum detects that. Without one the last frame is held back until another follows at its end:
after a spliced frame no frame follows.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_drivers.api import Quality
from rigapp_drivers.gsv8.numbers import DataType, Values, decode, encode
from rigapp_drivers.gsv8.protocol import crc8, crc16, crc16_of_rows

PREFIX = 0xAA
SUFFIX = 0x85
_PREFIX_BYTE = bytes((PREFIX,))

_TYPE_MASK = 0xF0  # third byte of measured values: bit 7 set, b6:4 data type, b3:2 reserved
_SATURATED = 0x01
_LONG_FORM = 15

_FIRST_BULK = 64  # frames checked together after damage
_MAXIMUM_BULK = 1 << 15
_FIRST_WINDOW = 64  # bytes searched first after damage
_MAXIMUM_WINDOW = 1 << 16


@dataclass(frozen=True, slots=True)
class FrameLayout:
    """Layout of the measured-value frames that the device is configured to send.

    objects: values of one sample (analog channels first, counters last).
    high_speed: several samples may share a frame, oldest first.
    """

    objects: int
    data_type: DataType = DataType.FLOAT32
    checksum: bool = False
    high_speed: bool = False
    offset_binary: bool = True

    def length(self, sequences: int = 1) -> int:
        """Return the length in bytes of a frame of ``sequences`` samples."""
        data = sequences * self.objects * self.data_type.width
        return 4 + data + (2 if self.checksum else 0)

    def header(self, sequences: int = 1) -> int:
        """Return the header byte of a frame of ``sequences`` samples."""
        return (0x30 if self.checksum else 0x10) | (sequences * self.objects - 1)

    @property
    def third(self) -> int:
        """Return the third byte of a frame without error bits."""
        return 0x80 | self.data_type << 4

    @property
    def most_sequences(self) -> int:
        """Return the maximum number of samples per frame."""
        return 16 // self.objects if self.high_speed else 1


@dataclass(frozen=True, slots=True)
class Response:
    """Response to a request: status 0 is success, data is b"" otherwise."""

    status: int
    data: bytes = b""


@dataclass(frozen=True, slots=True)
class Run:
    """Consecutive samples: values (objects, n), quality (n,) of Quality flags.

    lost_before: samples known to be lost just before.
    """

    values: Values
    quality: NDArray[np.uint8]
    lost_before: int = 0


@dataclass(frozen=True, slots=True)
class Parsed:
    """Content of one piece of the stream, in order of arrival within each list."""

    responses: list[Response] = field(default_factory=list)
    runs: list[Run] = field(default_factory=list)


@dataclass(slots=True)
class Tally:
    """Counts of line errors since the parser was created."""

    dropped_bytes: int = 0
    resynchronisations: int = 0
    checksum_failures: int = 0
    lost_samples: int = 0
    foreign_frames: int = 0


def encode_response(response: Response, *, checksum: bool = False) -> bytes:
    """Return the bytes of a response frame (device to host), at most 14 data bytes."""
    if len(response.data) > 14:
        raise ValueError(say("a short response holds at most 14 bytes"))
    head = (0x70 if checksum else 0x50) | len(response.data)
    body = bytes((head, response.status)) + response.data
    check = bytes((crc8(body),)) if checksum else b""
    return _PREFIX_BYTE + body + check + bytes((SUFFIX,))


def encode_frames(
    values: NDArray[np.generic],
    layout: FrameLayout,
    saturated: NDArray[np.bool_] | None = None,
    sequences: int = 1,
) -> NDArray[np.uint8]:
    """Return (frames, length) bytes of measured-value frames for values (objects, samples).

    samples must be a multiple of sequences; saturated: (samples,) flags; one marks its whole frame.
    """
    objects, count = values.shape
    width = sequences * objects * layout.data_type.width
    payload = encode(values, layout.data_type, offset_binary=layout.offset_binary)
    payload = payload.reshape(count // sequences, width)
    frames = np.empty((len(payload), layout.length(sequences)), dtype=np.uint8)
    frames[:, 0] = PREFIX
    frames[:, 1] = layout.header(sequences)
    frames[:, 2] = layout.third
    if saturated is not None:
        frames[:, 2] |= (
            saturated.reshape(count // sequences, sequences).any(axis=1).astype(np.uint8)
        )
    frames[:, 3 : 3 + payload.shape[1]] = payload
    if layout.checksum:
        crc = crc16_of_rows(frames[:, 1:-3])
        frames[:, -3] = crc & 0xFF
        frames[:, -2] = crc >> 8
    frames[:, -1] = SUFFIX
    return frames


class StreamParser:
    """Parse a stream piece by piece; only the unconsumed tail is kept between pieces.

    Without a layout, measured values of any layout are skipped and only responses are returned.
    With one, complete frames of another layout are counted as foreign, and their samples are lost.
    ``response_expected``: accept an apparent response while the stream is out of step; in step,
    responses are always accepted. hold: return no sample before its frame is followed by another
    one or a response.
    """

    def __init__(self, layout: FrameLayout | None = None, *, hold: bool = False) -> None:
        self.layout = layout
        self.response_expected = False
        self._hold = hold
        self.tally = Tally()
        self.consecutive_foreign = 0
        self._tail = b""
        self._in_step = True
        self._dropped = 0
        self._damaged = 0
        self._bulk = _FIRST_BULK
        self._sequences = (
            {}
            if layout is None
            else {layout.header(count): count for count in range(1, layout.most_sequences + 1)}
        )

    def feed(self, data: bytes) -> Parsed:
        """Parse the next bytes and return the completed frames."""
        buffer = self._tail + data if self._tail else data
        parsed = Parsed()
        position = self._parse(buffer, parsed)
        self._tail = buffer[position:]
        return parsed

    def give_up_tail(self) -> Parsed:
        """Treat an incomplete frame as damaged and continue the search after its first byte.

        For use when the line is silent although a response is due. A complete frame that was held
        back is returned.
        """
        parsed = Parsed()
        if self._tail:
            buffer = self._tail
            hold, self._hold = self._hold, False
            position = self._parse(buffer, parsed) if hold else 0
            self._hold = hold
            if position == 0:
                position = self._parse(buffer, parsed, self._skip(buffer, 0))
            self._tail = buffer[position:]
        return parsed

    @property
    def waiting_bytes(self) -> int:
        """Return the length of the unconsumed tail."""
        return len(self._tail)

    def _parse(self, buffer: bytes, parsed: Parsed, position: int = 0) -> int:
        octets = np.frombuffer(buffer, dtype=np.uint8)
        while position < len(buffer):
            if buffer[position] != PREFIX:
                position = self._skip(buffer, position)
                continue
            if len(buffer) - position < 3:
                break
            length = self._length_at(buffer, position)
            if length == 0:
                position = self._skip(buffer, position)
            elif len(buffer) - position < length:
                break
            elif buffer[position + 1] in self._sequences:
                before = position
                position = self._take_samples(buffer, octets, position, length, parsed)
                if position == before:
                    break
            else:
                position = self._take_other(buffer, position, length, parsed)
        return position

    def _length_at(self, buffer: bytes, position: int) -> int:
        """Return the length of the frame that may start here, 0 if none can."""
        head, third = buffer[position + 1], buffer[position + 2]
        length = int(self._lengths(self._in_step)[head, third])
        if length == 0 or head & 0xD0 != 0x10 or self._is_own(head, third):
            return length
        return 0 if self._hides_own_frame(buffer, position, length) else length

    def _lengths(self, in_step: bool) -> NDArray[np.int16]:
        """Return the valid table of lengths by header and third byte."""
        responses = in_step or self.response_expected
        return _frame_lengths(self.layout, responses, in_step or self.layout is None)

    def _is_own(self, head: int, third: int) -> bool:
        layout = self.layout
        return layout is not None and head in self._sequences and third & _TYPE_MASK == layout.third

    def _hides_own_frame(self, buffer: bytes, position: int, length: int) -> bool:
        """Return whether an own frame starts inside this one, where a shorter own one would end.

        Then this is an own frame with a damaged head, and its false length would consume good ones.
        """
        layout = self.layout
        if layout is None:
            return False
        heads = tuple(bytes((PREFIX, head)) for head in self._sequences)
        starts = (position + layout.length(count) for count in self._sequences.values())
        return any(
            buffer.startswith(heads, start) and buffer[start + 2] & _TYPE_MASK == layout.third
            for start in starts
            if start + 3 <= min(position + length, len(buffer))
        )

    def _take_samples(
        self, buffer: bytes, octets: NDArray[np.uint8], start: int, length: int, parsed: Parsed
    ) -> int:
        layout = self.layout
        assert layout is not None
        third = buffer[start + 2] & _TYPE_MASK
        if third != layout.third:
            return self._take_other(buffer, start, length, parsed)
        head = buffer[start + 1]
        count = min((len(octets) - start) // length, self._bulk)
        rows = octets[start : start + count * length].reshape(count, length)
        good = _leading_good(rows, head, third, layout.checksum)
        if good == 0:
            if layout.checksum and rows[0, -1] == SUFFIX:
                self.tally.checksum_failures += 1
            return self._skip(buffer, start)
        follows = not self._hold or self._follows(buffer, start + good * length)
        given = good if follows else good - 1
        if given:
            parsed.runs.append(self._run(rows[:given], layout))
        # Bulks of constant size would cost the square of the damage; growing ones its logarithm.
        self._bulk = min(self._bulk * 4, _MAXIMUM_BULK) if good == count else _FIRST_BULK
        end = start + given * length
        return self._skip(buffer, end) if follows is False else end

    def _follows(self, buffer: bytes, end: int) -> bool | None:
        """Return whether a frame or a response begins at the end of a frame; None: unknown yet."""
        if end < len(buffer) and buffer[end] != PREFIX:
            return False
        if end + 3 > len(buffer):
            return None
        length = int(self._lengths(True)[buffer[end + 1], buffer[end + 2]])
        if length == 0 or self._is_own(buffer[end + 1], buffer[end + 2]):
            return length > 0
        return buffer[end + length - 1] == SUFFIX if end + length <= len(buffer) else None

    def _run(self, rows: NDArray[np.uint8], layout: FrameLayout) -> Run:
        check = 2 if layout.checksum else 0
        payload = rows[:, 3 : rows.shape[1] - 1 - check]
        values = decode(
            payload, layout.objects, layout.data_type, offset_binary=layout.offset_binary
        )
        quality = rows[:, 2] & np.uint8(_SATURATED)  # Quality.SATURATED has the same bit
        sequences = values.shape[1] // len(rows)
        if sequences > 1:
            quality = np.repeat(quality, sequences)
        lost = self._resync(quality, rows.shape[1], sequences)
        self.consecutive_foreign = 0
        return Run(values, quality, lost)

    def _resync(self, quality: NDArray[np.uint8], length: int, sequences: int) -> int:
        """Flag the first sample after damaged bytes; return the number of lost samples."""
        if self._in_step and not self._damaged:
            return 0
        lost = max(self._damaged, self._dropped // length * sequences)
        flags = Quality.GOOD if self._in_step else Quality.RESYNCHRONISED
        quality[0] |= flags | (Quality.LOST_BEFORE if lost else Quality.GOOD)
        self._settle()
        self.tally.lost_samples += lost
        return lost

    def _settle(self) -> None:
        if not self._in_step:
            self.tally.resynchronisations += 1
        self._in_step, self._dropped, self._damaged = True, 0, 0

    def _take_other(self, buffer: bytes, start: int, length: int, parsed: Parsed) -> int:
        """Parse a response, or skip a measured-value frame of another layout."""
        frame = buffer[start : start + length]
        if frame[-1] != SUFFIX:
            return self._skip(buffer, start)
        checksum = frame[1] & 0x20
        if frame[1] & 0xD0 == 0x50:
            if checksum and crc8(frame[1:-2]) != frame[-2]:
                self.tally.checksum_failures += 1
                return self._skip(buffer, start)
            parsed.responses.append(Response(frame[2], frame[3 : 3 + (frame[1] & 0x0F)]))
            if self.layout is None:
                self._settle()
            return start + length
        if checksum and crc16(frame[1:-3]) != int.from_bytes(frame[-3:-1], "little"):
            self.tally.checksum_failures += 1
            return self._skip(buffer, start)
        if self.layout is None:
            self._settle()
        else:
            self._damaged += 1
            self.tally.foreign_frames += 1
            self.consecutive_foreign += 1
        return start + length

    def _skip(self, buffer: bytes, position: int) -> int:
        """Drop one byte and all following ones that cannot start a complete frame."""
        self._bulk = _FIRST_BULK
        if self._in_step:
            self._in_step = False
            head = buffer[position + 1 : position + 3]
            if buffer[position] == PREFIX and len(head) == 2 and self.layout is not None:
                begun = head[1] & _TYPE_MASK == self.layout.third
                self._damaged += self._sequences.get(head[0], 0) if begun else 0
        following = self._next_start(np.frombuffer(buffer, dtype=np.uint8), position + 1)
        self._dropped += following - position
        self.tally.dropped_bytes += following - position
        return following

    def _next_start(self, octets: NDArray[np.uint8], position: int) -> int:
        """Return the first position where a complete frame may start, or the end.

        The search window grows, so that the cost is proportional to the skipped bytes.
        """
        window = _FIRST_WINDOW
        while position < len(octets):
            starts = position + np.flatnonzero(octets[position : position + window] == PREFIX)
            if starts.size:
                starts = starts[self._may_start(octets, starts)]
                if starts.size:
                    return int(starts[0])
            position += window
            window = min(4 * window, _MAXIMUM_WINDOW)
        return len(octets)

    def _may_start(self, octets: NDArray[np.uint8], starts: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return at which prefix positions a complete or still incomplete frame starts."""
        lengths = self._lengths(False)
        length = _looked_up(lengths, octets, starts)
        ends = starts + length
        coming = ends > len(octets)
        complete = (length > 0) & ~coming
        complete[complete] = octets[ends[complete] - 1] == SUFFIX
        layout = self.layout
        if layout is not None and (layout.checksum or self._hold):
            own = complete & (octets[np.minimum(starts + 1, len(octets) - 1)] & 0xD0 == 0x10)
            complete[own] = (
                _checks(octets, starts[own], length[own])
                if layout.checksum
                else self._may_follow(octets, ends[own])
            )
        return complete | coming & (length > 0)

    def _may_follow(self, octets: NDArray[np.uint8], ends: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Return at which ends a frame or a response may begin, judged by its first bytes."""
        following = octets[np.minimum(ends, len(octets) - 1)] == PREFIX
        plausible = _looked_up(self._lengths(True), octets, ends) > 0
        return (ends >= len(octets)) | following & plausible


@functools.lru_cache(maxsize=64)
def _frame_lengths(layout: FrameLayout | None, responses: bool, foreign: bool) -> NDArray[np.int16]:
    """Return the frame length by header and third byte, (256, 256); 0: none.

    responses: accept responses to requests. foreign: accept measured values of any layout.
    """
    head, third = np.ogrid[:256, :256]
    count, checked, number = head & 0x0F, head >> 5 & 1, third >> 4 & 7
    lengths = np.zeros((256, 256), dtype=np.int16)
    if foreign:
        plausible = (head & 0xD0 == 0x10) & (third >= 0x80) & (number >= 1) & (number <= 3)
        data = (count + 1) * (number + 1)
        lengths = np.where(plausible, 4 + data + 2 * checked, lengths)
    if responses:
        answer = (head & 0xD0 == 0x50) & (count != _LONG_FORM) & ((third == 0) | (count == 0))
        lengths = np.where(answer, 4 + count + checked, lengths)
    if layout is not None:
        own = third & _TYPE_MASK == layout.third
        for sequences in range(1, layout.most_sequences + 1):
            here = (head == layout.header(sequences)) & own
            lengths = np.where(here, layout.length(sequences), lengths)
    return lengths.astype(np.int16)


def _looked_up(
    lengths: NDArray[np.int16], octets: NDArray[np.uint8], starts: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the frame length at each position; 3, the minimum, if the stream ends before."""
    last = len(octets) - 1
    length = lengths[octets[np.minimum(starts + 1, last)], octets[np.minimum(starts + 2, last)]]
    return np.where(starts + 2 > last, 3, length).astype(np.int64)


def _checks(
    octets: NDArray[np.uint8], starts: NDArray[np.int64], lengths: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Return which complete frames have a correct checksum."""
    right = np.zeros(len(starts), dtype=np.bool_)
    for length in np.unique(lengths).tolist():
        these = lengths == length
        rows = octets[starts[these][:, None] + np.arange(length)]
        sent = rows[:, -3].astype(np.uint16) | rows[:, -2].astype(np.uint16) << 8
        right[these] = crc16_of_rows(rows[:, 1:-3]) == sent
    return right


def _leading_good(rows: NDArray[np.uint8], head: int, third: int, checksum: bool) -> int:
    """Return the number of leading rows that are complete frames with this head."""
    good = (
        (rows[:, 0] == PREFIX)
        & (rows[:, 1] == head)
        & (rows[:, 2] & _TYPE_MASK == third)
        & (rows[:, -1] == SUFFIX)
    )
    count = len(rows) if good.all() else int(good.argmin())
    if not checksum or count == 0:
        return count
    sent = rows[:count, -3].astype(np.uint16) | rows[:count, -2].astype(np.uint16) << 8
    right = crc16_of_rows(rows[:count, 1:-3]) == sent
    return count if right.all() else int(right.argmin())
