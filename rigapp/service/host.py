"""Host an engine: simulated rig, engine, twin and server, and the order between them.

Used by ``rigapp run`` (one test, then the end) and ``rigapp engine`` (until told to shut down).
"""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec

from rigapp.calibrating.records_in_use import probes_stated, with_records
from rigapp.calibrating.rig_file import only_records_differ
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_rig, read_test
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.sequence import Sequence
from rigapp.engine.devices import plan_devices
from rigapp.engine.engine import Engine, LogEntry
from rigapp.engine.starting import check_fit
from rigapp.notify.facts import CourierSetup
from rigapp.notify.link import CourierLink
from rigapp.notify.ways import Ways, inspected, ways_of
from rigapp.process.ending import Background, asked_to_end, finish_in_time
from rigapp.process.logs import beside, in_file
from rigapp.process.private import private_folder
from rigapp.process.threads import OneAtATime
from rigapp.queue.items import removed
from rigapp.queue.worker import Hands
from rigapp.schema.details import indented
from rigapp.schema.loglines import SpecimenWear
from rigapp.schema.messages import (
    AT_REST,
    PROTOCOL_VERSION,
    Recovery,
    Remedy,
    Reply,
    Request,
    RevolutionMeasured,
    RunState,
    Snapshot,
    Status,
)
from rigapp.schema.notices import Finished
from rigapp.schema.states import ACTIVE, Refused
from rigapp.schema.verbs import (
    VERBS,
    BeginCalibration,
    CalibrationKey,
    Hand,
    Nothing,
    QueueAdd,
    QueueRemove,
    ReleaseCalibration,
    Resume,
    Start,
    Zero,
)
from rigapp.service.bounds import asked_of, refusal
from rigapp.service.calibration import RigCalibration
from rigapp.service.command import InCommand
from rigapp.service.lasttest import cut_off, last_wear, remember
from rigapp.service.queued import add_tests
from rigapp.service.recorded import (
    bushing_left,
    checkpoint,
    complete_test,
    compress_complete,
    end_whole_test,
    recorded_test,
    with_revolutions,
)
from rigapp.service.registry import (
    EngineEntry,
    announce,
    lasting_folder,
    local_endpoints,
    runtime_folder,
    withdraw,
)
from rigapp.service.resumption import (
    Past,
    Resumption,
    compare,
    read_past,
    remarks,
    stored_tare,
)
from rigapp.service.rigqueue import RigQueue
from rigapp.service.security import Bind, authorise_own_viewer, parse_bind, require_viewers
from rigapp.service.server import Server
from rigapp.service.simulated import SampleNumbers, SimulatedDevices, Speed, parse_speed
from rigapp.simulation.handle import SimulationFailed
from rigapp.twin.link import TwinLink
from rigapp.twin.messages import Sought, TwinSetup
from rigapp_drivers.api import DeviceError

log = logging.getLogger(__name__)

EXPECTED = (UnusableInput, Refused, DeviceError, SimulationFailed, TimeoutError)
"""Errors that are a sentence for whoever asked, not a defect."""

DEVICES_COME_S, DEVICES_PAUSE_S = 300.0, 15.0
"""After the computer's start devices may be ready later; they are asked so long, so often."""
LONELY_S = 60.0  # a window may be closed and opened again meanwhile
START_WAIT_S = 10.0  # a second start waits so long for the first to be refused or begun
CLOSE_S = 120.0
"""Stopping a test under way may take 60 s of it, and a courier 30 s to hear of it."""
TWIN_START_S = 15.0
"""A test waits so long for its twin, so that the first revolutions are predicted, then goes on."""


END_CALIBRATION = "Take off what hangs on the pin, then end the calibration."
"""The next step of a rig that a calibration occupies."""

HAND_LOOKS = 3
"""Looks at both counts before a hand: of three, one is not held up by the computer."""


class ChangedElsewhere(Exception):
    """Say that a rig file says something else than when the engine was started."""


class EngineHost:
    """One engine of one rig, reachable by viewers while it lives."""

    def __init__(
        self,
        rig: Document[RigFile],
        speed: Speed | None,
        bind: Bind | None = None,
        *,
        own: bool = False,
    ) -> None:
        """Make the engine and begin to serve; devices are opened by ``connect`` or ``start``.

        bind: where to listen in place of this computer's sockets. own: its simulated rig ends with
        it, so an open calibration is not taken up, nor kept. Raises UnusableInput.
        """
        plan_devices(rig.record, str(rig.path))
        ways = ways_of(rig)
        unusable = inspected(ways)
        if unusable:
            raise UnusableInput(f"{rig.path}: {'; '.join(unusable)}.")
        self._simulated = SimulatedDevices(rig, speed)
        self._twin: TwinLink | None = None
        self._rig, self._records = rig, with_records(rig)
        self.engine = Engine(
            self._records.rig, on_measured=self._offer, records=self._records.texts
        )
        self._subscription = self.engine.subscribe()
        self.notices = self.engine.watch()
        self._log = ExitStack()
        self._starting = OneAtATime(START_WAIT_S)
        self._cancelled = ""
        self.ended = threading.Event()
        self._behind = SampleNumbers()
        self._command = InCommand(
            lambda text, who, before, after: self.engine.log("command", text, who, before, after)
        )
        self._calibration = RigCalibration(
            None if own else rig.path, lambda text, who: self.engine.log("calibrating", text, who)
        )
        hands = Hands(self._begin_queued, EXPECTED, self.engine.queue_stopped)
        self._queue = RigQueue(rig.path, hands, self.engine.watch())
        self._verbs = self._table()
        self._server = self._listen(bind)
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
        self._messages = self._courier(ways) if ways else None

    def _courier(self, ways: Ways) -> CourierLink:
        """Start what tells who is away; it hears what every viewer hears."""
        folder = private_folder(lasting_folder() / "messages")
        rig = str(self._rig.path.resolve())
        run, name = f"{os.getpid()} {time.time()}", self._rig.record.name
        return CourierLink(
            CourierSetup(rig, ways.ways, ways.ping, str(folder), str(ways.secrets), run, name),
            self.engine.watch(),
            lambda: self._with_service(self.engine.status()).shown(),
            lambda text: self.engine.log("message", text, "messages"),
            self.engine.messages_failed,
            runtime_folder(),
        )

    def _listen(self, bind: Bind | None) -> Server:
        if bind is not None:
            addresses = bind.endpoints()
        else:
            addresses = local_endpoints(runtime_folder(), os.getpid())
        # A port of this computer is open to its other users, as a socket in our folder is not.
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
        text = "a window looks on" if watched else "the last window has gone"
        self.engine.log("viewer", text, "engine")

    # --- tests -----------------------------------------------------------------------------------

    def connect(self, test: TestFile | None = None) -> None:
        """Open the devices, simulated ones with the mechanism of the test; blocks until ready."""
        parameters = test.model if test is not None else None
        if not self._simulated.suits(parameters) and self.engine.state is not RunState.IDLE:
            self.engine.shutdown()
        self.engine.connect(lambda: self._simulated.ports(parameters))

    def start(
        self,
        test: Document[TestFile],
        out: Path,
        operator: str,
        *,
        resume: bool,
        reason: str = "",
        examined: Callable[[Resumption], None] = lambda found: None,
        calibration: str = "",
    ) -> None:
        """Connect where needed and start a test, or go on with it; raises what the engine raises.

        reason: for what ``resumption`` finds and asks a reason for. examined: told what it found.
        calibration: key of the open one that the test is part of.
        """
        with self._starting:
            self._calibration.judge(calibration, Sequence(test.record.run).fastest_rpm)
            notes = self._latest_records(operator)
            if self._records.blocking:
                raise Refused("; ".join(self._records.blocking.values()))
            check_fit(self._records.rig.record, test)
            past = read_past(out) if resume else None
            self._go_on()
            self._make_ready(test.record)
            self._go_on()
            notes += [
                LogEntry("calibration", f"{section}: {words}", operator)
                for section, words in self._records.remarks.items()
            ]
            specimen = test.record.metadata.specimen
            worn = past.worn if past is not None else last_wear(self._rig.path, specimen)
            depth_um = worn.depth_um if worn is not None else 0.0
            if self._simulated.fit(specimen, depth_um) and past is None:
                words = f"a bushing worn by {depth_um:.1f} um is in the simulated rig"
                notes.append(LogEntry("specimen", f"{words}: {specimen or 'no name'}", operator))
            if past is not None:
                found = self._compare(past)
                examined(found)
                notes += remarks(found, operator, reason)
                if self._simulated.needed and past.worn is None:
                    words = "the file tells no wear depth: the simulated rig has an unworn bushing"
                    notes.append(LogEntry("resumed", words, operator))
                self._take_up(past)
            self._start_twin(test.record, out, past, worn)
            self._go_on()
            self._keep_log(out)
            self.engine.start(test, out, operator=operator, resume=resume, remarks=notes, worn=worn)
            self.engine.test_cut_off("")
            remember(self._rig.path, out, specimen)

    def tell_of_cut_off_test(self) -> None:
        """Warn where the last test of this rig was ended by nobody; nothing turns."""
        self.engine.test_cut_off(cut_off(self._rig.path))

    def cancel(self, why: str) -> None:
        """Let no test start any more, nor go on with starting; raises Refused there."""
        self._cancelled = why

    def _go_on(self) -> None:
        if self._cancelled:
            raise Refused(self._cancelled)

    def _keep_log(self, out: Path) -> None:
        """Keep the program's remarks beside this test's file from now on."""
        self._log.close()
        self._log.enter_context(in_file(beside(out)))

    def resumption(self, path: Path) -> Resumption:
        """Connect where needed and say what a test in a file would meet if it went on here."""
        with self._starting:
            self._calibration.judge()  # a simulated rig may be put up anew for the test
            self._latest_records("")
            past = read_past(path)
            self._make_ready(recorded_test(path).record)
            return self._compare(past)

    def use_records(self, operator: str) -> Reply:
        """Put to use what the rig file names now; a rig file is written while an engine runs."""
        with self._starting:
            try:
                changed = self._use_records()
            except ChangedElsewhere as error:
                return refusal(f"{error}.")
            if not changed:
                return refusal(f"{self._rig.path} names the records that are in use already.")
            used = "; ".join(f"{label}: {words}" for label, words in self._records.remarks.items())
            self.engine.log("calibration", f"in use from now on: {used}", operator)
            return Reply(ok=True, sentence=f"The engine uses it from now on ({used}).")

    def _latest_records(self, operator: str) -> list[LogEntry]:
        """Use the records that the rig file names now; return what is to be said of it."""
        try:
            self._use_records()
        except ChangedElsewhere as error:
            return [LogEntry("calibration", str(error), operator)]
        return []

    def _use_records(self) -> bool:
        """Use the records that the rig file names now; tell whether they are others.

        Raises UnusableInput for what cannot be used, Refused where it would change during a test,
        ChangedElsewhere.
        """
        now, path = read_rig(self._rig.path), self._rig.path
        if not only_records_differ(self._rig.record, now.record):
            raise ChangedElsewhere(
                f"{path} was changed in more than the records that it names; it counts when the"
                " engine is started again"
            )
        found = with_records(now)
        changed = found.texts != self._records.texts or now.record != self._rig.record
        if changed:
            self.engine.use_records(found.rig, found.texts)
        self._rig, self._records = now, found
        return changed

    def _make_ready(self, test: TestFile) -> None:
        ready = self.engine.state in (RunState.READY, RunState.STOPPED)
        if ready and self._simulated.suits(test.model):
            return
        if self.engine.state in ACTIVE:
            raise Refused("a test is under way; stop it first")
        self.connect(test)

    def _compare(self, past: Past) -> Resumption:
        """Compare a file with the rig; its tare counts unless the cell was zeroed since."""
        rest, tare = self.engine.rest(), stored_tare(past)
        if tare is not None and not rest.calibration.load_cell.tare.any():
            rest = replace(rest, calibration=rest.calibration.with_tare(tare))
        return compare(
            past,
            self._records.rig.record,
            rest.calibration,
            rest.devices,
            rest.signals,
            self._records.blocking,
        )

    def _take_up(self, past: Past) -> None:
        """Use the tare of the test again."""
        tare = stored_tare(past)
        if tare is not None and not self.engine.rest().calibration.load_cell.tare.any():
            self.engine.set_tare(tare)

    def _start_twin(
        self, test: TestFile, file: Path, past: Past | None, worn: SpecimenWear | None
    ) -> None:
        """Start the twin of a test, as its file left it where the test goes on.

        worn: another test has left the bushing so; its file has what is known of it.
        """
        if self._twin is not None:
            self._twin.close()
            self._twin = None
        if test.prediction.enabled:
            rig, stated = self._records.rig.record, probes_stated(self._records.texts)
            setup = TwinSetup(
                test.model,
                test.prediction.joint,
                sought=Sought(
                    stated.sensitivity if stated is not None else None,
                    stated.drift_um if stated is not None else None,
                    test.stop.wear_depth_um,
                    test.run.revolutions,
                    stated.records if stated is not None else "",
                    test.prediction.prior,
                ),
                force_uncertainty_N=rig.load_cell.uncertainty_N,
            )
            own = past is not None and (worn is None or Path(worn.file) == past.path)
            if past is not None and own:
                setup = msgspec.structs.replace(
                    setup, new_position_um=past.new_position_um, checkpoint=checkpoint(file)
                )
            elif worn is not None:
                left, model = bushing_left(Path(worn.file))
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
        """Stop a test under way, tell viewers, release everything; the spindle stands then."""
        self.cancel("the engine ends")
        self._queue.halt()
        try:
            self.engine.shutdown()
        finally:
            self._queue.close()
            if self._twin is not None:
                self._twin.close()
            self._simulated.close()
            if self._messages is not None:
                self._messages.close()
            self._server.close()
            withdraw(os.getpid())
            self._log.close()
            self.ended.set()

    @property
    def watched(self) -> bool:
        """Tell whether a viewer is attached."""
        return self._server.watched

    @property
    def occupied(self) -> bool:
        """Tell whether a test is under way or a calibration open, which nobody may look at."""
        return self.engine.state in ACTIVE or self._calibration.shown is not None

    # --- tests one after another -----------------------------------------------------------------

    def _begin_queued(self, test: Path, file: Path, operator: str) -> Finished | None:
        """Begin a test of the queue; where its file is there, go on with it or end it."""
        self._calibration.judge()
        if not file.exists():
            file.parent.mkdir(parents=True, exist_ok=True)
            self.start(read_test(test), file, operator, resume=False)
            return None
        end = end_whole_test(file) or complete_test(file)
        if end is None:
            self.start(recorded_test(file), file, operator, resume=True)
        return end

    # --- what viewers ask ------------------------------------------------------------------------

    def snapshot(self) -> Snapshot:
        """Return what is new for all viewers."""
        self._command.look()
        snapshot = self.engine.snapshot(self._subscription)
        return msgspec.structs.replace(snapshot, status=self._with_service(snapshot.status))

    def _with_service(self, status: Status) -> Status:
        """Add what the engine itself does not know."""
        speed, queue = self._simulated.speed, self._queue.view()
        calibration, recovery = self._calibration.shown, status.recovery
        next_is_test = recovery.step in (Remedy.GO_ON, Remedy.NONE)
        if calibration is not None and next_is_test and status.state in AT_REST:
            recovery = Recovery(sentence=END_CALIBRATION)
        return msgspec.structs.replace(
            status,
            calibration=calibration,
            recovery=recovery,
            simulated_speed=0.0 if speed == "max" else float(speed or 1.0),
            in_command=self._command.holder,
            queue=queue.items,
            queue_works=queue.working,
        )

    def handle(self, request: Request) -> Reply:
        """Carry out a request; what was refused comes back as one sentence, and is logged."""
        reply = self._handled(request)
        if not reply.ok:
            log.info("%s refused: %s", request.verb, reply.sentence)
        return reply

    def _handled(self, request: Request) -> Reply:
        verb = VERBS.get(request.verb)
        if verb is None:
            known = ", ".join(sorted(VERBS))
            return refusal(f"There is no command {request.verb!r}: {known}.")
        try:
            self._command.judge(request)
            result = self._verbs[verb.name](asked_of(verb, request.arguments), request)
        except EXPECTED as error:
            return refusal(str(error))
        except (TypeError, ValueError) as error:
            return refusal(f"The arguments of {request.verb!r} are not usable ‹{error}›.")
        return result if isinstance(result, Reply) else Reply(ok=True, result=result)

    def _table(self) -> dict[str, Callable[[Any, Request], Any]]:
        """Return what each verb does, of the record of its arguments and the request."""
        engine, command, simulated = self.engine, self._command, self._simulated
        return {
            "hello": lambda a, by: {"version": PROTOCOL_VERSION, "pid": os.getpid()},
            "status": lambda a, by: self._with_service(engine.status()).tree(),
            "present": lambda a, by: command.present(by),
            "take_command": lambda a, by: command.take(by, a.force),
            "release_command": lambda a, by: command.release(by),
            "connect": self._connect_request,
            "reconnect": self._connect_request,
            "start": self._start_request,
            "resume_file": self._resume_request,
            "queue_start": lambda a, by: msgspec.to_builtins(self._queue.start(by.operator)),
            "queue_stop": lambda a, by: msgspec.to_builtins(self._queue.stop()),
            "queue_add": self._queue_request,
            "queue_remove": self._unqueue_request,
            "examine_file": lambda a, by: msgspec.to_builtins(self.resumption(Path(a.file))),
            "pause": lambda a, by: engine.pause(by.operator, a.reason),
            "resume": self._resume_paused,
            "stop": lambda a, by: engine.stop(by.operator, a.reason),
            "drive_off": lambda a, by: engine.drive_off(by.operator, a.reason),
            "reset": lambda a, by: engine.reset(by.operator),
            "acknowledge": lambda a, by: engine.acknowledge(a.key, by.operator),
            "shelve": lambda a, by: engine.shelve(a.key, a.reason, a.minutes, by.operator),
            "note": lambda a, by: engine.note(a.text, by.operator),
            "extend": lambda a, by: engine.extend(a.revolutions, by.operator, a.reason),
            "set_limit": lambda a, by: engine.set_limit(a.name, a.value, by.operator, a.reason),
            "calibration_begin": self._begin_calibration,
            "calibration_end": self._end_calibration,
            "calibration_release": self._release_calibration,
            "use_records": lambda a, by: self.use_records(by.operator),
            "zero": self._zero_request,
            "inject_fault": lambda a, by: simulated.process.inject(msgspec.to_builtins(a)),
            "clear_fault": lambda a, by: simulated.process.clear(a.kind),
            "signals": lambda a, by: msgspec.to_builtins(engine.hear(a.window_s)),
            "hand": self._hand_request,
            "simulation_state": lambda a, by: simulated.process.state(),
            "shutdown": lambda a, by: self.ended.set(),
        }

    def _hand_request(self, asked: Hand, by: Request) -> dict[str, int]:
        """Let the simulated hands do something; return the first device sample after it."""
        process = self._simulated.process
        for _ in range(HAND_LOOKS):
            self._behind.note(self.engine.samples_processed, int(process.state()["samples"]))
        self._simulated.hand(asked.what, asked.details)
        return {"after_sample": self._behind.processed_at(int(process.state()["samples"]))}

    def _resume_paused(self, asked: Nothing, by: Request) -> None:
        self._calibration.judge_viewer(by.client)
        self.engine.resume(by.operator)

    def _zero_request(self, asked: Zero, by: Request) -> dict[str, tuple[float, float]]:
        self._calibration.judge()  # what hangs on the pin would be in the zero
        return self.engine.zero(asked.what, by.operator, asked.reason)

    def _begin_calibration(self, asked: BeginCalibration, by: Request) -> dict[str, str | float]:
        with self._starting:
            if self.engine.state in ACTIVE:
                raise Refused("a test is under way; stop it first")
            return self._calibration.begin(by, asked.what, asked.fastest_rpm)

    def _end_calibration(self, asked: CalibrationKey, by: Request) -> None:
        self._calibration.end(asked.key, by)
        self._put_together()

    def _release_calibration(self, asked: ReleaseCalibration, by: Request) -> None:
        if self.engine.state in ACTIVE:
            raise Refused("the spindle turns for the calibration; stop it first")
        self._calibration.release(asked.since, asked.reason, by)
        self._put_together()

    def _put_together(self) -> None:
        """Take the hands of a training off the simulated rig: the crank would stay locked."""
        try:
            if self.engine.state not in ACTIVE:
                self._simulated.put_together()
        except (UnusableInput, SimulationFailed) as error:
            self.engine.log(
                "calibrating", f"the simulated rig is as it was left: {error}", "engine"
            )

    def _connect_request(self, asked: Nothing, by: Request) -> None:
        with self._starting:
            self.connect()

    def _start_request(self, asked: Start, by: Request) -> None:
        test = with_revolutions(read_test(Path(asked.test)), asked.revolutions)
        out, key = Path(asked.out), asked.calibration
        self.start(test, out, by.operator, resume=False, calibration=key)

    def _queue_request(self, asked: QueueAdd, by: Request) -> None:
        tests = [Path(one) for one in asked.tests]
        add_tests(self._queue.store, self._records.rig.record, tests, Path(asked.folder))

    def _unqueue_request(self, asked: QueueRemove, by: Request) -> None:
        self._queue.store.change(lambda queue: removed(queue, list(asked.numbers)))

    def _resume_request(self, asked: Resume, by: Request) -> Reply | None:
        self._calibration.judge()
        path = Path(asked.file)
        ended = end_whole_test(path)
        if ended is not None:
            return Reply(ok=True, sentence=ended.sentence)
        self.start(recorded_test(path), path, by.operator, resume=True, reason=asked.reason)
        return None


def serve(rig_path: Path, speed: str | None, bind: str | None = None, *, stay: bool = False) -> int:
    """Host an engine for windows until one of them, or a signal, shuts it down.

    bind: as ``security.parse_bind`` takes it. stay: also while nobody looks on, as it started with
    the computer: it tells of a test that was cut off, and asks for its devices for a while, which
    may come up later.

    Without it, without a test and without a viewer for ``LONELY_S``, it ends by itself.
    """
    rig = read_rig(rig_path)
    host = EngineHost(rig, parse_speed(speed, rig), parse_bind(bind) if bind else None)
    with asked_to_end() as asked:
        Background(lambda: _connect_quietly(host, DEVICES_COME_S if stay else 0.0), "connect")
        if stay:
            host.tell_of_cut_off_test()
        lonely_since = time.monotonic()
        while not host.ended.is_set() and not asked:
            notice = host.notices.get(0.2)
            if isinstance(notice, Finished):
                compress_complete(notice)
            if stay or host.watched or host.occupied:
                lonely_since = time.monotonic()
            elif time.monotonic() - lonely_since > LONELY_S:
                break
        close_host(host, asked)
    return 0


def close_host(host: EngineHost, asked: list[str]) -> None:
    """Close a host at the end of its process, which ends whatever hangs; see ``asked_to_end``."""
    finish_in_time(
        host.close,
        asked,
        turning=lambda: host.engine.state in ACTIVE,
        give_up=lambda: withdraw(os.getpid()),
        limit_s=CLOSE_S,
    )


def _connect_quietly(host: EngineHost, patience_s: float = 0.0) -> None:
    """Connect at once, so that the window shows live values; a failure shows in the state.

    patience_s: for so long it is tried again, as long as nobody else has done anything.
    """
    until = time.monotonic() + patience_s
    while True:
        try:
            host.connect()
        except EXPECTED as error:
            print(f"rigapp engine: {indented(str(error))}", flush=True)
        untouched = host.engine.state in (RunState.IDLE, RunState.FAULT) and not host.watched
        if not untouched or time.monotonic() > until or host.ended.wait(DEVICES_PAUSE_S):
            return
