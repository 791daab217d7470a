"""Calibrations made by hand: the four inputs of load cell and probes, and free ones beside them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.assembler import EncoderSetup
from rigapp.engine.values.calibrate import Calibration
from rigapp.engine.values.instruments import Counter, InputLine, LoadCell, ProbePair, Wire
from rigapp.schema.channels import BASE, Channel, ChannelTable

Array = NDArray[np.float64]


def calibration_by_hand(
    *,
    encoder: EncoderSetup,
    sample_rate_Hz: float,
    matrix: Array,
    sensitivity: Array,
    zero: Array | None = None,
    probe_offset: Array | None = None,
    latency_s: Sequence[float] | Array = (0.0, 0.0, 0.0, 0.0),
    scale: Sequence[float] | Array = (1.0, 1.0, 1.0, 1.0),
    offset: Sequence[float] | Array = (0.0, 0.0, 0.0, 0.0),
    quadratic_terms: Array | None = None,
    tare: Array | None = None,
    index_angle_rad: float = 0.0,
    correction: Any = None,
    uncertainty_um: tuple[float, float] | None = None,
    counter: Mapping[str, Any] | None = None,
    free: Mapping[str, tuple[Channel, InputLine]] | None = None,
) -> Calibration:
    """Return a calibration whose Blocks have the inputs in rows 0 .. and the count behind them.

    Free channels have the rows after the four of load cell and probes.
    """
    free = dict(free or {})
    four = iter(latency_s)
    base = tuple(
        one if one.name == "force" else replace(one, latency_s=float(next(four)))
        for one in BASE.channels
    )
    table = ChannelTable((*base, *(channel for channel, _ in free.values())))
    scales, offsets = [*scale, *(1.0 for _ in free)], [*offset, *(0.0 for _ in free)]
    wires = tuple(
        Wire(channel, row, channel.signal_unit, float(scales[row]), float(offsets[row]))
        for row, channel in enumerate(table.sampled)
    )
    return Calibration(
        table=table,
        wires=wires,
        counter=Counter(**{"row": len(wires), **(counter or {})}),
        encoder=encoder,
        index_angle_rad=index_angle_rad,
        sample_rate_Hz=sample_rate_Hz,
        load_cell=LoadCell(
            matrix,
            np.zeros(2) if zero is None else zero,
            np.zeros(2) if tare is None else tare,
            np.zeros((2, 3)) if quadratic_terms is None else quadratic_terms,
        ),
        probes=ProbePair(
            sensitivity,
            np.zeros(2) if probe_offset is None else probe_offset,
            correction,
            uncertainty_um,
        ),
        scalars={name: line for name, (_, line) in free.items()},
    )
