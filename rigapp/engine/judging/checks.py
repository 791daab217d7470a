"""Immediate checks of blocks and speeds: largest force, saturated inputs, encoder and drive."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rigapp.engine.samples.assembler import Values
from rigapp.engine.values.calibrate import Calibration
from rigapp.engine.values.corrections import linearised
from rigapp.schema.channels import LOAD_CELL
from rigapp.texts import say
from rigapp_drivers.api import Block, Quality
from rigapp_model.compiled import njit

Array = NDArray[np.float64]

_SIGNATURE = (
    "float64({0}[::1], {0}[::1], float64[:, ::1], float64[::1], float64[:, ::1],"
    " float64[:, ::1], float64, float64)"
)


def _peak(
    raw_1: Array,
    raw_2: Array,
    gain: Array,
    bias: Array,
    quadratic_terms: Array,
    own: Array,
    count: float,
    step: float,
) -> float:
    largest = 0.0
    turn = own.shape[1]
    curved = False
    for j in range(3):
        curved = curved or quadratic_terms[0, j] != 0.0 or quadratic_terms[1, j] != 0.0
    for i in range(raw_1.shape[0]):
        x = gain[0, 0] * raw_1[i] + gain[0, 1] * raw_2[i] + bias[0]
        y = gain[1, 0] * raw_1[i] + gain[1, 1] * raw_2[i] + bias[1]
        if curved:
            x, y = linearised(x, y, quadratic_terms)
        if turn > 0:
            k = math.floor(count + step * i) % turn
            x += own[0, k]
            y += own[1, k]
        square = x * x + y * y
        if not square <= largest:
            if math.isnan(square):
                return square
            largest = square
    return largest


_peak_kernel = njit(
    [_SIGNATURE.format("float32"), _SIGNATURE.format("int32")], cache=True, nogil=True
)(_peak)


NOTHING = np.zeros((2, 0))
"""Pin weight of a calibration without correction."""


class PeakForce:
    """Largest joint force of a block, from raw samples."""

    def __init__(self, calibration: Calibration) -> None:
        self._rows = [calibration.rows[i] for i in calibration.inputs_of(LOAD_CELL)]
        self._gain, self._bias = calibration.force_gain()
        self._quadratic_terms = calibration.load_cell.quadratic_terms
        self._own = calibration.own_weight
        self.needs_angle = self._own.size > 0

    def of(self, values: Values, turning: tuple[float, float] | None = None) -> float:
        """Return the largest |F| of a block in N; NaN if a sample is NaN.

        turning: count of the first sample from the index, and counts per sample, for the pin's
        weight; None if unknown: then the force includes the weight.
        """
        first, second = self._rows
        own = self._own if turning is not None else NOTHING
        square = _peak_kernel(
            values[first],
            values[second],
            self._gain,
            self._bias,
            self._quadratic_terms,
            own,
            *(turning or (0.0, 0.0)),
        )
        return math.sqrt(square) if not math.isnan(square) else math.nan


AT_THE_END: Final = 0.98
"""Share of its range beyond which an input is a cause of a flagged sample."""

STAYS_S: Final = 0.1
"""Duration after which an input counts as saturated; excludes spikes."""

FLAG: Final = int(Quality.SATURATED)
"""The flag as int: numpy checks an enumeration for its protocols at each use."""

BACK_S: Final = 0.5
"""Time without a saturated sample after which an input is valid again."""


class SaturationWatch:
    """Saturation of the inputs of one connection, block by block."""

    def __init__(self, calibration: Calibration) -> None:
        self._names = calibration.names
        self._stays = max(1, round(STAYS_S * calibration.sample_rate_Hz))
        self._back = max(1, round(BACK_S * calibration.sample_rate_Hz))
        self._full = [0] * len(self._names)
        self._valid_samples = [0] * len(self._names)
        self._all_valid = True
        self.inputs: frozenset[str] = frozenset()

    def mark(self, inputs: Iterable[str]) -> None:
        """Mark inputs as saturated immediately."""
        self.inputs |= frozenset(inputs)
        self._all_valid = False

    def look(self, full: NDArray[np.bool_] | None, samples: int) -> bool:
        """Add the ``full_samples`` of a block; return whether ``inputs`` has changed."""
        if full is None:
            if self._all_valid:
                return False
            full = np.zeros((len(self._names), samples), np.bool_)
        for i, row in enumerate(full):
            self._full[i] = _trailing(row, self._full[i])
            self._valid_samples[i] = _trailing(~row, self._valid_samples[i])
        before = self.inputs
        for i, name in enumerate(self._names):
            if self._full[i] >= self._stays:
                self.inputs |= {name}
            elif self._valid_samples[i] >= self._back:
                self.inputs -= {name}
        self._all_valid = not self.inputs and not any(self._full)
        return self.inputs != before


def full_samples(block: Block, calibration: Calibration) -> NDArray[np.bool_] | None:
    """Return flags of the saturated samples, (inputs, samples); None if none is flagged."""
    if not np.bitwise_or.reduce(block.quality) & FLAG:
        return None
    share = np.abs(calibration.signals(block.values)) / calibration.ranges[:, None]
    return np.asarray((share >= AT_THE_END) & ((block.quality & FLAG) != 0), np.bool_)


def _trailing(condition: NDArray[np.bool_], before: int) -> int:
    """Return the number of samples up to the last one for which a condition has held."""
    broken = np.flatnonzero(~condition)
    if broken.size == 0:
        return int(before + condition.size)
    return int(condition.size - 1 - broken[-1])


# Comparison of the crank's speed by its encoder and by the drive, once after each start.
#
# Only this detects a gear ratio, a number of counts or a belt that differs from the rig file: the
# drive holds its own speed, and all revolutions appear complete. In a ramp the two speeds are of
# different times: there only a difference beyond that of the delay counts, so that a test that ends
# before its set speed is checked as well.

AGREE: Final = 0.1
"""Tolerance of the difference, relative to the set speed; above the ripple and the effect of the
age of the drive's reply at constant speed, below that of a wrong gear or pulley."""

LATE_S: Final = 0.5
"""Largest difference in time of the two speeds of a ramp, of the rig's time: the drive is polled
every 0.1 s and filters its speed over part of that, and the encoder's is a mean over 0.1 s."""

RAMP_FROM: Final = 0.25
"""Share of the set speed from which a ramp is checked; below, a drive's speed is a few counts."""

ANSWERS: Final = 5
"""Consecutive replies of the drive that decide: one may be as old as the ramp, not five."""


TURNING: Final = 0.5
"""Least share of the set speed shown by the encoder; without motion it has failed instead."""


@dataclass(slots=True)
class SpeedComparison:
    """Comparison since the last start; undecided until enough consecutive replies agree."""

    decided: bool = True
    last_answer_s: float = 0.0
    agreed: int = 0
    differed: int = 0

    def begin(self) -> None:
        """Restart the comparison with the drive's next reply."""
        self.decided = False
        self.agreed = self.differed = 0

    def differs(
        self,
        answered_s: float,
        encoder_rpm: float,
        drive_rpm: float,
        target_rpm: float,
        late_rpm: float | None = None,
    ) -> bool:
        """Add both speeds, rpm; return True once, after enough consecutive replies that differ.

        answered_s: time of the drive's reply; each reply counts once. NaN, from a drive without a
        measured speed, agrees with any speed. late_rpm: change of speed by a ramp within
        ``LATE_S``, None at the set speed; agreement in a ramp does not decide.
        """
        if self.decided or answered_s == self.last_answer_s:
            return False
        if late_rpm is None:
            allowed_rpm, turning = AGREE * target_rpm, encoder_rpm >= TURNING * target_rpm
        else:
            faster_rpm = max(encoder_rpm, drive_rpm)
            allowed_rpm = AGREE * faster_rpm + late_rpm
            turning = faster_rpm >= RAMP_FROM * target_rpm and encoder_rpm > AGREE * faster_rpm
        if not turning:
            return False
        self.last_answer_s = answered_s
        if abs(encoder_rpm - drive_rpm) > allowed_rpm:
            self.agreed, self.differed = 0, self.differed + 1
        else:
            self.agreed, self.differed = self.agreed + (late_rpm is None), 0
        self.decided = max(self.agreed, self.differed) >= ANSWERS
        return self.decided and self.differed > 0


def direction_mismatch(encoder_back: bool, drive_back: bool, directions: tuple[int, int]) -> str:
    """Return a text with the remedy if encoder or drive show the crank turning backwards.

    directions: present values of encoder.direction and spindle.direction.
    """
    encoder, spindle = directions
    if encoder_back and drive_back:
        return say(
            "Encoder and drive show the crank turning backwards, though forwards was"
            " commanded: check the motor's leads, and A and B of the drive's encoder."
        )
    if encoder_back:
        return say(
            "The encoder shows the crank turning backwards, while the drive turns"
            " forwards. If the crank turned counter-clockwise, exchange A and B of the"
            " crank encoder or set encoder.direction = {} in the rig file; if it did"
            " not, set spindle.direction = {}.",
            -encoder,
            -spindle,
        )
    return say(
        "The drive reports that it turns backwards, while the encoder shows forwards:"
        " exchange A and B of the drive's own encoder."
    )
