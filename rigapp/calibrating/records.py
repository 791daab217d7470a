"""Store the record of a calibration: atomically, read-only, never overwritten.

Problems and budgets are stored as plain values.
"""

from __future__ import annotations

import calendar
import math
import os
import time
from collections.abc import Mapping, Sequence
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rigapp.config.calibration_settings import CalibrationFile
from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file
from rigapp.schema.wire import tree_of
from rigapp_calibration.problems import Problem
from rigapp_calibration.records import CLOCKS_S, EVALUATION, seal

if TYPE_CHECKING:
    from rigapp_calibration.taking.uncertainty import Budget


def problems_of(problems: Sequence[Problem]) -> list[dict[str, Any]]:
    """Return problems as plain values."""
    return [
        {"code": problem.code, "sentence": problem.sentence, "blocks": problem.blocks}
        for problem in problems
    ]


def budget_result(budget: Budget | None, unit: str, scale: float = 1.0) -> dict[str, Any]:
    """Return the keys of a budget in a result, with the unit; ``scale``: units per SI unit."""
    return {
        f"expanded_uncertainty_{unit}": None if budget is None else scale * budget.expanded,
        "coverage_factor": None if budget is None else budget.coverage_factor,
        "effective_degrees_of_freedom": None if budget is None else finite(budget.degrees),
        "budget": [
            {
                "name": contribution.name,
                f"standard_uncertainty_{unit}": scale * contribution.uncertainty,
                "type": contribution.evaluation,
                "distribution": contribution.distribution,
                "degrees_of_freedom": finite(contribution.degrees),
                "averages_out": contribution.averages,
            }
            for contribution in (() if budget is None else budget.contributions)
        ],
    }


def finite(degrees: float) -> float | None:
    """Return degrees of freedom, None where they are infinite."""
    return degrees if math.isfinite(degrees) else None


def refuse_existing(to: Path, what: str = "records") -> None:
    """Refuse a file that exists or has no folder; what: such files are. Raise UnusableInput."""
    if os.path.lexists(to):
        raise UnusableInput("{}: exists; {} are never overwritten, name another file.", to, what)
    if not to.parent.is_dir():
        raise UnusableInput("{}: the folder {} does not exist; make it first.", to, to.parent)


def keep_record(
    to: Path,
    kind: str,
    readings: str,
    settings: CalibrationFile,
    result: Mapping[str, Any],
    taken: Mapping[str, Any] | None = None,
    as_found: Mapping[str, Any] | None = None,
) -> None:
    """Write the record atomically and read-only.

    taken: how the readings were taken, if by the program itself. as_found: their
    result for the record that was in use. Raises UnusableInput for a date in the future.
    """
    now = int(time.time())
    day = settings.paperwork.calibrated_on
    done = now
    if taken is None and day is not None:
        done = calendar.timegm(day.timetuple())
    if done > now + CLOCKS_S:
        raise UnusableInput("paperwork.calibrated_on = {} is in the future; correct the date.", day)
    content = {
        "kind": kind,
        "calibrated_at": _day(done),
        "recorded_at": _day(now),
        "due_at": _day(done + 86400 * settings.paperwork.valid_days),
        "evaluation": EVALUATION,
        "software": f"rigapp {metadata.version('rigapp')}",
        "settings": tree_of(settings),
        "readings_csv": readings,
        "result": dict(result),
    }
    if taken is not None:
        content["taken"] = dict(taken)
    if as_found:
        content["as_found"] = dict(as_found)
    with whole_file(to, new=True, mode=0o444) as part:
        part.write_bytes(seal(content))


def _day(seconds: int) -> str:
    return time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(seconds))
