"""The command line: thin verbs, each of which imports its modules only when it is called.

This module is the public interface of the package.
"""

from rigapp.cli.program import main

__all__ = ["main"]
