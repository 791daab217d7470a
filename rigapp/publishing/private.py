"""Private data in a text, by patterns; and their removal."""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Iterable
from urllib.parse import urlsplit

MAIL = re.compile(r"[\w.%+-]+@(?:[A-Za-z0-9-]+\.)+[A-Za-z]{2,}")
HOME = re.compile(
    r"(?:/(?:var/|usr/|export/)?home/|/Users/|/(?:run/)?media/|[A-Za-z]:[\\/]+Users[\\/]+)"
    r"([^\\/\s\"',;:()\[\]]+)"
)
ROOT = re.compile(r"(?<![\w/.-])/root(?=/)")
IPV4 = re.compile(r"(?<![\w.-])(?:\d{1,3}\.){3}\d{1,3}(?![\w-]|\.\d)")
IPV6 = re.compile(r"(?<![\w:.])(?:[0-9A-Fa-f]{0,4}:){2,7}[0-9A-Fa-f]{0,4}(?![\w:])")
URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*://[^\s\"'<>]+")
LOCAL_NAME = re.compile(
    r"(?<![\w.@-])[A-Za-z0-9-]+(?:\.[A-Za-z0-9-]+)*"
    r"\.(?:local|localdomain|lan|internal|intranet|corp|home\.arpa)(?![\w.-]*\w)"
)

NO_HOST = frozenset({"hwgrep", "loop", "spy", "alt", "file"})
"""Schemes whose URLs name a port of this computer, as in pyserial."""
PROGRAM = frozenset(
    {"", "engine", "limits", "drive", "storage", "twin", "messages", "queue", "operator"}
)
"""Names in a log that are not persons, and the name of a person without one."""


def without_private(text: str, names: Iterable[str]) -> str:
    """Return a text in which private data are replaced by their kinds, in brackets.

    Home folders, e-mail addresses, addresses of other computers (that of a document, too: it may
    hold a secret), and names, as whole words. names: of people and computers.
    """
    text = URL.sub(_without_host, text)
    text = ROOT.sub("[home]", HOME.sub("[home]", MAIL.sub("[e-mail]", text)))
    text = LOCAL_NAME.sub("[host]", text)
    for pattern in (IPV4, IPV6):
        text = pattern.sub(lambda match: "[address]" if is_elsewhere(match[0]) else match[0], text)
    for name in sorted(names, key=len, reverse=True):
        text = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", "[name]", text, flags=re.IGNORECASE)
    return text


def _without_host(url: re.Match[str]) -> str:
    scheme, _, rest = url[0].partition("://")
    try:
        host = urlsplit(url[0]).hostname or ""
    except ValueError:
        host = rest
    address = address_of(host)
    is_local = host == "localhost" or (address is not None and address.is_loopback)
    return url[0] if scheme in NO_HOST or scheme == "wire" or is_local else f"{scheme}://[address]"


def address_of(text: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    """Return the IP address in a text, None without one."""
    try:
        return ipaddress.ip_address(text)
    except ValueError:
        return None


def is_elsewhere(text: str) -> bool:
    """Return whether a text is the address of another computer, not of this one."""
    result = address_of(text)
    return result is not None and not (result.is_loopback or result.is_unspecified)
