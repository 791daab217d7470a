"""Worn profile, uncertainty of forces, triggered cycles and the twin's gaps in the report."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from report_samples import CALIBRATION, append, cycle, event, metadata
from reportpage import Page, read

from rigapp.commands.files import write_report
from rigapp.report.testreport.worn import extent_of
from rigapp.schema.columns import PROFILE_ANGLES_DEG, profile_columns
from rigapp.storage import FilePlan, create_test
from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty
from rigapp_calibration.records import seal

ANGLES = np.asarray(PROFILE_ANGLES_DEG, dtype=np.float64)
JOINT = {"bushing_radius_mm": 10.0, "bushing_width_mm": 13.1}
PARAMETERS = {"joint": JOINT, "bushing": {"density_g_per_cm3": 2.2}}
RESULT = {
    "uncertainty_line_N": {"constant_N": 1.9, "per_N": 0.012},
    "uncertainty_lines_of_mean_N": {
        "component": {"constant_N": 1.5, "per_N": 0.01},
        "magnitude": {"constant_N": 0.5, "per_N": 0.004},
    },
    "coverage_factor": 2.04,
    "expanded_uncertainty_N": 5.5,
}
KEPT = (
    (20, "scheduled"), (27, "before"), (28, "trigger"), (29, "after"),
    (40, "scheduled"), (45, "trigger"), (46, "after"), (60, "last"),
)  # fmt: skip
RECORD = seal({"kind": "load cell", "settings": {}, "result": RESULT}).decode()


def depths(deepest_mm: float) -> dict[str, np.ndarray]:
    """Parabolas of 20 degrees half width; the measured one leans and ends where it was seen."""

    def parabola(at: float, depth: float) -> np.ndarray:
        return np.maximum(depth * (1.0 - ((ANGLES - at) / 20.0) ** 2), 0.0)

    measured = parabola(-3.0, deepest_mm)
    measured[np.abs(ANGLES + 3.0) > 20.0] = np.nan
    return {
        "measured": measured,
        "predicted": parabola(0.0, 1.1 * deepest_mm),
        "driven": parabola(0.0, 1.05 * deepest_mm),
        "uncertainty": np.full(ANGLES.size, 0.002),
    }


@pytest.fixture(scope="module")
def worn_file(quick_folder: Path) -> Path:
    plan = FilePlan(
        60, cycles=20, samples_per_cycle=200, events=256,
        profiles=40, cycle_reason=True, unfinished_samples=2000,
    )  # fmt: skip
    about = replace(
        metadata("Worn"),
        parameters=PARAMETERS,
        calibration={**CALIBRATION, "record_load_cell": {"record": RECORD}},
    )
    path = quick_folder / "worn.h5"
    with create_test(path, plan, about) as writer:
        for revolution in range(1, 61):
            append(writer, revolution)
            if revolution in (1, 10, 30, 60):
                values = dict.fromkeys((one.name for one in profile_columns()), 1.0)
                values |= {"revolution": revolution, "revolutions": 4, "run_out": 3.02}
                values["approach_change"] = -2.5
                writer.append_profile(list(values.values()), depths(0.001 * revolution))
        for revolution, why in KEPT:
            columns = cycle(plan, revolution, 200)
            writer.append_cycle(revolution, columns, why, 8 if revolution == 28 else 0)
        writer.append_unfinished(61, cycle(plan, 61, 90), 64)
        text = "revolutions 33 to 35: 3 not predicted, the twin could not keep up"
        writer.append_event(event(36, "twin", "twin", text))
        writer.finish("stopped", "operator", "Stopped by Ann.")
    return path


@pytest.fixture(scope="module")
def page(worn_file: Path, quick_folder: Path) -> Page:
    target = quick_folder / "worn.html"
    assert write_report(worn_file, target) == 0
    return read(target.read_bytes())


def test_worn_profile_in_numbers_and_as_a_picture(page: Page) -> None:
    rows = {row[0]: row[1:] for row in page.rows("Wear")}
    measured = rows["measured (probes)"]
    profile = next(row for row in page.rows("Wear") if row[1].startswith("60.00 ±"))
    assert profile[:5] == ["measured (probes)", "60.00 ± 2.00", "-3", "-22", "16"]
    assert measured
    area = float(profile[5])
    expected = 4.0 / 3.0 * 0.06 * np.radians(20.0) * 10.0
    assert area == pytest.approx(expected, rel=0.01)
    assert float(profile[6]) == pytest.approx(area * 13.1 * 2.2, rel=1e-3)
    words = [image["alt"] for image in page.images if image["alt"].startswith("Worn profile")]
    assert "measured (probes) at most 60.00 µm at -3°" in words[0]
    assert "the pin never reached are unknown" in page.text
    assert "A run-out of 3.0 µm was taken out" in page.text
    assert "has changed by -2.5 µm; this was taken out" in page.text


def test_uncertainty_of_forces_is_stated(page: Page) -> None:
    stated = page.value("Summary", "Uncertainty of a force")
    assert stated.startswith("U(F) = 1.50 N + 0.01000 |F|, k = 1.96 (record ")
    largest = page.value("Summary", "Largest joint force")
    force = float(largest.partition(" ")[0])
    assert float(largest.partition("± ")[2].partition(" ")[0]) == pytest.approx(
        0.5 + 0.004 * force, abs=0.01
    )
    assert page.text.count("Shaded: the expanded uncertainty of a force") == 2


def test_cycles_around_triggers_and_cut_off_are_listed(page: Page) -> None:
    rows = page.rows("Complete cycles")
    assert ["28", "27", "29", "3", "an input at the end of its range"] in rows
    assert ["45", "45", "46", "2", "good"] in rows
    assert "kept apart: revolution 61." in page.text


def test_what_the_twin_missed_is_told(page: Page) -> None:
    assert any("33 to 35" in row[2] for row in page.rows("Agreement with the model") if row[2:])


def test_files_of_before_say_that_there_is_nothing(eventful_file: Path, tmp_path: Path) -> None:
    target = tmp_path / "old.html"
    assert write_report(eventful_file, target) == 0
    old = read(target.read_bytes())
    assert "No worn profile is recorded" in old.text
    assert old.value("Summary", "Uncertainty of a force").startswith("not stated")


@pytest.mark.long
@pytest.mark.parametrize("ending", ["html", "pdf"])
def test_the_same_bytes_each_time(worn_file: Path, tmp_path: Path, ending: str) -> None:
    targets = [tmp_path / f"{i}.{ending}" for i in range(2)]
    for target in targets:
        assert write_report(worn_file, target) == 0
    assert targets[0].read_bytes() == targets[1].read_bytes()


def test_the_rig_file_can_state_the_uncertainty() -> None:
    text = "[load_cell]\nuncertainty_N = [2.0, 0.005]\n"
    found = force_uncertainty({}, {"rig": text})
    assert found is not None
    np.testing.assert_allclose(found.at(np.array([-100.0, 0.0])), [2.5, 2.0])
    assert "rig file" in found.words
    for broken in ("", "[load_cell]\nuncertainty_N = 3.0\n", "= ="):
        assert force_uncertainty({"record_load_cell": {"record": "no"}}, {"rig": broken}) is None


def test_a_profile_without_a_place_is_unknown() -> None:
    nothing = extent_of(ANGLES, np.full(ANGLES.size, np.nan), PARAMETERS)
    assert np.isnan(nothing.depth)
    unworn = extent_of(ANGLES, np.zeros(ANGLES.size), {})
    assert unworn.depth == 0.0
    assert np.isnan(unworn.area)
    assert np.isnan(unworn.low)
