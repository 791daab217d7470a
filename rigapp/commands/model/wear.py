"""`rigapp model wear`, `pressure` and `paper`: life and contact of the bushing, comparisons."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np

from rigapp.commands.model.cycle import check_rpm, demand, joint_technique, plane_words
from rigapp.commands.model.forces import check_contact_options, with_contact_law
from rigapp.commands.progress import check_time_limit, watched
from rigapp.config.errors import UnusableInput
from rigapp.config.loading import read_parameters
from rigapp.config.parameters import MM, MPA
from rigapp.report.tables import check_target, write_table

if TYPE_CHECKING:
    from rigapp_model.wear.life import Life


METHODS = ("implicit", "explicit")
CONTACTS = ("finite-element", "winkler")
MM2 = 1e-6
GRAM = 1e-3
LARGEST_TOLERANCE = 0.1
SMALLEST_TOLERANCE = 1e-5


@dataclass(frozen=True, slots=True)
class Scheme:
    """Options for the computation of a life.

    method: implicit or explicit; extrapolation: largest explicit step in cycles, None for half the
    stability limit; contact: finite-element or winkler. contact_law, restitution: of separate
    bodies, None for those of the parameter file.
    """

    method: str = "implicit"
    extrapolation: float | None = None
    contact: str = "finite-element"
    contact_law: str | None = None
    restitution: float | None = None


def write_wear(
    params_path: Path,
    rpm: float,
    cycles: int,
    joint: str,
    force_N: float | None,
    tolerance: float,
    target: Path,
    profile: Path | None,
    time_limit_s: float | None = None,
    scheme: Scheme | None = None,
) -> int:
    """Write the life of the bushing as CSV, and its worn profile if a name is given.

    joint: one of ``TECHNIQUES``; force_N: a constant force along the follower, positive in tension,
    instead of the mechanism's; tolerance: largest relative error of the depth at the end;
    time_limit_s: time after which the partial result is written; scheme: implicit steps and finite
    elements if None. Warnings go to stderr. Return the exit status: 0, or 1 when the tolerance was
    missed or time ran out. Raises UnusableInput naming the unusable input.
    """
    from rigapp_model.errors import OutOfTime
    from rigapp_model.wear.life import life

    _check_wear(params_path, rpm, cycles, joint, force_N, tolerance, target, profile)
    scheme = scheme or Scheme()
    _check_scheme(scheme)
    check_time_limit(time_limit_s)
    contact_options = {"--contact-law": scheme.contact_law, "--restitution": scheme.restitution}
    check_contact_options(joint, contact_options)
    parameters = with_contact_law(
        read_parameters(params_path), scheme.contact_law, scheme.restitution
    )
    try:
        with watched("wear", time_limit_s) as report, _plain(params_path, force_N):
            result = life(
                parameters,
                rpm * np.pi / 30.0,
                float(cycles),
                joint,
                tolerance,
                force_N,
                report,
                method=cast(Literal["implicit", "explicit"], scheme.method),
                step=scheme.extrapolation,
                contact=cast(Literal["finite-element", "winkler"], scheme.contact),
            )
    except OutOfTime:
        print(
            f"--time-limit-s {time_limit_s:g}: over before the first row; {target} is not written.",
            file=sys.stderr,
        )
        return 1
    write_table("--to", target, _wear_columns(result))
    if profile is not None:
        columns = {"angle_deg": np.degrees(result.angle), "depth_mm": result.depth / MM}
        write_table("--profile", profile, columns)
    by_mechanism = f"joint {joint}, {plane_words(parameters.mechanism)}"
    kind = by_mechanism if force_N is None else f"constant force {force_N:g} N"
    print(_summary(target, result, kind))
    for note in result.notes:
        print(note, file=sys.stderr)
    return 0 if result.tolerance_met and result.complete else 1


def write_pressure(params_path: Path, force_N: float, target: Path) -> int:
    """Write the contact pressure for a force along the follower, print the pin's displacement.

    Angles from -180 to 180 deg, 0 at the middle of the contact. Return the exit status 0. Raises
    UnusableInput when the bushing cannot carry the force.
    """
    from rigapp_model.bushing.ring import pressure_distribution, ring_of

    presses = math.isfinite(force_N) and force_N > 0.0
    demand(presses, "--force-N", force_N, "give a finite force above 0")
    check_target("--to", target, params_path)
    parameters = read_parameters(params_path)
    joint = parameters.joint
    with _plain(params_path, force_N):
        ring = ring_of(joint, parameters.bushing.material)
        contact = pressure_distribution(ring, (force_N / joint.bushing_width, 0.0))
    angle = np.append(contact.angle, np.pi)
    pressure = np.append(contact.pressure, contact.pressure[0])
    columns = {"angle_deg": np.degrees(angle), "pressure_MPa": pressure / MPA}
    write_table("--to", target, columns)
    print(
        f"{target}: pin displacement {contact.pin[0] / MM:.6f} mm, of which"
        f" {(contact.pin[0] - ring.clearance) / MM:.6f} mm is indentation; peak pressure"
        f" {pressure.max() / MPA:.4f} MPa; contact half-angle"
        f" {np.degrees(contact.half_angle):.2f} deg."
    )
    return 0


def _check_wear(
    source: Path,
    rpm: float,
    cycles: int,
    joint: str,
    force_N: float | None,
    tolerance: float,
    target: Path,
    profile: Path | None,
) -> None:
    """Refuse unusable options."""
    check_rpm(rpm)
    demand(cycles >= 1, "--cycles", cycles, "give at least 1")
    joint_technique(joint)
    pulls = force_N is None or (math.isfinite(force_N) and force_N != 0.0)
    demand(pulls, "--force-N", force_N, "give a finite force other than 0")
    reached = SMALLEST_TOLERANCE <= tolerance <= LARGEST_TOLERANCE
    words = f"give {SMALLEST_TOLERANCE:g} to {LARGEST_TOLERANCE:g}"
    demand(reached, "--tolerance", tolerance, words)
    check_target("--to", target, source)
    if profile is not None:
        check_target("--profile", profile, source)
        another = profile.absolute() != target.absolute()
        demand(another, "--profile", profile, "that is the --to file; give another name")


def _check_scheme(scheme: Scheme) -> None:
    """Refuse unusable options of the computation."""
    for name, value, known in (
        ("--method", scheme.method, METHODS),
        ("--contact", scheme.contact, CONTACTS),
    ):
        demand(value in known, name, value, f"choose one of {', '.join(known)}")
    step = scheme.extrapolation
    if step is not None and scheme.method != "explicit":
        raise UnusableInput(
            f"--extrapolation has no meaning for --method {scheme.method}; use --method explicit."
        )
    forward = step is None or (math.isfinite(step) and step > 0.0)
    demand(forward, "--extrapolation", step, "give a finite number of cycles above 0")


def _wear_columns(result: Life) -> dict[str, Any]:
    """Return the columns in the units of their names."""
    return {
        "cycles": result.cycles,
        "max_depth_mm": result.max_depth / MM,
        "worn_area_mm2": result.worn_area / MM2,
        "worn_mass_g": result.worn_mass / GRAM,
        "peak_pressure_MPa": result.peak_pressure / MPA,
        "mean_force_N": result.mean_force,
        "estimated_error_mm": result.estimated_error / MM,
        "worn_area_error_mm2": result.area_error / MM2,
        "worn_mass_error_g": result.mass_error / GRAM,
    }


def _summary(target: Path, result: Life, kind: str) -> str:
    """Return the printed summary of a life under a kind of load."""
    return (
        f"{target}: {len(result.cycles)} rows, {kind}; after {result.cycles[-1]:.0f} cycles"
        f" {result.max_depth[-1] / MM:.6g} mm deep (error at most"
        f" {result.estimated_error[-1] / MM:.2g} mm), {result.worn_mass[-1] / GRAM:.6g} g worn"
        f" (error at most {result.mass_error[-1] / GRAM:.2g} g).{_steps(result)}"
    )


def _steps(result: Life) -> str:
    """Return the printed text about explicit steps; empty for implicit ones or without wear."""
    if result.extrapolation is None or math.isinf(result.extrapolation.limit):
        return ""
    step, limit = result.extrapolation.step, result.extrapolation.limit
    return (
        f" Explicit steps of at most {step:.4g} cycles, {step / limit:.0%} of the stability limit"
        f" of {limit:.4g} cycles on this mesh of {result.sectors} sectors."
    )


@contextmanager
def _plain(params_path: Path, force_N: float | None) -> Iterator[None]:
    """Convert errors of the model into a sentence that names the file."""
    from rigapp_model.bushing.contact import ContactError
    from rigapp_model.wear.explicit import UnstableStep

    try:
        yield
    except UnstableStep as error:
        raise UnusableInput(f"--extrapolation {error.value:g}: {error.remedy}.") from error
    except ContactError as error:
        load = "the mechanism's force" if force_N is None else f"--force-N {force_N:g}"
        raise UnusableInput(f"{params_path}: {load}: {error.remedy}.") from error
    except ValueError as error:
        raise UnusableInput(f"{params_path}: {error}.") from error


def write_paper(folder: Path, recorded: Path | None, time_limit_s: float | None) -> int:
    """Write the comparisons into a folder and print the files' names.

    recorded: a test file for Figs 20 and 21. Return the exit status: 0, or 1 when time ran out.
    Raises UnusableInput naming the unusable input.
    """
    from rigapp.report.paper import make_paper

    check_time_limit(time_limit_s)
    with watched("comparisons", time_limit_s) as report:
        paper = make_paper(folder, recorded, report)
    for path in paper.files:
        print(path)
    if paper.complete:
        return 0
    print(
        f"--time-limit-s {time_limit_s:g}: over before all comparisons were made; the pages hold"
        " those that were.",
        file=sys.stderr,
    )
    return 1
