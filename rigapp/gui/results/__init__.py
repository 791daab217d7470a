"""Recorded tests, without Qt: a folder read by another process, what a test came to in words."""
