"""Fields of a test file for a form: path, unit, range, default, choices."""

from __future__ import annotations

import math
import re
import typing
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import msgspec

from rigapp.config.ranges import Key, keys_of, refusal, unit_of
from rigapp.config.recipe import TestFile
from rigapp.gui.language.keys import key_name
from rigapp.gui.widgets.numbers import number, whole
from rigapp.presentation.numbers import unit_text
from rigapp.presentation.translation import Text, tr, translate
from rigapp.schema.channels import BASE
from rigapp.viewer.levels import levels_of

HIDDEN = ("schema", "model.schema", "limits.rule", "run.step", "view.")
"""Keys that the form does not change, or shows elsewhere."""


@dataclass(frozen=True, slots=True)
class FieldSpec(Key):
    """One field of the form."""

    @property
    def kind(self) -> str:
        """Return the kind of value: int, float, str, bool, "choice" or "pair"."""
        if self.choices:
            return "choice"
        if typing.get_origin(self.value_type) is tuple:
            return "pair"
        return {int: "int", float: "float", bool: "bool"}.get(self.value_type, "str")

    @property
    def key(self) -> str:
        """Return the key within its section."""
        return self.path.rsplit(".", 1)[-1]

    @property
    def section(self) -> str:
        """Return the dotted path of the section, empty for the top."""
        return self.path.rpartition(".")[0]

    @property
    def unit(self) -> str:
        """Return the unit in the key, empty without one."""
        return unit_text(unit_of(self.path))

    @property
    def label(self) -> str:
        """Return the caption of the field."""
        return tr(self.name)

    @property
    def name(self) -> Text:
        """Return the key in words, without its unit."""
        return key_name(self.key)

    @property
    def needed(self) -> bool:
        """Return whether the key is required."""
        return self.default is msgspec.NODEFAULT

    @property
    def allowed(self) -> str:
        """Return range, default and the meaning of the values."""
        parts = []
        if math.isfinite(self.range.low):
            low, high = f"{self.range.low:g}", f"{self.range.high:g} {self.unit}".rstrip()
            parts.append(tr("{} to {}", low, high))
        if not self.needed and self.kind != "str":
            parts.append(tr("default {}", self.default_words))
        return "; ".join(filter(None, (*parts, tr(self.words))))

    @property
    def default_words(self) -> str:
        """Return the default in words."""
        return tr(show_value(self.default).replace("_", " ") or "off")

    @property
    def hint(self) -> str:
        """Return key, range, default and the meaning of the values."""
        return "; ".join(filter(None, (self.path, self.allowed)))


@cache
def form_fields() -> tuple[FieldSpec, ...]:
    """Return the fields of a test file in the order of the file."""
    shown = (key for key in keys_of(TestFile) if not key.path.startswith(HIDDEN))
    return tuple(FieldSpec(*(getattr(key, name) for name in Key.__slots__)) for key in shown)


WANTED: Final[dict[str, Text]] = {
    "int": "{} must be an integer, not {}",
    "float": "{} must be a number, not {}",
    "pair": "{} must be two numbers, not {}",
}


def parse_value(field: FieldSpec, text: str) -> Any:
    """Return the value of a text; raises ValueError with one sentence."""
    text = text.strip()
    try:
        if field.kind == "int":
            value: Any = whole(text)
        elif field.kind == "float":
            value = number(text)
        elif field.kind == "pair":
            value = _two_numbers(text)
        else:
            return text
    except ValueError:
        raise ValueError(tr(WANTED[field.kind], field.label, repr(text))) from None
    for part in value if field.kind == "pair" else (value,):
        wrong = refusal(field.path, part)
        if wrong:
            raise ValueError(f"{field.label}: {translate(wrong)}")
    return value


def _two_numbers(text: str) -> list[float]:
    """Return the numbers of "0, 9.81", "0,5; 9,81" or "0 9,81"; raise ValueError."""
    parts = re.split(r"\s*;\s*|\s*,\s+|\s+", text)
    if len(parts) == 1:
        parts = text.split(",")
    first, second = map(number, parts)
    return [first, second]


def show_value(value: Any) -> str:
    """Return a value as the form shows it, empty for None."""
    if value is None:
        return ""
    if isinstance(value, (list, tuple)):
        return ", ".join(
            f"{part:g}" if isinstance(part, int | float) else str(part) for part in value
        )
    if isinstance(value, float):
        return f"{value:.10g}"
    return str(value)


def get_path(tree: Mapping[str, Any], path: str) -> Any:
    """Return the value at a dotted path, None when it is missing."""
    value: Any = tree
    for key in path.split("."):
        if not isinstance(value, Mapping) or key not in value:
            return None
        value = value[key]
    return value


def set_path(tree: dict[str, Any], path: str, value: Any) -> None:
    """Set the value at a dotted path, creating missing tables."""
    *parents, last = path.split(".")
    for key in parents:
        tree = tree.setdefault(key, {})
    tree[last] = value


def changes(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[str]:
    """Return the differences between two trees, one line for each key."""
    lines = []
    flat_before, flat_after = dict(_flat(before, "")), dict(_flat(after, ""))
    for path in sorted({*flat_before, *flat_after}):
        old, new = flat_before.get(path), flat_after.get(path)
        if old != new:
            lines.append(f"{path}: {_word(old)} → {_word(new)}")
    return lines


def differences(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[str]:
    """Return the differences between two tests, one line for each key; limits as sentences."""
    rule = "limits.rule"
    lines = [line for line in changes(before, after) if not line.startswith(rule)]
    old, new = (
        [level.sentence(BASE) for level in levels_of(tables_in(get_path(tree, rule)))]
        for tree in (before, after)
    )
    lines += [tr("new limit: {}", limit) for limit in new if limit not in old]
    lines += [tr("limit gone: {}", limit) for limit in old if limit not in new]
    return lines or ([tr("the order of the limits")] if _other_rules(before, after) else [])


def _other_rules(before: Mapping[str, Any], after: Mapping[str, Any]) -> bool:
    return any(line.startswith("limits.rule") for line in changes(before, after))


def tables_in(value: Any) -> list[dict[str, Any]]:
    """Return the tables of a value that is an array of tables, else an empty list."""
    return [item for item in value if isinstance(item, dict)] if isinstance(value, list) else []


def in_form_words(sentence: str) -> str:
    """Return a sentence with keys of a test file replaced by their labels in the form."""
    labels = {field.path: f"\u201c{field.label}\u201d" for field in form_fields()}
    return re.sub(
        r"\b[a-z_]+(\.\w+)+",
        lambda key: labels.get(key[0], key[0]),
        sentence.removeprefix("test: "),
    )


def fields_named(sentence: str) -> list[str]:
    """Return the paths of the fields named in a sentence, in its order."""
    known = {field.path for field in form_fields()}
    return [key[0] for key in re.finditer(r"\b[a-z_]+(\.\w+)+", sentence) if key[0] in known]


def _word(value: Any) -> str:
    return tr("none") if value is None else show_value(value)


def _flat(tree: Any, prefix: str) -> Iterator[tuple[str, Any]]:
    if isinstance(tree, Mapping):
        for key, value in tree.items():
            yield from _flat(value, f"{prefix}.{key}" if prefix else str(key))
    elif isinstance(tree, list) and tree and isinstance(tree[0], Mapping):
        for index, value in enumerate(tree):
            yield from _flat(value, f"{prefix}.{index + 1}")
    else:
        yield prefix, tree
