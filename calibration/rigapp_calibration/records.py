"""Calibration records: immutable, self-contained, with a digest of their own content.

A record is a JSON object with sorted keys. ``digest`` is the SHA-256 of the canonical JSON of the
content, and ``number`` its first twelve digits: the unique number of the certificate. ``signature``
is present when a laboratory signed the digest (``signatures``).
"""

from __future__ import annotations

import calendar
import hashlib
import json
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rigapp.texts import SentenceError, say

SCHEMA = 1
BESIDE = ("digest", "number", "signature")
"""Keys of a record that are not part of its content."""
EVALUATION = 6
"""Version of the fits, checks and budgets: raised when the same readings give another result.

A record of another evaluation is compared only in values common to all evaluations.
"""

CLOCKS_S = 86400.0
"""Tolerance of a date in the future: the clocks of two computers may differ by a day."""

MALFORMED = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""Errors raised by reading a value that is missing, of another type or out of range."""


class RecordError(SentenceError, ValueError):
    """A record cannot be used; the text gives the reason."""


class RecordChanged(RecordError):
    """A record differs from what was sealed."""


@dataclass(frozen=True, slots=True)
class Signature:
    """An Ed25519 signature of a record's digest, and the raw public key; both hexadecimal."""

    public_key: str
    value: str


@dataclass(frozen=True, slots=True)
class Record:
    """A calibration record as read: content, digest, and signature if it has one."""

    content: Mapping[str, Any]
    digest: str
    signature: Signature | None = None

    @property
    def number(self) -> str:
        """Return the number of the record and of its certificate."""
        return self.digest[:12]

    @property
    def kind(self) -> str:
        """Return the kind of the calibration."""
        return str(self.content["kind"])

    @property
    def evaluation(self) -> int:
        """Return the number of the evaluation that made the result.

        1 if the record states none; 0 if the stated value is not a whole number from 1.
        """
        stated = self.content.get("evaluation", 1)
        return stated if type(stated) is int and stated >= 1 else 0


def seal(content: Mapping[str, Any], signature: Signature | None = None) -> bytes:
    """Return the bytes of a record: the content with schema, number, digest and signature."""
    body = {**content, "schema": SCHEMA}
    digest = _digest(body)
    sealed = {**body, "number": digest[:12], "digest": digest}
    if signature is not None:
        sealed["signature"] = {
            "algorithm": "Ed25519",
            "public_key": signature.public_key,
            "value": signature.value,
        }
    text = json.dumps(sealed, sort_keys=True, indent=1, ensure_ascii=False, allow_nan=False)
    return (text + "\n").encode()


def unseal(data: bytes) -> Record:
    """Read a record and verify its digest; raise RecordError."""
    try:
        sealed = json.loads(data)
    except (UnicodeDecodeError, json.JSONDecodeError) as error:
        raise RecordError("it is not a calibration record ‹{}›", error) from error
    if not isinstance(sealed, dict) or "digest" not in sealed or "kind" not in sealed:
        raise RecordError("it is not a calibration record")
    if sealed.get("schema") != SCHEMA:
        raise RecordError(
            "its schema is {}, this program reads {}; update rigapp",
            repr(sealed.get("schema")),
            SCHEMA,
        )
    body = {key: value for key, value in sealed.items() if key not in BESIDE}
    digest = _digest(body)
    if sealed["digest"] != digest or sealed.get("number") != digest[:12]:
        raise RecordChanged("it was changed after it was made: its digest does not fit its content")
    stated = sealed.get("signature")
    if stated is None:
        return Record(body, digest)
    try:
        signature = Signature(str(stated["public_key"]), str(stated["value"]))
    except MALFORMED as error:
        raise RecordChanged("its signature is incomplete") from error
    return Record(body, digest, signature)


def check_shape(record: Record) -> None:
    """Check the parts and dates that readers of a record rely on; raise RecordError."""
    for key in ("result", "settings"):
        if not isinstance(record.content.get(key), dict):
            raise RecordError("it has no {}", key)
    for key in ("calibrated_at", "due_at"):
        stated = record.content.get(key)
        try:
            moment(stated or "")
        except (TypeError, ValueError) as error:
            raise RecordError(
                "its {} is {}; a date such as 2027-04-30T12:00:00Z is needed", key, repr(stated)
            ) from error


def checked_record(data: bytes) -> Record:
    """Read a record and verify its digest, parts and dates; raise RecordError."""
    record = unseal(data)
    check_shape(record)
    return record


def in_future(record: Record, now: float) -> str:
    """Return why the date of a record is impossible, empty if it is possible."""
    stated = str(record.content["calibrated_at"])
    if moment(stated) <= now + CLOCKS_S:
        return ""
    return say("states that it was made on {}, which is in the future", stated[:10])


def moment(stamp: str) -> float:
    """Return the UTC seconds of a record's time stamp."""
    return calendar.timegm(time.strptime(stamp, "%Y-%m-%dT%H:%M:%SZ"))


def _digest(body: Mapping[str, Any]) -> str:
    canonical = json.dumps(
        body, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False
    )
    return hashlib.sha256(canonical.encode()).hexdigest()
