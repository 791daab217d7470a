"""Execute the requests of viewers to an engine, and manage the control of one of them."""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_test
from rigapp.queue.items import removed
from rigapp.schema.messages import PROTOCOL_VERSION, Reply, Request
from rigapp.schema.states import ACTIVE, Refused
from rigapp.schema.verbs import (
    VERBS,
    BeginCalibration,
    CalibrationKey,
    Extend,
    Hand,
    LinesToReport,
    Nothing,
    QueueAdd,
    ReleaseCalibration,
    Resume,
    SetLimit,
    Start,
    Who,
    Zero,
    verb_of,
)
from rigapp.schema.wire import tree_of
from rigapp.service.bounds import parse_arguments, refusal
from rigapp.service.recorded import end_whole_test, recorded_test, with_revolutions
from rigapp.service.rigqueue import add_tests
from rigapp.simulation.handle import SimulationFailed
from rigapp.texts import joined, say, sentence_of_error
from rigapp_drivers.api import DeviceError

# Control of an engine: several viewers may observe, one of them operates.
#
# Control is optional: until a viewer takes it, every viewer may send any request. Afterwards
# requests of others that change something are refused, except safety verbs.

CONTROL_TIMEOUT_S = 10.0
"""Time without a message of the holder after which control is released."""

ASLEEP_S = 2.0
"""Longer pauses between checks mean a suspended process and do not count for the holder."""


Log = Callable[[str, str, str, str], None]
"""Function that logs an event's text, the operator, and the holder of control before and after."""


@dataclass(frozen=True, slots=True)
class Holder:
    """The viewer in control: its identity and the name shown to others."""

    client: str
    name: str


class ControlLock:
    """The control of one operator; every method may be called from any thread."""

    def __init__(self, log: Log, clock: Callable[[], float] = time.monotonic) -> None:
        """Start without a holder; log: called at every change."""
        self._log = log
        self._clock = clock
        self._lock = threading.Lock()
        self._holder: Holder | None = None
        self._last_message = self._last_check = clock()

    @property
    def holder(self) -> str:
        """Return the name of the holder, empty without one."""
        holder = self._holder
        return holder.name if holder is not None else ""

    def look(self) -> None:
        """Release control if its holder is lost; to be called several times a second."""
        with self._lock:
            now = self._clock()
            if now - self._last_check > ASLEEP_S:
                self._last_message += now - self._last_check
            self._last_check = now
            holder = self._holder
            silence = now - self._last_message
            if holder is None or silence <= CONTROL_TIMEOUT_S:
                return
            self._holder = None
        text = say("control released: no message from {} for {:.0f} s", holder.name, silence)
        self._log(text, "engine", holder.name, "")

    def check(self, request: Request) -> None:
        """Raise Refused when the request needs control and another viewer holds it."""
        with self._lock:
            holder = self._holder
            if holder is None:
                return
            if request.client == holder.client:
                self._last_message = self._clock()
                return
        if verb_of(request.verb).who is Who.ANYONE:
            return
        raise Refused(
            "{} has control of this rig, so {} is refused; take control first. Stop,"
            " drive off and acknowledge are possible for everybody",
            holder.name,
            repr(request.verb),
        )

    def take(self, request: Request, force: bool = False) -> dict[str, str]:
        """Give control to the sender; raise Refused while another holds it, unless forced."""
        if not request.client:
            raise Refused("a viewer without an identity cannot take control")
        taker = Holder(request.client, request.operator.strip() or say("another viewer"))
        with self._lock:
            former = self._holder
            same = former is not None and former.client == taker.client
            if former is not None and not same and not force:
                raise Refused(
                    "{} has control; ask for a release, or take over by force, which is recorded",
                    former.name,
                )
            self._holder = taker
            self._last_message = self._clock()
        if not same:
            before = former.name if former is not None else ""
            text = say("took control") + (say(" by force from {}", before) if before else "")
            self._log(text, taker.name, before, taker.name)
        return {"in_command": taker.name}

    def release(self, request: Request) -> None:
        """Release control; raise Refused when the sender does not hold it."""
        with self._lock:
            holder = self._holder
            if holder is None or holder.client != request.client:
                if holder is None:
                    raise Refused("nobody controls this rig; take control first")
                raise Refused("you do not control this rig; {} does", holder.name)
            self._holder = None
        self._log(say("released control"), holder.name, holder.name, "")

    def present(self, request: Request) -> dict[str, bool]:
        """Return whether the sender still has control (``check`` has recorded the heartbeat)."""
        holder = self._holder
        return {"in_command": holder is not None and holder.client == request.client}


log = logging.getLogger(__name__)

EXPECTED = (UnusableInput, Refused, DeviceError, SimulationFailed, TimeoutError)
"""Errors that are reported to the requester as a sentence, not as a defect."""

ACTION_READINGS = 3
"""Number of readings of both counts before an action: at least one of three is not delayed."""


class RequestHandler:
    """Execute the requests of all viewers of a host."""

    def __init__(self, host: Any) -> None:
        # An ``EngineHost``, which creates this object; importing it would be circular.
        self._host = host
        self._verbs = self._table()

    def handle(self, request: Request) -> Reply:
        """Execute a request; a refusal is returned as one sentence, and logged."""
        self._host.reports.note_name(request.operator)
        reply = self._handled(request)
        if not reply.ok:
            log.info("%s refused: %s", request.verb, reply.sentence)
        return reply

    def _handled(self, request: Request) -> Reply:
        verb = VERBS.get(request.verb)
        if verb is None:
            known = joined(", ", sorted(VERBS))
            return refusal(say("There is no command {}: {}.", repr(request.verb), known))
        try:
            self._host.command.check(request)
            result = self._verbs[verb.name](parse_arguments(verb, request.arguments), request)
        except EXPECTED as error:
            return refusal(sentence_of_error(error))
        except (TypeError, ValueError) as error:
            return refusal(
                say("The arguments of {} are not usable ‹{}›.", repr(request.verb), error)
            )
        return result if isinstance(result, Reply) else Reply(ok=True, result=result)

    def _table(self) -> dict[str, Callable[[Any, Request], Any]]:
        """Return the function of each verb, called with its arguments' record and the request."""
        engine, command, simulated = self._host.engine, self._host.command, self._host.simulated
        return {
            "hello": lambda a, by: {"version": PROTOCOL_VERSION, "pid": os.getpid()},
            "status": lambda a, by: self._host.with_service(engine.status()).tree(),
            "present": lambda a, by: command.present(by),
            "take_command": lambda a, by: command.take(by, a.force),
            "release_command": lambda a, by: command.release(by),
            "connect": self._connect_request,
            "reconnect": self._connect_request,
            "start": self._start_request,
            "resume_file": self._resume_request,
            "queue_start": lambda a, by: tree_of(self._host.queue.start(by.operator)),
            "queue_stop": lambda a, by: tree_of(self._host.queue.stop()),
            "queue_add": self._queue_request,
            "queue_remove": lambda a, by: self._host.queue.store.change(
                lambda queue: removed(queue, list(a.numbers))
            ),
            "examine_file": lambda a, by: tree_of(self._host.resumption(Path(a.file))),
            "pause": lambda a, by: engine.pause(by.operator, a.reason),
            "resume": self._resume_paused,
            "stop": lambda a, by: engine.stop(by.operator, a.reason),
            "drive_off": lambda a, by: engine.drive_off(by.operator, a.reason),
            "reset": lambda a, by: engine.reset(by.operator),
            "acknowledge": lambda a, by: engine.acknowledge(a.key, by.operator),
            "shelve": lambda a, by: engine.shelve(a.key, a.reason, a.minutes, by.operator),
            "note": lambda a, by: engine.note(a.text, by.operator),
            "extend": self._extend_request,
            "set_limit": self._limit_request,
            "calibration_begin": self._begin_calibration,
            "calibration_end": self._end_calibration,
            "calibration_release": self._release_calibration,
            "report_begin": self._begin_report,
            "report_end": lambda a, by: self._host.reports.end(),
            "use_records": lambda a, by: self._host.use_records(by.operator),
            "zero": self._zero_request,
            "inject_fault": lambda a, by: simulated.process.inject(tree_of(a)),
            "clear_fault": lambda a, by: simulated.process.clear(a.kind),
            "signals": lambda a, by: tree_of(engine.signal_view(a.window_s)),
            "hand": self._hand_request,
            "simulation_state": lambda a, by: simulated.process.state(),
            "shutdown": lambda a, by: self._host.ended.set(),
        }

    def _extend_request(self, requested: Extend, by: Request) -> None:
        self._host.pins.check(by.operator, requested.pin)
        self._host.engine.extend(requested.revolutions, by.operator, requested.reason)

    def _limit_request(self, requested: SetLimit, by: Request) -> None:
        self._host.pins.check(by.operator, requested.pin)
        self._host.engine.set_limit(requested.name, requested.value, by.operator, requested.reason)

    def _hand_request(self, requested: Hand, by: Request) -> dict[str, int]:
        """Execute an action of the simulated operator; return the first device sample after it."""
        simulated, behind = self._host.simulated, self._host.behind
        process = simulated.process
        for _ in range(ACTION_READINGS):
            behind.note(self._host.engine.samples_processed, int(process.state()["samples"]))
        simulated.hand(requested.what, requested.details)
        return {"after_sample": behind.processed_at(int(process.state()["samples"]))}

    def _begin_report(self, requested: LinesToReport, by: Request) -> Reply:
        self._host.reports.begin(requested)
        devices = joined(", ", self._host.reports.shown.devices)
        return Reply(ok=True, sentence=say("The lines of {} are recorded.", devices))

    def _resume_paused(self, requested: Nothing, by: Request) -> None:
        self._host.calibration.check_viewer(by.client)
        self._host.engine.resume(by.operator)

    def _zero_request(self, requested: Zero, by: Request) -> Any:
        self._host.calibration.check()  # the zero would include a weight on the pin
        return self._host.engine.zero(requested.what, by.operator, requested.reason)

    def _begin_calibration(self, requested: BeginCalibration, by: Request) -> Any:
        with self._host.starting:
            if self._host.engine.state in ACTIVE:
                raise Refused("a test is running; stop it first")
            return self._host.calibration.begin(by, requested.what, requested.fastest_rpm)

    def _end_calibration(self, requested: CalibrationKey, by: Request) -> None:
        self._host.calibration.end(requested.key, by)
        self._put_together()

    def _release_calibration(self, requested: ReleaseCalibration, by: Request) -> None:
        if self._host.engine.state in ACTIVE:
            raise Refused("the spindle turns for the calibration; stop it first")
        self._host.calibration.release(requested.since, requested.reason, by)
        self._put_together()

    def _put_together(self) -> None:
        """Undo a training on the simulated rig, which would leave the crank locked."""
        try:
            if self._host.engine.state not in ACTIVE:
                self._host.simulated.put_together()
        except (UnusableInput, SimulationFailed) as error:
            self._host.engine.log(
                "calibrating", say("the simulated rig is as it was left: {}", error), "engine"
            )

    def _connect_request(self, requested: Nothing, by: Request) -> None:
        with self._host.starting:
            self._host.connect()

    def _start_request(self, requested: Start, by: Request) -> None:
        test = with_revolutions(read_test(Path(requested.test)), requested.revolutions)
        out, key = Path(requested.out), requested.calibration
        self._host.start(test, out, by.operator, resume=False, calibration=key)

    def _queue_request(self, requested: QueueAdd, by: Request) -> None:
        tests = [Path(test) for test in requested.tests]
        add_tests(
            self._host.queue.store, self._host.records.rig.record, tests, Path(requested.folder)
        )

    def _resume_request(self, requested: Resume, by: Request) -> Reply | None:
        self._host.calibration.check()
        path = Path(requested.file)
        ended = end_whole_test(path)
        if ended is not None:
            return Reply(ok=True, sentence=ended.sentence)
        self._host.start(
            recorded_test(path), path, by.operator, resume=True, reason=requested.reason
        )
        return None
