"""Make small tests with content that each row's number determines."""

from __future__ import annotations

import os
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.channels import BASE, ChannelTable
from rigapp.schema.columns import PREDICTED_CURVES, prediction_columns
from rigapp.schema.messages import Event
from rigapp.storage import FilePlan, TestMetadata, TestReader, TestWriter, create_test
from rigapp.storage.structure.build import build_file
from rigapp.storage.writing import create

FULL = FilePlan(
    revolutions=300, cycles=40, samples_per_cycle=50, events=256, checksums=True, waiting_cycles=4
)
"""Every channel and every column of the prediction."""
FORCES = ChannelTable(tuple(one for one in BASE.channels if "force" in one.name))
PLAN = replace(
    FULL,
    channels=FORCES.channels,
    revolution_columns=FORCES.revolution_columns,
    cycle_columns=FORCES.cycle_columns,
    prediction_columns=prediction_columns()[:6],
    predicted_curves=PREDICTED_CURVES[:3],
)
"""With half as many columns, a file is made, written and checked in half the time."""
METADATA = TestMetadata(
    title="A test",
    rig_text='name = "rig"\n',
    test_text='title = "A test"\n',
    parameters={"mechanism": {"crank_radius_mm": 76.2}, "spring": None},
    calibration={"load_cell": {"matrix_N_per_mV_per_V": [[200.0, 0.0], [0.0, 200.0]]}},
    rig_name="rig",
    operator="Ann",
    specimen="PTFE 1",
    bushing="PTFE",
    notes="first",
    started=1_800_000_000.0,
)


def row(revolution: int, plan: FilePlan = PLAN) -> NDArray[np.float64]:
    """Return the statistics of a revolution."""
    values = revolution + np.arange(len(plan.revolution_columns)) / 64.0
    values[[one.name == "quality" for one in plan.revolution_columns]] = revolution % 7
    return values


def prediction(revolution: int, plan: FilePlan = PLAN) -> NDArray[np.float64]:
    """Return the predicted row of a revolution."""
    return revolution - np.arange(len(plan.prediction_columns)) / 64.0


def curves(revolution: int, plan: FilePlan = PLAN) -> NDArray[np.float32]:
    """Return the predicted curves of a revolution."""
    number = len(plan.predicted_curves)
    grid = np.arange(number * plan.prediction_points, dtype=np.float32)
    return (grid + revolution).reshape(number, plan.prediction_points)


def cycle(revolution: int, plan: FilePlan = PLAN) -> NDArray[np.float64]:
    """Return a whole cycle of a revolution; its length varies a little."""
    samples = plan.samples_per_cycle + revolution % 3
    grid = np.arange(len(plan.cycle_columns) * samples, dtype=np.float64)
    return (grid / 4.0 + revolution).reshape(len(plan.cycle_columns), samples)


def new_test(folder: Path, plan: FilePlan = PLAN, name: str = "test.h5") -> TestWriter:
    """Create a test file; its structure is built once and copied from then on."""
    with patch.object(create, "build_file", _copy_built_file):
        return create_test(folder / name, plan, METADATA)


def _copy_built_file(path: Path, plan: FilePlan, metadata: TestMetadata, name: str) -> None:
    length, parts = _built_file(plan, name)
    with path.open("xb") as file:
        file.truncate(length)
        for offset, part in parts:
            file.seek(offset)
            file.write(part)


@cache
def _built_file(plan: FilePlan, name: str) -> tuple[int, list[tuple[int, bytes]]]:
    """Return the length of a new file and what lies between its holes, which stay holes."""
    parts = []
    with TemporaryDirectory() as folder:
        path = Path(folder) / name
        build_file(path, plan, METADATA, name)
        length, offset = path.stat().st_size, 0
        with path.open("rb") as file:
            while offset < length:
                try:
                    start = os.lseek(file.fileno(), offset, os.SEEK_DATA)
                except OSError:  # nothing more but a hole
                    break
                offset = os.lseek(file.fileno(), start, os.SEEK_HOLE)
                parts.append((start, os.pread(file.fileno(), offset - start, start)))
    return length, parts


def write(writer: TestWriter, first: int, last: int, every: int = 10) -> None:
    """Append the revolutions first .. last, each ``every``-th with its whole cycle and curves."""
    for revolution in range(first, last + 1):
        kept = revolution % every == 0
        if kept:
            writer.append_cycle(revolution, cycle(revolution, writer.plan))
        writer.append_prediction(
            prediction(revolution, writer.plan), curves(revolution, writer.plan) if kept else None
        )
        writer.append_row(row(revolution, writer.plan))


def check(reader: TestReader, first: int = 1, every: int = 10) -> int:
    """Assert that everything committed is what ``write`` wrote; return the committed rows."""
    plan = reader.plan
    number = reader.committed()
    expected = np.array([row(first + i, plan) for i in range(number)]).reshape(
        number, len(plan.revolution_columns)
    )
    for place, (name, values) in enumerate(reader.rows().items()):
        np.testing.assert_array_equal(values, expected[:, place].astype(values.dtype), name)
    for stored in reader.cycles():
        assert stored.revolution % every == 0
        wanted = cycle(stored.revolution, plan)
        for place, values in enumerate(stored.columns.values()):
            np.testing.assert_array_equal(values, wanted[place].astype(values.dtype))
        found = reader.predicted_curve(stored.revolution)
        if found is not None:
            wanted_curves = curves(stored.revolution, plan)
            for place, name in enumerate(plan.predicted_curves):
                np.testing.assert_array_equal(found[name], wanted_curves[place])
    for i, revolution in enumerate(reader.predictions()["revolution"]):
        assert revolution == first + i
    return number


def ended(
    folder: Path, revolutions: int = 150, status: str = "complete", plan: FilePlan = PLAN
) -> Path:
    """Return the file of a test that has ended."""
    path = folder / "test.h5"
    path.write_bytes(_ended(revolutions, status, plan))
    path.chmod(0o444)
    return path


@cache
def _ended(revolutions: int, status: str, plan: FilePlan) -> bytes:
    # To make a file takes 0.3 s of processor time, to copy it nothing.
    with TemporaryDirectory() as folder:
        with new_test(Path(folder), plan) as writer:
            writer.append_event(Event(1.0, 0, "started", "operator", "g" * 300))
            write(writer, 1, revolutions)
            writer.finish(status, status, "done")
        return (Path(folder) / "test.h5").read_bytes()
