"""One cycle of the mechanism as table columns, in the units of their names."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.parameters import MM
from rigapp_model.wear.techniques import TECHNIQUES, Technique

if TYPE_CHECKING:
    from rigapp_model.dynamics import MechanismMotion
    from rigapp_model.parameters import Mechanism

COLUMNS = (
    "crank_angle_deg",
    "fx_N",
    "fy_N",
    "f_N",
    "fx_crank_N",
    "fy_crank_N",
    "fx_follower_N",
    "fy_follower_N",
    "torque_Nm",
    "slider_position_mm",
    "slider_velocity_m_per_s",
    "slider_acceleration_m_per_s2",
    "slip_mm",
)

Array = np.ndarray


def plane_words(mechanism: Mechanism) -> str:
    """Return the plane of motion of a mechanism as text, from its gravity."""
    x, y = mechanism.gravity
    if x == 0.0 and y == 0.0:
        return "horizontal plane (no gravity)"
    return f"gravity {x:g}, {y:g} m/s² along x, y"


@dataclass(frozen=True, slots=True)
class CycleTable:
    """Columns, a remark to print, warnings, and whether the table is complete."""

    columns: Mapping[str, Array]
    remark: str = ""
    sentences: tuple[str, ...] = ()
    complete: bool = True


def joint_technique(name: str) -> Technique:
    """Return the technique of --joint; raises UnusableInput for an unknown one."""
    demand(name in TECHNIQUES, "--joint", name, f"choose one of {', '.join(TECHNIQUES)}")
    return TECHNIQUES[name]


def demand(good: bool, option: str, value: object, words: str) -> None:
    """Raise UnusableInput unless the value of an option is good; words: the remedy."""
    if not good:
        shown = f"{value:g}" if isinstance(value, float) else value
        raise UnusableInput(f"{option} {shown}: {words}.")


def check_rpm(rpm: float) -> None:
    """Refuse a speed that is not above 0."""
    demand(math.isfinite(rpm) and rpm != 0.0, "--rpm", rpm, "give a finite speed other than 0")


def columns_of(degrees: Array, motion: MechanismMotion, pin_radius: float) -> dict[str, Array]:
    """Return the columns common to all joints."""
    values = (
        degrees,
        *motion.force,
        motion.force_magnitude,
        *motion.force_crank,
        *motion.force_follower,
        motion.drive_torque,
        motion.slider_position / MM,
        motion.slider_velocity,
        motion.slider_acceleration,
        motion.slip_increments(pin_radius) / MM,
    )
    return dict(zip(COLUMNS, values, strict=True))
