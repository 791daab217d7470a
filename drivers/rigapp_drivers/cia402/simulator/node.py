"""A simulated CANopen node with a drive: NMT, heartbeats both ways, emergencies, SDO, PDO.

Frames in, frames out, in the time of the wire, which the fault plan holds.
"""

from __future__ import annotations

import enum
import struct
from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import Final

from rigapp_drivers.cia402.protocol import (
    EMERGENCY_BASE,
    HEARTBEAT_BASE,
    NMT_ID,
    SDO_REPLY_BASE,
    SDO_REQUEST_BASE,
    SYNC_ID,
    Nmt,
    NodeState,
    State,
)
from rigapp_drivers.cia402.simulator.axis import Axis402
from rigapp_drivers.cia402.simulator.objects import (
    PDO_ENTRIES,
    Abort,
    AbortTransfer,
    Dictionary,
    Pdos,
    add_communication,
    add_epos,
    add_identity,
    add_profile,
)
from rigapp_drivers.cia402.slcan import Frame
from rigapp_drivers.simulated import FaultPlan
from rigapp_drivers.simulator_api import DriveCommand, MotorState

DOWNLOAD, _UPLOAD, _UPLOAD_SEGMENT, _ABORT = 1, 2, 3, 4


class SdoServer:
    """Reply to the requests of one client, 8 bytes each."""

    def __init__(self, objects: Dictionary) -> None:
        self._objects = objects
        self._rest = b""
        self._toggle = 0
        self._object = (0, 0)

    def answer(
        self, request: bytes, forced_abort: int | None = None, *, obey: bool = True
    ) -> bytes | None:
        """Return the reply, None if the protocol has none.

        forced_abort: code of a simulated fault. obey: whether a confirmed download is executed.
        """
        if len(request) != 8:
            return None
        command = request[0] >> 5
        if command == _ABORT:
            self._rest = b""
            return None
        if command != _UPLOAD_SEGMENT:
            index, subindex = struct.unpack_from("<HB", request, 1)
            self._object = (index, subindex)
        try:
            if forced_abort is not None:
                raise AbortTransfer(forced_abort)
            return self._obey(command, request) if obey else self._confirmed()
        except AbortTransfer as abort:
            self._rest = b""
            return struct.pack("<BHBI", 0x80, *self._object, abort.code)

    def _confirmed(self) -> bytes:
        return struct.pack("<BHBI", 0x60, *self._object, 0)

    def _obey(self, command: int, request: bytes) -> bytes:
        if command == DOWNLOAD:
            return self._download(request)
        if command == _UPLOAD:
            return self._upload()
        if command == _UPLOAD_SEGMENT:
            return self._upload_segment(request[0] >> 4 & 1)
        raise AbortTransfer(Abort.COMMAND)

    def _download(self, request: bytes) -> bytes:
        expedited, sized = request[0] & 2, request[0] & 1
        if not expedited:
            raise AbortTransfer(Abort.COMMAND)
        index, subindex = self._object
        entry = self._objects.find(index, subindex)
        length = 4 - (request[0] >> 2 & 3) if sized else entry.length
        self._objects.write(index, subindex, request[4 : 4 + length])
        return self._confirmed()

    def _upload(self) -> bytes:
        index, subindex = self._object
        data = self._objects.read(index, subindex)
        if len(data) <= 4:
            head = 0x43 | (4 - len(data)) << 2
            return struct.pack("<BHB", head, index, subindex) + data.ljust(4, b"\0")
        self._rest, self._toggle = data, 0
        return struct.pack("<BHBI", 0x41, index, subindex, len(data))

    def _upload_segment(self, toggle: int) -> bytes:
        if not self._rest:
            raise AbortTransfer(Abort.COMMAND)
        if toggle != self._toggle:
            raise AbortTransfer(Abort.TOGGLE)
        part, self._rest = self._rest[:7], self._rest[7:]
        self._toggle ^= 1
        head = toggle << 4 | (7 - len(part)) << 1 | (0 if self._rest else 1)
        return bytes((head,)) + part.ljust(7, b"\0")


BOOT_S: Final = 0.1
_SLOW_COMMAND_S: Final = 2.0  # longer than any driver's time-outs for one transfer
_BY_ITSELF_RPM: Final = 30.0
HEARTBEAT_LOST: Final = 0x8130
BUS_OFF: Final = 0x81FD
PDO_LENGTH: Final = 0x8210
_REGISTERS: Final = {0x2: 0x02, 0x3: 0x04, 0x4: 0x08, 0x5: 0x04, 0x6: 0x20, 0x7: 0x20, 0x8: 0x10}


class Cia402Fault(enum.StrEnum):
    """Kinds of fault; the comment gives the meaning of ``value``."""

    SILENT_NODE = "silent_node"  # the node neither receives nor sends
    LOST_HEARTBEAT = "lost_heartbeat"  # only the heartbeat is missing
    EMERGENCY = "emergency"  # error code: message, error register, fault state
    BUS_OFF = "bus_off"  # off the bus until end_s, then emergency 81FD
    SDO_ABORT = "sdo_abort"  # abort code
    NO_SDO_REPLY = "no_sdo_reply"
    IGNORED_COMMAND = "ignored_command"  # the write is confirmed but not executed
    FALSE_READBACK = "false_readback"  # the drive always reports a motor without power
    FALSE_STANDSTILL = "false_standstill"  # the drive reports standstill: its encoder is dead
    TURNS_BY_ITSELF = "turns_by_itself"  # speed without a command, rpm
    SLOW_COMMAND = "slow_command"  # s until a download is confirmed; it is executed at once
    LATE_TPDO = "late_tpdo"  # delay in s
    NO_TPDO = "no_tpdo"
    BOOT_UP = "boot_up"  # s until the node sends its boot-up message
    RESTART_UNSEEN = "restart_unseen"  # no boot-up message; 1017 is kept, 1016 is not
    WATCHDOG_LOST = "watchdog_lost"  # 1016:1 is 0
    TORQUE_OFF = "torque_off"  # the safe-torque-off inputs are open
    GARBLED_LINE = "garbled_line"  # the adapter sends an invalid line


@dataclass(frozen=True, slots=True)
class NodeOptions:
    """Options of the simulated drive.

    velocity_unit: 60A9 at power-on. tpdo1_period_s: period of TPDO1 in addition to sending on
    change. vendor: if not maxon's, the node has no objects 2xxx and 3xxx. lacking: further missing
    objects.
    """

    node_id: int
    encoder_pulses: int
    vendor: int
    name: str
    velocity_unit: int
    tpdo1_period_s: float | None
    lacking: Collection[int]


class Cia402Node:
    """One node; ``take`` frames, ``tick`` the time, ``collect`` the frames due on the bus."""

    def __init__(self, options: NodeOptions, plan: FaultPlan) -> None:
        self._options = options
        self._plan = plan
        self._motor = MotorState(0, 0.0, 0.0)
        self._observed = False
        self._queue: list[tuple[float, Frame]] = []
        self._silent_until_s = 0.0
        self._was_off_bus = False
        self._build()

    # --- power and NMT ---------------------------------------------------------------------------

    def _build(self) -> None:
        options = self._options
        objects = Dictionary(options.lacking)
        add_communication(objects, options.name)
        add_identity(objects, (options.vendor, 0x6550_0000, 0x0170_0000, 0x1234_5678))
        add_profile(objects)
        if options.vendor == 0xFB:
            add_epos(objects, options.node_id, options.encoder_pulses)
        objects.set(0x60A9, options.velocity_unit)
        self.objects = objects
        self.pdos = Pdos(objects, options.node_id, options.tpdo1_period_s)
        self.sdo = SdoServer(objects)
        self.axis = Axis402(objects, 4 * options.encoder_pulses, self._acknowledge)
        self._hook()
        self.state = NodeState.PRE_OPERATIONAL
        self._last_heartbeat_s: float | None = None
        self._heartbeats_s: dict[int, float] = {}
        self.watchdog_tripped = False
        if self._observed:
            self.axis.observe(self._motor)

    def _hook(self) -> None:
        entries = self.objects.entries
        entries[0x1003, 0].written = self._clear_history
        entries[0x6041, 0].read = lambda: self.axis.status_word(
            no_power=self._plan.on(Cia402Fault.FALSE_READBACK)
        )
        entries[0x1016, 1].written = entries[0x1016, 2].written = self._consumer_written
        entries[0x6077, 0].read = entries[0x6078, 0].read = lambda: round(
            1e6 * self._motor.current_A / self.objects.number(0x6075)
        )
        entries[0x6079, 0].read = lambda: round(self._motor.supply_V * 1e3)
        if (0x2200, 1) in entries:
            entries[0x2200, 1].read = lambda: round(self._motor.supply_V * 10)
            entries[0x30D1, 1].read = entries[0x30D1, 2].read = lambda: round(
                self._motor.current_A * 1e3
            )
            entries[0x3201, 1].read = lambda: round(self._motor.temperature_C * 10)
            entries[0x3202, 1].read = lambda: 0 if self.axis.torque_off else 3

    def power_on(self, time_s: float, silence_s: float) -> None:
        """Restart: default parameters, no power on the motor, a boot-up message."""
        self._build()
        self._queue.clear()
        self._silent_until_s = time_s + silence_s
        identifier = HEARTBEAT_BASE + self._options.node_id
        self._queue.append((time_s + silence_s, Frame(identifier, bytes((NodeState.BOOT_UP,)))))

    def _restart_unseen(self) -> None:
        """Restart as ``power_on``, but keep the heartbeat and send no message."""
        period = self.objects.number(0x1017)
        self._build()
        self._queue.clear()
        self.objects.set(0x1017, period)

    def _network_command(self, data: bytes, time_s: float) -> None:
        if len(data) < 2 or data[1] not in (0, self._options.node_id):
            return
        command = data[0]
        if command == Nmt.START:
            if self.state is not NodeState.OPERATIONAL:
                self.pdos.forget()
            self.state = NodeState.OPERATIONAL
        elif command == Nmt.STOP:
            self.state = NodeState.STOPPED
        elif command == Nmt.PRE_OPERATIONAL:
            self.state = NodeState.PRE_OPERATIONAL
        elif command in (Nmt.RESET_NODE, Nmt.RESET_COMMUNICATION):
            self.power_on(time_s, BOOT_S)

    # --- frames ----------------------------------------------------------------------------------

    def take(self, frame: Frame, time_s: float) -> None:
        """Execute a frame from the bus."""
        if self._ignores_commands() or frame.extended or frame.remote:
            return
        node_id = self._options.node_id
        if frame.identifier == NMT_ID:
            self._network_command(frame.data, time_s)
        elif frame.identifier == SDO_REQUEST_BASE + node_id:
            if self.state is not NodeState.STOPPED:
                self._answer_sdo(frame.data, time_s)
        elif frame.identifier == SYNC_ID:
            if self.state is NodeState.OPERATIONAL:
                self._send_pdos(self.pdos.on_sync(time_s), time_s)
        elif HEARTBEAT_BASE < frame.identifier <= HEARTBEAT_BASE + 0x7F:
            self._heartbeats_s[frame.identifier - HEARTBEAT_BASE] = time_s
        elif self.state is NodeState.OPERATIONAL:
            self._take_pdo(frame, time_s)
        self._send_changes(time_s)

    def _answer_sdo(self, request: bytes, time_s: float) -> None:
        index = int.from_bytes(request[1:3], "little")
        abort = self._plan.link_fault(Cia402Fault.SDO_ABORT, index, default=Abort.STATE)
        ignored = request[:1] and request[0] >> 5 == DOWNLOAD and self._ignores(index)
        reply = self.sdo.answer(request, None if abort is None else int(abort), obey=not ignored)
        if reply is None or self._plan.link_fault(Cia402Fault.NO_SDO_REPLY, index) is not None:
            return
        if request[0] >> 5 == DOWNLOAD:
            slow = Cia402Fault.SLOW_COMMAND
            time_s += self._plan.link_fault(slow, index, _SLOW_COMMAND_S) or 0.0
        self._queue.append((time_s, Frame(SDO_REPLY_BASE + self._options.node_id, reply)))

    def _ignores(self, index: int) -> bool:
        return self._plan.link_fault(Cia402Fault.IGNORED_COMMAND, index) is not None

    def _take_pdo(self, frame: Frame, time_s: float) -> None:
        if self._ignores(0x6040):  # the object that the driver maps into its PDO
            return
        try:
            fits = self.pdos.receive(frame)
        except AbortTransfer:
            return
        if fits is False:
            self.emergency(PDO_LENGTH, time_s)

    def _send_pdos(self, frames: list[Frame], time_s: float) -> None:
        if self._plan.on(Cia402Fault.NO_TPDO):
            return
        delay_s = self._plan.active(Cia402Fault.LATE_TPDO, default=0.2) or 0.0
        self._queue.extend((time_s + delay_s, frame) for frame in frames)

    def _send_changes(self, time_s: float) -> None:
        if self.state is NodeState.OPERATIONAL:
            self._send_pdos(self.pdos.on_time(time_s), time_s)

    def collect(self, time_s: float) -> list[Frame]:
        """Return the frames that are due, in order."""
        due = [frame for due_s, frame in self._queue if due_s <= time_s]
        self._queue = [entry for entry in self._queue if entry[0] > time_s]
        return [] if self._ignores_commands() else due

    # --- time ------------------------------------------------------------------------------------

    def tick(self, time_s: float) -> None:
        """Process resets, faults, heartbeats and their supervision."""
        silence_s = self._plan.take(Cia402Fault.BOOT_UP, BOOT_S)
        if silence_s is not None:
            self.power_on(time_s, silence_s)
        if self._plan.take(Cia402Fault.RESTART_UNSEEN) is not None:
            self._restart_unseen()
        if self._plan.take(Cia402Fault.WATCHDOG_LOST) is not None:
            self.objects.set(0x1016, 0, 1)
        while (code := self._plan.take(Cia402Fault.EMERGENCY, 0x1000)) is not None:
            self.emergency(int(code), time_s)
        rpm = self._plan.take(Cia402Fault.TURNS_BY_ITSELF, _BY_ITSELF_RPM)
        if rpm is not None:
            self.axis.turn_by_itself(rpm)
        self.axis.set_torque_off(self._plan.on(Cia402Fault.TORQUE_OFF))
        self._update_bus(time_s)
        self._check_hosts(time_s)
        self._beat(time_s)
        self._send_changes(time_s)

    def _ignores_commands(self) -> bool:
        kinds = (Cia402Fault.SILENT_NODE, Cia402Fault.BUS_OFF)
        off = any(self._plan.on(kind) for kind in kinds)
        return off or self._plan.time_s < self._silent_until_s

    def _update_bus(self, time_s: float) -> None:
        off = self._plan.on(Cia402Fault.BUS_OFF)
        if self._was_off_bus and not off:
            self.emergency(BUS_OFF, time_s)
        self._was_off_bus = off

    def _check_hosts(self, time_s: float) -> None:
        for subindex in (1, 2):
            value = self.objects.number(0x1016, subindex)
            node_id, limit_s = value >> 16 & 0x7F, (value & 0xFFFF) * 1e-3
            last_s = self._heartbeats_s.get(node_id)
            if limit_s and last_s is not None and time_s - last_s > limit_s:
                del self._heartbeats_s[node_id]
                self._host_lost(time_s)

    def _host_lost(self, time_s: float) -> None:
        option = self.objects.number(0x6007)
        self.watchdog_tripped |= self.axis.powered
        self._announce(HEARTBEAT_LOST, time_s)
        if option == 1:
            self.axis.fail()
        elif option == 2:
            self.axis.power_off(State.SWITCH_ON_DISABLED)
        elif option == 3 and self.axis.state is State.ENABLED:
            self.axis.stop_by_option(self.objects.number(0x605A))
        behaviour = self.objects.number(0x1029, 1)
        if behaviour == 0 and self.state is NodeState.OPERATIONAL:
            self.state = NodeState.PRE_OPERATIONAL
        elif behaviour == 2:
            self.state = NodeState.STOPPED

    def _beat(self, time_s: float) -> None:
        period_s = self.objects.number(0x1017) * 1e-3
        if not period_s or self._last_heartbeat_s is None:
            self._last_heartbeat_s = time_s
        elif time_s - self._last_heartbeat_s >= period_s:
            self._last_heartbeat_s = time_s
            if self._plan.active(Cia402Fault.LOST_HEARTBEAT) is None:
                identifier = HEARTBEAT_BASE + self._options.node_id
                self._queue.append((time_s, Frame(identifier, bytes((self.state,)))))

    # --- errors ----------------------------------------------------------------------------------

    def emergency(self, code: int, time_s: float) -> None:
        """Report an error and enter the fault reaction."""
        self._announce(code, time_s)
        self.axis.fail()

    def _announce(self, code: int, time_s: float) -> None:
        objects = self.objects
        register = 0x80 if code >= 0xFF00 and code != 0xFF0B else _REGISTERS.get(code >> 12, 0x20)
        register = {0x1000: 0x01, 0xFF0B: 0x20, 0x8611: 0x20}.get(code, register)
        objects.set(0x1001, objects.number(0x1001) | register)
        objects.set(0x603F, code)
        count = min(objects.number(0x1003) + 1, PDO_ENTRIES)
        for subindex in range(count, 1, -1):
            objects.set(0x1003, objects.number(0x1003, subindex - 1), subindex)
        objects.set(0x1003, code, 1)
        objects.set(0x1003, count)
        self._send_emergency(code, time_s)

    def _send_emergency(self, code: int, time_s: float) -> None:
        data = struct.pack("<HB5x", code, self.objects.number(0x1001))
        if self.state is not NodeState.STOPPED:
            identifier = EMERGENCY_BASE + self._options.node_id
            self._queue.append((max(time_s, self._silent_until_s), Frame(identifier, data)))

    def _acknowledge(self) -> bool:
        """Accept a fault reset: the errors of this simulation end by themselves."""
        if self.objects.number(0x1001):
            self.objects.set(0x1001, 0)
            self.objects.set(0x603F, 0)
            self._send_emergency(0, 0.0)
        return True

    # --- parameters ------------------------------------------------------------------------------

    def _clear_history(self, value: int) -> None:
        if value != 0:
            raise AbortTransfer(Abort.VALUE)

    def _consumer_written(self, value: int) -> None:
        self._heartbeats_s.pop(value >> 16 & 0x7F, None)

    # --- plant -----------------------------------------------------------------------------------

    def advance(self, elapsed_s: float) -> DriveCommand:
        """Advance the ramps and return the motor command."""
        self.axis.advance(elapsed_s)
        return self.axis.command()

    def observe(self, state: MotorState) -> None:
        """Set the motor's state."""
        if self._plan.on(Cia402Fault.FALSE_STANDSTILL):
            count = self._motor.position_count
            state = replace(state, speed_count_per_s=0.0, position_count=count)
        self._motor = state
        self._observed = True
        self.axis.observe(state)
