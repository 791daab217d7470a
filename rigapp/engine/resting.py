"""The load cell's signals while the crank stands: taken as zero, noted before a start, in a rest.

A rest between two steps of a test begins and ends here.
"""

from __future__ import annotations

import math
import time
from contextlib import suppress

import numpy as np
from numpy.typing import NDArray

from rigapp.checks.fit import LIGHT_PIN
from rigapp.engine.activetest import ActiveTest, Rest
from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.connection import Connection
from rigapp.engine.core import Core
from rigapp.engine.processing import Averaging
from rigapp.schema.channels import LOAD_CELL
from rigapp.schema.loglines import REST, RestSignals
from rigapp.schema.messages import RunState
from rigapp.schema.states import Refused
from rigapp.texts import say
from rigapp_drivers.api import DeviceError

Array = NDArray[np.float64]

REST_SHARE = 0.4
"""The signals at rest are averaged over this share of the time for a zero."""


def take_zero(core: Core, rig: ConnectedRig | None, operator: str, reason: str) -> Array:
    """Take the present signals as zero of the load cell and return the tare, (2,) in mV/V.

    The crank must stand and the pin must be unloaded. Raises Refused, TimeoutError.
    """
    core.require(
        rig is not None and core.state in (RunState.READY, RunState.STOPPED),
        say("the zero is taken before a test, not while {}", core.state),
    )
    assert rig is not None
    core.require(rig.is_stationary(), say("the crank turns; let it stand"))
    patience_s = core.timing.zero * 4 + core.timing.start_margin
    signals = averaged(rig, core.timing.zero, patience_s).mean
    calibration = rig.processor.calibration
    cell = calibration.load_cell
    tare = np.asarray(signals[calibration.place(LOAD_CELL)] - cell.zero, np.float64)
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
    shown = [np.array2string(one, precision=6) for one in (before, tare)]
    core.event("zero", operator or "operator", say("load cell zeroed{}", why), shown[0], shown[1])
    return tare


def averaged(rig: ConnectedRig, seconds: float, patience_s: float) -> Averaging:
    """Return the electrical signals (inputs,) averaged over some seconds; raise TimeoutError."""
    rate = rig.setup.sample_rate_Hz
    averaging = rig.processor.average(max(8, round(seconds * rate)))
    if not averaging.done.wait(patience_s):
        raise TimeoutError(say("the zero needs samples, and none came; check the device"))
    return averaging


def signals_at_rest(core: Core, rig: ConnectedRig) -> RestSignals | None:
    """Return what the load cell shows, mV/V; None when the crank moves or no samples come."""
    if not rig.is_stationary():
        return None
    seconds = REST_SHARE * core.timing.zero
    try:
        seen = averaged(rig, seconds, 2.0 * seconds * rig.slow() + 1.0)
    except TimeoutError:
        return None
    pair = rig.processor.calibration.place(LOAD_CELL)
    (first, second), (noise, other) = seen.mean[pair].tolist(), seen.noise[pair].tolist()
    angle = rig.processor.motion.angle_deg(time.monotonic())
    if not np.isfinite([first, second]).all():
        return None
    return RestSignals(first, second, noise, other, angle)


def note_rest(core: Core, rest: RestSignals | None, when: str = say("before the start")) -> None:
    """Write the signals at rest into the log of the test."""
    if rest is None:
        return
    shown = f"{rest.force_1_mV_per_V:.6f}, {rest.force_2_mV_per_V:.6f}"
    text = say("the load cell shows {} mV/V at rest {}", shown, when)
    core.event(REST, "engine", text, after=shown, data=rest)


def begin_rest(core: Core, rig: ConnectedRig, test: ActiveTest, rest: Rest) -> None:
    """Note what the load cell shows at the beginning of a rest between two steps."""
    rest.signals = signals_at_rest(core, rig)
    if test.logs_steps:
        note_rest(core, rest.signals, say("at the beginning of a rest of {:g} s", rest.duration_s))


def end_rest(core: Core, connection: Connection, test: ActiveTest, rest: Rest) -> None:
    """Note by how much the load cell has crept in a rest, and go on with the test."""
    now, before = signals_at_rest(core, connection.rig), rest.signals
    if now is not None and before is not None and test.logs_steps:
        crept = [b - a for a, b in zip(before.pair, now.pair, strict=True)]
        note_rest(
            core,
            now,
            say(
                "at the end of a rest of {:g} s, in which it crept by {:+.6f}, {:+.6f} mV/V",
                rest.duration_s,
                crept[0],
                crept[1],
            ),
        )
    if test.resting is not rest:
        return
    with suppress(Refused, DeviceError):  # stopped meanwhile; a drive's refusal has ended the test
        connection.motion.resume(test)
