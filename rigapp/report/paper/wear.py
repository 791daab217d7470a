"""The paper's Fig. 15: wear with constant and with evolving kinematics."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rigapp.report.paper.chapter import Chapter
from rigapp.report.paper.kinematics import COLOURS, MM

if TYPE_CHECKING:
    from model.parameters import Parameters

CYCLES = 23_000
TOLERANCE = 1e-3


def constant_and_evolving(parameters: Parameters, speed: float, name: str, bushing: str) -> Chapter:
    """Return Fig. 15 for a bushing: depth over cycles by both kinematics, and the difference."""
    from model.wear.life import life

    constant = life(parameters, speed, CYCLES, "perfect", TOLERANCE)
    evolving = life(parameters, speed, CYCLES, "continuous", TOLERANCE)
    cycles = np.union1d(constant.cycles, evolving.cycles)
    depth = {
        kind: np.interp(cycles, found.cycles, found.max_depth) / MM
        for kind, found in (("constant", constant), ("evolving", evolving))
    }
    shared = np.isin(cycles, constant.cycles) & np.isin(cycles, evolving.cycles)
    difference = depth["evolving"] - depth["constant"]
    error = max(constant.estimated_error[-1], evolving.estimated_error[-1]) / MM
    end, last = depth["constant"][-1], difference[-1]
    start, force = evolving.mean_force[0], evolving.mean_force[-1]
    before = constant.mean_force[0]

    def draw(axes: Sequence[Any]) -> None:
        axes[0].plot(cycles, depth["constant"], color=COLOURS[0], label="constant")
        axes[0].plot(cycles, depth["evolving"], "--", color=COLOURS[4], label="evolving")
        axes[0].set_ylabel("depth, mm")
        axes[0].legend(title="kinematics", loc="lower right")
        axes[1].plot(cycles[shared], difference[shared], "o-", ms=3, color=COLOURS[1])
        axes[1].set_ylabel("evolving less constant, mm")
        axes[1].set_xlabel("cycles")

    return Chapter(
        name=name,
        title=f"Fig. 15: constant and evolving kinematics, {bushing}",
        columns={
            "cycles": cycles[shared],
            "depth_constant_mm": depth["constant"][shared],
            "depth_evolving_mm": depth["evolving"][shared],
            "difference_mm": difference[shared],
        },
        sentences=(
            f"After {CYCLES:,} cycles the bushing is {end:.6g} mm deep with constant kinematics"
            f" and {end + last:.6g} mm with evolving kinematics: {abs(last):.3g} mm"
            f" ({100.0 * abs(last) / end:.2f} %) {'more' if last > 0.0 else 'less'}; each depth is"
            f" known to {error:.2g} mm.",
            f"The difference {_course(difference[shared])}; its sign is that of the force in"
            " Fig. 10 with the spring outboard.",
            f"Of the change of the mean force, {100.0 * (start / before - 1.0):+.3f} % comes from"
            f" the clearance that the new joint has, and {100.0 * (force / start - 1.0):+.4f} %"
            " from the wear itself.",
        ),
        draw=draw,
        words="wear depth over cycles for constant and evolving kinematics, and the difference",
        panels=2,
    )


def _course(difference: np.ndarray) -> str:
    """Return in words how the difference goes on with the cycles."""
    size = np.abs(difference)
    if np.all(np.diff(size) >= 0.0):
        return "grows with the cycles, as the paper says"
    return f"is largest, {size.max():.3g} mm, before the end: unlike the paper's it does not grow"
