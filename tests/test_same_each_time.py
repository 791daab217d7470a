"""The suite draws the same examples in every run."""

from __future__ import annotations

import random

from hypothesis import given, settings
from hypothesis import strategies as st


def _drawn() -> list[tuple[int, bytes]]:
    seen: list[tuple[int, bytes]] = []

    @settings(settings.get_profile("rigapp"), max_examples=20)
    @given(st.integers(), st.binary())
    def look(number: int, data: bytes) -> None:
        seen.append((number, data))

    look()
    return seen


def test_two_runs_draw_the_same_and_remember_nothing() -> None:
    random.seed(1)
    first = _drawn()
    random.seed(2)
    assert _drawn() == first
    assert len(set(first)) > 10
    assert settings.get_profile("rigapp").database is None
