"""Recorded tests: a folder read by another process, what a test came to, and its documents."""
