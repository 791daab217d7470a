"""Write a settings file with comments: every key with its meaning, range and default."""

from __future__ import annotations

import textwrap
import typing
from collections.abc import Iterator, Mapping
from typing import Any, Final

import msgspec
import tomlkit

from rigapp.config.meanings import meaning_of, tables_in
from rigapp.config.ranges import Key, keys_of

WIDTH: Final = 100


def commented(
    kind: type[msgspec.Struct],
    stated: Mapping[str, Any],
    notes: Mapping[str, str] | None = None,
    settings: Mapping[str, Mapping[str, Any]] | None = None,
    without: tuple[str, ...] = (),
) -> str:
    """Return a file of a kind as TOML: the stated keys, and every other key commented out.

    stated: nested tables as in the file. notes: path of a key -> an additional sentence above it.
    settings: name of a device -> the settings of its driver, each a ``SettingSpec``. without:
    sections to omit.
    """
    keys = {key.path: key for key in keys_of(kind)}
    writer = _Writer(kind, keys, notes or {}, settings or {}, without)
    return "\n".join(writer.section(kind, "", "", stated)).strip() + "\n"


class _Writer:
    """Write the sections of a kind of file in order."""

    def __init__(
        self,
        file: type[msgspec.Struct],
        keys: Mapping[str, Key],
        notes: Mapping[str, str],
        settings: Mapping[str, Mapping[str, Any]],
        without: tuple[str, ...],
    ) -> None:
        self._file, self._keys, self._notes, self._settings = file, keys, notes, settings
        self._without = without

    def section(
        self, kind: type[msgspec.Struct], path: str, name: str, stated: Mapping[str, Any] | None
    ) -> Iterator[str]:
        """Yield the lines below the head of a section; stated is None where it is absent.

        path: with ``*`` for user-defined names, a dot at the end. name: with these names.
        """
        tables = []
        for field in msgspec.structs.fields(kind):
            if tables_in(field.type) or field.type == dict[str, Any]:
                tables.append(field)
                continue
            yield from self._key(self._keys[f"{path}{field.name}"], field.name, stated)
        for field in (table for table in tables if table.name not in self._without):
            value = None if stated is None else stated.get(field.name)
            yield from self._tables(field, f"{path}{field.name}", f"{name}{field.name}", value)

    def _tables(
        self, field: msgspec.structs.FieldInfo, path: str, name: str, stated: Any
    ) -> Iterator[str]:
        if field.type == dict[str, Any]:
            yield from self._driver(name, stated or {})
            return
        (kind,) = tables_in(field.type)
        origin = typing.get_origin(field.type)
        if origin is dict:
            for key, value in (stated or {"NAME": None}).items():
                yield from self._table(kind, f"[{name}.{key}]", f"{path}.*", f"{name}.{key}", value)
        elif origin is tuple:
            for value in stated or [None]:
                yield from self._table(kind, f"[[{name}]]", path, name, value)
        else:
            yield from self._table(kind, f"[{name}]", path, name, stated)

    def _table(
        self, kind: type[msgspec.Struct], head: str, path: str, name: str, stated: Any
    ) -> Iterator[str]:
        yield ""
        yield head if stated is not None else f"# {head}"
        yield from self.section(kind, f"{path}.", f"{name}.", stated)

    def _key(self, key: Key, name: str, stated: Mapping[str, Any] | None) -> Iterator[str]:
        words = meaning_of(self._file, key)
        if key.path in self._notes:
            words += f" {self._notes[key.path]}"
        yield from _comment(words)
        if stated is not None and name in stated:
            yield f"{name} = {toml_value(stated[name])}"
        elif key.default is msgspec.NODEFAULT or key.default is None:
            yield f"# {name} ="
        else:
            yield f"# {name} = {toml_value(key.default)}"

    def _driver(self, name: str, stated: Mapping[str, Any]) -> Iterator[str]:
        """Yield the settings of a device's driver."""
        device = name.split(".")[1]
        if device not in self._settings:
            return
        yield ""
        yield f"[{name}]"
        for key, spec in self._settings[device].items():
            words = spec.sentence
            if spec.choices:
                words += f" One of {', '.join(map(toml_value, spec.choices))}."
            elif spec.minimum is not None and spec.maximum is not None:
                words += f" Allowed: {spec.minimum:.9g} to {spec.maximum:.9g}."
            yield from _comment(words)
            value = stated.get(key, spec.default)
            yield (
                f"{key} = {toml_value(value)}"
                if key in stated
                else f"# {key} = {toml_value(value)}"
            )


def _comment(words: str) -> list[str]:
    return textwrap.wrap(
        words, WIDTH, initial_indent="# ", subsequent_indent="# ", break_long_words=False
    )


def toml_value(value: Any) -> str:
    """Return a value as TOML writes it, on one line."""
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, dict):
        return "{" + ", ".join(f" {key} = {toml_value(item)}" for key, item in value.items()) + " }"
    return tomlkit.item(str(value) if isinstance(value, str) else value).as_string()
