"""Recorded tests: a folder read by another process, the result of a test, and its documents."""
