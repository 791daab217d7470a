"""Read a test file for drawing; always called on a worker thread."""

from __future__ import annotations

from pathlib import Path

from rigapp.gui.series import LiveData


def load_history(path: Path, planned: int = 0) -> LiveData:
    """Return everything that a file holds of a test, with its levels of detail built.

    Raises UnusableInput when the file is not a readable test.
    """
    from rigapp.storage import open_test

    with open_test(path) as test:
        rows = test.rows()
        data = LiveData(max(planned, len(rows["revolution"])))
        data.load_rows(rows)
        predictions = test.predictions()
        if len(predictions["revolution"]):
            data.predictions.load(predictions)
    return data
