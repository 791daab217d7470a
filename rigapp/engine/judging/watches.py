"""What the supervising thread looks at beside threads and stops: old blocks, broken sensors."""

from __future__ import annotations

from rigapp.engine.judging.machine import JudgedRig, JudgedRun
from rigapp.schema.alarms import KINDS, Cause, because, key_of
from rigapp.schema.states import ACTIVE
from rigapp_drivers.api import InputFault, InputFaultKind, SlowSource

CALM_S = 0.5
"""An input that was saturated has returned when no sample has been for so long."""


class Watches:
    """Look at the age of unprocessed data and at what the data source says of its inputs."""

    def __init__(self, run: JudgedRun, rig: JudgedRig) -> None:
        self._run = run
        self._rig = rig
        self._told: tuple[InputFault, ...] = ()
        self._saturated: dict[str, int] = {}
        self._carried = {one.input: one.name for one in run.table.sampled}

    def look(self) -> None:
        """Look once."""
        self._look_at_queue()
        self._look_at_inputs()
        self._look_for_return()
        self._look_at_slow()

    def _look_at_slow(self) -> None:
        """Warn of slow devices that tell nothing, until they do."""
        slow, alarms = self._rig.slow_channels, self._run.alarms
        silent = {one.source.name: age_s for one, age_s in slow.silent()}
        for name, device in slow.devices.items():
            key = key_of("slow_silent", name)
            if name not in silent:
                if not device.worker.error:
                    alarms.clear(key)
            elif not alarms.is_active(key):
                self._run.act_on(slow_silent(device.source, silent[name], device.last_error))

    def _look_at_queue(self) -> None:
        """Switch the drive off when an overload would be seen too late."""
        run, limit_s = self._run, self._run.timing.queue_age
        age_s = self._rig.queue_age_s()
        if age_s <= limit_s:
            run.alarms.clear("queue_age")
        elif run.state in ACTIVE and not run.alarms.is_active("queue_age"):
            device = self._rig.source.name
            run.act_on(because("queue_age", device=device, age_s=age_s, limit_s=limit_s))

    def _look_at_inputs(self) -> None:
        source = self._rig.source
        faults = source.input_faults()
        if faults == self._told:
            return
        fresh = [fault for fault in faults if fault not in self._told]
        self._told = faults
        for fault in fresh:
            self._tell(source.name, source.port, fault)

    def _look_for_return(self) -> None:
        """End the alarm of a saturated input when no sample has been flagged for a while."""
        processor = self._rig.processor
        patience = CALM_S * processor.calibration.sample_rate_Hz
        for key, told_at in list(self._saturated.items()):
            if processor.next_sample - max(told_at, processor.saturated_until) > patience:
                del self._saturated[key]
                self._run.alarms.clear(key)

    def _tell(self, device: str, port: str, fault: InputFault) -> None:
        run, full = self._run, fault.kind is InputFaultKind.SATURATED
        if full and self._followed(fault):
            return
        named = ", ".join(self._name(one) for one in fault.inputs)
        kind, what = f"input:{fault.kind.value}", named
        if fault.kind is InputFaultKind.SENSOR_BROKEN:
            concerned = self._concerns_force(fault) and run.state in ACTIVE
            kind = "input:broken" if concerned else "input:suspect"
            if fault.host_time_ns == 0:
                kind = "input:before"
        elif kind not in KINDS:
            kind, what = "input", f"{fault.kind.value}:{named}"
        cause = because(
            kind,
            what,
            kind=fault.kind.value,
            device=device,
            port=port,
            words=fault.words + (f" ({named})" if named else ""),
        )
        run.act_on(cause)
        if full:
            self._saturated[cause.key] = self._rig.processor.next_sample

    def _name(self, wanted: str) -> str:
        """Return what an input carries, beside its name."""
        carried = self._carried.get(wanted)
        return f"{wanted} ({carried})" if carried else wanted

    def _followed(self, fault: InputFault) -> bool:
        """Tell whether the samples themselves show it, and when it ends (``saturation``)."""
        return bool(fault.inputs) and set(fault.inputs) <= self._carried.keys()

    def _concerns_force(self, fault: InputFault) -> bool:
        cell = self._run.rig.record.load_cell
        return not fault.inputs or bool({cell.input_1, cell.input_2} & set(fault.inputs))


def slow_silent(source: SlowSource, age_s: float, error: str) -> Cause:
    """Return the alarm that a slow device tells nothing; error: its last one, if any."""
    why = f" ({error.rstrip('.')})" if error else ""
    return because("slow_silent", source.name, port=source.port, age_s=age_s, why=why)
