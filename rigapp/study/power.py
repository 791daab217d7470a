"""After how many revolutions a difference of the wear coefficient is seen, by virtual tests."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from rigapp.config.writing import whole_file
from rigapp.study.design import Design
from rigapp.study.file import StudyFile
from rigapp.study.folder import POWER
from rigapp.study.kinds import KINDS
from rigapp.study.points import StudyRow
from rigapp.study.virtual import VirtualTest

SHARES = (0.5, 0.8, 0.9, 0.95)
"""Of the tests that shall see the difference."""
FACTOR = "run.coefficient_factor"


def write_power(
    folder: Path, study: StudyFile, design: Design, rows: Mapping[int, StudyRow]
) -> list[Path]:
    """Write of virtual tests by factor of their coefficient when how many saw it; else nothing."""
    if KINDS[study.kind].settings is not VirtualTest:
        return []
    path = folder / POWER
    with whole_file(path) as part, part.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["coefficient_factor", "share_of_tests", "revolutions", "tests"])
        for factor, seen in sorted(seen_by_factor(study, design, rows).items()):
            for share in SHARES:
                writer.writerow([factor, share, revolutions_until(seen, share), len(seen)])
    return [path]


def seen_by_factor(
    study: StudyFile, design: Design, rows: Mapping[int, StudyRow]
) -> dict[float, list[float]]:
    """Return of each factor the revolutions at which its tests saw it, inf where they did not."""
    assert isinstance(study.run, VirtualTest)
    found: dict[float, list[float]] = {}
    for point in design.points:
        row = rows.get(point.number)
        if row is not None and not row.problem:
            factor = float(point.values.get(FACTOR, study.run.coefficient_factor))
            found.setdefault(factor, []).append(row.numbers.get("seen_revolution", math.inf))
    return found


def revolutions_until(seen: list[float], share: float) -> float:
    """Return the revolutions after which so great a share has seen it; inf: not in time."""
    ordered = np.sort(seen)
    return float(ordered[max(math.ceil(share * len(ordered)) - 1, 0)])
