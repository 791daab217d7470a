"""What a calibration hears from the engine: the last seconds' signals and the pin's angle."""

from __future__ import annotations

import math

import msgspec
import numpy as np

from rigapp.engine.connectedrig import ConnectedRig
from rigapp.engine.values.calibrate import Calibration
from rigapp.schema.messages import RunState
from rigapp.schema.states import Refused

PERMITTED = (RunState.READY, RunState.STOPPED)


class SignalView(msgspec.Struct, frozen=True):
    """Carry a window of signals to a calibration.

    end: device sample at the end of each mean. signals: of each sampled channel, a list as long as
    ``end``; units: of these. angle_deg: crank angle of the newest sample, None while the index has
    not been passed. matrix, zero: the calibration in use, N per unit of the load cell and unit;
    quadratic: its quadratic terms (2 x 3), signal unit per N^2, None without.
    sensitivity_um_per_V, probe_offset_V: that of the probes.
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


def hear(
    rig: ConnectedRig | None, state: RunState, window_s: float, *, simulated: bool
) -> SignalView:
    """Return the signals of the last window_s (device time); raise Refused while a test runs.

    The first call begins to keep them and returns an empty window.
    """
    if rig is None or state not in PERMITTED:
        raise Refused(
            "readings are taken while the rig is ready and no test is under way, not while {}",
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
        units={one.channel.name: one.unit for one in calibration.wires},
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
    if not cell.bend.any():
        return None
    quadratic: list[list[float]] = np.linalg.solve(cell.matrix, cell.bend).tolist()
    return quadratic


def _angle_deg(rig: ConnectedRig) -> float | None:
    """Return the crank angle from the counter itself where it restarts at the index.

    The count says where a standing crank is; the tracked phase, which serves a running one, may be
    withheld after a hand has turned the crank faster than a spindle can.
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
