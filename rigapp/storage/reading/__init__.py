"""Read a test file at every instant, old ones too, and hand its data to other programs."""
