"""Compare the paper's three techniques: joint forces and wear depths of the same mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rigapp.report.paper.kinematics import COLOURS, DEGREES, MM, POINTS, angles
from rigapp.report.paper.pages import Chapter
from rigapp.report.paper.table2 import CYCLES
from rigapp.report.paper.wear import Progress, shared, whole_life

if TYPE_CHECKING:
    from rigapp_model.contact.ensemble import Ensemble
    from rigapp_model.contact.impact_system import ClearanceSystem
    from rigapp_model.parameters import Parameters

TOLERANCE = 3e-3  # line width of the figure
REVOLUTIONS = 40
NAMES = {
    "perfect": "1, perfect joint",
    "continuous": "2, continuous contact",
    "contact": "3, separate bodies",
}
SHADES = (COLOURS[0], COLOURS[1], COLOURS[4])


def forces(parameters: Parameters, speed: float, progress: Progress) -> Chapter:
    """Return the joint force of the three techniques, with and without the spring."""
    from rigapp_model.contact.ensemble import ensemble
    from rigapp_model.contact.impact import contact_cycle
    from rigapp_model.joints import continuous_contact, perfect_joint

    loose = replace(parameters, mechanism=replace(parameters.mechanism, spring=None))
    columns = {"crank_angle_deg": np.degrees(angles())}
    for kind, p in (("spring", parameters), ("no_spring", loose)):
        mechanism, joint = p.mechanism, p.joint
        columns[f"f_perfect_{kind}_N"] = perfect_joint(
            mechanism, angles(), speed, joint=joint
        ).force_magnitude
        answer = continuous_contact(mechanism, joint, angles(), speed)
        columns[f"f_continuous_{kind}_N"] = answer.motion.force_magnitude
    sprung = contact_cycle(_system(parameters, speed), POINTS, progress=progress)
    many = ensemble(_system(loose, speed), REVOLUTIONS, POINTS, progress=progress)
    columns |= {
        "f_contact_spring_N": sprung.motion.force_magnitude,
        "f_contact_no_spring_sample_N": many.sample.motion.force_magnitude,
        "f_contact_no_spring_N_mean": many.force_magnitude.value,
        "f_contact_no_spring_N_standard_error": many.force_magnitude.standard_error,
    }
    most = columns["f_perfect_spring_N"].max()
    apart = np.abs(columns["f_contact_spring_N"] - columns["f_continuous_spring_N"]).max()
    change = columns["f_continuous_spring_N"].max() / most - 1.0
    return Chapter(
        name="techniques_force",
        title="The three techniques: joint force",
        columns=columns,
        sentences=(
            "With the spring the follower is in tension, contact is never lost, and techniques 2"
            f" and 3 agree to {apart:.2g} N; against the perfect joint the clearance of"
            f" {parameters.joint.clearance / MM:.3g} mm changes the maximum by"
            f" {100.0 * change:+.2f} %.",
            _unsprung_sentence(many),
        ),
        draw=lambda axes: _draw_forces(axes, columns),
        words="joint force over the crank angle by the three techniques, their differences, and"
        " the same without a spring, where one revolution of the third is ragged",
        panels=3,
        warning="Without the spring technique 2 does not hold: its assumption of tension fails.",
    )


def _system(parameters: Parameters, speed: float) -> ClearanceSystem:
    from rigapp_model.contact.impact_system import clearance_system

    return clearance_system(
        parameters.mechanism,
        parameters.joint,
        parameters.bushing.material,
        parameters.pin,
        speed,
    )


def _unsprung_sentence(many: Ensemble) -> str:
    fraction, mean, most = (
        (float(mean_of.value), float(mean_of.standard_error))
        for mean_of in (many.contact_fraction, many.mean_force, many.greatest_force)
    )
    return (
        f"Without the spring pin and bushing touch {100.0 * fraction[0]:.1f} ±"
        f" {100.0 * fraction[1]:.1f} % of the time. The motion is chaotic: the grey curve is one"
        f" sample, the line the mean over {many.revolutions} revolutions with its standard error;"
        f" mean force {mean[0]:.3g} ± {mean[1]:.2g} N, greatest {most[0]:.3g} ± {most[1]:.2g} N."
    )


def _draw_forces(axes: Sequence[Any], columns: dict[str, np.ndarray]) -> None:
    degrees = columns["crank_angle_deg"]
    perfect = columns["f_perfect_spring_N"]
    for colour, kind in zip(SHADES, NAMES, strict=True):
        style = "--" if kind == "contact" else "-"
        size = columns[f"f_{kind}_spring_N"]
        axes[0].plot(degrees, size, style, color=colour, label=NAMES[kind])
        if kind != "perfect":
            axes[1].plot(degrees, size - perfect, style, color=colour, label=NAMES[kind])
    axes[0].set_title("with the spring", loc="left")
    axes[1].set_title("with the spring, less the perfect joint", loc="left")
    mean = columns["f_contact_no_spring_N_mean"]
    error = columns["f_contact_no_spring_N_standard_error"]
    sample = columns["f_contact_no_spring_sample_N"]
    axes[2].plot(degrees, sample, color="0.75", lw=0.7, label="3, one sample")
    axes[2].fill_between(degrees, mean - error, mean + error, color=SHADES[2], alpha=0.3, lw=0)
    axes[2].plot(degrees, mean, color=SHADES[2], label="3, mean")
    for colour, kind in zip(SHADES[:2], NAMES, strict=False):
        axes[2].plot(degrees, columns[f"f_{kind}_no_spring_N"], color=colour, label=NAMES[kind])
    axes[2].set_title("without a spring", loc="left")
    axes[2].set_ylim(0.0, 1.1 * float(np.quantile(sample, 0.995)))
    for panel in axes:
        panel.set_ylabel("|F|, N")
        panel.legend(title="technique", loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes[1].set_ylabel("difference, N")
    axes[2].set_xlabel(DEGREES)


def wear(parameters: Parameters, speed: float, progress: Progress) -> Chapter:
    """Return the depth over the cycles of the three techniques."""
    lives = {
        kind: whole_life(parameters, speed, CYCLES, kind, tolerance=TOLERANCE, progress=progress)
        for kind in NAMES
    }
    cycles, depths, errors = shared(lives)
    columns = {"cycles": cycles}
    for kind in lives:
        columns[f"depth_{kind}_mm"], columns[f"error_{kind}_mm"] = depths[kind], errors[kind]

    def draw(axes: Sequence[Any]) -> None:
        perfect = columns["depth_perfect_mm"]
        for colour, kind in zip(SHADES, NAMES, strict=True):
            style = "--" if kind == "contact" else "-"
            depth, error = columns[f"depth_{kind}_mm"], columns[f"error_{kind}_mm"]
            axes[0].plot(cycles, depth, style, color=colour, label=NAMES[kind])
            axes[1].errorbar(
                cycles, depth - perfect, error, fmt=f"o{style}", ms=3, lw=1, color=colour
            )
        axes[0].set_ylabel("depth, mm")
        axes[0].legend(title="technique", loc="lower right")
        axes[1].set_ylabel("less technique 1, mm")
        axes[1].set_xlabel("cycles")

    rows = [("technique", "mean force, new, N", "mean force, end, N", "depth, mm", "error, mm")]
    rows += [
        (
            NAMES[kind],
            f"{life.mean_force[0]:.3f}",
            f"{life.mean_force[-1]:.3f}",
            f"{life.max_depth[-1] / MM:.5f}",
            f"{life.estimated_error[-1] / MM:.5f}",
        )
        for kind, life in lives.items()
    ]
    return Chapter(
        name="techniques_wear",
        title="The three techniques: wear",
        columns=columns,
        sentences=(
            f"The soft bushing assumed for Table 2, {CYCLES:,} cycles with the spring. The bars"
            " are the bounds of each depth's numerical error.",
        ),
        draw=draw,
        words="wear depth over cycles by the three techniques, and what they are off the first",
        panels=2,
        table=rows,
    )
