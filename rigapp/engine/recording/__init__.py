"""Recording of a test: the plan of its file, the cycles to store, and the writing."""
