"""Compile the numerical kernels once, with a line of progress each.

Kernels have explicit signatures and a cache on disk: importing their module compiles them the first
time and loads them afterwards. This step imports every module that has some, so that nothing is
compiled inside a running test or on the window's thread.
"""

from __future__ import annotations

import importlib
import importlib.util
import sys
import time
from collections.abc import Iterator
from pathlib import Path

PACKAGES = ("model", "rigapp", "drivers", "calibration")


def kernel_modules() -> Iterator[str]:
    """Yield the dotted name of each module whose source asks numba for compiled functions."""
    for package in PACKAGES:
        spec = importlib.util.find_spec(package)
        if spec is None or not spec.submodule_search_locations:
            continue
        root = Path(next(iter(spec.submodule_search_locations)))
        for path in sorted(root.rglob("*.py")):
            text = path.read_text(encoding="utf-8")
            if path != Path(__file__) and ("@njit" in text or "@numba." in text):
                yield ".".join((package, *path.relative_to(root).with_suffix("").parts))


def main() -> int:
    """Compile or load every kernel module."""
    names = list(kernel_modules())
    terminal = sys.stdout.isatty()
    for number, name in enumerate(names, 1):
        begin = time.perf_counter()
        print(
            f"\rCompiling kernels {number}/{len(names)}: {name:<40}",
            end="" if terminal else "\n",
            flush=True,
        )
        importlib.import_module(name)
        if terminal and time.perf_counter() - begin > 1.0:
            print(f" {time.perf_counter() - begin:.0f} s")
    if terminal and names:
        print()
    return 0


if __name__ == "__main__":
    sys.exit(main())
