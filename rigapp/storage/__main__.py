"""Compress or seal the file of an ended test: ``python -m rigapp.storage FILE``."""

from __future__ import annotations

import sys

from rigapp.storage.upkeep.compact import main

sys.exit(main())
