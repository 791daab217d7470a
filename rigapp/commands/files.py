"""`rigapp info` and `rigapp export`: what a test file holds."""

from __future__ import annotations

import json
from pathlib import Path

from rigapp.storage.export import export_test
from rigapp.storage.reader import open_test


def print_info(path: Path, *, as_json: bool) -> int:
    """Print the summary of a test file; return the exit status."""
    with open_test(path) as test:
        summary = test.summary()
    if as_json:
        print(json.dumps(summary))
    else:
        width = max(len(key) for key in summary)
        for key, value in summary.items():
            print(f"{key.replace('_', ' '):<{width}}  {value}")
    return 0


def export_file(path: Path, target: Path, *, cycles: bool) -> int:
    """Write a table of a test file and say how much was written."""
    rows = export_test(path, target, cycles=cycles)
    print(f"{target}: {rows} rows.")
    return 0
