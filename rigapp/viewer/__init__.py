"""The data behind window and page: the engine's snapshots, a test's file, control. No Qt here.

Slow work runs on a worker's thread, and its results are delivered to the screen's thread.
"""
