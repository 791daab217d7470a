"""The RoboClaw at the byte level: packets in, replies and the motor's command out.

Loaded by the simulated rig and by tests; no driver at run time imports it.

Time of the wire and time of the plant differ: the packet time-out, the serial watchdog and the
faults run on ``now_s``, the ramps on ``elapsed_s``.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable
from dataclasses import replace
from typing import Final

from rigapp_drivers.roboclaw.protocol import (
    ACKNOWLEDGE,
    MAXIMUM_DUTY_ACCELERATION,
    TIMEOUT_UNIT_S,
    Command,
    Generation,
    crc16,
    write_format,
)
from rigapp_drivers.roboclaw.simulator.registers import Registers, RoboClawFault, Saved
from rigapp_drivers.roboclaw.status import generation_of
from rigapp_drivers.simulated import FaultPlan, Faults
from rigapp_drivers.simulator_api import DriveCommand, MotorState

_BOOT_S: Final = 0.2
_SLOW_S: Final = 0.15
_SLOW_COMMAND_S: Final = 2.0  # longer than any driver's time-outs for one packet
_WRONG_ACKNOWLEDGE: Final = 0x7F
_BY_ITSELF_COUNT_PER_S: Final = 1800  # 30 rpm of an encoder of 3600 counts


class RoboClawSimulator:
    """Respond as a RoboClaw does; implements ``rigapp_drivers.simulator_api.SimulatedDrive``.

    address, motor: packet address and the motor of the plant (1 or 2); the other motor has no load.
    any_address: reply to every address, as over USB. firmware: its text; it determines the packet
    layouts unless status_width, pin_modes, voltage_offset or combined_status are given.
    inter_byte_timeout_s: a longer gap inside a packet discards it; 0.01 on the real drive, longer
    by default because a busy host pauses inside a packet. qpps: speed limit of both motors in
    counts/s. duty_acceleration: of both, in duty per second. s3_mode: function of input S3, as set
    with the manufacturer's tool, None for the latching emergency stop. unknown_commands: numbers
    that this firmware lacks and does not answer (200 to 202 are not in every manual). faults:
    ``Fault`` records or tables of their fields.
    """

    kinds = RoboClawFault

    def __init__(
        self,
        *,
        address: int = 0x80,
        motor: int = 1,
        any_address: bool = False,
        firmware: str = "USB Roboclaw 2x30a v4.2.4",
        status_width: str | int = "auto",
        pin_modes: int | None = None,
        voltage_offset: bool | None = None,
        combined_status: bool | None = None,
        inter_byte_timeout_s: float = 0.5,
        qpps: int = 44000,
        duty_acceleration: int = MAXIMUM_DUTY_ACCELERATION,
        s3_mode: int | None = None,
        unknown_commands: Iterable[int] = (),
        faults: Faults = (),
    ) -> None:
        generation = _generation(firmware, status_width, pin_modes, voltage_offset)
        saved = Saved()
        if generation.pin_modes == 3:
            saved.pin_modes = (1, 0, 0)
        for settings in saved.axes:
            settings.pid = (*settings.pid[:3], qpps)
            settings.duty_acceleration = duty_acceleration
        if s3_mode is not None:
            saved.pin_modes = (s3_mode, *saved.pin_modes[1:])
        if combined_status is None:
            combined_status = generation.status_bits == 32
        self.generation = generation
        self.watchdog_tripped = False
        self._plan = FaultPlan(RoboClawFault, faults)
        self.inject, self.clear = self._plan.add, self._plan.clear
        unknown = frozenset(unknown_commands)
        if not combined_status:
            unknown |= {Command.COMBINED_STATUS}
        self._registers = Registers(generation, motor, saved, unknown, self._plan)
        self._address = address
        self._any_address = any_address
        self._firmware = firmware
        self._inter_byte_timeout_s = inter_byte_timeout_s
        self._last_byte_s = 0.0
        self._silent_until_s = 0.0
        self._buffer = b""

    # --- SimulatedDrive --------------------------------------------------------------------------

    def receive(self, data: bytes, now_s: float) -> bytes:
        """Process bytes from the host and return the replies."""
        time_s = self._update_conditions(now_s)
        if time_s < self._silent_until_s:
            return b""
        if data:
            if time_s - self._last_byte_s > self._inter_byte_timeout_s:
                self._buffer = b""
            self._last_byte_s = time_s
            self._buffer += data
        replies = self._plan.due()
        while packet := self._next_packet():
            replies += self._answer(packet)
        return replies

    def command(self, elapsed_s: float, now_s: float) -> DriveCommand:
        """Advance the ramps, check watchdog and faults, return the motor command."""
        self._update_conditions(now_s)
        for axis in self._registers.axes:
            axis.advance(elapsed_s)
        return self._registers.axes[self._registers.motor - 1].command()

    def observe(self, state: MotorState) -> None:
        """Set the motor's state for later replies."""
        self._registers.observe(state)

    def emit(self, now_s: float) -> bytes:
        """Return the delayed replies that are due; a RoboClaw sends nothing unsolicited."""
        self._update_conditions(now_s)
        return self._plan.due()

    # --- for tests and demonstrations ------------------------------------------------------------

    @property
    def serial_timeout_s(self) -> float:
        """Return the watchdog's time-out; 0 is off."""
        return self._registers.memory.timeout * TIMEOUT_UNIT_S

    # --- time ------------------------------------------------------------------------------------

    def _update_conditions(self, now_s: float) -> float:
        """Process resets, watchdog and fault conditions; return the time since the start."""
        time_s = self._plan.tick(now_s)
        silence_s = self._plan.take(RoboClawFault.RESET, _BOOT_S)
        if silence_s is not None:
            self._registers.power_on()
            self._buffer = b""
            self._plan.forget_late()
            self._last_byte_s = time_s
            self._silent_until_s = time_s + silence_s
            self.watchdog_tripped = False
        if self._plan.take(RoboClawFault.RESTART_UNSEEN) is not None:
            self._registers.power_on(clock_runs_on=True)
        if self._plan.take(RoboClawFault.WATCHDOG_LOST) is not None:
            self._registers.memory.timeout = 0
        speed = self._plan.take(RoboClawFault.TURNS_BY_ITSELF, _BY_ITSELF_COUNT_PER_S)
        if speed is not None:
            self._registers.axes[self._registers.motor - 1].run(round(speed))
        timeout_s = self.serial_timeout_s
        if timeout_s and time_s - self._last_byte_s > timeout_s and self._registers.halt():
            self.watchdog_tripped = True
        self._registers.switch_off_on_faults()
        return time_s

    # --- packets ---------------------------------------------------------------------------------

    def _next_packet(self) -> bytes | None:
        """Remove one complete packet from the buffer; discard invalid bytes."""
        if len(self._buffer) < 2:
            return None
        address, command = self._buffer[:2]
        mine = 0x80 <= address <= 0x87 if self._any_address else address == self._address
        layout = write_format(command, self._registers.generation)
        if not mine or not (command == Command.VERSION or self._registers.knows(command)):
            self._buffer = b""
            return None
        length = 2 if layout is None else 4 + struct.calcsize(layout)
        if len(self._buffer) < length:
            return None
        packet, self._buffer = self._buffer[:length], self._buffer[length:]
        return packet

    def _answer(self, packet: bytes) -> bytes:
        command = packet[1]
        if self._plan.link_fault(RoboClawFault.LOST_COMMAND, command) is not None:
            return b""
        layout = write_format(command, self._registers.generation)
        if layout is None:
            reply = self._reply(packet)
        elif crc16(packet[:-2]) != int.from_bytes(packet[-2:], "big"):
            return b""
        else:
            if self._plan.link_fault(RoboClawFault.IGNORED_COMMAND, command) is None:
                self._registers.write(command, struct.unpack(layout, packet[2:-2]))
            self._registers.switch_off_on_faults()
            wrong = self._plan.link_fault(
                RoboClawFault.WRONG_ACKNOWLEDGE, command, _WRONG_ACKNOWLEDGE
            )
            reply = ACKNOWLEDGE if wrong is None else bytes((int(wrong),))
            slow = RoboClawFault.SLOW_COMMAND
            reply = self._plan.in_time(reply, slow, command, _SLOW_COMMAND_S)
        return self._send(reply, command)

    def _reply(self, packet: bytes) -> bytes:
        command = packet[1]
        if command == Command.VERSION:
            data = self._firmware.encode("ascii") + b"\n\0"
        else:
            data = self._registers.read(command)
        crc = crc16(packet + data)
        if self._plan.link_fault(RoboClawFault.WRONG_CRC, command) is not None:
            crc ^= 0x0001
        return data + crc.to_bytes(2, "big")

    def _send(self, reply: bytes, command: int) -> bytes:
        if self._plan.link_fault(RoboClawFault.NO_REPLY, command) is not None:
            return b""
        if self._plan.link_fault(RoboClawFault.DUPLICATED_REPLY, command) is not None:
            reply += reply
        return self._plan.in_time(reply, RoboClawFault.SLOW_REPLY, command, _SLOW_S)


def _generation(
    firmware: str, status_width: str | int, pin_modes: int | None, voltage_offset: bool | None
) -> Generation:
    generation = generation_of(firmware)
    if status_width != "auto":
        generation = replace(generation, status_bits=int(status_width))
    if pin_modes is not None:
        generation = replace(generation, pin_modes=pin_modes)
    if voltage_offset is not None:
        generation = replace(generation, voltage_offset=voltage_offset)
    return generation


__all__ = ["RoboClawFault", "RoboClawSimulator"]
