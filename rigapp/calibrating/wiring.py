"""Identity of the cell or probes of a record, and of the measuring line to which it is bound."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Final

from rigapp.config.rig import LoadCellSection, ProbesSection, RigFile
from rigapp.texts import say

SECTIONS: Final[Mapping[str, str]] = {
    "load cell": "load_cell",
    "probe": "probes",
    "probe pair": "probes",
}
"""Kind of a record -> its section of the rig file; other kinds are bound in another way."""

_OTHER_LINE: Final = frozenset({"record", "reply_timeout_s", "poll_interval_s", "block_s"})
"""Settings of a device that change no value."""


def wiring_of(rig: RigFile) -> dict[str, dict[str, Any]]:
    """Return the measuring lines of load cell and probes, by section.

    Driver, serial number and settings of the device, range and inputs, by the rig file.
    """
    return {name: _line(rig, getattr(rig, name)) for name in dict.fromkeys(SECTIONS.values())}


def _line(rig: RigFile, section: LoadCellSection | ProbesSection) -> dict[str, Any]:
    device = rig.devices[section.device]
    ranged = "range_mV_per_V" if isinstance(section, LoadCellSection) else "range_V"
    settings = {key: value for key, value in device.settings.items() if key not in _OTHER_LINE}
    return {
        "driver": device.driver,
        "serial_number": device.serial_number,
        "input_1": section.input_1,
        "input_2": section.input_2,
        ranged: getattr(section, ranged),
        **{f"settings.{key}": value for key, value in sorted(settings.items())},
    }


def foreign(kind: str, content: Mapping[str, Any], rig: RigFile) -> Iterator[str]:
    """Yield differences between a record's cell and line and those of the rig file.

    content: of the record. Readings that came as a table, and older records, have no line.
    """
    section = SECTIONS.get(kind)
    if section is None:
        return
    if section == "load_cell":
        yield from _another_cell(content, rig.load_cell.serial_number)
    taken = (content.get("taken") or {}).get("wiring")
    if not isinstance(taken, Mapping) or not isinstance(taken.get(section), Mapping):
        return
    before, now = taken[section], _line(rig, getattr(rig, section))
    for key in sorted({*before, *now}):
        old, new = before.get(key), now.get(key)
        if _plain(old) != _plain(new):
            yield say("was taken with {} = {}, the rig file says {}", key, _text(old), _text(new))


def _another_cell(content: Mapping[str, Any], named: str) -> Iterator[str]:
    settings = content["settings"]
    of = settings.get("cell", {}).get("serial_number") or ""
    if not named or of == named:
        return
    if of:
        yield say("is of the load cell {}, the rig file names {}", repr(of), repr(named))
    else:
        yield say("does not say of which load cell it is, the rig file names {}", repr(named))


def _plain(value: Any) -> Any:
    return list(map(_plain, value)) if isinstance(value, list | tuple) else value


def _text(value: Any) -> Any:
    return say("nothing") if value in (None, "") else value
