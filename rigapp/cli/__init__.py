"""The command line: thin verbs, each of which imports what it needs when it is called.

Others enter by this door.
"""

from rigapp.cli.program import main

__all__ = ["main"]
