"""Time one cycle of the dynamics by every method, in one run, and one cycle of impacts.

Run with ``python benchmarks/bench_mechanics.py [--angles 3600] [--rounds 7]``. The methods
alternate; the table shows the median and the ratio to the closed form. EXUDYN, a general multibody
program, takes part when it is installed: it integrates the same cycle with its implicit solver.
"""

from __future__ import annotations

import argparse
import importlib.util
import statistics
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from budgets import measured, size, skipped

from rigapp_model.constraints import solve_imperfect, solve_perfect
from rigapp_model.contact.impact import contact_cycle
from rigapp_model.contact.impact_system import clearance_system
from rigapp_model.dynamics import inverse_dynamics
from rigapp_model.history import motion_from_history
from rigapp_model.parameters import Joint, Material, Mechanism, Spring

MECHANISM = Mechanism(0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871)
MECHANISM = replace(MECHANISM, spring=Spring(525.0, 0.2794 + 20.0 / 525.0))
JOINT = Joint(9.5e-3, 10e-3, 20e-3, 13.1e-3)
POLYMER, STEEL = Material(500e6, 0.38), Material(206e9, 0.29)
SPEED = np.pi


def exudyn_cycle(angles: int) -> Callable[[], np.ndarray] | None:
    """Return a run of the same cycle in EXUDYN, or None when it is not installed.

    Rigid bodies in the plane, revolute joints and a driven crank; it returns time and the slider's
    acceleration (x, y, z) at every step.
    """
    if importlib.util.find_spec("exudyn") is None:
        return None
    import exudyn as exu
    from exudyn import itemInterface as items  # noqa: N813

    m = MECHANISM
    period, spring = 2.0 * np.pi / SPEED, m.spring
    assert spring is not None
    start = inverse_dynamics(m, 0.0, SPEED)

    def run() -> np.ndarray:
        container = exu.SystemContainer()
        system = container.AddSystem()
        ground = system.AddObject(items.ObjectGround())
        at_origin = system.AddMarker(items.MarkerBodyPosition(bodyNumber=ground))

        def body(mass: float, inertia: float, x: float, v: float, w: float) -> tuple[int, int]:
            node = system.AddNode(
                items.NodeRigidBody2D(
                    referenceCoordinates=[x, 0.0, 0.0], initialVelocities=[0.0, v, w]
                )
            )
            made = items.ObjectRigidBody2D(mass=mass, inertia=max(inertia, 1e-6), nodeNumber=node)
            return node, system.AddObject(made)

        def marker(number: int, x: float) -> int:
            return system.AddMarker(
                items.MarkerBodyPosition(bodyNumber=number, localPosition=[x, 0.0, 0.0])
            )

        r, length = m.crank_radius, m.follower_length
        crank_node, crank = body(m.crank_mass, m.crank_inertia, 0.5 * r, 0.5 * r * SPEED, SPEED)
        _, follower = body(
            m.follower_mass,
            m.follower_inertia,
            r + 0.5 * length,
            float(start.follower_velocity[1]),
            float(start.follower_speed),
        )
        slider_node, slider = body(m.moving_mass, 0.0, r + length, 0.0, 0.0)
        revolute = items.ObjectJointRevolute2D
        system.AddObject(revolute(markerNumbers=[at_origin, marker(crank, -0.5 * r)]))
        system.AddObject(
            revolute(markerNumbers=[marker(crank, 0.5 * r), marker(follower, -0.5 * length)])
        )
        system.AddObject(
            revolute(markerNumbers=[marker(follower, 0.5 * length), marker(slider, 0.0)])
        )
        fixed = system.AddMarker(
            items.MarkerNodeCoordinate(
                nodeNumber=system.AddNode(items.NodePointGround()), coordinate=0
            )
        )
        for coordinate in (1, 2):
            held = system.AddMarker(
                items.MarkerNodeCoordinate(nodeNumber=slider_node, coordinate=coordinate)
            )
            system.AddObject(items.CoordinateConstraint(markerNumbers=[fixed, held]))
        along = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=slider_node, coordinate=0))
        system.AddObject(
            items.CoordinateSpringDamper(
                markerNumbers=[fixed, along],
                stiffness=spring.stiffness,
                offset=spring.free_position - (r + length),
            )
        )
        turning = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=crank_node, coordinate=2))
        system.AddObject(
            items.CoordinateConstraint(
                markerNumbers=[fixed, turning],
                offset=SPEED,
                velocityLevel=True,
            )
        )
        sensor = system.AddSensor(
            items.SensorNode(
                nodeNumber=slider_node,
                outputVariableType=exu.OutputVariableType.Acceleration,
                storeInternal=True,
            )
        )
        system.Assemble()
        settings = exu.SimulationSettings()
        settings.timeIntegration.numberOfSteps = angles
        settings.timeIntegration.endTime = period
        settings.timeIntegration.verboseMode = 0
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = period / angles
        system.SolveDynamic(settings)
        stored: np.ndarray = system.GetSensorStoredData(sensor)
        return stored

    return run


def contact_system(friction: float, bushing: Material, foundation: bool = False):  # type: ignore[no-untyped-def]
    """Return the system of one cycle of technique 3."""
    from rigapp_model.contact_law import ContactModel

    joint = replace(JOINT, friction_coefficient=friction)
    law = ContactModel(foundation=foundation)
    return clearance_system(MECHANISM, joint, bushing, STEEL, SPEED, law)


def measure(ways: dict[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """Return the median time of each method; the methods alternate."""
    times: dict[str, list[float]] = {name: [] for name in ways}
    for way in ways.values():
        way()
    for _ in range(rounds):
        for name, way in ways.items():
            start = time.perf_counter()
            way()
            times[name].append(time.perf_counter() - start)
    return {name: statistics.median(values) for name, values in times.items()}


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--angles", type=int, default=size(3600, 60))
    parser.add_argument("--rounds", type=int, default=size(7, 1))
    arguments = parser.parse_args()
    n = arguments.angles
    angles = 2.0 * np.pi / n * np.arange(n)
    counts = np.floor(angles * 3600.0 / (2.0 * np.pi)) * (2.0 * np.pi / 3600.0)
    ways: dict[str, Callable[[], object]] = {
        "closed form": lambda: inverse_dynamics(MECHANISM, angles, SPEED),
        "closed form, clearance and friction": lambda: inverse_dynamics(
            MECHANISM, angles, SPEED, 0.0, 5e-4, replace(JOINT, friction_coefficient=0.1)
        ),
        "Eqs 4-7, batched Newton": lambda: solve_perfect(MECHANISM, angles, SPEED),
        "Eq. 12, batched Newton": lambda: solve_imperfect(MECHANISM, 9.5e-3, 10e-3, angles, SPEED),
        "differentiate encoder counts": lambda: motion_from_history(angles / SPEED, counts),
    }
    general = exudyn_cycle(n)
    if general is not None:
        ways["EXUDYN, implicit, index 2"] = general
    taken = measure(ways, arguments.rounds)
    base = taken["closed form"]
    print(f"{n} crank angles, median of {arguments.rounds}")
    for name, seconds in taken.items():
        print(f"  {name:<38}{1e3 * seconds:9.3f} ms{seconds / base:9.1f} x")
    peer = "EXUDYN" if general is not None else "Eqs 4-7"
    other = list(taken.values())[-1] if general is not None else taken["Eqs 4-7, batched Newton"]
    measured("closed_form", 1e3 * base * 3600 / n, peer, other / base)
    if general is None:
        skipped("closed form against EXUDYN", "EXUDYN is not installed")
    else:
        stored = general()
        mine = inverse_dynamics(MECHANISM, SPEED * stored[:, 0], SPEED).slider_acceleration
        apart = np.abs(stored[1:, 1] - mine[1:]).max() / np.ptp(mine)
        print(f"  slider acceleration, EXUDYN from closed form: {apart:.1e} of its range")

    contacts: dict[str, Callable[[], object]] = {}
    for name, system in {
        "polymer bushing": contact_system(0.0, POLYMER),
        "polymer bushing, friction 0.13": contact_system(0.13, POLYMER),
        "polymer bushing, elastic foundation": contact_system(0.0, POLYMER, True),
        "steel bushing": contact_system(0.0, STEEL),
        "steel bushing, friction 0.13": contact_system(0.13, STEEL),
        "polymer bushing, no spring, impacts": clearance_system(
            replace(MECHANISM, spring=None), JOINT, POLYMER, STEEL, SPEED
        ),
    }.items():
        contacts[name] = lambda system=system: contact_cycle(system, settling_revolutions=0)
    print("one revolution with contact resolved, 30 rpm, clearance 0.5 mm, default tolerance")
    taken = measure(contacts, arguments.rounds)
    for name, seconds in taken.items():
        print(f"  {name:<38}{1e3 * seconds:9.3f} ms")
    measured("impacts_polymer", 1e3 * taken["polymer bushing, friction 0.13"])
    measured("impacts_steel", 1e3 * taken["steel bushing, friction 0.13"])


if __name__ == "__main__":
    main()
