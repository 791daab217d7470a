"""The running check: from the files of its runs to a record."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.calibrating.records import problems_of
from rigapp.calibrating.session import Outcome
from rigapp.config.errors import UnusableInput
from rigapp.config.rig import RigFile
from rigapp.schema.messages import Flag
from rigapp.texts import say
from rigapp_calibration.taking.readings import numbers, read_table
from rigapp_calibration.turning.running_check import Known, RunningCheck, SpeedRun, running_check

RUNNING_COLUMNS = ("run", "speed_rpm", "force_1_N", "force_2_N")
STEADY_SHARE = 0.02
"""A revolution within this share of its set speed counts; what a ramp adds is more."""
MASS_UNCERTAINTY = 0.01
"""Relative standard uncertainty of mass times radius: a pin weighed, its centre by its drawing."""
FORCE_UNCERTAINTY = 0.005
"""Relative standard uncertainty of a force where no record states one: a cell of class 0.5."""


def check_of(files: Sequence[Path], speeds: Sequence[float], known: Known) -> tuple[Outcome, str]:
    """Compare the runs at some speeds (rpm) with the known force: outcome, readings as CSV."""
    runs = [read_run(path, speed) for path, speed in zip(files, speeds, strict=True)]
    check = running_check(runs, known)
    result, lines = running_result(check, known, runs), (*running_lines(check), check.sentence)
    # The result of a check is always shown.
    return Outcome(say("running check"), result, lines, always_shown=True), runs_csv(runs)


def check_again(content: Mapping[str, Any]) -> dict[str, Any]:
    """Return the result that the revolutions in a record's content give; raise ReadingsError."""
    stated = content["result"]
    rows = read_table(content["readings_csv"], RUNNING_COLUMNS)
    run, rpm, *force = (numbers(rows, name) for name in RUNNING_COLUMNS)
    speed, forces = rpm * math.pi / 30.0, np.column_stack(force)
    runs = [
        SpeedRun(speed[run == number], forces[run == number], spread)
        for number, spread in enumerate(stated["spread_within_a_turn_N"], 1)
    ]
    of = stated["known"]
    known = Known(
        stated["known_mass_times_radius_kg_m"],
        of["mass_times_radius_relative_standard_uncertainty"],
        of["resolution_N"],
        of["force_relative_standard_uncertainty"],
    )
    return running_result(running_check(runs, known), known, runs)


def known_term(rig: RigFile, mass_kg: float | None, radius_mm: float | None) -> Known:
    """Return the known data of pin and cell; raise UnusableInput without a mass."""
    cell = rig.load_cell
    mass = cell.outboard_mass_kg if mass_kg is None else mass_kg
    radius = cell.outboard_radius_mm if radius_mm is None else radius_mm
    if not (mass > 0.0 and radius > 0.0):
        raise UnusableInput(
            "the mass of the pin outboard of its gauges is not known; write"
            " load_cell.outboard_mass_kg and outboard_radius_mm, or give --mass-kg and"
            " --radius-mm."
        )
    per_force = FORCE_UNCERTAINTY if cell.uncertainty_N is None else cell.uncertainty_N[1] / 2.0
    return Known(mass * radius * 1e-3, MASS_UNCERTAINTY, cell.resolution_N, per_force)


def read_run(path: Path, rpm: float) -> SpeedRun:
    """Return the revolutions of a test file at its steady speed."""
    from rigapp.storage import open_test

    with open_test(path) as reader:
        summary = reader.summary()
        if summary["status"] != "complete":
            raise UnusableInput(
                "the run at {:g} rpm was not completed: {} {} holds it.",
                rpm,
                summary["reason"],
                path,
            )
        names = ("speed", "quality", "force_1_mean", "force_2_mean", "force_1_rms", "force_2_rms")
        speed, quality, force_1, force_2, rms_1, rms_2 = (reader.column(name) for name in names)
    good = (np.abs(speed / rpm - 1.0) < STEADY_SHARE) & (quality & int(Flag.PARTIAL) == 0)
    force = np.column_stack((force_1, force_2))[good].astype(np.float64)
    squares = np.column_stack((rms_1, rms_2))[good] ** 2 - force**2
    spread = float(np.sqrt(np.maximum(squares, 0.0).mean(axis=0).min())) if len(force) else 0.0
    return SpeedRun(speed[good].astype(np.float64) * math.pi / 30.0, force, spread)


def runs_csv(runs: Sequence[SpeedRun]) -> str:
    """Return every revolution that was used, as CSV."""
    lines = [",".join(RUNNING_COLUMNS)]
    for number, run in enumerate(runs, 1):
        for speed, (force_1, force_2) in zip(run.speed, run.force, strict=True):
            lines.append(
                f"{number},{float(speed) * 30.0 / math.pi!r},{float(force_1)!r},{float(force_2)!r}"
            )
    return "\n".join(lines) + "\n"


def running_result(check: RunningCheck, known: Known, runs: Sequence[SpeedRun]) -> dict[str, Any]:
    """Return the result for ``--json`` and the record, units in the keys."""
    return {
        "known": {
            "mass_times_radius_relative_standard_uncertainty": known.moment_uncertainty,
            "force_relative_standard_uncertainty": known.relative,
            "resolution_N": known.resolution,
        },
        "spread_within_a_turn_N": [run.spread for run in runs],
        "accepted": check.accepted,
        "problems": problems_of(check.problems),
        "sentence": check.sentence,
        "known_mass_times_radius_kg_m": known.moment,
        "measured_mass_times_radius_kg_m": check.moment,
        "measured_expanded_uncertainty_kg_m": check.moment_expanded,
        "coverage_factor": 2.0,
        "speeds": [
            {
                "speed_rpm": c.speed * 30.0 / math.pi,
                "known_N": list(c.known),
                "measured_N": list(c.measured),
                "expanded_uncertainty_N": c.expanded,
                "agrees": c.agrees,
            }
            for c in check.comparisons
        ],
    }


def running_lines(check: RunningCheck) -> list[str]:
    """Return the speeds as lines of a table."""
    if not check.comparisons:
        return []
    return [
        say("   rpm   known N   force_1 N   force_2 N   U (k = 2) N"),
        *(
            f"{c.speed * 30.0 / math.pi:6.1f} {c.known[0]:+9.2f} {c.measured[0]:+11.2f}"
            f" {c.measured[1]:+11.2f} {c.expanded:13.2f}"
            for c in check.comparisons
        ),
    ]
