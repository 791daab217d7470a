"""The engine as a process: server, client, and how they find each other."""
