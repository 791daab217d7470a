"""Serialisation of records between processes, and for files and scripts.

On the wire a ``Sentence`` keeps its structure; in JSON it is its English text.
"""

from __future__ import annotations

from typing import Any, Final, Literal, TypeVar

import msgspec
from msgspec.msgpack import Ext

from rigapp.texts import Sentence

Record = TypeVar("Record")

SENTENCE: Final = 1
"""Extension code of MessagePack: an array of the template and its values by their names."""


def encode(record: Any) -> bytes:
    """Return a record as MessagePack."""
    return _ENCODER.encode(record)


def decode(body: bytes, kind: type[Record]) -> Record:
    """Return a record of a kind; raise DecodeError or ValidationError of msgspec.

    A string field accepts a sentence as well: older programs send strings.
    """
    return msgspec.convert(_DECODER.decode(body), kind)


def json_bytes(record: Any, order: Literal["deterministic"] | None = None) -> bytes:
    """Return a record as JSON, its sentences as strings."""
    return msgspec.json.encode(record, enc_hook=str, order=order)


def tree_of(record: Any) -> Any:
    """Return a record as dictionaries and lists, its sentences kept."""
    return msgspec.to_builtins(record, builtin_types=(Sentence,))


def parts_of_sentence(sentence: Sentence) -> list[Any]:
    """Return the template of a sentence and its values, if any: for JSON."""
    values = {
        name: parts_of_sentence(value) if isinstance(value, Sentence) else value
        for name, value in sentence.values.items()
    }
    return [sentence.template, values] if values else [sentence.template]


def sentence_of_parts(parts: Any) -> Sentence:
    """Return the sentence of its parts; raise ValueError or TypeError for invalid parts."""
    template, values = (*parts, {})[:2]
    if not isinstance(template, str):
        raise TypeError(template)
    made = {k: sentence_of_parts(v) if isinstance(v, list) else v for k, v in values.items()}
    return Sentence.of(template, made)


def _extended(value: object) -> Ext:
    if not isinstance(value, Sentence):
        # msgspec expects this error for an unsupported type.
        raise NotImplementedError(f"{type(value).__name__} cannot be sent")
    return Ext(SENTENCE, encode([value.template, value.values]))


def _sentence(code: int, body: memoryview) -> object:
    if code != SENTENCE:
        raise ValueError(f"extension {code} of a message is not known")
    template, values = _DECODER.decode(body)
    return Sentence.of(template, values)


_ENCODER: Final = msgspec.msgpack.Encoder(enc_hook=_extended)
_DECODER: Final = msgspec.msgpack.Decoder(ext_hook=_sentence)
