"""Prepare a test: the form of its file, its limits, and the checks before the start."""
