"""Faults that can be injected into a simulated rig."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp_drivers.registry import DriverNotFound, load_driver, load_simulator


@dataclass(frozen=True, slots=True)
class FaultChoice:
    """One fault: its kind and place (a device, or "signal")."""

    kind: str
    where: str


def fault_choices(devices: tuple[tuple[str, str], ...]) -> list[FaultChoice]:
    """Return every fault of a simulated rig; devices: (name, driver) of each."""
    # Import the simulator only for a simulated rig, not with the window.
    from rigapp.simulation.disturbances import SignalFault
    from rigapp.simulation.wire.link import WireFault

    result = [FaultChoice(kind.value, "signal") for kind in SignalFault]
    for name, driver in devices:
        result += [FaultChoice(kind.value, name) for kind in WireFault]
        known = {kind.value for kind in WireFault}
        result += [FaultChoice(kind, name) for kind in _device_kinds(driver) if kind not in known]
    return result


def _device_kinds(driver: str) -> list[str]:
    try:
        simulator = load_simulator(load_driver(driver))
    except DriverNotFound:
        return []
    return [kind.value for kind in getattr(simulator, "kinds", ())]
