"""A crank whose true position is known, its counter, and a slow plain reference of the cutting."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.assembler import Assembler, EncoderSetup, Margins, Revolution
from rigapp_drivers.api import Block

Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Shaft:
    """A random motion. position: whole counts (samples,), 0 at an index."""

    turn: int
    rate: float
    position: Ints


def shaft(
    seed: int, turn: int, rate: float, seconds: float, reverse: bool, top_rev_per_s: float
) -> Shaft:
    """Return a motion from a stand through ramps, stands, and (``reverse``) reversals."""
    rng = np.random.default_rng(seed)
    n = int(seconds * rate)
    top = min(top_rev_per_s, 0.3 * rate)
    knots = max(4, int(seconds * 2))
    speeds = rng.uniform(-top if reverse else 0.0, top, knots)
    speeds[0] = 0.0
    speeds[rng.integers(1, knots)] = 0.0
    time = np.arange(n) / rate
    speed = np.interp(time, np.linspace(0, seconds, knots), speeds)
    turns = rng.uniform(0.3, 0.7) + np.cumsum(speed) / rate
    return Shaft(turn, rate, np.floor(turns * turn).astype(np.int64))


def counter(truth: Shaft, kind: str, seed: int = 0) -> Ints:
    """Return what the counter shows.

    ``modulo``: 0 .. turn - 1. ``signed``: set to zero at every index passed, negative behind it, an
    arbitrary value before the first index. ``runs on``: never set to zero.
    """
    position, turn = truth.position, truth.turn
    if kind == "modulo":
        return position % turn
    if kind == "runs on":
        return position
    out = np.empty_like(position)
    zero = int(position[0])
    for i, now in enumerate(position):
        if i and now // turn != position[i - 1] // turn:
            forward = now > position[i - 1]
            zero = int(now // turn * turn if forward else position[i - 1] // turn * turn)
        out[i] = now - zero
    return out


@dataclass(frozen=True)
class Cut:
    """A revolution as the reference cuts it."""

    ordinal: int
    first: int
    end: int
    base: int


def reference(truth: Shaft, kind: str) -> list[Cut]:
    """Cut by the true position, one sample at a time."""
    position, turn = truth.position, truth.turn
    cuts: list[Cut] = []
    base: int | None = int(position[0] // turn * turn) if kind == "runs on" else None
    inside = False
    start = ordinal = 0
    for i in range(1, len(position)):
        now, before = int(position[i]), int(position[i - 1])
        if base is None:
            if now // turn != before // turn:
                base = (now if now > before else before) // turn * turn
                start, inside = i, True
            continue
        crossed = 0
        if now - base >= turn:
            crossed = (now - base) // turn
        elif base - now >= turn:
            crossed = -((base - now) // turn)
        if crossed:
            if inside:
                cuts.append(Cut(ordinal, start, i, base))
            base += crossed * turn
            ordinal += abs(crossed)
            start, inside = i, True
    return cuts


def blocks(
    counts: NDArray[np.generic],
    rate: float,
    sizes: Iterable[int] | int,
    dtype: type = np.float32,
    quality: NDArray[np.uint8] | None = None,
) -> Iterable[Block]:
    """Split a count into Blocks; channel 0 carries the sample's own index."""
    n = len(counts)
    values = np.zeros((3, n), dtype)
    values[0] = np.arange(n)
    values[2] = counts
    flags = quality if quality is not None else np.zeros(n, np.uint8)
    start = sequence = 0
    given = iter(sizes) if not isinstance(sizes, int) else None
    while start < n:
        size = next(given, n) if given is not None else sizes
        end = min(n, start + max(1, size))  # type: ignore[type-var]
        yield Block(
            "daq",
            sequence,
            start,
            rate,
            sequence,
            np.ascontiguousarray(values[:, start:end]),
            flags[start:end],
        )
        start, sequence = end, sequence + 1


def assemble(
    counts: NDArray[np.generic],
    setup: EncoderSetup,
    rate: float,
    sizes: Iterable[int] | int = 64,
    margins: Margins | None = None,
    **options: object,
) -> tuple[Assembler, list[Revolution]]:
    """Push a count through an assembler."""
    assembler = Assembler(setup, 2, rate, margins, **options)  # type: ignore[arg-type]
    found: list[Revolution] = []
    for block in blocks(counts, rate, sizes):
        found += assembler.push(block)
    return assembler, found
