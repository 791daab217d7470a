"""``[[notify]]`` and ``[ping]``: notifications, in a rig file or in the user's own file."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Annotated, Final, Literal, get_args
from urllib.parse import urlsplit

import msgspec

from rigapp.config.numbers import within
from rigapp.texts import joined, say

When = Literal["critical", "warning", "end", "pause", "criterion", "silence", "disk", "daily"]

REFERENCE: Final = re.compile(r"\{([a-z][a-z0-9_]*)\}")
"""Placeholder of a secret in a URL: its name in braces."""

CLOCK: Final = re.compile(r"([01]\d|2[0-3]):([0-5]\d)")
"""Time of day in ``daily_at``."""

WAY_NAME: Final = re.compile(r"[A-Za-z0-9][A-Za-z0-9 _.-]{0,39}")
"""Pattern of a channel's name, which appears in the log."""


class NotifySection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[[notify]]: one channel for messages: a URL of apprise, or a command of the user.

    An event that recurs within recovered_after_s is not reported again.
    """

    url: str = ""
    command: tuple[str, ...] = ()
    when: tuple[When, ...] = ("critical", "end", "pause", "silence", "disk")
    name: str = ""
    daily_at: str = "07:00"
    near_percent: Annotated[float, within(0.1, 50.0)] = 5.0
    silent_after_s: Annotated[float, within(5.0, 86_400.0)] = 60.0
    disk_free_GB: Annotated[float, within(0.01, 100_000.0, unit="GB")] = 2.0
    recovered_after_s: Annotated[float, within(0.0, 3600.0)] = 10.0
    most_per_hour: Annotated[int, within(1, 1000, unit="messages")] = 20


class PingSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[ping]: a URL that is requested at an interval while all is well (a dead man's switch)."""

    url: str
    interval_s: Annotated[float, within(5.0, 86_400.0)] = 60.0


class NotifyFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The user's own file: channels for every rig of this user."""

    schema: int
    notify: tuple[NotifySection, ...] = ()
    ping: PingSection | None = None


def notify_faults(ways: Sequence[NotifySection], ping: PingSection | None) -> Iterator[str]:
    """Yield the faults of channels and ping, each as a sentence without any URL."""
    for number, way in enumerate(ways, 1):
        yield from (say("notify {} {}", number, fault) for fault in _of_way(way))
    for name, count in Counter(way.name for way in ways if way.name).items():
        if count > 1:
            yield say(
                "notify.name = {} occurs {} times; each recipient needs its own name",
                repr(name),
                count,
            )
    if ping is not None and not REFERENCE.fullmatch(ping.url):
        if urlsplit(ping.url).scheme not in ("http", "https"):
            yield say("ping.url begins neither with http:// nor with https://")
        elif _password_in(ping.url):
            yield say("ping.url holds a password; {}", _ELSEWHERE)


_ELSEWHERE = (
    "write {NAME} in its place, and the secret under that name into the keyring or secrets.toml"
)


def _of_way(way: NotifySection) -> Iterator[str]:
    if bool(way.url) == bool(way.command):
        yield say("needs either url or command")
    if way.url and not REFERENCE.fullmatch(way.url):
        if not re.match(r"[A-Za-z][A-Za-z0-9+.-]*://", way.url):
            yield say("url begins with no scheme, as in mailtos:// or json://")
        elif _password_in(way.url):
            yield say("url holds a password; {}", _ELSEWHERE)
    if way.command and not way.command[0].strip():
        yield say("the command names no program")
    if not way.when:
        yield say("when is empty; choose of {}", joined(", ", get_args(When)))
    if way.name and not WAY_NAME.fullmatch(way.name):
        yield say("name may hold letters, digits, blanks and . _ - only, 40 at most")
    if not CLOCK.fullmatch(way.daily_at):
        yield say("daily_at = {} is no time of the day; write it as 07:00", repr(way.daily_at))


def _password_in(url: str) -> bool:
    """Return whether a URL contains a password instead of a reference."""
    try:
        password = urlsplit(REFERENCE.sub("", url)).password
    except ValueError:
        return False
    return bool(password)
