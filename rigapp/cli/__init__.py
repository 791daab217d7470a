"""The command line: thin verbs, each of which imports its modules only when it is called.

Others enter by this door.
"""

from rigapp.cli.program import main

__all__ = ["main"]
