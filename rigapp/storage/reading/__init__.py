"""Read test files at every instant, old ones too, and export their data."""
