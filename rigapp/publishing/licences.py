"""Licences under which data are published, by their SPDX identifier."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp.config.errors import UnusableInput


@dataclass(frozen=True, slots=True)
class Licence:
    """One licence: its SPDX identifier, its name, where its text stands."""

    identifier: str
    name: str
    url: str

    @property
    def text(self) -> str:
        """Return what stands in the file LICENSE."""
        return (
            f"These data are published under the {self.name}.\n\n"
            f"SPDX-License-Identifier: {self.identifier}\n"
            f"The text of the licence: {self.url}\n"
        )


CREATIVE_COMMONS = "https://creativecommons.org"
DATA_COMMONS = "https://opendatacommons.org/licenses"
LICENCES = {
    one.identifier: one
    for one in (
        Licence(
            "CC-BY-4.0",
            "Creative Commons Attribution 4.0 International licence",
            f"{CREATIVE_COMMONS}/licenses/by/4.0/",
        ),
        Licence(
            "CC-BY-SA-4.0",
            "Creative Commons Attribution-ShareAlike 4.0 International licence",
            f"{CREATIVE_COMMONS}/licenses/by-sa/4.0/",
        ),
        Licence(
            "CC-BY-NC-4.0",
            "Creative Commons Attribution-NonCommercial 4.0 International licence",
            f"{CREATIVE_COMMONS}/licenses/by-nc/4.0/",
        ),
        Licence(
            "CC0-1.0",
            "Creative Commons Zero 1.0 Universal dedication to the public domain",
            f"{CREATIVE_COMMONS}/publicdomain/zero/1.0/",
        ),
        Licence(
            "ODC-By-1.0",
            "Open Data Commons Attribution License 1.0",
            f"{DATA_COMMONS}/by/1-0/",
        ),
        Licence("ODbL-1.0", "Open Database License 1.0", f"{DATA_COMMONS}/odbl/1-0/"),
        Licence(
            "PDDL-1.0",
            "Open Data Commons Public Domain Dedication and License 1.0",
            f"{DATA_COMMONS}/pddl/1-0/",
        ),
    )
}
"""Those that data repositories offer; licences of programs say nothing of data."""


def licence_of(identifier: str) -> Licence:
    """Return the licence that somebody named, in whatever case; raise UnusableInput."""
    for one in LICENCES.values():
        if one.identifier.casefold() == identifier.strip().casefold():
            return one
    raise UnusableInput(
        f"--licence {identifier}: is none of the licences for data that are known here; give one"
        f" of {', '.join(LICENCES)}."
    )
