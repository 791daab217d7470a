"""The meaning of every key of a file, and the JSON Schema with it for an editor."""

from __future__ import annotations

import functools
import math
import tomllib
import types
import typing
from collections.abc import Mapping
from importlib.resources import files
from typing import Annotated, Any, Final, Literal

import msgspec

from rigapp.config.numbers import Range
from rigapp.config.parameters import ParameterFile
from rigapp.config.ranges import Key, keys_of, unit_of
from rigapp.config.recipe import TestFile
from rigapp.config.rig import RigFile

KINDS: Final[Mapping[str, type[msgspec.Struct]]] = {"rig": RigFile, "test": TestFile}
"""Kinds of files with a schema, by their name on the command line."""

DIALECT: Final = "http://json-schema.org/draft-07/schema#"
"""Draft 7, the newest one that TOML editors (taplo, Even Better TOML) support."""


@functools.cache
def key_table() -> Mapping[str, Mapping[str, str]]:
    """Return a sentence for each key, by kind of file (a table of keys.toml) and path."""
    return tomllib.loads(files("rigapp.config").joinpath("keys.toml").read_text("utf-8"))


@functools.cache
def meanings() -> Mapping[type[msgspec.Struct], Mapping[str, str]]:
    """Return a sentence for each key of a kind of file, by its path."""
    table = key_table()
    model = {f"model.{path}": words for path, words in table["parameters"].items()}
    return {
        RigFile: table["rig"],
        TestFile: {**table["test"], **model},
        ParameterFile: table["parameters"],
    }


def meaning_of(kind: type[msgspec.Struct], key: Key) -> str:
    """Return the meaning of a key, with its unit, range and choices, as one or two sentences."""
    return described(meanings()[kind][key.path], key)


def described(words: str, key: Key) -> str:
    """Return the sentence of a key with its unit, range and choices."""
    parts = [words]
    parts += [f"{key.words[0].upper()}{key.words[1:]}."] if key.words else []
    unit = unit_of(key.path, key.range)
    if math.isfinite(key.range.low):
        parts.append(f"Allowed: {key.range.words(unit)}.")
    elif unit:
        parts.append(f"Unit: {unit}.")
    if key.choices and not key.words:
        parts.append(f"One of {', '.join(key.choices)}.")
    return " ".join(parts)


def json_schema(
    kind: type[msgspec.Struct], settings: Mapping[str, Mapping[str, Any]] | None = None
) -> dict[str, Any]:
    """Return the JSON Schema of a kind of file, with meaning, unit and range of each key.

    settings: driver -> the schema of each of its settings, for a rig file; others are unrestricted.
    """
    root = _table(kind, "", {key.path: key for key in keys_of(kind)}, kind)
    if settings:
        device = root["properties"]["devices"]["additionalProperties"]
        device["properties"]["driver"]["examples"] = sorted(settings)
        device["allOf"] = [
            {
                "if": {"properties": {"driver": {"const": driver}}},
                "then": {"properties": {"settings": {"type": "object", "properties": dict(keys)}}},
            }
            for driver, keys in sorted(settings.items())
        ]
    return {"$schema": DIALECT, **root}


def _table(
    kind: type[msgspec.Struct], prefix: str, keys: Mapping[str, Key], file: type[msgspec.Struct]
) -> dict[str, Any]:
    """Return the schema of a section; prefix: its path in the file, with a dot at the end."""
    properties, needed = {}, []
    for field in msgspec.structs.fields(kind):
        path = f"{prefix}{field.name}"
        if path in keys and not tables_in(field.type):
            node = _of_type(field.type, keys[path].range)
        else:
            node = _holding(field.type, path, keys, file)
        if path in meanings()[file]:
            node["description"] = meaning_of(file, keys[path])
        default = getattr(field, "default", msgspec.NODEFAULT)
        if isinstance(default, bool | int | float | str | tuple):
            node["default"] = str(default) if isinstance(default, str) else default
        properties[field.name] = node
        if field.required:
            needed.append(field.name)
    words = " ".join((kind.__doc__ or "").split("\n\n")[0].split())
    return {
        "type": "object",
        "description": words,
        "properties": properties,
        "required": needed,
        "additionalProperties": False,
    }


def tables_in(hint: Any) -> list[type[msgspec.Struct]]:
    """Return the sections in a type, at any depth."""
    if isinstance(hint, type) and issubclass(hint, msgspec.Struct):
        return [hint]
    return [table for part in typing.get_args(hint) for table in tables_in(part)]


def _holding(
    hint: Any, path: str, keys: Mapping[str, Key], file: type[msgspec.Struct]
) -> dict[str, Any]:
    """Return the schema of a section, of sections by name, or of a list of sections."""
    (kind,) = tables_in(hint)
    if typing.get_origin(hint) is dict:
        below = _table(kind, f"{path}.*.", keys, file)
        return {"type": "object", "additionalProperties": below}
    below = _table(kind, f"{path}.", keys, file)
    return {"type": "array", "items": below} if typing.get_origin(hint) is tuple else below


_PLAIN: Final = {int: "integer", float: "number", str: "string", bool: "boolean"}


def _of_type(hint: Any, allowed: Range) -> dict[str, Any]:
    """Return the schema of a value that is not a section, with the range of its numbers."""
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if origin is Annotated:
        return _of_type(parts[0], allowed)
    if origin is Literal:
        return {"enum": list(parts)}
    if origin in (typing.Union, types.UnionType):
        kinds = [_of_type(part, allowed) for part in parts if part is not type(None)]
        return kinds[0] if len(kinds) == 1 else {"anyOf": kinds}
    if origin is tuple and parts[-1] is Ellipsis:
        return {"type": "array", "items": _of_type(parts[0], allowed)}
    if origin is tuple:
        items = [_of_type(part, allowed) for part in parts]
        return {"type": "array", "items": items, "minItems": len(items), "maxItems": len(items)}
    if hint not in _PLAIN:
        return {"type": "object"}
    node: dict[str, Any] = {"type": _PLAIN[hint]}
    if hint in (int, float) and math.isfinite(allowed.high):
        node["minimum"] = -allowed.high if allowed.size else allowed.low
        node["maximum"] = allowed.high
    return node


def schema_of_setting(spec: Any) -> dict[str, Any]:
    """Return the schema of one setting of a driver; spec: its ``SettingSpec``."""
    node: dict[str, Any] = {"description": spec.sentence}
    if spec.choices:
        node["enum"] = list(spec.choices)
    elif spec.kind in _PLAIN:
        node["type"] = _PLAIN[spec.kind]
    bounds = {"minimum": spec.minimum, "maximum": spec.maximum}
    node |= {name: bound for name, bound in bounds.items() if bound is not None}
    if isinstance(spec.default, bool | int | float | str):
        node["default"] = str(spec.default) if isinstance(spec.default, str) else spec.default
    return node
