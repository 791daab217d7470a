"""Identities of connected devices, and detection of exchanged devices."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Final

from rigapp.texts import joined, say
from rigapp_drivers.api import DeviceError, DriverInfo, Identity, WrongDevice
from rigapp_drivers.discovery import ask
from rigapp_drivers.edge import Guarded
from rigapp_drivers.registry import DriverNotFound, available_drivers, load_driver

IDENTITY: Final = ("maker", "model", "firmware", "serial_number")
"""Fields of an identity; in a file ``device_model`` etc. beside the settings of a device."""


def identity_record(identity: Identity) -> dict[str, str]:
    """Return the identity of a device as stored beside its settings."""
    result = {f"device_{name}": getattr(identity, name) for name in IDENTITY}
    return {name: value for name, value in result.items() if value}


def stranger(device: Guarded, driver: str) -> WrongDevice | None:
    """Return an error if a device of another driver answers on the port, else None.

    Probes the port for the other drivers, without motion or change of settings.
    """
    answer = ask(device.port, _others(driver)).answer
    if answer is None:
        return None
    identity = answer.identity
    number = identity.serial_number
    name = " ".join(part for part in (identity.maker, identity.model) if part) or answer.title
    return WrongDevice.at(
        device,
        "a {} answers here{}; check whether ports are exchanged, and name this one for it"
        ' (driver = "{}").',
        name,
        say(" (serial number {})", number) if number else "",
        answer.driver,
    )


def combined_error(errors: Sequence[DeviceError]) -> DeviceError:
    """Return one error for several devices, with all in its ``each``; errors: at least one."""
    first = errors[0]
    if len(errors) == 1:
        return first
    same_sentence = len({error.sentence for error in errors}) == 1
    each = (say("{}: {}", error.device, error.sentence) for error in errors)
    words = first.sentence if same_sentence else joined(" ", each)
    devices = joined(", ", dict.fromkeys(error.device for error in errors))
    ports = joined(", ", dict.fromkeys(error.port for error in errors))
    error = type(first)(devices, ports, words)
    error.each = tuple(errors)
    return error


def _others(driver: str) -> list[DriverInfo]:
    result = []
    for name in available_drivers():
        if name != driver:
            with suppress(DriverNotFound):
                result.append(load_driver(name))
    return result


def identity_words(readback: Mapping[str, object]) -> str:
    """Return the identity of a device as text, from its stored fields."""
    words = [str(readback.get(f"device_{name}", "")) for name in IDENTITY[:2]]
    name = " ".join(word for word in words if word)
    firmware, number = (readback.get(f"device_{name}", "") for name in IDENTITY[2:])
    parts = [name]
    parts += [say("firmware {}", firmware)] if firmware else []
    parts += [say("serial number {}", number)] if number else []
    return joined(", ", [part for part in parts if part])
