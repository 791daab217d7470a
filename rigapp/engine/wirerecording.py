"""Recording of the lines of a rig's devices."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

from rigapp_drivers.api import DriverInfo
from rigapp_drivers.wire.recorder import RecordedFor, WireRecorder, record_line

FOLDER: Final = "wire"
SUFFIX: Final = ".wire"
KEPT: Final = 10
"""Recordings per device by the rig file; older ones are deleted."""


class WireRecording:
    """Recordings of the devices' lines.

    folder: of the rig file, whose key ``record`` records to its folder ``wire``. file: of
    ``--record-wire``, which records all devices, each to a file with its name; None without it.
    Each connection has a file of its own.
    """

    def __init__(self, folder: Path = Path(), file: Path | None = None) -> None:
        self.folder, self.file = folder, file
        self._lines: dict[str, tuple[str, dict[str, Any]]] = {}
        self._set: dict[str, WireRecorder] = {}
        self._report: Path | None = None
        self._reported: Collection[str] = ()
        self._recorders: dict[str, WireRecorder] = {}

    def attach(
        self,
        device: str,
        port: str,
        wanted: bool,
        driver: DriverInfo,
        settings: Mapping[str, Any],
    ) -> None:
        """Start recording a device's line if requested, else stop it."""
        self._end(device)
        path = self._path(device, wanted)
        header = {
            "device": device,
            "driver": driver.name,
            "port": port,
            "protocol": driver.protocol,
            "settings": dict(settings),
        }
        if path is not None:
            self._set[device] = WireRecorder(path, header)
            record_line(device, port, self._set[device])
        before, _ = self._lines.get(device, (port, header))
        if before != port:  # the port of a simulated device changes each time
            record_line(device, before, None, RecordedFor.REPORT)
        self._lines[device] = port, header
        self._record_for_report(device)

    def end(self) -> None:
        """End the recordings by the rig file and ``--record-wire`` and complete their files."""
        for device in tuple(self._set):
            self._end(device)

    def _end(self, device: str) -> None:
        recorder = self._set.pop(device, None)
        if recorder is not None:
            record_line(device, self._lines[device][0], None)
            recorder.close()

    def begin_report(self, folder: Path, devices: Collection[str]) -> None:
        """Also record the lines of devices to a folder, of those not open yet after opening."""
        self.end_report()
        self._report, self._reported = folder, devices
        for device in tuple(self._lines):
            self._record_for_report(device)

    def end_report(self) -> None:
        """End the recording of ``begin_report`` and complete its files."""
        self._report, recorders, self._recorders = None, self._recorders, {}
        for device, recorder in recorders.items():
            record_line(device, self._lines[device][0], None, RecordedFor.REPORT)
            recorder.close()

    def _record_for_report(self, device: str) -> None:
        if self._report is None or device not in self._reported:
            return
        port, header = self._lines[device]
        if device not in self._recorders:
            self._recorders[device] = WireRecorder(self._report / f"{device}{SUFFIX}", header)
        record_line(device, port, self._recorders[device], RecordedFor.REPORT)

    def _path(self, device: str, wanted: bool) -> Path | None:
        if self.file is not None:
            return recorded_file(self.file, device)
        if not wanted:
            return None
        folder = self.folder / FOLDER
        for old in sorted(folder.glob(f"{device}-[0-9]*{SUFFIX}*"))[: 1 - KEPT]:
            old.unlink(missing_ok=True)
        moment = datetime.now(UTC).strftime("%Y%m%d-%H%M%S")
        return folder / f"{device}-{moment}{SUFFIX}"


def recorded_file(file: Path, device: str) -> Path:
    """Return the path of a device's recording for ``--record-wire FILE``."""
    return file.with_name(f"{file.stem}-{device}{file.suffix or SUFFIX}")
