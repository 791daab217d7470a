"""Rig and test files: allowed content, reading, checks, and errors as plain sentences."""
