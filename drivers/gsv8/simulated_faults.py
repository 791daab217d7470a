"""The faults that a simulated GSV-8 knows."""

from __future__ import annotations

import enum

from drivers.simulated_faults import FaultPlan


class FaultKind(enum.StrEnum):
    """Name a fault; its ``value`` means what stands behind it."""

    # in the stream, once
    DROPPED_FRAMES = "dropped_frames"  # how many frames are missing (1)
    CUT_FRAME = "cut_frame"  # bytes of the frame that are sent (11)
    GARBAGE = "garbage"  # random bytes before a frame (7)
    FLIPPED_BIT = "flipped_bit"  # which byte of a frame is wrong by one bit (5)
    OVERRUN = "overrun"  # frames lost in the transmit queue (10); reported as code 91
    # in the stream, while active
    WRONG_OBJECT_COUNT = "wrong_object_count"  # objects more than the device admits (1)
    # at the inputs, while active
    SATURATED_INPUT = "saturated_input"  # analog channel (1), beyond the end of its range
    STUCK_INPUT = "stuck_input"  # analog channel (1)
    SENSOR_BROKEN = "sensor_broken"  # analog channel (1); value error of kind 3
    MISSING_INDEX = "missing_index"  # the index pulse does not arrive
    STUCK_COUNTER = "stuck_counter"
    # at the counter, once
    COUNTER_SLIP = "counter_slip"  # counts too many (1)
    FALSE_INDEX = "false_index"  # an index pulse where there is none
    # in the replies; count: how many, target: which command
    NO_REPLY = "no_reply"
    LOST_COMMAND = "lost_command"  # neither obeyed nor answered
    SLOW_REPLY = "slow_reply"  # s of delay (0.3)
    REFUSED = "refused"  # status of the answer (75 hexadecimal)
    # the device
    WRITE_ACCESS_ELSEWHERE = "write_access_elsewhere"  # every write is answered with status 75
    RESET = "reset"  # power off and on


Gsv8Faults = FaultPlan[FaultKind]
