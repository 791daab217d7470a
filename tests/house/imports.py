"""What imports what in the source, wherever the import stands: see ``module_graph``."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
ROOTS = {
    "rigapp": TOP,
    "rigapp_drivers": TOP / "drivers",
    "rigapp_model": TOP / "model",
    "rigapp_calibration": TOP / "calibration",
}
"""Each package that is imported, and the folder from which it is."""

Graph = Mapping[str, set[str]]


def modules() -> dict[str, Path]:
    """Return every module by its dotted name; a package is its ``__init__``."""
    found = {}
    for name, folder in ROOTS.items():
        for path in (folder / name).rglob("*.py"):
            parts = path.relative_to(folder).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


MODULES = modules()


def imported(path: Path) -> Iterator[str]:
    """Yield the modules of this project that a file names in an import, wherever it stands."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (one.name for one in node.names if one.name in MODULES)
        elif isinstance(node, ast.ImportFrom) and node.module in MODULES:
            assert node.level == 0, f"{path}: a relative import"
            for one in node.names:
                inner = f"{node.module}.{one.name}"
                yield inner if inner in MODULES else node.module


def package_of(module: str) -> str:
    """Return the package in which a module stands, a package itself."""
    return module if MODULES[module].name == "__init__.py" else module.rpartition(".")[0]


@cache
def module_graph() -> Graph:
    return {name: set(imported(path)) - {name} for name, path in MODULES.items()}
