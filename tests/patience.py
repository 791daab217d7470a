"""How long a test waits for what must come: one number for the whole suite."""

PATIENCE_S = 240.0
"""Whatever is waited for comes within seconds where nothing else runs; a loaded computer may take
minutes. A test has 300 s in all."""

PATIENCE_MS = round(1000 * PATIENCE_S)
"""The same for qtbot."""
