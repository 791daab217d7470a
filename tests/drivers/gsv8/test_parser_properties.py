"""The stream parser under any split, garbage, cut and flip, against a byte-by-byte reference."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from rigapp_drivers.api import Quality
from rigapp_drivers.gsv8.frames import (
    FrameLayout,
    Parsed,
    Response,
    StreamParser,
    encode_frames,
    encode_response,
)
from rigapp_drivers.gsv8.numbers import DataType
from rigapp_drivers.gsv8.protocol import crc16

LAYOUTS = [
    FrameLayout(objects=5),
    FrameLayout(objects=3, checksum=True),
    FrameLayout(objects=2, data_type=DataType.INT24),
    FrameLayout(objects=4, data_type=DataType.INT16, checksum=True),
    FrameLayout(objects=5, high_speed=True),
]
layouts = st.sampled_from(LAYOUTS)
NASTY = bytes((0xAA, 0x85, 0x14, 0xB0, 0x50, 0x00, 0x11, 0xA0, 0x1E, 0x19, 0x00, 0x33, 0x90))


def _samples(layout: FrameLayout, count: int, seed: int = 0) -> np.ndarray:
    """Return numbers whose bytes hold no AA, so that no false start hides in them."""
    ramp = np.arange(count) % 1000 + seed % 7
    rows = [ramp * (row + 1) % 127 for row in range(layout.objects)]
    return np.array(rows, dtype=np.float64)


def _stream(layout: FrameLayout, values: np.ndarray, sequences: int = 1) -> bytes:
    return encode_frames(values, layout, sequences=sequences).tobytes()


def _feed_in_pieces(parser: StreamParser, data: bytes, cuts: list[int]) -> Parsed:
    whole = Parsed()
    bounds = [0, *sorted(cut % (len(data) + 1) for cut in cuts), len(data)]
    for start, end in pairwise(bounds):
        part = parser.feed(data[start:end])
        whole.responses.extend(part.responses)
        whole.runs.extend(part.runs)
    return whole


def _joined(parsed: Parsed, layout: FrameLayout) -> tuple[np.ndarray, np.ndarray, int]:
    if not parsed.runs:
        return np.empty((layout.objects, 0)), np.empty(0, np.uint8), 0
    values = np.concatenate([run.values for run in parsed.runs], axis=1)
    quality = np.concatenate([run.quality for run in parsed.runs])
    return values, quality, sum(run.lost_before for run in parsed.runs)


@given(layouts, st.integers(0, 300), st.lists(st.integers(0, 10000), max_size=20))
def test_any_split_gives_the_same_samples(layout: FrameLayout, count: int, cuts: list[int]) -> None:
    values = _samples(layout, count)
    parser = StreamParser(layout)
    parsed = _feed_in_pieces(parser, _stream(layout, values), cuts)
    got, quality, lost = _joined(parsed, layout)
    assert got.tolist() == values.tolist()
    assert not quality.any()
    assert lost == 0
    assert parser.waiting_bytes == 0
    assert parser.tally.dropped_bytes == 0


@given(
    layouts,
    st.lists(st.tuples(st.integers(0, 40), st.binary(max_size=14)), max_size=6),
    st.lists(st.integers(0, 10000), max_size=10),
)
def test_responses_between_frames_disturb_nothing(
    layout: FrameLayout, answers: list[tuple[int, bytes]], cuts: list[int]
) -> None:
    data, values, responses = b"", [], []
    for count, answer in answers:
        block = _samples(layout, count)
        values.append(block)
        responses.append(Response(0, answer))
        data += _stream(layout, block) + encode_response(responses[-1], checksum=count % 2 == 0)
    parsed = _feed_in_pieces(StreamParser(layout), data, cuts)
    got, quality, lost = _joined(parsed, layout)
    assert parsed.responses == responses
    assert got.tolist() == (np.concatenate(values, axis=1).tolist() if values else got.tolist())
    assert not quality.any()
    assert lost == 0


def _frames_by_bytes(data: bytes, layout: FrameLayout) -> Iterator[bytes]:
    """Follow the protocol's rule literally: on any mismatch drop one byte and search again."""
    position, in_step = 0, True
    lengths = {
        layout.header(count): layout.length(count) for count in range(1, layout.most_sequences + 1)
    }
    while position + 3 <= len(data):
        head, third = data[position + 1], data[position + 2]
        length, mine = 0, False
        if data[position] == 0xAA:
            if head in lengths and third & 0xF0 == layout.third:
                length, mine = lengths[head], True
            elif head & 0xD0 == 0x10 and third & 0x80 and third >> 4 & 7 in (1, 2, 3) and in_step:
                width = (third >> 4 & 7) + 1
                length = 4 + ((head & 15) + 1) * width + (2 if head & 0x20 else 0)
                for own in lengths.values():
                    begun = data[position + own : position + length][:3]
                    if len(begun) == 3 and begun[0] == 0xAA and begun[1] in lengths:
                        length = length if begun[2] & 0xF0 != layout.third else 0
            elif head & 0xF0 == 0x50 and head != 0x5F and in_step and not (third and head & 15):
                length = 4 + (head & 15)
        if length and position + length > len(data):
            return
        frame = data[position : position + length]
        good = bool(frame) and frame[-1] == 0x85
        if good and head & 0xF0 == 0x30:
            good = crc16(frame[1:-3]) == int.from_bytes(frame[-3:-1], "little")
        if not good:
            position += 1
            in_step = False
            continue
        if mine:
            in_step = True
            yield frame
        position += length


nasty_streams = st.lists(
    st.one_of(
        st.binary(max_size=8),
        st.lists(st.sampled_from(NASTY), max_size=30).map(bytes),
        st.tuples(layouts, st.integers(1, 5)).map(lambda a: _stream(a[0], _samples(*a))),
        st.tuples(layouts, st.integers(1, 30)).map(
            lambda a: _stream(a[0], _samples(a[0], 2))[: a[1]]
        ),
    ),
    max_size=12,
).map(b"".join)


@settings(max_examples=300)
@given(layouts, nasty_streams, st.lists(st.integers(0, 10000), max_size=8))
def test_any_bytes_give_what_the_literal_rule_gives(
    layout: FrameLayout, data: bytes, cuts: list[int]
) -> None:
    data = data.replace(b"\xaa\x70", b"\xaa\x50").replace(b"\xaa\x7f", b"\xaa\x5f")
    parser = StreamParser(layout)
    got, _, _ = _joined(_feed_in_pieces(parser, data, cuts), layout)
    frames = list(_frames_by_bytes(data, layout))
    expected = Parsed()
    for frame in frames:
        expected.runs.extend(StreamParser(layout).feed(frame).runs)
    wanted, _, _ = _joined(expected, layout)
    np.testing.assert_array_equal(got, wanted)
    assert parser.waiting_bytes < 80
    parser.response_expected = True
    parser.feed(data)
    parser.give_up_tail()


@settings(max_examples=200)
@given(
    layouts,
    st.integers(3, 40),
    st.integers(0, 30),
    st.one_of(
        st.tuples(st.just("garbage"), st.binary(min_size=1, max_size=60)),
        st.tuples(st.just("cut"), st.integers(1, 1000)),
        st.tuples(st.just("flip"), st.tuples(st.integers(0, 1000), st.integers(1, 255))),
    ),
    st.lists(st.integers(0, 10000), max_size=5),
)
@example(FrameLayout(2, DataType.INT24), 4, 0, ("flip", (1, 10)), [])
@example(FrameLayout(2, DataType.INT24), 4, 0, ("flip", (1, 14)), [])
@example(FrameLayout(5), 3, 0, ("flip", (1, 0x0E)), [7])
def test_in_step_again_within_two_frames(
    layout: FrameLayout, count: int, where: int, damage: tuple[str, object], cuts: list[int]
) -> None:
    layout = FrameLayout(layout.objects, layout.data_type, layout.checksum)
    values = _samples(layout, count, seed=1)
    frames = [bytes(row) for row in encode_frames(values, layout)]
    where %= count
    kind, how = damage
    if kind == "garbage":
        assert isinstance(how, bytes)
        how = how.replace(b"\xaa", b"\x00")
        frames[where] = how + frames[where]
    elif kind == "cut":
        assert isinstance(how, int)
        frames[where] = frames[where][: how % len(frames[where])]
    else:
        assert isinstance(how, tuple)
        broken = bytearray(frames[where])
        broken[how[0] % len(broken)] ^= how[1]
        frames[where] = bytes(broken)
    parser = StreamParser(layout)
    got, quality, _ = _joined(_feed_in_pieces(parser, b"".join(frames), cuts), layout)
    delivered = got.T.tolist()
    good = values.T.tolist()
    assert delivered[:where] == good[:where]
    rest = good[where + 3 :]
    assert delivered[len(delivered) - len(rest) :] == rest
    if parser.tally.dropped_bytes and len(delivered) > where:
        assert np.any(quality & Quality.RESYNCHRONISED) or not rest


@pytest.mark.parametrize("layout", LAYOUTS[:4])
def test_no_damaged_head_hides_the_frames_behind_it(layout: FrameLayout) -> None:
    """A damaged head can be that of a longer frame which ends where a good one does."""
    values = _samples(layout, 6, seed=1)
    frames = encode_frames(values, layout)
    for place, bits in product(range(3), range(1, 256)):
        broken = frames.copy()
        broken[1, place] ^= bits
        parser = StreamParser(layout)
        got, _, lost = _joined(parser.feed(broken.tobytes()), layout)
        assert got[:, -3:].tolist() == values[:, -3:].tolist(), (place, bits)
        assert got.shape[1] + lost == 6, (place, bits)


def test_a_cut_frame_is_one_lost_sample() -> None:
    layout = FrameLayout(objects=5)
    frames = [bytes(row) for row in encode_frames(_samples(layout, 10), layout)]
    frames[4] = frames[4][:11]
    parser = StreamParser(layout)
    runs = parser.feed(b"".join(frames)).runs
    assert [run.lost_before for run in runs] == [0, 1]
    assert [run.values.shape[1] for run in runs] == [4, 5]
    assert runs[1].quality[0] == Quality.RESYNCHRONISED | Quality.LOST_BEFORE
    assert not runs[1].quality[1:].any()
    assert parser.tally.resynchronisations == 1
    assert parser.tally.lost_samples == 1


def test_garbage_between_frames_loses_nothing() -> None:
    layout = FrameLayout(objects=5)
    frames = [bytes(row) for row in encode_frames(_samples(layout, 4), layout)]
    runs = StreamParser(layout).feed(frames[0] + b"\x01\x02\x85" + b"".join(frames[1:])).runs
    assert [run.lost_before for run in runs] == [0, 0]
    assert sum(run.values.shape[1] for run in runs) == 4
    assert runs[1].quality[0] == Quality.RESYNCHRONISED


def test_a_wrong_checksum_is_one_lost_sample() -> None:
    layout = FrameLayout(objects=3, checksum=True)
    frames = encode_frames(_samples(layout, 5), layout)
    frames[2, 5] ^= 0x01
    parser = StreamParser(layout)
    runs = parser.feed(frames.tobytes()).runs
    assert [run.values.shape[1] for run in runs] == [2, 2]
    assert runs[1].lost_before == 1
    assert parser.tally.checksum_failures == 1


def test_a_response_with_a_wrong_checksum_is_not_delivered() -> None:
    parser = StreamParser()
    good = encode_response(Response(0, b"\x01"), checksum=True)
    bad = good[:3] + b"\x02" + good[4:]
    assert parser.feed(bad).responses == []
    assert parser.tally.checksum_failures == 1
    parser.response_expected = True
    assert parser.feed(good).responses == [Response(0, b"\x01")]


def test_payload_full_of_delimiters_is_no_trouble() -> None:
    layout = FrameLayout(objects=5)
    word = np.frombuffer(bytes.fromhex("AA8514B0"), dtype=">f4")[0]
    values = np.full((5, 1000), word)
    parser = StreamParser(layout)
    parsed = _feed_in_pieces(parser, _stream(layout, values), list(range(0, 24000, 7)))
    got, quality, lost = _joined(parsed, layout)
    assert np.array_equal(got.view(np.uint32), values.astype(np.float32).view(np.uint32))
    assert not quality.any()
    assert lost == 0


@pytest.mark.parametrize("sequences", [1, 2, 3])
def test_high_speed_frames_hold_several_samples(sequences: int) -> None:
    layout = FrameLayout(objects=5, high_speed=True)
    values = _samples(layout, 12)
    saturated = np.arange(12) == 6
    data = encode_frames(values, layout, saturated, sequences).tobytes()
    got, quality, _ = _joined(StreamParser(layout).feed(data), layout)
    assert got.tolist() == values.tolist()
    first = 6 // sequences * sequences
    assert np.flatnonzero(quality).tolist() == list(range(first, first + sequences))


def test_high_speed_frames_are_foreign_when_not_allowed() -> None:
    plain, fast = FrameLayout(objects=5), FrameLayout(objects=5, high_speed=True)
    parser = StreamParser(plain)
    parsed = parser.feed(_stream(fast, _samples(fast, 12), sequences=3))
    assert parsed.runs == []
    assert parser.consecutive_foreign == 4
    back = parser.feed(_stream(plain, _samples(plain, 2)))
    assert back.runs[0].lost_before == 4
    assert parser.consecutive_foreign == 0


def test_frames_with_another_number_of_objects_are_counted() -> None:
    parser = StreamParser(FrameLayout(objects=5))
    six = FrameLayout(objects=6)
    assert parser.feed(_stream(six, _samples(six, 9))).runs == []
    assert parser.consecutive_foreign == 9
    assert parser.tally.dropped_bytes == 0


def test_without_a_layout_only_responses_are_returned() -> None:
    parser = StreamParser()
    parser.response_expected = True
    five = FrameLayout(objects=5)
    stream = _stream(five, _samples(five, 3))
    parsed = parser.feed(stream[13:] + bytes.fromhex("AA500085") + stream)
    assert parsed.responses == [Response(0)]
    assert parsed.runs == []
    assert parser.waiting_bytes == 0


def test_a_frame_that_never_ends_hides_no_answer() -> None:
    parser = StreamParser()
    parser.response_expected = True
    assert parser.feed(bytes.fromhex("AA5E00" + "AA500085")).responses == []
    assert parser.give_up_tail().responses == [Response(0)]
    assert parser.give_up_tail() == Parsed()


def test_reserved_bits_of_the_third_byte_are_ignored() -> None:
    layout = FrameLayout(objects=1)
    parsed = StreamParser(layout).feed(bytes.fromhex("AA10BE3F80000085"))
    assert parsed.runs[0].values.tolist() == [[1.0]]
    assert parsed.runs[0].quality.tolist() == [0]


def test_overwritten_frames_are_counted_by_their_length() -> None:
    layout = FrameLayout(objects=5)
    frames = encode_frames(_samples(layout, 10), layout)
    frames[3:6] = 0x11
    runs = StreamParser(layout).feed(frames.tobytes()).runs
    assert [run.lost_before for run in runs] == [0, 3]
    fast = FrameLayout(objects=5, high_speed=True)
    packed = encode_frames(_samples(fast, 30), fast, sequences=3)
    packed[2:4] = 0x11
    runs = StreamParser(fast).feed(packed.tobytes()).runs
    assert [run.lost_before for run in runs] == [0, 6]


def test_a_refusal_with_data_is_no_response() -> None:
    parser = StreamParser()
    assert parser.feed(bytes.fromhex("AA5251000085")).responses == []
    assert parser.tally.dropped_bytes > 0
