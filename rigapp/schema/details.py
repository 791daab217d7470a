"""Part what an operator reads of a text from its technical details.

Whoever writes a text puts into it, between ‹ and ›, what a library or the operating system said, a
register, an address, raw bytes: ``f"The port cannot be opened ‹{error}›; check the cable."``. Logs
and files keep it whole; who shows it to an operator shows the sentence, with the details folded.
"""

from __future__ import annotations

import re
from typing import Final

_DETAILS: Final = re.compile(r"\s*‹([^‹›]*)(?:›|$)| on (\w+://[^\s‹›]+?)(?=:? |:?$)")
"""The innermost details of a text, up to the end of one that was cut; and where a device is when
it has no port of its own."""


def sentence_of(text: str) -> str:
    """Return a text without its details."""
    return _parted(text)[0]


def details_of(text: str) -> str:
    """Return the details of a text, a line each, empty where it has none."""
    return "\n".join(_parted(text)[1])


def marked_details(text: str) -> str:
    """Return the details of a text marked as such, to stand behind another sentence."""
    return "".join(f" ‹{one}›" for one in _parted(text)[1])


def indented(text: str) -> str:
    """Return a text as a terminal shows it: the sentence, and below it its details, indented."""
    sentence, details = _parted(text)
    return "\n    ".join((sentence, *details))


def error_text(error: BaseException, otherwise: str) -> str:
    """Return what an error says: a sentence of this program's, else ``otherwise`` with details.

    The operating system's own words for a file stay: they say what happened.
    """
    ours = _is_ours(type(error).__module__) or (type(error) is ValueError and _raised_here(error))
    if ours and str(error):
        return str(error)
    if isinstance(error, OSError) and error.strerror and error.filename:
        return f"{error.filename}: {error.strerror} ‹{error!r}›"
    return f"{otherwise} ‹{error!r}›"


def _raised_here(error: BaseException) -> bool:
    """Tell whether this program's own code raised an error: then its text is a sentence."""
    place = error.__traceback__
    while place is not None and place.tb_next is not None:
        place = place.tb_next
    return place is not None and _is_ours(str(place.tb_frame.f_globals.get("__name__", "")))


def _is_ours(module: str) -> bool:
    return module.partition(".")[0].startswith("rigapp")


def _parted(text: str) -> tuple[str, list[str]]:
    details: list[str] = []
    # Nearly every text has none, and this is asked for with every repaint.
    if "‹" not in text and "://" not in text:
        return text, details
    while (found := _DETAILS.search(text)) is not None:
        details.append(" ".join((found[1] or found[2] or "").split()))
        text = text[: found.start()] + text[found.end() :]
    return text, [one for one in details if one]
