"""What must hold before the motor turns, and the making of a test's file."""

from __future__ import annotations

import math
import time
from pathlib import Path, PurePath

from rigapp.checks.check import refuse_blocked
from rigapp.checks.fit import check_fit, sampling_check
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.parameters import to_parameters
from rigapp.config.recipe import TestFile
from rigapp.config.sequence import Sequence
from rigapp.engine.activetest import ActiveTest
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.core import Core
from rigapp.engine.drive.driving import RestApproach
from rigapp.engine.judging.criteria import StopMonitor
from rigapp.engine.judging.depthwatch import DepthWatch, KnownDepth
from rigapp.engine.judging.jointwatch import JointWatch
from rigapp.engine.judging.limits import RuleMonitor
from rigapp.engine.judging.testrun import TestRun
from rigapp.engine.recording.history import History
from rigapp.engine.recording.recorder import Recorder
from rigapp.engine.recording.store import Opened, OpenRequest, OpenStore
from rigapp.schema.loglines import SpecimenWear
from rigapp.schema.states import Refused
from rigapp.texts import say
from rigapp_drivers.api import SampleClock
from rigapp_model.dynamics import rest_angle

OVERSPEED_SHARE = 0.8
"""Of the overspeed limit, which the ripple of an approach to the rest must not reach."""


def check_start(core: Core, rig: ConnectedRig, document: Document[TestFile]) -> RuleMonitor:
    """Return the monitor of a test that may start; raise Refused or UnusableInput."""
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
    """Make the file of a test, or reopen it; raise UnusableInput."""
    test, path, calibration = request.test, request.path, request.calibration
    run = test.record.run
    opened = open_store(request)
    if opened.last_revolution >= run.revolutions:
        opened.store.close()
        raise UnusableInput(
            "{}: holds revolution {} of {} planned; nothing is left to do",
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


def _approach(test: TestFile) -> RestApproach:
    """Return how the crank comes to its rest at a regular end."""
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
    """Return the criteria with what they know of an earlier segment; raise UnusableInput."""
    stops = StopMonitor(test.stop)
    try:
        if stops.any:
            last = opened.last_revolution
            stops.remember(opened.history(), last, opened.depths(stops.recent(last)))
        over = stops.over(offset_s)
        if over is not None:
            raise UnusableInput("{}: nothing is left to do. {}", path, over.sentence)
    except BaseException:
        opened.store.close()
        raise
    return stops
