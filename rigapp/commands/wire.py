"""`rigapp wire`: what a device and the program said on a recorded line."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.config.names import login_name
from rigapp.schema.messages import Status
from rigapp.service.client import Client
from rigapp_drivers.registry import DriverNotFound, load_driver
from rigapp_drivers.wire.trace import RecordKind, TraceError, WireRecord, WireTrace, read_trace

PACKING_S = 120.0
"""Recordings of all devices, each bounded to some hundred megabytes, are packed within it."""
LOOK_S = 0.2
MARKS = {RecordKind.SENT: ">", RecordKind.RECEIVED: "<", RecordKind.NOTE: "#"}
SHOWN_BYTES = 64


def show_line(path: Path, *, raw: bool = False) -> int:
    """Print a recorded line; status 1 where the file is damaged. Raises UnusableInput."""
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
    """Record the lines of a rig's devices for a report of an error; exit status.

    Its engine does it, started where none runs; the devices are connected anew unless the rig is
    occupied. Raises UnusableInput, EngineUnreachable.
    """
    from rigapp.service.launch import attach

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
        while not (told := _told(client)):
            if time.monotonic() > deadline:
                raise UnusableInput("{}: was not written in {:g} s.", file, PACKING_S)
            time.sleep(LOOK_S)
    finally:
        client.close()
    print(told)
    return 0 if file.exists() else 1


def _told(client: Client) -> str:
    """Return what came of the report, empty while it is recorded."""
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
