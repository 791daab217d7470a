"""Seal the parts of an ended test by a tree of SHA-256, and find the parts that changed since.

A leaf is the digest of some rows as stored, or of some cycles with their samples; the digest of a
part is that of its leaves, the root that of all parts. The seal is in the file and beside it.
Whoever can change the file can make a new seal for it: this is detected by a copy of the seal kept
elsewhere, and by the signature, where the laboratory signs.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import platformdirs

from rigapp.config.errors import UnusableInput
from rigapp.schema.wire import json_bytes
from rigapp.storage.filesystem.folder import hidden_name
from rigapp.storage.reading.reader import TestReader
from rigapp.storage.reading.verify import RAGGED
from rigapp.storage.structure.layout import STATE_FIELDS
from rigapp.texts import say

LEAF_ROWS = 4096
LEAF_CYCLES = 64
ROW_PARTS = ("revolutions", "cycles", "unfinished", "prediction", "curves", "profiles", "events")
PART_NAMES = {
    "configuration": say("the configuration"),
    "ending": say("how the test ended"),
    "revolutions": say("the revolutions"),
    "cycles": say("the complete cycles"),
    "unfinished": say("the unfinished revolutions"),
    "prediction": say("the prediction"),
    "curves": say("the predicted curves"),
    "profiles": say("the worn profiles"),
    "events": say("the log"),
}
PREFIX = b"seal of a test, SHA-256 "
"""Prefix of the signed root, so that its signature is valid for a seal only."""


class Part(msgspec.Struct, frozen=True):
    """A part of a test: its rows, and the digest of each leaf in hexadecimal."""

    rows: int
    leaves: list[str]

    @property
    def digest(self) -> str:
        """Return the digest of the part."""
        sha = hashlib.sha256(b"\x01" + self.rows.to_bytes(8, "little"))
        sha.update(b"".join(map(bytes.fromhex, self.leaves)))
        return sha.hexdigest()


class Seal(msgspec.Struct, frozen=True):
    """The seal of a test: its parts by name; key and signature are empty without a signature."""

    identifier: str
    parts: dict[str, Part]
    root: str
    public_key: str = ""
    signature: str = ""


def root_of(identifier: str, parts: dict[str, Part]) -> str:
    """Return the digest of all parts, in hexadecimal."""
    lines = [identifier, *(f"{name} {parts[name].digest}" for name in sorted(parts))]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def parts_of(reader: TestReader) -> dict[str, Part]:
    """Return the parts of an open test in their present state."""
    ending = hashlib.sha256(b"\x00")
    for text in reader.ending():
        ending.update(text.encode() + b"\0")
    result = {
        "configuration": Part(1, [reader.settings_digest()]),
        "ending": Part(len(STATE_FIELDS), [ending.hexdigest()]),
    }
    for name in filter(reader.has, ROW_PARTS):
        rows = reader.committed(name)
        step = LEAF_CYCLES if name in RAGGED else LEAF_ROWS
        leaves = [_leaf(reader, name, at, min(rows, at + step)) for at in range(0, rows, step)]
        result[name] = Part(rows, leaves)
    return result


def _leaf(reader: TestReader, stream: str, first: int, stop: int) -> str:
    result = hashlib.sha256(b"\x00")
    columns, checksums = reader.raw_rows(stream, first, stop)
    for column in (*columns, checksums):
        result.update(column.tobytes())
    if stream in RAGGED and stop > first:
        places = {field.name: at for at, field in enumerate(reader.fields(stream))}
        begin = int(columns[places["first"]][0])
        end = int(columns[places["first"]][-1] + columns[places["count"]][-1])
        for column in reader.raw_rows(RAGGED[stream], begin, end)[0]:
            result.update(column.tobytes())
    return result.hexdigest()


def make_seal(reader: TestReader) -> Seal:
    """Return the seal of an ended test, signed where this user has a key; raise UnusableInput."""
    identifier, parts = str(reader.metadata()["identifier"]), parts_of(reader)
    root = root_of(identifier, parts)
    return Seal(identifier, parts, root, *_signature(root))


def key_path() -> Path:
    """Return the path of the key that signs this user's seals; the file need not exist."""
    return platformdirs.user_config_path("rigapp") / "seal-key.pem"


def _signature(root: str) -> tuple[str, str]:
    """Return public key and signature in hexadecimal, empty texts where there is no key."""
    path = key_path()
    try:
        mode = path.stat().st_mode
        pem = path.read_bytes()
    except FileNotFoundError:
        return "", ""
    except OSError as error:
        raise UnusableInput("{}: the key cannot be read ({})", path, error.strerror) from error
    if os.name == "posix" and stat.S_IMODE(mode) & 0o077:
        raise UnusableInput("{}: others can read the key that seals tests; chmod 600 it", path)
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import load_pem_private_key

    try:
        key = load_pem_private_key(pem, password=None)
    except (ValueError, TypeError) as error:
        raise UnusableInput("{}: this is no private key in PEM ‹{}›", path, error) from error
    if not isinstance(key, Ed25519PrivateKey):
        raise UnusableInput("{}: this is no Ed25519 key; make one: rigapp calibrate key", path)
    return key.public_key().public_bytes_raw().hex(), key.sign(PREFIX + root.encode()).hex()


def beside(path: Path) -> Path:
    """Return the path of the seal beside a file."""
    return path.with_name(f"{path.name}.seal.json")


def write_beside(path: Path, seal: Seal) -> None:
    """Write a seal beside its file, over an earlier one and through no link; raises OSError."""
    hidden = hidden_name(path, "seal")
    hidden.unlink(missing_ok=True)
    try:
        with hidden.open("xb") as stream:
            stream.write(json_bytes(seal))
            stream.flush()
            os.fsync(stream.fileno())
        hidden.chmod(0o444)
        os.replace(hidden, beside(path))
    finally:
        hidden.unlink(missing_ok=True)


def has_seal_beside(path: Path) -> bool:
    """Return whether a file has a seal beside it; a link does not count."""
    return beside(path).is_file() and not beside(path).is_symlink()


def read_seal(text: bytes | str) -> Seal:
    """Return a seal from its text; raise UnusableInput."""
    try:
        seal = msgspec.json.decode(text, type=Seal)
        leaves = (leaf for part in seal.parts.values() for leaf in part.leaves)
        for digits in (*leaves, seal.public_key, seal.signature):
            bytes.fromhex(digits)
        return seal
    except (msgspec.MsgspecError, ValueError) as error:
        raise UnusableInput("The seal is damaged ‹{}›", error) from error


def broken_seals(reader: TestReader) -> Iterator[str]:
    """Yield a sentence for each part of a file that differs from its seal; none without a seal."""
    path, stored = reader.path, reader.seal_text()
    seals: list[tuple[Any, Seal]] = []
    try:
        if stored:
            seals.append((say("in the file"), read_seal(stored)))
        if has_seal_beside(path):
            seals.append((beside(path).name, read_seal(beside(path).read_bytes())))
    except UnusableInput as error:
        yield say("A seal cannot be read: {}", error)
    except OSError as error:
        yield say("A seal cannot be read ‹{}›.", error)
    if not seals:
        return
    now = parts_of(reader)
    for where, seal in seals:
        yield from (
            say("Seal {}: {}", where, difference) for difference in _differences(reader, seal, now)
        )
    if reader.compressed and not stored:
        yield say("The seal in the file is missing.")


def _differences(reader: TestReader, seal: Seal, now: dict[str, Part]) -> Iterator[str]:
    if seal.identifier != str(reader.metadata()["identifier"]):
        yield say("it is that of another test.")
        return
    if root_of(seal.identifier, seal.parts) != seal.root:
        yield say("its digests do not belong together.")
    if seal.signature and not _signed(seal):
        yield say("its signature does not hold.")
    for name in sorted({*seal.parts, *now}):
        then, part = seal.parts.get(name, Part(0, [])), now.get(name, Part(0, []))
        if then == part:
            continue
        words = PART_NAMES.get(name, name)
        if then.rows != part.rows:
            yield say("{}: {} rows were sealed, {} are there.", words, then.rows, part.rows)
        wrong = [
            i
            for i, pair in enumerate(zip(then.leaves, part.leaves, strict=False))
            if len({*pair}) > 1
        ]
        if wrong and name not in ROW_PARTS:
            yield say("{}: not as it was sealed.", words)
        elif wrong:
            step = LEAF_CYCLES if name in RAGGED else LEAF_ROWS
            yield say(
                "{}: not as they were sealed between the rows {} and {}.",
                words,
                wrong[0] * step,
                min(part.rows, (wrong[-1] + 1) * step) - 1,
            )


def _signed(seal: Seal) -> bool:
    from cryptography.exceptions import InvalidSignature
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey

    try:
        key = Ed25519PublicKey.from_public_bytes(bytes.fromhex(seal.public_key))
        key.verify(bytes.fromhex(seal.signature), PREFIX + seal.root.encode())
    except (InvalidSignature, ValueError):
        return False
    return True


def seal_description(reader: TestReader) -> str:
    """Return a description of a file's seal."""
    text: str | bytes = reader.seal_text()
    if not text and has_seal_beside(reader.path):
        text = beside(reader.path).read_bytes()
    if not text:
        return say("It is not sealed: that happens when the test ends.")
    seal = read_seal(text)
    if not seal.signature:
        return say("Sealed, not signed; root {}", seal.root)
    finger = hashlib.sha256(bytes.fromhex(seal.public_key)).hexdigest()[:32]
    return say("Sealed and signed by the key {}; root {}", finger, seal.root)
