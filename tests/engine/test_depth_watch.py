"""A measured wear depth that contradicts what was known is told, and judges nothing then."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
import pytest
from msgspec.structs import replace

from rigapp.config.recipe import StopSection
from rigapp.engine.judging.depthwatch import BIN, STAYS, DepthWatch, KnownDepth
from rigapp.schema.columns import prediction_columns
from rigapp.schema.messages import Prediction
from rigapp.schema.states import ENDED
from tests.engine.engine_doubles import MemoryRig, a_test, eventually

NAMES = [one.name for one in prediction_columns()]


def answer(depth_um: float, doubt_um: float, model_um: float = math.nan) -> dict[str, float]:
    return dict.fromkeys(NAMES, math.nan) | {
        "measured_wear_depth": 1e-3 * depth_um,
        "measured_wear_depth_uncertainty": 1e-3 * doubt_um,
        "driven_wear_depth": 1e-3 * model_um,
    }


def told(
    watch: DepthWatch,
    depths_um: Iterable[float],
    doubt_um: float = 0.5,
    model_um: float = 0.0,
    first: int = 8,
) -> list[tuple[int, str, str]]:
    """Return revolution, key and sentence of each alarm; model_um: worn in a revolution."""
    return [
        (number, cause.key, cause.sentence)
        for number, depth in enumerate(depths_um, first)
        for cause in watch.look(number, answer(depth, doubt_um, model_um * number))
    ]


def test_wear_that_grows_is_believed_also_where_a_joint_runs_in() -> None:
    noise = np.random.default_rng(1).normal(0.0, 0.2, 2000)
    watch = DepthWatch()
    assert told(watch, 0.02 * np.arange(2000) + noise) == []
    assert not watch.doubtful
    fast = 5.0 * (1.0 - np.exp(-np.arange(200) / 20.0)) + noise[:200]
    assert told(DepthWatch(), fast, model_um=0.05) == []


@pytest.mark.parametrize(("last", "now"), [(26.5, 8.3), (16.7, -3.0), (3.0, 26.5)])
def test_a_start_is_compared_with_the_last_test_of_the_specimen(last: float, now: float) -> None:
    watch = DepthWatch(KnownDepth(last, 1.6, when="revolution 500 of bushing.h5"))
    alarms = told(watch, [now] * 40, 1.1)
    assert [key for _, key, _ in alarms] == ["wear_jumped"]
    number, _, sentence = alarms[0]
    assert number == 8 + STAYS - 1
    assert f"is {now:.1f} um; in revolution 500 of bushing.h5 it was {last:.1f} um" in sentence
    assert "a probe was moved, or the specimen exchanged" in sentence
    assert watch.remark.startswith("The wear depth is not reliable.")
    assert told(DepthWatch(KnownDepth(last, 1.6)), [last + 1.0] * 40, 1.1) == []


def test_a_probe_that_moves_between_two_bins_is_told_from_the_first_depth_on() -> None:
    watch = DepthWatch()
    assert told(watch, [5.0] * (2 * BIN + 1)) == []
    assert not watch.doubtful
    assert told(watch, [-45.0]) == []
    assert watch.doubtful, "one is no jump yet, but judges nothing"
    assert told(watch, [5.0]) == []
    assert not watch.doubtful
    ((_, key, sentence),) = told(watch, [60.0] * 30)
    assert (key, "is 60.0 um" in sentence) == ("wear_jumped", True)


def test_wear_that_falls_slowly_is_told_by_the_deepest_mean() -> None:
    falling = np.concatenate([np.full(3 * BIN, 20.0), 20.0 - 0.01 * np.arange(500)])
    alarms = told(DepthWatch(), falling)
    assert alarms[0][1] == "wear_fell"
    assert "fallen from 20.0 um" in alarms[0][2]


def test_a_depth_below_that_of_a_new_bushing_is_told() -> None:
    assert told(DepthWatch(), [-0.4] * 40) == []
    ((_, key, sentence),) = told(DepthWatch(), [-3.0] * 40, 1.1)
    assert key == "wear_negative"
    assert "-3.0 +/- 1.1 um" in sentence


@pytest.mark.long
def test_a_depth_that_jumped_ends_no_test_and_is_remarked_at_its_end() -> None:
    rig = MemoryRig()
    rig.engine.connect()
    stop = StopSection(wear_depth_um=40.0, wear_depth_revolutions=2)
    rig.start(replace(a_test(600), stop=stop))
    eventually(lambda: len(rig.store.rows) > 20, 60.0)
    last = int(rig.store.rows[-1][0])
    for number, depth in enumerate([5.0] * 4 + [90.0] * 6, last - 9):
        values = np.array([*(answer(depth, 0.5) | {"revolution": number}).values()])
        rig.engine.submit_prediction(Prediction(number, values.tobytes(), b"", b"", b""))
    keys = {one.key for one in rig.engine.status().alarms}
    assert keys == {"wear_jumped", "depth_not_judged:wear_depth_um"}
    rig.engine.wait(ENDED, 120.0)
    outcome = rig.engine.outcome
    rig.engine.shutdown(20.0)
    assert outcome is not None
    assert (outcome.status, outcome.revolutions) == ("complete", 600)
    assert "The wear depth is not reliable" in outcome.sentence
    assert "is 90.0 um" in outcome.sentence
