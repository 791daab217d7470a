"""`rigapp status`: the engines that run, each in a few lines."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.engine.devices import LoadDriver, make_devices
from rigapp.service.launch import find_engine
from rigapp_drivers.api import DriveStatus
from rigapp_drivers.registry import load_driver

ANSWER_S = 5.0  # far longer than an engine that runs takes


def show_engines(rig: Path | None, *, as_json: bool) -> int:
    """Print the engines of this computer, and one that RIGAPP_ENGINE names; 1 when there is none.

    rig: only the engine of this rig file. An engine that does not answer is listed with the reason.
    """
    found = [_requested(entry) for entry in _entries(rig)]
    if as_json:
        print(json.dumps(found, indent=2))
    elif not found:
        print(f"No engine runs{f' for {rig}' if rig is not None else ''}.")
    else:
        print("\n".join(line for one in found for line in _lines(one)))
    return 0 if found else 1


def _entries(rig: Path | None) -> list[Any]:
    import os

    from rigapp.service.launch import find_engine
    from rigapp.service.registry import read_entry, running_engines

    if rig is not None:
        entry = find_engine(rig)
        return [entry] if entry is not None else []
    elsewhere = os.environ.get("RIGAPP_ENGINE")
    return [*([read_entry(Path(elsewhere))] if elsewhere else []), *running_engines()]


def _requested(entry: Any) -> dict[str, Any]:
    from rigapp.service.client import Client, EngineUnreachable

    shown: dict[str, Any] = {"pid": entry.pid, "rig_file": entry.rig}
    try:
        client = Client(entry, look=False)
    except EngineUnreachable as error:
        return {**shown, "problem": str(error)}
    try:
        reply = client.request("status", timeout_s=ANSWER_S)
    except EngineUnreachable as error:
        return {**shown, "problem": str(error)}
    finally:
        client.close()
    if not reply.ok:
        return {**shown, "problem": reply.sentence}
    status = reply.result
    shown |= _told(status)
    names = (
        "state", "reason", "rig", "test", "file", "revolution", "planned", "committed",
        "speed_rpm", "data_age_s", "in_command", "simulated",
    )  # fmt: skip
    alarms = [
        {name: alarm[name] for name in ("key", "title", "cause", "state", "severity", "first_out")}
        for alarm in status["alarms"]
    ]
    recovery = status.get("recovery", {})
    next_step = {name: recovery.get(name, "") for name in ("step", "verb", "sentence")}
    return {
        **shown,
        **{name: _finite(status[name]) for name in names},
        "calibration": status.get("calibration"),
        "alarms": alarms,
        "next": next_step,
    }


def _told(result: Any) -> dict[str, str]:
    """Return the state of a status in a word and in a line, as the window says them."""
    from rigapp.presentation.states import state_details, state_line, state_word
    from rigapp.schema.messages import Status

    status = Status.of_tree(result)
    told = {"state_word": state_word, "state_line": state_line, "state_details": state_details}
    return {name: tell(status) for name, tell in told.items()}


def _indented(text: str) -> list[str]:
    """Return the lines of a text with its details below it."""
    from rigapp.schema.details import indented

    return [f"  {line}" for line in indented(text).splitlines()]


def _finite(value: Any) -> Any:
    """Return None for an infinite number, which JSON cannot tell."""
    return None if isinstance(value, float) and value in (float("inf"), float("-inf")) else value


def _lines(one: dict[str, Any]) -> list[str]:
    head = f"engine {one['pid']}: {one['rig_file']}"
    if "problem" in one:
        return [head, *_indented(one["problem"])]
    word, line = one["state_word"], one["state_line"]
    lines = [head, f"  {line}" if line.startswith(word) else f"  {word}. {line}"]
    lines += [f"      {one}" for one in one["state_details"].splitlines()]
    if one["file"]:
        lines.append(
            f"  {one['test']}: revolution {one['revolution']} of {one['planned']},"
            f" {one['committed']} safe in {one['file']}"
        )
    if one["in_command"]:
        lines.append(f"  in command: {one['in_command']}")
    for alarm in one["alarms"]:
        lines += _indented(f"{alarm['severity']}, {alarm['state']}: {alarm['cause']}")
    return lines


def reset_drive(rig_path: Path, load: LoadDriver = load_driver) -> int:
    """Acknowledge what the drive holds, after its cause is removed; return the exit status.

    The motor stays without power. Raises UnusableInput while an engine has the drive, DeviceError
    when the drive does not answer or keeps its fault.
    """
    if find_engine(rig_path) is not None:
        raise UnusableInput(f"{rig_path}: an engine runs this rig; reset there, in its window.")
    rig = read_rig(rig_path)
    devices = make_devices(rig.record, {}, load, str(rig_path), folder=rig_path.parent)
    spindle = devices.spindle
    try:
        spindle.open()
        spindle.configure(devices.drive_request)
        held = _held(spindle.status())
        if held:
            spindle.reset_fault()
    finally:
        spindle.close()
    where = f"{spindle.name} on {spindle.port}"
    print(f"{where}: {held} was reset; the motor has no power." if held else f"{where}: ready.")
    return 0


def _held(status: DriveStatus) -> str:
    """Return what keeps a drive from turning, in words; empty when nothing does."""
    stop = ("the emergency stop",) if status.emergency_stop else ()
    return ", ".join((*stop, *status.faults))
