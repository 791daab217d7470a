"""Let the tests of this folder share their samples, and give many small files a quick folder."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
MEMORY = Path("/dev/shm")  # noqa: S108


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave the hours-long tests of this folder out unless the run asks for them by ``-m soak``."""
    if "soak" in (config.option.markexpr or ""):
        return
    here = Path(__file__).parent
    long = [
        one for one in items if one.path.is_relative_to(here) and one.get_closest_marker("soak")
    ]
    if long:
        config.hook.pytest_deselected(items=long)
        items[:] = [one for one in items if one not in long]


@pytest.fixture
def quick_folder(tmp_path: Path) -> Iterator[Path]:
    """Return a folder in memory where there is one: syncing costs nothing there."""
    if not os.access(MEMORY, os.W_OK):
        yield tmp_path
        return
    with tempfile.TemporaryDirectory(prefix="rigapp-storage-", dir=MEMORY) as folder:
        yield Path(folder)
