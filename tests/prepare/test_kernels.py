"""The set-up step finds every kernel, and a kernel is compiled once its module is imported."""

from __future__ import annotations

import ast
import importlib
from pathlib import Path

import pytest

from rigapp.prepare.kernels import kernel_modules, kernels_of, may_compile, remove_left_over


@pytest.mark.parametrize(
    "source",
    [
        "from rigapp_model.compiled import njit\n@njit('int64(int64)')\ndef f(x): ...",
        "from rigapp_model import compiled\nf = compiled.njit('int64(int64)')(g)",
        "import numba as nb\nf = nb.njit('int64(int64)')(g)",
        "def make():\n    from numba import vectorize\n    return vectorize(g)",
    ],
)
def test_every_way_to_make_a_kernel_is_seen(source: str) -> None:
    assert may_compile(source)


def test_words_are_no_kernels() -> None:
    assert not may_compile('NAMES = ("numba",)  # @njit and @numba. are words here')


def test_the_overload_check_is_compiled_by_the_set_up_step() -> None:
    assert {"rigapp.engine.judging.checks", "rigapp.engine.values.reduce"} <= set(kernel_modules())


def test_importing_a_module_compiles_all_its_kernels() -> None:
    for name in kernel_modules():
        kernels = kernels_of(importlib.import_module(name))
        assert kernels, f"{name} imports a compiler and has no kernel"
        for kernel in kernels:
            assert kernel.signatures, f"{name}.{kernel.__name__} has no signature"
            assert not kernel._can_compile, f"{name}.{kernel.__name__} compiles when it is called"
            assert kernel.targetoptions.get("nopython")
            assert kernel.stats.cache_path, f"{name}.{kernel.__name__} is not kept"


def test_kernels_are_made_by_one_function_at_the_top_of_a_module() -> None:
    """A kernel made elsewhere could go stale, or be compiled in the middle of a test."""
    for name in kernel_modules():
        path = Path(str(importlib.import_module(name).__file__))
        tree = ast.parse(path.read_text(encoding="utf-8"))
        own = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        sources = {node.module for node in own for alias in node.names if alias.name == "njit"}
        assert sources == {"rigapp_model.compiled"}, name
        inner = [
            part
            for node in ast.walk(tree)
            if isinstance(node, ast.FunctionDef)
            for statement in node.body
            for part in ast.walk(statement)
        ]
        assert not [n for n in inner if isinstance(n, ast.Name) and n.id == "njit"], name


def test_left_over_files_of_the_cache_are_removed() -> None:
    module = importlib.import_module("rigapp.engine.judging.checks")
    neighbours = [
        importlib.import_module(name) for name in kernel_modules() if name.startswith("rigapp.eng")
    ]
    folder = Path(str(module.__file__)).parent / "__pycache__"
    old = [folder / "checks._peak-20.py311.nbi", folder / "checks.gone-.py311.1.nbc"]
    for path in old:
        path.touch()
    kept = set(folder.glob("checks._peak-.*"))
    remove_left_over(neighbours)
    assert not any(path.exists() for path in old)
    assert set(folder.glob("checks._peak-.*")) == kept
