"""The cycle of pin and bushing as separate bodies: a sample, or means of many revolutions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rigapp.commands.model.cycle import CycleTable, columns_of
from rigapp.commands.progress import check_time_limit, watched
from rigapp.config.errors import UnusableInput
from rigapp_model.wear.techniques import SOLVABLE, TECHNIQUES, listed

if TYPE_CHECKING:
    from rigapp_model.ensemble import Ensemble, Mean
    from rigapp_model.impact import ContactCycle
    from rigapp_model.impact_system import ClearanceSystem
    from rigapp_model.parameters import Parameters

CONTACT_COLUMNS = ("contact", "penetration_um", "contact_angle_deg")
FEWEST_REVOLUTIONS, MOST_REVOLUTIONS = 2, 1_000_000
SMALLEST_TOLERANCE, LARGEST_TOLERANCE = 1e-12, 0.1

Array = np.ndarray


@dataclass(frozen=True, slots=True)
class Impacting:
    """Hold what only separate bodies have: revolutions to average, tolerance, time limit (s)."""

    revolutions: int | None = None
    tolerance: float | None = None
    time_limit_s: float | None = None


def check_impacting(joint: str, options: Impacting) -> None:
    """Refuse options that another joint has no use for, or that are out of range."""
    for name, value in (("--revolutions", options.revolutions), ("--tolerance", options.tolerance)):
        if value is not None and joint in SOLVABLE:
            others = listed(tuple(one for one in TECHNIQUES if one not in SOLVABLE))
            raise UnusableInput(f"{name} has no meaning for --joint {joint}; use --joint {others}.")
    number, tolerance = options.revolutions, options.tolerance
    if number is not None and not FEWEST_REVOLUTIONS <= number <= MOST_REVOLUTIONS:
        raise UnusableInput(
            f"--revolutions {number}: give {FEWEST_REVOLUTIONS} to {MOST_REVOLUTIONS}."
        )
    if tolerance is not None and not SMALLEST_TOLERANCE <= tolerance <= LARGEST_TOLERANCE:
        raise UnusableInput(
            f"--tolerance {tolerance:g}: give {SMALLEST_TOLERANCE:g} to {LARGEST_TOLERANCE:g}."
        )
    check_time_limit(options.time_limit_s)


def impact_cycle(
    parameters: Parameters, speed: float, degrees: Array, options: Impacting
) -> CycleTable:
    """Return one revolution, and with ``options.revolutions`` their means beside it.

    One alone is the second revolution after a start in contact. Raises the model's OutOfTime when
    time runs out before there is one.
    """
    from rigapp_model.contact_law import ContactModel
    from rigapp_model.ensemble import ensemble
    from rigapp_model.impact import contact_cycle
    from rigapp_model.impact_system import clearance_system

    law = ContactModel() if options.tolerance is None else ContactModel(tolerance=options.tolerance)
    system = clearance_system(
        parameters.mechanism,
        parameters.joint,
        parameters.bushing.material,
        parameters.pin,
        speed,
        law,
    )
    with watched("revolutions", options.time_limit_s) as tell:
        if options.revolutions is None:
            sample, many = contact_cycle(system, len(degrees), progress=tell), None
        else:
            many = ensemble(system, options.revolutions, len(degrees), progress=tell)
            sample = many.sample
    columns = _sample_columns(system, degrees, sample)
    if many is not None:
        columns |= _mean_columns(many)
    if speed < 0.0:
        columns = {name: _backwards(name, column) for name, column in columns.items()}
    complete = many is None or many.revolutions == options.revolutions
    sentences = _sentences(system, sample, many)
    if many is not None and not complete:
        sentences.append(
            f"--time-limit-s {options.time_limit_s:g}: over after {many.revolutions} of"
            f" {options.revolutions} revolutions; the means are of these."
        )
    return CycleTable(columns, _remark(system, sample, many), tuple(sentences), complete)


def _sample_columns(
    system: ClearanceSystem, degrees: Array, cycle: ContactCycle
) -> dict[str, Array]:
    """Return the columns of one revolution."""
    columns = columns_of(degrees, cycle.motion, system.joint.pin_radius)
    values = (
        cycle.touching.astype(np.int64),
        1e6 * np.maximum(cycle.penetration, 0.0),
        np.degrees(cycle.contact_angle),
    )
    return columns | dict(zip(CONTACT_COLUMNS, values, strict=True))


def _mean_columns(many: Ensemble) -> dict[str, Array]:
    """Return mean and standard error beside each force, the torque and the contact."""
    means: dict[str, Mean] = {"f_N": many.force_magnitude, "torque_Nm": many.drive_torque}
    columns = {}
    for frame, mean in (
        ("", many.force),
        ("_crank", many.force_crank),
        ("_follower", many.force_follower),
    ):
        for axis, value, error in zip("xy", mean.value, mean.standard_error, strict=True):
            columns[f"f{axis}{frame}_N_mean"] = value
            columns[f"f{axis}{frame}_N_standard_error"] = error
    means["contact"] = many.touching
    for name, mean in means.items():
        columns[f"{name}_mean"] = mean.value
        columns[f"{name}_standard_error"] = mean.standard_error
    return columns


def _remark(system: ClearanceSystem, cycle: ContactCycle, many: Ensemble | None) -> str:
    """Return what is printed about the contact."""
    if many is None:
        remark = (
            f" In contact {100.0 * cycle.contact_fraction:.1f} % of the revolution,"
            f" {len(cycle.impacts)} impacts."
        )
    else:
        fraction, impacts, mean, most = (
            (float(found.value), float(found.standard_error))
            for found in (
                many.contact_fraction,
                many.impacts,
                many.mean_force,
                many.greatest_force,
            )
        )
        remark = (
            f" Over {many.revolutions} revolutions (mean +/- standard error): in contact"
            f" {100.0 * fraction[0]:.2f} +/- {100.0 * fraction[1]:.2f} % of the time,"
            f" {impacts[0]:.2f} +/- {impacts[1]:.2f} impacts a revolution, mean force"
            f" {mean[0]:.4g} +/- {mean[1]:.2g} N, greatest {most[0]:.4g} +/- {most[1]:.2g} N."
        )
    low, high = system.contact.friction_ramp
    if system.joint.friction_coefficient > 0.0:
        remark += (
            f" The ripple of the force depends on the friction ramp ({low:g} to {high:g} m/s) and"
            " is no measurement of the real joint."
        )
    return remark


def _sentences(system: ClearanceSystem, cycle: ContactCycle, many: Ensemble | None) -> list[str]:
    """Return what must be read: that a curve is one sample, and where the law does not hold."""
    sentences = []
    lost = many.contact_fraction.value < 1.0 if many else not cycle.contact_is_continuous
    if lost:
        advice = (
            "--revolutions N gives means over N of them with standard errors"
            if many is None
            else "the columns ending in _mean and _standard_error are over all of them"
        )
        sentences.append(
            "Pin and bushing lose contact: the motion is chaotic and this curve is one sample of"
            f" it, no revolution is like the next; {advice}."
        )
    deepest = float(cycle.penetration.max())
    if deepest > system.joint.clearance:
        sentences.append(
            f"The pin presses {1e6 * deepest:.0f} um into the bushing, deeper than the clearance of"
            f" {1e6 * system.joint.clearance:.0f} um: the law of a small contact does not hold"
            " there."
        )
    return sentences


def _backwards(name: str, column: Array) -> Array:
    """Return a column that was sampled at falling angles in the order of rising ones."""
    if name == "crank_angle_deg":
        return column
    if name == "slip_mm":
        return column[::-1]
    return np.roll(column[::-1], 1)
