"""Settings that hold for the whole suite.

The suite draws the same examples each time; `make search` looks for new ones. What it finds is
mended and kept as an @example, so that no file beside the sources decides what is tested.
"""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("rigapp", deadline=None, derandomize=True, print_blob=True)
settings.register_profile("search", deadline=None, database=None, max_examples=500, print_blob=True)
settings.load_profile("rigapp")
