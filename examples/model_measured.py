"""Predict the force of a measured revolution: encoder counts in, joint force out.

Run with ``python examples/model_measured.py``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.history import motion_from_history
from rigapp_model.parameters import Mechanism, Spring

MECHANISM = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
MECHANISM = replace(MECHANISM, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))
COUNTS = 3600


def main() -> dict[str, float]:
    """Print and return how far the force from counts is from that of the true motion."""
    time, w = np.arange(1920) / 960.0, np.pi
    angle = 0.01 + w * time + 0.005 * np.sin(2.0 * w * time)
    speed = w + 0.01 * w * np.cos(2.0 * w * time)
    acceleration = -0.02 * w * w * np.sin(2.0 * w * time)
    counts = np.floor(angle / (2.0 * np.pi) * COUNTS)
    measured = (counts + 0.5) * (2.0 * np.pi / COUNTS)
    fitted_speed, fitted_acceleration = motion_from_history(time, measured)
    truth = inverse_dynamics(MECHANISM, angle, speed, acceleration)
    predicted = inverse_dynamics(MECHANISM, angle, fitted_speed, fitted_acceleration)
    steady = inverse_dynamics(MECHANISM, angle, w)
    result = {
        "error_from_counts_N": float(np.abs(predicted.force - truth.force).max()),
        "error_if_speed_were_constant_N": float(np.abs(steady.force - truth.force).max()),
    }
    for name, value in result.items():
        print(f"{name:>32} {value:.4g}")
    return result


if __name__ == "__main__":
    main()
