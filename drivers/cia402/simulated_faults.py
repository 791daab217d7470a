"""The faults that a simulated CiA 402 drive knows."""

from __future__ import annotations

import enum

from drivers.simulated_faults import FaultPlan


class FaultKind(enum.StrEnum):
    """Name a fault; its ``value`` means what stands behind it."""

    SILENT_NODE = "silent_node"  # the node neither hears nor says anything
    LOST_HEARTBEAT = "lost_heartbeat"  # only the heartbeat is missing
    EMERGENCY = "emergency"  # error code: message, error register, fault state
    BUS_OFF = "bus_off"  # off the bus until end_s, then emergency 81FD
    SDO_ABORT = "sdo_abort"  # abort code
    NO_SDO_REPLY = "no_sdo_reply"
    LATE_TPDO = "late_tpdo"  # s of delay
    NO_TPDO = "no_tpdo"
    BOOT_UP = "boot_up"  # s until the node says its boot-up message
    TORQUE_OFF = "torque_off"  # the safe-torque-off inputs are open
    GARBLED_LINE = "garbled_line"  # the adapter sends a line that is none


Cia402Faults = FaultPlan[FaultKind]
