"""``report.toml``: author and customer of a report, texts and logo of the laboratory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal

import msgspec

from rigapp.config.errors import UnusableInput

FIELDS: Final = ("file", "title", "specimen", "date")
"""Placeholders of a report number, each in braces."""


class LaboratorySection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[laboratory]: the head of a report. logo: a PNG or JPEG beside this file."""

    name: str = ""
    address: str = ""
    logo: str = ""


class ReportSection(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """[report]: number, customer, the statement at the foot and who signs."""

    number: str = ""
    customer: str = ""
    statement: str = ""
    language: Literal["en", "de"] = "en"
    signatures: tuple[str, ...] = ("Operator, date", "Reviewer, date")


class ReportFile(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The settings of reports: of a laboratory, or of one customer's tests."""

    schema: int
    laboratory: LaboratorySection = LaboratorySection()
    report: ReportSection = ReportSection()


def report_number(pattern: str, values: Mapping[str, str]) -> str:
    """Return a report's number; raises UnusableInput for a pattern with another placeholder."""
    try:
        return pattern.format_map({name: values[name] for name in FIELDS})
    except (KeyError, IndexError, ValueError, AttributeError) as error:
        raise UnusableInput(
            "report.number = {} names something else than {}; correct the pattern.",
            repr(pattern),
            ", ".join(f"{{{name}}}" for name in FIELDS),
        ) from error
