"""Follow the counter sample by sample: position, revolution cuts, everything suspicious.

All memory is in one vector, ``state``, so that the result cannot depend on how the samples came in
blocks.

A revolution ends when the position has gone one whole revolution away from its base, in either
direction, so that swinging back and forth over the index cuts once. Where the counter restarts at
the index, the cut waits for the index event; when the count has run an eighth of a turn beyond
without one, the cut is made where the count says, and flagged.

Words used here. *step*: counts turned from one sample to the next. *index event*: the counter was
set to zero by the index pulse between two samples. *base*: position of the index at which the
present revolution began. *odd*: a step that no motion explains.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from model.compiled import njit
from rigapp.engine.samples.counterstate import BEGIN, BREAK, CUT, Counts, Floats
from rigapp.engine.samples.counterstate import ParameterAt as P
from rigapp.engine.samples.counterstate import StateAt as S
from rigapp.schema.messages import Flag

_CUT, _BEGIN, _BREAK = CUT, BEGIN, BREAK

_STARTED, _LOCKED, _INSIDE, _POSITION = map(int, (S.STARTED, S.LOCKED, S.INSIDE, S.POSITION))
_PREVIOUS, _BASE, _STEP, _BEFORE = map(int, (S.PREVIOUS, S.BASE, S.STEP, S.BEFORE))
_RUN, _KEPT, _START_KEPT, _SKIPPING = map(int, (S.RUN, S.KEPT, S.START_KEPT, S.SKIPPING))
_FLAGS, _LOST, _IDLE, _HIGH = map(int, (S.FLAGS, S.LOST, S.IDLE, S.HIGH))
_JUMPED, _JUMP_STEP, _OTHER = map(int, (S.JUMPED, S.JUMP_STEP, S.OTHER))
_OTHER_VALID, _TURNED, _TRAVEL = map(int, (S.OTHER_VALID, S.UNLOCKED_TURN, S.TRAVEL))
_TRAVEL_FIRST, _LAST_MOVED, _ORDINAL = map(int, (S.TRAVEL_FIRST, S.LAST_MOVED, S.ORDINAL))
_INDEX_EVENTS, _COUNT_ERRORS = int(S.INDEX_EVENTS), int(S.COUNT_ERRORS)
_SEEN, _ODD, _GAP = map(int, (S.SEEN, S.ODD, S.GAP))
_PENDING, _PENDING_KEPT = int(S.PENDING), int(S.PENDING_KEPT)
_PENDING_SAMPLE, _PENDING_POSITION = int(S.PENDING_SAMPLE), int(S.PENDING_POSITION)

_TURN, _DIRECTION, _RESTARTS, _MODULUS = map(int, (P.COUNTS, P.DIRECTION, P.RESTARTS, P.MODULUS))
_TOLERANCE, _MISSED_AFTER = int(P.TOLERANCE), int(P.MISSED_AFTER)
_IDLE_AFTER, _CAPACITY = int(P.IDLE_AFTER), int(P.CAPACITY)

_F_LOST = int(Flag.LOST_SAMPLES)
_F_MISMATCH = int(Flag.COUNT_MISMATCH)
_F_MISSED = int(Flag.MISSED_INDEX)
_F_SATURATED = int(Flag.SATURATED)
_F_GAP = int(Flag.GAP_BEFORE)
_F_REVERSED = int(Flag.REVERSED)
_F_PARTIAL = int(Flag.PARTIAL)
_F_TIME_JUMP = int(Flag.TIME_JUMP)
_F_PAUSED = int(Flag.PAUSED)
_F_SENSOR = int(Flag.SENSOR_FAULT)

LARGEST_GAP_REVOLUTIONS = 25
"""Beyond so many revolutions the number of those lost in a gap is not certain."""


@njit("int64(int64, int64)", cache=True, nogil=True)
def wrap(value: int, modulus: int) -> int:
    """Return the value modulo ``modulus`` that lies in [-modulus/2, modulus/2)."""
    half = modulus // 2
    return (value + half) % modulus - half


@njit("void(int64, int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _begin_counting(count: int, sample: int, state: Counts, parameters: Counts) -> None:
    """Take the first count of all: it says where the crank is only if it never restarts."""
    restarts = parameters[_RESTARTS] != 0
    start = 0 if restarts else count
    state[_STARTED] = 1
    state[_PREVIOUS] = count
    state[_POSITION] = start
    state[_BASE] = start - start % parameters[_TURN]
    state[_HIGH] = start
    state[_LOCKED] = 0 if restarts else 1
    state[_LAST_MOVED] = sample
    state[_TRAVEL_FIRST] = state[_TRAVEL]


@njit("void(int64[::1])", cache=True, nogil=True)
def _doubt(state: Counts) -> None:
    state[_FLAGS] |= _F_MISMATCH
    state[_COUNT_ERRORS] += 1


@njit("int64(int64, int64, int64, int64[::1], float64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _over_gap(
    count: int, step: int, lost: int, state: Counts, mean_step: Floats, parameters: Counts
) -> int:
    """Move over a gap in the samples, by the speed before it, and return the counts moved."""
    turn, restarts = parameters[_TURN], parameters[_RESTARTS] != 0
    if restarts:
        foreseen = mean_step[0] * (max(lost, 0) + 1)
        step += turn * int(np.floor((foreseen - step) / turn + 0.5))
    now = state[_BEFORE] + step
    if state[_LOCKED] and restarts:
        now += wrap(count - now, turn)
    state[_POSITION] = now
    state[_FLAGS] |= _F_LOST
    if lost < 0 or (restarts and abs(mean_step[0] * lost) > LARGEST_GAP_REVOLUTIONS * turn):
        state[_FLAGS] |= _F_TIME_JUMP
    if lost > 0:
        state[_LOST] += lost
    return step


@njit("void(int64, int64[::1])", cache=True, nogil=True)
def _lock(phase: int, state: Counts) -> None:
    """Take the first index: from here on the angle is known, and the first revolution begins."""
    state[_LOCKED] = 2
    state[_BASE] = 0
    state[_POSITION] = phase
    state[_HIGH] = phase
    state[_FLAGS] = 0
    state[_LOST] = 0
    state[_IDLE] = 0
    state[_PENDING] = 0


@njit("void(int64, int64, boolean, boolean, int64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _pass_index(
    phase: int, step: int, wrapped: bool, at_zero: bool, state: Counts, parameters: Counts
) -> None:
    """Judge a count that was set to zero: the index, an index with lost counts, or none at all."""
    turn, tolerance = parameters[_TURN], parameters[_TOLERANCE]
    odd, expected, base = state[_ODD] != 0, state[_STEP], state[_BASE]
    target = state[_BEFORE] + expected
    boundary = base + turn * int(np.floor((target - phase - base) / turn + 0.5))
    deviation = target - boundary - phase
    state[_JUMPED] = 0
    if abs(deviation) <= turn // 8:
        state[_POSITION] = boundary + phase
        state[_SEEN] = 1
        if odd:
            state[_OTHER] = target
            state[_OTHER_VALID] = 1
        if abs(deviation) > 2 + tolerance + abs(expected) // 50:
            _doubt(state)
    elif wrapped and not odd:
        # A whole turn of counts since the last index: the counter is right again.
        ahead = (state[_BEFORE] - base) // turn + (1 if step >= 0 else 0)
        state[_POSITION] = base + ahead * turn + phase
        state[_SEEN] = 1
        _doubt(state)
    else:
        state[_POSITION] = target
        state[_JUMPED] = 0 if at_zero else 1
        state[_JUMP_STEP] = step
        _doubt(state)
    if not odd:
        state[_STEP] = step


@njit("int64(int64, int64, int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _doubt_step(count: int, step: int, slack: int, state: Counts, parameters: Counts) -> int:
    """Judge an odd step: a wrong reading is bridged, a jump that goes on is motion.

    Returns the counts that the crank is taken to have moved.
    """
    turn, expected = parameters[_TURN], state[_STEP]
    near = 2 + parameters[_TOLERANCE] + abs(expected) // 8
    target = state[_BEFORE] + expected
    if parameters[_RESTARTS] != 0:
        aligned = target + wrap(count - target, turn)
    elif parameters[_MODULUS] > 0:
        aligned = target + wrap(count - target, parameters[_MODULUS])
    else:
        aligned = count
    if state[_OTHER_VALID]:
        # A single zero reading near the index looked like the index: go back.
        former = state[_OTHER] + expected
        if abs(wrap(count - former, turn)) <= near:
            target = former
            aligned = former + wrap(count - former, turn)
    if abs(aligned - target) <= near:
        state[_POSITION] = aligned
        state[_JUMPED] = 0
        return expected
    if state[_JUMPED] and abs(step - state[_JUMP_STEP]) <= slack:
        state[_POSITION] = state[_BEFORE] + step
        state[_STEP] = step
        state[_JUMPED] = 0
        return step
    state[_POSITION] = target
    state[_JUMPED] = 1
    state[_JUMP_STEP] = step
    if state[_LOCKED]:
        _doubt(state)
    return expected


@njit("void(int64, int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _step_on(count: int, step: int, state: Counts, parameters: Counts) -> None:
    """Take an ordinary step; after a jump that has stayed, believe the count again."""
    now = state[_BEFORE] + step
    if state[_JUMPED] and state[_LOCKED]:
        # Samples went missing unseen: the count is right, the position was not.
        turn = parameters[_TURN]
        jump = wrap(count - now, turn) if parameters[_RESTARTS] != 0 else count - now
        if abs(jump) <= turn // 2:
            now += jump
    state[_POSITION] = now
    state[_STEP] = step
    state[_JUMPED] = 0


@njit("void(int64, int64, int64, int64[::1], float64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _follow(
    count: int, sample: int, lost: int, state: Counts, mean_step: Floats, parameters: Counts
) -> None:
    """Follow the count of one sample, whatever it does. lost: samples lost before it, -1 unknown.

    Leaves in the state: POSITION, what it was BEFORE, whether the index was SEEN, the step was ODD,
    a GAP lay before, and LOCKED = 2 at the first index of all.
    """
    turn, tolerance = parameters[_TURN], parameters[_TOLERANCE]
    restarts = parameters[_RESTARTS] != 0
    delta = count - state[_PREVIOUS]
    if parameters[_MODULUS] > 0:
        delta = wrap(delta, parameters[_MODULUS])
    step = wrap(delta, turn) if restarts else delta
    expected = state[_STEP]
    before = state[_POSITION]
    had_other = state[_OTHER_VALID]
    state[_BEFORE] = before
    state[_SEEN], state[_ODD], state[_GAP] = 0, 0, 0
    move = step
    if lost != 0:
        state[_GAP] = 1
        state[_OTHER_VALID] = 0
        move = _over_gap(count, step, lost, state, mean_step, parameters)
    else:
        slack = min(4 + 4 * tolerance + abs(expected) // 8, turn // 4)
        odd = abs(step - expected) > slack
        state[_ODD] = 1 if odd else 0
        wrapped = restarts and delta != step
        phase = wrap(count, turn) if restarts else 0
        reach = 2 + tolerance
        at_zero = restarts and min(expected, 0) - reach <= phase <= max(expected, 0) + reach
        if wrapped or (odd and at_zero):
            state[_INDEX_EVENTS] += 1
            state[_OTHER_VALID] = 0
            move = expected if odd else step
            if state[_LOCKED] == 0:
                _lock(phase, state)
                state[_STEP] = expected if odd else step
                state[_JUMPED] = 0
            else:
                _pass_index(phase, step, wrapped, at_zero, state, parameters)
        elif odd:
            state[_OTHER_VALID] = had_other
            move = _doubt_step(count, step, slack, state, parameters)
            state[_OTHER_VALID] = 0
        else:
            state[_OTHER_VALID] = 0
            _step_on(count, step, state, parameters)
        mean_step[0] += (state[_STEP] - mean_step[0]) / 64.0
    if state[_LOCKED] == 0:
        state[_TURNED] += step
    if state[_POSITION] != before or count != state[_PREVIOUS]:
        state[_LAST_MOVED] = sample
        state[_RUN] = 0
    else:
        state[_RUN] += 1
    state[_PREVIOUS] = count
    state[_TRAVEL] += move


@njit("int64(int64[:, ::1], int64, int64, int64, int64, int64, int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _event(
    events: Counts, row: int, kind: int, kept: int, sample: int, end: int, state: Counts
) -> int:
    """Write an event; return the number of events now."""
    events[row, 0] = kind
    events[row, 1] = kept
    events[row, 2] = sample
    events[row, 3] = state[_BASE]
    events[row, 4] = state[_ORDINAL]
    events[row, 5] = state[_FLAGS]
    events[row, 6] = state[_LOST]
    events[row, 7] = state[_IDLE]
    events[row, 8] = end
    return row + 1


@njit("void(uint8, int64[::1])", cache=True, nogil=True)
def _note_marks(mark: int, state: Counts) -> None:
    """Turn a sample's marks (``drivers.api.Quality``) into flags of its revolution."""
    if mark & 1:
        state[_FLAGS] |= _F_SATURATED
    if mark & 6:
        state[_FLAGS] |= _F_LOST
    if mark & 8:
        state[_FLAGS] |= _F_MISMATCH
    if mark & 16:
        state[_FLAGS] |= _F_SENSOR


@njit("int64(int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _crossed(sample: int, state: Counts, parameters: Counts) -> int:
    """Return how many revolutions end with this sample, negative backwards, 0 for none."""
    turn = parameters[_TURN]
    ahead = state[_POSITION] - state[_BASE]
    if -turn < ahead < turn:
        state[_PENDING] = 0
        return 0
    # A crank that had turned back onto the index comes to the next one with a count of 0: setting
    # it to 0 cannot be seen then, and the count itself says where the index is.
    shows = state[_PREVIOUS] == ahead - turn
    seen = state[_SEEN] != 0 or shows
    sure = ahead < 0 or seen or state[_GAP] != 0 or parameters[_RESTARTS] == 0
    if state[_PENDING] == 0 or sure:
        state[_PENDING_KEPT] = state[_KEPT]
        state[_PENDING_SAMPLE] = sample
        state[_PENDING_POSITION] = state[_POSITION]
    if ahead < 0:
        state[_FLAGS] |= _F_REVERSED
        return -((-ahead) // turn)
    if not sure:
        state[_PENDING] = 1
        if ahead - turn <= parameters[_MISSED_AFTER]:
            return 0
        state[_FLAGS] |= _F_MISSED
    return ahead // turn


@njit("int64(int64, int64, int64[:, ::1], int64, int64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _cut(
    crossed: int, lost: int, events: Counts, found: int, state: Counts, parameters: Counts
) -> int:
    """End a revolution and begin the next; return the number of events now."""
    turn = parameters[_TURN]
    base = state[_BASE] + crossed * turn
    carried = 0
    if state[_GAP]:
        carried = _F_GAP | _F_LOST
        state[_LOST] -= max(lost, 0)  # they count for the revolution that begins
        if abs(base - state[_BEFORE]) > turn // 100 or abs(crossed) > 1:
            state[_FLAGS] |= _F_PARTIAL
        if abs(state[_POSITION] - base) > turn // 100:
            carried |= _F_PARTIAL
    kept, sample, end = state[_PENDING_KEPT], state[_PENDING_SAMPLE], state[_PENDING_POSITION]
    kind = _CUT if state[_INSIDE] else _BEGIN
    found = _event(events, found, kind, kept, sample, end, state)
    state[_PENDING] = 0
    state[_INSIDE] = 1
    state[_BASE] = base
    state[_ORDINAL] += abs(crossed)
    state[_FLAGS] = carried
    state[_LOST] = max(lost, 0) if state[_GAP] else 0
    state[_IDLE] = 0
    state[_HIGH] = state[_POSITION]
    state[_START_KEPT] = kept
    return found


@njit("boolean(int64[::1], int64[::1])", cache=True, nogil=True)
def _worth_keeping(state: Counts, parameters: Counts) -> bool:
    """Tell whether a sample is kept: not a long stand, and memory left."""
    if state[_RUN] > parameters[_IDLE_AFTER]:
        state[_IDLE] += 1
        state[_FLAGS] |= _F_PAUSED
        return False
    if state[_KEPT] - state[_START_KEPT] >= parameters[_CAPACITY]:
        state[_LOST] += 1
        state[_FLAGS] |= _F_LOST | _F_PARTIAL
        return False
    return True


@njit("int64(int64, int64, int64[:, ::1], int64, int64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _place(
    sample: int, lost: int, events: Counts, found: int, state: Counts, parameters: Counts
) -> int:
    """Begin, go on with, or end a revolution at a sample; return the number of events now."""
    now = state[_POSITION]
    if state[_LOCKED] == 2:
        state[_LOCKED] = 1
        state[_INSIDE] = 1
        state[_START_KEPT] = state[_KEPT]
        found = _event(events, found, _BEGIN, state[_KEPT], sample, now, state)
    if state[_LOCKED] == 0 or state[_SEEN]:
        state[_HIGH] = now
    if state[_LOCKED] == 0:
        return found
    crossed = _crossed(sample, state, parameters)
    if crossed != 0:
        return _cut(crossed, lost, events, found, state, parameters)
    if now > state[_HIGH]:
        state[_HIGH] = now
    elif now < state[_HIGH] - 4 and not state[_ODD] and not state[_GAP]:
        state[_FLAGS] |= _F_REVERSED
    return found


@njit("int64(int64[::1], uint8[::1], int64, int64, int64[::1], float64[::1], int64[::1],"
            "int64[::1], uint8[::1])", cache=True, nogil=True)  # fmt: skip
def _plain_run(
    counts: Counts,
    quality: NDArray[np.uint8],
    start: int,
    first_sample: int,
    state: Counts,
    mean_step: Floats,
    parameters: Counts,
    position: Counts,
    keep: NDArray[np.uint8],
) -> int:
    """Take small steps forward within a revolution as long as they last; return where they end.

    Nearly every sample is one; what is done here is what all the rest would do.
    """
    turn, direction = parameters[_TURN], parameters[_DIRECTION]
    if (
        state[_LOCKED] == 0
        or state[_PENDING] + state[_JUMPED] + state[_OTHER_VALID] + state[_SKIPPING] != 0
        or 0 < parameters[_MODULUS] < turn
    ):
        return start
    previous, now, step = state[_PREVIOUS], state[_POSITION], state[_STEP]
    base, high, mean = state[_BASE], state[_HIGH], mean_step[0]
    half, smooth = turn // 2, min(8, turn // 4)
    room = parameters[_CAPACITY] - state[_KEPT] + state[_START_KEPT]
    end = min(counts.shape[0], start + room)
    i = start
    while i < end and quality[i] == 0:
        count = counts[i] * direction
        delta = count - previous
        following = now + delta
        if (
            delta <= 0
            or delta >= half
            or abs(delta - step) > smooth
            or abs(following - base) >= turn
            or following < high - 4
        ):
            break
        previous, now, step = count, following, delta
        high = max(high, now)
        mean += (delta - mean) / 64.0
        position[i] = now
        keep[i] = 1
        if i == 0:
            state[_TRAVEL_FIRST] = state[_TRAVEL] + delta
        i += 1
    if i > start:
        state[_TRAVEL] += now - state[_POSITION]
        state[_PREVIOUS], state[_POSITION], state[_STEP] = previous, now, step
        state[_HIGH] = high
        state[_LAST_MOVED] = first_sample + i - 1
        state[_RUN] = 0
        state[_KEPT] += i - start
        mean_step[0] = mean
    return i


@njit("int64(int64[::1], uint8[::1], int64, int64, int64[::1], float64[::1], int64[::1],"
            "int64[::1], uint8[::1], int64[:, ::1])", cache=True, nogil=True)  # fmt: skip
def scan(
    counts: Counts,
    quality: NDArray[np.uint8],
    first_sample: int,
    lost: int,
    state: Counts,
    mean_step: Floats,
    parameters: Counts,
    position: Counts,
    keep: NDArray[np.uint8],
    events: Counts,
) -> int:
    """Follow the counts of one block and return the number of events.

    counts: (n,) raw counts. quality: (n,) flags of ``drivers.api.Quality``. first_sample: device
    index of the first. lost: samples lost before it, 0 none, -1 unknown. state, mean_step: memory
    between calls. parameters: see ``ParameterAt``. position: (n,) out, unwrapped counts in the
    rig's positive sense. keep: (n,) out, 0 for samples not worth keeping. events:
    (rows, EventAt.SIZE) out, 2 n rows at least.
    """
    found = 0
    i = 0
    while i < counts.shape[0]:
        if i > 0 or lost == 0:
            i = _plain_run(
                counts, quality, i, first_sample, state, mean_step, parameters, position, keep
            )
            if i == counts.shape[0]:
                break
        count, sample = counts[i] * parameters[_DIRECTION], first_sample + i
        missing = lost if i == 0 else 0
        if state[_STARTED] == 0:
            _begin_counting(count, sample, state, parameters)
        else:
            _follow(count, sample, missing, state, mean_step, parameters)
            if i == 0:
                state[_TRAVEL_FIRST] = state[_TRAVEL]
            _note_marks(quality[i], state)
            found = _place(sample, missing, events, found, state, parameters)
        position[i] = state[_POSITION]
        keep[i] = 1 if _worth_keeping(state, parameters) else 0
        if keep[i]:
            if state[_SKIPPING] or state[_GAP]:
                now = state[_POSITION]
                found = _event(events, found, _BREAK, state[_KEPT], sample, now, state)
            state[_KEPT] += 1
        state[_SKIPPING] = 1 - keep[i]
        i += 1
    return found
