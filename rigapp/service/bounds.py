"""Validate a request before it is executed: its size, and its arguments by the verb's record."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec
from msgspec import inspect

from rigapp.config.errors import in_words
from rigapp.config.ranges import refusal as number_refusal
from rigapp.schema.messages import NOTE_CHARACTERS, Reply, Request
from rigapp.schema.states import Refused, refuse_long
from rigapp.schema.verbs import Priority, Verb
from rigapp.texts import capitalised, joined

MESSAGE_BYTES = 1 << 16  # far more than the longest request
NAME_CHARACTERS = 100
SENTENCE_CHARACTERS = 2000


def bounded(request: Request) -> Request:
    """Return a request with a displayable sender; raises Refused for an unknown verb.

    The sender's name is truncated and never refused.
    """
    refuse_long("verb", request.verb, NAME_CHARACTERS)
    refuse_long("client", request.client, NAME_CHARACTERS)
    operator = " ".join(request.operator[:NAME_CHARACTERS].split())
    return msgspec.structs.replace(request, operator=operator)


def parse_arguments(verb: Verb, arguments: Mapping[str, Any]) -> Any:
    """Return the arguments of a request as the record of its verb.

    A safety verb is never refused for its arguments: texts are truncated, and other invalid values
    omitted. For all other verbs a missing, too long, out-of-range or mistyped argument raises
    Refused. Unknown arguments are ignored.
    """
    if verb.lane is Priority.SAFETY:
        names = verb.record.__struct_fields__
        texts = {name: arguments[name] for name in names if isinstance(arguments.get(name), str)}
        return verb.record(**{name: text[:NOTE_CHARACTERS] for name, text in texts.items()})
    kind = inspect.type_info(verb.record)
    assert isinstance(kind, inspect.StructType)
    for field in kind.fields:
        if field.name in arguments:
            _check_value(verb.name, field, arguments[field.name])
        elif field.required:
            raise Refused("{} needs {}", repr(verb.name), repr(field.name))
    try:
        return msgspec.convert(arguments, verb.record)
    except msgspec.ValidationError as error:
        wrong = joined(": ", filter(None, in_words(error)))
        raise Refused("the arguments of {} are not usable: {}", repr(verb.name), wrong) from error


def refusal(words: str, identifier: int = 0) -> Reply:
    """Return the reply to a refused request: the reason as one short sentence.

    A key at the start of the sentence is not capitalised.
    """
    first = words.split(" ", 1)[0].rstrip(".,:;")
    text = words if len(words) <= SENTENCE_CHARACTERS else words[:SENTENCE_CHARACTERS]
    text = text if set(first) & {"_", "."} else capitalised(text)
    sentence = text if text.endswith((".", "?", "!")) else text + "."
    return Reply(ok=False, sentence=sentence, identifier=identifier)


def _check_value(verb: str, field: inspect.Field, value: Any) -> None:
    """Refuse the value of an argument, with a specific sentence where there is one."""
    kind, title, key = field.type, field.name, ""
    if isinstance(kind, inspect.Metadata):
        title = (kind.extra_json_schema or {}).get("title", title)
        key = (kind.extra or {}).get("key", "")
        kind = kind.type
    if key and value is not None:
        wrong = number_refusal(key, value)
        if wrong:
            raise Refused(wrong)
    elif isinstance(kind, inspect.StrType):
        if not isinstance(value, str):
            raise Refused("the {} of {} is not a text", title, repr(verb))
        refuse_long(title, value, kind.max_length or NOTE_CHARACTERS)
    elif isinstance(kind, inspect.FloatType) and kind.ge is not None and kind.le is not None:
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not number or not kind.ge <= value <= kind.le:
            raise Refused(
                "{} of {} is not a number from {:g} to {:g}", title, repr(verb), kind.ge, kind.le
            )
