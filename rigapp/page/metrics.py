"""Every rig as Prometheus metrics, in a separate registry.

Numbers are collected at a request, from the newest views of the watching thread: a scrape reaches
no engine. A rig whose engine does not answer has only ``rigapp_up`` 0 and its silence.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from prometheus_client import CollectorRegistry, ProcessCollector, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.registry import Collector

from rigapp.page.view import RigView
from rigapp.schema.messages import RunState, Severity
from rigapp.viewer.knownwear import COEFFICIENT, REMAINING

M_PER_MM = 1e-3
Samples = list[tuple[dict[str, str], float]]


@dataclass(frozen=True, slots=True)
class RigMetric:
    """A metric of a rig: its name, its meaning, its samples by their labels besides ``rig``.

    silent: also for a rig whose engine does not answer.
    """

    name: str
    words: str
    samples: Callable[[RigView], Samples]
    labels: tuple[str, ...] = ()
    counter: bool = False
    silent: bool = False


def _one(pick: Callable[[RigView], float | None]) -> Callable[[RigView], Samples]:
    def samples(view: RigView) -> Samples:
        value = pick(view)
        return [] if value is None or math.isnan(value) else [({}, float(value))]

    return samples


def _column(column: str, scale: float = 1.0) -> Callable[[RigView], Samples]:
    return _one(lambda view: scale * view.values.get(column, math.nan))


def _statistics(stem: str) -> Callable[[RigView], Samples]:
    def samples(view: RigView) -> Samples:
        return [
            ({"statistic": statistic}, view.values[f"{stem}_{statistic}"])
            for statistic in ("max", "min", "rms", "mean")
            if f"{stem}_{statistic}" in view.values
        ]

    return samples


def _with_limits(stem: str) -> Callable[[RigView], Samples]:
    def samples(view: RigView) -> Samples:
        names = (("estimate", stem), ("low", f"{stem}_low"), ("high", f"{stem}_high"))
        return [({"bound": word}, view.wear[name]) for word, name in names if name in view.wear]

    return samples


def _process(pick: str) -> Callable[[RigView], Samples]:
    return _one(lambda view: getattr(view.process, pick) if view.process is not None else None)


def _states(view: RigView) -> Samples:
    return [({"state": state.value}, float(view.state == state.value)) for state in RunState]


def _limits_used(view: RigView) -> Samples:
    # Of two levels of one limit only the next one is there, so each limit is there once.
    return [
        (
            {
                "quantity": limit.title,
                "action": limit.action,
                "limit": f"{limit.limit:g} {limit.unit}",
            },
            limit.used,
        )
        for limit in view.limits
    ]


def _alarms(view: RigView) -> Samples:
    return [
        (
            {"severity": severity.value, "acknowledged": word},
            float(
                sum(
                    alarm.severity is severity and alarm.acknowledged is seen and alarm.active
                    for alarm in view.alarms
                )
            ),
        )
        for severity in Severity
        for word, seen in (("yes", True), ("no", False))
    ]


def _devices(pick: str) -> Callable[[RigView], Samples]:
    return lambda view: [
        ({"device": device.name}, float(getattr(device, pick))) for device in view.devices
    ]


RIG_METRICS = (
    RigMetric(
        "rigapp_up", "1 while the engine speaks", _one(lambda v: float(v.attached)), silent=True
    ),
    RigMetric(
        "rigapp_silence_seconds",
        "time since the engine's last word",
        _one(lambda v: v.silence_s),
        silent=True,
    ),
    RigMetric(
        "rigapp_engine_restarts_total",
        "how often another engine came in place of the one before",
        _one(lambda v: v.restarts),
        counter=True,
        silent=True,
    ),
    RigMetric("rigapp_state", "1 for the state of the run", _states, ("state",)),
    RigMetric("rigapp_revolution", "number of the newest revolution", _one(lambda v: v.revolution)),
    RigMetric("rigapp_revolutions_planned", "planned revolutions", _one(lambda v: v.planned)),
    RigMetric(
        "rigapp_rows_committed", "rows safe in the file of the test", _one(lambda v: v.committed)
    ),
    RigMetric(
        "rigapp_rows_dropped_total",
        "rows that were not sent to viewers in time; the file has them",
        _one(lambda v: v.rows_dropped),
        counter=True,
    ),
    RigMetric("rigapp_data_age_seconds", "age of the newest sample", _one(lambda v: v.data_age_s)),
    RigMetric(
        "rigapp_prediction_age_seconds", "age of the prediction", _one(lambda v: v.twin_age_s)
    ),
    RigMetric(
        "rigapp_speed_rpm", "speed of the crank, revolutions a minute", _one(lambda v: v.speed_rpm)
    ),
    RigMetric("rigapp_target_speed_rpm", "speed that is wanted", _one(lambda v: v.target_rpm)),
    RigMetric(
        "rigapp_planned_end_timestamp_seconds",
        "when the planned revolutions are done, UTC",
        _one(lambda v: v.expected_end_at or None),
    ),
    RigMetric(
        "rigapp_smallest_margin_percent",
        "distance of the newest revolution to the nearest limit",
        _one(lambda v: v.worst_margin_percent),
    ),
    RigMetric(
        "rigapp_limit_used_ratio",
        "how much of the way to a limit is used, 1 at the limit",
        _limits_used,
        ("quantity", "action", "limit"),
    ),
    RigMetric(
        "rigapp_force_newtons",
        "size of the joint's force over the newest revolution",
        _statistics("force"),
        ("statistic",),
    ),
    RigMetric("rigapp_residual_newtons", "RMS of measured less predicted", _column("residual_rms")),
    RigMetric(
        "rigapp_wear_depth_metres",
        "wear depth from the probes",
        _column("measured_wear_depth", M_PER_MM),
    ),
    RigMetric(
        "rigapp_wear_depth_uncertainty_metres",
        "its expanded uncertainty (k = 2)",
        _column("measured_wear_depth_uncertainty", M_PER_MM),
    ),
    RigMetric(
        "rigapp_model_wear_depth_metres", "wear depth by the model", _column("wear_depth", M_PER_MM)
    ),
    RigMetric(
        "rigapp_wear_coefficient_mm3_per_newton_metre",
        "wear coefficient with its 95 % limits",
        _with_limits(COEFFICIENT),
        ("bound",),
    ),
    RigMetric(
        "rigapp_remaining_revolutions",
        "revolutions until the final wear depth with their 95 % limits",
        _with_limits(REMAINING),
        ("bound",),
    ),
    RigMetric("rigapp_alarms", "active alarms", _alarms, ("severity", "acknowledged")),
    RigMetric("rigapp_device_connected", "1 while connected", _devices("connected"), ("device",)),
    RigMetric(
        "rigapp_device_lost_samples_total",
        "samples lost since the connection",
        _devices("lost_samples"),
        ("device",),
        counter=True,
    ),
    RigMetric(
        "rigapp_device_errors_total",
        "errors of the device since the connection",
        _devices("errors"),
        ("device",),
        counter=True,
    ),
    RigMetric(
        "rigapp_disk_free_bytes", "room on the file's disk", _one(lambda v: v.disk_free_bytes)
    ),
    RigMetric("rigapp_disk_size_bytes", "size of that disk", _one(lambda v: v.disk_total_bytes)),
    RigMetric(
        "rigapp_engine_cpu_seconds_total",
        "processor time of the engine",
        _process("cpu_seconds"),
        counter=True,
    ),
    RigMetric(
        "rigapp_engine_resident_memory_bytes",
        "memory of the engine",
        _process("resident_memory_bytes"),
    ),
    RigMetric("rigapp_engine_threads", "threads of the engine", _process("threads")),
    RigMetric(
        "rigapp_engine_start_timestamp_seconds",
        "when the engine began, UTC",
        _process("started_at"),
    ),
)
"""Every metric of a rig; each has the label ``rig``."""


@dataclass(frozen=True, slots=True)
class PageNumbers:
    """State of the page itself: open pages, connections, connections dropped as too slow."""

    readers: int
    connections: int
    dropped: int


class Metrics(Collector):
    """The metrics of the rigs, the page and its process, made at a request."""

    def __init__(
        self, views: Callable[[], Sequence[RigView]], page: Callable[[], PageNumbers]
    ) -> None:
        self._views, self._page = views, page
        self._registry = CollectorRegistry(auto_describe=False)
        self._registry.register(self)
        ProcessCollector(registry=self._registry)

    def text(self) -> bytes:
        """Return all of them as Prometheus reads them."""
        return generate_latest(self._registry)

    def collect(self) -> Iterator[Metric]:
        """Yield every metric with a sample."""
        views = self._views()
        rigs = _apart(views)
        for metric in RIG_METRICS:
            kind = CounterMetricFamily if metric.counter else GaugeMetricFamily
            family = kind(metric.name, metric.words, labels=("rig", *metric.labels))
            for view in views:
                for labels, value in metric.samples(view) if view.attached or metric.silent else ():
                    values = [rigs[view.identity], *(labels[name] for name in metric.labels)]
                    family.add_metric(values, value)
            if family.samples:
                yield family
        page = self._page()
        yield GaugeMetricFamily("rigapp_page_readers", "pages that are open", page.readers)
        yield GaugeMetricFamily("rigapp_page_connections", "open connections", page.connections)
        dropped = "connections dropped as too slow, or too many"
        yield CounterMetricFamily("rigapp_page_dropped_total", dropped, page.dropped)


def _apart(views: Sequence[RigView]) -> dict[str, str]:
    """Return the names of rigs by identity; equal names are made distinct by it."""
    times = Counter(view.name for view in views)
    return {
        view.identity: view.name if times[view.name] == 1 else f"{view.name} ({view.identity})"
        for view in views
    }
