"""Follow the counter sample by sample: unwrapped position, revolution cuts, everything suspicious.

One compiled pass, so that the result cannot depend on how the samples came in blocks: all memory
between two calls is in ``state``.

Words used here. *step*: counts turned from one sample to the next. *index event*: the counter was
set to zero by the index pulse between two samples. *base*: position of the index at which the
present revolution began. A revolution ends when the position has gone one whole revolution away
from its base, in either direction, so that swinging back and forth over the index cuts once.
"""

from __future__ import annotations

from enum import IntEnum

import numba
import numpy as np
from numpy.typing import NDArray

from rigapp.engine.messages import Flag

Counts = NDArray[np.int64]
Counts2 = NDArray[np.int64]

STANDSTILL_S = 2.0
"""Samples of a standing crank beyond this time are counted, but not kept."""


class S(IntEnum):
    """Places in the state vector."""

    STARTED = 0
    PREVIOUS = 1
    POSITION = 2
    BASE = 3
    STEP = 4
    LOCKED = 5
    INSIDE = 6
    PENDING = 7
    PENDING_KEPT = 8
    PENDING_SAMPLE = 9
    RUN = 10
    KEPT = 11
    FLAGS = 12
    LOST = 13
    IDLE = 14
    ORDINAL = 15
    HIGH = 16
    ODD = 17
    ODD_STEP = 18
    SKIPPING = 19
    UNLOCKED_TURN = 20
    START_KEPT = 21
    INDEX_EVENTS = 22
    COUNT_ERRORS = 23
    LAST_MOVED = 24
    OTHER = 25
    OTHER_VALID = 26
    PENDING_POSITION = 27
    TRAVEL = 28
    TRAVEL_FIRST = 29
    SIZE = 30


class P(IntEnum):
    """Places in the parameter vector."""

    COUNTS = 0
    DIRECTION = 1
    RESTARTS = 2
    MODULUS = 3
    STEP_TOLERANCE = 4
    MISSED_AFTER = 5
    IDLE_AFTER = 6
    CAPACITY = 7
    SIZE = 8


class E(IntEnum):
    """Columns of an event."""

    KIND = 0
    KEPT = 1
    SAMPLE = 2
    BASE = 3
    ORDINAL = 4
    FLAGS = 5
    LOST = 6
    IDLE = 7
    END_POSITION = 8
    SIZE = 9


CUT = 1
"""Event: a revolution ended before this sample and another begins with it."""
BEGIN = 2
"""Event: the first revolution begins with this sample; what came before had no known angle."""
BREAK = 3
"""Event: time is not continuous before this sample."""

_LOST = int(Flag.LOST_SAMPLES)
_MISMATCH = int(Flag.COUNT_MISMATCH)
_MISSED = int(Flag.MISSED_INDEX)
_SATURATED = int(Flag.SATURATED)
_GAP = int(Flag.GAP_BEFORE)
_REVERSED = int(Flag.REVERSED)
_PARTIAL = int(Flag.PARTIAL)
_TIME_JUMP = int(Flag.TIME_JUMP)
_PAUSED = int(Flag.PAUSED)

_STARTED, _PREVIOUS, _POSITION, _BASE, _STEP = 0, 1, 2, 3, 4
_LOCKED, _INSIDE, _PENDING, _PENDING_KEPT, _PENDING_SAMPLE = 5, 6, 7, 8, 9
_RUN, _KEPT, _FLAGS, _LOST_COUNT, _IDLE, _ORDINAL, _HIGH = 10, 11, 12, 13, 14, 15, 16
_ODD, _ODD_STEP, _SKIPPING, _TURN, _START_KEPT = 17, 18, 19, 20, 21
_INDEX_EVENTS, _COUNT_ERRORS, _LAST_MOVED, _OTHER, _OTHER_VALID = 22, 23, 24, 25, 26
_PENDING_POSITION, _TRAVEL, _TRAVEL_FIRST = 27, 28, 29
_CUT, _BEGIN, _BREAK = CUT, BEGIN, BREAK


@numba.njit("int64(int64, int64)", cache=True, nogil=True)
def wrap(value: int, modulus: int) -> int:
    """Return the value modulo ``modulus`` that lies in [-modulus/2, modulus/2)."""
    half = modulus // 2
    return (value + half) % modulus - half


@numba.njit("void(int64[:, ::1], int64, int64, int64, int64, int64[::1], int64)",
            cache=True, nogil=True)  # fmt: skip
def _event(
    events: Counts2, row: int, kind: int, kept: int, sample: int, state: Counts, end: int
) -> None:
    events[row, 0] = kind
    events[row, 1] = kept
    events[row, 2] = sample
    events[row, 3] = state[_BASE]
    events[row, 4] = state[_ORDINAL]
    events[row, 5] = state[_FLAGS]
    events[row, 6] = state[_LOST_COUNT]
    events[row, 7] = state[_IDLE]
    events[row, 8] = end


@numba.njit("int64(int64[::1], uint8[::1], int64, int64, int64[::1], float64[::1], int64[::1],"
            "int64[::1], uint8[::1], int64[:, ::1])", cache=True, nogil=True)  # fmt: skip
def scan(
    counts: Counts,
    quality: NDArray[np.uint8],
    first_sample: int,
    lost: int,
    state: Counts,
    mean_step: NDArray[np.float64],
    parameters: Counts,
    position: Counts,
    keep: NDArray[np.uint8],
    events: Counts2,
) -> int:
    """Follow the counts of one block and return the number of events.

    counts: (n,) raw counts. quality: (n,) flags of ``drivers.api.Quality``. first_sample: device
    index of the first. lost: samples lost before it, 0 none, -1 unknown. state, mean_step: memory
    between calls. parameters: see ``P``. position: (n,) out, unwrapped counts in the rig's positive
    sense. keep: (n,) out, 0 for samples not worth keeping. events: (rows, E.SIZE) out, 2 n rows at
    least.
    """
    turn = parameters[0]
    direction = parameters[1]
    restarts = parameters[2] != 0
    modulus = parameters[3]
    tolerance = parameters[4]
    missed_after = parameters[5]
    idle_after = parameters[6]
    capacity = parameters[7]
    found = 0
    half = turn // 2
    smooth = min(8, turn // 4)
    plain = modulus == 0 or modulus >= turn
    for i in range(counts.shape[0]):
        count = counts[i] * direction
        sample = first_sample + i
        if (
            plain
            and quality[i] == 0
            and state[_LOCKED] == 1
            and (i > 0 or lost == 0)
            and state[_PENDING] + state[_ODD] + state[_OTHER_VALID] + state[_SKIPPING] == 0
            and state[_KEPT] - state[_START_KEPT] < capacity
        ):
            # Nearly every sample: a small step forward within a revolution. Same as all below.
            delta = count - state[_PREVIOUS]
            now = state[_POSITION] + delta
            if (
                0 < delta < half
                and abs(delta - state[_STEP]) <= smooth
                and -turn < now - state[_BASE] < turn
                and now >= state[_HIGH] - 4
            ):
                state[_PREVIOUS] = count
                state[_POSITION] = now
                state[_STEP] = delta
                state[_HIGH] = max(now, state[_HIGH])
                state[_TRAVEL] += delta
                if i == 0:
                    state[_TRAVEL_FIRST] = state[_TRAVEL]
                state[_LAST_MOVED] = sample
                state[_RUN] = 0
                state[_KEPT] += 1
                mean_step[0] += (delta - mean_step[0]) / 64.0
                position[i] = now
                keep[i] = 1
                continue
        flags = 0
        mark = quality[i]
        if mark != 0:
            if mark & 1:
                flags |= _SATURATED
            if mark & 6:
                flags |= _LOST
            if mark & 8:
                flags |= _MISMATCH

        if state[_STARTED] == 0:
            state[_STARTED] = 1
            state[_PREVIOUS] = count
            start = count if not restarts else 0
            state[_POSITION] = start
            state[_BASE] = start - start % turn
            state[_HIGH] = start
            state[_LOCKED] = 0 if restarts else 1
            state[_LAST_MOVED] = sample
            state[_STEP] = 0
            state[_TRAVEL_FIRST] = state[_TRAVEL]
            position[i] = start
            keep[i] = 1
            state[_KEPT] += 1
            continue

        gap = i == 0 and lost != 0
        delta = count - state[_PREVIOUS]
        if modulus > 0:
            delta = wrap(delta, modulus)
        step = wrap(delta, turn) if restarts else delta
        expected = state[_STEP]
        before = state[_POSITION]
        base = state[_BASE]
        seen = False
        odd = False
        other = False
        move = step

        if gap:
            if restarts:
                foreseen = mean_step[0] * (max(lost, 0) + 1)
                step += turn * int(np.floor((foreseen - step) / turn + 0.5))
                move = step
            now = before + step
            if state[_LOCKED] and restarts:
                now += wrap(count - now, turn)
            flags |= _LOST
            if lost < 0 or (restarts and abs(mean_step[0] * lost) > 25 * turn):
                flags |= _TIME_JUMP
            if lost > 0:
                state[_LOST_COUNT] += lost
        else:
            slack = min(4 + 4 * tolerance + abs(expected) // 8, turn // 4)
            allowed = 2 + tolerance + abs(expected) // 50
            odd = abs(step - expected) > slack
            if odd:
                move = expected
            wrapped = restarts and delta != step
            phase = wrap(count, turn) if restarts else 0
            at_zero = restarts and (
                min(expected, 0) - 2 - tolerance <= phase <= max(expected, 0) + 2 + tolerance
            )
            if wrapped or (odd and at_zero):
                state[_INDEX_EVENTS] += 1
                jumped = False
                if state[_LOCKED] == 0:
                    state[_LOCKED] = 1
                    state[_INSIDE] = 1
                    state[_BASE] = 0
                    base = 0
                    before = phase - (step if not odd else 0)
                    now = phase
                    state[_HIGH] = now
                    state[_FLAGS] = 0
                    state[_LOST_COUNT] = 0
                    state[_IDLE] = 0
                    state[_PENDING] = 0
                    state[_START_KEPT] = state[_KEPT]
                    _event(events, found, _BEGIN, state[_KEPT], sample, state, now)
                    found += 1
                    if not odd:
                        state[_STEP] = step
                else:
                    target = before + expected
                    boundary = base + turn * int(np.floor((target - phase - base) / turn + 0.5))
                    deviation = target - boundary - phase
                    if abs(deviation) <= turn // 8:
                        now = boundary + phase
                        seen = True
                        if odd:
                            state[_OTHER] = target
                            other = True
                        if abs(deviation) > allowed:
                            flags |= _MISMATCH
                            state[_COUNT_ERRORS] += 1
                    elif wrapped and not odd:
                        # A whole turn of counts since the last index: the counter is right again.
                        ahead = (before - base) // turn + (1 if step >= 0 else 0)
                        now = base + ahead * turn + phase
                        seen = True
                        flags |= _MISMATCH
                        state[_COUNT_ERRORS] += 1
                    else:
                        now = before + expected
                        jumped = not at_zero
                        flags |= _MISMATCH
                        state[_COUNT_ERRORS] += 1
                    if not odd:
                        state[_STEP] = step
                state[_ODD] = 1 if jumped else 0
                state[_ODD_STEP] = step
            elif odd:
                target = before + expected
                if restarts:
                    aligned = target + wrap(count - target, turn)
                elif modulus > 0:
                    aligned = target + wrap(count - target, modulus)
                else:
                    aligned = count
                if state[_OTHER_VALID]:
                    # A single zero reading near the index looks like the index: go back.
                    former = state[_OTHER] + expected
                    if abs(wrap(count - former, turn)) <= 2 + tolerance + abs(expected) // 8:
                        target = former
                        aligned = former + wrap(count - former, turn)
                if abs(aligned - target) <= 2 + tolerance + abs(expected) // 8:
                    now = aligned
                    state[_ODD] = 0
                elif state[_ODD] and abs(step - state[_ODD_STEP]) <= slack:
                    now = before + step
                    move = step
                    state[_STEP] = step
                    state[_ODD] = 0
                else:
                    now = target
                    state[_ODD] = 1
                    state[_ODD_STEP] = step
                    if state[_LOCKED]:
                        flags |= _MISMATCH
                        state[_COUNT_ERRORS] += 1
            else:
                now = before + step
                state[_STEP] = step
                if state[_ODD] and state[_LOCKED]:
                    # The jump has stayed: samples went missing unseen, and the count is right.
                    jump = wrap(count - now, turn) if restarts else count - now
                    if abs(jump) <= half:
                        now += jump
                state[_ODD] = 0
            mean_step[0] += (state[_STEP] - mean_step[0]) / 64.0

        moved = now != before or count != state[_PREVIOUS]
        state[_PREVIOUS] = count
        state[_POSITION] = now
        state[_OTHER_VALID] = 1 if other else 0
        state[_TRAVEL] += move
        if i == 0:
            state[_TRAVEL_FIRST] = state[_TRAVEL]
        state[_FLAGS] |= flags
        if seen:
            state[_HIGH] = now
        if moved:
            state[_LAST_MOVED] = sample

        if state[_LOCKED] == 0:
            state[_TURN] += step
            state[_HIGH] = now
        else:
            ahead_of = now - base
            if ahead_of >= turn:
                crossed = ahead_of // turn
                if seen or gap or not restarts:
                    kept, at, end = state[_KEPT], sample, now
                    cut = True
                else:
                    if state[_PENDING] == 0:
                        state[_PENDING] = 1
                        state[_PENDING_KEPT] = state[_KEPT]
                        state[_PENDING_SAMPLE] = sample
                        state[_PENDING_POSITION] = now
                    kept, at = state[_PENDING_KEPT], state[_PENDING_SAMPLE]
                    end = state[_PENDING_POSITION]
                    cut = ahead_of - turn > missed_after
                    if cut:
                        state[_FLAGS] |= _MISSED
            elif ahead_of <= -turn:
                crossed = -((-ahead_of) // turn)
                state[_FLAGS] |= _REVERSED
                kept, at, end = state[_KEPT], sample, now
                cut = True
            else:
                crossed = 0
                kept, at, end = state[_KEPT], sample, now
                cut = False
                state[_PENDING] = 0
            if cut:
                state[_PENDING] = 0
                carried = 0
                new_base = base + crossed * turn
                if gap:
                    carried = _GAP | _LOST
                    if abs(new_base - before) > turn // 100 or abs(crossed) > 1:
                        state[_FLAGS] |= _PARTIAL
                    if abs(now - new_base) > turn // 100:
                        carried |= _PARTIAL
                _event(events, found, _CUT if state[_INSIDE] else _BEGIN, kept, at, state, end)
                found += 1
                state[_INSIDE] = 1
                state[_BASE] = new_base
                state[_ORDINAL] += abs(crossed)
                state[_FLAGS] = carried
                state[_LOST_COUNT] = max(lost, 0) if gap else 0
                state[_IDLE] = 0
                state[_HIGH] = now
                state[_START_KEPT] = kept
            elif now > state[_HIGH]:
                state[_HIGH] = now
            elif now < state[_HIGH] - 4 and not odd and not gap:
                state[_FLAGS] |= _REVERSED

        position[i] = now
        state[_RUN] = 0 if moved else state[_RUN] + 1
        wanted = True
        if state[_RUN] > idle_after:
            wanted = False
            state[_IDLE] += 1
            state[_FLAGS] |= _PAUSED
        elif state[_KEPT] - state[_START_KEPT] >= capacity:
            wanted = False
            state[_LOST_COUNT] += 1
            state[_FLAGS] |= _LOST | _PARTIAL
        if wanted:
            if state[_SKIPPING] or gap:
                _event(events, found, _BREAK, state[_KEPT], sample, state, now)
                found += 1
            state[_SKIPPING] = 0
            keep[i] = 1
            state[_KEPT] += 1
        else:
            state[_SKIPPING] = 1
            keep[i] = 0
    return found


def new_state() -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the memory of a counter that has not been seen yet."""
    return np.zeros(int(S.SIZE), np.int64), np.zeros(1, np.float64)
