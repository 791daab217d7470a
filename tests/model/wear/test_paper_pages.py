"""`rigapp model paper`: the comparisons as files, their numbers, and what the page says."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import numpy as np
import pytest

from rigapp.commands.model.wear import write_paper
from rigapp.config.errors import UnusableInput
from rigapp.report.paper import EXPERIMENT, SIMULATION, STEEL, make_paper
from rigapp.report.paper.pages import provenance

NAMES = (
    "fig6_position",
    "fig7_velocity",
    "fig8_acceleration",
    "fig9_force",
    "fig10_force_over_gap",
    "techniques_force",
    "techniques_wear",
    "fig13_slip",
    "fig15_steel",
    "fig15_soft",
    "table2",
    "fig21_profile",
)


pytestmark = pytest.mark.long  # all pages are made; their numbers are tested with the model


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with everything that make_paper writes."""
    target = tmp_path_factory.mktemp("paper") / "new"
    made = make_paper(target)
    assert made.complete
    assert sorted(made.files) == sorted(target.iterdir())
    return target


def columns(folder: Path, name: str) -> dict[str, np.ndarray]:
    """Return a table's columns by name."""
    path = folder / f"{name}.csv"
    header = path.read_text().partition("\n")[0].split(",")
    return dict(zip(header, np.loadtxt(path, delimiter=",", skiprows=1).T, strict=True))


def test_every_comparison_has_table_and_picture(folder: Path) -> None:
    files = {path.name for path in folder.iterdir()}
    assert files == {f"{n}{end}" for n in NAMES for end in (".csv", ".png")} | {
        "index.html",
        "index.md",
    }
    for name in NAMES:
        picture = (folder / f"{name}.png").read_bytes()
        assert picture.startswith(b"\x89PNG")
        assert len(picture) > 10_000


@pytest.mark.parametrize("name", NAMES[:4])
def test_without_clearance_both_models_are_one(folder: Path, name: str) -> None:
    table = columns(folder, name)
    pairs = [key for key in table if "_perfect_" in key]
    assert len(pairs) == (2 if name == "fig9_force" else 3)
    for key in pairs:
        other = table[key.replace("_perfect_", "_imperfect_")]
        assert np.abs(table[key] - other).max() < 1e-12 * max(np.abs(other).max(), 1.0)
        assert np.ptp(other) > 0.0


def test_force_falls_with_the_gap_when_the_spring_is_outboard(folder: Path) -> None:
    table = columns(folder, "fig10_force_over_gap")
    size = [table[f"f_outboard_gap_{gap}mm_N"].max() for gap in ("0", "0.1", "0.5", "1")]
    change = 100.0 * (np.array(size[1:]) / size[0] - 1.0)
    assert change == pytest.approx([-0.055, -0.275, -0.55], abs=0.006)
    printed = [table[f"f_inboard_Eq_12_as_printed_gap_{gap}mm_N"].max() for gap in ("0", "1")]
    assert printed[1] > printed[0]
    page = (folder / "index.md").read_text()
    assert "the maximum force falls by 0.55 % at a gap of 1 mm" in page


def test_slip_is_once_round_the_pin(folder: Path) -> None:
    table = columns(folder, "fig13_slip")
    assert table["slip_mm"].sum() == pytest.approx(2.0 * np.pi * 9.5, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "depth", "by_wear", "whole"),
    [("fig15_steel", 1.76e-4, -6.4e-7, -3.1e-3), ("fig15_soft", 0.481, -1.22e-3, -4.1e-3)],
)
def test_what_wear_does_is_told_apart_from_what_clearance_does(
    folder: Path, name: str, depth: float, by_wear: float, whole: float
) -> None:
    table = columns(folder, name)
    assert table["cycles"][-1] == 23000
    assert table["depth_perfect_mm"][-1] == pytest.approx(depth, rel=5e-3)
    for one, other, difference in (
        ("evolving", "constant", "evolving_less_constant_mm"),
        ("constant", "perfect", "constant_less_perfect_mm"),
        ("evolving", "perfect", "evolving_less_perfect_mm"),
    ):
        apart = table[f"depth_{one}_mm"] - table[f"depth_{other}_mm"]
        np.testing.assert_allclose(table[difference], apart, rtol=1e-3, atol=1e-14 + 1e-12 * depth)
        late = table["cycles"] >= 1000
        assert np.all(np.diff(table[difference][late]) < 0.0)
    share = table["evolving_less_constant_mm"][-1] / table["depth_constant_mm"][-1]
    assert share == pytest.approx(by_wear, rel=0.02)
    share = table["evolving_less_perfect_mm"][-1] / table["depth_perfect_mm"][-1]
    assert share == pytest.approx(whole, rel=0.02)
    page = (folder / "index.md").read_text()
    assert page.count("First difference, what wear does to itself through the kinematics") == 2
    assert page.count("which is no effect of wear") == 2


def test_lines_between_the_cycles_of_fig_15_are_nearer_than_its_effect(folder: Path) -> None:
    table = columns(folder, "fig15_soft")
    cycles, depth = table["cycles"], table["depth_evolving_mm"]
    assert len(cycles) >= 40
    inner = slice(1, -1, 2)
    between = np.interp(cycles[inner], cycles[::2], depth[::2])
    # With every other cycle left out a straight line is four times as far off.
    off = 0.25 * np.abs(between - depth[inner])[cycles[inner] > 100.0].max()
    assert off < 0.5 * np.abs(table["evolving_less_constant_mm"][-1])


def test_three_techniques_stand_side_by_side(folder: Path) -> None:
    table = columns(folder, "techniques_force")
    two, three = table["f_continuous_spring_N"], table["f_contact_spring_N"]
    assert np.abs(two - three).max() < 0.05
    assert 0.3 < np.abs(table["f_perfect_spring_N"] - two).max() < 0.5
    mean = table["f_contact_no_spring_N_mean"]
    error = table["f_contact_no_spring_N_standard_error"]
    assert np.all(error >= 0.0)
    assert np.abs(table["f_contact_no_spring_sample_N"] - mean).max() > 10.0
    lives = columns(folder, "techniques_wear")
    assert lives["cycles"][-1] == 21377
    apart = np.abs(lives["depth_contact_mm"] - lives["depth_continuous_mm"])
    assert np.all(apart <= lives["error_contact_mm"] + lives["error_continuous_mm"])
    page = (folder / "index.md").read_text()
    assert "Without the spring technique 2 does not hold" in page
    assert "one sample, the line the mean over 40 revolutions" in page


def test_profile_of_the_simulations(folder: Path) -> None:
    table = columns(folder, "fig21_profile")
    assert table["depth_simulation_mm"].max() == pytest.approx(0.4524, rel=1e-3)
    assert table["depth_experiment_mm"].max() == pytest.approx(0.4850, rel=1e-3)
    for one in ("simulation", "experiment"):
        flat, upright = table[f"depth_{one}_mm"], table[f"depth_{one}_vertical_mm"]
        turned = table["angle_deg"][np.argmax(upright)] - table["angle_deg"][np.argmax(flat)]
        assert 1.0 < abs(turned) < 10.0, "gravity turns the contact"
    assert table["angle_deg"][np.argmax(table["depth_simulation_mm"])] == pytest.approx(0.0, abs=1)


def test_time_that_runs_out_leaves_pages_of_what_was_made(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # Each look at the clock finds a second gone.
    clock = itertools.count()
    monkeypatch.setattr("rigapp.commands.progress.monotonic", lambda: float(next(clock)))
    assert write_paper(tmp_path, None, 3.0) == 1
    printed = capsys.readouterr()
    assert "--time-limit-s 3: over before all comparisons were made" in printed.err
    made = {path.name for path in tmp_path.iterdir()}
    assert {"fig6_position.png", "fig10_force_over_gap.csv", "index.html"} <= made
    assert "fig15_steel.csv" not in made
    assert set(printed.out.split()) == {str(path) for path in tmp_path.iterdir()}


def test_table_2_is_reproduced_and_called_assumed(folder: Path) -> None:
    page = (folder / "index.md").read_text()
    rows = {
        cells[0].strip(): [cell.strip() for cell in cells[1:5]]
        for line in page.splitlines()
        if (cells := line.strip("|").split("|")) and len(cells) == 5
    }
    area, mass, depth = (
        rows[key] for key in ("worn area, mm²", "worn mass, g", "largest depth, mm")
    )
    assert float(area[1]) == pytest.approx(5.5175, rel=1e-3)
    assert float(mass[1]) == pytest.approx(0.1589, rel=1e-3)
    assert float(depth[1]) == pytest.approx(0.4524, rel=1e-3)
    assert float(mass[3]) == pytest.approx(0.1714, rel=1e-3)
    assert float(depth[3]) == pytest.approx(0.4850, rel=1e-3)
    assert "They are assumed, not recovered" in page
    found = re.search(r"at ([\d.]+) mm and ([\d.]+) mm³/m for the paper's simulation", page)
    assert found is not None
    assert float(found[1]) == pytest.approx(0.635, abs=0.003)
    assert float(found[2]) == pytest.approx(5.05e-4 * 101.8, rel=2e-3)
    table = columns(folder, "table2")
    assert np.all(np.diff(table["kf_for_depth_simulation_mm3_per_m"]) < 0.0)


def test_every_value_of_every_file_has_a_source(folder: Path) -> None:
    page = (folder / "index.html").read_text()
    for path in (STEEL, SIMULATION, EXPERIMENT):
        values = re.findall(r"^(?!schema)\w+ = ", path.read_text(), re.MULTILINE)
        rows = provenance(path).blocks[1].rows
        assert len(rows) == len(values) > 20
        for key, value, source in rows:
            assert source.split(":")[0].split(" ")[0].rstrip(",") in (
                "Table",
                "paper",
                "assumed",
                "derived",
                "fitted",
            ), (path.name, key, value)
        assert path.name in page


def test_folder_that_cannot_be_made_is_named(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    with pytest.raises(UnusableInput, match=r"--to .*file.*cannot be made"):
        make_paper(blocked / "inside")
