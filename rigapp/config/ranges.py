"""Check the numbers of files, live changes and requests against the ranges of their fields.

A key is the dotted path of a number in its file, ``*`` for a user-defined name; the unit is that in
the key. Every number must be finite; a field without a range has no further restriction.
"""

from __future__ import annotations

import functools
import math
import types
import typing
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Final, Literal

import msgspec

from rigapp.config.notify import NotifyFile
from rigapp.config.numbers import ANY, Range
from rigapp.config.parameters import ParameterFile
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile
from rigapp.schema.units import MISTAKEN, unit_of_key
from rigapp.texts import Sentence, say


@dataclass(frozen=True, slots=True)
class Key:
    """A key of a file that is not a table: path, type, default and range.

    value_type: without None and annotations. choices: the allowed texts, if restricted. words:
    meanings of its values, if described. default: NODEFAULT when the key is required. optional: its
    section may be absent.
    """

    path: str
    value_type: Any
    default: Any
    range: Range
    choices: tuple[str, ...] = ()
    optional: bool = False
    words: str = ""


@functools.cache
def keys_of(kind: type[msgspec.Struct]) -> tuple[Key, ...]:
    """Return the keys of a kind of file, in the order of the file."""
    return tuple(_keys(kind, "", optional=False))


def _keys(kind: type[msgspec.Struct], prefix: str, *, optional: bool) -> Iterator[Key]:
    for field in msgspec.structs.fields(kind):
        path = f"{prefix}{field.name}"
        hint, nullable = _without_none(field.type)
        inner = (typing.get_args(hint) or (None,))[-1 if typing.get_origin(hint) is dict else 0]
        if _is_struct(hint):
            yield from _keys(hint, f"{path}.", optional=optional or nullable)
            continue
        if _is_struct(inner):
            star = ".*" if typing.get_origin(hint) is dict else ""
            yield from _keys(inner, f"{path}{star}.", optional=True)
        choices, metas = tuple(_choices(field.type)), getattr(field.type, "__metadata__", ())
        words = next((meta.description for meta in metas if meta.description), "")
        yield Key(path, hint, field.default, _range_in(field.type), choices, optional, words)


def _is_struct(hint: Any) -> bool:
    return isinstance(hint, type) and issubclass(hint, msgspec.Struct)


def _without_none(hint: Any) -> tuple[Any, bool]:
    """Return a type without annotation and None, and whether it may be None."""
    hint = _bare(hint)
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        kinds = [kind for kind in typing.get_args(hint) if kind is not type(None)]
        return _bare(kinds[0]), type(None) in typing.get_args(hint)
    return hint, False


def _bare(hint: Any) -> Any:
    return typing.get_args(hint)[0] if typing.get_origin(hint) is Annotated else hint


def _range_in(hint: Any) -> Range:
    """Return the range in a type, at any depth."""
    for meta in getattr(hint, "__metadata__", ()):
        if isinstance(meta, msgspec.Meta) and "range" in (meta.extra or {}):
            result: Range = (meta.extra or {})["range"]
            return (
                result.counted() if int in (_bare(hint), *typing.get_args(_bare(hint))) else result
            )
    parts = typing.get_args(hint)
    return next((result for part in parts if (result := _range_in(part)) is not ANY), ANY)


def _choices(hint: Any) -> Iterator[str]:
    """Yield the values of every Literal within a type."""
    for part in typing.get_args(hint):
        if typing.get_origin(hint) is Literal:
            yield str(part)
        else:
            yield from _choices(part)


RANGES: Final[Mapping[str, Range]] = {
    key.path: key.range
    for kind in (TestFile, ParameterFile, RigFile, NotifyFile)
    for key in keys_of(kind)
    if key.range is not ANY
}
"""Ranges in test, parameter and rig files; ``devices.NAME.settings`` are checked by drivers."""

LEVELS: Final[Mapping[str, Range]] = {
    "N": Range(-10_000.0, 10_000.0),
    "um": Range(-20_000.0, 20_000.0),
    "mm": Range(-20.0, 20.0),
    "rpm": Range(0.0, 5000.0),
    "deg": Range(-360.0, 360.0),
}
"""Unit of a quantity -> range of a rule's level for it."""

OTHER_LEVEL: Final = Range(-1e9, 1e9)
"""Range of a level for a quantity of any other unit."""


def unit_of(key: str, allowed: Range | None = None) -> str:
    """Return the unit of a key for a sentence, empty without one."""
    allowed = RANGES.get(key, ANY) if allowed is None else allowed
    return allowed.unit or unit_of_key(key).words


def refusal(key: str, value: Any, allowed: Range | None = None, unit: str | None = None) -> str:
    """Return the fault of a key's value, without a full stop; empty when it is valid.

    allowed, unit: instead of the field's. The sentence suggests the probably intended unit.
    """
    allowed = RANGES.get(key, ANY) if allowed is None else allowed
    unit = unit_of(key, allowed) if unit is None else unit
    bounded = math.isfinite(allowed.low)
    range_words = say("; allowed is {}", allowed.words(unit)) if bounded else ""
    if isinstance(value, bool) or not isinstance(value, int | float):
        shown = str(value).lower() if isinstance(value, bool) else repr(value)
        return say("{} = {} is not a number{}", key, shown, range_words)
    if isinstance(value, float) and not math.isfinite(value):
        return say("{} = {} is not a finite number{}", key, value, range_words)
    if allowed.integer and not isinstance(value, int):
        return say("{} = {} is not an integer{}", key, value, range_words)
    if allowed.holds(value):
        return ""
    return say(
        "{} = {} is outside {}{}",
        key,
        _shown(value),
        allowed.words(unit),
        _suggestion(value, allowed, unit),
    )


def refusals(record: msgspec.Struct) -> Iterator[str]:
    """Yield the faults of the numbers of a record, in the order of the file."""
    ranges = {key.path: key.range for key in keys_of(type(record))}
    for name in record.__struct_fields__:
        yield from _of_value(name, name, getattr(record, name), ranges)


def _of_value(key: str, shown: str, value: Any, ranges: Mapping[str, Range]) -> Iterator[str]:
    if isinstance(value, msgspec.Struct):
        for name in value.__struct_fields__:
            yield from _of_value(f"{key}.{name}", f"{shown}.{name}", getattr(value, name), ranges)
    elif isinstance(value, dict):
        for name, item in value.items():
            if isinstance(item, msgspec.Struct):
                yield from _of_value(f"{key}.*", f"{shown}.{name}", item, ranges)
    elif isinstance(value, tuple):
        for number, item in enumerate(value, 1):
            yield from _of_value(key, say("{} {}", shown, number), item, ranges)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        allowed = ranges.get(key, ANY)
        fault = refusal(shown, value, allowed, unit_of(key, allowed))
        if fault:
            yield fault


LONGEST_SHOWN: Final = 1e15
"""Largest number written without an exponent, as operators type it; floats are exact up to it."""


def _shown(value: float) -> str:
    try:
        if 1e9 <= abs(value) < LONGEST_SHOWN:
            return f"{value:.0f}"
        return f"{value:.9g}"
    except OverflowError:
        return say("a number of {} digits", len(str(abs(value))))


def _suggestion(value: float, allowed: Range, unit: str) -> str:
    for other, factor, offset in MISTAKEN.get(unit, ()):
        try:
            converted = value * factor + offset
        except OverflowError:
            continue
        if converted and allowed.holds(converted):
            return say("; did you mean {}? Then write {:.6g}", Sentence(other), converted)
    return ""
