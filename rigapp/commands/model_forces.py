"""`rigapp model forces`: one cycle of the mechanism as a table."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rigapp.commands.tables import check_target, write_table
from rigapp.config.errors import UnusableInput
from rigapp.config.model_parameters import MM, read_parameters

if TYPE_CHECKING:
    from model.dynamics import Motion
    from model.parameters import Parameters

JOINTS = ("perfect", "continuous", "contact")
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
CONTACT_COLUMNS = ("contact", "penetration_um", "contact_angle_deg")
FEWEST_POINTS, MOST_POINTS = 4, 1_000_000

Array = np.ndarray


def write_forces(
    params_path: Path,
    rpm: float,
    joint: str,
    clearance_mm: float | None,
    points: int,
    target: Path,
) -> int:
    """Write one cycle at ``points`` equal crank angles as CSV, replacing an earlier table.

    joint: perfect, continuous or contact; clearance_mm: radial clearance instead of the file's (not
    with perfect). A sentence on stderr says where continuous contact does not hold. Returns the
    exit status 0; raises UnusableInput naming what cannot be used.
    """
    _check(rpm, joint, clearance_mm, points, params_path, target)
    parameters = _with_clearance(read_parameters(params_path), params_path, clearance_mm)
    try:
        columns, remark, warning = _cycle(parameters, rpm, joint, points)
    except ValueError as error:
        raise UnusableInput(f"{params_path}: {error}.") from error
    write_table("--to", target, columns)
    size = columns["f_N"]
    print(
        f"{target}: {points} crank angles at {rpm:g} rpm, joint {joint}; "
        f"force {size.min():.3f} to {size.max():.3f} N.{remark}"
    )
    if warning:
        print(warning, file=sys.stderr)
    return 0


def _check(
    rpm: float, joint: str, clearance_mm: float | None, points: int, source: Path, target: Path
) -> None:
    """Refuse what the options cannot mean."""
    if not math.isfinite(rpm) or rpm == 0.0:
        raise UnusableInput(f"--rpm {rpm:g}: give a finite speed other than 0.")
    if joint not in JOINTS:
        raise UnusableInput(f"--joint {joint}: choose one of {', '.join(JOINTS)}.")
    if not FEWEST_POINTS <= points <= MOST_POINTS:
        raise UnusableInput(f"--points {points}: give {FEWEST_POINTS} to {MOST_POINTS}.")
    if clearance_mm is not None:
        if not math.isfinite(clearance_mm) or clearance_mm < 0.0:
            raise UnusableInput(f"--clearance-mm {clearance_mm:g}: give 0 or more.")
        if joint == "perfect" and clearance_mm != 0.0:
            raise UnusableInput(
                "--clearance-mm has no meaning for a perfect joint; use --joint continuous or"
                " contact."
            )
    check_target("--to", target, source)


def _with_clearance(parameters: Parameters, path: Path, clearance_mm: float | None) -> Parameters:
    """Return the parameters with the bushing's radius set by a clearance."""
    if clearance_mm is None:
        return parameters
    radius = parameters.joint.pin_radius + clearance_mm * MM
    try:
        return replace(parameters, joint=replace(parameters.joint, bushing_radius=radius))
    except ValueError as error:
        raise UnusableInput(f"{path} with --clearance-mm {clearance_mm:g}: {error}.") from error


def _cycle(
    parameters: Parameters, rpm: float, joint: str, points: int
) -> tuple[dict[str, Array], str, str]:
    """Return the columns, a remark for stdout and a warning for stderr."""
    from model.joints import continuous_contact, perfect_joint

    speed = rpm * np.pi / 30.0
    degrees = 360.0 / points * np.arange(points)
    mechanism, bearing = parameters.mechanism, parameters.joint
    if joint == "perfect":
        motion = perfect_joint(mechanism, np.deg2rad(degrees), speed, joint=bearing)
        return _columns(degrees, motion, bearing.pin_radius), "", ""
    if joint == "continuous":
        answer = continuous_contact(mechanism, bearing, np.deg2rad(degrees), speed)
        columns = _columns(degrees, answer.motion, bearing.pin_radius)
        return columns, "", answer.sentence()
    return _contact(parameters, speed, degrees)


def _contact(
    parameters: Parameters, speed: float, degrees: Array
) -> tuple[dict[str, Array], str, str]:
    """Return technique 3's columns: the second revolution after a start in contact."""
    from model.impact import contact_cycle
    from model.impact_system import clearance_system

    bearing, points = parameters.joint, len(degrees)
    system = clearance_system(
        parameters.mechanism, bearing, parameters.bushing.material, parameters.pin, speed
    )
    cycle = contact_cycle(system, points)
    columns = _columns(degrees, cycle.motion, bearing.pin_radius)
    columns["contact"] = cycle.touching.astype(np.int64)
    columns["penetration_um"] = 1e6 * np.maximum(cycle.penetration, 0.0)
    columns["contact_angle_deg"] = np.degrees(cycle.contact_angle)
    if speed < 0.0:
        columns = {name: _backwards(name, column) for name, column in columns.items()}
    remark = (
        f" In contact {100.0 * cycle.contact_fraction:.1f} % of the revolution,"
        f" {len(cycle.impacts)} impacts."
    )
    low, high = system.contact.friction_ramp
    if bearing.friction_coefficient > 0.0:
        remark += (
            f" The ripple of the force depends on the friction ramp ({low:g} to {high:g} m/s) and"
            " is no measurement of the real joint."
        )
    warning = ""
    deepest = float(cycle.penetration.max())
    if deepest > bearing.clearance:
        warning = (
            f"The pin presses {1e6 * deepest:.0f} um into the bushing, deeper than the clearance of"
            f" {1e6 * bearing.clearance:.0f} um: the law of a small contact does not hold there."
        )
    return columns, remark, warning


def _backwards(name: str, column: Array) -> Array:
    """Return a column that was sampled at falling angles in the order of rising ones."""
    if name == "crank_angle_deg":
        return column
    if name == "slip_mm":
        return column[::-1]
    return np.roll(column[::-1], 1)


def _columns(degrees: Array, motion: Motion, pin_radius: float) -> dict[str, Array]:
    """Return the columns that every joint has, in the units of their names."""
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
