"""Signals at standstill: zero, log entry before a start, rests, calibrations.

Also begins and ends the rest between two steps of a test.
"""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass

import msgspec
import numpy as np
from numpy.typing import NDArray

from rigapp.checks.fit import LIGHT_PIN
from rigapp.config.loading import Document
from rigapp.config.rig import RigFile
from rigapp.engine.activetest import ActiveTest, Rest
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.connection import Connection
from rigapp.engine.core import Core
from rigapp.engine.processing import Averaging
from rigapp.engine.values.calibrate import Calibration, calibration_of
from rigapp.schema.channels import LOAD_CELL
from rigapp.schema.loglines import REST, RestSignals
from rigapp.schema.messages import RunState
from rigapp.schema.states import ACTIVE, Refused
from rigapp.texts import say
from rigapp_drivers.api import DeviceError

Array = NDArray[np.float64]

REST_SHARE = 0.4
"""Averaging time of the signals at rest, relative to that of a zero."""


@dataclass(frozen=True, slots=True, eq=False)
class RigAtRest:
    """Rig before a test: present calibration, device settings, load cell at rest (mV/V)."""

    calibration: Calibration
    devices: Mapping[str, Mapping[str, str | float | int]]
    signals: RestSignals | None


def take_zero(core: Core, rig: ConnectedRig | None, operator: str, reason: str) -> Array:
    """Take the present signals as zero of the load cell and return the tare, (2,) in mV/V.

    The crank must be stationary and the pin unloaded. Raises Refused, TimeoutError.
    """
    core.require(
        rig is not None and core.state in (RunState.READY, RunState.STOPPED),
        say("the zero is taken before a test, not while {}", core.state),
    )
    assert rig is not None
    core.require(rig.is_stationary(), say("Stop the crank first."))
    patience_s = core.timing.zero * 4 + core.timing.start_margin
    signals = averaged(rig, core.timing.zero, patience_s).mean
    calibration = rig.processor.calibration
    cell = calibration.load_cell
    tare = np.asarray(signals[calibration.inputs_of(LOAD_CELL)] - cell.zero, np.float64)
    before = cell.tare
    degrees = rig.processor.motion.angle_deg(time.monotonic())
    core.require(
        degrees is not None
        or abs(cell.pin_weight) <= LIGHT_PIN * core.rig.record.load_cell.full_scale_N,
        say(
            "the pin itself weighs {:.2g} N, which is in the zero by the crank angle, and the angle"
            " is not known yet: turn the crank by hand past its index, then take the zero",
            abs(cell.pin_weight),
        ),
    )
    rig.processor.set_tare(tare.tolist(), None if degrees is None else math.radians(degrees))
    why = say(": {}", reason.strip()) if reason.strip() else ""
    shown = [np.array2string(values, precision=6) for values in (before, tare)]
    core.event("zero", operator or "operator", say("load cell zeroed{}", why), shown[0], shown[1])
    return tare


def use_records(core: Core, connection: Connection | None, rig: Document[RigFile]) -> None:
    """Use a rig file with the values of other records; see ``Engine.use_records``."""
    if core.state in ACTIVE:
        raise Refused("a test is running; stop it first")
    if connection is not None:
        before = connection.rig.processor.calibration
        calibration = calibration_of(rig.record, connection.rig.setup)
        if rig.record.load_cell == core.rig.record.load_cell:
            cell = before.load_cell
            calibration = calibration.with_tare(cell.tare.tolist(), cell.tare_angle)
        connection.rig.processor.use(calibration)
    core.rig = rig


def averaged(rig: ConnectedRig, seconds: float, patience_s: float) -> Averaging:
    """Average the electrical signals (inputs,) over a time; raise TimeoutError."""
    rate = rig.setup.sample_rate_Hz
    averaging = rig.processor.average(max(8, round(seconds * rate)))
    if not averaging.done.wait(patience_s):
        raise TimeoutError(say("No samples received while zeroing. Check the device."))
    return averaging


def signals_at_rest(core: Core, rig: ConnectedRig) -> RestSignals | None:
    """Return the load cell's signals, mV/V; None if the crank moves or samples are missing."""
    if not rig.is_stationary():
        return None
    seconds = REST_SHARE * core.timing.zero
    try:
        averages = averaged(rig, seconds, 2.0 * seconds * rig.slow() + 1.0)
    except TimeoutError:
        return None
    pair = rig.processor.calibration.inputs_of(LOAD_CELL)
    (first, second), (noise, other) = averages.mean[pair].tolist(), averages.noise[pair].tolist()
    angle = rig.processor.motion.angle_deg(time.monotonic())
    if not np.isfinite([first, second]).all():
        return None
    return RestSignals(first, second, noise, other, angle)


def note_rest(core: Core, rest: RestSignals | None, when: str = say("before the start")) -> None:
    """Write the signals at rest to the log of the test."""
    if rest is None:
        return
    shown = f"{rest.force_1_mV_per_V:.6f}, {rest.force_2_mV_per_V:.6f}"
    text = say("the load cell shows {} mV/V at rest {}", shown, when)
    core.event(REST, "engine", text, after=shown, data=rest)


def begin_rest(core: Core, rig: ConnectedRig, test: ActiveTest, rest: Rest) -> None:
    """Log the load cell's signals at the beginning of a rest between two steps."""
    rest.signals = signals_at_rest(core, rig)
    if test.logs_steps:
        note_rest(core, rest.signals, say("at the beginning of a rest of {:g} s", rest.duration_s))


def end_rest(core: Core, connection: Connection, test: ActiveTest, rest: Rest) -> None:
    """Log the creep of the load cell during a rest, and resume the test."""
    now, before = signals_at_rest(core, connection.rig), rest.signals
    if now is not None and before is not None and test.logs_steps:
        creep = [b - a for a, b in zip(before.pair, now.pair, strict=True)]
        note_rest(
            core,
            now,
            say(
                "at the end of a rest of {:g} s, in which it crept by {:+.6f}, {:+.6f} mV/V",
                rest.duration_s,
                creep[0],
                creep[1],
            ),
        )
    if test.resting is not rest:
        return
    with suppress(Refused, DeviceError):  # stopped meanwhile; or a DeviceError has ended the test
        connection.motion.resume(test)


PERMITTED = (RunState.READY, RunState.STOPPED)


class SignalView(msgspec.Struct, frozen=True):
    """Window of signals for a calibration.

    end: device sample at the end of each mean. signals: means of each sampled channel, as many as
    ``end``; units: of these. angle_deg: crank angle of the latest sample, None before the index.
    matrix, zero: present calibration, N per unit of the load cell and unit; quadratic: its
    quadratic terms (2 x 3), signal unit per N^2, None without. sensitivity_um_per_V,
    probe_offset_V: those of the probes.
    """

    end: list[int]
    signals: dict[str, list[float]]
    samples_per_mean: int
    sample_rate_Hz: float
    units: dict[str, str]
    angle_deg: float | None
    count_deg: float
    stands: bool
    simulated: bool
    matrix: list[list[float]]
    zero: list[float]
    quadratic: list[list[float]] | None = None
    sensitivity_um_per_V: list[float] = []
    probe_offset_V: list[float] = []


def signal_view(
    rig: ConnectedRig | None, state: RunState, window_s: float, *, simulated: bool
) -> SignalView:
    """Return the signals of the last window_s (device time); raise Refused during a test.

    The first call starts the recording and returns an empty window.
    """
    if rig is None or state not in PERMITTED:
        raise Refused(
            "readings are taken while the rig is ready and no test is running, not while {}",
            state,
        )
    if not 0.0 < window_s < math.inf:
        raise Refused("the window is a number of seconds above 0")
    processor = rig.processor
    means = processor.listen(window_s)
    calibration = processor.calibration
    encoder = calibration.encoder
    return SignalView(
        end=means.end.tolist(),
        signals=dict(zip(calibration.names, means.signals.T.tolist(), strict=True)),
        samples_per_mean=means.samples_per_mean,
        sample_rate_Hz=means.sample_rate_Hz,
        units={wire.channel.name: wire.unit for wire in calibration.wires},
        angle_deg=_angle_deg(rig) if processor.index_seen else None,
        count_deg=360.0 / encoder.counts_per_revolution,
        stands=rig.is_stationary(),
        simulated=simulated,
        matrix=calibration.load_cell.matrix.tolist(),
        zero=calibration.load_cell.zero.tolist(),
        sensitivity_um_per_V=calibration.probes.sensitivity.tolist(),
        probe_offset_V=calibration.probes.offset.tolist(),
        quadratic=_quadratic(calibration),
    )


def _quadratic(calibration: Calibration) -> list[list[float]] | None:
    cell = calibration.load_cell
    if not cell.quadratic_terms.any():
        return None
    quadratic: list[list[float]] = np.linalg.solve(cell.matrix, cell.quadratic_terms).tolist()
    return quadratic


def _angle_deg(rig: ConnectedRig) -> float | None:
    """Return the crank angle, from the counter if that restarts at the index.

    The count is valid for a stationary crank; the tracked phase may be unknown after the crank was
    turned by hand faster than a spindle can.
    """
    processor = rig.processor
    calibration, live = processor.calibration, processor.live
    encoder = calibration.encoder
    if live is None:
        return None
    if not encoder.restarts_at_index:
        newest = processor.motion.newest()
        phase = None if newest is None else newest.phase
    else:
        counts = calibration.counter.scale * live.count + calibration.counter.offset
        phase = round(encoder.direction * counts)
    if phase is None:
        return None
    degrees = math.degrees(calibration.index_angle_rad)
    return (degrees + 360.0 * phase / encoder.counts_per_revolution) % 360.0
