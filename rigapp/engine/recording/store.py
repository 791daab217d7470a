"""Interface of a test file, and its creation and reopening by the engine."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.config.channels import channel_table
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.engine.judging.criteria import DEPTH_COLUMNS, HISTORY_COLUMNS, NOTHING
from rigapp.engine.recording.history import TRIGGERED
from rigapp.engine.values.calibrate import Calibration
from rigapp.engine.values.instruments import InputLine, ProbePair
from rigapp.schema.channels import LOAD_CELL, PROBES, ChannelTable, Kind
from rigapp.schema.loglines import RestSignals, SpecimenWear
from rigapp.schema.messages import Event, PathReport
from rigapp.schema.wire import tree_of
from rigapp.storage import (
    CALIBRATION,
    TestMetadata,
    create_test,
    open_test,
    reopen_test,
    rows_up_to,
)
from rigapp_calibration.load_cell.force_uncertainty import (
    noise_of_sample,
    stated_uncertainty,
    uncertainty_record,
)
from rigapp_drivers.api import SampleClock


class Store(Protocol):
    """Test file. ``append_*`` are thread-safe and do not wait for the disk."""

    @property
    def path(self) -> Path:
        """Return the path of the file; another one if it had to be saved there."""

    def watch_path(self, notice: Callable[[str], object]) -> PathReport | None:
        """Restore the path of the file; None if it is unchanged.

        May take long; notice is called before.
        """

    @property
    def revolutions(self) -> int:
        """Return the number of rows appended."""

    @property
    def cycles_refused(self) -> int:
        """Return the number of complete cycles that had no space."""

    def append_row(self, values: NDArray[np.float64]) -> None:
        """Append a row, in the order of the plan's columns."""

    def append_cycle(
        self, revolution: int, columns: Mapping[str, ArrayLike], why: str, quality: int
    ) -> bool:
        """Append a complete cycle and why it is stored; return False without space."""

    def hold_cycle(
        self, revolution: int, columns: Mapping[str, ArrayLike], why: str, quality: int
    ) -> None:
        """Write a complete cycle that waits in memory, for recovery after a crash."""

    def append_unfinished(
        self, revolution: int, columns: Mapping[str, ArrayLike], quality: int
    ) -> bool:
        """Append an unfinished revolution; return False without space."""

    def append_prediction(self, values: NDArray[np.float64]) -> bool:
        """Append a prediction; return False without space."""

    def append_curves(self, revolution: int, curves: Mapping[str, ArrayLike]) -> bool:
        """Append the predicted curves of a revolution; return False without space."""

    def append_profile(self, values: NDArray[np.float64], curves: Mapping[str, ArrayLike]) -> bool:
        """Append a worn profile; return False without space."""

    def keep_checkpoint(self, revolution: int, state: bytes) -> None:
        """Store the state of the twin after a revolution, for a restart; the latest one is used."""

    def append_event(self, event: Event) -> bool:
        """Append to the log; return False if it is full."""

    def note_gap(self, event: Event) -> None:
        """Count an interruption and log it."""

    def place(self) -> None:
        """Write queued data to the file, without a commit."""

    def extend(self, revolutions: int) -> None:
        """Reserve space for a number of revolutions and log it; raise UnusableInput."""

    def commit(self) -> int:
        """Commit all data and return the number of committed rows."""

    def finish(self, status: str, reason_code: str, sentence: str) -> None:
        """Commit, and record the end of the test: complete, stopped or fault."""

    def close(self) -> None:
        """Close the file."""

    def discard(self) -> None:
        """Close and delete a file without rows."""


HISTORY_ROWS = 100_000
"""Rows of earlier runs that are read at once."""


@dataclass(frozen=True, slots=True)
class Opened:
    """An open test file. rows: already in it; last_*: of the last of these.

    table: its channels, None for those of the rig.

    triggered: complete cycles in it that a trigger selected. history: yields these rows in blocks
    of (len(HISTORY_COLUMNS), n); depths: reads the measured wear depths after a revolution, as
    (len(DEPTH_COLUMNS), n).
    """

    store: Store
    rows: int = 0
    last_revolution: int = 0
    last_time_s: float = 0.0
    last_host_time: float = 0.0
    history: Callable[[], Iterator[NDArray[np.float64]]] = lambda: iter(())
    depths: Callable[[int], NDArray[np.float64]] = lambda after: NOTHING
    triggered: int = 0
    table: ChannelTable | None = None


@dataclass(frozen=True, slots=True, eq=False)
class OpenRequest:
    """Content of a new file before its first row.

    rest: the signals at rest. worn: wear of the specimen, None for a new one.
    """

    path: Path
    rig: Document[RigFile]
    test: Document[TestFile]
    calibration: Calibration
    devices: Mapping[str, Mapping[str, str | float | int]]
    records: Mapping[str, str]
    operator: str
    resume: bool
    rest: RestSignals | None = None
    worn: SpecimenWear | None = None


OpenStore = Callable[[OpenRequest], Opened]
"""Create or reopen a test file; raises UnusableInput without leaving a file."""


def open_file(request: OpenRequest) -> Opened:
    """Create the HDF5 file of a test, or reopen it to resume; raise UnusableInput."""
    return _resume(request) if request.resume else _create(request)


def _create(request: OpenRequest) -> Opened:
    from rigapp.engine.recording.fileplan import file_plan

    test, rig = request.test.record, request.rig.record
    calibration = request.calibration
    by_encoder = calibration.counter.clock is SampleClock.ENCODER
    plan = file_plan(
        test,
        calibration.sample_rate_Hz,
        calibration.encoder.counts_per_revolution if by_encoder else None,
        calibration.table,
    )
    metadata = TestMetadata(
        title=test.title,
        rig_text=request.rig.text,
        test_text=request.test.text,
        parameters=tree_of(test.model),
        calibration={
            **calibration_record(request.calibration),
            "force_uncertainty": _uncertainty(request),
            **{f"device_{name}": dict(readback) for name, readback in request.devices.items()},
            **{f"record_{section}": {"record": text} for section, text in request.records.items()},
        },
        detectors=detector_record(rig, calibration.sample_rate_Hz, request.devices),
        rig_name=rig.name,
        operator=request.operator or test.metadata.operator,
        specimen=test.metadata.specimen,
        bushing=test.metadata.bushing,
        notes=test.metadata.notes,
        simulated=bool(rig.simulated_devices),
    )
    return Opened(create_test(request.path, plan, metadata))


def _resume(request: OpenRequest) -> Opened:
    store = reopen_test(request.path)
    try:
        with open_test(request.path) as reader:
            table = reader.plan.table
            missing = missing_channels(table, request.calibration.table)
            if missing:
                raise UnusableInput("{}: {}", request.path, missing)
            rows = store.revolutions
            if rows == 0:
                return Opened(store, table=table)
            return Opened(
                store,
                table=table,
                rows=rows,
                last_revolution=int(reader.column("revolution", rows - 1, rows)[0]),
                last_time_s=float(reader.column("time", rows - 1, rows)[0]),
                last_host_time=float(reader.column("host_time", rows - 1, rows)[0]),
                triggered=sum(why in TRIGGERED for why in reader.cycle_reasons()),
                history=lambda: _history(request.path, rows),
                depths=lambda after: _depths(request.path, after),
            )
    except BaseException:
        store.close()
        raise


def missing_channels(kept: ChannelTable, measured: ChannelTable) -> str:
    """Return why a rig cannot resume a file, by the channels of both, or an empty text."""
    missing = [
        channel.name
        for channel in kept.channels
        if channel.name not in measured
        or not set(channel.columns) <= set(measured[channel.name].columns)
    ]
    if not missing:
        return ""
    return (
        f"the file keeps {', '.join(missing)}, which this rig does not measure so; put"
        f" [channels.{missing[0]}] of the test's rig file back, or begin a new test"
    )


def _history(path: Path, rows: int) -> Iterator[NDArray[np.float64]]:
    with open_test(path) as reader:
        for first in range(0, rows, HISTORY_ROWS):
            stop = min(rows, first + HISTORY_ROWS)
            columns = [reader.column(name, first, stop) for name in HISTORY_COLUMNS]
            yield np.array(columns, np.float64)


def _depths(path: Path, after: int) -> NDArray[np.float64]:
    with open_test(path) as reader:
        first = rows_up_to(reader, after, "prediction")
        result = [reader.column(name, first, stream="prediction") for name in DEPTH_COLUMNS]
        return np.array(result, np.float64)


def calibration_record(calibration: Calibration) -> dict[str, Any]:
    """Return a calibration as nested plain values, units in the keys."""
    encoder, cell, probes = calibration.encoder, calibration.load_cell, calibration.probes
    result = {
        LOAD_CELL: {
            "record": cell.record,
            "matrix_N_per_mV_per_V": cell.matrix.tolist(),
            "bend_per_N": cell.quadratic_terms.tolist(),
            "zero_mV_per_V": cell.zero.tolist(),
            "tare_mV_per_V": cell.tare.tolist(),
            "pin_weight_in_plane_N": cell.pull.tolist(),
            **(
                {}
                if cell.tare_angle is None
                else {"tare_crank_angle_deg": math.degrees(cell.tare_angle)}
            ),
            "latency_ms": _latency_ms(calibration, LOAD_CELL),
            "frame": "crank",
            "sign": "F on the follower by the pin = G + bend (F1^2, F1 F2, F2^2),"
            " G = - matrix (signal - zero - tare), and what the pin weighs at the angle of the"
            " sample, less that at the angle of the tare",
        },
        PROBES: {
            "record": probes.record,
            "sensitivity_um_per_V": probes.sensitivity.tolist(),
            "offset_V": probes.offset.tolist(),
            "latency_ms": _latency_ms(calibration, PROBES),
            "frame": "follower",
            **_probe_extras(probes),
        },
        "encoder": {
            "counts_per_revolution": encoder.counts_per_revolution,
            "direction": encoder.direction,
            "restarts_at_index": int(encoder.restarts_at_index),
            "index_angle_deg": math.degrees(calibration.index_angle_rad),
        },
        "acquisition": {
            "clock": calibration.counter.clock.value,
            "sample_rate_Hz": calibration.sample_rate_Hz,
            "scale": [wire.scale for wire in calibration.wires],
            "offset": [wire.offset for wire in calibration.wires],
        },
    }
    for wire in calibration.wires:
        line = calibration.scalars.get(wire.channel.name)
        if line is not None:
            result[f"channel_{wire.channel.name}"] = {
                "record": line.record,
                "unit": wire.channel.unit,
                "latency_ms": 1e3 * wire.channel.latency_s,
                **_line_record(line),
                **({} if line.uncertainty is None else {"uncertainty": line.uncertainty}),
            }
    return result


def _latency_ms(calibration: Calibration, instrument: str) -> list[float]:
    return (calibration.latency_s[calibration.inputs_of(instrument)] * 1e3).tolist()


def _line_record(line: InputLine) -> dict[str, Any]:
    if line.table.size:
        return {"table_V": line.table[0].tolist(), "table_value": line.table[1].tolist()}
    return {"scale_per_V": line.slope, "offset_V": line.zero}


def _uncertainty(request: OpenRequest) -> dict[str, Any]:
    """Return the file's record of the uncertainty of its forces."""
    cell = request.rig.record.load_cell
    stated = stated_uncertainty(request.records.get("load_cell", ""), cell.uncertainty_N)
    signal_noise = request.rest.noise if request.rest is not None else None
    noise_N = noise_of_sample(request.calibration.load_cell.matrix, signal_noise, cell.resolution_N)
    return uncertainty_record(stated, *noise_N, cell.full_scale_N)


INSTRUMENTS = {
    LOAD_CELL: (
        "strain gauge load cell",
        "two bridges in the crank pin: the force on the follower by the pin, along the crank and"
        " across it",
    ),
    PROBES: (
        "capacitance probe",
        "two probes on the follower: position of the pin, along the follower and across it",
    ),
}
"""Instrument -> its type and quantity, as described in a file."""


def detector_record(
    rig: RigFile,
    sample_rate_Hz: float,
    devices: Mapping[str, Mapping[str, str | float | int]] = MappingProxyType({}),
) -> dict[str, Mapping[str, Any]]:
    """Return the detectors as nested plain values, units in the keys; rate: of the device.

    devices: settings read back from each, with its identity.
    """
    table, cell, encoder = channel_table(rig), rig.load_cell, rig.encoder
    ranges = {
        LOAD_CELL: {"full_scale_N": cell.full_scale_N, "resolution_N": cell.resolution_N},
        PROBES: {"range_V": rig.probes.range_V},
    }
    result: dict[str, Mapping[str, Any]] = {}
    for name, (kind, sentence) in INSTRUMENTS.items():
        wired = [table[channel] for channel in table.names_of(name)]
        result[name] = {
            "description": sentence,
            "type": kind,
            "channels": [curve.name for curve in table.curves if curve.instrument == name],
            "local_name": [wire.input for wire in wired],
            **_device(rig, wired[0].device, sample_rate_Hz, devices),
            **ranges[name],
            "latency_ms": [1e3 * wire.latency_s for wire in wired],
            "calibration": f"{CALIBRATION}/{name}",
        }
    result["encoder"] = {
        "description": "angle of the crank",
        "type": "incremental encoder with index",
        "channels": ["angle"],
        "local_name": [encoder.input],
        **_device(rig, encoder.device, sample_rate_Hz, devices),
        "counts_per_revolution": encoder.counts_per_revolution,
        "calibration": f"{CALIBRATION}/encoder",
    }
    for channel in table.free:
        slow = channel.kind is Kind.SLOW
        result[channel.name] = {
            "description": channel.description,
            "type": "one value a revolution" if slow else "scalar input",
            "channels": [channel.name],
            "local_name": [channel.input],
            **_device(rig, channel.device, math.nan if slow else sample_rate_Hz, devices),
            "unit": channel.unit,
            **(
                {}
                if slow
                else {"range_V": channel.signal_range, "latency_ms": 1e3 * channel.latency_s}
            ),
        }
    return result


IDENTITY_PREFIX = "device_"
"""Prefix of the keys of a device's identity, beside its settings (``identifying``)."""


def _device(
    rig: RigFile,
    name: str,
    sample_rate_Hz: float,
    devices: Mapping[str, Mapping[str, str | float | int]],
) -> dict[str, Any]:
    identity = {
        key.removeprefix(IDENTITY_PREFIX): value
        for key, value in devices.get(name, {}).items()
        if key.startswith(IDENTITY_PREFIX)
    }
    return {
        "device": name,
        "driver": rig.devices[name].driver,
        **identity,
        "sample_rate_Hz": sample_rate_Hz,
    }


def _probe_extras(probes: ProbePair) -> dict[str, Any]:
    """Return uncertainty, alignment and run-out map of the probes, if used."""
    extras: dict[str, Any] = {}
    if probes.uncertainty_um is not None:
        extras["uncertainty_um"] = list(probes.uncertainty_um)
    correction = probes.correction
    if correction is not None:
        extras["alignment"] = correction.matrix.tolist()
        if correction.cosines.size:
            extras["run_out_cos_um"] = correction.cosines.tolist()
            extras["run_out_sin_um"] = correction.sines.tolist()
    return extras
