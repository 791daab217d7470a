"""Speed of a study of lives, with one worker and with two, alternating.

Run with ``python benchmarks/bench_study.py [--lives 600] [--rounds 3]``. Each study has lives of
23,000 cycles at 1 %, as in ``examples/study.toml``. A round runs it with one worker and with two;
the time is from the first committed row to the last: starting processes does not count.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import tempfile
import time
from pathlib import Path

from budgets import measured, size

from rigapp.study.running import read_study, run_study

EXAMPLES = Path(__file__).parents[1] / "examples"
GOAL_LIVES = 10_000


def rate(study: Path, to: Path, workers: int) -> float:
    """Return the lives a second of a study, computed into a new folder."""
    times: list[tuple[float, float]] = []

    def note(done: float, _all: float) -> None:
        times.append((time.perf_counter(), done))

    run_study(read_study(study), to, workers=workers, progress=note)
    (begin, first), (end, last) = times[workers], times[-1 - workers]
    # In a study as small as a trial's, all lives may come in one message.
    if end <= begin:
        (begin, first), (end, last) = times[0], times[-1]
    return (last - first) / (end - begin)


def main() -> None:
    """Print both rates, their ratio, and the time of 10,000 lives."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lives", type=int, default=size(600, 40))
    parser.add_argument("--rounds", type=int, default=size(3, 1))
    given = parser.parse_args()
    rates: dict[int, list[float]] = {1: [], 2: []}
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        shutil.copy(EXAMPLES / "parameters.toml", root)
        text = (EXAMPLES / "study.toml").read_text("utf-8")
        study = root / "study.toml"
        study.write_text(text.replace("points = 320", f"points = {given.lives}"), "utf-8")
        for number in range(given.rounds):
            for workers, measured_rates in rates.items():
                measured_rates.append(rate(study, root / f"{number}-{workers}", workers))
    single, double = (statistics.median(measured_rates) for measured_rates in rates.values())
    efficiency, lasts_s = double / single / 2.0, GOAL_LIVES / double
    print(
        f"lives a second: {single:.1f} with one worker, {double:.1f} with two:"
        f" {double / single:.2f} times"
    )
    measured("workers", 100.0 * efficiency)
    measured("lives", lasts_s / 60.0)


if __name__ == "__main__":
    main()
