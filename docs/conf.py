"""Settings of `make docs`: the guides of this folder, pages of commands and docstrings."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
PACKAGES = {
    "model/rigapp_model": [],
    "calibration/rigapp_calibration": [],
    # Simulated devices have no API: they are accessed through their protocols.
    "drivers/rigapp_drivers": ["drivers/rigapp_drivers/*simulat*.py"],
    # Of the application: schema, stored data, and the interface for analysis. Re-exports of
    # rigapp.model and others are documented where they are defined.
    "rigapp": [f"rigapp/{path.name}" for path in (ROOT / "rigapp").iterdir()],
}
SHOWN = ("schema", "analysis", "__init__.py")
PACKAGES["rigapp"] = sorted(set(PACKAGES["rigapp"]) - {f"rigapp/{name}" for name in SHOWN})

project = "rigapp"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.apidoc"]
html_theme = "furo"
html_show_sourcelink = False
myst_heading_anchors = 4
autodoc_member_order = "bysource"
apidoc_modules = [
    {
        "path": ROOT / package,
        "destination": f"api/{Path(package).name}",
        "exclude_patterns": [str(ROOT / pattern) for pattern in without],
        "separate_modules": True,
        "automodule_options": {"members"},
    }
    for package, without in PACKAGES.items()
]

MARKS = re.compile(r"``.*?``|\|")


def escape_bars(_app: Any, _what: str, _name: str, _of: Any, _how: Any, lines: list[str]) -> None:
    """Escape the bars of a magnitude, |F|, which docutils would take for a substitution."""
    lines[:] = [
        MARKS.sub(lambda m: r"\|" if m.group() == "|" else m.group(), line) for line in lines
    ]


def setup(app: Any) -> None:
    """Register with Sphinx; write the pages of the commands and of the keys."""
    sys.path.insert(0, str(HERE))
    from reference import command_reference, key_reference

    (HERE / "api").mkdir(exist_ok=True)
    (HERE / "api" / "commands.md").write_text(command_reference(), "utf-8")
    (HERE / "api" / "keys.md").write_text(key_reference(), "utf-8")
    app.connect("autodoc-process-docstring", escape_bars)
