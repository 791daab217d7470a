"""Records of every kind, by which a changed evaluation is noticed.

After ``rigapp_calibration.records.EVALUATION`` was raised, or for a new kind of records,
``python -m tests.calibration.pinned`` keeps what is missing; what is there is never made again.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from rigapp.calibrating.records import keep_record
from rigapp.calibrating.running_check import running_result, runs_csv
from rigapp.calibrating.subjects import SUBJECTS
from rigapp.config.calibration_settings import CellSection, LoadCellFile
from rigapp.config.loading import read_document
from rigapp_calibration.records import EVALUATION, seal
from rigapp_calibration.turning.running_check import Known, SpeedRun, running_check
from tests.calibration.test_probe_certificates import ANGLE, run_out

FOLDER = Path(__file__).parent / "evaluations"
EXAMPLES = Path(__file__).parents[2] / "examples" / "calibration"


def _table(path: Path, subject: str, example: str, which: str = "", lines: str = "") -> None:
    """Keep the record of an example's readings; lines: what they begin with, if not all count."""
    of = SUBJECTS[subject]
    assert of.fit is not None
    given = read_document(EXAMPLES / f"{example}.toml", of.settings).record
    text = (EXAMPLES / f"{example}.csv").read_text("utf-8")
    if lines:
        kept = (one for one in text.splitlines() if one.startswith(("series", lines)))
        text = "\n".join(kept) + "\n"
    outcome = of.fit(text, given, example, which)
    keep_record(path, outcome.kind, text, given, outcome.result)


def _run_out(path: Path) -> None:
    moved = np.outer([8e-6, 1e-6], np.cos(ANGLE))
    with TemporaryDirectory() as scratch:
        record = run_out(Path(scratch) / "map", (0.3, 0.6), moved)
    path.write_bytes(seal(record.content))


def _running_check(path: Path) -> None:
    known = Known(0.05 * 0.0762, 0.01, 2.0, 0.005)
    rng = np.random.default_rng(3)
    runs = []
    for rpm in (30.0, 240.0):
        speed = np.full(10, rpm * np.pi / 30.0)
        force = np.column_stack((-known.moment * speed**2, np.zeros(10)))
        runs.append(SpeedRun(speed, force + rng.normal(0.0, 0.02, (10, 2)), 0.7))
    given = LoadCellFile(schema=1, cell=CellSection(name="pin load cell"))
    result = running_result(running_check(runs, known), known, runs)
    keep_record(path, "running check", runs_csv(runs), given, result)


MAKERS: Mapping[str, Callable[[Path], None]] = {
    "load_cell": partial(_table, subject="load cell", example="load_cell"),
    "probe": partial(_table, subject="probes", example="probes", which="1", lines="1."),
    "probes": partial(_table, subject="probes", example="probes", which="both"),
    "channel": partial(_table, subject="channel", example="channel"),
    "run_out": _run_out,
    "running_check": _running_check,
}
"""Name of the file -> what makes it."""


def main() -> int:
    """Keep a record of every kind, made by the present evaluation, where there is none."""
    folder = FOLDER / str(EVALUATION)
    folder.mkdir(parents=True, exist_ok=True)
    missing = {name: folder / f"{name}.json" for name in MAKERS}
    missing = {name: path for name, path in missing.items() if not path.exists()}
    if not missing:
        print(
            f"{folder} is complete: raise rigapp_calibration.records.EVALUATION",
            file=sys.stderr,
        )
        return 1
    for name, path in missing.items():
        MAKERS[name](path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
