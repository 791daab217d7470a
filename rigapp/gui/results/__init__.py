"""Recorded tests: index of a folder read by another process, results and documents of a test."""
