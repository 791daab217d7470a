"""The bench's judge of samples finds what is wrong; a loss without a number is in the count."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from rigapp.testing.bench import COUNTS, PERIOD, SourceBench, wait_until
from rigapp.testing.contracts import read_contracts

Make = Callable[..., SourceBench]


def test_the_judge_finds_what_is_wrong(bench: Make) -> None:
    b = bench(next(c for c in read_contracts() if c.info.name == "gsv8"))
    b.connect()
    block = max(b.blocks(200), key=lambda block: block.values.shape[1])
    assert block.values.shape[1] > 8
    b.judge([block])
    shorter = replace(
        block, values=np.delete(block.values, 3, axis=1), quality=np.delete(block.quality, 3)
    )
    with pytest.raises(AssertionError, match="missing without a flag"):
        b.judge([shorter])
    for row, error, words in ((2, 0.5, "analog_3: wrong samples"), (4, 5.0, "counter_1 steps")):
        values = block.values.copy()
        values[row, 2] += error
        with pytest.raises(AssertionError, match=words):
            b.judge([replace(block, values=values)])


def test_a_frame_lost_without_a_number_shows_in_the_count(bench: Make) -> None:
    b = bench(next(c for c in read_contracts() if c.info.name == "gsv8"))
    b.connect()
    counts = [count for block in b.blocks(100) for count in block.values[-1]]
    b.simulator.inject("dropped_frames", value=20.0)

    def jumps() -> bool:
        for block in b.blocks(20):
            counts.extend(block.values[-1])
        steps = np.diff(counts) % COUNTS
        return bool((np.abs(steps - 21 * COUNTS / PERIOD) <= 1.0).any())

    wait_until(jumps, "the jump of the count that the engine looks for")
