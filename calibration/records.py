"""Calibration records: immutable, self-contained, with a digest of their own content.

A record is a JSON object with sorted keys. ``digest`` is the SHA-256 of the canonical JSON of all
other keys, and ``number`` its first twelve digits: the unique number of the certificate.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

SCHEMA = 1


class RecordError(ValueError):
    """Say why a record cannot be used."""


@dataclass(frozen=True, slots=True)
class Record:
    """A calibration record as read: its content and its number."""

    content: Mapping[str, Any]
    number: str

    @property
    def kind(self) -> str:
        """Return what was calibrated."""
        return str(self.content["kind"])


def seal(content: Mapping[str, Any]) -> bytes:
    """Return the bytes of a record: the content with schema, number and digest."""
    body = {**content, "schema": SCHEMA}
    digest = _digest(body)
    sealed = {**body, "number": digest[:12], "digest": digest}
    text = json.dumps(sealed, sort_keys=True, indent=1, ensure_ascii=False, allow_nan=False)
    return (text + "\n").encode()


def unseal(data: bytes) -> Record:
    """Read a record and verify its digest; raise RecordError."""
    try:
        sealed = json.loads(data)
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise RecordError(f"it is not a calibration record ({error})") from error
    if not isinstance(sealed, dict) or "digest" not in sealed or "kind" not in sealed:
        raise RecordError("it is not a calibration record")
    if sealed.get("schema") != SCHEMA:
        raise RecordError(
            f"its schema is {sealed.get('schema')!r}, this program reads {SCHEMA}; update rigapp"
        )
    body = {key: value for key, value in sealed.items() if key not in ("digest", "number")}
    digest = _digest(body)
    if sealed["digest"] != digest or sealed.get("number") != digest[:12]:
        raise RecordError("it was changed after it was made: its digest does not fit its content")
    return Record(content=body, number=digest[:12])


def _digest(body: Mapping[str, Any]) -> str:
    canonical = json.dumps(
        body, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
    )
    return hashlib.sha256(canonical.encode()).hexdigest()
