"""`rigapp wire`: what a device and the program said on a recorded line."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp_drivers.registry import DriverNotFound, load_driver
from rigapp_drivers.wire.trace import RecordKind, TraceError, WireRecord, WireTrace, read_trace

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
