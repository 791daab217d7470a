"""Regression test by a recorded line: ``check_trace(path)`` replays it to the driver."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rigapp_drivers.api import DataRequest, DeviceLost, DriveRequest, DriverKind, SlowRequest
from rigapp_drivers.edge import Guarded, GuardedSource, GuardedSpindle, make_driver
from rigapp_drivers.registry import load_driver
from rigapp_drivers.wire.trace import RecordKind, WireTrace, read_trace

_SILENT_READS = 20
_READ_S = 0.1
_PLAYER = "rigapp_drivers.wire.protocol_wire"


@dataclass(frozen=True, slots=True)
class Replayed:
    """Result of a driver with a recorded line; samples: of a data source, without lost ones."""

    identity: Mapping[str, Any]
    readback: Mapping[str, Any]
    samples: int = 0
    lost_samples: int = 0


def check_trace(path: Path | str) -> Replayed:
    """Replay a recorded line to its driver; raise AssertionError if the results differ.

    The driver must read back the same identity and settings as in the recording, and send no other
    requests. Samples of a stream must be complete.
    """
    trace = read_trace(Path(path))
    assert not trace.problem, trace.problem
    header = trace.header
    info = load_driver(str(header["driver"]))
    noted = _notes(trace)
    unknown = _Unknown()
    logging.getLogger(_PLAYER).addHandler(unknown)
    driver = make_driver(info, str(header["device"]), f"wire:{path}", header["settings"])
    try:
        replayed = _replay(driver, info.kind, noted, unknown)
    finally:
        driver.close()
        logging.getLogger(_PLAYER).removeHandler(unknown)
    return replayed


class _Unknown(logging.Handler):
    """Collect the requests without a recorded reply."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.texts.append(record.getMessage())


def _notes(trace: WireTrace) -> dict[str, Any]:
    """Merge the notes; return the first value of each key."""
    note: dict[str, Any] = {}
    for record in trace.records:
        if record.kind is RecordKind.NOTE:
            note = {**record.note, **note}
    return note


def _replay(
    driver: Guarded, kind: DriverKind, noted: Mapping[str, Any], unknown: _Unknown
) -> Replayed:
    identity = driver.open()
    for key, value in noted.get("identity", {}).items():
        now = getattr(identity, key)
        assert key == "port" or _plain(now) == value, f"{key} is {now}, was {value}"
    known = {"maker": identity.maker, "model": identity.model}
    if "request" not in noted:
        assert not unknown.texts, f"not asked when the line was recorded: {unknown.texts}"
        return Replayed(known, {})
    request = _request(kind, noted["request"])
    if isinstance(driver, GuardedSource):
        readback = dict(driver.configure(request).readback)
    else:
        readback = dict(driver.configure(request))
    assert _plain(readback) == noted["readback"], f"read back {readback}"
    # During a stream a driver polls by the clock, so at other positions than in the recording.
    assert not unknown.texts, f"not asked when the line was recorded: {unknown.texts}"
    if isinstance(driver, GuardedSource):
        return _streamed(driver, Replayed(known, readback))
    if isinstance(driver, GuardedSpindle):
        driver.status()
    else:
        driver.read()
    return Replayed(known, readback)


def _request(kind: DriverKind, content: Mapping[str, Any]) -> Any:
    if kind is DriverKind.DATA_SOURCE:
        inputs = {name: (what, size) for name, (what, size) in content["inputs"].items()}
        return DataRequest(content["sample_rate_Hz"], inputs, content["settings"])
    if kind is DriverKind.SPINDLE:
        return DriveRequest(**content)
    return SlowRequest(tuple(content["quantities"]), content["timeout_s"], content["settings"])


def _streamed(source: GuardedSource, replayed: Replayed) -> Replayed:
    source.start()
    samples = lost = silent = 0
    while silent < _SILENT_READS:
        try:
            block = source.read(_READ_S)
        except DeviceLost:  # the recording ends
            break
        silent = silent + 1 if block is None else 0
        if block is not None:
            samples += block.values.shape[1]
            lost += block.lost_before
    assert not lost, f"{lost} samples are lost"
    return Replayed(replayed.identity, replayed.readback, samples, lost)


def _plain(value: Any) -> Any:
    """Return a value after a JSON round trip."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value if isinstance(value, bool | int | float) else str(value)
