"""The notification channels of rig and user: list them, test them, add and remove one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Final, get_args

from PySide6.QtCore import QProcess
from PySide6.QtGui import QShowEvent
from PySide6.QtWidgets import QCheckBox, QWidget

from rigapp.config.errors import UnusableInput
from rigapp.config.notify import NotifySection, When
from rigapp.gui.widgets.build import button, column, edit, named, prose
from rigapp.gui.widgets.reflow import flowing
from rigapp.gui.widgets.tables import PlainTable
from rigapp.presentation.tokens import STEP
from rigapp.presentation.translation import Text, tr, translate
from rigapp.process.children import module_command
from rigapp.schema.details import error_text
from rigapp.viewer.tasks import TaskWorker

if TYPE_CHECKING:
    from rigapp.notify.channels import ListedWay

WORDS: Final[dict[str, Text]] = {
    "critical": "critical alarms",
    "warning": "warnings",
    "end": "end of a test",
    "pause": "pauses",
    "criterion": "end is near",
    "silence": "silent engine",
    "disk": "full disk",
    "daily": "daily summary",
}
"""Topics of messages, in the order of the choices."""
EMPTY: Final[Text] = "Nobody is notified. Add a recipient: a URL as in mailtos:// or json://."
COUNTS: Final[Text] = "A new recipient takes effect when the engine is started again."
TABLE_HEIGHT = 13 * STEP


class MessageCard(QWidget):
    """List and test the notification channels, add and remove those of the user's file."""

    def __init__(
        self, worker: TaskWorker, rig: Path | None, say: Callable[[str, bool], None]
    ) -> None:
        super().__init__()
        self._worker, self._rig, self._say = worker, rig, say
        self._ways: tuple[ListedWay, ...] = ()
        named(self, "message_ways", "Recipients")
        self.table = PlainTable(
            "way_table", "Recipients", ("Recipient", "Leads to", "Reports"), stretch=(2,), cut=(1,)
        )
        self.table.setMinimumHeight(TABLE_HEIGHT)
        self.table.itemSelectionChanged.connect(self._enable)
        self.message = prose("ways_told", "Result", role="caption")
        self.test = button("ways_test", "Send a test &message", self._test)
        tip: Text = "Remove the selected recipient; those of the rig file stay"
        self.remove = button(
            "way_remove", "Remove", self._remove, "Remove the selected recipient", tip=tip
        )
        self.name = edit("way_name", "Name of a new recipient", self._enable, hint="Name")
        self.url = edit("way_url", "Address of a new recipient", self._enable, hint="URL")
        self.when = {
            kind: named(QCheckBox(tr(WORDS[kind])), f"way_when_{kind}", WORDS[kind])
            for kind in get_args(When)
        }
        for kind in NotifySection().when:
            self.when[kind].setChecked(True)
        self.add = button("way_add", "Add", self._add, "Add recipient")
        column(
            (self.table, 1),
            flowing(self.test, self.remove, None),
            self.message,
            flowing("New recipient", (self.name, 1), (self.url, 2), self.add),
            flowing(*self.when.values()),
            on=self,
            spacing=STEP,
        )
        self._process = QProcess(self)
        self._process.finished.connect(self._tested)
        self._enable()

    def showEvent(self, event: QShowEvent) -> None:
        """Read the channels again, since they may have been edited."""
        super().showEvent(event)
        self.look()

    def look(self) -> None:
        """Read the channels on the worker."""
        rig = self._rig
        self._worker.submit(lambda: _read(rig), self._list, self._fail)

    def _list(self, ways: tuple[ListedWay, ...]) -> None:
        self._ways = ways
        self.table.show_rows(
            [
                (way.name, way.leads_to, ", ".join(tr(WORDS[when]) for when in way.when))
                for way in ways
            ]
        )
        if not ways:
            self.message.setText(tr(EMPTY))
        self._enable()

    def _fail(self, error: Exception) -> None:
        self.message.setText(error_text(error, "The ways cannot be read."))

    def _enable(self) -> None:
        chosen = self.table.chosen_of(self._ways)
        self.remove.setEnabled(chosen is not None and chosen.own)
        self.test.setEnabled(bool(self._ways) and not self._process.processId())
        self.add.setEnabled(bool(self.name.text().strip() and self.url.text().strip()))

    def _add(self) -> None:
        from rigapp.notify.channels import add_way

        when = tuple(kind for kind, box in self.when.items() if box.isChecked())
        way = NotifySection(url=self.url.text().strip(), name=self.name.text().strip(), when=when)
        try:
            add_way(way)
        except UnusableInput as error:
            self.message.setText(translate(error_text(error, "The way cannot be added.")))
            return
        self.name.clear()
        self.url.clear()
        self.message.setText(tr(COUNTS))
        self.look()

    def _remove(self) -> None:
        from rigapp.notify.channels import remove_way

        chosen = self.table.chosen_of(self._ways)
        if chosen is None:
            return
        try:
            remove_way(chosen.name)
        except UnusableInput as error:
            self.message.setText(translate(error_text(error, "The way cannot be removed.")))
            return
        self.message.setText(tr(COUNTS))
        self.look()

    def _test(self) -> None:
        rig = ["--rig", self._rig] if self._rig is not None else []
        program, *arguments = module_command("rigapp", "notify", "--test", *rig)
        self.message.setText(tr("Sending a test message …"))
        self._process.start(program, arguments)
        self._enable()

    def _tested(self) -> None:
        output = bytes(self._process.readAllStandardOutput().data()).decode(errors="replace")
        errors = bytes(self._process.readAllStandardError().data()).decode(errors="replace")
        self.message.setText((output.strip() or errors.strip()).removeprefix("rigapp: "))
        self._enable()


def _read(rig: Path | None) -> tuple[ListedWay, ...]:
    from rigapp.config.loading import read_rig
    from rigapp.notify.channels import listed_ways

    return listed_ways(read_rig(rig) if rig is not None else None)
