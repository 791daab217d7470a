"""Rig and test files: their allowed content, reading, checks, and errors in plain sentences."""
