"""The JSON Schema of rig and test files, for an editor."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from rigapp.config.errors import UnusableInput
from rigapp.config.meanings import KINDS, json_schema, schema_of_setting
from rigapp.texts import joined, say
from rigapp_drivers.registry import DriverNotFound, available_drivers, load_driver


def schema_text(kind: str) -> str:
    """Return the JSON Schema of "rig" or "test"; raises UnusableInput for another kind."""
    if kind not in KINDS:
        raise UnusableInput("{}: has no schema; say {}.", kind, joined(say(" or "), KINDS))
    settings = _settings() if kind == "rig" else {}
    tree = {"title": f"rigapp {kind} file", **json_schema(KINDS[kind], settings)}
    return json.dumps(tree, indent=2, ensure_ascii=False) + "\n"


def _settings() -> Mapping[str, Mapping[str, Any]]:
    """Return the settings of each loadable driver; ``rigapp doctor`` reports the others."""
    result = {}
    for name in available_drivers():
        try:
            keys = load_driver(name).settings
        except DriverNotFound:
            continue
        result[name] = {key: schema_of_setting(spec) for key, spec in keys.items()}
    return result
