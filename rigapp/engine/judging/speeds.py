"""Compare, once after every start, the crank's speed as its encoder and as the drive tell it.

A gear ratio, a number of counts or a belt that is not what the rig file says shows here and nowhere
else: the drive holds the speed it believes in, and every revolution looks whole. In a ramp both
tell a speed of another moment: there only a difference counts that no lateness explains, so that
also a test is judged that ends before it reaches its set speed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from rigapp.texts import say

AGREE: Final = 0.1
"""Share of the set speed within which both must tell the same; ripple and age of the drive's answer
stay well below at a steady speed, a wrong gear or pulley does not."""

LATE_S: Final = 0.5
"""How far apart the moments of two speeds of a ramp may be, of the rig's time: the drive is asked
each 0.1 s and filters its speed over some of that, and the encoder's is a mean over 0.1 s."""

RAMP_FROM: Final = 0.25
"""Share of the set speed from which a ramp is judged: below, a drive's speed is a few counts."""

ANSWERS: Final = 5
"""Answers of the drive in a row that decide: one may be as old as the ramp, five may not."""


TURNING: Final = 0.5
"""Share of the set speed that the encoder must show: one that stands is lost, not wrong."""


@dataclass(slots=True)
class SpeedComparison:
    """What is known since the last start; undecided until enough answers in a row say the same."""

    decided: bool = True
    last_answer_s: float = 0.0
    agreed: int = 0
    differed: int = 0

    def begin(self) -> None:
        """Compare anew, from the drive's next answer on."""
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
        """Take both speeds, rpm; True once when they differ for good.

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
