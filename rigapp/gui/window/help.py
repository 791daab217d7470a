"""Help on F1: the operator's manual where it is installed, and always the keys."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QTextBrowser, QVBoxLayout, QWidget

from rigapp.gui.language.words import Text, tr
from rigapp.gui.widgets.build import named
from rigapp.gui.window.controls import BUTTONS
from rigapp.gui.window.recover import KEY as RECOVER_KEY

KEYS: Text = """
| Key | Does |
| --- | --- |
{commands}
| F8 | Go to the line for reasons and notes; Enter adds the note to the log |
| F7 | Acknowledge the alarm that is told in full; show the alarms where none is seen |
| {recover} | Do the next step of the *Recover* panel |
| F1 | This help |
| F3 | Calibrate the load cell or the probes, map the pin's run-out |
| F9 | Light or dark |
| Ctrl+1 … Ctrl+9, Ctrl+W, Ctrl+0, Ctrl+R | Go to a page |
| Alt + underlined letter | Press a button, go to a field |
| ← → + − in a trend | Move and zoom; a click reads the values at a cycle, Esc the newest again |
| ← → in a force plot | Move the cursor by 1 deg, with Shift by 10 deg; a click puts it there |
| Esc | Close the start bar or this window |

The emergency stop is the red button on the rig. It works without this program, and no program
replaces it. "Stop test" ends a test in order: the spindle runs down, the file is closed.
"""


def manual() -> str:
    """Return the operator's manual as Markdown; only the keys where no manual is installed."""
    commands = "\n".join(
        f"| {command.key} | {command.spoken.rstrip('…')}: {tr(command.tip)} |"
        for command in BUTTONS
    )
    keys = f"# {tr('Keys')}\n{tr(KEYS, commands=commands, recover=RECOVER_KEY)}"
    path = Path(__file__).parents[3] / "docs" / "operator.md"
    try:
        return path.read_text(encoding="utf-8") + "\n\n" + keys
    except OSError:
        return keys


class HelpWindow(QWidget):
    """Show the manual in a window of its own, which never blocks the first one."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent, Qt.WindowType.Window)
        named(self, "help", "Help").setWindowTitle(tr("Help"))
        self.browser = named(QTextBrowser(), "help_text", "Manual")
        self.browser.setOpenExternalLinks(False)
        self.browser.setMarkdown(manual())
        column = QVBoxLayout(self)
        column.addWidget(self.browser)
        QShortcut(QKeySequence(Qt.Key.Key_Escape), self, self.close)
        self.resize(820, 640)
