"""The pictures of a study: axes in words with units, logarithmic where it was varied so."""

from __future__ import annotations

from pathlib import Path

import matplotlib.figure
import numpy as np
import pytest

from rigapp.study.design import Design, Spread, StudyFile, StudyPoint
from rigapp.study.points import StudyRow
from rigapp.study.table import draw_study, is_logarithmic, label_of


def test_axes_are_named_in_words_and_logarithmic_where_varied_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[matplotlib.figure.Figure] = []
    save = matplotlib.figure.Figure.savefig

    def keep(figure: matplotlib.figure.Figure, *given: object, **more: object) -> None:
        drawn.append(figure)
        save(figure, *given, **more)

    monkeypatch.setattr(matplotlib.figure.Figure, "savefig", keep)
    coefficient, radius = "bushing.wear_coefficient_mm3_per_Nm", "joint.bushing_radius_mm"
    vary = {coefficient: Spread(1e-5, 1e-3, scale="log"), radius: Spread(9.6, 10.4)}
    study = StudyFile(1, "life", {}, vary=vary)
    points = [
        StudyPoint(n, {coefficient: 10.0 ** (n - 5), radius: 9.6 + 0.4 * n}, 1) for n in range(3)
    ]
    rows = {n: StudyRow(n, {"max_depth_mm": 0.1 * n + 0.1}) for n in range(3)}
    draw_study(tmp_path, study, Design(tuple(points), 0), rows, {})
    left, right = drawn[0].axes
    assert left.get_xscale() == "log"
    assert right.get_xscale() == "linear"
    assert left.get_xlabel().startswith("wear coefficient, mm³")
    assert right.get_xlabel() == "bushing radius, mm"
    assert left.get_ylabel() == "max depth, mm"
    np.testing.assert_allclose(left.lines[0].get_xdata(), [1e-5, 1e-4, 1e-3])


def test_what_says_nothing_without_its_section_has_it() -> None:
    assert label_of("pin.youngs_modulus_MPa") == "youngs modulus, pin, MPa"
    assert label_of("joint.friction_coefficient") == "friction coefficient"


def test_a_list_over_a_decade_is_logarithmic() -> None:
    assert is_logarithmic([1e-4, 2e-4, 5e-3])
    assert not is_logarithmic([1e-4, 2e-4, 5e-4])
    assert not is_logarithmic(["perfect", "continuous"])
    assert not is_logarithmic(None)
