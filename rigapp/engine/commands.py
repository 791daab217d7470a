"""Commands on a test: start it, change a limit or its length; the text of its end."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePath

from rigapp.checks.check import refuse_blocked
from rigapp.checks.fit import check_fit, overload_check, sampling_check
from rigapp.config.consistency import overspeed_faults
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.parameters import to_parameters
from rigapp.config.ranges import refusal
from rigapp.config.recipe import TestFile
from rigapp.config.sequence import Sequence
from rigapp.engine.activetest import ActiveTest
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.connection import Connection
from rigapp.engine.core import NO_FILE, Core
from rigapp.engine.drive.driving import Ramp, RestApproach
from rigapp.engine.identifying import identity_words
from rigapp.engine.judging.criteria import StopMonitor
from rigapp.engine.judging.depthwatch import DepthWatch, KnownDepth
from rigapp.engine.judging.jointwatch import JointWatch
from rigapp.engine.judging.limits import RuleMonitor, changed_limits
from rigapp.engine.judging.testrun import TestRun
from rigapp.engine.recording.history import History
from rigapp.engine.recording.recorder import Recorder
from rigapp.engine.recording.store import Opened, OpenRequest, OpenStore
from rigapp.engine.resting import note_rest, signals_at_rest
from rigapp.schema.loglines import LIMIT_CHANGED, SPECIMEN, LimitChange, LogEntry, SpecimenWear
from rigapp.schema.messages import RunState
from rigapp.schema.notices import Finished
from rigapp.schema.states import ACTIVE, Refused, Trigger
from rigapp.texts import Sentence, capitalised, say
from rigapp_drivers.api import SampleClock
from rigapp_model.dynamics import rest_angle

EXTENDABLE = frozenset({RunState.STARTING, RunState.RUNNING, RunState.PAUSING, RunState.PAUSED})

OVERSPEED_SHARE = 0.8
"""Speed limit of the approach to rest, as a fraction of the overspeed limit: margin for ripple."""


def check_start(core: Core, rig: ConnectedRig, document: Document[TestFile]) -> RuleMonitor:
    """Check whether a test may start, and return its monitor; raise Refused or UnusableInput."""
    check_fit(core.rig.record, document)
    test = document.record
    run = test.run
    blocking = core.alarms.blocking()
    if blocking is not None:
        raise Refused('"{}" is on the alarm list: acknowledge and reset it first', blocking.title)
    rig.wait_out_silence(test.limits.stale_data_s)
    missing = rig.not_yet(test.limits.stale_data_s)
    core.require(not missing, say("{}; check the device", missing))
    force_N, limit_N = rig.processor.force_N, test.limits.overload_N
    core.require(
        not force_N > limit_N,
        say(
            "the load cell shows {:.0f} N, limits.overload_N is {:g} N; unload the pin or"
            " take the zero",
            force_N,
            limit_N,
        ),
    )
    sequence = Sequence(run)
    samples = rig.setup.sample_rate_Hz * 60.0 / sequence.fastest_rpm
    calibration = rig.processor.calibration
    if calibration.counter.clock is SampleClock.ENCODER:
        samples = calibration.encoder.counts_per_revolution
    rate_Hz = rig.setup.sample_rate_Hz
    refuse_blocked([sampling_check(samples, rate_Hz, sequence)])
    return RuleMonitor(test.limits.rule, core.table)


def open_test(
    core: Core,
    rig: ConnectedRig,
    request: OpenRequest,
    monitor: RuleMonitor,
    open_store: OpenStore,
) -> ActiveTest:
    """Create or reopen the file of a test; raise UnusableInput."""
    test, path, calibration = request.test, request.path, request.calibration
    run = test.record.run
    opened = open_store(request)
    if opened.last_revolution >= run.revolutions:
        opened.store.close()
        raise UnusableInput(
            "{}: holds revolution {} of {} planned; no revolution is left to do",
            path,
            opened.last_revolution,
            run.revolutions,
        )
    gap_s = max(0.0, time.time() - opened.last_host_time) if opened.rows else 0.0
    offset_s = opened.last_time_s + gap_s
    stops = _stop_monitor(test.record, opened, offset_s, path)
    sequence = Sequence(run)
    stage = sequence.at(opened.last_revolution + 1)
    return ActiveTest(
        document=test,
        path=path,
        run=TestRun(
            calibration=calibration,
            monitor=monitor,
            first=opened.last_revolution + 1,
            planned=run.revolutions,
            time_offset_s=offset_s,
            utc=core.utc,
            resumed=request.resume,
            stops=stops,
            slow=rig.slow_channels.columns,
            joint=JointWatch(test.record.model.pairing),
            depth=DepthWatch(_last_depth(request.worn)),
            step=lambda number: sequence.at(number).step,
        ),
        recorder=Recorder(
            opened.store,
            History(test.record.cycles, run.revolutions, opened.triggered),
            calibration,
            offset_s,
            opened.last_revolution + 1,
            rig.processor.unfinished,
            opened.table,
        ),
        limits=test.record.limits,
        operator=request.operator,
        started_at=time.time(),
        deadline_s=rig.ramp_deadline_s(stage.speed_rpm, stage.acceleration_rpm_per_s),
        fresh=not request.resume,
        sequence=sequence,
        stage=stage,
        approach=_approach(test.record),
    )


def start_test(
    core: Core,
    connection: Connection,
    open_store: OpenStore,
    test: Document[TestFile],
    path: Path,
    *,
    operator: str,
    resume: bool,
    remarks: Iterable[LogEntry],
    worn: SpecimenWear | None,
    records: Mapping[str, str],
) -> None:
    """Create or reopen the file of a test and start the spindle; see ``Engine.start``."""
    processor = connection.rig.processor
    processor.use(processor.calibration.under(test.record.model.mechanism.gravity_m_s2))
    monitor = check_start(core, connection.rig, test)
    rest = signals_at_rest(core, connection.rig)
    request = OpenRequest(
        path=path,
        rig=core.rig,
        test=test,
        calibration=processor.calibration,
        devices=dict(connection.devices.readback),
        records=records,
        operator=operator,
        resume=resume,
        rest=rest,
        worn=worn,
    )
    active = open_test(core, connection.rig, request, monitor, open_store)
    core.publisher.restart(active.recorder.rows)
    core.test = active
    if core.awake is not None:
        core.awake.begin()
    connection.rig.control.arm(Ramp(active.target_rpm, active.ramp_rpm_per_s))
    try:
        core.fire(Trigger.START, say("started by {}", operator) if operator else "")
    except Refused as error:
        active.finished = True
        sentence = say("The test did not start: {}", core.reason or error)
        if not active.recorder.finish("fault", core.fault_code.value, sentence, keep_empty=resume):
            sentence = say("{} {}", sentence, NO_FILE)
        active.outcome = Finished(core.fault_code, sentence, "fault", 0, str(path))
        core.sleep_again()
        raise
    for name, readback in connection.devices.readback.items():
        core.event("device", name, identity_words(readback))
    for remark in remarks:
        core.event(remark.kind, remark.who, remark.text, remark.before, remark.after)
    if worn is not None:
        words = say("worn by {:.1f} +/- {:.1f} um", worn.depth_um, worn.uncertainty_um)
        where = say("revolution {} of {}", worn.revolution, worn.file)
        core.event(SPECIMEN, "engine", say("the specimen is {} since {}", words, where), data=worn)
    note_rest(core, rest)
    connection.motion.begin_test()
    with connection.motion.turning():
        connection.rig.control.run()


def _approach(test: TestFile) -> RestApproach:
    """Return the approach to the angle of rest at a regular end."""
    angle = rest_angle(to_parameters(test.model).mechanism)
    return RestApproach(
        None if angle is None else math.degrees(angle),
        OVERSPEED_SHARE * test.limits.overspeed_rpm,
    )


def _last_depth(worn: SpecimenWear | None) -> KnownDepth | None:
    if worn is None:
        return None
    when = say("revolution {} of {}", worn.revolution, PurePath(worn.file).name)
    return KnownDepth(worn.depth_um, worn.uncertainty_um, when=when)


def _stop_monitor(test: TestFile, opened: Opened, offset_s: float, path: Path) -> StopMonitor:
    """Return the stop criteria with the history of earlier runs; raise UnusableInput."""
    stops = StopMonitor(test.stop)
    try:
        if stops.any:
            last = opened.last_revolution
            stops.remember(opened.history(), last, opened.depths(stops.recent(last)))
        over = stops.over(offset_s)
        if over is not None:
            raise UnusableInput("{}: no revolution is left to do. {}", path, over.sentence)
    except BaseException:
        opened.store.close()
        raise
    return stops


def set_limit(core: Core, name: str, value: float, operator: str, reason: str) -> None:
    """Change a limit of the active test and log it; raise Refused, UnusableInput."""
    active = core.test
    if active is None or core.state not in ACTIVE:
        raise Refused("limits are changed in the test file while no test is under way")
    before, limits = changed_limits(active.limits, name, value, core.table)
    for message in overspeed_faults(limits, active.sequence):
        raise UnusableInput(message)
    refuse_blocked([overload_check(limits.overload_N, core.rig.record)])
    active.run.monitor.replace(limits.rule)
    active.limits = limits
    core.event(
        LIMIT_CHANGED,
        operator or "operator",
        say("limit {} changed{}", name, _why(reason)),
        before=f"{before:g}" if before is not None else "none",
        after=f"{value:g}",
        key=name,
        data=LimitChange(before, float(value)),
    )


def extend(core: Core, revolutions: int, operator: str, reason: str) -> None:
    """Change the number of revolutions of the active test and log it.

    Raises Refused, UnusableInput.
    """
    active = core.test
    if active is None or core.state not in EXTENDABLE or active.run.complete:
        raise Refused("the number of revolutions is changed while a test runs or is paused")
    run = active.run
    problem = refusal("run.revolutions", revolutions)
    if problem:
        raise UnusableInput(problem)
    core.require(
        revolutions > run.number + 1,
        say(
            "revolution {} is made already; the test can end after a later one than {}",
            run.number,
            run.number + 1,
        ),
    )
    before = run.planned
    active.recorder.extend(revolutions)
    run.planned = revolutions
    text = say("the test will end after {} revolutions{}", revolutions, _why(reason))
    core.event("command", operator or "operator", text, str(before), str(revolutions))


def ended_by(operator: str, reason: str, *, off: bool) -> Sentence:
    """Return a text with who ended a test and why; reason: as entered, not translated."""
    name = capitalised(operator) or say("The operator")
    done = say("{} switched the drive off", name) if off else say("{} stopped the test", name)
    return done + (_why(reason) or ".")


def _why(reason: str) -> str:
    """Return a reason as the end of a sentence, or an empty text."""
    return say(": {}", reason.strip()) if reason.strip() else ""
