"""The self test of the GUI library finds a library that drops references."""

from __future__ import annotations

import itertools
from typing import Any

import PySide6
import pytest

from rigapp.gui.window import selftest


def test_the_installed_library_passes(qapp: Any) -> None:
    assert selftest.run_self_test() == []


def test_a_library_that_drops_a_reference_a_call_fails(
    qapp: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    falling = itertools.count(20_000, -selftest.CALLS)
    drifts = selftest.reference_drifts(lambda: next(falling))
    assert set(drifts.values()) == {-selftest.CALLS}
    monkeypatch.setattr(selftest, "reference_drifts", lambda: drifts)
    problems = selftest.run_self_test()
    assert len(problems) == len(drifts)
    assert "install PySide6-Essentials 6.11.3" in problems[0] or "6.11.3" in problems[0]


def test_a_version_known_as_unusable_fails(qapp: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(PySide6, "__version__", "6.9.1")
    assert any("cannot be used" in problem for problem in selftest.run_self_test())
