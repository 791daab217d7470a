"""Keep a test: what the file shall hold, which cycles, and the thread that stores."""
