"""How long a person waits: `rigapp --help`, against the interpreter's own start."""

from __future__ import annotations

import statistics
import subprocess
import sys
import time

from budgets import measured, size

RUNS = size(9, 1)


def seconds(*command: str) -> float:
    """Return the median wall time of a command."""
    times = []
    for _ in range(RUNS):
        begin = time.perf_counter()
        subprocess.run([sys.executable, *command], stdout=subprocess.DEVNULL, check=True)
        times.append(time.perf_counter() - begin)
    return statistics.median(times)


def main() -> None:
    """Print the medians and their ratio to the budget."""
    bare = seconds("-c", "pass")
    shown = seconds("-m", "rigapp", "--help")
    print(f"rigapp --help: {shown:.3f} s, {shown / bare:.1f} times a bare interpreter")
    measured("help", shown, "bare interpreter", shown / bare)


if __name__ == "__main__":
    main()
