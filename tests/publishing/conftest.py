"""Recorded tests to publish, where syncing is quick."""

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
def quick_place() -> Iterator[Path]:
    """Return a folder in memory where there is one."""
    place = MEMORY if os.access(MEMORY, os.W_OK) else None
    with tempfile.TemporaryDirectory(prefix="rigapp-publishing-", dir=place) as folder:
        yield Path(folder)


@pytest.fixture(scope="session")
def clean_file(quick_place: Path) -> Path:
    """Return a complete test in which nothing is private but its operator, the author."""
    from publishing_samples import recorded

    return recorded(quick_place / "ptfe 1.h5")


@pytest.fixture
def no_report(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw no report: it takes a second, and these tests do not look at it."""
    from rigapp.publishing import packaged

    monkeypatch.setattr(packaged, "_report", lambda path: b"no report")


@pytest.fixture
def folder(quick_place: Path) -> Iterator[Path]:
    """Return a folder for one test."""
    with tempfile.TemporaryDirectory(dir=quick_place) as one:
        yield Path(one)
