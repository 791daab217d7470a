"""Panel for the recovery from a fault: cause, steps, and one button for the next step.

The engine determines the next step (``engine.views``); the panel only shows and requests it.
"""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QFrame, QLabel

from rigapp.gui.widgets.build import button, column, named, prose
from rigapp.gui.widgets.details import FoldedDetails
from rigapp.presentation.tokens import CARD_RADIUS, GAP, MARGIN, STEP, Theme
from rigapp.presentation.translation import Text, marked, tr, translate
from rigapp.schema.details import details_of
from rigapp.schema.messages import NO_TEST, Alarm, Remedy, RunState, Severity, Status
from rigapp.schema.states import ACTIVE

KEY: Final = "F10"

STEPS: Final[dict[Remedy, Text]] = {
    Remedy.CAUSE: "Remove the cause",
    Remedy.CONNECT: "Connect",
    Remedy.ACKNOWLEDGE: "Acknowledge",
    Remedy.RESET: "Reset",
    Remedy.RESUME: "Resume",
}
"""The steps in order, with their names in the panel."""

BUTTONS: Final[dict[str, Text]] = {
    "connect": "Connect the devices",
    "acknowledge": "Acknowledge all",
    "reset": "Reset",
    "resume": "Resume the test",
    "resume_file": "Resume the test",
    "start": "Start a test…",
}
"""Text of the button for the request of each step."""

BUTTON_PLACE: Final = 2
"""Position of the button in the panel, below the sentence of the next step: both are above the
steps and the cause, so that they are visible in every window."""

UNDER_WAY: Final = ACTIVE - {RunState.STOPPING}
"""States that need no recovery."""


def needs_recovery(status: Status) -> bool:
    """Return whether a fault prevents the next start."""
    if status.engine.state in ACTIVE or status.engine.state is RunState.CONNECTING:
        return False
    return status.engine.state is RunState.FAULT or _worst(status) is not None


def _worst(status: Status) -> Alarm | None:
    """Return the critical alarm of the next step, or the first critical alarm."""
    critical = [alarm for alarm in status.alarms if alarm.severity is Severity.CRITICAL]
    wanted = status.recovery.cause
    return min(
        critical,
        key=lambda alarm: (alarm.key != wanted, not alarm.active, not alarm.first_out),
        default=None,
    )


class RecoverPanel(QFrame):
    """Guide through the recovery from a fault; hidden while there is none."""

    wanted = Signal(str, dict)
    start_wanted = Signal()

    def __init__(self, theme: Theme) -> None:
        super().__init__()
        self._theme = theme
        self._status: Status | None = None
        self._requested = self._tight = False
        self._why = ""
        named(self, "recover_panel", "Recover")
        self.title = named(QLabel(tr("Recover")), "recover_title", "Recover")
        self.cause = prose("recover_cause", "What happened")
        self.details = FoldedDetails("recover")
        self.next = prose("recover_next", "Next step")
        self.steps = {
            step: named(QLabel(), f"recover_step_{step.name.lower()}", tr("Step: {}", tr(text)))
            for step, text in STEPS.items()
        }
        self.button = button(
            "recover_do", "", self.act, "Do the next step", guarded=True, rank="primary"
        )
        self.button.setFixedHeight(5 * STEP)
        self.other = button(
            "recover_other", "Start another test…", self.start_wanted.emit, guarded=True
        )
        self.away = button("recover_away", "Close", self.hide, "Close the panel")
        self._lay_out()
        self.dress(theme)
        self.hide()

    def make_room(self, *, tight: bool) -> None:
        """Show only the next step in a tight window, its button first."""
        self._tight = tight
        self.title.setHidden(tight)
        self._column.removeWidget(self.button)
        self._column.insertWidget(0 if tight else BUTTON_PLACE, self.button)
        self._show()

    def dress(self, theme: Theme) -> None:
        """Apply a theme."""
        self._theme = theme
        self._show()

    def take_status(self, status: Status | None) -> None:
        """Update to the newest status; open for a recovery, close when a test runs."""
        before, self._status = self._status, status
        changed = before is None or status is None or _situation(before) != _situation(status)
        if changed:
            self._requested = False
        if status is None or status.engine.state in UNDER_WAY:
            self.hide()
        elif needs_recovery(status) and self.isHidden():
            self._why = ""
            self.show()
            changed = True
        if changed:
            self._show()

    def answered(self) -> None:
        """Enable the button again after the answer to a request."""
        self._requested = False
        self._show()

    def press(self) -> None:
        """Perform the next step by its key, on any page."""
        self.button.click()

    def act(self) -> None:
        """Request the next step."""
        status = self._status
        verb = status.recovery.verb if status is not None else ""
        if status is None or not verb or self._requested:
            return
        if verb == "start":
            self.start_wanted.emit()
            return
        self._requested = True
        self._show()
        self.wanted.emit(
            verb, {"file": (status.test or NO_TEST).file} if verb == "resume_file" else {}
        )

    def _show(self) -> None:
        status = self._status
        if status is None:
            return
        recovery = status.recovery
        worst = _worst(status)
        if worst is not None:
            self._why = worst.cause
        self._frame(recovered=recovery.step is Remedy.RESUME)
        self.cause.setText(translate(self._why or status.engine.reason))
        self.details.show_details(details_of(self._why or status.engine.reason))
        self.next.setText(translate(recovery.sentence))
        for number, (step, label) in enumerate(self.steps.items(), 1):
            now = step is recovery.step
            label.setHidden(self._tight and not now)
            mark = "▶" if now else "○" if step in recovery.left or not recovery.left else "✔"
            label.setText(f"{mark} {number} {tr(STEPS[step])}")
            label.setStyleSheet(self._step_style(now=now, left=mark == "○"))
            state: Text = "next" if now else "to do" if mark == "○" else "done"
            label.setAccessibleDescription(tr(state))
        text: Text = BUTTONS.get(recovery.verb, marked("Waiting until the cause is removed"))
        if recovery.step is Remedy.NONE:
            text = tr("Wait")
        self.button.setText(f"{tr(text)}  {KEY}")
        self.button.setEnabled(bool(recovery.verb) and not self._requested)
        self.button.setToolTip(translate(recovery.sentence))
        self.other.setVisible(recovery.verb == "resume_file")
        self.away.setVisible(recovery.step is Remedy.RESUME)

    def _frame(self, *, recovered: bool) -> None:
        theme = self._theme
        edge = theme.border if recovered else theme.critical
        sheet = (
            f"#recover_panel {{ background: {theme.base}; border: 2px solid {edge};"
            f" border-radius: {CARD_RADIUS}px; }}"
            " #recover_title, #recover_next { font-weight: 600; }"
        )
        if sheet != self.styleSheet():
            self.setStyleSheet(sheet)

    def _step_style(self, *, now: bool, left: bool) -> str:
        theme = self._theme
        if now:
            return (
                f"background: {theme.tint}; color: {theme.highlight}; font-weight: 600;"
                f" padding: 4px 8px; border-left: 3px solid {theme.highlight};"
            )
        return f"color: {theme.text if left else theme.muted}; padding: 4px 8px;"

    def _lay_out(self) -> None:
        steps = column(*self.steps.values())
        steps.setSpacing(STEP // 2)
        layout = self._column = column(
            self.title, self.next, self.button, self.other, self.away, steps, self.cause,
            self.details, on=self,
        )  # fmt: skip
        layout.setContentsMargins(MARGIN, GAP, MARGIN, GAP)
        layout.setSpacing(STEP)


def _situation(status: Status) -> tuple[object, ...]:
    worst = _worst(status)
    return (
        status.engine.state,
        status.engine.reason,
        status.recovery,
        worst.cause if worst is not None else "",
    )
