"""One attempt to reach somebody, in a process of its own that alone learns the secrets.

``python -m rigapp.notify.delivery`` takes an ``AttemptRequest`` on standard input and writes an
``DeliveryResult`` on standard output. Whoever starts it ends it when it takes too long: a server
that hangs, or answers a byte a minute, holds up nothing else.
"""

from __future__ import annotations

import logging
import os
import re
import sys
import urllib.error
import urllib.request
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Literal
from urllib.parse import unquote, urlsplit

import msgspec

from rigapp.config.errors import UnusableInput
from rigapp.config.notify import REFERENCE
from rigapp.notify.secrets import filled, looked_up, names_in, redacted
from rigapp.schema.wire import json_bytes

ANSWER_S = 15.0
"""A server of the ping may take so long between two signs of life."""

MOST_REASON = 300
"""Characters of a reason: it goes into a line of the log."""


class AttemptRequest(msgspec.Struct, frozen=True):
    """Say what to do: judge a URL, or only look up its secrets, send a message, or ping.

    url: as in the file, with references; secrets: the file that they may stand in.
    """

    what: Literal["inspect", "look up", "send", "ping"]
    url: str
    secrets: str
    title: str = ""
    text: str = ""
    level: str = "information"


class DeliveryResult(msgspec.Struct, frozen=True):
    """Say whether it worked, or why not, without any secret."""

    ok: bool
    reason: str = ""


class _Remarks(logging.Handler):
    """Gather what apprise has to say: its answer is yes or no, and the reason stands in its log."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.texts.append(record.getMessage())


def attempted(request: AttemptRequest) -> DeliveryResult:
    """Do what a request asks for; never raises, and says no secret."""
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
    except Exception as error:  # its words may hold the URL
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
    told = service.notify(
        title=request.title,
        body=request.text,
        notify_type=types.get(request.level, apprise.NotifyType.INFO),
        body_format=apprise.NotifyFormat.TEXT,
    )
    return DeliveryResult(bool(told), "" if told else "; ".join(remarks.texts) or "not delivered")


def _inspected(request: AttemptRequest, service: Any, secrets: list[str]) -> DeliveryResult:
    """Refuse a URL with a secret of its own: what apprise hides must come from a reference."""
    if REFERENCE.fullmatch(request.url):
        return DeliveryResult(True)
    shown = set(_parts(service.url(privacy=True)))
    for part in _parts(service.url(privacy=False)):
        if part not in shown and not any(part in one or one in part for one in secrets):
            return DeliveryResult(
                False,
                "url holds a secret; write {NAME} in its place, and the secret under that name into"
                f" the keyring or {request.secrets}",
            )
    return DeliveryResult(True)


def _parts(url: str) -> Iterable[str]:
    return (unquote(part) for part in re.split(r"[:/@?&=]", url) if part)


def main() -> int:
    """Take one request and answer it."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=AttemptRequest)
    with answers:
        answers.write(json_bytes(attempted(request)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
