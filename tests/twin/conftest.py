"""Let the tests of the twin share what drives the plant."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
