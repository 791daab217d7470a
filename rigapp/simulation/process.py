"""The simulated rig as a process: ``python -m rigapp.simulation.process RIG.toml``.

Prints one JSON line with a URL per device once all ports are ready, then runs until interrupted.
Commands come as JSON lines on stdin (see ``handle``), unless that is a terminal.
"""

from __future__ import annotations

import argparse
import contextlib
import math
import os
import select
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_parameter_file, read_rig
from rigapp.process.ending import termination_signals
from rigapp.process.stale_files import remove_left_behind
from rigapp.schema.wire import json_bytes
from rigapp.simulation.handle import FOLDER, SimulatedRig, start_simulated_rig

__all__ = ["SimulatedRig", "main", "start_simulated_rig"]

ORPHAN_LIMIT_S = 10.0  # many times the drive's watchdog time-out, which stops the spindle
_READ_SIZE = 65536
LEFT_BEHIND = FOLDER + r"(?P<pid>\d+)-.*"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the simulated rig until interrupted; return the exit status (0 done, 2 unusable)."""
    options = _options(argv)
    try:
        with contextlib.ExitStack() as stack:
            return _run(options, stack)
    except UnusableInput as error:
        print(error, file=sys.stderr)
        return 2


def _options(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="rigapp sim", description="Run the simulated devices of a rig file."
    )
    parser.add_argument("rig", type=Path, help="rig file")
    parser.add_argument("--speed", help="times real time, or max; default: real time")
    parser.add_argument("--parameters", type=Path, help="parameter file of the mechanism")
    parser.add_argument("--faults", type=Path, help="fault file")
    parser.add_argument("--truth", type=Path, help="write the plant's truth here (.npz) at the end")
    parser.add_argument("--sockets", action="store_true", help="TCP ports in place of ptys")
    parser.add_argument(
        "--exit-with-parent",
        action="store_true",
        help="when stdin ends, continue until the spindle is at rest, at most 10 s",
    )
    return parser.parse_args(argv)


def speed_of(text: str | None) -> float:
    """Return a speed as a number, inf for max and 1 by default; raise UnusableInput."""
    if text is None:
        return 1.0
    if text == "max":
        return math.inf
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0.0 < speed < math.inf:
        raise UnusableInput("--speed {} is not usable; give a number above 0, or max.", text)
    return speed


def _run(options: argparse.Namespace, stack: contextlib.ExitStack) -> int:
    stopping = stack.enter_context(termination_signals())
    from rigapp.simulation.constants import packaged_parameters
    from rigapp.simulation.faults import read_faults
    from rigapp.simulation.rig import RigSimulation
    from rigapp.simulation.truth import TruthRecorder

    speed = speed_of(options.speed)
    rig_file = read_rig(options.rig).record
    parameters = packaged_parameters()
    if options.parameters is not None:
        parameters = read_parameter_file(options.parameters).record
    faults = read_faults(options.faults) if options.faults is not None else ()
    truth = TruthRecorder(options.truth) if options.truth is not None else None
    rig = RigSimulation(
        rig_file,
        parameters,
        _endpoints(options.sockets, stack),
        speed=speed,
        now_s=time.monotonic(),
        faults=faults,
        truth=truth,
    )
    stack.callback(rig.close)
    _say(json_bytes(rig.urls) + b"\n")
    _loop(rig, stopping, exit_with_parent=options.exit_with_parent)
    return 0


def _endpoints(sockets: bool, stack: contextlib.ExitStack) -> Callable[[str], Any]:
    """Return the factory of endpoints for devices: a pty, or TCP without ptys."""
    from rigapp.simulation.wire.endpoints import SocketEndpoint
    from rigapp.simulation.wire.ports import port_at

    if sockets:
        return lambda name: SocketEndpoint()
    remove_left_behind(Path(tempfile.gettempdir()), LEFT_BEHIND)
    folder = Path(tempfile.mkdtemp(prefix=f"{FOLDER}{os.getpid()}-"))
    stack.callback(shutil.rmtree, folder, ignore_errors=True)
    return lambda name: port_at(folder / name)


def _loop(rig: Any, stopping: list[str], *, exit_with_parent: bool) -> None:
    from rigapp.process.processclock import DEVICE_SHARE, ProcessClock
    from rigapp.simulation.handle import Lines, answer

    lines = Lines()
    stdin = _command_input()
    orphan_until = math.inf
    own, wait_s = ProcessClock(time.monotonic(), time.thread_time(), DEVICE_SHARE), 0.0
    while not stopping:
        now_s = time.monotonic()
        wait_s = rig.step(now_s, own.tick(now_s, time.thread_time(), wait_s))
        watched = rig.waitable() + ([stdin] if stdin is not None else [])
        ready, _, _ = select.select(watched, [], [], wait_s)
        if stdin is not None and stdin in ready:
            data = _read(stdin)
            for line in lines.feed(data):
                _say(answer(rig, line))
            if not data:
                stdin = None
                if exit_with_parent:
                    orphan_until = time.monotonic() + ORPHAN_LIMIT_S
        if orphan_until < math.inf and (rig.still() or time.monotonic() > orphan_until):
            return


def _command_input() -> int | None:
    """Return the descriptor of stdin, None for a terminal: reading it could stop the process."""
    try:
        descriptor = sys.stdin.fileno()
        os.fstat(descriptor)
    except (AttributeError, OSError, ValueError):
        return None
    return None if os.isatty(descriptor) else descriptor


def _read(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, _READ_SIZE)
    except OSError:
        return b""


def _say(line: bytes) -> None:
    """Write a line to stdout; ignore a closed one."""
    with contextlib.suppress(BrokenPipeError, ValueError):
        sys.stdout.buffer.write(line)
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    sys.exit(main())
