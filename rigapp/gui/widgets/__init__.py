"""Basic widgets of all panels: labels, buttons, tables, bars, independent of tests."""
