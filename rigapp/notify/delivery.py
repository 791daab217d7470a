"""One attempt of a delivery, in a process of its own, the only one to read the secrets.

``python -m rigapp.notify.delivery`` takes an ``AttemptRequest`` on standard input and writes an
``DeliveryResult`` on standard output. The parent ends it when it takes too long: a server that
hangs, or answers a byte a minute, blocks nothing else.
"""

from __future__ import annotations

import logging
import os
import re
import stat
import sys
import tomllib
import urllib.error
import urllib.request
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Literal
from urllib.parse import quote, unquote, urlsplit

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.notify import REFERENCE
from rigapp.process.private import SMALL_BYTES, open_to_others, owned_by_user
from rigapp.schema.wire import json_bytes

# Secrets by name: from a file of mode 0600 or the keyring, put into a URL, removed from a text.
# Only the short process of one attempt looks them up; engine and notifier hold only the names.

KEYRING_SERVICE = "rigapp"
"""Service of the keyring that holds the secrets, each with its name as user name."""

HIDDEN = "***"


def names_in(url: str) -> tuple[str, ...]:
    """Return the names of the secrets that a URL refers to."""
    return tuple(dict.fromkeys(REFERENCE.findall(url)))


def looked_up(names: Iterable[str], file: Path) -> dict[str, str]:
    """Return secrets by name, of the file first, then of the keyring; raise UnusableInput."""
    in_file: Mapping[str, str] | None = None
    secrets = {}
    for name in names:
        if in_file is None:
            in_file = read_secrets(file)
        secrets[name] = in_file[name] if name in in_file else _of_keyring(name, file)
    return secrets


def read_secrets(file: Path) -> dict[str, str]:
    """Return the secrets of a file by name, none without a file; raise UnusableInput.

    It must be owned by the user and readable by nobody else. No error repeats its content.
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


def _require_private(file: Path, status: os.stat_result) -> None:
    if not stat.S_ISREG(status.st_mode) or status.st_size > SMALL_BYTES:
        raise UnusableInput("{}: is no small file; write the secrets into one.", file)
    if not owned_by_user(status):
        raise UnusableInput("{}: belongs to another user; make it yours.", file)
    if open_to_others(status):
        raise UnusableInput(
            "{}: others can read it (mode {}); chmod 600 it, and change the secrets"
            " where others are on this computer.",
            file,
            f"{stat.S_IMODE(status.st_mode):04o}",
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
    """Return a URL with its secrets; quoted, except one that is the whole URL."""
    reference = REFERENCE.fullmatch(url)
    if reference is not None:
        return secrets[reference[1]]
    return REFERENCE.sub(lambda name: quote(secrets[name[1]], safe=""), url)


def redacted(text: str, secrets: Iterable[str]) -> str:
    """Return a text without the secrets, however they are quoted."""
    forms = {form for secret in secrets for form in (secret, quote(secret, safe=""), quote(secret))}
    for form in sorted(forms, key=len, reverse=True):
        text = text.replace(form, HIDDEN)
    return text


ANSWER_S = 15.0
"""Longest pause between two bytes of a server of the ping."""

MOST_REASON = 300
"""Characters of a reason in a line of the log."""


class AttemptRequest(msgspec.Struct, frozen=True):
    """The task: check a URL, or only look up its secrets, send a message, or ping.

    url: as in the file, with references; secrets: the file that may have them.
    """

    what: Literal["inspect", "look up", "send", "ping"]
    url: str
    secrets: str
    title: str = ""
    text: str = ""
    level: str = "information"


class DeliveryResult(msgspec.Struct, frozen=True):
    """Whether it worked, or why not, without any secret."""

    ok: bool
    reason: str = ""


class _Remarks(logging.Handler):
    """Collect the log of apprise: it returns only success or failure, the reason is in its log."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.texts.append(record.getMessage())


def attempted(request: AttemptRequest) -> DeliveryResult:
    """Carry out a request; never raises, and never returns a secret."""
    secrets: dict[str, str] = {}
    try:
        secrets = looked_up(names_in(request.url), Path(request.secrets))
        url = filled(request.url, secrets)
        if request.what == "ping":
            result = _ping(url)
        elif request.what == "look up":
            result = DeliveryResult(True)
        else:
            result = _by_apprise(request, url, list(secrets.values()))
    except UnusableInput as error:
        result = DeliveryResult(False, str(error))
    except Exception as error:  # its text may hold the URL
        result = DeliveryResult(False, f"it failed ‹{type(error).__name__}›")
    clean = " ".join(redacted(result.reason, [*secrets.values()]).split())
    return msgspec.structs.replace(result, reason=clean[:MOST_REASON])


def _ping(url: str) -> DeliveryResult:
    if urlsplit(url).scheme not in ("http", "https"):
        return DeliveryResult(False, "its URL begins neither with http:// nor with https://")
    request = urllib.request.Request(url, headers={"User-Agent": "rigapp"})  # noqa: S310 - judged above
    try:
        with urllib.request.urlopen(request, timeout=ANSWER_S):  # noqa: S310
            return DeliveryResult(True)
    except urllib.error.HTTPError as error:
        return DeliveryResult(False, f"the server answered {error.code}")
    except OSError as error:
        cause = getattr(error, "reason", error)
        return DeliveryResult(False, f"the server cannot be reached ({type(cause).__name__})")


def _by_apprise(request: AttemptRequest, url: str, secrets: list[str]) -> DeliveryResult:
    try:
        import apprise
    except ImportError:
        return DeliveryResult(False, "needs rigapp's extra: pip install 'rigapp[notify]'")
    remarks = _Remarks()
    logger = logging.getLogger("apprise")
    logger.handlers, logger.propagate = [remarks], False
    logger.setLevel(logging.WARNING)  # at lower levels it writes URLs and messages
    asset = apprise.AppriseAsset(app_id="rigapp", app_desc="rigapp", app_url="", async_mode=False)
    service = apprise.Apprise.instantiate(url, asset=asset)
    if service is None:
        return DeliveryResult(
            False, "apprise does not understand the URL; see its list of services"
        )
    if request.what == "inspect":
        return _inspected(request, service, secrets)
    types = {"critical": apprise.NotifyType.FAILURE, "warning": apprise.NotifyType.WARNING}
    delivered = service.notify(
        title=request.title,
        body=request.text,
        notify_type=types.get(request.level, apprise.NotifyType.INFO),
        body_format=apprise.NotifyFormat.TEXT,
    )
    return DeliveryResult(
        bool(delivered), "" if delivered else "; ".join(remarks.texts) or "not delivered"
    )


def _inspected(request: AttemptRequest, service: Any, secrets: list[str]) -> DeliveryResult:
    """Refuse a URL with a secret in it: parts that apprise hides must be references."""
    if REFERENCE.fullmatch(request.url):
        return DeliveryResult(True)
    shown = set(_parts(service.url(privacy=True)))
    for part in _parts(service.url(privacy=False)):
        if part not in shown and not any(part in secret or secret in part for secret in secrets):
            return DeliveryResult(
                False,
                "url holds a secret; write {NAME} in its place, and the secret under that name into"
                f" the keyring or {request.secrets}",
            )
    return DeliveryResult(True)


def _parts(url: str) -> Iterable[str]:
    return (unquote(part) for part in re.split(r"[:/@?&=]", url) if part)


def main() -> int:
    """Read one request and write its result."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # output of a library must not mix with the answer
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=AttemptRequest)
    with answers:
        answers.write(json_bytes(attempted(request)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
