"""Fixtures for all drivers: simulated devices on ptys."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest


def _load_harness() -> ModuleType:
    path = Path(__file__).with_name("harness.py")
    spec = importlib.util.spec_from_file_location("rigapp_tests_harness", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def harness() -> ModuleType:
    """Return the module with Wire, Wires, Clock and wait_until."""
    return sys.modules.get("rigapp_tests_harness") or _load_harness()


@pytest.fixture
def wire(harness: ModuleType) -> Iterator[Any]:
    """Make simulated devices on ptys: ``wire(respond, produce)``, ``wire.source(...)``."""
    if sys.platform == "win32":
        pytest.skip("a pty needs a POSIX system")
    wires = harness.Wires()
    yield wires
    wires.close()


@pytest.fixture
def wait_until(harness: ModuleType) -> Callable[..., None]:
    """Wait for a condition with a deadline."""
    function: Callable[..., None] = harness.wait_until
    return function
