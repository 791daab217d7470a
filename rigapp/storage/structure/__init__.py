"""What a test file holds and how it is laid out: streams, columns, settings, rows of the log."""
