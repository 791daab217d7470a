"""The report of a test: facts of its file, their words and pictures, one section each."""

from __future__ import annotations

from rigapp.report.testreport.compose import report_of

__all__ = ["report_of"]
