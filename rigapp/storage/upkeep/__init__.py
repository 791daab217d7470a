"""Work on existing files: resume a test, compress, seal, salvage."""
