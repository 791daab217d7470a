"""Host an engine: simulated rig, engine, twin and server, started and ended in order.

Used by ``rigapp run`` (for one test) and ``rigapp engine`` (until it is shut down).
"""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path

import msgspec

from rigapp.calibrating.records_in_use import only_records_differ, probes_stated, with_records
from rigapp.checks.check import refuse_blocked
from rigapp.checks.fit import check_fit
from rigapp.checks.start import drive_checks, record_checks
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.sequence import Sequence
from rigapp.engine.devices import plan_devices
from rigapp.engine.engine import Engine
from rigapp.notify.channels import DeliveryChannels, inspected, ways_of
from rigapp.notify.facts import NotifierSetup
from rigapp.notify.link import NotifierLink
from rigapp.process.awake import StayAwake
from rigapp.process.logs import in_file, log_beside
from rigapp.process.private import private_folder
from rigapp.process.threads import CommandLock
from rigapp.queue.worker import QueueActions
from rigapp.schema.loglines import LogEntry, SpecimenWear
from rigapp.schema.messages import (
    AT_REST,
    Recovery,
    Remedy,
    Reply,
    RevolutionMeasured,
    RunState,
    Snapshot,
    Status,
)
from rigapp.schema.notices import Finished
from rigapp.schema.states import ACTIVE, Refused
from rigapp.service.bounds import refusal
from rigapp.service.bugreport import BugReports
from rigapp.service.calibration import RigCalibration
from rigapp.service.pins import PinCheck
from rigapp.service.recorded import (
    bushing_state,
    checkpoint,
    complete_test,
    cut_off,
    end_whole_test,
    last_wear,
    recorded_test,
    remember,
)
from rigapp.service.registry import (
    EngineEntry,
    announce,
    lasting_folder,
    local_endpoints,
    runtime_folder,
    withdraw,
)
from rigapp.service.requests import EXPECTED, ControlLock, RequestHandler
from rigapp.service.resumption import (
    Past,
    Resumption,
    compare,
    read_past,
    remarks,
    stored_tare,
)
from rigapp.service.rigqueue import RigQueue
from rigapp.service.security import Bind, authorise_own_viewer, require_viewers
from rigapp.service.server import Server
from rigapp.service.simulated import SampleNumbers, SimulatedDevices, Speed
from rigapp.texts import joined, say, sentence_of_error
from rigapp.twin.link import IdentificationTarget, TwinLink, TwinSetup

log = logging.getLogger(__name__)

START_WAIT_S = 10.0  # wait of a second start until the first is refused or begun
TWIN_START_S = 15.0
"""Longest wait of a test for its twin, which then predicts the first revolutions."""


END_CALIBRATION = say("Remove the weights from the pin, then end the calibration.")
"""Next step for a rig occupied by a calibration."""


class ChangedElsewhere(Exception):
    """Raised when the rig file has changed since the engine was started."""


class EngineHost:
    """One engine of one rig, and its service for viewers."""

    def __init__(
        self,
        rig: Document[RigFile],
        speed: Speed | None,
        bind: Bind | None = None,
        *,
        own: bool = False,
        record_wire: Path | None = None,
    ) -> None:
        """Make the engine and start to serve; devices are opened by ``connect`` or ``start``.

        bind: address to listen on instead of this computer's sockets. own: the simulated rig ends
        with the host, so that an open calibration is neither continued nor stored. record_wire:
        path for the recordings of all device lines. Raises UnusableInput.
        """
        plan_devices(rig.record, str(rig.path))
        ways = ways_of(rig)
        unusable = inspected(ways)
        if unusable:
            raise UnusableInput("{}: {}.", rig.path, joined("; ", unusable))
        self.simulated = SimulatedDevices(rig, speed)
        self._twin: TwinLink | None = None
        self._rig, self.records = rig, with_records(rig)
        self.engine = Engine(
            self.records.rig,
            on_measured=self._offer,
            records=self.records.texts,
            record_wire=record_wire,
            awake=None if rig.record.simulated_samples else StayAwake(),
        )
        self._subscription = self.engine.subscribe()
        self.notices = self.engine.watch()
        self._log = ExitStack()
        self.starting = CommandLock(START_WAIT_S)
        self._cancelled = ""
        self.ended = threading.Event()
        self.behind = SampleNumbers()
        self.command = ControlLock(
            lambda text, who, before, after: self.engine.log("command", text, who, before, after)
        )
        self.pins = PinCheck(rig)
        self.calibration = RigCalibration(
            None if own else rig.path, lambda text, who: self.engine.log("calibrating", text, who)
        )
        self.reports = BugReports(self.engine, lambda: self._rig, self._connect_to_report)
        hands = QueueActions(self._begin_queued, EXPECTED, partial(self.engine.warn, "queue"))
        self.queue = RigQueue(rig.path, hands, self.engine.watch())
        self.handle = RequestHandler(self).handle
        self._server = self._listen(bind)
        self._subscription.on_news = self._server.wake
        self._server.start()
        announce(
            EngineEntry(
                pid=os.getpid(),
                commands=self._server.commands,
                snapshots=self._server.stream,
                rig=str(rig.path.resolve()),
                started=time.time(),
                server_key=self._server.public_key,
            )
        )
        self._messages = self._notifier(ways) if ways else None

    def _notifier(self, ways: DeliveryChannels) -> NotifierLink:
        """Start the notifier, which receives the same notices as viewers."""
        folder = private_folder(lasting_folder() / "messages")
        rig = str(self._rig.path.resolve())
        run, name = say("{} {}", os.getpid(), time.time()), self._rig.record.name
        return NotifierLink(
            NotifierSetup(rig, ways.ways, ways.ping, str(folder), str(ways.secrets), run, name),
            self.engine.watch(),
            lambda: self.with_service(self.engine.status()).shown(),
            lambda text: self.engine.log("message", text, "messages"),
            partial(self.engine.warn, "messages"),
            runtime_folder(),
        )

    def _listen(self, bind: Bind | None) -> Server:
        if bind is not None:
            addresses = bind.endpoints()
        else:
            addresses = local_endpoints(runtime_folder(), os.getpid())
        # Other users of this computer can reach a port, unlike a socket in a private folder.
        keys = lasting_folder() if addresses[0].startswith("tcp:") else None
        if keys is not None:
            if bind is not None and bind.remote:
                require_viewers(keys, bind)
            authorise_own_viewer(keys)
        return Server(
            self.handle,
            self.snapshot,
            *addresses,
            keys,
            on_failure=self.engine.service_failed,
            on_viewers=self._note_viewers,
            waits=lambda: self._subscription.waits,
        )

    def _note_viewers(self, watched: bool) -> None:
        text = say("a window is read-only") if watched else say("the last window has gone")
        self.engine.log("viewer", text, "engine")

    # --- tests -----------------------------------------------------------------------------------

    def connect(self, test: TestFile | None = None) -> None:
        """Open the devices, simulated ones with the mechanism of the test; blocks until ready."""
        parameters = test.model if test is not None else None
        if not self.simulated.suits(parameters) and self.engine.state is not RunState.IDLE:
            self.engine.shutdown()
        self.engine.connect(lambda: self.simulated.ports(parameters))

    def _connect_to_report(self) -> None:
        """Reconnect for a bug report; raises Refused while the rig is occupied."""
        if self.occupied:
            raise Refused("the rig is in use; its lines are recorded without reconnecting")
        with self.starting:
            self.connect()

    def start(
        self,
        test: Document[TestFile],
        out: Path,
        operator: str,
        *,
        resume: bool,
        reason: str = "",
        examined: Callable[[Resumption], None] = lambda resumption: None,
        calibration: str = "",
    ) -> None:
        """Connect if necessary and start or resume a test; raises the engine's errors.

        reason: for findings of ``resumption`` that need one. examined: called with the findings.
        calibration: key of the open calibration to which the test belongs.
        """
        with self.starting:
            self.calibration.check(calibration, Sequence(test.record.run).fastest_rpm)
            notes = self._latest_records(operator)
            refuse_blocked(record_checks(self.records))
            check_fit(self.records.rig.record, test)
            past = read_past(out) if resume else None
            self._refuse_cancelled()
            self._make_ready(test.record)
            self._refuse_cancelled()
            refuse_blocked(drive_checks(self.engine.status()))
            notes += [
                LogEntry("calibration", say("{}: {}", section, words), operator)
                for section, words in self.records.remarks.items()
            ]
            specimen = test.record.metadata.specimen
            worn = past.worn if past is not None else last_wear(self._rig.path, specimen)
            depth_um = worn.depth_um if worn is not None else 0.0
            if self.simulated.fit(specimen, depth_um) and past is None:
                words = say("a bushing worn by {:.1f} um is in the simulated rig", depth_um)
                notes.append(
                    LogEntry("specimen", say("{}: {}", words, specimen or say("no name")), operator)
                )
            if past is not None:
                resumption = self._compare(past, test.record)
                examined(resumption)
                notes += remarks(resumption, operator, reason)
                if self.simulated.needed and past.worn is None:
                    words = say(
                        "the file states no wear depth: the simulated rig has an unworn bushing"
                    )
                    notes.append(LogEntry("resumed", words, operator))
                self._restore_tare(past)
            self._start_twin(test.record, out, past, worn)
            self._refuse_cancelled()
            self._keep_log(out)
            self.engine.start(test, out, operator=operator, resume=resume, remarks=notes, worn=worn)
            self.engine.warn("cut_off", "")
            remember(self._rig.path, out, specimen)

    def warn_of_cut_off_test(self) -> None:
        """Raise an alarm if the last test of this rig was cut off, without moving anything."""
        self.engine.warn("cut_off", cut_off(self._rig.path))

    def cancel(self, why: str) -> None:
        """Prevent further starts and cancel a running one, which raises Refused."""
        self._cancelled = why

    def _refuse_cancelled(self) -> None:
        if self._cancelled:
            raise Refused(self._cancelled)

    def _keep_log(self, out: Path) -> None:
        """Write the program's log beside this test's file from now on."""
        self._log.close()
        self._log.enter_context(in_file(log_beside(out)))

    def resumption(self, path: Path) -> Resumption:
        """Connect if necessary and return the findings for resuming the test of a file."""
        with self.starting:
            self.calibration.check()  # a simulated rig may be restarted for the test
            self._latest_records("")
            past = read_past(path)
            test = recorded_test(path).record
            self._make_ready(test)
            return self._compare(past, test)

    def use_records(self, operator: str) -> Reply:
        """Load the records named in the rig file, which a calibration may have changed."""
        with self.starting:
            try:
                changed = self._use_records()
            except ChangedElsewhere as error:
                return refusal(say("{}.", error))
            if not changed:
                return refusal(say("{} names the records that are in use already.", self._rig.path))
            # A record that blocks the start has no other remark.
            reasons = {**self.records.remarks, **self.records.blocking}
            used = joined(
                "; ",
                (say("{}: {}", label, words) for label, words in reasons.items()),
            )
            self.engine.log("calibration", say("in use from now on: {}", used), operator)
            return Reply(ok=True, sentence=say("The engine uses it from now on ({}).", used))

    def _latest_records(self, operator: str) -> list[LogEntry]:
        """Load the records named in the rig file; return the log entries about them."""
        try:
            self._use_records()
        except ChangedElsewhere as error:
            return [LogEntry("calibration", sentence_of_error(error), operator)]
        return []

    def _use_records(self) -> bool:
        """Load the records named in the rig file; return whether they changed.

        Raises UnusableInput for unusable records, Refused for a change during a test,
        ChangedElsewhere.
        """
        now, path = read_rig(self._rig.path), self._rig.path
        if not only_records_differ(self._rig.record, now.record):
            raise ChangedElsewhere(
                say(
                    (
                        "{} has changes beyond the records that it names; it takes effect when"
                        " the engine is started again"
                    ),
                    path,
                )
            )
        records = with_records(now)
        changed = records.texts != self.records.texts or now.record != self._rig.record
        if changed:
            self.engine.use_records(records.rig, records.texts)
        self._rig, self.records = now, records
        return changed

    def _make_ready(self, test: TestFile) -> None:
        ready = self.engine.state in (RunState.READY, RunState.STOPPED)
        if ready and self.simulated.suits(test.model):
            return
        if self.engine.state in ACTIVE:
            raise Refused("a test is running; stop it first")
        self.connect(test)

    def _compare(self, past: Past, test: TestFile) -> Resumption:
        """Compare a file with the rig, by the file's tare unless the cell was zeroed since."""
        rest, tare = self.engine.rest(), stored_tare(past)
        calibration = rest.calibration.under(test.model.mechanism.gravity_m_s2)
        if tare is not None and not calibration.load_cell.tare.any():
            calibration = calibration.with_tare(*tare)
        return compare(
            past,
            self.records.rig.record,
            calibration,
            rest.devices,
            rest.signals,
            self.records.blocking,
        )

    def _restore_tare(self, past: Past) -> None:
        """Restore the tare of the test."""
        tare = stored_tare(past)
        if tare is not None and not self.engine.rest().calibration.load_cell.tare.any():
            self.engine.set_tare(*tare)

    def _start_twin(
        self, test: TestFile, file: Path, past: Past | None, worn: SpecimenWear | None
    ) -> None:
        """Start the twin of a test, for a resumed test from the state in its file.

        worn: wear of the bushing from another test, whose file has the state.
        """
        if self._twin is not None:
            self._twin.close()
            self._twin = None
        if test.prediction.enabled:
            rig, stated = self.records.rig.record, probes_stated(self.records.texts)
            setup = TwinSetup(
                test.model,
                test.prediction.joint,
                sought=IdentificationTarget(
                    stated.sensitivity if stated is not None else None,
                    stated.drift_um if stated is not None else None,
                    test.stop.wear_depth_um,
                    test.run.revolutions,
                    stated.records if stated is not None else "",
                    test.prediction.prior,
                    0.5 * (rig.load_cell.uncertainty_N or (0.0, 0.0))[1],
                ),
                force_uncertainty_N=rig.load_cell.uncertainty_N,
            )
            own = past is not None and (worn is None or Path(worn.file) == past.path)
            if past is not None and own:
                setup = msgspec.structs.replace(
                    setup, new_position_um=past.new_position_um, checkpoint=checkpoint(file)
                )
            elif worn is not None:
                left, model = bushing_state(Path(worn.file))
                same_model = model == (test.model, test.prediction.joint)
                setup = msgspec.structs.replace(
                    setup, checkpoint=left, new_test=True, same_model=same_model
                )
            self._twin = TwinLink(
                setup,
                self.engine.submit_prediction,
                runtime_folder(),
                lambda text: self.engine.log("twin", text, "twin"),
            )
            self._twin.wait_ready(TWIN_START_S)

    def _offer(self, measured: RevolutionMeasured) -> None:
        twin = self._twin
        if twin is not None:
            twin.offer(measured)

    def close(self) -> None:
        """Stop a running test, notify viewers, release all; the spindle is then stationary."""
        self.cancel(say("the engine ends"))
        self.queue.halt()
        self.reports.close()
        try:
            self.engine.shutdown()
        finally:
            self.queue.close()
            if self._twin is not None:
                self._twin.close()
            self.simulated.close()
            if self._messages is not None:
                self._messages.close()
            self._server.close()
            withdraw(os.getpid())
            self._log.close()
            self.ended.set()

    @property
    def watched(self) -> bool:
        """Return whether a viewer is attached."""
        return self._server.watched

    @property
    def occupied(self) -> bool:
        """Return whether a test is running or a calibration open, even without viewers."""
        return self.engine.state in ACTIVE or self.calibration.shown is not None

    # --- queue of tests --------------------------------------------------------------------------

    def _begin_queued(self, test: Path, file: Path, operator: str) -> Finished | None:
        """Start a test of the queue; where its file exists, resume or end it."""
        self.calibration.check()
        if not file.exists():
            file.parent.mkdir(parents=True, exist_ok=True)
            self.start(read_test(test), file, operator, resume=False)
            return None
        end = end_whole_test(file) or complete_test(file)
        if end is None:
            self.start(recorded_test(file), file, operator, resume=True)
        return end

    # --- viewers ---------------------------------------------------------------------------------

    def snapshot(self) -> Snapshot:
        """Return the news for all viewers."""
        self.command.look()
        snapshot = self.engine.snapshot(self._subscription)
        return msgspec.structs.replace(snapshot, status=self.with_service(snapshot.status))

    def with_service(self, status: Status) -> Status:
        """Add the fields of the service to a status."""
        speed, queue = self.simulated.speed, self.queue.view()
        calibration, recovery = self.calibration.shown, status.recovery
        next_is_test = recovery.step in (Remedy.RESUME, Remedy.NONE)
        if calibration is not None and next_is_test and status.engine.state in AT_REST:
            recovery = Recovery(sentence=END_CALIBRATION)
        engine = msgspec.structs.replace(
            status.engine,
            calibration=calibration,
            in_command=self.command.holder,
            queue=queue.items,
            queue_works=queue.working,
            line_report=self.reports.shown,
        )
        pace = 0.0 if speed == "max" else float(speed or 1.0)
        rig = msgspec.structs.replace(
            status.rig, simulated_speed=pace, limits_need_pin=self.pins.wanted
        )
        return msgspec.structs.replace(status, engine=engine, rig=rig, recovery=recovery)
