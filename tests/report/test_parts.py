"""The parts of a report by themselves: decimation, words, the log, the page."""

from __future__ import annotations

import io
import math
import zlib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pypdf import PdfReader
from report_samples import TEST_TEXT, event

from rigapp.presentation.numbers import grouped
from rigapp.presentation.times import duration
from rigapp.report.page.document import (
    Listing,
    Manuscript,
    Section,
    Table,
    Text,
    as_html,
    is_number,
)
from rigapp.report.page.pdf import as_pdf
from rigapp.report.testreport.envelope import BUCKETS, envelope
from rigapp.report.testreport.formatting import flags, number, quantity, settings, size, stamp
from rigapp.report.testreport.logsections import AlarmRecord, alarms_of, limits_of
from rigapp.schema.messages import Event
from rigapp.storage.structure.events import translated


@given(st.integers(0, 6000), st.integers(0, 2**32 - 1))
def test_envelope_keeps_every_extreme_in_few_points(length: int, seed: int) -> None:
    values = np.random.default_rng(seed).normal(size=length)
    if length > 10:
        values[length // 3] = math.nan
    x, y = envelope(np.arange(length), values)
    assert len(x) == len(y) <= max(2 * BUCKETS, length if length <= 2 * BUCKETS else 0)
    assert np.all(np.diff(x) >= 0)
    if length:
        assert np.nanmax(y) == np.nanmax(values)
        assert np.nanmin(y) == np.nanmin(values)


def test_envelope_leaves_a_hole_where_nothing_is_known() -> None:
    values = np.arange(10_000.0)
    values[3000:6000] = math.nan
    x, y = envelope(np.arange(10_000), values)
    hole = np.isnan(y)
    assert hole.any()
    assert 2980 < x[hole].min() < 3020
    assert 5980 < x[hole].max() < 6020


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.421, "0.42 s"), (35.0, "35.0 s"), (99.96, "1 min 40 s"), (7384, "2 h 3 min"),
     (4 * 86400 + 4 * 3600, "4 d 4 h"), (math.nan, "–")],
)  # fmt: skip
def test_durations(seconds: float, words: str) -> None:
    assert duration(seconds, exact=True) == words


def test_numbers_have_sensible_digits() -> None:
    assert quantity(87.9199, "N") == "87.9 N"
    assert quantity(-0.0001, "um") == "0.0 µm"
    assert number(math.inf, "N") == "unknown"
    assert grouped(9999) == "9\u202f999"
    assert grouped(1234567) == "1\u202f234\u202f567"
    assert size(21_852_160) == "21.9 MB (21\u202f852\u202f160 bytes)"
    assert size(12) == "12 bytes"
    assert stamp("") == "unknown"
    assert stamp("2026-11-21T14:14:57.188823+01:00") == "2026-11-21 13:14:57 UTC"


def test_flags_and_settings_in_words() -> None:
    assert flags(0) == ""
    assert flags(1 | 8).count(";") == 1
    rows = settings({"joint": {"pin_radius_mm": 9.5}, "latency_ms": [1.0, 2.5], "record": ""})
    assert rows == [("joint, pin radius", "9.5 mm"), ("latency", "1, 2.5 ms"), ("record", "none")]
    assert settings({"top": 8388608.0, "gain": 0.123456789}) == [
        ("top", "8388608"), ("gain", "0.123457"),
    ]  # fmt: skip


def older_alarms(events: list[Event], reason: str) -> list[AlarmRecord]:
    return alarms_of(translated(events), reason)


def test_first_out_is_the_alarm_that_the_reason_names() -> None:
    def told(title: str, what: str, cause: str, source: str = "engine") -> Event:
        return event(1, "alarm", source, f"{title}: {what}. {cause}")

    cause = "The joint force reached 391.0 N; the limit is 380 N."
    found = older_alarms(
        [
            told("Samples lost", "raised", "3 samples of daq were lost in all."),
            told("Samples lost", "shelved for 600 s: known. cable", "3 samples were lost.", "Ann"),
            told("Overload", "raised", cause),
            told("No data", "raised", "daq on COM1 has sent no samples for 2.1 s."),
            told("Samples lost", "cleared", "3 samples of daq were lost in all."),
        ],
        f"{cause} Then: the drive did not answer.",
    )
    assert [(one.title, one.first_out) for one in found] == [
        ("Samples lost", False), ("Overload", True), ("No data", False),
    ]  # fmt: skip
    assert found[0].cleared_at is not None
    assert "shelved for 600 s" in found[0].acknowledged
    assert not any(one.first_out for one in older_alarms([told("Overload", "raised", cause)], ""))


def test_the_log_says_what_was_first_out() -> None:
    cause = "The joint force reached 391.0 N; the limit is 380 N."
    found = older_alarms(
        [
            event(1, "alarm", "engine", "Drive silent: raised, first out. No answer in 0.3 s."),
            event(1, "alarm", "engine", f"Overload: raised. {cause}"),
        ],
        cause,
    )
    assert [one.first_out for one in found] == [True, False]


def test_limits_that_are_not_given_are_the_defaults() -> None:
    found = {one.name: one for one in limits_of("[run]\nrevolutions = 3\n", [])}
    assert found["overload_N"].start == 380.0
    added = event(5, "limit_changed", "Ann", "limit force_max.warning_below changed", "none", "30")
    rules = {one.name: one for one in limits_of(TEST_TEXT, translated([added]))}
    assert math.isnan(rules["force_max.warning_below"].start)
    assert rules["force_max.warning_below"].now == 30.0
    assert limits_of("no = [toml", []) == []


@pytest.mark.parametrize("text", ["1", "-0.35", "35.0 s", "1\u202f000", "–", "unknown", "7*"])
def test_cells_with_numbers(text: str) -> None:
    assert is_number(text)
    assert not is_number("revolution 7")


def test_long_content_is_set_on_numbered_pages() -> None:
    rows = tuple((str(i), "word " * 60, "x" * 300) for i in range(80))
    document = Manuscript(
        "A <title> & more",
        "footer " * 40,
        (
            Section("Table", (Table("wide", rows, ("number", "text", "unbroken")),)),
            Section("Listing", (Listing("file", "a = '" + "y" * 500 + "'\n" * 200),)),
            Section("Taller than a page", (Table("", (("note", "long " * 3000),), ("a", "b")),)),
            Section("Empty", (Table("none", (), ("a", "b")), Text("ü Ω 中", strong=True))),
        ),
    )
    data = as_pdf(document)
    pages = PdfReader(io.BytesIO(data)).pages
    assert len(pages) > 8
    assert f"page {len(pages)} of {len(pages)}" in pages[-1].extract_text()
    text = pages[-1].extract_text()
    assert "ü Ω 中" in text or "ü Ω \ufffd" in text, "as the computer's fonts have it"
    assert as_pdf(document) == data
    assert zlib.crc32(as_html(document)) == zlib.crc32(as_html(document))
    assert b"A &lt;title&gt; &amp; more" in as_html(document)
