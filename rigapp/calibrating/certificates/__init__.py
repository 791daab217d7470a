"""The type-specific parts of certificates; their plots and pages.

Takes the content of a record, returns parts of a page; independent of sessions and records.
"""
