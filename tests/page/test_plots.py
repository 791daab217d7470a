"""What is drawn of a rig: only what is known, the model beside it, bands where there are limits."""

from __future__ import annotations

import re

import msgspec
import numpy as np
from snapshots import PREDICTION_NAMES, make_predictions, make_snapshot

from rigapp.page.plots import Painter
from rigapp.schema.messages import Snapshot
from rigapp.viewer.news import News
from rigapp.viewer.series import LiveData


def news_of(snapshot: Snapshot) -> News:
    data = LiveData()
    data.take(snapshot)
    return News(status=snapshot.status, data=data)


def identified(count: int) -> Snapshot:
    """Return a snapshot whose wear coefficient is known from the middle on."""
    predictions = make_predictions(1, count)
    for name, value in (
        ("wear_coefficient", 5e-4),
        ("wear_coefficient_low", 4e-4),
        ("wear_coefficient_high", 6e-4),
        ("remaining_revolutions", 9000.0),
        ("remaining_revolutions_low", 8000.0),
        ("remaining_revolutions_high", np.inf),
    ):
        predictions[:, PREDICTION_NAMES.index(name)] = np.where(
            np.arange(count) < count // 2, np.nan, value
        )
    return msgspec.structs.replace(make_snapshot(count=count), predictions=predictions.tobytes())


def titles(news: News) -> list[str]:
    return [plot.title for plot in Painter().trends(news)]


def test_before_the_first_revolution_nothing_is_drawn() -> None:
    news = news_of(make_snapshot(count=0, curves=False))
    assert Painter().force(news) is None
    assert titles(news) == []


def test_a_revolution_is_drawn_over_its_model() -> None:
    plot = Painter().force(news_of(make_snapshot(count=5)))
    assert plot is not None
    assert plot.title == "Force over the crank angle, revolution 5"
    assert [role for role, _ in plot.legend] == ["model", "main", "first", "second"]
    assert re.findall(r'class="curve (\w+)"', plot.picture) == [
        "model", "model", "model", "main", "first", "second",
    ]  # fmt: skip


def test_a_model_that_is_behind_is_said_and_grey() -> None:
    plot = Painter().force(news_of(make_snapshot(count=5, twin_age_s=60.0)))
    assert plot is not None
    assert plot.legend[0] == ("stale", "model of revolution 5, behind")


def test_the_wear_coefficient_is_drawn_with_its_limits_once_it_is_known() -> None:
    assert titles(news_of(make_snapshot(count=200))) == [
        "|F| maximum", "Wear depth", "Measured − model",
    ]  # fmt: skip
    plots = {plot.title: plot for plot in Painter().trends(news_of(identified(200)))}
    known = plots["Wear coefficient, 95 %"].picture
    assert known.count('class="ribbon first" d="M') == 1
    open_above = plots["Revolutions that remain, 95 %"].picture
    assert 'class="ribbon first" d=""' in open_above, "no limit above, no band"
    assert "inf" not in open_above


def test_a_long_test_takes_no_more_bytes_than_a_short_one() -> None:
    short, long = (
        sum(len(plot.picture) for plot in Painter().trends(news_of(make_snapshot(count=count))))
        for count in (1000, 30000)
    )
    assert long < 2 * short
