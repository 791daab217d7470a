"""The paper's Figs 6 to 10 and 13: positions, forces and slip of one cycle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rigapp.report.paper.pages import Chapter, largest_difference

if TYPE_CHECKING:
    from rigapp_model.parameters import Mechanism, Parameters

POINTS = 360  # one per degree
GAPS_MM = (0.0, 0.1, 0.25, 0.5, 1.0)
MM = 1e-3
COLOURS = ("#000000", "#0072B2", "#009E73", "#E69F00", "#D55E00", "#CC79A7")
DEGREES = "crank angle, deg"
PRINTED = "inboard, Eq. 12 as printed"


def angles() -> np.ndarray:
    """Return the crank angles of a cycle, rad."""
    return 2.0 * np.pi * np.arange(POINTS) / POINTS


def same_without_clearance(parameters: Parameters, speed: float) -> list[Chapter]:
    """Return Figs 6 to 9: for R1 = R2 the imperfect joint's equations give the perfect joint."""
    from rigapp_model.constraints import PHI2, X1, X2, X3, solve_imperfect, solve_perfect

    radius = parameters.joint.pin_radius
    perfect = solve_perfect(parameters.mechanism, angles(), speed)
    other = solve_imperfect(parameters.mechanism, radius, radius, angles(), speed)
    degrees = np.degrees(angles())
    curves = (("link 1", "link1_x", X1), ("link 2", "link2_x", X2), ("slider", "slider_x", X3))
    parts = (
        ("6", "position", "m", perfect.position, other.position),
        ("7", "velocity", "m_per_s", perfect.velocity, other.velocity),
        ("8", "acceleration", "m_per_s2", perfect.acceleration, other.acceleration),
    )
    chapters = []
    for number, quantity, unit, of_perfect, of_imperfect in parts:
        columns = {"crank_angle_deg": degrees}
        worst = largest_difference(of_perfect[:, PHI2], of_imperfect[:, PHI2])
        for _, key, column in curves:
            columns[f"{key}_{quantity}_perfect_{unit}"] = of_perfect[:, column]
            columns[f"{key}_{quantity}_imperfect_{unit}"] = of_imperfect[:, column]
            worst = max(worst, largest_difference(of_perfect[:, column], of_imperfect[:, column]))

        def draw(
            axes: Sequence[Any], first: Any = of_perfect, second: Any = of_imperfect, of: str = unit
        ) -> None:
            for panel, (name, _, column) in zip(axes, curves, strict=True):
                _both(panel, degrees, first[:, column], second[:, column])
                panel.set_title(name, loc="left")
                panel.set_ylabel(of.replace("_per_", "/").replace("s2", "s²"))
            axes[-1].set_xlabel(DEGREES)
            axes[0].legend(loc="upper center")

        chapters.append(
            Chapter(
                name=f"fig{number}_{quantity}",
                title=f"Fig. {number}: {quantity} with R1 = R2",
                columns=columns,
                sentences=(
                    f"With R1 = R2 Eq. 12 gives the same {quantity} of link 1, link 2 and slider as"
                    " the perfect joint's Eq. 4; the largest difference is"
                    f" {worst:.1e} of the curve.",
                    "Link 1, the only one that the paper shows, is prescribed by the drive and"
                    " proves nothing; link 2 and the slider do.",
                ),
                draw=draw,
                words=f"{quantity} along x over the crank angle; both models lie on each other",
                panels=3,
            )
        )
    chapters.append(_reaction(degrees, perfect.force, other.force))
    return chapters


def _both(panel: Any, degrees: np.ndarray, perfect: np.ndarray, other: np.ndarray) -> None:
    """Draw the results of both models: a line, and points on it."""
    panel.plot(degrees, perfect, color=COLOURS[0], label="perfect, Eq. 4")
    points = {"ms": 3, "color": COLOURS[4], "label": "imperfect, Eq. 12"}
    panel.plot(degrees[::12], other[::12], "o", **points)


def _reaction(degrees: np.ndarray, perfect: np.ndarray, imperfect: np.ndarray) -> Chapter:
    """Return Fig. 9: the joint force by both models."""
    worst = largest_difference(perfect, imperfect)
    size = np.hypot(*perfect)

    def draw(axes: Sequence[Any]) -> None:
        _both(axes[0], degrees, size, np.hypot(*imperfect))
        axes[0].set_ylabel("|F|, N")
        axes[0].set_xlabel(DEGREES)
        axes[0].legend(loc="upper right")

    return Chapter(
        name="fig9_force",
        title="Fig. 9: force in the joint of links 1 and 2 with R1 = R2",
        columns={
            "crank_angle_deg": degrees,
            "fx_perfect_N": perfect[0],
            "fy_perfect_N": perfect[1],
            "fx_imperfect_N": imperfect[0],
            "fy_imperfect_N": imperfect[1],
        },
        sentences=(
            f"With R1 = R2 both models give the same joint force; the largest difference is"
            f" {worst:.1e} of its maximum.",
            f"The force is between {size.min():.2f} and {size.max():.2f} N. It is the sum of the"
            " multipliers of the pin's rows and of the wrist's rows; the pin's alone are wrong.",
        ),
        draw=draw,
        words="joint force over the crank angle; both models lie on each other",
    )


def arrangements(mechanism: Mechanism) -> dict[str, Mechanism]:
    """Return the mechanism with three arrangements of the spring: outboard, none, inboard."""
    from rigapp_model.parameters import Spring

    assert mechanism.spring is not None
    nearest = mechanism.follower_length - mechanism.crank_radius
    farthest = mechanism.follower_length + mechanism.crank_radius
    preload = mechanism.spring.free_position - farthest
    inboard = Spring(mechanism.spring.stiffness, nearest - preload)
    return {
        "outboard": mechanism,
        "none": replace(mechanism, spring=None),
        "inboard": replace(mechanism, spring=inboard),
    }


def force_over_gap(parameters: Parameters, speed: float) -> Chapter:
    """Return Fig. 10: the joint force with increasing gap, and its sign with and without spring."""
    degrees = np.degrees(angles())
    columns = {"crank_angle_deg": degrees}
    change: dict[str, list[float]] = {}
    for name, sizes in _sizes(parameters, speed).items():
        key = name.replace(", ", "_").replace(" ", "_").replace(".", "")
        change[name] = [100.0 * float(size.max() / sizes[0].max() - 1.0) for size in sizes]
        for gap, size in zip(GAPS_MM, sizes, strict=True):
            columns[f"f_{key}_gap_{gap:g}mm_N"] = size

    def draw(axes: Sequence[Any]) -> None:
        unworn = columns["f_outboard_gap_0mm_N"]
        for colour, gap in zip(COLOURS, GAPS_MM, strict=False):
            size = columns[f"f_outboard_gap_{gap:g}mm_N"]
            axes[0].plot(degrees, size - unworn, color=colour, label=f"{gap:g} mm")
        axes[0].set_ylabel("|F| less |F| without gap, N")
        axes[0].set_xlabel(DEGREES)
        axes[0].set_title("spring outboard", loc="left")
        axes[0].legend(title="gap", loc="center left", bbox_to_anchor=(1.0, 0.5))
        for colour, (name, values) in zip(COLOURS[1:], change.items(), strict=False):
            axes[1].plot(GAPS_MM, values, "o-", ms=3, color=colour, label=name)
        axes[1].set_ylabel("change of maximum, %")
        axes[1].set_xlabel("gap R2 - R1, mm")
        axes[1].legend(title="spring", loc="center left", bbox_to_anchor=(1.0, 0.5))

    last = {name: values[-1] for name, values in change.items()}
    rows = [("spring", *(f"gap {gap:g} mm" for gap in GAPS_MM))]
    rows += [(name, *(f"{v:+.3f} %" for v in values)) for name, values in change.items()]
    return Chapter(
        name="fig10_force_over_gap",
        title="Fig. 10: joint force as the gap grows",
        columns=columns,
        sentences=(
            "With the spring anchored outboard, as assumed here because only then the follower is"
            f" in tension, the maximum force {_trend(last['outboard'])} by"
            f" {abs(last['outboard']):.2f} % at a gap of 1 mm: a longer follower relaxes the"
            " spring.",
            f"Without a spring it {_trend(last['none'])} by {abs(last['none']):.2f} %; the follower"
            " is then in compression for a part of the cycle.",
            "With the spring anchored inboard the follower is in compression and the pin bears on"
            f" the other wall: the force {_trend(last['inboard'])} by {abs(last['inboard']):.2f} %."
            " If Eq. 12 is used as printed, with the pin held on the wall towards the crank, it"
            f" {_trend(last[PRINTED])} by {abs(last[PRINTED]):.2f} %.",
            "The paper says that the force increases with the gap; it does not say where the"
            " spring is anchored. Of the arrangements here only an inboard spring with Eq. 12 as"
            " printed would do so, and there the paper's own assumption of tension fails.",
        ),
        draw=draw,
        words="change of the joint force over the crank angle for five gaps, and over the gap for"
        " several places of the spring",
        panels=2,
        table=rows,
    )


def _sizes(parameters: Parameters, speed: float) -> dict[str, list[np.ndarray]]:
    """Return the force over the cycle at each gap, for each arrangement of the spring."""
    from rigapp_model.dynamics import inverse_dynamics
    from rigapp_model.joints import continuous_contact

    springs = arrangements(parameters.mechanism)
    sizes = {
        name: [
            continuous_contact(
                mechanism, parameters.joint, angles(), speed, clearance=gap * MM
            ).motion.force_magnitude
            for gap in GAPS_MM
        ]
        for name, mechanism in springs.items()
    }
    sizes[PRINTED] = [
        inverse_dynamics(
            springs["inboard"], angles(), speed, 0.0, gap * MM, parameters.joint
        ).force_magnitude
        for gap in GAPS_MM
    ]
    return sizes


def _trend(change: float) -> str:
    return "rises" if change > 0.0 else "falls"


def slip(parameters: Parameters, speed: float) -> Chapter:
    """Return Fig. 13: the slip of pin in bushing over a cycle."""
    from rigapp_model.joints import continuous_contact

    degrees = np.degrees(angles())
    motion = continuous_contact(parameters.mechanism, parameters.joint, angles(), speed).motion
    steps = motion.slip_increments(parameters.joint.pin_radius) / MM
    total = float(steps.sum())
    circumference = 2.0 * np.pi * parameters.joint.pin_radius / MM

    def draw(axes: Sequence[Any]) -> None:
        axes[0].plot(degrees, steps, color=COLOURS[1])
        axes[0].set_ylabel("slip per degree, mm")
        axes[1].plot(degrees, np.cumsum(steps), color=COLOURS[1])
        axes[1].set_ylabel("slip, mm")
        axes[1].set_xlabel(DEGREES)

    return Chapter(
        name="fig13_slip",
        title="Fig. 13: slip of the pin in the bushing",
        columns={"crank_angle_deg": degrees, "slip_mm": steps, "slip_so_far_mm": np.cumsum(steps)},
        sentences=(
            f"Over a revolution the pin slips {total:.4f} mm, which is its circumference of"
            f" {circumference:.4f} mm whatever the gap is.",
            f"Per degree of the crank it is between {steps.min():.4f} and {steps.max():.4f} mm,"
            " because the follower swings.",
        ),
        draw=draw,
        words="slip per degree and summed slip over the crank angle",
        panels=2,
    )
