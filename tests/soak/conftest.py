"""Let these tests use the doubles of the engine's and the service's tests."""

from __future__ import annotations

import sys
from pathlib import Path

for folder in ("engine", "service", "soak"):
    sys.path.insert(0, str(Path(__file__).parents[1] / folder))
