"""No module and no package imports another one that imports it, on whatever way round.

Imports for type checkers and imports inside functions count: what is written needs what it names.
"""

from __future__ import annotations

from house.imports import Graph, module_graph, package_of


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
