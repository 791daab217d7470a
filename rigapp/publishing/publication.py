"""What a package says of itself: title, authors, licence, day; the same for all its texts."""

from __future__ import annotations

from dataclasses import dataclass

from rigapp.publishing.authors import Author
from rigapp.publishing.licences import Licence
from rigapp.publishing.packaged import PackagedTest

VERSION = "1.0"
"""Of the data: a package is published once, whatever is mended later is another one."""
KEYWORDS = ("wear test", "slider-crank", "joint clearance", "bushing")


@dataclass(frozen=True, slots=True)
class Publication:
    """The tests of a package, whose they are, and how others may use them."""

    tests: tuple[PackagedTest, ...]
    authors: tuple[Author, ...]
    licence: Licence

    @property
    def title(self) -> str:
        """Return the title: that of the test, or those of all."""
        titles = dict.fromkeys(one.title for one in self.tests)
        kind = "Wear test" if len(self.tests) == 1 else f"{len(self.tests)} wear tests"
        return f"{kind}: {'; '.join(titles)}"

    @property
    def day(self) -> str:
        """Return the day on which the last of the tests ended."""
        return max(one.day for one in self.tests)

    @property
    def summary(self) -> str:
        """Return what was done, in one or two sentences."""
        total = sum(int(one.summary["revolutions"]) for one in self.tests)
        simulated = sum(bool(one.about["simulated"]) for one in self.tests)
        words = (
            "A hard pin turns in a soft bushing of a slider-crank mechanism; forces and the pin's"
            f" position are recorded for each of {total} revolutions"
        )
        if simulated == len(self.tests):
            return f"{words}. The rig was simulated: these are not measurements."
        if simulated:
            return f"{words}. The rig of {simulated} of the tests was simulated."
        return f"{words}."
