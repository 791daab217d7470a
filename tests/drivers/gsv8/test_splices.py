"""Damaged streams: no spliced frame is given as a good sample, and the search costs little."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rigapp_drivers.gsv8.frames import (
    FrameLayout,
    Response,
    StreamParser,
    encode_frames,
    encode_response,
)
from rigapp_drivers.gsv8.numbers import DataType

PLAIN = [
    FrameLayout(objects=5),
    FrameLayout(objects=2, data_type=DataType.INT24),
    FrameLayout(objects=4, data_type=DataType.INT16),
]
SUFFIXES = bytes((0x85, 0x85, 0x14, 0xB0, 0x11, 0x00, 0x3F))
"""Payload bytes of which many end a frame; without AA no splice can be followed by a frame."""


def frames_of(layout: FrameLayout, count: int, seed: int) -> list[bytes]:
    """Return whole frames whose payloads differ and are full of suffixes."""
    width = layout.objects * layout.data_type.width
    payload = np.random.default_rng(seed).choice(np.frombuffer(SUFFIXES, np.uint8), (count, width))
    head = bytes((0xAA, layout.header(), layout.third))
    return [head + bytes(row) + b"\x85" for row in payload]


def given_frames(parser: StreamParser, pieces: Iterator[bytes] | list[bytes]) -> list[bytes]:
    """Return the frames that a parser gives, encoded again, in order."""
    layout = parser.layout
    assert layout is not None
    out: list[bytes] = []
    for piece in pieces:
        for run in parser.feed(piece).runs:
            out += [bytes(row) for row in encode_frames(run.values, layout)]
    return out


def is_part(some: list[bytes], of: list[bytes]) -> bool:
    """Tell whether frames are there in their order, with others left out."""
    rest = iter(of)
    return all(frame in rest for frame in some)


@settings(max_examples=80)
@given(
    st.sampled_from(PLAIN),
    st.integers(0, 1000),
    st.lists(st.tuples(st.integers(0, 1000), st.integers(1, 90)), min_size=1, max_size=4),
    st.integers(1, 200),
)
@example(FrameLayout(objects=5), 3, [(30, 5)], 7)
def test_no_splice_is_given(
    layout: FrameLayout, seed: int, lost: list[tuple[int, int]], piece: int
) -> None:
    frames = frames_of(layout, 10 + 20 * len(lost), seed)
    stream = b"".join(frames)
    for place, (at, size) in reversed(list(enumerate(lost))):
        at = (10 + 20 * place) * layout.length() + at % layout.length()
        # A whole number of frames lost leaves one whole frame of two halves: only a checksum tells.
        size += size % layout.length() == 0
        stream = stream[:at] + stream[at + size :]
    parser = StreamParser(layout, hold=True)
    pieces = [stream[i : i + piece] for i in range(0, len(stream), piece)]
    got = given_frames(parser, pieces)
    got += given_frames(parser, [encode_response(Response(0))])
    whole = sum(frame in stream for frame in frames)
    assert is_part(got, frames)
    assert len(got) >= whole - 3 * len(lost), "little is lost around each damage"


def test_splices_of_a_long_stream_are_found_by_what_follows_them() -> None:
    layout = FrameLayout(objects=5)
    frames = frames_of(layout, 20_000, 1)
    random = np.random.default_rng(2)
    stream = bytearray(b"".join(frames))
    for at in sorted(random.integers(0, len(stream) - 100, 400).tolist(), reverse=True):
        del stream[at : at + int(random.integers(1, layout.length()))]
    good = set(frames)
    wrong = {
        hold: sum(
            frame not in good
            for frame in given_frames(StreamParser(layout, hold=hold), [bytes(stream)])
        )
        for hold in (False, True)
    }
    assert wrong[False] > 0
    assert wrong[True] == 0


def test_the_last_frame_waits_for_what_follows() -> None:
    layout = FrameLayout(objects=5)
    frames = frames_of(layout, 4, 5)
    parser = StreamParser(layout, hold=True)
    assert given_frames(parser, frames[:2]) == frames[:1]
    assert given_frames(parser, [encode_response(Response(0, b"\x01"))]) == [frames[1]]
    assert given_frames(parser, [frames[2] + b"\xaa"]) == []
    assert given_frames(parser, [frames[3][1:3]]) == [frames[2]]
    assert given_frames(parser, [frames[3][3:]]) == []
    (run,) = parser.give_up_tail().runs
    assert run.values.shape[1] == 1
    assert not run.quality.any()
    assert parser.tally.dropped_bytes == 0


def work(layout: FrameLayout | None, data: bytes, **options: Any) -> int:
    """Return how many calls, in Python and in C, the parsing of a stream takes."""
    parser, calls = StreamParser(layout, **options), 0
    parser.feed(b"\x00")

    def count(frame: Any, event: str, argument: Any) -> None:
        nonlocal calls
        calls += event in ("call", "c_call")

    before = sys.getprofile()
    sys.setprofile(count)
    try:
        for start in range(0, len(data), 1 << 16):
            parser.feed(data[start : start + (1 << 16)])
    finally:
        sys.setprofile(before)
    return calls


@pytest.mark.parametrize(
    ("layout", "options"),
    [
        (FrameLayout(5), {"hold": True}),
        (FrameLayout(5, high_speed=True), {"hold": True}),
        (FrameLayout(5, checksum=True), {}),
        (None, {}),
    ],
)
@pytest.mark.parametrize("pattern", ["AA14B0", "AA34B0", "AA34B085", "AA", "AA5001", "00"])
def test_the_search_for_a_frame_costs_little_and_in_proportion(
    layout: FrameLayout | None, options: dict[str, Any], pattern: str
) -> None:
    one = bytes.fromhex(pattern)
    repeated = one * (1_000_000 // len(one))
    once, twice = (work(layout, repeated[:size], **options) for size in (500_000, 1_000_000))
    assert twice <= 2.2 * once + 200
    assert twice < 1_000_000 / 200, "a call for each byte would be a hundred times as many"
