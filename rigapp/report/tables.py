"""Tables of the model's verbs as CSV, written completely or not at all."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.config.errors import UnusableInput
from rigapp.config.writing import whole_file


def check_target(option: str, target: Path, source: Path | None = None) -> None:
    """Refuse a target that is not a CSV file in an existing folder, or is the source."""
    if target.suffix.lower() != ".csv":
        raise UnusableInput("{} {}: give a name that ends with .csv.", option, target)
    if target.is_dir() or not target.absolute().parent.is_dir():
        raise UnusableInput(
            "{} {}: The folder does not exist, or the path is a folder.", option, target
        )
    if source is not None and target.exists() and source.exists() and target.samefile(source):
        raise UnusableInput("{} {}: that is the parameter file; give another name.", option, target)


def write_table(option: str, target: Path, columns: Mapping[str, Any]) -> None:
    """Write columns as CSV; an earlier table is replaced when the new one is complete."""
    table = np.column_stack([np.asarray(column, dtype=np.float64) for column in columns.values()])
    with (
        whole_file(target, f"{option} {target}") as part,
        part.open("w", encoding="ascii", newline="\n") as file,
    ):
        np.savetxt(
            file, table + 0.0, fmt="%.15g", delimiter=",", header=",".join(columns), comments=""
        )
