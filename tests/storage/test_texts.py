"""All that a file says can be asked for; an ended test does not say on which computer it ran."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import h5py
import pytest
from storage_samples import new_test, write

from rigapp.storage import open_test, reopen_test


def texts(path: Path) -> dict[str, str]:
    with open_test(path) as test:
        return dict(test.texts())


def test_texts_of_datasets_and_attributes_come_with_their_place(quick_folder: Path) -> None:
    with new_test(quick_folder) as writer:
        write(writer, 1, 3)
        writer.finish("complete", "complete", "done")
    path = quick_folder / "test.h5"
    with h5py.File(path, "r+") as file:
        file["/entry/instrument/list"] = ["one", "two", "one"]
        file["/entry/instrument"].attrs["made by"] = "hand"
        expected = file["/entry/configuration/test"][()].decode()
    found = texts(path)
    assert found["/entry/configuration/test"] == expected
    assert found["/entry/instrument@made by"] == "hand"
    assert found["/entry/state/reason"] == "done"
    assert found["/@NX_class"] == "NXroot"
    with open_test(path) as test:
        several = [text for place, text in test.texts() if place == "/entry/instrument/list"]
    assert several == ["one", "two"]
    assert not any(place.startswith("/entry/events/") for place in found)
    assert "" not in found.values()


def test_the_computer_is_named_while_the_test_is_written_and_no_longer(
    quick_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(socket, "gethostname", lambda: "lab7")
    path, place = quick_folder / "test.h5", "/entry/state/writer"
    with new_test(quick_folder) as writer:
        write(writer, 1, 3)
        assert texts(path)[place] == f"process {os.getpid()} on lab7"
        writer.finish("stopped", "operator", "stop button")
    assert texts(path)[place] == f"process {os.getpid()}"
    with reopen_test(path) as writer:
        assert texts(path)[place].endswith("on lab7")
        writer.finish("stopped", "operator", "stop button")
    assert "lab7" not in path.read_bytes().decode("latin-1")
