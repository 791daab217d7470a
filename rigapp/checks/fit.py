"""Whether a test fits a rig, by their files: known before any device is opened."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rigapp.checks.check import ATTENTION, BLOCKS, GOOD, Check, refuse_blocked
from rigapp.config.channels import channel_table
from rigapp.config.consistency import number_faults, overspeed_faults
from rigapp.config.loading import Document
from rigapp.config.recipe import LimitsSection, TestFile
from rigapp.config.rig import RigFile
from rigapp.config.rules import check_rules
from rigapp.config.sequence import Sequence
from rigapp.texts import say

FEWEST_SAMPLES = 16
"""Samples that a revolution must have at least."""

LIGHT_PIN = 1e-3
"""Of full scale. A pin that weighs less may be in a zero by an angle that nobody knows: a fifth of
what the temperature of a good cell does to its zero in use."""

FEW_SAMPLES = 60
"""With fewer samples a revolution, extremes are missed."""


def check_fit(rig: RigFile, document: Document[TestFile]) -> None:
    """Refuse a test that a rig cannot do or see; raise UnusableInput."""
    test, where = document.record, say("{}: ", document.path)
    check_rules(test.limits.rule, channel_table(rig), where)
    refuse_blocked(fit_checks(test, rig), where)


def fit_checks(test: TestFile, rig: RigFile) -> Iterator[Check]:
    """Yield the checks of a test's speed and overload on a rig."""
    yield speed_check(Sequence(test.run), test.limits, rig)
    yield overload_check(test.limits.overload_N, rig)
    yield from pin_weight_checks(test, rig)


def pin_weight_checks(test: TestFile, rig: RigFile) -> Iterator[Check]:
    """Say whether what the pin weighs is taken out of the forces; nothing of a light pin."""
    weight, full = abs(rig.load_cell.pin_weight_N), rig.load_cell.full_scale_N
    if weight <= LIGHT_PIN * full:
        return
    name = say("Weight of the pin")
    if any(test.model.mechanism.gravity_m_s2):
        yield Check(name, GOOD, say("{:.2g} N, taken out of the forces by the angle", weight))
        return
    yield Check(
        name,
        ATTENTION,
        say("{:.2g} N, left in the forces: the mechanism is horizontal by the test", weight),
        say("Where the crank turns upright, write mechanism.gravity_m_s2 = [0.0, -9.81]"),
    )


def speed_check(sequence: Sequence, limits: LimitsSection, rig: RigFile) -> Check:
    """Check the fastest speed of a test against its limit and what the rig allows."""
    name, speed, allowed = say("Speed"), sequence.fastest_rpm, rig.spindle.maximum_speed_rpm
    key = sequence.fastest_key
    if speed > allowed:
        sentence = say(
            "{} = {:g} is above the rig's spindle.maximum_speed_rpm = {:g}", key, speed, allowed
        )
        return Check(name, BLOCKS, sentence, say("Lower {}", key))
    for fault in overspeed_faults(limits, sequence):
        return Check(name, BLOCKS, fault, say("Raise limits.overspeed_rpm"))
    return Check(name, GOOD, say("{:g} rpm of {:g} rpm that the rig allows", speed, allowed))


def overload_check(overload_N: float, rig: RigFile) -> Check:
    """Check the overload limit against what the load cell may carry and its inputs can show."""
    for fault in number_faults(rig):
        # A record may replace the matrix of the file by one that gives no force at all.
        return Check(say("Load cell"), BLOCKS, fault, say("Calibrate, or correct the rig file"))
    name, full, reach = say("Overload"), rig.load_cell.full_scale_N, measuring_range_N(rig)
    if overload_N > reach:
        sentence = say(
            (
                "limits.overload_N = {:g} is never reached: the input of the load cell saturates"
                " at {:.0f} N"
            ),
            overload_N,
            reach,
        )
        advice = say("Lower the limit or raise load_cell.range_mV_per_V")
        return Check(name, BLOCKS, sentence, advice)
    text = say("drive off above {:g} N, full scale of the cell {:g} N", overload_N, full)
    if overload_N > full:
        return Check(
            name, ATTENTION, text, say("Lower limits.overload_N to what the cell may carry")
        )
    return Check(name, GOOD, text)


def sampling_check(samples: float, rate_Hz: float, sequence: Sequence) -> Check:
    """Check how many samples the fastest revolution has. rate_Hz: at which they are taken."""
    name, key = say("Sample rate"), sequence.fastest_key
    text = say(
        "{:.0f} samples a revolution at {:g} Hz and {} = {:g}",
        samples,
        rate_Hz,
        key,
        sequence.fastest_rpm,
    )
    advice = say("Raise the sample rate")
    if samples < FEWEST_SAMPLES:
        return Check(name, BLOCKS, say("{}, {} are needed", text, FEWEST_SAMPLES), advice)
    if samples < FEW_SAMPLES:
        return Check(name, ATTENTION, say("{}; extremes will be missed", text), advice)
    return Check(name, GOOD, text)


def measuring_range_N(rig: RigFile) -> float:
    """Return the force up to which the load cell's inputs are not full, in any direction."""
    matrix = np.array(rig.load_cell.matrix_N_per_mV_per_V, np.float64)
    zero = np.array(rig.load_cell.zero_mV_per_V, np.float64)
    # A force has the signals inverse(matrix) force: the longest row fills its input first.
    rows = np.linalg.norm(np.linalg.inv(matrix), axis=1)
    return float(np.min((rig.load_cell.range_mV_per_V - np.abs(zero)) / rows))
