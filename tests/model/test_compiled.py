"""Compiled code is taken from the cache only while nothing that went into it has changed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from patience import PATIENCE_S

from rigapp_model.compiled import njit

CALLER = """
from rigapp_model.compiled import njit
from program import constants
from program.called import OFFSETS, part

@njit(["float64(float64)", "float64(int64)"], cache=True, nogil=True)
def whole(x):
    return part(x) + OFFSETS[1] + constants.SHIFT

made = njit("float64(float64)", cache=True)(lambda x: whole(x) + 1.0)

def show():
    import json
    print(json.dumps([whole(1.0), made(1.0), sum(whole.stats.cache_hits.values())]))
"""
CALLED = """
from rigapp_model.compiled import njit
OFFSETS = (10.0, 20.0)

@njit("float64(float64)", cache=True)
def part(x):
    return 2.0 * x
"""
CONSTANTS = "SHIFT = 100.0\nOTHER = 1\n"
REPOSITORY = Path(__file__).parents[2]


@pytest.fixture
def program(tmp_path: Path) -> Path:
    folder = tmp_path / "program"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "caller.py").write_text(CALLER)
    (folder / "called.py").write_text(CALLED)
    (folder / "constants.py").write_text(CONSTANTS)
    return folder


def run(program: Path, **environment: str) -> tuple[float, float, int]:
    """Return what the caller gives in a new process, and how often it came from the cache."""
    done = subprocess.run(
        [sys.executable, "-B", "-c", f"from {program.name}.caller import show; show()"],
        cwd=program.parent,
        env={**os.environ, "PYTHONPATH": f"{program.parent}:{REPOSITORY}", **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    assert done.returncode == 0, done.stderr
    value, made, hits = json.loads(done.stdout)
    return value, made, hits


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert text.count(old) == 1
    path.write_text(text.replace(old, new))


@pytest.mark.long
def test_a_caller_sees_what_has_changed_in_other_files(program: Path) -> None:
    assert run(program) == (122.0, 123.0, 0)
    assert run(program) == (122.0, 123.0, 2)
    change(program / "called.py", "2.0 * x", "3.0 * x")
    assert run(program) == (123.0, 124.0, 0)
    change(program / "called.py", "20.0", "30.0")
    assert run(program) == (133.0, 134.0, 0)
    change(program / "constants.py", "100.0", "200.0")
    assert run(program) == (233.0, 234.0, 0)
    change(program / "constants.py", "OTHER = 1", "OTHER = 2")
    change(program / "called.py", "OFFSETS = (", "\n# a remark\nOFFSETS = (")
    assert run(program) == (233.0, 234.0, 2)
    change(program / "caller.py", "nogil=True", "fastmath=True")
    assert run(program) == (233.0, 234.0, 0)


@pytest.mark.long
def test_a_changed_kernel_takes_the_place_of_the_old_one(program: Path) -> None:
    run(program)
    before = sorted(path.name for path in (program / "__pycache__").glob("*.nb?"))
    change(program / "called.py", "    return 2.0 * x", "    y = x\n\n    return 3.0 * y")
    run(program)
    after = sorted(path.name for path in (program / "__pycache__").glob("*.nb?"))
    assert [name for name in before if "lambda" not in name] == [
        name for name in after if "lambda" not in name
    ]


@pytest.mark.long
def test_where_nothing_can_be_written_the_users_folder_keeps_the_kernels(
    program: Path, tmp_path: Path
) -> None:
    (program / "__pycache__").write_text("in the way of a folder")
    cache = {"XDG_CACHE_HOME": str(tmp_path / "cache")}
    assert run(program, **cache)[2] == 0
    assert run(program, **cache)[2] == 2
    change(program / "called.py", "2.0 * x", "3.0 * x")
    assert run(program, **cache) == (123.0, 124.0, 0)
    chosen = {"NUMBA_CACHE_DIR": str(tmp_path / "chosen")}
    assert run(program, **chosen)[2] == 0
    change(program / "called.py", "3.0 * x", "4.0 * x")
    assert run(program, **chosen) == (124.0, 125.0, 0)


@pytest.mark.long
def test_a_package_that_moves_with_its_cache_is_compiled_anew(program: Path) -> None:
    """Compiled code imports its own module again, by the name that the package had."""
    run(program)
    for path in program.glob("*.py"):
        path.write_text(path.read_text().replace("program", "renamed"))
    moved = program.rename(program.parent / "renamed")
    assert run(moved) == (122.0, 123.0, 0)
    assert run(moved) == (122.0, 123.0, 2)


UNKNOWN: list[float] = [1.0]


def test_a_value_that_cannot_be_compared_is_named() -> None:
    def function(x: float) -> float:
        return x + UNKNOWN[0]

    with pytest.raises(TypeError, match=r"UNKNOWN: .* of type list"):
        njit("float64(float64)", cache=True)(function)
