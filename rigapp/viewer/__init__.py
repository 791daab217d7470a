"""What window and page know: the engine's snapshots, a test's file, who is in command. No Qt here.

Everything slow is done on a worker's thread and handed over when the screen asks for it.
"""
