"""`rigapp model forces`: one cycle of the mechanism as a table."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rigapp.commands.model.cycle import (
    CycleTable,
    check_rpm,
    columns_of,
    demand,
    joint_technique,
    plane_words,
)
from rigapp.commands.model.impacts import (
    Impacting,
    check_impacting,
    impact_cycle,
    with_contact_law,
)
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_parameters
from rigapp.config.parameters import MM
from rigapp.report.tables import check_target, write_table
from rigapp_model.wear.techniques import TECHNIQUES, listed

if TYPE_CHECKING:
    from rigapp_model.parameters import Parameters

FEWEST_POINTS, MOST_POINTS = 4, 1_000_000


def write_forces(
    params_path: Path,
    rpm: float,
    joint: str,
    clearance_mm: float | None,
    points: int,
    target: Path,
    impacting: Impacting | None = None,
) -> int:
    """Write one cycle at ``points`` equal crank angles as CSV, replacing an earlier table.

    joint: one of ``TECHNIQUES``; clearance_mm: radial clearance instead of the file's, where the
    joint has one; impacting: what only separate bodies have. Sentences on stderr say where
    continuous contact does not hold, and that a curve is one sample of a chaotic motion. Returns
    the exit status: 0, or 1 when time ran out; raises UnusableInput naming what cannot be used.
    """
    from rigapp_model.errors import OutOfTime

    options = impacting or Impacting()
    _check(rpm, joint, clearance_mm, points, params_path, target)
    check_impacting(joint, options)
    parameters = _with_clearance(read_parameters(params_path), params_path, clearance_mm)
    parameters = with_contact_law(parameters, options.contact_law, options.restitution)
    try:
        cycle = _cycle(parameters, rpm, joint, points, options)
    except OutOfTime:
        print(
            f"--time-limit-s {options.time_limit_s:g}: over before the first revolution;"
            f" {target} is not written.",
            file=sys.stderr,
        )
        return 1
    except ValueError as error:
        raise UnusableInput(f"{params_path}: {error}.") from error
    write_table("--to", target, cycle.columns)
    size = cycle.columns["f_N"]
    print(
        f"{target}: {points} crank angles at {rpm:g} rpm, joint {joint}; "
        f"force {size.min():.3f} to {size.max():.3f} N; {plane_words(parameters.mechanism)}."
        f"{cycle.remark}"
    )
    for sentence in cycle.sentences:
        print(sentence, file=sys.stderr)
    return 0 if cycle.complete else 1


def _check(
    rpm: float, joint: str, clearance_mm: float | None, points: int, source: Path, target: Path
) -> None:
    """Refuse what the options cannot mean."""
    check_rpm(rpm)
    technique = joint_technique(joint)
    enough = FEWEST_POINTS <= points <= MOST_POINTS
    demand(enough, "--points", points, f"give {FEWEST_POINTS} to {MOST_POINTS}")
    if clearance_mm is not None:
        usable = math.isfinite(clearance_mm) and clearance_mm >= 0.0
        demand(usable, "--clearance-mm", clearance_mm, "give 0 or more")
        if "clearance" not in technique.needs and clearance_mm != 0.0:
            others = tuple(one.name for one in TECHNIQUES.values() if "clearance" in one.needs)
            raise UnusableInput(
                f"--clearance-mm has no meaning for a {joint} joint; use --joint {listed(others)}."
            )
    check_target("--to", target, source)


def _with_clearance(parameters: Parameters, path: Path, clearance_mm: float | None) -> Parameters:
    """Return the parameters with the bushing's radius set by a clearance."""
    if clearance_mm is None:
        return parameters
    radius = parameters.joint.pin_radius + clearance_mm * MM
    try:
        return replace(parameters, joint=replace(parameters.joint, bushing_radius=radius))
    except ValueError as error:
        raise UnusableInput(f"{path} with --clearance-mm {clearance_mm:g}: {error}.") from error


def _cycle(
    parameters: Parameters, rpm: float, joint: str, points: int, impacting: Impacting
) -> CycleTable:
    """Return the cycle by the technique chosen."""
    speed = rpm * np.pi / 30.0
    degrees = 360.0 / points * np.arange(points)
    solve = TECHNIQUES[joint].solve
    if solve is None:
        return impact_cycle(parameters, speed, degrees, impacting)
    motion, sentence = solve(parameters, np.deg2rad(degrees), speed, 0.0, 0.0)
    columns = columns_of(degrees, motion, parameters.joint.pin_radius)
    return CycleTable(columns, sentences=tuple(filter(None, [sentence])))
