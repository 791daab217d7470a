"""Run tests on a rig: the interface for the service, the command line and scripts.

All public methods are thread-safe. A command returns when it is accepted, not when it is complete;
``wait`` waits for a state. Commands raise ``Refused`` in an unsuitable state, ``UnusableInput`` for
unusable arguments, and ``DeviceError`` on a failure of a device.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from rigapp.config.loading import Document
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.engine.commands import (
    ended_by,
    extend,
    set_limit,
    start_test,
)
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.connection import Connection, lost_device
from rigapp.engine.core import Core
from rigapp.engine.devices import Devices, LoadDriver, make_devices
from rigapp.engine.drive.timing import Timing
from rigapp.engine.publish import Subscription
from rigapp.engine.recording.store import OpenStore, open_file
from rigapp.engine.resting import (
    RigAtRest,
    SignalView,
    signal_view,
    signals_at_rest,
    take_zero,
    use_records,
)
from rigapp.engine.supervisor import Supervisor
from rigapp.engine.values.calibrate import calibration_of
from rigapp.engine.views import build_status, next_step
from rigapp.engine.wirerecording import WireRecording
from rigapp.process.awake import StayAwake
from rigapp.process.memory import give_back
from rigapp.process.threads import CommandLock
from rigapp.schema.alarms import make_alarm
from rigapp.schema.details import error_text
from rigapp.schema.loglines import LogEntry, SpecimenWear
from rigapp.schema.messages import (
    Ends,
    FinishReason,
    Prediction,
    RevolutionMeasured,
    RunState,
    Snapshot,
    Status,
)
from rigapp.schema.notices import Finished
from rigapp.schema.states import (
    ACTIVE,
    ENDED,
    Ending,
    InFault,
    Refused,
    Trigger,
    allowed,
    refuse_long,
    transition,
)
from rigapp.texts import joined, say
from rigapp_drivers.api import DeviceError, DeviceFault
from rigapp_drivers.registry import load_driver

COMMAND_WAIT_S = 10.0
"""Longest wait of a command for the previous one; a stop does not wait."""


class Engine:
    """Engine of one rig.

    rig: the rig file as read. ports: device name -> port, replacing those of the rig file (for a
    simulated rig). load: returns a driver by name. open_store: creates the test file. on_measured:
    called with each valid revolution in the processing thread; must not block. record_wire: file of
    the recordings of the devices' lines, see ``WireRecording``. awake: keeps the computer awake
    during a test, or None. ``subscribe`` and ``watch``: see ``Publisher``.
    """

    def __init__(
        self,
        rig: Document[RigFile],
        *,
        ports: Mapping[str, str] | None = None,
        load: LoadDriver = load_driver,
        open_store: OpenStore = open_file,
        timing: Timing | None = None,
        on_measured: Callable[[RevolutionMeasured], None] | None = None,
        records: Mapping[str, str] | None = None,
        record_wire: Path | None = None,
        awake: StayAwake | None = None,
    ) -> None:
        self._records = dict(records or {})
        self._wires = WireRecording(rig.path.parent, record_wire)
        self.begin_report, self.end_report = self._wires.begin_report, self._wires.end_report
        self._core = Core(rig, timing or Timing(), on_measured, awake)
        self._ports = dict(ports or {})
        self._load = load
        self._open_store = open_store
        self._connection: Connection | None = None
        self._opening: Devices | None = None
        self._open_error: DeviceError | None = None
        self._command = CommandLock(COMMAND_WAIT_S)
        self._operator = ""
        publisher = self._core.publisher
        self.subscribe, self.unsubscribe = publisher.subscribe, publisher.unsubscribe
        self.watch, self.unwatch = publisher.watch, publisher.unwatch

    # --- connection ------------------------------------------------------------------------------

    def connect(self, ports: Callable[[], Mapping[str, str]] | None = None) -> None:
        """Open and configure the devices and start reading; blocks until ready.

        ports: creates the ports of simulated devices; called in the state connecting.

        From idle, ready, stopped or fault (then it reconnects). Raises UnusableInput, DeviceError
        or Refused; after the first two the state is fault. DeviceFault: the drive is connected, but
        an emergency stop or a fault of its own prevents motion.
        """
        with self._command:
            self._core.fire(Trigger.CONNECT)
            self._core.fault_code = FinishReason.DEVICE
            self._release()
            self._open_error = None
            try:
                if ports is not None:
                    self._ports = dict(ports())
                self._connection = self._open()
            except BaseException as error:
                why = error_text(error, say("The devices could not be connected."))
                self._core.fire_if(Trigger.FAILED, why)
                if isinstance(error, DeviceError):
                    self._open_error = error
                    self._core.warn(lost_device(error))
                else:
                    self._opening = None
                raise
            self._opening = None
            self._core.fire_if(Trigger.CONNECTED)
            self._connection.drive_watch.look()
            self._refuse_in_fault()

    def _refuse_in_fault(self) -> None:
        """Raise DeviceFault or InFault with the cause in the state fault."""
        core, connection = self._core, self._connection
        if core.state is not RunState.FAULT:
            return
        alarms = core.alarms.alarms()
        for alarm in alarms:
            if connection is not None and alarm.active and alarm.ends is Ends.DRIVE:
                spindle = connection.devices.spindle
                raise DeviceFault(spindle.name, spindle.port, "{} {}", alarm.cause, alarm.action)
        remedy = next((alarm.action for alarm in alarms if alarm.cause == core.reason), "")
        remedy = remedy or next_step(core, connection).sentence
        raise InFault(say("{} {}", core.reason, remedy).strip(), core.fault_code)

    def _open(self) -> Connection:
        core = self._core
        where = str(core.rig.path)
        devices = make_devices(core.rig.record, self._ports, self._load, where, self._wires)
        self._opening = devices
        setup = devices.open()
        connection: Connection | None = None
        try:
            calibration = calibration_of(core.rig.record, setup)
            connection = Connection(
                core, devices, setup, calibration, lambda c: Supervisor(core, c).step
            )
            # Alarms that the new connection does not raise again have ended.
            core.alarms.clear_ended_by(Ends.TEST, Ends.CONNECTION, Ends.SEEN)
            connection.start()
        except BaseException:
            (devices if connection is None else connection).close()
            core.control = None
            raise
        return connection

    def _release(self) -> None:
        connection, self._connection = self._connection, None
        if connection is None:
            return
        hanging = connection.close()
        self._wires.end()
        give_back()  # the C library retains memory of the connection's threads
        self._core.control = None
        for name in hanging:
            self._core.warn(make_alarm("thread", name, sentence=say("it does not end")))

    def shutdown(self, timeout_s: float = 60.0) -> None:
        """Stop the active test, finish its file, release the devices. Idempotent."""
        if self._core.state in ACTIVE:
            self._core.trip(
                Ending(FinishReason.OPERATOR, say("The engine was shut down during the test."))
            )
            try:
                self._core.wait(ENDED, timeout_s)
            except TimeoutError as error:
                self._core.will_not_stop(say("The engine was shut down, but {}.", error))
                self._core.finish()
        try:
            with self._command:
                self._release()
                self._core.fire_if(Trigger.DISCONNECT)
        except Refused as error:
            self._core.event("device", "engine", say("the devices are not released: {}", error))

    # --- a test ----------------------------------------------------------------------------------

    def start(
        self,
        test: Document[TestFile],
        path: Path,
        *,
        operator: str = "",
        resume: bool = False,
        remarks: Sequence[LogEntry] = (),
        worn: SpecimenWear | None = None,
    ) -> None:
        """Create the file of a test (or reopen it: ``resume``) and start the spindle.

        remarks: logged before the crank turns. worn: last known wear of the specimen, with which
        the first measured depth is compared. Raises Refused (InFault with the cause in the state
        fault), UnusableInput (the test contradicts the rig, the file cannot be created) or
        DeviceError (of the drive); the spindle does not turn then.
        """
        with self._command:
            try:
                self._start(test, path, operator, resume, remarks, worn)
            except Refused:
                self._refuse_in_fault()
                raise

    def _start(
        self,
        test: Document[TestFile],
        path: Path,
        operator: str,
        resume: bool,
        remarks: Sequence[LogEntry],
        worn: SpecimenWear | None,
    ) -> None:
        core, connection = self._core, self._connection
        transition(core.state, Trigger.START)
        if connection is None:
            raise Refused("no devices are connected; connect first")
        give_back()  # memory of the previous test: the crank is stationary, a pause is harmless
        self._operator = operator
        start_test(
            core,
            connection,
            self._open_store,
            test,
            path,
            operator=operator,
            resume=resume,
            remarks=remarks,
            worn=worn,
            records=self._records,
        )

    def pause(self, operator: str = "", reason: str = "") -> None:
        """Stop the crank at the safe angle; the drive holds it there.

        A rest between two steps becomes a pause.
        """
        with self._command:
            test = self._core.test
            if test is None or test.resting is None:
                transition(self._core.state, Trigger.PAUSE)
            assert self._connection is not None
            self._note_command("pause", operator, reason)
            self._connection.motion.pause(
                reason or say("pausing for {}", operator or say("the operator"))
            )

    def resume(self, operator: str = "") -> None:
        """Resume after a pause; raise DeviceError on a failure of the drive."""
        with self._command:
            core, connection = self._core, self._connection
            transition(core.state, Trigger.RESUME)
            active = core.test
            assert connection is not None
            assert active is not None
            self._note_command("resume", operator, "")
            connection.motion.resume(active)

    def stop(self, operator: str = "", reason: str = "") -> None:
        """End the test with a controlled stop; raise Refused without an active test."""
        self._end(operator, reason, off=False)

    def drive_off(self, operator: str = "", reason: str = "") -> None:
        """Switch off the motor's power immediately and end the test.

        Also without an active test. This is not an emergency stop, which is hardware.
        """
        if self._core.state not in ACTIVE:
            connection = self._connection
            if connection is None:
                raise Refused("no drive is connected")
            connection.rig.control.stop_now(off=True)
            self._note_command("drive_off", operator, reason)
            return
        self._end(operator, reason, off=True)

    def _end(self, operator: str, reason: str, off: bool) -> None:
        if self._core.state not in ACTIVE:
            transition(self._core.state, Trigger.STOP)
        sentence = ended_by(operator, reason, off=off)
        active = self._core.test
        locked = active is not None and active.finishing.acquire(blocking=False)
        # The drive first, as the log may wait for the disk. The file is not finished meanwhile.
        try:
            self._core.trip(Ending(FinishReason.OPERATOR, sentence, off=off))
            self._note_command("drive_off" if off else "stop", operator, reason)
        finally:
            if active is not None and locked:
                active.finishing.release()

    def reset(self, operator: str = "") -> None:
        """Clear latched alarms; from stopped or fault, return to ready.

        The deliberate action before another start. Possible in any state while an alarm needs it.
        Without a working connection the state is unchanged. Raises Refused while a critical alarm
        is active or not acknowledged, or if there is nothing to reset.
        """
        with self._command:
            core, connection = self._core, self._connection
            waiting = core.alarms.blocking() is not None
            at_rest = allowed(core.state, Trigger.RESET)
            if not at_rest and not waiting:
                transition(core.state, Trigger.RESET)
            if at_rest:
                core.settle()
                if connection is not None:
                    self._reset_drive(connection)
            core.alarms.reset(operator)
            if not at_rest:
                return
            if connection is not None and connection.sound:
                core.fire(Trigger.RESET, say("reset by {}", operator) if operator else "")
            elif not waiting:
                raise Refused("the connection to the devices is broken; connect first")

    def _reset_drive(self, connection: Connection) -> None:
        """Acknowledge the drive's own faults, so that their alarm can be cleared."""
        status = connection.rig.control.status
        if status is None or not (status.faults or status.emergency_stop):
            return
        try:
            connection.drive_watch.reset()
        except DeviceError as error:
            raise Refused("the drive keeps its fault: {}", error.sentence) from error

    # --- alarms, notes, limits, zero -------------------------------------------------------------

    def acknowledge(self, key: str = "", operator: str = "") -> None:
        """Acknowledge an alarm, or all of them; raise Refused for an unknown key."""
        keys = [key] if key else [a.key for a in self._core.alarms.alarms() if not a.acknowledged]
        for alarm in keys:
            self._core.alarms.acknowledge(alarm, operator)

    def shelve(self, key: str, reason: str, minutes: float, operator: str = "") -> None:
        """Hide an alarm for a limited time, with a reason; raise Refused."""
        self._core.alarms.shelve(key, reason, minutes * 60.0, operator)

    def note(self, text: str, operator: str = "") -> None:
        """Write an operator's note to the log of the test."""
        if not text.strip():
            raise Refused("the note is empty")
        refuse_long("note", text)
        if not self._core.event("note", operator or "operator", text.strip()):
            raise Refused("the log of this test has no room left for notes; alarms are still kept")

    def log(self, kind: str, text: str, who: str, before: str = "", after: str = "") -> None:
        """Write an event to the log of the test, with values before and after it."""
        self._core.event(kind, who, text, before, after)

    def service_failed(self, sentence: str) -> None:
        """Raise the alarm that viewers cannot be served."""
        self._core.act_on(make_alarm("service", sentence=sentence))

    def warn(self, kind: str, sentence: str) -> None:
        """Raise a warning (messages, queue, a test cut off), or clear it with an empty sentence."""
        cause = make_alarm(kind, sentence=sentence)
        if sentence:
            self._core.warn(cause)
        else:
            self._core.alarms.clear(cause.key)

    def set_limit(self, name: str, value: float, operator: str = "", reason: str = "") -> None:
        """Change a limit of the active test; logged with both values.

        name: ``overload_N``, ``overspeed_rpm``, ``stale_data_s``, or ``QUANTITY.LEVEL`` of a rule
        of the test, for example ``force_max.critical_above``. Raises Refused, UnusableInput.
        """
        with self._command:
            set_limit(self._core, name, value, operator, reason)

    def extend(self, revolutions: int, operator: str = "", reason: str = "") -> None:
        """Change the number of revolutions of the active test; logged.

        Raises Refused without a running test or if that revolution has passed, UnusableInput if the
        file or the disk has no space for them.
        """
        with self._command:
            extend(self._core, revolutions, operator, reason)

    def zero(
        self, what: Sequence[str] = ("load_cell",), operator: str = "", reason: str = ""
    ) -> dict[str, tuple[float, float]]:
        """Take the present signals as zero of the load cell; return it in signal units.

        The crank must be stationary and the pin unloaded. The zero is a tare in addition to the
        calibration, which is unchanged. Only without an active test. Raises Refused, TimeoutError.
        """
        unknown = [name for name in what if name != "load_cell"]
        if unknown:
            raise Refused("only the load_cell can be zeroed, not {}", joined(", ", unknown))
        with self._command:
            tare = take_zero(self._core, self._rig, operator, reason)
            return {"load_cell": (float(tare[0]), float(tare[1]))}

    def use_records(self, rig: Document[RigFile], records: Mapping[str, str]) -> None:
        """Use a rig file with the values of other records; only without an active test.

        rig: otherwise equal to that of the engine. The tare is kept if the load cell's values are
        unchanged. Raises Refused and UnusableInput, without any change.
        """
        with self._command:
            use_records(self._core, self._connection, rig)
            self._records = dict(records)

    def set_tare(self, tare: Sequence[float], angle: float | None = None) -> None:
        """Use the tare of an earlier run of a test (mV/V); only without an active test.

        angle: of the crank when it was taken, rad, None if unknown.
        """
        with self._command:
            self._before_a_test(say("the tare is set")).processor.set_tare(tare, angle)

    def rest(self) -> RigAtRest:
        """Return the present calibration, device settings and signals of the load cell.

        Raises Refused without devices and during a test.
        """
        with self._command:
            rig = self._before_a_test(say("this is looked at"))
            signals = signals_at_rest(self._core, rig)
            return RigAtRest(rig.processor.calibration, rig.devices.readback, signals)

    @property
    def _rig(self) -> ConnectedRig | None:
        return self._connection.rig if self._connection is not None else None

    def _before_a_test(self, what: str) -> ConnectedRig:
        """Return the connected rig; raise Refused without one or during a test."""
        if self._rig is None or self._core.state in ACTIVE:
            raise Refused("{} before a test, with the devices connected", what)
        return self._rig

    def signal_view(self, window_s: float) -> SignalView:
        """Return the electrical signals of the last seconds and the angle, for a calibration.

        Raises Refused during a test.
        """
        simulated = self._core.rig.record.simulated
        return signal_view(self._rig, self._core.state, window_s, simulated=simulated)

    @property
    def samples_processed(self) -> int:
        """Return the number of the next device sample, 0 without a connection."""
        connection = self._connection
        return connection.rig.processor.next_sample if connection is not None else 0

    def _note_command(self, verb: str, operator: str, reason: str) -> None:
        self._core.event("command", operator or "operator", say("{} {}", verb, reason).strip())

    # --- state -----------------------------------------------------------------------------------

    @property
    def state(self) -> RunState:
        """Return the present state."""
        return self._core.state

    @property
    def outcome(self) -> Finished | None:
        """Return the outcome of the last test, None before its end."""
        active = self._core.test
        return active.outcome if active is not None else None

    def status(self) -> Status:
        """Return the present status."""
        return build_status(
            self._core, self._connection, self._operator, self._opening, self._open_error
        )

    def wait(self, until: Iterable[RunState] = ENDED, timeout_s: float = 60.0) -> RunState:
        """Wait for one of the states, by default the end of a test; raise TimeoutError."""
        return self._core.wait(until, timeout_s)

    def snapshot(self, subscription: Subscription) -> Snapshot:
        """Return the new data for a viewer and the status as one message."""
        return subscription.take(self.status)

    def submit_prediction(self, prediction: Prediction) -> None:
        """Store, publish and evaluate a prediction of the twin."""
        core, active = self._core, self._core.test
        if active is None or core.state not in ACTIVE:
            return
        try:
            values = active.recorder.prediction(prediction)
        except Exception as error:
            core.storage_failed(error)
            return
        active.prediction = prediction
        active.prediction_at = time.monotonic()
        core.publisher.prediction(values, prediction)
        if self._connection is not None:
            self._connection.guard.predicted(active, values)
