"""Split the byte stream into scans, check the alignment of every one, and decode in bulk; pure.

The stream has no sync word, so the counter entry serves as one: from scan to scan it may change
only as the shaft can turn (internal clock), or by exactly one (encoder clock). A lost or added byte
puts other bytes in the counter's place. Such a word passes one check by chance with a probability
of ``Steps.odds`` (1/65536 for the encoder clock). The last ``GUARD`` scans are therefore held back
until later scans have passed, and are discarded with the first one that fails.

With the encoder clock a step of n + 1 followed by ``GUARD`` steps of 1 is a loss of n whole scans:
the alignment holds, the gap is known exactly and the stream continues. The scan with that step is
discarded, too, as it may be joined from the ends of two. After any other mismatch the parser stops
until ``restart``.

Not detected here: bytes that change without being lost (USB checks them), and with the internal
clock whole scans lost while the shaft is stationary, or turns so slowly that ``Steps.change`` hides
them. The host's clock detects those.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rigapp.texts import say
from rigapp_drivers.api import Quality
from rigapp_drivers.dataq.protocol import (
    COUNTER_SPAN,
    counts_of,
    lines_of,
    saturated_limits,
    without_echo,
)

GUARD: Final = 4  # a wrong scan passes this number of checks with odds of 65536^-4 (encoder clock)
MOST_LOST: Final = COUNTER_SPAN // 2  # beyond this the 16-bit counter's direction is ambiguous
GAP: Final = Quality.LOST_BEFORE | Quality.COUNT_SUSPECT

Words = NDArray[np.uint16]


@dataclass(frozen=True, slots=True)
class Layout:
    """Layout of a scan: analog words first, then a digital one, a rate, the counter last."""

    analog: int
    digital: bool = False
    rate: bool = False
    mask: int = 0xFFFF

    @property
    def words(self) -> int:
        """Return the 16-bit words of a scan; the counter is the last, and the last row."""
        return self.analog + self.digital + self.rate + 1


@dataclass(frozen=True, slots=True)
class Steps:
    """Allowed steps of the counter from one scan to the next.

    change: maximum difference of a step from the previous one.
    """

    lowest: int
    highest: int
    change: int

    @property
    def exact(self) -> bool:
        """Return whether the counter clocks the scans: one count, one scan."""
        return self.lowest == self.highest == 1

    @property
    def odds(self) -> float:
        """Return the probability that a random word passes one check."""
        width = min(self.highest - self.lowest, 2 * self.change) + 1
        return width / COUNTER_SPAN


ENCODER_STEPS: Final = Steps(1, 1, 0)


@dataclass(frozen=True, slots=True)
class Run:
    """Samples without a gap among them.

    values: (rows, samples) int32 in the order of the scan; the counter unwrapped (modulo 2**32).
    lost_before: scans lost before it; None: an unknown number.
    """

    values: NDArray[np.int32]
    quality: NDArray[np.uint8]
    lost_before: int | None = 0


@dataclass(frozen=True, slots=True)
class Mark:
    """Reference scan: count, unwrapped count, and the step to it if known."""

    count: int
    total: int
    step: int | None = None


class ScanParser:
    """Parse bytes in any pieces and return runs of valid scans; never raises for invalid bytes.

    echoes: possible echoes before the first scan. ``broken``: why the stream must be restarted.
    ``received``: whole scans since the last (re)start, including held and discarded ones.
    """

    def __init__(self, layout: Layout, steps: Steps, echoes: tuple[bytes, ...] = ()) -> None:
        self.layout = layout
        self.steps = steps
        self.broken: str | None = None
        self.received = 0
        self.discarded_bytes = 0
        self.echoes = echoes
        self._begun = False
        self._resumed = False
        self._bytes = b""
        self._held = 0
        self._last: Mark | None = None  # the last returned scan
        self._mark: Mark | None = None  # the reference of the next scan
        self._gap: int | None = 0  # scans missing before the next run
        self._limits = saturated_limits(layout.mask)
        self._signed_mask = np.int16(np.array(layout.mask, np.uint16).astype(np.int16))

    @property
    def held(self) -> int:
        """Return the number of whole scans held back."""
        return self._held

    def restart(self, *, clean: bool = False) -> None:
        """Expect a stream from its beginning; the counter continues from the last valid scan.

        clean: the previous stream was stopped and read to its end, so that nothing need be lost.
        """
        self.discarded_bytes += len(self._bytes)
        self._bytes = b""
        self._held = 0
        self._begun = False
        self._resumed = self._last is not None or not clean
        self._mark = None
        self.broken = None
        self.received = 0

    def feed(self, data: bytes) -> list[Run]:
        """Return the runs confirmed by these bytes, oldest first."""
        if self.broken is not None:
            self.discarded_bytes += len(data)
            return []
        return self._take(self._bytes + data, GUARD)

    def finish(self) -> list[Run]:
        """Return the scans held back at the stream's end; none if it is broken."""
        return [] if self.broken is not None else self._take(self._bytes, 0)

    def _take(self, data: bytes, guard: int) -> list[Run]:
        if not self._begun:
            stripped = without_echo(data, self.echoes)
            if stripped is None:
                self._bytes = data
                return []
            self._begun = True
            data = stripped
        size = 2 * self.layout.words
        scans = len(data) // size
        words = np.frombuffer(data, "<u2", scans * self.layout.words).reshape(
            scans, self.layout.words
        )
        self.received += scans - self._held
        runs: list[Run] = []
        begin = self._scan(words, guard, runs)
        self._held = scans - begin
        self._bytes = b"" if self.broken is not None else data[begin * size :]
        if self.broken is not None:
            self.discarded_bytes += len(data) - begin * size
            self._held = 0
        return runs

    def _scan(self, words: Words, guard: int, runs: list[Run]) -> int:
        """Append confirmed scans to ``runs``; return the index of the first held scan."""
        begin = 0
        if self._mark is None and len(words):
            begin = self._enter(int(counts_of(words[:1, -1])[0]))
        while begin < len(words):
            steps, bad = self._check(words[begin:])
            if bad is None:
                end = max(begin, len(words) - guard)
                self._append_runs(words[begin:end], steps, runs)
                return end
            safe = begin + max(0, bad - GUARD)
            behind = steps[bad + 1 : bad + 1 + GUARD]
            missing = int(steps[bad])
            aligned = self.steps.exact and 1 < missing < MOST_LOST and bool((behind == 1).all())
            if not aligned or (len(behind) < GUARD and not guard):
                self._append_runs(words[begin:safe], steps, runs)
                self.broken = self._reason(missing)
                return safe
            if len(behind) < GUARD:
                self._append_runs(words[begin:safe], steps, runs)
                return safe
            self._append_runs(words[begin : begin + bad], steps, runs)
            begin += bad + 1
            self._skip(missing)
        return begin

    def _enter(self, count: int) -> int:
        """Use the first scan of a stream as reference; return the number of consumed scans.

        It cannot be verified, so it is discarded, unless it is the very next pulse.
        """
        last = self._last
        step = (count - last.count) % COUNTER_SPAN if last is not None else 0
        if last is not None and self.steps.exact and step == 1:
            self._mark, self._gap, self._resumed = last, 0, False
            return 0
        self._mark = Mark(count, last.total + step if last is not None else count)
        if last is not None and self.steps.exact:
            self._gap = step
        else:
            self._gap = None if self._resumed else 0
        return 1

    def _skip(self, missing: int) -> None:
        """Skip a scan whose count is ``missing`` after the mark, and the scans lost before it."""
        assert self._mark is not None
        count = (self._mark.count + missing) % COUNTER_SPAN
        self._mark = Mark(count, self._mark.total + missing)
        self._gap = missing

    def _check(self, words: Words) -> tuple[Words, int | None]:
        """Return the step to each scan, and the index of the first with an impossible step."""
        mark, rule = self._mark, self.steps
        assert mark is not None
        counts = counts_of(words[:, -1])
        steps = np.empty_like(counts)
        np.subtract(counts[1:], counts[:-1], out=steps[1:])
        steps[0] = (int(counts[0]) - mark.count) % COUNTER_SPAN
        if rule.exact:
            wrong = steps != 1
        else:
            wrong = (steps < rule.lowest) | (steps > rule.highest)
            signed = steps.astype(np.int32)
            change = np.diff(signed, prepend=signed[:1] if mark.step is None else mark.step)
            wrong |= np.abs(change) > rule.change
        first = int(wrong.argmax())
        return steps, first if wrong[first] else None

    def _append_runs(self, words: Words, steps: Words, runs: list[Run]) -> None:
        if len(words) == 0:
            return
        run = self._decoded(words, steps[: len(words)])
        if self._gap != 0:
            run.quality[0] |= GAP
            if self._resumed:
                run.quality[0] |= Quality.RESYNCHRONISED
            run = Run(run.values, run.quality, self._gap)
        self._gap, self._resumed = 0, False
        runs.append(run)

    def _decoded(self, words: Words, steps: Words) -> Run:
        """Return scans as rows, and use the last one as mark."""
        layout, mark = self.layout, self._mark
        assert mark is not None
        rows = np.empty((layout.words, len(words)), np.int32)
        signed = words.view(np.int16)
        inputs = rows[: layout.analog]
        inputs[...] = signed[:, : layout.analog].T
        if layout.mask != 0xFFFF:
            inputs &= np.int32(self._signed_mask)
        row = layout.analog
        if layout.digital:
            rows[row] = lines_of(words[:, row])
            row += 1
        if layout.rate:
            rows[row] = signed[:, row]
        travel = np.cumsum(steps, dtype=np.int64) + mark.total
        rows[-1] = travel.astype(np.int32)
        count = int(counts_of(words[-1:, -1])[0])
        self._last = self._mark = Mark(count, int(travel[-1]), int(steps[-1]))
        return Run(rows, self._saturation(inputs))

    def _saturation(self, inputs: NDArray[np.int32]) -> NDArray[np.uint8]:
        quality = np.zeros(inputs.shape[1], np.uint8)
        low, high = self._limits
        if inputs.size and (inputs.max() >= high or inputs.min() <= low):
            over = ((inputs >= high) | (inputs <= low)).any(axis=0)
            quality[over] = Quality.SATURATED
        return quality

    def _reason(self, step: int) -> str:
        signed = step - COUNTER_SPAN if step > MOST_LOST else step
        expected = (
            "1" if self.steps.exact else say("{} to {}", self.steps.lowest, self.steps.highest)
        )
        return say(
            "the counter stepped by {} from one scan to the next, where {} (and a"
            " change of {} at most) is possible",
            signed,
            expected,
            self.steps.change,
        )
