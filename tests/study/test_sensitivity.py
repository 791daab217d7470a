"""Sensitivities against a function whose indices are known in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from rigapp.study.design import DesignSection, Spread, design_of
from rigapp.study.sensitivity import indices_of

A, B = 7.0, 0.1


def ishigami() -> tuple[np.ndarray, np.ndarray]:
    """Return first-order and total indices of Ishigami's function (Saltelli 2000)."""
    v1 = 0.5 * (1.0 + B * np.pi**4 / 5.0) ** 2
    v2 = A**2 / 8.0
    v13 = B**2 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0)
    total = v1 + v2 + v13
    return np.array([v1, v2, 0.0]) / total, np.array([v1 + v13, v2, v13]) / total


def values(points: int) -> tuple[np.ndarray, int]:
    vary = {key: Spread(-np.pi, np.pi) for key in "xyz"}
    design = design_of(vary, DesignSection("sobol", points))
    x, y, z = np.array([list(one.values.values()) for one in design.points], dtype=float).T
    found = np.sin(x) + A * np.sin(y) ** 2 + B * z**4 * np.sin(x)
    return found[: 5 * design.blocks].reshape(5, design.blocks), design.blocks


def test_indices_of_a_known_function_are_found_within_their_limits() -> None:
    blocks, count = values(20480)
    assert count == 4096
    found = indices_of(blocks, seed=1)
    assert found is not None
    first, total = ishigami()
    np.testing.assert_allclose(found.first_order, first, atol=0.02)
    np.testing.assert_allclose(found.total, total, atol=0.02)
    assert np.all((found.first_order_low <= first) & (first <= found.first_order_high))
    assert np.all((found.total_low - 1e-3 <= total) & (total <= found.total_high + 1e-3))


def test_limits_narrow_with_the_points_and_missing_ones_are_left_out() -> None:
    few, many = indices_of(values(320)[0], 1), indices_of(values(5120)[0], 1)
    assert few is not None
    assert many is not None
    width = [float((one.total_high - one.total_low).mean()) for one in (few, many)]
    assert width[1] < 0.5 * width[0]
    blocks, _ = values(5120)
    blocks[2, ::7] = np.nan
    found = indices_of(blocks, 1)
    assert found is not None
    np.testing.assert_allclose(found.total, many.total, atol=0.05)


@pytest.mark.parametrize("constant", [0.0, np.nan])
def test_what_does_not_vary_depends_on_nothing(constant: float) -> None:
    assert indices_of(np.full((4, 16), constant), 1) is None


def test_few_points_resolve_nothing_and_say_how_many_would() -> None:
    blocks, count = values(40)
    few = indices_of(blocks, seed=1)
    assert few is not None
    needed = few.points_needed(count)
    assert needed > 4 * count
    blocks, count = values(5 * needed)
    assert count == needed
    many = indices_of(blocks, seed=1)
    assert many is not None
    assert many.points_needed(count) <= 2 * count  # it was an estimate from very few points
    blocks, count = values(20480)
    most = indices_of(blocks, seed=1)
    assert most is not None
    assert most.points_needed(count) == 0
