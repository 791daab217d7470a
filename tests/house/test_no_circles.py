"""No module and no package imports another one that imports it, on whatever way round.

Imports for type checkers and imports inside functions count: what is written needs what it names.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
ROOTS = ("rigapp", "drivers", "model", "calibration")

Graph = Mapping[str, set[str]]


def modules() -> dict[str, Path]:
    """Return every module by its dotted name; a package is its ``__init__``."""
    found = {}
    for path in (path for root in ROOTS for path in (TOP / root).rglob("*.py")):
        parts = path.relative_to(TOP).with_suffix("").parts
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


def package_graph() -> Graph:
    """Return which packages import which; the sub-packages of one stand beside it."""
    found: dict[str, set[str]] = {}
    for name, used in module_graph().items():
        own = package_of(name)
        found.setdefault(own, set()).update(package_of(one) for one in used)
        found[own].discard(own)
    return found


def circles(graph: Graph) -> list[tuple[str, ...]]:
    """Return the strongly connected components of more than one node (Tarjan 1972)."""
    order: dict[str, int] = {}
    lowest: dict[str, int] = {}
    stack: list[str] = []
    found: list[tuple[str, ...]] = []

    def visit(node: str) -> None:
        order[node] = lowest[node] = len(order)
        stack.append(node)
        for other in sorted(graph[node]):
            if other not in order:
                visit(other)
                lowest[node] = min(lowest[node], lowest[other])
            elif other in stack:
                lowest[node] = min(lowest[node], order[other])
        if lowest[node] == order[node]:
            place = stack.index(node)
            component = tuple(sorted(stack[place:]))
            del stack[place:]
            if len(component) > 1:
                found.append(component)

    for node in sorted(graph):
        if node not in order:
            visit(node)
    return found


def test_a_circle_is_found() -> None:
    graph = {"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set[str]()}
    assert circles(graph) == [("b", "c")]


def test_no_module_stands_in_a_circle() -> None:
    assert circles(module_graph()) == []


def test_no_package_stands_in_a_circle() -> None:
    assert circles(package_graph()) == []
