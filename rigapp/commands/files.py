"""`rigapp info` and `rigapp export`: what a test file holds."""

from __future__ import annotations

import json
from dataclasses import asdict
from functools import partial
from pathlib import Path

from rigapp.commands.progress import bar
from rigapp.presentation.numbers import bytes_text
from rigapp.presentation.results import key_numbers, outcome_text, trust_lines
from rigapp.report.results import result_of_open
from rigapp.report.steps import sequence_of, step_numbers
from rigapp.storage import export_test, open_test
from rigapp_calibration.load_cell.force_uncertainty import force_uncertainty


def print_info(path: Path, *, as_json: bool) -> int:
    """Print the summary of a test file; return the exit status."""
    with open_test(path) as test:
        summary = test.summary()
        found = force_uncertainty(test.calibration(), test.configuration())
        file = path.stat()
        result = result_of_open(test, file.st_mtime, file.st_size, closely=not as_json)
    if as_json:
        summary["force_uncertainty"] = None if found is None else asdict(found)
    elif found is not None:
        summary["force_uncertainty"] = found.words
    if as_json:
        print(json.dumps(summary))
    else:
        summary["outcome"] = outcome_text(result)
        summary |= {one.caption: f"{one.value}, {one.line}" for one in key_numbers(result)}
        summary |= {one.text: one.line for one in trust_lines(result) if not one.good}
        summary["size"] = bytes_text(result.size_bytes)
        width = max(len(key) for key in summary)
        for key, value in summary.items():
            print(f"{key.replace('_', ' '):<{width}}  {value}")
    return 0


def export_file(path: Path, target: Path, *, cycles: bool, points: int | None = None) -> int:
    """Write a table of a test file and say how much was written; return the exit status."""
    with open_test(path) as test:
        sequence = sequence_of(test)
    steps = partial(step_numbers, sequence) if sequence is not None else None
    with bar("Export") as progress:
        rows = export_test(
            path, target, cycles=cycles, progress=progress, points=points, steps=steps
        )
    what = "samples" if cycles else "revolutions"
    if points is not None:
        what = f"{points} crank angles a cycle"
    print(f"{target}: {rows} rows ({what}).")
    return 0
