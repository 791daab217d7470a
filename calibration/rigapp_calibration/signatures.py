"""Signatures of records with a laboratory's key: Ed25519 (RFC 8032) over the record's digest.

A digest proves that a record is complete, a signature who issued it. Keys are PEM as OpenSSL reads
and writes them: PKCS #8 without a passphrase, and SubjectPublicKeyInfo.
"""

from __future__ import annotations

import hashlib

from cryptography.exceptions import InvalidSignature, UnsupportedAlgorithm
from cryptography.hazmat.primitives import serialization
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey

from rigapp.texts import SentenceError, say
from rigapp_calibration.records import Record, Signature

PREFIX = b"calibration record, SHA-256 "
"""Prefix of the signed digest, so that the signature is valid for records only."""
FINGERPRINT = 32
"""Hexadecimal digits of a fingerprint: 128 bits, out of reach of a search for a second key."""


class UnusableKey(SentenceError, ValueError):
    """A key cannot be used; the text gives the reason."""


def new_key() -> tuple[bytes, bytes]:
    """Return a new private key and its public key, both PEM."""
    key = Ed25519PrivateKey.generate()
    private = key.private_bytes(
        serialization.Encoding.PEM,
        serialization.PrivateFormat.PKCS8,
        serialization.NoEncryption(),
    )
    public = key.public_key().public_bytes(
        serialization.Encoding.PEM, serialization.PublicFormat.SubjectPublicKeyInfo
    )
    return private, public


def sign(record: Record, private: bytes) -> Signature:
    """Return the signature of a record by a private key (PEM); raise UnusableKey."""
    try:
        key = serialization.load_pem_private_key(private, password=None)
    except (ValueError, TypeError, UnsupportedAlgorithm) as error:
        raise UnusableKey("it is no private key in PEM without a passphrase ‹{}›", error) from error
    if not isinstance(key, Ed25519PrivateKey):
        raise UnusableKey("it is not an Ed25519 key; make one with rigapp calibrate key")
    public = key.public_key().public_bytes_raw()
    return Signature(public.hex(), key.sign(_message(record)).hex())


def signature_fault(record: Record) -> str:
    """Return why the signature of a signed record is invalid, empty if it is valid."""
    signature = record.signature
    assert signature is not None
    try:
        key = Ed25519PublicKey.from_public_bytes(bytes.fromhex(signature.public_key))
        key.verify(bytes.fromhex(signature.value), _message(record))
    except (InvalidSignature, ValueError):
        return say("Its signature does not hold: it was not made by the key that it names.")
    return ""


def public_key_of(pem: bytes) -> str:
    """Return the raw public key (hexadecimal) of a public key in PEM; raise UnusableKey."""
    try:
        key = serialization.load_pem_public_key(pem)
    except (ValueError, UnsupportedAlgorithm) as error:
        raise UnusableKey("it is no public key in PEM ‹{}›", error) from error
    if not isinstance(key, Ed25519PublicKey):
        raise UnusableKey("it is not an Ed25519 key")
    return key.public_bytes_raw().hex()


def fingerprint(public_key: str) -> str:
    """Return the fingerprint of a raw public key (hexadecimal), in groups of eight."""
    digest = hashlib.sha256(bytes.fromhex(public_key)).hexdigest()[:FINGERPRINT]
    return " ".join(digest[i : i + 8] for i in range(0, FINGERPRINT, 8))


def _message(record: Record) -> bytes:
    return PREFIX + record.digest.encode()
