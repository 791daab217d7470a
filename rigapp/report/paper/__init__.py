"""Reproduce the paper's comparisons as plots and tables: Figs 6-10, 13, 15, 20, 21, Table 2."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_parameters

if TYPE_CHECKING:
    from rigapp.report.paper.pages import Chapter
    from rigapp_model.parameters import Parameters

PARAMETERS = Path(__file__).with_name("parameters")
STEEL = PARAMETERS / "table1_steel.toml"
SIMULATION = PARAMETERS / "table2_simulation.toml"
EXPERIMENT = PARAMETERS / "table2_experiment.toml"
SPEED_RPM = 30.0

Progress = Callable[[float], None]
Part = Callable[[Progress], "Iterable[Chapter]"]


@dataclass(frozen=True, slots=True)
class PaperFiles:
    """The written files, and whether all comparisons are complete."""

    files: tuple[Path, ...]
    complete: bool


def make_paper(
    folder: Path, recorded: Path | None = None, progress: Progress = lambda part: None
) -> PaperFiles:
    """Write the comparisons into a folder, created if missing; return the written files.

    One CSV table and one PNG picture for each comparison, and index.html and index.md with
    descriptions and the source of every parameter; files of these names are replaced. recorded: a
    test file for Figs 20 and 21; progress: called with the completed share. When it raises the
    model's OutOfTime the pages contain the comparisons so far. Raises UnusableInput when the folder
    cannot be written or the test file cannot be read.
    """
    from rigapp.report.paper.pages import provenance, write_chapter, write_pages
    from rigapp_model.errors import OutOfTime

    todo = parts(recorded)
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UnusableInput("--to {}: cannot be made ({}).", folder, error.strerror) from error
    written, sections = [], []
    complete = True
    try:
        for number, part in enumerate(todo):
            progress(number / len(todo))
            for chapter in part(lambda done, n=number: progress((n + done) / len(todo))):  # type: ignore[misc]
                files, section = write_chapter(folder, chapter)
                written += files
                sections.append(section)
    except OutOfTime:
        complete = False
    sections += [provenance(path) for path in (STEEL, SIMULATION, EXPERIMENT)]
    return PaperFiles((*written, *write_pages(folder, sections)), complete)


def parts(recorded: Path | None = None) -> tuple[Part, ...]:
    """Return the functions that compute the comparisons, in the paper's order."""
    from rigapp.report.paper import kinematics, table2, techniques, wear
    from rigapp.report.paper.recorded import recorded_chapters

    steel, simulation, experiment = (
        read_parameters(path) for path in (STEEL, SIMULATION, EXPERIMENT)
    )
    speed = SPEED_RPM * np.pi / 30.0

    def fig15(parameters: Parameters, name: str, bushing: str) -> Part:
        return lambda progress: [
            wear.constant_and_evolving(parameters, speed, name, bushing, progress)
        ]

    result: list[Part] = [
        lambda progress: kinematics.same_without_clearance(steel, speed),
        lambda progress: [kinematics.force_over_gap(steel, speed)],
        lambda progress: [techniques.forces(simulation, speed, progress)],
        lambda progress: [techniques.wear(simulation, speed, progress)],
        lambda progress: [kinematics.slip(steel, speed)],
        fig15(steel, "fig15_steel", "steel as in section 4.3, K = 1e-8 mm³/(N m)"),
        fig15(simulation, "fig15_soft", "the soft bushing assumed for Table 2"),
    ]
    if recorded is not None:
        measured = tuple(recorded_chapters(recorded))
        result.append(lambda progress: measured)
    result.append(lambda progress: [table2.table_2(simulation, experiment, speed, progress)])
    result.append(lambda progress: [table2.worn_profiles(simulation, experiment, speed, progress)])
    return tuple(result)
