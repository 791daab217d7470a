"""Where the lines of a rig's devices are recorded."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

from rigapp_drivers.api import DriverInfo
from rigapp_drivers.wire.recorder import WireRecorder, record_line

FOLDER: Final = "wire"
SUFFIX: Final = ".wire"
KEPT: Final = 10
"""Recordings of a device that its rig file asks for; older ones are deleted."""


@dataclass(frozen=True, slots=True)
class WireRecording:
    """Tell which lines are recorded and where.

    folder: of the rig file, whose key ``record`` puts recordings into the folder ``wire`` there.
    file: of ``--record-wire``, which records every device, each into a file with its name; None
    without it.
    """

    folder: Path = Path()
    file: Path | None = None

    def attach(
        self,
        device: str,
        port: str,
        wanted: bool,
        driver: DriverInfo,
        settings: Mapping[str, Any],
    ) -> None:
        """Record a device's line where that is asked for, else no longer."""
        path = self._path(device, wanted)
        if path is None:
            record_line(device, port, None)
            return
        header = {
            "device": device,
            "driver": driver.name,
            "port": port,
            "protocol": driver.protocol,
            "settings": dict(settings),
        }
        record_line(device, port, WireRecorder(path, header))

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
    """Return where ``--record-wire FILE`` keeps the line of one device."""
    return file.with_name(f"{file.stem}-{device}{file.suffix or SUFFIX}")
