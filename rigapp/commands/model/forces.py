"""`rigapp model forces`: one cycle as a table; for separate bodies one sample or means of many."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rigapp.commands.model.cycle import (
    CycleTable,
    check_rpm,
    columns_of,
    demand,
    joint_technique,
    plane_words,
)
from rigapp.commands.progress import check_time_limit, watched
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_parameters
from rigapp.config.parameters import MM
from rigapp.report.tables import check_target, write_table
from rigapp_model.wear.techniques import SOLVABLE, TECHNIQUES, listed

if TYPE_CHECKING:
    from rigapp_model.contact.ensemble import Ensemble, Mean
    from rigapp_model.contact.impact import ContactCycle
    from rigapp_model.contact.impact_system import ClearanceSystem
    from rigapp_model.parameters import Parameters


CONTACT_COLUMNS = ("contact", "penetration_um", "contact_angle_deg")
FEWEST_REVOLUTIONS, MOST_REVOLUTIONS = 2, 1_000_000
LARGEST_NOISE = 1e-3
"""Share of the force above which numerical noise is reported."""
SMALLEST_TOLERANCE, LARGEST_TOLERANCE = 1e-12, 0.1

Array = np.ndarray


@dataclass(frozen=True, slots=True)
class Impacting:
    """Options of separate bodies: revolutions to average, tolerance, time limit (s).

    contact_law, restitution: None for those of the parameter file.
    """

    revolutions: int | None = None
    tolerance: float | None = None
    time_limit_s: float | None = None
    contact_law: str | None = None
    restitution: float | None = None


def check_impacting(joint: str, options: Impacting) -> None:
    """Refuse options that do not apply to the joint, or that are out of range."""
    check_contact_options(
        joint,
        {
            "--revolutions": options.revolutions,
            "--tolerance": options.tolerance,
            "--contact-law": options.contact_law,
            "--restitution": options.restitution,
        },
    )
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


def check_contact_options(joint: str, options: Mapping[str, object]) -> None:
    """Refuse options (name -> value, None where not given) that do not apply to the joint."""
    for name, value in options.items():
        if value is not None and joint in SOLVABLE:
            others = listed(
                tuple(technique for technique in TECHNIQUES if technique not in SOLVABLE)
            )
            raise UnusableInput(f"{name} has no meaning for --joint {joint}; use --joint {others}.")


def with_contact_law(
    parameters: Parameters, law: str | None, restitution: float | None
) -> Parameters:
    """Return the parameters with another contact law or restitution than the file's."""
    from rigapp_model.errors import ModelError
    from rigapp_model.restitution import check_law

    joint = parameters.joint
    law = joint.contact_law if law is None else law
    restitution = joint.restitution if restitution is None else restitution
    try:
        check_law(law, restitution)
    except ModelError as error:
        shown = f"--contact-law {law}" if error.quantity == "contact_law" else ""
        shown = shown or f"--restitution {restitution:g}"
        raise UnusableInput(f"{shown}: {error.remedy}.") from error
    return replace(parameters, joint=replace(joint, contact_law=law, restitution=restitution))


def impact_cycle(
    parameters: Parameters, speed: float, degrees: Array, options: Impacting
) -> CycleTable:
    """Return one revolution, and with ``options.revolutions`` also means over revolutions.

    A single one is the second revolution after a start in contact. Raises the model's OutOfTime
    when time runs out before there is one.
    """
    from rigapp_model.contact.ensemble import ensemble
    from rigapp_model.contact.impact import contact_cycle
    from rigapp_model.contact.impact_system import clearance_system
    from rigapp_model.contact_law import ContactModel

    joint = parameters.joint
    law = ContactModel(joint.contact_law, joint.restitution)
    if options.tolerance is not None:
        law = replace(law, tolerance=options.tolerance)
    system = clearance_system(
        parameters.mechanism,
        parameters.joint,
        parameters.bushing.material,
        parameters.pin,
        speed,
        law,
    )
    with watched("revolutions", options.time_limit_s) as report:
        if options.revolutions is None:
            sample, many = contact_cycle(system, len(degrees), progress=report), None
        else:
            many = ensemble(system, options.revolutions, len(degrees), progress=report)
            sample = many.sample
        noise = _noise_of(system, sample, many, len(degrees), report)
    columns = _sample_columns(system, degrees, sample)
    if many is not None:
        columns |= _mean_columns(many)
    if speed < 0.0:
        columns = {name: _backwards(name, column) for name, column in columns.items()}
    complete = many is None or many.revolutions == options.revolutions
    sentences = [*_noise(system, sample, noise), *_sentences(system, sample, many)]
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
    columns["slip_mm"] = 1e3 * cycle.slip
    return columns | dict(zip(CONTACT_COLUMNS, values, strict=True))


def _mean_columns(many: Ensemble) -> dict[str, Array]:
    """Return mean and standard error of each force, the torque and the contact."""
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
    """Return the remark about the contact."""
    if many is None:
        remark = (
            f" In contact {100.0 * cycle.contact_fraction:.1f} % of the revolution,"
            f" {len(cycle.impacts)} impacts, greatest force {cycle.greatest_force:.4g} N between"
            " the angles too."
        )
    else:
        fraction, impacts, mean, most = (
            (float(mean_of.value), float(mean_of.standard_error))
            for mean_of in (
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
            f" {mean[0]:.4g} +/- {mean[1]:.2g} N, greatest {most[0]:.4g} +/- {most[1]:.2g} N"
            f" between the angles too.{_peaks(many.peaks)}"
        )
    low, high = system.contact.friction_ramp
    if system.joint.friction_coefficient > 0.0:
        remark += (
            f" The ripple of the force depends on the friction ramp ({low:g} to {high:g} m/s) and"
            " is no measurement of the real joint."
        )
    return remark


def _peaks(peaks: Array) -> str:
    """Return the distribution of the peak forces of impacts (N) as text; empty without impacts."""
    if not len(peaks):
        return ""
    half, most, rare = np.quantile(peaks, (0.5, 0.9, 0.99))
    return (
        f" Greatest force of each of {len(peaks)} impacts: half above {half:.4g} N, one in 10 above"
        f" {most:.4g} N, one in 100 above {rare:.4g} N, the largest {peaks.max():.4g} N."
    )


def _noise_of(
    system: ClearanceSystem,
    sample: ContactCycle,
    many: Ensemble | None,
    points: int,
    report: Callable[[float], None],
) -> float | None:
    """Return the numerical noise of the force, N RMS; NaN if unknown, None if time ran out."""
    from rigapp_model.contact.impact import contact_cycle, numerical_noise
    from rigapp_model.contact_law import ContactModel
    from rigapp_model.errors import OutOfTime

    if not sample.contact_is_continuous and system.contact.tolerance <= ContactModel().tolerance:
        return float("nan")
    try:
        # The sample of an ensemble is a later revolution than the one of the finer run.
        first = contact_cycle(system, points, progress=report) if many else sample
        return numerical_noise(system, first, points, progress=report)
    except OutOfTime:
        return None


def _noise(system: ClearanceSystem, cycle: ContactCycle, noise: float | None) -> list[str]:
    """Return a warning about the numerical noise (N RMS, NaN: not known) if it is significant."""
    from rigapp_model.contact_law import ContactModel

    chosen, usual = system.contact.tolerance, ContactModel().tolerance
    if noise is None:
        return []
    if math.isnan(noise):
        if chosen <= usual:
            return []
        return [
            f"--tolerance {chosen:g} is coarser than {usual:g}; where contact is lost its numerical"
            f" noise cannot be told from the motion: compare means of both."
        ]
    size = float(np.sqrt(np.mean(cycle.motion.force_magnitude**2)))
    if noise <= LARGEST_NOISE * size:
        return []
    return [
        f"--tolerance {chosen:g} leaves numerical noise of {noise:.2g} N RMS in a force of"
        f" {size:.3g} N RMS; give a smaller one, {usual:g} by default."
    ]


def _sentences(system: ClearanceSystem, cycle: ContactCycle, many: Ensemble | None) -> list[str]:
    """Return warnings: a curve is only one sample, and the law is used out of its range."""
    sentences = [sentence for sentence in [system.contact.sentence()] if sentence]
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
    fastest, full = float(np.abs(cycle.sliding).max()), system.contact.friction_ramp[1]
    if system.joint.friction_coefficient > 0.0 and fastest < full:
        sentences.append(
            f"The pin slides at {1e3 * fastest:.2g} mm/s at most; friction acts in full only from"
            f" {1e3 * full:.2g} mm/s on, so this curve has too little of it."
        )
    deepest = float(cycle.penetration.max())
    if deepest > system.deepest:
        sentences.append(
            f"The pin presses {1e6 * deepest:.0f} um into the bushing; the contact law"
            f" {system.contact.law} does not hold beyond {1e6 * system.deepest:.0f} um."
        )
    return sentences


def _backwards(name: str, column: Array) -> Array:
    """Return a column sampled at decreasing angles in the order of increasing ones."""
    if name == "crank_angle_deg":
        return column
    if name == "slip_mm":
        return column[::-1]
    return np.roll(column[::-1], 1)


FEWEST_POINTS, MOST_POINTS = 4, 1_000_000


def write_forces(
    params_path: Path,
    rpm: float,
    joint: str,
    clearance_mm: float | None,
    points: int,
    target: Path,
    impacting: Impacting | None = None,
) -> int:
    """Write one cycle at ``points`` equal crank angles as CSV, replacing an earlier table.

    joint: one of ``TECHNIQUES``; clearance_mm: radial clearance instead of the file's, where the
    joint has one; impacting: options of separate bodies. Warnings on stderr: angles where
    continuous contact does not hold, and that a curve is one sample of a chaotic motion. Return the
    exit status: 0, or 1 when time ran out. Raises UnusableInput naming the unusable input.
    """
    from rigapp_model.errors import OutOfTime

    options = impacting or Impacting()
    _check(rpm, joint, clearance_mm, points, params_path, target)
    check_impacting(joint, options)
    parameters = _with_clearance(read_parameters(params_path), params_path, clearance_mm)
    parameters = with_contact_law(parameters, options.contact_law, options.restitution)
    try:
        cycle = _cycle(parameters, rpm, joint, points, options)
    except OutOfTime:
        print(
            f"--time-limit-s {options.time_limit_s:g}: over before the first revolution;"
            f" {target} is not written.",
            file=sys.stderr,
        )
        return 1
    except ValueError as error:
        raise UnusableInput(f"{params_path}: {error}.") from error
    write_table("--to", target, cycle.columns)
    size = cycle.columns["f_N"]
    print(
        f"{target}: {points} crank angles at {rpm:g} rpm, joint {joint}; "
        f"force {size.min():.3f} to {size.max():.3f} N; {plane_words(parameters.mechanism)}."
        f"{cycle.remark}"
    )
    for sentence in cycle.sentences:
        print(sentence, file=sys.stderr)
    return 0 if cycle.complete else 1


def _check(
    rpm: float, joint: str, clearance_mm: float | None, points: int, source: Path, target: Path
) -> None:
    """Refuse unusable options."""
    check_rpm(rpm)
    technique = joint_technique(joint)
    enough = FEWEST_POINTS <= points <= MOST_POINTS
    demand(enough, "--points", points, f"give {FEWEST_POINTS} to {MOST_POINTS}")
    if clearance_mm is not None:
        usable = math.isfinite(clearance_mm) and clearance_mm >= 0.0
        demand(usable, "--clearance-mm", clearance_mm, "give 0 or more")
        if "clearance" not in technique.needs and clearance_mm != 0.0:
            others = tuple(
                technique.name
                for technique in TECHNIQUES.values()
                if "clearance" in technique.needs
            )
            raise UnusableInput(
                f"--clearance-mm has no meaning for a {joint} joint; use --joint {listed(others)}."
            )
    check_target("--to", target, source)


def _with_clearance(parameters: Parameters, path: Path, clearance_mm: float | None) -> Parameters:
    """Return the parameters with the bushing's radius set from a clearance."""
    if clearance_mm is None:
        return parameters
    radius = parameters.joint.pin_radius + clearance_mm * MM
    try:
        return replace(parameters, joint=replace(parameters.joint, bushing_radius=radius))
    except ValueError as error:
        raise UnusableInput(f"{path} with --clearance-mm {clearance_mm:g}: {error}.") from error


def _cycle(
    parameters: Parameters, rpm: float, joint: str, points: int, impacting: Impacting
) -> CycleTable:
    """Return the cycle computed with the chosen technique."""
    speed = rpm * np.pi / 30.0
    degrees = 360.0 / points * np.arange(points)
    solve = TECHNIQUES[joint].solve
    if solve is None:
        return impact_cycle(parameters, speed, degrees, impacting)
    motion, sentence = solve(parameters, np.deg2rad(degrees), speed, 0.0, 0.0)
    columns = columns_of(degrees, motion, parameters.joint.pin_radius)
    return CycleTable(columns, sentences=tuple(filter(None, [sentence])))
