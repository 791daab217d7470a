"""Set up a CiA 402 drive for a run and read everything back; the motor stays off.

Order: power off, supervision in both directions, mode, units and limits, PDOs, operational.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Final

from rigapp.texts import joined, say
from rigapp_drivers.api import DriveRequest, InvalidRequest, ReplyTimeout, SettingRefused
from rigapp_drivers.cia402.monitor import NodeMonitor
from rigapp_drivers.cia402.network import CanNode
from rigapp_drivers.cia402.protocol import (
    COB_MASK,
    MILLI_RPM,
    PDO_INVALID,
    PROFILE_VELOCITY,
    PROFILE_VELOCITY_BIT,
    RPDO1_BASE,
    RPM,
    STATUS_AND_POSITION,
    STATUS_AND_VELOCITY,
    SYNC_ID,
    SYNCHRONOUS,
    TPDO_BASES,
    Control,
    Nmt,
    NodeState,
    consumer_heartbeat,
    mapping_entry,
    velocity_unit_rev_per_s,
)
from rigapp_drivers.spindles import refuse_request

ABORT_QUICK_STOP: Final = 3
_UNITS: Final = {"rpm": RPM, "milli-rpm": MILLI_RPM}
_MODE_S: Final = 1.0  # a change of mode takes a few ms
_START_S: Final = 2.0  # covers at least one heartbeat, whose period is at most 1 s
_SHORTEST_WATCHDOG_S: Final = 0.05  # a busy computer cannot feed it faster
_LONGEST_HEARTBEAT_MS: Final = 0xFFFF  # 16 bits of object 1016
_COARSE_RPM: Final = 0.1  # wear tests run at some tens of rpm; such a step is 0.3 % of 30 rpm
_ROUNDING: Final = 0.01  # relative error of a speed; less is negligible in any drive's speed loop
_RAMPS: Final = (0x6083, 0x6084)
_CONTROL_ONLY: Final = (mapping_entry(0x6040, 0, 16),)

ObjectKey = tuple[int, int]
"""Index and subindex of an object."""
SUPERVISION: Final[tuple[ObjectKey, ...]] = ((0x1016, 1), (0x6007, 0), (0x1017, 0))
"""Objects by which the drive stops when this computer is silent, and sends its own heartbeat."""
REQUIRED: Final[Mapping[ObjectKey, str]] = {
    (0x6040, 0): say("commands"),
    (0x6041, 0): say("its state"),
    (0x6060, 0): say("its mode"),
    (0x606C, 0): say("its speed"),
    (0x6064, 0): say("its position"),
    (0x60FF, 0): say("the speed to turn at"),
    (0x1016, 1): say("the monitor of this computer"),
    (0x1017, 0): say("its heartbeat"),
}
PROFILE_QUANTITIES: Final[Mapping[str, tuple[int, float, int]]] = {
    "current_A": (0x6078, 1e-6, 0x6075),
    "torque_Nm": (0x6077, 1e-6, 0x6076),
    "supply_V": (0x6079, 1e-3, 0),
}
"""Quantity -> object, unit, and object of the rated value (mA, mNm) for per mille (0: none)."""
_EPOS_QUANTITIES: Final[Mapping[str, tuple[ObjectKey, str]]] = {
    "current_A": ((0x30D1, 1), "current_unit_A"),
    "supply_V": ((0x2200, 1), "supply_unit_V"),
    "temperature_C": ((0x3201, 1), "temperature_unit_C"),
}

Readback = dict[str, str | float | int]


@dataclass(frozen=True, slots=True)
class Setup:
    """Set-up of the drive for this run.

    velocity_unit: rev/s of the crank per step of 606C and 60FF. acceleration_unit: rev/s2 of the
    crank per step.
    synchronous: speed and position come as TPDOs after a SYNC. control_pdo: RPDO1 carries 6040.
    ramps: existing objects for an acceleration. quantities: condition values of the drive, each
    with its object and unit. kept: objects that were set, with their values, which must persist.
    """

    request: DriveRequest
    watchdog_s: float
    velocity_unit: float
    acceleration_unit: float
    synchronous: bool
    control_pdo: bool
    ramps: Sequence[int]
    quantities: Mapping[str, tuple[ObjectKey, float]]
    boot_ups: int
    readback: Mapping[str, str | float | int]
    kept: Mapping[ObjectKey, int]


def check_watchdog(request: DriveRequest) -> None:
    """Raise InvalidRequest for a time-out outside the range of the heartbeat."""
    if not _SHORTEST_WATCHDOG_S <= request.watchdog_timeout_s <= _LONGEST_HEARTBEAT_MS * 1e-3:
        raise InvalidRequest(
            "a watchdog time-out of {:g} s is outside 0.05 to 65 s.", request.watchdog_timeout_s
        )


class Commissioning:
    """Perform one set-up; each step raises SettingRefused if the drive does not accept it."""

    def __init__(
        self, node: CanNode, monitor: NodeMonitor, settings: Mapping[str, Any], epos: bool
    ) -> None:
        self._node = node
        self._monitor = monitor
        self._settings = settings
        self._epos = epos
        self._readback: Readback = {}
        self._advice: list[str] = []
        self._kept: dict[ObjectKey, int] = {}

    def run(self, request: DriveRequest) -> Setup:
        """Set the drive up; raise SettingRefused, ReplyTimeout, DeviceLost."""
        node = self._node
        refuse_request(node, request, self._settings, check_watchdog)
        self._require()
        node.stop_beating()
        node.write(0x6040, Control.DISABLE_VOLTAGE)
        node.write(0x60FF, 0)
        node.command(Nmt.PRE_OPERATIONAL)
        watchdog_s = self._supervise(request.watchdog_timeout_s)
        self._choose_mode()
        unit = self._choose_unit(request)
        self._compare_encoder(request)
        synchronous, control_pdo = self._map_pdos()
        ramps = self._find_ramps()
        quantities = self._find_quantities()
        self._note_options()
        boot_ups = self._start()
        acceleration = float(self._settings["acceleration_unit_rpm_per_s"]) / 60.0
        self._readback |= {
            "acceleration_unit_rpm_per_s": acceleration * 60.0,
            "synchronous_pdo": int(synchronous),
            "control_pdo": int(control_pdo),
            "gear_ratio": request.gear_ratio,
            "direction": request.direction,
            "counts_per_revolution": request.counts_per_revolution,
        }
        if self._advice:
            self._readback["advice"] = joined("; ", self._advice)
        return Setup(
            request=request,
            watchdog_s=watchdog_s,
            velocity_unit=unit,
            acceleration_unit=acceleration / request.gear_ratio,
            synchronous=synchronous,
            control_pdo=control_pdo,
            ramps=ramps,
            quantities=quantities,
            boot_ups=boot_ups,
            readback=self._readback,
            kept=self._kept,
        )

    # --- supervision -----------------------------------------------------------------------------

    def _supervise(self, timeout_s: float) -> float:
        """Make the drive supervise this computer's heartbeat and send its own."""
        milliseconds = math.floor(timeout_s * 1e3 + 1e-6)
        host_id = int(self._settings["host_node_id"])
        self._set(0x1016, 0, 1)
        self._set(0x1016, consumer_heartbeat(host_id, milliseconds), 1)
        self._set(0x1017, int(self._settings["heartbeat_ms"]))
        self._readback |= {
            "watchdog_timeout_s": milliseconds * 1e-3,
            "host_node_id": host_id,
            "heartbeat_ms": int(self._settings["heartbeat_ms"]),
        }
        if self._set_if_there(0x6007, ABORT_QUICK_STOP):
            self._readback["abort_connection_option"] = ABORT_QUICK_STOP
        else:
            self._advice.append(
                say(
                    "its reaction to a silent computer cannot be set: pull the cable at a"
                    " low speed before the first test and check that it stops ‹no object 6007›"
                )
            )
        return milliseconds * 1e-3

    def _start(self) -> int:
        """Set the node operational, start the host's heartbeat; return the count of boot-ups."""
        node, monitor = self._node, self._monitor
        node.start_beating(int(self._settings["host_node_id"]))
        boot_ups = monitor.boot_ups
        sent_ns = time.monotonic_ns()
        node.command(Nmt.START)
        deadline = time.monotonic() + _START_S
        while not monitor.wait_for_state(NodeState.OPERATIONAL, sent_ns, 0.05):
            node.beat()
            if time.monotonic() > deadline:
                raise ReplyTimeout.at(
                    node,
                    (
                        "node {} reports no heartbeat of an operating device within {:g} s; its"
                        " heartbeat cannot be supervised."
                    ),
                    node.node_id,
                    _START_S,
                )
        return boot_ups

    # --- mode, units, limits ---------------------------------------------------------------------

    def _choose_mode(self) -> None:
        supported = self._node.read_if_there(0x6502)
        if supported is not None and not supported & PROFILE_VELOCITY_BIT:
            raise SettingRefused.at(
                self._node, "the drive has no profile velocity mode ‹object 6502›."
            )
        self._node.write(0x6060, PROFILE_VELOCITY)
        shown = 0x6060 if self._node.read_if_there(0x6061) is None else 0x6061
        deadline = time.monotonic() + _MODE_S
        while (mode := self._node.read(shown)) != PROFILE_VELOCITY:
            if time.monotonic() > deadline:
                raise SettingRefused.at(
                    self._node, "the drive stays in mode {} instead of profile velocity.", mode
                )
        self._readback["mode"] = self._kept[shown, 0] = PROFILE_VELOCITY

    def _choose_unit(self, request: DriveRequest) -> float:
        unit = self._velocity_unit() / request.gear_ratio
        highest = math.ceil(request.maximum_speed_rev_per_s / unit - 1e-9)
        motor = self._node.read_if_there(0x6080)
        self._readback |= {
            "velocity_step_rev_per_s": unit,
            "maximum_speed_rev_per_s": highest * unit,
            "maximum_motor_speed": -1 if motor is None else motor,
        }
        if not self._set_if_there(0x607F, highest):
            self._advice.append(
                say("it has no limit of speed to set; rigapp alone keeps it ‹no object 607F›")
            )
        step_rpm = unit * 60.0
        if step_rpm > _COARSE_RPM:
            self._advice.append(
                say(
                    (
                        "its speed commands are in steps of {:g} rpm of the crank, so a speed"
                        " below {:g} rpm may be off by more than {:.0%}; choose a finer"
                        " velocity_unit for such speeds."
                    ),
                    step_rpm,
                    step_rpm / 2.0 / _ROUNDING,
                    _ROUNDING,
                )
            )
        return unit

    def _velocity_unit(self) -> float:
        """Return rev/s of the motor per step, from object 60A9 or else from the setting."""
        wanted = _UNITS.get(str(self._settings["velocity_unit"]))
        given = float(self._settings["velocity_step_rpm"]) / 60.0
        raw = self._node.read_if_there(0x60A9)
        if raw is not None and wanted is not None:
            self._set(0x60A9, raw := wanted)
        unit = None if raw is None else velocity_unit_rev_per_s(raw)
        if unit is None and not given:
            raise SettingRefused.at(
                self._node,
                "it does not report the unit of its speed commands; give velocity_step_rpm from"
                " its manual ‹object 60A9 is {}, rpm is 00B44700›.",
                say("not there") if raw is None else f"{raw:08X}",
            )
        if unit is not None and given and not math.isclose(unit, given, rel_tol=1e-6):
            raise SettingRefused.at(
                self._node,
                "its speed commands are in steps of {:g} rpm ‹object 60A9›, the rig file says"
                " velocity_step_rpm = {:g}: one of them is wrong, and so would be the speed.",
                unit * 60.0,
                given * 60.0,
            )
        if raw is not None:
            self._kept[0x60A9, 0] = raw
        self._readback["velocity_unit"] = say("not there") if raw is None else f"{raw:08X}"
        return given if unit is None else unit

    def _find_ramps(self) -> tuple[int, ...]:
        ramps = tuple(index for index in _RAMPS if self._node.read_if_there(index) is not None)
        if len(ramps) < len(_RAMPS):
            lacking = joined(", ", (f"{index:04X}" for index in _RAMPS if index not in ramps))
            self._advice.append(
                say(
                    "it ramps up or down by its own setting, not by the test file's;"
                    " change the ramp in the drive ‹no object {}›",
                    lacking,
                )
            )
        return ramps

    def _find_quantities(self) -> dict[str, tuple[ObjectKey, float]]:
        """Return the objects of the condition values: of the EPOS4, or existing ones of CiA 402."""
        if self._epos:
            return {
                quantity: (entry, float(self._settings[unit]))
                for quantity, (entry, unit) in _EPOS_QUANTITIES.items()
            }
        quantities = {}
        for quantity, (index, unit, rated) in PROFILE_QUANTITIES.items():
            rated_value = self._node.read_if_there(rated) if rated else 1
            if rated_value and self._node.read_if_there(index) is not None:
                quantities[quantity] = ((index, 0), unit * rated_value)
        self._readback["quantities"] = joined(", ", quantities)
        return quantities

    def _require(self) -> None:
        """Refuse a drive without the indispensable objects, before anything is set."""
        for (index, subindex), what in REQUIRED.items():
            if not self._is_there(index, subindex):
                raise SettingRefused.at(
                    self._node,
                    "the drive cannot be used: it lacks {} ‹object {}:{}›.",
                    what,
                    f"{index:04X}",
                    subindex,
                )

    def _compare_encoder(self, request: DriveRequest) -> None:
        if not self._epos:
            return
        counts = 4 * self._node.read(0x3010, 1)
        if counts != request.counts_per_revolution:
            raise SettingRefused.at(
                self._node,
                "the drive has {} counts per revolution ‹four times object 3010:1›, the"
                " rig file {}: one of them is wrong, and so would be the speed.",
                counts,
                request.counts_per_revolution,
            )

    def _note_options(self) -> None:
        for name, index in (
            ("quick_stop_option", 0x605A),
            ("fault_reaction_option", 0x605E),
            ("quick_stop_deceleration", 0x6085),
            ("motion_profile", 0x6086),
        ):
            value = self._node.read_if_there(index)
            if value is not None:
                self._readback[name] = value
        behaviour = self._node.read_if_there(0x1029, 1)
        if behaviour is not None:
            self._readback["communication_error_behaviour"] = behaviour

    # --- PDOs ------------------------------------------------------------------------------------

    def _map_pdos(self) -> tuple[bool, bool]:
        """Map speed and position to SYNC and the control word to RPDO1; return which succeeded."""
        try:
            control = self._map_control()
        except SettingRefused:
            control = False
        try:
            sync_id = self._node.read_if_there(0x1005)
            position = self._map_on_sync(2, STATUS_AND_POSITION)
            velocity = self._map_on_sync(3, STATUS_AND_VELOCITY)
            events = self._node.read(0x1800, 1)
        except SettingRefused:
            return False, control
        if sync_id is not None and sync_id & COB_MASK != SYNC_ID:
            return False, control
        if not events & PDO_INVALID:
            self._node.listen(events & COB_MASK, self._monitor.take_status)
        self._node.listen(position, partial(self._monitor.take_value, "position"))
        self._node.listen(velocity, partial(self._monitor.take_value, "velocity"))
        return True, control

    def _map_control(self) -> bool:
        node = self._node
        for number in (1, 2, 3):
            cob_id = node.read_if_there(0x1400 + number, 1)
            if cob_id is not None and not cob_id & PDO_INVALID:
                self._set(0x1400 + number, cob_id | PDO_INVALID, 1)
        wanted = RPDO1_BASE + node.node_id
        return node.read(0x1400, 1) == wanted and self._mapping(0x1600) == _CONTROL_ONLY

    def _map_on_sync(self, number: int, entries: tuple[int, ...]) -> int:
        """Map the TPDO of a number (from 0) and return its identifier."""
        node, parameters, mapping = self._node, 0x1800 + number, 0x1A00 + number
        kept = node.read(parameters, 1) & ~PDO_INVALID & ~COB_MASK
        cob_id = kept | TPDO_BASES[number] + node.node_id
        node.write(parameters, cob_id | PDO_INVALID, 1)
        node.write(parameters, SYNCHRONOUS, 2)
        if self._mapping(mapping) != entries:
            node.write(mapping, 0)
            for subindex, entry in enumerate(entries, start=1):
                node.write(mapping, entry, subindex)
            node.write(mapping, len(entries))
        self._set(parameters, cob_id, 1)
        return cob_id & COB_MASK

    def _mapping(self, index: int) -> tuple[int, ...]:
        count = self._node.read(index)
        return tuple(self._node.read(index, sub) for sub in range(1, min(count, 8) + 1))

    # --- helpers ---------------------------------------------------------------------------------

    def _is_there(self, index: int, subindex: int) -> bool:
        try:
            return self._node.read_if_there(index, subindex) is not None
        except SettingRefused:  # it may be write-only
            return True

    def _set_if_there(self, index: int, value: int) -> bool:
        """Write a number and read it back; False if the drive has no such object."""
        if self._node.read_if_there(index) is None:
            return False
        self._set(index, value)
        return True

    def _set(self, index: int, value: int, subindex: int = 0) -> None:
        """Write a number and read it back."""
        self._node.write(index, value, subindex)
        readback = self._node.read(index, subindex)
        if readback != value:
            raise SettingRefused.at(
                self._node,
                "the drive did not keep a setting; check its firmware and that it is"
                " not locked ‹object {}:{} reads {} after {} was set›.",
                f"{index:04X}",
                subindex,
                readback,
                value,
            )
        self._kept[index, subindex] = value
