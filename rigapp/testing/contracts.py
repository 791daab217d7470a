"""Contract tables: the drivers, their requests, and the faults to report with time limits.

``shipped.toml`` contains the shipped drivers. A driver of another package provides a file of the
same format.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rigapp_drivers.api import DriverInfo
from rigapp_drivers.registry import available_drivers, load_driver

SHIPPED = Path(__file__).with_name("shipped.toml")


@dataclass(frozen=True)
class ExpectedFault:
    """One row: a fault, the driver's report of it, and the time limit in s.

    layer: ``wire`` (of any device) or ``device`` (the simulator's list). drivers: names, or ``data
    source`` / ``spindle`` / ``slow source`` for all of a kind. tells: names of error classes,
    ``flag NAME`` of a sample's quality, ``fault`` or ``warning`` in the drive's status, ``log`` (a
    warning of the driver), ``silence`` (no samples at all) or ``nothing`` (the fault is tolerated).
    words: a regular expression for the text. unnumbered: an unknown number of samples is lost, so
    that only the encoder's count shows the position of the gap, and the report comes later.
    """

    kind: str
    layer: str
    drivers: tuple[str, ...]
    tells: tuple[str, ...]
    within_s: float
    words: str = ""
    value: float | None = None
    count: int | None = None
    title: str = ""
    unnumbered: bool = False
    settings: dict[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Return the name of the row."""
        return self.title or self.kind


@dataclass(frozen=True)
class Contract:
    """A driver, its configuration and that of its simulator in the suite, and its faults."""

    info: DriverInfo
    settings: dict[str, Any]
    simulator: dict[str, Any]
    inputs: dict[str, tuple[str, float]]
    sample_rate_Hz: float
    faults: tuple[ExpectedFault, ...]

    def fault(self, kind: str) -> ExpectedFault:
        """Return the row of a fault common to all drivers of this kind; raise LookupError."""
        for row in self.faults:
            if row.kind == kind:
                return row
        raise LookupError(f"the contract of {self.info.name} has no row of kind {kind!r}")


def read_contracts(others: Iterable[Path] = ()) -> list[Contract]:
    """Return a contract for every driver in the tables.

    others: tables of other packages. Raises ValueError for a driver that is not installed.
    """
    files = [tomllib.loads(path.read_text("utf-8")) for path in (SHIPPED, *others)]
    rows = [_row(row) for file in files for row in file.get("fault", ())]
    profiles = {name: profile for file in files for name, profile in file["driver"].items()}
    missing = sorted(profiles.keys() - set(available_drivers()))
    if missing:
        raise ValueError(f"no such driver is installed: {', '.join(missing)}")
    contracts = []
    for name, profile in profiles.items():
        info = load_driver(name)
        faults = tuple(row for row in rows if {name, str(info.kind)} & set(row.drivers))
        inputs = {key: (kind, span) for key, (kind, span) in profile.get("inputs", {}).items()}
        contracts.append(
            Contract(
                info=info,
                settings=profile.get("settings", {}),
                simulator=profile.get("simulator", {}),
                inputs=inputs,
                sample_rate_Hz=float(profile.get("sample_rate_Hz", 960.0)),
                faults=_own_rows_first(faults, name),
            )
        )
    return contracts


def _own_rows_first(rows: tuple[ExpectedFault, ...], name: str) -> tuple[ExpectedFault, ...]:
    """Replace rows for a whole kind of driver by rows that name the driver."""
    own = [row for row in rows if name in row.drivers]
    taken = {row.name for row in own}
    return (*own, *(row for row in rows if name not in row.drivers and row.name not in taken))


def _row(row: dict[str, Any]) -> ExpectedFault:
    tells = row.pop("tells")
    return ExpectedFault(
        tells=(tells,) if isinstance(tells, str) else tuple(tells),
        drivers=tuple(row.pop("drivers")),
        **row,
    )
