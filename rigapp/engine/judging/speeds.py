"""Compare, once after every start, the crank's speed as its encoder and as the drive tell it.

A gear ratio, a number of counts or a belt that is not what the rig file says shows here and nowhere
else: the drive holds the speed that it believes in, and every revolution looks whole.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

AGREE: Final = 0.1
"""Share of the set speed within which both must tell the same; ripple and age of the drive's answer
stay well below at a steady speed, a wrong gear or pulley does not."""

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
        self, answered_s: float, encoder_rpm: float, drive_rpm: float, target_rpm: float
    ) -> bool:
        """Take both speeds at the set speed, rpm; True once when they differ for good.

        answered_s: when the drive answered; an answer counts once. A speed that is no number, of a
        drive that measures none, agrees with every other.
        """
        told = self.decided or answered_s == self.last_answer_s
        if told or encoder_rpm < TURNING * target_rpm:
            return False
        self.last_answer_s = answered_s
        if abs(encoder_rpm - drive_rpm) > AGREE * target_rpm:
            self.agreed, self.differed = 0, self.differed + 1
        else:
            self.agreed, self.differed = self.agreed + 1, 0
        self.decided = max(self.agreed, self.differed) >= ANSWERS
        return self.decided and self.differed > 0


def wrong_sense(encoder_back: bool, drive_back: bool, directions: tuple[int, int]) -> str:
    """Return what to do when encoder or drive show the crank turning backwards.

    directions: present values of encoder.direction and spindle.direction.
    """
    encoder, spindle = directions
    if encoder_back and drive_back:
        return (
            "Encoder and drive show the crank turning backwards, though forwards was commanded: "
            "check the motor's leads, and A and B of the drive's encoder."
        )
    if encoder_back:
        return (
            "The encoder shows the crank turning backwards, while the drive turns forwards. If the "
            "crank turned counter-clockwise, exchange A and B of the crank encoder or set "
            f"encoder.direction = {-encoder} in the rig file; if it did not, set "
            f"spindle.direction = {-spindle}."
        )
    return (
        "The drive reports that it turns backwards, while the encoder shows forwards: exchange "
        "A and B of the drive's own encoder."
    )
