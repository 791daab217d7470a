"""The paper's Fig. 15: wear with constant and with evolving kinematics."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rigapp.report.paper.kinematics import COLOURS, MM
from rigapp.report.paper.pages import Chapter

if TYPE_CHECKING:
    from rigapp_model.parameters import Parameters
    from rigapp_model.wear.life import Life

Progress = Callable[[float], None]
CYCLES = 23_000  # range of the paper's Figs 13 and 15
TOLERANCE = 1e-3  # line width of the figures
# Straight lines between them deviate from the curve by less than a line width; between 1, 3, 10,
# ... they would deviate by more than the differences in the figure.
ROWS = CYCLES * (np.arange(1.0, 40.0) / 40.0) ** 2  # even in the root, like the initial depth
# Repeated with a coarser tolerance: the change is the error of a difference of two lives.
COARSER = 3e-3
KINDS = {
    "perfect": ("perfect", "no clearance"),
    "constant": ("continuous", "clearance of the new joint"),
    "evolving": ("continuous", "clearance grown by the wear"),
}


def whole_life(parameters: Parameters, speed: float, cycles: int, kind: str, **more: Any) -> Life:
    """Return a complete life; raises OutOfTime when its ``progress`` raised it before the end."""
    from rigapp_model.errors import OutOfTime
    from rigapp_model.wear.life import life

    result = life(parameters, speed, cycles, kind, **more)
    if not result.complete:
        raise OutOfTime
    return result


def constant_and_evolving(
    parameters: Parameters, speed: float, name: str, bushing: str, progress: Progress
) -> Chapter:
    """Return Fig. 15 for a bushing: depth over cycles of three kinematics, and two differences."""
    fine, coarse = (_lives(parameters, speed, error, progress) for error in (TOLERANCE, COARSER))
    cycles, depth, _ = shared(fine)
    effects = {
        "wear": depth["evolving"] - depth["constant"],
        "clearance": depth["constant"] - depth["perfect"],
        "both": depth["evolving"] - depth["perfect"],
    }
    uncertainty = {
        effect: abs(_end(fine, *pair) - _end(coarse, *pair))
        for effect, pair in {
            "wear": ("evolving", "constant"),
            "clearance": ("constant", "perfect"),
            "both": ("evolving", "perfect"),
        }.items()
    }

    def draw(axes: Sequence[Any]) -> None:
        for colour, style, kind in zip(
            (COLOURS[1], COLOURS[0], COLOURS[4]), ("-", "-", "--"), KINDS, strict=True
        ):
            axes[0].plot(cycles, depth[kind], style, color=colour, label=KINDS[kind][1])
        axes[0].set_ylabel("depth, mm")
        axes[0].legend(title="kinematics", loc="lower right")
        axes[1].plot(cycles, effects["wear"], "o-", ms=3, color=COLOURS[4])
        axes[1].set_title("clearance grown by the wear less that of the new joint", loc="left")
        axes[2].plot(cycles, effects["both"], "o-", ms=3, color=COLOURS[1])
        axes[2].set_title("clearance grown by the wear less no clearance at all", loc="left")
        for panel in axes[1:]:
            panel.set_ylabel("difference, mm")
        axes[2].set_xlabel("cycles")

    return Chapter(
        name=name,
        title=f"Fig. 15: constant and evolving kinematics, {bushing}",
        columns={
            "cycles": cycles,
            "depth_perfect_mm": depth["perfect"],
            "depth_constant_mm": depth["constant"],
            "depth_evolving_mm": depth["evolving"],
            "evolving_less_constant_mm": effects["wear"],
            "constant_less_perfect_mm": effects["clearance"],
            "evolving_less_perfect_mm": effects["both"],
        },
        sentences=_sentences(fine, depth, effects, uncertainty),
        draw=draw,
        words="wear depth over cycles by three kinematics, and two differences of them: by the"
        " clearance's growth alone, and by all of the clearance",
        panels=3,
    )


def _lives(
    parameters: Parameters, speed: float, tolerance: float, progress: Progress
) -> dict[str, Life]:
    """Return the three lives."""
    return {
        kind: whole_life(
            parameters,
            speed,
            CYCLES,
            technique,
            tolerance=tolerance,
            evolving=kind == "evolving",
            progress=progress,
            rows=ROWS,
        )
        for kind, (technique, _) in KINDS.items()
    }


def shared(lives: dict[str, Life]) -> tuple[np.ndarray, dict[str, Any], dict[str, Any]]:
    """Return the cycles common to all lives, and the depths and errors of each life there, mm."""
    cycles = functools.reduce(np.intersect1d, (life.cycles for life in lives.values()))
    at = {kind: np.searchsorted(life.cycles, cycles) for kind, life in lives.items()}
    depths = {kind: life.max_depth[at[kind]] / MM for kind, life in lives.items()}
    errors = {kind: life.estimated_error[at[kind]] / MM for kind, life in lives.items()}
    return cycles, depths, errors


def _end(lives: dict[str, Life], kind: str, other: str) -> float:
    """Return the difference of two depths at the end, mm."""
    return float(lives[kind].max_depth[-1] - lives[other].max_depth[-1]) / MM


def _sentences(
    lives: dict[str, Life],
    depth: dict[str, np.ndarray],
    effects: dict[str, np.ndarray],
    uncertainty: dict[str, float],
) -> tuple[str, ...]:
    end = {kind: float(values[-1]) for kind, values in depth.items()}
    last = {kind: float(values[-1]) for kind, values in effects.items()}
    error = max(float(life.estimated_error[-1]) for life in lives.values()) / MM
    force = lives["evolving"].mean_force
    before = lives["perfect"].mean_force[0]

    def effect(kind: str, of: float) -> str:
        change = last[kind]
        return (
            f"{abs(change):.3g} mm ({100.0 * abs(change) / of:.2g} %)"
            f" {'more' if change > 0.0 else 'less'}, known to {uncertainty[kind]:.1g} mm"
        )

    by_clearance, by_wear = 100.0 * (force[0] / before - 1.0), 100.0 * (force[-1] / force[0] - 1.0)
    return (
        f"After {CYCLES:,} cycles the bushing is {end['perfect']:.6g} mm deep when the mechanism"
        f" has no clearance, {end['constant']:.6g} mm with the clearance of the new joint kept, and"
        f" {end['evolving']:.6g} mm with the clearance grown by the wear; each is known to"
        f" {error:.2g} mm. Differences are known better, since the three share mesh, crank"
        " positions and steps: by how much they change when all of these are coarser.",
        "First difference, what wear does to itself through the kinematics (section 4.3: kinematics"
        " that change as the wear evolves against the same ones kept constant):"
        f" {effect('wear', end['constant'])}. It {_course(effects['wear'])}.",
        "Second difference, between imperfect and perfect joint (the caption of the paper's"
        f" figure): {effect('both', end['perfect'])}. Of it {abs(last['clearance']):.3g} mm are"
        " there because the new joint has a clearance and the perfect one has none, which is no"
        f" effect of wear: the whole is {abs(last['both'] / last['wear']):,.2g} times the first"
        " difference.",
        f"Of the change of the mean force, {by_clearance:+.3f} % comes from the clearance that the"
        f" new joint has, and {by_wear:+.2g} % from the wear itself; the sign is that of the force"
        " in Fig. 10 with the spring outboard.",
    )


def _course(difference: np.ndarray) -> str:
    """Return a description of the difference over the cycles."""
    size = np.abs(difference)
    # Early differences are below the resolution of the depth.
    shown = size > 1e-3 * size.max()
    if np.all(np.diff(size[shown]) >= 0.0):
        return "grows with the cycles, as the paper says"
    return f"is largest, {size.max():.3g} mm, before the end: unlike the paper's it does not grow"
