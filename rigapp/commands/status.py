"""`rigapp status` of running engines, `rigapp reset`, and `rigapp wire` of recorded lines."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.names import login_name
from rigapp.engine.devices import LoadDriver, make_devices
from rigapp.schema.messages import Status
from rigapp.service.client import Client, EngineUnreachable
from rigapp.service.launch import attach, find_engine
from rigapp_drivers.api import DriveStatus
from rigapp_drivers.registry import DriverNotFound, load_driver
from rigapp_drivers.wire.trace import RecordKind, TraceError, WireRecord, WireTrace, read_trace

ANSWER_S = 5.0  # far longer than a running engine takes


def show_engines(rig: Path | None, *, as_json: bool) -> int:
    """Print the engines of this computer and that of RIGAPP_ENGINE; return 1 without engines.

    rig: only the engine of this rig file. An engine that does not answer is listed with the reason.
    """
    result = [_requested(entry) for entry in _entries(rig)]
    if as_json:
        print(json.dumps(result, indent=2))
    elif not result:
        print(f"No engine runs{f' for {rig}' if rig is not None else ''}.")
    else:
        print("\n".join(line for engine in result for line in _lines(engine)))
    return 0 if result else 1


def _entries(rig: Path | None) -> list[Any]:
    from rigapp.service.registry import read_entry, running_engines

    if rig is not None:
        entry = find_engine(rig)
        return [entry] if entry is not None else []
    elsewhere = os.environ.get("RIGAPP_ENGINE")
    return [*([read_entry(Path(elsewhere))] if elsewhere else []), *running_engines()]


def _requested(entry: Any) -> dict[str, Any]:
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
    shown |= _state_words(status)
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


def _state_words(result: Any) -> dict[str, str]:
    """Return the state of a status as a word and as a line, as in the window."""
    from rigapp.presentation.states import state_details, state_line, state_word

    status = Status.of_tree(result)
    texts = {"state_word": state_word, "state_line": state_line, "state_details": state_details}
    return {name: text_of(status) for name, text_of in texts.items()}


def _indented(text: str) -> list[str]:
    """Return the lines of a text, with its details below it."""
    from rigapp.schema.details import indented

    return [f"  {line}" for line in indented(text).splitlines()]


def _finite(value: Any) -> Any:
    """Return None for an infinite number, which JSON does not have."""
    return None if isinstance(value, float) and value in (float("inf"), float("-inf")) else value


def _lines(engine: dict[str, Any]) -> list[str]:
    head = f"engine {engine['pid']}: {engine['rig_file']}"
    if "problem" in engine:
        return [head, *_indented(engine["problem"])]
    word, line = engine["state_word"], engine["state_line"]
    lines = [head, f"  {line}" if line.startswith(word) else f"  {word}. {line}"]
    lines += [f"      {line}" for line in engine["state_details"].splitlines()]
    if engine["file"]:
        lines.append(
            f"  {engine['test']}: revolution {engine['revolution']} of {engine['planned']},"
            f" {engine['committed']} safe in {engine['file']}"
        )
    if engine["in_command"]:
        lines.append(f"  in command: {engine['in_command']}")
    for alarm in engine["alarms"]:
        lines += _indented(f"{alarm['severity']}, {alarm['state']}: {alarm['cause']}")
    return lines


def reset_drive(rig_path: Path, load: LoadDriver = load_driver) -> int:
    """Reset the fault of the drive after its cause is removed; return the exit status.

    The motor stays without power. Raises UnusableInput while an engine uses the drive, DeviceError
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
    """Return what prevents a drive from turning as text; empty when nothing does."""
    stop = ("the emergency stop",) if status.emergency_stop else ()
    return ", ".join((*stop, *status.faults))


PACKING_S = 120.0
"""Time limit for packing the recordings of all devices, each of some hundred megabytes at most."""
POLL_S = 0.2
MARKS = {RecordKind.SENT: ">", RecordKind.RECEIVED: "<", RecordKind.NOTE: "#"}
SHOWN_BYTES = 64


def show_line(path: Path, *, raw: bool = False) -> int:
    """Print a recorded line; return 1 where the file is damaged. Raises UnusableInput."""
    try:
        trace = read_trace(path)
    except TraceError as error:
        raise UnusableInput(str(error)) from error
    header = trace.header
    words = ", ".join(
        f"{key} {header[key]}" for key in ("device", "driver", "port") if key in header
    )
    print(f"# {words}, recorded {header.get('started', 'at an unknown time')}")
    for line in shown(trace, raw=raw):
        print(line)
    if trace.problem:
        print(trace.problem, file=sys.stderr)
    return 1 if trace.problem else 0


def report_lines(rig: Path, to: Path, seconds: float) -> int:
    """Record the lines of a rig's devices for a bug report; return the exit status.

    The rig's engine records them, and is started if necessary; the devices are reconnected unless
    the rig is occupied. Raises UnusableInput, EngineUnreachable.
    """
    read_rig(rig)
    file = to.resolve()
    client = attach(rig, login_name())
    try:
        requested = {"file": str(file), "duration_s": seconds, "reconnect": True}
        reply = client.request("report_begin", requested)
        if not reply.ok:
            raise UnusableInput(reply.sentence)
        print(f"Recording for {seconds:g} s.", file=sys.stderr)
        deadline = time.monotonic() + seconds + PACKING_S
        while not (sentence := _report_sentence(client)):
            if time.monotonic() > deadline:
                raise UnusableInput("{}: was not written in {:g} s.", file, PACKING_S)
            time.sleep(POLL_S)
    finally:
        client.close()
    print(sentence)
    return 0 if file.exists() else 1


def _report_sentence(client: Client) -> str:
    """Return the result of the report, empty during the recording."""
    report = Status.of_tree(client.request("status").result).engine.line_report
    return report.sentence if report is not None else ""


def shown(trace: WireTrace, *, raw: bool = False) -> Iterator[str]:
    """Yield the lines: seconds since the first record, direction, meaning."""
    decoder = None
    if not raw:
        try:
            make = load_driver(str(trace.header["driver"])).decoder
            decoder = make() if make is not None else None
        except DriverNotFound as error:
            yield f"# {error}"
    began_ns = trace.records[0].time_ns if trace.records else 0
    for record in trace.records:
        head = f"{(record.time_ns - began_ns) / 1e9:11.6f} {MARKS[record.kind]}"
        if record.kind is RecordKind.NOTE:
            yield f"{head} {', '.join(f'{key} {value}' for key, value in record.note.items())}"
        elif decoder is None:
            yield f"{head} {_hex(record)}"
        else:
            decode = decoder.sent if record.kind is RecordKind.SENT else decoder.received
            yield from (f"{head} {text}" for text in decode(record.data))


def _hex(record: WireRecord) -> str:
    more = len(record.data) - SHOWN_BYTES
    return record.data[:SHOWN_BYTES].hex(" ") + (f" ... and {more} more" if more > 0 else "")
