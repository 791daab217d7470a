"""The faults that a simulated DATAQ instrument knows."""

from __future__ import annotations

import enum


class FaultKind(enum.StrEnum):
    """Name a fault; its ``value`` means what stands behind it."""

    # in the stream, once
    DROPPED_BYTE = "dropped_byte"  # place of the byte in what is about to be sent (3)
    GARBAGE = "garbage"  # random bytes that are put in (7)
    OVERRUN = "overrun"  # whole scans that are lost (10); not reported by the device
    OVERRUN_BYTES = "overrun_bytes"  # bytes that are lost (7); not reported by the device
    # at the inputs, while active
    SATURATED_INPUT = "saturated_input"  # analog channel (1), beyond the end of its range
    STUCK_INPUT = "stuck_input"  # analog channel (1)
    STUCK_COUNTER = "stuck_counter"
    # at the counter, once
    COUNTER_SLIP = "counter_slip"  # counts too many (100)
    # in the replies; count: how many, target: place of the command in ``COMMANDS``
    NO_REPLY = "no_reply"
    SLOW_REPLY = "slow_reply"  # s of delay (0.3)
    WRONG_ECHO = "wrong_echo"
    # the device
    HANG = "hang"  # while active: neither sends nor answers
    RESET = "reset"  # power off and on; s until it answers again (0.2)
