"""Record a test: the plan of its file, the cycles that are kept, and the writing."""
