"""`rigapp reset`: release a drive that holds its emergency stop or a fault, and turn nothing."""

from __future__ import annotations

from pathlib import Path

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_rig
from rigapp.engine.devices import LoadDriver, make_devices
from rigapp.service.launch import find_engine
from rigapp_drivers.api import DriveStatus
from rigapp_drivers.registry import load_driver


def reset_drive(rig_path: Path, load: LoadDriver = load_driver) -> int:
    """Acknowledge what the drive holds, after its cause is removed; return the exit status.

    The motor stays without power. Raises UnusableInput while an engine has the drive, DeviceError
    when the drive does not answer or keeps its fault.
    """
    if find_engine(rig_path) is not None:
        raise UnusableInput(f"{rig_path}: an engine runs this rig; reset there, in its window.")
    rig = read_rig(rig_path)
    devices = make_devices(rig.record, {}, load, str(rig_path))
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
