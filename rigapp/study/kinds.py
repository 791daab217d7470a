"""The kinds of studies: one table, each with its settings and results."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

import msgspec
import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.numbers import within
from rigapp.config.parameters import MM, MPA
from rigapp.study.design import StudyFile
from rigapp.study.virtual import MM3_PER_NM, VirtualTest, virtual_test
from rigapp.texts import joined, say
from rigapp_model.wear.techniques import SOLVABLE, TECHNIQUES

if TYPE_CHECKING:
    from rigapp_model.parameters import Parameters

    SolvableName = str
    TechniqueName = str
else:
    SolvableName = Literal[SOLVABLE]
    TechniqueName = Literal[tuple(TECHNIQUES)]

MM2, GRAM = 1e-6, 1e-3
Rpm = Annotated[float, within(-10_000.0, 10_000.0)]
Numbers = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Noted:
    """Results by name with their remarks."""

    numbers: Numbers
    notes: tuple[str, ...] = ()


class ForcesRun(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run] of ``forces``: one cycle of the mechanism."""

    rpm: Rpm
    joint: SolvableName = "perfect"
    points: Annotated[int, within(4, 100_000)] = 360


class PressureRun(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run] of ``pressure``: one contact under a force."""

    force_N: Annotated[float, within(1e-6, 1e7)]


class LifeRun(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run] of ``life``: as the options of ``rigapp model wear``."""

    rpm: Rpm
    cycles: Annotated[float, within(1.0, 1e9)]
    tolerance: Annotated[float, within(1e-5, 0.1)] = 0.01
    joint: TechniqueName = "continuous"
    force_N: Annotated[float | None, within(-1e7, 1e7)] = None


class IdentifyRun(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[run] of ``identify``: recorded tests; after_revolution: as known then, 0: at the end."""

    files: list[str]
    file: str = ""
    after_revolution: Annotated[int, within(0, 10**9)] = 0


@dataclass(frozen=True, slots=True)
class Result:
    """A result: name, unit, description."""

    name: str
    unit: str
    words: str


@dataclass(frozen=True, slots=True)
class StudyKind:
    """One kind of study.

    settings: of [run]. compute (parameters, settings, seed): its results by name, NaN where
    unknown, with remarks; raises ValueError or UnusableInput with the
    sentence of the point. modelled: whether it needs a parameter file.
    """

    name: str
    settings: type[msgspec.Struct]
    results: tuple[Result, ...]
    compute: Callable[[Parameters | None, Any, int], Numbers | Noted]
    modelled: bool = True


def _speed(rpm: float) -> float:
    if rpm == 0.0:
        raise UnusableInput("run.rpm = 0: give a speed other than 0.")
    return rpm * math.pi / 30.0


def _forces(parameters: Parameters | None, run: ForcesRun, seed: int) -> Numbers:
    from rigapp_model.wear.techniques import solve_of

    assert parameters is not None
    angle = 2.0 * np.pi / run.points * np.arange(run.points)
    motion, _ = solve_of(run.joint)(parameters, angle, _speed(run.rpm), 0.0, 0.0)
    size, torque = motion.force_magnitude, motion.drive_torque
    slip = motion.slip_increments(parameters.joint.pin_radius)
    return {
        "force_max_N": float(size.max()),
        "force_min_N": float(size.min()),
        "force_rms_N": float(np.sqrt(np.mean(size**2))),
        "force_max_angle_deg": float(np.degrees(angle[int(size.argmax())])),
        "torque_max_Nm": float(np.abs(torque).max()),
        "slip_mm": float(np.abs(slip).sum() / MM),
    }


def _pressure(parameters: Parameters | None, run: PressureRun, seed: int) -> Numbers:
    from rigapp_model.bushing.ring import pressure_distribution, ring_of

    assert parameters is not None
    ring = ring_of(parameters.joint, parameters.bushing.material)
    contact = pressure_distribution(ring, (run.force_N / parameters.joint.bushing_width, 0.0))
    return {
        "peak_pressure_MPa": float(contact.pressure.max() / MPA),
        "contact_half_angle_deg": math.degrees(contact.half_angle),
        "indentation_mm": float((contact.pin[0] - ring.clearance) / MM),
    }


def _life(parameters: Parameters | None, run: LifeRun, seed: int) -> Noted:
    from rigapp_model.wear.life import life

    assert parameters is not None
    result = life(
        parameters,
        _speed(run.rpm),
        run.cycles,
        run.joint,
        run.tolerance,
        force=run.force_N,
        rows=(run.cycles,),  # a study uses only the end, and each row in between costs steps
    )
    numbers = {
        "max_depth_mm": float(result.max_depth[-1] / MM),
        "worn_area_mm2": float(result.worn_area[-1] / MM2),
        "worn_mass_g": float(result.worn_mass[-1] / GRAM),
        "peak_pressure_MPa": float(result.peak_pressure[-1] / MPA),
        "mean_force_N": float(result.mean_force[-1]),
        "estimated_error_mm": float(result.estimated_error[-1] / MM),
        "tolerance_met": float(result.tolerance_met),
    }
    return Noted(numbers, result.notes)


def _identify(parameters: Parameters | None, run: IdentifyRun, seed: int) -> Numbers:
    from pathlib import Path

    from rigapp.report.testreport.identified import identified_test

    identified = identified_test(Path(run.file), run.after_revolution or None)
    if identified.known is None:
        raise UnusableInput(identified.said)
    known = identified.known.coefficient
    left = identified.left.revolutions if identified.left is not None else None
    return {
        "wear_coefficient_mm3_per_Nm": MM3_PER_NM * known.median,
        "wear_coefficient_low_mm3_per_Nm": MM3_PER_NM * known.low,
        "wear_coefficient_high_mm3_per_Nm": MM3_PER_NM * known.high,
        "remaining_revolutions": left.median if left is not None else math.nan,
        "remaining_revolutions_low": left.low if left is not None else math.nan,
        "remaining_revolutions_high": left.high if left is not None else math.nan,
    }


def _simulate(parameters: Parameters | None, run: VirtualTest, seed: int) -> Numbers:
    assert parameters is not None
    return virtual_test(parameters, run, seed)


_COEFFICIENT = (
    Result("wear_coefficient_mm3_per_Nm", "mm^3/(N m)", say("wear coefficient, median")),
    Result("wear_coefficient_low_mm3_per_Nm", "mm^3/(N m)", say("lower 95 % limit of it")),
    Result("wear_coefficient_high_mm3_per_Nm", "mm^3/(N m)", say("upper 95 % limit of it")),
)
_PEAK = Result("peak_pressure_MPa", "MPa", say("largest contact pressure"))

KINDS: Mapping[str, StudyKind] = {
    kind.name: kind
    for kind in (
        StudyKind(
            "forces",
            ForcesRun,
            (
                Result("force_max_N", "N", say("largest |F| of the joint")),
                Result("force_min_N", "N", say("smallest |F| of the joint")),
                Result("force_rms_N", "N", say("RMS of |F| of the joint")),
                Result("force_max_angle_deg", "deg", say("crank angle of the largest |F|")),
                Result("torque_max_Nm", "N m", say("largest magnitude of the drive's torque")),
                Result("slip_mm", "mm", say("slip of a cycle")),
            ),
            _forces,
        ),
        StudyKind(
            "pressure",
            PressureRun,
            (
                _PEAK,
                Result("contact_half_angle_deg", "deg", say("half angle of the contact")),
                Result("indentation_mm", "mm", say("elastic approach of pin and bushing")),
            ),
            _pressure,
        ),
        StudyKind(
            "life",
            LifeRun,
            (
                Result("max_depth_mm", "mm", say("wear depth at the end")),
                Result("worn_area_mm2", "mm^2", say("worn area at the end")),
                Result("worn_mass_g", "g", say("worn mass at the end")),
                _PEAK,
                Result("mean_force_N", "N", say("mean force over the slip at the end")),
                Result("estimated_error_mm", "mm", say("bound of the computed depth's error")),
                Result("tolerance_met", "1", say("1: the error is within the tolerance")),
            ),
            _life,
        ),
        StudyKind(
            "identify",
            IdentifyRun,
            (
                *_COEFFICIENT,
                Result("remaining_revolutions", "1", say("revolutions to the depth of the end")),
                Result("remaining_revolutions_low", "1", say("lower 95 % limit of them")),
                Result("remaining_revolutions_high", "1", say("upper 95 % limit of them")),
            ),
            _identify,
            modelled=False,
        ),
        StudyKind(
            "simulate",
            VirtualTest,
            (
                *_COEFFICIENT,
                Result("half_width", "1", say("half the limits' distance over the median")),
                Result("covered", "1", say("1: the true coefficient lies within its limits")),
                Result(
                    "seen_revolution",
                    "1",
                    say(
                        "revolution from which the limits leave out the model's"
                        " coefficient, to the end; none where they do not"
                    ),
                ),
            ),
            _simulate,
        ),
    )
}
"""The kinds of studies by name."""


def record_of(name: str) -> type[StudyFile]:
    """Return the record of a kind's study file; raise UnusableInput for an unknown kind."""
    kind = KINDS.get(name)
    if kind is None:
        raise UnusableInput("kind = {}: choose one of {}", repr(name), joined(", ", KINDS))
    record: type[StudyFile] = msgspec.defstruct(  # type: ignore[assignment]
        f"{name.capitalize()}Study",
        [("run", kind.settings)],
        bases=(StudyFile,),
        frozen=True,
        forbid_unknown_fields=True,
        kw_only=True,
    )
    return record
