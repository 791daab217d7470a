"""The points of a study: as many as asked for, within what was asked for, the same each time."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rigapp.config.errors import UnusableInput
from rigapp.study.design import DesignSection, Spread, design_of

VARY = {"a": Spread(1.0, 3.0, levels=3), "b": [5.0, 7.0], "c": Spread(0.1, 10.0, scale="log")}


def test_a_grid_has_every_combination_with_the_last_key_quickest() -> None:
    found = design_of({"a": Spread(1.0, 3.0, levels=3), "b": ["x", "y"]}, DesignSection())
    assert [tuple(one.values.values()) for one in found.points] == [
        (1.0, "x"), (1.0, "y"), (2.0, "x"), (2.0, "y"), (3.0, "x"), (3.0, "y"),
    ]  # fmt: skip
    assert [one.number for one in found.points] == list(range(6))


def test_a_grid_of_nothing_is_one_point() -> None:
    assert [dict(one.values) for one in design_of({}, DesignSection()).points] == [{}]


@pytest.mark.parametrize("kind", ["latin-hypercube", "sobol"])
@given(points=st.integers(1, 300), seed=st.integers(0, 2**31 - 1))
def test_drawn_points_are_as_many_as_asked_for_and_within(
    kind: str, points: int, seed: int
) -> None:
    section = DesignSection(kind, points, seed)  # type: ignore[arg-type]
    found = design_of(VARY, section)
    assert found == design_of(VARY, section)
    assert len(found.points) == points
    for one in found.points:
        assert 1.0 <= float(one.values["a"]) <= 3.0
        assert one.values["b"] in (5.0, 7.0)
        assert 0.1 <= float(one.values["c"]) <= 10.0
    assert len({one.seed for one in found.points}) == points


def test_a_log_scale_has_as_many_points_in_each_decade() -> None:
    found = design_of(
        {"c": Spread(0.01, 100.0, scale="log")}, DesignSection("latin-hypercube", 400)
    )
    decades = np.floor(np.log10([float(one.values["c"]) for one in found.points]))
    assert np.unique(decades, return_counts=True)[1].tolist() == [100] * 4


def test_the_example_of_two_keys_is_all_base_points() -> None:
    found = design_of({"a": VARY["a"], "b": VARY["b"]}, DesignSection("sobol", 1024))
    assert found.blocks == 256
    rows = [tuple(one.values.values()) for one in found.points]
    a, b = rows[:256], rows[256:512]
    assert rows[512:768] == [(y[0], x[1]) for x, y in zip(a, b, strict=True)]
    assert rows[768:] == [(x[0], y[1]) for x, y in zip(a, b, strict=True)]


def test_repeats_differ_in_their_seed_alone() -> None:
    found = design_of({"b": [5.0, 7.0]}, DesignSection(repeats=3))
    assert [one.values["b"] for one in found.points] == [5.0] * 3 + [7.0] * 3
    assert len({one.seed for one in found.points}) == 6
    assert design_of(VARY, DesignSection("sobol", 64, repeats=2)).blocks == 0


@pytest.mark.parametrize(
    ("vary", "section", "words"),
    [
        ({"a": Spread(3.0, 1.0)}, DesignSection(), "vary.a: low = 3 must be below 1"),
        ({"a": Spread(-1.0, 1.0, scale="log")}, DesignSection(), "must be above 0 on a log scale"),
        ({"a": []}, DesignSection(), "the list is empty"),
        ({"a": Spread(0.0, float("nan"))}, DesignSection(), "must be below"),
        ({}, DesignSection("sobol"), "vary names no keys"),
        (
            {str(n): Spread(0.0, 1.0, levels=1000) for n in range(3)},
            DesignSection(),
            "the grid has 1,000,000,000 points",
        ),
        ({"a": [1.0, 2.0]}, DesignSection(repeats=100_000), None),
        ({"a": Spread(0.0, 1.0, levels=20)}, DesignSection(repeats=100_000), "at most 1,000,000"),
    ],
)
def test_what_cannot_be_varied_is_refused(
    vary: dict[str, object], section: DesignSection, words: str | None
) -> None:
    if words is None:
        assert len(design_of(vary, section).points) == 200_000  # type: ignore[arg-type]
        return
    with pytest.raises(UnusableInput, match=words.replace("(", r"\(")):
        design_of(vary, section)  # type: ignore[arg-type]
