"""What a request may hold: bounded in bytes, depth and length of its texts, before it is heard."""

from __future__ import annotations

from typing import Any

import msgspec

from rigapp.engine.run import Refused, refuse_long
from rigapp.schema.messages import NOTE_CHARACTERS, Reply, Request
from rigapp.schema.verbs import Lane, verb_of

MESSAGE_BYTES = 1 << 16
NAME_CHARACTERS = 100
SENTENCE_CHARACTERS = 2000
PATH_CHARACTERS = 4096
DEEPEST = 8
MOST = 1e9

_WORDS = {"text": "note", "reason": "reason"}
_TEXTS = frozenset({"text", "reason", "key", "name", "kind", "test", "out", "file"})
_NUMBERS = frozenset({"minutes", "window_s"})
"""Arguments that no table of ranges judges."""


def bounded(request: Request) -> Request:
    """Return a request whose texts have a length that can be stored and shown.

    The sender's name is cut. What makes the rig safe is never refused for its words: they are cut.
    Of all other requests what is too long, too deep or no text raises Refused.
    """
    refuse_long("verb", request.verb, NAME_CHARACTERS)
    refuse_long("client", request.client, NAME_CHARACTERS)
    arguments = request.arguments
    if verb_of(request.verb).lane is Lane.SAFETY:
        arguments = {
            key: value[:NOTE_CHARACTERS] for key, value in arguments.items()
            if isinstance(value, str)
        }  # fmt: skip
    else:
        _refuse_deep(request.verb, arguments)
        for key, value in arguments.items():
            if key in _NUMBERS:
                _refuse_no_number(request.verb, key, value)
            else:
                _refuse_bad_text(request.verb, key, value)
    operator = " ".join(request.operator[:NAME_CHARACTERS].split())
    return msgspec.structs.replace(request, arguments=arguments, operator=operator)


def refusal(words: str, identifier: int = 0) -> Reply:
    """Return the answer that says why not, as one sentence no longer than anybody reads.

    A key that it begins with stays as it is typed.
    """
    first = words.split(" ", 1)[0].rstrip(".,:;")
    begin = words[:1] if set(first) & {"_", "."} else words[:1].upper()
    text = begin + words[1:SENTENCE_CHARACTERS]
    sentence = text if text.endswith((".", "?", "!")) else text + "."
    return Reply(ok=False, sentence=sentence, identifier=identifier)


def _refuse_bad_text(verb: str, key: str, value: Any) -> None:
    what = _WORDS.get(key, key)
    if not isinstance(value, str):
        if key in _TEXTS:
            raise Refused(f"the {what[:NAME_CHARACTERS]} of {verb!r} is not a text")
        return
    most = NOTE_CHARACTERS if key in _WORDS else PATH_CHARACTERS
    refuse_long(what[:NAME_CHARACTERS], value, most)


def _refuse_no_number(verb: str, key: str, value: Any) -> None:
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not 0 <= value <= MOST:
        raise Refused(f"{key} of {verb!r} is not a number from 0 to {MOST:g}")


def _refuse_deep(verb: str, arguments: Any) -> None:
    """Walk without recursion: what is refused here may be as deep as a message is long."""
    level = [arguments]
    for _ in range(DEEPEST):
        level = [
            item
            for one in level
            if isinstance(one, dict | list | tuple)
            for item in (one.values() if isinstance(one, dict) else one)
        ]
    if level:
        raise Refused(f"the arguments of {verb!r} are nested more than {DEEPEST} deep")
