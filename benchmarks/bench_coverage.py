"""Print the coverage of the load cell's stated uncertainty, which should be 95 %.

Run with ``python benchmarks/bench_coverage.py [--calibrations 1000] [--seed 1]``. Of virtual
calibrations with known truth: matrix elements, zeros, and a reading (|F| and one component, one
reading and a mean), in each scenario. The goal is 93 to 97 %.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from budgets import measured, size

sys.path.insert(0, str(Path(__file__).parents[1]))

from tests.calibration.virtual_calibrations import SCENARIOS, coverage

LOW, HIGH = 0.93, 0.97


def main() -> None:
    """Print the table and the rows outside of the goal."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calibrations", type=int, default=size(1000, 4))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scenario", default="", help="only those whose name contains it")
    given = parser.parse_args()
    print(f"{given.calibrations} virtual calibrations each, truth held in %")
    outside: dict[bool, list[str]] = {False: [], True: []}
    wanted = [scenario for scenario in SCENARIOS if given.scenario in scenario.name][: size(99, 1)]
    furthest = 0.0
    for index, scenario in enumerate(wanted):
        covered = coverage(scenario, given.calibrations, given.seed + index)
        if index == 0:
            print(f"  {'':<24}" + "".join(f"{name:>23}" for name in covered))
        line = "".join(f"{100.0 * part:>23.1f}" for part, _ in covered.values())
        print(f"  {scenario.name:<24}{line}", flush=True)
        for name, (part, _) in covered.items():
            if "mean of" not in name:
                furthest = max(furthest, abs(100.0 * part - 95.0))
            if not LOW <= part <= HIGH:
                outside["mean of" in name].append(f"{scenario.name}: {name} {100.0 * part:.1f}")
    if wanted:
        measured("coverage", furthest)
    for words, of_mean in (("matrix, zero, reading", False), ("mean of readings", True)):
        goal = f"{words} within {100 * LOW:.0f} to {100 * HIGH:.0f} %"
        missed = "; ".join(outside[of_mean])
        print(f"  {goal}: {f'FAILS at {missed}' if missed else 'passes'}")


if __name__ == "__main__":
    main()
