"""Engines and pages for the tests of the page; all of them end with the test."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from page.doubles import OpenPage, ServedEngine

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def rig(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a rig file in a folder of its own, with the engines' own folder beside it."""
    monkeypatch.setenv("RIGAPP_RUNTIME_DIR", str(tmp_path / "run"))
    return Path(shutil.copy(EXAMPLES / "simulated.toml", tmp_path / "left.toml"))


@pytest.fixture
def ending() -> Iterator[ExitStack]:
    """Close at the end what was opened."""
    with ExitStack() as stack:
        yield stack


@pytest.fixture
def serve(ending: ExitStack) -> Callable[..., ServedEngine]:
    """Return what starts an engine for a rig file."""

    def start(*given: Path, **status: object) -> ServedEngine:
        engine = ServedEngine(*given, **status)
        ending.callback(engine.close)
        return engine

    return start


@pytest.fixture
def show(ending: ExitStack) -> Callable[..., OpenPage]:
    """Return what opens a page."""

    def start(*given: object) -> OpenPage:
        page = OpenPage(*given)  # type: ignore[arg-type]
        ending.callback(page.close)
        return page

    return start
