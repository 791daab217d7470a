"""Documents: ``page`` (layout), ``testreport`` (report of a test), ``paper`` (comparisons)."""
