"""`rigapp model paper`: the comparisons as files, their numbers, and what the page says."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from rigapp.config.errors import UnusableInput
from rigapp.report.paper import EXPERIMENT, SIMULATION, STEEL, make_paper
from rigapp.report.paper.pages import provenance

NAMES = (
    "fig6_position",
    "fig7_velocity",
    "fig8_acceleration",
    "fig9_force",
    "fig10_force_over_gap",
    "fig13_slip",
    "fig15_steel",
    "fig15_soft",
    "table2",
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with everything that make_paper writes."""
    target = tmp_path_factory.mktemp("paper") / "new"
    written = make_paper(target)
    assert sorted(written) == sorted(target.iterdir())
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


@pytest.mark.parametrize(("name", "depth"), [("fig15_steel", 1.76e-4), ("fig15_soft", 0.481)])
def test_evolving_kinematics_wear_less_and_the_difference_grows(
    folder: Path, name: str, depth: float
) -> None:
    table = columns(folder, name)
    assert table["cycles"][-1] == 23000
    assert table["depth_constant_mm"][-1] == pytest.approx(depth, rel=5e-3)
    assert np.all(np.diff(table["difference_mm"]) <= 0.0)
    share = table["difference_mm"][-1] / table["depth_constant_mm"][-1]
    assert -0.006 < share < -0.002


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
