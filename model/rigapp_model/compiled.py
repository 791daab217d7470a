"""Compile kernels with a cache on disk that is never stale.

numba stores compiled code beside the module and reuses it while the file of the function is
unchanged. But the functions that it calls and the constants that it names, perhaps from other
files, are compiled into it as well. Here the code is reused only while everything it was compiled
from is unchanged: the bytecode, constants and options of the kernel and of all kernels that it
calls, directly or indirectly, and the versions of the compiler.

As in numba itself, the cache is in ``NUMBA_CACHE_DIR``, else beside the module, else, if that is
not writable, in the user's cache folder.
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
"""Packages that their version identifies completely."""

PLAIN = (int, float, complex, str, bytes, type(None), np.generic, np.dtype, numba.types.Type)
"""Kinds of constants with a complete repr."""

_DIGEST = "kernel_digest"

UNCOUNTED = {"cache": True, "_nrt": False}
"""Options of a kernel that creates no array: without reference counts of its arguments.

Each count is a locked instruction; a small kernel called once a sample or stage takes up to 1.5
times as long with them.
"""


def njit(signatures: Any, **options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return a decorator that compiles a function immediately; options are those of numba.njit.

    With ``cache=True`` the compiled code is cached as described above. Raises TypeError if the
    function uses a value that cannot be compared with that of another run.
    """

    def compile_kernel(function: Any) -> Any:
        setattr(function, _DIGEST, digest(function, options))
        cached = options.get("cache", False) and _use_keyed_locators()
        return numba.njit(signatures, **{**options, "cache": cached})(function)

    return compile_kernel


def digest(function: FunctionType, options: Mapping[str, Any]) -> str:
    """Return a digest of everything that the compiled code of a function depends on."""
    sha = hashlib.sha256()
    for part in (repr(VERSIONS), *_function(function, options, set())):
        sha.update(part.encode() + b"\0")
    return sha.hexdigest()


def cache_name(function: FunctionType) -> str:
    """Return the prefix of a kernel's cache files, without that of its module."""
    return f"{function.__qualname__.replace('<', '').replace('>', '')}-{_disambiguator(function)}."


def _disambiguator(function: Any) -> str:
    """Return a text that distinguishes kernels created by the same line of source."""
    return getattr(function, _DIGEST)[:12] if "<" in function.__qualname__ else ""


# --- content of the digest ------------------------------------------------------------------------


def _function(
    function: FunctionType, options: Mapping[str, Any], seen: set[FunctionType]
) -> Iterator[str]:
    if function in seen:
        return
    seen.add(function)
    yield function.__module__  # numba's cached code imports its module by this name
    yield repr(sorted(options.items()))
    for value in function.__defaults__ or ():
        yield from _value(value, function.__qualname__, seen)
    for cell in function.__closure__ or ():
        yield from _value(cell.cell_contents, function.__qualname__, seen)
    yield from _code(function.__code__, function.__globals__, seen)


def _code(code: CodeType, names: dict[str, Any], seen: set[FunctionType]) -> Iterator[str]:
    """Yield the bytecode and the values of the module's names that it uses."""
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


# --- numba's cache, with the digest as its stamp --------------------------------------------------


class _Keyed:
    """Mixin: restrict a locator of numba to kernels, with their digest in place of the file's."""

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
    """Locate the cache in the folder NUMBA_CACHE_DIR."""


class KeyedBesideModule(_Keyed, caching.InTreeCacheLocator):
    """Locate the cache in the module's __pycache__."""


class KeyedForUser(_Keyed, caching.UserWideCacheLocator):
    """Locate the cache in the user's cache folder."""


def _use_keyed_locators() -> bool:
    """Insert the locators for kernels before numba's own, which remain for other functions.

    Returns False if NUMBA_CACHE_LOCATOR_CLASSES excludes them: then nothing is cached.
    """
    locators = caching.CacheImpl._locator_classes
    if KeyedInChosenFolder not in locators:
        locators[:0] = [KeyedInChosenFolder, KeyedBesideModule, KeyedForUser]
    return not numba.config.CACHE_LOCATOR_CLASSES
