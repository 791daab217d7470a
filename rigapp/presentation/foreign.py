"""What the window shows that no sentence of rigapp has: errors of others, words as values."""

from __future__ import annotations

from typing import Final

SYSTEM: Final = (
    "Address already in use", "Broken pipe", "Cannot assign requested address",
    "Connection refused", "Connection reset by peer", "Connection timed out",
    "Device or resource busy", "Directory not empty", "Disk quota exceeded", "File exists",
    "File name too long", "File too large", "Host is down", "Input/output error",
    "Invalid argument", "Is a directory", "Name or service not known", "Network is unreachable",
    "No route to host", "No space left on device", "No such device",
    "No such device or address", "No such file or directory", "Not a directory",
    "Operation not permitted", "Permission denied", "Read-only file system",
    "Resource temporarily unavailable", "Stale file handle", "Too many open files", "timed out",
)  # fmt: skip
"""Errors of the operating system."""

LIBRARIES: Final = (
    "{} (at line {}, column {})", "{} (at end of document)",
    "Cannot declare {} twice", "Cannot mutate immutable namespace {}", "Cannot overwrite a value",
    "Duplicate inline table key {}", "Expected {}", "Expected '=' after a key in a key/value pair",
    "Expected ']' at the end of a table declaration",
    "Expected ']]' at the end of an array declaration",
    "Expected newline or end of document after a statement", "Found invalid character {}",
    "Illegal character {}", "Invalid date or datetime", "Invalid hex value",
    "Invalid initial character for a key part", "Invalid statement", "Invalid value",
    "Unclosed array", "Unclosed inline table", "Unescaped '\\' in a string",
    "Unterminated string",
    "Invalid enum value {}", "No module named {}",
    "expected {}, got {}", "expected {} >= {}", "expected {} <= {}", "expected {} > {}",
    "expected {} < {}", "expected {} of length {}", "expected {} of length {}, got {}",
    "expected {} of length >= {}", "expected {} of length <= {}",
    "expected {} of at least length {}",
)  # fmt: skip
"""Errors of TOML and of the kinds of values."""

WORDS_INSIDE: Final = (
    "Slowly", "(assumed)", "assumed", "bridge", "voltage",
    "over-current", "over-voltage", "under-voltage", "over-temperature", "current",
    "temperature", "hardware", "software", "faster", "fell", "grew", "heavier", "less", "lighter",
    "more", "nothing", "reading", "rose", "slower", "text", "unknown", "writing",
    "clearance", "density", "gravity", "stiffness", "exponent", "follower angle",
    "follower speed", "friction ramp",
    "impact speed floor", "layers", "loads", "moving mass", "node spacing", "poissons ratio",
    "predictive band", "probe errors", "radii", "relative error", "restitution",
    "running in revolutions", "sectors", "slider position", "slider velocity", "start angle",
    "technique", "times", "tolerance", "typical force", "youngs modulus",
    "write {NAME} in its place, and the secret under that name into the keyring or secrets.toml",
)  # fmt: skip
"""Words that sentences put in the place of a value."""
