"""The pressure of the pin on the bushing, and where elasticity alone would put it.

Run with ``python examples/model_wear_pressure.py``.
"""

from __future__ import annotations

import numpy as np

from rigapp_model.bushing.ring import Ring, pressure_distribution

RING = Ring(inner=10e-3, outer=20e-3, pin_radius=9.5e-3, youngs_modulus=500e6, poissons_ratio=0.38)
WIDTH = 13.1e-3


def main() -> dict[str, float]:
    """Print and return peak pressure, contact angle and indentation for 110 N."""
    force = 110.0 / WIDTH
    contact = pressure_distribution(RING, (force, 0.0))
    result = {
        "peak_pressure_MPa": 1e-6 * float(contact.pressure.max()),
        "half_angle_deg": float(np.degrees(contact.half_angle)),
        "perssons_half_angle_deg": float(np.degrees(RING.half_angle(force))),
        "indentation_um": 1e6 * float(contact.pin[0] - RING.clearance),
        "pressure_integral_over_force": float(contact.contact.force.sum()) / force,
    }
    for name, value in result.items():
        print(f"{name:>30} {value:.5g}")
    return result


if __name__ == "__main__":
    main()
