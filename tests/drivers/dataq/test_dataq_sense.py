"""Direction by line B and angle by line Z, against edges of a shaft on any way."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rigapp_drivers.dataq.simulator.terminals import Terminals, rising_edges
from rigapp_drivers.dataq.stream import CountDirection
from rigapp_drivers.simulator_api import RigSignals

LINES = 12
DIRECTION, INDEX = 0, 1

ways = st.lists(st.floats(-4.0, 4.0), min_size=1, max_size=30)


def scans(way: list[float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return edges (encoder lines), states of the digital lines, and pulses along a way (turns)."""
    shaft = np.array([0.4, *(0.4 + np.cumsum(way))])
    terminals = Terminals(LINES, line_b=DIRECTION, line_z=INDEX)
    terminals.read(RigSignals({}, shaft[:1]), 1.0, by_encoder=True)
    readings = terminals.read(RigSignals({}, shaft[1:]), 1.0, by_encoder=True)
    return rising_edges(shaft * LINES).position, readings.lines, readings.counts


def followed(
    sense: CountDirection, lines: np.ndarray, pulses: np.ndarray, cuts: list[int]
) -> np.ndarray:
    """Return the counts of scans that come in pieces."""
    bounds = [0, *sorted(cut % (len(lines) + 1) for cut in cuts), len(lines)]
    pieces = [slice(a, b) for a, b in itertools.pairwise(bounds) if b > a]
    return np.concatenate([sense.counts(lines[piece], pulses[piece]) for piece in pieces])


@given(ways, st.lists(st.integers(0, 1000), max_size=5))
@example([1.3, -0.7, 0.9], [3])
@example([-2.0, 3.0], [])
@example([0.55, -0.4, 2.0], [])
def test_the_count_is_the_shafts_place_and_0_at_the_index(
    way: list[float], cuts: list[int]
) -> None:
    edges, lines, pulses = scans(way)
    if edges.size == 0:
        return
    place = np.floor(edges).astype(np.int64)
    backward = (lines >> DIRECTION & 1).astype(np.int64)
    rounds = np.cumsum(np.abs(np.diff(backward, prepend=backward[0])))  # so often turned round
    turning = followed(CountDirection(DIRECTION, None), lines, pulses, cuts)
    apart = turning - place
    assert (np.abs(apart - apart[0]) <= rounds).all()
    known = followed(CountDirection(DIRECTION, INDEX), lines, pulses, cuts)
    index = lines >> INDEX & 1
    events = np.flatnonzero((index == 1) & (np.diff(index, prepend=0) == 1))
    assert not known[events].any()
    for begin, end in itertools.pairwise([*events, edges.size]):
        apart = (known - place)[begin:end]
        assert (np.abs(apart - apart[0]) <= rounds[begin:end] - rounds[begin]).all()
        assert apart[0] % LINES == 0


def test_without_line_b_it_counts_on_and_the_index_sets_it_to_0() -> None:
    edges, lines, pulses = scans([2.5])
    counts = CountDirection(None, INDEX).counts(lines, pulses)
    np.testing.assert_array_equal(counts[edges >= LINES], (edges % LINES)[edges >= LINES])


def test_a_missing_index_shows_in_the_count() -> None:
    _, lines, pulses = scans([3.0])
    silent = np.where(np.arange(lines.size) > 15, lines & ~(1 << INDEX), lines)
    counts = CountDirection(DIRECTION, INDEX).counts(silent, pulses)
    assert counts.max() > LINES


def test_lost_scans_count_in_the_direction_of_the_scan_behind_them() -> None:
    _, lines, pulses = scans([1.0, -1.0])
    kept = np.delete(np.arange(lines.size), [3, 4, 5, 15, 16])
    counts = CountDirection(DIRECTION, None).counts(lines[kept], pulses[kept])
    whole = CountDirection(DIRECTION, None).counts(lines, pulses)
    np.testing.assert_array_equal(counts, whole[kept])


def test_pulses_go_round() -> None:
    pulses = np.array([2**31 - 2, 2**31 - 1, -(2**31), -(2**31) + 1])
    counts = CountDirection(DIRECTION, None).counts(np.zeros(4, np.int64), pulses)
    assert counts.tolist() == pytest.approx([1, 2, 3, 4])
