"""Settings of `make docs`: the guides as they stand here, and pages of the docstrings."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = {
    "model": [],
    "calibration": [],
    # A simulated device is spoken to by its bytes; nobody calls it.
    "drivers": ["drivers/*simulat*.py"],
    # Of the application, what flows and is stored, and the analyst's door.
    "rigapp": [f"rigapp/{one.name}" for one in (ROOT / "rigapp").iterdir()],
}
SHOWN = ("schema", "analysis", "model.py", "calibration.py", "__init__.py")
PACKAGES["rigapp"] = sorted(set(PACKAGES["rigapp"]) - {f"rigapp/{one}" for one in SHOWN})

project = "rigapp"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.apidoc"]
html_theme = "furo"
html_show_sourcelink = False
myst_heading_anchors = 4
autodoc_member_order = "bysource"
apidoc_modules = [
    {
        "path": ROOT / package,
        "destination": f"api/{package}",
        "exclude_patterns": [str(ROOT / pattern) for pattern in without],
        "separate_modules": True,
        "automodule_options": {"members"},
    }
    for package, without in PACKAGES.items()
]

MARKS = re.compile(r"``.*?``|\|")


def escape_bars(_app: Any, _what: str, _name: str, _of: Any, _how: Any, lines: list[str]) -> None:
    """Let the bars of a magnitude, |F|, be text: docutils takes them for a substitution."""
    lines[:] = [
        MARKS.sub(lambda m: r"\|" if m.group() == "|" else m.group(), line) for line in lines
    ]


def setup(app: Any) -> None:
    """Connect with Sphinx."""
    app.connect("autodoc-process-docstring", escape_bars)
