"""Read test files, also running and older ones, and export their data."""
