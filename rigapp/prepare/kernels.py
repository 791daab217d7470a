"""Compile the numerical kernels once, with a line of progress for each module.

Kernels have explicit signatures and a cache on disk: importing their module compiles them the first
time and loads them afterwards. This step imports every module with kernels, so that nothing is
compiled during a test or on the window's thread, and removes obsolete kernels from the cache.
"""

from __future__ import annotations

import ast
import importlib
import importlib.util
import sys
import time
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

PACKAGES = ("rigapp_model", "rigapp", "rigapp_drivers", "rigapp_calibration")
COMPILERS = ("numba", "rigapp_model.compiled")
"""Modules that compile functions; a module that imports one of them may have kernels."""

NO_KERNELS = ("rigapp_model.compiled", "rigapp.prepare.kernels")
"""Modules that only handle kernels of other modules."""

REPORT_AFTER_S = 1.0  # loading from the cache takes less
CACHED = (".nbi", ".nbc")


def kernel_modules() -> Iterator[str]:
    """Yield the dotted name of each module that imports a compiler."""
    for package in PACKAGES:
        spec = importlib.util.find_spec(package)
        if spec is None or not spec.submodule_search_locations:
            continue
        root = Path(next(iter(spec.submodule_search_locations)))
        for path in sorted(root.rglob("*.py")):
            name = ".".join((package, *path.relative_to(root).with_suffix("").parts))
            if name not in NO_KERNELS and may_compile(path.read_text(encoding="utf-8")):
                yield name


def may_compile(source: str) -> bool:
    """Return whether a module's source imports a compiler, under any name."""
    return any(name.rpartition(".")[2] in source for name in COMPILERS) and any(
        name == compiler or name.startswith(f"{compiler}.")
        for name in _imported(ast.parse(source))
        for compiler in COMPILERS
    )


def _imported(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def kernels_of(module: ModuleType) -> list[Any]:
    """Return the compiled functions defined in a module."""
    from numba.core.dispatcher import Dispatcher

    return [
        value
        for value in vars(module).values()
        if isinstance(value, Dispatcher) and value.py_func.__module__ == module.__name__
    ]


def remove_left_over(modules: Iterable[ModuleType]) -> int:
    """Remove the modules' cached kernels that no longer exist; return the number of files."""
    from rigapp_model.compiled import cache_name

    kernels = [kernel for module in modules for kernel in kernels_of(module)]
    functions = [kernel.py_func for kernel in kernels]
    present = tuple(f"{f.__module__.rpartition('.')[2]}.{cache_name(f)}" for f in functions)
    folders = {Path(f.__code__.co_filename).parent / "__pycache__" for f in functions}
    folders |= {Path(kernel.stats.cache_path) for kernel in kernels if kernel.stats.cache_path}
    left_over = [
        path
        for folder in folders
        for path in folder.glob("*.*")
        if path.suffix in CACHED and not path.name.startswith(present)
    ]
    for path in left_over:
        path.unlink(missing_ok=True)
    return len(left_over)


def compile_kernels() -> None:
    """Compile all kernels not yet compiled, with a line of progress for each module."""
    names = list(kernel_modules())
    terminal = sys.stdout.isatty()
    modules = []
    for number, name in enumerate(names, 1):
        begin = time.perf_counter()
        line = f"Compiling kernels {number}/{len(names)}: {name}"
        if terminal:
            print(f"\r{line:<70}", end="", flush=True)
        modules.append(importlib.import_module(name))
        took = time.perf_counter() - begin
        if took > REPORT_AFTER_S:
            print(f"\r{line:<70} {took:.0f} s" if terminal else f"{line} {took:.0f} s", flush=True)
    if terminal and names:
        print(f"\r{'Kernels are compiled.':<70}")
    remove_left_over(modules)


if __name__ == "__main__":
    compile_kernels()
