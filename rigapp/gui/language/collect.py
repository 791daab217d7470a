"""Gather the texts of the window from its source into the catalogues: ``make translations``.

Where a signature, a field or a table is annotated as ``Text``, its literals are texts. Texts of
the engine that the window only shows (alarms, states) come from the engine's tables.
"""

from __future__ import annotations

import ast
import calendar
import json
import re
import subprocess
import tempfile
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Final

import PySide6

from rigapp import viewer
from rigapp.checks.check import CheckVerdict
from rigapp.config.report import ReportSection
from rigapp.gui.language.keys import column_texts, key_texts
from rigapp.presentation import translation
from rigapp.presentation.catalogue import LANGUAGES, SENTENCES, WINDOW, catalogue_file
from rigapp.presentation.translation import EDGES, ENGLISH, Text
from rigapp.schema.alarms import KINDS
from rigapp.schema.columns import WEAR_MODELS
from rigapp.schema.criteria import CRITERIA
from rigapp.schema.details import sentence_of
from rigapp.schema.messages import HowEnded, RunState, Severity
from rigapp.schema.verbs import VERBS
from rigapp.schema.words import WORDS

ROOT: Final = Path(__file__).parents[3]
ON_TERMINALS: Final = (
    "rigapp/analysis", "rigapp/cli", "rigapp/commands", "rigapp/page", "rigapp/publishing",
    "rigapp/start",
)  # fmt: skip
"""Packages without texts that the window shows."""

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
"""Errors of the operating system, which are values of sentences."""

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
"""Names of numbers in the model's error messages."""

UNITS: Final = (
    "revolutions", "revolutions/s", "revolutions/h", "standard deviations", "days",
    "um per 1000 revolutions",
    "a share of 1",
)  # fmt: skip
"""Units written as words."""


def has_words(text: str) -> bool:
    """Return whether a text needs translation, unlike symbols, numbers, units or single letters."""
    return any(word not in NAMES for word in WORD.findall(text))


def without_braces(template: str) -> str:
    """Return a template without its placeholders."""
    return re.sub(r"\{[^{}]*\}", "", template)


@cache  # reading the whole source takes seconds
def module_sentences() -> tuple[tuple[str, Text], ...]:
    """Return module and template of each sentence, without details and surrounding space."""
    paths = {
        path.relative_to(ROOT).with_suffix("").as_posix(): path
        for source in ("drivers", "model", "calibration", "rigapp")
        for path in sorted((ROOT / source).rglob("*.py"))
    }
    return tuple(
        (name, template)
        for name, path in paths.items()
        if not name.startswith(ON_TERMINALS)
        for template in sentences_of(path)
    )


def sentences_of(module: Path) -> Iterator[Text]:
    """Yield the templates of a module."""
    for node in ast.walk(ast.parse(module.read_text("utf-8"))):
        for text in _texts(node):
            template = sentence_of(text).strip(EDGES)
            if has_words(without_braces(template)):
                yield template


def _texts(node: ast.AST) -> list[str]:
    """Return the texts of a call, and the values of an enumeration that are words."""
    match node:
        case ast.ClassDef(bases=[ast.Attribute(attr="StrEnum")], body=body):
            values = [member.value for member in body if isinstance(member, ast.Assign)]
            return [text for text in _literals(values) if " " in text]
        case (
            ast.Raise(exc=ast.Call(args=arguments))
            | ast.Call(func=ast.Attribute(attr="at"), args=arguments)
        ):
            return [text for text in _literals(arguments) if " " in text][:1]
        case ast.Call(func=ast.Name(id="say"), args=arguments):
            return _literals(arguments)[:1]
        case ast.Call(func=ast.Name(id="refusal" | "note"), args=[_, *arguments]):
            return _literals(arguments)[:1]
    return []


def _literals(nodes: list[ast.expr]) -> list[str]:
    constants = [node.value for node in nodes if isinstance(node, ast.Constant)]
    return [value for value in constants if isinstance(value, str)]


def all_sentences() -> list[Text]:
    """Return the templates of all sentences, each once."""
    of_alarms = (
        text
        for kind in KINDS.values()
        for text in (kind.title, sentence_of(kind.sentence), kind.consequence, kind.action)
    )
    tables = (*of_alarms, *SYSTEM, *LIBRARIES, *QUANTITIES, *UNITS)
    known = {*tables} | {template for _, template in module_sentences()}
    return sorted(text for text in known if has_words(without_braces(text)))


def all_templates() -> list[Text]:
    """Return the sentences with values."""
    return [template for template in all_sentences() if "{" in template]


SOURCES: Final = (
    Path(__file__).parents[1],
    Path(viewer.__file__).parent,
    Path(translation.__file__).parent,
)
"""The window, its view of a test, and texts shared with other packages."""
REPORT: Final = (
    *(Path(__file__).parents[2] / "report" / folder for folder in ("page", "testreport")),
    Path(translation.__file__).parent,
)
"""The report, whose functions for texts have other names than the window's."""

MARK: Final = "Text"
SHOWN_AS_IT_IS: Final = frozenset(
    {
        "QAction", "QCheckBox", "QGroupBox", "QLabel", "QPushButton", "QRadioButton",
        "QToolButton", "TextItem", "addItem", "addTab", "setAccessibleDescription",
        "setAccessibleName", "setLabel", "setPlaceholderText", "setSpecialValueText",
        "setTabToolTip", "setText", "setTitle", "setToolTip", "setWindowTitle",
    }
)  # fmt: skip
"""Functions of Qt and the plots that show literals without ``tr``, so never translated."""

Place = tuple[str, int]
"""Module and line of a text."""


@dataclass(slots=True)
class Texts:
    """The texts with their places in the source, and those that no catalogue can contain.

    loose: literals shown untranslated, and sentences composed without braces.
    """

    texts: dict[str, Place] = field(default_factory=dict)
    loose: list[Place] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class Taken:
    """A parameter or field with its annotation. rest: it receives all further arguments."""

    name: str
    annotation: ast.expr | None
    rest: bool = False


class _Marks:
    """Record which parameters of functions and classes are texts, by name."""

    def __init__(self, modules: dict[str, ast.Module]) -> None:
        self.aliases: dict[str, ast.expr] = {MARK: ast.Name(MARK)}
        self.parameters: dict[str, list[list[Taken]]] = defaultdict(list)
        for tree in modules.values():
            for node in tree.body:
                match node:
                    case ast.ImportFrom(names=names):  # import Text as Words
                        renamed = [name.asname for name in names if name.name == MARK]
                        self.aliases |= dict.fromkeys(filter(None, renamed), ast.Name(MARK))
                    case ast.Assign(targets=[ast.Name(id=name)], value=value) if _names(
                        value, MARK
                    ):
                        self.aliases[name] = value
        for tree in modules.values():
            for definition in ast.walk(tree):
                if isinstance(definition, ast.FunctionDef):
                    self._note(definition.name, _parameters(definition))
                elif isinstance(definition, ast.ClassDef):
                    self._note(definition.name, _made_with(definition))

    def _note(self, name: str, taken: list[Taken]) -> None:
        if any(self.is_text(parameter.annotation) for parameter in taken):
            self.parameters[name].append(taken)

    def is_text(self, annotation: ast.expr | None) -> bool:
        """Return whether an annotation contains texts."""
        return annotation is not None and _names(annotation, *self.aliases)


def _names(tree: ast.expr, *wanted: str) -> bool:
    return any(isinstance(node, ast.Name) and node.id in wanted for node in ast.walk(tree))


def _parameters(function: ast.FunctionDef) -> list[Taken]:
    args = function.args
    taken = [Taken(item.arg, item.annotation) for item in (*args.posonlyargs, *args.args)]
    if taken and taken[0].name in ("self", "cls"):
        taken = taken[1:]
    if args.vararg is not None:
        taken.append(Taken(args.vararg.arg, args.vararg.annotation, rest=True))
    return [*taken, *(Taken(item.arg, item.annotation) for item in args.kwonlyargs)]


def _made_with(definition: ast.ClassDef) -> list[Taken]:
    for node in definition.body:
        if isinstance(node, ast.FunctionDef) and node.name == "__init__":
            return _parameters(node)
    fields = [node for node in definition.body if isinstance(node, ast.AnnAssign)]
    return [Taken(ast.unparse(node.target), node.annotation) for node in fields]


class _Reader(ast.NodeVisitor):
    """Read one module."""

    def __init__(self, name: str, marks: _Marks, texts: Texts) -> None:
        self._name, self._marks, self._texts = name, marks, texts
        self._bases: list[str] = []

    def visit_ClassDef(self, node: ast.ClassDef) -> None:
        self._bases.append(next((base.id for base in node.bases if isinstance(base, ast.Name)), ""))
        self.generic_visit(node)
        self._bases.pop()

    def visit_AnnAssign(self, node: ast.AnnAssign) -> None:
        if node.value is not None:
            self._take(node.annotation, node.value)
        self.generic_visit(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> None:
        args = node.args
        last = args.args[len(args.args) - len(args.defaults) :]
        defaults = zip((*last, *args.kwonlyargs), (*args.defaults, *args.kw_defaults), strict=True)
        for parameter, value in defaults:
            if value is not None:
                self._take(parameter.annotation, value)
        for part in ast.walk(node):
            if isinstance(part, ast.Return) and part.value is not None and node.returns is not None:
                self._take(node.returns, part.value)
        self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> None:
        if isinstance(node.func, ast.Name) and node.func.id == "say":  # gathered by ``sentences``
            self.generic_visit(node)
            return
        if self._called(node.func) in SHOWN_AS_IT_IS:
            for value in (*node.args, *(keyword.value for keyword in node.keywords)):
                self._note_loose(value)
        for parameters in self._marks.parameters.get(self._called(node.func), ()):
            rest = next((parameter for parameter in parameters if parameter.rest), None)
            for index, value in enumerate(node.args):
                before = rest is None or index < parameters.index(rest)
                parameter = parameters[index] if before and index < len(parameters) else rest
                if parameter is not None:
                    self._take(parameter.annotation, value)
            by_name = {parameter.name: parameter.annotation for parameter in parameters}
            for keyword in node.keywords:
                self._take(by_name.get(keyword.arg or ""), keyword.value)
        self.generic_visit(node)

    def _note_loose(self, value: ast.expr) -> None:
        match value:
            case ast.IfExp(body=first, orelse=second) | ast.BinOp(left=first, right=second):
                self._note_loose(first)
                self._note_loose(second)
            case ast.Constant(value=str(text)) if has_words(text):
                self._texts.loose.append((self._name, value.lineno))
            case ast.JoinedStr(values=parts):
                for part in parts:
                    self._note_loose(part)

    def _called(self, function: ast.expr) -> str:
        if isinstance(function, ast.Attribute):
            constructs = function.attr == "__init__" and self._bases
            return self._bases[-1] if constructs else function.attr
        return function.id if isinstance(function, ast.Name) else ""

    def _take(self, annotation: ast.expr | None, value: ast.expr) -> None:
        """Collect the texts of a value by its annotation, descending into both."""
        if annotation is None or not self._marks.is_text(annotation):
            return
        match annotation, value:
            case _, ast.IfExp(body=first, orelse=second):
                self._take(annotation, first)
                self._take(annotation, second)
            case _, ast.BoolOp(values=values):
                for operand in values:
                    self._take(annotation, operand)
            case ast.Name(id=alias), _ if alias != MARK:
                self._take(self._marks.aliases[alias], value)
            case ast.Name(), ast.Constant(value=str(text)):
                if has_words(text):
                    self._texts.texts.setdefault(text, (self._name, value.lineno))
            case ast.Name(), ast.JoinedStr():
                self._note_loose(value)
            case ast.BinOp(op=ast.BitOr(), left=left, right=right), _:
                self._take(left, value)
                self._take(right, value)
            case ast.Subscript(slice=ast.Tuple(elts=[of, ast.Constant()])), _:  # tuple[Text, ...]
                self._take_each(of, value)
            case ast.Subscript(slice=ast.Tuple(elts=[key, of])), ast.Dict(keys=keys, values=values):
                for name, item in zip(keys, values, strict=True):
                    if name is not None:
                        self._take(key, name)
                    self._take(of, item)
            case ast.Subscript(slice=ast.Tuple(elts=kinds)), ast.Tuple(elts=values):
                for kind, item in zip(kinds, values, strict=False):
                    self._take(kind, item)
            case ast.Subscript(slice=of), ast.Dict():
                self._take(of, value)
            case ast.Subscript(value=ast.Name(id="Final"), slice=of), _:
                self._take(of, value)
            case ast.Subscript(slice=of), _:
                self._take_each(of, value)

    def _take_each(self, of: ast.expr, value: ast.expr) -> None:
        match value:
            case ast.Tuple(elts=values) | ast.List(elts=values) | ast.Set(elts=values):
                for item in values:
                    self._take(of, item)
            case ast.GeneratorExp(elt=item) | ast.ListComp(elt=item) | ast.Starred(value=item):
                self._take(of, item)


@cache
def texts_of(*sources: Path) -> Texts:
    """Return the texts of the modules below folders; without folders, of the program."""
    modules = {
        path.relative_to(source.parent).as_posix(): ast.parse(path.read_text("utf-8"))
        for source in sources or SOURCES
        for path in sorted(source.rglob("*.py"))
    }
    marks, texts = _Marks(modules), Texts()
    for name, tree in modules.items():
        _Reader(name, marks, texts).visit(tree)
    return texts


def texts_of_tables() -> list[Text]:
    """Return the texts of the engine's tables that the window shows, and days and months."""
    words = [state.value for state in RunState] + [verb.replace("_", " ") for verb in VERBS]
    words += [*WORDS, *WORDS.values()]
    words += [ending.value for ending in HowEnded]
    words += [member.value for member in (*CheckVerdict, *Severity)] + ["overload", "overspeed"]
    words += [criterion.title for criterion in CRITERIA.values()] + [*WEAR_MODELS, "True", "False"]
    words += ReportSection().signatures
    words += [*key_texts(), *column_texts()]
    return [*words, *calendar.day_abbr, *calendar.month_abbr]


def all_texts() -> list[Text]:
    """Return every text without values that the window shows, each once, in a fixed order."""
    plain = {text for text in all_sentences() if "{" not in text}
    return sorted(
        {*texts_of().texts, *texts_of(*REPORT).texts, *plain, *filter(has_words, texts_of_tables())}
    )


def update(languages: Sequence[str] = tuple(LANGUAGES)) -> None:
    """Bring every catalogue up to date with the source.

    Raises CalledProcessError when Qt's tool fails.
    """
    lines = [
        f"QT_TRANSLATE_NOOP({_quoted(context)}, {_quoted(text)})\n"
        for context, texts in ((WINDOW, all_texts()), (SENTENCES, all_templates()))
        for text in texts
    ]
    with tempfile.TemporaryDirectory(prefix="rigapp-texts-") as folder:
        listed = Path(folder) / "texts.py"
        listed.write_text("".join(lines), "utf-8")
        for language in languages:
            if language != ENGLISH:
                _run("lupdate", "-silent", "-no-obsolete", "-locations", "none",
                     "-source-language", ENGLISH, "-target-language", language,
                     listed, "-ts", catalogue_file(language))  # fmt: skip


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _run(tool: str, *arguments: object) -> None:
    """Run a tool of Qt from the folder of the library."""
    program = Path(PySide6.__file__).with_name(tool)
    subprocess.run([program, *map(str, arguments)], check=True)


if __name__ == "__main__":
    update()
