"""The uncertainty of a force: of one sample, of a mean, of a component, of |F|; in the file."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from rigapp_calibration.load_cell.force_uncertainty import (
    ForceUncertainty,
    force_uncertainty,
    noise_of_sample,
    stated_uncertainty,
    uncertainty_record,
)
from rigapp_calibration.records import seal

MATRIX = np.array([[200.0, 5.0], [-3.0, 190.0]])
RECORD = {
    "kind": "load cell",
    "result": {"uncertainty_line_N": {"constant_N": 1.2, "per_N": 0.01}, "coverage_factor": 2.1},
}


def test_samples_scatter_as_is_stated() -> None:
    """95 % of single samples and of means lie within U, components and magnitudes alike."""
    random = np.random.default_rng(3)
    noise, runs, n = 1.5, 4000, 25
    force = np.array([180.0, -240.0])
    size = float(np.hypot(*force))
    stated = ForceUncertainty(2.0 * 0.5, 2.0 * 0.004, 2.0, "test", noise)
    # A calibration's errors: of the zero, of the scale, of the angle; the same for all samples.
    zero = random.normal(0.0, 0.5 / math.sqrt(2.0), (runs, 1, 2))
    scale = random.normal(0.0, 0.004, (runs, 1, 1))
    turn = random.normal(0.0, 0.004, (runs, 1, 1))
    across = np.array([-force[1], force[0]])
    samples = force * (1.0 + scale) + across * turn + zero
    samples = samples + random.normal(0.0, noise, (runs, n, 2))
    for values, truth in (
        (samples[..., 0], force[0]),
        (samples[..., 1], force[1]),
        (np.hypot(samples[..., 0], samples[..., 1]), size),
    ):
        within_one = np.abs(values[:, 0] - truth) <= stated.at(size)
        within_mean = np.abs(values.mean(axis=1) - truth) <= stated.at(size, n)
        assert 0.93 < within_one.mean() < 0.999
        assert 0.93 < within_mean.mean() < 0.999
        # Without the noise of one sample the statement would be wrong.
        assert (np.abs(values[:, 0] - truth) <= stated.at(size, math.inf)).mean() < 0.93


def test_a_record_comes_before_the_rig_file() -> None:
    text = seal(RECORD).decode()
    found = stated_uncertainty(text, (9.0, 0.5))
    assert found is not None
    assert (found.constant_N, found.relative, found.coverage_factor) == (1.2, 0.01, 2.1)
    assert found.source.startswith("record ")
    rig = stated_uncertainty(text.replace("1.2", "1.3"), (9.0, 0.5))
    assert rig == ForceUncertainty(9.0, 0.5, 2.0, "rig file")
    assert stated_uncertainty("", None) is None
    assert stated_uncertainty("", (math.nan, 0.1)) is None


def test_a_record_states_the_magnitude_for_itself() -> None:
    lines = {
        "component": {"constant_N": 0.3, "per_N": 0.002},
        "magnitude": {"constant_N": 0.3, "per_N": 0.0005},
    }
    record = {**RECORD, "result": {**RECORD["result"], "uncertainty_lines_of_mean_N": lines}}
    found = stated_uncertainty(seal(record).decode(), None)
    assert found is not None
    assert float(found.at(400.0)) == pytest.approx(1.1)
    assert float(found.at(400.0, of_magnitude=True)) == pytest.approx(0.5)
    kept = uncertainty_record(found, 0.8, "signals at rest before the start", 400.0)
    again = force_uncertainty({"force_uncertainty": kept}, {})
    assert again is not None
    assert again.magnitude == (0.3, 0.0005)
    one = float(again.at(400.0, of_magnitude=True))
    assert one == pytest.approx(math.hypot(0.5, 1.96 * 0.8), rel=1e-3)


def test_u_by_load_is_taken_between_the_loads_and_the_line_beyond() -> None:
    by_load = [
        {"load_N": 0.0, "magnitude_mean_of_many_N": 0.2, "across_mean_of_many_N": 0.2},
        {"load_N": 200.0, "magnitude_mean_of_many_N": 0.4, "across_mean_of_many_N": 1.0},
        {"load_N": 400.0, "magnitude_mean_of_many_N": 0.5, "across_mean_of_many_N": 2.0},
    ]
    lines = {
        "component": {"constant_N": 0.3, "per_N": 0.005},
        "magnitude": {"constant_N": 0.3, "per_N": 0.001},
    }
    result = {
        **RECORD["result"], "uncertainty_lines_of_mean_N": lines, "uncertainty_by_load": by_load,
    }  # fmt: skip
    stated = stated_uncertainty(seal({**RECORD, "result": result}).decode(), None)
    assert stated is not None
    kept = uncertainty_record(stated, 0.0, "nothing", 400.0)
    found = force_uncertainty({"force_uncertainty": kept}, {})
    assert found is not None
    assert found.by_load == stated.by_load
    assert found.at([100.0, 300.0], of_magnitude=True) == pytest.approx([0.3, 0.45])
    assert found.at(300.0) == pytest.approx(1.5)
    # A component along the force, square to it, and half way.
    assert found.at(300.0, component=[300.0, 0.0]) == pytest.approx([0.45, 1.5])
    half = math.sqrt(0.5)
    assert found.at(300.0, component=300.0 * half) == pytest.approx(half * math.hypot(0.45, 1.5))
    assert found.at(500.0) == pytest.approx(2.8)


def test_noise_is_seen_at_rest_or_is_that_of_the_steps() -> None:
    seen, source = noise_of_sample(MATRIX, (0.01, 0.0), 2.0)
    assert seen == pytest.approx(2.0)
    assert "rest" in source
    for nothing in (None, (0.0, 0.0), (math.nan, 0.1)):
        steps, source = noise_of_sample(MATRIX, nothing, 2.0)
        assert steps == pytest.approx(2.0 / math.sqrt(12.0))
        assert "resolution" in source


def test_numbers_of_the_file_are_read_back() -> None:
    stated = ForceUncertainty(1.5, 0.01, 2.0, "rig file")
    kept = uncertainty_record(stated, 0.8, "signals at rest before the start", 400.0)
    found = force_uncertainty({"force_uncertainty": kept}, {})
    assert found == ForceUncertainty(1.5, 0.01, 2.0, "rig file", 0.8)
    assert kept["one_sample_N"] == found.at(kept["force_N"]).tolist()
    assert kept["mean_of_many_N"] == [1.5, 2.5, 3.5, 4.5, 5.5]
    assert kept["one_sample_N"][-1] == pytest.approx(math.hypot(5.5, 1.6))
    unknown = uncertainty_record(None, 0.8, "resolution of the load cell", 400.0)
    assert math.isnan(unknown["constant_N"])
    assert unknown["noise_N"] == 0.8
    assert force_uncertainty({"force_uncertainty": unknown}, {"rig": ""}) is None


def test_info_tells_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import h5py

    from rigapp.commands.files import print_info
    from rigapp.storage import FilePlan, TestMetadata, create_test

    stated = ForceUncertainty(1.5, 0.01, 2.0, "rig file")
    for name, kept in (
        ("known", uncertainty_record(stated, 0.8, "signals at rest", 400.0)),
        ("unknown", uncertainty_record(None, 0.8, "signals at rest", 400.0)),
    ):
        path = tmp_path / f"{name}.h5"
        about = TestMetadata("A test", "", "", calibration={"force_uncertainty": kept})
        plan = FilePlan(10, cycles=2, samples_per_cycle=20, prediction=False)
        with create_test(path, plan, about) as writer:
            writer.finish("stopped", "operator", "stopped")
        assert print_info(path, as_json=True) == 0
        shown = json.loads(capsys.readouterr().out)["force_uncertainty"]
        assert (shown is None) == (name == "unknown")
        with h5py.File(path) as file:
            columns = {
                "revolutions/force_max": ("one sample of |F|", "1"),
                "revolutions/force_2_min": ("one sample of one component", "1"),
                "revolutions/force_mean": ("a mean of n samples of |F|", "samples"),
                "revolutions/force_1_rms": ("a mean of n samples of one component", "samples"),
                "cycles/force_1": ("one sample of one component", "1"),
                "cycles/force": ("one sample of |F|", "1"),
            }
            for column, told in columns.items():
                attributes = file[f"/entry/{column}"].attrs
                assert attributes["uncertainty"] in file
                assert told == (
                    attributes["uncertainty_of"],
                    attributes["uncertainty_samples"],
                ), column
            for column in ("revolutions/probe_1_max", "prediction/force_max", "cycles/raw_force_1"):
                assert "uncertainty" not in file[f"/entry/{column}"].attrs
    assert print_info(tmp_path / "known.h5", as_json=False) == 0
    assert "U(F) = 1.50 N + 0.01000 |F|, k = 2.00 (rig file)" in capsys.readouterr().out
