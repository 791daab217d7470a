"""Time contact and wear of the bushing against standard methods, in one run.

Run with ``python benchmarks/bench_wear.py [--rounds 5]``. First the contact: condensed against the
whole sparse system in scikit-fem, on the same 180 x 8 mesh of 8-node quadrilaterals. Then the
life: implicit with its error bound against the paper's explicit extrapolation at its stability
limit. All ratios are of medians of this run.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from budgets import measured, median_s, size

from rigapp_model.bushing.compliance import circular_compliance
from rigapp_model.bushing.contact import simpson_weights, solve_contact
from rigapp_model.bushing.ring import Ring, ring_of
from rigapp_model.bushing.sector import SectorMesh, surface_spectrum
from rigapp_model.parameters import Bushing, Joint, Material, Mechanism, Parameters, Spring
from rigapp_model.wear.explicit import explicit_step, stable_step
from rigapp_model.wear.front import Front, implicit_step, touched, wear_problem
from rigapp_model.wear.life import life
from rigapp_model.wear.loads import constant_load
from rigapp_model.wear.state import unworn_state
from rigapp_model.wear.techniques import LifeOptions, technique_of

RING = Ring(0.010, 0.020, 0.0095, 500e6, 0.38)
WIDTH, FORCE_N, K = 0.0131, 110.0, 5.05e-13
MECHANISM = Mechanism(
    0.0762, 0.4045, 204e-6, 0.2032, 0.8175, 5500e-6, 5.54871, spring=Spring(525.0, 0.3174952)
)
PARAMETERS = Parameters(
    MECHANISM,
    Joint(0.0095, 0.010, 0.020, WIDTH),
    Bushing(Material(500e6, 0.38), 2200.0, K),
    Material(206e9, 0.29),
)
CYCLES, SPEED = size(23_000, 230), np.pi


def contacts(rounds: int) -> None:
    """Print the first table."""
    mesh = SectorMesh()
    force = (FORCE_N / WIDTH, 0.0)
    compliance = circular_compliance(RING.inner, RING.outer, 500e6, 0.38, mesh=mesh)
    circle = RING.circle(180)
    other = solve_contact(compliance, circle, RING.pin_radius, (0.95 * force[0], 100.0))
    loads = constant_load(FORCE_N, RING.pin_radius)
    problem = wear_problem(RING, 180, WIDTH, K, loads, np.pi)
    worn = implicit_step(problem, problem.unworn(), loads, CYCLES)
    surface = np.ascontiguousarray(worn.surface)
    near = solve_contact(compliance, surface, RING.pin_radius, (0.95 * force[0], 100.0))
    last = solve_contact(compliance, surface, RING.pin_radius, (0.9999 * force[0], 0.0))

    def condense() -> None:
        surface_spectrum.cache_clear()
        surface_spectrum(RING.inner, RING.outer, 500e6, 0.38, "strain", mesh)

    def solve(places: np.ndarray, start: object) -> Callable[[], object]:
        return lambda: solve_contact(
            compliance,
            places,
            RING.pin_radius,
            force,
            start=start,  # type: ignore[arg-type]
        )

    sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "model" / "wear"))
    import full_ring

    levels = mesh.radii(RING.inner, RING.outer)

    def whole() -> object:
        return full_ring.solve_full(0.010, 0.020, 0.0095, 500e6, 0.38, force[0], 180, levels)

    taken = {
        "scikit-fem, the whole system": median_s(whole, max(rounds // 2, size(2, 1))),
        "condense the ring once": median_s(condense, rounds, 5),
        "contact, unworn, no start": median_s(solve(circle, None), rounds, 100),
        "contact, unworn, from another force": median_s(solve(circle, other), rounds, 100),
        "contact, worn 0.4 mm, no start": median_s(solve(surface, None), rounds, 20),
        "contact, worn 0.4 mm, from another force": median_s(solve(surface, near), rounds, 20),
        "contact, worn 0.4 mm, from the last cycle": median_s(solve(surface, last), rounds, 20),
    }
    base = taken["scikit-fem, the whole system"]
    print(f"one contact, 180 x 8 elements, median of {rounds}")
    for name, seconds in taken.items():
        print(f"  {name:<42}{1e3 * seconds:10.3f} ms   1/{base / seconds:,.0f}")
    _, nodal, pin = whole()  # type: ignore[misc]
    mine = solve_contact(compliance, circle, RING.pin_radius, force)
    weights = simpson_weights(circle)
    apart = np.abs((mine.force - nodal) / weights).max() / (nodal / weights).max()
    print(f"  pressures apart {apart:.1e} of the peak, pin {abs(mine.pin[0] - pin):.1e} m")
    ratio = base / taken["contact, unworn, from another force"]
    measured("contact_peer", ratio, "scikit-fem", ratio)
    measured("contact", 1e3 * taken["contact, unworn, from another force"])
    measured("contact_worn", 1e3 * taken["contact, worn 0.4 mm, from the last cycle"])


def lives(rounds: int) -> None:
    """Print the second table."""
    exact = life(PARAMETERS, SPEED, CYCLES, "perfect", 3e-4).max_depth[-1]
    loads = technique_of("perfect").source(PARAMETERS, LifeOptions(SPEED)).unworn(6)
    ring = ring_of(PARAMETERS.joint, PARAMETERS.bushing.material)
    problem = wear_problem(ring, 180, WIDTH, K, loads, 1.2)
    limit = stable_step(ring, problem.sectors, K, loads)
    count = int(np.ceil(CYCLES / limit))
    front = problem.unworn()
    start = time.perf_counter()
    for _ in range(count):
        front = explicit_step(problem, front, loads, CYCLES / count)
    explicit = time.perf_counter() - start
    off = abs(float(front.depth(ring.inner).max()) / exact - 1.0)
    print(f"life of {CYCLES} cycles, six crank positions, elastic forces of the mechanism")
    print(
        f"  {'explicit at its limit of ' + f'{limit:.1f} cycles':<42}{1e3 * explicit:10.1f} ms"
        f"   depth off {off:.1e}"
    )
    for tolerance in ("1e-3", "1e-2"):
        for technique in ("perfect", "continuous"):
            run = lambda t=technique, e=float(tolerance): life(PARAMETERS, SPEED, CYCLES, t, e)  # noqa: E731
            seconds = median_s(run, rounds)
            result = run()
            bound = result.estimated_error[-1] / result.max_depth[-1]
            name = f"implicit, {technique}, tolerance {tolerance}"
            print(
                f"  {name:<42}{1e3 * seconds:10.1f} ms   1/{explicit / seconds:,.0f}"
                f"   error bound {bound:.1e}"
            )
            if technique == "continuous":
                name = "life_0.1" if tolerance == "1e-3" else "life_1"
                measured(name, 1e3 * seconds, "explicit extrapolation", explicit / seconds)
    state = unworn_state(PARAMETERS, 100.0).advance_by(loads, 5000.0)
    seconds = median_s(lambda: state.advance_by(loads, 500.0), rounds)
    name = "live state, 500 cycles"
    print(f"  {name:<42}{1e3 * seconds:10.1f} ms")
    unworn = Front(problem.unworn().surface)
    seconds = median_s(lambda: touched(problem, unworn, loads), rounds)
    print(f"  {'six contacts, unworn, as explicit takes':<42}{1e3 * seconds:10.1f} ms")


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=size(5, 1))
    rounds = parser.parse_args().rounds
    contacts(rounds)
    lives(rounds)


if __name__ == "__main__":
    main()
