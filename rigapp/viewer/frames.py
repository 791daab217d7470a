"""The frames in which a force can be shown; the file keeps the crank frame."""

from __future__ import annotations

import enum
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rigapp.presentation.translation import Text

Floats = NDArray[np.float64]


class ForceFrame(enum.StrEnum):
    """The frame of the two components."""

    CRANK = "crank"
    FOLLOWER = "follower"
    GLOBAL = "global"


FRAME_NAMES: Final[dict[ForceFrame, Text]] = {
    ForceFrame.CRANK: "crank frame",
    ForceFrame.FOLLOWER: "follower frame",
    ForceFrame.GLOBAL: "global frame",
}

COMPONENT_NAMES: Final[dict[ForceFrame, tuple[Text, Text]]] = {
    ForceFrame.CRANK: ("along crank", "across crank"),
    ForceFrame.FOLLOWER: ("along follower", "across follower"),
    ForceFrame.GLOBAL: ("along x", "along y"),
}

SHORT_NAMES: Final[dict[ForceFrame, tuple[Text, Text]]] = {
    ForceFrame.CRANK: ("along", "across"),
    ForceFrame.FOLLOWER: ("along", "across"),
    ForceFrame.GLOBAL: COMPONENT_NAMES[ForceFrame.GLOBAL],
}
"""Names of the components in a text that names the frame as well."""


def follower_angle(crank_angle_rad: ArrayLike, crank_over_follower: float) -> Floats:
    """Return the angle of the follower (pin to wrist) from +x; the slider is on +x.

    crank_over_follower: crank radius divided by follower length, both from the test's mechanism.
    """
    return np.arcsin(-crank_over_follower * np.sin(np.asarray(crank_angle_rad, dtype=np.float64)))


def to_frame(
    along: ArrayLike,
    across: ArrayLike,
    crank_angle_deg: ArrayLike,
    frame: ForceFrame,
    crank_over_follower: float | None = None,
) -> tuple[Floats, Floats]:
    """Turn components along and across the crank into a frame; N and deg, arrays of one length.

    Raises ValueError for the follower frame when the mechanism is not known.
    """
    first = np.asarray(along, dtype=np.float64)
    second = np.asarray(across, dtype=np.float64)
    if frame is ForceFrame.CRANK:
        return first, second
    turn = np.radians(np.asarray(crank_angle_deg, dtype=np.float64))
    if frame is ForceFrame.FOLLOWER:
        if crank_over_follower is None:
            raise ValueError("The follower frame needs the mechanism of the test, which is unknown")
        turn = turn - follower_angle(turn, crank_over_follower)
    cosine, sine = np.cos(turn), np.sin(turn)
    return cosine * first - sine * second, sine * first + cosine * second
