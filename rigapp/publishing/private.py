"""Find what is private in a text: addresses, names of computers, folders and people.

What is found is suspected, not proven; a person decides.
"""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Iterator
from urllib.parse import urlsplit

from rigapp.config.notify import REFERENCE
from rigapp.publishing.places import RIG, Passage

_MAIL = re.compile(r"[\w.%+-]+@(?:[A-Za-z0-9-]+\.)+[A-Za-z]{2,}")
_HOME = re.compile(
    r"(?:/(?:var/|usr/|export/)?home/|/Users/|/(?:run/)?media/|[A-Za-z]:[\\/]+Users[\\/]+)"
    r"([^\\/\s\"',;:()\[\]]+)"
)
_ROOT = re.compile(r"(?<![\w/.-])/root(?=/)")
_IPV4 = re.compile(r"(?<![\w.-])(?:\d{1,3}\.){3}\d{1,3}(?![\w-]|\.\d)")
_IPV6 = re.compile(r"(?<![\w:.])(?:[0-9A-Fa-f]{0,4}:){2,7}[0-9A-Fa-f]{0,4}(?![\w:])")
_URL = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*://[^\s\"'<>]+")
_LOCAL_NAME = re.compile(
    r"(?<![\w.@-])[A-Za-z0-9-]+(?:\.[A-Za-z0-9-]+)*"
    r"\.(?:local|localdomain|lan|internal|intranet|corp|home\.arpa)(?![\w.-]*\w)"
)
_WRITER = re.compile(r"process \d+ on (\S+)")
_VERSION = re.compile(r"version|firmware|platform")
_TOLD = re.compile(r"(?:notify|ping)\.(?:url|command)")

NO_HOST = frozenset({"hwgrep", "loop", "spy", "alt", "file"})
"""Schemes whose URLs name a port of this computer, as pyserial has them."""
PUBLIC = frozenset({"http", "https", "doi", "urn"})
"""Schemes by which documents are cited: a whole domain name there is no secret."""


def found_in(one: Passage, computers: frozenset[str], people: frozenset[str]) -> Iterator[str]:
    """Yield what is private in a passage, each as the object of a sentence.

    computers: names of the computers that are known. people: names of those who are no authors.
    """
    text = one.text
    for kind in (_addresses, _folders, _networks, _messages):
        yield from kind(one)
    if host := _WRITER.fullmatch(text) if one.path.endswith("/state/writer") else None:
        yield f"the host name {host[1]}"
    for name in sorted(computers):
        if _word(name, text, re.IGNORECASE):
            yield f"the host name {name}"
    for name in sorted(people):
        if _word(name, text):
            yield f"the name of {name}, who is not among the authors"


def _addresses(one: Passage) -> Iterator[str]:
    for found in _MAIL.findall(one.text):
        yield f"the e-mail address {found}"


def _folders(one: Passage) -> Iterator[str]:
    for found in _HOME.finditer(one.text):
        yield f"the home folder of {found[1]} ({found[0]})"
    if _ROOT.search(one.text):
        yield "a path in the home folder of root (/root)"


def _networks(one: Passage) -> Iterator[str]:
    for url in _URL.findall(one.text):
        if host := _private_host(url):
            yield f"the host name {host}"
    for name in _LOCAL_NAME.findall(one.text):
        yield f"the host name {name}"
    if not _VERSION.search(one.key):  # four numbers with dots
        for found in (*_IPV4.findall(one.text), *_IPV6.findall(one.text)):
            if _is_elsewhere(found):
                yield f"the IP address {found}"


def _messages(one: Passage) -> Iterator[str]:
    if one.path == RIG and _TOLD.fullmatch(one.key):
        secrets = ", ".join(REFERENCE.findall(one.text))
        yield "whom messages are sent to" + (f", with the secret named {secrets}" * bool(secrets))


def _private_host(url: str) -> str:
    """Return the host of a URL that is no public one, no IP address and not this computer."""
    try:
        parts = urlsplit(REFERENCE.sub("", url))
        host = parts.hostname or ""
    except ValueError:
        return ""
    if parts.scheme in NO_HOST or not host or host == "localhost" or _address(host) is not None:
        return ""
    whole = "." in host and not _LOCAL_NAME.fullmatch(host)
    return "" if parts.scheme in PUBLIC and whole else host


def _address(text: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        return ipaddress.ip_address(text)
    except ValueError:
        return None


def _is_elsewhere(text: str) -> bool:
    """Tell whether a text is the address of some computer, and not of whichever this is."""
    found = _address(text)
    return found is not None and not (found.is_loopback or found.is_unspecified)


def _word(name: str, text: str, flags: int = 0) -> bool:
    """Tell whether a name stands in a text; by its letters' case too: Max is not the word max."""
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text, flags) is not None
