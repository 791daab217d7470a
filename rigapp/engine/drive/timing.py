"""All time-outs and periods of the engine, in host seconds."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Timing:
    """Periods and time-outs of the engine, in seconds of the host's clock.

    read: longest wait for samples. poll: period of the drive's status. aim: period of the drive
    thread while it approaches the pause angle or stops. commit: period of commits. supervise:
    period of the checks of the threads. silence: time-out of a thread's heartbeat; silence_commit:
    of the committing thread, which a slow disk may delay. queue: samples buffered between reader
    and processing. standing: time without motion of the encoder that is a standstill. stop_margin:
    time-out of a controlled stop beyond its ramp. coast: after the power-off. start_margin: of a
    start beyond its ramp. zero: averaging time of a zero. finish: closing the file. make_safe: an
    emergency command to the drive from the supervisor. queue_age: longest wait of samples for the
    processing thread in real time, beyond which the drive is switched off.
    """

    read: float = 0.1
    poll: float = 0.1
    aim: float = 0.005
    commit: float = 1.0
    supervise: float = 0.05
    silence: float = 2.0
    silence_commit: float = 20.0
    queue: float = 10.0
    standing: float = 0.25
    stop_margin: float = 3.0
    coast: float = 15.0
    start_margin: float = 15.0
    zero: float = 0.5
    finish: float = 30.0
    make_safe: float = 1.0
    queue_age: float = 1.0
