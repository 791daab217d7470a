"""The scan parser under any split, lost and added bytes, lost scans: no wrong sample is good.

Every scan's analog words are a hash of its number, so a sample that is out of place is noticed.
Odds: a random word in the counter's place passes one check with ``Steps.odds``, 1/65536 for the
encoder clock and 13/65536 for the internal clock used here. A misaligned scan is handed on only
after ``GUARD`` more have passed: below 1e-18 a lost byte with analog inputs that are alive. With
inputs that stand still to the last bit the words after the first depend on it, so that the odds of
a single check remain; the last test counts them.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp_drivers.api import Quality
from rigapp_drivers.dataq.scans import ENCODER_STEPS, GUARD, Layout, Run, ScanParser, Steps

INTERNAL = Steps(0, 40, 6)
RULES = {"internal": (INTERNAL, 3), "encoder": (ENCODER_STEPS, 1)}
LAYOUTS = [
    Layout(4),
    Layout(1, mask=0xFFFC),
    Layout(2, digital=True),
    Layout(0),
    Layout(3, rate=True),
]
rules = st.sampled_from(sorted(RULES))
layouts = st.sampled_from(LAYOUTS)


def _words(layout: Layout, numbers: np.ndarray, step: int, first: int = 65500) -> np.ndarray:
    """Return scans as words: a hash of the scan's number, the counter last."""
    entries = np.arange(layout.words - 1)
    keys = numbers[:, None].astype(np.uint64) * np.uint64(64) + entries.astype(np.uint64)
    keys = (keys + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    keys ^= keys >> np.uint64(31)
    keys *= np.uint64(0xBF58476D1CE4E5B9)
    words = np.empty((numbers.size, layout.words), np.uint16)
    words[:, :-1] = (keys >> np.uint64(41)).astype(np.uint16)
    words[:, -1] = ((numbers * step + first) % 65536) ^ 0x8000
    return words


def _stream(layout: Layout, count: int, step: int) -> bytes:
    return _words(layout, np.arange(count), step).astype("<u2").tobytes()


def _expected(layout: Layout, numbers: np.ndarray, step: int) -> np.ndarray:
    """Return rows of what must come out, decoded by hand rules."""
    words = _words(layout, numbers, step)
    rows = [
        words[:, i].astype(np.int16).astype(int) & ~(0xFFFF ^ layout.mask)
        for i in range(layout.analog)
    ]
    if layout.digital:
        rows.append(words[:, layout.analog].astype(int) >> 8 & 0x7F)
    if layout.rate:
        rows.append(words[:, layout.words - 2].astype(np.int16).astype(int))
    rows.append(numbers * step + 65500)
    return np.array(rows)


def _feed(parser: ScanParser, data: bytes, cuts: list[int]) -> list[Run]:
    bounds = [0, *sorted(cut % (len(data) + 1) for cut in cuts), len(data)]
    return [run for a, b in pairwise(bounds) for run in parser.feed(data[a:b])]


def _check(layout: Layout, step: int, runs: list[Run]) -> list[int]:
    """Require that every sample handed on is a true scan, and return their numbers."""
    numbers: list[int] = []
    for run in runs:
        travelled = (run.values[-1].astype(int) - 65500) % 65536
        assert (travelled % step == 0).all()
        those = travelled // step
        assert (np.diff(those) == 1).all()
        expected = _expected(layout, those, step)
        assert run.values[:-1].tolist() == expected[:-1].tolist()
        numbers.extend(those.tolist())
    return numbers


@given(
    layouts, rules, st.integers(0, 200), st.lists(st.integers(0, 4000), max_size=20), st.booleans()
)
def test_any_split_gives_the_same_samples(
    layout: Layout, rule: str, count: int, cuts: list[int], echoed: bool
) -> None:
    steps, step = RULES[rule]
    parser = ScanParser(layout, steps, (b"start 2\r", b"start\r"))
    data = (b"start\r" if echoed else b"") + _stream(layout, count, step)
    runs = _feed(parser, data, cuts) + parser.finish()
    assert _check(layout, step, runs) == list(range(1, count))
    assert parser.broken is None
    assert parser.discarded_bytes == 0
    assert not any(run.lost_before or (run.quality & ~Quality.SATURATED).any() for run in runs)


drops = st.lists(st.tuples(st.integers(0, 2000), st.integers(1, 30)), max_size=3)
garbage = st.lists(st.tuples(st.integers(0, 2000), st.binary(min_size=1, max_size=30)), max_size=3)


def _good(runs: list[Run]) -> list[Run]:
    """Return the samples that are not flagged."""
    masks = [(run.quality & ~np.uint8(Quality.SATURATED)) == 0 for run in runs]
    return [
        Run(run.values[:, mask], run.quality[mask]) for run, mask in zip(runs, masks, strict=True)
    ]


@settings(max_examples=120)
@given(layouts, rules, drops, st.lists(st.integers(0, 3000), max_size=10))
def test_lost_bytes_never_make_a_wrong_sample(
    layout: Layout, rule: str, lost: list[tuple[int, int]], cuts: list[int]
) -> None:
    if rule == "internal" and sum(length for _, length in lost) >= 2 * layout.words:
        lost = lost[:0]  # whole scans of a slow shaft can go unseen, the module says so
    steps, step = RULES[rule]
    data = _stream(layout, 150, step)
    for place, length in lost:
        place %= len(data)
        data = data[:place] + data[place + length :]
    parser = ScanParser(layout, steps)
    runs = _feed(parser, data, cuts) + parser.finish()
    numbers = _check(layout, step, _good(runs))
    assert numbers == sorted(set(numbers))


@settings(max_examples=120)
@given(layouts, rules, garbage, st.lists(st.integers(0, 3000), max_size=10))
def test_garbage_never_makes_a_wrong_sample(
    layout: Layout, rule: str, added: list[tuple[int, bytes]], cuts: list[int]
) -> None:
    steps, step = RULES[rule]
    data = _stream(layout, 150, step)
    for place, put in added:
        place %= len(data)
        data = data[:place] + put + data[place:]
    parser = ScanParser(layout, steps)
    runs = _feed(parser, data, cuts) + parser.finish()
    numbers = _check(layout, step, _good(runs))
    assert numbers == sorted(set(numbers))


@settings(max_examples=120)
@given(layouts, rules, st.binary(max_size=600), st.lists(st.integers(0, 600), max_size=10))
def test_any_bytes_are_borne(layout: Layout, rule: str, data: bytes, cuts: list[int]) -> None:
    parser = ScanParser(layout, RULES[rule][0], (b"start\r",))
    runs = _feed(parser, data, cuts) + parser.finish()
    samples = sum(run.quality.size for run in runs)
    assert samples * 2 * layout.words + parser.discarded_bytes <= len(data)
    parser.restart()
    parser.feed(_stream(layout, 40, RULES[rule][1]))
    assert parser.broken is None


@given(layouts, rules, st.integers(1, 1500), st.integers(0, 30))
def test_one_lost_byte_breaks_the_stream_at_once_and_a_restart_heals_it(
    layout: Layout, rule: str, place: int, later: int
) -> None:
    steps, step = RULES[rule]
    size = 2 * layout.words
    data = _stream(layout, 1600 // size + 20, step)
    parser = ScanParser(layout, steps)
    runs = parser.feed(data[:place] + data[place + 1 :])
    assert parser.broken is not None
    assert "the counter stepped by" in parser.broken
    before = _check(layout, step, runs)
    hit = place // size
    # The scan that lost the byte may pass when the byte that took its place is the same.
    assert max(0, hit - GUARD - 1) <= len(before) <= max(0, hit)
    parser.restart()
    first = len(data) // size + later
    resumed = _words(layout, np.arange(first, first + 20), step).astype("<u2").tobytes()
    after = parser.feed(resumed) + parser.finish()
    assert _check(layout, step, after) == list(range(first + 1, first + 20))
    assert after[0].quality[0] & Quality.RESYNCHRONISED
    assert after[0].quality[0] & Quality.LOST_BEFORE
    exact = before and rule == "encoder"
    assert after[0].lost_before == (first - before[-1] if exact else None)


@given(
    layouts, st.integers(1, 60), st.integers(1, 3000), st.lists(st.integers(0, 3000), max_size=9)
)
def test_lost_scans_of_the_encoder_clock_are_counted_without_a_restart(
    layout: Layout, place: int, lost: int, cuts: list[int]
) -> None:
    numbers = np.concatenate([np.arange(place), np.arange(place + lost, place + lost + 40)])
    data = _words(layout, numbers, 1).astype("<u2").tobytes()
    parser = ScanParser(layout, ENCODER_STEPS)
    runs = _feed(parser, data, cuts) + parser.finish()
    assert parser.broken is None
    assert _check(layout, 1, runs) == np.delete(numbers, [0, place]).tolist()
    (gap,) = (run for run in runs if run.lost_before)
    assert gap.lost_before == lost + 1
    assert gap.quality[0] & ~Quality.SATURATED == Quality.LOST_BEFORE | Quality.COUNT_SUSPECT
    assert int(gap.values[-1, 0]) - 65500 == place + lost + 1


def test_the_counter_goes_round_without_a_mark() -> None:
    layout = Layout(1)
    numbers = np.arange(70_000)
    parser = ScanParser(layout, Steps(0, 40, 6))
    runs = parser.feed(_words(layout, numbers, 31).astype("<u2").tobytes()) + parser.finish()
    counts = np.concatenate([run.values[-1] for run in runs])
    assert counts.tolist() == (numbers[1:] * 31 + 65500).tolist()
    assert not any((run.quality & ~Quality.SATURATED).any() for run in runs)


@pytest.mark.parametrize(
    ("mask", "word"), [(0xFFFF, 0x7FFF), (0xFFFF, 0x8000), (0xFFFC, 0x7FFD), (0xFFFC, 0x8002)]
)
def test_the_ends_of_the_range_are_flagged(mask: int, word: int) -> None:
    words = np.array([[word, 0x7FFF], [5, 0x8000], [word, 0x8001], [9, 0x8002]], "<u2")
    parser = ScanParser(Layout(1, mask=mask), ENCODER_STEPS)
    assert parser.feed(words.tobytes()) == []
    (run,) = parser.finish()
    assert run.quality.tolist() == [0, Quality.SATURATED, 0]


@pytest.mark.parametrize("turned", [-1, -700, 7, 41, 20_000])
def test_counter_steps_that_no_shaft_makes_break_the_stream(turned: int) -> None:
    layout = Layout(1)
    words = _words(layout, np.arange(60), 0)
    words[30:, -1] = ((65500 + turned) % 65536) ^ 0x8000
    parser = ScanParser(layout, INTERNAL)
    runs = parser.feed(words.astype("<u2").tobytes())
    assert parser.broken == (
        f"the counter stepped by {turned} from one scan to the next, where 0 to 40 (and a change "
        "of 6 at most) is possible"
    )
    assert sum(run.quality.size for run in runs) == 30 - 1 - GUARD
    assert parser.feed(b"anything") == []


@given(st.lists(st.integers(-6, 6), min_size=2, max_size=80))
def test_motion_within_the_limits_never_breaks_the_stream(changes: list[int]) -> None:
    step, counts = 20, [0]
    for change in changes:
        step = min(40, max(0, step + change))
        counts.append(counts[-1] + step)
    words = np.array(counts, np.int64)[:, None] % 65536 ^ 0x8000
    parser = ScanParser(Layout(0), INTERNAL)
    runs = parser.feed(words.astype("<u2").tobytes()) + parser.finish()
    assert parser.broken is None
    assert np.concatenate([run.values[0] for run in runs]).tolist() == counts[1:]


@pytest.mark.sampled(every=3)
@pytest.mark.parametrize("rule", sorted(RULES))
@pytest.mark.parametrize("word", [0, 0x7FFF, 0xFFFF, 0x1234])
def test_dead_inputs_leave_the_odds_of_a_single_check(rule: str, word: int) -> None:
    """A standing shaft and inputs that are stuck: of 65536 counts, so many hide a lost byte."""
    steps, step = RULES[rule]
    step = 0 if rule == "internal" else step
    numbers = np.arange(24)
    near = ((word & 0xFF) << 8) ^ 0x8000  # where the bytes in the counter's place can fit
    counts = {(near + offset) % 65536 for offset in range(-300, 560)} | set(range(0, 65536, 97))
    hidden = 0
    for count in counts:
        words = np.full((24, 2), word, np.uint16)
        words[:, 1] = ((numbers * step + count) % 65536) ^ 0x8000
        data = words.astype("<u2").tobytes()
        parser = ScanParser(Layout(1), steps)
        parser.feed(data[:40] + data[41:])
        hidden += parser.broken is None
    assert hidden <= (steps.odds * 65536 if rule == "internal" else 0)
