"""Check blocks and speeds at once: largest force, saturated inputs, encoder against drive."""

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
"""Weight of a pin that is not taken off."""


class PeakForce:
    """Find the largest joint force of a block, from the samples as they came."""

    def __init__(self, calibration: Calibration) -> None:
        self._rows = [calibration.rows[i] for i in calibration.inputs_of(LOAD_CELL)]
        self._gain, self._bias = calibration.force_gain()
        self._quadratic_terms = calibration.load_cell.quadratic_terms
        self._own = calibration.own_weight
        self.needs_angle = self._own.size > 0

    def of(self, values: Values, turning: tuple[float, float] | None = None) -> float:
        """Return the largest |F| of a block in N; NaN when a sample is not a number.

        turning: count of the first sample from the index, and counts from one to the next, for what
        the pin's weight; None where they are not known, and the weight stays in the force.
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
"""A flagged sample belongs to every input whose signal is beyond this share of its range."""

STAYS_S: Final = 0.1
"""An input counts as saturated after so long without a sound sample: a spike does not."""

FLAG: Final = int(Quality.SATURATED)
"""The flag as a plain number: numpy checks an enumeration for its protocols at every use."""

BACK_S: Final = 0.5
"""It counts as sound again after so long without a saturated one."""


class SaturationWatch:
    """Follow the inputs of one connection, block by block."""

    def __init__(self, calibration: Calibration) -> None:
        self._names = calibration.names
        self._stays = max(1, round(STAYS_S * calibration.sample_rate_Hz))
        self._back = max(1, round(BACK_S * calibration.sample_rate_Hz))
        self._full = [0] * len(self._names)
        self._sound = [0] * len(self._names)
        self._calm = True
        self.inputs: frozenset[str] = frozenset()

    def mark(self, inputs: Iterable[str]) -> None:
        """Count inputs as saturated at once."""
        self.inputs |= frozenset(inputs)
        self._calm = False

    def look(self, full: NDArray[np.bool_] | None, samples: int) -> bool:
        """Take a block, ``full_samples`` of it; return whether ``inputs`` has changed."""
        if full is None:
            if self._calm:
                return False
            full = np.zeros((len(self._names), samples), np.bool_)
        for i, row in enumerate(full):
            self._full[i] = _trailing(row, self._full[i])
            self._sound[i] = _trailing(~row, self._sound[i])
        before = self.inputs
        for i, name in enumerate(self._names):
            if self._full[i] >= self._stays:
                self.inputs |= {name}
            elif self._sound[i] >= self._back:
                self.inputs -= {name}
        self._calm = not self.inputs and not any(self._full)
        return self.inputs != before


def full_samples(block: Block, calibration: Calibration) -> NDArray[np.bool_] | None:
    """Return where each input is saturated, (inputs, samples); None where none is flagged."""
    if not np.bitwise_or.reduce(block.quality) & FLAG:
        return None
    share = np.abs(calibration.signals(block.values)) / calibration.ranges[:, None]
    return np.asarray((share >= AT_THE_END) & ((block.quality & FLAG) != 0), np.bool_)


def _trailing(condition: NDArray[np.bool_], before: int) -> int:
    """Return for how many samples up to the last one a condition has held."""
    broken = np.flatnonzero(~condition)
    if broken.size == 0:
        return int(before + condition.size)
    return int(condition.size - 1 - broken[-1])


# Compare, once after every start, the crank's speed by its encoder and by the drive.
#
# A gear ratio, a number of counts or a belt that differs from the rig file shows here and
# nowhere else: the drive holds its own speed, and every revolution looks whole. In a
# ramp both speeds are of different moments: there only a difference counts that no lateness
# explains, so that a test is also judged that ends before it reaches its set speed.

AGREE: Final = 0.1
"""Share of the set speed within which both must agree; ripple and age of the drive's answer
stay well below at a steady speed, a wrong gear or pulley does not."""

LATE_S: Final = 0.5
"""How far apart the moments of two speeds of a ramp may be, of the rig's time: the drive is polled
each 0.1 s and filters its speed over some of that, and the encoder's is a mean over 0.1 s."""

RAMP_FROM: Final = 0.25
"""Share of the set speed from which a ramp is judged: below, a drive's speed is a few counts."""

ANSWERS: Final = 5
"""Answers of the drive in a row that decide: one may be as old as the ramp, five may not."""


TURNING: Final = 0.5
"""Share of the set speed that the encoder must show: without any motion it is lost, not wrong."""


@dataclass(slots=True)
class SpeedComparison:
    """The comparison since the last start; undecided until enough answers in a row agree."""

    decided: bool = True
    last_answer_s: float = 0.0
    agreed: int = 0
    differed: int = 0

    def begin(self) -> None:
        """Start the comparison again with the drive's next answer."""
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
        """Take both speeds, rpm; True once, when enough answers in a row differ.

        answered_s: when the drive answered; an answer counts once. A speed that is no number, of a
        drive that measures none, agrees with every other. late_rpm: by how much a ramp changes the
        speed within ``LATE_S``, None at the set speed; agreement in a ramp decides nothing.
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
    """Return what to do when encoder or drive show the crank turning backwards.

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
