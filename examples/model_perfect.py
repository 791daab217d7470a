"""Technique 1: the joint force of the perfect joint, in closed form and by the paper's equations.

Run with ``python examples/model_perfect.py``.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.constraints import solve_perfect
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.parameters import Mechanism, Spring

MECHANISM = Mechanism(
    crank_radius=0.0762,
    crank_mass=0.4045,
    crank_inertia=204e-6,
    follower_length=0.2032,
    follower_mass=0.8175,
    follower_inertia=5500e-6,
    slider_mass=5.54871,
    spring=Spring(stiffness=525.0, free_position=0.2794 + 20.0 / 525.0),
)


def main() -> dict[str, float]:
    """Print and return the force's maximum, minimum and RMS and how far the two ways differ."""
    angles = np.deg2rad(np.arange(360.0))
    speed = 30.0 * np.pi / 30.0
    motion = inverse_dynamics(MECHANISM, angles, speed)
    reference = solve_perfect(MECHANISM, angles, speed)
    force = motion.force_magnitude
    result = {
        "maximum_N": float(force.max()),
        "maximum_at_deg": float(np.degrees(angles[force.argmax()])),
        "minimum_N": float(force.min()),
        "rms_N": float(np.sqrt(np.mean(force**2))),
        "largest_difference_N": float(np.abs(motion.force - reference.force).max()),
    }
    for name, value in result.items():
        print(f"{name:>22} {value:.6g}")
    return result


if __name__ == "__main__":
    main()
