"""Unusable input, said in one sentence."""

from __future__ import annotations


class UnusableInput(Exception):
    """Say which file and key cannot be used, and what to do; exit status 2."""
