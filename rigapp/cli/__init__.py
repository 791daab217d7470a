"""The command line: thin verbs, each of which imports its modules only when it is called.

Other packages import this one.
"""

from rigapp.cli.program import main

__all__ = ["main"]
