"""The band of measured minus predicted holds a healthy rig, is steady, and shows a sick one.

The rigs are simulated by the plant's own mechanics, whose errors are other ones than the band
supposes: cross-talk, a soft spring, a heavy slider, friction, noise of whole steps of the cell.
"""

from __future__ import annotations

import numpy as np
import pytest
from plant_revolutions import PARAMETERS, column, measured_revolutions, moved

from rigapp.schema.columns import AGREEMENT_BIN_DEG
from rigapp.schema.messages import Prediction, as_array
from rigapp.twin.checkpoint import packed, restore
from rigapp.twin.predict import MeasuredRevolution
from rigapp.twin.twin import Twin

NUMBER = 40
FIRST = 5
"""The run-up is over, and there is more than one revolution to average."""


def outside(measured: MeasuredRevolution, prediction: Prediction) -> float:
    """Return the part of the means of |F| over 2 degrees that lies beyond the band."""
    count = round(360.0 / AGREEMENT_BIN_DEG)
    degrees = np.degrees(measured.angle) % 360.0
    places = np.minimum((degrees / AGREEMENT_BIN_DEG).astype(int), count - 1)
    grid = np.arange(361.0)
    force, band = (
        np.append(curve, curve[0])
        for curve in map(as_array, (prediction.force, prediction.agreement_uncertainty))
    )
    size = np.hypot(measured.force_1, measured.force_2)
    number = np.bincount(places, minlength=count)
    off = np.bincount(places, size - np.interp(degrees, grid, force), count) / np.maximum(number, 1)
    middles = AGREEMENT_BIN_DEG * (np.arange(count) + 0.5)
    return float(np.mean(np.abs(off)[number > 0] > np.interp(middles, grid, band)[number > 0]))


def shares(**effects: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the parts outside of a rig with some effects, and the band's largest values, N."""
    twin, parts, bands = Twin(PARAMETERS, "continuous"), [], []
    for measured, _ in measured_revolutions(1.1, NUMBER, **effects):
        prediction = twin.predict(measured)
        parts.append(outside(measured, prediction))
        bands.append(column(prediction, "agreement_uncertainty_max"))
    return np.array(parts)[FIRST:], np.array(bands)[FIRST:]


def test_a_healthy_rig_is_within_its_band_and_the_band_is_steady() -> None:
    parts, bands = shares()
    assert parts.mean() < 0.05
    assert np.abs(np.diff(bands)).max() < 0.1 * bands.mean()
    assert bands.mean() < 0.06 * 87.0  # of the largest force


@pytest.mark.long
def test_counts_of_many_revolutions_tell_what_one_leaves_open_at_150_rpm() -> None:
    twin, parts, bands, off = Twin(PARAMETERS, "continuous"), [], [], []
    revolutions = measured_revolutions(1.1, 30, speed=5.0 * np.pi, counts=3600)
    for measured in (moved(whole) for whole, _ in revolutions):
        prediction = twin.predict(measured)
        parts.append(outside(measured, prediction))
        bands.append(column(prediction, "agreement_uncertainty_max"))
        size = measured.on_grid(np.hypot(measured.force_1, measured.force_2))
        off.append(np.abs((size - as_array(prediction.force)).reshape(-1, 2).mean(axis=1)).max())
        # A steady drive has no jerk: counts that beat with the samples look like one.
        if measured.revolution > FIRST:
            assert column(prediction, "unfollowed_acceleration") < 50.0
    assert np.mean(parts[FIRST:]) < 0.05
    # What comes again tells the force: the band is no wider than what the samples scatter by.
    assert np.mean(bands[20:]) < 1.7 * np.mean(off[20:])
    assert max(bands[20:]) < 0.15 * bands[1]
    assert np.abs(np.diff(bands[FIRST:])).max() < 0.1 * np.mean(bands[FIRST:])


@pytest.mark.long
@pytest.mark.sampled
@pytest.mark.parametrize(
    "fault",
    [
        {"spring_stiffness_factor": 0.9},
        {"slider_mass_factor": 1.25},
        {"cell_gain_error_percent": 6.0},
    ],
)
def test_a_sick_rig_leaves_it_in_every_revolution(fault: dict[str, float]) -> None:
    parts, _ = shares(**fault)
    assert parts[:20].min() > 0.1


def test_what_came_again_is_kept_in_a_checkpoint() -> None:
    twin, again = (Twin(PARAMETERS, "continuous") for _ in range(2))
    revolutions = [moved(one) for one, _ in measured_revolutions(1.1, 6, counts=3600)]
    for measured in revolutions[:5]:
        twin.predict(measured)
    assert restore(again, packed(twin))
    assert again.recurrent.seen == twin.recurrent.seen > 0
    one, other = (
        column(a_twin.predict(revolutions[5]), "agreement_uncertainty_max")
        for a_twin in (twin, again)
    )
    assert one == other
