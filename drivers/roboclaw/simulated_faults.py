"""The faults that a simulated RoboClaw knows."""

from __future__ import annotations

import enum

from drivers.simulated_faults import FaultPlan


class FaultKind(enum.StrEnum):
    """Name a fault; its ``value`` means what stands behind it."""

    EMERGENCY_STOP = "emergency_stop"  # the S3 input is active
    OVER_CURRENT = "over_current"  # A, shown as the motor's current
    UNDER_VOLTAGE = "under_voltage"  # V of the main supply
    OVER_TEMPERATURE = "over_temperature"  # degrees C
    DRIVER_FAULT = "driver_fault"
    STATUS_BITS = "status_bits"  # bits to set in the status word
    WRONG_CRC = "wrong_crc"
    WRONG_ACKNOWLEDGE = "wrong_acknowledge"  # byte sent instead of FF
    NO_REPLY = "no_reply"
    LOST_COMMAND = "lost_command"  # the packet is neither obeyed nor answered
    SLOW_REPLY = "slow_reply"  # s of delay
    DUPLICATED_REPLY = "duplicated_reply"
    RESET = "reset"  # s until the drive answers again


RoboClawFaults = FaultPlan[FaultKind]
