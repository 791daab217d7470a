"""Compile kernels with a cache on disk that is never stale.

numba keeps compiled code beside the module and uses it again as long as the file of the function
is unchanged. The functions it calls and the constants it names are compiled into it as well, and
may be in other files. Here the compiled code is used again only while everything that went into
it is the same: the bytecode, constants and options of the kernel and of all kernels that it calls,
directly or through others, and the versions of the compiler.

By numba's own rules the cache is in ``NUMBA_CACHE_DIR``, else beside the module, else, where that
cannot be written, in the user's cache folder.
"""

# mypy: disable-error-code="misc"
from __future__ import annotations

import dis
import enum
import hashlib
import sys
from collections.abc import Callable, Iterator, Mapping
from types import BuiltinFunctionType, CodeType, FunctionType, ModuleType
from typing import Any

import numba
import numpy as np
from numba.core import caching
from numba.core.dispatcher import Dispatcher

VERSIONS = (numba.__version__, np.__version__)
FOREIGN = frozenset({"numpy", "numba", "scipy", *sys.stdlib_module_names})
"""Packages whose content follows from their version."""

PLAIN = (int, float, complex, str, bytes, type(None), np.generic, np.dtype, numba.types.Type)
"""Kinds of constants with a complete repr."""

_DIGEST = "kernel_digest"

UNCOUNTED = {"cache": True, "_nrt": False}
"""Options of a kernel that makes no array: it counts no references to its arguments.

Each count is a locked instruction; a small kernel called once a sample or stage takes up to half as
long again with them.
"""


def njit(signatures: Any, **options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that compiles a function at once; options are those of numba.njit.

    With ``cache=True`` the compiled code is kept as this module says. Raises TypeError when the
    function names a value that cannot be compared with that of another run.
    """

    def compile_kernel(function: Any) -> Any:
        setattr(function, _DIGEST, digest(function, options))
        kept = options.get("cache", False) and _use_keyed_locators()
        return numba.njit(signatures, **{**options, "cache": kept})(function)

    return compile_kernel


def digest(function: FunctionType, options: Mapping[str, Any]) -> str:
    """Return a digest of everything that the compiled code of a function depends on."""
    sha = hashlib.sha256()
    for part in (repr(VERSIONS), *_function(function, options, set())):
        sha.update(part.encode() + b"\0")
    return sha.hexdigest()


def cache_name(function: FunctionType) -> str:
    """Return the prefix of a kernel's files in the cache, after that of its module."""
    return f"{function.__qualname__.replace('<', '').replace('>', '')}-{_disambiguator(function)}."


def _disambiguator(function: Any) -> str:
    """Return a text that distinguishes kernels made repeatedly by one line of source."""
    return getattr(function, _DIGEST)[:12] if "<" in function.__qualname__ else ""


# --- content of the digest ------------------------------------------------------------------------


def _function(
    function: FunctionType, options: Mapping[str, Any], seen: set[FunctionType]
) -> Iterator[str]:
    if function in seen:
        return
    seen.add(function)
    yield function.__module__  # what numba keeps imports its own module again by this name
    yield repr(sorted(options.items()))
    for value in function.__defaults__ or ():
        yield from _value(value, function.__qualname__, seen)
    for cell in function.__closure__ or ():
        yield from _value(cell.cell_contents, function.__qualname__, seen)
    yield from _code(function.__code__, function.__globals__, seen)


def _code(code: CodeType, names: dict[str, Any], seen: set[FunctionType]) -> Iterator[str]:
    """Yield the bytecode, and the values of the names that it looks up in its module."""
    yield repr((code.co_code, code.co_names, code.co_varnames, code.co_freevars))
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _code(constant, names, seen)
        else:
            yield from _value(constant, code.co_qualname, seen)
    looked_up = {each.argval for each in dis.get_instructions(code) if each.opname == "LOAD_GLOBAL"}
    for name in sorted(looked_up & names.keys()):
        value = names[name]
        yield name
        if not isinstance(value, ModuleType):
            yield from _value(value, f"{code.co_qualname}, {name}", seen)
        elif not _foreign(value.__name__):
            for attribute in filter(value.__dict__.__contains__, code.co_names):
                where = f"{code.co_qualname}, {name}.{attribute}"
                yield from _value(getattr(value, attribute), where, seen)


def _value(value: Any, where: str, seen: set[FunctionType]) -> Iterator[str]:
    if isinstance(value, PLAIN):
        yield f"{type(value).__name__} {value!r}"
    elif isinstance(value, Dispatcher):
        if hasattr(value.py_func, _DIGEST):
            yield getattr(value.py_func, _DIGEST)
        else:
            yield from _function(value.py_func, value.targetoptions, seen)
    elif isinstance(value, tuple):
        yield f"{type(value).__name__} of {len(value)}"
        for item in value:
            yield from _value(item, where, seen)
    elif isinstance(value, frozenset):
        yield from sorted("".join(_value(item, where, seen)) for item in value)
    elif isinstance(value, np.ndarray):
        yield f"{value.dtype} {value.shape} {value.tobytes().hex()}"
    elif isinstance(value, type):
        yield f"{value.__qualname__} {getattr(value, '_fields', ())}"
        if issubclass(value, enum.Enum):
            yield repr(list(value))
    elif isinstance(value, FunctionType) and not _foreign(value.__module__):
        yield from _function(value, {}, seen)
    elif isinstance(value, FunctionType | BuiltinFunctionType | np.ufunc):
        yield f"{value.__module__ if hasattr(value, '__module__') else ''} {value.__name__}"
    else:
        raise TypeError(
            f"{where}: compiled code cannot be kept by a value of type {type(value).__name__};"
            " use a number, a string, a tuple, an array or a kernel"
        )


def _foreign(module: str | None) -> bool:
    return module is None or module.partition(".")[0] in FOREIGN


# --- numba's cache, kept by the digest ------------------------------------------------------------


class _Keyed:
    """Let one of numba's locators take kernels only, and their digest for the file's."""

    def __init__(self, py_func: Any, py_file: str) -> None:
        super().__init__(py_func, py_file)  # type: ignore[call-arg]
        self._function = py_func

    def get_source_stamp(self) -> str:
        return str(getattr(self._function, _DIGEST))

    def get_disambiguator(self) -> str:
        return _disambiguator(self._function)

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> Any:
        if not hasattr(py_func, _DIGEST):
            return None
        return super().from_function(py_func, py_file)


class KeyedInChosenFolder(_Keyed, caching.UserProvidedCacheLocator):
    """In the folder that NUMBA_CACHE_DIR names."""


class KeyedBesideModule(_Keyed, caching.InTreeCacheLocator):
    """In the module's __pycache__."""


class KeyedForUser(_Keyed, caching.UserWideCacheLocator):
    """In the user's cache folder."""


def _use_keyed_locators() -> bool:
    """Put the locators for kernels before numba's own, which serve all other functions.

    Returns False where NUMBA_CACHE_LOCATOR_CLASSES allows no others: then nothing is cached.
    """
    present = caching.CacheImpl._locator_classes
    if KeyedInChosenFolder not in present:
        present[:0] = [KeyedInChosenFolder, KeyedBesideModule, KeyedForUser]
    return not numba.config.CACHE_LOCATOR_CLASSES
