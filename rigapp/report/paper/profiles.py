"""The paper's Fig. 21 without a test: the worn profiles that the simulations of Table 2 give."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rigapp.report.paper.chapter import Chapter
from rigapp.report.paper.kinematics import COLOURS, MM
from rigapp.report.paper.table2 import CYCLES, TOLERANCE
from rigapp.report.paper.wear import Tell, whole_life

if TYPE_CHECKING:
    from rigapp_model.parameters import Parameters

STEP_DEG = 0.5


def worn_profiles(
    simulation: Parameters, experiment: Parameters, speed: float, tell: Tell
) -> Chapter:
    """Return Fig. 21 by the sets that fit the paper's simulation and its experiment."""
    degrees = np.arange(-180.0, 180.0 + STEP_DEG, STEP_DEG)
    columns = {"angle_deg": degrees}
    extents = []
    for name, parameters in (("simulation", simulation), ("experiment", experiment)):
        found = whole_life(
            parameters, speed, CYCLES, "continuous", tolerance=TOLERANCE, progress=tell
        )
        depth = np.interp(degrees, np.degrees(found.angle), found.depth) / MM
        columns[f"depth_{name}_mm"] = depth
        worn = degrees[depth > 0.01 * depth.max()]
        extents.append(
            f"{depth.max():.4f} mm deep, from {worn[0]:.0f} to {worn[-1]:.0f}° for the set that"
            f" fits its {name}"
        )

    def draw(axes: Sequence[Any]) -> None:
        for colour, style, name in zip(
            COLOURS[1:], ("-", "--"), ("simulation", "experiment"), strict=False
        ):
            axes[0].plot(
                degrees, columns[f"depth_{name}_mm"], style, color=colour, label=f"fits its {name}"
            )
        axes[0].set_xlim(-120.0, 120.0)
        axes[0].set_ylim(bottom=0.0)
        axes[0].set_xlabel("angle from the initial contact point, °, follower frame")
        axes[0].set_ylabel("depth, mm")
        axes[0].legend(title="parameters", loc="upper right")

    return Chapter(
        name="fig21_profile",
        title="Fig. 21: worn profile after 21,377 cycles",
        columns=columns,
        sentences=(
            f"By the model, with the two sets assumed for Table 2: {extents[0]}, and {extents[1]}.",
            "The paper prints no numbers of its measured profile. That of a recorded test stands"
            " beside the model's when one is given with --file.",
        ),
        draw=draw,
        words="worn profile over the angle from the initial contact point by both parameter sets",
    )
