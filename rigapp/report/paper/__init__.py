"""The paper's comparisons again: Figs 6 to 10, 13 and 15 and Table 2, as plots and tables."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.model_parameters import read_parameters

if TYPE_CHECKING:
    from rigapp.report.paper.chapter import Chapter

PARAMETERS = Path(__file__).with_name("parameters")
STEEL = PARAMETERS / "table1_steel.toml"
SIMULATION = PARAMETERS / "table2_simulation.toml"
EXPERIMENT = PARAMETERS / "table2_experiment.toml"
SPEED_RPM = 30.0


def make_paper(folder: Path) -> list[Path]:
    """Write the comparisons into a folder, made if it is not there; return what was written.

    One CSV table and one PNG picture a comparison, and index.html and index.md that say in plain
    sentences what they show and where every parameter comes from; files of these names are
    replaced. Raises UnusableInput when the folder cannot be written.
    """
    from rigapp.report.paper.pages import provenance, write_chapter, write_pages

    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UnusableInput(f"--to {folder}: cannot be made ({error.strerror}).") from error
    written, sections = [], []
    for chapter in chapters():
        files, section = write_chapter(folder, chapter)
        written += files
        sections.append(section)
    sections += [provenance(path) for path in (STEEL, SIMULATION, EXPERIMENT)]
    return written + write_pages(folder, sections)


def chapters() -> Iterator[Chapter]:
    """Yield the comparisons in the paper's order."""
    from rigapp.report.paper import kinematics, table2, wear

    steel, simulation, experiment = (
        read_parameters(path) for path in (STEEL, SIMULATION, EXPERIMENT)
    )
    speed = SPEED_RPM * np.pi / 30.0
    yield from kinematics.same_without_clearance(steel, speed)
    yield kinematics.force_over_gap(steel, speed)
    yield kinematics.slip(steel, speed)
    yield wear.constant_and_evolving(
        steel, speed, "fig15_steel", "steel as in section 4.3, K = 1e-8 mm³/(N m)"
    )
    yield wear.constant_and_evolving(
        simulation, speed, "fig15_soft", "the soft bushing assumed for Table 2"
    )
    yield table2.table_2(simulation, experiment, speed)
