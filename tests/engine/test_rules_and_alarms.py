"""Rules, alarms, schedule, states: the pure parts of the engine's judgement."""

from __future__ import annotations

import itertools
import math
from collections import Counter

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from rigapp.config.errors import UnusableInput
from rigapp.config.recipe import CyclesSection, LimitRule, LimitsSection
from rigapp.engine.judging.alarms import AlarmBook
from rigapp.engine.judging.limits import RuleMonitor, changed_limits, check_rules
from rigapp.engine.recording.history import Schedule, logarithmic
from rigapp.schema.alarms import make_alarm
from rigapp.schema.channels import BASE
from rigapp.schema.loglines import AlarmChange
from rigapp.schema.messages import Alarm, FinishReason, RunState, Severity
from rigapp.schema.states import ACTIVE, ENDED, TABLE, Ending, Refused, Trigger, allowed, transition

# --- rules ---------------------------------------------------------------------------------------


def judged(rule: LimitRule, values: list[float]) -> list[tuple[int, bool, str]]:
    monitor = RuleMonitor((rule,))
    return [
        (i, verdict.active, verdict.cause.kind.severity.value)
        for i, value in enumerate(values)
        for verdict in monitor.judge({rule.quantity: value})
    ]


def test_a_level_is_passed_after_the_delay_and_left_below_the_hysteresis() -> None:
    rule = LimitRule("force_max", critical_above=100.0, hysteresis=10.0, delay_revolutions=3)
    values = [101.0, 101, 99, 101, 101, 101, 101, 95, 91, 89, 101]
    assert judged(rule, values) == [(5, True, "critical"), (9, False, "critical")]


def test_levels_below_work_the_other_way_round() -> None:
    rule = LimitRule("speed", warning_below=28.0, critical_below=25.0)
    assert judged(rule, [30.0, 27, 24, 26, 30]) == [
        (1, True, "warning"),
        (2, True, "critical"),
        (3, False, "critical"),
        (4, False, "warning"),
    ]


def test_a_value_that_is_no_number_or_missing_changes_nothing() -> None:
    rule = LimitRule("force_max", critical_above=100.0)
    assert judged(rule, [float("nan"), 101.0, float("nan")]) == [(1, True, "critical")]
    assert RuleMonitor((rule,)).judge({"speed": 3.0}) == []


@given(st.lists(st.floats(0, 200), max_size=60), st.integers(1, 4), st.floats(0, 20))
def test_verdicts_alternate(values: list[float], delay: int, hysteresis: float) -> None:
    rule = LimitRule(
        "force_max", critical_above=100.0, hysteresis=hysteresis, delay_revolutions=delay
    )
    found = judged(rule, values)
    assert [active for _, active, _ in found] == [i % 2 == 0 for i in range(len(found))]
    for i, active, _ in found:
        assert (values[i] > 100.0) == active


@pytest.mark.parametrize(
    ("rule", "words"),
    [
        (LimitRule("force_maxx", critical_above=1.0), "did you mean force_max"),
        (LimitRule("force_max"), "no level"),
        (LimitRule("force_max", warning_above=5.0, critical_above=5.0), "beyond warning_above"),
        (LimitRule("force_max", warning_below=5.0, critical_below=6.0), "beyond warning_below"),
        (LimitRule("force_max", critical_above=5.0, critical_below=6.0), "no value lies"),
        (LimitRule("force_max", critical_above=float("nan")), "not a finite number"),
        (LimitRule("force_max", critical_above=5.0, hysteresis=-1.0), "hysteresis"),
        (LimitRule("revolution", critical_above=5.0), "no such quantity"),
    ],
)
def test_a_rule_that_makes_no_sense_is_refused(rule: LimitRule, words: str) -> None:
    with pytest.raises(UnusableInput, match=words):
        check_rules((rule,), BASE)


def test_the_worst_margin_names_its_level() -> None:
    monitor = RuleMonitor(
        (
            LimitRule("force_max", warning_above=100.0),
            LimitRule("speed", critical_below=20.0),
        )
    )
    margin, name = monitor.worst_margin({"force_max": 90.0, "speed": 30.0})
    assert (margin, name) == (pytest.approx(10.0), "force_max warning above")
    margin, name = monitor.worst_margin({"force_max": 50.0, "speed": 21.0})
    assert (margin, name) == (pytest.approx(5.0), "speed critical below")


def test_a_changed_rule_keeps_what_its_level_has_seen() -> None:
    monitor = RuleMonitor((LimitRule("force_max", critical_above=100.0),))
    assert len(monitor.judge({"force_max": 101.0})) == 1
    monitor.replace((LimitRule("force_max", critical_above=90.0),))
    assert monitor.judge({"force_max": 95.0}) == []
    assert monitor.judge({"force_max": 80.0})[0].active is False


def test_one_limit_is_changed_at_a_time() -> None:
    limits = LimitsSection(rule=(LimitRule("force_max", warning_above=10.0, critical_above=20.0),))
    before, after = changed_limits(limits, "force_max.warning_above", 12.0)
    assert (before, after.rule[0].warning_above, after.rule[0].critical_above) == (10.0, 12.0, 20.0)
    before, after = changed_limits(limits, "overload_N", 300.0)
    assert (before, after.overload_N, after.rule) == (380.0, 300.0, limits.rule)
    for name, value in (("overlod_N", 1.0), ("overload_N", -1.0), ("overload_N", float("nan"))):
        with pytest.raises(UnusableInput, match=name):
            changed_limits(limits, name, value)


@pytest.mark.parametrize("name", ["overload_N", "overspeed_rpm", "stale_data_s"])
@pytest.mark.parametrize("value", [1e300, math.inf, math.nan, True, 0.0, 10**400])
def test_a_limit_cannot_be_switched_off_in_a_running_test(name: str, value: float) -> None:
    limits = LimitsSection(rule=(LimitRule("force_max", critical_above=20.0),))
    with pytest.raises(UnusableInput, match=rf"limits\.{name} = .* (allowed is|outside) "):
        changed_limits(limits, name, value)
    if value:
        with pytest.raises(UnusableInput, match=r"force_max\.critical_above = .* to 10000 N"):
            changed_limits(limits, "force_max.critical_above", value)


# --- alarms --------------------------------------------------------------------------------------

WARNING = make_alarm("count_mismatch", revolution=3)
CRITICAL = make_alarm("overload", force_N=400.0, limit_N=380.0)


class NotificationState:
    """An alarm book with a clock in hand."""

    def __init__(self) -> None:
        self.now = 1000.0
        self.changes: list[tuple[str, str, str]] = []
        self.book = AlarmBook(lambda: self.now, self.changed)

    def changed(self, alarm: Alarm, change: AlarmChange, who: str) -> None:
        self.changes.append((alarm.key, change.words, who))

    def states(self) -> dict[str, str]:
        return {alarm.key: alarm.state for alarm in self.book.alarms()}


def test_an_alarm_goes_its_way_through_the_states() -> None:
    one = NotificationState()
    assert one.book.raise_alarm(WARNING, 3)
    assert not one.book.raise_alarm(WARNING, 4)
    assert one.states() == {"count_mismatch": "unacknowledged"}
    one.book.acknowledge("count_mismatch", "Ada")
    assert one.states() == {"count_mismatch": "acknowledged"}
    one.book.clear("count_mismatch")
    assert one.states() == {}
    one.book.raise_alarm(WARNING)
    one.book.clear("count_mismatch")
    assert one.states() == {"count_mismatch": "returned"}
    one.book.acknowledge("count_mismatch", "Ada")
    assert one.states() == {}
    assert ("count_mismatch", "acknowledged", "Ada") in one.changes


def test_a_critical_alarm_stays_until_it_is_acknowledged_and_reset() -> None:
    one = NotificationState()
    one.book.raise_alarm(CRITICAL)
    assert one.book.blocking() is not None
    with pytest.raises(Refused, match="still active"):
        one.book.reset("Ada")
    one.book.clear("overload")
    assert one.states() == {"overload": "latched"}
    with pytest.raises(Refused, match="not acknowledged"):
        one.book.reset("Ada")
    one.book.acknowledge("overload", "Ada")
    assert one.states() == {"overload": "latched"}
    one.book.reset("Ada")
    assert one.states() == {}
    assert one.book.blocking() is None


def test_the_first_critical_alarm_is_marked_until_the_reset() -> None:
    one = NotificationState()
    one.book.raise_alarm(WARNING)
    one.book.raise_alarm(CRITICAL)
    one.book.raise_alarm(make_alarm("overspeed", by="encoder", speed_rpm=60.0, limit_rpm=45.0))
    assert [a.key for a in one.book.alarms() if a.first_out] == ["overload"]
    for key in ("overload", "overspeed"):
        one.book.clear(key)
        one.book.acknowledge(key, "Ada")
    one.book.reset("Ada")
    one.book.raise_alarm(make_alarm("overspeed", by="encoder", speed_rpm=60.0, limit_rpm=45.0))
    assert [a.key for a in one.book.alarms() if a.first_out] == ["overspeed"]


def test_shelving_needs_a_reason_and_ends_by_itself() -> None:
    one = NotificationState()
    one.book.raise_alarm(WARNING)
    with pytest.raises(Refused, match="reason"):
        one.book.shelve("count_mismatch", " ", 60.0, "Ada")
    with pytest.raises(Refused, match="at most 12 h"):
        one.book.shelve("count_mismatch", "known", 1e6, "Ada")
    one.book.shelve("count_mismatch", "known, cable ordered", 60.0, "Ada")
    assert one.states() == {"count_mismatch": "shelved"}
    one.book.clear("count_mismatch")
    one.book.raise_alarm(WARNING)
    assert one.states() == {"count_mismatch": "shelved"}
    one.now += 61.0
    assert one.states() == {"count_mismatch": "unacknowledged"}


def test_the_first_out_alarm_stays_it_when_it_comes_again() -> None:
    one = NotificationState()
    one.book.raise_alarm(CRITICAL)
    one.book.raise_alarm(make_alarm("overspeed", by="encoder", speed_rpm=60.0, limit_rpm=45.0))
    one.book.clear("overload")
    one.book.raise_alarm(CRITICAL)
    assert [a.key for a in one.book.alarms() if a.first_out] == ["overload"]
    told = [what for key, what, _ in one.changes if key == "overload"]
    assert told == ["raised, first out", "cleared", "raised"]


def test_what_ends_a_test_is_first_out_though_another_alarm_is_raised_before_it() -> None:
    one = NotificationState()
    one.book.claim_first_out(CRITICAL)
    one.book.raise_alarm(make_alarm("overspeed", by="encoder", speed_rpm=60.0, limit_rpm=45.0))
    one.book.raise_alarm(CRITICAL)
    assert [a.key for a in one.book.alarms() if a.first_out] == ["overload"]
    one.book.claim_first_out(make_alarm("overspeed", by="encoder", speed_rpm=60.0, limit_rpm=45.0))
    assert [a.key for a in one.book.alarms() if a.first_out] == ["overload"]


def test_the_end_of_shelving_is_told() -> None:
    one = NotificationState()
    one.book.raise_alarm(WARNING)
    one.book.shelve("count_mismatch", "known", 60.0, "Ada")
    one.book.look()
    one.now += 60.0
    one.book.look()
    one.book.look()
    assert [what for _, what, _ in one.changes][1:] == [
        "shelved for 60 s: known", "no longer shelved",
    ]  # fmt: skip


KEYS = {
    "count_mismatch": WARNING,
    "overload": CRITICAL,
    "overspeed": make_alarm("overspeed", by="encoder", speed_rpm=60.0, limit_rpm=45.0),
}


class Isa(RuleBasedStateMachine):
    """The states of ISA-18.2 told a second time, as sets of keys."""

    def __init__(self) -> None:
        super().__init__()
        self.one = NotificationState()
        self.active: set[str] = set()
        self.unacknowledged: set[str] = set()
        self.latched: set[str] = set()
        self.listed: set[str] = set()
        self.shelved: dict[str, float] = {}
        self.first_out = ""

    def settle(self) -> None:
        """Leave on the list what holds, is not acknowledged, is latched or shelved."""
        self.listed = self.active | self.unacknowledged | self.latched | set(self.shelved)

    @rule(key=st.sampled_from(sorted(KEYS)))
    def it_is_raised(self, key: str) -> None:
        new = self.one.book.raise_alarm(KEYS[key])
        assert new == (key not in self.active)
        if new:
            self.unacknowledged.add(key)
        self.active.add(key)
        if KEYS[key].kind.latched:
            self.latched.add(key)
            self.first_out = self.first_out or key
        self.settle()

    @rule(key=st.sampled_from(sorted(KEYS)))
    def it_clears(self, key: str) -> None:
        self.one.book.clear(key)
        self.active.discard(key)
        self.settle()

    @rule(key=st.sampled_from(sorted(KEYS)))
    def it_is_acknowledged(self, key: str) -> None:
        if key not in self.listed:
            with pytest.raises(Refused, match="there is no alarm"):
                self.one.book.acknowledge(key, "Ada")
            return
        self.one.book.acknowledge(key, "Ada")
        self.unacknowledged.discard(key)
        if key not in self.active | self.latched:
            self.shelved.pop(key, None)
        self.settle()

    @rule(key=st.sampled_from(sorted(KEYS)), minutes=st.integers(1, 3))
    def it_is_shelved(self, key: str, minutes: int) -> None:
        if key not in self.listed:
            return
        self.one.book.shelve(key, "known", 60.0 * minutes, "Ada")
        self.shelved[key] = self.one.now + 60.0 * minutes

    @rule()
    def it_is_reset(self) -> None:
        critical = {key for key in self.listed if KEYS[key] is not WARNING}
        if critical & (self.active | self.unacknowledged):
            with pytest.raises(Refused):
                self.one.book.reset("Ada")
            return
        self.one.book.reset("Ada")
        self.latched -= self.listed - self.active
        self.unacknowledged &= self.active
        self.shelved = {k: until for k, until in self.shelved.items() if k in self.active}
        self.first_out = ""
        self.settle()

    @rule()
    def a_minute_passes(self) -> None:
        self.one.now += 60.0
        self.one.book.look()
        self.shelved = {k: until for k, until in self.shelved.items() if until > self.one.now}
        self.settle()

    @invariant()
    def the_list_is_as_the_standard_says(self) -> None:
        def state(key: str) -> str:
            if key in self.shelved:
                return "shelved"
            if key in self.active:
                return "unacknowledged" if key in self.unacknowledged else "acknowledged"
            return "latched" if key in self.latched else "returned"

        assert self.one.states() == {key: state(key) for key in self.listed}
        marked = [alarm.key for alarm in self.one.book.alarms() if alarm.first_out]
        assert marked == ([self.first_out] if self.first_out else [])
        assert (self.one.book.blocking() is not None) == bool(self.listed - {"count_mismatch"})


TestIsa = Isa.TestCase
TestIsa.settings = settings(max_examples=60, stateful_step_count=30, deadline=None)


def test_an_unknown_alarm_is_named() -> None:
    with pytest.raises(Refused, match='no alarm "overlod"'):
        NotificationState().book.acknowledge("overlod", "Ada")


def test_critical_alarms_come_first() -> None:
    one = NotificationState()
    one.book.raise_alarm(WARNING)
    one.now += 1
    one.book.raise_alarm(CRITICAL)
    assert [a.severity for a in one.book.alarms()] == [Severity.CRITICAL, Severity.WARNING]


# --- schedule ------------------------------------------------------------------------------------


@given(
    st.integers(1, 3000),
    st.integers(1, 500),
    st.integers(1, 40),
    st.sampled_from(["every", "logarithmic", "none"]),
)
def test_the_plan_is_the_number_of_cycles_kept(n: int, every: int, decade: int, kind: str) -> None:
    schedule = Schedule(CyclesSection(kind, every, decade), n)  # type: ignore[arg-type]
    kept = [i for i in range(1, n + 1) if schedule.keeps(i)]
    assert len(kept) == schedule.planned()
    assert kept[-1:] == ([n] if kind != "none" else [])


def test_logarithmic_cycles_are_evenly_spaced_in_the_logarithm() -> None:
    found = sorted(logarithmic(100_000, 10))
    assert found[:4] == [1, 2, 3, 4]
    decades = Counter(len(str(number)) for number in found)
    assert decades[4] == decades[5] == 10


# --- states --------------------------------------------------------------------------------------


def test_every_state_of_a_test_can_be_stopped_and_only_so_left() -> None:
    for state in ACTIVE:
        assert transition(state, Trigger.STOP) is RunState.STOPPING
        assert not allowed(state, Trigger.DISCONNECT)
        assert not allowed(state, Trigger.CONNECT)
        assert not allowed(state, Trigger.START)
    for (state, _), following in TABLE.items():
        if following in ENDED and state in ACTIVE:
            assert state is RunState.STOPPING


def test_every_state_is_reached_and_none_is_a_trap() -> None:
    reached = {RunState.IDLE}
    for _ in RunState:
        reached |= {following for (state, _), following in TABLE.items() if state in reached}
    # An open calibration is a state for those who look on; the engine below it is ready.
    assert reached == set(RunState) - {RunState.CALIBRATING}
    for state in reached:
        there = {state}
        for _ in RunState:
            there |= {to for (at, _), to in TABLE.items() if at in there}
        assert RunState.IDLE in there


def test_what_is_not_in_the_table_is_refused_with_what_is_possible() -> None:
    for state, trigger in itertools.product(RunState, Trigger):
        if (state, trigger) in TABLE:
            assert transition(state, trigger) is TABLE[state, trigger]
        else:
            with pytest.raises(Refused, match=f"not possible while {state.value}"):
                transition(state, trigger)


@pytest.mark.parametrize(
    ("reason", "status"),
    [
        (FinishReason.COMPLETE, "complete"),
        (FinishReason.OPERATOR, "stopped"),
        (FinishReason.LIMIT, "stopped"),
        (FinishReason.DEVICE, "fault"),
        (FinishReason.STORAGE, "fault"),
        (FinishReason.INTERNAL, "fault"),
    ],
)
def test_the_file_says_how_the_test_ended(reason: FinishReason, status: str) -> None:
    assert Ending(reason, "because").status == status
