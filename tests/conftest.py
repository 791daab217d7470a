"""Settings and fixtures of the whole suite.

The suite draws the same examples each time; `make search` looks for new ones. What it finds is
mended and kept as an @example, so that no file beside the sources decides what is tested.
"""

from __future__ import annotations

import signal
from collections import Counter
from collections.abc import Callable, Generator, Iterator
from contextlib import ExitStack
from typing import Any

import pytest
from hypothesis import settings

from rigapp.process.memory import begin_to_load, end_of_loading

settings.register_profile(
    "rigapp", max_examples=25, deadline=None, derandomize=True, print_blob=True
)
settings.register_profile("search", deadline=None, database=None, max_examples=500, print_blob=True)
settings.load_profile("rigapp")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """Search for garbage only among what the tests make.

    Modules and items of the whole suite are half a million objects: a search takes 0.5 s.
    """
    begin_to_load()
    try:
        return (yield)
    finally:
        end_of_loading()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave to the long suite all cases of a sampled test but the first, or but each n-th."""
    seen: Counter[tuple[pytest.Item | pytest.Collector | None, str]] = Counter()
    for item in items:
        sampled = item.get_closest_marker("sampled")
        if sampled is not None:
            of = (item.parent, getattr(item, "originalname", item.name))
            every = sampled.kwargs.get("every")
            if seen[of] % every if every else seen[of]:
                item.add_marker(pytest.mark.long)
            seen[of] += 1


@pytest.fixture(scope="session", autouse=True)
def _settings_of_nobody(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep the developer's own settings and what the program keeps out of the tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CONFIG_HOME", str(tmp_path_factory.mktemp("config")))
        patch.setenv("XDG_DATA_HOME", str(tmp_path_factory.mktemp("data")))
        # An engine shares the memory of a test with the window, which may grow more than an engine.
        patch.setattr("rigapp.service.server.GROWTH_BYTES", 1_000_000_000)
        if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
            # As in the background of a shell; every program that a test starts would inherit it.
            signal.signal(signal.SIGINT, signal.default_int_handler)
        yield


@pytest.fixture
def running(request: pytest.FixtureRequest) -> Iterator[Callable[..., Any]]:
    """Start programs in the background by the test module's own ``Running``, and end them all."""
    with ExitStack() as ending:

        def start(*arguments: Any) -> Any:
            one = request.module.Running(*arguments)
            ending.callback(one.close)
            return one

        yield start
