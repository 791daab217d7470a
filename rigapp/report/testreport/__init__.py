"""The report of a test: facts of its file, with texts and figures in sections."""

from __future__ import annotations

from rigapp.report.testreport.compose import report_of
from rigapp.report.testreport.cover import report_settings

__all__ = ["report_of", "report_settings"]
