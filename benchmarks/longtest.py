"""Make the files of long tests in seconds: every column filled, whole cycles and log as usual.

The writer makes the file; its columns are filled by h5py, block by block, which is quicker than a
test. Rows are a smooth course with noise, so that they compress no better than measured values.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any, BinaryIO

import h5py
import numpy as np
from numpy.typing import NDArray

from rigapp.schema.messages import Event
from rigapp.storage import FilePlan, TestMetadata, create_test, profile_rows, reopen_test

SAMPLES = 3600
BLOCK = 1 << 18
EVENTS = 200
CYCLES = 60
SEED = 34
EXAMPLES = Path(__file__).parents[1] / "examples"


def make_long_test(path: Path, rows: int, *, ended: bool = False) -> None:
    """Write a test of ``rows`` revolutions, interrupted one before its planned end.

    ended: the test was stopped there and its file closed, in place as on the rig.
    """
    recipe = (EXAMPLES / "quick.toml").read_text("utf-8")
    recipe = re.sub(r"(?m)^revolutions = \d+", f"revolutions = {rows + 1}", recipe, count=1)
    rig = (EXAMPLES / "simulated.toml").read_text("utf-8")
    plan = FilePlan(
        rows + 1, CYCLES, SAMPLES, cycle_reason=True, event_details=True,
        profiles=profile_rows(rows),
    )  # fmt: skip
    about = TestMetadata(title="A long test", rig_text=rig, test_text=recipe, operator="bench")
    with create_test(path, plan, about) as writer:
        for number in np.linspace(1, rows, CYCLES).astype(int).tolist():
            writer.append_cycle(number, _cycle(number, plan))
            writer.append_curves(number, _curves(plan))
        for number in np.linspace(1, rows, EVENTS).astype(int).tolist():
            writer.append_event(Event(1e9 + number, number, "note", "bench", "oil added"))
        writer.commit()
    path.chmod(0o644)
    # At their offsets: only the writer changes the visible length of a column.
    with h5py.File(path, "r") as file, path.open("r+b") as raw:
        for group, columns in (
            ("revolutions", plan.revolution_columns),
            ("prediction", plan.prediction_columns),
        ):
            for at, column in enumerate(columns):
                _fill(raw, file[f"/entry/{group}/{column.name}"], column.name, rows, at)
            raw.seek(file[f"/entry/{group}/committed"].id.get_offset())
            raw.write(rows.to_bytes(8, "little"))
    if ended:
        with reopen_test(path) as writer:
            writer.finish("stopped", "operator", "The operator stopped the test.")


def _fill(raw: BinaryIO, dataset: h5py.Dataset, name: str, rows: int, at: int) -> None:
    """Fill one column: numbers count, times increase, all else drifts and is noisy."""
    noise = np.random.default_rng(SEED + at)
    raw.seek(dataset.id.get_offset())
    for first in range(0, rows, BLOCK):
        number = np.arange(first + 1, min(rows, first + BLOCK) + 1, dtype=np.float64)
        raw.write(_values(name, number, rows, noise).astype(dataset.dtype).tobytes())


def _values(
    name: str, number: NDArray[np.float64], rows: int, noise: np.random.Generator
) -> NDArray[Any]:
    known = {
        "revolution": lambda: number,
        "time": lambda: number,
        "host_time": lambda: 1e9 + number,
        "speed": lambda: 60.0 + noise.normal(0.0, 0.01, len(number)),
        "samples": lambda: np.full(len(number), SAMPLES),
        "lost_samples": lambda: np.zeros(len(number)),
        "quality": lambda: np.zeros(len(number)),
        "wear_depth": lambda: 0.4 * number / rows,
        "measured_wear_depth": lambda: 0.4 * number / rows + noise.normal(0.0, 1e-3, len(number)),
        "measured_wear_depth_uncertainty": lambda: np.full(len(number), 2e-3),
        "wear_coefficient": lambda: np.full(len(number), 5e-4),
        "wear_coefficient_low": lambda: np.full(len(number), 4e-4),
        "wear_coefficient_high": lambda: np.full(len(number), 6e-4),
        "wear_model": lambda: np.zeros(len(number)),
        "wear_model_weight": lambda: np.full(len(number), 0.9),
        "deviation_cause": lambda: np.zeros(len(number)),
    }
    if name in known:
        return np.asarray(known[name]())
    return 80.0 + 10.0 * number / rows + noise.normal(0.0, 1.0, len(number))


def _cycle(number: int, plan: FilePlan) -> dict[str, NDArray[Any]]:
    noise = np.random.default_rng(number)
    angle = np.linspace(0.0, 360.0, SAMPLES, endpoint=False)
    wave = 60.0 * np.sin(np.radians(angle)) + noise.normal(0.0, 1.0, SAMPLES)
    return {
        column.name: (angle if column.name == "angle" else wave).astype(column.dtype)
        for column in plan.cycle_columns
    }


def _curves(plan: FilePlan) -> dict[str, NDArray[Any]]:
    angle = np.linspace(0.0, 2.0 * np.pi, plan.prediction_points, endpoint=False)
    return dict.fromkeys(plan.predicted_curves, 60.0 * np.sin(angle))


if __name__ == "__main__":
    make_long_test(Path(sys.argv[1]), int(sys.argv[2]), ended="ended" in sys.argv[3:])
