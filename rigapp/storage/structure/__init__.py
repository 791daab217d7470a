"""Contents and layout of a test file: streams, columns, settings, rows of the log."""
