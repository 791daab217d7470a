"""Which whole cycles are kept."""

from __future__ import annotations

from rigapp.config.recipe import CyclesSection


class Schedule:
    """Tell whether the whole cycle of a revolution is kept; the last one of a test always is."""

    def __init__(self, section: CyclesSection, revolutions: int) -> None:
        self._section = section
        self._last = revolutions
        self._wanted: frozenset[int] = frozenset()
        if section.schedule == "logarithmic":
            self._wanted = logarithmic(revolutions, section.per_decade)

    def keeps(self, revolution: int) -> bool:
        """Tell whether revolution number ``revolution`` (the first is 1) is kept whole."""
        section = self._section
        if section.schedule == "none":
            return False
        if revolution == self._last:
            return True
        if section.schedule == "every":
            return revolution % section.every_revolutions == 0
        return revolution in self._wanted

    @property
    def any(self) -> bool:
        """Tell whether any cycle is kept."""
        return self._section.schedule != "none"

    def planned(self) -> int:
        """Return the number of cycles kept of the whole test."""
        if self._section.schedule == "none":
            return 0
        if self._section.schedule == "every":
            whole, rest = divmod(self._last, self._section.every_revolutions)
            return whole + (1 if rest else 0)
        return len(self._wanted | {self._last})


def logarithmic(revolutions: int, per_decade: int) -> frozenset[int]:
    """Return revolution numbers spaced evenly in the logarithm: ``per_decade`` in each decade."""
    found: set[int] = set()
    step = 0
    while True:
        number = round(10 ** (step / per_decade))
        if number > revolutions:
            return frozenset(found)
        found.add(number)
        step += 1
