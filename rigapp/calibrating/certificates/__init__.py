"""The parts of certificates beside the identification, by subject; their plots and pages.

Takes the content of a record, returns parts of a page; independent of sessions and records.
"""
