"""Separate the operator's part of a text from its technical details.

The author of a text puts between ‹ and › the words of a library or the operating system, a
register, an address, raw bytes: ``f"The port cannot be opened ‹{error}›; check the cable."``. Logs
and files keep the whole text; operators see the sentence, with the details folded.
"""

from __future__ import annotations

import errno
import re
from typing import Final

from rigapp.texts import Sentence, braces, sentence_of_error

_DETAILS: Final = re.compile(r"\s*‹([^‹›]*)(?:›|$)| on (\w+://[^\s‹›]+?)(?=:? |:?$)")
"""The innermost details of a text, up to the end of a truncated one; also the location of a device
without a port of its own."""
_MARKS: Final = re.compile("([‹›])")


def sentence_of(text: str) -> str:
    """Return a text without its details, its structure kept."""
    return _bare(text) if isinstance(text, Sentence) else _parted(text)[0]


def details_of(text: str) -> str:
    """Return the details of a text, one per line, empty without any."""
    return "\n".join(_parted(text)[1])


def marked_details(text: str) -> str:
    """Return the marked details of a text, to append to another sentence."""
    return "".join(f" ‹{detail}›" for detail in _parted(text)[1])


def indented(text: str) -> str:
    """Return a text as a terminal shows it: the sentence, and its details indented below."""
    sentence, details = _parted(text)
    return "\n    ".join((sentence, *details))


def error_text(error: BaseException, otherwise: str) -> str:
    """Return an error's sentence if it is of this program, else ``otherwise`` with details.

    The operating system's own words for a file are kept: they say what happened.
    """
    ours = _is_ours(type(error).__module__) or (type(error) is ValueError and _raised_here(error))
    if ours and str(error):
        return sentence_of_error(error)
    if isinstance(error, OSError) and error.strerror and error.filename:
        return Sentence("{}: {} ‹{}›", error.filename, Sentence(error.strerror), repr(error))
    if isinstance(error, OSError) and error.strerror and error.errno:
        name = {**errno.errorcode, 524: "ENOTSUPP"}.get(error.errno, str(error.errno))
        return Sentence("{} ({}) ‹{}›", Sentence(error.strerror), name, repr(error))
    return Sentence("{} ‹{}›", otherwise, repr(error))


def _bare(sentence: Sentence) -> Sentence:
    """Return a sentence without the marked parts of its template and values."""
    if not sentence.values:
        return Sentence(_parted(sentence)[0])
    template, values, depth = "", dict[str, object](), 0
    for literal, name, spec in braces(sentence.template):
        for part in _MARKS.split(literal):
            if part == "‹":
                template, depth = template.rstrip() if depth == 0 else template, depth + 1
            elif part == "›":
                depth -= 1
            elif depth == 0:
                template += part.replace("{", "{{").replace("}", "}}")
        value = sentence.values[name] if name and depth == 0 else None
        if isinstance(value, str) and "://" in value and literal.endswith(" on "):
            template = template.removesuffix(" on ")
        elif value is not None:
            known = "" if name.isdigit() else name
            template += f"{{{known}:{spec}}}" if spec else f"{{{known}}}"
            values[known or str(sum(map(str.isdigit, values)))] = (
                sentence_of(value) if isinstance(value, str) else value
            )
    if values:
        return Sentence.of(template, values)
    return Sentence(template.replace("{{", "{").replace("}}", "}"))


def _raised_here(error: BaseException) -> bool:
    """Return whether this program's own code raised an error: then its text is a sentence."""
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    return trace is not None and _is_ours(str(trace.tb_frame.f_globals.get("__name__", "")))


def _is_ours(module: str) -> bool:
    return module.partition(".")[0].startswith("rigapp")


def _parted(text: str) -> tuple[str, list[str]]:
    details: list[str] = []
    # Nearly every text has none, and every repaint calls this.
    if "‹" not in text and "://" not in text:
        return text, details
    while (match := _DETAILS.search(text)) is not None:
        details.append(" ".join((match[1] or match[2] or "").split()))
        text = text[: match.start()] + text[match.end() :]
    return text, [detail for detail in details if detail]
