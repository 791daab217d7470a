"""The levels of detail hide no extreme and keep to their size."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp.viewer.pyramid import Pyramid, bucket_size, polyline

VALUES = st.lists(
    st.one_of(st.floats(-1e6, 1e6, width=32), st.just(float("nan"))), min_size=1, max_size=1500
)


def filled(values: np.ndarray, cuts: list[int]) -> Pyramid:
    """Return a pyramid that got its values in pieces."""
    pyramid = Pyramid(capacity=16)
    for piece in np.split(values, sorted({cut % (len(values) + 1) for cut in cuts})):
        pyramid.extend(piece)
    return pyramid


@settings(deadline=None, max_examples=80)
@given(
    values=VALUES,
    cuts=st.lists(st.integers(0, 2000), max_size=6),
    span=st.tuples(st.integers(0, 1600), st.integers(0, 1600)),
    buckets=st.integers(1, 400),
)
def test_every_bucket_holds_the_extremes_of_its_rows(
    values: list[float], cuts: list[int], span: tuple[int, int], buckets: int
) -> None:
    array = np.array(values, dtype=np.float32)
    pyramid = filled(array, cuts)
    start, stop = min(span), max(span)
    envelope = pyramid.envelope(start, stop, buckets)
    inside = array[start:stop]
    size = bucket_size(len(inside), buckets)
    for at, low, high in zip(envelope.first, envelope.low, envelope.high, strict=True):
        rows = array[at : at + size]
        known = rows[np.isfinite(rows)]
        if len(known):
            assert low == known.min()
            assert high == known.max()
        else:
            assert np.isnan(low)
            assert np.isnan(high)
    assert len(envelope.first) <= buckets + 2
    if len(inside):
        assert envelope.first[0] <= start < envelope.first[0] + size
        assert envelope.first[-1] + size >= min(stop, len(array))


@settings(deadline=None, max_examples=40)
@given(values=VALUES, cuts=st.lists(st.integers(0, 2000), max_size=6))
def test_growing_in_pieces_gives_the_same_levels_as_at_once(
    values: list[float], cuts: list[int]
) -> None:
    array = np.array(values, dtype=np.float32)
    pieces = filled(array, cuts).envelope(0, len(array), 7)
    whole = filled(array, []).envelope(0, len(array), 7)
    np.testing.assert_array_equal(pieces.low, whole.low)
    np.testing.assert_array_equal(pieces.high, whole.high)


def test_a_spike_of_one_cycle_in_a_million_is_drawn() -> None:
    values = np.zeros(1_000_000, dtype=np.float32)
    values[654_321] = 380.0
    pyramid = Pyramid(len(values))
    pyramid.extend(values)
    x, y = polyline(np.arange(1e6), pyramid.envelope(0, len(values), 1200))
    assert y.max() == 380.0
    assert abs(x[np.argmax(y)] - 654_321) < 1024
    assert len(x) < 2500


@given(st.integers(1, 10**8), st.integers(1, 5000))
def test_bucket_size_is_the_smallest_power_of_two_that_suffices(rows: int, buckets: int) -> None:
    size = bucket_size(rows, buckets)
    assert size & (size - 1) == 0
    assert -(-rows // size) <= buckets
    assert size == 1 or -(-rows // (size // 2)) > buckets


def test_unknown_stretches_shrink_to_one_point() -> None:
    pyramid = Pyramid()
    pyramid.extend(np.array([1.0, np.nan, np.nan, np.nan, 2.0], dtype=np.float32))
    x, y = polyline(np.arange(5.0), pyramid.envelope(0, 5, 100))
    np.testing.assert_array_equal(x, [0.0, 1.0, 4.0])
    np.testing.assert_array_equal(y, [1.0, np.nan, 2.0])


def test_an_empty_series_draws_nothing() -> None:
    x, y = polyline(np.empty(0), Pyramid().envelope(0, 10, 100))
    assert len(x) == len(y) == 0


def test_rows_written_again_bring_the_levels_up_to_date() -> None:
    pyramid = Pyramid()
    pyramid.extend(np.full(5000, np.nan, dtype=np.float32))
    pyramid.write(1000, np.full(10, 7.0))
    assert float(np.nanmax(pyramid.envelope(0, 5000, 3).high)) == 7.0
