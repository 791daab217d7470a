"""The wear coefficient beside a simulated test: what is stated, refused, kept and continued."""

from __future__ import annotations

import functools
import logging
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest
from plant_revolutions import PARAMETERS, TEST, column, measured_revolutions

from rigapp.config.recipe import StopSection
from rigapp.engine.judging.criteria import StopMonitor
from rigapp.schema.columns import by_name, identified_columns, prediction_columns
from rigapp.schema.messages import Prediction, as_array
from rigapp.twin.checkpoint import packed, restore
from rigapp.twin.identifying import Identifier
from rigapp.twin.link import IdentificationTarget, TwinSetup
from rigapp.twin.twin import Twin
from rigapp.twin.worker import new_twin

NOMINAL = TEST.model.bushing.wear_coefficient_mm3_per_Nm
REVOLUTIONS = 260
SOUGHT = IdentificationTarget(0.01, 0.3, 20.0, REVOLUTIONS, "a record")
revolutions = functools.cache(measured_revolutions)


def a_twin() -> Twin:
    return Twin(PARAMETERS, "continuous", identifier=Identifier(PARAMETERS, SOUGHT))


@functools.cache
def told(number: int = REVOLUTIONS) -> tuple[list[Prediction], list[bytes]]:
    """Return the predictions of a test at 1.1 times the model's coefficient, and checkpoints."""
    twin, predictions, kept = a_twin(), [], []
    for measured, _ in revolutions(1.1, number):
        predictions.append(twin.predict(measured))
        assert twin.changed, "every revolution tells something, so that none may be lost"
        kept.append(packed(twin))
    return predictions, kept


@pytest.mark.long
def test_the_interval_contains_the_rigs_coefficient_and_narrows() -> None:
    predictions, _ = told()
    limits = []
    for one in (predictions[60], predictions[-1]):
        low, value, high = (
            column(one, f"wear_coefficient{end}") / NOMINAL for end in ("_low", "", "_high")
        )
        assert low < 1.1 < high
        assert low < value < high
        limits.append(high - low)
    assert limits[1] < 0.7 * limits[0]
    assert column(predictions[-1], "wear_model") == 0.0
    assert np.isnan(column(predictions[-1], "wear_departure_revolution"))


@pytest.mark.long
def test_what_remains_is_what_the_plant_takes_to_the_depth_of_the_criterion() -> None:
    predictions, _ = told()
    depths = np.array([depth for _, depth in revolutions(1.1, 620)])
    reached = float(np.flatnonzero(depths >= 1e-6 * SOUGHT.depth_um)[0] + 1)
    low, high = (
        column(predictions[-1], f"remaining_revolutions{end}") for end in ("_low", "_high")
    )
    assert low < reached - REVOLUTIONS < high


@pytest.mark.long
@pytest.mark.parametrize("at", [70, 203])
def test_a_killed_twin_goes_on_with_the_same_numbers_bit_for_bit(at: int) -> None:
    predictions, kept = told()
    twin = a_twin()
    assert restore(twin, kept[at - 1])
    for (measured, _), expected in zip(
        revolutions(1.1, REVOLUTIONS)[at:], predictions[at:], strict=True
    ):
        again = twin.predict(measured)
        assert again.values == expected.values, measured.revolution
    assert packed(twin) == kept[-1]


@pytest.mark.long
def test_a_checkpoint_of_before_opens_and_the_identification_begins_there() -> None:
    _, kept = told()
    old = msgspec.msgpack.decode(kept[199])
    del old["identified"]
    twin = a_twin()
    assert restore(twin, msgspec.msgpack.encode(old))
    for measured, _ in revolutions(1.1, REVOLUTIONS)[200:]:
        last = twin.predict(measured)
    assert np.isfinite(column(last, "measured_wear_depth"))
    assert twin.identifier is not None
    assert twin.identifier.progress == pytest.approx(REVOLUTIONS, rel=0.03)


@pytest.mark.long
def test_a_checkpoint_recorded_before_the_ends_were_kept_goes_on_with_the_same_coefficient() -> (
    None
):
    predictions, _ = told()
    twin = a_twin()
    recorded = Path(__file__).parents[1] / "data" / "checkpoint_without_ends.msgpack"
    assert restore(twin, recorded.read_bytes())
    for measured, _ in revolutions(1.1, REVOLUTIONS)[twin.newest : 80]:
        last = twin.predict(measured)
    for name in ("wear_coefficient_low", "wear_coefficient", "wear_coefficient_high"):
        expected = column(predictions[79], name)
        assert column(last, name) == pytest.approx(expected, rel=0.02), name


@pytest.mark.parametrize(
    ("sought", "words"),
    [
        (
            IdentificationTarget(planned=100.0),
            "no calibration record that states uncertainty of the sensitivity",
        ),
        (IdentificationTarget(0.01, None, None, 100.0, "a record"), "states drift"),
    ],
)
def test_without_a_record_it_is_refused_in_words_and_the_columns_are_unknown(
    sought: IdentificationTarget, words: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        twin = new_twin(TwinSetup(TEST.model, "continuous", sought=sought))
    assert words in caplog.text
    assert "The friction coefficient is not stated" in caplog.text
    last = twin.predict(revolutions(1.1, REVOLUTIONS)[0][0])
    values = by_name(prediction_columns(), as_array(last.values, "<f8"))
    names = [one.name for one in identified_columns()]
    assert np.isnan([values[name] for name in (*names, "friction_coefficient")]).all()
    assert values["pressure_velocity_max"] > 0.0


@pytest.mark.parametrize(
    ("stop", "key"),
    [
        (StopSection(wear_coefficient_mm3_per_Nm=0.2 * NOMINAL, identified_revolutions=3), ""),
        (
            StopSection(remaining_revolutions=900.0, identified_revolutions=3),
            "remaining_revolutions_low",
        ),
        (StopSection(wear_consistency=4.0, identified_revolutions=3), "wear_consistency"),
    ],
)
def test_each_of_them_can_end_a_test(stop: StopSection, key: str) -> None:
    predictions, _ = told(66)
    monitor = StopMonitor(stop)
    assert monitor.any
    met = []
    for number, one in enumerate(predictions, start=1):
        values = by_name(prediction_columns(), as_array(one.values, "<f8"))
        if key:
            values[key] = -5.0 if number > 60 else 0.0
        met += [found for found in (monitor.prediction(number, values),) if found]
    assert met
    assert "in 3 revolutions in a row" in met[0].sentence
    assert met[0].planned is (stop.remaining_revolutions is not None)


def test_clearance_and_width_are_in_the_budget_of_the_coefficient() -> None:
    joint = PARAMETERS.joint
    identifier = Identifier(PARAMETERS, SOUGHT, reference=1e-6)
    usual = identifier.errors().geometry
    assert usual == pytest.approx(np.hypot(20e-6 / joint.clearance, 1e-4 / joint.bushing_width))
    narrow = replace(joint, bushing_width=0.2 * joint.bushing_width)
    identifier.parameters = replace(PARAMETERS, joint=narrow)
    assert identifier.errors().geometry > 1.2 * usual


def test_the_temperature_of_the_room_goes_into_the_bins() -> None:
    twin = a_twin()
    for measured, _ in revolutions(1.1, REVOLUTIONS)[:24]:
        twin.predict(replace(measured, temperature=20.0 + 0.1 * measured.revolution))
    assert twin.identifier is not None
    warm = [one.warm for one in twin.identifier.bins.closed]
    assert warm
    assert warm == pytest.approx(
        [20.0 + 0.1 * b.progress for b in twin.identifier.bins.closed], rel=0.02
    )
