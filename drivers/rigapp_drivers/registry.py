"""Find drivers by entry point and check their settings.

A third-party package adds a driver by naming a ``DriverInfo`` under the entry-point group
``rigapp.drivers``; nothing here changes. A driver's module is imported on first use.
"""

from __future__ import annotations

import copy
import difflib
import importlib
import math
from collections.abc import Iterable, Mapping
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from rigapp.texts import SentenceError, joined, say
from rigapp_drivers.api import DriverInfo, SettingSpec
from rigapp_drivers.edge import failure_words, foreign

GROUP = "rigapp.drivers"
FORMER_NAMES = ("drivers", "model", "calibration")
"""Names under which version 0.2 installed its packages; a driver may still import them."""

_KIND_WORDS: dict[type, str] = {
    bool: say("true or false"),
    int: say("an integer"),
    float: say("a number"),
    str: say("a text in quotation marks"),
    list: say("a list"),
    dict: say("a table"),
}


class SettingsError(SentenceError, ValueError):
    """A setting is invalid; one sentence with the remedy."""


class DriverNotFound(SentenceError, LookupError):
    """A driver or simulator cannot be loaded; one sentence with the remedy."""


class DriverBroken(DriverNotFound):
    """The import of a driver or simulator failed; the sentence names its package."""


def available_drivers() -> tuple[str, ...]:
    """Return the names of all installed drivers, sorted, without importing any of them."""
    return tuple(sorted(_entries()))


def load_driver(name: str) -> DriverInfo:
    """Import a driver by name and return its description; raise DriverNotFound.

    Any exception of the import is raised as DriverBroken.
    """
    entries = _entries()
    entry = entries.get(name)
    if entry is None:
        hint = _nearest(name, entries)
        raise DriverNotFound(
            'There is no driver "{}"{}; installed are: {}.',
            name,
            hint,
            joined(", ", sorted(entries)),
        )
    with foreign(
        lambda error: DriverBroken(
            say(
                'The driver "{}" cannot be loaded ‹{}: {}›; {}.',
                name,
                entry.value,
                failure_words(error),
                _way_out(name, error),
            )
        )
    ):
        info = entry.load()
    if not isinstance(info, DriverInfo):
        raise DriverBroken(
            'The driver "{}" ({}) is a {}, not a DriverInfo; report it to the author of'
            " the package {}.",
            name,
            entry.value,
            type(info).__name__,
            package_of(name),
        )
    return info


def _way_out(driver: str, error: BaseException) -> str:
    """Return the remedy for a driver whose import has failed."""
    former = str(getattr(error, "name", None) or "").partition(".")[0]
    if former in FORMER_NAMES:
        return say(
            'it was written for an older rigapp: "from {} import ..." is "from'
            ' rigapp.{} import ..." now; install its newer version, or change that line',
            former,
            former,
        )
    return say("reinstall or update the package {}", package_of(driver))


def package_of(driver: str) -> str:
    """Return the name of the installed package that provides a driver."""
    entry = _entries().get(driver)
    if entry is None:
        return driver
    return entry.dist.name if entry.dist is not None else entry.module.partition(".")[0]


def load_simulator(info: DriverInfo) -> type[Any]:
    """Import and return the simulator class of a driver; raise DriverNotFound.

    Only the simulated rig and tests call this: a driver at run time never loads a simulator.
    """
    if info.simulator is None:
        raise DriverNotFound(
            'The driver "{}" has no simulator; give the device a real port.', info.name
        )
    module_name, _, class_name = info.simulator.partition(":")
    package = package_of(info.name)
    with foreign(
        lambda error: DriverBroken(
            say(
                'The simulator of driver "{}" cannot be loaded ‹{}: {}›; reinstall or'
                " update the package {}.",
                info.name,
                info.simulator,
                failure_words(error),
                package,
            )
        )
    ):
        simulator = getattr(importlib.import_module(module_name), class_name)
    if not isinstance(simulator, type):
        raise DriverBroken(
            'The simulator of driver "{}" ({}) is not a class; report it to the author'
            " of the package {}.",
            info.name,
            info.simulator,
            package,
        )
    return simulator


def check_settings(info: DriverInfo, settings: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Return the settings with every default filled in; raise SettingsError.

    where: location for the error text, for example ``rig.toml [devices.daq.settings]``.
    """
    for key in settings:
        if key not in info.settings:
            known = joined(", ", sorted(info.settings)) or "none"
            raise SettingsError(
                '{}: driver "{}" has no setting "{}"{}; its settings are: {}.',
                where,
                info.name,
                key,
                _nearest(key, info.settings),
                known,
            )
    return {
        key: _checked(settings[key], spec, say("{} {}", where, key))
        if key in settings
        else copy.deepcopy(spec.default)
        for key, spec in info.settings.items()
    }


def _entries() -> dict[str, EntryPoint]:
    return {entry.name: entry for entry in entry_points(group=GROUP)}


def _nearest(word: str, words: Iterable[str]) -> str:
    texts = [text for text in words if isinstance(text, str)]
    near = difflib.get_close_matches(word, texts, n=1, cutoff=0.5)
    return say(' (did you mean "{}"?)', near[0]) if near else ""


def _checked(value: Any, spec: SettingSpec, where: str) -> Any:
    value = _converted(value, spec, where)
    if spec.choices and not any(_same(value, choice) for choice in spec.choices):
        hint = _nearest(value, spec.choices) if isinstance(value, str) else ""
        allowed = joined(", ", (_shown(choice) for choice in spec.choices))
        raise SettingsError(
            "{}: {} is not allowed{}; choose one of: {}.", where, _shown(value), hint, allowed
        )
    if isinstance(value, int | float) and not isinstance(value, bool):
        _check_range(value, spec, where)
    return value


def _same(value: Any, choice: Any) -> bool:
    return type(value) is type(choice) and bool(value == choice)


def _converted(value: Any, spec: SettingSpec, where: str) -> Any:
    if spec.kind is object:
        return value
    if spec.kind is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if spec.kind is int and isinstance(value, float) and value.is_integer():
        return int(value)
    fits = isinstance(value, spec.kind)
    if isinstance(value, bool) and spec.kind is not bool:
        fits = False
    if not fits:
        wanted = _KIND_WORDS.get(spec.kind, spec.kind.__name__)
        raise SettingsError("{}: {} is not {}. {}", where, _shown(value), wanted, spec.sentence)
    return value


def _check_range(value: float, spec: SettingSpec, where: str) -> None:
    if not math.isfinite(value):
        raise SettingsError("{}: {} is not a finite number. {}", where, value, spec.sentence)
    if spec.minimum is not None and value < spec.minimum:
        raise SettingsError(
            "{}: {:g} is below the smallest value {:g}. {}",
            where,
            value,
            spec.minimum,
            spec.sentence,
        )
    if spec.maximum is not None and value > spec.maximum:
        raise SettingsError(
            "{}: {:g} is above the largest value {:g}. {}",
            where,
            value,
            spec.maximum,
            spec.sentence,
        )


def _shown(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return f'"{value}"' if isinstance(value, str) else f"{value}"
