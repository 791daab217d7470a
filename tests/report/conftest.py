"""Let the tests of this folder share their samples, and write test files where syncing is quick."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
MEMORY = Path("/dev/shm")  # noqa: S108


@pytest.fixture(scope="session")
def quick_folder() -> Iterator[Path]:
    """Return a folder in memory where there is one."""
    place = MEMORY if os.access(MEMORY, os.W_OK) else None
    with tempfile.TemporaryDirectory(prefix="rigapp-report-", dir=place) as folder:
        yield Path(folder)


@pytest.fixture(scope="session")
def eventful_file(quick_folder: Path) -> Path:
    """Return a test in which much happened."""
    from report_samples import eventful

    return eventful(quick_folder / "eventful.h5")
