"""Make test files with data like a rig's, quickly, for the tests of the report."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rigapp.schema.columns import AGREEMENT, JOINT_CURVES
from rigapp.schema.messages import Event, Flag
from rigapp.storage import FilePlan, TestMetadata, TestWriter, create_test
from rigapp_calibration.records import seal

STARTED = 1_800_000_000.0
RPM = 60.0
TEST_TEXT = """# A wear test.
schema = 1
title = "PTFE, dry"

[run]
revolutions = 400
speed_rpm = 60.0

[limits]
overload_N = 200.0
overspeed_rpm = 90.0

[[limits.rule]]
quantity = "force_max"
warning_above = 95.0
critical_above = 120.0
"""
RECORD = seal(
    {
        "kind": "load cell",
        "calibrated_at": "2026-03-02T09:00:00Z",
        "due_at": "2027-03-02T09:00:00Z",
        "settings": {"cell": {"name": "pin cell 17"}, "paperwork": {"serial_number": "S-4711"}},
        "result": {"expanded_uncertainty_N": 2.345, "coverage_factor": 2.05},
    }
).decode()
CALIBRATION = {
    "load_cell": {
        "record": "LC-17 2026-03-02",
        "matrix_N_per_mV_per_V": [[200.0, 1.5], [-0.8, 199.2]],
        "zero_mV_per_V": [0.0123, -0.0045],
        "tare_mV_per_V": [0.0, 0.0],
        "frame": "crank",
    },
    "probes": {"record": "P-3", "sensitivity_um_per_V": [100.0, 101.0], "offset_V": [0.0, 0.1]},
    "record_load_cell": {"record": RECORD},
    "record_probes": {"record": RECORD.replace("4711", "4712")},
    "device_daq": {"sample_rate_Hz": 960.0, "speed_limit_count_per_s": 44000, "object_map": "a, b"},
}
ANGLES = np.arange(360.0)


def metadata(title: str = "PTFE, dry") -> TestMetadata:
    """Return the metadata of a test."""
    return TestMetadata(
        title=title,
        rig_text='name = "Rig 2 <main hall>"\n',
        test_text=TEST_TEXT,
        parameters={"mechanism": {"crank_radius_mm": 76.2}, "spring": None},
        calibration=CALIBRATION,
        rig_name="Rig 2 <main hall>",
        operator="Ann O'Hara & Bjørn",
        specimen="PTFE 1",
        bushing="PTFE, virgin",
        notes="first of three",
        started=STARTED,
        identifier="11111111-2222-3333-4444-555555555555",
    )


def curves(angle: NDArray[np.float64], wear: float = 0.0) -> dict[str, NDArray[np.float64]]:
    """Return forces over the crank angle in N."""
    t = np.radians(angle)
    one = 20.0 + 60.0 * np.cos(t) + 8.0 * np.cos(2 * t)
    two = 50.0 * np.sin(t) + (4.0 + wear) * np.sin(3 * t)
    return {"force_1": one, "force_2": two, "force": np.hypot(one, two)}


def row(plan: FilePlan, revolution: int, quality: int = 0, time: float = 0.0) -> dict[str, float]:
    """Return the statistics of a revolution by name."""
    found = {
        "revolution": float(revolution),
        "time": time or revolution * 60.0 / RPM,
        "host_time": STARTED + (time or revolution * 60.0 / RPM),
        "speed": RPM,
        "speed_max": RPM + 1.0,
        "speed_min": RPM - 1.0,
        "speed_rms": RPM,
        "samples": 960.0,
        "lost_samples": 0.0,
        "quality": float(quality),
    }
    values = {
        **curves(ANGLES, revolution / 200.0),
        "probe_1": -500.0 + 4.0 * np.sin(np.radians(ANGLES)) - revolution / 20.0,
        "probe_2": 26.0 + 7.0 * np.cos(np.radians(ANGLES)),
    }
    for name, array in values.items():
        found |= {
            f"{name}_max": array.max(),
            f"{name}_min": array.min(),
            f"{name}_rms": math.sqrt(np.mean(array**2)),
            f"{name}_mean": array.mean(),
            f"{name}_angle_of_max": float(np.argmax(array)),
        }
    return {one.name: float(found[one.name]) for one in plan.revolution_columns}


def prediction(plan: FilePlan, revolution: int, measured_wear: bool) -> dict[str, float]:
    """Return the predicted row of a revolution by name."""
    found = {
        "revolution": float(revolution),
        "residual_rms": 1.5 + 0.2 * math.sin(revolution / 20.0),
        "residual_1_rms": 1.1,
        "residual_2_rms": 1.2,
        "phase_shift": -0.35,
        "wear_depth": 2.0e-5 * revolution,
        "driven_wear_depth": 2.2e-5 * revolution,
        "measured_wear_depth": 2.5e-5 * revolution if measured_wear else math.nan,
        "measured_wear_depth_uncertainty": 4e-4 if measured_wear else math.nan,
        "force_uncertainty": 0.8,
        "unfollowed_acceleration": 0.0,
    }
    for name, array in curves(ANGLES).items():
        found |= {
            f"{name}_max": array.max(),
            f"{name}_min": array.min(),
            f"{name}_rms": math.sqrt(np.mean(array**2)),
        }
    return {one.name: float(found.get(one.name, math.nan)) for one in plan.prediction_columns}


def cycle(plan: FilePlan, revolution: int, samples: int = 960) -> dict[str, NDArray[np.float64]]:
    """Return the samples of a whole cycle, noise included."""
    noise = np.random.default_rng(revolution)
    angle = np.arange(samples) * 360.0 / samples
    found = {name: np.zeros(samples) for name in (one.name for one in plan.cycle_columns)}
    found["angle"] = angle
    found["time"] = revolution + angle / 360.0
    for name, values in curves(angle, revolution / 200.0).items():
        found[name] = values + noise.normal(0.0, 0.8, samples)
    found["probe_1"] = -500.0 + 4.0 * np.sin(np.radians(angle)) - revolution / 20.0
    found["probe_2"] = 26.0 + 7.0 * np.cos(np.radians(angle))
    return found


def append(
    writer: TestWriter, revolution: int, quality: int = 0, time: float = 0.0,
    keep: bool = False, model: bool = True, measured_wear: bool = True, lost: int = 0,
) -> None:  # fmt: skip
    """Append a revolution, its prediction, and its whole cycle when ``keep``."""
    plan = writer.plan
    values = row(plan, revolution, quality, time)
    values["lost_samples"] = float(lost)
    if keep:
        writer.append_cycle(revolution, cycle(plan, revolution))
    writer.append_row(list(values.values()))
    if model:
        predicted = prediction(plan, revolution, measured_wear)
        unknown = {one.name: np.full(ANGLES.size, np.nan) for one in (*JOINT_CURVES, AGREEMENT)}
        known = {**unknown, **curves(ANGLES)}
        kept = {name: one.astype(np.float32) for name, one in known.items()}
        writer.append_prediction(list(predicted.values()), kept if keep else None)


def event(revolution: int, kind: str, source: str, text: str, *values: str) -> Event:
    """Return an event at the time of a revolution."""
    return Event(STARTED + revolution * 60.0 / RPM, revolution, kind, source, text, *values)


def new_test(path: Path, revolutions: int = 400, cycles: int = 12) -> TestWriter:
    """Create a test file."""
    plan = FilePlan(revolutions, cycles=cycles, samples_per_cycle=960, events=512)
    return create_test(path, plan, metadata())


def eventful(path: Path) -> Path:
    """Write a test in which much happened: a gap, a pause, alarms, changes; stopped by a limit."""
    cause = "force_max is 121.5, above the critical limit 121."
    with new_test(path) as writer:
        writer.append_event(event(0, "state", "engine", "started by Ann", "", "starting"))
        for revolution in range(1, 201):
            quality = {1: int(Flag.RAMP), 90: int(Flag.LOST_SAMPLES)}.get(revolution, 0)
            append(writer, revolution, quality, keep=revolution % 40 == 0,
                   lost=7 if revolution == 90 else 0)  # fmt: skip
        writer.append_event(event(50, "note", "Ann", "squeak <heard> at 50, ≈ 3 kHz"))
        writer.append_event(
            event(120, "limit_changed", "Bjørn", "limit force_max.critical_above changed: wear-in",
                  "120", "121")
        )  # fmt: skip
        text = "force_max above limit: raised. force_max is 95.2, above the warning limit 95."
        writer.append_event(event(150, "alarm", "engine", text, "", "unacknowledged"))
        text = text.replace("raised", "acknowledged")
        writer.append_event(event(160, "alarm", "Ann", text, "", "acknowledged"))
        writer.append_event(event(170, "alarm", "engine", text.replace("acknowledged", "cleared")))
        for revolution in range(206, 301):
            gap = int(Flag.GAP_BEFORE) if revolution == 206 else 0
            append(writer, revolution, gap, time=revolution + 30.0, keep=revolution % 40 == 0)
        writer.note_gap(event(206, "gap", "storage", "the test was resumed after revolution 200"))
        text = f"force_max above limit: raised. {cause}"
        writer.append_event(event(300, "alarm", "engine", text, "", "unacknowledged"))
        writer.append_event(event(300, "state", "engine", cause, "", "stopping"))
        writer.finish("stopped", "limit", cause)
    return path
