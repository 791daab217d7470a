"""What must hold before the motor turns, and the making of a test's file."""

from __future__ import annotations

import math
import time
from pathlib import Path, PurePath

from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.parameters import to_parameters
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.config.rules import check_rules
from rigapp.config.sequence import Sequence
from rigapp.engine.activetest import ActiveTest
from rigapp.engine.connection import Connection
from rigapp.engine.core import Core
from rigapp.engine.drive.driving import RestApproach
from rigapp.engine.judging.criteria import StopMonitor
from rigapp.engine.judging.depthwatch import DepthWatch, KnownDepth
from rigapp.engine.judging.jointwatch import JointWatch
from rigapp.engine.judging.limits import RuleMonitor
from rigapp.engine.judging.reach import FEWEST_SAMPLES, load_cell_reach_N
from rigapp.engine.judging.testrun import TestRun
from rigapp.engine.recording.history import History
from rigapp.engine.recording.recorder import Recorder
from rigapp.engine.recording.store import Opened, OpenRequest, OpenStore
from rigapp.schema.loglines import SpecimenWear
from rigapp.schema.states import Refused
from rigapp_drivers.api import SampleClock
from rigapp_model.dynamics import rest_angle

OVERSPEED_SHARE = 0.8
"""Of the overspeed limit, which the ripple of an approach to the rest must not reach."""


def check_start(core: Core, connection: Connection, document: Document[TestFile]) -> RuleMonitor:
    """Return the monitor of a test that may start; raise Refused or UnusableInput."""
    check_fit(core.rig.record, document)
    test = document.record
    run = test.run
    blocking = core.alarms.blocking()
    if blocking is not None:
        raise Refused(f'"{blocking.title}" is on the alarm list: acknowledge and reset it first')
    connection.wait_out_silence(test.limits.stale_data_s)
    missing = connection.not_yet(test.limits.stale_data_s)
    core.require(not missing, f"{missing}; check the device")
    force_N, limit_N = connection.processor.force_N, test.limits.overload_N
    core.require(
        not force_N > limit_N,
        f"the load cell shows {force_N:.0f} N, limits.overload_N is {limit_N:g} N; unload the pin "
        "or take the zero",
    )
    sequence = Sequence(run)
    fastest = sequence.fastest_rpm
    samples = connection.setup.sample_rate_Hz * 60.0 / fastest
    calibration = connection.processor.calibration
    if calibration.counter.clock is SampleClock.ENCODER:
        samples = calibration.encoder.counts_per_revolution
    if samples < FEWEST_SAMPLES:
        raise UnusableInput(
            f"{sequence.fastest_key} = {fastest:g}: {connection.setup.sample_rate_Hz:g} samples/s "
            f"give {samples:.0f} samples a revolution, {FEWEST_SAMPLES} are needed; "
            "raise the sample rate"
        )
    return RuleMonitor(test.limits.rule, core.table)


def check_fit(rig: RigFile, document: Document[TestFile]) -> None:
    """Refuse what a rig cannot do or see, before any device is opened; raise UnusableInput."""
    test, where = document.record, document.path
    sequence, allowed = Sequence(test.run), rig.spindle.maximum_speed_rpm
    fastest, key = sequence.fastest_rpm, sequence.fastest_key
    if fastest > allowed:
        raise UnusableInput(
            f"{where}: {key} = {fastest:g} is above the rig's "
            f"spindle.maximum_speed_rpm = {allowed:g}"
        )
    if test.limits.overspeed_rpm <= fastest:
        raise UnusableInput(
            f"{where}: limits.overspeed_rpm = {test.limits.overspeed_rpm:g} must be above "
            f"{key} = {fastest:g}"
        )
    check_rules(test.limits.rule, channel_table(rig), f"{where}: ")
    check_overload(rig, test.limits.overload_N, f"{where}: ")


def check_overload(rig: RigFile, overload_N: float, where: str = "") -> None:
    """Refuse an overload that the load cell's inputs cannot show; raise UnusableInput."""
    reach = load_cell_reach_N(rig)
    if overload_N > reach:
        raise UnusableInput(
            f"{where}limits.overload_N = {overload_N:g} can never be seen: the input of "
            f"the load cell is full at {reach:.0f} N; lower the limit or raise "
            "load_cell.range_mV_per_V"
        )


def open_test(
    core: Core,
    connection: Connection,
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
            f"{path}: holds revolution {opened.last_revolution} of {run.revolutions} planned; "
            "nothing is left to do"
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
            slow=connection.slow_channels.columns,
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
            connection.processor.unfinished,
            opened.table,
        ),
        limits=test.record.limits,
        operator=request.operator,
        started_at=time.time(),
        deadline_s=connection.ramp_deadline_s(stage.speed_rpm, stage.acceleration_rpm_per_s),
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
    when = f"revolution {worn.revolution} of {PurePath(worn.file).name}"
    return KnownDepth(worn.depth_um, worn.uncertainty_um, when=when)


def _stop_monitor(test: TestFile, opened: Opened, offset_s: float, path: Path) -> StopMonitor:
    """Return the criteria with what they know of an earlier segment; raise UnusableInput."""
    stops = StopMonitor(test.stop)
    try:
        if stops.any:
            stops.remember(opened.history(), opened.last_revolution, opened.depths())
        over = stops.over(offset_s)
        if over is not None:
            raise UnusableInput(f"{path}: nothing is left to do. {over.sentence}")
    except BaseException:
        opened.store.close()
        raise
    return stops
