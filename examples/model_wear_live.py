"""Wear beside a running test: a state that measured revolutions advance.

Run with ``python examples/model_wear_live.py``.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.joints import continuous_contact
from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring
from rigapp_model.wear.state import unworn_state

PARAMETERS = Parameters(
    Mechanism(
        0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871, spring=Spring(525.0, 0.3174952)
    ),
    Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3),
    Bushing(Material(500e6, 0.38), density=2200.0, wear_coefficient=5.05e-13),
    pin=Material(206e9, 0.29),
)
ANGLES = 2.0 * np.pi * np.arange(3600) / 3600


def main() -> dict[str, float]:
    """Print and return the wear after ten advances of 100 cycles, each by one revolution."""
    state = unworn_state(PARAMETERS, typical_force=100.0)
    for _ in range(10):
        # In a test this is the measured force, turned into the follower frame.
        motion = continuous_contact(
            PARAMETERS.mechanism, PARAMETERS.joint, ANGLES, np.pi, clearance=state.clearance
        ).motion
        slip = motion.slip_increments(PARAMETERS.joint.pin_radius)
        state = state.advance(motion.force_follower, slip, cycles=100)
    result = {
        "cycles": state.cycles,
        "depth_mm": 1e3 * state.max_depth,
        "error_mm": 1e3 * state.estimated_error,
        "clearance_mm": 1e3 * state.clearance,
        "mass_mg": 1e6 * state.worn_mass,
    }
    for name, value in result.items():
        print(f"{name:>16} {value:.6g}")
    return result


if __name__ == "__main__":
    main()
