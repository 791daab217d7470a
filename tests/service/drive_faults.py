"""What a drive may do behind the program's back: for the table of stops, and for random walks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stories import EXAMPLES

from rigapp.schema.messages import RunState


@dataclass(frozen=True)
class Drive:
    """A drive's rig, and the targets of its commands."""

    name: str
    rig: Path
    off: int
    ramp: int


DRIVES = (
    Drive("roboclaw", EXAMPLES / "simulated.toml", off=32, ramp=38),
    Drive("cia402", EXAMPLES / "simulated_alternate.toml", off=0x6040, ramp=0x60FF),
)


@dataclass(frozen=True)
class Case:
    """What the drive does, and whether only its watchdog can stop it, None where it may fire."""

    name: str
    faults: tuple[Mapping[str, Any], ...] = ()
    fires: bool | None = False
    ramp: bool = False
    state: RunState = RunState.RUNNING

    @property
    def unseen(self) -> bool:
        """Tell whether no encoder sees the crank."""
        return any(fault.get("device") == "daq" for fault in self.faults)


IGNORES_ALL = {"kind": "ignored_command"}
CASES = (
    Case("obeys"),
    Case("ignores one power-off", ({"kind": "ignored_command", "target": "off", "count": 1},)),
    Case("ignores five", ({"kind": "ignored_command", "target": "off", "count": 5},)),
    Case("ignores every power-off", ({"kind": "ignored_command", "target": "off"},), fires=True),
    Case("ignores everything", (IGNORES_ALL,), fires=True),
    Case("and says it has no power", (IGNORES_ALL, {"kind": "false_readback"}), fires=True),
    Case(
        "and the encoder is stale",
        (IGNORES_ALL, {"kind": "false_readback"}, {"kind": "hang", "device": "daq"}),
        fires=True,
    ),
    Case(
        "and says it stands",
        (
            IGNORES_ALL,
            {"kind": "false_readback"},
            {"kind": "false_standstill"},
            {"kind": "hang", "device": "daq"},
        ),
        fires=True,
    ),
    Case(
        "obeys, and no encoder sees it",
        ({"kind": "false_standstill"}, {"kind": "hang", "device": "daq"}),
        fires=None,
    ),
    Case("ignores the ramp", ({"kind": "ignored_command", "target": "ramp"},), ramp=True),
    Case(
        "confirms late, ignores one",
        (
            {"kind": "slow_command", "value": 0.15, "count": 4},
            {"kind": "ignored_command", "target": "off", "count": 1},
        ),
    ),
    Case("turns by itself in Ready", ({"kind": "turns_by_itself"},), state=RunState.READY),
    Case(
        "and ignores everything",
        (IGNORES_ALL, {"kind": "turns_by_itself"}),
        fires=True,
        state=RunState.READY,
    ),
)


def faults_of(drive: Drive, case: Case) -> list[dict[str, Any]]:
    """Return the faults of a case as this drive has them."""
    return [
        {"device": "drive", **fault, **({"target": getattr(drive, target)} if target else {})}
        for fault in case.faults
        for target in [fault.get("target")]
    ]
