"""What the supervising thread looks at beside threads and stops: old blocks, broken sensors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from drivers.api import InputFault, InputFaultKind, InputSupervision
from rigapp.engine.core import Core
from rigapp.engine.judging import causes
from rigapp.schema.messages import FinishReason
from rigapp.schema.states import ACTIVE, Ending

if TYPE_CHECKING:
    from rigapp.engine.connection import Connection


CALM_S = 0.5
"""An input that was saturated has returned when no sample has been for so long."""


class Watches:
    """Look at the age of unprocessed data and at what the data source says of its inputs."""

    def __init__(self, core: Core, connection: Connection) -> None:
        self._core = core
        self._connection = connection
        self._told: tuple[InputFault, ...] = ()
        self._saturated: dict[str, int] = {}
        self._carried = {one.input: one.name for one in core.table.sampled}
        self._real_time = core.rig.record.simulation is None

    def look(self) -> None:
        """Look once."""
        self._look_at_queue()
        self._look_at_inputs()
        self._look_for_return()
        self._look_at_slow()

    def _look_at_slow(self) -> None:
        """Warn of slow devices that tell nothing, until they do."""
        slow, alarms = self._connection.slow_channels, self._core.alarms
        silent = {one.source.name: (one, age_s) for one, age_s in slow.silent()}
        for name, device in slow.devices.items():
            key = causes.slow_key(name)
            if name not in silent:
                if not device.worker.error:
                    alarms.clear(key)
            elif not alarms.is_active(key):
                port, age_s = device.source.port, silent[name][1]
                self._core.warn(causes.slow_silent(name, port, age_s, device.last_error))

    def _look_at_queue(self) -> None:
        """Switch the drive off when an overload would be seen too late.

        The time of a simulated rig waits for the engine, so that lateness costs nothing there.
        """
        core, limit_s = self._core, self._core.timing.queue_age
        if not self._real_time:
            return
        age_s = self._connection.queue_age_s()
        if age_s <= limit_s:
            core.alarms.clear("queue_age")
        elif core.state in ACTIVE and not core.alarms.is_active("queue_age"):
            source = self._connection.devices.source
            cause = causes.queue_age(source.name, age_s, limit_s)
            core.trip(Ending(FinishReason.INTERNAL, cause.cause, off=True), cause)

    def _look_at_inputs(self) -> None:
        source = self._connection.devices.source
        if not isinstance(source, InputSupervision):
            return
        faults = source.input_faults()
        if faults == self._told:
            return
        fresh = [fault for fault in faults if fault not in self._told]
        self._told = faults
        for fault in fresh:
            self._tell(source.name, source.port, fault)

    def _look_for_return(self) -> None:
        """End the alarm of a saturated input when no sample has been flagged for a while."""
        processor = self._connection.processor
        patience = CALM_S * processor.calibration.sample_rate_Hz
        for key, told_at in list(self._saturated.items()):
            if processor.next_sample - max(told_at, processor.saturated_until) > patience:
                del self._saturated[key]
                self._core.alarms.clear(key)

    def _tell(self, device: str, port: str, fault: InputFault) -> None:
        core = self._core
        if fault.kind is InputFaultKind.SATURATED and self._followed(fault):
            return
        named = ", ".join(self._name(one) for one in fault.inputs)
        broken = fault.kind is InputFaultKind.SENSOR_BROKEN
        if broken and fault.host_time_ns and self._concerns_force(fault) and core.state in ACTIVE:
            cause = causes.sensor_broken(device, port, fault.words, named)
            core.trip(Ending(FinishReason.DEVICE, cause.cause), cause)
        elif broken:
            before = fault.host_time_ns == 0
            core.warn(causes.sensor_suspect(device, port, fault.words, named, before=before))
        else:
            cause = causes.input_fault(device, port, fault.kind.value, fault.words, named)
            core.warn(cause)
            if fault.kind is InputFaultKind.SATURATED:
                self._saturated[cause.key] = self._connection.processor.next_sample

    def _name(self, wanted: str) -> str:
        """Return what an input carries, beside its name."""
        carried = self._carried.get(wanted)
        return f"{wanted} ({carried})" if carried else wanted

    def _followed(self, fault: InputFault) -> bool:
        """Tell whether the samples themselves show it, and when it ends (``saturation``)."""
        return bool(fault.inputs) and set(fault.inputs) <= self._carried.keys()

    def _concerns_force(self, fault: InputFault) -> bool:
        cell = self._core.rig.record.load_cell
        return not fault.inputs or bool({cell.input_1, cell.input_2} & set(fault.inputs))
