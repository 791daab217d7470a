"""PINs of the operators who may change limits, in a file that the rig file names.

They prevent casual changes of a test's limits, not changes by users with write access to the rig's
files. Only a salted hash of each PIN is stored (scrypt, RFC 7914), and in no recorded file.
"""

from __future__ import annotations

import hashlib
import hmac
import math
import os
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Final

from rigapp.config.errors import UnusableInput
from rigapp.config.loading import Document, read_document
from rigapp.config.rig import OperatorsFile, RigFile
from rigapp.config.toml import toml_text
from rigapp.config.writing import whole_file
from rigapp.schema.states import Refused
from rigapp.texts import say

COST, BLOCK, LANES = 2**14, 8, 1
"""Parameters of a hash: 16 MB and about 50 ms, as RFC 7914 proposes for a login."""
SALT_BYTES, HASH_BYTES = 16, 32
MIN_PIN_LENGTH: Final = 4
"""Minimum number of characters of a PIN."""
FREE_TRIES, LONGEST_WAIT_S = 3, 300.0
"""Wrong PINs in a row before the first wait, which doubles with each; longest wait."""


def hashed(pin: str, salt: bytes | None = None) -> str:
    """Return the hash of a PIN."""
    salt = salt or os.urandom(SALT_BYTES)
    made = hashlib.scrypt(pin.encode(), salt=salt, n=COST, r=BLOCK, p=LANES, dklen=HASH_BYTES)
    return f"scrypt:{COST}:{BLOCK}:{LANES}:{salt.hex()}:{made.hex()}"


def fits(pin: str, kept: str) -> bool:
    """Return whether a PIN matches a hash; False for hashes of other forms."""
    try:
        kind, cost, block, lanes, salt, expected = kept.split(":")
        if (kind, int(cost), int(block), int(lanes)) != ("scrypt", COST, BLOCK, LANES):
            return False
        made = hashed(pin, bytes.fromhex(salt)).rpartition(":")[2]
    except ValueError:
        return False
    return hmac.compare_digest(made, expected)


def operators_file(rig: Document[RigFile]) -> Path | None:
    """Return the file of the operators of a rig, None where none is set."""
    name = rig.record.operators.file
    return rig.path.parent / name if name else None


def pins_in(file: Path) -> Mapping[str, str]:
    """Return the hashes by operator name, empty without a file; raises UnusableInput."""
    return read_document(file, OperatorsFile).record.pins if file.exists() else {}


def set_pin(file: Path, name: str, pin: str, by_pin: str) -> None:
    """Set or replace the PIN of an operator; raises UnusableInput.

    by_pin: the PIN of any operator who has one, required if there is any.
    """
    pins = dict(pins_in(file))
    if not name.strip():
        raise UnusableInput("An operator needs a name.")
    if len(pin) < MIN_PIN_LENGTH:
        raise UnusableInput("A PIN has {} characters at least.", MIN_PIN_LENGTH)
    if pins and not any(fits(by_pin, kept) for kept in pins.values()):
        raise UnusableInput("The PIN of an operator who has one is needed, too.")
    pins[name.strip()] = hashed(pin)
    with whole_file(file, mode=0o600) as part:
        part.write_text(toml_text(OperatorsFile(1, pins)), encoding="utf-8", newline="")


class PinCheck:
    """Check the PIN of an operator who changes a limit, where the rig file requires it."""

    def __init__(self, rig: Document[RigFile], clock: Callable[[], float] = time.monotonic) -> None:
        self._file = operators_file(rig)
        self._clock, self._lock = clock, threading.Lock()
        self._wrong, self._wait_until = 0, -math.inf

    @property
    def wanted(self) -> bool:
        """Return whether changes of limits need a PIN."""
        return self._file is not None

    def check(self, operator: str, pin: str) -> None:
        """Raise Refused for a wrong PIN of the operator, UnusableInput for a broken file."""
        if self._file is None:
            return
        with self._lock:  # concurrent requests would double the tries
            left = self._wait_until - self._clock()
            if left > 0.0:
                raise Refused(say("too many wrong PINs; try again in {:.0f} s", math.ceil(left)))
            kept = pins_in(self._file).get(operator)
            if kept is None:
                raise Refused(
                    say("{} has no PIN; limits are changed by operators who have one", operator)
                )
            if fits(pin, kept):
                self._wrong = 0
                return
            self._wrong += 1
            if self._wrong >= FREE_TRIES:
                wait_s = min(2.0 ** (self._wrong - FREE_TRIES + 1), LONGEST_WAIT_S)
                self._wait_until = self._clock() + wait_s
            raise Refused(say("this is not the PIN of {}", operator))
