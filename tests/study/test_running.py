"""Studies on workers: the same whoever dies on the way."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest
import xarray
from patience import PATIENCE_S
from study.studies import PRESSURE, command, started, written

LONG = """schema = 1
kind = "life"
parameters = "parameters.toml"
[run]
rpm = 30.0
cycles = 23000
[vary]
"joint.bushing_radius_mm" = { low = 9.6, high = 10.5 }
"bushing.wear_coefficient_mm3_per_Nm" = { low = 1e-4, high = 1e-3, scale = "log" }
[design]
kind = "sobol"
points = 128
"""
"""Seconds of a core: enough to come between."""


def table(folder: Path) -> xarray.Dataset:
    with xarray.open_dataset(folder / "table.nc", engine="h5netcdf") as data:
        return data.load()


def rows(folder: Path) -> int:
    path = folder / "rows.jsonl"
    return path.read_bytes().count(b"\n") if path.exists() else 0


def wait_for_rows(process: subprocess.Popen[str], folder: Path, more_than: int) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while rows(folder) <= more_than:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < deadline, f"{rows(folder)} rows"
        time.sleep(0.02)


def workers(process: subprocess.Popen[str]) -> list[psutil.Process]:
    return [
        one
        for one in psutil.Process(process.pid).children(recursive=True)
        if any("spawn_main" in word for word in one.cmdline())
    ]


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a study that nobody disturbed."""
    folder = tmp_path_factory.mktemp("whole")
    done = subprocess.run(
        command(written(folder, LONG), folder / "out", "--workers", "1"),
        capture_output=True, text=True, timeout=PATIENCE_S, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert "128 of 128 points are done, 128 with a result." in done.stdout
    return folder / "out"


@pytest.mark.long
def test_the_table_opens_with_names_units_and_what_it_was_made_of(whole: Path) -> None:
    data = table(whole)
    assert data.sizes["point"] == 128
    assert data["max_depth_mm"].attrs["units"] == "mm"
    assert data["joint.bushing_radius_mm"].attrs["units"] == "mm"
    assert data.attrs["study"] == LONG
    assert data.attrs["source"].startswith("rigapp ")
    assert set(data["problem"].values.tolist()) == {""}
    total = data["sensitivity_total"].sel(result="max_depth_mm")
    assert total.values[1] > 5.0 * total.values[0], "the coefficient decides"
    assert {one.name for one in whole.iterdir()} == {
        "rows.jsonl", "study.json", "table.nc", "table.csv", "results.png", "sensitivities.png",
    }  # fmt: skip
    assert len((whole / "table.csv").read_text().splitlines()) == 129


@pytest.mark.long
def test_a_killed_study_goes_on_where_it_was(whole: Path, tmp_path: Path) -> None:
    study, out = written(tmp_path, LONG), tmp_path / "out"
    first = started(study, out, "--workers", "1")
    try:
        wait_for_rows(first, out, 5)
    finally:
        os.killpg(first.pid, signal.SIGKILL)
        first.communicate()
    safe = rows(out)
    assert 0 < safe < 128
    second = started(study, out, "--workers", "1")
    words, errors = second.communicate(timeout=PATIENCE_S)
    assert second.returncode == 0, errors
    assert "128 of 128" in words
    assert rows(out) == 128, "nothing was computed twice"
    xarray.testing.assert_identical(table(out), table(whole))


@pytest.mark.long
def test_workers_that_die_one_after_another_change_nothing(whole: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    process = started(written(tmp_path, LONG), out, "--workers", "2")
    try:
        for _ in range(3):
            wait_for_rows(process, out, rows(out) + 3)
            workers(process)[0].kill()
        words, errors = process.communicate(timeout=PATIENCE_S)
    finally:
        process.kill()
    assert process.returncode == 0, errors
    assert "128 with a result" in words
    xarray.testing.assert_identical(table(out), table(whole))


@pytest.mark.long
def test_an_interrupt_leaves_tables_and_a_scheduler_elsewhere_goes_on(
    whole: Path, tmp_path: Path
) -> None:
    study, out = written(tmp_path, LONG), tmp_path / "out"
    first = started(study, out, "--workers", "1")
    wait_for_rows(first, out, 5)
    first.send_signal(signal.SIGINT)
    _, errors = first.communicate(timeout=PATIENCE_S)
    assert first.returncode == 1
    assert "what is done is safe" in errors
    assert "Traceback" not in errors
    assert "not computed yet" in table(out)["problem"].values.tolist()
    script = (
        "from distributed import LocalCluster\n"
        "if __name__ == '__main__':\n"
        "    cluster = LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None)\n"
        "    print(cluster.scheduler_address, flush=True)\n"
        "    input()\n"
        "    cluster.close()\n"
    )
    path = tmp_path / "cluster.py"
    path.write_text(script, "utf-8")
    elsewhere = subprocess.Popen(
        [sys.executable, str(path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    try:
        assert elsewhere.stdout is not None
        address = elsewhere.stdout.readline().strip()
        assert re.fullmatch(r"tcp://127\.0\.0\.1:\d+", address)
        second = started(study, out, "--scheduler", address)
        _, errors = second.communicate(timeout=PATIENCE_S)
        assert second.returncode == 0, errors
    finally:
        elsewhere.communicate("\n", timeout=PATIENCE_S)
    xarray.testing.assert_identical(table(out), table(whole))


@pytest.mark.long
def test_points_without_a_result_are_told_and_a_silent_scheduler_too(tmp_path: Path) -> None:
    text = PRESSURE.partition("[vary]")[0] + '[vary]\n"joint.bushing_radius_mm" = [10.0, 9.0]\n'
    done = subprocess.run(
        command(written(tmp_path, text), tmp_path / "out", "--workers", "1"),
        capture_output=True, text=True, timeout=PATIENCE_S, check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert "1 have none; the column `problem` says why." in done.stdout
    assert "the pin must fit" in str(table(tmp_path / "out")["problem"].values[1])
    done = subprocess.run(
        command(tmp_path / "study.toml", tmp_path / "new", "--scheduler", "nowhere"),
        capture_output=True, text=True, timeout=PATIENCE_S, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "--scheduler nowhere: no Dask scheduler answers there" in done.stderr
