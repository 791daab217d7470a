"""Settings that hold for the whole suite."""

from __future__ import annotations

from hypothesis import settings

settings.register_profile("rigapp", deadline=None, print_blob=True)
settings.load_profile("rigapp")
