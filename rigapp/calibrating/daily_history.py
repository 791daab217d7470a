"""The store of the daily checks and its control charts: append-only, each line chained.

And the trend of calibrations: sensitivities with their U over the years, as a document.
"""

from __future__ import annotations

import datetime
import hashlib
import json
import math
import time
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path
from typing import Any

import numpy as np

from rigapp.calibrating.certificates.formatting import STYLES, write_page
from rigapp.calibrating.journal import Journal
from rigapp.calibrating.session import Rig
from rigapp.config.errors import UnusableInput
from rigapp.report.page.document import Block, Figure, Manuscript, Section, Table, Text
from rigapp.report.page.figures import WIDTH_IN, canvas_of, in_style, saved
from rigapp.texts import say
from rigapp_calibration.load_cell.as_found import Change, Output, outputs
from rigapp_calibration.load_cell.daily import Chart, ChartFinding, DailyCheck, chart
from rigapp_calibration.records import Record, moment

STORE = "daily-checks.jsonl"
MOST_LINES = 20


@dataclass(frozen=True, slots=True)
class Charted:
    """A charted value of a check: its words, the limit by the calibration; of the zero, N."""

    words: str
    promised: float = 0.0
    of_zero: bool = False


CHARTED: Mapping[str, Charted] = {
    "sensitivity_ratio": Charted("Sensitivity", 1.0),
    "cross_talk_ratio": Charted("Cross-talk"),
    "gain_1_ratio": Charted(say("Gain of axis 1"), 1.0),
    "gain_2_ratio": Charted(say("Gain of axis 2"), 1.0),
    "cross_talk_1_by_2_ratio": Charted(say("Cross-talk of axis 1 by a force along 2")),
    "cross_talk_2_by_1_ratio": Charted(say("Cross-talk of axis 2 by a force along 1")),
    "zero_1_N": Charted(say("Zero of axis 1"), of_zero=True),
    "zero_2_N": Charted(say("Zero of axis 2"), of_zero=True),
}
"""Means over the angles first; older files have only these."""


@dataclass(frozen=True, slots=True)
class DailyHistory:
    """The checks of the calibration in use, oldest first, and their charts by column."""

    entries: tuple[Mapping[str, Any], ...]
    earlier: int
    charts: Mapping[str, Chart]

    @property
    def findings(self) -> tuple[tuple[str, ChartFinding], ...]:
        """Return (name of the chart, finding)."""
        return tuple(
            (CHARTED[name].words, finding)
            for name, chart in self.charts.items()
            for finding in chart.findings
        )

    @property
    def in_control(self) -> bool:
        """Return whether the last check is passed and no rule requires action."""
        passed = bool(self.entries[-1]["passed"])
        return passed and not any(finding.action for _, finding in self.findings)


def entry_of(
    check: DailyCheck,
    rig: Rig,
    *,
    calibration: Mapping[str, Any],
    uncertainty_N: tuple[float, float] | None,
    source: str,
) -> dict[str, Any]:
    """Return the entry of a check in the store; expanded uncertainty as a share of the weight."""
    weight = check.weight
    share = None if uncertainty_N is None else (uncertainty_N[0] + uncertainty_N[1] * weight)
    return {
        "time": round(time.time(), 3),
        "rig": rig.name,
        "simulated": rig.simulated,
        "operator": rig.operator,
        "passed": check.passed,
        "sensitivity_ratio": check.sensitivity,
        "cross_talk_ratio": check.cross_talk,
        "gain_1_ratio": float(check.elements[0, 0]),
        "gain_2_ratio": float(check.elements[1, 1]),
        "cross_talk_1_by_2_ratio": float(check.elements[0, 1]),
        "cross_talk_2_by_1_ratio": float(check.elements[1, 0]),
        "zero_N": check.zero.tolist(),
        "zero_1_N": float(check.zero[0]),
        "zero_2_N": float(check.zero[1]),
        "zero_allowed_N": check.zero_allowed,
        "turned_deg": math.degrees(check.turned),
        "sentence": check.sentence,
        "largest_N": check.largest,
        "allowed_N": check.allowed,
        **decision_rule_keys(check),
        "weight_N": weight,
        "expanded_uncertainty_ratio": None if share is None else share / weight,
        "calibration": _digest(calibration)[:12],
        "source": source,
    }


def decision_rule_keys(check: DailyCheck) -> dict[str, Any]:
    """Return the rule that evaluated a check: U along, across and of the zero, N, and in words."""
    names = ("along", "across", "zero")
    return {
        "expanded_uncertainty_N": dict(zip(names, check.expanded, strict=True)),
        "decision_rule": check.rule,
    }


def append_check(store: Path, entry: Mapping[str, Any]) -> None:
    """Append a check; the same readings count once. Raises UnusableInput."""
    with closing(Journal(store)) as journal:
        events = journal.read()
        previous = _verify(store, events)
        if events and events[-1].get("source") == entry["source"]:
            return
        body = {**entry, "previous": previous}
        journal.append({**body, "digest": _digest(body)})


def read_history(store: Path, rig: str | None = None) -> DailyHistory:
    """Read a store and evaluate the checks since the last change of the calibration.

    rig: only of this rig; None for the one of the last check. Raises UnusableInput.
    """
    events: list[dict[str, Any]] = []
    if store.is_file():
        with closing(Journal(store)) as journal:
            events = journal.read()
    _verify(store, events)
    if not events:
        raise UnusableInput("{}: there are no daily checks yet; take one first.", store)
    wanted = rig or events[-1]["rig"]
    checks = [event for event in events if event["rig"] == wanted]
    if not checks:
        raise UnusableInput("{}: there is no daily check of the rig {}.", store, repr(wanted))
    used = checks[-1]["calibration"]
    entries = tuple(takewhile(lambda event: event["calibration"] == used, reversed(checks)))[::-1]
    return DailyHistory(entries, len(checks) - len(entries), _charts(entries))


def _charts(entries: Sequence[Mapping[str, Any]]) -> dict[str, Chart]:
    """Return the charts of the last check's values; a zero is compared with its allowed range."""
    last = entries[-1]
    charts = {}
    for name, charted in CHARTED.items():
        values = [entry[name] for entry in entries if name in entry]
        if name not in last:
            continue
        if charted.of_zero:
            # A zero follows the temperature: no limits of its history.
            charts[name] = Chart(np.array(values), charted.promised, last["zero_allowed_N"])
        else:
            evaluated = chart(values, charted.promised, last["expanded_uncertainty_ratio"])
            # A level error shows in all of them: the check reports it, the cell is right.
            charts[name] = replace(evaluated, findings=()) if last.get("turned_deg") else evaluated
    return charts


def _verify(store: Path, events: Sequence[Mapping[str, Any]]) -> str:
    """Return the digest of the last line; raise UnusableInput where the chain is broken."""
    previous = ""
    for number, event in enumerate(events, 1):
        body = {key: value for key, value in event.items() if key != "digest"}
        if event.get("previous") != previous or event.get("digest") != _digest(body):
            raise UnusableInput(
                "{}: line {} was changed or a line before it is missing; the store is"
                " append-only. Begin another one, and keep this.",
                store,
                number,
            )
        previous = str(event["digest"])
    return previous


def _digest(body: Mapping[str, Any]) -> str:
    text = json.dumps(body, sort_keys=True, ensure_ascii=False, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def history_result(history: DailyHistory) -> dict[str, Any]:
    """Return the result for ``--json``."""
    return {
        "in_control": history.in_control,
        "earlier_checks": history.earlier,
        "findings": [
            {"chart": name, "code": f.code, "sentence": f.sentence, "action": f.action}
            for name, f in history.findings
        ],
        "checks": [
            {
                key: entry[key]
                for key in ("time", "operator", "passed", *CHARTED, "largest_N")
                if key in entry
            }
            for entry in history.entries
        ],
        "charts": {
            name: {
                "promised": chart.promised,
                "expanded_uncertainty": chart.expanded,
                "centre": chart.centre,
                "standard_deviation": chart.sigma,
                "limits": chart.limits,
            }
            for name, chart in history.charts.items()
        },
    }


def history_lines(history: DailyHistory) -> list[str]:
    """Return the newest checks as a table, and the verdict of the charts."""
    return [
        say("when (UTC)         sensitivity  cross-talk   largest N  verdict  operator"),
        *(
            f"{when(entry)}   {entry['sensitivity_ratio']:10.5f}"
            f"  {entry['cross_talk_ratio']:+10.5f}  {entry['largest_N']:10.2f}"
            f"  {'passed' if entry['passed'] else 'FAILED'}   {entry['operator']}"
            for entry in history.entries[-MOST_LINES:]
        ),
        *verdict_lines(history),
    ]


def verdict_lines(history: DailyHistory) -> list[str]:
    """Return the verdict of the charts, in sentences."""
    count = len(history.entries)
    lines: list[str] = [say("{}: {}", name, finding.sentence) for name, finding in history.findings]
    last = history.entries[-1]
    if not last["passed"]:
        deviation = say("{:.2f} N off, {:.2f} N are allowed.", last["largest_N"], last["allowed_N"])
        lines.insert(0, say("The last check failed: {}", last.get("sentence", deviation)))
    if not lines:
        checks = say("1 check") if count == 1 else say("{} checks", count)
        lines = [say("{} with this calibration: in control.", checks)]
    if rule := last.get("decision_rule"):
        lines.append(str(rule))
    limits = history.charts["sensitivity_ratio"].limits
    if limits is None:
        lines.append(say("From the eighth check on the history has limits of its own."))
    else:
        lines.append(
            say(
                "Limits of the history for the sensitivity: {:.5f} to {:.5f}.", limits[0], limits[1]
            )
        )
    return lines


def when(entry: Mapping[str, Any]) -> str:
    """Return the time of a check, UTC."""
    moment = float(entry["time"])
    return time.strftime("%Y-%m-%d %H:%M", time.gmtime(moment)) if math.isfinite(moment) else "?"


BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "#666666"


def write_chart(history: DailyHistory, to: Path) -> None:
    """Write the charts as .png, .html or .pdf; raise UnusableInput."""
    write_page(
        to, "chart", lambda: chart_document(history), {".png": lambda: draw(history).draw("png")}
    )


def chart_document(history: DailyHistory) -> Manuscript:
    """Compose the page: verdict, charts, table."""
    rows = tuple(
        (
            when(entry),
            f"{entry['sensitivity_ratio']:.5f}",
            f"{entry['cross_talk_ratio']:+.5f}",
            f"{entry['largest_N']:.2f}",
            "passed" if entry["passed"] else "failed",
            str(entry["operator"]),
        )
        for entry in history.entries
    )
    head = ("when (UTC)", "sensitivity", "cross-talk", "largest N", "verdict", "operator")
    words = tuple(Text(line) for line in verdict_lines(history))
    return Manuscript(
        title=f"Daily checks of {history.entries[-1]['rig']}",
        footer="Control chart of the daily checks",
        sections=(
            Section("", words),
            Section("Charts", (draw(history, words[0].text),)),
            Section("Checks", (Table("Checks with the calibration in use", rows, head),)),
        ),
        closing="Sensitivity, gain: felt over applied force. Cross-talk: share felt across the"
        " weight, or by one axis of a force along the other. Zero: less that of the calibration.",
    )


def draw(history: DailyHistory, words: str = "") -> Figure:
    """Return the charts. words: their text alternative."""
    from matplotlib.figure import Figure as Canvas
    from matplotlib.ticker import MaxNLocator

    columns = 2 if len(history.charts) > 2 else 1
    rows = -(-len(history.charts) // columns)
    with in_style():
        canvas = Canvas(figsize=(WIDTH_IN, 2.2 * rows + 0.4), layout="constrained")
    for index, (name, series) in enumerate(history.charts.items(), 1):
        of_zero = CHARTED[name].of_zero
        axes = canvas.add_subplot(rows, columns, index)
        count = np.arange(1, len(series.values) + 1)
        axes.plot(count, series.values, "-o", color=BLUE, ms=4, lw=1, label="checks")
        if series.findings:
            axes.plot(count[-1:], series.values[-1:], "s", color=ORANGE, ms=9, mfc="none",
                      mew=1.8, label="see the words")  # fmt: skip
        axes.axhline(series.promised, color=GREY, lw=1.0)
        if series.expanded is not None:
            words = "allowed" if of_zero else "U of the calibration"
            low, high = series.promised - series.expanded, series.promised + series.expanded
            axes.axhspan(low, high, color=GREY, alpha=0.15, label=words)
        if series.limits is not None:
            for limit in series.limits:
                axes.axhline(limit, color=ORANGE, ls="--", lw=1.0)
            axes.plot([], [], "--", color=ORANGE, label="limits of the history")
        axes.set_title(CHARTED[name].words + (" (N)" if of_zero else ""), fontsize=9, loc="left")
        axes.set_xlabel("check")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.legend(fontsize=6, loc="best")
    return saved(canvas, "Gains, cross-talk and zeros", words)


Item = tuple[str, str, Sequence[tuple[Record, Sequence[Change]]]]
"""Kind, name, and the records, oldest first, each with its as-found changes."""
MOST_TICKS = 6
"""Maximum number of dates below a chart."""


def write_trend(items: Sequence[Item], to: Path) -> None:
    """Write the trend of some items as .pdf or .html; raise UnusableInput."""
    write_page(to, "trend", lambda: trend_document(items))


def trend_document(items: Sequence[Item]) -> Manuscript:
    """Compose the page: of each item its charts, and the as-found changes of each record."""
    return Manuscript(
        title="Trend of calibrations",
        footer="Trend of calibrations",
        sections=tuple(
            Section(f"{kind} {name}".strip(), tuple(_blocks(records)))
            for kind, name, records in items
        ),
        closing="Bars: expanded uncertainty U of the calibration, about 95 %. As found: what the"
        " record before told too much; allowed is the root of the sum of the squares of both U.",
        signatures=(),
    )


def _blocks(records: Sequence[tuple[Record, Sequence[Change]]]) -> list[Block]:
    table = Table(
        "Records",
        tuple(
            (
                str(record.content["calibrated_at"])[:10],
                record.number,
                "; ".join(change.words for change in changes) or "nothing to compare",
            )
            for record, changes in records
        ),
        ("calibrated", "record", "as found"),
    )
    by_record = [(record, outputs(record.kind, record.content["result"])) for record, _ in records]
    names = list(dict.fromkeys(output.what for _, parts in by_record for output in parts))
    if not names:
        return [Text("Records of this kind state no sensitivity with its U: no chart."), table]
    return [*(_chart(name, by_record) for name in names), table]


def _chart(name: str, by_record: Sequence[tuple[Record, Sequence[Output]]]) -> Figure:
    """Return the values of one sensitivity over the dates, with bars of U."""
    points = [(record, part) for record, parts in by_record for part in parts if part.what == name]
    values = [output.value for _, output in points]
    bars = [output.expanded for _, output in points]
    days = [
        datetime.datetime.fromtimestamp(moment(str(record.content["calibrated_at"])), datetime.UTC)
        for record, _ in points
    ]
    colour, marker, _ = STYLES[0]
    with canvas_of(2.3) as canvas:
        axes = canvas.subplots()
    axes.errorbar(days, values, bars, fmt=marker, color=colour, ms=4.0, capsize=3.0, lw=1.2)
    axes.axhline(values[0], color="#000000", lw=0.6, ls=":")
    axes.set_ylabel(points[0][1].unit.replace("um", "µm"))
    axes.set_xlabel("date of calibration")
    axes.set_title(name[:1].upper() + name[1:], loc="left")
    ticks = days if len(days) <= MOST_TICKS else days[:: -(-len(days) // MOST_TICKS)]
    axes.set_xticks(ticks, [day.date().isoformat() for day in ticks])
    change = 100.0 * (values[-1] / values[0] - 1.0)
    words = f"{name}: {len(values)} calibrations, the last {change:+.2g} % from the first."
    return saved(canvas, name[:1].upper() + name[1:], words)
