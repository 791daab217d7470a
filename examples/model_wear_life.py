"""The life of a bushing by two joints: what evolving kinematics change, and how well it is known.

Run with ``python examples/model_wear_life.py``.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring
from rigapp_model.wear.life import life

PARAMETERS = Parameters(
    Mechanism(
        0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871, spring=Spring(525.0, 0.3174952)
    ),
    Joint(
        pin_radius=9.5e-3, bushing_radius=10e-3, bushing_outer_radius=20e-3, bushing_width=13.1e-3
    ),
    Bushing(Material(500e6, 0.38), density=2200.0, wear_coefficient=5.05e-13),
    pin=Material(206e9, 0.29),
)


def main() -> dict[str, float]:
    """Print and return depth, mass and error bound after 23,000 cycles at 30 rpm."""
    result: dict[str, float] = {}
    for technique in ("perfect", "continuous"):
        worn = life(PARAMETERS, np.pi, 23_000, technique, tolerance=1e-3)
        result[f"{technique}_depth_mm"] = 1e3 * float(worn.max_depth[-1])
        result[f"{technique}_error_mm"] = 1e3 * float(worn.estimated_error[-1])
        result[f"{technique}_mass_g"] = 1e3 * float(worn.worn_mass[-1])
        result[f"{technique}_mean_force_N"] = float(worn.mean_force[-1])
    for name, value in result.items():
        print(f"{name:>24} {value:.6g}")
    return result


if __name__ == "__main__":
    main()
