"""`rigapp calibrate verify`, `certificate`, `key` and `sign`: what is done with a record."""

from __future__ import annotations

import datetime
import json
import os
import sys
import time
from pathlib import Path

from rigapp.calibrating.records import refuse_existing
from rigapp.calibrating.verification import verified
from rigapp.config.errors import UnusableInput
from rigapp.config.reading import read_bytes
from rigapp.config.writing import whole_file
from rigapp.process.private import open_to_others
from rigapp.schema.details import error_text
from rigapp_calibration.records import (
    Record,
    RecordChanged,
    RecordError,
    check_shape,
    in_future,
    seal,
    unseal,
)
from rigapp_calibration.signatures import UnusableKey, fingerprint, new_key, public_key_of, sign

UNSIGNED = "It is not signed: nothing shows which laboratory made it."


def certify(record: Path, to: Path, issued: str = "") -> int:
    """Write the certificate of a record as PDF or HTML; return the exit status.

    issued: the date of issue, as 2027-04-30; without it that of the record.
    """
    from rigapp.calibrating.certificate import write_certificate

    try:
        day = datetime.date.fromisoformat(issued) if issued else None
    except ValueError as error:
        raise UnusableInput(f"--issued {issued}: write a date such as 2027-04-30.") from error
    mark = write_certificate(record, to, day)
    print(f"The certificate is {to}.")
    if mark:
        print(f"note: each page is marked {mark} ([paperwork] of the settings).", file=sys.stderr)
    return 0


def verify_record(path: Path, public_key: Path | None = None, *, as_json: bool) -> int:
    """Fit the readings of a record again and print what differs; return the exit status.

    public_key: of the laboratory that must have signed it.
    """
    try:
        data, record = _read(path)
    except RecordChanged as error:
        print(f"rigapp: {path}: {error}.", file=sys.stderr)
        return 1
    found = verified(data)
    against = [*found.differences]
    if ahead := in_future(record, time.time()):
        against.append(f"It {ahead}.")
    signer = "" if record.signature is None else fingerprint(record.signature.public_key)
    if public_key is not None:
        against += _not_by(record, public_key)
    if as_json:
        told = {
            "number": record.number,
            "kind": record.kind,
            "verified": not against,
            "compared": found.compared,
            "differences": against,
            "unverified": found.unverified,
            "signed_by": signer or None,
        }
        print(json.dumps(told))
        return 1 if against else 0
    print(f"Record {record.number} of a {record.kind}: its digest holds.")
    if found.compared:
        agree = "differ" if found.differences else "agree"
        print(
            f"Its readings were fitted again; {found.compared} results were compared and {agree}."
        )
    if signer:
        whose = "" if public_key else "; give --public-key to see whether it is the laboratory's"
        print(f"It is signed by the key {signer}{whose}.")
    for one in (*found.unverified, *(() if signer else (UNSIGNED,))):
        print(f"note: {one}")
    for one in against:
        print(f"rigapp: {path}: {one}", file=sys.stderr)
    return 1 if against else 0


def make_key(to: Path) -> int:
    """Write a private key that its owner alone can read, and the public key beside it."""
    public = to.with_suffix(".pub")
    if public == to:
        raise UnusableInput(f"{to}: the public key gets the ending .pub; name another file.")
    for path in (to, public):
        refuse_existing(path, "keys")
    secret, open_to_all = new_key()
    _write(to, secret, 0o600)
    _write(public, open_to_all, 0o644)
    print(f"The private key is {to}: keep it to the laboratory, and keep a copy where it is safe.")
    print(f"The public key is {public}, for everybody; {fingerprint(public_key_of(open_to_all))}.")
    return 0


def sign_record(path: Path, key: Path, to: Path) -> int:
    """Write a record again with the signature of a laboratory's key; return the exit status."""
    try:
        data, record = _read(path)
    except RecordChanged as error:
        raise UnusableInput(f"{path}: {error}.") from error
    if record.signature is not None:
        raise UnusableInput(f"{path}: it is signed already.")
    refuse_existing(to)
    for one in verified(data).differences:
        print(f"rigapp: {path}: it is not signed: {one}", file=sys.stderr)
        return 1
    secret = _secret(key)
    try:
        signature = sign(record, secret)
    except UnusableKey as error:
        raise UnusableInput(f"{key}: {error}.") from error
    _write(to, seal(record.content, signature), 0o444)
    print(f"The record {record.number} with its signature is {to}; {path} stays as it was.")
    return 0


def _read(path: Path) -> tuple[bytes, Record]:
    """Return a record and its bytes; raise RecordChanged, or UnusableInput for what is none."""
    try:
        data = path.read_bytes()
        record = unseal(data)
        check_shape(record)
        return data, record
    except FileNotFoundError as error:
        raise UnusableInput(f"{path}: there is no such record; check the name.") from error
    except RecordChanged:
        raise
    except (OSError, RecordError) as error:
        why = error_text(error, "the record cannot be read")
        raise UnusableInput(f"{path}: {why}.") from error


def _not_by(record: Record, public_key: Path) -> list[str]:
    """Return why a record is not signed by a key, nothing when it is."""
    try:
        wanted = public_key_of(read_bytes(public_key))
    except OSError as error:
        raise UnusableInput(f"{public_key}: cannot be read ({error.strerror}).") from error
    except UnusableKey as error:
        raise UnusableInput(f"{public_key}: {error}.") from error
    if record.signature is None:
        return [UNSIGNED]
    if record.signature.public_key == wanted:
        return []
    return [f"It is signed by another key than {public_key} ({fingerprint(wanted)})."]


def _secret(key: Path) -> bytes:
    """Return a private key that others cannot read; raise UnusableInput."""
    try:
        others = open_to_others(key.stat())
        secret = key.read_bytes()
    except OSError as error:
        raise UnusableInput(f"{key}: cannot be read ({error.strerror}).") from error
    if others:
        raise UnusableInput(
            f"{key}: others can read or write this key; make it yours alone: chmod 600 {key}"
        )
    return secret


def _write(to: Path, data: bytes, mode: int) -> None:
    """Write a new file that has its permissions from the first byte on."""
    with whole_file(to, new=True, mode=mode) as part:
        opened = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(opened, "wb") as stream:
            stream.write(data)
