"""Dependence of the wear coefficient on revolutions, regime and pressure.

A dependence on the revolutions alone rescales time: the profile after n revolutions is that of
constant K after ``steady_cycles(n)``. One on nominal pressure and speed at a crank angle is a
factor of the slip at that angle. One on the local pressure changes a step; ``front`` iterates it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import wrightomega

from rigapp_model.parameters import Joint, WearLaw
from rigapp_model.wear.loads import CycleLoads

Array = NDArray[np.float64]

FAINT = 1e-2
"""Least pressure to which a pressure exponent is applied, relative to the largest: the coefficient
at the contact's edge, where there is little wear, must not be 0 or infinite."""


def steady_cycles(law: WearLaw, cycles: Array | float) -> Array:
    """Return the cycles at the steady coefficient with the same wear as the first ``cycles``."""
    done = np.asarray(cycles, dtype=np.float64)
    return done - law.excess * law.running_in * np.expm1(-done / law.running_in)


def cycles_at(law: WearLaw, reached: Array | float) -> Array:
    """Invert ``steady_cycles``, to a millionth of a cycle."""
    done = np.asarray(reached, dtype=np.float64)
    if law.excess == 0.0:
        return done
    rest = np.log(law.excess) + law.excess - done / law.running_in
    cycles = done + law.running_in * (wrightomega(rest) - law.excess)
    return np.round(np.maximum(cycles, 0.0), 6)


def switched(loads: CycleLoads, speed: Array | float, joint: Joint, law: WearLaw) -> CycleLoads:
    """Return loads with the rates of wear of their regime.

    speed: sliding speed of each position, m/s; its sign is ignored.
    """
    if law.beyond == 1.0 or not np.isfinite(law.transition):
        return loads
    product = loads.magnitude / joint.projected_area * np.abs(speed)
    return replace(loads, rate=np.where(product > law.transition, law.beyond, 1.0))


def shares(law: WearLaw, pressure: Array, slip: Array) -> Array:
    """Return the factor of K at each node, (N,), for pressures (M, N), Pa, over slips (M,).

    With it the total wear of all positions, K share sum s p, equals K sum s p (p / p0)^(m - 1).
    """
    faint = FAINT * float(pressure.max())
    raised = (np.maximum(pressure, faint) / law.reference_pressure) ** (law.exponent - 1.0)
    weight = slip[:, None] * np.maximum(pressure, 0.0)
    total = weight.sum(axis=0)
    untouched = (faint / law.reference_pressure) ** (law.exponent - 1.0)
    return np.where(
        total > 0.0, (weight * raised).sum(axis=0) / np.maximum(total, 1e-300), untouched
    )
