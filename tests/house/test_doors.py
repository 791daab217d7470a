"""Whoever uses a room of the program enters by the doors that the room names.

Each room names them in its ``__init__``: "Other packages import ``one``, ``two``." or "Other
packages import this one." Imports for type checkers and inside functions count.
"""

from __future__ import annotations

import ast
import re

import pytest
from house.imports import MODULES, module_graph

THIS_DOOR = "Other packages import this one"
OPEN = {
    "rigapp.schema": "records and tables for everybody: each module is one of them",
    "rigapp.config": "records of files for everybody: each module is one kind of file",
    "rigapp.commands": "each module is a verb, loaded when it is called",
    "rigapp.calibrating": "each module is one subject, loaded when it is asked for",
    "rigapp.report": "each document is loaded when it is asked for",
    "rigapp.viewer": "what window and page know: each module is one thing that they show",
    "rigapp.twin": "each side of the process is entered where it is",
    "rigapp_model": "a library of functions: each module is a part of the physics",
    "rigapp_calibration": "a library of functions: each package is what is calibrated",
}
"""Rooms without a door of their own, each with its reason; see decision 19."""


def room_of(module: str) -> str:
    parts = module.split(".")
    return ".".join(parts[:2]) if parts[0] == "rigapp" else parts[0]


ROOMS = sorted(
    name
    for name in {room_of(one) for one in MODULES} - OPEN.keys() - {"rigapp"}
    if MODULES[name].name == "__init__.py"
)


def doors(room: str) -> set[str]:
    """Return the modules by which others enter a room, relative to it; "" is the room itself."""
    words = ast.get_docstring(ast.parse(MODULES[room].read_text("utf-8"))) or ""
    if THIS_DOOR in words:
        return {""}
    found = re.search(
        r"Other packages import\s+(?:only\s+)?([^.]*(?:\.[a-z][^.]*)*)\.(?:\s|$)", words
    )
    return set(re.findall(r"``([\w.]+)``", found[1])) if found else set()


def entered(room: str) -> set[str]:
    """Return the modules of a room, relative to it, that others import."""
    return {
        one[len(room) + 1 :]
        for name, used in module_graph().items()
        for one in used
        if room_of(one) == room != room_of(name)
    }


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_is_entered_by_its_doors_and_each_of_them_is_used(room: str) -> None:
    assert entered(room) == doors(room)


def test_an_open_room_is_there() -> None:
    assert OPEN.keys() <= {room_of(one) for one in MODULES}
