"""Cutting at the index: exact, complete, independent of the blocks, and honest about faults."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from encoder_truth import Shaft, assemble, blocks, counter, reference, shaft
from hypothesis import given, settings
from hypothesis import strategies as st

from rigapp.engine.samples.assembler import (
    STANDSTILL_S,
    Assembler,
    EncoderSetup,
    Margins,
    Revolution,
)
from rigapp.schema.messages import Flag
from rigapp_drivers.api import Block

KINDS = ("modulo", "signed", "runs on")


def setup_for(kind: str, turn: int, direction: int = 1) -> EncoderSetup:
    return EncoderSetup(turn, direction, restarts_at_index=kind != "runs on")


def steady(revolutions: float, per_revolution: float, turn: int = 360, start: float = 0.5) -> Shaft:
    """Return a motion at constant speed."""
    turns = start + np.arange(int(revolutions * per_revolution)) / per_revolution
    return Shaft(turn, per_revolution, np.floor(turns * turn + 1e-9).astype(np.int64))


motions = st.builds(
    shaft,
    seed=st.integers(0, 2**32 - 1),
    turn=st.sampled_from([40, 360, 3600, 14400]),
    rate=st.sampled_from([100.0, 960.0, 12000.0]),
    seconds=st.floats(1.0, 4.0),
    reverse=st.booleans(),
    top_rev_per_s=st.sampled_from([0.5, 3.0, 50.0]),
)


@settings(max_examples=25, deadline=None)
@given(motions, st.sampled_from(KINDS), st.sampled_from([1, -1]), st.integers(1, 500))
def test_cuts_agree_with_the_true_position(
    truth: Shaft, kind: str, direction: int, size: int
) -> None:
    counts = counter(truth, kind) * direction
    _, found = assemble(counts, setup_for(kind, truth.turn, direction), truth.rate, size)
    wanted = reference(truth, kind)
    assert [(r.ordinal, r.first_sample, r.end_sample) for r in found] == [
        (cut.ordinal, cut.first, cut.end) for cut in wanted
    ]
    for revolution, cut in zip(found, wanted, strict=True):
        inside = truth.position[revolution.sample_indices()]
        np.testing.assert_array_equal(revolution.counts, inside - cut.base)
        assert revolution.end_count == truth.position[cut.end] - cut.base
        assert not revolution.flags & ~(Flag.REVERSED | Flag.PAUSED)
        backwards = np.min(np.diff(inside, prepend=inside[0])) < 0
        if not backwards:
            assert not revolution.flags & Flag.REVERSED


@settings(max_examples=25, deadline=None)
@given(motions, st.sampled_from(KINDS), st.lists(st.integers(1, 700), max_size=200))
def test_cutting_does_not_depend_on_the_blocks(truth: Shaft, kind: str, sizes: list[int]) -> None:
    counts, setup = counter(truth, kind), setup_for(kind, truth.turn)
    margins = Margins(2, 5)
    _, whole = assemble(counts, setup, truth.rate, len(counts), margins)
    _, pieces = assemble(counts, setup, truth.rate, sizes, margins)
    assert len(whole) == len(pieces)
    for one, other in zip(whole, pieces, strict=True):
        same_revolution(one, other)


def same_revolution(one: Revolution, other: Revolution) -> None:
    np.testing.assert_array_equal(one.values, other.values)
    np.testing.assert_array_equal(one.counts, other.counts)
    np.testing.assert_array_equal(one.segments, other.segments)
    for name in ("ordinal", "before", "first_sample", "end_sample", "lost_samples", "flags"):
        assert getattr(one, name) == getattr(other, name), name


@settings(max_examples=25, deadline=None)
@given(motions, st.sampled_from(KINDS), st.integers(1, 300))
def test_no_sample_is_lost_and_none_is_invented(truth: Shaft, kind: str, size: int) -> None:
    counts = counter(truth, kind)
    assembler, found = assemble(counts, setup_for(kind, truth.turn), truth.rate, size)
    at = found[0].first_sample if found else 0
    for revolution in found:
        assert revolution.first_sample == at
        at = revolution.end_sample
        length = revolution.end_sample - revolution.first_sample
        assert revolution.samples + revolution.idle_samples == length
        place = slice(revolution.before, revolution.before + revolution.samples)
        np.testing.assert_array_equal(revolution.values[0, place], revolution.sample_indices())
    assert assembler.lost_samples == 0


@settings(max_examples=20, deadline=None)
@given(motions, st.sampled_from(KINDS), st.lists(st.integers(1, 700), max_size=100))
def test_what_is_not_whole_yet_is_the_rest(truth: Shaft, kind: str, sizes: list[int]) -> None:
    counts = counter(truth, kind)
    assembler, found = assemble(counts, setup_for(kind, truth.turn), truth.rate, sizes)
    part = assembler.unfinished()
    wanted = reference(truth, kind)
    if part is None:
        assert found == []
        return
    assert part.flags & Flag.PARTIAL
    assert part.end_sample == len(counts)
    if found:
        assert part.first_sample == found[-1].end_sample
        assert part.ordinal > found[-1].ordinal
    assert part.samples + part.idle_samples == part.end_sample - part.first_sample
    place = slice(part.before, part.before + part.samples)
    np.testing.assert_array_equal(part.values[0, place], part.sample_indices())
    assert part.before + part.samples == part.values.shape[1]
    if wanted:
        inside = truth.position[part.sample_indices()]
        assert set((inside - part.counts) % truth.turn) == {0}
        assert abs(int(part.counts[-1])) < truth.turn


@pytest.mark.sampled(every=4)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("size", [1, 19, 10_000])
def test_from_a_stand_through_zero_to_3000_rpm_backwards(kind: str, size: int) -> None:
    """Forward to 3000 rpm, down through a stand, and up to 3000 rpm the other way."""
    rate, turn = 12_000.0, 3600
    speed = np.concatenate(
        (
            np.zeros(600),
            np.linspace(0.0, 50.0, 6000),
            np.linspace(50.0, -50.0, 12_000),
            np.full(6000, -50.0),
        )
    )
    turns = 0.4 + np.cumsum(speed) / rate
    truth = Shaft(turn, rate, np.floor(turns * turn).astype(np.int64))
    counts = counter(truth, kind)
    _, found = assemble(counts, setup_for(kind, turn), rate, size)
    wanted = reference(truth, kind)
    assert len(wanted) > 40
    assert [(r.ordinal, r.first_sample, r.end_sample) for r in found] == [
        (cut.ordinal, cut.first, cut.end) for cut in wanted
    ]
    assert any(r.flags & Flag.REVERSED for r in found)
    assert not any(r.flags & ~(Flag.REVERSED | Flag.PAUSED) for r in found)


def test_a_crank_that_turns_back_onto_the_index_misses_none() -> None:
    """The count is 0 at the next index without having been set to 0."""
    turn = 40
    there = np.concatenate((np.arange(12, -641, -1), np.arange(-639, -520)))
    truth = Shaft(turn, 960.0, np.repeat(there, 2))
    counts = counter(truth, "signed")
    for size in (1, 7, len(counts)):
        _, found = assemble(counts, setup_for("signed", turn), truth.rate, size)
        assert [(r.ordinal, r.first_sample, r.end_sample) for r in found] == [
            (cut.ordinal, cut.first, cut.end) for cut in reference(truth, "signed")
        ]
        assert not any(r.flags & (Flag.MISSED_INDEX | Flag.COUNT_MISMATCH) for r in found)


def test_margins_are_the_neighbouring_samples() -> None:
    truth = steady(5, 100)
    _, found = assemble(counter(truth, "modulo"), setup_for("modulo", 360), 100.0, 7, Margins(2, 4))
    assert len(found) == 4
    for revolution in found:
        first = revolution.first_sample
        np.testing.assert_array_equal(
            revolution.values[0], np.arange(first - 2, revolution.end_sample + 4)
        )
        assert revolution.before == 2


def test_a_revolution_waits_for_its_margin() -> None:
    truth = steady(3, 100, start=0.0)
    assembler = Assembler(setup_for("modulo", 360), 2, 100.0, Margins(0, 3))
    given = list(blocks(counter(truth, "modulo"), 100.0, 1))
    # The index is seen at samples 100 and 200; three more are wanted.
    done = [i for i, block in enumerate(given) if assembler.push(block)]
    assert done == [202]


@pytest.mark.parametrize("per_revolution", [19.2, 12.0, 4.3, 2.5])
def test_few_samples_a_revolution_at_high_speed(per_revolution: float) -> None:
    ramp = np.arange(400) ** 2 / (2 * 400 * per_revolution)
    turns = 0.4 + np.concatenate([ramp, ramp[-1] + np.arange(1, 2000) / per_revolution])
    truth = Shaft(3600, 960.0, np.floor(turns * 3600).astype(np.int64))
    _, found = assemble(counter(truth, "modulo"), setup_for("modulo", 3600), 960.0)
    assert [r.first_sample for r in found] == [c.first for c in reference(truth, "modulo")]
    assert not any(r.flags for r in found)


def test_whole_numbers_and_floats_cut_alike() -> None:
    truth = steady(4, 100)
    counts = counter(truth, "modulo")
    setup = setup_for("modulo", 360)
    results = []
    for dtype in (np.float32, np.int32):
        assembler = Assembler(setup, 2, 100.0)
        results.append(
            [r.first_sample for b in blocks(counts, 100.0, 9, dtype) for r in assembler.push(b)]
        )
    assert results[0] == results[1] != []


def test_a_scaled_counter_is_understood() -> None:
    truth = steady(4, 100)
    counts = counter(truth, "modulo")
    _, plain = assemble(counts, setup_for("modulo", 360), 100.0)
    _, scaled = assemble(counts / 4 - 1.0, setup_for("modulo", 360), 100.0, scale=4.0, offset=4.0)
    assert [r.first_sample for r in plain] == [r.first_sample for r in scaled]


def test_a_missing_index_is_flagged_and_the_cut_is_where_it_should_be() -> None:
    truth = steady(8, 400)
    counts = counter(truth, "modulo")
    third = np.flatnonzero(np.diff(truth.position // 360) == 1)[2] + 1
    fourth = np.flatnonzero(np.diff(truth.position // 360) == 1)[3] + 1
    counts[third:fourth] += 360  # the index between the second and third was not seen
    _, found = assemble(counts, setup_for("modulo", 360), 400.0)
    assert [r.first_sample for r in found] == [c.first for c in reference(truth, "modulo")]
    flags = [r.flags for r in found]
    assert flags[1] == Flag.MISSED_INDEX
    assert flags[0] == flags[2] == flags[3] == Flag.GOOD


def test_an_index_that_never_comes_is_reported() -> None:
    truth = steady(6, 400)
    assembler, found = assemble(truth.position - 180, setup_for("modulo", 360), 400.0)
    assert found == []
    assert assembler.motion.turned_without_index == pytest.approx(6.0, abs=0.02)


@pytest.mark.parametrize("slip", [-40, -7, 7, 40])
def test_slipped_counts_are_flagged_and_the_index_still_cuts(slip: int) -> None:
    truth = steady(8, 400)
    counts = counter(truth, "modulo")
    edges = np.flatnonzero(np.diff(truth.position // 360) == 1) + 1
    middle = (edges[2] + edges[3]) // 2
    step = np.minimum(np.arange(edges[3] - middle), abs(slip)) * np.sign(slip)
    counts[middle : edges[3]] += step  # one count too many or too few at a time
    _, found = assemble(counts, setup_for("modulo", 360), 400.0)
    assert [r.first_sample for r in found] == [c.first for c in reference(truth, "modulo")]
    flags = [r.flags for r in found]
    assert flags[2] & Flag.COUNT_MISMATCH
    assert not flags[2] & Flag.MISSED_INDEX
    assert flags[1] == flags[4] == Flag.GOOD


def test_half_a_revolution_of_lost_counts_is_mended_at_the_next_index_but_one() -> None:
    truth = steady(12, 400)
    counts = counter(truth, "modulo")
    edges = np.flatnonzero(np.diff(truth.position // 360) == 1) + 1
    stuck = slice(edges[2] + 50, edges[2] + 300)
    counts[stuck] = counts[edges[2] + 50]
    counts[edges[2] + 300 : edges[3]] -= counts[edges[2] + 300] - counts[edges[2] + 50] - 1
    _, found = assemble(counts, setup_for("modulo", 360), 400.0)
    assert any(r.flags & Flag.COUNT_MISMATCH for r in found)
    wanted = [c.first for c in reference(truth, "modulo")]
    assert [r.first_sample for r in found][-4:] == wanted[-4:]
    assert not any(r.flags for r in found[-4:])


@pytest.mark.parametrize("wrong", [0, 5000, -3000])
@pytest.mark.parametrize("where", [0.1, 0.5, 0.95])
def test_a_single_wrong_count_moves_no_cut(wrong: int, where: float) -> None:
    truth = steady(8, 400)
    counts = counter(truth, "modulo")
    edges = np.flatnonzero(np.diff(truth.position // 360) == 1) + 1
    counts[edges[2] + int(where * 400)] = wrong
    _, found = assemble(counts, setup_for("modulo", 360), 400.0)
    wanted = [c.first for c in reference(truth, "modulo")]
    got = [r.first_sample for r in found]
    assert len(got) == len(wanted)
    assert got[:3] == wanted[:3]
    assert got[4:] == wanted[4:]
    assert abs(got[3] - wanted[3]) <= (20 if wrong == 0 and where > 0.9 else 0)
    assert found[2].flags & Flag.COUNT_MISMATCH
    assert found[5].flags == Flag.GOOD


@pytest.mark.parametrize("missing", [12, 40, 150])
@pytest.mark.parametrize("where", [0.2, 0.97])
def test_samples_lost_unseen_are_flagged_and_the_cuts_stay_right(
    missing: int, where: float
) -> None:
    truth = steady(8, 400)
    edges = np.flatnonzero(np.diff(truth.position // 360) == 1) + 1
    at = edges[2] + int(where * 400)
    seen = Shaft(360, 400.0, np.delete(truth.position, slice(at, at + missing)))
    _, found = assemble(counter(seen, "modulo"), setup_for("modulo", 360), 400.0)
    wanted = reference(seen, "modulo")
    # A hole over the index that is longer than an eighth of a turn hides one sample more.
    hidden = missing > 50 and where > 0.9
    distance = np.array([r.first_sample for r in found]) - [c.first for c in wanted]
    assert np.flatnonzero(distance).tolist() == ([3] if hidden else [])
    assert abs(distance).max() <= 1
    assert found[2].flags & Flag.COUNT_MISMATCH
    assert [r.flags for r in found[4:]] == [Flag.GOOD] * len(found[4:])
    # From the second sample behind the hole on, the angle is right again.
    last = found[2].sample_indices() > at + 1
    np.testing.assert_array_equal(
        found[2].counts[last], seen.position[found[2].sample_indices()[last]] - wanted[2].base
    )


def test_a_spurious_index_pulse_makes_no_revolution() -> None:
    truth = steady(8, 400)
    counts = counter(truth, "modulo")
    edges = np.flatnonzero(np.diff(truth.position // 360) == 1) + 1
    middle = (edges[2] + edges[3]) // 2
    counts[middle : edges[3]] -= counts[middle]
    _, found = assemble(counts, setup_for("modulo", 360), 400.0)
    assert [r.first_sample for r in found] == [c.first for c in reference(truth, "modulo")]
    assert found[2].flags & Flag.COUNT_MISMATCH
    np.testing.assert_array_equal(found[2].counts, np.arange(400) * 360 // 400)


def gap(truth: Shaft, start: int, lost: int, told: bool = True) -> list[Block]:
    counts = counter(truth, "modulo")
    values = np.zeros((3, len(counts)), np.float32)
    values[0], values[2] = np.arange(len(counts)), counts
    found, first, sequence = [], 0, 0
    for begin, end in ((0, start), (start + lost, len(counts))):
        for at in range(begin, end, 50):
            stop = min(at + 50, end)
            n = stop - at
            missing = lost if at == start + lost and told else 0
            found.append(
                Block(
                    "daq", sequence, at, truth.rate, 0, values[:, at:stop].copy(),
                    np.zeros(n, np.uint8), missing,
                )
            )  # fmt: skip
            sequence += 1
            first = stop
    assert first == len(counts)
    return found


@pytest.mark.parametrize("told", [True, False])
def test_a_gap_inside_a_revolution_is_a_break_and_a_flag(told: bool) -> None:
    truth = steady(8, 400)
    assembler = Assembler(setup_for("modulo", 360), 2, 400.0)
    found = [r for b in gap(truth, 1050, 30, told) for r in assembler.push(b)]
    assert [r.first_sample for r in found] == [c.first for c in reference(truth, "modulo")]
    hit = next(r for r in found if r.lost_samples)
    assert hit.flags == Flag.LOST_SAMPLES
    assert (hit.lost_samples, hit.samples) == (30, 370)
    assert len(hit.segments) == 2
    assert 1050 not in hit.sample_indices()
    assert assembler.lost_samples == 30
    for other in found:
        if other is not hit:
            assert other.flags == Flag.GOOD


@pytest.mark.parametrize("lost", [500, 2100, 4000])
def test_revolutions_lost_in_a_gap_are_counted(lost: int) -> None:
    truth = steady(30, 400)
    assembler = Assembler(setup_for("modulo", 360), 2, 400.0)
    found = [r for b in gap(truth, 3050, lost) for r in assembler.push(b)]
    wanted = {c.ordinal: c for c in reference(truth, "modulo")}
    before, after = (
        max((r for r in found if r.end_sample <= 3050 + lost), key=lambda r: r.ordinal),
        (found[[bool(r.flags & Flag.GAP_BEFORE) for r in found].index(True)]),
    )
    assert before.flags & Flag.PARTIAL
    assert after.flags & Flag.PARTIAL
    assert after.lost_samples == lost
    assert before.lost_samples == 0
    assert (
        after.ordinal - before.ordinal
        == truth.position[3050 + lost] // 360 - truth.position[3049] // 360
    )
    for revolution in found:
        if not revolution.flags & Flag.PARTIAL:
            assert revolution.first_sample == wanted[revolution.ordinal].first
            assert revolution.flags == Flag.GOOD


def test_a_device_that_starts_again_is_a_time_jump() -> None:
    truth = steady(10, 400)
    assembler = Assembler(setup_for("modulo", 360), 2, 400.0)
    given = list(blocks(counter(truth, "modulo"), 400.0, 50))
    found = []
    for i, block in enumerate(given):
        late = replace(block, first_sample=block.first_sample - 1000) if i > 40 else block
        found += assembler.push(late)
    assert sum(bool(r.flags & Flag.TIME_JUMP) for r in found) == 1


def test_a_long_stand_is_counted_but_not_kept() -> None:
    rate = 400.0
    moving = steady(3, 400).position
    stand = np.full(int(rate * 60), moving[-1] + 1)
    rest = stand[-1] + np.arange(1000) * 360 // 400
    position = np.concatenate([moving, stand, rest])
    truth = Shaft(360, rate, position)
    assembler, found = assemble(counter(truth, "modulo"), setup_for("modulo", 360), rate)
    paused = [r for r in found if r.flags & Flag.PAUSED]
    assert len(paused) == 1
    assert paused[0].samples < 400 + rate * STANDSTILL_S + 10
    assert paused[0].samples + paused[0].idle_samples == (
        paused[0].end_sample - paused[0].first_sample
    )
    assert paused[0].counts[-1] == 359
    assert assembler.lost_samples == 0


def test_memory_is_bounded_by_a_flagged_loss() -> None:
    dither = np.tile([10, 11], 5000)
    position = np.concatenate([np.arange(-300, 10), dither, np.arange(12, 800)])
    truth = Shaft(360, 400.0, position)
    _, found = assemble(counter(truth, "modulo"), setup_for("modulo", 360), 400.0, capacity=2000)
    hit = found[0]
    assert hit.flags & Flag.LOST_SAMPLES
    assert hit.flags & Flag.PARTIAL
    assert hit.samples == 2000
    assert hit.samples + hit.lost_samples == hit.end_sample - hit.first_sample
    assert found[1].flags == Flag.GOOD


def test_marks_of_the_device_become_flags() -> None:
    truth = steady(6, 400)
    quality = np.zeros(len(truth.position), np.uint8)
    quality[700] = 1
    quality[1100] = 8
    quality[1500] = 4
    assembler = Assembler(setup_for("modulo", 360), 2, 400.0)
    found = [
        r
        for b in blocks(counter(truth, "modulo"), 400.0, 64, quality=quality)
        for r in assembler.push(b)
    ]
    wanted = {700: Flag.SATURATED, 1100: Flag.COUNT_MISMATCH, 1500: Flag.LOST_SAMPLES}
    for revolution in found:
        marks = [
            flag
            for at, flag in wanted.items()
            if revolution.first_sample <= at < revolution.end_sample
        ]
        assert revolution.flags == (marks[0] if marks else Flag.GOOD)


def test_a_count_that_is_no_number_is_held_and_flagged() -> None:
    truth = steady(6, 400)
    counts = counter(truth, "modulo").astype(np.float64)
    counts[1100] = np.nan
    _, found = assemble(counts, setup_for("modulo", 360), 400.0)
    flags = [int(r.flags) for r in found]
    assert sorted(flags) == [0] * (len(flags) - 1) + [int(Flag.COUNT_MISMATCH)]


def test_discard_begins_at_the_next_index() -> None:
    truth = steady(6, 400)
    assembler = Assembler(setup_for("modulo", 360), 2, 400.0)
    found = []
    for block in blocks(counter(truth, "modulo"), 400.0, 50):
        if block.first_sample == 750:
            assembler.discard()
        found += assembler.push(block)
    firsts = [c.first for c in reference(truth, "modulo")]
    assert [r.first_sample for r in found] == [firsts[0], *firsts[2:]][: len(found)]
    assert found[1].ordinal == 2


@pytest.mark.parametrize(("counts", "direction"), [(3, 1), (360, 0)])
def test_an_impossible_encoder_is_refused(counts: int, direction: int) -> None:
    with pytest.raises(ValueError, match="must be"):
        EncoderSetup(counts, direction)
