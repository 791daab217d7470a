"""A life computed the hard way: many implicit steps, extrapolated, on a fine mesh."""

from __future__ import annotations

import numpy as np

from rigapp_model.bushing.ring import ring_of
from rigapp_model.wear.forces import constant_source
from rigapp_model.wear.front import implicit_step, wear_problem, worn_area
from rigapp_model.wear.techniques import LifeOptions, technique_of


def fine_life(parameters, speed, rows, technique, force, sectors, positions, steps, half_angle):
    """Return depth (m) and worn area (m^2), (2, rows), at each of the increasing cycles ``rows``.

    Between rows ``steps`` and twice as many implicit steps are taken, and extrapolated.
    """
    source = (
        constant_source(force, parameters.joint, speed, parameters.bushing.law)
        if force is not None
        else technique_of(technique).source(parameters, LifeOptions(speed))
    )
    ring = ring_of(parameters.joint, parameters.bushing.material)
    loads = source.unworn(positions)
    problem = wear_problem(
        ring,
        sectors,
        parameters.joint.bushing_width,
        parameters.bushing.wear_coefficient,
        loads,
        half_angle,
        parameters.bushing.law,
    )
    runs = []
    for number in (steps, 2 * steps):
        front, done, found = problem.unworn(), 0.0, []
        for row in rows:
            for _ in range(number):
                now = source.at(front, done, positions)
                front = implicit_step(problem, front, now, (row - done) / number)
            done = row
            depth = float(front.depth(ring.inner).max())
            found.append((depth, worn_area(problem, front.surface)))
        runs.append(np.array(found).T)
    return 2.0 * runs[1] - runs[0]
