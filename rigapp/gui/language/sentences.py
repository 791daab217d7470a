"""Gather what others than the window tell out of their source, with braces where values stand."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final

from rigapp.presentation.told import EDGES, templates
from rigapp.presentation.translation import Text
from rigapp.schema.details import sentence_of

ROOT: Final = Path(__file__).parents[3]

SPEAKERS: Final = (
    "drivers", "model", "calibration", "rigapp/calibrating", "rigapp/config", "rigapp/engine",
    "rigapp/gui/data", "rigapp/gui/testfile", "rigapp/notify", "rigapp/prepare", "rigapp/process",
    "rigapp/queue", "rigapp/replay", "rigapp/report", "rigapp/schema", "rigapp/service",
    "rigapp/simulation", "rigapp/storage", "rigapp/study", "rigapp/twin",
)  # fmt: skip
"""Packages whose sentences the window shows; files and terminals have them in English."""

PAPERS: Final = (
    "drivers/rigapp_drivers/cia402/simulator", "drivers/rigapp_drivers/dataq/simulator",
    "drivers/rigapp_drivers/gsv8/simulator", "drivers/rigapp_drivers/modbus_sensor/simulator",
    "drivers/rigapp_drivers/roboclaw/simulator", "drivers/rigapp_drivers/simulator_api",
    "rigapp/calibrating/certificate", "rigapp/calibrating/certificates",
    "rigapp/calibrating/daily_chart", "rigapp/engine/recording/store", "rigapp/notify",
    "rigapp/prepare", "rigapp/report", "rigapp/schema/channels", "rigapp/schema/columns",
    "rigapp/schema/loglines", "rigapp/service/security", "rigapp/simulation",
    "rigapp/storage/reading/export", "rigapp/storage/reading/oldlog", "rigapp/storage/structure",
    "rigapp/study/pictures", "rigapp/study/table",
)  # fmt: skip
"""Their parts that write files, papers and terminals: of these the window shows what they raise."""

WORD: Final = re.compile(r"[^\W\d_]{2,}")
NAMES: Final = {"rigapp", "rpm", "mm", "µm", "Hz", "kHz", "ms", "min", "px"}
"""The program and units of measurement: the same in every language."""
PATTERNS: Final = re.compile(r"%[sd(]|\(\?|\(\.\+|\\[dSb]")
"""What a journal of messages and regular expressions have."""
LOGGED: Final = {"debug", "info", "warning", "error", "exception", "critical"}


def has_words(text: str) -> bool:
    """Tell whether a text says something; symbols, numbers, units and single letters do not."""
    return any(word not in NAMES for word in WORD.findall(text))


def sentences_of(module: Path, raised: bool = False) -> Iterator[str]:
    """Yield the sentences of a module, with braces where it puts values, without their edges.

    They are its strings of several words, and the arguments of ``Check`` of any length. raised:
    only those of its errors.
    """
    tree = ast.parse(module.read_text("utf-8"))
    roots = [one for one in ast.walk(tree) if isinstance(one, ast.Raise)] if raised else [tree]
    for root in roots:
        for one, checked in _strings(root):
            template = sentence_of(_template(one)).strip(EDGES)
            if has_words(_literal(template)) and (" " in template or checked):
                yield template


def _strings(node: ast.AST, checked: bool = False) -> Iterator[tuple[ast.AST, bool]]:
    """Yield the strings below a node that may be shown, and whether ``Check`` takes them as such.

    What explains, compares, annotates, decorates, names a thread or goes into a journal is not.
    """
    match node:
        case ast.Compare() | ast.Expr(value=ast.Constant()) | ast.keyword(arg="name"):
            return
        case ast.Constant():
            yield node, checked
        case ast.JoinedStr(values=values):
            yield node, checked
            for one in values:
                if isinstance(one, ast.FormattedValue):
                    yield from _strings(one.value)
        case ast.FunctionDef(args=args, body=body):
            for part in (*args.defaults, *args.kw_defaults, *body):
                yield from _strings(part) if part is not None else ()
        case ast.ClassDef(body=body):
            for statement in body:
                yield from _strings(statement)
        case ast.AnnAssign(value=ast.expr() as value):
            yield from _strings(value)
        case ast.Call(func=ast.Attribute(value=ast.Name(id="log"), attr=name)) if name in LOGGED:
            return
        case ast.Call(func=ast.Name(id="Worker")) | ast.Call(func=ast.Attribute(attr="_help")):
            return
        case _:
            check = isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Check"
            for child in ast.iter_child_nodes(node):
                yield from _strings(child, check)


def _template(node: ast.AST) -> str:
    """Return a string with braces where it puts values, empty where a node is none."""
    match node:
        case ast.Constant(value=str(text)) if not PATTERNS.search(text):
            return text if "{" not in text else ""
        case ast.JoinedStr(values=values):
            return "".join(_piece(one) for one in values)
    return ""


def _piece(value: ast.expr) -> str:
    match value:
        case ast.Constant(value=str(text)):
            return text.replace("{", "{{").replace("}", "}}")
        case ast.FormattedValue(format_spec=ast.JoinedStr(values=[ast.Constant(value=str(spec))])):
            return f"{{:{spec}}}"
    return "{}"


def _literal(template: str) -> str:
    return re.sub(r"\{[^{}]*\}", "", template)


def _within(name: str, places: tuple[str, ...]) -> bool:
    return any(name == one or name.startswith(f"{one}/") for one in places)


def all_sentences() -> list[Text]:
    """Return what others than the window say, each once: plain texts, and templates with values."""
    found = {one for one in templates() if has_words(_literal(one))}
    for speaker in SPEAKERS:
        for path in (ROOT / speaker).rglob("*.py"):
            name = path.relative_to(ROOT).with_suffix("").as_posix()
            found.update(sentences_of(path, raised=_within(name, PAPERS)))
    return sorted(found)


def all_templates() -> list[Text]:
    """Return those of the sentences that have values; by them they are known again."""
    return [one for one in all_sentences() if "{" in one]
