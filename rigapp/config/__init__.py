"""Rig and test files: what may stand in them, read, checked and told in plain sentences."""
