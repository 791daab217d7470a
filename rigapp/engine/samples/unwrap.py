"""Unwrapping of the counter sample by sample: position, revolutions, faults.

The complete state is in one array, ``state``, so that the result does not depend on the division of
the samples into blocks.

A revolution ends when the position is one complete revolution from its base, in either direction,
so that swinging over the index ends one only. If the counter restarts at the index, the end waits
for the index event; an eighth of a turn later without one, the revolution ends according to the
count, and is flagged.

Terms. *step*: counts from one sample to the next. *index event*: the index pulse set the counter to
zero between two samples. *base*: position of the index at which the present revolution began.
*odd*: a step that no motion explains. *skip*: a permanent jump of the count that the next index
confirms: samples are missing, as after lost counts of the encoder the count at the index is wrong.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.counterstate import (
    BEGIN,
    BREAK,
    CUT,
    Counts,
    EventAt,
    Floats,
    ParameterAt,
    StateAt,
)
from rigapp.schema.messages import Flag
from rigapp_model.compiled import njit

_LOST_SAMPLES = int(Flag.LOST_SAMPLES)
_COUNT_MISMATCH = int(Flag.COUNT_MISMATCH)
_MISSED_INDEX = int(Flag.MISSED_INDEX)
_SATURATED = int(Flag.SATURATED)
_GAP_BEFORE = int(Flag.GAP_BEFORE)
_REVERSED = int(Flag.REVERSED)
_PARTIAL = int(Flag.PARTIAL)
_TIME_JUMP = int(Flag.TIME_JUMP)
_PAUSED = int(Flag.PAUSED)
_SENSOR_FAULT = int(Flag.SENSOR_FAULT)

LARGEST_GAP_REVOLUTIONS = 25
"""Revolutions in a gap beyond which their number is uncertain.

An error of the speed of 2 % is half a revolution in 25.
"""
DITHER = 2
"""Uncertainty of a step in counts: an edge just before or after a sample, at each end."""
NUDGE = 4
"""Vibration of a stationary crank, counts: twice the dither. More is a reversal."""
ACCELERATES = 8
"""Inverse of the largest relative change of consecutive steps, besides the encoder's tolerance.

An eighth within one sample exceeds the acceleration of any drive.
"""
INDEX_STEADY = 50
"""Inverse of the error of the count at the index relative to a step: a drive's ripple of 2 %."""
INDEX_NEAR = 8
"""Inverse of the distance, in turns, from the expected position within which an index is accepted.

At half a turn the index is ambiguous; within an eighth it is not.
"""
STEP_MOST = 4
"""Inverse of the largest step, in turns; a longer one could be a backward step."""
STEPS_OF_MEAN = 64
"""Steps averaged for the speed before a gap, which is then known to 1/64 of the dither."""
WHOLE_WITHIN = 100
"""Inverse of the distance, in turns, from an end of a revolution beyond which it is partial.

1 % of a turn is 3.6 degrees, within which forces of the mechanism change by some per cent.
"""
PLAIN_STEP = 2 * NUDGE
"""Change of step that is always allowed, counts: that with the least tolerance, 1 count."""


@njit("int64(int64, int64)", cache=True, nogil=True)
def wrap(value: int, modulus: int) -> int:
    """Return the value modulo ``modulus`` in [-modulus/2, modulus/2)."""
    half = modulus // 2
    return (value + half) % modulus - half


@njit("void(int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _begin_counting(count: int, state: Counts, parameters: Counts) -> None:
    """Process the very first count, which gives the crank angle only if it never restarts."""
    restarts = parameters[ParameterAt.RESTARTS] != 0
    start = 0 if restarts else count
    state[StateAt.STARTED] = 1
    state[StateAt.PREVIOUS] = count
    state[StateAt.POSITION] = start
    state[StateAt.BASE] = start - start % parameters[ParameterAt.COUNTS]
    state[StateAt.HIGH] = start
    state[StateAt.LOCKED] = 0 if restarts else 1
    state[StateAt.TRAVEL_FIRST] = state[StateAt.TRAVEL]


@njit("void(int64[::1])", cache=True, nogil=True)
def _flag_mismatch(state: Counts) -> None:
    state[StateAt.FLAGS] |= _COUNT_MISMATCH


@njit("void(int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _skip(jump: int, state: Counts, parameters: Counts) -> None:
    """Record a permanent jump."""
    if abs(jump) > DITHER + parameters[ParameterAt.TOLERANCE]:
        state[StateAt.SKIPPED] += jump
        state[StateAt.SKIPS] += 1


@njit("int64(int64, int64, int64, int64[::1], float64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _over_gap(
    count: int, step: int, lost: int, state: Counts, mean_step: Floats, parameters: Counts
) -> int:
    """Extrapolate over a gap in the samples by the speed before it; return the counts moved."""
    turn, restarts = parameters[ParameterAt.COUNTS], parameters[ParameterAt.RESTARTS] != 0
    if restarts:
        foreseen = mean_step[0] * (max(lost, 0) + 1)
        step += turn * int(np.floor((foreseen - step) / turn + 0.5))
    now = state[StateAt.BEFORE] + step
    if state[StateAt.LOCKED] and restarts:
        now += wrap(count - now, turn)
    state[StateAt.POSITION] = now
    state[StateAt.FLAGS] |= _LOST_SAMPLES
    if lost < 0 or (restarts and abs(mean_step[0] * lost) > LARGEST_GAP_REVOLUTIONS * turn):
        state[StateAt.FLAGS] |= _TIME_JUMP
    if lost > 0:
        state[StateAt.LOST] += lost
    return step


@njit("void(int64, int64[::1])", cache=True, nogil=True)
def _lock(phase: int, state: Counts) -> None:
    """Process the first index, which gives the angle; the first revolution begins."""
    state[StateAt.LOCKED] = 2
    state[StateAt.BASE] = 0
    state[StateAt.POSITION] = phase
    state[StateAt.HIGH] = phase
    state[StateAt.FLAGS] = 0
    state[StateAt.LOST] = 0
    state[StateAt.IDLE] = 0
    state[StateAt.PENDING] = 0


@njit("void(int64, int64, boolean, boolean, int64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _pass_index(
    phase: int, step: int, wrapped: bool, at_zero: bool, state: Counts, parameters: Counts
) -> None:
    """Classify a count that was set to zero: an index, an index after lost counts, or none."""
    turn, tolerance = parameters[ParameterAt.COUNTS], parameters[ParameterAt.TOLERANCE]
    odd, expected, base = state[StateAt.ODD] != 0, state[StateAt.STEP], state[StateAt.BASE]
    target = state[StateAt.BEFORE] + expected
    boundary = base + turn * int(np.floor((target - phase - base) / turn + 0.5))
    deviation = target - boundary - phase
    state[StateAt.JUMPED] = 0
    if abs(deviation) <= turn // INDEX_NEAR:
        state[StateAt.POSITION] = boundary + phase
        state[StateAt.SEEN] = 1
        if odd:
            state[StateAt.OTHER] = target
            state[StateAt.OTHER_VALID] = 1
        if abs(deviation) > DITHER + tolerance + abs(expected) // INDEX_STEADY:
            _flag_mismatch(state)
            if at_zero:
                state[StateAt.OFF_INDEX] = 1
            else:
                _skip(-deviation, state, parameters)
    elif wrapped and not odd:
        # A complete turn of counts since the last index: the counter is correct again.
        turns = (state[StateAt.BEFORE] - base) // turn + (1 if step >= 0 else 0)
        state[StateAt.POSITION] = base + turns * turn + phase
        state[StateAt.SEEN] = 1
        state[StateAt.OFF_INDEX] = 1
        _flag_mismatch(state)
    else:
        state[StateAt.POSITION] = target
        state[StateAt.JUMPED] = 0 if at_zero else 1
        state[StateAt.OFF_INDEX] |= 1 if at_zero else 0
        state[StateAt.JUMP_STEP] = step
        _flag_mismatch(state)
    if not odd:
        state[StateAt.STEP] = step


@njit("int64(int64, int64, int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _classify_odd_step(count: int, step: int, slack: int, state: Counts, parameters: Counts) -> int:
    """Classify an odd step: a wrong reading is bridged, a repeated jump is motion.

    Returns the assumed motion of the crank in counts.
    """
    turn, expected = parameters[ParameterAt.COUNTS], state[StateAt.STEP]
    near = DITHER + parameters[ParameterAt.TOLERANCE] + abs(expected) // ACCELERATES
    target = state[StateAt.BEFORE] + expected
    if parameters[ParameterAt.RESTARTS] != 0:
        aligned = target + wrap(count - target, turn)
    elif parameters[ParameterAt.MODULUS] > 0:
        aligned = target + wrap(count - target, parameters[ParameterAt.MODULUS])
    else:
        aligned = count
    if state[StateAt.OTHER_VALID]:
        # A single zero reading near the index was mistaken for the index: revert.
        reverted = state[StateAt.OTHER] + expected
        if abs(wrap(count - reverted, turn)) <= near:
            target = reverted
            aligned = reverted + wrap(count - reverted, turn)
    if abs(aligned - target) <= near:
        state[StateAt.POSITION] = aligned
        state[StateAt.JUMPED] = 0
        return expected
    if state[StateAt.JUMPED] and abs(step - state[StateAt.JUMP_STEP]) <= slack:
        state[StateAt.POSITION] = state[StateAt.BEFORE] + step
        state[StateAt.STEP] = step
        state[StateAt.JUMPED] = 0
        return step
    state[StateAt.POSITION] = target
    state[StateAt.JUMPED] = 1
    state[StateAt.JUMP_STEP] = step
    if state[StateAt.LOCKED]:
        _flag_mismatch(state)
    return expected


@njit("void(int64, int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _regular_step(count: int, step: int, state: Counts, parameters: Counts) -> None:
    """Process an ordinary step; after a permanent jump, follow the count again."""
    now = state[StateAt.BEFORE] + step
    if state[StateAt.JUMPED] and state[StateAt.LOCKED]:
        # Unreported missing samples: the count is correct, the position was not.
        turn = parameters[ParameterAt.COUNTS]
        jump = wrap(count - now, turn) if parameters[ParameterAt.RESTARTS] != 0 else count - now
        if abs(jump) <= turn // 2:
            now += jump
            _skip(jump, state, parameters)
    state[StateAt.POSITION] = now
    state[StateAt.STEP] = step
    state[StateAt.JUMPED] = 0


@njit("void(int64, int64, int64[::1], float64[::1], int64[::1])", cache=True, nogil=True)
def _process_count(
    count: int, lost: int, state: Counts, mean_step: Floats, parameters: Counts
) -> None:
    """Process the count of one sample. lost: samples lost before it, -1 if unknown.

    Sets in the state: POSITION, the position BEFORE, flags of an index SEEN, an ODD step, a GAP
    before, and LOCKED = 2 at the very first index.
    """
    turn, tolerance = parameters[ParameterAt.COUNTS], parameters[ParameterAt.TOLERANCE]
    restarts = parameters[ParameterAt.RESTARTS] != 0
    delta = count - state[StateAt.PREVIOUS]
    if parameters[ParameterAt.MODULUS] > 0:
        delta = wrap(delta, parameters[ParameterAt.MODULUS])
    step = wrap(delta, turn) if restarts else delta
    expected = state[StateAt.STEP]
    before = state[StateAt.POSITION]
    had_other = state[StateAt.OTHER_VALID]
    state[StateAt.BEFORE] = before
    state[StateAt.SEEN], state[StateAt.ODD], state[StateAt.GAP] = 0, 0, 0
    move = step
    if lost != 0:
        state[StateAt.GAP] = 1
        state[StateAt.OTHER_VALID] = 0
        move = _over_gap(count, step, lost, state, mean_step, parameters)
    else:
        slack = min(NUDGE * (1 + tolerance) + abs(expected) // ACCELERATES, turn // STEP_MOST)
        odd = abs(step - expected) > slack
        state[StateAt.ODD] = 1 if odd else 0
        wrapped = restarts and delta != step
        phase = wrap(count, turn) if restarts else 0
        reach = DITHER + tolerance
        at_zero = restarts and min(expected, 0) - reach <= phase <= max(expected, 0) + reach
        if wrapped or (odd and at_zero):
            state[StateAt.OTHER_VALID] = 0
            move = expected if odd else step
            if state[StateAt.LOCKED] == 0:
                _lock(phase, state)
                state[StateAt.STEP] = expected if odd else step
                state[StateAt.JUMPED] = 0
            else:
                _pass_index(phase, step, wrapped, at_zero, state, parameters)
        elif odd:
            state[StateAt.OTHER_VALID] = had_other
            move = _classify_odd_step(count, step, slack, state, parameters)
            state[StateAt.OTHER_VALID] = 0
        else:
            state[StateAt.OTHER_VALID] = 0
            _regular_step(count, step, state, parameters)
        mean_step[0] += (state[StateAt.STEP] - mean_step[0]) / STEPS_OF_MEAN
    if state[StateAt.LOCKED] == 0:
        state[StateAt.UNLOCKED_TURN] += step
    if state[StateAt.POSITION] != before or count != state[StateAt.PREVIOUS]:
        state[StateAt.RUN] = 0
    else:
        state[StateAt.RUN] += 1
    state[StateAt.PREVIOUS] = count
    state[StateAt.TRAVEL] += move


@njit("int64(int64[:, ::1], int64, int64, int64, int64, int64, int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _event(
    events: Counts, row: int, kind: int, kept: int, sample: int, end: int, state: Counts
) -> int:
    """Write an event; return the number of events."""
    events[row, EventAt.KIND] = kind
    events[row, EventAt.KEPT] = kept
    events[row, EventAt.SAMPLE] = sample
    events[row, EventAt.BASE] = state[StateAt.BASE]
    events[row, EventAt.ORDINAL] = state[StateAt.ORDINAL]
    events[row, EventAt.FLAGS] = state[StateAt.FLAGS]
    events[row, EventAt.LOST] = state[StateAt.LOST]
    events[row, EventAt.IDLE] = state[StateAt.IDLE]
    events[row, EventAt.END_POSITION] = end
    events[row, EventAt.SKIPPED] = 0 if state[StateAt.OFF_INDEX] else state[StateAt.SKIPPED]
    return row + 1


@njit("void(uint8, int64[::1])", cache=True, nogil=True)
def _note_marks(mark: int, state: Counts) -> None:
    """Convert a sample's marks (``rigapp_drivers.api.Quality``) to flags of its revolution."""
    if mark & 1:
        state[StateAt.FLAGS] |= _SATURATED
    if mark & 6:
        state[StateAt.FLAGS] |= _LOST_SAMPLES
    if mark & 8:
        state[StateAt.FLAGS] |= _COUNT_MISMATCH
    if mark & 16:
        state[StateAt.FLAGS] |= _SENSOR_FAULT


@njit("int64(int64, int64[::1], int64[::1])", cache=True, nogil=True)
def _revolutions_ended(sample: int, state: Counts, parameters: Counts) -> int:
    """Return the number of revolutions that end with this sample, negative if backwards."""
    turn = parameters[ParameterAt.COUNTS]
    ahead = state[StateAt.POSITION] - state[StateAt.BASE]
    if -turn < ahead < turn:
        state[StateAt.PENDING] = 0
        return 0
    # A crank that had turned back to the index reaches the next one with a count of 0: the reset
    # is then not visible, and the count itself gives the index.
    count_at_index = state[StateAt.PREVIOUS] == ahead - turn
    seen = state[StateAt.SEEN] != 0 or count_at_index
    confirmed = (
        ahead < 0 or seen or state[StateAt.GAP] != 0 or parameters[ParameterAt.RESTARTS] == 0
    )
    if state[StateAt.PENDING] == 0 or confirmed:
        state[StateAt.PENDING_KEPT] = state[StateAt.KEPT]
        state[StateAt.PENDING_SAMPLE] = sample
        state[StateAt.PENDING_POSITION] = state[StateAt.POSITION]
    if ahead < 0:
        state[StateAt.FLAGS] |= _REVERSED
        return -((-ahead) // turn)
    if not confirmed:
        state[StateAt.PENDING] = 1
        if ahead - turn <= parameters[ParameterAt.MISSED_AFTER]:
            return 0
        state[StateAt.FLAGS] |= _MISSED_INDEX
    return ahead // turn


@njit("int64(int64, int64, int64[:, ::1], int64, int64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _cut(
    crossed: int, lost: int, events: Counts, count: int, state: Counts, parameters: Counts
) -> int:
    """End a revolution and begin the next; return the number of events."""
    turn = parameters[ParameterAt.COUNTS]
    base = state[StateAt.BASE] + crossed * turn
    next_flags = 0
    if state[StateAt.GAP]:
        next_flags = _GAP_BEFORE | _LOST_SAMPLES
        state[StateAt.LOST] -= max(lost, 0)  # counted in the revolution that begins
        if abs(base - state[StateAt.BEFORE]) > turn // WHOLE_WITHIN or abs(crossed) > 1:
            state[StateAt.FLAGS] |= _PARTIAL
        if abs(state[StateAt.POSITION] - base) > turn // WHOLE_WITHIN:
            next_flags |= _PARTIAL
    kept, sample, end = (
        state[StateAt.PENDING_KEPT],
        state[StateAt.PENDING_SAMPLE],
        state[StateAt.PENDING_POSITION],
    )
    kind = CUT if state[StateAt.INSIDE] else BEGIN
    count = _event(events, count, kind, kept, sample, end, state)
    state[StateAt.PENDING] = 0
    state[StateAt.INSIDE] = 1
    state[StateAt.BASE] = base
    state[StateAt.ORDINAL] += abs(crossed)
    state[StateAt.FLAGS] = next_flags
    state[StateAt.LOST] = max(lost, 0) if state[StateAt.GAP] else 0
    state[StateAt.IDLE] = 0
    state[StateAt.SKIPPED], state[StateAt.OFF_INDEX] = 0, 0
    state[StateAt.HIGH] = state[StateAt.POSITION]
    state[StateAt.START_KEPT] = kept
    return count


@njit("boolean(int64[::1], int64[::1])", cache=True, nogil=True)
def _is_stored(state: Counts, parameters: Counts) -> bool:
    """Return whether a sample is stored: no long standstill, and memory available."""
    if state[StateAt.RUN] > parameters[ParameterAt.IDLE_AFTER]:
        state[StateAt.IDLE] += 1
        state[StateAt.FLAGS] |= _PAUSED
        return False
    if state[StateAt.KEPT] - state[StateAt.START_KEPT] >= parameters[ParameterAt.CAPACITY]:
        state[StateAt.LOST] += 1
        state[StateAt.FLAGS] |= _LOST_SAMPLES | _PARTIAL
        return False
    return True


@njit("int64(int64, int64, int64[:, ::1], int64, int64[::1], int64[::1])",
            cache=True, nogil=True)  # fmt: skip
def _process_sample(
    sample: int, lost: int, events: Counts, count: int, state: Counts, parameters: Counts
) -> int:
    """Begin, continue or end a revolution at a sample; return the number of events."""
    now = state[StateAt.POSITION]
    if state[StateAt.LOCKED] == 2:
        state[StateAt.LOCKED] = 1
        state[StateAt.INSIDE] = 1
        state[StateAt.START_KEPT] = state[StateAt.KEPT]
        count = _event(events, count, BEGIN, state[StateAt.KEPT], sample, now, state)
    if state[StateAt.LOCKED] == 0 or state[StateAt.SEEN]:
        state[StateAt.HIGH] = now
    if state[StateAt.LOCKED] == 0:
        return count
    crossed = _revolutions_ended(sample, state, parameters)
    if crossed != 0:
        return _cut(crossed, lost, events, count, state, parameters)
    if now > state[StateAt.HIGH]:
        state[StateAt.HIGH] = now
    elif now < state[StateAt.HIGH] - NUDGE and not state[StateAt.ODD] and not state[StateAt.GAP]:
        state[StateAt.FLAGS] |= _REVERSED
    return count


@njit("int64(int64[::1], uint8[::1], int64, int64[::1], float64[::1], int64[::1],"
            "int64[::1], uint8[::1])", cache=True, nogil=True)  # fmt: skip
def _plain_run(
    counts: Counts,
    quality: NDArray[np.uint8],
    start: int,
    state: Counts,
    mean_step: Floats,
    parameters: Counts,
    position: Counts,
    keep: NDArray[np.uint8],
) -> int:
    """Process consecutive small forward steps within a revolution; return the index of their end.

    Applies to nearly all samples; the result is the same as by the full path.
    """
    turn, direction = parameters[ParameterAt.COUNTS], parameters[ParameterAt.DIRECTION]
    if (
        state[StateAt.LOCKED] == 0
        or state[StateAt.PENDING]
        + state[StateAt.JUMPED]
        + state[StateAt.OTHER_VALID]
        + state[StateAt.SKIPPING]
        != 0
        or 0 < parameters[ParameterAt.MODULUS] < turn
    ):
        return start
    previous, now, step = state[StateAt.PREVIOUS], state[StateAt.POSITION], state[StateAt.STEP]
    base, high, mean = state[StateAt.BASE], state[StateAt.HIGH], mean_step[0]
    half, slack = turn // 2, min(PLAIN_STEP, turn // STEP_MOST)
    room = parameters[ParameterAt.CAPACITY] - state[StateAt.KEPT] + state[StateAt.START_KEPT]
    end = min(counts.shape[0], start + room)
    i = start
    while i < end and quality[i] == 0:
        count = counts[i] * direction
        delta = count - previous
        following = now + delta
        if (
            delta <= 0
            or delta >= half
            or abs(delta - step) > slack
            or abs(following - base) >= turn
            or following < high - NUDGE
        ):
            break
        previous, now, step = count, following, delta
        high = max(high, now)
        mean += (delta - mean) / STEPS_OF_MEAN
        position[i] = now
        keep[i] = 1
        if i == 0:
            state[StateAt.TRAVEL_FIRST] = state[StateAt.TRAVEL] + delta
        i += 1
    if i > start:
        state[StateAt.TRAVEL] += now - state[StateAt.POSITION]
        state[StateAt.PREVIOUS], state[StateAt.POSITION], state[StateAt.STEP] = previous, now, step
        state[StateAt.HIGH] = high
        state[StateAt.RUN] = 0
        state[StateAt.KEPT] += i - start
        mean_step[0] = mean
    return i


@njit(
    [f"boolean({kind}[::1], float64, float64, int64[::1])" for kind in ("float32", "int32")],
    cache=True,
    nogil=True,
)
def counted(raw: Floats, scale: float, offset: float, out: Counts) -> bool:
    """Write the counts of samples (n,) to out[:n]; return False if one is not finite."""
    for i in range(raw.shape[0]):
        signal = raw[i] * scale + offset
        if not np.isfinite(signal):
            return False
        out[i] = np.int64(np.rint(signal))
    return True


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
    """Unwrap the counts of one block and return the number of events.

    counts: (n,) raw counts. quality: (n,) flags of ``rigapp_drivers.api.Quality``. first_sample:
    device index of the first. lost: samples lost before it, -1 if unknown. state, mean_step:
    preserved between calls. parameters: see ``ParameterAt``. position: (n,) out, unwrapped counts
    in the rig's positive direction. keep: (n,) out, 0 for samples that are not stored. events:
    (rows, EventAt.SIZE) out, at least 2 n rows.
    """
    result = 0
    i = 0
    while i < counts.shape[0]:
        if i > 0 or lost == 0:
            i = _plain_run(counts, quality, i, state, mean_step, parameters, position, keep)
            if i == counts.shape[0]:
                break
        count, sample = counts[i] * parameters[ParameterAt.DIRECTION], first_sample + i
        missing = lost if i == 0 else 0
        if state[StateAt.STARTED] == 0:
            _begin_counting(count, state, parameters)
        else:
            _process_count(count, missing, state, mean_step, parameters)
            if i == 0:
                state[StateAt.TRAVEL_FIRST] = state[StateAt.TRAVEL]
            _note_marks(quality[i], state)
            result = _process_sample(sample, missing, events, result, state, parameters)
        position[i] = state[StateAt.POSITION]
        keep[i] = 1 if _is_stored(state, parameters) else 0
        if keep[i]:
            if state[StateAt.SKIPPING] or state[StateAt.GAP]:
                now = state[StateAt.POSITION]
                result = _event(events, result, BREAK, state[StateAt.KEPT], sample, now, state)
            state[StateAt.KEPT] += 1
        state[StateAt.SKIPPING] = 1 - keep[i]
        i += 1
    return result
