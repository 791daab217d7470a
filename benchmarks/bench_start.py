"""Time of `rigapp --help`, against the interpreter's own start."""

from __future__ import annotations

import subprocess
import sys

from budgets import measured, median_s, size

RUNS = size(9, 1)


def seconds(*command: str) -> float:
    """Return the median wall time of a command."""
    run = [sys.executable, *command]
    return median_s(lambda: subprocess.run(run, stdout=subprocess.DEVNULL, check=True), RUNS)


def main() -> None:
    """Print the medians and their ratio to the budget."""
    bare = seconds("-c", "pass")
    shown = seconds("-m", "rigapp", "--help")
    print(f"rigapp --help: {shown:.3f} s, {shown / bare:.1f} times a bare interpreter")
    measured("help", shown, "bare interpreter", shown / bare)


if __name__ == "__main__":
    main()
