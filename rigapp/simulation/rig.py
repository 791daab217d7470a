"""The simulated rig: plant, device simulators and wires in one loop, one thread.

A pass processes the hosts' requests, and advances the plant by the chunks that are due; between two
chunks requests are processed again, so that a reply does not wait for the remaining chunks. Within
a chunk the drive's command is constant except for its ramp, so a chunk is short: at most 20 ms of
wall time and 1/10 revolution. Faster than real time a second chunk waits for the host while it
reads the first, so that a command takes effect within 1/5 revolution of the host's newest data.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import ParameterFile
from rigapp.config.rig import RigFile
from rigapp.schema.faults import FaultRecord
from rigapp.simulation import layout
from rigapp.simulation.constants import Machine, plant_constants, plant_section, seed_of
from rigapp.simulation.devices import (
    MakeEndpoint,
    data_device,
    drive_device,
    inputs_of,
    signals,
    simulated_names,
    slow_devices,
)
from rigapp.simulation.disturbances import (
    Disturbances,
    Interference,
    SignalFault,
    WiredSignals,
    terminals,
)
from rigapp.simulation.faults import SIGNAL_KINDS, WIRE_KINDS, Timetable, check_fault
from rigapp.simulation.layout import Drive
from rigapp.simulation.plant import Plant
from rigapp.simulation.simulated_operator import SimulatedOperator
from rigapp.simulation.surroundings import DRIVE_WARMER_K, FreeInputs, slow_values
from rigapp.simulation.truth import TruthRecorder
from rigapp.simulation.wire.link import WireFault
from rigapp_drivers.edge import foreign
from rigapp_drivers.simulator_api import DriveCommand, DriveMode, MotorState

STANDING = 1e-6
"""A crank slower than this is stationary, rad/s."""
CHUNK_S = 0.02  # a command takes effect as soon as in a real drive's loop
SLOW_S = 1.0
"""Measuring period of slow devices, in plant time."""
LONGEST_CHUNK_S = 0.1  # of plant time, at any speed
CHUNK_REVOLUTIONS = 1.0 / 10.0  # see above: the host may lag by twice this
LONGEST_PASS_CHUNKS = 8  # then other work is due, such as the control channel
IDLE_S = 0.01  # shorter than any time-out on the wire
HOST_WAIT_S = 0.00015  # latency of a pty
TURN = 2.0 * math.pi
FULL_GAUGE_BYTES = 3072  # of the 4095 that a pty reports at most: more may be waiting

LONGEST_CATCH_UP_S = 1.0  # a real device would not deliver older data either
BURST_S = 0.1  # shorter than any time-out of a host


class PlantPace:
    """Compute the plant time that is due; ``speed`` times real time, inf for the host's pace.

    Never slower than real time, so that a host which does not read loses data as with a real
    device. Never faster than the chosen speed, nor than the host reads the data. Without a reading
    host the plant runs in real time, since the drive's watchdog runs on the wall clock: at any
    speed the spindle stops within the time-out of a dead engine, and coasts in real time.

    The devices' time, on which the drive's watchdog runs, is that of their process
    (``processclock``).
    """

    def __init__(self, speed: float, now_s: float) -> None:
        self.speed = speed
        self._last = now_s
        self._must = 0.0
        self._may = 0.0

    @property
    def fast(self) -> bool:
        """Return whether the speed is above real time."""
        return self.speed > 1.0

    def tick(self, now_s: float) -> None:
        """Advance the wall clock to now."""
        passed = max(0.0, now_s - self._last)
        self._last = now_s
        self._must = min(self._must + passed * min(1.0, self.speed), LONGEST_CATCH_UP_S)
        if math.isinf(self.speed):
            self._may = math.inf
        else:
            burst = max(BURST_S * self.speed, self._must)
            self._may = min(self._may + passed * self.speed, burst)

    def due(self, chunk_s: float, *, taken: bool) -> bool:
        """Return whether a chunk is due; taken: a host is streaming and has read all data."""
        if self._must >= chunk_s:
            return True
        return self.fast and taken and self._may >= chunk_s

    def advanced(self, chunk_s: float) -> None:
        """Record that the plant advanced by a chunk."""
        self._must = max(0.0, self._must - chunk_s)
        self._may = max(0.0, self._may - chunk_s)

    def wait_s(self, chunk_s: float, *, may_be_taken: bool) -> float:
        """Return the time until work is due; 0 if only the host has to read."""
        wait = (chunk_s - self._must) / min(1.0, self.speed)
        if self.fast and may_be_taken:
            fast_wait = 0.0 if math.isinf(self.speed) else (chunk_s - self._may) / self.speed
            wait = min(wait, fast_wait)
        return max(0.0, wait)


class RigSimulation:
    """Run a rig file's devices with one plant; call ``step`` repeatedly.

    speed: factor on real time, inf for as fast as the host reads the data.
    """

    def __init__(
        self,
        rig: RigFile,
        parameters: ParameterFile,
        make_endpoint: MakeEndpoint,
        *,
        speed: float,
        now_s: float,
        faults: Sequence[FaultRecord] = (),
        truth: TruthRecorder | None = None,
    ) -> None:
        """Open all ports; raise UnusableInput."""
        seed = seed_of(rig)
        self._free = FreeInputs(rig)
        self._channels = channel_table(rig)
        self._section = plant_section(rig)
        self._machine = Machine()
        constants = plant_constants(parameters, rig, self._machine)
        self._daq = data_device(rig, make_endpoint, seed)
        self._drive = drive_device(rig, make_endpoint, seed)
        self._slow = slow_devices(rig, make_endpoint, seed)
        made = (self._daq, self._drive, *self._slow)
        self._devices = {each.name: each for each in made if each.name in simulated_names(rig)}
        sampled = self._daq.name in self._devices
        self._inputs = inputs_of(rig, self._channels) if sampled else {}
        self._wires = {name: device.wire for name, device in self._devices.items()}
        self._counts = rig.spindle.encoder_counts_per_revolution * rig.spindle.gear_ratio
        self._direction = rig.spindle.direction
        self.plant = Plant(
            constants,
            seed=seed,
            filter_delay_s=self._section.filter_delay_ms * 1e-3,
            sample_rate_Hz=self._daq.simulator.sample_rate_Hz,
            free_inputs=len(self._free),
        )
        self.hands = SimulatedOperator(self.plant)
        self._start_angle = self.plant.angle_rad
        for fault in faults:
            self._check(fault, later=True)
        self._interference = Interference(rig, seed)
        self._disturbances = Disturbances(seed)
        self._timetable = Timetable(faults)
        self._truth = truth
        self._pace = PlantPace(speed, now_s)
        self._now = now_s
        self._device_s = now_s
        self._command = DriveCommand(DriveMode.OFF)
        self._target_speed = 0.0
        self._chunk_bytes = 0
        self._next_surroundings_s = -math.inf
        self._drive_degC = 0.0
        self._connected = False

    @property
    def urls(self) -> dict[str, str]:
        """Return the URL of each device for the host."""
        return {name: wire.endpoint.url for name, wire in self._wires.items()}

    def waitable(self) -> list[int]:
        """Return the descriptors to wait on for reading."""
        return [d for wire in self._wires.values() for d in wire.endpoint.waitable()]

    def step(self, now_s: float, device_s: float | None = None) -> float:
        """Do the work that is due; return the seconds until the next work.

        device_s: the devices' time (``processclock.ProcessClock``), the wall clock's if None.
        """
        self._now = now_s
        self._device_s = now_s if device_s is None else device_s
        self._timetable.act(self, now_s, self.plant.time_s, self._revolutions())
        self._connected = self._daq.wire.connected()
        self._drive.wire.connected()
        self._converse(now_s)
        rate_Hz = self._daq.simulator.sample_rate_Hz * self._disturbances.clock
        self.plant.set_sample_rate(rate_Hz)
        self._pace.tick(now_s)
        for _ in range(LONGEST_PASS_CHUNKS):
            steps = self._chunk_steps()
            chunk_s = steps * self.plant.step_s
            if not self._pace.due(chunk_s, taken=self._host_has_read()):
                break
            self._advance(steps, chunk_s, now_s)
            self._pace.advanced(chunk_s)
            self._converse(now_s)
        for wire in self._wires.values():
            wire.flush(now_s)
        return self._wait_s()

    def begin(self, fault: FaultRecord) -> None:
        """Begin a fault (called by the timetable)."""
        if fault.kind in WIRE_KINDS:
            default = 1.0 if fault.kind != WireFault.SLOW else 0.2
            value = default if fault.value is None else fault.value
            self._wires[fault.device].start_fault(WireFault(fault.kind), value)
        elif fault.kind in SIGNAL_KINDS:
            kind = SignalFault(fault.kind)
            self._disturbances.start(kind, fault.channel, fault.value, fault.rate_per_s)
        else:
            self._inject_into_device(fault)

    def end(self, fault: FaultRecord) -> None:
        """End a fault (called by the timetable)."""
        if fault.kind in WIRE_KINDS:
            self._wires[fault.device].stop_fault(WireFault(fault.kind))
        elif fault.kind in SIGNAL_KINDS:
            self._disturbances.stop(SignalFault(fault.kind), fault.channel)
        else:
            self._devices[fault.device].simulator.clear(fault.kind)

    def inject(self, fault: FaultRecord) -> None:
        """Add a fault to the timetable; raise UnusableInput if no device supports it."""
        later = fault.at_s is not None or fault.at_revolution is not None
        self._check(fault, later=later)
        self._timetable.add(fault)
        self._timetable.act(self, self._now, self.plant.time_s, self._revolutions())

    def clear(self, kind: str) -> None:
        """End all faults of a kind."""
        self._timetable.clear(self, kind)

    def still(self) -> bool:
        """Return whether the spindle is stationary and not driven."""
        return abs(self.plant.speed_rad_per_s) < STANDING and self._target_speed == 0.0

    def wear_to(self, depth_um: float, area_mm2: float | None = None) -> None:
        """Set the bushing's wear to that of an earlier test; raise UnusableInput."""
        if not self.still():
            raise UnusableInput("state: the spindle turns or is driven; stop it first.")
        try:
            self.plant.wear_to(depth_um * 1e-6, None if area_mm2 is None else area_mm2 * 1e-6)
        except ValueError as error:
            raise UnusableInput("state: {}.", error) from error

    def report(self) -> dict[str, Any]:
        """Return the true state as a JSON-ready table: angle, speed, wear, drive, links."""
        state = self.plant.state()
        return {
            "time_s": state.time_s,
            "samples": state.samples,
            "angle_deg": math.degrees(state.angle_rad) % 360.0,
            "revolutions": self._revolutions(),
            "speed_rpm": state.speed_rad_per_s / TURN * 60.0,
            "joint_force_N": state.joint_force_N,
            "motor_torque_Nm": state.motor_torque_Nm,
            "motor_current_A": state.motor_current_A,
            "wear_depth_um": state.wear_depth_m * 1e6,
            "worn_area_mm2": state.worn_area_m2 * 1e6,
            "bushing_rise_K": state.bushing_rise_K,
            "drive_mode": str(self._command.mode),
            "setpoint_rpm": self._target_speed / TURN * 60.0,
            "watchdog_tripped": bool(getattr(self._drive.simulator, "watchdog_tripped", False)),
            "streaming": self._daq.simulator.streaming,
            "sample_rate_Hz": self._daq.simulator.sample_rate_Hz,
            "connected": {n: w.endpoint.connected() for n, w in self._wires.items()},
            "failed": {n: device.simulator.failed for n, device in self._devices.items()},
            "overruns": {n: w.dropped for n, w in self._wires.items()},
        }

    def close(self) -> None:
        """Release all ports and write the truth file; safe to call twice."""
        for wire in self._wires.values():
            wire.close()
        if self._truth is not None:
            self._truth.save()
            self._truth = None

    def _converse(self, now_s: float) -> None:
        """Process the hosts' requests and reply."""
        for device in self._devices.values():
            data = device.wire.receive()
            if data or device in self._slow:
                reply = device.simulator.receive(data, self._device_s)
                device.wire.send(reply, now_s, droppable=False)
        sent = self._drive.simulator.emit(self._device_s)
        self._drive.wire.send(sent, now_s, droppable=True)

    def _advance(self, steps: int, chunk_s: float, now_s: float) -> None:
        """Advance the plant by one chunk with the drive's command and send its samples."""
        command = self._drive.simulator.command(chunk_s, self._device_s)
        samples = self.plant.advance(steps, self._act(command))
        self._observe()
        seen = terminals(samples, self._free.voltages(samples))
        seen = self._interference.apply(seen, samples, self.plant.sample_rate_Hz)
        seen = self._disturbances.apply(seen, self.plant.sample_rate_Hz)
        if self._truth is not None:
            self._truth.take(replace(samples, shaft_revolutions=seen.shaft_revolutions))
        self._deliver(seen, now_s)

    def _deliver(self, seen: WiredSignals, now_s: float) -> None:
        if not self._inputs or seen.shaft_revolutions.size == 0:
            return
        data = self._daq.simulator.sample(signals(seen, self._inputs), self._device_s)
        self._chunk_bytes = len(data)
        if not self._daq.wire.send(data, now_s, droppable=True):
            self._daq.simulator.overrun(self._device_s)

    def _act(self, command: DriveCommand) -> Drive:
        """Return the motor's input during the chunk from the drive's command."""
        before, self._command = self._command, command
        jam = self._disturbances.jam_Nm + self.hands.lock_Nm
        supply = self._machine.supply_V
        start = self._target_speed
        self._target_speed = 0.0
        if command.mode == DriveMode.OFF:
            return Drive(layout.OFF, 0.0, 0.0, 0.0, supply, jam)
        direction = self._direction
        if command.mode == DriveMode.DUTY:
            self._target_speed = (
                direction * command.duty * supply / self._machine.torque_constant_Nm_per_A
            )
            return Drive(layout.DUTY, 0.0, 0.0, direction * command.duty, supply, jam)
        speed = direction * TURN * command.speed_count_per_s / self._counts
        if before.mode != DriveMode.VELOCITY:
            start = self.plant.speed_rad_per_s
        self._target_speed = speed
        return Drive(layout.VELOCITY, start, speed, 0.0, supply, jam)

    def _observe(self) -> None:
        """Update the drive's encoder, current and supply, and the slow devices' quantities."""
        plant = self.plant
        if plant.time_s >= self._next_surroundings_s:
            self._next_surroundings_s = plant.time_s + SLOW_S
            self._update_surroundings()
        counts = self._direction * self._counts / TURN
        self._drive.simulator.observe(
            MotorState(
                position_count=math.floor((plant.angle_rad - self._start_angle) * counts),
                speed_count_per_s=plant.speed_rad_per_s * counts,
                current_A=self._direction * plant.motor_current_A,
                supply_V=self._machine.supply_V,
                temperature_C=self._drive_degC,
            )
        )

    def _update_surroundings(self) -> None:
        """Update the slow devices' quantities and the drive's temperature."""
        now = (self._section, self.plant.state().bushing_rise_K, self.plant.warm_s)
        for device in self._slow:
            device.simulator.observe(slow_values(device.quantities, *now))
        self._drive_degC = slow_values(("temperature_C",), *now)["temperature_C"] + DRIVE_WARMER_K

    def _chunk_steps(self) -> int:
        speed = max(abs(self.plant.speed_rad_per_s), abs(self._target_speed))
        chunk_s = min(CHUNK_S * max(self._pace.speed, 1.0), LONGEST_CHUNK_S)
        if speed > 0.0:
            chunk_s = min(chunk_s, CHUNK_REVOLUTIONS * TURN / speed)
        return max(1, int(chunk_s / self.plant.step_s))

    def _host_has_read(self) -> bool:
        """Return whether a host is streaming and has read all but the newest chunk."""
        if not (self._pace.fast and self._streamed()):
            return False
        return self._daq.wire.backlog(self._now) <= min(self._chunk_bytes, FULL_GAUGE_BYTES)

    def _streamed(self) -> bool:
        return self._connected and self._daq.simulator.streaming

    def _wait_s(self) -> float:
        if any(wire.waiting() for wire in self._wires.values()):
            return HOST_WAIT_S if self._pace.fast else 0.001
        chunk_s = self._chunk_steps() * self.plant.step_s
        wait = self._pace.wait_s(chunk_s, may_be_taken=self._streamed())
        return min(max(wait, HOST_WAIT_S), IDLE_S)

    def _revolutions(self) -> float:
        return (self.plant.angle_rad - self._start_angle) / TURN

    def _check(self, fault: FaultRecord, *, later: bool) -> None:
        """Refuse a fault that no device supports, before it is due; raise UnusableInput."""
        check_fault(fault, list(self._wires), self._channels)
        if later and fault.kind not in WIRE_KINDS | SIGNAL_KINDS:
            self._inject_into_device(fault)
            self._devices[fault.device].simulator.clear(fault.kind)

    def _inject_into_device(self, fault: FaultRecord) -> None:
        """Pass a fault to the device's simulator, under the simulator's names."""
        data = {"value": fault.value, "count": fault.count, "target": fault.target}
        arguments = {key: value for key, value in data.items() if value is not None}
        with foreign(
            lambda error: UnusableInput(
                f"fault {fault.kind}: device {fault.device} cannot have it ({error})."
            )
        ):
            self._devices[fault.device].simulator.simulator.inject(fault.kind, **arguments)
