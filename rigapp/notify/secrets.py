"""Secrets by name: from a file of mode 0600 or the keyring, put into a URL, taken out of a text.

Only the short process of one attempt calls this; engine and notifier know names alone.
"""

from __future__ import annotations

import os
import stat
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from urllib.parse import quote

from rigapp.config.errors import UnusableInput
from rigapp.config.notify import REFERENCE
from rigapp.process.private import SMALL_BYTES, open_to_others, owned_by_user

KEYRING_SERVICE = "rigapp"
"""Under this service the keyring holds the secrets, each with its name as user name."""

HIDDEN = "***"


def names_in(url: str) -> tuple[str, ...]:
    """Return the names of the secrets that a URL refers to."""
    return tuple(dict.fromkeys(REFERENCE.findall(url)))


def looked_up(names: Iterable[str], file: Path) -> dict[str, str]:
    """Return secrets by name, of the file first, then of the keyring; raise UnusableInput."""
    in_file: Mapping[str, str] | None = None
    found = {}
    for name in names:
        if in_file is None:
            in_file = read_secrets(file)
        found[name] = in_file[name] if name in in_file else _of_keyring(name, file)
    return found


def read_secrets(file: Path) -> dict[str, str]:
    """Return what a file of secrets holds, nothing when there is none; raise UnusableInput.

    It must be ours and readable by nobody else. No sentence repeats anything that stands in it.
    """
    try:
        descriptor = os.open(file, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise UnusableInput("{}: cannot be read ({}).", file, error.strerror) from None
    try:
        _require_private(file, os.fstat(descriptor))
        text = os.read(descriptor, SMALL_BYTES).decode()
        tree = tomllib.loads(text)
    except ValueError:
        raise UnusableInput('{}: is no TOML of lines like name = "secret".', file) from None
    finally:
        os.close(descriptor)
    if not all(isinstance(value, str) and value for value in tree.values()):
        raise UnusableInput("{}: every secret is a text in quotes, and not empty.", file)
    return tree


def _require_private(file: Path, found: os.stat_result) -> None:
    if not stat.S_ISREG(found.st_mode) or found.st_size > SMALL_BYTES:
        raise UnusableInput("{}: is no small file; write the secrets into one.", file)
    if not owned_by_user(found):
        raise UnusableInput("{}: belongs to somebody else; make it yours.", file)
    if open_to_others(found):
        raise UnusableInput(
            "{}: others can read it (mode {}); chmod 600 it, and change the secrets"
            " where others are on this computer.",
            file,
            f"{stat.S_IMODE(found.st_mode):04o}",
        )


def _of_keyring(name: str, file: Path) -> str:
    try:
        import keyring

        secret: str | None = keyring.get_password(KEYRING_SERVICE, name)
        why = "the keyring has none of that name"
    except ImportError:
        secret, why = None, "the keyring needs rigapp's extra: pip install 'rigapp[notify]'"
    except Exception as error:
        secret, why = None, f"no keyring can be asked ‹{type(error).__name__}›"
    if not secret:
        raise UnusableInput(
            "the secret {} is not in {}, and {}; write it into that file, mode 0600, or"
            " give it by: keyring set {} {}",
            name,
            file,
            why,
            KEYRING_SERVICE,
            name,
        )
    return secret


def filled(url: str, secrets: Mapping[str, str]) -> str:
    """Return a URL with its secrets; quoted, but for one that is the whole URL."""
    whole = REFERENCE.fullmatch(url)
    if whole is not None:
        return secrets[whole[1]]
    return REFERENCE.sub(lambda name: quote(secrets[name[1]], safe=""), url)


def redacted(text: str, secrets: Iterable[str]) -> str:
    """Return a text without the secrets, however they are quoted."""
    forms = {form for one in secrets for form in (one, quote(one, safe=""), quote(one))}
    for form in sorted(forms, key=len, reverse=True):
        text = text.replace(form, HIDDEN)
    return text
