"""Run the command line as ``python -m rigapp``."""

from rigapp.cli import main

main()
