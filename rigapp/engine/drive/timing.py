"""Every time-out and period of the engine, in host seconds, in one place."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Timing:
    """Set the engine's periods and time-outs, all in seconds of the host's clock.

    read: longest wait for samples. poll: drive status. aim: drive thread while it aims at the pause
    angle or stops. commit: between two commits. supervise: between two checks of the threads.
    silence: a thread without a heartbeat for so long is dead; silence_commit: the same for the
    committing thread, which a slow disk may delay. queue: samples held between reader and
    processing. standing: the encoder must show no motion for so long. stop_margin: granted to a
    controlled stop beyond its ramp. coast: granted after the power was taken off. start_margin:
    granted to a start beyond its ramp. zero: samples averaged for a zero. finish: closing the file.
    make_safe: an emergency command to the drive from the supervisor. queue_age: samples of a rig in
    real time that wait longer for the processing thread switch the drive off.
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
