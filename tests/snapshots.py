"""Snapshots of an engine, made by hand: the paper's test, running."""

from __future__ import annotations

import time
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from rigapp.schema.channels import BASE
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import (
    Alarm,
    ChannelView,
    Cycle,
    DeviceView,
    DriveView,
    Event,
    Prediction,
    RunState,
    Severity,
    Snapshot,
    Status,
    as_array,
)
from rigapp.storage import FilePlan, TestMetadata, create_test

RADIUS, LENGTH = 76.2, 203.2
REVOLUTION_NAMES = tuple(column.name for column in BASE.revolution_columns)
PREDICTION_NAMES = tuple(column.name for column in prediction_columns())

ALARM = Alarm(
    key="force_max_high",
    severity=Severity.WARNING,
    title="Force is high",
    cause="force_max is 212 N, warns above 200 N",
    consequence="At 300 N for 3 cycles the test stops",
    action="Look at the joint; lower the speed or stop the test",
    raised_at=1_800_000_000.0,
    revolution=1200,
)


def crank_forces(
    angle_deg: np.ndarray, amplitude: float = 35.0
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return crank-frame components and |F| of something like a spring-loaded slider-crank."""
    turn = np.radians(angle_deg)
    pull = 61.0 - amplitude * np.cos(turn)
    follower = np.arcsin(-RADIUS / LENGTH * np.sin(turn))
    one = -pull * np.cos(turn - follower)
    two = pull * np.sin(turn - follower)
    return one, two, pull


def make_status(**changes: Any) -> Status:
    """Return the status of a running simulated test, with changes."""
    now = time.time()
    base = Status.of_flat(
        {
            "state": RunState.RUNNING,
            "reason": "",
            "rig": "Simulated slider-crank",
            "test": "The paper's wear test",
            "file": "paper-20270101-080000.h5",
            "revolution": 1234,
            "planned": 21377,
            "committed": 1233,
            "first_revolution": 1,
            "target_rpm": 30.0,
            "speed_rpm": 30.02,
            "started_at": 1.8e9,
            "expected_end_at": now + 40286.0,
            "data_age_s": 0.1,
            "host_time": now,
            "simulated": True,
            "simulated_speed": 20.0,
            "worst_margin_percent": 43.0,
            "worst_margin": "force_max to overload",
            "twin_revolution": 1233,
            "twin_age_s": 0.2,
            "residual_rms_N": 1.7,
            "drive": DriveView(30.02, 30.0, 1.4, 48.0, 31.5, True, False, (), ()),
            "devices": (
                DeviceView(
                    "daq", "gsv8", "socket://127.0.0.1:1", True, "GSV-8 1.44", 960.0, 0, 0, ""
                ),
                DeviceView("drive", "roboclaw", "/dev/pts/3", True, "RoboClaw 4.3", 50.0, 0, 0, ""),
            ),
            "channels": (
                ChannelView("force_1", -0.431, "mV/V", -86.2, "N", "rig file", 2.0),
                ChannelView("force_2", 0.022, "mV/V", 4.4, "N", "rig file", 2.0),
                ChannelView("probe_1", 1.21, "V", 121.0, "um", "rig file", None),
                ChannelView("probe_2", -0.13, "V", -13.0, "um", "rig file", None),
            ),
            "operator": "E. Sample",
            "engine_pid": 4711,
        }
    )
    return Status.of_flat(base.flat() | dict(**changes))


def make_rows(first: int, count: int) -> np.ndarray:
    """Return rows of the revolutions first .. first + count - 1."""
    revolution = np.arange(first, first + count, dtype=np.float64)
    rows = np.zeros((count, len(REVOLUTION_NAMES)))
    wear = 2.0 * np.log1p(revolution / 3000.0)
    noise = np.random.default_rng(first).normal(0.0, 0.4, (3, count))
    values = {
        "revolution": revolution,
        "time": 2.0 * revolution,
        "host_time": 1.8e9 + 2.0 * revolution,
        "speed": np.full(count, 30.0),
        "speed_max": np.full(count, 30.2),
        "speed_min": np.full(count, 29.8),
        "force_max": 97.0 - wear + noise[0],
        "force_min": 26.0 + 0.3 * wear + noise[1],
        "force_rms": 71.0 - 0.7 * wear + noise[2],
        "force_1_max": -25.0 + noise[0],
        "force_1_min": -97.0 + wear,
        "force_1_rms": 65.0 - wear,
        "force_2_max": 50.0 + noise[1],
        "force_2_min": -50.0 + noise[2],
        "force_2_rms": 30.0 + noise[0],
        "probe_1_max": 120.0 + 3 * wear,
        "probe_1_min": 80.0 + 3 * wear,
        "probe_1_rms": 100.0 + 3 * wear,
    }
    for name, column in values.items():
        rows[:, REVOLUTION_NAMES.index(name)] = column
    return rows


def make_predictions(first: int, count: int) -> np.ndarray:
    """Return prediction rows of the revolutions first .. first + count - 1."""
    revolution = np.arange(first, first + count, dtype=np.float64)
    rows = np.zeros((count, len(PREDICTION_NAMES)))
    wear = 2.1 * np.log1p(revolution / 3000.0)
    values = {
        "revolution": revolution,
        "residual_rms": np.full(count, 1.7),
        "residual_1_rms": np.full(count, 1.5),
        "residual_2_rms": np.full(count, 0.9),
        "wear_depth": 0.02 * wear,
        "measured_wear_depth": 0.02 * wear + 0.001,
        "measured_wear_depth_uncertainty": np.full(count, 0.0011),
        "force_max": 96.5 - wear,
        "force_min": 26.4 + 0.3 * wear,
        "force_rms": 71.1 - 0.7 * wear,
        "force_1_max": np.full(count, -26.0),
        "force_1_min": -96.5 + wear,
        "force_1_rms": 65.5 - wear,
        "force_2_max": np.full(count, 51.0),
        "force_2_min": np.full(count, -51.0),
        "force_2_rms": np.full(count, 30.0),
        "force_uncertainty": np.full(count, 0.94),
    }
    for name, column in values.items():
        rows[:, PREDICTION_NAMES.index(name)] = column
    return rows


def make_cycle(revolution: int, points: int = 1920) -> Cycle:
    """Return a measured cycle with noise."""
    angle = np.linspace(0.0, 360.0, points, endpoint=False)
    noise = np.random.default_rng(revolution).normal(0.0, 0.7, (2, points))
    one, two, _ = crank_forces(angle, 36.0)
    one, two = one + noise[0], two + noise[1]
    probes = 100.0 + 12.0 * np.cos(np.radians(angle)), 8.0 * np.sin(np.radians(angle))
    names = [channel.name for channel in BASE.channels]
    named = zip(names, (one, two, np.hypot(one, two), *probes), strict=True)
    curves = {name: array.astype("<f4").tobytes() for name, array in named}
    return Cycle(revolution, angle.astype("<f4").tobytes(), curves)


def make_prediction(revolution: int) -> Prediction:
    """Return the model's answer for a cycle."""
    angle = np.arange(360.0)
    curves = [array.astype("<f4").tobytes() for array in crank_forces(angle)]
    return Prediction(revolution, make_predictions(revolution, 1)[0].tobytes(), *curves)


def make_snapshot(
    first: int = 1, count: int = 1233, *, curves: bool = True, **changes: Any
) -> Snapshot:
    """Return a snapshot with rows first .. and the newest curves."""
    last = first + count - 1
    changes.setdefault("revolution", last + 1)
    changes.setdefault("committed", last if count else 0)
    changes.setdefault("twin_revolution", last)
    return Snapshot(
        status=make_status(**changes),
        first_row=first - 1,
        rows=make_rows(first, count).tobytes(),
        predictions=make_predictions(first, count).tobytes(),
        cycle=make_cycle(last) if curves else None,
        prediction=make_prediction(last) if curves else None,
    )


def write_recorded(path: Path) -> None:
    """Write a finished test of 300 revolutions, every tenth whole cycle kept."""
    path.write_bytes(_recorded())
    path.chmod(0o444)


@cache
def _recorded() -> bytes:
    # To make a file takes 0.3 s of processor time and some syncs, to copy it nothing.
    with TemporaryDirectory() as folder:
        path = Path(folder) / "recorded.h5"
        _record(path)
        return path.read_bytes()


def _record(path: Path) -> None:
    plan = FilePlan(revolutions=300, cycles=40, samples_per_cycle=400, events=256)
    text = (Path(__file__).parents[1] / "examples" / "quick.toml").read_text(encoding="utf-8")
    metadata = TestMetadata(
        title="Quick test",
        rig_text='name = "rig"\n',
        test_text=text,
        rig_name="Simulated slider-crank",
        operator="Ann",
        simulated=True,
        started=1_800_000_000.0,
    )
    writer = create_test(path, plan, metadata)
    rows, predictions = make_rows(1, 300), make_predictions(1, 300)
    for index in range(300):
        revolution = index + 1
        kept = revolution % 10 == 0
        if kept:
            writer.append_cycle(revolution, cycle_columns_of(make_cycle(revolution, 400)))
        prediction = make_prediction(revolution)
        sent = {name: as_array(getattr(prediction, name)) for name in plan.predicted_curves}
        curves = {name: curve if len(curve) else np.zeros(360) for name, curve in sent.items()}
        writer.append_prediction(predictions[index], curves if kept else None)
        writer.append_row(rows[index])
    writer.append_event(Event(1.8e9, 120, "note", "Ann", "oil added"))
    writer.commit()
    writer.finish("complete", "complete", "All revolutions are done.")


def cycle_columns_of(cycle: Cycle) -> dict[str, np.ndarray]:
    """Return a cycle message as the columns of a file; what it does not carry is zero."""
    names = [column.name for column in BASE.cycle_columns]
    found = {name: np.zeros(len(as_array(cycle.angle_deg))) for name in names}
    found["angle"] = as_array(cycle.angle_deg)
    return found | {name: as_array(curve) for name, curve in cycle.curves.items()}
