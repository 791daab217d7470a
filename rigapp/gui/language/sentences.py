"""Gather the templates of sentences out of the source: of ``say``, and of errors raised."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from rigapp.presentation.translation import EDGES, Text
from rigapp.schema.alarms import KINDS
from rigapp.schema.details import sentence_of

ROOT: Final = Path(__file__).parents[3]
ON_TERMINALS: Final = (
    "rigapp/analysis", "rigapp/cli", "rigapp/commands", "rigapp/page", "rigapp/publishing",
    "rigapp/start",
)  # fmt: skip
"""Rooms of which the window shows nothing."""

WORD: Final = re.compile(r"[^\W\d_]{2,}")
NAMES: Final = {"rigapp", "rpm", "mm", "µm", "Hz", "kHz", "ms", "min", "px"}
"""The program and units of measurement: the same in every language."""

SYSTEM: Final = (
    "Address already in use", "Broken pipe", "Cannot assign requested address",
    "Connection refused", "Connection reset by peer", "Connection timed out",
    "Device or resource busy", "Directory not empty", "Disk quota exceeded", "File exists",
    "File name too long", "File too large", "Host is down", "Input/output error",
    "Invalid argument", "Is a directory", "Name or service not known", "Network is unreachable",
    "No route to host", "No space left on device", "No such device",
    "No such device or address", "No such file or directory", "Not a directory",
    "Operation not permitted", "Permission denied", "Read-only file system",
    "Resource temporarily unavailable", "Stale file handle", "Too many open files", "timed out",
)  # fmt: skip
"""Errors of the operating system, which sentences have as values."""

LIBRARIES: Final = (
    "Cannot overwrite a value", "Expected '=' after a key in a key/value pair",
    "Expected ']' at the end of a table declaration",
    "Expected ']]' at the end of an array declaration",
    "Expected newline or end of document after a statement", "Invalid date or datetime",
    "Invalid hex value", "Invalid initial character for a key part", "Invalid statement",
    "Invalid value", "Unclosed array", "Unclosed inline table", "Unescaped '\\' in a string",
    "Unterminated string", "Invalid enum value {}", "expected {}, got {}", "expected {} >= {}",
    "expected {} <= {}", "expected {} > {}", "expected {} < {}", "expected {} of length {}",
    "expected {} of length {}, got {}", "expected {} of length >= {}",
    "expected {} of length <= {}", "expected {} of at least length {}",
)  # fmt: skip
"""Errors of the readers of TOML and of records (``rigapp.config.errors``)."""

QUANTITIES: Final = (
    "clearance", "contact law", "density", "gravity", "stiffness", "exponent", "follower angle",
    "follower speed",
    "friction ramp", "impact speed floor", "layers", "loads", "moving mass", "node spacing",
    "poissons ratio", "predictive band", "probe errors", "radii", "relative error", "restitution",
    "running in revolutions", "sectors", "slider position", "slider velocity", "start angle",
    "technique", "times", "tolerance", "typical force", "youngs modulus",
)  # fmt: skip
"""What the model calls a number that it cannot work with."""

UNITS: Final = (
    "revolutions", "revolutions/s", "revolutions/h", "standard deviations", "days",
    "um per 1000 revolutions",
    "a share of 1",
)  # fmt: skip
"""Units that are words."""


def has_words(text: str) -> bool:
    """Tell whether a text says something; symbols, numbers, units and single letters do not."""
    return any(word not in NAMES for word in WORD.findall(text))


def without_braces(template: str) -> str:
    """Return what a template says itself."""
    return re.sub(r"\{[^{}]*\}", "", template)


def said() -> Iterator[tuple[str, Text]]:
    """Yield the module and the template of each sentence, without its details and its edges."""
    for source in ("drivers", "model", "calibration", "rigapp"):
        for path in sorted((ROOT / source).rglob("*.py")):
            name = path.relative_to(ROOT).with_suffix("").as_posix()
            if not name.startswith(ON_TERMINALS):
                yield from ((name, one) for one in sentences_of(path))


def sentences_of(module: Path) -> Iterator[Text]:
    """Yield the templates of a module."""
    for node in ast.walk(ast.parse(module.read_text("utf-8"))):
        for one in _texts(node):
            template = sentence_of(one).strip(EDGES)
            if has_words(without_braces(template)):
                yield template


def _texts(node: ast.AST) -> list[str]:
    """Return what a call says, and the values of an enumeration that are words."""
    match node:
        case ast.ClassDef(bases=[ast.Attribute(attr="StrEnum")], body=body):
            values = [one.value for one in body if isinstance(one, ast.Assign)]
            return [one for one in _literals(values) if " " in one]
        case (
            ast.Raise(exc=ast.Call(args=arguments))
            | ast.Call(func=ast.Attribute(attr="at"), args=arguments)
        ):
            return [one for one in _literals(arguments) if " " in one][:1]
        case ast.Call(func=ast.Name(id="say"), args=arguments):
            return _literals(arguments)[:1]
    return []


def _literals(nodes: list[ast.expr]) -> list[str]:
    constants = [one.value for one in nodes if isinstance(one, ast.Constant)]
    return [one for one in constants if isinstance(one, str)]


def all_sentences() -> list[Text]:
    """Return the templates of all sentences, each once."""
    of_alarms = (
        text
        for kind in KINDS.values()
        for text in (kind.title, sentence_of(kind.sentence), kind.consequence, kind.action)
    )
    tables = (*of_alarms, *SYSTEM, *LIBRARIES, *QUANTITIES, *UNITS)
    known = {*tables} | {template for _, template in said()}
    return sorted(one for one in known if has_words(without_braces(one)))


def all_templates() -> list[Text]:
    """Return the sentences with values."""
    return [one for one in all_sentences() if "{" in one]
