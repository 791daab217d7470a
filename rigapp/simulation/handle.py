"""Start and control the simulated rig as a process, and execute its commands in that process."""

from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile
from rigapp.config.toml import toml_text
from rigapp.process.children import Child
from rigapp.schema.wire import json_bytes
from rigapp.texts import joined, say

if TYPE_CHECKING:
    from rigapp.simulation.rig import RigSimulation

ANSWER_S = 30.0  # replies take ms, but the computer may stall
START_S = 180.0
"""After a change the first start compiles the kernels of the plant, slowly on a busy computer."""
FOLDER = "rigapp-sim-"
"""Prefix of the names of temporary folders; the process id of the owner follows."""
_CLOSE_S = 5.0  # then the process is killed, which loses no data


class SimulationFailed(Exception):
    """The simulated rig's process did not start, has ended, or does not reply."""


class SimulatedRig:
    """A running simulated rig; ``urls``: device of the rig file -> URL."""

    def __init__(self, process: Child, urls: dict[str, str]) -> None:
        self.urls = urls
        self._process = process
        self._lock = threading.Lock()

    @property
    def pid(self) -> int:
        """Return the process id."""
        return self._process.pid

    def alive(self) -> bool:
        """Return whether the process is running."""
        return self._process.running

    def inject(self, fault: Mapping[str, object]) -> None:
        """Inject a fault; raise UnusableInput, SimulationFailed.

        Keys as in a fault file; its kind may also be under ``fault``, as on the control channel.
        """
        message = dict(fault)
        if "kind" in message:
            message["fault"] = message.pop("kind")
        self._obey(message)

    def clear(self, kind: str) -> None:
        """End all faults of a kind; raise SimulationFailed."""
        self._obey({"clear": kind})

    def hand(self, what: str, **details: Any) -> None:
        """Perform an action of ``simulated_operator``; raise UnusableInput, SimulationFailed."""
        self._obey({"hand": what, **details})

    def wear_to(self, depth_um: float, area_mm2: float | None = None) -> None:
        """Set the bushing's wear to that of an earlier test; the crank must be stationary.

        Without an area it is derived from the depth. Raises UnusableInput, SimulationFailed.
        """
        self._obey({"state": {"wear_depth_um": depth_um, "worn_area_mm2": area_mm2}})

    def state(self) -> dict[str, Any]:
        """Return the plant's true angle, speed, wear, drive, links; raise SimulationFailed."""
        return self._obey({"query": "state"})

    def close(self) -> None:
        """End the process; never raises; safe to call twice."""
        self._process.close(_CLOSE_S)

    def __enter__(self) -> SimulatedRig:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _obey(self, message: dict[str, Any]) -> dict[str, Any]:
        with self._lock:
            try:
                self._process.stdin.write(json_bytes(message) + b"\n")
                self._process.stdin.flush()
                line = _read_line(self._process, ANSWER_S)
            except (OSError, ValueError) as error:
                raise SimulationFailed(say("the simulated rig has ended ({}).", error)) from error
        reply = msgspec.json.decode(line, type=dict[str, Any])
        if "error" in reply:
            raise UnusableInput(reply["error"])
        return reply


def start_simulated_rig(
    rig_path: Path,
    *,
    speed: float | Literal["max"],
    parameters: ParameterFile | None,
    faults: Path | None = None,
    truth: Path | None = None,
    timeout_s: float = START_S,
) -> SimulatedRig:
    """Start the devices of a rig file in a separate process and wait until they are ready.

    parameters: the mechanism, the packaged one if None. If this process ends, the other continues
    until the spindle is stationary, at most 10 s; it does not receive this one's Ctrl-C. Raises
    UnusableInput with the process's message, SimulationFailed on another failure or time-out.
    """
    options: list[object] = ["--speed", speed, "--exit-with-parent"]
    options += ["--faults", faults] if faults is not None else []
    options += ["--truth", truth] if truth is not None else []
    with contextlib.ExitStack() as stack:
        if parameters is not None:
            folder = stack.enter_context(
                tempfile.TemporaryDirectory(prefix=f"{FOLDER}{os.getpid()}-")
            )
            path = Path(folder) / "parameters.toml"
            path.write_text(toml_text(parameters), encoding="utf-8")
            options += ["--parameters", path]
        process = Child("rigapp.simulation.process", rig_path, *options, pipes=True)
        try:
            urls = msgspec.json.decode(_read_line(process, timeout_s), type=dict[str, str])
        except OSError as error:
            raise _failure(process, error) from error
        return SimulatedRig(process, urls)


def _failure(process: Child, error: OSError) -> Exception:
    """End the process of a rig that did not start, and return the error."""
    with contextlib.suppress(subprocess.TimeoutExpired):
        if not isinstance(error, TimeoutError):
            process.wait(_CLOSE_S)
    if process.running:
        process.close(_CLOSE_S)
        return SimulationFailed(f"the simulated rig did not answer: {error}")
    status, reason = process.status, process.messages()
    process.close()
    if status == 2 and reason:
        return UnusableInput(reason)
    return SimulationFailed(f"the simulated rig ended with status {status}: {reason or error}")


def _read_line(process: Child, timeout_s: float) -> bytes:
    """Return one line of the process's output; raise TimeoutError, BrokenPipeError."""
    try:
        return process.read_line(timeout_s)
    except TimeoutError:
        raise TimeoutError(say("no line from the simulated rig within {:g} s", timeout_s)) from None
    except BrokenPipeError:
        raise BrokenPipeError(say("the simulated rig's output ended")) from None


# Control channel of the simulated rig: a JSON line in, a JSON line back.
#
# {"fault": "cable_pull", "device": "daq", "duration_s": 1.0}        -> {"ok": true}
# {"clear": "emergency_stop"}                                        -> {"ok": true}
# {"query": "state"}                                                 -> the true state of the plant
# {"hand": "turn_pin", "angle_deg": 90.0}, see simulated_operator    -> {"ok": true}
# {"state": {"wear_depth_um": 12.5, "worn_area_mm2": 0.3}}           -> {"ok": true}
# anything else                                                      -> {"error": "a sentence"}
#
# ``state`` restores the wear of an earlier test before it is resumed on a restarted rig: the depth
# at the contact and, if known, the worn area (else derived from the depth). The crank must be
# stationary without drive. The keys are those of the reply to ``query``.
#
# A new command is another verb in ``VERBS``: a function of the rig and the message's table.

Table = dict[str, Any]
LONGEST_LINE = 65536


def _inject(rig: RigSimulation, message: Table) -> Table:
    from rigapp.simulation.faults import fault_of  # imports the plant, not needed by the parent

    data = dict(message)
    data["kind"] = data.pop("fault")
    rig.inject(fault_of(data))
    return {"ok": True}


def _clear(rig: RigSimulation, message: Table) -> Table:
    rig.clear(str(message["clear"]))
    return {"ok": True}


def _query(rig: RigSimulation, message: Table) -> Table:
    if message["query"] != "state":
        raise UnusableInput(
            "query {} is not known; the only one is 'state'.", repr(message["query"])
        )
    return rig.report()


def _hand(rig: RigSimulation, message: Table) -> Table:
    from rigapp.simulation.simulated_operator import hand_of

    rig.hands.do(hand_of(message))
    return {"ok": True}


class WornState(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Values set by ``state``."""

    wear_depth_um: float
    worn_area_mm2: float | None = None


def _set_state(rig: RigSimulation, message: Table) -> Table:
    try:
        state = msgspec.convert(message["state"], WornState)
    except msgspec.ValidationError as error:
        raise UnusableInput("state: {}.", error) from error
    rig.wear_to(state.wear_depth_um, state.worn_area_mm2)
    return {"ok": True}


VERBS: Mapping[str, Callable[[RigSimulation, Table], Table]] = {
    "fault": _inject,
    "clear": _clear,
    "query": _query,
    "hand": _hand,
    "state": _set_state,
}


def answer(rig: RigSimulation, line: bytes) -> bytes:
    """Execute one line and return the reply, with its newline."""
    try:
        message = msgspec.json.decode(line, type=dict[str, Any])
        verbs = [verb for verb in VERBS if verb in message]
        if len(verbs) != 1:
            raise UnusableInput("a message has one of the keys {}.", joined(", ", VERBS))
        reply = VERBS[verbs[0]](rig, message)
    except msgspec.DecodeError as error:
        reply = {"error": f"not a JSON object on one line: {error}"}
    except UnusableInput as error:
        reply = {"error": str(error)}
    return json_bytes(reply) + b"\n"


class Lines:
    """Split received bytes into lines; a line without end is dropped at 64 KiB."""

    def __init__(self) -> None:
        self._rest = b""

    def feed(self, data: bytes) -> list[bytes]:
        """Return the complete, non-empty lines."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        if len(self._rest) > LONGEST_LINE:
            self._rest = b""
        return [line for line in lines if line.strip()]
