"""Technique 2: clearance in continuous contact, and what the program says when it cannot hold.

Run with ``python examples/model_continuous.py``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rigapp_model.joints import continuous_contact
from rigapp_model.parameters import Joint, Mechanism, Spring

FREE = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
SPRUNG = replace(FREE, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))
JOINT = Joint(
    pin_radius=9.5e-3, bushing_radius=10e-3, bushing_outer_radius=20e-3, bushing_width=13.1e-3
)


def main() -> dict[str, float]:
    """Print and return the change of the greatest force with clearance, and where tension fails."""
    angles, speed = np.deg2rad(np.arange(360.0)), np.pi
    result: dict[str, float] = {}
    perfect = continuous_contact(SPRUNG, JOINT, angles, speed, clearance=0.0)
    greatest = perfect.motion.force_magnitude.max()
    for clearance in (0.1e-3, 0.5e-3, 1.0e-3):
        worn = continuous_contact(SPRUNG, JOINT, angles, speed, clearance=clearance)
        change = 100.0 * (worn.motion.force_magnitude.max() / greatest - 1.0)
        result[f"change_percent_at_{1e3 * clearance:g}_mm"] = float(change)
    failing = continuous_contact(FREE, JOINT, angles, speed)
    start, end = failing.compression[0]
    result["compression_from_deg"] = float(np.degrees(start))
    result["compression_to_deg"] = float(np.degrees(end))
    for name, value in result.items():
        print(f"{name:>26} {value:.4g}")
    print(failing.sentence())
    return result


if __name__ == "__main__":
    main()
