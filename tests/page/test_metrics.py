"""The metrics: as Prometheus reads them, units in their names; what the examples name exists."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import pytest
from page.doubles import OpenPage, ServedEngine
from prometheus_client.parser import text_string_to_metric_families
from snapshots import ALARM

from rigapp.page.metrics import RIG_METRICS, Metrics, PageNumbers
from rigapp.page.view import LimitView, ProcessView, RigView
from rigapp.schema.columns import identified_columns
from rigapp.schema.messages import DeviceView, RunState

TOP = Path(__file__).parents[2]
MONITORING = TOP / "examples" / "monitoring"
UNITS = (
    "seconds", "rpm", "percent", "ratio", "newtons", "metres", "mm3_per_newton_metre", "bytes",
    "total",
)  # fmt: skip
COUNTED = re.compile(
    r"_(up|state|revolution|revolutions|planned|committed|alarms|connected|threads)$"
)


def a_view(**changes: object) -> RigView:
    """Return a view of which everything is known."""
    known = {one.name: 1.0 for one in identified_columns()}
    view = RigView(
        "rig1", "left", "attached", "", 2, 1.8e9, 0.1, "",
        state="running", revolution=1234, planned=20000, committed=1233, rows_dropped=3,
        speed_rpm=30.0, target_rpm=30.0, expected_end_at=1.9e9, data_age_s=0.1, twin_age_s=0.5,
        worst_margin_percent=43.0,
        values={
            "force_max": 97.0, "force_min": 26.0, "force_rms": 71.0, "force_mean": 65.0,
            "residual_rms": 1.7, "measured_wear_depth": 0.021, "wear_depth": 0.02,
            "measured_wear_depth_uncertainty": 0.001,
        },
        wear=known,
        limits=(LimitView("Speed", 30.0, 90.0, "rpm", "drive off", 0.33, False, ""),),
        alarms=(ALARM,),
        devices=(DeviceView("daq", "gsv8", "", True, "", lost_samples=7),),
        disk_free_bytes=10, disk_total_bytes=20,
        process=ProcessView(4711, 12.5, 10_000_000, 17, 1.7e9),
    )  # fmt: skip
    return msgspec.structs.replace(view, **changes)


def scraped(*views: RigView) -> dict[tuple[str, tuple[tuple[str, str], ...]], float]:
    """Return the samples of a scrape by name and labels."""
    text = Metrics(lambda: views, lambda: PageNumbers(3, 4, 5)).text().decode()
    return {
        (sample.name, tuple(sorted(sample.labels.items()))): sample.value
        for family in text_string_to_metric_families(text)
        for sample in family.samples
    }


def names(samples: dict[tuple[str, tuple[tuple[str, str], ...]], float]) -> set[str]:
    return {name for name, _ in samples}


def test_every_metric_is_told_where_everything_is_known() -> None:
    found = names(scraped(a_view()))
    assert {one.name for one in RIG_METRICS} <= found
    assert {"rigapp_page_readers", "process_resident_memory_bytes"} <= found


def test_values_are_those_of_the_rig_in_the_units_of_their_names() -> None:
    found = scraped(a_view())
    rig = ("rig", "left")
    assert found["rigapp_wear_depth_metres", (rig,)] == pytest.approx(21e-6)
    assert found["rigapp_state", (rig, ("state", "running"))] == 1.0
    assert sum(found["rigapp_state", (rig, ("state", one.value))] for one in RunState) == 1.0
    assert found["rigapp_force_newtons", (rig, ("statistic", "max"))] == 97.0
    alarms = ("rigapp_alarms", (("acknowledged", "no"), rig, ("severity", "warning")))
    assert found[alarms] == 1.0
    assert found["rigapp_device_lost_samples_total", (("device", "daq"), rig)] == 7.0
    assert found["rigapp_engine_cpu_seconds_total", (rig,)] == 12.5


def test_of_a_silent_engine_nothing_old_is_told() -> None:
    found = scraped(a_view(line="lost", silence_s=60.0))
    of_rig = {name for name, labels in found if ("rig", "left") in labels}
    assert of_rig == {one.name for one in RIG_METRICS if one.silent}
    assert found["rigapp_up", (("rig", "left"),)] == 0.0
    assert found["rigapp_silence_seconds", (("rig", "left"),)] == 60.0


def test_what_is_not_known_is_left_out() -> None:
    found = names(scraped(a_view(values={}, wear={}, process=None, disk_free_bytes=None)))
    assert "rigapp_wear_depth_metres" not in found
    assert "rigapp_engine_threads" not in found
    assert "rigapp_disk_free_bytes" not in found


def test_two_rigs_are_told_apart_by_their_name() -> None:
    found = scraped(a_view(), a_view(identity="rig2", name='the "other"\n'))
    assert ("rigapp_up", (("rig", 'the "other"\n'),)) in found
    same = scraped(a_view(), a_view(identity="rig2"))
    named = {dict(labels)["rig"] for name, labels in same if name == "rigapp_up"}
    assert named == {"left (rig1)", "left (rig2)"}


@pytest.mark.parametrize("told", RIG_METRICS, ids=lambda one: one.name)
def test_a_name_ends_with_its_unit_or_is_a_count(told: object) -> None:
    name = told.name  # type: ignore[attr-defined]
    assert name.endswith(UNITS) or COUNTED.search(name)


def test_a_scrape_of_a_page_is_what_prometheus_reads(
    rig: Path, serve: Callable[..., ServedEngine], show: Callable[..., OpenPage]
) -> None:
    engine = serve(rig)
    page = show([rig])
    page.sees(lambda rigs: rigs and rigs[0]["line"] == "attached", "the engine speaks")
    status, headers, text = page.get("/metrics")
    assert status == 200
    assert headers["content-type"].startswith("text/plain; version=")
    families = {family.name: family for family in text_string_to_metric_families(text)}
    assert families["rigapp_rows_committed"].samples[0].value == 1233.0
    assert families["rigapp_engine_threads"].samples[0].value >= 1.0
    assert engine.requests == []


def metrics_of(expression: str) -> Iterator[str]:
    """Yield the names of metrics in an expression of PromQL: what is no word of the language."""
    bare = re.sub(r"\{[^}]*\}|\[[^]]*\]|\b(?:by|on|ignoring|without)\s*\([^)]*\)", " ", expression)
    for name in re.findall(r"\b[a-z][a-z0-9_]*\b(?!\s*\()", bare):
        if name not in {"and", "or", "unless", "e9"}:
            yield name


def expressions() -> list[tuple[str, str]]:
    """Return every expression of the examples with where it stands."""
    board = json.loads((MONITORING / "grafana-dashboard.json").read_text("utf-8"))
    found = [
        (panel["title"], target["expr"]) for panel in board["panels"] for target in panel["targets"]
    ]
    rules = (MONITORING / "alert-rules.yml").read_text("utf-8")
    return found + re.findall(r"alert: (\w+)\n\s+expr: (.+)", rules)


def test_every_metric_that_the_examples_name_exists() -> None:
    there = names(scraped(a_view())) | {"up"}
    asked = expressions()
    assert len(asked) > 30
    assert [
        (where, name) for where, one in asked for name in metrics_of(one) if name not in there
    ] == []


def test_the_alert_rules_say_whom_they_are_about() -> None:
    rules = (MONITORING / "alert-rules.yml").read_text("utf-8")
    assert rules.count("- alert:") == rules.count("severity: critical}") + rules.count(
        "severity: warning}"
    )
    assert rules.count("- alert:") == rules.count("annotations: {summary:")


def test_the_guide_lists_every_metric() -> None:
    guide = (TOP / "docs" / "page.md").read_text("utf-8")
    assert [one.name for one in RIG_METRICS if f"`{one.name}`" not in guide] == []
